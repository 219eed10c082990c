"""--diff and --pdiff where oiiotool lets pass what nobody means to let pass. Their other verdicts
are compared with oiiotool's in differential/."""

import itertools
import json

import numpy as np
import pytest

NUMBERS = np.random.default_rng(1).random((12, 16, 3))
KINDS = {"numbers": NUMBERS, "nan": NUMBERS * np.nan, "inf": NUMBERS + np.inf,
         "minus": NUMBERS - np.inf}


@pytest.fixture
def kinds(make_image):
    """Images of which one has numbers and the others have none."""
    return {name: make_image(f"{name}.exr", pixels=pixels) for name, pixels in KINDS.items()}


@pytest.mark.parametrize("mode", [[], ["--compat"]])
@pytest.mark.parametrize("command", ["--diff", "--pdiff"])
@pytest.mark.parametrize("a, b", itertools.permutations(KINDS, 2))
def test_images_without_numbers_are_no_match(tonetool, kinds, mode, command, a, b):
    ran = tonetool(*mode, "--fail", "1e30", "--failpercent", "99.9", kinds[a], kinds[b], command,
                   status=1)
    assert "FAILURE" in ran.out.splitlines() and "Max error  = inf @ (0, 0, R)" in ran.out
    assert mode or "192 pixel(s) are NaN, Inf or -Inf in one image" in ran.out


@pytest.mark.parametrize("mode", [[], ["--compat"]])
@pytest.mark.parametrize("kind", KINDS)
def test_images_are_equal_to_themselves(tonetool, kinds, mode, kind):
    assert "PASS" in tonetool(*mode, kinds[kind], kinds[kind], "--diff").out.splitlines()


@pytest.mark.parametrize("count", [1, 2, 7])
def test_some_pixels_without_numbers(tonetool, kinds, make_image, count):
    holes = NUMBERS.copy()
    holes.reshape(-1, 3)[5:5 + count, 1] = np.nan
    ran = tonetool(kinds["numbers"], make_image("holes.exr", pixels=holes), "--diff", status=1)
    assert "Max error  = inf @ (5, 0, G)" in ran.out and f"  {count} pixel(s) are NaN" in ran.out
    tonetool("holes.exr", "holes.exr", "--diff")


def test_a_deep_image_is_no_match_for_a_flat_one(tonetool, testimages, make_image):
    for words in ([testimages / "deep.exr", make_image("a.exr")],
                  [make_image("a.exr"), testimages / "deep.exr"]):
        assert "PASS" not in tonetool(*words, "--diff", status=1).out


def test_a_frame_without_numbers_is_a_failed_frame(tonetool, make_image, tmp_path):
    for frame, pixels in ((1, NUMBERS), (2, KINDS["nan"])):
        make_image(f"ref.{frame:04}.exr", pixels=NUMBERS)
        make_image(f"test.{frame:04}.exr", pixels=pixels)
    check = ["ref.#.exr", "test.#.exr", "--diff"]
    tonetool(*check, "--json", "whole.json", status=1)
    for frame in (1, 2):
        tonetool("--frames", frame, *check, "--json", f"part{frame}.json", status=frame - 1)
    tonetool("--merge", "part1.json", "part2.json", "--json", "merged.json", status=3)
    for name in ("whole.json", "merged.json"):
        found = json.loads((tmp_path / name).read_text(encoding="utf-8"))
        assert [frame["status"] for frame in found["frames"]] == ["passed", "failed"]


@pytest.mark.parametrize("limit", ["fail", "failpercent", "hardfail", "warn", "warnpercent",
                                   "hardwarn"])
@pytest.mark.parametrize("words", [["--{} 0.1", "--hdrflip"], ["--hdrflip", "--{} 0.1"],
                                   ["--diff", "--{} 0.1"]])
def test_a_limit_that_holds_nothing_is_an_error(tonetool, kinds, limit, words):
    line = [part for word in words for part in word.format(limit).split()]
    ran = tonetool(kinds["numbers"], kinds["numbers"], *line, status=1)
    assert f"tonetool ERROR: {limit} : no --diff ran after it" in ran.err
    assert "--hdrflip:fail=X" in ran.err


def test_limits_before_a_diff_that_waits_for_its_images(tonetool, kinds):
    tonetool("--fail", "0.1", "--diff", kinds["numbers"], kinds["numbers"])
    tonetool(kinds["numbers"], kinds["numbers"], "--fail", "0.1", "--pdiff", "--fail", "0.2",
             "--diff")
