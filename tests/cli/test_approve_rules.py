# SPDX-License-Identifier: BSD-3-Clause
"""--approve and --approved: a store of approved images, which only an approval writes."""

import array
import hashlib
import itertools
import json
import os
import random
import re
import resource
import shutil
import signal
import socket
import struct
import subprocess
import time

import numpy as np
import pytest
from conftest import call
from prestart import Streams, number, prestarted, run_bytes

SUITE = """tonetool-suite = 1
name = "looks"
reference = "approved"
test = "t/%N.exr"
check = "--errormap:metric=mse:print=0:fail=mse=0.01"
"""
NAMES = ["glass", "hair/a", "hair/b", "wood"]
WHY = ["--reason", "new shader"]


@pytest.fixture
def render(tmp_path, make_image):
    """Writes the test of a case, all of one value."""

    def write(name, value, folder="t"):
        (tmp_path / folder / name).parent.mkdir(parents=True, exist_ok=True)
        return make_image(f"{folder}/{name}.exr", 4, 4, pixels=np.full((4, 4, 3), value),
                          attributes={"DateTime": "2026:01:01 00:00:00"})  # else no two have the same bytes

    return write


@pytest.fixture
def folder(tmp_path, render):
    """A suite of four cases, none of which is approved."""
    (tmp_path / "suite.toml").write_text(SUITE)
    for name in NAMES:
        render(name, 0.25)
    return tmp_path


@pytest.fixture
def check(tonetool, folder):
    """Runs the suite; the cases of run.json by name."""

    def run(*words, status=0):
        tonetool("--suite", "suite.toml", *words, "--json", "run.json", "-q", status=status)
        return {case["name"]: case for case in load(folder / "run.json")["frames"]}

    return run


@pytest.fixture
def approved(tonetool, check, folder):
    """The suite with all four approved, which its run has passed."""
    check(status=1)
    tonetool("--approve", "run.json", "*", *WHY)
    check()
    return folder


def load(path):
    return json.loads(path.read_text())


def record(folder, name):
    return load(folder / f"approved/{name}.approved.json")["images"]


def hash_of(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def statuses(cases):
    return {name: case["status"] for name, case in cases.items()}


def contents(folder):
    """Every file and folder of the store, with its bytes and times."""
    return {str(path.relative_to(folder)): (path.lstat().st_mtime_ns, path.lstat().st_ino,
                                            path.read_bytes() if path.is_file() else None)
            for path in [folder / "approved", *(folder / "approved").rglob("*")] if path.exists()}


def images_of(folder):
    """The store without its lock: names of files below it."""
    return sorted(str(path.relative_to(folder / "approved")) for path in (folder / "approved").rglob("*")
                  if path.is_file() and path.name != ".tonetool.lock")


def assert_whole(folder):
    """Every record can be read, and each of its images is what it says."""
    count = 0
    for path in (folder / "approved").rglob("*.approved.json"):
        one = load(path)
        assert one["format"] == "tonetool-approved" and one["version"] == 1 and one["images"]
        for image in one["images"]:
            assert hash_of(path.parent / image["file"]) == image["sha256"]
            assert (path.parent / image["file"]).stat().st_size == image["bytes"]
            count += 1
    return count


# ---- the first run, and what an approval writes

def test_a_first_run_fails_and_writes_nothing(tonetool, check, folder):
    cases = check(status=1)
    assert statuses(cases) == dict.fromkeys(NAMES, "missing")
    assert {case["message"] for case in cases.values()} == {"no approved image"}
    assert {case["sha256"] for case in cases.values()} == {hash_of(folder / "t/glass.exr")}
    assert not (folder / "approved").exists()


def test_what_an_approval_writes(tonetool, check, folder, monkeypatch):
    check(status=1)
    monkeypatch.setenv("GIT_AUTHOR_NAME", "Ada")
    monkeypatch.setenv("GIT_AUTHOR_EMAIL", "ada@studio")
    ran = tonetool("--approve", "run.json", "hair/a", *WHY)
    assert "hair/a" in ran.out and "hair/b" not in ran.out
    sha256 = hash_of(folder / "t/hair/a.exr")
    file = f"a.{sha256[:12]}.exr"
    assert images_of(folder) == sorted([f"hair/{file}", "hair/a.approved.json"])
    assert (folder / "approved/hair" / file).read_bytes() == (folder / "t/hair/a.exr").read_bytes()
    (image,) = record(folder, "hair/a")
    at = image.pop("at")
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", at)
    assert image.pop("replaces", []) == []
    assert image == {"key": "", "file": file, "sha256": sha256, "by": "Ada <ada@studio>",
                     "bytes": (folder / "t/hair/a.exr").stat().st_size, "reason": "new shader"}
    lines = (folder / "approved/hair/a.approved.json").read_text().splitlines()
    assert all(line.count('":') <= 1 for line in lines)  # a field a line, for git
    assert statuses(check(status=1)) == {**dict.fromkeys(NAMES, "missing"), "hair/a": "passed"}


def test_by(tonetool, check, folder, monkeypatch):
    check(status=1)
    monkeypatch.setenv("GIT_AUTHOR_NAME", "Ada")
    tonetool("--approve", "run.json", "glass", *WHY, "--by", 'Bob "B" <b@c>')
    assert record(folder, "glass")[0]["by"] == 'Bob "B" <b@c>'
    monkeypatch.delenv("GIT_AUTHOR_NAME")
    monkeypatch.delenv("GIT_AUTHOR_EMAIL", raising=False)
    tonetool("--approve", "run.json", "wood", *WHY)
    login = subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()
    assert record(folder, "wood")[0]["by"] == login


def test_replaced_images(tonetool, check, approved, render):
    old = record(approved, "glass")[0]
    render("glass", 0.75)
    assert statuses(check(status=3)) == {**dict.fromkeys(NAMES, "passed"), "glass": "failed"}
    tonetool("--approve", "run.json", "glass", *WHY)
    (new,) = record(approved, "glass")
    assert new["replaces"] == [old["sha256"]] and new["sha256"] == hash_of(approved / "t/glass.exr")
    assert not (approved / "approved" / old["file"]).exists()
    check()
    render("glass", 0.25)
    assert statuses(check(status=3))["glass"] == "failed"  # the old one holds no more


def test_add_keeps_what_is_accepted(tonetool, check, approved, render):
    render("glass", 0.75)
    check(status=3)
    tonetool("--approve", "run.json", "glass", "--add", *WHY)
    assert len(record(approved, "glass")) == 2
    hashes = [image["sha256"] for image in record(approved, "glass")]
    assert hashes == sorted(hashes)
    for value, passes in ((0.25, True), (0.75, True), (0.5, False)):
        render("glass", value)
        case = check(status=0 if passes else 3)["glass"]
        assert case["status"] == ("passed" if passes else "failed")
        # The best is the measurement, the other one is told.
        wanted = hash_of(approved / "t/glass.exr")[:12]
        assert len(case["tried"]) == 1 and case["tried"][0]["file"] != case["reference"]
        assert not passes or wanted in case["reference"]
        assert case["measurements"][0]["quantities"]["mse"] == (0 if passes else pytest.approx(0.0625))
    tonetool("--approve", "run.json", "glass", *WHY)  # without --add
    assert len(record(approved, "glass")) == 1
    assert len(record(approved, "glass")[0]["replaces"]) == 2
    assert len([file for file in images_of(approved) if file.startswith("glass")]) == 2


def test_keys(tonetool, check, approved, render):
    render("glass", 0.75)
    case = check("--key", "cuda", status=3)["glass"]  # there is none with that key: those without
    assert case["status"] == "failed" and case.get("key", "") == ""
    tonetool("--approve", "run.json", "glass", "--key", "cuda", *WHY)
    file = f"glass@cuda.{hash_of(approved / 't/glass.exr')[:12]}.exr"
    assert file in images_of(approved)
    assert [(image["key"], image["file"] == file) for image in record(approved, "glass")] == [
        ("", False), ("cuda", True)]
    cases = check("--key", "cuda")
    assert cases["glass"]["key"] == "cuda" and cases["wood"].get("key", "") == ""
    assert statuses(check(status=3))["glass"] == "failed"  # the key is given, never guessed
    render("glass", 0.25)
    assert statuses(check())["glass"] == "passed"
    # With images of the key those without are no fallback.
    assert statuses(check("--key", "cuda", status=3))["glass"] == "failed"
    assert statuses(check("--key", "metal"))["glass"] == "passed"



def test_an_image_of_another_key_is_none(tonetool, check, folder):
    check("--key", "cuda", status=1)
    tonetool("--approve", "run.json", "glass", "--key", "cuda", *WHY)
    case = check(status=1)["glass"]
    assert case["status"] == "missing" and case["message"] == "no approved image"


@pytest.mark.parametrize("key", ["a/b", "../x", "a b", "@", "", "a\nb", ".x"])
def test_hostile_keys(tonetool, check, folder, key):
    check(status=1)
    if not key:
        tonetool("--approve", "run.json", "glass", "--key", key, *WHY)
        assert record(folder, "glass")[0]["key"] == ""
        return
    tonetool("--approve", "run.json", "glass", "--key", key, *WHY, status=1)
    assert not [file for file in folder.rglob("*.approved.json")]


# ---- refusals: exit 1, and the store is as it was

def refused(tonetool, folder, *words):
    before = contents(folder)
    ran = tonetool("--approve", *words, status=1)
    assert contents(folder) == before and "approved:" not in ran.out
    return ran.err


def test_what_passed_is_refused(tonetool, check, approved, render):
    render("glass", 0.251)  # passes, and is another file
    check()
    for name in ("glass", "wood"):
        assert "--again" in refused(tonetool, approved, "run.json", name, *WHY)
    refused(tonetool, approved, "run.json", "*", *WHY)
    refused(tonetool, approved, "run.json", "*", "--add", *WHY)
    refused(tonetool, approved, "run.json", "glass", "--by", "x", *WHY)
    tonetool("--approve", "run.json", "glass", "--again", *WHY)
    assert record(approved, "glass")[0]["sha256"] == hash_of(approved / "t/glass.exr")


def test_a_glob_does_not_renew_what_passed(tonetool, check, approved, render):
    render("glass", 0.251)  # passes, and is another file
    render("hair/a", 0.75)
    check(status=3)
    before = [record(approved, name) for name in ("glass", "hair/b", "wood")]
    tonetool("--approve", "run.json", "*", *WHY)
    assert [record(approved, name) for name in ("glass", "hair/b", "wood")] == before
    assert record(approved, "hair/a")[0]["sha256"] == hash_of(approved / "t/hair/a.exr")


def test_an_image_of_another_size(tonetool, check, approved, make_image):
    make_image("t/glass.exr", 6, 5)
    assert check(status=1)["glass"]["status"] == "size mismatch"
    tonetool("--approve", "run.json", "glass", *WHY)
    check()


def test_a_run_without_hashes_is_refused(tonetool, check, approved, render):
    """What is approved is what was seen."""
    render("glass", 0.75)
    check(status=3)
    run = load(approved / "run.json")
    for sha256 in (None, "", "0" * 64, "x"):
        for case in run["frames"]:
            case.pop("sha256", None)
            if sha256 is not None:
                case["sha256"] = sha256
        (approved / "run.json").write_text(json.dumps(run))
        for words in ([], ["--again"], ["--add"]):
            refused(tonetool, approved, "run.json", "glass", *words, *WHY)


def test_one_method_can_be_approved(tonetool, folder, render):
    (folder / "suite.toml").write_text(SUITE.replace("t/%N", "m/%M/%N"))
    for method, value in (("bdpt", 0.25), ("pt", 0.75)):
        render("glass", value, folder=f"m/{method}")
    tonetool("--suite", "suite.toml", "--json", "run.json", "-q", status=1)
    refused(tonetool, folder, "run.json", "glass", *WHY)


def test_parts_of_another_key_are_refused(tonetool, approved):
    tonetool("--suite", "suite.toml", "--key", "cuda", "--only", "glass", "--json", "one.json", "-q")
    tonetool("--suite", "suite.toml", "--only", "[hw]*", "--json", "two.json", "-q")
    for words in (["--suite", "suite.toml"], [], ["--suite", "suite.toml", "--key", "cuda"]):
        tonetool(*words, "--merge", "one.json", "two.json", "--json", "m.json", status=1)
        assert not (approved / "m.json").exists()


def test_the_run_of_a_key(tonetool, check, approved, render):
    """Of a run with --key images of that key are approved, or those without where it is said."""
    render("glass", 0.75)
    check("--key", "cuda", status=3)
    assert "cuda" in refused(tonetool, approved, "run.json", "glass", *WHY)
    tonetool("--approve", "run.json", "glass", "--key", "cuda", *WHY)
    assert [image["key"] for image in record(approved, "glass")] == ["", "cuda"]


def test_what_is_not_there_to_be_approved_is_refused(tonetool, check, approved, render):
    (approved / "suite.toml").write_text(SUITE + '\n[[case]]\nname = "wood"\nskip = "flaky"\n')
    (approved / "t/glass.exr").write_bytes(b"no image")
    (approved / "t/hair/a.exr").unlink()
    render("hair/b", 0.75)
    assert statuses(check(status=1)) == {"glass": "unreadable", "hair/a": "missing", "hair/b": "failed",
                                         "wood": "skipped"}
    for name in ("wood", "glass", "hair/a"):
        for words in ([], ["--again"], ["--add"], ["--key", "x"]):
            assert name in refused(tonetool, approved, "run.json", name, *words, *WHY)
    refused(tonetool, approved, "run.json", "hair/b", "glass", *WHY)  # all or none
    refused(tonetool, approved, "run.json", "hair/b", "gone", *WHY)
    assert "gone" in refused(tonetool, approved, "run.json", "gone*", *WHY)
    tonetool("--approve", "run.json", "hair/b", *WHY)


def test_what_has_changed_is_refused(tonetool, check, approved, render):
    for name in ("glass", "wood"):
        render(name, 0.75)
    check(status=3)
    render("glass", 0.5)
    assert "glass" in refused(tonetool, approved, "run.json", "glass", *WHY)
    assert "glass" in refused(tonetool, approved, "run.json", "wood", "glass", "--again", *WHY)
    (approved / "t/glass.exr").unlink()
    refused(tonetool, approved, "run.json", "glass", *WHY)
    render("glass", 0.75)  # the same bytes again
    tonetool("--approve", "run.json", "glass", *WHY)


def test_reason_and_names_are_required(tonetool, check, approved, render):
    render("glass", 0.75)
    check(status=3)
    for words in (["glass"], ["glass", "--reason", ""], ["glass", "--reason", " \n"], ["glass", "--reason"],
                  ["glass", "--add"], ["glass", "--retire"]):
        assert "reason" in refused(tonetool, approved, "run.json", *words)
    told = refused(tonetool, approved, "run.json", *WHY)  # lists what could be
    assert "glass" in told and "wood" not in told and "hair" not in told
    refused(tonetool, approved, "none.json", "glass", *WHY)
    refused(tonetool, approved, "suite.toml", "glass", *WHY)


BESIDE = [["t/glass.exr"], ["t/%N.exr"], ["--suite", "suite.toml"], ["--hdrflip"], ["--errormap:fail=1"],
          ["--qc"], ["--tmqi"], ["-o", "x.exr"], ["--json", "x.json"], ["--approved", "approved"], ["--compat"],
          ["--merge", "run.json"], ["--only", "glass"], ["--resize", "2x2"]]


def test_an_approval_is_a_line_of_its_own(tonetool, check, approved, render):
    render("glass", 0.75)
    check(status=3)
    before = contents(approved)
    for words in BESIDE:
        for line in (["--approve", "run.json", "glass", *WHY, *words],
                     [*words, "--approve", "run.json", "glass", *WHY]):
            tonetool(*line, status=1)
            assert contents(approved) == before and not (approved / "x.json").exists()


def test_a_run_without_a_store_is_refused(tonetool, folder, check):
    shutil.copytree(folder / "t", folder / "r")
    (folder / "plain.toml").write_text(SUITE.replace('"approved"', '"r/%N.exr"'))
    tonetool("--suite", "plain.toml", "--json", "plain.json", "-q")
    tonetool("r/%N.exr", "t/%N.exr", "--errormap:metric=mse:fail=0.5", "--json", "line.json", "-q")
    for file in ("plain.json", "line.json"):
        for words in ([], ["--again"]):
            tonetool("--approve", file, "*", *words, *WHY, status=1)
    assert not (folder / "approved").exists()
    tonetool("--suite", "plain.toml", "--key", "cuda", status=1)


def test_words_of_an_approval_alone(tonetool, approved):
    for words in (WHY, ["--by", "x"], ["--again"], ["--retire"]):
        tonetool("--suite", "suite.toml", *words, status=1)


def test_nothing_else_approves(tonetool, check, folder, monkeypatch):
    for name in ("TONETOOL_APPROVE", "TONETOOL_UPDATE", "UPDATE_BASELINES"):
        monkeypatch.setenv(name, "1")
    for key in ("approve = true", 'approve = "all"', "update = true"):
        (folder / "suite.toml").write_text(SUITE + key + "\n")
        tonetool("--suite", "suite.toml", status=1)
    (folder / "suite.toml").write_text(SUITE)
    check(status=1)
    assert not (folder / "approved").exists()


def test_retire(tonetool, check, approved):
    (approved / "t/hair/a.exr").unlink()
    cases = check(status=1)
    assert cases["hair/a"]["status"] == "missing" and "t/hair/a.exr" in cases["hair/a"]["message"]
    refused(tonetool, approved, "run.json", "hair/a", "--retire")
    refused(tonetool, approved, "run.json", "gone", "--retire", *WHY)
    tonetool("--approve", "run.json", "hair/a", "--retire", *WHY)
    assert not [file for file in images_of(approved) if file.startswith("hair/a")]
    assert sorted(check()) == ["glass", "hair/b", "wood"]



def test_only_a_retired_case_is_retired(tonetool, check, approved):
    """"removes record and images of a retired case": one whose test is there is none."""
    check()
    refused(tonetool, approved, "run.json", "glass", "--retire", *WHY)
    refused(tonetool, approved, "run.json", "*", "--retire", *WHY)


def test_a_case_of_a_part_can_be_approved(tonetool, check, folder):
    check("--only", "hair/*", status=1)
    assert "glass" in refused(tonetool, folder, "run.json", "glass", *WHY)
    tonetool("--approve", "run.json", "hair/*", *WHY)
    check("--only", "hair/*")
    tonetool("--suite", "suite.toml", "--only", "glass", "--json", "p.json", "-q", status=1)
    tonetool("--suite", "suite.toml", "--only", "wood", "--json", "q.json", "-q", status=1)
    tonetool("--merge", "p.json", "q.json", "--json", "merged.json", "-q", status=1)
    tonetool("--approve", "merged.json", "glass", "wood", *WHY)
    check()


# ---- a store that is not what was approved

def test_an_edited_baseline_is_an_error(tonetool, check, approved):
    (image,) = record(approved, "glass")
    shutil.copy(approved / "t/glass.exr", approved / "approved" / image["file"])  # the same bytes
    check()
    with open(approved / "approved" / image["file"], "ab") as file:
        file.write(b"\0")
    case = check(status=1)["glass"]
    assert case["status"] == "error" and case["message"].endswith("is not what was approved")
    assert image["file"] in case["message"]
    assert image["file"] in tonetool("--approved", "approved", status=1).out
    refused(tonetool, approved, "run.json", "glass", *WHY)
    (approved / "approved" / image["file"]).unlink()
    assert check(status=1)["glass"]["status"] == "error"
    assert image["file"] in tonetool("--approved", "approved", status=1).out


def test_each_accepted_image_is_verified(tonetool, check, approved, render):
    render("glass", 0.75)
    check(status=3)
    tonetool("--approve", "run.json", "glass", "--add", *WHY)
    other = next(image for image in record(approved, "glass")
                 if image["sha256"] != hash_of(approved / "t/glass.exr"))
    shutil.copy(approved / "t/glass.exr", approved / "approved" / other["file"])
    assert check(status=1)["glass"]["status"] == "error"


def test_an_unfetched_pointer(tonetool, check, approved):
    (image,) = record(approved, "glass")
    place = approved / "approved" / image["file"]
    pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:{}\nsize {}\n"
    place.write_text(pointer.format(image["sha256"], image["bytes"]))
    case = check(status=1)["glass"]
    assert case["status"] == "error" and "not fetched: git lfs pull" in case["message"]
    assert "not fetched" in tonetool("--approved", "approved", status=1).out
    place.write_text(pointer.format("0" * 64, image["bytes"]))
    assert check(status=1)["glass"]["message"].endswith("is not what was approved")


def test_approved_lists_and_verifies(tonetool, check, approved):
    ran = tonetool("--approved", "approved")
    for name in NAMES:
        assert re.search(rf"^{name} .*\b{record(approved, name)[0]['bytes']}\b.*new shader", ran.out, re.M)
    extra = approved / "approved/hair/x.0123456789ab.exr"
    shutil.copy(approved / "t/glass.exr", extra)
    assert "x.0123456789ab.exr" in tonetool("--approved", "approved", status=1).out
    extra.rename(approved / "approved/plain.exr")
    assert "plain.exr" in tonetool("--approved", "approved", status=1).out
    (approved / "approved/plain.exr").unlink()
    tonetool("--approved", "approved")
    (approved / "approved/glass.approved.json").unlink()
    assert record(approved, "wood") and "glass." in tonetool("--approved", "approved", status=1).out
    tonetool("--approved", "none", status=1)



def test_a_record_without_images(tonetool, check, approved):
    text = json.dumps({"format": "tonetool-approved", "version": 1, "images": []})
    (approved / "approved/glass.approved.json").write_text(text)
    case = check(status=1)["glass"]
    assert case["status"] == "missing" and case["message"] == "no approved image"
    tonetool("--approved", "approved", status=1)


@pytest.mark.parametrize("change", [
    lambda text: "", lambda text: text[:len(text) // 2], lambda text: "[" * 100000, lambda text: "null",
    lambda text: text.replace('"version": 1', '"version": 2'),
    lambda text: text.replace('"file": "glass', '"file": "../t/glass'),
    lambda text: text.replace('"key"', '"kex"'), lambda text: text.replace("tonetool-approved", "x"),
    lambda text: "<<<<<<< HEAD\n" + text], ids=range(9))
def test_broken_records(tonetool, check, approved, change):
    file = approved / "approved/glass.approved.json"
    file.write_text(change(file.read_text()))
    cases = check(status=1)
    assert statuses(cases) == {**dict.fromkeys(NAMES, "passed"), "glass": "error"}
    assert "glass.approved.json" in cases["glass"]["message"]
    ran = tonetool("--approved", "approved", status=1)
    assert "glass.approved.json" in ran.out + ran.err
    refused(tonetool, approved, "run.json", "glass", *WHY)



def test_another_record_is_broken(tonetool, check, approved, render):
    """An approval holds or does not: exit 1 leaves the store as it was."""
    render("wood", 0.75)
    (approved / "approved/glass.approved.json").write_text("{")
    check(status=1)
    before = contents(approved)
    ran = call(os.environ["TONETOOL"], ["--approve", "run.json", "wood", *WHY], approved)
    if ran.status:
        assert contents(approved) == before
    else:
        assert record(approved, "wood")[0]["sha256"] == hash_of(approved / "t/wood.exr")


# ---- a check never writes to a store

CHECKS = [[], ["--report", "r.html"], ["--junit", "j.xml", "--csv", "t.csv"], ["--images", "looks"],
          ["--github"], ["--summary", "s.md"], ["--state", "st"], ["--parallel-frames", "2"],
          ["--jobs", "2"], ["--key", "cuda"], ["--only", "hair/*"], ["-n"], ["-v"], ["--ctest"]]


def test_checks_do_not_write(tonetool, approved, render):
    render("glass", 0.75)
    (approved / "t/wood.exr").unlink()
    render("new", 0.5)
    (approved / "approved/.tonetool-new.1-0").write_text("left")
    shutil.copy(approved / "t/new.exr", approved / "approved/x.0123456789ab.exr")
    before = contents(approved)
    for words in CHECKS:
        call(os.environ["TONETOOL"], ["--suite", "suite.toml", *words, "--json", "run.json"], approved)
        assert contents(approved) == before, words
    tonetool("--suite", "suite.toml", "--merge", "run.json", "--json", "m.json", status=1)
    tonetool("--approved", "approved", status=1)
    assert contents(approved) == before


def test_a_run_beside_a_store_gives_the_same_bytes(tonetool, approved, render):
    render("glass", 0.75)
    for kind, words in (("one", []), ("many", ["--parallel-frames", "3"]), ("jobs", ["--jobs", "2"])):
        tonetool("--suite", "suite.toml", *words, "--json", f"{kind}.json", "--csv", f"{kind}.csv", "-q", status=3)
    for glob in ("glass", "[hw]*"):
        tonetool("--suite", "suite.toml", "--only", glob, "--json", f"part.{glob[0]}.json", "-q",
                 status=3 if glob == "glass" else 0)
    tonetool("--suite", "suite.toml", "--merge", "part.g.json", "part.[.json", "--json", "parts.json", "--csv",
             "parts.csv", "-q", status=3)
    for kind, ending in itertools.product(("many", "jobs", "parts"), ("json", "csv")):
        assert (approved / f"{kind}.{ending}").read_bytes() == (approved / f"one.{ending}").read_bytes(), kind


def test_state_sees_an_approval(tonetool, approved, render):
    render("glass", 0.75)
    tonetool("--suite", "suite.toml", "--state", "st", "--json", "run.json", "-q", status=3)
    tonetool("--approve", "run.json", "glass", *WHY)
    tonetool("--suite", "suite.toml", "--state", "st", "-q")
    (image,) = record(approved, "wood")
    with open(approved / "approved" / image["file"], "ab") as file:
        file.write(b"\0")
    tonetool("--suite", "suite.toml", "--state", "st", "-q", status=1)


def test_the_schema_holds(tonetool, check, approved, render, testimages):
    schema = pytest.importorskip("jsonschema", reason="no python3-jsonschema here")
    render("glass", 0.75)
    check(status=3)
    tonetool("--approve", "run.json", "glass", "--add", *WHY)
    render("glass", 0.5)
    (approved / "t/wood.exr").unlink()
    check("--key", "cuda", status=1)
    description = load(testimages.parent / "src" / "sequence" / "check.schema.json")
    schema.Draft7Validator(description).validate(load(approved / "run.json"))


# ---- hostile names

HOSTILE = ["a b", "it's", 'say "x"', "50%", "%41", "a,b", "a\nb", "<script>alert(1)</script>", "n" * 200,
           "[ab]", "back\\slash", "ä", "; rm x", "$HOME", "a.approved", "x@cuda", "a.0123456789ab"]


def test_hostile_names(tonetool, check, folder):
    source = (folder / "t/wood.exr").read_bytes()
    shutil.rmtree(folder / "t")
    for name in HOSTILE:
        (folder / f"t/{name}.exr").parent.mkdir(parents=True, exist_ok=True)
        (folder / f"t/{name}.exr").write_bytes(source)
    check(status=1)
    for name in HOSTILE[::2]:  # each by its own name
        tonetool("--approve", "run.json", name, *WHY)
    check(status=1)
    tonetool("--approve", "run.json", "*", *WHY)
    assert statuses(check()) == dict.fromkeys(HOSTILE, "passed")
    assert assert_whole(folder) == len(HOSTILE)
    tonetool("--approved", "approved")


def test_a_name_that_is_not_utf8(tonetool, check, folder):
    place = os.fsencode(folder) + b"/t/x\xff\xfey.exr"
    shutil.copy(folder / "t/wood.exr", place)
    done = run_bytes(os.environ["TONETOOL"], ["--suite", "suite.toml", "--json", "run.json"], folder, 60)
    assert done.returncode == 1 and len(load(folder / "run.json")["frames"]) == 5
    # JSON is UTF-8: the name is not approved under another one.
    done = run_bytes(os.environ["TONETOOL"], ["--approve", "run.json", "x*", *WHY], folder, 60)
    assert done.returncode == 1 and not (folder / "approved").exists()
    tonetool("--approve", "run.json", "glass", "wood", "hair/*", *WHY)
    assert assert_whole(folder) == 4


def test_names_cannot_leave_the_store(tonetool, check, folder):
    check(status=1)
    run = load(folder / "run.json")
    for name in ("../out", "/tmp/out", "a/../../out", ".git/x", ""):
        run["frames"][0]["name"] = name
        (folder / "run.json").write_text(json.dumps(run))
        tonetool("--approve", "run.json", name or "*", *WHY, status=1)
    assert not (folder / "out.approved.json").exists() and not (folder / "approved/.git").exists()


# ---- disks and processes

def unnamed(folder):
    return [file for file in images_of(folder) if not file.endswith(".approved.json") and "tonetool-new" in file]


def test_a_full_disk(approved, render, check, program):
    """A limit of a file's size stands for it."""
    render("glass", 0.75)
    check(status=3)
    before = {name: value[2] for name, value in contents(approved).items()}

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    for size in (0, 100, (approved / "t/glass.exr").stat().st_size):  # the image, then its record
        done = subprocess.run([program, "--approve", "run.json", "glass", *WHY], cwd=approved,
                              preexec_fn=limit, capture_output=True, text=True, check=False)
        assert done.returncode == 1 and "approved:" not in done.stdout, (size, done)
        after = {name: value[2] for name, value in contents(approved).items()}
        named = {name: value for name, value in after.items() if not re.search(r"glass\.[0-9a-f]{12}\.exr", name)}
        assert {**before, **named} == before and not unnamed(approved)  # an image without a record may be left


def test_a_store_that_cannot_be_written(approved, render, check, program):
    render("glass", 0.75)
    check(status=3)
    words = [program, "--approve", "run.json", "glass", *WHY]
    if os.geteuid() == 0:
        script = 'mount --bind approved approved && mount -o remount,bind,ro approved && exec "$@"'
        words = ["unshare", "-m", "sh", "-c", script, "sh", *words]
        probe = subprocess.run([*words[:4], script, "sh", "true"], cwd=approved, capture_output=True, check=False)
        if probe.returncode:
            pytest.skip("no mounts of one's own here")
    else:
        for path in (approved / "approved", approved / "approved/hair"):
            path.chmod(0o555)
    before = contents(approved)
    done = subprocess.run(words, cwd=approved, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "approved" in done.stderr, done
    assert contents(approved) == before
    # A check needs no more than to read.
    words[words.index("--approve"):] = ["--suite", "suite.toml", "-q"]
    done = subprocess.run(words, cwd=approved, capture_output=True, text=True, check=False)
    (approved / "approved").chmod(0o755)
    (approved / "approved/hair").chmod(0o755)
    assert done.returncode == 3


def start(program, words, cwd):
    """Starts the program; its process and a function that waits for its status."""
    waiting = prestarted(program)
    if not waiting:
        process = subprocess.Popen([program, *words], cwd=cwd, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        return process.pid, process.wait
    streams = Streams().__enter__()
    parts = [str(cwd), waiting.program, *words, *(f"{key}={value}" for key, value in os.environ.items())]
    text = b"".join(os.fsencode(part) + b"\0" for part in parts)
    connection = socket.socket(socket.AF_UNIX)
    connection.connect(waiting.address)
    connection.sendmsg([struct.pack("=II", len(text), len(words) + 1)],
                       [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", streams.given))])
    connection.sendall(text)
    streams.close_given()
    pid = number(connection)

    def wait():
        streams.read(60)
        status = os.waitstatus_to_exitcode(number(connection))
        streams.__exit__()
        connection.close()
        return status

    return pid, wait


KILLS = int(os.environ.get("APPROVE_KILLS", "30"))


def test_kill_at_any_moment(tonetool, folder, check, program, render):
    """Every record can be read and every hash is right; the next approval clears what is left."""
    choice = random.Random(1)
    names = [*NAMES, *(f"more/{number}" for number in range(8))]
    killed, longest = 0, 0.02
    for attempt in range(KILLS):
        for name in names:
            render(name, 0.25 + (attempt + 1) / 4)
        call(program, ["--suite", "suite.toml", "--json", "run.json", "-q"], folder)
        began = time.monotonic()
        pid, wait = start(program, ["--approve", "run.json", "*", *WHY], folder)
        time.sleep(choice.random() * longest)
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        status = wait()
        killed += status != 0
        if status == 0:
            longest = min(longest, time.monotonic() - began)
        assert status in (0, -signal.SIGKILL)
        assert_whole(folder)
    assert killed >= KILLS // 4
    for name in names:
        render(name, 1e3)
    call(program, ["--suite", "suite.toml", "--json", "run.json", "-q"], folder)
    tonetool("--approve", "run.json", "*", *WHY)
    check()
    assert assert_whole(folder) == len(names)
    tonetool("--approved", "approved")
    left = [path for path in (folder / "approved").rglob("*")
            if path.is_file() and path.name.startswith(".") and path.name != ".tonetool.lock"]
    assert not left


PROCESSES, RECORDS = 8, int(os.environ.get("APPROVE_RECORDS", "3"))


def test_approvals_at_once_lose_nothing(tonetool, tmp_path, program, render):
    """Each process approves an image of its own for every case, one command for each."""
    for process in range(PROCESSES):
        for case in range(RECORDS):
            render(f"case{case}", process + case / 64, folder=f"p{process}")
        text = SUITE.replace("t/%N", f"p{process}/%N")
        (tmp_path / f"p{process}.toml").write_text(text)
        tonetool("--suite", f"p{process}.toml", "--json", f"p{process}.json", "-q", status=1)
    for case in range(RECORDS):
        waits = [start(program, ["--approve", f"p{process}.json", f"case{case}", "--add", *WHY], tmp_path)[1]
                 for process in range(PROCESSES)]
        assert [wait() for wait in waits] == [0] * PROCESSES
    assert assert_whole(tmp_path) == PROCESSES * RECORDS
    tonetool("--approved", "approved")
    for process in range(PROCESSES):
        tonetool("--suite", f"p{process}.toml", "-q")
