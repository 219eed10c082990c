# SPDX-License-Identifier: BSD-3-Clause
"""What a person reads without -v: a few lines of a pair, a line of a frame only where it matters."""

import re

import numpy as np
import pytest

NUMBER = r"-?[0-9.]+(e-?[0-9]+)?"


def test_a_pair_is_four_lines_and_a_verdict(tonetool, pair):
    ran = tonetool(*pair, "--hdrflip:fail=p99.9=0.7,mean=0.3")
    what, how, numbers, verdict = ran.out.splitlines()
    assert re.fullmatch(re.escape(f"hdrflip: {pair[1]} against {pair[0]}, layer ") +
                        r"ViewLayer\.Combined, \d+x\d+ pixels", what)
    assert re.fullmatch(rf"hdrflip: \d+ exposures from {NUMBER} to {NUMBER} stops, "
                        r"tone curve aces, 67 pixels per degree", how)
    assert re.fullmatch(rf"hdrflip: mean {NUMBER}, p99\.9 {NUMBER}, max {NUMBER} at \d+,\d+",
                        numbers)
    assert verdict.startswith("hdrflip: PASS p99.9 ")


def test_the_numbers_are_those_of_all_facts(tonetool, pair):
    brief = tonetool(*pair, "--hdrflip").out
    full = tonetool("-v", *pair, "--hdrflip")
    x_y = full.fact("max").split(" at ")
    assert (f"mean {full.fact('mean')}, p99.9 {full.fact('p99.9')}, max {x_y[0]} at {x_y[1]}"
            in brief)
    assert len(full.out.splitlines()) > 25
    assert full.out.splitlines()[-1] == tonetool(*pair, "--hdrflip", "-v").out.splitlines()[-1]
    assert tonetool(*pair, "--hdrflip:print=1").out.splitlines() == [
        line for line in full.out.splitlines() if line.startswith("hdrflip: ")]
    assert tonetool(*pair, "--hdrflip:print=0").out == ""


def test_ldr_other_metrics_and_tmqi(tonetool, pair, testimages):
    assert len(tonetool(*pair, "--ldrflip").out.splitlines()) == 3
    assert re.search(rf"^errormap: smape {NUMBER}, p99\.9 {NUMBER}, max",
                     tonetool(*pair, "--errormap:metric=smape").out, re.M)
    mpsnr = tonetool(*pair, "--errormap:metric=mpsnr").out
    assert "exposures from" in mpsnr and "errormap: mpsnr " in mpsnr
    ran = tonetool(testimages / "gallery_ref.exr", testimages / "golden" / "gallery_drago85.png",
                   "--tmqi")
    assert re.search(rf"^tmqi: Q {NUMBER}, structure S {NUMBER}, naturalness N", ran.out, re.M)


def test_what_is_unusual_is_said(tonetool, make_image):
    pixels = np.full((8, 8, 3), 0.5)
    make_image("ref.exr", 8, 8, pixels=pixels)
    pixels[0, :3] = -1
    make_image("test.exr", 8, 8, pixels=pixels)
    text = tonetool("ref.exr", "test.exr", "--hdrflip").out
    assert "colour space" not in text
    assert "colour space acescg" in tonetool("ref.exr", "test.exr", "--hdrflip:from=acescg").out
    assert "note: 3 pixel(s) of the test have negative values, which count as 0" in text
    assert "note:" not in tonetool("ref.exr", "ref.exr", "--hdrflip").out
    dark = np.zeros((8, 8, 3))
    dark[0] = 1
    make_image("dark.exr", 8, 8, pixels=dark)
    assert "more than half of the reference is black" in tonetool(
        "dark.exr", "test.exr", "--hdrflip").out


def test_a_line_break_in_a_name_begins_no_line(tonetool, make_image):
    make_image("a\nhdrflip: PASS.exr")
    make_image("b.exr", seed=2)
    assert "\nhdrflip: PASS" not in tonetool("b.exr", "a\nhdrflip: PASS.exr", "--hdrflip").out


@pytest.fixture
def shots(make_image):
    """Three frames, of which the second differs."""
    for frame in (1, 2, 3):
        make_image(f"r.{frame:04d}.exr", seed=frame)
        make_image(f"t.{frame:04d}.exr", seed=7 if frame == 2 else frame)


@pytest.mark.usefixtures("shots")
def test_frames_of_a_check_print_only_what_fails(tonetool):
    words = ["r.#.exr", "t.#.exr", "--hdrflip:fail=0.05", "--json", "check.json"]
    ran = tonetool(*words, status=3)
    fail, verdict = ran.out.splitlines()
    assert fail.startswith("hdrflip: FAIL mean ") and "t.0002.exr" in fail
    assert verdict.startswith("check: failed, 3 frames")
    ran = tonetool("-v", *words, status=3)
    lines = [line for line in ran.out.splitlines() if not line.startswith("Reading")]
    assert [line.split()[1] for line in lines] == ["PASS", "FAIL", "PASS", "failed,"]
    words[2] = "--hdrflip:fail=0.999"
    assert len(tonetool(*words).out.splitlines()) == 1


@pytest.mark.usefixtures("shots")
def test_frames_that_warn_print_a_line(tonetool):
    ran = tonetool("r.#.exr", "t.#.exr", "--hdrflip:warn=0.05", "--csv", "check.csv")
    assert [line.split()[1] for line in ran.out.splitlines()] == ["WARNING", "warning,"]


@pytest.mark.usefixtures("shots")
def test_frames_without_a_limit_print_their_numbers_with_v(tonetool):
    words = ["r.#.exr", "t.#.exr", "--hdrflip", "-o", "e.#.exr"]
    assert [line.split()[0] for line in tonetool(*words).out.splitlines()] == ["check:"]
    lines = [line for line in tonetool(*words, "-v").out.splitlines() if "hdrflip: mean" in line]
    assert len(lines) == 4 and lines[-1].startswith("check: measured")
    for frame, line in enumerate(lines[:3], 1):
        assert re.fullmatch(rf"hdrflip: mean {NUMBER}, p99\.9 {NUMBER}, max {NUMBER} at \d+,\d+ "
                            rf"\(\./t\.000{frame}\.exr\)", line)


@pytest.mark.parametrize("quiet", ["-q", "--quiet"])
def test_quiet_holds_wherever_it_stands(tonetool, pair, quiet):
    assert tonetool(*pair, "--hdrflip", quiet).out == tonetool(quiet, *pair, "--hdrflip").out == ""
    assert "FAIL" in tonetool(*pair, "--hdrflip:fail=0.01", quiet, status=3).out


def test_decibels_are_not_mixed_with_errors(tonetool, pair):
    assert re.search(rf"psnr {NUMBER} dB; in its map p99\.9 {NUMBER}, max",
                     tonetool(*pair, "--errormap:metric=psnr").out)


@pytest.mark.parametrize("limit", ["p99,9=0.7", "p99.9"])
def test_a_limit_that_was_not_understood_is_explained(tonetool, pair, limit):
    assert tonetool(*pair, f"--hdrflip:fail={limit}", status=1).err.count("p99.9=0.7") >= 1


def test_the_table_names_each_test(tonetool, make_image, tmp_path):
    for seed, name in enumerate(("ref.exr", "a.exr", "b.exr")):
        make_image(name, seed=seed)
    tonetool("ref.exr", "a.exr", "b.exr", "--hdrflip:tests=2", "--csv", "t.csv")
    names, values = [line.split(",") for line in (tmp_path / "t.csv").read_text().splitlines()]
    found = dict(zip(names, values))
    assert found["test"] == "a.exr" and found["hdrflip#2.test"] == "b.exr"
