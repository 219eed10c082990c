# SPDX-License-Identifier: BSD-3-Clause
"""What the module computes is what the program computes, to the bit, and in the type it was given."""

import re

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import TESTIMAGES, files, pixels_of, same


def fact(text, name):
    (value,) = re.findall(rf"^\w+: {re.escape(name)} (.*)$", text, re.M)
    return value


def test_hdr_flip(pair, program, tmp_path):
    ref_file, test_file, ref, test = pair
    text = program(ref_file, test_file, "--hdrflip:exposuremap=stops", "-o", "map.exr", "--pop", "-o",
                   "stops.exr", "-v")
    found = tonetool.hdr_flip(ref, test, want_exposure_map=True)
    assert same(found.map, tmp_path / "map.exr")
    assert same(found.exposure_stops, tmp_path / "stops.exr")
    assert type(found.map) is type(ref)
    assert f"{found.summary.pool.mean:.6g}" == fact(text, "mean")
    assert len(found.summary.exposures) == int(fact(text, "exposures").split()[-1])


def test_hdr_flip_options(pair, program, tmp_path):
    ref_file, test_file, ref, test = pair
    program(ref_file, test_file,
            "--hdrflip:tonemapper=hable:ppd=40:startExposure=-2:stopExposure=3:numExposures=4",
            "-o", "map.exr")
    found = tonetool.hdr_flip(ref, test, curve="hable", ppd=40, start_exposure=-2, stop_exposure=3,
                              num_exposures=4, nthreads=1)
    assert same(found.map, tmp_path / "map.exr")
    assert found.summary.exposures == pytest.approx([-2, -1 / 3, 4 / 3, 3])


def test_hdr_flip_of_several(pair):
    _, _, ref, test = pair
    several = tonetool.hdr_flip(ref, [test, ref])
    assert same(several[0].map, tonetool.hdr_flip(ref, test).map)
    assert several[1].summary.pool.max == 0


def test_exposures(pair):
    _, _, ref, test = pair
    found = tonetool.hdr_flip(ref, test, want_exposures=True)
    assert [one.stops for one in found.exposures] == found.summary.exposures
    largest = np.max([pixels_of(one.flip) for one in found.exposures], axis=0)
    assert largest.tobytes() == pixels_of(found.map).tobytes()
    assert pixels_of(found.exposures[0].reference).shape[2] == 3


def test_ldr_flip(pair, program, tmp_path):
    ref_file, test_file, ref, test = pair
    program(ref_file, test_file, "--ldrflip", "-o", "map.exr")
    found = tonetool.ldr_flip(ref, test)
    assert same(found.map, tmp_path / "map.exr") and not found.summary.hdr


def test_tonemap(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    program(ref_file, "--tonemap:curve=agx:stops=1.5", "-d", "float", "-o", "picture.exr")
    found = tonetool.tonemap(ref, curve={"name": "agx"}, calibration={"stops": 1.5})
    assert same(found.image, tmp_path / "picture.exr")
    assert type(found.image) is type(ref) and found.summary.curve == "agx"


@pytest.mark.parametrize("extension", ["png", "tif"])
def test_tonemap_of_integers_with_alpha(extension, program, tmp_path):
    file = str(tmp_path / f"straight.{extension}")
    pixels = np.random.default_rng(8).random((12, 16, 4), np.float32)
    pixels[..., 3] = 0.5 + pixels[..., 3] / 2
    pixels[..., :3] *= pixels[..., 3:]
    out = oiio.ImageOutput.create(file)
    assert out.open(file, oiio.ImageSpec(16, 12, 4, "uint16"))
    assert out.write_image(pixels)
    out.close()
    command = "--tonemap:curve=linear:encode=none"
    program(file, command, "-d", "float", "-o", "light.exr")
    found = tonetool.tonemap(oiio.ImageBuf(file), curve="linear", encode="none")
    assert same(found.image, tmp_path / "light.exr")


def test_tonemap_measured(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    program(ref_file, "--tonemap:curve=drago:method=mean:key=1:white=max:encode=none:clamp=0", "-d",
            "float", "-o", "picture.exr")
    found = tonetool.tonemap(ref, curve="drago", encode="none", clamp=False,
                             calibration={"method": "mean", "key": 1, "white_percentile": 100})
    assert same(found.image, tmp_path / "picture.exr")
    assert found.summary.calibration.white > 0


def test_view(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    config = TESTIMAGES.parent / "ocio" / "tonetool.ocio"
    program("--colorconfig", config, ref_file, "--tonemap:display=sRGB:view=ACES SDR", "-d", "float",
            "-o", "picture.exr")
    found = tonetool.tonemap(ref, view={"config": config, "display": "sRGB", "view": "ACES SDR"})
    assert same(found.image, tmp_path / "picture.exr")


def test_calibrate(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    program(ref_file, "--calibrate:method=auto:level=1", "-d", "float", "-o", "picture.exr")
    found = tonetool.calibrate(ref, method="auto", level=1)
    assert same(found.image, tmp_path / "picture.exr") and found.summary.key > 0


def test_camera(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    camera = {"method": "camera", "fnumber": 2.8, "shutter": 0.02, "iso": 400}
    words = ":".join(f"{name}={value}" for name, value in camera.items())
    program(ref_file, f"--calibrate:{words}:unit=50", "-d", "float", "-o", "picture.exr")
    found = tonetool.calibrate(ref, **camera, adapt={"unit": 50})
    assert same(found.image, tmp_path / "picture.exr")
    assert found.summary.ev100 == pytest.approx(np.log2(100 * 2.8 ** 2 / (400 * 0.02)))
    assert found.summary.unit == 50 and tonetool.calibrate(ref).summary.ev100 is None
    local = tonetool.cg_tmo(ref, **camera, adapt={"unit": 50}).summary
    assert local.adaptation_from == "camera" and local.ev100 == found.summary.ev100


def test_bloom(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    program(ref_file, "--bloom:threshold=2s:amount=0.5:vision=mesopic:fov=50", "-d", "float", "-o",
            "picture.exr")
    found = tonetool.bloom(ref, threshold="2s", amount=0.5, vision="mesopic", fov=50, nthreads=2)
    assert same(found.image, tmp_path / "picture.exr")
    assert found.summary.threshold == pytest.approx(4 * found.summary.lwa)
    assert 0 < found.summary.kept < 1 and found.summary.spreading > 0


def test_exposure(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    program(ref_file, "--exposure", "-1.25", "-d", "float", "-o", "picture.exr")
    assert same(tonetool.exposure(ref, -1.25), tmp_path / "picture.exr")


def test_cg_tmo(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    program(ref_file, "--cgtmo:sigma=4:samples=40", "-d", "float", "-o", "picture.exr")
    found = tonetool.cg_tmo(ref, sigma=4, samples=40)
    assert same(found.image, tmp_path / "picture.exr")


def test_cg_tmo_with_guides_of_an_array(program, tmp_path):
    ref_file, _ = files("cornell")
    image = oiio.ImageBuf(str(ref_file))
    names = image.spec().channelnames
    named = tonetool.image(image.get_pixels(oiio.FLOAT), channels=names)
    program(ref_file, "--cgtmo", "-d", "float", "-o", "picture.exr")
    found = tonetool.cg_tmo(named)
    assert found.summary.position and found.summary.normal and found.summary.albedo
    assert same(found.image, tmp_path / "picture.exr")


@pytest.mark.parametrize("metric", tonetool.error_metrics())
def test_error_map(pair, metric, program, tmp_path):
    ref_file, test_file, ref, test = pair
    program(ref_file, test_file, f"--errormap:metric={metric}", "-o", "map.exr")
    found = tonetool.error_map(ref, test, metric=metric)
    assert same(found.map, tmp_path / "map.exr")
    assert found.summary.decibels == (metric in ("psnr", "mpsnr"))


def test_tmqi(pair, program, tmp_path):
    ref_file, _, ref, _ = pair
    picture = tonetool.tonemap(ref).image
    tonetool.write_image(picture, tmp_path / "picture.exr")
    # An EXR file does not keep the mark of sRGB.
    text = program(ref_file, "picture.exr", "--tmqi:ldrfrom=srgb", "-o", "map.exr", "-v")
    found = tonetool.tmqi(ref, picture, ldr_pixels={"from": "srgb"})
    assert same(found.map, tmp_path / "map.exr")
    assert f"{tonetool.tmqi_quantity(found.summary.score, 'Q'):.6g}" == fact(text, "Q")


def test_light_index(program, tmp_path):
    ref_file, _ = files("gallery")
    program(ref_file, "--lightindex", "-o", "index.exr")
    found = tonetool.light_index(oiio.ImageBuf(str(ref_file)))
    assert same(found.map, tmp_path / "index.exr") and len(found.summary.groups) > 1


def test_panorama_and_luminance(program):
    panorama = tonetool.panorama_stats(oiio.ImageBuf(str(TESTIMAGES / "gallery_pano.exr")))
    assert 0 < panorama.harmonic <= panorama.geometric <= panorama.mean <= panorama.max
    ref_file, _ = files("cornell")
    text = program(ref_file, "--luminancestats")
    found = tonetool.luminance_stats(oiio.ImageBuf(str(ref_file)))
    assert f"{found.median:.6g}" == fact(text, "median")


def test_color_map(program, tmp_path, noise):
    tonetool.write_image(noise, tmp_path / "noise.exr")
    program("noise.exr", "--ch", "R", "--colormap", "magma", "-d", "float", "-o", "colors.exr")
    assert same(tonetool.color_map(noise[..., 0], "magma"), tmp_path / "colors.exr")
    ramp = tonetool.color_map(noise[..., 0], [0, 0, 0, 1, 1, 1])
    assert ramp.shape == noise.shape


def test_export_lut(program, tmp_path):
    text = program("--exportlut:curve=neutral:size=17", "ours.cube")
    found = tonetool.export_lut(tmp_path / "theirs.cube", curve="neutral", size=17)
    assert (tmp_path / "ours.cube").read_bytes() == (tmp_path / "theirs.cube").read_bytes()
    assert f"{found.max_error:.6g}" in text and found.structure == "3D 17"


def test_filmstrip(pair, program, tmp_path):
    ref_file, test_file, ref, test = pair
    program(ref_file, test_file, "--filmstrip:width=64:columns=3", "-d", "float", "-o", "strip.exr")
    found = tonetool.flip_filmstrip(ref, test, thumb_width=64, max_columns=3)
    assert same(found.image, tmp_path / "strip.exr")


def test_registry():
    names = tonetool.tone_curve_names()
    assert [curve.name for curve in tonetool.tone_curves()] == names
    light = tonetool.tone_curve_response([0, 0.18, 1], name="reinhard")
    assert light.dtype == np.float64 and light == pytest.approx([0, 0.18 / 1.18, 0.5], rel=1e-6)


def test_threads_and_regions_change_no_bit(pair):
    _, _, ref, test = pair
    whole = pixels_of(tonetool.hdr_flip(ref, test, nthreads=1).map)
    part = tonetool.hdr_flip(ref, test, roi=oiio.ROI(8, 40, 4, 20), nthreads=2).map
    assert pixels_of(part)[-16:, -32:].tobytes() == whole[4:20, 8:40].tobytes()
