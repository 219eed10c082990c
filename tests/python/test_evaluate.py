# SPDX-License-Identifier: BSD-3-Clause
"""tonetool.evaluate: what flip-evaluator is called with, and what comes back."""

import json
import math
import pathlib
import warnings

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import TESTIMAGES, pixels_of, write

GOLDEN = [json.loads(line) for line in
          (TESTIMAGES / "golden" / "results.jsonl").read_text(encoding="utf-8").splitlines()]


def parameters_of(golden):
    words = golden["options"].replace("--ldr", "").split()
    keys = {"--tm": "tonemapper", "--cstart": "startExposure", "--cstop": "stopExposure",
            "--n": "numExposures", "--ppd": "ppd"}
    values = {keys[word]: value for word, value in zip(words[::2], words[1::2])}
    return {key: value if key == "tonemapper" else int(value) if key == "numExposures" else float(value)
            for key, value in values.items()}


@pytest.mark.parametrize("golden", GOLDEN, ids=lambda golden: golden["name"])
def test_published_program(golden):
    """The figures of NVIDIA's FLIP, whose maps testimages/golden has."""
    kind = "HDR" if golden["hdr"] else "LDR"
    pair = [TESTIMAGES / golden[name] for name in ("reference", "test")]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        found, mean, used = tonetool.evaluate(*pair, kind, applyMagma=False, parameters=parameters_of(golden))
    names = oiio.ImageBuf(str(TESTIMAGES / golden["map"])).spec().channelnames
    wanted = pixels_of(TESTIMAGES / golden["map"])[..., [names.index("flip")]]
    assert found.shape == wanted.shape and found.dtype == np.float32
    assert np.abs(found - wanted).max() < 1e-4
    assert mean == pytest.approx(golden["mean"], abs=2e-6)
    assert used["ppd"] == pytest.approx(golden["ppd"], rel=1e-6)
    if golden["hdr"]:
        assert used["tonemapper"] == golden["tonemapper"]
        for key in ("startExposure", "stopExposure", "numExposures"):
            assert used[key] == pytest.approx(golden[key], abs=1e-4)
    else:
        assert set(used) == {"ppd"}


@pytest.fixture
def other(noise):
    return noise * np.random.default_rng(8).uniform(0.8, 1, noise.shape).astype(np.float32)


def buf(array, name, tmp_path):
    write(tmp_path / name, array)
    return oiio.ImageBuf(str(tmp_path / name))


@pytest.mark.parametrize("parameters, keywords", [
    ({}, {}), ({"ppd": 40}, {"ppd": 40}),
    ({"vc": [0.5, 0.6, 1920]}, {"distance": 0.5, "width": 0.6, "pixels_across": 1920}),
    ({"tonemapper": "hable", "startExposure": -1, "stopExposure": 2.5, "numExposures": 3},
     {"curve": "hable", "start_exposure": -1, "stop_exposure": 2.5, "num_exposures": 3})])
def test_is_hdr_flip(noise, other, parameters, keywords):
    wanted = tonetool.hdr_flip(noise, other, **keywords)
    found, mean, used = tonetool.evaluate(noise, other, "HDR", applyMagma=False, parameters=parameters)
    assert found.shape == (24, 32, 1) and np.array_equal(found[..., 0], wanted.map)
    assert mean == wanted.summary.pool.mean > 0
    exposures = wanted.summary.exposures
    assert used == {"ppd": wanted.summary.ppd, "tonemapper": wanted.summary.tonemapper,
                    "startExposure": exposures[0], "stopExposure": exposures[-1],
                    "numExposures": len(exposures), **({"vc": parameters["vc"]} if "vc" in parameters else {})}
    again = tonetool.evaluate(noise, other, "HDR", applyMagma=False, parameters=used)
    assert np.array_equal(again[0], found) and again[1:] == (mean, used)


def test_is_ldr_flip(noise, other):
    encoded = tonetool.ldr_flip(noise, other, pixels={"from": "srgb"})
    linear = tonetool.ldr_flip(noise, other)
    for wanted, srgb in ((encoded, True), (linear, False)):
        found, mean, used = tonetool.evaluate(noise, other, "LDR", srgb, False)
        assert np.array_equal(found[..., 0], wanted.map)
        assert mean == wanted.summary.pool.mean and used == {"ppd": wanted.summary.ppd}
    assert encoded.summary.pool.mean != linear.summary.pool.mean
    assert tonetool.evaluate(noise, other, "LDR")[1] == encoded.summary.pool.mean


def test_vc_is_the_distance_and_the_screen(noise):
    used = tonetool.evaluate(noise, noise, "LDR", parameters={"vc": (1.0, 0.5, 1000)})[2]
    assert used["ppd"] == pytest.approx(1.0 * 1000 / 0.5 * math.pi / 180, rel=1e-9)
    assert tonetool.evaluate(noise, noise, "LDR")[2]["ppd"] == pytest.approx(67.0206, abs=1e-4)


def test_magma(noise, other):
    plain = tonetool.evaluate(noise, other, "HDR", applyMagma=False)[0]
    colors, mean, _ = tonetool.evaluate(noise, other, "HDR", computeMeanError=False)
    assert colors.shape == (24, 32, 3) and colors.dtype == np.float32 and mean == -1
    assert np.array_equal(colors, tonetool.color_map(plain, "magma"))


@pytest.mark.parametrize("kind", ["LDR", "HDR"])
def test_any_mix_of_images(kind, noise, other, tmp_path):
    """Files and ImageBufs of floats are linear, and so are arrays where that is said."""
    refs = [noise, noise.astype(np.float64), str(tmp_path / "r.exr"), tmp_path / "r.exr", buf(noise, "r.exr", tmp_path)]
    tests = [other, tmp_path / "t.exr", buf(other, "t.exr", tmp_path)]
    wanted = tonetool.evaluate(noise, other, kind, False)
    for ref in refs:
        for test in tests:
            found = tonetool.evaluate(ref, test, kind, False)
            assert isinstance(found[0], np.ndarray) and np.array_equal(found[0], wanted[0])
            assert found[1:] == wanted[1:]


@pytest.mark.parametrize("integer", [np.uint8, np.uint16])
@pytest.mark.parametrize("srgb", [True, False])
def test_integers_of_ldr(integer, srgb, noise, other, tmp_path):
    """A picture is the same as codes, as their share of white, as a file and as an ImageBuf."""
    white = np.iinfo(integer).max
    codes, others = ((image * white).astype(integer) for image in (noise, other))
    found = tonetool.evaluate(codes, others, "LDR", srgb, False)
    shares = [(image / np.float32(white)).astype(np.float32) for image in (codes, others)]
    assert np.abs(found[0] - tonetool.evaluate(*shares, "LDR", srgb, False)[0]).max() < 1e-5
    for name, image in (("r.png", codes), ("t.png", others)):
        tonetool.write_image(image, tmp_path / name)
    for files in ([tmp_path / "r.png", tmp_path / "t.png"],
                  [oiio.ImageBuf(str(tmp_path / name)) for name in ("r.png", "t.png")], [codes, tmp_path / "t.png"]):
        assert np.array_equal(tonetool.evaluate(*files, "LDR", srgb, False)[0], found[0])
    held = oiio.ImageBuf(str(tmp_path / "t.png"))
    held.read(force=True)
    assert np.array_equal(tonetool.evaluate(codes, held, "LDR", srgb, False)[0], found[0])
    assert held.spec().get_string_attribute("oiio:ColorSpace") in ("sRGB", "srgb_rec709_scene")


@pytest.mark.parametrize("srgb", [True, False])
def test_halves_of_ldr(srgb, noise, other, tmp_path):
    """Their bits, taken for floats, would be beyond 0 to 1."""
    halves = [np.clip(image, 0, 1).astype(np.float16) for image in (noise, other)]
    floats = [image.astype(np.float32) for image in halves]
    wanted = tonetool.evaluate(*floats, "LDR", srgb)
    assert np.array_equal(tonetool.evaluate(*halves, "LDR", srgb)[0], wanted[0])
    for value in (1.5, -0.3):
        with pytest.raises(ValueError, match="takes 0 to 1"):
            tonetool.evaluate(np.full((16, 16, 3), value, np.float16), np.zeros((16, 16, 3), np.float16), "LDR", srgb)
    held = [oiio.ImageBuf(oiio.ImageSpec(image.shape[1], image.shape[0], 3, oiio.HALF)) for image in halves]
    for image, values in zip(held, floats):
        image.set_pixels(image.roi, values)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tonetool.evaluate(*held, "LDR", srgb)


def test_srgb_and_linear_differ(noise, other, tmp_path):
    codes, others = ((image * 255).astype(np.uint8) for image in (noise, other))
    assert tonetool.evaluate(codes, others, "LDR", True)[1] != tonetool.evaluate(codes, others, "LDR", False)[1]


@pytest.mark.parametrize("key", ["pdd", "numexposures", "start", 3])
def test_unknown_parameters_list_the_valid(noise, key):
    with pytest.raises((ValueError, TypeError)) as raised:
        tonetool.evaluate(noise, noise, "HDR", parameters={key: 1})
    if key != 3:
        assert f'"{key}"' in str(raised.value)
        assert "ppd, vc, tonemapper, startExposure, stopExposure, numExposures" in str(raised.value)
    with pytest.raises(ValueError, match='of "LDR": unknown name "startExposure".*valid: ppd, vc$'):
        tonetool.evaluate(noise, noise, "LDR", parameters={"startExposure": 1})


@pytest.mark.parametrize("parameters, error, said", [
    ({"ppd": "60"}, TypeError, "evaluate: parameters: ppd is '60'"),
    ({"ppd": -1}, tonetool.Error, "ppd is -1"),
    ({"vc": [0.7, 0.7]}, ValueError, "vc has 2 numbers: must be three"),
    ({"vc": [0.7, 0, 3840]}, tonetool.Error, "width is 0"),
    ({"ppd": 30, "vc": [0.7, 0.7, 3840]}, ValueError, "ppd and vc"),
    ({"tonemapper": "acess"}, tonetool.Error, 'did you mean "aces"'),
    ({"numExposures": 2.5}, TypeError, "numExposures is 2.5"),
    ({"startExposure": 3.0, "stopExposure": 1.0}, tonetool.Error, "exposure"),
    ([("ppd", 3)], TypeError, "parameters is"),
])
def test_wrong_parameters(noise, parameters, error, said):
    with pytest.raises(error, match=said):
        tonetool.evaluate(noise, noise, "HDR", parameters=parameters)


@pytest.mark.parametrize("arguments, said", [
    (("hdr",), 'dynamicRangeString: unknown name "hdr".*LDR, HDR'), (("",), "dynamicRangeString"),
    (("LDR", 1), "inputsRGB is 1"), (("LDR", True, None), "applyMagma is None"),
    (("LDR", True, True, "no"), "computeMeanError"), ((), "dynamicRangeString is missing"),
    (("LDR", True, True, True, {}, 3), "takes 7"),
])
def test_wrong_arguments(noise, arguments, said):
    with pytest.raises((ValueError, TypeError), match=said):
        tonetool.evaluate(noise, noise, *arguments)


def test_odd_images_are_refused(noise, tmp_path):
    codes = (noise * 255).astype(np.uint8)
    tonetool.write_image(codes, tmp_path / "codes.png")
    for odd in (codes, tmp_path / "codes.png", oiio.ImageBuf(str(tmp_path / "codes.png"))):
        with pytest.raises(ValueError, match='evaluate: test holds integers.*"HDR" takes scene light'):
            tonetool.evaluate(noise, odd, "HDR")
    for odd in (noise * 3, noise - 0.5, noise * 255):
        with pytest.raises(ValueError, match='evaluate: test holds values from.*"LDR" takes 0 to 1'):
            tonetool.evaluate(noise, odd, "LDR")
    with pytest.raises(TypeError, match="int64"):
        tonetool.evaluate(noise, noise.astype(np.int64), "LDR")
    with pytest.raises(ValueError, match="moveaxis"):
        tonetool.evaluate(np.moveaxis(noise, -1, 0), noise, "LDR")
    with pytest.raises(tonetool.Error, match="32x24.*32x10"):
        tonetool.evaluate(noise, noise[:10], "HDR")
    with pytest.raises(tonetool.Error, match="none.exr"):
        tonetool.evaluate(tmp_path / "none.exr", noise, "HDR")
    with pytest.raises(tonetool.Error, match="finite"):
        tonetool.evaluate(np.full_like(noise, np.nan), noise, "HDR")
    with pytest.raises(TypeError, match="reference is None"):
        tonetool.evaluate(None, noise, "HDR")


@pytest.mark.parametrize("kind", ["LDR", "HDR"])
def test_nan_is_said(kind, noise):
    broken = noise.copy()
    broken[3, 4, 1] = np.nan
    for pair, of in (((broken, noise), "reference"), ((noise, broken), "test")):
        with pytest.warns(UserWarning, match=f"evaluate: .*{of}"):
            found = tonetool.evaluate(*pair, kind, applyMagma=False)[0]
        assert found[3, 4, 0] == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning):
            tonetool.evaluate(broken, noise, kind)
        tonetool.evaluate(noise, noise, kind)


def test_file_beyond_the_range_of_ldr_is_said(noise, tmp_path):
    bright = buf(noise * 3, "bright.exr", tmp_path)
    with pytest.warns(UserWarning, match='evaluate: test holds values from 0 to [0-9.]+, "LDR"'):
        found = tonetool.evaluate(noise, tmp_path / "bright.exr", "LDR", False, False)
    clipped = np.clip(pixels_of(bright), 0, 1)
    assert np.array_equal(found[0], tonetool.evaluate(noise, clipped, "LDR", False, False)[0])


def test_part_of_the_picture(noise, other, tmp_path):
    """Of a file of several parts the one with the picture, as the program finds it."""
    depth = tonetool.image(noise[..., 0], channels=["Z"])
    picture = tonetool.image(other, channels=["R", "G", "B"])
    tonetool.write_images([depth, picture], tmp_path / "parts.exr")
    found = tonetool.evaluate(noise, pathlib.Path(tmp_path / "parts.exr"), "HDR", applyMagma=False)
    assert np.array_equal(found[0], tonetool.evaluate(noise, other, "HDR", applyMagma=False)[0])


def test_negative_light_is_told():
    bright = np.random.default_rng(1).random((40, 60, 3), np.float32)
    dark = bright.copy()
    dark[:30] *= -1
    with pytest.warns(UserWarning, match="evaluate: test has 1800 pixels with negative values, which count as 0"):
        tonetool.evaluate(bright, dark, "HDR")
    with pytest.warns(UserWarning, match="evaluate: reference has 1800 pixels with negative values"):
        tonetool.evaluate(dark, bright, "HDR")


@pytest.mark.parametrize("name", ["x.exr", pathlib.Path("x.exr")])
def test_where_a_name_is_no_image_the_error_says_how_to_read_it(name):
    image = np.zeros((4, 4, 3), np.float32)
    with pytest.raises(TypeError, match=r"; tonetool\.image\(name\) is that of a file"):
        tonetool.hdr_flip(image, name)
    with pytest.raises(TypeError) as error:
        tonetool.hdr_flip(image, 3)
    assert "is that of a file" not in str(error.value)
