# SPDX-License-Identifier: BSD-3-Clause
"""--memory: what it takes, what it bounds, and that it changes nothing else."""

import subprocess
import sys

import numpy as np
import OpenImageIO as oiio
import pytest


@pytest.mark.parametrize("size", ["256M", "1G", "300000K", "268435456"])
def test_sizes(tonetool, pair, size):
    tonetool("--memory", size, *pair, "--hdrflip")


@pytest.mark.parametrize("size", ["", "0", "0M", "M", "-1M", "1.5G", "256 M", "256MB", "256m", "1T",
                                  "0x10", "99999999999G", "99999999999999999999"])
def test_bad_sizes(tonetool, pair, size):
    ran = tonetool("--memory", size, *pair, "--hdrflip", status=1)
    assert f'memory : SIZE "{size}": not a size; valid: ' in ran.err and "256M" in ran.err


def test_too_small(tonetool, pair):
    ran = tonetool("--memory", "1M", *pair, "--hdrflip:fail=0.999", "-o", "x.exr", status=1)
    assert "memory is 1M: this comparison needs at least 1" in ran.err
    assert "PASS" not in ran.out


def test_help_says_what_it_is(tonetool):
    assert "--memory SIZE" in tonetool("--help").out
    assert "half of" in tonetool("--help", "memory").out


def write_pair(folder, width, height, kind="float", channels=("R", "G", "B")):
    """Two EXR files, in rows; every channel of the test is a little off."""
    random = np.random.default_rng(5)
    names = []
    block = np.exp2(random.random((64, width, len(channels)), dtype=np.float32) * 8 - 4)
    for name, amount in (("r.exr", 0), ("t.exr", 0.4)):
        spec = oiio.ImageSpec(width, height, len(channels), kind)
        spec.channelnames = tuple(channels)
        spec.attribute("compression", "zips")
        out = oiio.ImageOutput.create(str(folder / name))
        assert out.open(str(folder / name), spec)
        factor = 1 + np.float32(amount) * (random.random(block.shape, dtype=np.float32) - 0.5)
        for y in range(0, height, 64):
            rows = (block * factor * np.float32(1 + y / height))[:min(64, height - y)]
            assert out.write_scanlines(y, y + len(rows), 0, np.ascontiguousarray(rows))
        out.close()
        names.append(folder / name)
    return names


def peak(program, words, cwd):
    """Peak resident bytes of one call."""
    code = ("import resource, subprocess, sys\n"
            "done = subprocess.run(sys.argv[1:], stdout=sys.stderr)\n"
            "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, done.returncode)")
    done = subprocess.run([sys.executable, "-c", code, program, *map(str, words)], cwd=cwd,
                          capture_output=True, text=True, check=True, timeout=120)
    kilobytes, status = map(int, done.stdout.split())
    assert status == 0, done.stderr
    return kilobytes * 1024


def same_pixels(a, b):
    return np.array_equal(oiio.ImageBuf(str(a)).get_pixels(oiio.FLOAT),
                          oiio.ImageBuf(str(b)).get_pixels(oiio.FLOAT))


FAST = "--hdrflip:numExposures=2"


def test_same_output(tonetool, tmp_path):
    files = write_pair(tmp_path, 2500, 700)
    command = ["--hdrflip:numExposures=2:exposuremap=index:fail=0.05:warn=0.01", "-o", "map.exr",
               "--pop", "-o", "index.exr"]
    plain = tonetool(*files, *command, status=3)
    for name in ("map.exr", "index.exr"):
        (tmp_path / name).rename(tmp_path / ("plain_" + name))
    least = tonetool("--memory", "1M", *files, *command, status=1).err.split("at least ")[1]
    bound = tonetool("--memory", least.split()[0], *files, *command, status=3)
    assert (plain.out, plain.err) == (bound.out, bound.err)
    for name in ("map.exr", "index.exr"):
        assert same_pixels(tmp_path / name, tmp_path / ("plain_" + name))


@pytest.mark.usefixtures("plain_memory")
def test_peak_memory(program, tmp_path):
    """Beyond what a small pair takes, a large one takes its map and little more."""
    folder = tmp_path / "small"
    folder.mkdir()
    base = peak(program, [*write_pair(folder, 32, 32), FAST, "-o", "map.exr"], folder)
    width, height = 4096, 2160
    files = write_pair(tmp_path, width, height)
    whole = peak(program, [*files, FAST, "-o", "whole.exr"], tmp_path)
    bound = peak(program, ["--memory", "168M", *files, FAST, "-o", "bound.exr"], tmp_path)
    assert same_pixels(tmp_path / "whole.exr", tmp_path / "bound.exr")
    pixels = width * height
    assert whole - base > 26 * pixels, "two images of 13 bytes a pixel"
    # 168M less 105M set aside; the allocator and the decoder may keep 12 MB more.
    assert bound - base < ((168 - 105) << 20) + 12e6


@pytest.mark.usefixtures("plain_memory")
def test_only_the_compared_channels_are_kept(program, tmp_path):
    names = [f"aov{i:02}.{c}" for i in range(40) for c in "RGB"]
    files = write_pair(tmp_path, 800, 600, "half", ["R", "G", "B", *names])
    taken = peak(program, [*files, FAST, "-o", "map.exr"], tmp_path)
    everything = 2 * 123 * 4 * 800 * 600
    assert taken < everything / 2


def test_a_file_written_twice_is_read_anew(tonetool, make_image):
    """What is compared is the file as it is, whatever an earlier command saw under its name."""
    a = make_image("a.exr", 40, 30)
    make_image("b.exr", 24, 18)
    ran = tonetool(a, "-o", "x.exr", "x.exr", "--hdrflip:fail=0:print=0", "--pop",
                   "b.exr", "-o", "x.exr", "x.exr", "--hdrflip:fail=0:print=0", "--pop",
                   a, "--exposure", "1", "-o", "x.exr", "--pop", a, "x.exr", "--hdrflip:fail=0",
                   status=3)
    assert ran.out.count("PASS mean 0 <= 0") == 2 and "FAIL" in ran.out
