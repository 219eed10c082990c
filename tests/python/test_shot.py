# SPDX-License-Identifier: BSD-3-Clause
"""One exposure for the frames of a shot, with statistics as objects and as a file."""

import numpy as np
import OpenImageIO as oiio
import pytest

import tonetool


@pytest.fixture
def frames():
    y, x = np.mgrid[:36, :64]
    stripes = np.exp2(np.sin(x * 0.35) + 0.08 * y)[..., None] * np.array([1.0, 0.9, 0.7])
    return [(stripes * light).astype(np.float32) for light in (1, 2, 4)]


@pytest.fixture
def lights(frames):
    return [tonetool.frame_light(frame, frame=number) for number, frame in enumerate(frames, 1)]


def test_objects_and_files_expose_alike(frames, lights, tmp_path):
    assert [light.frame for light in lights] == [1, 2, 3]
    assert lights[2].lwa == pytest.approx(4 * lights[0].lwa, rel=1e-6)
    file = tmp_path / "shot.json"
    file.write_text(tonetool.shot_text(lights[::-1]))
    assert tonetool.read_shot(file).frames == lights, "in their order"
    for options in ({"statistics": lights}, str(file), {"adapt": str(file), "frame": 2}):
        for frame in frames:
            found = tonetool.cg_tmo(frame, adapt=options).summary
            assert found.adaptation == pytest.approx(lights[1].lwa, rel=1e-6)
            assert found.adaptation_from == found.maximum_from == "shot"
            assert found.adapted == "shot of frames 1 to 3"
    alone = tonetool.cg_tmo(frames[0]).summary
    assert alone.adapted == "" and alone.adaptation == lights[0].lwa


def test_calibration_by_a_shot(frames, lights):
    exposed = [tonetool.calibrate(frame, method="mean", adapt={"statistics": lights})
               for frame in frames]
    assert len({result.summary.exposure for result in exposed}) == 1
    assert exposed[0].summary.mean == pytest.approx(lights[1].lwa_geometric, rel=1e-6)
    white = {"method": "mean", "white_percentile": 100, "adapt": {"statistics": lights}}
    shown = tonetool.tonemap(frames[0], curve="reinhard-extended", calibration=white).summary
    factor = 2 ** shown.calibration.exposure
    assert shown.parameters["white"] == pytest.approx(lights[2].maximum * factor, rel=1e-6)


def test_exposures_over_time(lights):
    exposures = [tonetool.shot_exposure(lights, frame=number, mode="eye", tau=0.4)
                 for number in (1, 2, 3)]
    share = 1 - np.exp(-1 / 24 / 0.4)
    assert exposures[0].lwa == pytest.approx(lights[0].lwa)
    assert exposures[1].lwa == pytest.approx(lights[0].lwa * 2 ** share)
    assert exposures[1].notes == ["no header says framesPerSecond: 24 are assumed"]


def test_likeness(frames, lights):
    assert tonetool.shot_likeness(lights[0], lights[2]) == pytest.approx(1, abs=1e-5)
    other = tonetool.frame_light(np.ascontiguousarray(frames[0].transpose(1, 0, 2)))
    assert tonetool.shot_likeness(lights[0], other) < 0.6


@pytest.mark.parametrize("options, why", [
    ({"adapt": "nothing.json"}, 'no file "nothing.json"'),
    ({"adapt": "shot"}, 'no file "shot"'),
    ({"frame": 9}, "frame 9 is not in the statistics"),
    ({"mode": "eye"}, "which frame is the image"),
])
def test_errors(frames, lights, options, why):
    statistics = {} if "adapt" in options else {"statistics": lights}
    with pytest.raises(tonetool.Error, match=why):
        tonetool.cg_tmo(frames[0], adapt={**options, **statistics})


def test_a_frame_that_is_there_twice(frames, lights):
    other = tonetool.frame_light(frames[2], frame=1)
    assert tonetool.shot_text(lights + lights) == tonetool.shot_text(lights)
    with pytest.raises(tonetool.Error, match="frame 1 is there twice"):
        tonetool.shot_text([*lights, other])
    with pytest.raises(TypeError):
        tonetool.shot_text([1])


# ---- steady detail

GUIDES = [f"{layer}.{c}" for layer in ("P", "N") for c in "XYZ"]


@pytest.fixture
def walk(tmp_path):
    """Noisy images of two walls along which a camera goes, and their light."""
    images = {}
    y, x = np.mgrid[:36, :64]
    rays = np.stack([(x + .5) / 64 - .5, (y + .5 - 18) / 64, np.ones(x.shape)], -1)
    right = rays[..., :1] > .1
    depth = np.where(right, 3 / (1 + rays[..., :1]), 4)
    normal = np.where(right, [-np.sqrt(.5), 0, -np.sqrt(.5)], [0., 0, -1])
    for number in range(1, 8):
        position = rays * depth + [.01 * number, 0, 0]
        noise = .2 * np.random.default_rng(number).standard_normal((36, 64, 1))
        light = np.exp(np.sin(2 * position[..., :1]) + noise)
        pixels = np.concatenate([light * [.5, .4, .3], position, normal], 2)
        spec = oiio.ImageSpec(64, 36, 9, "float")
        spec.channelnames = ("R", "G", "B", *GUIDES)
        images[number] = oiio.ImageBuf(spec)
        images[number].set_pixels(spec.roi, np.ascontiguousarray(pixels, np.float32))
    lights = [tonetool.frame_light(image, frame=number) for number, image in images.items()]
    return images, lights


def test_steady_detail(walk):
    images, lights = walk
    adapt = {"statistics": lights, "frame": 2}
    assert tonetool.steady_window(lights, frame=2) == [1, 2, 3, 4, 5, 6]
    linear = {"encode": "none", "clamp": False, "adapt": adapt}
    still = tonetool.cg_tmo(images[2], **linear)
    assert still.summary.steady == []
    steady = tonetool.cg_tmo(images[2], steady=True, frames=images, **linear)
    assert steady.summary.steady == [1, 2, 3, 4, 5, 6]
    assert steady.summary.warnings == still.summary.warnings
    noise = [np.std(np.diff(np.log(result.image.get_pixels()[..., 0]))) for result in (still, steady)]
    assert noise[1] < .8 * noise[0]
    others = {number: images[number] for number in (1, 3, 4, 5, 6)}
    again = tonetool.cg_tmo(images[2], steady=True, frames=others, **linear)
    assert np.array_equal(again.image.get_pixels(), steady.image.get_pixels())
    part = tonetool.cg_tmo(images[2], steady=True, frames=images, roi=oiio.ROI(5, 40, 3, 30), **linear)
    assert np.array_equal(part.image.get_pixels(), steady.image.get_pixels()[3:30, 5:40])
    for wrong, why in (({"frames": others | {3: None}}, "frames"), ({"frames": 1}, "Mapping"),
                       ({"frames": {"a": images[1]}}, "frames")):
        with pytest.raises(TypeError, match=why):
            tonetool.cg_tmo(images[2], steady=True, **linear, **wrong)
    del others[5]
    with pytest.raises(tonetool.Error, match="needs frame 5, which is not given"):
        tonetool.cg_tmo(images[2], steady=True, frames=others, **linear)
    with pytest.raises(tonetool.Error, match="steady=1 is of the frames of a shot"):
        tonetool.cg_tmo(images[2], steady=True)


def test_camera(walk):
    images, lights = walk
    rows = np.eye(3, 4)
    rows[0, 3] = -.03
    assert np.allclose(tonetool.frame_camera(images[3]), rows.ravel() / np.linalg.norm(rows), atol=1e-5)
    assert tonetool.frame_camera(images[3], position="none") == [] == lights[0].camera
    with pytest.raises(tonetool.Error, match="nothing"):
        tonetool.frame_camera(images[3], position="nothing")
