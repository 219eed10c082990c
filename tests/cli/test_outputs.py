# SPDX-License-Identifier: BSD-3-Clause
"""Data types, formats, metadata, and what becomes of a file that cannot be written."""

import os
import resource
import subprocess

import numpy as np
import OpenImageIO as oiio
import pytest

TYPES = ["uint8", "uint10", "uint12", "uint16", "uint32", "half", "float", "double"]


def same_file(read, ours, theirs):
    (a, spec_a), (b, spec_b) = read(ours), read(theirs)
    assert str(spec_a.format) == str(spec_b.format)
    assert [str(f) for f in spec_a.channelformats] == [str(f) for f in spec_b.channelformats]
    assert spec_a.channelnames == spec_b.channelnames
    assert (spec_a.roi, spec_a.roi_full) == (spec_b.roi, spec_b.roi_full)
    for key in ("oiio:BitsPerSample", "oiio:ColorSpace", "compression"):
        assert spec_a.getattribute(key) == spec_b.getattribute(key), key
    assert np.array_equal(a, b)


@pytest.mark.parametrize("extension", ["exr", "tif", "png"])
@pytest.mark.parametrize("kind", TYPES)
@pytest.mark.parametrize("how", ["option", "modifier"])
def test_data_types_as_oiiotool(tonetool, oiiotool, make_image, read, kind, extension, how):
    a = make_image("a.exr", kind="half")
    words = (["-d", kind, "-o"] if how == "option" else [f"-o:datatype={kind}"])
    tonetool(a, *words, f"x.{extension}")
    oiiotool(a, "-d", kind, "-o", f"y.{extension}")
    same_file(read, f"x.{extension}", f"y.{extension}")


@pytest.mark.parametrize("kind", ["uint8", "uint16", "half", "float"])
@pytest.mark.parametrize("source", ["tif", "exr", "png"])
@pytest.mark.parametrize("extension", ["exr", "tif", "png"])
def test_default_type_is_the_input_s(tonetool, oiiotool, make_image, read, kind, source,
                                     extension):
    a = make_image(f"a.{source}", kind=kind)
    tonetool(a, "-o", f"x.{extension}")
    oiiotool(a, "-o", f"y.{extension}")
    same_file(read, f"x.{extension}", f"y.{extension}")
    tonetool(a, "--ch", "B,G,R", "-o", f"x.{extension}")
    oiiotool(a, "--ch", "B,G,R", "-o", f"y.{extension}")
    same_file(read, f"x.{extension}", f"y.{extension}")


def test_type_of_one_channel(tonetool, oiiotool, make_image, read):
    a = make_image("a.exr", kind="half")
    for words in (["-d", "R=float"], ["-d", "half", "-d", "G=float"],
                  ["-d", "R=float", "-d", "half"], ["-d", "R=float,B=float"]):
        tonetool(a, *words, "-o", "x.exr")
        oiiotool(a, *words, "-o", "y.exr")
        same_file(read, "x.exr", "y.exr")


def test_type_of_a_channel_that_no_output_has(tonetool, make_image):
    ran = tonetool(make_image("a.exr"), "-d", "Q=half", "-o", "x.exr", status=1)
    assert '"Q"' in ran.err


@pytest.mark.parametrize("bad", ["foo", "uint", "R=foo", "R=", "=half", "R=half,foo", "Half", ""])
def test_unknown_type(tonetool, make_image, bad, tmp_path):
    ran = tonetool(make_image("a.exr"), "-d", bad, "-o", "x.exr", status=1)
    assert "-d : " in ran.err
    assert not (tmp_path / "x.exr").exists()


def test_rendered_pair_keeps_its_channel_types(tonetool, pair, read):
    tonetool(pair[0], "-o", "x.exr")
    _, spec = read("x.exr")
    kinds = {str(f) for f in spec.channelformats}
    assert kinds == {"half", "float"} and spec.nchannels == 35


def test_maps_are_float(tonetool, pair, read):
    tonetool(*pair, "--hdrflip", "-o", "x.exr", "-o:datatype=half", "y.exr")
    assert str(read("x.exr")[1].format) == "float" and read("x.exr")[1].nchannels == 1
    assert str(read("y.exr")[1].format) == "half"


def srgb(linear):
    linear = np.clip(linear.astype(np.float64), 0, 1)
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)


def test_colormap_is_rgb_and_srgb(tonetool, make_image, read):
    """The colours that magma is known for, not their linear light as oiiotool leaves them."""
    values = make_image("a.exr", channels=("Y",), width=3, height=1,
                        pixels=np.array([0.0, 0.5, 1.0]).reshape(1, 3, 1))
    tonetool(values, "--colormap", "magma", "-o", "x.png")
    pixels, spec = read("x.png")
    assert spec.nchannels == 3 and spec.get_string_attribute("oiio:ColorSpace") in ("sRGB", "srgb_rec709_scene")
    known = [[0, 0, 4], [183, 55, 121], [252, 253, 191]]
    assert np.abs(pixels[0] * 255 - known).max() <= 2


@pytest.mark.parametrize("name", ["blue-red", "viridis", "magma", "turbo", "plasma", "inferno",
                                  "spectrum", "heat", "0,0,0,1,0.5,0"])
def test_colormaps_are_oiiotool_s_encoded(tonetool, oiiotool, make_image, read, name):
    for a in (make_image("a.exr", channels=("Y",)), make_image("b.exr")):
        tonetool(a, "--colormap", name, "-o", "x.exr")
        oiiotool(a, "--colormap", name, "-o", "y.exr")
        # A float's rounding of values up to 1.
        assert np.abs(read("x.exr")[0] - srgb(read("y.exr")[0])).max() < 2e-7


@pytest.mark.parametrize("name", ["nosuch", "Magma", "0,0,0", "0,0,0,1,1", "0,0,0,1,1,x"])
def test_unknown_colormap(tonetool, make_image, name):
    ran = tonetool(make_image("a.exr"), "--colormap", name, "-o", "x.png", status=1)
    assert "valid:" in ran.err


def test_half_in_a_fits_file(tonetool, make_image, read):
    name = make_image("a.exr", kind="half")
    tonetool(name, "-o", "a.fits", "-d", "half", "-o", "b.fits")
    for written in ("a.fits", "b.fits"):
        assert np.abs(read(written)[0] - read(name)[0]).max() < 1e-6


def rows_of_pnm(path):
    """The pixels of a PPM file, which no library has turned."""
    kind, size, most, pixels = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind == b"P6"
    values = np.frombuffer(pixels, "u1" if int(most) == 255 else ">u2")
    return values.reshape(height, width, 3) / int(most)


def test_sixteen_bits_in_a_pnm_file(tonetool, make_image, read, tmp_path):
    """The writer of OpenImageIO 2.4 swaps their bytes."""
    name = make_image("a.exr")
    eight = oiio.VERSION < 20500
    ran = tonetool(name, "-d", "uint16", "-o", "a.ppm", "--warnings-exit", status=2 * eight)
    assert ("8 bits are written" in ran.err) == eight
    found = np.abs(rows_of_pnm(tmp_path / "a.ppm") - read(name)[0]).max()
    assert found < (0.003 if eight else 2e-5)


def test_first_row_of_a_pnm_file_is_the_top(tonetool, make_image, read, tmp_path):
    """That of OpenImageIO 2.5 begins with the last."""
    name = make_image("a.exr")
    tonetool(name, "-d", "uint8", "-o", "a.ppm")
    assert np.abs(rows_of_pnm(tmp_path / "a.ppm") - read(name)[0]).max() < 0.003


def test_last_row_of_a_pfm_file_is_the_top(tonetool, make_image, read, tmp_path):
    """A reader of OpenImageIO 2.5 that is not configured begins with the first."""
    name = make_image("a.exr")
    rows = read(name)[0][::-1].astype("<f4")
    (tmp_path / "a.pfm").write_bytes(b"PF\n16 12\n-1.0\n" + rows.tobytes())
    assert "mean 0," in tonetool(name, "a.pfm", "--hdrflip:from=linear").out
    tonetool("a.pfm", "-o", "b.exr")
    assert np.array_equal(read("b.exr")[0], read(name)[0])


@pytest.mark.parametrize("kind", ["png", "tif", "dpx", "tga"])
def test_no_pixel_of_the_display_window_is_lost(tonetool, make_image, read, kind):
    """Few formats can hold an origin below 0: oiiotool leaves out what is there."""
    pixels = np.random.default_rng(2).random((12, 16, 3)).astype(np.float32)
    for window, place in (((-5, -3, -5, -3, 16, 12), (0, 0)), ((0, 0, -4, -2, 30, 20), (2, 4)),
                          ((-9, -4, -10, -6, 40, 30), (2, 1))):
        name = make_image("a.exr", pixels=pixels, window=window)
        tonetool(name, "-d", "uint8", "-o", f"a.{kind}")
        got, spec = read(f"a.{kind}")
        assert got.shape[:2] == (window[5], window[4]) and (spec.x, spec.y) == (0, 0)
        assert np.abs(got[place[0]:, place[1]:][:12, :16] - pixels).max() < 0.003


def test_data_window_in_a_format_without_one(tonetool, oiiotool, make_image, read):
    a = make_image("a.exr", window=(3, 2, 0, 0, 30, 20))
    tonetool(a, "-o", "x.png", "-o", "x.exr")
    oiiotool(a, "-o", "y.png", "-o", "y.exr")
    same_file(read, "x.png", "y.png")
    same_file(read, "x.exr", "y.exr")


def test_too_many_channels_for_the_format(tonetool, oiiotool, pair, read):
    ran = tonetool("--warnings-exit", pair[0], "-o", "x.png", status=2)
    assert "Can't save 35 channels to png" in ran.err
    oiiotool(pair[0], "-o", "y.png")
    same_file(read, "x.png", "y.png")


def test_compression(tonetool, oiiotool, make_image, read):
    a = make_image("a.exr")
    for name in ("piz", "none", "dwaa:200"):
        tonetool(a, "--compression", name, "-o", "x.exr")
        tonetool(a, f"-o:compression='{name}'", "z.exr")
        oiiotool(a, "--compression", name, "-o", "y.exr")
        for ours in ("x.exr", "z.exr"):
            same_file(read, ours, "y.exr")
    tonetool(a, "--compression", "zipp", "-o", "x.exr", status=1)
    tonetool(a, "--compression", "dwaa:high", "-o", "x.exr", status=1)


def test_metadata_goes_on_and_the_command_line_is_noted(tonetool, make_image, read):
    a = make_image("a.exr", attributes={"ShotNote": "somebody"})
    tonetool(a, "--exposure", "1", "-o", "x.exr")
    _, spec = read("x.exr")
    assert spec.get_string_attribute("ShotNote") == "somebody"
    assert spec.get_string_attribute("Exif:ImageHistory") == \
        "tonetool a.exr --exposure 1 -o x.exr"


def test_deep_image_goes_through(tonetool, testimages, read):
    tonetool(testimages / "deep.exr", "-o", "x.exr")
    assert read("x.exr")[1].deep


def test_unwritable_places(tonetool, make_image, tmp_path):
    a = make_image("a.exr")
    tonetool(a, "-o", "nosuch/x.exr", status=1)
    tonetool(a, "-o", "x.nosuch", status=1)
    tonetool(a, "-o", "noextension", status=1)
    (tmp_path / "folder.exr").mkdir()
    tonetool(a, "-o", "folder.exr", status=1)
    assert not [p for p in os.listdir(tmp_path) if p not in ("a.exr", "folder.exr")]


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_read_only_directory(tonetool, make_image, tmp_path):
    a = make_image("a.exr")
    (tmp_path / "locked").mkdir(mode=0o555)
    tonetool(a, "-o", "locked/x.exr", status=1)


def test_full_device_behind_a_link(tonetool, make_image, tmp_path):
    a = make_image("a.exr")
    (tmp_path / "x.exr").symlink_to("/dev/full")
    tonetool(a, "-o", "x.exr", status=1)
    assert os.path.exists("/dev/full") and (tmp_path / "x.exr").is_symlink()


def test_file_size_limit_leaves_the_old_file(tonetool, make_image, tmp_path):
    old = make_image("x.exr", width=4, height=4)
    before = (tmp_path / old).read_bytes()
    a = make_image("a.exr", width=256, height=256)

    def small_files():
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

    tonetool(a, "-o", old, status=1, preexec_fn=small_files)
    assert (tmp_path / old).read_bytes() == before
    assert sorted(os.listdir(tmp_path)) == ["a.exr", "x.exr"]


@pytest.mark.parametrize("name", ["x.exr", "x.tx"])
def test_texture_on_a_full_disk(tonetool, make_image, tmp_path, name):
    a = make_image("a.exr", width=256, height=256)
    (tmp_path / name).write_bytes(b"old")

    def small_files():
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

    ran = tonetool(a, "-otex", name, status=1, preexec_fn=small_files)
    assert "Could not make texture" in ran.err
    assert (tmp_path / name).read_bytes() == b"old"
    assert sorted(os.listdir(tmp_path)) == ["a.exr", name]


@pytest.mark.parametrize("words", [["-o", "x.exr"], ["-otex", "x.exr"], ["-otex", "x.tx"],
                                   ["-obump", "x.tx"], ["-oenv", "x.exr"]])
def test_replaced_file_keeps_its_rights(tonetool, make_image, tmp_path, words):
    a = make_image("a.exr", width=32, height=16)
    file = tmp_path / words[-1]
    file.write_bytes(b"old")
    file.chmod(0o604)
    tonetool(a, *(["--ch", "R"] if words[0] == "-obump" else []), *words)
    assert file.stat().st_mode & 0o7777 == 0o604
    assert file.read_bytes() != b"old"
    assert sorted(os.listdir(tmp_path)) == ["a.exr", words[-1]]


def test_what_a_killed_run_left_is_cleared_by_the_next(program, tonetool, tmp_path):
    folder = tmp_path / "out"
    folder.mkdir()
    words = [program, "--pattern", "noise", "2048x2048", "3", "-d", "half", "-o", "out/b.exr"]
    with subprocess.Popen(words, cwd=tmp_path) as running:
        while running.poll() is None and not os.listdir(folder):
            pass
        running.kill()
    left = os.listdir(folder)
    assert len(left) == 1 and left[0].startswith(".b.exr."), left
    tonetool("--create", "4x4", "3", "-o", "out/c.exr")
    assert os.listdir(folder) == ["c.exr"]


def test_output_over_the_input(tonetool, make_image, read):
    a = make_image("a.exr")
    before = read(a)[0]
    tonetool(a, "--exposure", "1", "-o", a)
    assert np.array_equal(read(a)[0], before * 2)


@pytest.mark.parametrize("words", [
    ["--hdrflip:numExposures=2:saveexposures=s"], ["--exportlut", "l.cube"], ["-o", "x.exr"],
    ["-otex", "x.tx"], ["--hdrflip:fail=0.999", "--json", "x.json", "--state", "s"]])
def test_a_dry_run_writes_nothing(tonetool, pair, tmp_path, words):
    tonetool("-n", *pair, *words)
    assert not list(tmp_path.iterdir())
