# SPDX-License-Identifier: BSD-3-Clause
"""The frame loop: wildcards, holes, views, parallel frames, progress; and the language around it."""

import json
import os
import pty
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pytest
from conftest import call


@pytest.fixture
def shot(make_image):
    """shot.0001.exr to shot.0004.exr, without frame 3."""
    return [make_image(f"shot.{frame:04d}.exr", width=80, height=70, seed=frame)
            for frame in (1, 2, 4)]


@pytest.mark.usefixtures("shot")
def test_frames_are_those_on_the_disk(tonetool, read, tmp_path):
    tonetool("shot.#.exr", "--exposure", "1", "-o", "out.#.exr")
    assert sorted(path.name for path in tmp_path.glob("out.*")) == \
        ["out.0001.exr", "out.0002.exr", "out.0004.exr"]
    assert np.array_equal(read("out.0004.exr")[0], read("shot.0004.exr")[0] * 2)


@pytest.mark.usefixtures("shot")
def test_unreadable_frame_is_named_and_whole_outputs_stay(tonetool, tmp_path, read):
    ran = tonetool("--frames", "1-4", "shot.#.exr", "-o", "out.#.exr", status=1)
    assert 'does not exist: "shot.0003.exr" (frame 3)' in ran.err
    assert sorted(path.name for path in tmp_path.glob("out.*")) == ["out.0001.exr", "out.0002.exr"]
    assert np.array_equal(read("out.0002.exr")[0], read("shot.0002.exr")[0])


@pytest.mark.usefixtures("shot")
@pytest.mark.parametrize("parallel", [(), ("--parallel-frames", "2")])
def test_skip_bad_frames_goes_on_but_fails(tonetool, tmp_path, parallel):
    tonetool("--frames", "1-4", "--skip-bad-frames", *parallel, "shot.#.exr", "-o", "out.#.exr",
             status=1)
    assert sorted(path.name for path in tmp_path.glob("out.*")) == \
        ["out.0001.exr", "out.0002.exr", "out.0004.exr"]


@pytest.mark.usefixtures("shot")
@pytest.mark.parametrize("policy, value", [("black", 0), ("checker", 1)])
def test_missing_file_is_replaced_and_said(tonetool, read, policy, value):
    ran = tonetool("--warnings-exit", "--missingfile", policy, "--frames", "1-4", "shot.#.exr",
                   "-o", "out.#.exr", status=2)
    assert f'"shot.0003.exr", {policy} instead (frame 3)' in ran.err
    pixels, spec = read("out.0003.exr")
    assert (spec.width, spec.height) == (80, 70) and pixels.max() == value


@pytest.mark.usefixtures("shot")
@pytest.mark.parametrize("words, text", [
    (["nosuch.#.exr"], 'no file matches "nosuch.#.exr"'),
    (["shot.1-3#.exr", "shot.1-2#.exr", "--add"],
     "shot.1-3#.exr (3 frames) vs. shot.1-2#.exr (2 frames)"),
    (["--frames", "1-", "shot.#.exr"], 'no frame range: "1-"'),
    (["--frames", "x", "shot.#.exr"], 'no frame range: "x"'),
    (["--frames", "1-2 4", "shot.#.exr"], '"4" is left over (valid: 1-10'),
    (["--frames", "1-2000000000", "shot.#.exr"], "has 2000000000 frames (valid: at most"),
    (["--parallel-frames", "0", "shot.#.exr"], "out of range"),
    (["--if", "0", "shot.0001.exr"], "--if without its --endif"),
    (["--endfor"], "endfor without matching for"),
    (["--for", "i", "1,3,0", "--endfor"], "never ends"),
    (["shot.0001.exr", "--echo:newlines=2", "x"], 'did you mean "newline"'),
])
def test_what_cannot_be_is_an_error(tonetool, tmp_path, words, text):
    output = "out.#.exr" if "#" in " ".join(words) else "out.exr"
    assert text in tonetool(*words, "-o", output, status=1).err
    assert not list(tmp_path.glob("out.*"))


@pytest.mark.usefixtures("shot")
def test_parallel_frames_are_the_same_bit_for_bit(tonetool, read):
    words = ["shot.#.exr", "--exposure", "0.3", "--luminancestats"]
    serial = tonetool(*words, "-o", "serial.#.exr")
    parallel = tonetool("--parallel-frames", "3", *words, "-o", "parallel.#.exr")
    assert serial.out == parallel.out and serial.out.count("log-average") == 3
    for frame in ("0001", "0002", "0004"):
        assert read(f"serial.{frame}.exr")[0].tobytes() == \
            read(f"parallel.{frame}.exr")[0].tobytes()


@pytest.mark.usefixtures("shot")
def test_progress_as_json_and_none_when_piped(tonetool):
    words = ["shot.#.exr", "-o", "out.#.exr"]
    gap = "tonetool WARNING: \"shot.#.exr\" has no frame 3 (valid: "
    assert tonetool(*words).err.startswith(gap) and tonetool(*words).err.count("\n") == 1
    words = ["--frames", "1,2,4", *words]
    assert tonetool(*words).err == ""
    lines = [json.loads(line) for line in tonetool("--progress=json", *words).err.splitlines()]
    assert [line["frame"] for line in lines] == [1, 2, 4]
    assert [line["done"] for line in lines] == [1, 2, 3]
    assert all(line["total"] == 3 and line["status"] == 0 for line in lines)


def test_views(tonetool, make_image, read):
    for view in ("left", "right"):
        make_image(f"stereo_{view}.exr", seed=len(view))
    tonetool("stereo_%V.exr", "-o", "out_%v.exr")
    assert np.array_equal(read("out_l.exr")[0], read("stereo_left.exr")[0])
    assert np.array_equal(read("out_r.exr")[0], read("stereo_right.exr")[0])


def shown_on_a_terminal(program, words, cwd):
    """The lines that are left on the screen, and those that were there before they were erased."""
    master, slave = pty.openpty()
    with subprocess.Popen([program, *words], cwd=cwd, stdin=slave, stdout=slave,
                          stderr=slave) as process:
        os.close(slave)
        text = b""
        while True:
            try:
                piece = os.read(master, 65536)
            except OSError: # the program has closed its side
                break
            text += piece
        status = process.wait(timeout=60)
    os.close(master)
    shown, erased = [], []
    for line in text.decode().replace("\r\n", "\n").split("\n"):
        *before, rest = line.split("\r\x1b[K")
        erased += before
        shown.append(rest)
    return status, shown, erased


@pytest.mark.usefixtures("pair_of_shots")
@pytest.mark.parametrize("jobs", [[], ["--jobs", "2"]])
@pytest.mark.parametrize("check", [[], ["--json", "check.json"]])
def test_progress_never_shares_a_line_with_results(program, tmp_path, jobs, check):
    limit = ":fail=0.05" if check else ""
    words = [*jobs, "r.#.exr", "t.#.exr", f"--hdrflip{limit}", *check]
    status, shown, erased = shown_on_a_terminal(program, words, tmp_path)
    assert status == (3 if check else 0)
    assert [line for line in erased if line][0].startswith("1 of 3 frames")
    assert all(" of 3 frames" in line or not line for line in erased)
    results = [line for line in shown if line]
    assert results and not any(" of 3 frames" in line for line in results)
    if check:
        assert [line.split(":")[0] for line in results] == ["hdrflip", "check"]
    else:
        assert [line.split(" ")[0] for line in results] == ["check:"]


def test_loops_conditions_and_variables(tonetool):
    ran = tonetool("--for", "i", "0,6,2", "--if", "{i==2}", "--echo", "two", "--else", "--echo",
                   "{i}", "--endif", "--endfor", "--set", "n", "0", "--while", "{n<2}", "--echo",
                   "n{n}", "--set", "n", "{n+1}", "--endwhile")
    assert ran.out.split() == ["0", "two", "4", "n0", "n1"]


@pytest.mark.parametrize("how", ["man", "bash", "zsh", "fish"])
def test_man_page_and_completion_have_every_command_and_modifier(tonetool, how):
    text = tonetool(f"--help={how}").out.replace("\\", "")
    for row in json.loads(tonetool("--help=json").out):
        for name in row["names"]:
            assert ("-" if len(name) == 1 else "--") + name in text
        for modifier in row["modifiers"]:
            assert modifier["key"] + "=" in text


def test_no_clobber_and_dry_run(tonetool, make_image, tmp_path):
    a, b = make_image("a.exr"), make_image("b.exr", seed=2)
    before = (tmp_path / b).read_bytes()
    ran = tonetool("--no-clobber", a, "-o", b, "-o", "new.exr")
    assert "not overwriting" in ran.err and (tmp_path / b).read_bytes() == before
    tonetool("-n", a, "-o", "other.exr")
    assert os.path.exists(tmp_path / "new.exr") and not os.path.exists(tmp_path / "other.exr")


# ---- what was not compared is not passed

@pytest.fixture
def pair_of_shots(make_image, tmp_path):
    """r.0001.exr to r.0003.exr and as many tests, of which frame 2 is another."""
    for frame in (1, 2, 3):
        make_image(f"r.{frame:04d}.exr", seed=frame)
        make_image(f"t.{frame:04d}.exr", seed=7 if frame == 2 else frame)
    return tmp_path


SHOTS = ["r.#.exr", "t.#.exr"]
FLIP = "--hdrflip:fail=0.05:print=0"


@pytest.mark.usefixtures("pair_of_shots")
@pytest.mark.parametrize("words, text", [
    (["r.0001.exr", "r.0002.exr", "t.0001.exr", FLIP], '"r.0001.exr" was never compared'),
    (["r.0001.exr", "r.0002.exr", "--swap", "t.0002.exr", "--diff"], "was never compared"),
    (["r.0001.exr", "r.0001.exr", "--exposure", "1", "r.0001.exr", "r.0001.exr", FLIP],
     "was never compared"),
    (["r.0001.exr", "--printstats", "r.0002.exr", "t.0002.exr", FLIP], "was never compared"),
    (["r.0001.exr", "r.0002.exr", "--qc"], '"r.0001.exr" was never compared'),
    (["--frames", "1-3", "r.0001.exr", "r.0001.exr", FLIP], "no image that is read has a wildcard"),
    (["--frames", "1-3", "r.#.exr", "r.0001.exr", FLIP], "--wildcardoff r.0001.exr --wildcardon"),
    (["--frames", "1-3", "r.#.exr", "r.0001.exr", "--exposure", "0", "--diff"], "no wildcard"),
    (["r.#.exr", "--pop", "--wildcardoff", "r.0001.exr", "t.0001.exr", "--wildcardon", FLIP],
     "would be one comparison that counts for each"),
    (["r.#.exr", "--pop", "--wildcardoff", "r.0001.exr", "--mulc", "0.5", "t.0001.exr",
      "--wildcardon", "--mulc", "1", "--diff"], "would be one comparison that counts for each"),
    (["--frames", "1-2", *SHOTS, FLIP, "--frames", "3"], "--frames is given twice"),
    (["--frames", "1-3", "r.1-2#.exr", "t.1-2#.exr", FLIP], "--frames 1-3 holds for no name"),
    (["r.1-3#.exr", "t.1-2#.exr", FLIP], '"r.1-3#.exr" has 3 frames, "t.1-2#.exr" 2'),
    (["r.#.exr", "-o", "same.exr"], '"same.exr" would be written by every frame'),
    (["r.#.exr", "-otex", "same.tx"], '"same.tx" would be written by every frame'),
    (["r.#.exr", "-o:all=1", "same.%02d.exr"], "would be written by every frame"),
    ([*SHOTS, "--hdrflip:saveexposures=same"], "would be written by every frame"),
    ([*SHOTS, FLIP, "--json", "other.0001.exr"], "has the name of an image (valid: "),
    ([*SHOTS, FLIP, "--report", "page.png"], "such as check.html)"),
    (["r.0001.exr", "t.0001.exr", FLIP, "-o", "./t.0001.exr"], "is read by this check, and -o would"),
    ([*SHOTS, FLIP, "-o", "t.#.exr"], "is read by this check, and -o would"),
    (["r.#.exr", "-o", "same.{FRAME_NUMBER//3}.exr"], "was written by frame 1"),
])
def test_not_compared_or_written_over(tonetool, words, text):
    ran = tonetool(*words, status=1)
    assert text in ran.err and "check: passed" not in ran.out


@pytest.mark.usefixtures("pair_of_shots")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_frames_of_several_processes_that_write_one_file(tonetool, jobs):
    words = ["--jobs", jobs, "--frames", "1,3", *SHOTS, FLIP, "-o", "same.{FRAME_NUMBER//9}.exr",
             "--state", "s"]
    for _ in range(2):  # also where both are known from the run before
        ran = tonetool(*words, status=1)
        assert "was written by frame" in ran.err + ran.out and "check: passed" not in ran.out
    ran = tonetool("--jobs", jobs, "--frames", "1,3", *SHOTS, FLIP, "-o",
                   "same.{FRAME_NUMBER//2}.exr", "--state", "s2")
    assert "check: passed" in ran.out


@pytest.fixture
def run_without_rights(program, tmp_path):
    """Runs the program as somebody who may not read everything, unlike root, on a copy of the
    files."""
    user = {"user": 65534} if os.geteuid() == 0 else {}
    folder = Path(tempfile.mkdtemp())
    shutil.copytree(tmp_path, folder, dirs_exist_ok=True)
    folder.chmod(0o755)
    if subprocess.run(["test", "-x", program], check=False, **user).returncode != 0:
        pytest.skip("the program lies where nobody else may run it")

    def run(*words):
        return call(program, words, folder, stdout=subprocess.PIPE, **user)

    yield folder, run
    shutil.rmtree(folder)


@pytest.mark.usefixtures("pair_of_shots")
def test_what_may_not_be_read_is_said(run_without_rights):
    folder, run = run_without_rights
    (folder / "closed").mkdir(0)
    (folder / "r.0003.exr").chmod(0)
    ran = run("closed/r.#.exr", "t.#.exr", FLIP)
    assert ran.status == 1 and 'cannot list the folder "closed/"' in ran.err, ran.err
    assert "Permission denied" in ran.err
    ran = run("r.0003.exr", "t.0003.exr", FLIP)
    assert ran.status == 1 and '"r.0003.exr": Permission denied' in ran.err, ran.err


@pytest.mark.usefixtures("pair_of_shots")
@pytest.mark.parametrize("words", [
    ["r.0001.exr", "r.0002.exr", "--pop", "t.0001.exr", FLIP],
    ["r.0001.exr", "--label", "r", "t.0001.exr", FLIP, "r", "t.0001.exr", "--diff"],
    ["r.0001.exr", "r.0001.exr", "t.0001.exr", FLIP.replace("print", "tests=2:print")],
    ["--frames", "1,3", "r.#.exr", "--wildcardoff", "r.0002.exr", "--wildcardon",
     "--hdrflip:fail=0.99:quantity=mean", "-o", "map.#.exr"],
    ["--frames", "1,3", *SHOTS, "r.0002.exr", "--mulc", "0", "--add", FLIP],
    ["--frames", "1,3", *SHOTS, FLIP, "-o", "map.{FRAME_NUMBER}.exr"],
    ["--frames", "1,3", "r.{FRAME_NUMBER}.exr".replace("{", "000{"), "t.000{FRAME_NUMBER}.exr", FLIP],
    ["--frames", "1,3", "r.#.exr", "--if", "{FRAME_NUMBER==1}", "-o", "poster.exr", "--endif", "--luminancestats"],
    ["--frames", "1", "r.#.exr", "-o", "one.exr"],
    ["--frames", "1-3,2", "r.#.exr", "-o", "out.#.exr"],
    ["--frames", "1-2", "--echo", "{FRAME_NUMBER}"],
    ["-n", "r.3-1#.exr", "t.1-3#.exr", "--add", "-o", "out.#.exr"],
])
def test_legal_lines_stay_legal(tonetool, words):
    tonetool(*words)


@pytest.mark.usefixtures("pair_of_shots")
def test_a_sequence_ends_with_a_verdict_that_names_the_worst_frame(tonetool):
    ran = tonetool(*SHOTS, FLIP, status=3)
    assert ran.out.splitlines()[-1].startswith(
        "check: failed, 3 frames: 1 failed, 2 passed; worst: frame 2 (hdrflip: ")
    ran = tonetool(*SHOTS, "--hdrflip:print=0")
    assert "check: measured, 3 frames: 3 measured; worst: frame 2 (hdrflip: " in ran.out
    ran = tonetool(*SHOTS, "--diff", status=1)
    assert "worst: frame 2 (diff: " in ran.out.splitlines()[-1]
    ran = tonetool("--frames", "1,3", *SHOTS, "--if", "{FRAME_NUMBER==1}", "--hdrflip:print=0",
                   "--endif", "--echo", "x")
    assert "check: measured, 1 frame: 1 measured" in ran.out
    tonetool("--frames", "1,3", *SHOTS, "--if", "{FRAME_NUMBER==1}", FLIP, "--else", "--pop",
             "--pop", "--endif", status=1)
    assert "check:" not in tonetool("r.#.exr", "-o", "out.#.exr").out


def test_numbers_that_differ(tonetool, pair_of_shots):
    (pair_of_shots / "t.0002.exr").rename(pair_of_shots / "t.0004.exr")
    for words in ([FLIP], ["--diff"], [FLIP, "--json", "c.json"]):
        ran = tonetool(*SHOTS, *words, status=1)
        assert 'no file "t.0002.exr"' in ran.err and "2 missing, 2 passed" in ran.out
    assert '"t.#.exr" has frames 1,3-4' in tonetool(*SHOTS, "--hdrflip", status=1).err
    (pair_of_shots / "t.0001.exr").unlink()
    (pair_of_shots / "t.0003.exr").unlink()
    ran = tonetool(*SHOTS, FLIP, "--json", "c.json", status=1)
    assert "r.1-3#.exr t.4#.exr" in ran.err


def test_ranges_of_equal_length_pair_by_position(tonetool, pair_of_shots):
    for frame in (1, 2, 3):
        (pair_of_shots / f"t.{frame:04d}.exr").rename(pair_of_shots / f"t.{100 + frame:04d}.exr")
    words = ["r.1-3#.exr", "t.101-103#.exr", FLIP]
    ran = tonetool(*words, "--json", "c.json", "--csv", "c.csv", "--junit", "c.xml", status=3)
    assert "worst: frame 2 (test 102) (hdrflip: " in ran.out
    found = json.loads((pair_of_shots / "c.json").read_text(encoding="utf-8"))["frames"]
    assert [(f["frame"], f["test_frame"], f["test"]) for f in found] == [
        (n, 100 + n, f"t.010{n}.exr") for n in (1, 2, 3)]
    assert (pair_of_shots / "c.csv").read_text(encoding="utf-8").splitlines()[2].startswith(
        "2,,102,failed")
    assert 'name="frame 0002 (test 0102)"' in (pair_of_shots / "c.xml").read_text(encoding="utf-8")
    assert "worst: frame 2 (test 102)" in tonetool(*words, status=3).out
    tonetool("--merge", "c.json", "--json", "m.json", status=3)
    assert (pair_of_shots / "m.json").read_bytes() == (pair_of_shots / "c.json").read_bytes()


def test_a_range_in_one_name_says_what_it_leaves_out(tonetool, pair_of_shots):
    said = ('tonetool WARNING: "r.#.exr" also has frame 3, which the range of "t.1-2#.exr" leaves out '
            "(valid: --frames 1-2 if that is meant")
    passes = "--hdrflip:fail=max=0.999"
    assert said in tonetool("r.#.exr", "t.1-2#.exr", passes).err
    assert said in tonetool("--dry-run", "r.#.exr", "t.1-2#.exr", passes).err
    tonetool("--warnings-exit", "r.#.exr", "t.1-2#.exr", passes, status=2)
    ran = tonetool("r.1-2#.exr", "t.#.exr", "--against")
    assert '"t.#.exr" also has frame 3' in ran.err
    for words in (["r.1-2#.exr", "t.1-2#.exr"], ["--frames", "1-2", *SHOTS]):
        assert tonetool("--warnings-exit", *words, passes).err == ""


@pytest.mark.parametrize("command", [FLIP, "--against", "--diff", "--hdrflip"])
def test_a_shot_against_itself_is_no_check(tonetool, pair_of_shots, command):
    """By name or links; links of some frames, as of those that were not rendered again, are a warning."""
    words = ["r.#.exr", "./r.#.exr", command, "--json", "c.json"]
    told = 'in all 3 frames "{}" and "{}" are the same file (valid: the names of two versions)'
    assert told.format(*words) in tonetool(*words, status=1).err
    ran = tonetool("--frames", "2", *words, status=1)  # a task of a farm
    assert "are the same file (valid: the names of two versions)" in ran.err
    assert "check: error, 1 frame: 1 error" in ran.out
    for number in (1, 2, 3):
        (pair_of_shots / f"t.{number:04d}.exr").unlink()
        (pair_of_shots / f"t.{number:04d}.exr").symlink_to(f"r.{number:04d}.exr")
    assert told.format(*SHOTS) in tonetool(*SHOTS, command, "--json", "c.json", status=1).err
    (pair_of_shots / "t.0003.exr").unlink()
    shutil.copy(pair_of_shots / "r.0003.exr", pair_of_shots / "t.0003.exr")
    ran = tonetool(*SHOTS, command, "--json", "c.json")
    assert "are the same file" in ran.err and "2 warnings" in ran.out


def test_files_on_the_disk_are_names(tonetool, pair_of_shots, make_image):
    os.mkfifo(pair_of_shots / "t.0004.exr")
    make_image("r.0004.exr")
    ran = tonetool(*SHOTS, FLIP, "--json", "c.json", status=1)
    assert "is a pipe" in ran.err and "1 unreadable, 1 failed, 2 passed" in ran.out
    make_image("e.{1+1}.0001.exr", seed=3)
    make_image("e.2.0001.exr", seed=4)
    assert tonetool("e.{1+1}.#.exr", "--echo", "{TOP.filename}").out == "./e.{1+1}.0001.exr\n"
    for name in ("p+q", "ppq", "p.q"):
        make_image(f"{name}.0001.exr")
    assert tonetool("p+q.#.exr", "--echo", "{TOP.filename}").out == "./p+q.0001.exr\n"
    make_image("u.-001.exr")
    make_image("v.-0001.exr")
    ran = tonetool("u.#.exr", "v.#.exr", FLIP)
    assert "check: passed, 1 frame" in ran.out
    tonetool("--frames", "-1-0", "u.#.exr", "v.#.exr", FLIP, status=1)
    make_image("u.-0001.exr")
    assert "are both frame -1" in tonetool("u.#.exr", "v.#.exr", FLIP, status=1).err
    make_image("v.7.exr")
    assert "v.7.exr\" has fewer digits" in tonetool("v.#.exr", "v.#.exr", "--diff", status=1).err


@pytest.fixture
def views(make_image, tmp_path):
    """r.left.0001.exr and r.right.0001.exr, and as many tests, of which the right one is another."""
    for view, seed in (("left", 1), ("right", 2)):
        make_image(f"r.{view}.0001.exr", seed=seed)
        make_image(f"t.{view}.0001.exr", seed=1)
    return tmp_path


@pytest.mark.usefixtures("views")
@pytest.mark.parametrize("number", ["#", "0001"])
@pytest.mark.parametrize("asked", ["left,rihgt", "rihgt,left"])
def test_a_view_without_a_file_is_missing(tonetool, number, asked):
    words = [f"r.%V.{number}.exr", f"t.%V.{number}.exr", FLIP]
    ran = tonetool("--views", asked, *words, status=1)
    assert "rihgt" in ran.err and "1 missing, 1 passed" in ran.out
    assert "check: passed, 1 frame" in tonetool("--views", "left", *words).out
    assert "1 failed, 1 passed" in tonetool(*words, status=3).out


def test_a_view_that_all_lack_is_missing(tonetool, views):
    for name in "rt":
        (views / f"{name}.right.0001.exr").unlink()
    ran = tonetool("r.%V.#.exr", "t.%V.#.exr", FLIP, status=1)
    assert 'no file "r.right.0001.exr"' in ran.err


@pytest.mark.usefixtures("views")
@pytest.mark.parametrize("asked, words, text", [
    ("left,right", ["r.left.#.exr", "t.left.#.exr"], "no image that is read has a view"),
    ("left,right", ["r.left.0001.exr", "t.left.0001.exr"], "no image that is read has a view"),
    ("left,left", ["r.%V.1#.exr", "t.%V.1#.exr"], "is there twice"),
    ("left,", ["r.%V.#.exr", "t.%V.#.exr"], "a view has no name"),
])
def test_views_that_hold_for_nothing(tonetool, asked, words, text):
    ran = tonetool("--views", asked, *words, FLIP, status=1)
    assert f"--views {asked}: " in ran.err and text in ran.err and "check:" not in ran.out


def test_two_views_of_one_file(tonetool, make_image):
    for name in "rt":
        make_image(f"{name}_l.0001.exr")
    words = ["r_%v.#.exr", "t_%v.#.exr", FLIP]
    ran = tonetool("--views", "left,lower", *words, status=1)
    assert "is the file of two views, left and lower" in ran.err and "check:" not in ran.out
    tonetool("--views", "left", *words)


def test_two_numbers_are_no_step(tonetool, pair_of_shots, make_image):
    for name in "rt":
        (pair_of_shots / f"{name}.0002.exr").unlink()
    ran = tonetool(*SHOTS, FLIP, status=1)
    assert 'no file "r.0002.exr"' in ran.err and "1 missing, 2 passed" in ran.out
    (pair_of_shots / "t.0003.exr").unlink()
    assert "2 missing, 1 passed" in tonetool(*SHOTS, FLIP, status=1).out
    tonetool("--frames", "1", *SHOTS, FLIP)
    for name, frame in (("t", 3), ("r", 5), ("t", 5)):
        make_image(f"{name}.{frame:04d}.exr", seed=frame)
    assert "check: passed, 3 frames" in tonetool(*SHOTS, FLIP).out


MADE = ["--create", "4x4", "3", "--create", "4x4", "3",
        "--hdrflip:fail=0.1:print=0:startExposure=0:stopExposure=1"]


@pytest.mark.parametrize("more", [[], ["-o", "map.#.exr"], ["-o", "map.{FRAME_NUMBER}.exr"],
                                  ["--echo", "{FRAME_NUMBER}"], ["--json", "{FRAME_NUMBER}.json"]])
def test_frames_of_which_nothing_depends_on_the_frame(tonetool, tmp_path, more):
    ran = tonetool("--frames", "1-3", *MADE, *more, status=1)
    assert "nothing that makes an image depends on the frame" in ran.err
    assert "check:" not in ran.out and not list(tmp_path.iterdir())


def test_frames_that_an_expression_makes(tonetool):
    ran = tonetool("--frames", "1-3", *MADE[:3], "--addc", "{FRAME_NUMBER}", *MADE[3:6], "--addc",
                   "{FRAME_NUMBER}", MADE[6])
    assert "check: passed, 3 frames" in ran.out


@pytest.mark.usefixtures("pair_of_shots")
@pytest.mark.parametrize("more", [["-o", "map.{FRAME_NUMBER}.exr"], ["--echo", "{FRAME_NUMBER}"],
                                  ["--if", "{1+1}", "--endif"]])
def test_an_expression_that_makes_no_image_excuses_no_stills(tonetool, more):
    ran = tonetool("--frames", "1-3", "r.0001.exr", "t.0001.exr", FLIP, *more, status=1)
    assert "no image that is read has a wildcard" in ran.err and "check:" not in ran.out


def test_two_files_of_one_number_are_seen_beside_a_range_too(tonetool, make_image):
    for name in ("r.1", "r.2", "t.1", "t.2"):
        make_image(f"{name}.exr")
    words = ["r.@.exr", "t.@.exr", FLIP]
    tonetool("--frames", "1-2", *words)
    make_image("r.0001.exr", seed=9)
    for numbers in (["--frames", "1-2"], []):
        ran = tonetool(*numbers, *words, status=1)
        assert "are both frame 1" in ran.err and "check:" not in ran.out
    assert "are both frame 1" in tonetool("r.1-2@.exr", *words[1:], status=1).err
    tonetool("--frames", "2", *words)


@pytest.mark.parametrize("command", ["json", "csv", "junit", "report", "contactsheet",
                                     "statistics"])
@pytest.mark.parametrize("file", ["t.0001.exr", "./t.0001.exr", "link.exr", "hard.exr"])
def test_what_is_written_at_the_end_is_no_input(tonetool, pair_of_shots, command, file):
    (pair_of_shots / "link.exr").symlink_to("t.0001.exr")
    os.link(pair_of_shots / "t.0001.exr", pair_of_shots / "hard.exr")
    before = (pair_of_shots / "t.0001.exr").read_bytes()
    for words in (SHOTS, ["r.0001.exr", "t.0001.exr"]):
        ran = tonetool(*words, FLIP + ":exposures=shot", f"--{command}", file, status=1)
        assert f'--{command}: "{file}" is ' in ran.err and "written over" in ran.err
        assert "check:" not in ran.out and (pair_of_shots / "t.0001.exr").read_bytes() == before


@pytest.mark.usefixtures("pair_of_shots")
def test_what_is_written_at_the_end_is_no_output_and_no_other_file_that_is_read(tonetool, tmp_path):
    pair = ["--frames", "1", *SHOTS, FLIP]
    assert "is written as an image, too" in tonetool(*pair, "-o", "map.1.exr", "--contactsheet",
                                                     "map.1.exr", status=1).err
    tonetool(*pair, "--json", "a.json")
    assert "is read, and" in tonetool("--merge", "a.json", "--json", "./a.json", status=1).err
    shot = ["--frames", "1", *SHOTS, FLIP + ":exposures=a.json"]
    tonetool("--frames", "1", *SHOTS, FLIP + ":exposures=shot", "--json", "a.json")
    assert "is read, and" in tonetool(*shot, "--csv", "a.json", status=1).err
    tonetool(*shot, "--json", "a.json")
    (tmp_path / "a.tone").write_text("no recipe", encoding="ascii")
    assert "is read, and" in tonetool(*pair, "--colorconfig", "a.tone", "--csv", "a.tone",
                                      status=1).err


@pytest.mark.usefixtures("pair_of_shots")
def test_a_dry_run_writes_nothing_and_has_the_verdict(tonetool, tmp_path):
    before = sorted(tmp_path.rglob("*"))
    files = ["--json", "c.json", "--csv", "c.csv", "--junit", "c.xml", "--report", "c.html",
             "--contactsheet", "c.png", "--pictures", "p", "--state", "s"]
    for words in (["-n", *SHOTS, FLIP, *files, "-o", "map.#.exr"], [*SHOTS, FLIP, *files, "-n"]):
        ran = tonetool(*words, status=3)
        assert "check: failed, 3 frames: 1 failed, 2 passed" in ran.out
        assert sorted(tmp_path.rglob("*")) == before
    tonetool("-n", *SHOTS, FLIP + ":exposures=shot", "--statistics", "range.json")
    assert sorted(tmp_path.rglob("*")) == before
    assert json.loads(tonetool("-n", *SHOTS, FLIP, "--json", "-", status=3).out)["frames"]
    tonetool(*SHOTS, FLIP, "--json", "part.json", status=3)
    tonetool("-n", "--merge", "part.json", "--json", "whole.json", status=3)
    assert not (tmp_path / "whole.json").exists()


@pytest.mark.usefixtures("pair_of_shots")
@pytest.mark.parametrize("command", ["json", "csv", "junit", "report", "contactsheet", "pictures",
                                     "state", "statistics"])
def test_a_file_without_a_name_is_refused_before_the_work(tonetool, command):
    for words in ([f"--{command}="], [f"--{command}", ""]):
        ran = tonetool(*SHOTS, FLIP + ":exposures=shot", *words, status=1)
        assert f"--{command}: " in ran.err and "is empty (valid: a name" in ran.err
        assert "check:" not in ran.out


def test_exposures_of_other_files_are_warned_of(tonetool, pair_of_shots, make_image):
    tonetool(*SHOTS, "--hdrflip:exposures=shot", "--statistics", "range.json")
    tonetool("--warnings-exit", "--frames", "1", *SHOTS, FLIP + ":exposures=range.json")
    tonetool("--warnings-exit", f"{pair_of_shots}/r.#.exr", "t.#.exr",
             FLIP + ":exposures=range.json:quantity=p99", status=3)
    make_image("x.0001.exr")
    ran = tonetool("--warnings-exit", "--frames", "1", "x.#.exr", "t.#.exr",
                   FLIP + ":exposures=range.json", status=2)
    assert '"x.0001.exr" is not among them' in ran.err
    tonetool("--warnings-exit", "x.0001.exr", "t.0001.exr", FLIP + ":exposures=range.json",
             status=2)


@pytest.mark.usefixtures("pair_of_shots")
def test_values_behind_an_equals_sign_and_results_on_the_standard_output(tonetool):
    words = ["--frames=1,3", "--jobs=2", *SHOTS, FLIP]
    ran = tonetool(*words, "--json", "-")
    assert json.loads(ran.out)["counts"]["passed"] == 2 and "check: passed" in ran.err
    assert tonetool(*words, "--csv=-").out.startswith("frame,")
    assert tonetool(*words, "--junit", "-").out.startswith("<?xml")
    assert "has the standard output already" in tonetool(*words, "--json", "-", "--csv", "-",
                                                         status=1).err
    assert "takes texts alone" in tonetool(*words, "--report", "-", status=1).err
    assert tonetool("--echo", "--frames=1", "--echo", "x").out == "--frames=1\nx\n"
    with open("/dev/full", "w", encoding="ascii") as full:
        assert "standard output" in tonetool(*words, "--json", "-", status=1, stdout=full).err


# ---- one shot by two names

@pytest.mark.parametrize("command", [FLIP, "--hdrflip", "--against"])
def test_a_shot_against_links_to_it(tonetool, pair_of_shots, command):
    shot = pair_of_shots
    (shot / "latest").symlink_to(".")
    for other in ("latest/r.#.exr", f"{shot}/r.#.exr"):
        ran = tonetool("r.#.exr", other, command, status=1)
        assert f'frames "r.#.exr" and "{other}" are the same file (valid: the names of two versions)' in ran.err
    # A version may share frames that did not change.
    (shot / "v2").mkdir()
    for file in shot.glob("r.*.exr"):
        (shot / "v2" / file.name).symlink_to(f"../{file.name}")
    first = sorted((shot / "v2").iterdir())[0]
    shutil.copy(first.resolve(), shot / "copy.exr")
    first.unlink()
    (shot / "copy.exr").rename(first)
    assert "are the same file" in tonetool("r.#.exr", "v2/r.#.exr", command).err


def test_parts_and_layers_of_one_file_are_compared(tonetool, pair_of_shots, command="--hdrflip:fail=0.9"):
    shot = pair_of_shots
    for number in (1, 2, 3):
        tonetool(f"r.{number:04}.exr", f"t.{number:04}.exr", "--siappend", "-o", f"p.{number:04}.exr")
    words = ["p.#.exr", "--subimage", "0", "p.#.exr", "--subimage", "1"]
    ran = tonetool(*words, command)
    assert "check: passed, 3 frames: 3 passed" in ran.out and ran.err == ""
    tonetool(*words, "--against", "--exit-zero", "--json", "c.json")
    assert all(frame["status"] != "error" for frame in json.loads((shot / "c.json").read_text())["frames"])
    ran = tonetool("p.#.exr", "--subimage", "1", "p.#.exr", "--subimage", "1", command, status=1)
    assert "are the same file" in ran.err


def test_an_error_map_in_the_place_of_its_reference(tonetool, pair_of_shots):
    before = {file: file.read_bytes() for file in pair_of_shots.glob("*.exr")}
    (pair_of_shots / "link.exr").symlink_to("r.0001.exr")
    told = "is read by this line, and what a comparison has made would be written over it"
    for words in (["r.#.exr", "t.#.exr", "--hdrflip", "-o", "r.#.exr"],
                  ["r.0001.exr", "t.0001.exr", "--hdrflip", "-o", "t.0001.exr"],
                  ["r.0001.exr", "t.0001.exr", "--hdrflip", "-o", "link.exr"],
                  ["r.0001.exr", "t.0001.exr", "--hdrflip", "--colormap", "magma", "-o", "./r.0001.exr"]):
        assert told in tonetool(*words, status=1).err
    assert all(file.read_bytes() == data for file, data in before.items())
    tonetool("r.0001.exr", "t.0001.exr", "--hdrflip", "--pop", "r.0001.exr", "--mulc", "2", "-o", "r.0001.exr")


def test_limits_are_not_written_over_by_what_they_judge(tonetool, pair_of_shots):
    tonetool("r.#.exr", "t.#.exr", "--hdrflip:fail=0.99", "--json", "limits.json")
    before = (pair_of_shots / "limits.json").read_bytes()
    for key in ("fail", "warn"):
        ran = tonetool("r.#.exr", "t.#.exr", f"--hdrflip:{key}=limits.json", "--json", "./limits.json", status=1)
        assert "is read, and would be written over" in ran.err
    assert (pair_of_shots / "limits.json").read_bytes() == before
    tonetool("r.#.exr", "t.#.exr", "--hdrflip:fail=limits.json", "--json", "today.json")


# ---- gaps

def test_a_gap_in_what_is_only_converted_is_told(tonetool, pair_of_shots):
    shutil.copy(pair_of_shots / "t.0003.exr", pair_of_shots / "t.0006.exr")
    ran = tonetool("t.#.exr", "--mulc", "2", "-o", "o.#.exr")
    assert ran.err == ('tonetool WARNING: "t.#.exr" has no frames 4-5 (valid: --frames 1-3,6 if that is meant, '
                       "--frames 1-6 where a missing frame is an error)\n")
    tonetool("t.#.exr", "--mulc", "2", "-o", "o.#.exr", "--warnings-exit", status=2)
    for words in (["--frames", "1-3,6", "t.#.exr"], ["--compat", "t.#.exr"], ["r.#.exr"]):
        assert tonetool(*words, "--mulc", "2", "-o", "o.#.exr").err == ""
    ran = tonetool("t.#.exr", "r.#.exr", "--hdrflip", status=1)
    assert ": it lacks frame 6 (valid: --frames with numbers that both have)" in ran.err
