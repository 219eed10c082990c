# SPDX-License-Identifier: BSD-3-Clause
"""--suite and --only: cases with limits of their own, and what a suite file must not hide."""

import csv
import json
import shutil
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

MSE = "--errormap:metric=mse:print=0:fail=mse=0.1"  # the images differ by 0.25 in mse
HEAD = """tonetool-suite = 1
name = "lookdev"
reference = "r/%N.exr"
test = "t/%N.exr"
check = "{}"
"""


@pytest.fixture
def suite(tmp_path, make_image):
    """suite(rows, check=, head=) writes suite.toml beside three equal cases and two that differ."""
    make_image("same.exr", 4, 4, pixels=np.zeros((4, 4, 3)))
    make_image("other.exr", 4, 4, pixels=np.full((4, 4, 3), 0.5))
    for name in ("a", "hair/long", "hair/short", "b", "c"):
        for side in "rt":
            (tmp_path / side / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(tmp_path / ("other.exr" if side == "t" and name.startswith("hair") else "same.exr"),
                        tmp_path / side / f"{name}.exr")

    def make(rows="", check=MSE, head=HEAD, file="suite.toml"):
        (tmp_path / file).write_text(head.format(check) + rows)
        return tmp_path

    return make


def load(path):
    return json.loads(path.read_text())


def statuses(path):
    return {frame["name"]: frame["status"] for frame in load(path)["frames"]}


LENIENT = '\n[[case]]\nname = "hair/*"\nfail = "mse=0.3"\nwhy = "curves"\n'


def test_rows_have_their_limits(tonetool, suite):
    folder = suite()
    tonetool("--suite", "suite.toml", "--json", "j", "-q", status=3)
    assert statuses(folder / "j") == {"a": "passed", "b": "passed", "c": "passed",
                                      "hair/long": "failed", "hair/short": "failed"}
    suite(LENIENT + '\n[[case]]\nname = "*/short"\nfail = "mse=0.2,max=0.9"\n')
    tonetool("--suite", "suite.toml", "--json", "j", "-q", status=3)
    found = {frame["name"]: frame for frame in load(folder / "j")["frames"]}
    assert found["hair/long"]["status"] == "passed" and found["hair/long"]["line"] == 7
    assert found["hair/short"]["status"] == "failed" and found["hair/short"]["line"] == 12
    assert found["hair/short"]["why"] == "curves"  # key by key
    assert [one["fail"] for one in found["hair/short"]["measurements"][0]["thresholds"]] == [0.2, 0.9]
    assert "line" not in found["a"]


def test_a_suite_of_one_plain_pattern_is_the_same_line(tonetool, suite):
    folder = suite()
    tonetool("--suite", "suite.toml", "--json", "s", "--csv", "s.csv", "-q", status=3)
    tonetool("r/%N.exr", "t/%N.exr", MSE, "--json", "p", "--csv", "p.csv", "-q", status=3)
    assert load(folder / "s")["frames"] == load(folder / "p")["frames"]
    assert (folder / "s.csv").read_bytes() == (folder / "p.csv").read_bytes()


def test_names_are_relative_to_the_file(tonetool, suite, tmp_path):
    suite(LENIENT)
    (tmp_path / "sub").mkdir()
    shutil.move(tmp_path / "r", tmp_path / "sub/r")
    shutil.move(tmp_path / "t", tmp_path / "sub/t")
    shutil.move(tmp_path / "suite.toml", tmp_path / "sub/suite.toml")
    tonetool("--suite", "sub/suite.toml", "-q", "--json", "j")
    assert load(tmp_path / "j")["frames"][0]["reference"] == "sub/r/a.exr"


@pytest.mark.parametrize("rows, said", [
    ('\n[[case]]\nname = "hair/*"\nfial = "mse=0.3"\n', ["fial", "did you mean fail?", " 9 "]),
    ('\n[[case]]\nname = "hair/*"\nfail = 0.3\n', ["fail is a text", " 9 "]),
    ('\n[[case]]\nname = "hiar/*"\nfail = "mse=0.3"\n', ["matches no case", " 7 "]),
    ('\n[[case]]\nname = "a"\nmask = "m.png"\n', ["mask needs why"]),
    ('\n[[case]]\nname = "a"\nfail = "tmqi.Q=0.3"\n', ["the check has no tmqi", "line 7"]),
    ('\n[[case]]\nname = "a"\nlayer = "diffuse"\ncheck = "--diff"\n', ["no command of the check has layer="]),
    ('\n[[case]]\nname = "a"\ncheck = "--errormap:metric=mse:fail=0.1 -o x.png"\n', ["-o", "does not go into check"]),
    ('\n[[case]]\nname = "a"\ncheck = "--json x"\n', ["--json", "does not go into check"]),
    ('\n[[case]]\nname = "a"\ncheck = "--frames 1-3"\n', ["does not go into check"]),
    ('\n[[case]]\nname = "a"\ncheck = "--errormup"\n', ["errormup"]),
])
def test_what_is_wrong_ends_it_before_any_case(tonetool, suite, rows, said):
    folder = suite(rows)
    ran = tonetool("--suite", "suite.toml", "--json", "j", "--only", "a", status=1)
    for text in said:
        assert text in ran.err
    assert not (folder / "j").exists() and not (folder / "x.png").exists()


@pytest.mark.parametrize("words, said", [
    (["--compat"], "--compat"), (["a.exr"], "does not go beside --suite"), ([MSE], "does not go beside"),
    (["-o", "x.png"], "does not go beside"), (["--suite", "suite.toml"], "given twice"),
    (["--only", "zz*"], "names none of the 5 cases"), (["--key", "cuda"], "no folder of them"),
])
def test_what_goes_beside_it(tonetool, suite, words, said):
    suite()
    assert said in tonetool("--suite", "suite.toml", *words, status=1).err


@pytest.mark.parametrize("head, said", [
    (HEAD.replace("tonetool-suite = 1\n", ""), "tonetool-suite = 1"), (HEAD.replace("t/%N.exr", "t/a.exr"), "has no %N"),
    (HEAD.replace("t/%N", "none/%N"), "missing"), ("", "no suite"), (HEAD + "x = = 1\n", "suite.toml"),
])
def test_a_file_that_is_none(tonetool, suite, head, said):
    suite(head=head)
    ran = tonetool("--suite", "suite.toml", status=1)
    assert said in ran.err + ran.out
    assert "no-such" in tonetool("--suite", "no-such.toml", status=1).err


SKIP = '\n[[case]]\nname = "hair/*"\nskip = "flaky <until> #123"\n'


def test_skipped_is_never_passed(tonetool, suite):
    folder = suite(SKIP)
    (folder / "t/hair/long.exr").unlink()
    ran = tonetool("--suite", "suite.toml", "--json", "j", "--csv", "c", "--junit", "x", "--report", "p.html")
    assert "check: passed, 5 cases: 2 skipped, 3 passed" in ran.out
    assert statuses(folder / "j")["hair/long"] == "skipped" and load(folder / "j")["counts"]["skipped"] == 2
    with open(folder / "c", newline="", encoding="utf-8") as file:
        assert [row["status"] for row in csv.DictReader(file)].count("skipped") == 2
    root = ElementTree.parse(folder / "x").getroot()
    assert root[0].get("name") == "lookdev" and root[0].get("skipped") == "2"
    assert [one.get("message") for one in root.iter("skipped")] == ["flaky <until> #123"] * 2
    assert {one.get("classname") for one in root.iter("testcase")} == {"lookdev"}
    tonetool("--merge", "j", "--json", "m", "-q")
    assert (folder / "m").read_bytes() == (folder / "j").read_bytes()
    suite('\n[[case]]\nskip = "all"\n')
    assert "nothing was checked" in tonetool("--suite", "suite.toml", status=1).out


def test_a_result_that_calls_itself_skipped(tonetool, suite):
    folder = suite()
    tonetool("--suite", "suite.toml", "--json", "j", "-q", status=3)
    text = load(folder / "j")
    for frame in text["frames"]:
        if frame["status"] == "failed":
            frame["status"] = "skipped"  # with its measurements
    (folder / "j").write_text(json.dumps(text))
    tonetool("--merge", "j", "-q", status=1)


def test_parts_by_only(tonetool, suite):
    folder = suite(LENIENT)
    tonetool("--suite", "suite.toml", "--json", "whole", "-q")
    ran = tonetool("--suite", "suite.toml", "--only", "hair/*", "--json", "one")
    assert "check: passed, 2 of 5 cases: 2 passed" in ran.out
    tonetool("--suite", "suite.toml", "--only", "[ab]", "--only", "c", "--json", "two", "-q")
    tonetool("--suite", "suite.toml", "--merge", "two", "one", "--json", "m", "-q")
    assert (folder / "m").read_bytes() == (folder / "whole").read_bytes()
    ran = tonetool("--suite", "suite.toml", "--merge", "one", status=1)
    assert "no part has a result of this case" in ran.out and "5 cases: 3 errors" in ran.out
    suite(LENIENT + "# another file\n")
    assert "another suite" in tonetool("--suite", "suite.toml", "--merge", "one", "two", status=1).err
    tonetool("--suite", "suite.toml", "--only", "hair/*", "--json", "three", "-q")
    assert "not of the same check" in tonetool("--merge", "two", "three", status=1).err


def test_the_same_bytes_in_any_way(tonetool, suite):
    folder = suite(LENIENT + SKIP.replace("hair/*", "b"))
    tonetool("--suite", "suite.toml", "--json", "one", "--csv", "one.csv", "--junit", "one.xml", "-q")
    tonetool("--suite", "suite.toml", "--json", "two", "--csv", "two.csv", "--junit", "two.xml", "-q",
             "--parallel-frames", "3", "--state", "st")
    tonetool("--suite", "suite.toml", "--json", "three", "-q", "--state", "st")
    for end in ("", ".csv", ".xml"):
        assert (folder / f"one{end}").read_bytes() == (folder / f"two{end}").read_bytes()
    assert (folder / "one").read_bytes() == (folder / "three").read_bytes()
    suite()  # the limit of hair/* is gone: what was kept does not hold any more
    tonetool("--suite", "suite.toml", "--json", "four", "-q", "--state", "st", status=3)
    assert statuses(folder / "four")["hair/long"] == "failed" and statuses(folder / "four")["b"] == "passed"


TWICE = ("--label t --pop --label r t --errormap:metric=mse:print=0:fail=mse=0.1 --pop "
         "r t --errormap:metric=mae:print=0 --pop r t --ldrflip:print=0:fail=mean=0.99")


def test_limits_of_several_commands(tonetool, suite):
    folder = suite('\n[[case]]\nname = "hair/*"\nfail = "errormap.mse=0.3,ldrflip.mean=0.97"\n'
                   '\n[[case]]\nname = "*short"\nfail = "ldrflip.mean=0.01"\n', check=TWICE.replace("metric=mae", "metric=mse").replace("mse:print=0 ", "mse:print=0:fail=mse=0.1 "))
    tonetool("--suite", "suite.toml", "--json", "j", "-q", status=3)
    found = {frame["name"]: frame for frame in load(folder / "j")["frames"]}
    assert found["hair/long"]["status"] == "passed"
    assert found["hair/short"]["measurements"][2]["thresholds"][0]["fail"] == 0.01
    suite('\n[[case]]\nname = "a"\nfail = "mse=0.5"\n', check=TWICE)
    assert "does not say of which command" in tonetool("--suite", "suite.toml", status=1).err
    suite('\n[[case]]\nname = "a"\nfail = "mean=0.5"\n', check="--qc", head=HEAD.replace('reference = "r/%N.exr"\n', ""))
    assert "measures nothing" in tonetool("--suite", "suite.toml", status=1).err


def test_rows_with_another_check(tonetool, suite):
    folder = suite('\n[[case]]\nname = "hair/*"\ncheck = "--ldrflip:print=0:fail=mean=0.99"\n')
    tonetool("--suite", "suite.toml", "--json", "j", "--parallel-frames", "2", "-q")
    commands = {frame["name"]: frame["measurements"][0]["command"] for frame in load(folder / "j")["frames"]}
    assert commands == {"a": "errormap", "b": "errormap", "c": "errormap", "hair/long": "ldrflip", "hair/short": "ldrflip"}
    tonetool("--merge", "j", "--json", "m", "-q")
    assert (folder / "m").read_bytes() == (folder / "j").read_bytes()


def test_masks_and_regions(tonetool, suite, make_image):
    folder = suite()
    half = np.ones((4, 4, 1))
    half[:, :1] = 0
    (folder / "masks/hair").mkdir(parents=True)
    make_image("masks/hair/long.exr", 4, 4, ("Y",), pixels=half)
    changed = np.zeros((4, 4, 3))
    changed[:, 0] = 0.9
    make_image("t/hair/long.exr", 4, 4, pixels=changed)
    make_image("t/hair/short.exr", 4, 4, pixels=changed)
    rows = ('\n[[case]]\nname = "hair/long"\nmask = "masks/%N.exr"\nwhy = "a clock"\n'
            '\n[[case]]\nname = "hair/short"\nignore = "1x4+0+0"\nwhy = "a clock"\n')
    tonetool("--suite", "suite.toml", "-q", status=3)
    suite(rows)
    tonetool("--suite", "suite.toml", "--json", "j", "-q")
    found = {frame["name"]: frame for frame in load(folder / "j")["frames"]}
    for name in ("hair/long", "hair/short"):
        assert found[name]["measurements"][0]["parameters"]["ignored"] == pytest.approx(0.25)
    (folder / "masks/hair/long.exr").unlink()
    assert "masks/hair/long.exr" in tonetool("--suite", "suite.toml", "-q", status=1).err


@pytest.mark.parametrize("name", ["a b", "it's", 'q"q', "100%", "x,y", "<script>", "n" * 200, "#1", "[a]", "{1+1}", "$HOME"])
def test_names(tonetool, suite, name):
    folder = suite()
    for side in "rt":
        shutil.copy(folder / "same.exr", folder / side / f"{name}.exr")
    tonetool("--suite", "suite.toml", "--json", "j", "--junit", "x", "--report", "p.html", "-q", status=3)
    assert statuses(folder / "j")[name] == "passed"
    assert name in {one.get("name") for one in ElementTree.parse(folder / "x").getroot().iter("testcase")}


def test_annotations_point_at_the_row(tonetool, suite):
    folder = suite('\n[[case]]\nname = "hair/short"\nfail = "mse=0.2"\n')
    (folder / "t/c.exr").unlink()
    ran = tonetool("--suite", "suite.toml", "--github", "--summary", "s.md", "-q", status=1)
    assert [line.split(",title")[0] for line in ran.out.splitlines() if line[:2] == "::"] == [
        "::error file=suite.toml,line=4", "::error file=suite.toml,line=4", "::error file=suite.toml,line=7"]
    assert (folder / "s.md").read_text().startswith("## lookdev: missing\n")


@pytest.mark.parametrize("name", ["hair/lnog", "HAIR/LONG", "hair/long.exr", "./hair/long"])
def test_the_case_that_was_meant(tonetool, suite, name):
    suite(f'\n[[case]]\nname = "{name}"\nfail = "mse=9"\n')
    assert 'did you mean "hair/long"?' in tonetool("--suite", "suite.toml", status=1).err
    suite()
    assert 'did you mean "hair/long"?' in tonetool("--suite", "suite.toml", "--only", name, status=1).err


@pytest.mark.parametrize("blank", ["  ", "\\n", "\\t"])
def test_a_blank_reason_is_none(tonetool, suite, blank):
    suite(f'\n[[case]]\nname = "a"\nskip = "{blank}"\n')
    assert "skip is empty" in tonetool("--suite", "suite.toml", status=1).err


def test_parts_that_lack_a_case_are_no_whole(tonetool, suite):
    folder = suite(LENIENT)
    for part, name in enumerate("abc"):
        tonetool("--suite", "suite.toml", "--only", name, "--json", f"p{part}", "-q")
    # Of a glob like part.*.json one part may be all that there is.
    ran = tonetool("--merge", "p0", "--json", "m", status=1)
    assert "the parts have 1 of 5 cases" in ran.err and "passed, 1 of 5 cases" in ran.out
    assert load(folder / "m")["frames"][0]["status"] == "passed"
    ran = tonetool("--merge", "p0", "p1", "p2", "--json", "m", status=1)
    assert "the parts have 3 of 5 cases" in ran.err
    tonetool("--suite", "suite.toml", "--only", "hair/*", "--json", "p3", "-q")
    tonetool("--merge", "p0", "p1", "p2", "p3", "-q")
    ran = tonetool("--suite", "suite.toml", "--merge", "p0", "p1", "--only", "a", status=1)
    assert "--only chooses what is compared" in ran.err
    assert load(folder / "p0")["cases"] == 5
