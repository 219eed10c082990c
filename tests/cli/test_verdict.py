# SPDX-License-Identifier: BSD-3-Clause
"""What a comparison looks at, and what it says of it: nothing that was not compared is a pass."""

import json
import os

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

HEIGHT, WIDTH = 30, 48
ROWS, COLUMNS = np.mgrid[0:HEIGHT, 0:WIDTH]


def scene(ball=(3, 0.6, 0.3)):
    wall = 0.18 * np.exp(0.8 * np.sin(COLUMNS / 5) + 0.6 * np.cos(ROWS / 4))
    image = np.stack([wall * 1.1, wall, wall * 0.8], -1)
    image[(COLUMNS - 20) ** 2 + (ROWS - 15) ** 2 < 49] = ball
    return image.astype(np.float32)


GOOD, BAD = scene(), scene((0.05, 0.5, 0.1))
NORMALS = np.stack([COLUMNS / WIDTH, ROWS / HEIGHT, 0 * ROWS + 0.5], -1).astype(np.float32)


@pytest.fixture
def put(make_image):
    def write(name, pixels, channels="RGB", **options):
        return make_image(name, pixels.shape[1], pixels.shape[0], list(channels), pixels=pixels,
                          **options)

    return write


@pytest.fixture
def pair(put):
    return put("good.exr", GOOD), put("bad.exr", BAD)


@pytest.fixture
def parts(tmp_path):
    """Writes an EXR (or TIFF) of parts (name, pixels, view)."""

    def write(file, *entries):
        specs = []
        for name, pixels, view in entries:
            spec = oiio.ImageSpec(WIDTH, HEIGHT, pixels.shape[2], "float")
            spec.channelnames = ("R", "G", "B")
            if name:
                spec.attribute("oiio:subimagename", name)
            if view:
                spec.attribute("view", view)
            specs.append(spec)
        out = oiio.ImageOutput.create(str(tmp_path / file))
        assert out.open(str(tmp_path / file), tuple(specs)), out.geterror()
        for i, (_, pixels, _) in enumerate(entries):
            assert i == 0 or out.open(str(tmp_path / file), specs[i], "AppendSubimage")
            assert out.write_image(np.ascontiguousarray(pixels))
        out.close()
        return file

    return write


# ---- parts and views

@pytest.fixture
def aovs(parts):
    return [parts(f"{name}.exr", ("N", NORMALS, ""), ("albedo", GOOD * 0 + 0.5, ""),
                  ("C", pixels, "")) for name, pixels in (("aov", GOOD), ("worse", BAD))]


def test_the_beauty_is_found_by_the_name_of_its_part(tonetool, aovs):
    ran = tonetool(*aovs, "--hdrflip:fail=0.01", status=3)
    assert "FAIL mean" in ran.out and not ran.err
    tonetool(aovs[0], aovs[0], "--hdrflip:fail=0.01")
    for layer, status in (("C", 3), ("c", 3), ("albedo", 0), ("N", 0)):
        tonetool(*aovs, f"--hdrflip:fail=0.01:layer={layer}", status=status)
    ran = tonetool(*aovs, "--hdrflip:fail=0.01:layer=Z", status=1)
    assert 'no colour layer or part "Z"; there are: N, albedo, C' in ran.err


@pytest.mark.parametrize("command", ["hdrflip", "ldrflip", "flipdiff", "filmstrip",
                                     "errormap:metric=mae"])
def test_every_comparison_finds_parts(tonetool, aovs, command):
    assert "FAIL" in tonetool(*aovs, f"--{command}:fail=0.001:layer=C", status=3).out
    ran = tonetool("-a", *aovs, f"--{command}:fail=0.001", status=1)
    assert "3 subimage(s)" in ran.err and "not with -a" in ran.err
    assert "not with -a" in tonetool("-a", *aovs, f"--{command}", status=1).err


@pytest.mark.parametrize("names", [("a", "b"), ("beauty", "diffuse"), ("rgba", "rgba_2")])
def test_a_picture_that_is_not_looked_at_is_an_error(tonetool, parts, names):
    files = [parts(f"{pixels is BAD}.exr", (names[0], GOOD, ""), (names[1], pixels, ""))
             for pixels in (GOOD, BAD)]
    for limit in ("fail", "warn"):
        ran = tonetool(*files, f"--hdrflip:{limit}=0.5", status=1)
        assert f"pictures are not looked at: {names[1]}" in ran.err and "PASS" not in ran.out
    assert "not looked at" in tonetool(*files, "--hdrflip", "--warnings-exit", status=2).err
    tonetool(*files, f"--hdrflip:fail=0.01:layer={names[0]}")
    tonetool(*files, f"--hdrflip:fail=0.01:layer={names[1]}", status=3)
    assert "not looked at" in tonetool(*files, "--hdrflip", "--json", "x.json", status=1).out


@pytest.mark.parametrize("names", [("rgba_left", "rgba_right"), ("rgba.left", "rgba.right"),
                                   ("left", "right")])
def test_views_of_parts(tonetool, parts, names):
    files = [parts(f"{pixels is BAD}.exr", (names[0], GOOD, "left"), (names[1], pixels, "right"))
             for pixels in (GOOD, BAD)]
    assert "not looked at" in tonetool(*files, "--hdrflip:fail=0.5", status=1).err
    for layer, status in ((names[0], 0), (names[1], 3), ("left", 0), ("right", 3)):
        tonetool(*files, f"--hdrflip:fail=0.01:layer={layer}", status=status)


def test_views_of_one_part(tonetool, put):
    files = [put(f"{pixels is BAD}.exr", np.concatenate([GOOD, pixels], -1),
                 ["R", "G", "B", "right.R", "right.G", "right.B"]) for pixels in (GOOD, BAD)]
    assert "not looked at: right" in tonetool(*files, "--hdrflip:fail=0.5", status=1).err
    for layer, status in (("R,G,B", 0), ("right", 3)):
        tonetool(*files, f"--hdrflip:fail=0.01:layer={layer}", status=status)


# ---- orientation

def test_pictures_that_are_turned_differently(tonetool, put):
    turn = {"Orientation": 3}
    upright = put("upright.tif", GOOD)
    turned, other = put("turned.tif", GOOD, attributes=turn), put("other.tif", BAD,
                                                                 attributes=turn)
    tagged = put("tagged.tif", GOOD, attributes={"Orientation": 1})
    for command in ("hdrflip", "ldrflip", "flipdiff", "errormap:metric=mse"):
        ran = tonetool(upright, turned, f"--{command}:fail=0", status=1)
        assert "the Orientation of the reference is 1, that of the test 3" in ran.err
        tonetool(upright, tagged, f"--{command}:fail=0")
    tonetool(turned, other, "--hdrflip:fail=0.01", status=3)
    tonetool(upright, turned, "--reorient", "--hdrflip:fail=0.01", status=3)
    assert "differ in Orientation" in tonetool(upright, turned, "--diff", status=1).out
    assert "Orientation" in tonetool(upright, turned, "--tmqi", status=1).err


# ---- diff

def test_a_diff_looks_at_all_that_is_there(tonetool, put, pair, aovs):
    for command in ("--diff", "--pdiff"):
        ran = tonetool(*aovs, command, status=1)
        assert "FAILURE" in ran.out and "Subimage 2" in ran.out and "PASS" not in ran.out
        assert "PASS" in tonetool(aovs[0], aovs[0], command).out
        ran = tonetool(pair[0], aovs[0], command, status=1)
        assert "differing numbers of subimages (1 vs 3)" in ran.out
    assert "PASS" in tonetool("--compat", *aovs, "--diff").out


@pytest.mark.parametrize("command", ["--diff", "--pdiff"])
def test_a_diff_of_other_sizes_or_channels(tonetool, put, pair, command):
    others = {
        "wider.exr": (np.pad(GOOD, ((0, 0), (0, 1), (0, 0)), mode="edge"), "RGB", None, "in size"),
        "padded.exr": (np.pad(GOOD, ((0, 9), (0, 9), (0, 0))), "RGB", None, "in size"),
        "display.exr": (GOOD, "RGB", (0, 0, 0, 0, WIDTH + 4, HEIGHT), "in their display windows"),
        "moved.exr": (GOOD, "RGB", (5, 0, 0, 0, WIDTH, HEIGHT), "in size"),
        "alpha.exr": (np.pad(GOOD, ((0, 0), (0, 0), (0, 1))), "RGBA", None, "in their channels"),
        "named.exr": (GOOD, ["x.R", "x.G", "x.B"], None, "in their channels")}
    for name, (pixels, channels, window, text) in others.items():
        put(name, pixels, channels, window=window)
        for words in ((pair[0], name), (name, pair[0])):
            ran = tonetool(*words, command, status=1)
            assert text in ran.out and "FAILURE" in ran.out and "PASS" not in ran.out
    ran = tonetool("--compat", pair[0], "padded.exr", "--diff")
    assert "PASS" in ran.out


# ---- warnings

def test_a_file_against_itself(tonetool, put, pair, tmp_path, aovs):
    os.symlink("good.exr", tmp_path / "symbolic.exr")
    os.link(tmp_path / "good.exr", tmp_path / "hard.exr")
    for other in ("good.exr", "symbolic.exr", "hard.exr", "./good.exr"):
        for command in ("--hdrflip:fail=0", "--errormap:metric=mae", "--diff"):
            ran = tonetool("good.exr", other, command, "--warnings-exit", status=2)
            assert "are the same file" in ran.err
    put("copy.exr", GOOD)
    assert not tonetool("good.exr", "copy.exr", "--hdrflip:fail=0", "--warnings-exit").err
    assert not tonetool("good.exr", "good.exr", "--mulc", "1", "--hdrflip:fail=0").err
    # The same commands make the same of one file.
    for same in (["--mulc", "1"], ["--ch", "R,G,B"], ["--resize", "50%", "--exposure", "1"]):
        for command in ("--hdrflip:fail=0", "--diff"):
            ran = tonetool("good.exr", *same, "hard.exr", *same, command, "--warnings-exit",
                           status=2)
            assert "are the same file" in ran.err
        assert not tonetool("good.exr", *same, "copy.exr", *same, "--hdrflip:fail=0").err
    assert not tonetool("good.exr", "--mulc", "1", "good.exr", "--mulc", "1.0001",
                        "--hdrflip:fail=0.5").err
    for name in ("ref.0001.exr", "ref.0002.exr"):
        put(name, GOOD)
    ran = tonetool("ref.#.exr", "ref.#.exr", "--hdrflip:fail=0.01:print=0", "--json", "s.json", status=1)
    assert 'in all 2 frames "ref.#.exr" and "ref.#.exr" are the same file' in ran.err
    ran = tonetool("ref.#.exr", "--mulc", "1", "ref.#.exr", "--mulc", "1.0001", "--hdrflip:fail=0.5")
    assert "check: passed, 2 frames: 2 passed" in ran.out


@pytest.mark.parametrize("between", [["--exposure", "1"], ["--mulc", "1"], ["--ch", "R,G,B"],
                                     ["--flip"], ["--blur", "3x3"],
                                     ["--for", "i", "0,40", "--dup", "--max", "--endfor"]])
def test_parts_that_a_command_before_has_left_out(tonetool, make_parts, between):
    one, other = make_parts("a.exr", 0.5, 0.5), make_parts("b.exr", 0.5, 0.9)
    for command in ("--hdrflip:fail=0.01", "--errormap:metric=mse:fail=0.01", "--diff"):
        ran = tonetool(one, *between, other, *between, command, status=1)
        assert "has left out parts with a picture: two" in ran.err and "PASS" not in ran.out
        ran = tonetool(one, "--subimage", "one", *between, other, "--subimage", "0", *between,
                       command)
        assert "PASS" in ran.out


def test_layers_of_other_names(tonetool, put):
    for layer in ("diffuse", "specular", "left", "right", "C", "ViewLayer.Combined", "v.diffuse"):
        put(f"{layer}.exr", GOOD, [f"{layer}.{c}" for c in "RGB"])
    put("plain.exr", GOOD)
    for one, other in (("diffuse", "specular"), ("left", "right"), ("plain", "diffuse")):
        ran = tonetool(f"{one}.exr", f"{other}.exr", "--hdrflip:fail=0.1", "--warnings-exit",
                       status=2)
        assert "the layer of the reference is" in ran.err
    for one, other in (("C", "ViewLayer.Combined"), ("plain", "C"), ("diffuse", "v.diffuse")):
        tonetool(f"{one}.exr", f"{other}.exr", "--hdrflip:fail=0.1", "--warnings-exit")


def test_a_crop_that_leaves_most_out_is_said(tonetool, put):
    put("a.exr", GOOD)
    for width, status in ((WIDTH - 2, 0), (WIDTH // 3, 2)):
        put("b.exr", GOOD, window=(0, 0, 0, 0, width, HEIGHT))
        for command in ("hdrflip", "errormap:metric=mse"):
            ran = tonetool("a.exr", "b.exr", f"--{command}:fail=0.1:crop=1", "--warnings-exit",
                           status=status)
            assert (f"only {width * HEIGHT} of the {WIDTH * HEIGHT} pixels" in ran.err) == (status == 2)


def test_mip_levels_that_are_not_looked_at(tonetool, put):
    for name in ("good", "other"):
        put(f"{name}.exr", GOOD)
        tonetool(f"{name}.exr", "-otex", f"{name}.tx")
    ran = tonetool("good.tx", "other.tx", "--hdrflip:fail=0.1", "--warnings-exit", status=2)
    assert "MIP levels the largest is looked at" in ran.err
    tonetool("good.tx", "other.tx", "--diff", "--warnings-exit")
    tonetool("--warnings-exit", "good.tx", "--selectmip", "1", "--label", "a", "other.tx",
             "--selectmip", "1", "--hdrflip:fail=0.1")


def test_alpha_that_is_ignored(tonetool_v, put):
    alpha = np.ones((HEIGHT, WIDTH, 1), np.float32)
    hole = alpha.copy()
    hole[5:15, 10:20] = 0
    full = put("full.exr", np.concatenate([GOOD, alpha], -1), "RGBA")
    put("hole.exr", np.concatenate([GOOD, hole], -1), "RGBA")
    for command in ("hdrflip", "ldrflip", "flipdiff", "errormap:metric=mae"):
        ran = tonetool_v(full, "hole.exr", f"--{command}", "--warnings-exit", status=2)
        assert "100 pixel(s) differ in alpha, which is ignored" in ran.err
        assert ran.fact("alpha-ignored") == "100"
    assert not tonetool_v(full, put("rgb.exr", GOOD), "--hdrflip:fail=0", "--warnings-exit").err
    assert "100 pixel(s)" in tonetool_v("hole.exr", "rgb.exr", "--hdrflip").err
    tonetool_v(full, "hole.exr", "--hdrflip:fail=0.01:alpha=error", status=3)


def test_light_that_is_white_at_every_exposure(tonetool, put):
    nits, brighter = GOOD * 5000, GOOD * 5000
    brighter[8:20] *= 4
    put("nits.exr", nits), put("brighter.exr", brighter)
    for command in ("flipdiff", "ldrflip", "hdrflip:tonemapper=hable:startExposure=2:"
                    "stopExposure=3"):
        ran = tonetool("nits.exr", "brighter.exr", f"--{command}")
        assert "are white in both images at every exposure" in ran.err
    assert "white" not in tonetool("nits.exr", "brighter.exr", "--hdrflip").err


# ---- values that are no numbers

@pytest.mark.parametrize("a, b", [("inf", "nan"), ("inf", "-inf"), ("nan", "-inf")])
def test_kinds_of_values_that_are_no_numbers(tonetool_v, put, a, b):
    files = []
    for kind in (a, b):
        pixels = GOOD.copy()
        pixels[5:10, 30:40] = float(kind)
        files.append(put(f"kind{kind}.exr", pixels))
    for command in ("hdrflip", "ldrflip", "errormap:metric=mse"):
        ran = tonetool_v(*files, f"--{command}:fail=0", status=3)
        assert ran.fact("nonfinite-unlike") == "50" and "FAIL" in ran.out
        copy = put("copy.exr", pixels)
        ran = tonetool_v(files[1], copy, f"--{command}:fail=0")
        assert ran.fact("max").startswith("0 ") and ran.fact("nonfinite-in-both") == "50"
    tonetool_v(*files, "--diff", status=1)


def test_what_stands_beside_a_value_that_is_no_number(tonetool_v, put):
    for name, color in (("a", [np.inf, 0.1, 0.1]), ("b", [np.inf, 9, 9])):
        pixels = GOOD.copy()
        pixels[5:10, 30:40] = color
        put(f"red_{name}.exr", pixels)
        put(f"half_{name}.exr", pixels, kind="half")
    ran = tonetool_v("red_a.exr", "red_b.exr", "--hdrflip:fail=0", status=3)
    assert ran.fact("nonfinite-unlike") == "50"
    assert tonetool_v("red_a.exr", "half_a.exr", "--hdrflip").fact("nonfinite-unlike") == "0"
    tonetool_v("red_a.exr", "half_b.exr", "--hdrflip:fail=0.5:quantity=max", status=3)


# ---- limits

def test_a_hole_that_the_mean_does_not_see(tonetool_v, put):
    plate = np.full((120, 160, 3), 0.2) * (1 + 0.3 * np.sin(np.arange(160) / 9))[None, :, None]
    broken = plate.copy()
    broken[40:46, 60:66] = 0
    files = put("plate.exr", plate), put("hole.exr", broken)
    tonetool_v(*files, "--hdrflip:fail=0.05")
    for limits in ("fail=0.05:quantity=p99.9", "fail=p99.95=0.05", "fail=max=0.05",
                   "fail=above0.2=0.0001", "above=0.2:fail=above=0.0001",
                   "fail=mean=0.05,p99.9=0.05", "fail=mean=0.05,max=0.9,p99.9=0.05"):
        ran = tonetool_v(*files, f"--hdrflip:print=0:{limits}", status=3)
        assert ran.out.count("\n") == 1 and ran.out.startswith("hdrflip: FAIL ")
        assert ", worst pixel " in ran.out and "mean" not in ran.out
    ran = tonetool_v(*files, "--hdrflip:print=0:fail=mean=0.05,p99=0.5:warn=max=0.1",
                   "--warnings-exit", status=2)
    assert ran.out.startswith("hdrflip: WARNING max ")
    ran = tonetool_v(*files, "--hdrflip:print=0:fail=mean=0.05,p99=0.5")
    assert ran.out.startswith("hdrflip: PASS mean ") and " <= 0.5 (hole.exr)" in ran.out
    assert float(tonetool_v(*files, "--hdrflip:above=0.2").fact("above0.2")) > 36 / 19200


def test_several_limits_of_one_measurement(tonetool, pair, tmp_path):
    limits = "fail=p99.9=0.05,mean=0.9,above0.1=0.5:warn=mean=0.001"
    tonetool(*pair, f"--hdrflip:print=0:{limits}", "--json", "x.json", "--csv", "x.csv",
             "--junit", "x.xml", status=3)
    (frame,) = json.loads((tmp_path / "x.json").read_text(encoding="utf-8"))["frames"]
    found = frame["measurements"][0]["thresholds"]
    assert [(one["quantity"], one.get("fail"), one.get("warn")) for one in found] == [
        ("p99.9", 0.05, None), ("mean", 0.9, 0.001), ("above0.1", 0.5, None)]
    assert frame["status"] == "failed" and frame["message"].startswith("hdrflip: p99.9 ")
    for one in found:
        assert one["value"] == frame["measurements"][0]["quantities"][one["quantity"]]
    assert "hdrflip.threshold.mean" in (tmp_path / "x.csv").read_text(encoding="utf-8")
    assert "p99.9" in (tmp_path / "x.xml").read_text(encoding="utf-8")
    tonetool("--merge", "x.json", "--json", "m.json", status=3)
    assert json.loads((tmp_path / "m.json").read_text(encoding="utf-8"))["frames"] == [frame]


@pytest.mark.parametrize("words, text", [
    ("hdrflip:fail=1", "fail=1 can never fail: mean is never above 1"),
    ("hdrflip:warn=1", "warn=1 can never warn"),
    ("ldrflip:fail=max=1.0", "max is never above 1"),
    ("flipdiff:fail=1", "can never fail"),
    ("filmstrip:fail=p99=1", "can never fail"),
    ("hdrflip:fail=above0.1=1", "above0.1 is never above 1"),
    ("hdrflip:fail=above=0.1", "needs above=E"),
    ("hdrflip:above=1", "no error is above it"),
    ("hdrflip:above=0.05:fail=0.5", "above= is not what the limit without a name is of, which is mean"),
    ("hdrflip:fail=above1=0", "no error is above it"),
    ("hdrflip:fail=mean=0.5,above1.5=0.1", "no error is above it"),
    ("errormap:metric=smape:fail=above1=0", "no error is above it"),
    ("errormap:metric=smape:fail=1", "smape is never above 1"),
    ("errormap:metric=mpsnr:fail=0", "mpsnr is never below 0"),
    ("tmqi:fail=0", "Q is never below 0"),
    ("tmqi:fail=above0.1=0.1", "unknown quantity"),
    ("hdrflip:fail=p101=0.5", 'unknown quantity "p101"'),
    ("hdrflip:fail=p99=0.5,p99.0=0.4", "two limits of p99"),
    ("hdrflip:fail=0.1,0.2", "two limits of mean"),
    ("hdrflip:fail=mean=", "not a number"),
    ("hdrflip:fail==0.5", 'unknown quantity ""'),
    ("hdrflip:quantity=max:fail=p99=0.5", "quantity= is of a limit without a name"),
    ("errormap:metric=psnr:fail=-1000", "out of range"),
])
def test_limits_that_mean_nothing(tonetool, pair, words, text):
    ran = tonetool(*pair, f"--{words}", status=1)
    assert text in ran.err and "PASS" not in ran.out


def test_percentages_that_mean_nothing(tonetool, pair):
    ran = tonetool("--failpercent", "100", *pair, "--diff", status=1)
    assert "--failpercent 100 can never fail" in ran.err
    tonetool("--failpercent", "100", "--hardfail", "0.1", *pair, "--diff", status=1)
    tonetool("--failpercent", "100", "--hardfail", "100", *pair, "--diff")
    tonetool("--compat", "--failpercent", "100", *pair, "--diff")


@pytest.mark.parametrize("again", [["--dup"], ["--label", "x", "x"]])
@pytest.mark.parametrize("command", ["hdrflip", "ldrflip", "errormap:metric=mse", "diff"])
def test_an_image_against_itself(tonetool, make_image, again, command):
    a = make_image("a.exr", 64, 48, kind="half")
    ran = tonetool(a, *again, f"--{command}", "--warnings-exit", status=2)
    assert "are the same file" in ran.err


def test_a_limit_of_too_few_frames_fails_until_all_frames_are_there(tonetool):
    line = [TESTIMAGES / "anim" / "ref.#.exr", TESTIMAGES / "anim" / "test.#.exr", "--hdrflip:quantity=mean:fail=auto"]
    ran = tonetool("--frames", "1-4", *line, status=3)
    assert "fail=auto found no limit: it needs 5 frames, most of them alike" in ran.out
    for part, frames in (("a.json", "1-4"), ("b.json", "5-8")):
        tonetool("--frames", frames, *line, "--exit-zero", "--json", part)
    ran = tonetool("--merge", "a.json", "b.json", "--frames", "1-8", status=3)
    assert "check: failed, 8 frames: 1 failed, 7 passed; " in ran.out and "worst: frame 5" in ran.out
