# SPDX-License-Identifier: BSD-3-Clause
"""Tone curves that are measured: tables in files, the film's formula, and curves written back.

The responses of cameras and films here are made up; those of real ones belong to who measured them.
"""

import json
import os
import re
import struct
from pathlib import Path

import numpy as np
import pytest
from conftest import TESTIMAGES

CORNELL = TESTIMAGES / "cornell_ref.exr"
CORNELL_TEST = TESTIMAGES / "cornell_test.exr"


def hable(x):
    return (0.231683 * x * x + 0.013791 * x) / (0.18 * x * x + 0.3 * x + 0.018)


def aces(x):
    return (2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14)


def reinhard(x):
    return x / (1 + x)


CURVES = {"hable": hable, "aces": aces, "reinhard": reinhard}


def srgb(v):
    return np.where(v <= 0.0031308, v * 12.92, 1.055 * np.maximum(v, 1e-9) ** (1 / 2.4) - 0.055)


def linear(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def spi1d(rows, low=0.0, high=1.0):
    rows = np.atleast_2d(np.asarray(rows, np.float64).T).T
    lines = "\n".join(" ".join(f"{v:.9g}" for v in row) for row in rows)
    return (f"Version 1\nFrom {low} {high}\nLength {len(rows)}\nComponents {rows.shape[1]}\n"
            f"{{\n{lines}\n}}\n")


def cube(rows, low=0.0, high=1.0):
    rows = np.asarray(rows, np.float64)
    rows = np.stack([rows] * 3, 1) if rows.ndim == 1 else rows
    lines = "\n".join(" ".join(f"{v:.9g}" for v in row) for row in rows)
    return (f"TITLE \"a curve\"\n# made up\nLUT_1D_SIZE {len(rows)}\n"
            f"DOMAIN_MIN {low} {low} {low}\nDOMAIN_MAX {high} {high} {high}\n{lines}\n")


def csv(x, rows):
    rows = np.atleast_2d(np.asarray(rows, np.float64).T).T
    return "# x and y\nx,y\n" + "".join(
        ",".join(f"{v:.9g}" for v in (a, *row)) + "\n" for a, row in zip(x, rows))


def clf(rows):
    lines = "\n".join(f"{v:.9g}" for v in rows)
    return ('<?xml version="1.0" encoding="UTF-8"?>\n<ProcessList compCLFversion="3" id="x">\n'
            '<LUT1D inBitDepth="32f" outBitDepth="32f">\n'
            f'<Array dim="{len(rows)} 1">\n{lines}\n</Array>\n</LUT1D>\n</ProcessList>\n')


def responses(curves, kind="graph"):
    """Text of the DoRF database's form."""
    out = ""
    for name, (x, y) in curves.items():
        out += f"{name}\n{kind}\nI =\n" + " ".join(f"{v:.9g}" for v in x)
        out += "\nB =\n" + " ".join(f"{v:.9g}" for v in y) + "\n"
    return out


def model(x, mean, bases):
    """Text of the EMoR model's form, four values a line."""
    def block(title, values):
        rows = [values[i:i + 4] for i in range(0, len(values), 4)]
        return title + "\n" + "\n".join("   ".join(f"{v:.6e}" for v in row) for row in rows) + "\n"
    text = block("E =", x) + block("f0 =", mean)
    for k, base in enumerate(bases, 1):
        text += block(f"h({k})=", base)
    return text


@pytest.fixture
def curve(tmp_path):
    """Writes a curve and returns its name."""

    def write(name, text):
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return name if "." in name else f"./{name}"

    return write


@pytest.fixture
def ramp(make_image, tmp_path, tonetool, read):
    """What a curve makes of greys or colours, linear, as float."""

    def run(words, light, encode="none", program=None):
        light = np.asarray(light, np.float32)
        pixels = np.stack([light] * 3, -1) if light.ndim == 1 else light
        make_image("ramp.exr", pixels.shape[0], 1, pixels=pixels[None])
        (program or tonetool)("ramp.exr", f"--tonemap:{words}:encode={encode}", "-d", "float",
                              "-o", "ramp.out.exr")
        return read("ramp.out.exr")[0][0].astype(np.float64)

    return run


LIGHT = np.concatenate([[0, 1e-30, 1e-6], np.exp2(np.linspace(-12, 3.99, 500)), [16, 40, 1e10]])


def kinds(values, low=0.0, high=16.0):
    """One curve as a file of each kind, with what it needs beside its name."""
    x = np.linspace(low, high, len(values))
    return {"c.spi1d": (spi1d(values, low, high), ""), "c.cube": (cube(values, low, high), ""),
            "c.csv": (csv(x, values), ""), "c.clf": (clf(values), f":white={high:g}"),
            "c.txt": (responses({"only one": (x / high, values)}), f":white={high:g}"),
            "c.dat": (model(x / high, values, []), f":white={high:g}")}


@pytest.mark.parametrize("name", sorted(kinds([0, 1])))
def test_a_table_of_each_kind_is_its_straight_lines(name, curve, ramp):
    values = np.clip(hable(np.linspace(0, 16, 257)), 0, 1)
    text, more = kinds(values)[name]
    out = ramp(f"curve={curve(name, text)}{more}", LIGHT)
    expected = np.interp(LIGHT, np.linspace(0, 16, 257), values)
    assert np.abs(out - expected[:, None]).max() <= 2e-6


@pytest.mark.parametrize("name", sorted(CURVES))
def test_a_table_of_a_curve_gives_its_picture_and_its_comparison(name, curve, tonetool, tmp_path,
                                                                make_image, read):
    curve("t.csv", csv(np.linspace(0, 16, 4096), CURVES[name](np.linspace(0, 16, 4096))))
    on = ":on=luminance" if name == "reinhard" else ""
    source = read_color(CORNELL)
    make_image("in.exr", source.shape[1], source.shape[0], pixels=np.minimum(source, 15.9))
    for encode in ("none", "srgb"):
        for words in (f"curve={name}", "curve=t.csv" + on):
            tonetool("in.exr", f"--tonemap:{words}:encode={encode}", "-d", "float", "-o",
                     f"{words[6]}.exr")
        off = np.abs(read(f"{name[0]}.exr")[0] - read("t.exr")[0])
        # Next to black sRGB is 12.92 times as steep as light, and aces bends: straight lines over
        # 16/4095 are 6.4e-5 of light off there.
        assert (off.max() if encode == "none" else off.mean()) <= 2e-4, encode
    prescale = ":prescale=1" if name == "aces" else ""
    facts = []
    for words in (f"tonemapper={name}{prescale}", "curve=t.csv" + on):
        ran = tonetool(CORNELL, CORNELL_TEST, f"--hdrflip:{words}", "-v")
        facts.append([float(ran.fact("mean")), *ends_of(ran)])
    (mean, *stops), (table_mean, *table_stops) = facts
    assert abs(mean - table_mean) <= 1e-4
    assert np.abs(np.subtract(stops, table_stops)).max() <= 1e-3


def ends_of(ran):
    """The first and the last exposure in stops."""
    words = ran.fact("exposures").split()
    return float(words[1]), float(words[3])


def read_color(name):
    import OpenImageIO as oiio
    image = oiio.ImageBuf(str(name))
    names = image.spec().channelnames
    layer = "" if "R" in names else "ViewLayer.Combined."
    return image.get_pixels("float")[..., [names.index(layer + c) for c in "RGB"]]


def test_identical_images_are_exactly_alike(curve, tonetool, tmp_path):
    curve("t.csv", csv([0, 0.1, 1, 7], [[0, 0.01, 0], [0.3, 0.2, 0.1], [0.8, 0.9, 0.7], [1, 1, 1]]))
    ran = tonetool(CORNELL, CORNELL, "--hdrflip:curve=t.csv", "-v")
    assert ran.fact("mean") == "0" and ran.fact("max").startswith("0 at")


def test_channels_have_their_own_columns(curve, ramp):
    x = np.array([0, 0.5, 2])
    rows = np.array([[0, 0.1, 0.2], [0.5, 0.4, 0.3], [1, 0.9, 0.8]])
    color = np.array([[0.25, 1, 1.5], [3, 0, 0.5]])
    expected = np.stack([np.interp(color[:, c], x, rows[:, c]) for c in range(3)], 1)
    for name, text in (("c.csv", csv(x, rows)),
                       ("c.spi1d", spi1d(np.stack([np.interp(np.linspace(0, 2, 9), x, rows[:, c])
                                                   for c in range(3)], 1), 0, 2))):
        assert np.abs(ramp(f"curve={curve(name, text)}", color) - expected).max() <= 1e-6


def test_other_values_are_handled_as_by_other_curves(curve, ramp):
    curve("t.csv", csv([0, 1], [0.25, 0.75]))
    out = ramp("curve=t.csv", [np.nan, np.inf, -np.inf, -3, 0.5])
    assert out[:, 0].tolist() == [0.25, 0.75, 0.25, 0.25, 0.5]


def test_white_moves_the_table(curve, ramp):
    curve("t.csv", csv([0, 1], [0, 1]))
    assert np.allclose(ramp("curve=t.csv:white=4", [0, 1, 2, 4, 8])[:, 0], [0, 0.25, 0.5, 1, 1])
    out = ramp("curve=t.csv:white=max", [1, 2, 5])
    assert np.allclose(out[:, 0], [0.2, 0.4, 1], atol=1e-6)


def test_logarithms_of_light(curve, ramp):
    stops = np.linspace(-8, 4, 49)
    values = 1 / (1 + 2.0 ** -stops)
    light = np.exp2(np.linspace(-10, 6, 200))
    expected = np.interp(np.log2(light), stops, values)
    curve("two.csv", csv(stops, values))
    curve("ten.csv", csv(stops * np.log10(2), values))
    for words in ("two.csv:tableinput=log2", "ten.csv:tableinput=log10"):
        assert np.abs(ramp(f"curve={words}", light)[:, 0] - expected).max() <= 2e-6
        black = ramp(f"curve={words}:white=2", [0, 2])[:, 0]
        assert np.allclose(black, [values[0], 0.5], atol=1e-6)


def test_densities_are_light_above_the_least(curve, ramp):
    log_exposure = np.linspace(-3, 1, 17)
    density = 0.2 + 3 / (1 + np.exp(2.4 * (log_exposure + 0.7)))
    curve("film.csv", csv(log_exposure, density))
    light = 10 ** np.linspace(-4, 2, 300)
    between = np.interp(np.log10(light), log_exposure, density)
    out = ramp("curve=film.csv:tableinput=log10:tableoutput=density", light)[:, 0]
    assert np.abs(out - 10 ** -(between - density.min())).max() <= 3e-6


@pytest.mark.parametrize("encode", ["srgb", "rec1886", "none"])
def test_encoded_results_come_out_as_they_are(encode, curve, ramp):
    x, code = [0, 0.2, 1, 4], [0, 0.4, 0.9, 1]
    curve("t.csv", csv(x, code))
    light = np.linspace(0, 5, 200)
    out = ramp("curve=t.csv:tableoutput=encoded", light, encode)[:, 0]
    assert np.abs(out - np.interp(light, x, code)).max() <= (2e-5 if encode != "none" else 1e-6)


def test_encoded_results_are_decoded_in_comparisons(curve, tonetool):
    x = np.linspace(0, 16, 4096)
    curve("light.csv", csv(x, hable(x).clip(0, 1)))
    curve("code.csv", csv(x, srgb(hable(x).clip(0, 1))))
    means = [float(tonetool(CORNELL, CORNELL_TEST, f"--hdrflip:curve={words}", "-v").fact("mean"))
             for words in ("light.csv", "code.csv:tableoutput=encoded")]
    assert abs(means[0] - means[1]) <= 1e-5


CAMERAS = responses({
    "maker-100Red": (np.linspace(0, 1, 9), np.linspace(0, 1, 9) ** 0.5),
    "maker-100Green": (np.linspace(0, 1, 9), np.linspace(0, 1, 9) ** 0.6),
    "maker-100Blue": (np.linspace(0, 1, 9), np.linspace(0, 1, 9) ** 0.7),
    "other_Red": (np.linspace(0, 1, 3), [0, 0.8, 1]),
    "other_Green": (np.linspace(0, 1, 3), [0, 0.7, 1]),
    "other_Blue": (np.linspace(0, 1, 3), [0, 0.6, 1]),
    "grey": (np.linspace(0, 1, 3), [0, 0.5, 0.9])})


def test_responses_are_chosen_by_name(curve, ramp):
    curve("dorf.txt", CAMERAS)
    assert np.allclose(ramp("curve=dorf.txt:curvename=maker-100", [0.25])[0],
                       [0.25 ** 0.5, 0.25 ** 0.6, 0.25 ** 0.7], atol=1e-6)
    assert np.allclose(ramp("curve=dorf.txt:curvename=OTHER", [0.5])[0], [0.8, 0.7, 0.6])
    assert np.allclose(ramp("curve=dorf.txt:curvename=other_Red", [0.5])[0], 0.8)
    assert np.allclose(ramp("curve=dorf.txt:curvename=grey", [1])[0], 0.9)


def test_a_model_is_a_mean_and_weighted_bases(curve, ramp):
    x = np.linspace(0, 1, 10)
    bases = [np.sin(np.pi * x), np.sin(2 * np.pi * x)]
    curve("emor.txt", model(x, x, bases))
    for weights in ([], [0.1], [-0.05, 0.02]):
        words = "curve=emor.txt" + (":coeffs=" + ",".join(map(str, weights)) if weights else "")
        expected = x + sum(w * b for w, b in zip(weights, bases))
        assert np.allclose(ramp(words, x)[:, 0], expected.clip(0, 1), atol=2e-6)


def test_blanks_line_ends_and_marks_of_order_do_not_matter(curve, ramp):
    plain = csv([0, 1, 2], [0, 0.5, 1])
    for name, text in (("crlf.csv", plain.replace("\n", "\r\n")), ("cr.csv", plain.replace("\n", "\r")),
                       ("bom.csv", "\ufeff" + plain), ("end.csv", plain.rstrip("\n")),
                       ("wide.csv", plain.replace(",", " ,  ") + "\n\n# end\n")):
        assert np.allclose(ramp(f"curve={curve(name, text)}", [1])[0], 0.5), name
    # A name without an extension: what it holds tells what it is.
    assert np.allclose(ramp(f"curve={curve('dorf', CAMERAS)}:curvename=grey", [1])[0], 0.9)


ROW = "1,1\n"
HOSTILE = [
    ("c.spi1d", spi1d([0, 1]).replace("Components 1", "Components 2"), ["line 4", "2", "1 or 3"]),
    ("c.spi1d", spi1d([0, 1]).replace("Length 2", "Length 999999999999"),
     ["line 3", "999999999999", "2 to 65536"]),
    ("c.spi1d", spi1d([0, 1]).replace("Length 2", "Length 1"), ["line 3", "2 to 65536"]),
    ("c.spi1d", spi1d([0, 1]).replace("Length 2", "Length nan"), ["line 3", "nan"]),
    ("c.spi1d", spi1d([0, 1]).replace("Length 2", "Length 3"), ["2 row(s)", "3"]),
    ("c.spi1d", spi1d([0, 1]).replace("}", ""), ["row 2 of 2"]),
    ("c.spi1d", spi1d([0, 1]).replace("\n1\n", "\nnan\n"), ["line 7", "nan", "-1e9 to 1e9"]),
    ("c.spi1d", spi1d([0, 1]).replace("\n1\n", "\n1e400\n"), ["line 7", "1e400"]),
    ("c.spi1d", spi1d([0, 1], 1, 0), ["1 to 0", "rise"]),
    ("c.spi1d", spi1d([0, 1]).replace("Version 1", "Version 2"), ["line 1", "must be 1"]),
    ("c.spi1d", "", ["ends before its table"]),
    ("c.spi1d", b"\x00\x01\xff" * 100, ["not text"]),
    ("c.spi1d", bytes(range(128, 256)) * 10, ["line 1"]),
    ("c.cube", "LUT_3D_SIZE 2\n" + "0 0 0\n" * 8, ["LUT_3D_SIZE", "LUT_1D_SIZE"]),
    ("c.cube", "LUT_1D_SIZE 2\n0 0 0\n1 1\n", ["line 3", "must be 3"]),
    ("c.cube", "LUT_1D_SIZE 2\n0 0 0\n1 1 1\n1 1 1\n", ["line 4", "2 rows"]),
    ("c.cube", "LUT_1D_SIZE 2\nDOMAIN_MAX 1 2 3\n0 0 0\n1 1 1\n", ["1 2 3", "R, G and B"]),
    ("c.cube", "LUT_1D_SIZE 2\n0 0 0\n", ["1 row(s)", "2"]),
    ("c.cube", "0 0 0\n1 1 1\n", ["line 1", "LUT_1D_SIZE"]),
    ("c.csv", "0,0\n", ["1 row(s)", "2 to 65536"]),
    ("c.csv", "x,y\nz,w\n" + ROW, ["line 2", '"z" is not a number']),
    ("c.csv", "0,0\n0,1\n", ["line 2", "strictly rising"]),
    ("c.csv", "0,0\n2,1\n1,2\n", ["line 3", "1 behind 2"]),
    ("c.csv", "-1,0\n1,1\n", ["line 1", "-1", "tableinput"]),
    ("c.csv", "0,0,0\n1,1,1\n", ["line 1", "3 field(s)", "x,y or x,r,g,b"]),
    ("c.csv", "0,0\n1,1,1,1\n", ["line 2", "4 number(s)"]),
    ("c.csv", "0,0\n1,inf\n", ["line 2", "inf"]),
    ("c.csv", "0,0\n1,0x10\n", ["line 2", '"0x10" is not a number']),
    ("c.csv", "".join(f"{i},0.5\n" for i in range(65537)), ["line 65537", "65536"]),
    ("c.csv", "\ufeff".encode("utf-16") + "0,0\n1,1\n".encode("utf-16-le"), ["not text"]),
    ("c.clf", clf([0, 1]).replace("</LUT1D>", ""), ["OpenColorIO"]),
    ("c.clf", clf([0, 1]).replace("</LUT1D>", '</LUT1D><Range inBitDepth="32f" outBitDepth="32f">'
                                  "<minInValue>0</minInValue><minOutValue>0</minOutValue></Range>"),
     ["2 step(s)", "one table"]),
    ("c.clf", b"\x00" * 50, ["OpenColorIO"]),
    ("c.txt", "nothing that is known\n", ["is no curve", ".spi1d"]),
    ("c.txt", "a\nb\nI =\n0 1\nB =\n", ["5 line(s)", "name, type"]),
    ("c.txt", "a\nb\nI =\n0 1\nX =\n0 1\n", ["line 5", '"B ="']),
    ("c.txt", "a\nb\nI =\n0 1\nB =\n0 1 2\n", ["line 6", "3 values"]),
    ("c.txt", "a\nb\nI =\n0 0\nB =\n0 1\n", ["line 4", "strictly rising"]),
    ("c.txt", "E =\n0 1\n", ["f0"]),
    ("c.txt", "E =\n0 1\nf0 =\n0 1 2\n", ["3 values of f0"]),
]


@pytest.mark.parametrize("name,text,said", HOSTILE, ids=range(len(HOSTILE)))
def test_what_is_no_curve_is_refused_with_a_sentence(name, text, said, curve, tonetool):
    curve(name, text)
    for words in ((CORNELL, f"--tonemap:curve={name}", "-o", "out.png"),
                  (CORNELL, CORNELL_TEST, f"--hdrflip:curve={name}"),
                  (f"--exportlut:curve={name}", "out.cube"), (f"--tonecurves:curve={name}",)):
        ran = tonetool(*words, status=1)
        line = next(line for line in ran.err.splitlines() if "ERROR" in line)
        assert f'"{name}"' in line
        for word in said:
            assert word in line, (line, word)


@pytest.mark.parametrize("words,said", [
    ("nosuch.csv", ["there is no such file"]),
    ("dir.csv", ["is not a file"]),
    ("t.csv:bias=1", ["bias", "white"]),
    ("t.csv:white=0", ["white", "0.0001"]),
    ("t.csv:curvename=x", ["curvename"]),
    ("t.csv:coeffs=1,2", ["coeffs", "E ="]),
    ("t.csv:tableinput=ln", ["log2, log10"]),
    ("t.csv:tableoutput=density:tableinput=log10:white=nan", ["white"]),
    ("rgb.csv:on=luminance", ["on=luminance"]),
    ("far.csv:tableinput=log10", ["400", "2^120"]),
    ("dorf.txt", ["7 curves", "curvename=", "maker-100, maker-100Red"]),
    ("dorf.txt:curvename=maker-10", ["did you mean \"maker-100\"?"]),
    ("emor.txt:coeffs=1,2,3", ["1 base function", "3 numbers"]),
    ("aces:curvename=x", ["of curves from files"]),
    ("aces:tableinput=log2", ["of curves from files"]),
    ("hble", ["did you mean", "hable"]),
    ("film:dmin=3:dmax=2", ["dmax must exceed dmin"]),
    ("film:middle=1,2", ["3 numbers"]),
    ("film:middle=1,2,x", ["x"]),
    ("film:middle=.1,.2,.3:on=luminance", ["on=luminance"]),
])
def test_bad_words(words, said, curve, tonetool, tmp_path):
    (tmp_path / "dir.csv").mkdir()
    curve("t.csv", csv([0, 1], [0, 1]))
    curve("far.csv", csv([0, 400], [0, 1]))
    curve("rgb.csv", csv([0, 1], [[0, 0, 0], [1, 1, 0.9]]))
    curve("dorf.txt", CAMERAS)
    curve("emor.txt", model([0, 0.5, 1], [0, 0.5, 1], [[0, 1, 0]]))
    ran = tonetool(CORNELL, f"--tonemap:curve={words}", "-o", "out.png", status=1)
    for word in said:
        assert word in ran.err, ran.err


def test_a_comparison_needs_a_curve_that_rises_and_reaches_white(curve, tonetool):
    curve("dim.csv", csv([0, 1, 9], [0, 0.5, 0.8]))
    ran = tonetool(CORNELL, CORNELL_TEST, "--hdrflip:curve=dim.csv", status=1)
    assert "at most 0.8" in ran.err and "0.85" in ran.err and "startExposure" in ran.err
    tonetool(CORNELL, CORNELL_TEST, "--hdrflip:curve=dim.csv:startExposure=-2:stopExposure=1")
    curve("falls.csv", csv([0, 1, 2, 3], [0, 0.9, 0.7, 1]))
    ran = tonetool(CORNELL, CORNELL_TEST, "--hdrflip:curve=falls.csv", status=1)
    assert "falls at x = 1" in ran.err
    ran = tonetool(CORNELL, "--tonemap:curve=falls.csv", "-o", "out.png")
    assert ran.fact("table") == "4 rows of x 0 to 3, falling from x = 1"
    ran = tonetool(CORNELL, CORNELL_TEST, "--hdrflip:curve=dim.csv:tonemapper=aces", status=1)
    assert "curve=" in ran.err and "tonemapper=" in ran.err


def test_exposures_begin_where_the_mean_of_the_channels_is_bright(curve, tonetool_v):
    curve("t.csv", csv([0, 1, 3, 9], [[0, 0, 0], [0.6, 0.8, 1.0], [0.8, 0.9, 1.0], [1, 1, 1]]))
    ran = tonetool_v(CORNELL, CORNELL_TEST, "--hdrflip:curve=t.csv:maxluminance=4:medianluminance=0.5")
    x85 = 1 + (0.85 - 0.8) / (0.9 - 0.8) * 2
    assert ends_of(ran) == pytest.approx((np.log2(x85 / 4), np.log2(x85 / 0.5)), abs=1e-5)


def test_the_list_shows_a_file(curve, tonetool):
    curve("t.csv", csv([0, 1, 4], [0, 0.5, 1]))
    ran = tonetool("--tonecurves:curve=t.csv")
    assert "t.csv: a measured curve; on rgb" in ran.out
    assert "3 rows of x 0 to 4, rising" in ran.out
    ran = tonetool("--tonecurves:curve=t.csv:table=1")
    lines = ran.out.splitlines()
    assert lines[0] == "stops,t.csv" and "0,0.5" in lines and "2,1" in lines
    assert tonetool("--tonecurves:curve=hable").out.count("; on ") == 1


def test_the_picture_names_its_curve(curve, tonetool, read):
    curve("t.csv", csv([0, 1], [0, 1]))
    tonetool(CORNELL, "--tonemap:curve=./t.csv:white=2:encode=none", "-o", "out.exr")
    spec = read("out.exr")[1]
    assert spec.get_string_attribute("tonemap:curve") == "t.csv"
    assert spec.get_string_attribute("tonemap:parameters") == "white=2"


def test_recipes_find_curves_beside_themselves(curve, tonetool, tmp_path, read):
    (tmp_path / "sub").mkdir()
    curve("sub/t.csv", csv([0, 1, 16], [0, 0.5, 1]))
    curve("sub/aces", "no curve, though it has the name of one")
    for name, words in (("a", "curve=t.csv"), ("b", "curve=aces")):
        curve(f"sub/{name}.tone", f"tonetool 1\n{CORNELL}\n--tonemap:{words}:encode=none\n")
        tonetool(f"sub/{name}.tone", "-d", "float", "-o", f"{name}.exr")
    tonetool(CORNELL, "--tonemap:curve=sub/t.csv:encode=none", "-d", "float", "-o", "c.exr")
    tonetool(CORNELL, "--tonemap:curve=aces:encode=none", "-d", "float", "-o", "d.exr")
    assert np.array_equal(read("a.exr")[0][..., :3], read("c.exr")[0][..., :3])
    assert np.array_equal(read("b.exr")[0][..., :3], read("d.exr")[0][..., :3])


def test_a_film_has_the_values_of_its_formula(ramp):
    out = ramp("curve=film", [0.045, 0.18, 0.72, 2.88])[:, 0]
    assert np.abs(out / [0.00374, 0.0316, 0.268, 0.695] - 1).max() < 2e-3
    light = np.exp2(np.linspace(-10, 8, 300))
    middle, gamma, dmin, dmax = np.array([0.2, 0.18, 0.15]), 1.5, 0.1, np.array([2.8, 3, 3.2])
    density = (dmax - dmin) / (1 + np.exp(4 * gamma * np.log10(light[:, None] / middle) / (dmax - dmin)))
    out = ramp("curve=film:middle=.2,.18,.15:gamma=1.5:dmin=.1:dmax=2.8,3,3.2", light)
    assert np.abs(out - 10 ** -density).max() <= 2e-6


def test_a_film_is_a_table_of_densities(curve, ramp, tonetool):
    log_exposure = np.linspace(-4, 3, 2001)
    density = 3 / (1 + np.exp(2.4 * (log_exposure - np.log10(0.18))))
    curve("film.csv", csv(log_exposure, density))
    light = np.exp2(np.linspace(-8, 8, 200))
    words = "curve=film.csv:tableinput=log10:tableoutput=density"
    # The least density of the table, which counts as 0, is 3.7e-4: 8.6e-4 of light.
    assert np.abs(ramp(words, light) - ramp("curve=film", light)).max() <= 1e-3
    tonetool(CORNELL, CORNELL_TEST, "--hdrflip:curve=film:middle=.2,.18,.16")


# --exportlut


def spline(points):
    """The natural cubic spline through (input, output), at 0 to 255."""
    x, y = np.array(points, np.float64).T
    n = len(x)
    h = np.diff(x)
    a, b = np.eye(n), np.zeros(n)
    for i in range(1, n - 1):
        a[i, i - 1:i + 2] = h[i - 1], 2 * (h[i - 1] + h[i]), h[i]
        b[i] = 6 * ((y[i + 1] - y[i]) / h[i] - (y[i] - y[i - 1]) / h[i - 1])
    m = np.linalg.solve(a, b)
    at = np.arange(256)
    k = np.clip(np.searchsorted(x, at, "right") - 1, 0, n - 2)
    t, s = (at - x[k]) / h[k], (x[k + 1] - at) / h[k]
    out = s * y[k] + t * y[k + 1] + ((s ** 3 - s) * m[k] + (t ** 3 - t) * m[k + 1]) * h[k] ** 2 / 6
    return out.clip(0, 255)


def read_acv(path):
    data = path.read_bytes()
    words = struct.unpack(f">{len(data) // 2}H", data)
    assert words[:2] == (4, 5)
    curves, at = [], 2
    for _ in range(5):
        count = words[at]
        pairs = words[at + 1:at + 1 + 2 * count]
        curves.append([(pairs[2 * i + 1], pairs[2 * i]) for i in range(count)])
        at += 1 + 2 * count
    assert at == len(words)
    return curves


def drago(x, white=5, bias=0.85):
    x = np.minimum(x, white)
    return np.log1p(x) / (np.log10(1 + white) * np.log(2 + 8 * (x / white) ** (np.log(bias) / np.log(0.5))))


IDENTITY = [(0, 0), (255, 255)]


@pytest.mark.parametrize("white", [1, 5, 11.2])
@pytest.mark.parametrize("name,function", [
    ("hable", lambda x, w: hable(x)), ("aces", lambda x, w: aces(x)),
    ("reinhard-extended", lambda x, w: x * (1 + x / w ** 2) / (1 + x)), ("drago", drago)])
def test_curves_of_photoshop(name, function, white, tonetool, tmp_path):
    ran = tonetool(f"--exportlut:curve={name}:white={white}", "x.acv")
    composite, *others = read_acv(tmp_path / "x.acv")
    assert others == [IDENTITY] * 4 and 2 <= len(composite) <= 16
    assert composite[0][0] == 0 and composite[-1][0] == 255
    code = 255 * srgb(function(linear(np.arange(256) / 255) * white, white).clip(0, 1))
    off = np.abs(spline(composite) - code).max()
    assert off <= 1.5
    assert float(ran.fact("error max").split()[0]) == pytest.approx(off / 255, abs=1e-5)
    assert ("exact for greys only" in ran.err) == (name in ("drago", "reinhard-extended"))


def test_channels_of_photoshop_beside_an_even_composite(curve, tonetool, tmp_path):
    rows = np.stack([np.linspace(0, 1, 33) ** g for g in (0.8, 1, 1.3)], 1)
    curve("t.spi1d", spi1d(rows))
    tonetool("--exportlut:curve=t.spi1d", "x.acv")
    composite, *channels, last = read_acv(tmp_path / "x.acv")
    assert composite == last == IDENTITY
    light = linear(np.arange(256) / 255)
    for c, points in enumerate(channels):
        code = 255 * srgb(np.interp(light, np.linspace(0, 1, 33), rows[:, c]))
        assert np.abs(spline(points) - code).max() <= 1.5


@pytest.mark.parametrize("words,said", [("curve=agx", "mixes"), ("curve=aces:size=17", "shaper"),
                                        ("curve=aces:white=-1", "white"),
                                        ("curve=aces:saturation=2", "luminance")])
def test_what_photoshop_cannot_have(words, said, tonetool, tmp_path):
    assert said in tonetool(f"--exportlut:{words}", "x.acv", status=1).err
    assert not (tmp_path / "x.acv").exists()


def test_a_luminance_curve_is_written_by_its_greys(tonetool, tmp_path, ramp):
    ran = tonetool("--exportlut:curve=drago", "x.spi1d")
    assert "luminance curve: exact for greys only" in ran.err
    text = (tmp_path / "x.spi1d").read_text()
    assert "luminance curve: exact for greys only" in text and "Components 1" in text
    assert float(ran.fact("grey-error max")) < 1e-3
    # Read back, with the shaper that it wants before it.
    rows = np.array([float(v) for v in re.search(r"{(.*)}", text, re.S)[1].split()])
    light = np.exp2(np.linspace(-10, 2, 50))
    at = (np.log2(light + 2.0 ** -12) + 12) / (np.log2(2.0 ** 10 + 2.0 ** -12) + 12)
    expected = ramp("curve=drago", light, "srgb")[:, 0]
    assert np.abs(np.interp(at, np.linspace(0, 1, len(rows)), rows) - expected).max() < 1e-3
    assert "luminance" not in tonetool("--exportlut:curve=drago", "x.cube").err


@pytest.mark.parametrize("kind", ["cube", "spi1d", "clf", "ctf"])
def test_tables_are_written_as_tables(kind, curve, tonetool, tmp_path, oiiotool, ramp, read,
                                      make_image):
    rows = np.stack([np.linspace(0, 1, 65) ** g for g in (0.8, 1, 1.3)], 1)
    curve("t.csv", csv(np.linspace(0, 4, 65), rows))
    ran = tonetool("--exportlut:curve=t.csv", f"x.{kind}")
    assert "1D 4096" in ran.out and float(ran.fact("error max").split()[0]) < 2e-3


def test_a_written_table_is_a_curve_again(tonetool, tmp_path, ramp):
    tonetool("--exportlut:curve=hable:shaper=linear:encode=none:size=1025", "x.spi1d")
    tonetool("--exportlut:curve=hable:shaper=linear:encode=none:size=1025", "x.cube")
    light = np.linspace(0, 1, 500)
    for name in ("x.spi1d", "x.cube"):
        assert np.abs(ramp(f"curve={name}", light)[:, 0] - hable(light)).max() < 2e-5


# --calibrate:show=


@pytest.mark.parametrize("method", ["mean:key=0.3", "auto"])
@pytest.mark.parametrize("level", [0, 1, 3])
def test_the_exposure_that_is_shown_makes_the_picture(method, level, tonetool, read):
    words = f"--calibrate:method={method}:level={level}:stops=0.5"
    planes = {}
    for name in ("", "exposure", "mean", "key"):
        ran = tonetool(CORNELL, words + (f":show={name}" if name else ""), "-d", "float",
                       "-o", "out.exr")
        pixels, spec = read("out.exr")
        names = spec.channelnames
        layer = "" if "R" in names else "ViewLayer.Combined."
        planes[name] = pixels[..., [names.index(layer + c) for c in "RGB"]].astype(np.float64)
    source = read_color(CORNELL).astype(np.float64)
    product = source * planes["exposure"]
    assert (np.abs(product - planes[""]) <= 1e-6 * np.maximum(1, np.abs(product))).all()
    for name in ("exposure", "mean", "key"):
        assert np.ptp(planes[name], axis=2).max() == 0
        if level == 0 or (name == "key" and method != "auto"):
            assert np.ptp(planes[name]) == 0
        else:
            assert np.ptp(planes[name]) > 0
    gain = 2 ** 0.5 * planes["key"] / planes["mean"]
    assert np.abs(planes["exposure"] / gain - 1).max() <= 1e-5
    if level == 0:
        assert planes["mean"][0, 0, 0] == pytest.approx(float(ran.fact("mean")), rel=1e-5)
        assert planes["key"][0, 0, 0] == pytest.approx(float(ran.fact("key")), rel=1e-5)


def test_what_can_be_shown(tonetool, read):
    tonetool(CORNELL, "--calibrate:stops=3:show=exposure", "-d", "float", "-o", "out.exr")
    pixels, spec = read("out.exr")
    assert 8 in pixels[0, 0]
    ran = tonetool(CORNELL, "--calibrate:show=mean", "-o", "out.exr", status=1)
    assert "method mean or auto" in ran.err
    ran = tonetool(CORNELL, "--calibrate:method=mean:show=median", "-o", "out.exr", status=1)
    assert "mean, key, exposure" in ran.err


def test_golden_bytes_are_of_this_form(tmp_path):
    """The file that the design's own program wrote is read by this reader as it was meant."""
    shared = os.environ.get("SHARED_DIR", "")
    numbers = Path(shared) / "golden" / "shot" / "numbers.json"
    if not shared or not numbers.exists():
        pytest.skip("no goldens here")
    golden = bytes.fromhex(json.loads(numbers.read_text())["acv_of_square_root_hex"])
    (tmp_path / "golden.acv").write_bytes(golden)
    composite, *others = read_acv(tmp_path / "golden.acv")
    assert len(composite) == 16 and others == [IDENTITY] * 4
    assert np.abs(np.array([y for _, y in composite])
                  - 255 * (np.array([x for x, _ in composite]) / 255) ** 0.5).max() <= 0.5
