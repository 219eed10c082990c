# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C, TERM and HUP in a check: nothing new begins, no result is written, what is kept is said, and the same
command goes on."""

import json
import os
import re
import signal
import subprocess
import time

import numpy as np
import pytest

FLIP = "--hdrflip:fail=p99.9=0.9:print=0"
FRAMES = 24
WIDTH, HEIGHT = 256, 144
SIGNALS = [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]


@pytest.fixture
def shot(make_image, tmp_path):
    """Frames that take a while: some hundredths of a second each."""
    pixels = np.random.default_rng(1).random((HEIGHT, WIDTH, 3))
    make_image("r.exr", WIDTH, HEIGHT, pixels=pixels)
    make_image("t.exr", WIDTH, HEIGHT, pixels=pixels * 1.01)
    for number in range(1, FRAMES + 1):
        for side in "rt":
            (tmp_path / f"{side}.{number:04d}.exr").write_bytes((tmp_path / f"{side}.exr").read_bytes())
    time.sleep(0.05)  # files older than the run
    return tmp_path


def begin(program, folder, *words):
    return subprocess.Popen([program, "r.#.exr", "t.#.exr", FLIP, *words], cwd=folder, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def until_some_are_kept(process, state, count=3):
    end = time.monotonic() + 60
    while len(list(state.glob("[a-z]*.json"))) < count and process.poll() is None:
        assert time.monotonic() < end
        time.sleep(0.01)
    assert process.poll() is None, "the run was over before it could be interrupted"


def stamps_of(state):
    """When the result of each frame was written."""
    return {file.name: file.stat().st_mtime_ns for file in state.glob("frame.*.json")}


def children_of(process):
    listed = subprocess.run(["ps", "--ppid", str(process.pid), "-o", "pid="], capture_output=True,
                            text=True, check=False).stdout
    return [int(word) for word in listed.split()]


def is_running(number):
    try:
        with open(f"/proc/{number}/stat", encoding="utf-8") as stat:
            return stat.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize("jobs", ["1", "2"])
@pytest.mark.parametrize("number, status", SIGNALS)
def test_what_is_kept_is_said_and_the_same_command_goes_on(program, shot, number, status, jobs):
    words = ["--jobs", jobs, "--state", "st", "--json", "c.json", "--report", "c.html", "-o",
             "map.#.exr"]
    with begin(program, shot, *words) as process:
        until_some_are_kept(process, shot / "st")
        workers = children_of(process)
        process.send_signal(number)
        out, err = process.communicate(timeout=60)
    assert process.returncode == status, (out, err)
    kept = int(re.search(rf"^tonetool: (\d+) of {FRAMES} frames kept in st; the same command goes on$",
                         err, re.M).group(1))
    # A frame whose pictures were not taken yet is checked anew.
    files = len(list((shot / "st").glob("frame.*.json")))
    assert files - int(jobs) <= kept <= files and 1 <= kept < FRAMES
    assert "check: " not in out and "ERROR" not in err and "crashed" not in err
    assert len(workers) == int(jobs) and not any(map(is_running, workers))
    assert not {"c.json", "c.html"} & set(os.listdir(shot))
    assert [file for file in shot.rglob(".*") if file.is_file()] == []
    before = stamps_of(shot / "st")
    with begin(program, shot, *words, "-v") as process:
        out, err = process.communicate(timeout=120)
    assert process.returncode == 0, (out, err)
    assert len(re.findall(r"^frame \d+: passed, ", err, re.M)) == FRAMES
    again = stamps_of(shot / "st")
    assert sum(again[name] == stamp for name, stamp in before.items()) >= kept
    assert json.loads((shot / "c.json").read_text())["counts"]["passed"] == FRAMES


def test_a_second_signal_ends_it_at_once(program, shot):
    with begin(program, shot, "--state", "st", "--json", "c.json") as process:
        until_some_are_kept(process, shot / "st", 1)
        for worker in children_of(process):
            os.kill(worker, signal.SIGSTOP)  # as one that waits for a file server
        workers = children_of(process)
        process.send_signal(signal.SIGINT)
        time.sleep(0.3)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        process.wait(timeout=20)
        for worker in workers:
            os.kill(worker, signal.SIGCONT)
    assert process.returncode == -signal.SIGINT


def test_without_a_state_nothing_is_kept(program, shot):
    with begin(program, shot, "--json", "c.json", "-v") as process:
        assert process.stderr.readline().startswith("frame 1: passed")
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert err.splitlines()[-1] == "tonetool: interrupted, nothing is kept (valid: --state DIR)"
    assert not (shot / "c.json").exists()


def test_while_the_exposures_are_measured(program, shot):
    words = ["--hdrflip:exposures=shot:fail=p99.9=0.9", "--state", "st", "--json", "c.json"]
    with subprocess.Popen([program, "r.#.exr", "t.#.exr", *words], cwd=shot, text=True,
                          stderr=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        until_some_are_kept(process, shot / "st", 2)
        process.send_signal(signal.SIGTERM)
        _, err = process.communicate(timeout=60)
    assert process.returncode == 143
    assert re.search(rf"^tonetool: the exposures of \d+ of {FRAMES} frames kept in st; the same", err, re.M)
    assert not list((shot / "st").glob("frame.*.json"))


@pytest.mark.parametrize("turn", range(10))
def test_at_any_moment_to_the_whole_group(program, shot, turn):
    """As a terminal sends it: the workers get it, too."""
    with subprocess.Popen([program, "--jobs", "2", "r.#.exr", "t.#.exr", FLIP, "--state", "st", "--json",
                           "c.json"], cwd=shot, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, start_new_session=True) as process:
        time.sleep(float(np.random.default_rng(turn).random()) * 0.8)
        os.killpg(process.pid, signal.SIGINT)
        _, err = process.communicate(timeout=60)
    assert process.returncode in (130, -signal.SIGINT, 0)  # in the loop, around it, after it
    assert "crashed" not in err and "ERROR" not in err
    assert (process.returncode == 130) == ("kept in st" in err)
    assert [file for file in shot.rglob(".*") if file.is_file()] == []


def test_nohup(program, shot):
    with subprocess.Popen(["nohup", program, "--frames", "1-4", "r.#.exr", "t.#.exr", FLIP, "--state", "st",
                           "--json", "c.json"], cwd=shot, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        until_some_are_kept(process, shot / "st", 1)
        process.send_signal(signal.SIGHUP)
        assert process.wait(timeout=60) == 0
    assert (shot / "c.json").exists()
