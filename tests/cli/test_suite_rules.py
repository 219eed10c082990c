# SPDX-License-Identifier: BSD-3-Clause
"""--suite: named cases by a file of limits, --only, skipped cases, and parts of a suite."""

import csv
import itertools
import json
import os
import re
import shutil
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from conftest import call
from prestart import run_bytes

HEAD = """tonetool-suite = 1
name = "lookdev"
reference = "r/%N.exr"
test = "t/%N.exr"
"""
MSE = "--errormap:metric=mse:print=0:fail=mse=0.01"
PRINTERS = ["--json", "{}.json", "--csv", "{}.csv", "--junit", "{}.xml", "--summary", "{}.md"]
# The squares of these are the errors: .04, .09, .16, .25
OFFSETS = {"glass": 0.0, "hair/a": 0.2, "hair/b": 0.3, "wood": 0.4, "zinc": 0.5}


def rows_text(*rows):
    """[[case]] rows from pairs of a key and its text."""
    return "".join("\n[[case]]\n" + "".join(f"{key} = {json.dumps(text)}\n" for key, text in row.items())
                   for row in rows)


@pytest.fixture
def images(tmp_path, make_image):
    """Five cases; the mean square error of each is that of OFFSETS."""
    for name, offset in OFFSETS.items():
        for side in "rt":
            (tmp_path / side / name).parent.mkdir(parents=True, exist_ok=True)
        make_image(f"r/{name}.exr", 4, 4, pixels=np.full((4, 4, 3), 0.25))
        make_image(f"t/{name}.exr", 4, 4, pixels=np.full((4, 4, 3), 0.25 + offset))
    return tmp_path


@pytest.fixture
def suite(images):
    """Writes suite.toml of a check and rows."""

    def write(*rows, check=MSE, head=HEAD, file="suite.toml"):
        (images / file).parent.mkdir(parents=True, exist_ok=True)
        (images / file).write_text(head + f"check = {json.dumps(check)}\n" + rows_text(*rows))
        return images

    return write


@pytest.fixture
def check(tonetool, tmp_path):
    """Runs suite.toml; the cases of its JSON by name."""

    def run(*words, status=3):
        tonetool("--suite", "suite.toml", *words, "--json", "j.json", "-q", status=status)
        return {case["name"]: case for case in load(tmp_path / "j.json")["frames"]}

    return run


def load(path):
    return json.loads(path.read_text())


def table(path):
    with open(path, newline="", errors="surrogateescape", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def statuses(cases):
    return {name: case["status"] for name, case in cases.items()}


def printers(name):
    return [word.format(name) for word in PRINTERS]


def all_but(failed):
    return {name: "failed" if name in failed else "passed" for name in OFFSETS}


# ---- rows

def test_the_check_of_the_file(check, suite):
    suite()
    assert statuses(check()) == all_but(["hair/a", "hair/b", "wood", "zinc"])


@pytest.mark.parametrize("rows, failed", [
    ([{"name": "hair/*", "fail": "mse=0.05"}], ["hair/b", "wood", "zinc"]),
    ([{"name": "*", "fail": "mse=1"}, {"name": "hair/*", "fail": "mse=0.05"}], ["hair/b"]),
    ([{"name": "hair/*", "fail": "mse=0.05"}, {"name": "*", "fail": "mse=1"}], []),
    ([{"name": "*", "fail": "mse=1"}, {"name": "hair/a", "fail": "mse=0.01"},
      {"name": "hair/[a-b]", "fail": "mse=0.06"}], ["hair/b"]),
    ([{"fail": "mse=1"}], []),  # without a name: all
    ([{"fail": "mse=1"}, {"name": "????", "fail": "mse=0.2"}], ["zinc"]),
    ([{"fail": "mse=1"}, {"name": "[!a-w]*", "fail": "mse=0.2"}], ["zinc"]),
])
def test_later_rows_win(check, suite, rows, failed):
    suite(*rows)
    assert statuses(check(status=3 if failed else 0)) == all_but(failed)


def test_later_rows_win_key_by_key(check, suite):
    suite({"name": "*", "fail": "mse=1", "warn": "mse=0.03", "why": "first"},
          {"name": "hair/*", "fail": "mse=0.08"},
          {"name": "hair/b", "why": "curves"},
          {"name": "zinc", "skip": "flaky until #123"},
          {"name": "z*", "fail": "mse=0.01"})
    cases = check()
    assert statuses(cases) == {"glass": "passed", "hair/a": "warning", "hair/b": "failed",
                               "wood": "warning", "zinc": "skipped"}
    assert cases["hair/b"]["why"] == "curves" and cases["hair/a"]["why"] == "first"
    assert cases["zinc"]["message"] == "flaky until #123"


def test_all_limits_of_a_list_hold(check, suite):
    suite({"name": "glass", "fail": "mse=0.01,max=0.01"}, {"name": "hair/a", "fail": "max=0.01,mse=1"},
          {"name": "hair/b", "fail": "mse=0.01,max=1"}, {"name": "wood", "fail": "mse=0.01,max=0.02"},
          {"name": "zinc", "fail": "mse=1,max=1"})
    cases = check()
    assert statuses(cases) == all_but(["hair/a", "hair/b", "wood"])
    for name, told in (("hair/a", ["max"]), ("hair/b", ["mse"]), ("wood", ["mse", "max"])):
        for quantity in ("mse", "max"):  # each that is exceeded is named, and no other
            assert (f"{quantity} 0." in cases[name]["message"]) == (quantity in told), cases[name]
        assert {limit["quantity"] for limit in cases[name]["measurements"][0]["thresholds"]} == {"mse", "max"}


TWO = ("--label tst --swap --label ref --swap --errormap:metric=mse:print=0 ref tst --ldrflip:print=0")


def test_limits_of_several_commands(check, suite, tonetool):
    suite({"name": "*", "fail": "errormap.mse=1,ldrflip.mean=0.99"},
          {"name": "hair/a", "fail": "errormap.mse=0.01,ldrflip.mean=0.99"},
          {"name": "zinc", "fail": "errormap.mse=1,ldrflip.mean=0.01"}, check=TWO)
    cases = check()
    assert statuses(cases) == all_but(["hair/a", "zinc"])
    assert cases["hair/a"]["message"].startswith("errormap: mse")
    assert cases["zinc"]["message"].startswith("ldrflip: mean")
    for limits in ("mse=1", "tmqi.Q=0.5", "errormap.nothing=1"):
        suite({"name": "wood", "fail": limits}, check=TWO)
        assert "suite.toml" in tonetool("--suite", "suite.toml", status=1).err, limits



def test_labels_are_no_files(suite, program):
    """The words of a check that are labels stay, where the suite is in another folder."""
    folder = suite({"name": "*", "fail": "errormap.mse=1,ldrflip.mean=0.99"}, check=TWO)
    (folder / "else").mkdir()
    ran = call(program, ["--suite", "../suite.toml", "-q"], folder / "else")
    assert ran.status == 0, ran.err


def test_a_row_replaces_the_check(check, suite):
    suite({"name": "hair/*", "check": "--errormap:metric=mse:print=0:fail=mse=0.05"},
          {"name": "zinc", "check": "--ldrflip:print=0:fail=mean=0.99"})
    cases = check()
    assert statuses(cases) == all_but(["hair/b", "wood"])
    assert [case["measurements"][0]["command"] for case in cases.values()] == ["errormap"] * 4 + ["ldrflip"]


def test_a_row_sets_the_layer(check, suite, make_image):
    for side, value in (("r", 0.0), ("t", 0.5)):
        pixels = np.zeros((4, 4, 6))
        pixels[:, :, 3:] = value
        make_image(f"{side}/wood.exr", 4, 4, ("R", "G", "B", "spec.R", "spec.G", "spec.B"), pixels=pixels)
    suite({"name": "*", "fail": "mse=1"}, {"name": "wood", "fail": "mse=0.1"})
    assert statuses(check(status=0))["wood"] == "passed"
    suite({"name": "*", "fail": "mse=1"}, {"name": "wood", "fail": "mse=0.1", "layer": "spec"})
    assert statuses(check())["wood"] == "failed"


def test_masks_and_ignored_regions(check, suite, make_image):
    bad = np.full((4, 4, 3), 0.25)
    bad[:, 0] = 1
    for name in ("glass", "hair/a", "wood"):
        make_image(f"t/{name}.exr", 4, 4, pixels=bad)
    mask = np.ones((4, 4, 1))
    mask[:, 0] = 0
    for name in ("glass", "hair/a"):
        (suite() / "m" / name).parent.mkdir(parents=True, exist_ok=True)
        make_image(f"m/{name}.exr", 4, 4, ("Y",), pixels=mask)
    suite({"name": "*", "fail": "mse=1"}, {"name": "[gh]*", "fail": "mse=0.001"},
          {"name": "glass", "mask": "m/%N.exr", "why": "the edge"},
          {"name": "hair/a", "ignore": "1x4+0+0", "why": "the edge"},
          {"name": "hair/b", "fail": "mse=1"}, {"name": "wood", "fail": "mse=0.001"})
    cases = check()
    assert statuses(cases) == all_but(["wood"])
    for name in ("glass", "hair/a"):
        assert cases[name]["measurements"][0]["parameters"]["ignored"] == pytest.approx(0.25)
        assert cases[name]["why"] == "the edge"


def test_methods_have_rows(tonetool, suite):
    folder = suite({"method": "pt*", "fail": "mse=1"}, {"name": "zinc", "method": "bdpt", "skip": "later"},
                   head=HEAD.replace("t/%N", "m/%M/%N"))
    for method in ("bdpt", "pt", "pt2"):
        shutil.copytree(folder / "t", folder / "m" / method)
    tonetool("--suite", "suite.toml", "--csv", "t.csv", "-q", status=3)
    rows = {(row["name"], row["method"]): row["status"] for row in table(folder / "t.csv")}
    assert rows == {(name, method): "passed" if method != "bdpt" or name == "glass" else
                    "skipped" if name == "zinc" else "failed"
                    for name, method in itertools.product(OFFSETS, ("bdpt", "pt", "pt2"))}


def test_a_suite_of_one_pattern_is_the_same_line(tonetool, suite):
    folder = suite()
    tonetool("--suite", "suite.toml", "--json", "s.json", "--csv", "s.csv", "-q", status=3)
    tonetool("r/%N.exr", "t/%N.exr", MSE, "--json", "p.json", "--csv", "p.csv", "-q", status=3)
    assert (folder / "s.csv").read_bytes() == (folder / "p.csv").read_bytes()
    for key in ("verdict", "sentence", "counts", "worst", "frames"):
        assert load(folder / "s.json")[key] == load(folder / "p.json")[key]


def test_the_union_of_both_sides(check, suite):
    folder = suite({"fail": "mse=1"})
    (folder / "t/wood.exr").unlink()
    (folder / "r/zinc.exr").unlink()
    assert statuses(check(status=1)) == {"glass": "passed", "hair/a": "passed", "hair/b": "passed",
                                         "wood": "missing", "zinc": "missing"}


# ---- what is wrong in the file

WRONG = [
    ('[[case]]\nname = "zinc"\nfial = "mse=1"\n', "fial", "did you mean fail?"),
    ('[[case]]\nname = "zinc"\nfail = 0.5\n', "fail = 0.5", ""),
    ('[[case]]\nname = "zinc"\nfail = { mse = 1 }\n', "fail = { mse", ""),
    ('[[case]]\nname = "zinc"\nskip = true\n', "skip = true", ""),
    ('[[case]]\nname = ["zinc"]\nskip = "x"\n', 'name = ["zinc"]', ""),
    ('[[case]]\nname = "zinc"\nskip = "x\n', 'skip = "x', ""),
    ('[[case]]\nname = "zinc"\nmask = "m.exr"\n', 'mask = "m.exr"', "why"),
    ('[[case]]\nname = "zinc"\nignore = "1x1+0+0"\n', 'ignore = "1x1+0+0"', "why"),
    ('[[case]]\nname = "gone/*"\nskip = "x"\n', "[[case]]", "matches no case"),
    ('[[case]]\nname = "ZINC"\nskip = "x"\n', "[[case]]", "matches no case"),
    ('[[case]]\nmethod = "pt"\nskip = "x"\n', "[[case]]", "matches no case"),
    ('approve = true\n', "approve = true", ""),
    ('case = "zinc"\n', 'case = "zinc"', ""),
    ('[cases]\nname = "zinc"\n', "[cases]", ""),
]


@pytest.mark.parametrize("text, line, hint", WRONG, ids=range(len(WRONG)))
@pytest.mark.parametrize("only", [[], ["--only", "glass"]])
def test_errors_have_a_line_and_a_caret(tonetool, suite, text, line, hint, only):
    folder = suite()
    (folder / "suite.toml").write_text((folder / "suite.toml").read_text() + "\n" + text)
    lines = (folder / "suite.toml").read_text().splitlines()
    number = next(at + 1 for at, one in enumerate(lines) if line in one)
    before = {path for path in folder.rglob("*")}
    ran = tonetool("--suite", "suite.toml", *only, *printers("w"), "--report", "w.html", status=1)
    shown = ran.err.split(f"{number} | {lines[number - 1]}\n")
    assert len(shown) == 2 and hint in ran.err
    assert re.match(r" *\| +[\^~]", shown[1])  # what is meant is marked below the line
    assert "check:" not in ran.out and {path for path in folder.rglob("*")} == before


@pytest.mark.parametrize("gone, text", [
    ("tonetool-suite = 1\n", "tonetool-suite = 1"), ('test = "t/%N.exr"\n', "test"),
    ("check = ", "check")])
def test_required_keys(tonetool, suite, gone, text):
    folder = suite()
    kept = [line for line in (folder / "suite.toml").read_text().splitlines(True)
            if not line.startswith(gone)]
    (folder / "suite.toml").write_text("".join(kept))
    assert text in tonetool("--suite", "suite.toml", "--json", "w.json", status=1).err
    assert not (folder / "w.json").exists()


@pytest.mark.parametrize("content", [b"", b"\0\xff\xfe", b"[" * 100000, b"tonetool-suite = 2\n",
                                     b"tonetool-suite = '1'\n", b"a." * 5000 + b"b = 1\n"], ids=range(6))
def test_hostile_files(tonetool, suite, content):
    folder = suite()
    (folder / "suite.toml").write_bytes(content)
    tonetool("--suite", "suite.toml", status=1)
    tonetool("--suite", "none.toml", status=1)
    tonetool("--suite", "r", status=1)
    tonetool("--suite", status=1)


@pytest.mark.parametrize("words", ["-o e/%N.png", "--json x.json", "--csv x.csv", "--report x.html",
                                   "--frames 1-2", "--n", "-n", "--junit x.xml", "--jobs 2",
                                   "--parallel-frames 2", "--state st", "--only glass", "--compat",
                                   "--suite suite.toml", "--images x", "--merge j.json",
                                   "--approve run.json --reason x", "--threads 1", "-q", "-v"])
def test_what_may_not_stand_in_check(tonetool, suite, words):
    for row in (False, True):
        folder = suite(*([{"name": "zinc", "check": f"{MSE} {words}"}] if row else []),
                       check=MSE if row else f"{MSE} {words}")
        before = {path for path in folder.rglob("*")}
        ran = tonetool("--suite", "suite.toml", "--csv", "w.csv", status=1)
        assert words.split()[0] in ran.err and "suite.toml" in ran.err
        assert {path for path in folder.rglob("*")} == before


@pytest.mark.parametrize("words", [["r/glass.exr"], ["r/%N.exr", "t/%N.exr"], ["--hdrflip"],
                                   ["--errormap"], ["--qc"], ["--resize", "2x2"], ["-o", "o.exr"],
                                   ["--compat"], ["--suite", "suite.toml"], ["--views", "left"],
                                   ["--approve", "j.json", "--reason", "x"], ["--key", "cuda"]])
def test_what_may_not_stand_beside(tonetool, suite, words):
    folder = suite()
    before = {path for path in folder.rglob("*")}
    for line in (["--suite", "suite.toml", *words], [*words, "--suite", "suite.toml"]):
        ran = tonetool(*line, "--csv", "w.csv", status=1)
        assert "check:" not in ran.out and {path for path in folder.rglob("*")} == before


def test_file_names_are_relative_to_the_suite(tonetool, suite, make_image, program):
    folder = suite()
    make_image("m.exr", 4, 4, ("Y",), pixels=np.ones((4, 4, 1)))
    suite({"name": "*", "mask": "m.exr", "why": "all counts"}, {"name": "zinc", "skip": "x"})
    tonetool("--suite", "suite.toml", "--csv", "here.csv", "-q", status=3)
    (folder / "else").mkdir()
    for words in (["../suite.toml"], [str(folder / "suite.toml")]):
        ran = call(program, ["--suite", *words, "--csv", "there.csv", "-q"], folder / "else")
        assert ran.status == 3, ran.err
        rows = table(folder / "else/there.csv")
        assert [row["status"] for row in rows] == [row["status"] for row in table(folder / "here.csv")]
        assert rows[0]["test"] == os.path.join(os.path.dirname(words[0]), "t/glass.exr")
    assert sorted(path.name for path in (folder / "else").iterdir()) == ["there.csv"]


# ---- skipped

def test_skipped_everywhere(tonetool, suite, check):
    folder = suite({"fail": "mse=1"}, {"name": "hair/*", "skip": "flaky <until> #123"},
                   {"name": "wood", "skip": "no GPU"})
    (folder / "t/wood.exr").write_text("no image")
    (folder / "t/hair/a.exr").unlink()
    ran = tonetool("--suite", "suite.toml", *printers("s"), "--report", "s.html")
    assert "5 cases: 3 skipped, 2 passed" in ran.out
    shot = load(folder / "s.json")
    assert shot["counts"]["skipped"] == 3 and shot["counts"]["passed"] == 2 and shot["verdict"] != "skipped"
    assert [(case["status"], case.get("message")) for case in shot["frames"]] == [
        ("passed", None), *[("skipped", "flaky <until> #123")] * 2, ("skipped", "no GPU"), ("passed", None)]
    assert [row["status"] for row in table(folder / "s.csv")] == ["passed", *["skipped"] * 3, "passed"]
    root = ElementTree.parse(folder / "s.xml").getroot()
    assert root.find("testsuite").attrib == {"name": "lookdev", "tests": "5", "failures": "0",
                                             "errors": "0", "skipped": "3"}
    skipped = {case.get("name"): case.find("skipped").get("message") for case in root.iter("testcase")
               if case.find("skipped") is not None}
    assert skipped == {"hair/a": "flaky <until> #123", "hair/b": "flaky <until> #123", "wood": "no GPU"}
    assert "<until>" not in (folder / "s.html").read_text()


def test_skipping_changes_no_exit_status(check, suite):
    suite({"name": "zinc", "skip": "x"})
    assert statuses(check(status=3))["zinc"] == "skipped"
    suite({"name": "*", "fail": "mse=1"}, {"name": "zinc", "skip": "x"})
    check(status=0)


def test_all_skipped_is_an_error(tonetool, suite):
    folder = suite({"skip": "all of it"})
    ran = tonetool("--suite", "suite.toml", "--junit", "s.xml", status=1)
    assert "passed" not in ran.out
    tonetool("--suite", "suite.toml", "--only", "zinc", status=1)
    suite({"name": "zinc", "skip": "this one"})
    tonetool("--suite", "suite.toml", "--only", "zinc", status=1)
    assert folder


# ---- --only, parts, state

def test_only(tonetool, suite):
    folder = suite({"fail": "mse=1"})
    ran = tonetool("--suite", "suite.toml", "--only", "hair/*", "--only", "zinc", "--csv", "t.csv",
                   "--json", "j.json")
    assert "3 of 5 cases" in ran.out and "3 of 5 cases" in load(folder / "j.json")["sentence"]
    assert [row["name"] for row in table(folder / "t.csv")] == ["hair/a", "hair/b", "zinc"]
    ran = tonetool("--suite", "suite.toml", "--only", "gone", "--csv", "w.csv", status=1)
    assert "gone" in ran.err and not (folder / "w.csv").exists()
    tonetool("--suite", "suite.toml", "--only", "hair/*", "--only", "gone", "--csv", "w.csv", status=1)
    assert not (folder / "w.csv").exists()


def test_the_whole_name_of_a_case_is_no_glob(images, suite, check):
    """Cases may be named as globs are: "glas[s]" is not "glass" where both are there."""
    for side in "rt":
        shutil.copyfile(images / side / "zinc.exr", images / side / "glas[s].exr")
    suite({"name": "glas[s]", "fail": "mse=1"})
    cases = check(status=3)
    assert cases["glas[s]"]["status"] == "passed"
    assert cases["glass"]["measurements"][0]["thresholds"][0]["fail"] == 0.01
    assert list(check("--only", "glas[s]", status=0)) == ["glas[s]"]
    (images / "t" / "glas[s].exr").unlink()
    (images / "r" / "glas[s].exr").unlink()
    assert list(check("--only", "glas[s]", status=0)) == ["glass"]


ROWS = [{"name": "hair/*", "fail": "mse=0.05", "why": "curves"}, {"name": "wood", "skip": "x"}]


def parts(tonetool, *globs):
    for number, glob in enumerate(globs):
        ran = tonetool("--suite", "suite.toml", "--only", glob, "--json", f"part.{number}.json", "-q",
                       status=0 if glob == "glass" else 3)
        assert ran
    return [f"part.{number}.json" for number in range(len(globs))]


def test_parts_merged_are_the_whole(tonetool, suite):
    folder = suite(*ROWS)
    tonetool("--suite", "suite.toml", *printers("whole"), "-q", status=3)
    files = parts(tonetool, "[h]*", "glass", "[w-z]*")
    tonetool("--suite", "suite.toml", "--merge", *files, *printers("with"), "-q", status=3)
    tonetool("--merge", *reversed(files), *printers("without"), "-q", status=3)
    tonetool("--suite", "suite.toml", "--parallel-frames", "3", *printers("parallel"), "-q", status=3)
    tonetool("--suite", "suite.toml", "--jobs", "2", *printers("jobs"), "-q", status=3)
    for kind, ending in itertools.product(("with", "without", "parallel", "jobs"), ("json", "csv", "xml", "md")):
        assert (folder / f"{kind}.{ending}").read_bytes() == (folder / f"whole.{ending}").read_bytes(), (kind, ending)


def test_merge_tells_cases_of_no_part(tonetool, suite):
    folder = suite(*ROWS)
    files = parts(tonetool, "[h]*", "glass")
    ran = tonetool("--suite", "suite.toml", "--merge", *files, "--csv", "m.csv", status=1)
    rows = {row["name"]: row for row in table(folder / "m.csv")}
    assert {name: row["status"] for name, row in rows.items()} == {
        "glass": "passed", "hair/a": "passed", "hair/b": "failed", "wood": "error", "zinc": "error"}
    assert "5 cases: 2 errors" in ran.out and "no part has" in rows["zinc"]["message"]


def test_parts_of_another_suite_are_refused(tonetool, suite):
    folder = suite(*ROWS)
    files = parts(tonetool, "[h]*", "glass")
    suite(*ROWS, {"name": "glass", "why": "a row more"})
    ran = tonetool("--suite", "suite.toml", "--only", "[wz]*", "--json", "other.json", "-q", status=3)
    tonetool("--merge", *files, "other.json", "--json", "m.json", status=1)
    ran = tonetool("--suite", "suite.toml", "--merge", *files, "--json", "m.json", status=1)
    assert "part.0.json" in ran.err and not (folder / "m.json").exists()


def test_parts_that_overlap(tonetool, suite):
    suite(*ROWS)
    files = parts(tonetool, "[h]*", "h*")
    tonetool("--suite", "suite.toml", "--merge", *files, status=1)


def test_state_of_an_edited_suite(tonetool, suite):
    folder = suite(*ROWS)
    for _ in range(2):
        tonetool("--suite", "suite.toml", "--state", "st", "--csv", "one.csv", "-q", status=3)
    suite({"name": "*", "fail": "mse=1"})
    # What was kept is of another suite: nothing of it is used.
    tonetool("--suite", "suite.toml", "--state", "st", *printers("kept"), "-q")
    tonetool("--suite", "suite.toml", *printers("plain"), "-q")
    assert {row["status"] for row in table(folder / "plain.csv")} == {"passed"}
    for ending in ("json", "csv", "xml", "md"):
        assert (folder / f"kept.{ending}").read_bytes() == (folder / f"plain.{ending}").read_bytes()


def test_a_state_goes_on(tonetool, suite, make_image):
    folder = suite(*ROWS)
    tonetool("--suite", "suite.toml", "--state", "st", "-q", status=3)
    make_image("t/zinc.exr", 4, 4, pixels=np.full((4, 4, 3), 0.25))
    tonetool("--suite", "suite.toml", "--state", "st", *printers("st"), "-q", status=3)
    tonetool("--suite", "suite.toml", *printers("plain"), "-q", status=3)
    for ending in ("json", "csv", "xml", "md"):
        assert (folder / f"st.{ending}").read_bytes() == (folder / f"plain.{ending}").read_bytes()


def test_the_schema_holds(tonetool, suite, testimages):
    schema = pytest.importorskip("jsonschema", reason="no python3-jsonschema here")
    folder = suite(*ROWS, {"name": "zinc", "ignore": "1x1+0+0", "why": "dust"})
    (folder / "r/glass.exr").unlink()
    tonetool("--suite", "suite.toml", "--json", "j.json", "-q", status=1)
    tonetool("--suite", "suite.toml", "--only", "hair/*", "--json", "only.json", "-q", status=3)
    description = load(testimages.parent / "src" / "sequence" / "check.schema.json")
    for name in ("j.json", "only.json"):
        schema.Draft7Validator(description).validate(load(folder / name))
    shot = load(folder / "j.json")
    assert shot["suite"]["name"] == "lookdev" and len(shot["suite"]["sha256"]) == 64
    assert shot["suite"]["sha256"] in " ".join(shot["check"])


# ---- hostile names

HOSTILE = ["a b", "it's", 'say "x"', "50%", "%41", "a,b", "a\nb", "<script>alert(1)</script>", "n" * 200,
           "[ab]", "back\\slash", "-o", "ä", "; rm x", "$HOME", "&amp;", "]]>"]


@pytest.mark.parametrize("parallel", [[], ["--jobs", "2"]])
def test_hostile_names(tonetool, suite, parallel):
    folder = suite({"fail": "mse=1"}, {"name": "a,b", "skip": "comma"}, {"name": "a\nb", "fail": "mse=0.01"})
    for side in "rt":
        source = (folder / side / "zinc.exr").read_bytes()
        shutil.rmtree(folder / side)
        for name in HOSTILE:
            (folder / side / f"{name}.exr").parent.mkdir(parents=True, exist_ok=True)
            (folder / side / f"{name}.exr").write_bytes(source)
    tonetool("--suite", "suite.toml", *parallel, *printers("h"), "--report", "h.html", "--github",
             "--state", "st", status=3)
    wanted = sorted(HOSTILE, key=str.encode)
    told = {name: "failed" if name == "a\nb" else "skipped" if name == "a,b" else "passed" for name in wanted}
    assert [(case["name"], case["status"]) for case in load(folder / "h.json")["frames"]] == list(told.items())
    rows = table(folder / "h.csv")
    plain = {name: "'" + name if name[0] in "-=+@" else name for name in wanted}  # for spreadsheets
    assert [(row["name"], row["status"]) for row in rows] == [(plain[name], told[name]) for name in wanted]
    cases = list(ElementTree.parse(folder / "h.xml").getroot().iter("testcase"))
    assert len({case.get("name") for case in cases}) == len(HOSTILE)
    assert "<script>alert" not in (folder / "h.html").read_text()
    for name in ("[[]ab]", "50%", "[-]o"):  # each can be chosen
        tonetool("--suite", "suite.toml", "--only", name, "--json", "one.json", "-q")
        assert len(load(folder / "one.json")["frames"]) == 1


def test_names_that_are_not_utf8(tonetool, suite):
    folder = suite({"fail": "mse=1"})
    for side in "rt":
        shutil.copy(folder / side / "zinc.exr", os.fsencode(folder) + b"/" + side.encode() + b"/x\xff\xfey.exr")
    done = run_bytes(os.environ["TONETOOL"], ["--suite", "suite.toml", *printers("u"), "--report", "u.html"],
                     folder, 60)
    assert done.returncode == 0
    shot = load(folder / "u.json")  # it is UTF-8
    assert len(shot["frames"]) == 6 and shot["counts"]["passed"] == 6
    ElementTree.parse(folder / "u.xml")
