# SPDX-License-Identifier: BSD-3-Clause
"""--approve and --approved: nothing else writes to a store, and what is in it is what was seen."""

import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest

SUITE = """tonetool-suite = 1
reference = "approved"
test = "t/%N.exr"
check = "--errormap:metric=mse:print=0:fail=mse=0.1"
"""
CHECK = ["--suite", "suite.toml", "--json", "run.json", "-q"]


@pytest.fixture
def suite(tmp_path, make_image):
    (tmp_path / "suite.toml").write_text(SUITE)
    for name, value in (("black", 0), ("grey", 0.5), ("light", 0.55)):
        make_image(f"{name}.exr", 4, 4, pixels=np.full((4, 4, 3), value))
    (tmp_path / "t/hair").mkdir(parents=True)
    for name in ("a", "b", "hair/long"):
        shutil.copy(tmp_path / "black.exr", tmp_path / "t" / f"{name}.exr")
    return tmp_path


@pytest.fixture
def approved(tonetool, suite):
    tonetool(*CHECK, status=1)
    tonetool("--approve", "run.json", "*", "--reason", "first", "--by", "Ada")
    return suite


def load(path):
    return json.loads(path.read_text())


def statuses(folder):
    return {frame["name"]: frame["status"] for frame in load(folder / "run.json")["frames"]}


def contents(folder):
    return {str(path.relative_to(folder)): (path.read_bytes(), path.stat().st_mtime_ns)
            for path in sorted(folder.rglob("*")) if path.is_file()}


def record(folder, name):
    return load(folder / f"approved/{name}.approved.json")["images"]


def sound(store):
    """Every record can be read, and its images are what they are called."""
    for path in store.rglob("*.approved.json"):
        for image in load(path)["images"]:
            assert hashlib.sha256((path.parent / image["file"]).read_bytes()).hexdigest() == image["sha256"]


def test_a_first_run_passes_nothing_and_writes_nothing(tonetool, suite):
    ran = tonetool(*CHECK, "--report", "p.html", "--state", "st", status=1)
    assert "check: missing, 3 cases: 3 missing" in ran.out and "no approved image" in ran.err
    assert "--approve run.json a b hair/long --reason" in ran.out
    assert not (suite / "approved").exists()
    with_both = SUITE.replace('check = "', 'check = "--against ')
    (suite / "suite.toml").write_text(with_both)
    ran = tonetool(*CHECK, status=1)
    assert "errormap : no approved image" in ran.err and ".approved" not in ran.err


def test_what_is_approved_is_kept(tonetool, approved):
    images = record(approved, "hair/long")
    assert len(images) == 1 and images[0]["by"] == "Ada" and images[0]["reason"] == "first"
    assert images[0]["sha256"] == hashlib.sha256((approved / "t/hair/long.exr").read_bytes()).hexdigest()
    assert images[0]["file"] == f"long.{images[0]['sha256'][:12]}.exr"
    before = contents(approved / "approved")
    for words in ([], ["--report", "p.html"], ["--parallel-frames", "2"], ["--state", "st"], ["--dry-run"]):
        tonetool(*CHECK, *words)
    assert statuses(approved) == {"a": "passed", "b": "passed", "hair/long": "passed"}
    shutil.copy(approved / "grey.exr", approved / "t/a.exr")
    tonetool(*CHECK, status=3)
    assert contents(approved / "approved") == before
    ran = tonetool("--approved", "approved")
    assert ran.out.splitlines()[0].split() == ["name", "key", "bytes", "approved", "by", "reason"]
    assert [line.split()[0] for line in ran.out.splitlines()[1:]] == ["a", "b", "hair/long"]


@pytest.mark.parametrize("words, said", [
    ([], "which cases"), (["a"], "why?"), (["a", "--reason", " "], "why?"), (["z*", "--reason", "x"], "names no case"),
    (["b", "--reason", "x"], "it passed (--again"), (["a", "--reason", "x", "--diff"], "a line of its own"),
    (["a", "--reason", "x", "--suite", "suite.toml"], "a line of its own"), (["a", "--reason", "x", "--key", "../x"], "the key"),
])
def test_refusals(tonetool, approved, words, said):
    shutil.copy(approved / "grey.exr", approved / "t/a.exr")
    tonetool(*CHECK, status=3)
    before = contents(approved / "approved")
    assert said in tonetool("--approve", "run.json", *words, status=1).err
    assert contents(approved / "approved") == before


def test_only_what_was_seen(tonetool, approved):
    shutil.copy(approved / "grey.exr", approved / "t/a.exr")
    tonetool(*CHECK, status=3)
    shutil.copy(approved / "light.exr", approved / "t/a.exr")
    before = contents(approved / "approved")
    assert "has changed" in tonetool("--approve", "run.json", "a", "--reason", "x", status=1).err
    (approved / "t/a.exr").write_bytes((approved / "grey.exr").read_bytes()[:-40])
    tonetool(*CHECK, status=1)
    tonetool("--approve", "run.json", "a", "--reason", "x", status=1)
    (approved / "t/a.exr").unlink()
    tonetool(*CHECK, status=1)
    assert statuses(approved)["a"] == "missing"  # no baseline goes stale unseen
    assert 'no test "t/a.exr"' in tonetool("--approve", "run.json", "a", "--reason", "x", status=1).err
    assert contents(approved / "approved") == before
    tonetool("r.exr", "--approve", "run.json", "a", "--reason", "x", status=1)
    (approved / "plain.json").write_text((approved / "run.json").read_text().replace('"store"', '"stare"'))
    assert "folder of approved images" in tonetool("--approve", "plain.json", "a", "--reason", "x", status=1).err


def test_again_add_and_retire(tonetool, approved):
    first = record(approved, "a")[0]
    shutil.copy(approved / "grey.exr", approved / "t/a.exr")
    tonetool(*CHECK, status=3)
    # Of * only what did not pass.
    ran = tonetool("--approve", "run.json", "*", "--add", "--reason", "two looks")
    assert "2 that passed left as approved" in ran.out and "approved: b" not in ran.out
    assert len(record(approved, "a")) == 2 and len(record(approved, "b")) == 1
    tonetool(*CHECK)
    frame = load(approved / "run.json")["frames"][0]
    assert [one["status"] for one in frame["tried"]] == ["failed"] and first["file"] in frame["tried"][0]["file"]
    tonetool("--approve", "run.json", "a", "--again", "--reason", "one look")
    assert len(record(approved, "a")) == 1 and first["sha256"] in str(record(approved, "a")[0])
    assert not (approved / "approved" / first["file"]).exists()
    (approved / "t/b.exr").unlink()
    tonetool(*CHECK, status=1)
    tonetool("--approve", "run.json", "b", "--retire", "--reason", "gone")
    tonetool(*CHECK)
    assert statuses(approved) == {"a": "passed", "hair/long": "passed"}
    tonetool("--approved", "approved")


def test_keys(tonetool, approved):
    shutil.copy(approved / "grey.exr", approved / "t/a.exr")
    tonetool(*CHECK, "--key", "cuda", status=3)
    assert "--key cuda" in tonetool("--approve", "run.json", "a", "--reason", "x", status=1).err
    tonetool("--approve", "run.json", "a", "--key", "cuda", "--reason", "x")
    ran = tonetool(*CHECK, "--key", "cuda")
    assert "2 compared with images without the key cuda" in ran.out
    assert record(approved, "a")[1]["file"].startswith("a@cuda.")
    tonetool(*CHECK, status=3)  # the images of all are as they were


def test_an_image_that_is_not_what_was_approved(tonetool, approved):
    file = approved / "approved" / record(approved, "a")[0]["file"]
    kept = file.read_bytes()
    shutil.copy(approved / "grey.exr", file)
    shutil.copy(approved / "grey.exr", approved / "t/a.exr")  # equal, and approved by nobody
    ran = tonetool(*CHECK, status=1)
    assert "is not what was approved" in ran.err and statuses(approved)["a"] == "error"
    assert "is not what was approved" in tonetool("--approved", "approved", status=1).out
    tonetool(*CHECK, "--state", "st", status=1)
    digest = hashlib.sha256(kept).hexdigest()
    file.write_text(f"version https://git-lfs.github.com/spec/v1\noid sha256:{digest}\nsize {len(kept)}\n")
    assert "not fetched: git lfs pull" in tonetool(*CHECK, status=1).err
    file.unlink()
    assert "approved and not there" in tonetool(*CHECK, status=1).err
    file.write_bytes(kept)
    shutil.copy(approved / "black.exr", approved / "t/a.exr")
    tonetool(*CHECK)
    shutil.copy(file, approved / "approved/stray.exr")
    assert "has no record" in tonetool("--approved", "approved", status=1).out
    (approved / "approved/a.approved.json").write_text("{}")
    tonetool(*CHECK, status=1)
    tonetool("--approved", "approved", status=1)
    assert "no folder" in tonetool("--approved", "nowhere", status=1).err


def test_a_store_that_cannot_be_written(tonetool, approved):
    shutil.copy(approved / "grey.exr", approved / "t/a.exr")
    tonetool(*CHECK, status=3)
    before = contents(approved / "approved")
    limited = "ulimit -f 0; exec \"$@\""
    ran = subprocess.run(["bash", "-c", limited, "-", os.environ["TONETOOL"], "--approve", "run.json", "a", "--reason", "x"],
                         cwd=approved, capture_output=True, check=False)
    assert ran.returncode == 1 and b"approved: a" not in ran.stdout
    assert contents(approved / "approved") == before


def approving(folder, name, reason):
    return subprocess.Popen([os.environ["TONETOOL"], "--approve", "run.json", name, "--again", "--add", "--reason", reason],
                            cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def test_killed_at_any_moment(tonetool, approved):
    for name in ("a", "b", "hair/long"):
        shutil.copy(approved / "grey.exr", approved / "t" / f"{name}.exr")
    tonetool(*CHECK, status=3)
    moments = random.Random(7)
    for _ in range(20):
        running = approving(approved, "*", "killed")
        time.sleep(moments.uniform(0.0, 0.25))
        running.send_signal(signal.SIGKILL)
        running.wait()
        sound(approved / "approved")
    tonetool("--approve", "run.json", "*", "--again", "--reason", "whole")
    sound(approved / "approved")
    tonetool("--approved", "approved")
    assert not list((approved / "approved").rglob(".tonetool-new.*"))


def test_several_at_once_lose_nothing(tonetool, suite):
    runs = []
    for number in range(4):
        folder = suite / f"run{number}"
        (folder / "t").mkdir(parents=True)
        (folder / "suite.toml").write_text(SUITE.replace('"approved"', '"../approved"'))
        shutil.copy(suite / ("black.exr" if number % 2 else "grey.exr"), folder / f"t/n{number}.exr")
        shutil.copy(suite / "light.exr", folder / "t/shared.exr")
        subprocess.run([os.environ["TONETOOL"], *CHECK], cwd=folder, check=False, capture_output=True)
    for number in range(4):
        runs.append(approving(suite / f"run{number}", "*", f"of {number}"))
    assert [run.wait() for run in runs] == [0] * 4
    sound(suite / "approved")
    assert {path.name for path in (suite / "approved").glob("*.json")} == {
        "n0.approved.json", "n1.approved.json", "n2.approved.json", "n3.approved.json", "shared.approved.json"}


def test_a_case_that_lost_its_record_and_its_image_is_missing(tonetool, approved):
    """Else it would be no case any more, and nobody would know."""
    (approved / "approved/hair/long.approved.json").unlink()
    (approved / "t/hair/long.exr").unlink()
    tonetool(*CHECK, status=1)
    assert statuses(approved) == {"a": "passed", "b": "passed", "hair/long": "missing"}
    tonetool("--suite", "suite.toml", "--key", "cuda", "-q", status=1)


def test_a_record_of_another_case_approves_nothing(tonetool, approved):
    shutil.copy(approved / "approved/a.approved.json", approved / "approved/b.approved.json")
    tonetool(*CHECK, status=1)
    frame = next(one for one in load(approved / "run.json")["frames"] if one["name"] == "b")
    assert frame["status"] == "error" and "which is of another case, key or hash" in frame["message"]
    tonetool("--approved", "approved", status=1)


def test_the_first_run_sees_what_cannot_be_read(tonetool, suite):
    whole = (suite / "t/a.exr").read_bytes()
    (suite / "t/a.exr").write_bytes(whole[:len(whole) // 2])
    (suite / "t/b.exr").write_bytes(b"")
    ran = tonetool("--suite", "suite.toml", "--json", "run.json", status=1)
    assert statuses(suite) == {"a": "unreadable", "b": "unreadable", "hair/long": "missing"}
    assert "approve run.json hair/long --reason" in ran.out
    assert 'there is no folder "approved": approving makes it' in ran.out
    tonetool("--approve", "run.json", "hair/long", "--reason", "first")


@pytest.mark.parametrize("test, store, refused", [
    ("%N.exr", "approved", True), ("./%N.exr", "sub/../approved", True), ("approved/%N.exr", "approved", True),
    ("t/%N.exr", "t", True), ("t/%N.exr", "t/approved", True), ("t/%N.exr", "approved", False),
    ("%N_out.exr", "approved", False)])
def test_a_store_is_not_where_tests_are(tonetool, suite, test, store, refused):
    """What is approved would be a case of the next run."""
    (suite / "sub").mkdir()
    shutil.copy(suite / "black.exr", suite / "a_out.exr")
    (suite / "suite.toml").write_text(SUITE.replace("t/%N.exr", test).replace('"approved"', f'"{store}"'))
    ran = tonetool("--suite", "suite.toml", "--json", "run.json", status=1)
    assert (f'"{store}" is where "{test}" looks for tests' in ran.err) == refused
    assert (suite / "run.json").exists() != refused
