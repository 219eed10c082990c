# SPDX-License-Identifier: BSD-3-Clause
"""Strictness: whatever is not understood is an error with status 1, and says why."""

import os
import struct
import subprocess
import zlib

import numpy as np
import pytest


def test_error_text(tonetool):
    ran = tonetool("nosuch file.exr", "--hdrflip", status=1)
    assert ran.err == ('tonetool ERROR: read : File does not exist: "nosuch file.exr"\n'
                       "Full command line was:\n> tonetool 'nosuch file.exr' --hdrflip\n")


@pytest.mark.parametrize("words, text", [
    (["--bogus"], 'unknown command "--bogus"'),
    (["--hdrflp"], "did you mean --hdrflip"),
    (["--"], 'unknown command "--"'),
    (["--hdrflip:tonemaper=aces"], 'did you mean "tonemapper"'),
    (["--hdrflip:nonsense=1"], "valid: tonemapper, curve, white"),
    (["--hdrflip:fail"], 'malformed modifier "fail"'),
    (["--hdrflip:fail="], '"fail" has no value'),
    (["--hdrflip:"], "empty modifier"),
    (["--hdrflip::fail=0.999"], "empty modifier"),
    (["--hdrflip:fail=0.1:fail=0.9"], '"fail" is given twice'),
    (["--hdrflip:tonemapper='aces"], "unfinished quotation"),
    (["--dup:x=1"], "this command has none"),
    (["--exposure"], "missing argument STOPS"),
    (["-o", "--dup"], '"--dup" is a command'),
    (["--help", "hdrflp"], "did you mean --hdrflip"),
    (["--qc:fireflies=off"], 'did you mean "firefly"'),
    (["--report"], "missing argument FILE.html"),
    (["--contactsheet"], "missing argument FILE"),
    (["--pictures"], "missing argument DIR"),
    (["--reprot", "a.html"], "did you mean --report"),
    (["--threads", "x"], "not a whole number"),
    (["--threads", "-1"], "out of range"),
    (["-"], 'File does not exist: "-"'),
])
def test_command_line_that_is_not_understood(tonetool, words, text):
    assert text in tonetool(*words, status=1).err


@pytest.mark.parametrize("modifier", [
    "tonemapper=ases", "tonemapper=ACES", "fail=0,05", "fail=5%", "fail=abc", "fail=nan",
    "fail=inf", "fail=-0.1", "fail=1.5", "fail=0x1", "warn=x", "quantity=median:fail=0.999",
    "quantity=max", "numExposures=0", "numExposures=-1", "numExposures=2.5",
    "numExposures=1025", "startExposure=abc", "startExposure=2:stopExposure=1", "ppd=0",
    "ppd=-1", "ppd=nan", "ppd=67:distance=0.7", "ppd=67:width=0.7", "ppd=67:pixels=3840",
    "distance=0", "width=-1", "pixels=0", "coeffs=1,2,3", "coeffs=1,2,3,4,5,x",
    "coeffs=1,2,3,4,5,6:tonemapper=aces", "maxluminance=0", "medianluminance=-1",
    "resize=1:crop=1", "resize=yes", "crop=2", "alpha=maybe", "exposuremap=both", "print=2",
    "tests=0", "tests=1.5", "layer=nosuch", "from=nosuch"])
def test_bad_values_are_errors_and_write_nothing(tonetool, pair, tmp_path, modifier):
    ran = tonetool(*pair, f"--hdrflip:{modifier}", "-o", "x.exr", status=1)
    assert "tonetool ERROR: hdrflip : " in ran.err
    assert not os.listdir(tmp_path)


@pytest.mark.parametrize("value", ["abc", "0,5", "nan", "inf", "1e9", "", "5%"])
def test_bad_stops(tonetool, make_image, value):
    ran = tonetool(make_image("a.exr"), "--exposure", value, "-o", "x.exr", status=1)
    assert "exposure : STOPS" in ran.err


@pytest.mark.parametrize("command", ["--hdrflip:fail=0.999", "--ldrflip:fail=0.999",
                                     "--flipdiff:fail=0.999"])
@pytest.mark.parametrize("bad", ["truncated.exr", "deep.exr", "y_only.exr", "not_an_image.exr",
                                 "nosuch.exr", "aovs_only.exr", "two_beauties.exr"])
def test_images_that_cannot_be_compared(tonetool, testimages, command, bad, tmp_path):
    good = testimages / "plain.exr"
    for words in ([good, testimages / bad], [testimages / bad, good]):
        ran = tonetool(*words, command, "-o", "x.exr", status=1)
        assert "tonetool ERROR: " in ran.err and "PASS" not in ran.out
    assert not os.listdir(tmp_path)


def test_truncated_file_is_an_error_wherever_its_pixels_are_used(tonetool, testimages):
    bad = testimages / "truncated.exr"
    for words in (["-o", "x.exr"], ["--stats"], ["--ch", "R", "-o", "x.exr"],
                  ["--exposure", "1", "-o", "x.exr"], ["--luminancestats"],
                  ["--colormap", "magma", "-o", "x.png"]):
        order = [*words, bad] if words == ["--stats"] else [bad, *words]
        tonetool(*order, status=1)


def chroma_at_half_the_size(data):
    """An EXR file's bytes with the header of luminance-chroma files."""
    data = bytearray(data)
    at = data.index(b"chlist") + 11
    for step in (2, 1, 2):
        numbers = data.index(b"\0", at) + 1
        data[numbers + 8:numbers + 16] = struct.pack("<ii", step, step)
        at = numbers + 16
    return bytes(data)


@pytest.mark.parametrize("damage", [
    chroma_at_half_the_size, lambda data: b"", lambda data: data[:100], lambda data: data[:len(data) * 2 // 3],
    lambda data: b"no image"])
@pytest.mark.parametrize("command", ["--hdrflip", "--diff", "--add -o sum.exr"])
def test_an_error_names_the_file_that_cannot_be_read(tonetool, make_image, tmp_path, damage, command):
    good, bad = make_image("good.exr"), make_image("bad.exr", attributes={"compression": "zip"})
    (tmp_path / bad).write_bytes(damage((tmp_path / bad).read_bytes()))
    for pair in ((good, bad), (bad, good)):
        ran = tonetool(*pair, *command.split(), status=1)
        assert "bad.exr" in next(line for line in ran.err.splitlines() if "ERROR" in line)
    assert not (tmp_path / "sum.exr").exists()


def planar_tiff(path, pixels, rows):
    """Deflated float planes one after another, `rows` rows a strip; OpenImageIO writes one row a strip."""
    height, width, channels = pixels.shape
    strips = [zlib.compress(pixels[y:y + rows, :, c].astype("<f4").tobytes())
              for c in range(channels) for y in range(0, height, rows)]
    body, places = b"II*\0", []
    for part in [b"\0" * 4, *strips]:  # first the place of the directory, which is known at the end
        places.append(len(body))
        body += part + b"\0" * (len(part) % 2)
    arrays = []
    for numbers in (struct.pack("<3H", 32, 32, 32), struct.pack("<3H", 3, 3, 3),
                    struct.pack(f"<{len(strips)}I", *places[1:]),
                    struct.pack(f"<{len(strips)}I", *map(len, strips))):
        arrays.append(len(body))
        body += numbers + b"\0" * (len(numbers) % 2)
    short, long = 3, 4
    tags = [(256, long, 1, width), (257, long, 1, height), (258, short, 3, arrays[0]), (259, short, 1, 8),
            (262, short, 1, 2), (273, long, len(strips), arrays[2]), (277, short, 1, channels),
            (278, long, 1, rows), (279, long, len(strips), arrays[3]), (284, short, 1, 2),
            (339, short, 3, arrays[1])]
    directory = struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in tags) + b"\0" * 4
    path.write_bytes(body[:4] + struct.pack("<I", len(body)) + body[8:] + directory)


@pytest.mark.parametrize("rows", [1, 3, 7, 64])
def test_compressed_strips_of_planar_files(tonetool, make_image, tmp_path, rows):
    pixels = np.random.default_rng(5).random((220, 64, 3), np.float32)
    plain = make_image("plain.exr", pixels=pixels, width=64, height=220)
    planar_tiff(tmp_path / "planar.tif", pixels, rows)
    assert f"RowsPerStrip: {rows}\n" in tonetool("--info", "-v", "planar.tif").out
    assert (tonetool("planar.tif", "--luminancestats").out.replace("planar.tif", plain)
            == tonetool(plain, "--luminancestats").out)
    tonetool(plain, "planar.tif", "--diff")
    assert "max 0 " in tonetool(plain, "planar.tif", "--hdrflip", "-o", "map.exr").out
    assert "max 0 " in tonetool("--memory", "130M", plain, "planar.tif", "--hdrflip", "-o", "map.exr").out


@pytest.mark.parametrize("command", ["--luminancestats", "--calibrate", "--ldrflip", "--tonemap"])
def test_a_reader_that_names_fewer_channels_than_there_are(tonetool, make_image, command):
    cube = make_image("a.fits", 32, 24)
    ran = tonetool(cube, cube, command, "-o", "x.exr", status=1)
    assert '"a.fits": needs R,G,B' in ran.err


@pytest.mark.parametrize("bits", ["uint8", "uint10", "uint12", "uint16"])
@pytest.mark.parametrize("share", [0.5, 0.95])
def test_cut_dpx_files(tonetool, make_image, tmp_path, bits, share):
    tonetool(make_image("a.exr", 96, 80), "-d", bits, "-o", "a.dpx")
    tonetool("a.dpx", "-o", "whole.exr")
    whole = (tmp_path / "a.dpx").read_bytes()
    (tmp_path / "cut.dpx").write_bytes(whole[:int(len(whole) * share)])
    for words in (["cut.dpx", "-o", "x.exr"], ["cut.dpx", "--qc"], ["cut.dpx", "--tonemap"],
                  ["a.dpx", "cut.dpx", "--ldrflip:fail=0.9"]):
        ran = tonetool(*words, status=1)
        assert "cut.dpx" in ran.err and "PASS" not in ran.out


def test_a_webp_file_has_colours(tonetool, make_image):
    grey = make_image("a.exr", channels=("Y", "A"))
    ran = tonetool(grey, "--tonemap", "-o", "x.webp", status=1)
    assert "webp files have 3 or 4 channels, the image has 2" in ran.err


def test_nothing_done_is_an_error(tonetool, make_image):
    tonetool(status=1)
    assert "no output" in tonetool(make_image("a.exr"), status=1).err
    assert "no output" in tonetool("-q", status=1).err


def test_an_error_dominates_a_failed_threshold(tonetool, pair):
    ran = tonetool(*pair, "--hdrflip:fail=0", "-o", "nosuch/x.exr", status=1)
    assert "FAIL" in ran.out


def test_full_standard_output(tonetool, pair):
    with open("/dev/full", "w", encoding="ascii") as full:
        tonetool(*pair, "--hdrflip:fail=0.999", "-o", "x.exr", status=1, stdout=full)
        tonetool("--help", status=1, stdout=full)


def test_closed_pipe(program, pair, tmp_path):
    reader, writer = os.pipe()
    os.close(reader)
    words = [program, *pair, "--hdrflip:fail=0.999", "-o", "x.exr"]
    done = subprocess.run(words, stdout=writer, stderr=subprocess.PIPE, cwd=tmp_path,
                          check=False)
    os.close(writer)
    assert done.returncode == 1 and done.stderr == b""
    assert (tmp_path / "x.exr").exists()


def test_help(tonetool):
    everything = tonetool("--help").out
    for command in ("--hdrflip", "--ldrflip", "--flipdiff", "--filmstrip", "--luminancestats"):
        assert command in everything
        assert "fail=" in tonetool("--help", command).out or command == "--luminancestats"
    assert tonetool("-help", "hdrflip").out == tonetool("--help", "--hdrflip").out


def test_version(tonetool):
    assert tonetool("--version").out.splitlines()[0].count(".") == 2
