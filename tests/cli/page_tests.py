# SPDX-License-Identifier: BSD-3-Clause
"""What is tested of a page: its commands succeed, write what they say, and print what is shown."""

import re
import shlex

import markdown
import pytest

# Commands that no test of a page runs, and why.
NOT_RUN = {
    "bash src/scripts/demo.sh": "test_readme.py runs it with build/release",
    "bash src/scripts/test.sh": "it is what runs these tests",
    "bash src/scripts/test.sh --preset asan": "the same, of another build",
    "cmake --install build/release": "it writes outside the build; tests/package installs",
    "build/release/tests/bench/tonetool_bench": "it takes minutes, and its result is a time",
}


def not_run(block):
    """Why a block is not run; empty where it is. A block is run whole or not at all."""
    reasons = [NOT_RUN.get(command, "") for command in block.commands()]
    assert all(reasons) or not any(reasons), f"{block}: part of it cannot be run"
    return reasons[0]


def cases(pages):
    """The commands of pages, as parameters of a test."""
    found = [block for page in pages for block in markdown.blocks(page) + markdown.inline(page)]
    return [pytest.param(block, id=repr(block)) for block in found if not not_run(block)]


def outputs(block):
    """The files that a block's commands write by -o, in its folder."""
    for command in block.commands():
        words = shlex.split(command)
        for flag, name in zip(words, words[1:]):
            if flag == "-o":
                yield name.replace("#", "*").replace("%N", "*")


def check(block, program, folder):
    """Runs a block and compares what is shown."""
    reason = markdown.lacks(block, program)
    if reason:
        pytest.skip(reason)
    markdown.fill(folder, program)
    ran = markdown.run(block, program, folder)
    assert not ran.failed, f"{block}: {ran.failed[0]}\n{ran.text}"
    for name in outputs(block):
        written = [file.stat().st_size for file in folder.glob(name)]
        assert written and min(written) > 0, f"{block}: nothing in {name}\n{ran.text}"
    if block.shown is not None:
        assert markdown.same_output(block.shown, ran.lines, block.within), (
            f"{block}: shown is\n" + "\n".join(block.shown) + "\n\nprinted was\n" + ran.text
            + "\nsrc/scripts/remake_outputs.py renews the page")


def links(page):
    """The files that a page links to, relative to it."""
    text = (markdown.ROOT / page).read_text(encoding="utf-8")
    return [target.partition("#") for target in re.findall(r"\]\(([^)\s]+)\)", text)
            if "://" not in target]


def headings(path):
    """The anchors of a page, as GitHub makes them."""
    found = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in found}


def check_links(page):
    """Every link of a page leads somewhere."""
    for target, _, anchor in links(page):
        path = (markdown.ROOT / page).parent / target if target else markdown.ROOT / page
        assert path.exists(), f"{page}: no {target}"
        assert not anchor or anchor in headings(path), f"{page}: no {target}#{anchor}"
