# SPDX-License-Identifier: BSD-3-Clause
"""A frame that ends the process that reads it is one result of a check, and the others go on."""

import json
import shutil
import signal
import struct
import subprocess
import time

import pytest
from conftest import call

FLIP = "--hdrflip:quantity=p99:fail=0.5:print=0"


def crashing_exr(path):
    """An EXR that is whole, but whose header makes OpenImageIO 2.4 divide by 0."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    width, height = 64, 48
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1)
                        for name in (b"B", b"G", b"R")) + b"\0"
    header = (struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", channels) +
              attribute(b"compression", b"compression", b"\0") +
              attribute(b"dataWindow", b"box2i", window) +
              attribute(b"displayWindow", b"box2i", window) +
              attribute(b"lineOrder", b"lineOrder", b"\0") +
              attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
              attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)) +
              attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) +
              attribute(b"tiff:RowsPerStrip", b"int", struct.pack("<i", 0)) + b"\0")
    size = 3 * 4 * width
    rows = [struct.pack("<ii", y, size) + struct.pack(f"<{3 * width}f", *[0.25] * (3 * width))
            for y in range(height)]
    first = len(header) + 8 * height
    table = b"".join(struct.pack("<Q", first + y * (size + 8)) for y in range(height))
    path.write_bytes(header + table + b"".join(rows))


@pytest.fixture
def shot(program, make_image, tmp_path):
    """Twenty frames; reading the whole of test.0008.exr ends the process."""
    for number in range(1, 21):
        for name in ("ref", "test"):
            make_image(f"{name}.{number:04d}.exr", 64, 48, kind="half")
    crashing_exr(tmp_path / "test.0008.exr")
    crash = call(program, ["ref.0008.exr", "test.0008.exr", "--hdrflip"], tmp_path)  # no check
    if crash.status >= 0:
        pytest.skip("this OpenImageIO reads the file that ends version 2.4")
    return tmp_path


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_frame_that_crashes_is_one_result(tonetool, shot, jobs):
    ran = tonetool("--jobs", jobs, "ref.#.exr", "test.#.exr", FLIP, "--json", "c.json", "--csv",
                   "c.csv", "--junit", "c.xml", "--report", "c.html", status=1)
    found = load(shot / "c.json")
    statuses = {frame["frame"]: frame["status"] for frame in found["frames"]}
    assert statuses == {n: "crashed" if n == 8 else "passed" for n in range(1, 21)}
    assert found["verdict"] == "crashed" and found["worst"] == [{"frame": 8}]
    crashed = found["frames"][7]
    assert "SIG" in crashed["message"] and crashed["test"] == "test.0008.exr"
    assert "1 crashed, 19 passed; worst: frame 8" in ran.out
    assert 'errors="1"' in (shot / "c.xml").read_text()
    assert (shot / "c.html").exists()


def test_the_same_bytes_however_many_processes(tonetool, shot):
    for jobs in ("1", "3"):
        tonetool("--jobs", jobs, "ref.#.exr", "test.#.exr", FLIP.replace("print=0", "print=1"),
                 "--json", f"{jobs}.json", "--state", f"s{jobs}", status=1)
    assert (shot / "1.json").read_bytes() == (shot / "3.json").read_bytes()


def test_a_run_that_goes_on_tries_the_frame_again(tonetool, shot, make_image):
    words = ["ref.#.exr", "test.#.exr", FLIP, "--json", "c.json", "--state", "s"]
    tonetool(*words, status=1)
    tonetool(*words, status=1)
    make_image("test.0008.exr", 64, 48, kind="half")
    tonetool(*words)
    assert load(shot / "c.json")["counts"]["passed"] == 20


def test_exposures_of_the_shot_are_measured_past_it(tonetool, shot):
    tonetool("ref.#.exr", "test.#.exr", FLIP + ":exposures=shot", "--json", "c.json", status=1)
    counts = load(shot / "c.json")["counts"]
    assert (counts["crashed"], counts["passed"]) == (1, 19)
    shutil.copy(shot / "test.0008.exr", shot / "ref.0008.exr")
    ran = tonetool("ref.#.exr", "test.#.exr", FLIP + ":exposures=shot", "--statistics", "r.json",
                   status=1)
    assert "frame 8" in ran.err
    assert len(load(shot / "r.json")["samples"]) == 19


def test_qc_and_pairs_too(tonetool, shot):
    tonetool("--frames", "7-9", "test.#.exr", "--qc", "--json", "q.json", status=1)
    frames = load(shot / "q.json")["frames"]
    assert [f["status"] == "crashed" for f in frames] == [False, True, False]
    assert all(("qc" in f) == (f["frame"] != 8) for f in frames)
    tonetool("ref.0008.exr", "test.0008.exr", FLIP, "--json", "p.json", status=1)
    assert load(shot / "p.json")["verdict"] == "crashed"


def test_what_a_crash_has_begun_to_write_is_removed(tonetool, shot):
    tonetool("--frames", "7-9", "ref.#.exr", "test.#.exr", FLIP, "-o", "map.#.exr", "--json",
             "c.json", status=1)
    assert sorted(p.name for p in shot.iterdir() if p.name.startswith((".", "map"))) == \
        ["map.0007.exr", "map.0009.exr"]


# ---- errors of one frame that are not its files'

@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_state_that_cannot_be_written_loses_no_result(tonetool, make_image, tmp_path, jobs):
    for number in (1, 2, 3):
        make_image(f"a.{number:04d}.exr")
        make_image(f"b.{number:04d}.exr")
    (tmp_path / "s").mkdir()
    (tmp_path / "s" / "frame.0002.json").mkdir()  # also root cannot write it
    ran = tonetool("--jobs", jobs, "a.#.exr", "b.#.exr", FLIP, "--json", "c.json", "--state", "s",
                   status=1)
    frames = load(tmp_path / "c.json")["frames"]
    assert [frame["status"] for frame in frames] == ["passed", "passed", "passed"]
    assert "--state: " in ran.err and "frame.0002.json" in ran.err
    assert frames[1]["measurements"][0]["status"] == "passed"


def test_pictures_that_cannot_be_kept_lose_no_result(tonetool, make_image, tmp_path):
    for number in (1, 2):
        make_image(f"a.{number:04d}.exr")
        make_image(f"b.{number:04d}.exr")
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "0001.small.json").symlink_to("elsewhere.json")
    ran = tonetool("a.#.exr", "b.#.exr", FLIP, "--json", "c.json", "--pictures", "p", status=1)
    assert [f["status"] for f in load(tmp_path / "c.json")["frames"]] == ["passed", "passed"]
    assert "0001.small.json" in ran.err
    assert not (tmp_path / "p" / "elsewhere.json").exists()


def test_the_verdict_comes_before_the_files_and_each_that_can_be_is_written(tonetool, make_image,
                                                                            tmp_path):
    make_image("a.exr")
    (tmp_path / "full.csv").symlink_to("/dev/full")
    ran = tonetool("a.exr", "a.exr", FLIP, "--csv", "full.csv", "--json", "c.json", "--junit",
                   "c.xml", status=1)
    assert "check: " in ran.out and "full.csv" in ran.err
    assert load(tmp_path / "c.json")["verdict"] in ("passed", "warning")
    assert (tmp_path / "c.xml").exists()


def test_each_file_that_is_not_written_is_a_line(tonetool, make_image, tmp_path):
    make_image("a.exr")
    make_image("b.exr", seed=2)
    results = {"--csv": "c.csv", "--junit": "c.xml", "--report": "c.html", "--bad-frames": "bad.txt"}
    for name in results.values():
        (tmp_path / name).symlink_to("/dev/full")
    ran = tonetool("a.exr", "b.exr", "--hdrflip:fail=0.01:print=0", *(word for item in results.items() for word in item),
                   "--json", "c.json", status=1)
    assert ran.out.splitlines()[-1].startswith("check: failed")
    errors = [line for line in ran.err.splitlines() if line.startswith("tonetool ERROR")]
    assert len(errors) == 4 and all(any(name in line for line in errors) for name in results.values())
    assert load(tmp_path / "c.json")["verdict"] == "failed"


def test_the_workers_end_with_the_program(program, shot):
    with subprocess.Popen([program, "--jobs", "2", "ref.#.exr", "test.#.exr", FLIP, "-o",
                           "map.#.exr", "--json", "c.json"], cwd=shot, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        time.sleep(0.4)
        process.send_signal(signal.SIGKILL)
        process.wait()
    time.sleep(0.2)
    running = subprocess.run(["pgrep", "-f", str(program) + ".*--jobs 2 ref.#.exr"],
                             capture_output=True, check=False)
    assert running.stdout == b""
    assert [p.name for p in shot.iterdir() if p.name.startswith(".")] == []


# ---- what a result follows from

def test_the_state_sees_what_stands_behind_words(tonetool, make_image, tmp_path):
    make_image("ref.exr", seed=1)
    make_image("bad.exr", seed=2)
    (tmp_path / "in.tone").write_text("tonetool 1\nf.1.exr\n")
    (tmp_path / "out.tone").write_text("tonetool 1\nin.tone\n")
    for number, name in enumerate(("f.{1}.exr", "in.tone", "out.tone", "out.tone?a=b", "f.1.exr")):
        (tmp_path / "out.tone").write_text("tonetool 1\n$a = c\nin.tone\n")
        (tmp_path / "f.1.exr").write_bytes((tmp_path / "ref.exr").read_bytes())
        words = ["ref.exr", name, "--hdrflip:fail=0.01:print=0", "--json", "c.json", "--state",
                 f"s{number}"]
        time.sleep(0.05)  # files older than the run
        tonetool(*words)
        tonetool(*words)
        assert list((tmp_path / f"s{number}").iterdir()), name
        (tmp_path / "f.1.exr").write_bytes((tmp_path / "bad.exr").read_bytes())
        tonetool(*words, status=3)
