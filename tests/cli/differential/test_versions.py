# SPDX-License-Identifier: BSD-3-Clause
"""The list of what another version of oiiotool does otherwise: that it names cases, that it is what the
page shows, and that neither a difference nor a row passes without the other."""

from pathlib import Path

import pytest
import versions
from cases import CASES
from test_pipelines import PIPELINES
from versions import RESULT, TEXT, Difference, judge

PAGE = Path(__file__).resolve().parents[3] / "src" / "doc" / "building.md"

ROWS = (Difference((2, 5), TEXT, "other words", "words"),
        Difference((3, 0), RESULT, "other pixels", "pixels"),
        Difference((2, 5), TEXT, "for a while", "passing", before=(3, 0)),
        Difference((3, 1), RESULT, "other pixels now", "words"))
PRINTS = ["stdout differs\n--- oiiotool\na\n--- tonetool\nb"]
WRITES = ["out.exr: part (0, 0): 1 of 2 values differ"]


def test_rows_of_a_version_name_cases_once():
    pairs = [(row.since, name) for row in versions.DIFFERENCES for name in row.cases()]
    assert len(set(pairs)) == len(pairs) > 0
    names = [name for _, name in pairs]
    assert not set(names) - {case.name for case in CASES + PIPELINES}
    assert all(row.kind in (TEXT, RESULT) and row.since > versions.WRITTEN_FOR and row.reason
               for row in versions.DIFFERENCES)


@pytest.mark.parametrize("made", [versions.table, versions.table_of_commands])
def test_page_shows_the_rows(made):
    assert made() in PAGE.read_text(encoding="utf-8"), "the page should have:\n" + made()


@pytest.mark.parametrize("found", [[], PRINTS, WRITES])
def test_what_is_not_listed_is_left_as_it_is(found):
    assert judge("words", found, (2, 4), ROWS) == found
    assert judge("pixels", found, (2, 5), ROWS) == found


@pytest.mark.parametrize("name, found, version", [("words", PRINTS, (2, 5)),
                                                  ("pixels", WRITES, (3, 0)),
                                                  ("pixels", PRINTS + WRITES, (3, 1))])
def test_a_listed_difference_is_expected(name, found, version):
    with pytest.raises(pytest.xfail.Exception, match="other"):
        judge(name, found, version, ROWS)


def test_the_newest_row_counts_and_an_ended_one_does_not():
    with pytest.raises(pytest.xfail.Exception, match="other pixels now"):
        judge("words", WRITES, (3, 1), ROWS)
    assert "versions.py says" in judge("words", PRINTS, (3, 1), ROWS)[0]
    with pytest.raises(pytest.xfail.Exception, match="for a while"):
        judge("passing", PRINTS, (2, 6), ROWS)
    assert judge("passing", [], (3, 0), ROWS) == [] and judge("passing", PRINTS, (3, 0), ROWS) == PRINTS


@pytest.mark.parametrize("name, found", [("words", []), ("words", WRITES), ("words", PRINTS + WRITES),
                                         ("pixels", PRINTS)])
def test_a_row_that_is_not_so_fails(name, found):
    assert "versions.py says" in judge(name, found, (3, 0), ROWS[:1] if name == "words" else ROWS)[0]


def test_commands_that_are_not_taken():
    assert versions.not_taken((2, 4)) == (set(), set())
    commands, modifiers = versions.not_taken((2, 5))
    assert "normalize" in commands and ("resize", "from") in modifiers
