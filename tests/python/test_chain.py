# SPDX-License-Identifier: BSD-3-Clause
"""tonetool.chain runs what the program runs."""

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import same


def test_equals_the_program(pair, program, tmp_path):
    ref_file, test_file, ref, test = pair
    program(ref_file, test_file, "--hdrflip", "-o", "map.exr", "--colormap", "magma", "-d", "float",
            "-o", "colors.exr")
    found = tonetool.chain("--hdrflip --dup --colormap magma", [ref, test])
    assert found.status == 0 and "hdrflip: mean" in found.out
    assert len(found.images) == len(found.names) == 2
    assert same(found.images[0], tmp_path / "map.exr")
    assert same(found.images[1], tmp_path / "colors.exr")
    assert all(type(image) is type(ref) for image in found.images)


def test_words_and_files(pair):
    ref_file, test_file, ref, test = pair
    from_files = tonetool.chain([ref_file, test_file, "--hdrflip:ppd=40"])
    assert same(from_files.images[0], tonetool.hdr_flip(ref, test, ppd=40).map)
    assert isinstance(from_files.images[0], oiio.ImageBuf)


def test_what_is_left_is_a_copy(noise):
    before = noise.copy()
    (left,) = tonetool.chain("--echo here", [noise]).images
    assert np.array_equal(left, noise)
    left[:] = 0
    assert np.array_equal(noise, before)


@pytest.mark.parametrize("words", ["--hdrflip:fail=0.9", "--diff",
                                   "--if 0 --hdrflip:fail=0.9 --endif"])
def test_what_was_not_compared_is_an_error(pair, words):
    _, _, ref, test = pair
    with pytest.raises(tonetool.Error, match="was never compared"):
        tonetool.chain(words, [test, ref, ref])
    assert len(tonetool.chain("--hdrflip", [test, ref, ref]).images) == 2


def test_threshold_is_never_passed_over(pair):
    _, _, ref, test = pair
    with pytest.raises(tonetool.CheckFailed, match="threshold") as raised:
        tonetool.chain("--hdrflip:fail=0.01", [ref, test])
    assert isinstance(raised.value, tonetool.Error)
    assert raised.value.result.status == 3
    assert same(raised.value.result.images[-1], tonetool.hdr_flip(ref, test).map)
    assert tonetool.chain("--hdrflip:fail=0.99", [ref, test]).status == 0


@pytest.mark.parametrize("command, said", [
    ("--hdrflop", "--hdrflop"),
    ("--hdrflip:pdp=3", "pdp"),
    ("nosuch.exr", "nosuch.exr"),
    ("--addc", "addc"),
])
def test_errors_have_the_reason(command, said, noise):
    with pytest.raises(tonetool.Error, match=said):
        tonetool.chain(command, [noise, noise])


def test_read_only(noise, tmp_path):
    with pytest.raises(tonetool.Error, match="-o"):
        tonetool.chain(["-o", tmp_path / "x.exr"], [noise], read_only=True)
    assert not list(tmp_path.iterdir())
    tonetool.chain(["-o", tmp_path / "x.exr"], [noise])
    assert same(tmp_path / "x.exr", noise)


def test_wrong_arguments(noise):
    with pytest.raises(TypeError, match="chain: command"):
        tonetool.chain(3, [noise])
    with pytest.raises(TypeError, match="chain: images"):
        tonetool.chain("--dup", noise[0, 0, 0])
    with pytest.raises(ValueError, match=r"images\[0\].*\(3,\)"):
        tonetool.chain("--dup", [noise[0, 0]])
