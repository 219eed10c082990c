# SPDX-License-Identifier: BSD-3-Clause
"""--github and --summary: what did not pass, as continuous integration shows it."""

import re
import shutil

import numpy as np
import pytest

MSE = "--errormap:metric=mse:print=0:fail=mse=0.2,max=0.9"


@pytest.fixture
def suite(tmp_path, make_image):
    """One case passes, one fails, one is missing."""
    for side in "rt":
        (tmp_path / side).mkdir()
        make_image(f"{side}/cornell.exr", 4, 4)
        make_image(f"{side}/hair_1.exr", 4, 4, pixels=np.full((4, 4, 3), 0 if side == "r" else 0.5 ** 0.5))
    make_image("r/pla,ne: 5%.exr", 4, 4)
    return tmp_path


WORDS = ["r/%N.exr", "t/%N.exr", MSE, "-q"]


def lines_of(ran):
    return [line for line in ran.out.splitlines() if line.startswith("::")]


def decoded(text):
    """As GitHub's runner reads it."""
    for code, sign in (("%3A", ":"), ("%2C", ","), ("%0D", "\r"), ("%0A", "\n"), ("%25", "%")):
        text = text.replace(code, sign)
    return text


def test_annotations(tonetool, suite):
    ran = tonetool(*WORDS, "--github", status=1)
    assert lines_of(ran) == [
        "::error title=check%3A hair_1 failed::errormap: mse 0.5 > 0.2",
        '::error title=check%3A pla%2Cne%3A 5%25 missing::no test "t/pla,ne: 5%25.exr"']
    assert ran.out.index("check: missing") < ran.out.index("::error")
    match = re.fullmatch(r"::error title=([^:]*)::(.*)", lines_of(ran)[1])
    assert decoded(match[1]) == "check: pla,ne: 5% missing"
    assert decoded(match[2]) == 'no test "t/pla,ne: 5%.exr"'


def test_ten_of_a_kind(tonetool, suite):
    for number in range(40):
        shutil.copy(suite / "r/cornell.exr", suite / f"r/extra{number:02}.exr")
    lines = lines_of(tonetool(*WORDS, "--github", status=1))
    assert len(lines) == 10 and lines[-1] == "::error title=check::and 33 more: see the summary"


def test_summary_is_added(tonetool, suite):
    (suite / "s.md").write_text("before\n")
    tonetool(*WORDS, "--summary", "s.md", "--json", "j.json", status=1)
    table = """## check: missing

3 cases: 1 missing, 1 failed, 1 passed

| case | status | quantity | value | limit | why |
|---|---|---|--:|--:|---|
| pla,ne: 5% | missing | | | | no test "t/pla,ne: 5%.exr" |
| hair\\_1 | failed | errormap mse | 0.5000 | 0.2 | |
"""
    assert (suite / "s.md").read_text() == "before\n" + table
    tonetool("--merge", "j.json", "--summary", "merged.md", status=1)
    assert (suite / "merged.md").read_text() == table
    tonetool(*WORDS, "-n", "--summary", "none.md", status=1)
    assert not (suite / "none.md").exists()


def test_the_summary_of_a_step(tonetool, suite, monkeypatch):
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(suite / "step.md"))
    tonetool(*WORDS, "--github", status=1, env=None)
    assert (suite / "step.md").read_text().startswith("## check: missing\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(suite / "no/step.md"))
    ran = tonetool("r/cornell.exr", "t/cornell.exr", MSE, "--github", status=1, env=None)
    assert "cannot write" in ran.err  # a summary that is lost is no success


def test_a_shot_has_frames(tonetool, tmp_path, make_image):
    for side, frames in (("r", (1, 2)), ("t", (1,))):
        for frame in frames:
            make_image(f"{side}.{frame:04}.exr", 4, 4)
    ran = tonetool("r.#.exr", "t.#.exr", MSE, "-q", "--github", "--summary", "s.md", status=1)
    assert lines_of(ran) == ['::error title=check%3A frame 2 missing::no file "t.0002.exr"']
    assert '\n| frame 2 | missing | | | | no file "t.0002.exr" |\n' in (tmp_path / "s.md").read_text()


def test_a_long_summary_is_cut(tonetool, suite):
    for number in range(250):
        shutil.copy(suite / "r/cornell.exr", suite / f"r/extra{number:03}.exr")
    tonetool(*WORDS, "--summary", "s.md", status=1)
    lines = (suite / "s.md").read_text().splitlines()
    assert len(lines) == 4 + 2 + 200 + 2 and lines[-1] == "and 52 more"


def test_warnings_and_what_passed(tonetool, suite):
    (suite / "r/pla,ne: 5%.exr").unlink()
    words = ["r/%N.exr", "t/%N.exr", "--errormap:metric=mse:print=0:warn=0.2", "--github"]
    ran = tonetool(*words, "--summary", "s.md")
    assert lines_of(ran) == ["::warning title=check%3A hair_1 warning::errormap: mse 0.5 > 0.2"]
    (suite / "s.md").unlink()
    (suite / "t/hair_1.exr").unlink()
    shutil.copy(suite / "r/hair_1.exr", suite / "t/hair_1.exr")
    assert not lines_of(tonetool(*words, "--summary", "s.md"))
    assert (suite / "s.md").read_text() == "## check: passed\n\n2 cases: 2 passed\n"
