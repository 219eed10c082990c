# SPDX-License-Identifier: BSD-3-Clause
"""What is measured of a scene: which pixels count, the means of cells, and the largest luminance."""

import json
import os
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

SHARED = Path(os.environ.get("SHARED_DIR", ""))
GOLDENS, SCENES = SHARED / "golden" / "shot", SHARED / "scenes"
needs_scenes = pytest.mark.skipif(not (GOLDENS / "stats.json").exists() or not SCENES.exists(),
                                  reason="SHARED_DIR has no golden/shot and scenes")
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
# Numbers are printed in six digits.
CLOSE = 1e-5


def golden(name):
    path = GOLDENS / name
    return json.loads(path.read_text()) if path.exists() else {}


@pytest.fixture
def measured(tonetool):
    """What --cgtmo measures of an image, and what it says."""

    def measured(image, options="", **more):
        ran = tonetool(image, f"--cgtmo:filter=none:preset=default{options}:encode=none", "-o",
                       "out.exr", **more)
        if more.get("status"):
            return None, ran
        facts = {name: float(ran.fact(name)) for name in ("adaptation", "maximum", "counted")}
        return facts, ran

    return measured


def check(measured, image, expected):
    found, ran = measured(image)
    assert found["adaptation"] == pytest.approx(expected["Lwa_cells"], rel=CLOSE)
    assert found["maximum"] == pytest.approx(expected["Lmax_p99.99"], rel=CLOSE)
    assert found["counted"] == expected["counted"]
    assert ran.fact("adaptation-from") == "image" and ran.fact("maximum-from") == "image"
    found, _ = measured(image, ":lwa=geometric:maxpercentile=100")
    assert found["adaptation"] == pytest.approx(expected["Lwa_geometric_counted"], rel=CLOSE)
    assert found["maximum"] == pytest.approx(expected["maximum"], rel=CLOSE)
    found, _ = measured(image, ":lwa=geometric:count=all:maximum=image")
    assert found["adaptation"] == pytest.approx(expected["Lwa_geometric_all_1e-6"], rel=CLOSE)


@needs_scenes
@pytest.mark.parametrize("scene", [name for name in golden("stats.json") if ", " not in name])
def test_goldens_of_scenes(measured, scene):
    check(measured, SCENES / f"{scene}.exr", golden("stats.json")[scene])


@needs_scenes
@pytest.mark.parametrize("frame", range(1, 9))
def test_goldens_of_a_shot(measured, frame):
    check(measured, SCENES / "anim" / f"ref.{frame:04}.exr",
          golden("shot.json")["frames"][frame - 1])


@needs_scenes
@pytest.mark.parametrize("scene", ["cornell", "nightstreet", "gallery"])
def test_few_samples_have_the_exposure_of_many(measured, scene):
    many, _ = measured(SCENES / scene / "ref.exr")
    few, _ = measured(SCENES / scene / "test_4spp.exr")
    assert few["adaptation"] == pytest.approx(many["adaptation"], rel=0.06)


@pytest.fixture
def masked(tmp_path):
    """The gallery with most of it black, and the name of its part that is not."""
    image = oiio.ImageBuf(str(SCENES / "gallery" / "ref.exr"))
    names = list(image.spec().channelnames)
    keep = [n for n in names if n.split(".")[1] in ("Combined", "Depth")]
    pixels = image.get_pixels(oiio.FLOAT)[..., [names.index(n) for n in keep]].copy()
    outside = np.ones(pixels.shape[:2], bool)
    outside[60:250, 140:330] = False
    for i, name in enumerate(keep):
        if "Combined" in name:
            pixels[..., i][outside] = 0
        if name.endswith("Combined.A"):
            pixels[..., i] = ~outside
        if "Depth" in name:
            pixels[..., i][outside] = 1e10

    def write(name, channels, values):
        spec = oiio.ImageSpec(values.shape[1], values.shape[0], len(channels), "float")
        spec.channelnames = tuple(channels)
        out = oiio.ImageBuf(spec)
        out.set_pixels(oiio.ROI(), np.ascontiguousarray(values))
        assert out.write(str(tmp_path / name))
        return tmp_path / name

    def make(*left_out):
        kept = [i for i, n in enumerate(keep) if not any(n.endswith(o) for o in left_out)]
        return write("masked.exr", [keep[i] for i in kept], pixels[..., kept])

    make.part = lambda: write("part.exr", keep, pixels[60:250, 140:330])
    return make


@needs_scenes
def test_what_shows_nothing_is_not_measured(measured, masked):
    (expected,) = [v for name, v in golden("stats.json").items() if ", " in name]
    part, _ = measured(masked.part())
    assert part["adaptation"] == pytest.approx(expected["Lwa_cells"], rel=CLOSE)
    for left_out in ((), ("A",), ("Depth.Z",)):
        found, ran = measured(masked(*left_out))
        assert found["adaptation"] == pytest.approx(expected["Lwa_cells"], rel=CLOSE), left_out
        assert found["counted"] == expected["counted"]
        assert found["maximum"] == pytest.approx(expected["Lmax_p99.99"], rel=CLOSE)
        assert "show nothing and are not measured" in ran.err
        assert "Lwa of all pixels would be" in ran.err
    # Neither alpha nor depth: black is out of all but cells with light in them, here at a border.
    found, _ = measured(masked("A", "Depth.Z"))
    assert found["adaptation"] == pytest.approx(expected["Lwa_cells"], rel=0.03)
    _, ran = measured(masked(), ":count=all:lwa=geometric")
    assert "show nothing" not in ran.err


def test_the_largest_pixels_are_passed_over(make_image, measured):
    light = np.full((100, 100), 1.0)
    light[3, 7], light[50, 60] = 500, 40
    source = make_image("fly.exr", 100, 100, pixels=light[..., None] * np.ones(3))
    for options, expected in (("", 40), (":maxpercentile=100", 500), (":maxpercentile=99.98", 1),
                              (":lmax=7", 7)):
        assert measured(source, options)[0]["maximum"] == pytest.approx(expected, rel=1e-6), options
    small = make_image("small.exr", 3, 3, pixels=np.arange(1, 10).reshape(3, 3, 1) * np.ones(3))
    assert measured(small)[0]["maximum"] == pytest.approx(8), "one pixel at least"


def test_black_surfaces_are_part_of_a_cell(make_image, measured):
    """Noise of few samples: half of the pixels of a lit wall are black, but alpha tells the wall."""
    random = np.random.default_rng(1)
    light = np.where(random.random((96, 96)) < 0.5, 2.0, 0.0)
    wall = np.stack([light, light, light, np.ones_like(light)], -1)
    source = make_image("wall.exr", 96, 96, ("R", "G", "B", "A"), pixels=wall)
    found, ran = measured(source)
    assert found["counted"] == (light > 0).sum()
    cells = light.reshape(48, 2, 48, 2).mean((1, 3))
    assert found["adaptation"] == pytest.approx(np.exp(np.log(cells[cells > 0]).mean()), rel=CLOSE)
    assert "show nothing" not in ran.err


def test_an_alpha_of_nothing_says_nothing(make_image, measured):
    light = np.random.default_rng(4).random((30, 30, 4))
    light[..., 3] = 0
    source = make_image("zero.exr", 30, 30, ("R", "G", "B", "A"), pixels=light)
    opaque = make_image("opaque.exr", 30, 30, pixels=light[..., :3])
    found, ran = measured(source)
    assert found == measured(opaque)[0]
    assert "alpha is 0 wherever there is light" in ran.err


def test_what_is_doubtful_is_said(make_image, measured):
    flat = make_image("flat.exr", 20, 20, pixels=np.full((20, 20, 3), 0.5))
    assert "nothing to compress" in measured(flat)[1].err
    wide = make_image("wide.exr", 200, 200,
                      pixels=np.geomspace(0.01, 10, 40000).reshape(200, 200, 1) * np.ones(3))
    assert measured(wide)[1].err == ""
    assert "times the maximum" in measured(wide, ":lmax=1")[1].err
    make_image("pano.exr", 8, 4, pixels=np.full((4, 8, 3), 0.3162 * 5))
    assert "one exposure" in measured(wide, ":env=pano.exr")[1].err
    make_image("near.exr", 8, 4, pixels=np.full((4, 8, 3), 0.3162 * 3))
    assert measured(wide, ":env=near.exr")[1].err == ""


def test_the_maximum_is_of_the_image_unless_a_source_is_named(make_image, measured, tonetool,
                                                              tmp_path):
    names, planes = ["R", "G", "B"], [np.full((30, 30), 1.0)] * 3
    for group, value in (("key", 0.75), ("rim", 0.25)):
        names += [f"light_{group}.{c}" for c in "RGB"]
        planes += [np.full((30, 30), value)] * 3
    source = make_image("groups.exr", 30, 30, names, pixels=np.stack(planes, -1))
    assert measured(source)[1].fact("maximum-from") == "image"
    assert measured(source, ":maximum=groups")[1].fact("maximum-from") == "groups key"
    assert measured(source, ":maximum=first")[1].fact("maximum-from") == "groups key"
    ran = tonetool(source, "--cgtmo:filter=none", "-o", "classic.png")
    assert ran.fact("maximum-from") == "groups key", "without a preset it is the classic one"


def exposure(tonetool, image, options):
    ran = tonetool(image, f"--calibrate:method=mean:{options}", "-d", "float", "-o", "out.exr")
    return float(ran.fact("exposure"))


def test_calibration_counts_what_is_lit(tonetool, make_image):
    light = np.zeros((40, 40, 4))
    light[:10] = [0.5, 0.5, 0.5, 1]
    source = make_image("part.exr", 40, 40, ("R", "G", "B", "A"), pixels=light)
    right = np.log2(0.18 / 0.5)
    for options in ("stops=0", "count=lit", "means=cells", "skiptransparent=1"):
        assert exposure(tonetool, source, options) == pytest.approx(right, abs=1e-4), options
    assert exposure(tonetool, source, "count=all") > right + 5
    ran = tonetool(source, "--calibrate:method=mean:count=lit:skipblack=1", "-o", "x.exr", status=1)
    assert "count=lit" in ran.err and "skipblack" in ran.err
    ran = tonetool(source, "--calibrate:method=mean:level=1:means=cells", "-o", "x.exr", status=1)
    assert "means=cells" in ran.err
    black = make_image("black.exr", 8, 8, pixels=np.zeros((8, 8, 3)))
    exposure(tonetool, black, "stops=0")
    tonetool(black, "--calibrate:method=mean:count=lit", "-o", "x.exr", status=1)


def test_nothing_depends_on_threads(tonetool):
    facts = set()
    for n in (1, 3):
        ran = tonetool("--threads", n, TESTIMAGES / "gallery_ref.exr",
                       "--cgtmo:filter=none:preset=default", "-o", f"{n}.png")
        facts.add((ran.fact("adaptation"), ran.fact("maximum"), ran.fact("counted")))
    assert len(facts) == 1


def test_an_alpha_that_is_no_number_counts_as_0_and_leaves_the_colour(tonetool, tmp_path):
    pictures = {}
    for name, value in (("nan", np.nan), ("zero", 0.0)):
        pixels = np.random.default_rng(1).random((32, 48, 4), np.float32)
        pixels[..., 3] = 1
        pixels[4:8, 4:8, 3] = value
        image = oiio.ImageBuf(oiio.ImageSpec(48, 32, 4, "float"))
        image.set_pixels(oiio.ROI(0, 48, 0, 32), pixels)
        image.write(str(tmp_path / f"{name}.exr"))
        ran = tonetool(tmp_path / f"{name}.exr", "--cgtmo", "-o", f"{name}.tif", "-q")
        assert "not finite" not in ran.err
        pictures[name] = oiio.ImageInput.open(str(tmp_path / f"{name}.tif")).read_image("float")
    assert np.array_equal(pictures["nan"][..., :3], pictures["zero"][..., :3])
    assert pictures["nan"][4:8, 4:8, :3].min() > 0
