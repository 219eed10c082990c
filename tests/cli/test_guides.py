# SPDX-License-Identifier: BSD-3-Clause
"""Every command of the guides in src/doc runs, and prints what they show."""

import markdown
import pytest
from page_tests import cases, check, check_links

RUN = [page for page in markdown.PAGES if page != "README.md"]


@pytest.mark.parametrize("block", cases(RUN))
def test_command(block, program, tmp_path):
    check(block, program, tmp_path)


def test_there_are_commands_and_outputs():
    found = [case.values[0] for case in cases(RUN)]
    assert sum(len(block.commands()) for block in found) >= 60
    assert sum(block.shown is not None for block in found) >= 20


@pytest.mark.parametrize("page", markdown.GUIDES)
def test_links(page):
    check_links(page)


def test_every_guide_is_linked_from_the_readme():
    readme = (markdown.ROOT / "README.md").read_text(encoding="utf-8")
    for page in markdown.GUIDES:
        assert f"({page}" in readme, page


def test_recipe_is_shown_as_it_is():
    shown = [text for text in markdown.code("src/doc/recipes.md", "text") if text.startswith("tonetool 1")]
    assert shown == [(markdown.ROOT / "testimages" / "flip.tone").read_text(encoding="utf-8")]
