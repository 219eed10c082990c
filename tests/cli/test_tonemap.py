# SPDX-License-Identifier: BSD-3-Clause
"""--tonemap, --calibrate and --tonecurves, against numpy and against the files' own figures."""

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
CORNELL = TESTIMAGES / "cornell_ref.exr"


def read(name):
    """Pixels (float) and spec."""
    source = oiio.ImageInput.open(str(name))
    assert source, oiio.geterror()
    return source.read_image("float"), source.spec()


def color(name):
    """R, G, B (plain, or of the beauty of Blender's files) as double."""
    pixels, spec = read(name)
    layer = "" if "R" in spec.channelnames else "ViewLayer.Combined."
    return pixels[..., [spec.channelnames.index(layer + c) for c in "RGB"]].astype(np.float64)


def luminance(rgb):
    return np.maximum(rgb, 0) @ WEIGHTS


def srgb(v):
    return np.where(v <= 0.0031308, v * 12.92, 1.055 * np.maximum(v, 1e-9) ** (1 / 2.4) - 0.055)


def test_a_curve_per_channel(tonetool, tmp_path):
    tonetool(CORNELL, "--tonemap:curve=aces:encode=none", "-d", "float", "-o", "out.exr")
    x = np.maximum(color(CORNELL), 0)
    expected = np.clip((2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14), 0, 1)
    # The bound of the lanes.
    assert np.abs(color(tmp_path / "out.exr") - expected).max() <= 2e-6


def test_a_curve_on_luminance_with_saturation(tonetool, tmp_path):
    tonetool(CORNELL, "--tonemap:curve=reinhard:saturation=0.5:stops=1:encode=none:clamp=0",
             "-d", "float", "-o", "out.exr")
    x = 2 * np.maximum(color(CORNELL), 0)
    lum = luminance(x)[..., None]
    safe = np.where(lum > 0, lum, 1)
    expected = np.where(lum > 0, lum / (1 + lum) * np.sqrt(x / safe), 0)
    assert np.abs(color(tmp_path / "out.exr") - expected).max() <= 4e-6


def test_the_result_is_srgb_unless_asked_otherwise(tonetool, tmp_path):
    tonetool(CORNELL, "--tonemap", "-d", "float", "-o", "srgb.exr")
    tonetool(CORNELL, "--tonemap:encode=none", "-d", "float", "-o", "linear.exr")
    assert np.abs(color(tmp_path / "srgb.exr") - srgb(color(tmp_path / "linear.exr"))).max() < 1e-6
    for encode, exponent in (("gamma2.2", 2.2), ("rec1886", 2.4), ("gamma2.6", 2.6)):
        tonetool(CORNELL, f"--tonemap:encode={encode}", "-d", "float", "-o", "out.exr")
        back = color(tmp_path / "out.exr") ** exponent
        assert np.abs(back - color(tmp_path / "linear.exr")).max() < 2e-6, encode


def test_a_file_says_how_it_is_encoded(tonetool, tmp_path):
    ran = tonetool("--warnings-exit", CORNELL, "--tonemap", "-o", "out.png")
    assert read(tmp_path / "out.png")[1].get_string_attribute("oiio:ColorSpace") in ("sRGB", "srgb_rec709_scene")
    # The picture is the layer that was mapped, and that is no news.
    assert "Can't save" not in ran.err
    # Readers of OpenEXR take every file for linear light.
    assert "display-encoded" in tonetool(CORNELL, "--tonemap", "-o", "out.exr").err
    assert not tonetool(CORNELL, "--tonemap:encode=none", "-o", "out.exr").err


def test_the_mapped_layer_is_what_a_png_gets(tonetool, make_image, tmp_path):
    pixels = np.zeros((4, 4, 7), np.float32)
    pixels[..., 3:6] = [0.1, 0.2, 0.4]
    names = ("Z", "N.X", "N.Y", "C.R", "C.G", "C.B", "N.Z")
    source = make_image("in.exr", 4, 4, names, pixels=pixels)
    tonetool(source, "--tonemap:curve=linear", "-o", "out.png")
    out = read(tmp_path / "out.png")[0]
    assert out.shape == (4, 4, 3)
    assert np.abs(out[0, 0] - srgb(np.array([0.1, 0.2, 0.4]))).max() < 0.003


def test_every_curve_of_the_list(tonetool, tmp_path):
    names = tonetool("--tonecurves:table=1").out.splitlines()[0].split(",")[1:]
    assert {"aces", "hable", "reinhard", "agx", "neutral", "drago"} <= set(names)
    for name in names:
        tonetool(CORNELL, f"--tonemap:curve={name}", "-d", "float", "-o", "out.exr")
        shown = color(tmp_path / "out.exr")
        assert shown.min() >= 0 and shown.max() <= 1, name
        assert shown.max() > 0.5 and shown.std() > 0.05, name


def test_other_channels_and_alpha_are_carried(tonetool, make_image, tmp_path):
    pixels = np.random.default_rng(5).random((9, 7, 6)).astype(np.float32) * 4
    source = make_image("in.exr", 7, 9, ("A", "R", "G", "B", "Z", "P.X"), pixels=pixels)
    tonetool(source, "--tonemap:curve=hable", "-o", "out.exr")
    out, spec = read(tmp_path / "out.exr")
    before, header = read(tmp_path / source)
    for name in ("A", "Z", "P.X"):
        assert np.array_equal(out[..., spec.channelnames.index(name)],
                              before[..., header.channelnames.index(name)]), name
    assert not np.array_equal(out[..., spec.channelnames.index("R")],
                              before[..., header.channelnames.index("R")])


def test_unpremult_maps_the_color_behind_alpha(tonetool, make_image, tmp_path):
    rgb = np.array([0.1, 0.5, 2.0])
    alpha = np.array([0, 0.25, 1.0])
    pixels = np.zeros((1, 3, 4), np.float32)
    pixels[0, :, :3] = rgb * np.where(alpha > 0, alpha, 1)[:, None]
    pixels[0, :, 3] = alpha
    source = make_image("in.exr", 3, 1, ("R", "G", "B", "A"), pixels=pixels)
    tonetool(source, "--tonemap:curve=reinhard:on=rgb:encode=none:unpremult=1", "-d", "float",
             "-o", "out.exr")
    expected = rgb / (1 + rgb) * np.where(alpha > 0, alpha, 1)[:, None]
    assert np.abs(color(tmp_path / "out.exr")[0] - expected).max() < 1e-6


def test_one_picture_in_two_spaces_looks_the_same(tonetool, tmp_path):
    for name in ("rec709", "acescg"):
        tonetool(TESTIMAGES / f"{name}.exr", "--tonemap:curve=agx", "-d", "float",
                 "-o", f"{name}.out.exr")
    a, b = color(tmp_path / "rec709.out.exr"), color(tmp_path / "acescg.out.exr")
    # Both files are halves.
    assert np.abs(a - b).max() < 2e-3


def test_primaries_of_the_image_keep_its_values(tonetool, tmp_path):
    source = TESTIMAGES / "acescg.exr"
    tonetool(source, "--tonemap:curve=reinhard:on=rgb:primaries=image:encode=none", "-d", "float",
             "-o", "out.exr")
    x = np.maximum(color(source), 0)
    assert np.abs(color(tmp_path / "out.exr") - x / (1 + x)).max() < 2e-6
    assert read(tmp_path / "out.exr")[1].getattribute("chromaticities") is not None
    # On luminance the weights are those of the primaries: a grey is what it is on each channel.
    tonetool(source, "--tonemap:curve=reinhard:on=luminance:primaries=image:encode=none",
             "-d", "float", "-o", "out.exr")
    weights = np.array([0.2722, 0.6741, 0.0537])  # ACEScg's Y, before adaptation to D65
    lum = (x @ weights)[..., None]
    assert np.abs(color(tmp_path / "out.exr") - np.clip(x / (1 + lum), 0, 1)).max() < 0.01
    ran = tonetool(source, "--tonemap:primaries=image", "-o", "out.exr", status=1)
    assert "encode=srgb" in ran.err and "acescg" in ran.err


def test_pixels_that_are_not_numbers(tonetool, make_image, tmp_path):
    pixels = np.full((1, 4, 3), 0.5, np.float32)
    pixels[0, 0] = [np.nan, 0.5, 0.5]
    pixels[0, 1] = [np.inf, 0.5, 0.5]
    pixels[0, 2] = [-np.inf, -1, 0.5]
    source = make_image("in.exr", 4, 1, pixels=pixels)
    for curve in ("aces", "agx", "neutral", "drago", "reinhard", "uchimura"):
        ran = tonetool(source, f"--tonemap:curve={curve}:encode=none", "-d", "float",
                       "-o", "out.exr")
        out = color(tmp_path / "out.exr")
        assert np.isfinite(out).all() and out.min() >= 0 and out.max() <= 1, curve
        assert "3 pixel(s) are not finite" in ran.err
    ran = tonetool(source, "--calibrate:method=mean", "-o", "out.exr")
    assert ran.fact("mean") == "0.500001"


def geometric(lum, epsilon=1e-6):
    return np.exp(np.log(lum.astype(np.float32).astype(np.float64) + epsilon).mean())


def test_calibration_by_the_mean(tonetool, tmp_path):
    lum = luminance(color(CORNELL))
    ran = tonetool(CORNELL, "--calibrate:method=mean:key=0.18", "-d", "float", "-o", "out.exr")
    assert float(ran.fact("mean")) == pytest.approx(geometric(lum), rel=1e-5)
    factor = 0.18 / geometric(lum)
    assert float(ran.fact("exposure")) == pytest.approx(np.log2(factor), abs=1e-4)
    assert np.allclose(color(tmp_path / "out.exr"), color(CORNELL) * factor, rtol=1e-5, atol=0)


def test_calibration_with_an_automatic_key(tonetool, tmp_path):
    mean = geometric(luminance(color(CORNELL)))
    key = 1.03 - 2 / (2 + np.log10(1 + mean))
    ran = tonetool(CORNELL, "--calibrate:method=auto:stops=1", "-d", "float", "-o", "out.exr")
    assert float(ran.fact("key")) == pytest.approx(key, rel=1e-5)
    assert np.allclose(color(tmp_path / "out.exr"), color(CORNELL) * 2 * key / mean, rtol=1e-5,
                       atol=0)


def test_calibration_leaves_out_what_it_is_asked_to(tonetool, make_image):
    pixels = np.zeros((1, 4, 4), np.float32)
    pixels[0, :, 3] = [1, 1, 0, 1]
    pixels[0, :, :3] = np.array([1, 4, 1e4, 0])[:, None]
    source = make_image("in.exr", 4, 1, ("R", "G", "B", "A"), pixels=pixels)
    for modifiers, kept in (("", [1, 4, 0]), (":count=all", [1, 4, 1e4, 0]),
                            (":skipblack=1", [1, 4, 1e4]),
                            (":skiptransparent=1", [1, 4, 0]),
                            (":skipblack=1:skiptransparent=1", [1, 4])):
        ran = tonetool(source, f"--calibrate:method=mean{modifiers}", "-o", "out.exr")
        mean = geometric(np.array(kept))
        assert float(ran.fact("mean")) == pytest.approx(mean, rel=1e-5), modifiers


def test_local_means_even_out_a_picture(tonetool, make_image, tmp_path):
    pixels = np.ones((64, 64, 3), np.float32) * 0.25
    pixels[:, 32:] = 16
    source = make_image("in.exr", 64, 64, pixels=pixels)
    tonetool(source, "--calibrate:method=mean:level=1:key=0.5", "-d", "float", "-o", "out.exr")
    out = color(tmp_path / "out.exr")
    # Beyond the middles of the cells, at the sides, each half has its own mean.
    assert out[0, 0, 0] == pytest.approx(0.5, rel=1e-5)
    assert out[63, 63, 0] == pytest.approx(0.5, rel=1e-5)
    # In the middle both see the mean of the two (bilinear in logarithms), half a pixel off.
    assert out[10, 31, 0] == pytest.approx(0.5 * 0.25 / 2, rel=0.1)
    ran = tonetool(source, "--calibrate:method=mean:level=7", "-o", "out.exr", status=1)
    assert "level is 7" in ran.err and "0 to 6" in ran.err


def test_white_from_the_image(tonetool, tmp_path):
    lum = luminance(color(CORNELL))
    mean = geometric(lum)
    ran = tonetool(CORNELL, "--tonemap:curve=reinhard-extended:method=mean:key=0.5:white=max"
                   ":encode=none:clamp=0", "-d", "float", "-o", "out.exr")
    white = lum.max() * 0.5 / mean
    facts = [line for line in ran.out.splitlines() if line.startswith("tonemap: white ")]
    assert [float(line.split()[-1]) for line in facts] == [pytest.approx(white, rel=1e-5)] * 2
    # The brightest pixel becomes white.
    assert luminance(color(tmp_path / "out.exr")).max() == pytest.approx(1, abs=2e-6)
    ran = tonetool(CORNELL, "--tonemap:curve=drago:white=p50", "-o", "out.exr")
    median = np.sort(lum.ravel())[(lum.size - 1) // 2]
    assert float(ran.out.split("tonemap: white ")[1].split()[0]) == pytest.approx(median, rel=1e-5)


def test_the_picture_does_not_depend_on_threads(tonetool, tmp_path):
    for n in (1, 2, 3):
        tonetool("--threads", n, CORNELL, "--tonemap:curve=drago:method=auto:level=2:white=p99",
                 "-d", "float", "-o", f"{n}.exr")
    one = read(tmp_path / "1.exr")[0]
    assert np.array_equal(one, read(tmp_path / "2.exr")[0])
    assert np.array_equal(one, read(tmp_path / "3.exr")[0])


def test_metadata_says_what_was_done(tonetool, tmp_path):
    tonetool(CORNELL, "--tonemap:curve=drago:bias=0.8:stops=1.5", "-o", "out.exr")
    spec = read(tmp_path / "out.exr")[1]
    assert spec.get_string_attribute("tonemap:curve") == "drago"
    assert "bias=0.8" in spec.get_string_attribute("tonemap:parameters")
    assert spec.get_float_attribute("tonemap:exposure") == 1.5


BAD = [
    ("--tonemap:curve=haple", ["haple", "hable"]),
    ("--tonemap:curve=nothing-like-it", ["nothing-like-it", "aces", "uchimura"]),
    ("--tonemap:curve=drago:bias=2", ["bias", "2"]),
    ("--tonemap:curve=aces:bias=0.8", ["aces", "bias"]),
    ("--tonemap:curve=aces:white=max", ["aces", "white"]),
    ("--tonemap:curve=agx:on=rgb", ["agx", "on=rgb"]),
    ("--tonemap:curve=aces:saturation=0.5", ["saturation", "aces"]),
    ("--tonemap:saturation=5:curve=reinhard", ["saturation", "0 to 4"]),
    ("--tonemap:coeffs=1,2,3", ["coeffs", "6"]),
    ("--tonemap:coeffs=0,1,0,0,0,0", ["coeffs"]),
    ("--tonemap:curve=aces:coeffs=0,1,0,0,1,1", ["curve", "coeffs"]),
    ("--tonemap:encode=rec709", ["encode", "srgb"]),
    ("--tonemap:method=global", ["method", "manual"]),
    ("--tonemap:key=0.2", ["key", "mean"]),
    ("--tonemap:level=2", ["local", "mean"]),
    ("--tonemap:white=p0", ["white"]),
    ("--tonemap:stops=200", ["stops", "126"]),
    ("--tonemap:looks=a", ["looks", "display"]),
    ("--tonemap:display=sRGB:curve=aces", ["curve", "view"]),
    ("--tonemap:display=sRGB:encode=none", ["encode"]),
    ("--calibrate:method=mean:key=0", ["key"]),
    ("--calibrate:epsilon=0:method=mean", ["epsilon"]),
]


@pytest.mark.parametrize("command,words", BAD)
def test_what_is_wrong_is_said(tonetool, tmp_path, command, words):
    ran = tonetool(CORNELL, command, "-o", "out.exr", status=1)
    for word in words:
        assert word in ran.err, ran.err
    assert not (tmp_path / "out.exr").exists()


def test_without_a_configuration_a_view_is_an_error(tonetool, monkeypatch):
    monkeypatch.delenv("OCIO", raising=False)
    ran = tonetool(CORNELL, "--tonemap:display=sRGB:view=ACES", "-o", "out.exr", status=1)
    assert "OCIO" in ran.err


def test_the_list_is_complete(tonetool):
    text = tonetool("--tonecurves").out
    table = tonetool("--tonecurves:table=1").out.splitlines()
    names = table[0].split(",")[1:]
    for name in names:
        assert f"\n{name}: " in "\n" + text
    rows = np.array([[float(cell) for cell in line.split(",")] for line in table[1:]])
    assert rows[0, 0] == -12 and rows[-1, 0] == 12 and len(rows) == 97
    aces = rows[:, 1 + names.index("aces")]
    x = np.exp2(rows[:, 0])
    assert np.allclose(aces, np.clip((2.51 * x + 0.03) * x / ((2.43 * x + 0.59) * x + 0.14), 0, 1),
                       rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("words", [["--exposure", "1"], ["--tonemap:curve=reinhard"], ["--bloom"], ["--calibrate:stops=1"],
                                   ["--cgtmo"]], ids=lambda words: words[0])
def test_with_all_subimages_the_others_are_carried(tonetool, make_image, tmp_path, words):
    make_image("n.exr", channels=("normal.X", "normal.Y", "normal.Z"), seed=2)
    make_image("rgb.exr", attributes={"oiio:subimagename": "rgba"})
    make_image("z.exr", channels=("Z",), seed=3)
    tonetool("n.exr", "rgb.exr", "z.exr", "--siappendall", "-o", "parts.exr")
    tonetool("parts.exr", *words, "-o", "one.exr")
    tonetool("-a", "parts.exr", *words, "-o", "all.exr")

    def parts(name):
        file = oiio.ImageInput.open(str(tmp_path / name))
        found = []
        while file.seek_subimage(len(found), 0):
            found.append((file.spec().channelnames, file.read_image("float").tobytes()))
        return found

    before, after = parts("parts.exr"), parts("all.exr")
    assert len(before) == len(after) == 3 and after[0] == before[0] and after[2] == before[2]
    assert parts("one.exr") == [after[1]] != [before[1]]


@pytest.mark.parametrize("command", ["--tonemap", "--cgtmo"])
def test_negative_pixels_are_counted(tonetool, command):
    name = command.strip("-")
    assert f"{name}: negative 1\n" in tonetool("-v", TESTIMAGES / "negative.exr", command, "-o", "o.png").out
    assert "negative" not in tonetool("-v", CORNELL, command, "-o", "o.png").out


@pytest.mark.parametrize("name", ["o.exr", "o.hdr"])
def test_display_light_in_a_file_of_light_is_warned_about(tonetool, name):
    said = "is read as linear light (encode=none)"
    assert said in tonetool(CORNELL, "--tonemap", "-o", name).err
    assert said not in tonetool(CORNELL, "--tonemap:encode=none", "-o", name).err
    assert said not in tonetool(CORNELL, "--tonemap", "-o", "o.png").err
