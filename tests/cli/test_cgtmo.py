# SPDX-License-Identifier: BSD-3-Clause
"""--cgtmo: laws of the operator, its guides, and what is refused."""

import subprocess
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

CORNELL = TESTIMAGES / "cornell_ref.exr"


def color(path):
    image = oiio.ImageBuf(str(path))
    assert not image.has_error, image.geterror()
    names = list(image.spec().channelnames)
    layer = "" if "R" in names else "ViewLayer.Combined."
    return image.get_pixels(oiio.FLOAT)[..., [names.index(layer + c) for c in "RGB"]]


def test_without_a_filter_it_is_global_drago(tonetool, tmp_path):
    tonetool(CORNELL, "--cgtmo:filter=none:encode=none:clamp=0", "-d", "float", "-o", "local.exr")
    tonetool(CORNELL, "--tonemap:curve=drago:method=mean:key=1:white=max:encode=none:clamp=0",
             "-d", "float", "-o", "global.exr")
    a, b = color(tmp_path / "local.exr"), color(tmp_path / "global.exr")
    assert np.abs(a - b).max() <= 1e-5 * b.max()


def test_a_constant_image_is_global_drago(tonetool, make_image, tmp_path):
    source = make_image("flat.exr", 50, 40, pixels=np.full((40, 50, 3), 0.3, np.float32))
    tonetool(source, "--cgtmo:encode=none:lmax=5", "-d", "float", "-o", "local.exr")
    tonetool(source, "--cgtmo:encode=none:lmax=5:filter=none", "-d", "float", "-o", "global.exr")
    assert np.abs(color(tmp_path / "local.exr") - color(tmp_path / "global.exr")).max() <= 1e-6


@pytest.mark.parametrize("bias", [0.7, 0.85, 0.95])
def test_the_brightest_becomes_white(tonetool, tmp_path, bias):
    tonetool(CORNELL, f"--cgtmo:filter=none:encode=none:clamp=0:bias={bias}:ldmax=80", "-d",
             "float", "-o", "out.exr")
    weights = np.array([0.2126, 0.7152, 0.0722])
    # The curve of a low bias is above its end before it gets there.
    brightest = np.argmax(color(CORNELL) @ weights)
    assert (color(tmp_path / "out.exr") @ weights).flat[brightest] == pytest.approx(0.8, abs=2e-6)


def test_the_guides_are_found_and_named(tonetool, tmp_path):
    ran = tonetool(CORNELL, "--cgtmo", "-o", "out.exr")
    assert ran.fact("position") == "ViewLayer.Position"
    assert ran.fact("normal") == "ViewLayer.Normal"
    assert ran.fact("albedo") == "ViewLayer.DiffCol"
    spec = oiio.ImageBuf(str(tmp_path / "out.exr")).spec()
    assert spec.get_string_attribute("tonemap:curve") == "cgtmo"
    assert spec.get_string_attribute("tonemap:normal") == "ViewLayer.Normal"


def test_the_picture_is_local_and_keeps_its_edges(tonetool, tmp_path):
    tonetool(CORNELL, "--cgtmo:encode=none", "-d", "float", "-o", "guided.exr")
    tonetool(CORNELL, "--cgtmo:encode=none:filter=none", "-d", "float", "-o", "none.exr")
    a, b = color(tmp_path / "guided.exr"), color(tmp_path / "none.exr")
    assert np.abs(a - b).mean() > 1e-3
    assert np.isfinite(a).all() and a.min() >= 0 and a.max() <= 1


@pytest.mark.parametrize("kind", ["guided", "bilateral", "wls"])
def test_nothing_depends_on_threads(tonetool, tmp_path, kind):
    for n in (1, 3):
        tonetool("--threads", n, CORNELL, f"--cgtmo:filter={kind}:encode=none", "-d", "float",
                 "-o", f"{n}.exr")
    assert np.array_equal(color(tmp_path / "1.exr"), color(tmp_path / "3.exr"))


def test_without_guides_luminance_tells_edges(tonetool, make_image):
    source = make_image("plain.exr", 40, 30)
    ran = tonetool(source, "--cgtmo:preset=paper", "-o", "out.exr")
    for name in ("position", "normal", "albedo"):
        assert f"no {name} among the layers" in ran.err
    assert "lumsigma=0.4" in ran.err
    ran = tonetool(source, "--cgtmo:strict=1", "-o", "strict.exr", status=1)
    assert "position" in ran.err
    tonetool(source, "--cgtmo:position=none:normal=none:albedo=none:strict=1", "-o", "out.exr")


@pytest.mark.parametrize("kind", ["guided", "bilateral", "wls", "none"])
def test_one_pixel_a_line_and_black(tonetool, make_image, kind):
    one = make_image("one.exr", 1, 1, pixels=np.full((1, 1, 3), 2, np.float32))
    tonetool(one, f"--cgtmo:filter={kind}", "-o", "out.exr")
    tonetool(make_image("line.exr", 1, 30), f"--cgtmo:filter={kind}", "-o", "out.exr")
    black = make_image("black.exr", 8, 8, pixels=np.zeros((8, 8, 3), np.float32))
    assert "black" in tonetool(black, f"--cgtmo:filter={kind}", "-o", "out.exr", status=1).err


def test_wls_without_smoothness_is_global_drago(tonetool, tmp_path):
    tonetool(CORNELL, "--cgtmo:filter=wls:wlslambda=0:encode=none", "-d", "float", "-o", "wls.exr")
    tonetool(CORNELL, "--cgtmo:filter=none:encode=none", "-d", "float", "-o", "none.exr")
    assert np.abs(color(tmp_path / "wls.exr") - color(tmp_path / "none.exr")).max() <= 2e-6


def dense_wls(light, domain, alpha, weight):
    """Minimum of sum (u - g)^2 + weight sum (du)^2 / (|d ln light|^alpha + 1e-4)."""
    logs, place = np.log(light), np.arange(light.size).reshape(light.shape)
    matrix = np.eye(light.size)
    for one, other in ((place[1:], place[:-1]), (place[:, 1:], place[:, :-1])):
        for i, j in zip(one.flat, other.flat):
            a = weight / (abs(logs.flat[i] - logs.flat[j]) ** alpha + 1e-4)
            matrix[[i, j, i, j], [i, j, j, i]] += [a, a, -a, -a]
    data = logs if domain == "log" else light
    base = np.linalg.solve(matrix, data.ravel()).reshape(light.shape)
    return np.exp(base) if domain == "log" else base


@pytest.mark.parametrize("modifiers,domain,alpha,weight", [
    ("", "log", 1.2, 0.125), (":preset=paper", "linear", 1.2, 0.125),
    (":domain=linear:wlsalpha=0.7:wlslambda=20", "linear", 0.7, 20),
    (":wlsalpha=2:wlslambda=3", "log", 2, 3)])
def test_wls_is_drago_on_the_dense_solution(tonetool, make_image, tmp_path, modifiers, domain,
                                            alpha, weight):
    source = make_image("in.exr", 17, 13)
    scene = color(tmp_path / source).astype(float)
    light = scene @ np.array([0.2126, 0.7152, 0.0722])
    ran = tonetool(source, f"--cgtmo:filter=wls:encode=none:clamp=0{modifiers}", "-d", "float",
                   "-o", "out.exr")
    assert ran.err == ""
    base = dense_wls(light, domain, alpha, weight)
    assert np.abs(base / light - 1).max() > 0.1
    maximum, adaptation = (float(ran.fact(name)) for name in ("maximum", "adaptation"))
    curve = np.log(1 + base / adaptation) / np.log10(1 + maximum / adaptation) / np.log(
        2 + 8 * (base / maximum) ** (np.log(0.85) / np.log(0.5)))
    expected = scene * (curve / base)[..., None]
    # Numbers are printed in six digits.
    assert np.abs(color(tmp_path / "out.exr") / expected - 1).max() <= 1e-5


@pytest.mark.parametrize("kind", ["guided", "bilateral", "wls", "none"])
@pytest.mark.parametrize("domain", ["log", "linear"])
def test_luminance_is_base_times_detail(tonetool, tmp_path, kind, domain):
    for part in ("base", "detail"):
        tonetool(CORNELL, f"--cgtmo:filter={kind}:domain={domain}:show={part}", "-d", "float", "-o",
                 f"{part}.exr")
    base, detail = color(tmp_path / "base.exr"), color(tmp_path / "detail.exr")
    assert (base == base[..., :1]).all() and (detail == detail[..., :1]).all()
    light = color(CORNELL) @ np.array([0.2126, 0.7152, 0.0722])
    assert np.abs(base * detail / light[..., None] - 1)[light > 0].max() <= 2e-6
    deviation = np.abs(detail - 1).max()
    assert deviation <= 2e-6 if kind == "none" else deviation > 0.1
    spec = oiio.ImageBuf(str(tmp_path / "base.exr")).spec()
    assert spec.get_string_attribute("tonemap:show") == "base"
    tonetool("detail.exr", "--cgtmo:filter=none:show=base:layer=ViewLayer.Combined", "-d", "float",
             "-o", "again.exr")
    assert np.abs(color(tmp_path / "again.exr") / detail - 1).max() <= 2e-6, "it is linear Rec.709"


def bytes_read(program, folder, *words):
    """By the system's account of a shell and the program it ran."""
    script = '"$@" > out.txt 2>&1 || exit 1; cat /proc/$$/io'
    done = subprocess.run(["bash", "-c", script, "bash", program, *map(str, words)], cwd=folder,
                          capture_output=True, text=True, check=True)
    return int(dict(line.split(": ") for line in done.stdout.splitlines())["rchar"])


@pytest.mark.skipif(not Path("/proc/self/io").exists(), reason="the system keeps no such account")
@pytest.mark.parametrize("options", ["", ":maximum=groups", ":preset=classic", ":filter=wls"])
def test_a_file_is_read_once(program, make_image, tmp_path, options):
    layers = ["", "light_key.", "light_rim.", "light_off.", "albedo."]
    names = [layer + c for layer in layers for c in "RGB"] + ["A", "Z"]
    names += [f"{layer}.{c}" for layer in ("P", "N") for c in "XYZ"]
    read, size = [], []
    for width in (30, 230):
        pixels = np.random.default_rng(1).random((200, width, len(names)))
        source = make_image(f"{width}.exr", width, 200, names, pixels=pixels)
        read.append(bytes_read(program, tmp_path, source, f"--cgtmo{options or ':strict=0'}", "-d",
                               "uint8", "-o", "out.png"))
        size.append((tmp_path / source).stat().st_size)
    assert size[1] > 3e6
    assert read[1] - read[0] <= 1.02 * (size[1] - size[0])


BAD = [
    ("preset=best", ["best", "default", "paper"]), ("domain=ln", ["ln", "log"]),
    ("filter=wsl", ["wsl", "guided"]), ("normaldist=angle", ["angle", "dot"]),
    ("footprint=auto", ["auto", "global"]), ("lwa=mode", ["mode", "geometric"]),
    ("lwa=0", ["lwa"]), ("lmax=0", ["lmax"]), ("bias=2", ["bias"]), ("sigma=0", ["sigma"]),
    ("samples=2", ["samples", "4"]), ("position=Pos", ["Pos", "Position"]),
    ("show=bases", ["bases", "base", "detail"]), ("filter=wls:wlsalpha=5", ["wlsalpha", "4"]), ("filter=wls:wlslambda=-1", ["wlslambda", "100"]),
    ("wlslambda=1", ["wlslambda", "filter=wls", "guided"]), ("encode=rec709", ["rec709", "srgb"]),
]


@pytest.mark.parametrize("modifiers,words", BAD)
def test_what_is_wrong_is_said(tonetool, tmp_path, modifiers, words):
    ran = tonetool(CORNELL, f"--cgtmo:{modifiers}", "-o", "out.exr", status=1)
    for word in words:
        assert word in ran.err, ran.err
    assert not (tmp_path / "out.exr").exists()
