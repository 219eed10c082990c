# SPDX-License-Identifier: BSD-3-Clause
"""What the FLIP commands print and push, and the status they end with."""

import numpy as np
import pytest


def test_summary_is_one_fact_a_line(tonetool_v, pair):
    ran = tonetool_v(*pair, "--hdrflip", "-o", "x.exr")
    assert all(line.startswith("hdrflip: ") for line in ran.out.splitlines())
    assert ran.fact("reference") == str(pair[0]) and ran.fact("test") == str(pair[1])
    assert ran.fact("reference-layer") == "ViewLayer.Combined"
    assert ran.fact("tonemapper") == "aces"
    assert ran.fact("exposures").startswith("start ")
    for name in ("mean", "weighted-median", "weighted-q1", "weighted-q3", "p50", "p95", "p99",
                 "p99.9", "ppd", "reference-nonfinite", "test-negative", "test-uncovered"):
        assert float(ran.fact(name)) >= 0
    value, where = ran.fact("max").split(" at ")
    assert 0 < float(value) <= 1 and len(where.split(",")) == 2


def test_summary_agrees_with_the_map(tonetool_v, pair, read):
    ran = tonetool_v(*pair, "--hdrflip", "-o", "x.exr")
    pixels = read("x.exr")[0][:, :, 0].astype(np.float64)
    assert float(ran.fact("mean")) == pytest.approx(pixels.mean(), rel=1e-5)
    value, where = ran.fact("max").split(" at ")
    x, y = map(int, where.split(","))
    assert pixels[y, x] == pixels.max() == pytest.approx(float(value), rel=1e-5)


@pytest.mark.parametrize("command", ["hdrflip", "ldrflip", "flipdiff"])
def test_identical_images_give_exactly_zero(tonetool_v, pair, read, command):
    ran = tonetool_v(pair[0], pair[0], f"--{command}:fail=0", "-o", "x.exr")
    assert f"{command}: PASS" in ran.out
    assert ran.fact("mean") == "0" and not read("x.exr")[0].any()


def test_threshold_statuses(tonetool_v, pair, tmp_path):
    mean = tonetool_v(*pair, "--hdrflip").fact("mean")
    ran = tonetool_v(*pair, "--hdrflip:fail=0.001", "-o", "x.exr", status=3)
    assert f"hdrflip: FAIL mean {mean} > 0.001" in ran.out
    assert (tmp_path / "x.exr").exists()
    ran = tonetool_v(*pair, "--hdrflip:fail=0.999")
    assert f"hdrflip: PASS mean {mean} <= 0.999" in ran.out
    tonetool_v(*pair, "--hdrflip:fail=0.999:warn=0.001")
    ran = tonetool_v(*pair, "--hdrflip:fail=0.999:warn=0.001", "--warnings-exit", status=2)
    assert f"tonetool WARNING: hdrflip : mean {mean} > 0.001" in ran.err
    tonetool_v(*pair, "--hdrflip:fail=0.001:warn=0.001", "--warnings-exit", status=3)
    tonetool_v(*pair, "--hdrflip:fail=0.001", "--pop", pair[0], pair[0], "--hdrflip:fail=0",
             status=3)


@pytest.mark.parametrize("quantity", ["mean", "weighted-median", "weighted-q1", "weighted-q3",
                                      "p50", "p95", "p99", "p99.9", "min", "max"])
def test_every_quantity_can_fail(tonetool_v, pair, quantity):
    value = tonetool_v(*pair, "--hdrflip").fact(quantity).split(" at ")[0]
    ran = tonetool_v(*pair, f"--hdrflip:fail=0.999:quantity={quantity}")
    assert f"PASS {quantity} {value} <= 0.999" in ran.out
    if float(value) > 1e-3:
        limit = float(value) * 0.99
        tonetool_v(*pair, f"--hdrflip:fail={limit}:quantity={quantity}", status=3)


def test_quiet_shows_failures_and_warnings_only(tonetool, pair):
    ran = tonetool("-q", *pair, "--hdrflip:fail=0.001:warn=0.001", status=3)
    assert ran.out.splitlines() == [ran.out.strip()] and ran.out.startswith("hdrflip: FAIL mean")
    assert "WARNING" in ran.err
    assert tonetool("-q", *pair, "--hdrflip:fail=0.999").out == ""
    ran = tonetool(*pair, "--hdrflip:fail=0.999:print=0")
    assert ran.out.startswith("hdrflip: PASS") and len(ran.out.splitlines()) == 1


def test_nonfinite_pixels_are_warnings(tonetool_v, testimages):
    words = [testimages / "plain.exr", testimages / "nan_center.exr", "--hdrflip:fail=0.999"]
    assert "WARNING: hdrflip" in tonetool_v(*words).err
    ran = tonetool_v("--warnings-exit", *words, status=2)
    assert ran.fact("test-nonfinite") == "1"


@pytest.mark.parametrize("kind", ["stops", "index"])
def test_exposure_map_lies_below(tonetool_v, pair, read, kind):
    ran = tonetool_v(*pair, f"--hdrflip:exposuremap={kind}", "-o", "e.exr", "--pop", "-o", "m.exr")
    start, stop, count = (float(word) for word in ran.fact("exposures").split()[1::2])
    error, exposures = read("e.exr")[0], read("m.exr")[0]
    assert error.max() <= 1
    if kind == "index":
        assert set(np.unique(exposures)) <= set(range(int(count)))
    else:
        assert exposures.min() >= start - 1e-3 and exposures.max() <= stop + 1e-3


def test_several_tests_against_one_reference(tonetool, pair, read):
    alone = tonetool(*pair, "--hdrflip", "-o", "one.exr")
    ran = tonetool(pair[0], pair[0], pair[1], "--hdrflip:tests=2", "-o", "b.exr", "--pop", "-o",
                   "a.exr")
    assert np.array_equal(read("one.exr")[0], read("b.exr")[0])
    assert not read("a.exr")[0].any()
    assert ran.out.endswith(alone.out)
    tonetool(pair[0], pair[0], "--hdrflip:tests=2", status=1)
    tonetool(pair[0], pair[0], pair[1], "--hdrflip:tests=2:fail=0", status=3)


def test_exposures_are_saved(tonetool_v, pair, tmp_path, read):
    ran = tonetool_v(*pair, "--hdrflip:saveexposures=s:numExposures=3", "-o", "x.exr")
    assert ran.fact("exposures").endswith("count 3")
    for i in range(3):
        for what in ("reference", "test", "flip"):
            assert (tmp_path / f"s.0{i}.{what}.exr").exists()
    maps = [read(f"s.0{i}.flip.exr")[0] for i in range(3)]
    assert np.array_equal(np.max(maps, axis=0), read("x.exr")[0])


def test_modifiers_reach_the_library(tonetool_v, pair):
    ran = tonetool_v(*pair, "--hdrflip:tonemapper=hable:ppd=40:startExposure=-2:stopExposure=3:"
                          "numExposures=4")
    assert ran.fact("tonemapper") == "hable" and ran.fact("ppd") == "40"
    assert ran.fact("exposures") == "start -2 stop 3 count 4"
    ran = tonetool_v(*pair, "--hdrflip:distance=1.4:width=0.7:pixels=1920")
    assert float(ran.fact("ppd")) == pytest.approx(1.4 * 1920 / 0.7 * np.pi / 180, rel=1e-5)
    ran = tonetool_v(*pair, "--hdrflip:layer=ViewLayer.Combined_key")
    assert ran.fact("reference-layer") == "ViewLayer.Combined_key"


def test_derived_images_keep_their_encoding(tonetool_v, testimages, make_image):
    grey = make_image("a.tif", kind="uint16")
    straight = tonetool_v(grey, grey, "--hdrflip")
    derived = tonetool_v(grey, "--ch", "R,G,B", grey, "--hdrflip:fail=0")
    assert straight.fact("reference-space") == derived.fact("reference-space")
    assert tonetool_v(grey, "--exposure", "1", "-o", "x.exr", status=1).err


def test_flipdiff_speaks_openimageio(tonetool_v, pair, read):
    ran = tonetool_v(*pair, "--flipdiff", "-o", "x.exr")
    assert ran.fact("ppd") == "67.02" and ran.fact("exposures").endswith("count 4")
    fixed = tonetool_v(*pair, "--hdrflip:maxluminance=2:medianluminance=0.18:ppd=67.02")
    assert ran.fact("mean") == fixed.fact("mean")
    auto = tonetool_v(*pair, "--flipdiff:maxluminance=0")
    assert auto.fact("mean") == tonetool_v(*pair, "--hdrflip:ppd=67.02").fact("mean")
    ldr = tonetool_v(*pair, "--flipdiff:hdr=0")
    assert ldr.fact("mean") == tonetool_v(*pair, "--ldrflip:ppd=67.02").fact("mean")
    _, spec = read("x.exr")
    for key in ("FLIP:meanerror", "FLIP:maxerror", "FLIP:maxx", "FLIP:maxy",
                "FLIP:startExposure", "FLIP:stopExposure", "FLIP:numExposures"):
        assert spec.getattribute(key) is not None, key


def test_flipdiff_fails_on_the_largest_error(tonetool, pair, read):
    ran = tonetool(*pair, "--flipdiff:fail=0.01:colormap=magma", "-o", "x.png", status=3)
    assert "FAILURE" in ran.out.splitlines() and "flipdiff: FAIL max " in ran.out
    assert read("x.png")[1].nchannels == 3
    ran = tonetool(*pair, "--flipdiff:fail=0.999")
    assert "PASS" in ran.out.splitlines()
    tonetool(*pair, "--flipdiff:colormap=nosuch", status=1)


def test_filmstrip(tonetool_v, pair, read):
    ran = tonetool_v(*pair, "--filmstrip:width=64:columns=3:fail=0.999", "-o", "x.png")
    pixels, spec = read("x.png")
    assert spec.nchannels == 3 and pixels.std() > 0.01
    assert float(ran.fact("mean")) > 0
    tonetool_v(*pair, "--filmstrip:width=0", "-o", "x.png", status=1)


def test_exposure(tonetool_v, pair, read):
    tonetool_v(pair[0], "--exposure", "-2", "-o", "x.exr")
    tonetool_v(pair[0], "--exposure", "-2", "--exposure", "2", "-o", "same.exr")
    a, spec = read("x.exr")
    before, after = tonetool_v(pair[0], "--luminancestats"), tonetool_v("x.exr", "--luminancestats")
    assert float(after.fact("max")) == pytest.approx(float(before.fact("max")) / 4, rel=1e-3)
    assert a.shape[2] == 35 and spec.nchannels == 35


def test_luminance_statistics(tonetool_v, pair, testimages):
    ran = tonetool_v(pair[0], "--luminancestats")
    assert ran.fact("layer") == "ViewLayer.Combined"
    assert float(ran.fact("min")) <= float(ran.fact("median")) <= float(ran.fact("max"))
    ran = tonetool_v("--warnings-exit", testimages / "nan_center.exr", "--luminancestats", status=2)
    assert ran.fact("nonfinite") == "1"


def test_threads_do_not_change_the_numbers(tonetool, pair):
    one = tonetool("--threads", "1", *pair, "--hdrflip")
    assert one.out == tonetool("--threads", "2", *pair, "--hdrflip").out


COMBINED = tuple(f"ViewLayer.Combined.{c}" for c in "RGB")


@pytest.mark.parametrize("command", ["--hdrflip:fail=mean=0.5", "--errormap:metric=mse:fail=9",
                                     "--biascheck:fail=1"])
@pytest.mark.parametrize("swapped", [False, True])
def test_one_picture_is_not_compared_with_another_by_the_way(tonetool, make_image, command, swapped):
    """A copy as plain R,G,B beside a changed beauty would pass."""
    pixels = np.random.default_rng(2).random((64, 64, 6))
    make_image("one.exr", 64, 64, channels=COMBINED, pixels=pixels[:, :, 3:])
    make_image("both.exr", 64, 64, channels=("R", "G", "B", *COMBINED), pixels=pixels)
    pair = ("both.exr", "one.exr") if swapped else ("one.exr", "both.exr")
    ran = tonetool(*pair, command, status=1)
    assert "both have ViewLayer.Combined (layer=ViewLayer.Combined compares that)" in ran.err
    words = command.split(":")
    tonetool(*pair, ":".join([words[0], "layer=ViewLayer.Combined", *words[1:]]))


def test_another_picture_is_said_where_nothing_judges(tonetool, make_image):
    make_image("one.exr", channels=COMBINED)
    make_image("both.exr", channels=("R", "G", "B", *COMBINED))
    assert "both have ViewLayer.Combined" in tonetool("one.exr", "both.exr", "--hdrflip").err
    make_image("plain.exr")
    assert "both have" not in tonetool("one.exr", "plain.exr", "--hdrflip").err


@pytest.mark.parametrize("layer, told", [
    ("Combned", 'no colour layer "Combned"; did you mean "ViewLayer.Combined"? layers with R,G,B: '),
    ("difcol", 'no colour layer "difcol"; did you mean "ViewLayer.DiffCol"? '),
    ("Depth", 'layer "Depth" has no R,G,B; layers with R,G,B: '), ("Nothing", 'no colour layer "Nothing"; layers')])
def test_a_layer_that_is_not_there(tonetool, testimages, layer, told):
    words = [testimages / "cornell_ref.exr", testimages / "cornell_test.exr"]
    assert told in tonetool(*words, f"--hdrflip:layer={layer}", status=1).err


def test_pictures_of_two_sizes_are_named(tonetool, testimages):
    words = [testimages / "cornell_ref.exr", testimages / "gallery_ref.exr"]
    ran = tonetool(*words, "--hdrflip", status=1)
    assert ("hdrflip : the reference's display window is 96x96+0+0, the test's 128x72+0+0; they must be the same, "
            f'or ask for resize=1 or crop=1 (reference "{words[0]}", test "{words[1]}")') in ran.err
