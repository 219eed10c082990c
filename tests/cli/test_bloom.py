# SPDX-License-Identifier: BSD-3-Clause
"""--bloom: the glare of bright light, in linear light."""

import math

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
NIGHT = TESTIMAGES / "nightstreet_ref.exr"


def glare(vision, t, wavelength):
    """Spencer et al. 1995, at an angle in degrees."""
    core, cube, square, halo = {"photopic": (.384, .478, .138, 0), "mesopic": (.368, .478, .138, .016),
                                "scotopic": (.282, .478, .207, .033)}[vision]
    return (core * 2.61e6 * np.exp(-(t / .02) ** 2) + cube * 20.91 / (t + .02) ** 3 + square * 72.37 / (t + .02) ** 2 +
            halo * 436.9 * (568 / wavelength) * np.exp(-19.75 * (t - 3 * wavelength / 568) ** 2))


def kernel_of(function, reach):
    """The means of a function of the distance in pixels, all adding up to 1."""
    n, s = int(reach), 15
    at = (np.arange((2 * n + 1) * s) + .5) / s - .5 - n
    fine = function(np.hypot(at[:, None], at[None]))
    coarse = fine.reshape(2 * n + 1, s, 2 * n + 1, s).mean((1, 3))
    pixels = np.arange(-n, n + 1)
    coarse[np.hypot(pixels[:, None], pixels[None]) > reach] = 0
    return coarse / coarse.sum()


@pytest.fixture
def lamp(make_image):
    """One bright pixel in the dark."""

    def make(name="l.exr", width=60, height=40, at=(21, 17), light=(1000.0, 500.0, 200.0), dark=0.0):
        pixels = np.full((height, width, 3), dark)
        pixels[at[1], at[0]] = light
        return make_image(name, width, height, pixels=pixels)

    return make


@pytest.mark.parametrize("vision", ["photopic", "mesopic", "scotopic"])
def test_a_point_of_light_becomes_the_eyes_function(tonetool, lamp, read, vision):
    """60 pixels of 0.25 degrees: the longer side is nearer than 30 degrees."""
    ran = tonetool(lamp(), f"--bloom:fov=15:vision={vision}", "-o", "o.exr")
    found = read("o.exr")[0]
    for c, wavelength in enumerate((611, 549, 467)):
        kernel = kernel_of(lambda r, w=wavelength: glare(vision, r * 0.25, w), 60)
        wanted = (1000, 500, 200)[c] * kernel[60 - 17:60 + 40 - 17, 60 - 21:60 + 60 - 21]
        assert np.allclose(found[..., c], wanted, rtol=1e-5, atol=1e-6), c
        if c == 1:
            assert float(ran.fact("kept")) == pytest.approx(kernel[60, 60], rel=1e-5)


def test_it_ends_at_30_degrees(tonetool, lamp, read):
    ran = tonetool(lamp(), "--bloom:fov=90", "-o", "o.exr")
    assert float(ran.fact("reach")) == 20
    found = read("o.exr")[0][..., 1]
    y, x = np.mgrid[:40, :60]
    near = np.hypot(x - 21, y - 17) <= 20
    assert (found[near] > 1e-4).all() and (found[~near] < 1e-9).all()


def test_a_gaussian_is_the_mean_of_four(tonetool, lamp, read):
    tonetool(lamp(), "--bloom:psf=gaussian:radius=3", "-o", "o.exr")
    kernel = kernel_of(lambda r: sum(np.exp(-r * r / (2 * s * s)) / (s * s) for s in (3 / 8, 3 / 4, 3 / 2, 3)), 15)
    wanted = np.zeros((40 + 30, 60 + 30))
    wanted[17:17 + 31, 21:21 + 31] = kernel
    assert np.allclose(read("o.exr")[0][..., 0], 1000 * wanted[15:-15, 15:-15], rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("options", ["", ":vision=scotopic", ":psf=gaussian:radius=2", ":threshold=3:amount=0.3"])
def test_light_is_neither_made_nor_lost(tonetool, make_image, read, options):
    """In a frame that is wide enough for all of it: 10 pixels of 3 degrees."""
    pixels = np.zeros((60, 60, 3))
    pixels[20:40, 20:40] = np.exp(np.random.default_rng(2).normal(0, 2, (20, 20, 3)))
    make_image("s.exr", 60, 60, pixels=pixels)
    if "gaussian" not in options:
        options += ":fov=179"
    tonetool("s.exr", f"--bloom{options}", "-o", "o.exr")
    before, after = read("s.exr")[0].astype(float), read("o.exr")[0].astype(float)
    assert not np.array_equal(before, after) and (after >= 0).all()
    assert after.sum((0, 1)) == pytest.approx(before.sum((0, 1)), rel=1e-5)


def test_light_above_the_threshold_spreads(tonetool, lamp, read):
    """E = C (L - T) / L, and C + A (PSF * E - E)."""
    tonetool(lamp(dark=0.5), "--bloom:fov=15:threshold=100:amount=0.25", "-o", "o.exr")
    tonetool("l.exr", "--bloom:fov=15", "-o", "whole.exr")
    before, found = read("l.exr")[0].astype(float), read("o.exr")[0].astype(float)
    light = before[17, 21] @ WEIGHTS
    source = before[17, 21] * (light - 100) / light
    kernel = kernel_of(lambda r: glare("photopic", r * 0.25, 549), 60)
    spread = kernel[60 - 17:60 + 40 - 17, 60 - 21:60 + 60 - 21, None] * source
    wanted = before + 0.25 * spread
    wanted[17, 21] -= 0.25 * source
    assert np.allclose(found, wanted, rtol=1e-5)
    assert not np.allclose(read("whole.exr")[0], wanted, rtol=1e-2)


def test_a_threshold_in_stops_is_above_the_mean_of_cells(tonetool, read):
    ran = tonetool(NIGHT, "--bloom:threshold=6s", "-o", "o.exr")
    mean = float(tonetool(NIGHT, "--cgtmo", "-o", "p.exr").fact("adaptation"))
    assert float(ran.fact("lwa")) == pytest.approx(mean, rel=1e-5)
    assert float(ran.fact("threshold")) == pytest.approx(64 * mean, rel=1e-5)
    tonetool(NIGHT, f"--bloom:threshold={64 * mean!r}", "-o", "q.exr")
    assert np.allclose(read("o.exr")[0], read("q.exr")[0], rtol=1e-5)
    assert 0 < float(ran.fact("light")) < 1 and int(ran.fact("spreading")) > 0


@pytest.mark.parametrize("image", [NIGHT, TESTIMAGES / "cornell_ref.exr"])
def test_no_amount_is_the_same_picture(tonetool, read, image):
    tonetool(image, "-o", "a.exr")
    for options in ("amount=0:threshold=2s", "threshold=1e9", "amount=0:psf=gaussian"):
        tonetool(image, f"--bloom:{options}", "-o", "b.exr")
        (before, old), (after, new) = read("a.exr"), read("b.exr")
        assert before.tobytes() == after.tobytes(), options
        assert old.channelnames == new.channelnames


def test_alpha_and_other_layers_stay(tonetool, make_image, read):
    channels = ("R", "G", "B", "A", "Z", "light.R", "light.G", "light.B")
    make_image("s.exr", 20, 20, channels=channels)
    tonetool("s.exr", "--bloom", "-o", "o.exr")
    before, after = read("s.exr")[0], read("o.exr")[0]
    assert read("o.exr")[1].channelnames == channels
    assert np.array_equal(before[..., 3:], after[..., 3:])
    assert not np.allclose(before[..., :3], after[..., :3], rtol=1e-3)
    tonetool("s.exr", "--bloom:layer=light", "-o", "o.exr")
    after = read("o.exr")[0]
    assert np.array_equal(before[..., :5], after[..., :5])
    assert not np.allclose(before[..., 5:], after[..., 5:], rtol=1e-3)


def test_what_is_not_finite_stays_and_gives_no_light(tonetool, lamp, make_image, read):
    lamp("clean.exr", dark=0.25)
    pixels = read("clean.exr")[0].copy()
    pixels[3, 4] = (np.nan, 7, 7)
    pixels[30, 50] = (np.inf, 1, -np.inf)
    pixels[10, 10] = (1e4, -3, 1)
    make_image("bad.exr", 60, 40, pixels=pixels)
    pixels[3, 4] = pixels[30, 50] = 0
    make_image("black.exr", 60, 40, pixels=pixels)
    ran = tonetool("bad.exr", "--bloom", "-o", "o.exr")
    assert "2 pixel(s) are not finite: they stay as they are" in ran.err
    tonetool("black.exr", "--bloom", "-o", "b.exr")
    found, wanted = read("o.exr")[0], read("b.exr")[0].copy()
    bad = read("bad.exr")[0]
    for y, x in ((3, 4), (30, 50)):
        assert np.array_equal(found[y, x], bad[y, x], equal_nan=True)
        wanted[y, x] = bad[y, x]
    assert np.array_equal(found, wanted, equal_nan=True)
    assert found[10, 10, 1] < -2.9, "a negative component is no light, but gets some"


@pytest.mark.parametrize("options", [":vision=mesopic:threshold=2s", ":psf=gaussian"])
def test_threads_do_not_matter(tonetool, read, options):
    for threads in (1, 2, 5):
        tonetool("--threads", threads, NIGHT, f"--bloom{options}", "-d", "float", "-o", f"{threads}.exr")
    assert len({read(f"{threads}.exr")[0].tobytes() for threads in (1, 2, 5)}) == 1


def test_a_cropped_frame_has_the_pixels_angle_of_the_whole(tonetool, make_image, read):
    pixels = np.zeros((30, 30, 3))
    pixels[15, 15] = 100
    make_image("crop.exr", 30, 30, pixels=pixels, window=(20, 10, 0, 0, 120, 90))
    make_image("small.exr", 30, 30, pixels=pixels)
    tonetool("crop.exr", "--bloom:fov=60", "-o", "c.exr")
    tonetool("small.exr", "--bloom:fov=15", "-o", "s.exr")
    assert np.array_equal(read("c.exr")[0], read("s.exr")[0])
    assert read("c.exr")[1].x == 20


def test_grey_pictures(tonetool, make_image, read):
    pixels = np.random.default_rng(1).random((20, 30, 1)) * 10
    make_image("grey.exr", 30, 20, channels=("Y",), pixels=pixels)
    make_image("three.exr", 30, 20, pixels=np.repeat(pixels, 3, 2))
    tonetool("grey.exr", "--bloom:vision=scotopic", "-o", "g.exr")
    tonetool("three.exr", "--bloom:vision=scotopic", "-o", "t.exr")
    assert np.allclose(read("g.exr")[0][..., 0], read("t.exr")[0][..., 1], rtol=1e-6)


def test_the_camera_tells_the_field_of_view(tonetool, lamp, tmp_path):
    assert "40 degrees" in tonetool("-v", lamp(), "--bloom", "-o", "o.exr").fact("note")
    assert float(tonetool("l.exr", "--bloom", "-o", "o.exr").fact("fov")) == pytest.approx(40, rel=1e-6)
    assert "note" not in tonetool("-v", "l.exr", "--bloom:fov=40", "-o", "o.exr").out
    image = oiio.ImageBuf(str(tmp_path / "l.exr"))
    across = 1 / math.tan(math.radians(25) / 2)
    identity = tuple(float(i % 5 == 0) for i in range(16))
    projection = (across, 0, 0, 0, 0, across, 0, 0, 0, 0, 1, 1, 0, 0, -1, 0)
    image.specmod().attribute("worldToCamera", oiio.TypeMatrix, identity)
    image.specmod().attribute("worldToScreen", oiio.TypeMatrix, projection)
    assert image.write(str(tmp_path / "camera.exr"))
    ran = tonetool("-v", "camera.exr", "--bloom", "-o", "o.exr")
    assert float(ran.fact("fov")) == pytest.approx(25, rel=1e-5) and "note" not in ran.out


def test_a_black_picture(tonetool, make_image, read):
    make_image("black.exr", pixels=np.zeros((12, 16, 3)))
    for threshold in ("0", "6s"):
        tonetool("black.exr", f"--bloom:threshold={threshold}", "-o", "o.exr")
        assert not read("o.exr")[0].any()


def test_a_recipe(tonetool, lamp, read, tmp_path):
    tonetool(lamp(), "--bloom:fov=15", "-o", "o.exr")
    (tmp_path / "glare.tone").write_text("tonetool 1\nl.exr --bloom:fov=15\n")
    tonetool("glare.tone", "-o", "r.exr")
    assert np.array_equal(read("o.exr")[0], read("r.exr")[0])


@pytest.mark.parametrize("options, words", [
    ("threshold=much", ["threshold", "much", "Ns"]), ("threshold=-1", ["threshold", "0 or more"]),
    ("threshold=200s", ["threshold", "126"]), ("threshold=s", ["threshold"]), ("threshold=nan", ["threshold"]),
    ("amount=1.5", ["amount", "0 to 1"]), ("psf=moffat", ["moffat", "spencer", "gaussian"]),
    ("fov=180", ["fov", "179"]), ("radius=4", ["radius", "psf=gaussian"]), ("psf=gaussian:radius=0", ["radius"]),
    ("psf=gaussian:fov=40", ["fov", "psf=spencer"]), ("psf=gaussian:vision=mesopic", ["vision", "psf=spencer"]),
    ("vision=night", ["night", "scotopic"]), ("layer=none", ["none"]), ("treshold=1", ["treshold", "threshold"])])
def test_errors(tonetool, lamp, tmp_path, options, words):
    err = tonetool(lamp(), f"--bloom:{options}", "-o", "o.exr", status=1).err
    for word in words:
        assert word in err
    assert not (tmp_path / "o.exr").exists()


def test_display_encoded_images_are_refused(tonetool, make_image):
    make_image("s.png", kind="uint8")
    assert "linear" in tonetool("s.png", "--bloom", "-o", "o.exr", status=1).err
    tonetool("s.png", "--bloom:from=rec709", "-o", "o.exr")


def test_a_radius_beyond_the_image_takes_no_longer_than_its_circle(tonetool, lamp, read):
    """Its kernel is a product, row by column."""
    lamp("p.exr", width=30, height=1, at=(3, 0))
    tonetool("p.exr", "--bloom:psf=gaussian:radius=2000", "-d", "float", "-o", "o.exr", timeout=60)
    assert 0 < read("o.exr")[0][..., :3].sum() < 1  # nearly all of it leaves the frame
