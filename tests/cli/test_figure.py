# SPDX-License-Identifier: BSD-3-Clause
"""--figure and --colormap:bar=1."""

import shutil

import numpy as np
import OpenImageIO as oiio
import pytest

MAE = "--errormap:metric=mae:print=0"
FLIP = "--ldrflip:print=0"
DARK = 33


@pytest.fixture
def suite(tmp_path, make_image):
    """Two names and two methods, of which "b" lacks one name."""
    for folder in ("r", "o/a", "o/b"):
        (tmp_path / folder).mkdir(parents=True)
    for name, size in (("one", 24), ("two", 32)):
        make_image(f"r/{name}.exr", size, size, pixels=pattern(size))
        make_image(f"o/a/{name}.exr", size, size, pixels=pattern(size, 0.5))
    shutil.copy(tmp_path / "r/one.exr", tmp_path / "o/b/one.exr")
    return tmp_path


WORDS = ["r/%N.exr", "o/%M/%N.exr", FLIP, "-q"]


def pattern(size, more=0.0):
    """Red grows from left to right; a green pixel at 5,7 tells where an inset is cut."""
    pixels = np.zeros((size, size, 3))
    pixels[:, :, 0] = np.linspace(0, 1, size)
    pixels[7, 5] = (0, 1, 0)
    pixels[9, 9, 2] = more
    return pixels


def pixels_of(path):
    return oiio.ImageInput.open(str(path)).read_image(oiio.UINT8)


def blocks(picture, color, scale):
    """Where the colour fills squares of scale x scale pixels: their corners."""
    mask = (picture == color).all(axis=2)
    found = []
    for y, x in zip(*np.nonzero(mask)):
        if mask[y:y + scale, x:x + scale].all() and not mask[y - 1, x] and not mask[y, x - 1]:
            found.append((x, y))
    return found


def test_insets_are_repeated_pixels(tonetool, suite):
    tonetool(*WORDS, "--figure:names=one:inset=8x6+3+4:scale=5", "f.png", status=1)
    picture = pixels_of(suite / "f.png")
    found = blocks(picture, (0, 255, 0), 5)
    # The green pixel is third from the left of the inset and fourth from above, in the reference
    # and in both methods, in one line and at one distance.
    assert len(found) == 3 and len({y for _, y in found}) == 1
    xs = sorted(x for x, _ in found)
    assert xs[2] - xs[1] == xs[1] - xs[0] >= 8 * 5
    left, top = xs[0] - 2 * 5, found[0][1] - 3 * 5
    reference = oiio.ImageBuf(str(suite / "r/one.exr")).get_pixels()[4:10, 3:11, 0]
    shown = picture[top:top + 30:5, left:left + 40:5, 0] / 255
    linear = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    assert abs(linear - reference).max() < 0.01
    # Below the inset of the second method, a copy of the reference, the map is 0; of the first not.
    map_of = [picture[top + 30 + 4:top + 60 + 4, x - 10:x + 30] for x in xs]
    assert (map_of[2] == (0, 0, 4)).all() and map_of[1].max() > 60


def test_rows_and_columns(tonetool, suite):
    def size(more):
        tonetool(*WORDS, "--figure" + more, "f.png", status=1)
        return pixels_of(suite / "f.png").shape

    both, one, other = size(""), size(":names=one"), size(":names=two")
    assert both[0] > max(one[0], other[0]) and both[0] == one[0] + other[0] - 12
    assert size(":methods=a")[1] < both[1] == size(":methods=b,a")[1]
    assert size(":scale=5")[0] > both[0]
    tonetool(*WORDS, "--figure:methods=b,a", "g.png", status=1)
    tonetool(*WORDS, "--figure:methods=a,b", "f.png", status=1)
    assert (pixels_of(suite / "f.png") != pixels_of(suite / "g.png")).any()


def test_the_same_however_it_ran(tonetool, suite):
    tonetool(*WORDS, "--figure", "f.png", status=1)
    tonetool(*WORDS, "--figure", "g.png", "--parallel-frames", "--jobs", "2", status=1)
    for _ in range(2):  # a result that is kept has no pictures
        tonetool(*WORDS, "--state", "st", "--figure", "h.png", status=1)
        assert (suite / "f.png").read_bytes() == (suite / "h.png").read_bytes()
    assert (suite / "f.png").read_bytes() == (suite / "g.png").read_bytes()


def test_one_pair_and_stops(tonetool, suite, pair):
    tonetool(*pair, "--hdrflip:print=0", "--figure", "f.png")
    tonetool(*pair, "--hdrflip:print=0", "--figure:stops=3", "g.png")
    dark, bright = pixels_of(suite / "f.png"), pixels_of(suite / "g.png")
    assert dark.shape == bright.shape and bright.mean() > dark.mean() + 10
    assert (dark[0, 0] == 255).all()
    tonetool(*pair, MAE, "-q", "--figure", "h.png")  # without a bound there are no colours and no bar
    assert pixels_of(suite / "h.png").shape[1] < dark.shape[1]


def test_labels_and_paper(tonetool, suite, pair):
    tonetool(*pair, "--hdrflip:print=0", "--figure", "f.png")
    tonetool(*pair, "--hdrflip:print=0", "--figure:text=32", "g.png")
    tonetool(*pair, "--hdrflip:print=0", "--figure:background=dark", "h.png")
    small, large, dark = (pixels_of(suite / name) for name in ("f.png", "g.png", "h.png"))
    assert large.shape[0] > small.shape[0] + 32
    assert (small[0, 0] == 255).all() and (dark[0, 0] == DARK).all() and dark.shape == small.shape
    # Text is dark on white and light on dark: above the pictures there is nothing else.
    assert small[:30].min() < 40 and dark[:30].max() > 200


@pytest.mark.parametrize("command", ["--figure", "--contactsheet"])
def test_a_picture_in_a_file_that_holds_none(tonetool, suite, pair, command):
    for words in ([], ["--dry-run"]):
        ran = tonetool(*pair, "--hdrflip", command, "f.pdf", *words, status=1)
        assert f'{command}: "f.pdf" has no extension of an image that can be written' in ran.err
        assert "mean" not in ran.out


def test_tests_that_are_not_drawn_are_told(tonetool, make_image):
    files = [make_image(f"{name}.exr", seed=seed) for seed, name in enumerate(("r", "a", "b"))]
    ran = tonetool(*files, "--hdrflip:tests=2:print=0", "--figure", "f.png")
    assert "--figure: of several tests of a reference the first is drawn (valid: %M in the names" in ran.err
    assert "--figure" not in tonetool(*files[:2], "--hdrflip:print=0", "--figure", "f.png").err


def test_an_inset_counts_the_pixels_of_the_file(tonetool, tmp_path, make_image):
    window = (10, 20, 10, 20, 24, 24)
    for name in ("r.exr", "t.exr"):
        make_image(name, 24, 24, pixels=pattern(24), window=window)
    tonetool("r.exr", "t.exr", FLIP, "-q", "--figure:inset=3x3+14+26:scale=9", "f.png")
    found = blocks(pixels_of(tmp_path / "f.png"), (0, 255, 0), 9)
    assert len(found) == 2
    ran = tonetool("r.exr", "t.exr", FLIP, "-q", "--figure:inset=3x3+0+0", "f.png", status=1)
    assert "--figure: inset 3x3+0+0 is not inside of the image, which is 24x24+10+20" in ran.err


@pytest.mark.parametrize("modifiers, told", [
    (":names=three", '--figure: names has "three" (there are: one, two)'),
    (":methods=a,c", '--figure: methods has "c" (there are: a, b)'),
    (":inset=8x8", '--figure: inset is "8x8" (valid: WIDTHxHEIGHT+X+Y'),
    (":inset=0x8+0+0", '--figure: inset is "0x8+0+0"'),
    (":text=2", "--figure: text"), (":background=blue", "--figure: background"),
    (":scale=0", "--figure: scale"), (":columns=3", '--figure has no modifier "columns"')])
def test_before_any_work(tonetool, suite, modifiers, told):
    assert told in tonetool(*WORDS, "--figure" + modifiers, "f.png", status=1).err
    assert not (suite / "f.png").exists()


def test_no_figure(tonetool, suite):
    tonetool(*WORDS, "--json", "j.json", "-n", "--figure", "f.png", status=1)
    assert not (suite / "f.png").exists()
    tonetool(*WORDS, "--json", "j.json", status=1)
    ran = tonetool("--merge", "j.json", "--figure", "f.png", status=1)
    assert "--figure is drawn of images, which results do not have" in ran.err
    ran = tonetool("r/%N.exr", "--qc", "-q", "--figure", "f.png", status=1)
    assert "ERROR: --figure: there is no pair for the figure" in ran.err


# ---- a map with its bar

@pytest.mark.parametrize("height", [6, 240])
def test_bar(tonetool, read, make_image, height):
    values = make_image("v.exr", 30, height, ("Y",))
    tonetool(values, "--colormap", "magma", "-o", "plain.exr")
    tonetool(values, "--colormap:bar=1", "magma", "-o", "bar.exr")
    plain, bar = read("plain.exr")[0], read("bar.exr")[0]
    assert bar.shape[1] > plain.shape[1] and bar.shape[2] == 3
    assert (bar[:height, :30] == plain).all()
    text = min(max(height // 20, 10), 32)
    column = bar[:, 30 + text // 2 + 2]
    assert column[0].sum() > 2.4 and column[-1].sum() < 0.1  # 1 above, 0 below
    luminance = column @ (0.2126, 0.7152, 0.0722)
    assert (np.diff(luminance) <= 1e-4).all()


def test_a_bar_stands_beside_the_upright_map(tonetool, read, make_image):
    values = make_image("v.exr", 30, 40, ("Y",), attributes={"Orientation": 6})
    tonetool(values, "--colormap:bar=1", "magma", "-o", "bar.exr")
    pixels, spec = read("bar.exr")
    assert spec.height == 30 and spec.width > 40 and spec.get_int_attribute("Orientation", 1) == 1
    tonetool(values, "--reorient", "--colormap", "magma", "-o", "plain.exr")
    assert (pixels[:, :40] == read("plain.exr")[0]).all()
