# SPDX-License-Identifier: BSD-3-Clause
"""The unit of pixels, and exposures by a camera."""

import json
import math

import numpy as np
import OpenImageIO as oiio
import pytest

SUNNY = ":method=camera:fnumber=16:shutter=0.008:iso=100"
SATURATES = 38400  # cd/m2
HEADER = {"aperture": 16.0, "expTime": 0.008, "isoSpeed": 100.0}
CLOSE = 1e-5  # six digits are printed, and headers are float


@pytest.fixture
def scene(make_image):
    """A picture of light about 1, and its header."""
    values = np.exp2(np.random.default_rng(3).normal(0, 1, (24, 32, 3)))

    def make(name="s.exr", scale=1.0, **attributes):
        return make_image(name, 32, 24, pixels=values * scale, attributes=attributes)

    return make


def attribute(path, name):
    return oiio.ImageBuf(str(path)).spec().getattribute(name)


def test_sunny_sixteen(tonetool, scene, read):
    ran = tonetool(scene(), "--calibrate" + SUNNY, "-o", "o.exr")
    assert float(ran.fact("ev100")) == pytest.approx(14.966, abs=5e-4)
    assert float(ran.fact("unit")) == 1
    assert float(ran.fact("exposure")) == pytest.approx(-math.log2(SATURATES), rel=CLOSE)
    assert np.allclose(read("o.exr")[0], read("s.exr")[0] / SATURATES, rtol=1e-6, atol=0)


def test_what_saturates_becomes_white(tonetool, make_image, read):
    make_image("grey.exr", pixels=np.full((12, 16, 3), SATURATES / 179 / 4))
    tonetool("grey.exr", f"--calibrate{SUNNY}:unit=179:stops=2", "-o", "o.exr")
    assert np.allclose(read("o.exr")[0], 1, rtol=1e-6)


def test_the_header_tells(tonetool, scene, read):
    tonetool(scene(), f"--calibrate{SUNNY}:unit=250", "-o", "given.exr")
    ran = tonetool(scene("h.exr", **HEADER, whiteLuminance=250.0), "--calibrate:method=camera", "-o",
                   "header.exr")
    assert float(ran.fact("unit")) == 250
    assert np.allclose(read("header.exr")[0], read("given.exr")[0], rtol=1e-6)
    # What is given comes first.
    ran = tonetool("h.exr", "--calibrate:method=camera:fnumber=8:unit=1", "-o", "o.exr")
    assert float(ran.fact("ev100")) == pytest.approx(12.966, abs=5e-4)
    assert float(ran.fact("unit")) == 1


@pytest.mark.parametrize("lacks, title, option", [
    ("aperture", "aperture", "fnumber"), ("expTime", "expTime", "shutter"), ("isoSpeed", "isoSpeed", "iso")])
@pytest.mark.parametrize("command", ["calibrate", "tonemap", "cgtmo"])
def test_a_missing_setting_is_named(tonetool, scene, command, lacks, title, option):
    scene(**{name: value for name, value in HEADER.items() if name != lacks})
    err = tonetool("s.exr", f"--{command}:method=camera", "-o", "o.exr", status=1).err
    assert f"the header has no {title}" in err and f"{option}=X" in err


@pytest.mark.parametrize("options, words", [
    (":fnumber=8", ["fnumber", "method=camera", "manual"]),
    (":method=mean:iso=100", ["iso", "method=camera", "mean"]),
    (":unit=100", ["unit", "method=camera", "method=auto", "manual"]),
    (":method=mean:unit=100", ["unit", "method=mean"]),
    (SUNNY + ":key=0.2", ["key", "camera"]),
    (SUNNY + ":level=2", ["local means", "mean or auto"]),
    (SUNNY + ":adapt=shot", ["shot"]),
    (":method=camera:fnumber=0:shutter=1:iso=1", ["fnumber 0", "1e-30"]),
    (":method=camera:fnumber=1:shutter=-1:iso=1", ["shutter -1", "1e-30"]),
    (SUNNY + ":unit=0", ["unit 0", "1e-30"]),
    (SUNNY.replace("0.008", "1/0"), ['shutter "1/0" is not a number']),
    (SUNNY.replace("0.008", "1/-125"), ["shutter -0.008 is out of range"]),
    (SUNNY.replace("0.008", "1/125s"), ['shutter "1/125s" is not a number']),
])
@pytest.mark.parametrize("command", ["calibrate", "tonemap"])
def test_errors(tonetool, scene, command, options, words):
    err = tonetool(scene(), f"--{command}{options}", "-o", "o.exr", status=1).err
    for word in words:
        assert word in err


def test_a_time_may_be_a_fraction(tonetool, scene, read):
    whole = tonetool(scene(), "--calibrate" + SUNNY, "-o", "a.exr")
    fraction = tonetool(scene(), "--calibrate" + SUNNY.replace("0.008", "1/125"), "-o", "b.exr")
    assert fraction.fact("ev100") == whole.fact("ev100") == "14.9658"
    assert np.array_equal(read("a.exr")[0], read("b.exr")[0])


def test_a_key_of_the_mean_needs_a_unit(tonetool, scene):
    """1.03 - 2 / (2 + log10(Lav unit + 1)), and the exposure is key / Lav in pixel values."""
    for unit in (1, 179):
        ran = tonetool(scene(), f"--calibrate:method=auto:unit={unit}", "-o", "o.exr")
        mean, key = float(ran.fact("mean")), float(ran.fact("key"))
        assert key == pytest.approx(1.03 - 2 / (2 + math.log10(mean * unit + 1)), rel=CLOSE)
        assert float(ran.fact("exposure")) == pytest.approx(math.log2(key / mean), rel=CLOSE)
    # The same scene in other units has the same key.
    dim = tonetool(scene("dim.exr", 0.01, whiteLuminance=17900.0), "--calibrate:method=auto", "-o", "d.exr")
    assert float(dim.fact("key")) == pytest.approx(key, rel=CLOSE)


def test_a_unit_that_nobody_says_is_a_remark(tonetool, scene):
    plain = tonetool(scene(), "--calibrate:method=auto", "-o", "o.exr")
    told = tonetool("-v", "s.exr", "--calibrate:method=auto", "-o", "o.exr")
    given = tonetool("-v", "s.exr", "--calibrate:method=auto:unit=1", "-o", "o.exr")
    assert "whiteLuminance" in told.fact("note") and not told.err
    assert float(plain.fact("key")) == float(given.fact("key")) and "note" not in given.out


def test_a_curve_after_a_camera(tonetool, scene, tmp_path, read):
    tonetool(scene(), f"--calibrate{SUNNY}:unit=40000", "--tonemap:curve=hable:encode=none", "-o", "two.exr")
    tonetool("s.exr", f"--tonemap{SUNNY}:unit=40000:curve=hable:encode=none", "-o", "one.exr")
    assert np.allclose(read("one.exr")[0], read("two.exr")[0], rtol=1e-5)
    assert attribute(tmp_path / "one.exr", "tonemap:ev100") == pytest.approx(14.966, abs=5e-4)
    assert attribute(tmp_path / "one.exr", "tonemap:unit") == 40000


def test_white_is_measured_behind_the_camera(tonetool, scene):
    ran = tonetool(scene(), f"--tonemap{SUNNY}:unit=38400:curve=reinhard-extended:white=max", "-o", "o.exr")
    largest = tonetool("s.exr", "--luminancestats").fact("max")
    assert values(ran, "white") == pytest.approx([float(largest)] * 2, rel=CLOSE)


def test_cgtmo_adapts_to_what_the_camera_is_exposed_for(tonetool, scene, tmp_path):
    ran = tonetool(scene(), f"--cgtmo{SUNNY}:unit=4000", "-o", "o.exr")
    assert ran.fact("adaptation-from") == "camera"
    assert float(ran.fact("adaptation")) == pytest.approx(SATURATES * 0.104 / 4000, rel=CLOSE)
    assert float(ran.fact("ev100")) == pytest.approx(14.966, abs=5e-4)
    plain = tonetool("s.exr", "--cgtmo", "-o", "o2.exr")
    assert ran.fact("maximum") == plain.fact("maximum") and "ev100" not in plain.out
    assert attribute(tmp_path / "o.exr", "tonemap:ev100") == pytest.approx(14.966, abs=5e-4)
    # The same picture as with that number.
    tonetool("s.exr", f"--cgtmo:lwa={SATURATES * 0.104 / 4000}", "-o", "o3.exr")
    first, second = (oiio.ImageBuf(str(tmp_path / name)).get_pixels(oiio.FLOAT) for name in ("o.exr", "o3.exr"))
    assert np.allclose(first, second, atol=1e-6)


@pytest.mark.parametrize("options, words", [
    (SUNNY + ":lwa=cells", ["lwa", "method=camera"]), (":iso=100", ["iso", "method=camera"]),
    (":unit=100", ["unit", "method=camera"]), (":method=auto", ["auto", "measured", "camera"])])
def test_errors_of_cgtmo(tonetool, scene, options, words):
    err = tonetool(scene(), f"--cgtmo{options}", "-o", "o.exr", status=1).err
    for word in words:
        assert word in err


@pytest.fixture
def shot(scene):
    for number, light in enumerate((1, 3, 9), 1):
        scene(f"s.{number:04}.exr", light)


def values(ran, name):
    return [float(line.split(f"{name} ")[1]) for line in ran.out.splitlines() if f": {name} " in line]


def test_a_camera_measures_no_shot(tonetool, shot, tmp_path):
    words = ["--frames", "1-3", "s.#.exr"]
    ran = tonetool(*words, "--calibrate" + SUNNY, "-o", "o.#.exr")
    assert "adapted" not in ran.out and values(ran, "ev100") == pytest.approx([14.966] * 3, abs=5e-4)
    err = tonetool(*words, "--calibrate" + SUNNY, "--statistics", "s.json", status=1).err
    assert "--statistics" in err and not (tmp_path / "s.json").exists()
    ran = tonetool(*words, f"--cgtmo{SUNNY}:unit=4000", "-o", "o.#.exr")
    assert len(set(values(ran, "adaptation"))) == 1 and "maximum-from shot" in ran.out


def test_a_shot_has_the_unit_that_is_given(tonetool, shot, tmp_path):
    words = ["--frames", "1-3", "s.#.exr"]
    once = tonetool(*words, "--calibrate:method=auto:unit=50", "-o", "o.#.exr")
    keys = values(once, "key")
    mean = values(once, "mean")[0]
    assert keys == pytest.approx([1.03 - 2 / (2 + math.log10(mean * 50 + 1))] * 3, rel=CLOSE)
    tonetool(*words, "--calibrate:method=auto:unit=50", "--statistics", "s.json")
    kept = json.loads((tmp_path / "s.json").read_text())
    assert [frame["unit"] for frame in kept["frames"]] == [50] * 3
    later = tonetool(*words, "--calibrate:method=auto:adapt=s.json", "-o", "p.#.exr")
    assert values(later, "key") == keys
    # Eyes adapt to cd/m2, too.
    eye = tonetool(*words, "--cgtmo:adapt=eye:unit=0.01", "-o", "e.#.exr")
    other = tonetool(*words, "--cgtmo:adapt=eye:unit=1000", "-o", "f.#.exr")
    assert values(eye, "adaptation")[2] < values(other, "adaptation")[2]


def test_frames_of_two_units(tonetool, scene):
    for number, unit in enumerate((10.0, 20.0), 1):
        scene(f"t.{number:04}.exr", whiteLuminance=unit)
    words = ["--frames", "1-2", "t.#.exr"]
    err = tonetool(*words, "--calibrate:method=auto", "-o", "o.#.exr", status=1).err
    assert "whiteLuminance" in err and "10" in err and "20" in err and "unit=X" in err
    ran = tonetool(*words, "--calibrate:method=auto:unit=10", "-o", "o.#.exr")
    assert values(ran, "unit") == [10, 10]
    scene("t.0001.exr")
    assert "some frames have no whiteLuminance, and others have 20 (valid: unit=X)" in \
        tonetool(*words, "--calibrate:method=auto", "-o", "o.#.exr", status=1).err


def test_help_says_the_unit(tonetool):
    for command in ("calibrate", "tonemap", "cgtmo"):
        text = " ".join(tonetool("--help", command).out.split())
        assert "cd/m2 of a pixel value of 1" in text and "whiteLuminance" in text and "179" in text


@pytest.mark.parametrize("name, value", [("aperture", 0.0), ("expTime", -0.02)])
def test_a_header_with_a_wrong_setting(tonetool, scene, name, value):
    scene("w.exr", **{**HEADER, name: value})
    err = tonetool("w.exr", "--tonemap:method=camera", "-o", "o.png", status=1).err
    assert f"the header's {name} is {value:g}: must be above 0" in err
