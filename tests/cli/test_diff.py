# SPDX-License-Identifier: BSD-3-Clause
"""--diff and --pdiff where oiiotool lets pass what nobody means to let pass. Their other verdicts
are compared with oiiotool's in differential/."""

import itertools
import json

import numpy as np
import OpenImageIO as oiio
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


def changed(channel, value, row=5):
    pixels = np.dstack([NUMBERS, NUMBERS])
    pixels[row, 3, channel] = value
    return pixels


@pytest.mark.parametrize("channel", [3, 5])
def test_a_perceptual_diff_passes_no_channel_that_it_does_not_look_at(tonetool, make_image, channel):
    names = ("R", "G", "B", "A", "Z", "id")
    a = make_image("a.exr", channels=names, pixels=np.dstack([NUMBERS, NUMBERS]))
    b = make_image("b.exr", channels=names, pixels=changed(channel, 0.9))
    ran = tonetool(a, b, "--pdiff", status=1)
    assert "1 pixel(s) differ where --pdiff does not look" in ran.out and "PASS" not in ran.out
    assert "PASS" in tonetool(a, b, "--compat", "--pdiff").out
    tonetool("--failpercent", "1", a, b, "--pdiff")
    assert "1 failed" in tonetool(a, b, "--pdiff", "--json", "x.json", status=1).out
    tonetool(a, "--ch", "R,G,B", b, "--ch", "R,G,B", "--pdiff")


def test_a_perceptual_diff_looks_beside_a_nan(tonetool, make_image):
    images = []
    for name, green in (("a.exr", 0.2), ("b.exr", 0.9)):
        pixels = NUMBERS.copy()
        pixels[5, 3] = np.nan, green, 0.2
        images.append(make_image(name, pixels=pixels))
    ran = tonetool(*images, "--pdiff", status=1)
    assert "1 pixel(s) differ where --pdiff does not look" in ran.out
    tonetool(images[0], images[0], "--pdiff")


@pytest.mark.parametrize("command", ["--diff", "--pdiff"])
@pytest.mark.parametrize("attribute", ["oiio:subimagename", "view"])
def test_parts_of_other_names_are_other_pictures(tonetool, tmp_path, command, attribute):
    for file, names in (("a.exr", ("left", "right")), ("b.exr", ("right", "left"))):
        specs = []
        for part, name in zip("01", names):
            spec = oiio.ImageSpec(16, 12, 3, "float")
            spec.attribute("oiio:subimagename", part)
            spec.attribute(attribute, name)
            specs.append(spec)
        out = oiio.ImageOutput.create(str(tmp_path / file))
        assert out.open(str(tmp_path / file), tuple(specs))
        out.write_image(NUMBERS.astype(np.float32))
        assert out.open(str(tmp_path / file), specs[1], "AppendSubimage")
        out.write_image(NUMBERS.astype(np.float32))
        out.close()
    ran = tonetool("a.exr", "b.exr", command, status=1)
    assert "differ in the names of their parts" in ran.out and "FAILURE" in ran.out
    tonetool("a.exr", "a.exr", command)


def test_what_headers_say_and_nobody_applies_is_said(tonetool, make_image, tmp_path):
    a = make_image("a.hdr")
    text = (tmp_path / a).read_bytes()
    (tmp_path / "b.hdr").write_bytes(text.replace(b"FORMAT=", b"EXPOSURE=2\nFORMAT=", 1))
    ran = tonetool(a, "b.hdr", "--diff", "--warnings-exit", status=2)
    assert "EXPOSURE is 1 in the one and 2 in the other, and is not applied" in ran.err
