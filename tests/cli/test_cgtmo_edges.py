# SPDX-License-Identifier: BSD-3-Clause
"""--cgtmo:base=edges, the noise that it leaves, and what becomes of colours brighter than white."""

import json
import os
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
LINEAR = "encode=none:clamp=0"
GOLDENS = Path(os.environ.get("SHARED_DIR", "")) / "golden" / "shot"
needs_goldens = pytest.mark.skipif(not (GOLDENS / "numbers.json").exists(),
                                   reason="SHARED_DIR has no golden/shot")


def planes_of(path):
    image = oiio.ImageBuf(str(path))
    assert not image.has_error, image.geterror()
    pixels = image.get_pixels(oiio.FLOAT).astype(float)
    return {name: pixels[..., i] for i, name in enumerate(image.spec().channelnames)}


def color(path):
    planes = planes_of(path)
    layer = "" if "R" in planes else "ViewLayer.Combined."
    return np.stack([planes[layer + c] for c in "RGB"], -1)


@pytest.fixture
def mapped(tonetool, tmp_path):
    """The colours that --cgtmo makes of an image, and what it printed."""

    def mapped(image, options, *before):
        ran = tonetool(*before, image, f"--cgtmo:{options}", "-d", "float", "-o", "mapped.exr")
        found = color(tmp_path / "mapped.exr")
        (tmp_path / "mapped.exr").unlink()
        oiio.ImageCache(True).invalidate_all(True)
        return found, ran

    return mapped


@needs_goldens
@pytest.mark.parametrize("scene", ["cornell", "nightstreet", "gallery"])
def test_goldens_of_the_whole_window(mapped, scene):
    golden = planes_of(GOLDENS / f"base_{scene}.exr")
    image = TESTIMAGES / f"{scene}_ref.exr"
    share, _ = mapped(image, "samples=0:show=share")
    assert np.abs(share[..., 1] - golden["share"]).max() <= 1e-5
    base, _ = mapped(image, "samples=0:show=base")
    assert np.abs(np.log(base[..., 1]) - golden["base"]).max() <= 1e-5
    picture, _ = mapped(image, f"samples=0:{LINEAR}")
    lit = golden["Ld"] > 1e-3
    assert lit.mean() > 0.5
    assert np.abs((picture @ WEIGHTS)[lit] / golden["Ld"][lit] - 1).max() <= 1e-5


def test_a_constant_however_dark_has_no_detail(make_image, mapped):
    for value in (1e-5, 0.3):
        source = make_image("flat.exr", 70, 50, pixels=np.full((50, 70, 3), value))
        share, _ = mapped(source, "base=edges:show=share")
        assert (share == 0).all()
        picture, _ = mapped(source, f"base=edges:lmax=5:lwa=0.1:{LINEAR}")
        globally, _ = mapped(source, f"filter=none:lmax=5:lwa=0.1:{LINEAR}")
        assert np.abs(picture / globally - 1).max() <= 1e-6


def test_noise_follows_the_global_curve(make_image, mapped):
    """On a grey wall with noise of 5 % the base is luminance, unless noise is taken for detail."""
    wall = np.exp(np.random.default_rng(3).normal(0, 0.05, (64, 90, 1))) * np.ones(3)
    source = make_image("wall.exr", 90, 64, pixels=wall)
    share, _ = mapped(source, "base=edges:show=share")
    assert np.median(share) > 0.95
    without, _ = mapped(source, "base=edges:denoise=0:show=share")
    assert np.median(without) < 0.2


def test_strong_edges_keep_their_order(make_image, mapped):
    """A lamp that falls off softly: no neighbour of a brighter pixel becomes brighter than that."""
    y, x = np.mgrid[0:64, 0:64]
    light = 0.02 + 500 * np.exp(-((x - 32) ** 2 + (y - 30) ** 2) / 40.0)
    source = make_image("lamp.exr", 64, 64, pixels=light[..., None] * np.ones(3))
    turned = {}
    for base in ("edges", "mean"):
        picture, _ = mapped(source, f"base={base}:{LINEAR}")
        shown = np.log(picture @ WEIGHTS)
        worst = 0.0
        for axis in (0, 1):
            steps = np.diff(np.log(light), axis=axis)
            steep = np.abs(steps) > 0.3
            worst = min(worst, (np.sign(steps) * np.diff(shown, axis=axis))[steep].min())
        turned[base] = worst
    assert turned["edges"] > -1e-3 and turned["mean"] < -0.05, turned


def test_neither_threads_nor_the_median_of_noise_change_a_bit(tonetool, make_image, tmp_path):
    pixels = np.random.default_rng(5).random((300, 70, 3)) ** 4
    pixels[100:220] *= 1e-3  # fewer flat pixels in places: the median of the rest stands for them
    source = make_image("tall.exr", 70, 300, pixels=pixels)
    for n in (1, 3):
        tonetool("--threads", n, source, "--cgtmo:base=edges:encode=none", "-d", "float", "-o",
                 f"{n}.exr")
    assert np.array_equal(color(tmp_path / "1.exr"), color(tmp_path / "3.exr"))


def test_noise_of_a_layer(make_image, mapped, tonetool):
    generator = np.random.default_rng(7)
    light = np.exp(generator.normal(0, 0.3, (40, 50)))
    planes = np.stack([light, light, light, 0.09 * light ** 2, 0 * light], -1)
    source = make_image("var.exr", 50, 40, channels=("R", "G", "B", "variance.V", "none"),
                        pixels=planes)
    whole, _ = mapped(source, "base=edges:noise=variance:show=share")
    nothing, _ = mapped(source, "base=edges:noise=none:show=share")
    without, _ = mapped(source, "base=edges:denoise=0:show=share")
    assert (whole > 0.99).mean() > 0.95
    assert np.array_equal(nothing, without)
    ran = tonetool(source, "--cgtmo:base=edges:noise=vary", "-o", "x.exr", status=1)
    assert "vary" in ran.err and "variance.V" in ran.err


def test_pictures_without_guides_need_no_warning(make_image, tonetool):
    source = make_image("plain.exr", 40, 30)
    assert tonetool(source, "--cgtmo:base=edges:encode=none", "-o", "out.exr").err == ""
    ran = tonetool(source, "--cgtmo:base=edges:strict=1", "-o", "x.exr", status=1)
    assert "position" in ran.err


@pytest.mark.parametrize("options,words", [
    ("base=edge", ["edge", "edges", "mean"]), ("base=edges:domain=linear", ["base=mean"]),
    ("lumsigma=0.4", ["lumsigma", "base=mean"]),
    ("base=edges:filter=wls", ["filter=guided", "wls"]),
    ("base=mean:edge=0.2", ["edge", "base=edges"]),
    ("base=mean:denoise=1", ["denoise", "base=edges"]),
    ("preset=paper:noise=x", ["noise", "base=edges"]),
    ("filter=none:show=share", ["share", "base=edges"]),
    ("base=edges:edge=0", ["edge", "0.001"]), ("base=edges:denoise=-1", ["denoise", "100"]),
    ("clip=white", ["white", "hue", "channel"])])
def test_what_does_not_go_together_is_said(tonetool, options, words):
    ran = tonetool(TESTIMAGES / "cornell_ref.exr", f"--cgtmo:{options}", "-o", "x.exr", status=1)
    for word in words:
        assert word in ran.err, ran.err


PRESETS = {
    "default": "base=edges:domain=log:lumsigma=0:samples=80:clip=hue:count=lit:lwa=cells:"
               "maximum=auto:maxpercentile=99.99",
    "classic": "base=mean:domain=log:lumsigma=0.4:samples=80:clip=channel:count=all:"
               "lwa=geometric:maximum=first:maxpercentile=100",
    "paper": "base=mean:domain=linear:lumsigma=0:samples=0:clip=channel:count=all:"
             "lwa=geometric:maximum=first:maxpercentile=100"}


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("under", PRESETS)
def test_a_preset_is_its_options(mapped, preset, under):
    image = TESTIMAGES / "gallery_ref.exr"
    expected, ran = mapped(image, f"preset={preset}")
    spelt, same = mapped(image, f"preset={under}:{PRESETS[preset]}")
    assert np.array_equal(expected, spelt)
    assert ran.out == same.out


@pytest.mark.parametrize("kind", ["bilateral", "wls", "none"])
def test_other_filters_are_classic_unless_a_preset_is_named(mapped, kind):
    image = TESTIMAGES / "gallery_ref.exr"
    assert np.array_equal(mapped(image, f"filter={kind}")[0],
                          mapped(image, f"filter={kind}:preset=classic")[0])
    named, ran = mapped(image, f"filter={kind}:preset=default")
    assert not np.array_equal(named, mapped(image, f"filter={kind}")[0])
    assert ran.fact("maximum-from") == "image"


def test_the_default_is_its_preset(mapped):
    image = TESTIMAGES / "cornell_ref.exr"
    assert np.array_equal(mapped(image, "preset=default")[0], mapped(image, "strict=1")[0])
    assert mapped(image, "preset=paper")[1].fact("samples") == "1681"
    assert mapped(image, "preset=paper:samples=80")[1].fact("samples") == "80"


COLORS = [[2.42, .12, 1.33], [1.3, 1, .6], [1.2, .2, .2], [1.5, 1.4, .35], [3, 3, 3],
          [.9, .5, .1], [0, 0, 4]]
# A curve that leaves what it is given.
IDENTITY = "coeffs=0,1,0,0,0,1"


def clipped(tonetool, tmp_path, make_image, how, colors):
    source = make_image("colors.exr", len(colors), 1, pixels=np.array([colors]))
    tonetool(source, f"--tonemap:{IDENTITY}:encode=none:clip={how}", "-d", "float", "-o",
             f"{how}.exr")
    return color(tmp_path / f"{how}.exr")[0]


@needs_goldens
def test_goldens_of_the_clip(tonetool, tmp_path, make_image):
    goldens = json.loads((GOLDENS / "numbers.json").read_text())["clip_hue"]
    found = clipped(tonetool, tmp_path, make_image, "hue", [given for given, _ in goldens])
    assert np.abs(found - np.array([expected for _, expected in goldens])).max() <= 1e-6


def hue(rgb):
    return np.arctan2(np.sqrt(3) * (rgb[..., 1] - rgb[..., 2]),
                      2 * rgb[..., 0] - rgb[..., 1] - rgb[..., 2])


@pytest.mark.parametrize("how", ["hue", "luminance", "neutral"])
def test_clips_that_keep_the_hue(tonetool, tmp_path, make_image, how):
    colors = (np.random.default_rng(2).random((400, 3)) ** 2 * 4).tolist() + COLORS
    found = clipped(tonetool, tmp_path, make_image, how, colors)
    given = np.array(colors)
    inside = given.max(-1) <= 1
    assert inside.any() and np.allclose(found[inside], given[inside], rtol=0, atol=1e-7)
    assert found.max() <= 1 and found.min() >= 0
    colored = found.max(-1) - found.min(-1) > 0.02
    turned = np.angle(np.exp(1j * (hue(found) - hue(given))))
    assert np.abs(turned[colored]).max() <= 1e-4
    assert (found[400 + 4] == 1).all(), "grey stays grey"
    if how == "luminance":
        light = given @ WEIGHTS
        assert np.abs(found @ WEIGHTS - np.minimum(light, 1)).max() <= 1e-6


def test_by_channel_each_is_clamped(tonetool, tmp_path, make_image):
    found = clipped(tonetool, tmp_path, make_image, "channel", COLORS)
    assert np.allclose(found, np.clip(COLORS, 0, 1), rtol=0, atol=1e-7)
    source = make_image("plain.exr", len(COLORS), 1, pixels=np.array([COLORS]))
    tonetool(source, f"--tonemap:{IDENTITY}:encode=none", "-d", "float", "-o", "plain_out.exr")
    assert np.array_equal(found, color(tmp_path / "plain_out.exr")[0]), "the default of --tonemap"


def test_without_clamp_nothing_is_clipped(mapped):
    image = TESTIMAGES / "cornell_ref.exr"
    a, _ = mapped(image, f"base=edges:clip=hue:{LINEAR}")
    b, _ = mapped(image, f"base=edges:clip=channel:{LINEAR}")
    assert np.array_equal(a, b) and a.max() > 1
    inside, _ = mapped(image, "base=edges:clip=hue:encode=none")
    assert inside.max() <= 1
