# SPDX-License-Identifier: BSD-3-Clause
"""Look-up tables of curves and views: stock oiiotool, reading them, shows what tonetool computes."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

ROOT = Path(__file__).resolve().parents[2]
CONFIG = ROOT / "ocio" / "tonetool.ocio"
SCENE_LIGHT = ("clf", "ctf")
# Beyond the printed figures: their last digit, float results, other samples than those measured.
SLACK = 2e-6


def registry():
    done = subprocess.run([os.environ["TONETOOL"], "--tonecurves"], check=True,
                          capture_output=True, text=True)
    return dict(re.findall(r"^(\S+): .*; on (rgb|luminance|color)$", done.stdout, re.M))


def formats_of(domain):
    return ["cube", "spi1d" if domain == "rgb" else "spi3d", "clf", "ctf"]


def log2_shaper(x, low=-12, high=10):
    e = 2.0 ** low
    return (np.log2(np.maximum(x, 0) + e) - low) / (np.log2(2.0 ** high + e) - low)


def acescct_shaper(x):
    x = np.maximum(x, 0)
    return np.where(x > 0.0078125, (np.log2(np.maximum(x, 1e-9)) + 9.72) / 17.52,
                    10.5402377416545 * x + 0.0729055341958355)


def error_of(ran):
    found = re.search(r"^exportlut: error max (\S+) mean (\S+)$", ran.out, re.M)
    return float(found[1]), float(found[2])


@pytest.fixture(scope="module")
def pixels():
    """The beauty of a rendered image, and rows of greys and pure colours, linear Rec.709."""
    render = oiio.ImageBuf(str(ROOT / "testimages" / "cornell_ref.exr"))
    render = render.get_pixels(oiio.FLOAT)[..., :3]
    light = np.exp2(np.linspace(-12, 9.99, render.shape[1]))
    rows = [np.outer(light, [bool(k & 1), bool(k & 2), bool(k & 4)]) for k in range(1, 8)]
    return np.concatenate([render, rows]).astype(np.float32)


@pytest.fixture
def picture(make_image, pixels):
    """Writes linear.exr, and shaped.exr, which formats of one table take."""

    def make(shaper=log2_shaper, limit=1024):
        height, width = pixels.shape[:2]
        light = np.minimum(pixels, limit)
        make_image("linear.exr", width=width, height=height, pixels=light)
        make_image("shaped.exr", width=width, height=height,
                   pixels=shaper(light.astype(np.float64)))

    return make


@pytest.fixture
def difference(tonetool, oiiotool, read, tmp_path):
    """Differences of a table's picture, by stock oiiotool, to tonetool's own."""

    def measure(lut, tonemap):
        image = "linear.exr" if lut.endswith(SCENE_LIGHT) else "shaped.exr"
        # 2.4 wants a configuration, whichever, before it reads a table.
        done = oiiotool("--colorconfig", CONFIG, image, "--ociofiletransform", tmp_path / lut,
                        "-d", "float", "-o", "lut.exr")
        assert done.status == 0, done.err
        tonetool("--colorconfig", CONFIG, "linear.exr", tonemap, "-d", "float", "-o", "curve.exr")
        return np.abs(read("lut.exr")[0] - read("curve.exr")[0])

    return measure


@pytest.mark.parametrize("curve,domain", registry().items())
def test_reproduces_the_curve(curve, domain, tonetool, picture, difference):
    picture()
    for kind in formats_of(domain):
        ran = tonetool(f"--exportlut:curve={curve}", f"lut.{kind}")
        largest, mean = error_of(ran)
        off = difference(f"lut.{kind}", f"--tonemap:curve={curve}")
        assert off.max() <= largest * 1.001 + SLACK, (kind, off.max(), largest)
        assert mean <= largest <= (0.11 if "3D" in ran.out else 1e-3), kind


@pytest.mark.parametrize("curve", [c for c, domain in registry().items() if domain != "rgb"])
def test_larger_cubes_are_closer(curve, tonetool):
    means = [error_of(tonetool(f"--exportlut:curve={curve}:size={size}", "lut.cube"))[1]
             for size in (17, 33, 65)]
    assert means[0] > 1.5 * means[1] > 2 * means[2]


@pytest.mark.parametrize("encode", ["none", "gamma2.2", "rec1886", "gamma2.6"])
@pytest.mark.parametrize("curve,kind", [("aces", "clf"), ("aces", "spi1d"), ("agx", "clf"),
                                        ("neutral", "ctf")])
def test_encodings(encode, curve, kind, tonetool, picture, difference):
    picture()
    largest, _ = error_of(tonetool(f"--exportlut:curve={curve}:encode={encode}", f"lut.{kind}"))
    off = difference(f"lut.{kind}", f"--tonemap:curve={curve}:encode={encode}")
    if encode == "none":
        assert off.max() <= largest * 1.001 + SLACK
    else:  # infinitely steep at 0: pixels there are not the samples
        assert off.max() <= 1.02 * largest + SLACK


def test_parameters(tonetool, picture, difference):
    picture()
    words = "curve=uncharted2:white=4:toe=0.3"
    largest, _ = error_of(tonetool(f"--exportlut:{words}", "lut.clf"))
    assert difference("lut.clf", f"--tonemap:{words}").max() <= largest * 1.001 + SLACK
    words = "coeffs=0,1,0,0,1,1:on=luminance:saturation=0.5"
    ran = tonetool(f"--exportlut:{words}", "lut.ctf")
    assert "3D 33" in ran.out  # a power of the ratio is not in xyY
    assert difference("lut.ctf", f"--tonemap:{words}").max() <= error_of(ran)[0] * 1.05 + SLACK


@pytest.mark.parametrize("shaper,shape,limit", [("acescct", acescct_shaper, 222),
                                                ("linear", lambda x: x, 1)])
@pytest.mark.parametrize("kind", ["cube", "spi1d", "clf"])
def test_shapers(shaper, shape, limit, kind, tonetool, picture, difference):
    picture(shape, limit)
    largest, _ = error_of(tonetool(f"--exportlut:curve=hable:shaper={shaper}", f"lut.{kind}"))
    off = difference(f"lut.{kind}", "--tonemap:curve=hable")
    assert off.max() <= largest * 1.001 + SLACK


def test_range_of_log2(tonetool, picture, difference):
    picture(lambda x: log2_shaper(x, -8, 4), 16)
    ran = tonetool("--exportlut:curve=lottes:min=-8:max=4:size=512", "lut.cube")
    assert ran.fact("range") == "0 to 16"
    assert difference("lut.cube", "--tonemap:curve=lottes").max() <= error_of(ran)[0] + SLACK


def test_a_view(tonetool, picture, difference):
    picture()
    words = "display=sRGB:view='ACES SDR'"
    largest, _ = error_of(tonetool("--colorconfig", CONFIG, f"--exportlut:{words}:size=48",
                                   "lut.cube"))
    off = difference("lut.cube", f"--tonemap:{words}")
    # The view's own edges of the gamut are sharper than the cube's cells.
    assert off.max() <= largest * 1.1 + SLACK
    assert off.mean() < 0.01


def test_a_view_from_a_log_space(tonetool):
    ran = tonetool("--colorconfig", CONFIG,
                   "--exportlut:display=sRGB:view='ACES SDR':from=ACEScct:shaper=linear",
                   "lut.spi3d")
    assert ran.fact("input") == "ACEScct"


@pytest.mark.parametrize("kind", ["cube", "spi1d", "clf", "ctf"])
def test_files_say_what_they_expect(kind, tonetool, tmp_path):
    tonetool("--exportlut:curve=aces", f"lut.{kind}")
    text = (tmp_path / f"lut.{kind}").read_text()
    assert "tone curve aces" in text and "linear Rec.709" in text and "srgb" in text
    assert ("log2(x + 2^-12)" in text) == (kind not in SCENE_LIGHT)


def test_the_same_bytes_each_time(tonetool, tmp_path):
    tonetool("--exportlut:curve=agx", "a.cube")
    tonetool("--exportlut:curve=agx", "b.cube")
    assert (tmp_path / "a.cube").read_bytes() == (tmp_path / "b.cube").read_bytes()


BAD = [
    ("curve=aces", "lut.lut", "valid: .cube, .spi1d, .spi3d, .clf, .ctf"),
    ("curve=aces", "lut", "no extension"),
    ("curve=acse", "lut.cube", "aces"),
    ("curve=agx", "lut.spi1d", "valid: .cube, .spi3d, .clf, .ctf"),
    ("curve=aces", "lut.spi3d", "valid: .cube, .spi1d, .clf, .ctf"),
    ("curve=aces:size=1", "lut.cube", "2"),
    ("curve=aces:size=70000", "lut.cube", "65536"),
    ("curve=agx:size=200", "lut.cube", "2 to 129"),
    ("curve=aces:shaper=cineon", "lut.cube", "log2, acescct, linear"),
    ("curve=aces:shaper=acescct:min=-4", "lut.cube", "min and max"),
    ("curve=aces:encode=pq", "lut.cube", "srgb"),
    ("curve=aces:white=4", "lut.cube", "white"),
    ("curve=aces:from=acescg", "lut.cube", "from"),
    ("curve=aces:view=agx", "lut.cube", "view"),
    ("view=agx:encode=srgb", "lut.cube", "encode"),
    ("curve=aces", "nowhere/lut.cube", "nowhere"),
]


@pytest.mark.parametrize("words,name,said", BAD)
def test_bad_input(words, name, said, tonetool, tmp_path):
    ran = tonetool(f"--exportlut:{words}", name, status=1)
    assert said in ran.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("words,said", [("view=nosuch", "agx"), ("display=nosuch", "sRGB"),
                                        ("view=agx:looks=nosuch", "nosuch"),
                                        ("view=agx:from=nosuch", "ACEScg")])
def test_bad_views(words, said, tonetool):
    ran = tonetool("--colorconfig", CONFIG, f"--exportlut:{words}", "lut.cube", status=1)
    assert "nosuch" in ran.err and said in ran.err


def test_a_failure_leaves_the_old_file(tonetool, tmp_path):
    (tmp_path / "lut.spi1d").write_text("old")
    tonetool("--exportlut:curve=agx", "lut.spi1d", status=1)
    assert (tmp_path / "lut.spi1d").read_text() == "old"
    tonetool("--exportlut:curve=aces", "lut.spi1d")
    assert (tmp_path / "lut.spi1d").read_text().startswith("Version 1\n")
    assert [f.name for f in tmp_path.iterdir()] == ["lut.spi1d"]


def test_a_folder_that_cannot_be_written(tonetool, tmp_path):
    folder = tmp_path / "closed"
    folder.mkdir()
    if os.geteuid() == 0:
        pytest.skip("root may write anywhere")
    folder.chmod(0o500)
    ran = tonetool("--exportlut:curve=aces", "closed/lut.cube", status=1)
    assert "closed" in ran.err and list(folder.iterdir()) == []
