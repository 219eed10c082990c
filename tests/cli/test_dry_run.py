# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with a check is said before its first frame is read, and --dry-run says it alone."""

import json
import os
import pwd
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest
from conftest import TESTIMAGES

ANIM = TESTIMAGES / "anim"
PAIR = ["ref.#.exr", "test.#.exr"]


@pytest.fixture
def shot(tmp_path):
    """Eight frames; frame 3 of the test is missing."""
    for side in ("ref", "test"):
        for number in range(1, 9):
            if (side, number) != ("test", 3):
                shutil.copy(ANIM / f"{side}.{number:04d}.exr", tmp_path)
    return tmp_path


def names(folder):
    return sorted(os.listdir(folder))


def test_what_a_run_would_do(tonetool, shot):
    before = names(shot)
    ran = tonetool("--dry-run", "--frames", "1-10", *PAIR, "--hdrflip:fail=0.5", "-o", "map.#.exr",
                   "--json", "c.json", "--state", "deep/st")
    assert "10 frames asked for, 7 there, missing: 3,9-10\n" in ran.out
    assert "results would be in c.json (--json), deep/st (--state), map.#.exr (-o)\n" in ran.out
    assert ran.err == "" and names(shot) == before


def test_nothing_is_read_or_written_of_lines_without_a_verdict(tonetool, shot):
    before = names(shot)
    ran = tonetool("--dry-run", "ref.#.exr", "-o", "a.#.png")
    assert "8 frames asked for, 8 there\n" in ran.out and "a.#.png (-o)" in ran.out
    ran = tonetool("--dry-run", "ref.0001.exr", "test.0003.exr", "--hdrflip", "--json", "c.json")
    assert "not all of its files are there" in ran.out
    assert names(shot) == before


def test_a_merge(tonetool, shot):
    tonetool("--frames", "1-2", *PAIR, "--hdrflip:fail=0.9", "--json", "a.json")
    tonetool("--frames", "4", *PAIR, "--hdrflip:fail=0.9", "--json", "b.json")
    before = names(shot)
    ran = tonetool("--merge", "a.json", "b.json", "--json", "c.json", "--dry-run")
    assert "3 frames in 2 parts, 1 missing\n" in ran.out and "c.json (--json)" in ran.out
    (shot / "b.json").write_text('{"format": "tonetool-check", "version": 9}')
    ran = tonetool("--merge", "a.json", "b.json", "--json", "c.json", "--dry-run", status=1)
    assert '"b.json": is of version 9, this program reads' in ran.err
    assert names(shot) == before


MISTAKES = [
    (["--hdrflip", "--json", "c.json", "--nope"], 'unknown command "--nope"'),
    (["--hdrflip:fial=0.5", "--json", "c.json"], 'unknown modifier "fial"'),
    (["--hdrflip:fail=q9=0.5", "--json", "c.json"], 'unknown quantity "q9"'),
    (["--hdrflip:ppd=x", "--json", "c.json"], 'ppd "x" is not a number'),
    (["--hdrflip:tests=0", "--json", "c.json"], "hdrflip : tests 0 is out of range"),
    (["--hdrflip:fail=1"], "can never fail"),
    (["--hdrflip:fail=0,3"], "(valid: a decimal point, as in 0.3, or QUANTITY=LIMIT,QUANTITY=LIMIT)"),
    (["--hdrflip:fail=p99.9=0,1"], "fail=p99.9=0,1: a comma separates limits (valid: a decimal point, as in 0.1"),
    (["--hdrflip:warn=mean=0,05,p99=0.7"], "as in 0.05"),
    (["--hdrflip", "--table", "t.md"], "--table: a table has a row for each name, and no case has one"),
    (["--ldrflip:quantity=mean", "--json", "c.json"], "quantity= needs fail= or warn="),
    (["--errormap:metric=smap", "--json", "c.json"], '"smap"'),
    (["--hdrflip:fail=gone.json", "--json", "c.json"], 'could not read the limits "gone.json"'),
    (["--hdrflip:exposures=gone.json", "--json", "c.json"], 'no file "gone.json"'),
    (["--hdrflip:exposures=ref.0001.exr", "--json", "c.json"], 'exposures of "ref.0001.exr"'),
    (["--hdrflip:layer=Nope", "--json", "c.json"], '"ref.0001.exr": no colour layer "Nope"'),
    (["--qc:nan=sometimes", "--json", "c.json"], "sometimes"),
    (["--against:layer=Nope", "--json", "c.json"], '"ref.0001.exr": no colour layer "Nope"'),
    (["--hdrflip", "--against", "--json", "c.json"],
     "needs 2 image(s), the stack has 1; commands before it took theirs (--dup keeps one, --against"),
    (["--hdrflip", "--hdrflip", "--json", "c.json"], "needs 2 image(s), the stack has 1"),
    (["--biascheck:alpha=2", "--json", "c.json"], "alpha 2 is out of range"),
    (["--hdrflip", "-o", "gone/map.#.exr", "--json", "c.json"], 'no folder "gone"'),
    (["--hdrflip", "--json", "gone/c.json"], 'no folder "gone"'),
    (["--hdrflip", "--json", "c.json", "--state", "ref.0001.exr/st"], '"ref.0001.exr" is a file'),
    (["--hdrflip", "--pictures", "ref.0001.exr"], '"ref.0001.exr" is a file'),
]


@pytest.mark.parametrize("dry", [["--dry-run"], []])
@pytest.mark.parametrize("words, text", MISTAKES)
def test_mistakes_are_said_before_a_frame_is_read(tonetool, shot, words, text, dry):
    before = names(shot)
    ran = tonetool(*dry, "-v", *PAIR, *words, status=1)
    assert text in ran.err and ran.err.count("tonetool ERROR") == 1
    assert "Reading" not in ran.out and "check: " not in ran.out and "dry run" not in ran.out
    assert names(shot) == before


def test_a_layer_that_one_frame_has_is_no_mistake_of_the_line(tonetool, make_image, tmp_path):
    for number in (1, 2, 3):
        layer = "Key" if number == 3 else "Fill"
        make_image(f"a.{number:04d}.exr", channels=[f"{layer}.{c}" for c in "RGB"])
    words = ["a.#.exr", "--qc:layer=Key", "--json", "c.json"]
    tonetool(*words, status=1)
    found = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))["frames"]
    assert [frame["status"] for frame in found][:2] == ["error", "error"]
    # So a part of frames without it is a result, too.
    tonetool("--frames", "1-2", *words[:2], "--exit-zero", "--json", "part.json")
    (tmp_path / "a.0003.exr").unlink()
    ran = tonetool("--frames", "1-2", *words, status=1)
    assert 'no colour layer "Key"' in ran.err


def test_a_comparison_may_wait_for_its_images(tonetool, shot):
    plain = tonetool("--frames", "1-2", *PAIR, "--hdrflip:fail=0.5").out
    assert tonetool("--frames", "1-2", "--hdrflip:fail=0.5", *PAIR).out == plain
    assert tonetool("--frames", "1-2", PAIR[0], "--hdrflip:fail=0.5", PAIR[1]).out == plain
    ran = tonetool("--frames", "1-2", "--hdrflip:fail=0.5:layer=Nope", *PAIR, status=1)
    assert '"ref.0001.exr": no colour layer "Nope"' in ran.err
    ran = tonetool("--frames", "1-2", "--hdrflip:fail=0.5", PAIR[0], status=1)
    assert "needs 2 image(s), the stack has 1" in ran.err


def test_a_layer_that_a_command_makes_is_there(tonetool, shot):
    key = ["--ch", "ViewLayer.Combined.R,ViewLayer.Combined.G,ViewLayer.Combined.B", "--chnames",
           "Key.R,Key.G,Key.B"]
    tonetool("--frames", "1-2", PAIR[0], *key, PAIR[1], *key, "--hdrflip:fail=0.9:layer=Key")


def test_words_that_differ_between_frames_are_left_to_them(tonetool, shot):
    words = [*PAIR, "--hdrflip:fail={FRAME_NUMBER/100}", "--if", "0", "--hdrflip:fail=gone.json",
             "--endif"]
    ran = tonetool("--dry-run", *words)
    assert "8 frames asked for, 7 there" in ran.out


def test_old_results_stay_as_they_are(tonetool, shot):
    (shot / "c.json").write_text("old")
    stamp = (shot / "c.json").stat().st_mtime_ns
    tonetool("--dry-run", *PAIR, "--hdrflip", "--json", "c.json")
    tonetool(*PAIR, "--hdrflip:layer=Nope", "--json", "c.json", status=1)
    assert (shot / "c.json").read_text() == "old"
    assert (shot / "c.json").stat().st_mtime_ns == stamp


@pytest.fixture
def open_shot():
    """A pair that everybody may read, in a folder that everybody gets into."""
    if os.geteuid() != 0:
        pytest.skip("only root becomes somebody else")
    with tempfile.TemporaryDirectory(prefix="dry-run-", dir="/tmp") as folder:
        for side in ("ref", "test"):
            shutil.copy(ANIM / f"{side}.0001.exr", folder)
        yield Path(folder)


@pytest.mark.parametrize("words, text", [
    (["--json", "closed/c.json"], 'cannot write into the folder "'),
    (["--json", "kept.json"], 'cannot write "kept.json"'),
    (["--csv", "link.csv"], 'cannot write into the folder "'),
    (["--state", "closed/st"], 'cannot write into the folder "closed"'),
    (["--pictures", "closed"], 'cannot write into the folder "closed"'),
])
def test_places_that_nobody_may_write(program, open_shot, words, text):
    open_shot.chmod(0o777)
    (open_shot / "closed").mkdir(mode=0o555)
    (open_shot / "kept.json").write_text("old")
    (open_shot / "kept.json").chmod(0o444)
    (open_shot / "link.csv").symlink_to("closed/c.csv")
    nobody = pwd.getpwnam("nobody").pw_uid
    ran = subprocess.run([program, "--dry-run", *PAIR, "--hdrflip", *words], cwd=open_shot, user=nobody,
                         capture_output=True, text=True, check=False, timeout=60)
    assert ran.returncode == 1 and text in ran.stderr, (ran.stdout, ran.stderr)
    assert (open_shot / "kept.json").read_text() == "old"
