# SPDX-License-Identifier: BSD-3-Clause
"""What a render farm asks of a check: which frames to render again (--bad-frames), and an exit status that says
that a task is done (--exit-zero); and that a full disk beside the results loses none of them."""

import json
import os

import pytest

FLIP = "--hdrflip:fail=max=0.9:print=0"


@pytest.fixture
def shot(make_image, tmp_path):
    """Frames 1 to 6; 2, 3 and 6 of the test are wrong, 5 is missing."""
    for number in range(1, 7):
        make_image(f"ref.{number:04}.exr", seed=number)
        if number != 5:
            make_image(f"test.{number:04}.exr", seed=number,
                       pixels=None if number not in (2, 3, 6) else [[[9, 0, 0]] * 16] * 12)
    return ["--frames", "1-6", "ref.#.exr", "test.#.exr"]


def line_of(path):
    return path.read_text(encoding="utf-8")


def test_one_line_that_engines_read(tonetool, shot, tmp_path):
    tonetool(*shot, FLIP, "--bad-frames", "bad.txt", "--json", "all.json", status=1)
    assert line_of(tmp_path / "bad.txt") == "2-3,5-6\n"
    tonetool("--merge", "all.json", "--bad-frames", "again.txt", status=1)
    assert line_of(tmp_path / "again.txt") == "2-3,5-6\n"


def test_standard_output(tonetool, shot):
    ran = tonetool("-q", *shot, FLIP, "--bad-frames", "-", status=1)
    assert ran.out == "2-3,5-6\n"


def test_steps_are_no_ranges(tonetool, make_image, tmp_path):
    for number in (1, 3, 5):
        make_image(f"ref.{number:04}.exr", seed=number)
    tonetool("--frames", "1-5x2", "ref.#.exr", "gone.#.exr", FLIP, "--bad-frames", "bad.txt", status=1)
    assert line_of(tmp_path / "bad.txt") == "1,3,5\n"


def test_nothing_to_render_again_is_an_empty_file(tonetool, shot, tmp_path):
    tonetool("--frames", "1,4", *shot[2:], FLIP, "--bad-frames", "bad.txt")
    assert line_of(tmp_path / "bad.txt") == ""


def test_warnings_count_where_they_are_asked_for(tonetool, shot, tmp_path):
    words = ["--frames", "1-4", *shot[2:], "--hdrflip:warn=max=0.9:print=0"]
    for how, expected in (("", ""), (":from=error", ""), (":from=warning", "2-3\n")):
        tonetool(*words, f"--bad-frames{how}", "bad.txt")
        assert line_of(tmp_path / "bad.txt") == expected
    ran = tonetool(*words, "--bad-frames:from=info", "bad.txt", status=1)
    assert 'from "info"' in ran.err and "error, warning" in ran.err


@pytest.mark.parametrize("words", [[], ["--merge", "all.json"]])
def test_unknown_modifiers(tonetool, shot, tmp_path, words):
    tonetool(*shot, FLIP, "--json", "all.json", status=1)
    ran = tonetool(*(words or [*shot, FLIP]), "--bad-frames:form=warning", "bad.txt", status=1)
    assert '"form"' in ran.err and not (tmp_path / "bad.txt").exists()


def test_numbers_are_those_of_the_test(tonetool, make_image, tmp_path):
    for number in (1, 2):
        make_image(f"a.{number}.exr", seed=number)
        make_image(f"b.{number + 10}.exr", seed=number if number == 1 else 7)
    tonetool("a.1-2#.exr", "b.11-12#.exr", "--framepadding", "1", "--hdrflip:fail=max=0.01:print=0",
             "--bad-frames", "bad.txt", status=3)
    assert line_of(tmp_path / "bad.txt") == "12\n"


def test_two_views_are_one_frame(tonetool, make_image, tmp_path):
    for view in ("left", "right"):
        make_image(f"a.{view}.0001.exr", seed=1)
        make_image(f"b.{view}.0001.exr", seed=2)
    tonetool("a.%V.#.exr", "b.%V.#.exr", "--hdrflip:fail=max=0.01:print=0", "--bad-frames", "bad.txt", status=3)
    assert line_of(tmp_path / "bad.txt") == "1\n"


# ---- exit status of a task

def test_a_finished_task_ends_with_zero(tonetool, shot, tmp_path):
    ran = tonetool(*shot, FLIP, "--exit-zero", "--json", "part.json")
    assert ran.out.splitlines()[-1].startswith("check: missing, 6 frames: ")
    verdict = json.loads((tmp_path / "part.json").read_text(encoding="utf-8"))["verdict"]
    assert verdict == "missing"
    tonetool("--merge", "part.json", "--frames", "1-6", status=1)
    tonetool("--frames", "1-4", *shot[2:], FLIP, "--exit-zero", "--json", "part.json")
    tonetool("--merge", "part.json", "--frames", "1-4", status=3)


def test_what_is_not_written_is_no_finished_task(tonetool, shot, tmp_path):
    ran = tonetool(*shot, FLIP, "--exit-zero", "--json", "part.json", "--csv", "gone/x.csv", status=1)
    assert 'no folder "gone"' in ran.err and not (tmp_path / "part.json").exists()


@pytest.mark.parametrize("words", [["--exit-zero"], ["--exit-zero", "--report", "x.html"]])
def test_only_where_results_say_what_was_found(tonetool, shot, words):
    ran = tonetool(*shot, FLIP, *words, status=1)
    assert "--exit-zero" in ran.err and "--json FILE" in ran.err


def test_a_merge_is_judged(tonetool, shot, tmp_path):
    tonetool(*shot, FLIP, "--exit-zero", "--json", "part.json")
    ran = tonetool("--merge", "part.json", "--exit-zero", "--json", "all.json", status=1)
    assert "without --merge" in ran.err and not (tmp_path / "all.json").exists()


def test_the_results_are_those_of_a_run_without_it(tonetool, shot, tmp_path):
    for name, words in (("a", []), ("b", ["--exit-zero"])):
        tonetool(*shot, FLIP, *words, "--json", f"{name}.json", status=0 if words else 1)
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


# ---- a cache that cannot be written

@pytest.mark.parametrize("zero", [[], ["--exit-zero"]])
def test_a_state_that_cannot_be_kept_loses_no_result(tonetool, shot, tmp_path, zero):
    words = ["--frames", "1,4", *shot[2:], FLIP]
    tonetool(*words, "--json", "plain.json")
    tonetool("--frames", "1", *shot[2:], FLIP, "--state", "st", "--json", "first.json")
    # A folder in the place of a file that is to be written.
    (name,) = [path.name for path in (tmp_path / "st").glob("*.json") if "0001" in path.name]
    (tmp_path / "st" / name.replace("0001", "0004")).mkdir()
    ran = tonetool(*words, *zero, "--state", "st", "--json", "kept.json", status=1)
    assert "check: passed, 2 frames: 2 passed" in ran.out and "--state: " in ran.err
    assert (tmp_path / "kept.json").read_bytes() == (tmp_path / "plain.json").read_bytes()
