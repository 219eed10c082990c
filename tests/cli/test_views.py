# SPDX-License-Identifier: BSD-3-Clause
"""Views of OpenColorIO configurations, shown by --tonemap and compared through by --hdrflip."""

import os
import shutil
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

OCIO = TESTIMAGES.parent / "ocio"
CONFIG = OCIO / "tonetool.ocio"
ACES = "display=sRGB:view='ACES SDR'"
REFERENCE, TEST = TESTIMAGES / "gallery_ref.exr", TESTIMAGES / "gallery_test.exr"


def pixels(path):
    image = oiio.ImageBuf(str(path))
    assert not image.has_error, image.geterror()
    names = list(image.spec().channelnames)
    layer = "" if "R" in names else "ViewLayer.Combined."
    return image.get_pixels(oiio.FLOAT)[..., [names.index(layer + c) for c in "RGB"]]


def error_map(path):
    return oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)[..., 0]


def test_the_environment_names_the_configuration(tonetool, monkeypatch, tmp_path):
    tonetool("--colorconfig", CONFIG, REFERENCE, f"--tonemap:{ACES}", "-o", "a.exr")
    monkeypatch.setenv("OCIO", str(CONFIG))
    tonetool(REFERENCE, f"--tonemap:{ACES}", "-o", "b.exr")
    assert np.array_equal(pixels(tmp_path / "a.exr"), pixels(tmp_path / "b.exr"))


def test_calibration_goes_before_the_view(tonetool, tmp_path):
    tonetool("--colorconfig", CONFIG, REFERENCE, f"--tonemap:{ACES}:stops=1.5", "-d", "float",
             "-o", "a.exr")
    tonetool("--colorconfig", CONFIG, REFERENCE, "--exposure", "1.5", f"--tonemap:{ACES}",
             "-d", "float", "-o", "b.exr")
    assert np.abs(pixels(tmp_path / "a.exr") - pixels(tmp_path / "b.exr")).max() < 1e-6


def test_hdrflip_through_a_baked_view_is_near_the_exact_one(tonetool_v, tmp_path):
    tonetool_v("--colorconfig", CONFIG, REFERENCE, TEST, "--hdrflip", "-o", "curve.exr")
    ran = tonetool_v("--colorconfig", CONFIG, REFERENCE, TEST, f"--hdrflip:{ACES}", "-o", "baked.exr")
    assert ran.fact("tonemapper") == "sRGB/ACES SDR"
    words = ran.fact("bake-error").split()
    assert words[0] == "max" and words[2] == "mean"
    assert 0 < float(words[3]) < float(words[1]) < 0.02
    exact = tonetool_v("--colorconfig", CONFIG, REFERENCE, TEST, f"--hdrflip:{ACES}:exact=1",
                     "-o", "exact.exr")
    assert "bake-error" not in exact.out
    difference = np.abs(error_map(tmp_path / "baked.exr") - error_map(tmp_path / "exact.exr"))
    assert difference.max() <= 5e-3 and difference.mean() <= 5e-4
    # And it is another map than that of the curve.
    assert np.abs(error_map(tmp_path / "curve.exr") - error_map(tmp_path / "exact.exr")).max() > 0.01
    spec = oiio.ImageBuf(str(tmp_path / "baked.exr")).spec()
    assert spec.get_string_attribute("FLIP:tonemapper") == "sRGB/ACES SDR"
    assert spec.get_float_attribute("FLIP:bakeErrorMax") == pytest.approx(float(words[1]), rel=1e-5)


@pytest.mark.parametrize("scene", ["cornell", "nightstreet", "gallery"])
def test_a_baked_view_is_near_the_exact_one_on_rendered_scenes(tonetool, tmp_path, scene):
    folder = Path(os.environ.get("SHARED_DIR") or "/nowhere") / "scenes" / scene
    if not (folder / "ref.exr").is_file():
        pytest.skip("the rendered scenes are not here (SHARED_DIR)")
    for exact in (0, 1):
        tonetool("--colorconfig", CONFIG, folder / "ref.exr", folder / "test_16spp.exr",
                 f"--hdrflip:{ACES}:exact={exact}", "-o", f"{exact}.exr")
    difference = np.abs(error_map(tmp_path / "0.exr") - error_map(tmp_path / "1.exr"))
    assert difference.max() <= 5e-3 and difference.mean() <= 5e-4


@pytest.mark.parametrize("exact", [0, 1])
def test_one_exposure_through_a_view_is_ldrflip_of_what_it_shows(tonetool, tmp_path, exact):
    """The display's own colour space is sRGB: decoding its picture gives the light."""
    tonetool("--colorconfig", CONFIG, REFERENCE, TEST,
             f"--hdrflip:{ACES}:exact={exact}:startExposure=0.5:numExposures=1", "-o", "hdr.exr")
    for name, image in (("a", REFERENCE), ("b", TEST)):
        tonetool("--colorconfig", CONFIG, image, f"--tonemap:{ACES}:stops=0.5", "-d", "float",
                 "-o", f"{name}.exr")
    tonetool("a.exr", "b.exr", "--ldrflip:from=srgb", "-o", "ldr.exr")
    difference = np.abs(error_map(tmp_path / "hdr.exr") - error_map(tmp_path / "ldr.exr"))
    # OpenColorIO's pow is a few 1e-5 off; the table as far as it may be.
    assert difference.max() < (1e-3 if exact else 5e-3)


@pytest.mark.parametrize("exact", [0, 1])
def test_an_image_is_itself_through_a_view(tonetool_v, exact):
    ran = tonetool_v("--colorconfig", CONFIG, TEST, TEST, f"--hdrflip:{ACES}:exact={exact}:fail=0")
    assert ran.fact("mean") == "0"


def test_a_threshold_is_exceeded_through_a_view(tonetool):
    tonetool("--colorconfig", CONFIG, REFERENCE, TEST, f"--hdrflip:{ACES}:fail=0.01", status=3)


def test_bands_and_threads_give_the_same_map(tonetool_v, tmp_path):
    for name, words in (("a", ["--threads", 1]), ("b", ["--threads", 3]),
                        ("c", ["--memory", "200M"])):
        ran = tonetool_v(*words, "--colorconfig", CONFIG, REFERENCE, TEST, f"--hdrflip:{ACES}",
                       "-o", f"{name}.exr")
        assert ran.fact("bake-error")
    assert np.array_equal(error_map(tmp_path / "a.exr"), error_map(tmp_path / "b.exr"))
    assert np.array_equal(error_map(tmp_path / "a.exr"), error_map(tmp_path / "c.exr"))


def test_a_grey_of_the_references_median_is_shown_at_085(tonetool_v, make_image, tmp_path):
    ran = tonetool_v("--colorconfig", CONFIG, REFERENCE, TEST, f"--hdrflip:{ACES}:exact=1")
    words = ran.fact("exposures").split()
    for fact, stops in (("max-luminance", float(words[1])), ("median-luminance", float(words[3]))):
        value = float(ran.fact(fact)) * 2 ** stops
        grey = make_image("grey.exr", 4, 4, pixels=np.full((4, 4, 3), value, np.float32))
        tonetool_v("--colorconfig", CONFIG, grey, f"--tonemap:{ACES}", "-d", "float", "-o", "out.exr")
        code = float(pixels(tmp_path / "out.exr").mean())
        assert ((code + 0.055) / 1.055) ** 2.4 == pytest.approx(0.85, abs=1e-4)


def test_displays_of_high_dynamic_range_need_a_peak(tonetool_v):
    pq = "--hdrflip:display=Rec.2100-PQ:view='ACES HDR 1000'"
    ran = tonetool_v("--colorconfig", CONFIG, REFERENCE, TEST, pq, status=1)
    assert "high dynamic range" in ran.err and "peak=" in ran.err
    ran = tonetool_v("--colorconfig", CONFIG, REFERENCE, TEST, pq + ":peak=1000")
    assert float(ran.fact("mean")) > 0.05


def broken_configs(folder):
    """Name of a configuration that is no good, and a word of what is said of it."""
    (folder / "garbage.ocio").write_text("ocio_profile_version: [", encoding="utf-8")
    newer = CONFIG.read_text(encoding="utf-8").replace("ocio_profile_version: 2.1",
                                                       "ocio_profile_version: 2.9", 1)
    assert "2.9" in newer
    (folder / "newer.ocio").write_text(newer, encoding="utf-8")
    (folder / "empty.ocio").write_text("", encoding="utf-8")
    return ["garbage.ocio", "newer.ocio", "empty.ocio", "missing.ocio"]


@pytest.mark.parametrize("command", ["tonemap", "hdrflip"])
def test_configurations_that_are_no_good(tonetool, tmp_path, command):
    for name in broken_configs(tmp_path):
        ran = tonetool("--colorconfig", name, REFERENCE, *([TEST] if command == "hdrflip" else []),
                       f"--{command}:{ACES}", "-o", "out.exr", status=1)
        assert name in ran.err, (name, ran.err)
        assert not (tmp_path / "out.exr").exists()


@pytest.mark.parametrize("command", ["tonemap", "hdrflip"])
def test_a_view_whose_table_is_missing(tonetool, tmp_path, command):
    shutil.copy(CONFIG, tmp_path / "alone.ocio")
    images = [REFERENCE, TEST] if command == "hdrflip" else [REFERENCE]
    ran = tonetool("--colorconfig", "alone.ocio", *images, f"--{command}:display=sRGB:view=hable",
                   "-o", "out.exr", status=1)
    assert "hable" in ran.err
    assert not (tmp_path / "out.exr").exists()
    # The others need none.
    tonetool("--colorconfig", "alone.ocio", *images, f"--{command}:{ACES}", "-o", "out.exr")


BAD = [
    ("display=sRBG:view='ACES SDR'", ["sRBG", "sRGB"]),
    ("display=sRGB:view='ACES SDX'", ["ACES SDX", "ACES SDR"]),
    ("display=sRGB:view='ACES SDR':looks=nicer", ["nicer"]),
    ("display=sRGB:view='ACES SDR':context=A", ["context", "NAME=VALUE"]),
    ("view='ACES SDR':from=acesgc", ["acesgc", "ACEScg"]),
]


@pytest.mark.parametrize("modifiers,words", BAD)
def test_names_that_the_configuration_does_not_know(tonetool, modifiers, words):
    ran = tonetool("--colorconfig", CONFIG, REFERENCE, f"--tonemap:{modifiers}", "-o", "out.exr",
                   status=1)
    for word in words:
        assert word in ran.err, ran.err


def test_a_comparison_says_so_too(tonetool):
    for modifiers, words in (("display=sRGB:view='ACES SDX'", ["ACES SDX", "ACES SDR"]),
                             ("display=sRGB:tonemapper=aces", ["tonemapper", "view"]),
                             ("exact=1", ["exact"]), ("encoding=srgb", ["encoding"]),
                             ("peak=100", ["peak"]),
                             ("display=sRGB:view='ACES SDR':peak=0", ["peak"])):
        ran = tonetool("--colorconfig", CONFIG, REFERENCE, TEST, f"--hdrflip:{modifiers}", status=1)
        for word in words:
            assert word in ran.err, ran.err


# Configurations that differ in what they say of their light. LOG is a curve behind which light is.
PLAIN_CONFIG = """ocio_profile_version: 2
roles: {{default: raw, {roles}}}
displays:
  screen:
    - !<View> {{name: Film, colorspace: code}}
colorspaces:
  - !<ColorSpace> {{name: raw, isdata: true}}
  - !<ColorSpace> {{name: {light}}}
  - !<ColorSpace> {{name: LOG, to_scene_reference: !<LogTransform> {{base: 2, direction: inverse}}}}
  - !<ColorSpace> {{name: code, from_scene_reference: !<ExponentTransform> {{value: [2.2, 2.2, 2.2, 1], direction: inverse}}}}
"""
FILM = "view=Film:encoding=gamma2.2"


@pytest.mark.parametrize("roles,light", [("scene_linear: light", "light"),
                                         ("rendering: light", "light"),
                                         ("scene_linear: lin_ap1", "lin_ap1"),
                                         ("aces_interchange: AP0x", "AP0x"),
                                         ("scene_linear: lin_srgb", "lin_srgb")])
def test_hdrflip_from_a_space_of_the_configuration(tonetool_v, make_image, tmp_path, roles, light):
    (tmp_path / "c.ocio").write_text(PLAIN_CONFIG.format(roles=roles, light=light))
    config = ["--colorconfig", "c.ocio"]
    scene = np.random.default_rng(1).uniform(0.1, 2, (12, 16, 3)).astype(np.float32)
    lit, brighter = make_image("a.exr", pixels=scene), make_image("b.exr", pixels=scene * 1.5)
    log, brighter_log = (make_image(f"{name}_log.exr", pixels=np.log2(pixels))
                         for name, pixels in (("a", scene), ("b", scene * 1.5)))
    same = ":startExposure=-2:stopExposure=0:exact=1"
    want = tonetool_v(*config, lit, brighter, f"--hdrflip:{FILM}:from={light}{same}")
    got = tonetool_v(*config, log, brighter_log, f"--hdrflip:{FILM}:from=LOG{same}")
    assert got.fact("reference-space") == "LOG"
    assert float(want.fact("mean")) > 0.05
    assert abs(float(got.fact("mean")) - float(want.fact("mean"))) < 1e-3
    tonetool_v(*config, log, log, f"--hdrflip:{FILM}:from=LOG:fail=0")
    # As --tonemap takes it.
    tonetool_v(*config, log, f"--tonemap:view=Film:from=LOG", "-o", "t.exr")
    assert np.abs(pixels(tmp_path / "t.exr") - scene ** (1 / 2.2)).max() < 1e-3
    for command in (f"hdrflip:{FILM}", "tonemap:view=Film"):
        ran = tonetool_v(*config, log, log, f"--{command}:from=LOGS", status=1)
        assert 'did you mean "LOG"' in ran.err


def test_without_from_a_configuration_must_say_its_light(tonetool, tmp_path):
    (tmp_path / "c.ocio").write_text(
        PLAIN_CONFIG.format(roles="scene_linear: light", light="light"))
    ran = tonetool("--colorconfig", "c.ocio", REFERENCE, TEST, f"--hdrflip:{FILM}", status=1)
    assert "from=" in ran.err and "light" in ran.err


def test_a_misspelt_context_variable_is_an_error(tonetool, tmp_path):
    ran = tonetool("--colorconfig", CONFIG, REFERENCE, f"--tonemap:{ACES}:context=SHOTS=a", "-o",
                   "a.exr", status=1)
    assert 'unknown context variable "SHOTS"' in ran.err
    text = PLAIN_CONFIG.format(roles="scene_linear: light", light="light")
    (tmp_path / "c.ocio").write_text(text.replace("displays:", "environment: {SHOT: x}\ndisplays:"))
    for command in ("tonemap:view=Film:from=light", f"hdrflip:{FILM}:from=light"):
        words = ["--colorconfig", "c.ocio", REFERENCE, REFERENCE]
        ran = tonetool(*words, f"--{command}:context=SHOTS=a", "-o", "a.exr", status=1)
        assert 'did you mean "SHOT"' in ran.err
        tonetool(*words, f"--{command}:context=SHOT=a", "-o", "a.exr")
