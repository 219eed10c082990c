# SPDX-License-Identifier: BSD-3-Clause
"""What command lines of oiiotool meet beside its own behaviour, which tests/cli/differential holds:
where --compat is a command and where it is an argument, what it drops, deep images."""

import os

import numpy as np
import OpenImageIO as oiio
import pytest
from prestart import run_text


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("lines")
    y, x = np.mgrid[0:12, 0:16].astype(np.float32)
    image = oiio.ImageBuf(oiio.ImageSpec(16, 12, 3, "float"))
    image.set_pixels(oiio.ROI(), np.stack([x / 16, y / 12, x * y / 192], -1).copy())
    for name in ("a.exr", "s.0001.exr", "s.0002.exr", "s.0003.exr"):
        image.write(str(path / name))
    flat = oiio.ImageBuf(oiio.ImageSpec(8, 8, 5, "float"))
    flat.specmod().channelnames = ("R", "G", "B", "A", "Z")
    flat.specmod().alpha_channel, flat.specmod().z_channel = 3, 4
    flat.set_pixels(oiio.ROI(), np.full((8, 8, 5), 0.5, np.float32))
    deep = oiio.ImageBufAlgo.deepen(flat)
    assert deep.write(str(path / "deep.exr"))
    return path


@pytest.fixture
def run(folder, program):
    def call(*words):
        return run_text(program, words, folder, 60)
    return call


@pytest.fixture(scope="module")
def program():
    return os.environ["TONETOOL"]


@pytest.mark.parametrize("word", ["-compat", "--compat"])
def test_compat_has_one_or_two_dashes(run, word):
    done = run(word, "a.exr", "--resize:bogus=1", "4x4", "-o", "x.exr")
    assert done.returncode == 0
    assert '"bogus=1" is no modifier of this command' in done.stderr


@pytest.mark.parametrize("words", [
    ["--attrib", "note", "--compat"], ["--caption", "-compat"], ["--echo", "--compat"],
    ["--sattrib", "--compat", "x"]])
def test_compat_as_an_argument_is_an_argument(run, words):
    taken = run("a.exr", *words, "-o", "y.exr")
    assert taken.returncode == 0, taken.stderr
    strict = run("a.exr", *words, "--resize:bogus=1", "4x4", "-o", "y.exr")
    assert strict.returncode == 1 and "bogus" in strict.stderr


@pytest.mark.parametrize("word", ["--warnings-exit", "--skip-bad-frames", "-v", "--wildcardoff"])
def test_other_settings_as_arguments_set_nothing(run, word):
    """They hold for the whole line as --compat does."""
    done = run("--compat", "a.exr", "--caption", word, "s.#.exr", "--echo", "{TOP.filename}")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[0].removeprefix("./") == "s.0001.exr"  # as found on the disk


@pytest.mark.parametrize("words,text", [
    (["--contrast:gamma=2"], "gamma"), (["--resize:=3:filter=box", "4x4"], "=3"),
    (["--printstats:roi=4x4+0+0"], "roi="), (["--ch:nosuch=1", "R"], "nosuch=1"),
    (["-o:compression=zip", "c.exr"], "compression="), (["-o:bits=10", "c.exr"], "bits="),
    (["-o:type=bogus", "c.exr"], "bogus"), (["-otex:fovcot=2", "c.tx"], "fovcot="),
    (["--printinfo:format=xml"], "format=")])
def test_compat_drops_nothing_without_a_word(run, words, text):
    done = run("--compat", "a.exr", *words, "-o", "x.exr")
    warnings = [line for line in done.stderr.splitlines() if "WARNING" in line and text in line]
    assert done.returncode == 0 and len(warnings) == 1 and "no effect" in warnings[0], done.stderr


@pytest.mark.parametrize("words", [["--parallel-frames"], ["--jobs"], ["--parallel-frames", "2"]])
def test_frames_in_parallel_with_and_without_a_number(run, words):
    done = run(*words, "s.#.exr", "--echo", "{TOP.filename}")
    assert done.returncode == 0, done.stderr
    assert [name.removeprefix("./") for name in done.stdout.split()] == [
        "s.0001.exr", "s.0002.exr", "s.0003.exr"]


def test_newer_spellings(run, folder):
    assert run("a.exr", "--no-history", "-o", "h.exr").returncode == 0
    assert "Software" not in {one.name for one in
                              oiio.ImageBuf(str(folder / "h.exr")).spec().extra_attribs}
    assert run("a.exr", "--no-history", "--history", "-o", "i.exr").returncode == 0
    assert oiio.ImageBuf(str(folder / "i.exr")).spec().get_string_attribute("Software")


def test_an_output_range_counts_for_itself(run, folder):
    assert run("s.#.exr", "-o", "t.11-13#.exr").returncode == 0
    assert (folder / "t.0013.exr").exists()
    short = run("s.#.exr", "-o", "u.1-2#.exr")
    assert short.returncode == 1 and "3 frames" in short.stderr and "2 frames" in short.stderr
    check = run("s.#.exr", "--qc", "-o", "u.1-2#.exr", "--json", "u.json")
    assert check.returncode == 1 and "2 frames" in check.stderr


PATTERNS = ["--addc 1", "--crop 4x4+1+1", "--resize 4x4", "--resample 4x4", "--fit 4x4", "--cut 3x3",
            "--rotate90", "--rotate 20", "--warp 1,0,0,0,1,0,0,0,1", "--transpose", "--flip",
            "--cshift +1+1", "--blur 3x3", "--median 3x3", "--dilate 3x3", "--erode 3x3",
            "--laplacian", "--unsharp", "--fft", "--ifft", "--polar", "--unpolar", "--fillholes",
            "--invert", "--abs", "--powc 2", "--clamp", "--contrast", "--saturate 0.5", "--noise",
            "--rangecompress", "--rangeexpand", "--premult", "--unpremult", "--repremult",
            "--maxchan", "--minchan", "--chsum", "--colormap viridis", "--ccmatrix 1,0,0,0,1,0,0,0,1",
            "--box 1,1,3,3", "--line 1,1,3,3", "--point 1,1", "--fill:color=1 2x2",
            "--tocolorspace sRGB", "--colorconvert linear sRGB", "--pixelaspect 2", "--reorient",
            "--colorcount 0,0,0,0,0", "--rangecheck 0 1", "--printstats", "--printinfo:stats=1",
            "--croptofull", "--trim", "--fixnan black", "--paste +1+1", "--over", "--mosaic 2x1",
            "--absdiff", "--mad", "--zover", "--diff", "--pdiff", "--pastemeta", "--st_warp",
            "--convolve", "--dup --add", "--label x --echo {TOP.STATS}", "--echo {TOP.MAXCOLOR}",
            "-otex d.tx", "-oenv d.tx", "-obump d.tx", "-o d.tif", "--selectmip 0", "--unmip"]


def test_deep_images_are_refused_not_crashed_on(run):
    """By every command, in both manners: a result or an error, and never a signal."""
    found = {}
    for line in PATTERNS:
        for manner in ([], ["--compat"]):
            done = run(*manner, "deep.exr", "deep.exr", "deep.exr", *line.split(), "-o", "deepo.exr")
            if done.returncode not in (0, 1, 3):
                found[" ".join([*manner, line])] = done.returncode
    assert not found


def test_hashes_are_of_what_the_file_holds(run, folder):
    """A deep file's is there, and two files of one picture in other data types differ."""
    deep = run("--hash", "deep.exr")
    assert deep.returncode == 0 and "SHA-1: " in deep.stdout
    run("a.exr", "-d", "R=half", "-o", "mixed.exr")
    run("a.exr", "-d", "float", "-o", "same.exr")
    sums = [run("--hash", name).stdout.split("SHA-1: ")[1] for name in ("a.exr", "mixed.exr",
                                                                       "same.exr")]
    assert sums[0] != sums[1] and sums[0] == sums[2]


def test_a_line_that_clobbers_nothing_can_be_run_again(run, folder):
    for word in ("--noclobber", "--no-clobber"):
        for _ in range(2):
            done = run("a.exr", word, "-o", f"once{word}.exr")
            assert done.returncode == 0, done.stderr
    assert "already exists, not overwriting" in done.stderr


def test_an_update_goes_on_where_an_output_is_newer(run, folder):
    """One image or a frame of several: what is up to date is no error."""
    line = ["-u", "--frames", "1-3", "s.#.exr", "--mulc", "2", "-o", "up.#.exr"]
    assert run(*line).returncode == 0
    for number in (1, 2, 3):
        made = (folder / f"s.{number:04d}.exr").stat().st_mtime + 10
        os.utime(folder / f"up.{number:04d}.exr", (made, made))
    (folder / "up.0002.exr").unlink()
    kept = (folder / "up.0001.exr").stat().st_mtime_ns
    done = run(*line)
    assert done.returncode == 0, done.stderr
    assert (folder / "up.0002.exr").is_file() and (folder / "up.0001.exr").stat().st_mtime_ns == kept
    assert run("-u", "s.0001.exr", "--mulc", "2", "-o", "up.0001.exr").returncode == 0


@pytest.mark.parametrize("word", ["--info", "--stats", "--hash"])
def test_what_prints_of_files_is_not_after_them(run, word):
    done = run("a.exr", word)
    assert done.returncode == 1
    assert "printed nothing" in done.stderr and "(valid: --info FILE)" in done.stderr
    assert run(word, "a.exr").returncode == 0


@pytest.mark.parametrize("words", [
    ["--pattern", "constant:color=1,1,1,1", "8x8", "1"], ["grey.exr", "--mulc", "2,3,4"],
    ["grey.exr", "--box:color=1,1,1,1:fill=1", "1,1,3,3"],
    ["grey.exr", "--clamp:min=0,0,0:max=1,1,1"]])
def test_numbers_beyond_the_channels_are_not_used(run, folder, words):
    oiio.ImageBuf(oiio.ImageSpec(8, 8, 1, "float")).write(str(folder / "grey.exr"))
    done = run(*words, "-o", "own.exr")
    assert done.returncode == 0 and "of which the image's channels use" in done.stderr
    assert run("--compat", *words, "-o", "theirs.exr").returncode == 0
    # Not through an ImageBuf, whose cache may know what was there in this second.
    own, theirs = (oiio.ImageInput.open(str(folder / name)).read_image("float")
                   for name in ("own.exr", "theirs.exr"))
    assert np.array_equal(own, theirs)
