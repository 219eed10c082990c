# SPDX-License-Identifier: BSD-3-Clause
"""One exposure for the frames of a shot, with statistics as objects and as a file."""

import numpy as np
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
