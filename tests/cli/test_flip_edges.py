# SPDX-License-Identifier: BSD-3-Clause
"""Edge cases of the FLIP commands: none of them may end as a pass that is not one.

Rows of the table of edge cases of NVIDIA's reference program (what it does with them is in the
design notes; most end there as "all 0, passed") and the tests that say what tonetool does:

  reference median 0 (more than half black)  test_reference_more_than_half_black
  reference median negative                  test_reference_median_negative
  all-black reference                        test_all_black_reference
  NaN as the last pixel of the reference     test_nonfinite_pixel, test_nonfinite_and_auto_exposure
  NaN elsewhere in the reference             the same
  +Inf in the reference                      the same
  NaN or Inf in the test                     the same
  1e30 pixel                                 test_huge_pixel_is_white
  negative test pixel -1                     test_negative_pixel_is_black
  -n 1, 0, negative                          test_one_exposure, test_number_of_exposures
  start only, stop only                      test_one_end_given
  start > stop                               test_exposures_out_of_order
  1x1                                        test_one_pixel
  size mismatch                              test_display_windows_differ
  RGBA, RGB+Z, Y only, R only                test_channels_beside_the_colour, test_no_colour
  uint EXR channel                           test_uint_exr
  ".EXR" upper case                          test_upper_case_extension
  exr reference with png test                test_exr_and_png
  png reference with exr test                the same
  ppd 0                                      test_pixels_per_degree_out_of_range
  ppd 0.1                                    the same; test_smallest_and_largest_ppd
  error map above 1                          test_map_stays_within_0_and_1
  identical images                           test_identical_images_are_exactly_0
  exposure map unset where the error is 0    test_exposure_map_of_equal_pixels

Rows without a test here:
  int overflow    needs an image of more than 715 million pixels: 8 GB for each side; the far
                  apart data windows of test_data_windows_too_far_apart come nearest
  memory          leaks and mismatched frees are for the address sanitizer's build of all tests
"""

import os
import signal as signals
import struct
import subprocess
import time

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import call

HEIGHT, WIDTH = 24, 32
FIRST, CENTRE, LAST = (0, 0), (HEIGHT // 2, WIDTH // 2), (HEIGHT - 1, WIDTH - 1)
FIXED = "startExposure=-2:stopExposure=2:numExposures=3"
COMMANDS = ("hdrflip", "ldrflip", "flipdiff")


def picture(seed=1, height=HEIGHT, width=WIDTH, low=0.05, high=0.9):
    return np.random.default_rng(seed).uniform(low, high, (height, width, 3)).astype(np.float32)


def with_pixel(image, value, at=CENTRE):
    out = image.copy()
    out[at] = value
    return out


def flat(*color, height=HEIGHT, width=WIDTH):
    return np.tile(np.array(color, dtype=np.float32), (height, width, 1))


@pytest.fixture
def put(make_image):
    """Writes the pixels to NAME."""

    def write(name, pixels, channels=("R", "G", "B"), **options):
        height, width, count = pixels.shape
        return make_image(name, width, height, channels[:count], pixels=pixels, **options)

    return write


@pytest.fixture
def outcome(program, tmp_path):
    """Runs the program in tmp_path, where more than one status is right."""
    return lambda *words: call(program, words, tmp_path)


@pytest.fixture
def two(put):
    """Names of two images that differ everywhere."""
    return put("ref.exr", picture(1)), put("test.exr", picture(2))


@pytest.fixture
def map_of(tonetool_v, put, read):
    """The error map of two arrays or files, and what the command said."""

    def compare(reference, test, modifiers=FIXED, command="hdrflip", status=0):
        names = [image if isinstance(image, str) else put(name, image)
                 for image, name in ((reference, "map_ref.exr"), (test, "map_test.exr"))]
        ran = tonetool_v(*names, f"--{command}" + (f":{modifiers}" if modifiers else ""),
                       "-o", "map.exr", status=status)
        return read("map.exr")[0][:, :, 0], ran

    return compare


def write_exr(path, kinds, channels, origin=(0, 0), chromaticities=None):
    """An uncompressed EXR by hand: {name: array}, each as "uint", "half" or "float".

    OpenImageIO's own writer turns integers into half and refuses odd headers.
    """
    names = sorted(channels)
    height, width = channels[names[0]].shape
    code = {"uint": (0, "<u4"), "half": (1, "<f2"), "float": (2, "<f4")}

    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data

    listed = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", code[kinds[name]][0], 0, 1, 1)
                      for name in names) + b"\0"
    x, y = origin
    window = struct.pack("<4i", x, y, x + width - 1, y + height - 1)
    header = struct.pack("<2i", 20000630, 2)
    header += attribute("channels", "chlist", listed)
    if chromaticities:
        header += attribute("chromaticities", "chromaticities",
                            struct.pack("<8f", *chromaticities))
    header += attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    lines = []
    for row in range(height):
        data = b"".join(channels[name][row].astype(code[kinds[name]][1]).tobytes()
                        for name in names)
        lines.append(struct.pack("<2i", y + row, len(data)) + data)
    offsets, at = b"", len(header) + 8 * height
    for line in lines:
        offsets += struct.pack("<Q", at)
        at += len(line)
    path.write_bytes(header + offsets + b"".join(lines))
    return path.name


def rgb_planes(image):
    return dict(zip("RGB", np.moveaxis(image, 2, 0)))


def passes(ran):
    return [line for line in ran.out.splitlines() if "PASS" in line]


# ---- the reference's luminance


def test_reference_more_than_half_black(tonetool_v, put, testimages):
    image = picture()
    image[:, :WIDTH * 5 // 8] = 0
    ref, lit = put("a.exr", image), image[:, WIDTH * 5 // 8:].reshape(-1, 3)
    ran = tonetool_v(ref, put("b.exr", image * 2), "--hdrflip:fail=0.01", status=3)
    luminance = np.sort(lit @ np.float32([0.2126, 0.7152, 0.0722]))
    text = ran.fact("median-luminance")
    assert text.endswith(" of lit pixels")
    assert float(text.split()[0]) == pytest.approx(luminance[len(luminance) // 2], rel=1e-5)
    assert "more than half of the reference is black" in ran.err
    assert np.isfinite([float(word) for word in ran.fact("exposures").split()[1::2]]).all()
    tonetool_v(testimages / "mostly_black.exr", testimages / "plain.exr", "--hdrflip:fail=0.05",
             status=3)


def test_reference_median_negative(tonetool_v, put, map_of):
    image = picture()
    image[:, :WIDTH * 5 // 8] = -1
    black = np.maximum(image, 0)
    got, ran = map_of(image, picture(2), "")
    assert np.array_equal(got, map_of(black, picture(2), "")[0]) and got.max() > 0.1
    assert ran.fact("reference-negative") == str(HEIGHT * (WIDTH * 5 // 8))
    assert ran.fact("median-luminance").endswith(" of lit pixels")
    tonetool_v(put("a.exr", image), put("b.exr", picture(2)), "--hdrflip:fail=0.01", status=3)


@pytest.mark.parametrize("modifiers", ["", "startExposure=0", "stopExposure=0", "numExposures=3",
                                       "numExposures=1", "maxluminance=1", "medianluminance=1"])
def test_all_black_reference(tonetool_v, testimages, modifiers):
    black, plain = testimages / "black.exr", testimages / "plain.exr"
    for test in (plain, black):
        ran = tonetool_v(black, test, ":".join(filter(None, ["--hdrflip:fail=0.9999", modifiers])),
                       status=1)
        assert "the reference is black" in ran.err and not passes(ran)
        for name in ("startExposure", "stopExposure", "maxluminance", "medianluminance"):
            assert name in ran.err


def test_all_black_reference_with_exposures(tonetool_v, testimages):
    black, plain = testimages / "black.exr", testimages / "plain.exr"
    for how in ("startExposure=0:stopExposure=4", "maxluminance=1:medianluminance=0.1"):
        tonetool_v(black, plain, f"--hdrflip:fail=0.1:{how}", status=3)
        tonetool_v(black, black, f"--hdrflip:fail=0:{how}")
    tonetool_v(black, plain, "--ldrflip:fail=0.1", status=3)
    tonetool_v(black, plain, "--flipdiff:fail=0.1", status=3)


@pytest.mark.parametrize("scale", [1e-38, 3e-45, 3e38])
def test_luminance_at_the_ends_of_float(tonetool_v, put, scale):
    ref = put("a.exr", np.full((4, 4, 3), scale, np.float32))
    ran = tonetool_v(ref, put("b.exr", flat(0.5, 0.5, 0.5, height=4, width=4)), "--hdrflip:fail=0.1",
                   status=1)
    assert "exposure" in ran.err and not passes(ran)


# ---- NaN and Inf


@pytest.mark.parametrize("command", ["hdrflip", "ldrflip"])
@pytest.mark.parametrize("side", ["reference", "test"])
@pytest.mark.parametrize("value, at", [
    (np.nan, FIRST), (np.nan, CENTRE), (np.nan, LAST), (np.inf, FIRST), (np.inf, CENTRE),
    (np.inf, LAST), (-np.inf, CENTRE), ((0.5, np.nan, 0.5), CENTRE), ((0.5, 0.5, np.inf), CENTRE)])
def test_nonfinite_pixel(map_of, command, side, at, value):
    """Error exactly 1 there; elsewhere as if the pixel were the other image's."""
    pair = {"reference": picture(1), "test": picture(2)}
    other = pair["test" if side == "reference" else "reference"]
    modifiers = (FIXED + ":fail=0.999:quantity=max:print=1" if command == "hdrflip"
                 else "fail=0.999:quantity=max")
    bad = dict(pair, **{side: with_pixel(pair[side], value, at)})
    got, ran = map_of(bad["reference"], bad["test"], modifiers, command, status=3)
    mended = dict(pair, **{side: with_pixel(pair[side], other[at], at)})
    want, _ = map_of(mended["reference"], mended["test"], modifiers, command)
    assert got[at] == 1 and want[at] != 1
    got[at] = want[at]
    assert np.array_equal(got, want)
    assert ran.fact(f"{side}-nonfinite") == "1" and ran.fact("nonfinite-in-both") == "0"
    assert f"1 pixel(s) of the {side} are NaN or Inf" in ran.err
    assert ran.fact("max") == f"1 at {at[1]},{at[0]}"


@pytest.mark.parametrize("at", [FIRST, CENTRE, LAST], ids=["first", "centre", "last"])
@pytest.mark.parametrize("value", [np.nan, np.inf], ids=["nan", "inf"])
def test_nonfinite_and_auto_exposure(tonetool_v, put, at, value):
    """Exposures come from the finite pixels; identical but for the pixel is still a failure."""
    image = picture()
    ref, bad = put("a.exr", image), put("b.exr", with_pixel(image, value, at))
    hidden = put("c.exr", with_pixel(image, 0.5, at))
    ran = tonetool_v(bad, ref, "--hdrflip:fail=0", status=3)
    finite = np.delete(image.reshape(-1, 3), at[0] * WIDTH + at[1], axis=0)
    luminance = np.sort(finite @ np.float32([0.2126, 0.7152, 0.0722]))
    assert float(ran.fact("max-luminance")) == pytest.approx(luminance[-1], rel=1e-5)
    assert float(ran.fact("median-luminance")) == pytest.approx(luminance[len(luminance) // 2],
                                                                rel=1e-5)
    for reference, test in ((bad, ref), (ref, bad), (bad, hidden)):
        for command in COMMANDS:
            tonetool_v(reference, test, f"--{command}:fail=0", status=3)


def test_nonfinite_in_both(map_of):
    """One kind is equal, whatever lies around it; NaN against Inf is not."""
    want, _ = map_of(with_pixel(picture(1), 0), with_pixel(picture(2), 0))
    for value, error in ((np.nan, 0), (np.inf, 1)):
        got, ran = map_of(with_pixel(picture(1), np.nan), with_pixel(picture(2), value))
        assert got[CENTRE] == error
        got[CENTRE] = want[CENTRE]
        assert np.array_equal(got, want)
        assert (ran.fact("nonfinite-in-both") == "1") == (error == 0)
    _, ran = map_of(with_pixel(picture(1), np.nan), with_pixel(picture(2), np.nan))
    assert ran.fact("nonfinite-in-both") == "1" and "in both images and count as equal" in ran.err


@pytest.mark.parametrize("command", COMMANDS)
def test_no_finite_pixel(tonetool_v, put, command):
    ref, nothing = put("a.exr", picture()), put("b.exr", flat(np.nan, 0, 0))
    for pair in ((ref, nothing), (nothing, ref), (nothing, nothing)):
        ran = tonetool_v(*pair, f"--{command}:fail=0.9999", status=1)
        assert "no finite pixel" in ran.err and not passes(ran)


def test_half_that_overflows_is_not_a_pass(tonetool_v, put):
    image = with_pixel(picture(), 1e6)
    ref = put("a.exr", image)
    assert tonetool_v(ref, put("b.exr", image, kind="half"), "--hdrflip:fail=0", status=3).fact(
        "test-nonfinite") == "1"


def test_nonfinite_alpha_counts_only_where_alpha_does(tonetool_v, put):
    image = np.dstack([picture(), np.ones((HEIGHT, WIDTH), np.float32)])
    bad = image.copy()
    bad[CENTRE][3] = np.nan
    a, b = put("a.exr", image, tuple("RGBA")), put("b.exr", bad, tuple("RGBA"))
    assert tonetool_v(a, b, "--hdrflip:fail=0").fact("test-nonfinite") == "0"
    ran = tonetool_v(a, b, "--hdrflip:fail=0:alpha=error", status=3)
    assert ran.fact("max").startswith("1 at ")


# ---- values beyond the usual


@pytest.mark.parametrize("curve", ["aces", "hable", "reinhard"])
@pytest.mark.parametrize("side", ["reference", "test"])
def test_huge_pixel_is_white(map_of, curve, side):
    """Not black, as where its square overflows."""
    maps = []
    for value in (1e30, 1e6):
        pair = {"reference": picture(1), "test": picture(2)}
        pair[side] = with_pixel(pair[side], value)
        maps.append(map_of(pair["reference"], pair["test"], f"{FIXED}:tonemapper={curve}")[0])
    if curve == "reinhard":  # x/(1+x) of 1e6 is one float step below 1
        assert np.allclose(maps[0], maps[1], atol=1e-5)
    else:
        assert np.array_equal(*maps)
    assert maps[0][CENTRE] > 0.05


@pytest.mark.parametrize("curve", ["aces", "hable", "reinhard"])
@pytest.mark.parametrize("value", [-1, -0.01, -1e30])
def test_negative_pixel_is_black(map_of, curve, value):
    got, ran = map_of(picture(1), with_pixel(picture(2), value), f"{FIXED}:tonemapper={curve}")
    want, _ = map_of(picture(1), with_pixel(picture(2), 0), f"{FIXED}:tonemapper={curve}")
    assert np.array_equal(got, want) and ran.fact("test-negative") == "1"
    assert got[CENTRE] > 0.05


@pytest.mark.parametrize("command", ["ldrflip", "flipdiff"])
def test_all_negative_images_do_not_pass_in_silence(tonetool_v, put, command):
    a, b = put("a.exr", -picture(1)), put("b.exr", -picture(2))
    assert "negative" in tonetool_v("-q", a, b, f"--{command}:fail=0").err


@pytest.mark.parametrize("words", [
    ("--ldrflip:fail=0", 20, 40), ("--flipdiff:fail=0", 50, 100),
    ("--hdrflip:fail=0:startExposure=60:stopExposure=60", 1, 1),
    ("--hdrflip:fail=0:startExposure=-126:stopExposure=-126", 1, 1),
    ("--hdrflip:fail=0:maxluminance=1e-20:medianluminance=1e-20", 1, 1),
    ("--hdrflip:fail=0:coeffs=0,1,2,0,0,1:startExposure=0:stopExposure=0", 1, 1)],
    ids=["ldrflip above 1", "flipdiff above its range", "all white", "all black", "maxluminance",
         "coeffs above 1"])
def test_differences_that_no_exposure_shows(tonetool_v, put, words):
    command, scale, offset = words
    a, b = put("a.exr", picture(1) * scale + offset), put("b.exr", picture(2) * scale + offset)
    assert tonetool_v("-q", "--warnings-exit", a, b, command, status=2).err


# ---- exposures


def test_one_exposure(tonetool_v, two, read):
    """N=1 is one exposure, at the start."""
    ran = tonetool_v(*two, "--hdrflip:numExposures=1:startExposure=1:stopExposure=4:fail=0.01",
                   "-o", "one.exr", status=3)
    assert ran.fact("exposures") == "start 1 stop 1 count 1"
    tonetool_v(*two, "--hdrflip:startExposure=1:stopExposure=1:numExposures=1", "-o", "two.exr")
    assert np.array_equal(read("one.exr")[0], read("two.exr")[0]) and read("one.exr")[0].any()
    auto = tonetool_v(*two, "--hdrflip").fact("exposures").split()[1]
    ran = tonetool_v(*two, "--hdrflip:numExposures=1:fail=0.01", status=3)
    assert ran.fact("exposures") == f"start {auto} stop {auto} count 1"


@pytest.mark.parametrize("count", ["0", "-1", "1.5", "1e9", "1025", "99999999999999999999", "nan",
                                   "0x2", "2 ", "two"])
def test_number_of_exposures(tonetool_v, two, count):
    ran = tonetool_v(*two, f"--hdrflip:fail=0.9999:numExposures={count}", status=1)
    assert "numExposures" in ran.err and count in ran.err and "1 to 1024" in ran.err
    assert not passes(ran)


@pytest.mark.parametrize("given, kept", [("startExposure=-3", 0), ("stopExposure=6", 1)])
def test_one_end_given(tonetool_v, two, given, kept):
    auto = tonetool_v(*two, "--hdrflip").fact("exposures").split()[1:4:2]
    ends = tonetool_v(*two, f"--hdrflip:{given}:fail=0.01", status=3).fact("exposures").split()
    assert ends[1:4:2][kept] == given.split("=")[1]
    assert ends[1:4:2][1 - kept] == auto[1 - kept]


@pytest.mark.parametrize("modifiers", ["startExposure=2:stopExposure=1", "startExposure=100",
                                       "stopExposure=-100", "maxluminance=1:medianluminance=2"])
def test_exposures_out_of_order(tonetool_v, two, modifiers):
    ran = tonetool_v(*two, f"--hdrflip:fail=0.9999:{modifiers}", status=1)
    assert "above" in ran.err and not passes(ran)


@pytest.mark.parametrize("name", ["startExposure", "stopExposure", "maxluminance",
                                  "medianluminance"])
@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "1e99", "0,5", "1e400", "''"])
def test_exposures_that_are_not_numbers(tonetool_v, two, name, value):
    ran = tonetool_v(*two, f"--hdrflip:fail=0.9999:{name}={value}", status=1)
    assert name in ran.err and not passes(ran)


@pytest.mark.parametrize("value", ["-1000", "1000", "-127", "128"])
def test_exposures_out_of_range(tonetool_v, two, value):
    ran = tonetool_v(*two, f"--hdrflip:fail=0.9999:startExposure={value}:stopExposure={value}",
                   status=1)
    assert value in ran.err and "-126" in ran.err and "127" in ran.err and not passes(ran)


@pytest.mark.parametrize("coeffs", [
    "0,0,0.5,0,0,1", "0,-1,1,0,0,1", "0,1,0,0,-100,1", "0,1,0,0,0,0", "0,0,0,0,0,0",
    "nan,1,0,0,0,1", "0,1,0,0,0", "0,1,0,0,0,1,0", "0,1,0,0,0,", "1,-1,0,0,0,1"])
def test_curves_that_hide_differences(tonetool_v, two, coeffs):
    for how in ("", ":startExposure=0:stopExposure=0"):
        ran = tonetool_v(*two, f"--hdrflip:fail=0.9999:coeffs={coeffs}{how}", status=1)
        assert "coeffs" in ran.err or "curve" in ran.err
        assert not passes(ran)


def test_exposure_map_of_equal_pixels(tonetool_v, put, read):
    """Where nothing differs it says the first exposure, not whatever was in memory."""
    image = picture()
    changed = image.copy()
    changed[:, WIDTH - 2:] *= 4
    a, b = put("a.exr", image), put("b.exr", changed)
    for test in (a, b):
        for kind in ("index", "stops"):
            ran = tonetool_v(a, test, f"--hdrflip:ppd=10:exposuremap={kind}", "-o", "e.exr", "--pop",
                           "-o", "m.exr")
            error, exposure = read("e.exr")[0], read("m.exr")[0]
            start = 0 if kind == "index" else float(ran.fact("exposures").split()[1])
            assert (error == 0).any() and error.any() == (test == b)
            assert np.allclose(exposure[error == 0], start, rtol=1e-5)


# ---- size and windows


@pytest.mark.parametrize("curve", ["aces", "hable", "reinhard"])
def test_one_pixel(tonetool_v, put, map_of, testimages, curve):
    ref, test = flat(0.25, 0.5, 1, height=1, width=1), flat(1, 0.5, 0.25, height=1, width=1)
    got, ran = map_of(ref, test, f"tonemapper={curve}")
    start, stop, count = ran.fact("exposures").split()[1::2]
    assert start == stop and count == "2" and got.shape == (1, 1) and 0.1 < got[0, 0] <= 1
    tonetool_v(put("a.exr", ref), put("b.exr", test), "--hdrflip:fail=0.1", status=3)
    one = testimages / "one_pixel.exr"
    tonetool_v(one, one, "--hdrflip:fail=0")
    got, _ = map_of(flat(0, 0, 0, height=1, width=1), flat(1, 1, 1, height=1, width=1), "",
                    "ldrflip")
    assert got[0, 0] == pytest.approx(0.967384, abs=6e-6)


@pytest.mark.parametrize("width, height", [(31, 24), (32, 23), (1, 1), (64, 48), (24, 32)])
@pytest.mark.parametrize("command", COMMANDS)
def test_display_windows_differ(tonetool_v, put, width, height, command):
    a = put("a.exr", picture())
    b = put("b.exr", picture(height=height, width=width))
    for pair in ((a, b), (b, a)):
        ran = tonetool_v(*pair, f"--{command}:fail=0.9999", status=1)
        assert f"{width}x{height}" in ran.err and f"{WIDTH}x{HEIGHT}" in ran.err
        assert "resize=" in ran.err and "crop=" in ran.err and not passes(ran)


def test_display_windows_at_different_places(tonetool_v, put):
    a = put("a.exr", picture(), window=(0, 0, 0, 0, WIDTH, HEIGHT))
    b = put("b.exr", picture(), window=(5, 0, 5, 0, WIDTH, HEIGHT))
    tonetool_v(a, b, "--hdrflip:fail=0.9999", status=1)
    tonetool_v(a, b, "--hdrflip:fail=0.01:crop=1", status=3)
    far = put("c.exr", picture(), window=(WIDTH, 0, WIDTH, 0, WIDTH, HEIGHT))
    ran = tonetool_v(a, far, "--hdrflip:fail=0.9999:crop=1", status=1)
    assert "nothing to compare" in ran.err


def test_crop_compares_the_intersection(tonetool_v, put, read):
    image = picture()
    a = put("a.exr", image, window=(0, 0, 0, 0, WIDTH, HEIGHT))
    part = put("b.exr", image[4:, 5:], window=(5, 4, 5, 4, WIDTH - 5, HEIGHT - 4))
    ran = tonetool_v(a, part, f"--hdrflip:{FIXED}:crop=1:fail=0", "-o", "x.exr")
    assert ran.fact("pixels") == str((WIDTH - 5) * (HEIGHT - 4))
    assert (read("x.exr")[1].x, read("x.exr")[1].y) == (5, 4)
    changed = image[4:, 5:].copy()
    changed[-1, -1] += 1
    bad = put("c.exr", changed, window=(5, 4, 5, 4, WIDTH - 5, HEIGHT - 4))
    tonetool_v(a, bad, "--hdrflip:crop=1:fail=0", status=3)
    tonetool_v(bad, a, "--hdrflip:crop=1:fail=0", status=3)


def test_crop_without_a_covered_pixel(tonetool_v, put):
    """The display windows meet, but one image has no pixel there."""
    a = put("a.exr", picture(), window=(100, 100, 0, 0, 200, 200))
    b = put("b.exr", picture(), window=(0, 0, 0, 0, 50, 50))
    for pair in ((a, b), (b, a)):
        ran = tonetool_v(*pair, "--hdrflip:fail=0.9999:crop=1", status=1)
        assert "nothing to compare" in ran.err


def test_resize_brings_the_test_to_the_reference(tonetool_v, put):
    a, b = put("a.exr", flat(0.5, 0.5, 0.5)), put("b.exr", flat(0.5, 0.5, 0.5, height=48, width=64))
    red = put("c.exr", flat(0.9, 0.1, 0.1, height=48, width=64))
    ran = tonetool_v(a, b, "--hdrflip:fail=0.001:resize=1")
    assert ran.fact("pixels") == str(WIDTH * HEIGHT)
    tonetool_v(a, red, "--hdrflip:fail=0.1:resize=1", status=3)
    bad = put("d.exr", with_pixel(flat(0.5, 0.5, 0.5, height=48, width=64), np.nan))
    tonetool_v(a, bad, "--hdrflip:fail=0:resize=1", status=3)


@pytest.mark.parametrize("pair", ["ref", "test"])
def test_uncovered_pixels_are_black_and_counted(map_of, put, pair):
    """A data window inside the display window is the same as black around it."""
    image, other = picture(1), picture(2)
    whole = np.zeros_like(image)
    whole[3:13, 4:20] = image[3:13, 4:20]
    put("in.exr", image[3:13, 4:20], window=(4, 3, 0, 0, WIDTH, HEIGHT))
    put("black.exr", whole)
    put("other.exr", other)
    names = {"ref": ("{}.exr", "other.exr"), "test": ("other.exr", "{}.exr")}[pair]
    maps = [map_of(*(name.format(what) for name in names)) for what in ("in", "black")]
    assert np.array_equal(maps[0][0], maps[1][0])
    side = {"ref": "reference", "test": "test"}[pair]
    assert maps[0][1].fact(f"{side}-uncovered") == str(WIDTH * HEIGHT - 160)
    assert f"outside the {side}'s data window" in maps[0][1].err


def test_data_windows_that_do_not_meet(tonetool_v, put, read):
    a = put("a.exr", picture(), window=(0, 0, 0, 0, 100, 100))
    b = put("b.exr", picture(), window=(60, 70, 0, 0, 100, 100))
    for command in COMMANDS:
        ran = tonetool_v(a, b, f"--{command}:fail=0.1", "-o", "x.exr", status=3)
        assert ran.fact("pixels") == str(92 * 94)
        assert ran.fact("reference-uncovered") == str(92 * 94 - WIDTH * HEIGHT)
        assert read("x.exr")[0].max() > 0.1


def test_data_windows_too_far_apart(tonetool_v, put):
    """A union that no memory holds is an error, not an overflow."""
    a = put("a.exr", picture(), window=(1000000000, 1000000000, 0, 0, 200, 100))
    b = put("b.exr", picture(), window=(-1000000000, -1000000000, 0, 0, 200, 100))
    assert not passes(tonetool_v(a, b, "--hdrflip:fail=0.9999", status=1))


def test_pixels_outside_the_display_window_count(tonetool_v, put, testimages):
    image = picture(height=40, width=50)
    changed = image.copy()
    changed[0, 0] += 3
    window = (-8, -6, 0, 0, WIDTH, HEIGHT)
    a, b = put("a.exr", image, window=window), put("b.exr", changed, window=window)
    tonetool_v(a, b, "--hdrflip:fail=0", status=3)
    overscan = testimages / "overscan.exr"
    tonetool_v(overscan, overscan, "--hdrflip:fail=0")
    tonetool_v(testimages / "plain.exr", overscan, "--hdrflip:fail=0", status=3)


# ---- channels, alpha, layers


def test_channels_beside_the_colour(tonetool_v, put, map_of):
    want, _ = map_of(picture(1), picture(2))
    extra = picture(3)
    for names in ("RGBA", "RGBZ", "BGRA", "ZBGR"):
        files = []
        for name, image in (("a.exr", picture(1)), ("b.exr", picture(2))):
            planes = dict(zip("RGBAZ", np.moveaxis(np.dstack([image, extra[:, :, :2]]), 2, 0)))
            files.append(put(name, np.dstack([planes[c] for c in names]), tuple(names)))
        assert np.array_equal(map_of(*files)[0], want)


@pytest.mark.parametrize("channels", ["Y", "R"])
def test_one_channel_is_compared_with_one(tonetool_v, put, channels):
    grey = picture()[:, :, :1]
    a, good = put("a.exr", grey, channels), put("b.exr", picture())
    for pair in ((a, good), (good, a)):
        for command in COMMANDS:
            ran = tonetool_v(*pair, f"--{command}:fail=0.5", status=1)
            assert "has one channel" in ran.err and not passes(ran)
    for command in COMMANDS:
        tonetool_v(a, a, f"--{command}:fail=0")
        tonetool_v(a, put("c.exr", grey * 4 + 0.5, channels), f"--{command}:fail=0.01", status=3)


@pytest.mark.parametrize("channels", ["RG", "RGA", "XYZ"])
def test_no_colour(tonetool_v, put, channels):
    a = put("a.exr", picture()[:, :, :len(channels)], tuple(channels))
    good = put("b.exr", picture())
    for pair in ((a, good), (good, a), (a, a)):
        for command in COMMANDS:
            ran = tonetool_v(*pair, f"--{command}:fail=0.9999", status=1)
            assert "needs R,G,B" in ran.err and not passes(ran)


def test_alpha(tonetool_v, put, read):
    rgba = np.dstack([picture(), np.full((HEIGHT, WIDTH), 0.5, np.float32)])
    changed = rgba.copy()
    changed[CENTRE][3] = 0.25
    a, b = put("a.exr", rgba, tuple("RGBA")), put("b.exr", changed, tuple("RGBA"))
    tonetool_v(a, b, "--hdrflip:fail=0")
    ran = tonetool_v(a, b, "--hdrflip:fail=0:alpha=error:quantity=max", "-o", "x.exr", status=3)
    assert ran.fact("alpha-max") == f"0.25 at {CENTRE[1]},{CENTRE[0]}"
    assert read("x.exr")[0][CENTRE] == 0.25 and np.count_nonzero(read("x.exr")[0]) == 1
    opaque = put("c.exr", picture())
    ran = tonetool_v(opaque, a, "--hdrflip:fail=0:alpha=error", status=3)
    assert "only one image has alpha" in ran.err and ran.fact("alpha-max").startswith("0.5 ")
    tonetool_v(opaque, opaque, "--hdrflip:fail=0:alpha=error", status=1)
    tonetool_v("-i:ch=R,G,B", a, "-i:ch=R,G,B", b, "--hdrflip:fail=0:alpha=error", status=1)


def layers_file(put, name, layers):
    names = tuple(f"{layer}.{c}".lstrip(".") for layer in layers for c in "RGB")
    return put(name, np.dstack(list(layers.values())), names)


@pytest.mark.parametrize("layers", [
    ("left.beauty", "right.beauty"), ("beauty", "rgba"), ("Combined", "combined"),
    ("diffuse", "specular")])
def test_two_candidates_are_an_error(tonetool_v, put, layers):
    a = layers_file(put, "a.exr", {layer: picture(i) for i, layer in enumerate(layers)})
    ran = tonetool_v(a, a, "--hdrflip:fail=0.9999", status=1)
    for layer in layers:
        assert layer in ran.err
    tonetool_v(a, a, f"--hdrflip:fail=0:layer={layers[1]}")


def test_plain_colour_wins_over_layers(tonetool_v, put):
    a = layers_file(put, "a.exr", {"": picture(1), "beauty": picture(2)})
    b = layers_file(put, "b.exr", {"": picture(1), "beauty": picture(3)})
    assert tonetool_v(a, b, "--hdrflip:fail=0").fact("reference-layer") == "R,G,B"
    tonetool_v(a, b, "--hdrflip:fail=0:layer=beauty", status=3)


def test_layer_that_one_image_lacks(tonetool_v, put):
    a = layers_file(put, "a.exr", {"beauty": picture(1), "key": picture(2)})
    b = layers_file(put, "b.exr", {"beauty": picture(1)})
    for pair in ((a, b), (b, a)):
        ran = tonetool_v(*pair, "--hdrflip:fail=0.9999:layer=key", status=1)
        assert '"key"' in ran.err and "beauty" in ran.err


@pytest.mark.parametrize("layer", ["_", "-", "' '"])
def test_layer_name_of_separators(tonetool_v, two, layer):
    tonetool_v(*two, f"--hdrflip:fail=0.9999:layer={layer}", status=1)


@pytest.mark.parametrize("names", ["R,G,B,red,green,blue", "R,G,B,r,g,b"])
def test_two_spellings_of_one_colour(tonetool_v, put, names):
    channels = tuple(names.split(","))
    files = [put(f"{seed}.exr", np.dstack([picture(seed), picture(3)]), channels)
             for seed in (1, 2)]
    assert tonetool_v("--warnings-exit", *files, "--hdrflip:fail=0.9999", status=1).err


# ---- files and colour


@pytest.mark.parametrize("command", COMMANDS)
def test_uint_exr(tonetool_v, outcome, tmp_path, command):
    """The values of an unsigned channel are numbers, neither bits nor shares; or it is refused."""
    one = {c: np.full((4, 4), value, np.uint32) for c, value in zip("RGB", (1, 2, 3))}
    other = {c: np.full((4, 4), value, np.uint32) for c, value in zip("RGB", (30, 20, 10))}
    a = write_exr(tmp_path / "a.exr", dict.fromkeys("RGB", "uint"), one)
    b = write_exr(tmp_path / "b.exr", dict.fromkeys("RGB", "uint"), other)
    as_float = write_exr(tmp_path / "c.exr", dict.fromkeys("RGB", "float"), one)
    ran = outcome(a, as_float, f"--{command}:fail=0")
    assert ran.status == 0 or (ran.status == 1 and "uint" in ran.err)
    if command == "hdrflip":
        assert outcome(a, b, "--hdrflip:fail=0.01").status in (1, 3)
    else:
        brighter = dict(other, R=one["R"] * 0)
        b = write_exr(tmp_path / "b.exr", dict.fromkeys("RGB", "uint"), brighter)
        assert outcome(a, b, f"--{command}:fail=0.01").status in (1, 3)
    tonetool_v(a, a, f"--{command}:fail=0", status=ran.status)


def test_exr_of_mixed_types(tonetool_v, tmp_path):
    planes = rgb_planes(picture())
    a = write_exr(tmp_path / "a.exr", {"R": "half", "G": "float", "B": "half"}, planes)
    b = write_exr(tmp_path / "b.exr", dict.fromkeys("RGB", "float"), planes)
    c = write_exr(tmp_path / "c.exr", {"R": "half", "G": "float", "B": "half"},
                  dict(planes, B=planes["B"] * 0.5))
    tonetool_v(a, b, "--hdrflip:fail=0.01")
    tonetool_v(a, c, "--hdrflip:fail=0.05", status=3)


BAD_WHITES = [(np.nan, 0.329), (np.inf, 0.329), (0.3127, np.nan), (0.3127, 0.0)]


@pytest.mark.parametrize("white", BAD_WHITES)
@pytest.mark.parametrize("command", COMMANDS)
def test_chromaticities_that_are_not_numbers(outcome, tmp_path, command, white):
    primaries = (0.64, 0.33, 0.3, 0.6, 0.15, 0.06)
    files = [write_exr(tmp_path / f"{seed}.exr", dict.fromkeys("RGB", "float"),
                       rgb_planes(picture(seed)), chromaticities=primaries + white)
             for seed in (1, 2)]
    ran = outcome(*files, f"--{command}:fail=0.01")
    assert ran.status == 1 and "chromaticities" in ran.err and not passes(ran)


AP1 = (0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767)


def test_primaries_are_told_apart(tonetool_v, testimages):
    rec709, acescg = testimages / "rec709.exr", testimages / "acescg.exr"
    tonetool_v(rec709, acescg, "--hdrflip:fail=0.002")
    ran = tonetool_v(rec709, acescg, "--hdrflip:fail=0.002:from=rec709", status=3)
    assert ran.fact("test-space") == "rec709"


def test_wide_colours_are_not_clipped_before_the_tone_map(tonetool_v, tmp_path):
    """A pure ACEScg green is negative in Rec.709: counted, and its brightness still compared."""
    a, b = (write_exr(tmp_path / f"{green}.exr", dict.fromkeys("RGB", "float"),
                      rgb_planes(flat(0.1, green, 0.1)), chromaticities=AP1) for green in (2, 4))
    ran = tonetool_v(a, b, "--hdrflip:fail=0.05", status=3)
    assert ran.fact("reference-space") == "acescg"
    assert ran.fact("reference-negative") == str(WIDTH * HEIGHT)


@pytest.mark.parametrize("kind", ["uint8", "uint16"])
@pytest.mark.parametrize("png_first", [False, True])
def test_exr_and_png(tonetool_v, put, kind, png_first):
    """The same picture both ways is nearly the same, because the PNG is decoded."""
    linear = picture(low=0.01, high=0.99)
    coded = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    exr, png = put("a.exr", linear), put("b.png", coded, kind=kind)
    pair = (png, exr) if png_first else (exr, png)
    for command in COMMANDS:
        tonetool_v(*pair, f"--{command}:fail={0.03 if kind == 'uint8' else 0.002}")
        undecoded = put("c.png", linear, kind=kind)
        tonetool_v(exr, undecoded, f"--{command}:fail=0.1", status=3)


def test_png_depths_agree(tonetool_v, testimages):
    tonetool_v(testimages / "srgb8.png", testimages / "srgb16.png",
             "--hdrflip:fail=1e-4:quantity=max")


@pytest.mark.parametrize("name", ["a.EXR", "a.Exr", "a.PNG", "a.TIF"])
def test_upper_case_extension(tonetool_v, put, name, tmp_path):
    kind = "float" if name.lower().endswith("exr") else "uint16"
    lower = put(name.lower(), picture(1), kind=kind)
    other = put("b" + name.lower()[1:], picture(2), kind=kind)
    os.rename(tmp_path / other, tmp_path / "b.old")
    os.rename(tmp_path / lower, tmp_path / name)
    os.rename(tmp_path / "b.old", tmp_path / ("b" + name[1:]))
    tonetool_v(name, name, "--hdrflip:fail=0")
    tonetool_v(name, "b" + name[1:], "--hdrflip:fail=0.01", status=3)


@pytest.mark.parametrize("name", ["a.tif", "a.png", "a.jpg", "a.tga", "a.bmp", "a.sgi", "a.hdr",
                                  "a.webp", "a.rla", "a.iff"])
def test_every_format_is_compared_and_its_torso_refused(tonetool_v, put, name, tmp_path):
    kind = "float" if name.endswith("hdr") else "uint8"
    one, two_ = (put(prefix + name, picture(seed, 96, 128), kind=kind)
                 for seed, prefix in ((1, "x"), (2, "y")))
    tonetool_v(one, one, "--ldrflip:fail=0")
    tonetool_v(one, two_, "--ldrflip:fail=0.05", status=3)
    for file in (one, two_):
        whole = (tmp_path / file).read_bytes()
        (tmp_path / file).write_bytes(whole[:len(whole) * 6 // 10])
    for pair in ((one, two_), (one, one)):
        assert not passes(tonetool_v(*pair, "--ldrflip:fail=0.9999", status=1))


def test_rec709_video_needs_a_word(tonetool_v, put):
    """DPX and PPM readers tag the camera curve, which is neither linear nor sRGB."""
    a = put("a.ppm", picture(), kind="uint8")
    ran = tonetool_v(a, a, "--hdrflip:fail=0.9999", status=1)
    assert "Rec709" in ran.err and "from=" in ran.err
    tonetool_v(a, a, "--hdrflip:fail=0:from=srgb")


def test_planar_tiled_and_compressed_tiffs(tonetool_v, put, tmp_path):
    image = picture()
    a = put("a.exr", image)
    for planar in ("contig", "separate"):
        for compression in ("none", "lzw", "zip"):
            attributes = {"planarconfig": planar, "compression": compression}
            same = put("b.tif", image, attributes=attributes)
            tonetool_v(a, same, "--hdrflip:fail=0")
            other = put("c.tif", with_pixel(image, 0.95), attributes=attributes)
            tonetool_v(a, other, "--hdrflip:fail=0", status=3)
    spec = oiio.ImageSpec(WIDTH, HEIGHT, 3, "float")
    spec.tile_width = spec.tile_height = 16
    tiled = oiio.ImageBuf(spec)
    tiled.set_pixels(oiio.ROI(), image)
    tiled.write(str(tmp_path / "t.exr"))
    assert oiio.ImageBufAlgo.make_texture(oiio.MakeTxTexture, tiled, str(tmp_path / "t.tx"))
    tonetool_v(a, "t.exr", "--hdrflip:fail=0")
    tonetool_v(a, "t.tx", "--hdrflip:fail=0")
    tonetool_v(put("d.exr", with_pixel(image, 0.95, LAST)), "t.tx", "--hdrflip:fail=0", status=3)


def test_other_subimages_are_not_passed_in_silence(tonetool_v, make_parts):
    a, b = make_parts("a.exr", 0.5, 0.25), make_parts("b.exr", 0.5, 0.75)
    ran = tonetool_v(a, b, "--hdrflip:fail=0", status=1)
    assert "beside one, pictures are not looked at: two" in ran.err and not passes(ran)
    assert "two" in tonetool_v("--warnings-exit", a, b, "--hdrflip", status=2).err
    tonetool_v(a, "--subimage", "1", b, "--subimage", "two", "--hdrflip:fail=0", status=3)


def test_signed_integers(tonetool_v, put):
    a, b = (put(f"{seed}.tif", picture(seed), kind="int16") for seed in (1, 2))
    tonetool_v(a, a, "--hdrflip:fail=0")
    tonetool_v(a, b, "--hdrflip:fail=0.05", status=3)


# ---- ppd and the map's range


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("ppd", ["0", "0.1", "nan", "inf", "1e9", "-67", "1001", "67,02", "0x43"])
def test_pixels_per_degree_out_of_range(tonetool_v, two, command, ppd):
    ran = tonetool_v(*two, f"--{command}:fail=0.9999:ppd={ppd}", status=1)
    assert "ppd" in ran.err and ppd in ran.err and "1 to 1000" in ran.err and not passes(ran)


@pytest.mark.parametrize("screen", ["distance=1e-6", "width=1e6", "pixels=1e7", "distance=1e6"])
def test_screens_out_of_range(tonetool_v, two, screen):
    ran = tonetool_v(*two, f"--hdrflip:fail=0.9999:{screen}", status=1)
    assert "ppd" in ran.err and not passes(ran)


@pytest.mark.parametrize("ppd", [1, 1000])
@pytest.mark.parametrize("size", [(1, 1), (1, 9), (9, 1), (HEIGHT, WIDTH)])
def test_smallest_and_largest_ppd(map_of, put, tonetool_v, ppd, size):
    got, _ = map_of(picture(1, *size), picture(2, *size), f"ppd={ppd}")
    assert np.isfinite(got).all() and got.max() > 0.01 and got.max() <= 1.0001
    assert not map_of(picture(1, *size), picture(1, *size), f"ppd={ppd}:fail=0")[0].any()
    tonetool_v(put("a.exr", picture(1, *size)), put("b.exr", picture(2, *size)),
             f"--hdrflip:fail=0.001:ppd={ppd}", status=3)


def test_map_stays_within_0_and_1(map_of, tonetool_v, put, read):
    checker = np.indices((HEIGHT, WIDTH)).sum(axis=0)[:, :, None] % 2
    green, blue = flat(0, 1, 0), flat(0, 0, 1)
    one = np.where(checker, green, blue).astype(np.float32)
    for command in ("hdrflip", "ldrflip"):
        got, _ = map_of(one, (1 - one).astype(np.float32), "", command)
        assert got.min() >= 0 and got.max() <= 1.0001
    for value, name in ((1.0, "one"), (7.0, "seven")):  # colours are clamped, they do not wrap
        tonetool_v(put("v.exr", flat(value, value, value)), "--colormap", "magma", "-o",
                 f"{name}.png")
    assert np.array_equal(read("one.png")[0], read("seven.png")[0])


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", ["plain", "negative", "huge", "constant", "green", "white",
                                  "one_pixel", "rgba", "datawindow", "overscan", "acescg",
                                  "nan_last", "nan_center", "inf", "mostly_black"])
def test_identical_images_are_exactly_0(tonetool_v, testimages, read, name, command):
    image = testimages / f"{name}.exr"
    ran = tonetool_v(image, image, f"--{command}:fail=0:ppd=50", "-o", "x.exr")
    assert not read("x.exr")[0].any() and ran.fact("mean") == "0"


@pytest.mark.parametrize("ppd", [1, 33.3, 67.0206451, 200])
def test_known_values(map_of, testimages, ppd):
    def value(reference, test):
        got, _ = map_of(str(testimages / reference), str(testimages / test), f"ppd={ppd}",
                        "ldrflip")
        assert got.min() == got.max()
        return got.max()

    # 0.9673798 in exact arithmetic; 0.9673883 with float rounding in the feature taps.
    assert value("black.exr", "white.exr") == pytest.approx(0.967384, abs=6e-6)
    assert value("green.exr", "blue.exr") == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("at", [FIRST, CENTRE, LAST], ids=["first", "centre", "last"])
@pytest.mark.parametrize("channel", [0, 1, 2])
def test_one_step_of_one_float_is_seen(tonetool_v, put, at, channel):
    image = flat(0.5, 0.5, 0.5)
    changed = image.copy()
    changed[at][channel] = np.float32(0.5001)
    a, b = put("a.exr", image), put("b.exr", changed)
    for command in COMMANDS:
        tonetool_v(a, b, f"--{command}:fail=0", status=3)


# ---- thresholds and statuses


@pytest.mark.parametrize("key", ["fail", "warn"])
@pytest.mark.parametrize("value", ["nan", "-1", "2", "0,05", "inf", "", "''", "1e-400x", "5%", "."])
def test_thresholds_that_are_none(tonetool_v, two, key, value):
    ran = tonetool_v(*two, f"--hdrflip:{key}={value}", status=1)
    assert f"{key}" in ran.err and not passes(ran)


def test_threshold_is_not_lost_in_rounding(tonetool_v, put):
    """What is printed with 6 digits is compared with all of them."""
    a, b = put("a.exr", flat(0.5, 0.5, 0.5)), put("b.exr", flat(0.5, 0.6, 0.5))
    mean = tonetool_v(a, b, "--ldrflip:fail=0", status=3).fact("mean")
    for step, status in ((-1e-5, 3), (1e-5, 0)):
        ran = tonetool_v(a, b, f"--ldrflip:fail={float(mean) + step:.9f}", status=status)
        assert bool(passes(ran)) == (status == 0)


def test_a_failure_is_not_forgotten(tonetool_v, two):
    a, b = two
    bad, good = [a, b, "--hdrflip:fail=0.001"], [a, a, "--hdrflip:fail=0"]
    assert "FAIL" in tonetool_v(*bad, *good, status=3).out
    tonetool_v(*good, *bad, status=3)
    tonetool_v(*bad, *good, *good, "--pop", "--pop", "-o", "x.exr", status=3)
    tonetool_v(a, a, b, "--hdrflip:tests=2:fail=0", status=3)
    tonetool_v(a, b, a, "--hdrflip:tests=2:fail=0", status=3)
    tonetool_v("--warnings-exit", a, b, "--hdrflip:fail=0.9:warn=0.1", *bad, status=3)
    tonetool_v(*bad, "--help", status=3)
    tonetool_v(*bad, "--version", status=3)


def test_an_error_after_a_failure_is_an_error(tonetool_v, two, tmp_path):
    a, b = two
    tonetool_v(a, b, "--hdrflip:fail=0", "nosuch.exr", status=1)
    tonetool_v(a, b, "--hdrflip:fail=0.9999", "nosuch.exr", status=1)
    tonetool_v(a, b, "--hdrflip:fail=0.9999", a, "--hdrflip:tests=9:fail=0.9999", status=1)
    tonetool_v("--warnings-exit", a, b, "--hdrflip:fail=0.9999:warn=0", "--bogus", status=1)
    assert sorted(os.listdir(tmp_path)) == sorted(two)


@pytest.mark.parametrize("words", [
    ["ref.exr", "test.exr"], ["--hdrflip"], ["ref.exr", "--hdrflip:fail=0.9999"],
    ["ref.exr", "test.exr", "--hdrflip:tests=2:fail=0.9999"], ["-q", "--threads", "1"],
    ["ref.exr", "test.exr", "--swap", "--pop", "--pop"], ["ref.exr", "--hdrflip", "-o", "x.exr"],
    ["ref.exr", "test.exr", "--hdrflip:fail=0.9999", "--hdrflip:fail=0.9999"],
    ["ref.exr", "test.exr", "--hdrflip:fail=0.9999", "--ldrflip:fail=0.9999"],
    ["ref.exr", "--label", "test.exr"], ["--", "ref.exr", "test.exr", "--hdrflip:fail=0.9999"],
    ["ref.exr,test.exr", "--hdrflip:fail=0.9999"], ["", "", "--hdrflip:fail=0.9999"]])
def test_chains_that_measure_nothing(tonetool_v, two, words):
    assert two == ("ref.exr", "test.exr")
    tonetool_v(*words, status=1)


def test_quiet_keeps_failures(tonetool_v, two):
    a, b = two
    assert "FAIL" in tonetool_v("-q", a, b, "--hdrflip:fail=0", status=3).out
    assert tonetool_v("-q", a, a, "--hdrflip:fail=0").out == ""
    ran = tonetool_v("-q", "--warnings-exit", a, b, "--hdrflip:warn=0", status=2)
    assert "WARNING" in ran.err


@pytest.mark.parametrize("words", [
    ["--hdrflip:fail=0:Fail=0.9999"], ["--hdrflip:FAIL=0.9999"],
    ["--hdrflip:fail=0:fail=0.9999"], ["--hdrflip:fail =0.9999"], ["--hdrflip: fail=0.9999"],
    ["--hdrflip:fail= 0.9999"], ["--hdrflip:fail=0.9999 "],
    ["--hdrflip:quality=max:fail=0.9999"], ["--hdrflip;fail=0.9999"], ["--hdrflip=fail=0.9999"],
    ["--hdrflip,fail=0.9999"], ["--hdrflip:fail=0.9999,quantity=max"],
    ["--hdrflip:fail=0.9999:quantity=p101"], ["--hdrflip:fail=0.9999:quantity='max'x"],
    ["--hdrflip:fail:1"], ["--HDRFLIP:fail=0.9999"], ["\N{EN DASH}hdrflip:fail=0.9999"],
    ["\N{EM DASH}hdrflip:fail=0.9999"], ["--hdrflip:fail=\uff11"]])
def test_misspelt_is_an_error(tonetool_v, two, words):
    ran = tonetool_v(*two, *words, status=1)
    assert not passes(ran) and "ERROR" in ran.err


@pytest.mark.parametrize("name", ["a b.exr", "a:fail=0.9999.exr", "it's.exr", 'q"q.exr',
                                  "\u00fcn\u00ef.exr", "x=1.exr", "ref.exr?x=1",
                                  "ref.exr?x=1&y=2", "test#.exr", "@.exr",
                                  "%04d.exr", "{TOP.width}.exr", "hdrflip", "1", "a,b.exr"])
def test_odd_file_names_are_that_file(tonetool_v, two, name, tmp_path):
    """Not another one whose name is part of it, and no command."""
    os.rename(tmp_path / two[1], tmp_path / name)
    plain = ["--wildcardoff", "--evaloff"] if set("#@%{") & set(name) else []
    ran = tonetool_v(*plain, two[0], name, "--hdrflip:fail=0.01", status=3)
    assert ran.fact("test") == name
    tonetool_v(*plain, name, name, "--hdrflip:fail=0")


def test_labels_and_file_names(tonetool_v, two):
    a, b = two
    tonetool_v(a, "--label", "x", b, "--label", "x", "--pop", "x", "--hdrflip:fail=0.01", status=3)
    ran = tonetool_v(b, "--label", a, "--pop", a, b, "--hdrflip:fail=0")
    assert ran.fact("reference") == b  # the label hides the file, and the summary says so
    tonetool_v(b, "--label", a, "--pop", "-i", a, b, "--hdrflip:fail=0.01", status=3)
    tonetool_v("--hdrflip:fail=0.01", a, b, status=3)
    tonetool_v(a, "--hdrflip:fail=0.01", b, status=3)
    tonetool_v("-i", a, "-i:ch=R,G,B=0", b, "--hdrflip:fail=0.01", status=3)


# ---- several tests, saved exposures


def test_several_tests_are_one_call_each(tonetool_v, put, read):
    """Also where each of them has another data window or non-finite pixels."""
    window = (4, 3, 0, 0, WIDTH, HEIGHT)
    ref = put("a.exr", with_pixel(picture(1), np.nan, FIRST))
    tests = [put("b.exr", picture(2)), put("c.exr", picture(3)[:10, :12], window=window),
             put("d.exr", with_pixel(picture(4), np.inf, FIRST))]
    words = []
    for i in (3, 2, 1):
        words += ["-o", f"t{i}.exr", "--pop"]
    together = tonetool_v(ref, *tests, "--hdrflip:tests=3", *words[:-1])
    out = ""
    for i, test in enumerate(tests):
        out += tonetool_v(ref, test, "--hdrflip", "-o", "one.exr").out
        assert np.array_equal(read("one.exr")[0], read(f"t{i + 1}.exr")[0])
    assert together.out == out


def test_one_bad_test_of_several(tonetool_v, two, testimages, tmp_path):
    a, b = two
    for bad in ("y_only.exr", "plain.exr", "truncated.exr", "deep.exr"):
        ran = tonetool_v(a, b, testimages / bad, "--hdrflip:tests=2:fail=0.9999:saveexposures=s",
                       "-o", "x.exr", status=1)
        assert not passes(ran) and sorted(os.listdir(tmp_path)) == sorted(two)


def test_saved_exposures_that_cannot_be_written(tonetool_v, two, tmp_path):
    ran = tonetool_v(*two, "--hdrflip:fail=0.9999:numExposures=2:saveexposures=nosuch/s", status=1)
    assert "nosuch/s.00.reference.exr" in ran.err
    (tmp_path / "s.01.flip.exr").symlink_to("/dev/full")
    tonetool_v(*two, "--hdrflip:fail=0.9999:numExposures=2:saveexposures=s", status=1)


# ---- outputs


@pytest.mark.parametrize("name", ["x.exr", "x.png", "x.tif"])
def test_full_disk_after_a_pass(tonetool_v, two, name, tmp_path):
    (tmp_path / name).symlink_to("/dev/full")
    ran = tonetool_v(two[0], two[0], "--hdrflip:fail=0", "-o", name, status=1)
    assert name in ran.err
    assert "No space left" in ran.err or "cannot be written to a device" in ran.err  # TIFF seeks
    tonetool_v(*two, "--hdrflip:fail=0", "-o", name, status=1)


def test_old_output_survives_an_error(tonetool_v, two, testimages, tmp_path):
    old = tmp_path / "x.exr"
    old.write_bytes(b"old")
    for bad in ("truncated.exr", "y_only.exr", "nosuch.exr", "not_an_image.exr"):
        tonetool_v(two[0], testimages / bad, "--hdrflip:fail=0.9999", "-o", "x.exr", status=1)
        assert old.read_bytes() == b"old"


@pytest.mark.parametrize("closed", [">&-", ">&- 2>&-", "<&- >&- 2>&-", ">/dev/full",
                                    ">/dev/full 2>/dev/full"])
def test_nobody_hears_the_result(program, two, tmp_path, closed, read):
    """Standard output that cannot be written is an error; what is written is not spoilt by it."""
    for last in (two[0], two[1]):
        line = f'"$0" ref.exr {last} --hdrflip:fail=0.9999 -o x.exr {closed}'
        done = subprocess.run(["bash", "-c", line, program], cwd=tmp_path, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60)
        assert done.returncode == 1 and not done.stdout
        assert read("x.exr")[0].any() == (last == two[1])


def test_closed_error_output_changes_no_status(program, two, testimages, tmp_path):
    nan = testimages / "nan_center.exr"
    for words, status in (([*two, "--hdrflip:fail=0"], 3), (["nosuch.exr"], 1),
                          (["--warnings-exit", nan, nan, "--hdrflip:fail=0"], 2)):
        done = subprocess.run(["bash", "-c", 'exec "$0" "$@" 2>&-', program, *map(str, words)],
                              cwd=tmp_path, check=False, stdout=subprocess.DEVNULL, timeout=60)
        assert done.returncode == status


@pytest.mark.parametrize("written", ["b.exr", "./b.exr", "link.exr"])
def test_output_over_an_image_of_the_stack(tonetool_v, put, tmp_path, written):
    """The image on the stack is what its file held when it was named."""
    a, b = put("a.exr", picture(1)), put("b.exr", picture(2))
    (tmp_path / "link.exr").symlink_to("b.exr")
    tonetool_v(a, b, a, "-o", written, "--pop", "--hdrflip:fail=0.01", status=3)


@pytest.mark.parametrize("size", [(1, 1), (300, 400)])
def test_output_of_another_size_over_an_image_of_the_stack(tonetool_v, put, size):
    a, b, c = put("a.exr", picture(1)), put("b.exr", picture(1)), put("c.exr", picture(2, *size))
    tonetool_v(a, b, c, "-o", b, "--pop", "--hdrflip:fail=0", status=0)


@pytest.mark.parametrize("signal", ["TERM", "INT", "HUP"])
def test_killed_while_it_works(program, put, tmp_path, signal):
    """Neither a pass nor half a file."""
    a, b = put("a.exr", picture(1, 600, 800)), put("b.exr", picture(2, 600, 800))
    (tmp_path / "x.exr").write_bytes(b"old")
    with subprocess.Popen([program, a, b, "--hdrflip:fail=0.9999:numExposures=200", "-o", "x.exr"],
                          cwd=tmp_path, stdout=subprocess.PIPE) as running:
        time.sleep(0.5)
        running.send_signal(getattr(signals, f"SIG{signal}"))
        out = running.communicate(timeout=60)[0]
    assert running.returncode != 0 and b"PASS" not in out
    assert sorted(os.listdir(tmp_path)) == [a, b, "x.exr"]
    assert (tmp_path / "x.exr").read_bytes() == b"old"
