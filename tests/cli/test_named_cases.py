# SPDX-License-Identifier: BSD-3-Clause
"""%N and %M: cases with names, and lines that would pass without having compared them."""

import csv
import itertools
import json
import os
import random
import re
import shutil
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

FLIP = "--hdrflip:fail=mean=0.3,p99.9=0.9"
MSE = "--errormap:metric=mse:fail=0.5"


@pytest.fixture
def files(tmp_path, make_image):
    """Makes copies of one tiny image, or of another (`other`), under these names."""
    make_image("one.exr", 8, 8, seed=1)
    make_image("two.exr", 8, 8, seed=2)

    def make(*names, other=False):
        for name in names:
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(tmp_path / ("two.exr" if other else "one.exr"), tmp_path / name)
        return tmp_path

    return make


def load(path):
    return json.loads(path.read_text())


def table(path):
    with open(path, newline="", errors="surrogateescape", encoding="utf-8") as file:
        return list(csv.DictReader(file))


# ---- which cases there are: told anew, in a few lines

def expression(pattern):
    text, seen = "", set()
    for word in re.split("(%[NM])", pattern):
        if word not in ("%N", "%M"):
            text += re.escape(word)
        elif word in seen:
            text += f"(?P={word[1]})"
        else:
            seen.add(word)
            text += f"(?P<{word[1]}>{'.+' if word == '%N' else '[^/]+'})"
    return re.compile(text + r"\Z", re.S)


def matches(pattern, names):
    fixed = pattern.split("%")[0].count("/")
    found = {}
    for name in names:
        match = expression(pattern).match(name)
        if match and not any(part.startswith(".") for part in name.split("/")[fixed:]):
            found[match["N"], match.groupdict().get("M") or ""] = name
    return found


def expected(reference, test, names):
    refs, tests = matches(reference, names), matches(test, names)
    methods = {method for _, method in tests} or {""}
    if "%M" in test and "%M" not in reference:
        refs = {(name, method): file for (name, _), file in refs.items() for method in methods}
    keys = {*refs, *tests}
    if "%M" in test:
        keys |= {(name, method) for name, _ in keys for method in methods}
    return [(*key, refs.get(key), tests.get(key))
            for key in sorted(keys, key=lambda key: (key[0].encode(), key[1].encode()))]


def check_against_oracle(tonetool, folder, patterns, names):
    wanted = expected(*patterns, names)
    whole = all(case[2] and case[3] for case in wanted)
    tonetool(*patterns, MSE, "--csv", "t.csv", "-q", status=0 if whole else 1)
    rows = table(folder / "t.csv")
    assert [(row["name"], row["method"]) for row in rows] == [case[:2] for case in wanted]
    for row, (_, _, reference, test) in zip(rows, wanted, strict=True):
        assert row["status"] == ("passed" if reference and test else "missing"), row
        assert reference in (None, row["reference"]) and test in (None, row["test"])
        assert row["reference"] and row["test"]  # also the name of a file that is not there


@pytest.mark.parametrize("patterns, names", [
    (("r/%N.exr", "t/%N.exr"),
     "r/a.exr r/b.exr r/x/c.exr t/a.exr t/x/c.exr t/d.exr t/d.exr.tmp t/.e.exr r/.git/a.exr"),
    (("%N_ref.exr", "%N_test.exr"), "a_ref.exr a_test.exr a_ref_test.exr"),
    (("r/%N.exr", "out/%M/%N.exr"),
     "r/a.exr r/b.exr out/pt/a.exr out/pt/b.exr out/bdpt/a.exr"),
    (("r/%N/ref.exr", "t/%N/%N.exr"),
     "r/x/ref.exr r/x/y/ref.exr t/x/x.exr t/x/y/x/y.exr t/x/z.exr"),
    (("r/%N.exr", "t/%N.exr"), "r/ä_b.exr t/ä_b.exr r/A.exr t/a.exr"),
])
def test_examples(tonetool, files, patterns, names):
    check_against_oracle(tonetool, files(*names.split()), patterns, names.split())


@pytest.mark.parametrize("seed", range(12))
def test_random_trees(tonetool, files, seed):
    """Also: the order in which a folder lists its files makes no difference."""
    choice = random.Random(seed)
    patterns = choice.choice([("r/%N.exr", "t/%N.exr"), ("r/%N.exr", "t/%M/%N.exr"),
                              ("r/%N_a.exr", "t/%M_%N.exr"), ("r/%M/%N.exr", "t/%N/%M.exr"),
                              ("r/%N.exr", "t/%N/%N.exr")])
    parts = ["a", "b", "a_a", "x", "xy", ".h"]
    names = {f"{choice.choice('rt')}/{'/'.join(choice.choices(parts, k=choice.randint(1, 3)))}"
             f"{choice.choice(['', '', '_a'])}.exr" for _ in range(14)}
    names |= {"r/a.exr", "t/a/b.exr", "t/a/a.exr", "r/b_a.exr", "t/x_b.exr", "r/x/a.exr", "t/a/x.exr"}
    names = [name for name in names if not any(other.startswith(name + "/") for other in names)]
    choice.shuffle(names)
    check_against_oracle(tonetool, files(*names), patterns, names)


def test_what_is_missing_is_told(tonetool, files):
    folder = files("r/a.exr", "r/hair_1.exr", "r/same.exr", "t/a.exr", "t/hair_2.exr", "t/d/else.exr")
    (folder / "t/hair_2.exr").unlink()
    files("t/hair_2.exr", "t/alone.exr", other=True)
    ran = tonetool("r/%N.exr", "t/%N.exr", FLIP, "--json", "j.json", status=1)
    told = {frame["name"]: frame.get("message", "") for frame in load(folder / "j.json")["frames"]}
    assert told == {
        "a": "", "alone": 'no reference "r/alone.exr"',
        "d/else": 'no reference "r/d/else.exr", renamed? "hair_1" is there',
        "hair_1": 'no test "t/hair_1.exr", renamed? "d/else" is there',
        "hair_2": 'no reference "r/hair_2.exr"',
        "same": 'no test "t/same.exr"'}
    assert "6 cases: 5 missing, 1 passed; worst: alone (no reference" in ran.out
    assert 'no test "t/same.exr" (case same)' in ran.err


def test_an_edited_name_is_hinted_at(tonetool, files):
    folder = files("r/glass.exr", "r/a.exr", "t/a.exr")
    files("t/glas5.exr", other=True)
    tonetool("r/%N.exr", "t/%N.exr", FLIP, "--csv", "t.csv", "-q", status=1)
    assert [row["message"] for row in table(folder / "t.csv")][1:] == [
        'no reference "r/glas5.exr", renamed? "glass" is there',
        'no test "t/glass.exr", renamed? "glas5" is there']


def test_no_case_says_what_is_there(tonetool, files):
    folder = files("t/a.exr")
    (folder / "r/deep").mkdir(parents=True)
    for name in ("a", "b", "deep/c"):
        (folder / f"r/{name}.png").touch()
    for patterns, text in [
            (("r/%N.exr", "r/%N.tif"), "r/%N.exr matches no file; r/ has 3 files, all .png"),
            (("x/%N.exr", "x/%N.tif"), 'x/%N.exr matches no file; there is no folder "x/"'),
            (("t/%N.exr", "t/%M/%N.exr"), "t/%M/%N.exr matches no file; t/ has 1 file, all .exr")]:
        assert text in tonetool(*patterns, FLIP, status=1).err


# ---- what would pass without having been compared

@pytest.mark.parametrize("words, text", [
    (["r/a.exr", "r/b.exr", "r/c.exr", "t/a.exr", "t/b.exr", "t/c.exr", FLIP],
     "4 images were read and never compared; for all of them write 'r/%N.exr'"),
    (["r/a.exr", "r/b.exr", "t/a.exr", FLIP], '"r/a.exr" was never compared'),
    (["r/*.exr", "t/*.exr", FLIP], '"*" in "r/*.exr" is no wildcard here: names are %N, frames #'),
    (["r/?.exr", "t/?.exr", FLIP], '"?" in "r/?.exr" is no wildcard'),
    (["r/[ab].exr", "t/[ab].exr", FLIP], '"[ab]" in "r/[ab].exr" is no wildcard'),
    (["r/**/a.exr", "t/a.exr", FLIP], "is no wildcard here"),
    (["r", "t", FLIP], "r is a folder: write r/%N.exr"),
    (["r/", "t/", "--hdrflip"], "r is a folder: write r/%N.exr"),
    (["r/%N.exr", "t/a.exr", FLIP], "the test has no %N: one image would be checked 3 times"),
    (["r/%N.exr", "t/a.exr", "--resize", "4x4", FLIP], "the test has no %N"),
    (["r/%N.exr", "t/%N.exr", "--hdrflip:exposures=shot:fail=0.1"], "exposures=shot is of the frames"),
    (["r/%N.exr", "t/%N.exr", FLIP, "--bad-frames", "b"], "--bad-frames writes numbers of frames"),
    (["r/%N.exr", "t/%N.exr", FLIP, "--frames", "1-3"], "--frames 1-3: no image that is read has #"),
    (["r/%N.exr", "t/%N.exr", FLIP, "-o", "o.png"],
     '"o.png" would be written by every case over the one before (valid: %N in the name)'),
    (["r/%N.exr", "m/%M/%N.exr", FLIP, "-o", "%N.png"], "(valid: %M in the name)"),
])
def test_not_compared(tonetool, files, words, text):
    folder = files(*(f"{side}/{name}.exr" for side in ("r", "t", "m/p", "m/q") for name in "abc"))
    ran = tonetool(*words, status=1)
    assert text in ran.err
    # Before any case runs.
    assert "check:" not in ran.out and not list(folder.glob("*.png"))


def test_constant_reference(tonetool, files):
    files("r/a.exr", "t/a.exr", "t/b.exr")
    files("t/c.exr", other=True)
    ran = tonetool("r/a.exr", "t/%N.exr", MSE.replace("0.5", "0.01"), status=3)
    assert "3 cases: 1 failed, 2 passed; worst: c (errormap: mse" in ran.out


def test_one_file_on_both_sides(tonetool, files):
    folder = files("r/a.exr", "r/b.exr")
    (folder / "t").mkdir()
    os.symlink("../r/a.exr", folder / "t/a.exr")
    shutil.copy(folder / "r/b.exr", folder / "t/b.exr")
    tonetool("r/%N.exr", "t/%N.exr", FLIP, "--csv", "t.csv", status=1)
    assert [(row["status"], row["message"]) for row in table(folder / "t.csv")] == [
        ("error", "reference and test are the same file"), ("passed", "")]
    tonetool("r/%N.exr", "r/%N.exr", FLIP, status=1)
    tonetool("r/a.exr", "r/%N.exr", FLIP, "--csv", "t.csv", status=1)  # one reference among the tests
    assert [row["status"] for row in table(folder / "t.csv")] == ["error", "passed"]
    tonetool("r/%N.exr", "r/%N.exr", "--add", "-o", "t/%N_twice.exr")  # nothing is compared


# ---- results

@pytest.fixture
def suite(files):
    folder = files("r/cornell.exr", "t/cornell.exr", "r/hair/long.exr", "r/plane.exr", "t/ä b.exr", "r/ä b.exr")
    files("t/hair/long.exr", other=True)
    return folder


def test_every_printer_has_the_names(tonetool, suite):
    words = ["r/%N.exr", "t/%N.exr", "--errormap:metric=mse:fail=0.01"]
    ran = tonetool(*words, "--json", "j.json", "--csv", "t.csv", "--junit", "u.xml", "--report",
                   "p.html", "--contactsheet", "s.png", status=1)
    shot = load(suite / "j.json")
    assert shot["version"] == 2
    assert [frame["name"] for frame in shot["frames"]] == ["cornell", "hair/long", "plane", "ä b"]
    assert all(frame["frame"] == 0 for frame in shot["frames"])
    assert [one["name"] for one in shot["worst"]] == ["plane", "hair/long"]
    assert (suite / "t.csv").read_text().startswith("name,method,frame,view,status")
    assert "4 cases: 1 missing, 1 failed, 2 passed; worst: plane (no test" in ran.out
    cases = ElementTree.parse(suite / "u.xml").getroot().findall(".//testcase")
    assert [(case.get("classname"), case.get("name"), case.get("file")) for case in cases] == [
        ("check", name, f"t/{name}.exr") for name in ("cornell", "hair/long", "plane", "ä b")]
    (failure,) = cases[1].findall("failure")
    assert failure.text == failure.get("message") + "\n"
    (error,) = cases[2].findall("error")
    assert error.attrib == {"type": "missing", "message": 'no test "t/plane.exr"'}
    page = (suite / "p.html").read_text()
    assert "<td>hair/long</td>" in page and "2 of 4 cases need a look" in page
    assert (suite / "s.png").stat().st_size > 1000


def test_the_schema_knows_names(tonetool, suite, testimages):
    schema = pytest.importorskip("jsonschema", reason="no python3-jsonschema here")
    tonetool("r/%N.exr", "t/%N.exr", FLIP, "--json", "j.json", "-q", status=1)
    description = load(testimages.parent / "src" / "sequence" / "check.schema.json")
    schema.Draft7Validator(description).validate(load(suite / "j.json"))


def test_jobs_state_and_merge_give_the_same_bytes(tonetool, suite):
    words = ["r/%N.exr", "t/%N.exr", "--errormap:metric=mse:fail=0.01", "-q"]
    results = ["--json", "{}.json", "--csv", "{}.csv", "--junit", "{}.xml"]
    tonetool(*words, *(word.format("whole") for word in results), status=1)
    tonetool(*words, "--jobs", "3", *(word.format("jobs") for word in results), status=1)
    for _ in range(2):
        tonetool(*words, "--state", "st", *(word.format("state") for word in results), status=1)
    kept = sorted(path.name for path in (suite / "st").glob("frame@*"))
    assert kept == ["frame@%C3%A4%20b@.0000.json", "frame@cornell@.0000.json",
                    "frame@hair%2Flong@.0000.json"]
    # Parts, as somebody who checks half of the folder makes them.
    for part, gone in (("first", "ä b"), ("second", "cornell")):
        shutil.copytree(suite / "r", suite / part / "r")
        shutil.copytree(suite / "t", suite / part / "t")
        for name in {"first": ["ä b"], "second": ["cornell", "hair/long", "plane"]}[part]:
            for side in "rt":
                (suite / part / side / f"{name}.exr").unlink(missing_ok=True)
        tonetool("--eval", "") if False else None
        os.rename(suite / "r", suite / "r.whole"), os.rename(suite / "t", suite / "t.whole")
        os.rename(suite / part / "r", suite / "r"), os.rename(suite / part / "t", suite / "t")
        tonetool(*words, "--json", f"{part}.json", status=1 if part == "first" else 0)
        shutil.rmtree(suite / "r"), shutil.rmtree(suite / "t")
        os.rename(suite / "r.whole", suite / "r"), os.rename(suite / "t.whole", suite / "t")
    tonetool("--merge", "second.json", "first.json", *(word.format("merged") for word in results),
             status=1)
    for kind, ending in itertools.product(("jobs", "state", "merged"), ("json", "csv", "xml")):
        assert (suite / f"{kind}.{ending}").read_bytes() == (suite / f"whole.{ending}").read_bytes(), kind
    ran = tonetool("--merge", "first.json", "first.json", status=1)
    assert "case cornell is there twice" in ran.err


def test_methods(tonetool, files):
    folder = files("r/a.exr", "r/b.exr", "m/pt/a.exr", "m/pt/b.exr", "m/bdpt/a.exr")
    (folder / "o").mkdir()
    ran = tonetool("r/%N.exr", "m/%M/%N.exr", FLIP, "--junit", "u.xml", "-o", "o/%M/%N.png", status=1)
    names = [case.get("name") for case in ElementTree.parse(folder / "u.xml").getroot().iter("testcase")]
    assert names == ["a [bdpt]", "a [pt]", "b [bdpt]", "b [pt]"]
    assert "worst: b [bdpt] (no test " in ran.out
    assert sorted(str(path.relative_to(folder)) for path in folder.glob("o/*/*")) == [
        "o/bdpt/a.png", "o/pt/a.png", "o/pt/b.png"]


def test_a_method_with_an_empty_folder_is_missing(tonetool, files):
    folder = files("refs/a.exr", "refs/b.exr", "out/x/a.exr", "out/x/b.exr")
    words = ["refs/%N.exr", "out/%M/%N.exr", MSE]
    (folder / "out" / "latest").symlink_to("x")  # a second name of a method
    (folder / "out" / ".cache").mkdir()
    (folder / "out" / "logs").mkdir()
    (folder / "out" / "logs" / "x.txt").write_text("no method")
    tonetool(*words)
    (folder / "out" / "y" / "below").mkdir(parents=True)
    tonetool(*words, "--json", "run.json", status=1)
    assert [(frame["name"], frame["method"]) for frame in load(folder / "run.json")["frames"]
            if frame["status"] == "missing"] == [("a", "y"), ("b", "y")]


def test_folders_of_outputs_are_made(tonetool, suite):
    tonetool("r/%N.exr", "--resize", "4x4", "-o", "small/%N.exr", status=1)  # below a fixed folder
    (suite / "small").mkdir()
    tonetool("r/%N.exr", "--resize", "4x4", "-o", "small/%N.exr")
    assert (suite / "small/hair/long.exr").exists()


def test_names_in_modifiers_and_texts(tonetool, suite):
    (suite / "x").mkdir()
    ran = tonetool("r/ä%N.exr", "t/ä%N.exr", "--hdrflip:fail=0.5:print=0:saveexposures=x/e%N", "--echo", "<%N>")
    assert "< b>" in ran.out and "1 case: 1 passed" in ran.out
    assert list((suite / "x").glob("e b*"))
    assert "%N" in tonetool("r/plane.exr", "--echo", "<%N>").out  # without a name it is a text


def test_a_dry_run_lists_the_cases(tonetool, suite):
    ran = tonetool("r/%N.exr", "t/%N.exr", FLIP, "--dry-run", "--json", "j.json")
    assert "4 cases asked for, 3 there, missing: plane" in ran.out and not (suite / "j.json").exists()


# ---- frames of cases

def test_frames_of_a_name(tonetool, files):
    frames = [f"{side}/{name}.{frame:04}.exr" for side in "rt" for name, frames in
              (("a", (1, 2, 4)), ("x/b", (7, 8))) for frame in frames]
    folder = files(*frames)
    words = ["r/%N.#.exr", "t/%N.#.exr", FLIP, "-q", "--csv", "t.csv"]
    tonetool(*words, status=1)
    rows = table(folder / "t.csv")
    assert [(row["name"], row["frame"], row["status"]) for row in rows] == [
        ("a", "1", "passed"), ("a", "2", "passed"), ("a", "3", "missing"), ("a", "4", "passed"),
        ("x/b", "7", "passed"), ("x/b", "8", "passed")]
    tonetool(*words, "--frames", "7-8", status=1)
    assert [(row["name"], row["frame"], row["status"]) for row in table(folder / "t.csv")] == [
        ("a", "7", "missing"), ("a", "8", "missing"), ("x/b", "7", "passed"), ("x/b", "8", "passed")]
    # One reference for all frames; narrow numbers are told, not left out.
    files("s/a.exr", "s/x/b.exr")
    ran = tonetool("s/%N.exr", "t/%N.#.exr", FLIP, status=1)
    assert "6 cases: 1 missing, 5 passed; worst: a frame 3" in ran.out
    files("t/a.5.exr")
    assert '"t/a.5.exr" has fewer digits' in tonetool(*words, status=1).err


def test_rules_over_time_are_of_one_name(tonetool, files):
    files("t/a.exr", "t/b.exr", "t/c_0.exr", "t/c_1.exr")
    assert "4 cases: 4 passed" in tonetool("t/%N.exr", "--qc").out  # the same pixels in each
    folder = files("s/a.0001.exr", "s/a.0002.exr", "s/b.0003.exr")
    files("s/a.0003.exr", other=True)
    tonetool("s/%N.#.exr", "--qc:duplicate=error", "--json", "j.json", status=3)
    codes = {(frame["name"], frame["frame"]): [fault["code"] for fault in frame.get("faults", [])]
             for frame in load(folder / "j.json")["frames"]}
    assert "duplicate" in codes["a", 2] and "duplicate" not in codes["b", 3]


def test_an_acceptance_is_of_one_name(tonetool, tmp_path, make_image):
    (tmp_path / "t").mkdir()
    bad = np.full((12, 16, 3), np.nan)
    for name in ("a", "b"):
        make_image(f"t/{name}.exr", pixels=bad)
    words = ["t/%N.exr", "--qc", "--json", "j.json"]
    tonetool(*words, status=3)
    shot = load(tmp_path / "j.json")
    codes = {fault["code"] for frame in shot["frames"] for fault in frame["faults"]}
    for names, failed in ((["a"], 1), (["a", "b"], 0), ([""], 2)):
        accepted = [{"frame": 0, **({"name": name} if name else {}), "code": code, "by": "Ann",
                     "why": "asked for"} for code in codes for name in names]
        (tmp_path / "accepted.json").write_text(json.dumps({"check": shot["id"], "accepted": accepted}))
        tonetool(*words, "--accept", "accepted.json", status=3 if failed else 0)
        assert load(tmp_path / "j.json")["counts"]["failed"] == failed, names


# ---- what is no name

def test_plain_text(tonetool, files):
    folder = files("r/%N.exr", "t/%N.exr", "r/a.exr", "t/b.exr")
    ran = tonetool("--wildcardoff", "r/%N.exr", "t/%N.exr", "--wildcardon", FLIP)
    assert "hdrflip: t/%N.exr against r/%N.exr" in ran.out  # these files, not all names
    tonetool("--compat", "r/%N.exr", "-o", "o%N.exr")
    assert (folder / "o%N.exr").exists()


HOSTILE = ["a b", "it's", "100%", "a,b", "a;b", "=1+1", "<script>alert(1)</script>", "{1+1}", "x" * 200,
           "-o", "#", "new\nline", "label", "a.exr?x=1"]


def test_hostile_names(tonetool, files):
    folder = files(*(f"{side}/{name}.exr" for side in "rt" for name in HOSTILE if "/" not in name),
                   "r/<script>alert(1)</script>.exr", "t/<script>alert(1)</script>.exr")
    tonetool("r/%N.exr", "t/%N.exr", FLIP, "-q", "--json", "j.json", "--csv", "t.csv", "--junit",
             "u.xml", "--report", "p.html", "--state", "st", "-o", "o/%N.png", status=1)
    (folder / "o").mkdir()
    tonetool("r/%N.exr", "t/%N.exr", FLIP, "-q", "--json", "j.json", "--csv", "t.csv", "--junit",
             "u.xml", "--report", "p.html", "--state", "st", "-o", "o/%N.png")
    shot = load(folder / "j.json")
    assert {frame["name"] for frame in shot["frames"]} == set(HOSTILE)
    assert len(list((folder / "o").rglob("*.png"))) == len(HOSTILE)
    ElementTree.parse(folder / "u.xml")
    assert "<script>alert(1)" not in (folder / "p.html").read_text().split("</noscript>")[0]


def test_names_that_begin_with_a_dash_are_files(tonetool, files):
    folder = files("-o_r.exr", "-o_t.exr", "--compat_r.exr", "--compat_t.exr")
    tonetool("%N_r.exr", "%N_t.exr", FLIP, "--csv", "t.csv")
    assert [row["reference"] for row in table(folder / "t.csv")] == ["./--compat_r.exr", "./-o_r.exr"]


def test_names_that_are_not_utf8(tonetool, files):
    folder = files("r/a.exr", "t/a.exr")
    for side in "rt":
        os.rename(os.fsencode(folder / side / "a.exr"), os.fsencode(folder / side) + b"/\xff\xe4.exr")
    assert "1 case: 1 passed" in tonetool("r/%N.exr", "t/%N.exr", FLIP, "--json", "j.json").out


def test_links(tonetool, files):
    folder = files("r/x/a.exr", "t/x/a.exr", "far/b.exr")
    os.symlink("..", folder / "r/x/loop")
    os.symlink("x", folder / "r/again")     # a folder that has been seen by its own path
    os.symlink("../far", folder / "r/y")
    os.symlink("nowhere", folder / "t/dead.exr")
    tonetool("r/%N.exr", "t/%N.exr", FLIP, "--csv", "t.csv", status=1)
    assert [(row["name"], row["status"]) for row in table(folder / "t.csv")] == [
        ("dead", "missing"), ("x/a", "passed"), ("y/b", "missing")]


@pytest.mark.parametrize("words", [
    ["r/%N.exr", "t/%N.exr", "--hdrflip:fail=0.1", "-o", "r/%N.exr"],
    ["r/%N.exr", "t/%N.exr", "--hdrflip:fail=0.1", "-o", "t/%N.exr"],
    ["r/%N.exr", "t/%N.exr", "--hdrflip:fail=0.1", "--pop", "r/%N.exr", "-o", "t/%N2.exr"],
    ["--dry-run", "r/%N.exr", "t/%N.exr", "--hdrflip:fail=0.1", "-o", "./r/../r/%N.exr"]])
def test_an_output_over_what_another_case_reads(tonetool, make_image, tmp_path, words):
    for folder in "rt":
        (tmp_path / folder).mkdir()
        for name in ("a", "a2"):
            make_image(f"{folder}/{name}.exr")
    before = {file: file.read_bytes() for file in tmp_path.glob("?/*.exr")}
    ran = tonetool(*words, status=1)
    assert "is read by this check, and -o would write over it" in ran.err
    assert {file: file.read_bytes() for file in tmp_path.glob("?/*.exr")} == before


@pytest.mark.parametrize("there", ["t/glass.EXR", "t/glass.tif", "t/Glass.hdr"])
def test_a_file_of_another_ending_is_told(tonetool, files, there):
    folder = files("r/a.exr", "t/a.exr", "r/glass.exr", there)
    tonetool("r/%N.exr", "t/%N.exr", FLIP, "--csv", "t.csv", "-q", status=1)
    assert table(folder / "t.csv")[1]["message"] == \
        f'no test "t/glass.exr", though "{there[2:]}" is there'
