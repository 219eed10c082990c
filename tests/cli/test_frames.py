"""The frame loop: wildcards, holes, views, parallel frames, progress; and the language around it."""

import json
import os

import numpy as np
import pytest


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


def test_loops_conditions_and_variables(tonetool):
    ran = tonetool("--for", "i", "0,6,2", "--if", "{i==2}", "--echo", "two", "--else", "--echo",
                   "{i}", "--endif", "--endfor", "--set", "n", "0", "--while", "{n<2}", "--echo",
                   "n{n}", "--set", "n", "{n+1}", "--endwhile")
    assert ran.out.split() == ["0", "two", "4", "n0", "n1"]


@pytest.mark.parametrize("how", ["man", "bash", "zsh"])
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
