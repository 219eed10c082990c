# SPDX-License-Identifier: BSD-3-Clause
"""What all tests of the program share: how it is called, and images to call it with."""

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from prestart import run_text

TESTIMAGES = Path(__file__).resolve().parents[2] / "testimages"


class Ran:
    """What one call of a program did."""

    def __init__(self, done):
        self.status = done.returncode
        self.out = done.stdout
        self.err = done.stderr

    def fact(self, name):
        """The value of the line "command: name value"."""
        values = [line.split(": ", 1)[1][len(name) + 1:] for line in self.out.splitlines()
                  if ": " in line and line.split(": ", 1)[1].startswith(name + " ")]
        assert len(values) == 1, (name, values, self.out)
        return values[0]


def for_hosts(environment):
    """The environment of stock programs that load the plugin. One that was built with a sanitizer
    needs the sanitizer's library first; what the host never frees is not ours to report."""
    runtime = os.environ.get("SANITIZER_RUNTIME")
    if not runtime:
        return environment
    options = environment.get("ASAN_OPTIONS", "")
    return {**environment, "LD_PRELOAD": runtime,
            "ASAN_OPTIONS": f"{options}:detect_leaks=0".lstrip(":")}


def call(program, words, cwd, timeout=120, **options):
    """Runs the program. A sanitizer makes it slower: `timeout` is the limit without one."""
    if os.environ.get("SANITIZER_RUNTIME"):
        timeout *= 5
    if not options:
        return Ran(run_text(program, words, cwd, timeout))
    options.setdefault("stdout", subprocess.PIPE)
    done = subprocess.run([program, *map(str, words)], cwd=cwd, stderr=subprocess.PIPE,
                          text=True, check=False, timeout=timeout, **options)
    return Ran(done)


@pytest.fixture
def plain_memory():
    """For tests that measure memory: a sanitizer takes several times as much for itself."""
    if os.environ.get("SANITIZER_RUNTIME"):
        pytest.skip("built with a sanitizer, which has a memory of its own")


@pytest.fixture
def program():
    return os.environ["TONETOOL"]


@pytest.fixture
def tonetool(program, tmp_path):
    """Runs the program in tmp_path; status= is asserted."""

    def run(*words, status=0, **options):
        ran = call(program, words, tmp_path, **options)
        assert ran.status == status, (words, ran.status, ran.out, ran.err)
        return ran

    return run


@pytest.fixture
def tonetool_v(tonetool):
    """As tonetool; comparisons print every fact, one a line, for Ran.fact()."""

    def run(*words, **options):
        return tonetool(*words, "-v", **options)

    return run


@pytest.fixture
def oiiotool(tmp_path):
    path = shutil.which("oiiotool", path="/usr/bin")
    if not path:
        pytest.skip("no oiiotool here")

    def run(*words):
        return call(path, words, tmp_path)

    return run


@pytest.fixture
def make_image(tmp_path):
    """Writes an image of random values, or of `pixels`, and returns its name."""

    def make(name, width=16, height=12, channels=("R", "G", "B"), kind="float", pixels=None,
             seed=1, attributes=None, window=None):
        if pixels is None:
            pixels = np.random.default_rng(seed).random((height, width, len(channels)))
        spec = oiio.ImageSpec(width, height, len(channels), kind)
        spec.channelnames = tuple(channels)
        if window:
            spec.x, spec.y, spec.full_x, spec.full_y, spec.full_width, spec.full_height = window
        for key, value in (attributes or {}).items():
            spec.attribute(key, value)
        out = oiio.ImageOutput.create(str(tmp_path / name))
        assert out and out.open(str(tmp_path / name), spec), oiio.geterror()
        assert out.write_image(np.ascontiguousarray(pixels, dtype=np.float32))
        out.close()
        return name

    return make


@pytest.fixture
def make_parts(tmp_path):
    """Writes an EXR of two subimages, the first all `first`, the second all `second`."""

    def make(name, first, second):
        specs = []
        for part in ("one", "two"):
            spec = oiio.ImageSpec(16, 12, 3, "float")
            spec.attribute("oiio:subimagename", part)
            specs.append(spec)
        out = oiio.ImageOutput.create(str(tmp_path / name))
        assert out.open(str(tmp_path / name), tuple(specs))
        out.write_image(np.full((12, 16, 3), first, np.float32))
        assert out.open(str(tmp_path / name), specs[1], "AppendSubimage")
        out.write_image(np.full((12, 16, 3), second, np.float32))
        out.close()
        return name

    return make


@pytest.fixture
def read(tmp_path):
    """Pixels (float) and spec of an image that a test has made."""

    def read_image(name, subimage=0):
        source = oiio.ImageInput.open(str(tmp_path / name))
        assert source, oiio.geterror()
        assert source.seek_subimage(subimage, 0)
        return source.read_image("float"), source.spec()

    return read_image


@pytest.fixture
def pair():
    """Reference and test of a rendered pair."""
    return TESTIMAGES / "cornell_ref.exr", TESTIMAGES / "cornell_test.exr"


@pytest.fixture
def testimages():
    return TESTIMAGES
