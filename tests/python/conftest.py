# SPDX-License-Identifier: BSD-3-Clause
"""Images, the program, and how results are compared: to the bit."""

import os
import subprocess
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

TESTIMAGES = Path(__file__).resolve().parents[2] / "testimages"


def pixels_of(image):
    """Float values, height x width x channels."""
    if isinstance(image, np.ndarray):
        return image if image.ndim == 3 else image[..., None]
    if not isinstance(image, oiio.ImageBuf):
        image = oiio.ImageBuf(str(image))
    assert not image.has_error, image.geterror()
    return image.get_pixels(oiio.FLOAT)


def same(one, other):
    a, b = pixels_of(one), pixels_of(other)
    return a.shape == b.shape and a.tobytes() == b.tobytes()


@pytest.fixture
def program(tmp_path):
    """Runs the program in tmp_path and returns what it printed."""

    def run(*words, status=0):
        done = subprocess.run([os.environ["TONETOOL"], *map(str, words)], cwd=tmp_path, text=True,
                              capture_output=True, timeout=120, check=False)
        assert done.returncode == status, (words, done.stdout, done.stderr)
        return done.stdout + done.stderr

    return run


def files(scene):
    return tuple(TESTIMAGES / f"{scene}_{name}.exr" for name in ("ref", "test"))


@pytest.fixture(params=["buf", "array"])
def pair(request, tmp_path):
    """A pair as ImageBufs of layered files, or as arrays of plain ones: files, then images."""
    if request.param == "buf":
        paths = files("cornell")
        return (*paths, *(oiio.ImageBuf(str(path)) for path in paths))
    paths, arrays = [], []
    for path in files("cornell"):
        image = oiio.ImageBuf(str(path))
        index = [image.spec().channelnames.index(f"ViewLayer.Combined.{c}") for c in "RGB"]
        arrays.append(np.ascontiguousarray(image.get_pixels(oiio.FLOAT)[..., index]))
        paths.append(tmp_path / path.name)
        write(paths[-1], arrays[-1])
    return (*paths, *arrays)


def write(path, array):
    height, width, channels = array.shape
    out = oiio.ImageOutput.create(str(path))
    assert out.open(str(path), oiio.ImageSpec(width, height, channels, "float"))
    assert out.write_image(array)
    out.close()


@pytest.fixture
def noise():
    """An array of height x width x 3."""
    return np.random.default_rng(7).random((24, 32, 3), np.float32)
