# SPDX-License-Identifier: BSD-3-Clause
"""tonetool.attribute(): whose error is it?"""

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import TESTIMAGES, files


def anim(frame):
    return [oiio.ImageBuf(str(TESTIMAGES / "anim" / f"{side}.{frame:04}.exr")) for side in ("ref", "test")]


def test_the_light_that_is_off():
    found = tonetool.attribute(*anim(5))
    assert [text.split(",")[0] for text in found.findings] == ["light neonC: off"]
    light = found.lights[0]
    assert (light.name, light.finding, light.gain, light.gain_error) == ("neonC", "off", 0, 0)
    assert light.explains == pytest.approx(1 - light.mean_replaced / found.mean)
    assert found.mean == pytest.approx(tonetool.hdr_flip(*anim(5)).summary.pool.mean, abs=1e-6)
    assert {one.name: one.gain for one in found.lights}["(rest)"] is None


def test_other_metrics_and_without_what_each_does_alone():
    found = tonetool.attribute(*anim(5), metric="smape", alone=False)
    assert found.mean == pytest.approx(tonetool.error_map(*anim(5), metric="smape").summary.value, abs=1e-6)
    assert all(light.mean_alone is None for light in found.lights) and found.lights[0].name == "neonC"


def test_an_honest_frame():
    assert tonetool.attribute(*anim(1)).findings == []


def test_arrays_have_no_layers():
    rng = np.random.default_rng(1)
    a, b = rng.random((2, 24, 32, 3), np.float32)
    found = tonetool.attribute(a, b)
    assert found.mean == pytest.approx(tonetool.hdr_flip(a, b).summary.pool.mean, abs=1e-6)
    assert found.lights == [] and found.mattes == [] and found.layers == []
    assert len(found.warnings) == 1 and found.warnings[0].endswith("so nothing can be told")


def test_what_is_refused():
    reference, test = (oiio.ImageBuf(str(path)) for path in files("cornell"))
    with pytest.raises(tonetool.Error, match="hdrflip"):
        tonetool.attribute(reference, test, metric="flip")
    with pytest.raises(tonetool.Error, match="resized have no ids"):
        tonetool.attribute(reference, test, size="resize")
