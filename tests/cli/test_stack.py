# SPDX-License-Identifier: BSD-3-Clause
"""The stack, postponed operators, labels, channels and subimages."""

import numpy as np
import pytest


def test_postponed_operator_is_the_same_as_the_usual_order(tonetool, make_image, read):
    a, b = make_image("a.exr", seed=1), make_image("b.exr", seed=2)
    usual = tonetool(a, b, "--hdrflip", "-o", "usual.exr")
    late = tonetool(a, "--hdrflip", b, "-o", "late.exr")
    first = tonetool("--hdrflip", a, b, "-o", "first.exr")
    assert usual.out == late.out == first.out
    assert np.array_equal(read("usual.exr")[0], read("late.exr")[0])
    assert np.array_equal(read("usual.exr")[0], read("first.exr")[0])


def test_two_postponed_operators_run_in_their_order(tonetool, make_image, read):
    a, b = make_image("a.exr", seed=1), make_image("b.exr", seed=2)
    ran = tonetool("--hdrflip:print=0:fail=0.999", "--colormap", "magma", a, b, "-o", "x.exr")
    assert "hdrflip: PASS" in ran.out and read("x.exr")[1].nchannels == 3


def test_pending_operator_at_the_end_is_an_error(tonetool, make_image):
    a = make_image("a.exr")
    ran = tonetool("--info", a, "--hdrflip:fail=0.999", status=1)
    assert "hdrflip : never executed" in ran.err


@pytest.mark.parametrize("command", [["--exposure", "1"], ["--pop"], ["--dup"]])
def test_a_waiting_operator_is_not_overtaken(tonetool, make_image, command):
    a, b = make_image("a.exr"), make_image("b.exr", seed=2)
    ran = tonetool(a, "--hdrflip:fail=0.999", *command, b, "-o", "x.exr", status=1)
    assert "--hdrflip still waits" in ran.err and "PASS" not in ran.out


def test_no_output_while_an_operator_waits(tonetool, make_image, tmp_path):
    a, b = make_image("a.exr", seed=1), make_image("b.exr", seed=2)
    ran = tonetool(a, "--hdrflip", "-o", "x.exr", b, status=1)
    assert "--hdrflip still waits" in ran.err
    assert not (tmp_path / "x.exr").exists()


def test_dup_swap_pop(tonetool, make_image, read):
    a, b = make_image("a.exr", seed=1), make_image("b.exr", seed=2)
    tonetool(a, b, "--swap", "-o", "top.exr", "--pop", "-o", "below.exr")
    assert np.array_equal(read("top.exr")[0], read(a)[0])
    assert np.array_equal(read("below.exr")[0], read(b)[0])
    tonetool(a, "--dup", "--exposure", "1", "--pop", "-o", "same.exr")
    assert np.array_equal(read("same.exr")[0], read(a)[0])


def test_label_pushes_again_and_wins_over_a_file(tonetool, make_image, read):
    a, b = make_image("a.exr", seed=1), make_image("b.exr", seed=2)
    tonetool(a, "--label", "keep", "--pop", b, "keep", "-o", "x.exr")
    assert np.array_equal(read("x.exr")[0], read(a)[0])
    tonetool(a, "--label", "b.exr", "--pop", "b.exr", "-o", "y.exr")
    assert np.array_equal(read("y.exr")[0], read(a)[0])


@pytest.mark.parametrize("command", ["--dup", "--swap", "--pop", "--label x", "-o x.exr"])
def test_stack_commands_on_an_empty_stack(tonetool, command):
    assert "needs" in tonetool(*command.split(), status=1).err


@pytest.mark.parametrize("channels, expected", [
    ("B,G,R", [2, 1, 0]), ("2,0,1", [2, 0, 1]), ("r,g,b", [0, 1, 2]), ("R,R=B,G", [0, 2, 1])])
def test_ch(tonetool, make_image, read, channels, expected):
    a = make_image("a.tif")
    tonetool(a, "--ch", channels, "-o", "x.tif")
    assert np.array_equal(read("x.tif")[0], read(a)[0][:, :, expected])


def test_ch_with_values_as_oiiotool(tonetool, oiiotool, make_image, read):
    a = make_image("a.exr")
    tonetool(a, "--ch", "R,G=0.5,B,A=1.0", "-o", "x.exr")
    oiiotool(a, "--ch", "R,G=0.5,B,A=1.0", "-o", "y.exr")
    assert np.array_equal(read("x.exr")[0], read("y.exr")[0])
    assert read("x.exr")[1].channelnames == read("y.exr")[1].channelnames


@pytest.mark.parametrize("channels", ["Q", "R,Q", "3", "-1", "R,,B", "", "R=Q", "R=nan"])
def test_ch_refuses_what_is_not_there(tonetool, make_image, channels):
    tonetool(make_image("a.exr"), "--ch", channels, "-o", "x.exr", status=1)


def test_input_channels(tonetool, make_image, read):
    tonetool("-i:ch=G", make_image("a.exr"), "-o", "x.exr")
    assert read("x.exr")[1].channelnames == ("G",)


def test_chnames(tonetool, make_image, read):
    a = make_image("a.tif")
    tonetool(a, "--chnames", "X,,Z", "-o", "x.exr")
    assert sorted(read("x.exr")[1].channelnames) == ["G", "X", "Z"]
    tonetool(a, "--chnames", "X,Y,Z,W", "-o", "x.exr", status=1)
    tonetool(a, "--chnames", "A,A", "-o", "x.exr", status=1)


def test_subimages_are_kept_and_chosen(tonetool, make_parts, read):
    two = make_parts("two.exr", 0.25, 0.5)
    tonetool(two, "-o", "both.exr")
    assert read("both.exr", 1)[0].mean() == 0.5
    tonetool(two, "--subimage", "1", "-o", "x.exr")
    tonetool(two, "--subimage", "two", "-o", "y.exr")
    tonetool(two, "--subimage:delete=1", "0", "-o", "z.exr")
    for name in ("x.exr", "y.exr", "z.exr"):
        pixels, spec = read(name)
        assert pixels.mean() == 0.5 and spec.get_int_attribute("oiio:subimages", 1) == 1
    for bad in ("2", "-1", "nosuch", "0.5"):
        tonetool(two, "--subimage", bad, "-o", "x.exr", status=1)


def test_comparing_only_the_first_subimage_is_said(tonetool, make_parts):
    a, b = make_parts("a.exr", 0.25, 0.5), make_parts("b.exr", 0.25, 0.75)
    ran = tonetool("--warnings-exit", a, b, "--hdrflip", status=2)
    assert "pictures are not looked at: two" in ran.err
    ran = tonetool(a, b, "--hdrflip:fail=0", status=1)
    assert "pictures are not looked at: two" in ran.err
    for name in ("0", "1"):
        ran = tonetool(a, "--subimage", name, b, "--subimage", name, "--hdrflip:fail=0",
                       status=0 if name == "0" else 3)
        assert "not looked at" not in ran.err


def test_output_writes_all_with_a_pattern(tonetool, make_image, read):
    a, b = make_image("a.exr", seed=1), make_image("b.exr", seed=2)
    tonetool(a, b, "-o:all=7", "x.%03d.exr")
    assert np.array_equal(read("x.007.exr")[0], read(a)[0])
    assert np.array_equal(read("x.008.exr")[0], read(b)[0])
    for pattern in ("x.exr", "x.%s.exr", "x.%d.%d.exr", "x.%.exr"):
        tonetool(a, b, "-o:all=1", pattern, status=1)


def test_a_file_rewritten_in_the_same_run_is_read_anew(tonetool, make_image, read):
    a, b = make_image("a.exr", seed=1), make_image("b.exr", seed=2)
    before = read(b)[0]
    tonetool(a, "--pop", b, "-o", "a.exr", "a.exr", "-o", "x.exr")
    assert np.array_equal(read("x.exr")[0], before)
