# SPDX-License-Identifier: BSD-3-Clause
"""--qc: each fault alone is found in its frame, and nothing else; clean shots have none."""

import json
from pathlib import Path

import make_shot
import numpy as np
import pytest
from conftest import TESTIMAGES

SHARED = Path(__file__).resolve().parents[3] / "shared" / "scenes" / "anim"


def faults(report):
    return [(frame["frame"], fault["code"]) for frame in json.loads(report.read_text())["frames"]
            for fault in frame.get("faults", [])]


@pytest.fixture
def check(tonetool, tmp_path):
    """Runs --qc over shot.#.exr and returns what was found."""

    def run(status, qc="--qc", frames="1-20"):
        ran = tonetool("--frames", frames, "shot.#.exr", qc, "--warnings-exit", "--json",
                       "check.json", status=status)
        return ran, faults(tmp_path / "check.json")

    return run


@pytest.mark.parametrize("fault", make_shot.FAULTS)
def test_each_fault_is_found_and_nothing_else(check, tmp_path, fault):
    code, first = make_shot.make_shot(tmp_path, fault)
    severity = severity_of(fault, code)
    ran, found = check({"error": 3, "warning": 2}[severity] if code != "missing" else 1)
    assert found == [(first, code)]
    assert f"qc: frame {first}: {severity} {code}: " in ran.out


def severity_of(fault, code):
    errors = ("missing", "black", "constant", "missinglayer", "blacklayer", "nan", "inf",
              "lightsum", "channels", "displaywindow", "hole", "frozen", "repeat", "alphaempty")
    # What a story may do once: a light that goes out, a hold.
    mild = ("black-layer-stays", "frozen-at-the-end")
    return "error" if code in errors and fault not in mild else "warning"


@pytest.mark.parametrize("kind", [{}, {"noisy": True}, {"cut": True}, {"noisy": True, "cut": True}])
def test_no_false_alarm(check, tmp_path, kind):
    make_shot.make_shot(tmp_path, **kind)
    ran, found = check(0)
    assert found == []
    assert "check: passed, 20 frames: 20 passed" in ran.out


@pytest.mark.parametrize("value, code", [("nan", "nan"), ("inf", "inf"), ("-inf", "inf")])
@pytest.mark.parametrize("alpha", ["A", "diffuse.A", "diffuse.alpha"])
def test_an_alpha_that_is_no_number(tonetool, make_image, value, code, alpha):
    names = ["R", "G", "B", "A", "diffuse.R", "diffuse.G", "diffuse.B"]
    names += [] if alpha in names else [alpha]
    pixels = np.random.default_rng(3).random((12, 16, len(names))).astype(np.float32)
    pixels[4, 3, names.index(alpha)] = float(value)
    name = make_image("a.exr", channels=names, pixels=pixels)
    for words in ("--qc", "--qc:alpha=off"):
        ran = tonetool(name, words, status=3)
        assert f"error {code}: " in ran.out and "at (3, 4)" in ran.out


def test_severities_and_thresholds(check, tonetool, tmp_path):
    make_shot.make_shot(tmp_path, "light")
    assert check(3, "--qc:light=error")[1] == [(11, "light")]
    assert check(0, "--qc:light=0.9:layerlight=off")[1] == []
    assert check(0, "--qc:light=off:layerlight=off")[1] == []
    assert check(0, "--qc:light=info")[1] == [(11, "light")]
    for value, text in (("loud", "must be off, info"), ("-1", "must be off"), ("", "has no value")):
        assert text in tonetool("shot.0001.exr", f"--qc:light={value}", status=1).err
    assert "lihgt" in tonetool("shot.0001.exr", "--qc:lihgt=1", status=1).err


def test_any_split_gives_the_bytes_of_the_whole(tonetool, tmp_path):
    make_shot.make_shot(tmp_path, "flicker")
    tonetool("--frames", "1-20", "shot.#.exr", "--qc", "--json", "whole.json", "--csv", "whole.csv")
    for size in (1, 5):
        parts = []
        for first in range(1, 21, size):
            parts.append(f"part{first}.json")
            tonetool("--frames", f"{first}-{first + size - 1}", "shot.#.exr", "--qc", "--json",
                     parts[-1])
        tonetool("--merge", *reversed(parts), "--json", "merged.json", "--csv", "merged.csv")
        for kind in ("json", "csv"):
            assert ((tmp_path / f"merged.{kind}").read_bytes() ==
                    (tmp_path / f"whole.{kind}").read_bytes())
    assert faults(tmp_path / "merged.json") == [(5, "flicker")]


def test_a_gap_on_the_disk_is_a_fault(tonetool, tmp_path):
    make_shot.make_shot(tmp_path, "missing")
    ran = tonetool("shot.#.exr", "--qc", status=1)
    assert "qc: frame 8: error missing: " in ran.out


def test_few_values_are_bands_unless_the_file_has_no_more(tonetool, make_image, tmp_path):
    ramp = np.random.default_rng(1).random((80, 100, 3)).astype(np.float32)
    make_image("fine.exr", 100, 80, pixels=ramp)
    assert "bands" not in tonetool("fine.exr", "--qc").out
    make_image("coarse.exr", 100, 80, pixels=np.round(ramp * 255) / 255)
    ran = tonetool("coarse.exr", "--qc", "--warnings-exit", status=2)
    assert "warning bands: " in ran.out
    assert "bands" not in tonetool("coarse.exr", "--qc:bands=200").out
    tonetool("coarse.exr", "-d", "uint8", "-o", "coarse.png")
    assert "bands" not in tonetool("coarse.png", "--qc").out


def test_black_frames_by_their_alpha(check, tmp_path):
    for alpha, status, severity in ((1, 3, "error"), (0, 3, "error"), (None, 2, "warning")):
        for number in range(1, make_shot.FRAMES + 1):
            frame = make_shot.make_frame(number)
            if alpha is None:
                make_shot.without("Combined.A")(frame)
            if number == 6:
                make_shot.blacken(*make_shot.COLORS)(frame)
                frame.layers["Alpha"] = np.full_like(frame.layers["Alpha"], alpha or 0)
            frame.write(tmp_path / f"shot.{number:04d}.exr")
        ran, found = check(status)
        assert found == [(6, "black")]
        assert f"qc: frame 6: {severity} black: the picture is black" in ran.out


@pytest.mark.parametrize("share, status, severity",
                         [(0.05, 0, "info"), (0.3, 2, "warning"), (0.7, 3, "error")])
def test_an_empty_frame_by_what_is_in_the_frames_beside_it(check, tmp_path, share, status, severity):
    """A small element has left the picture; one that fills the next frame was not rendered."""
    for number in range(1, make_shot.FRAMES + 1):
        frame = make_shot.make_frame(number)
        alpha = frame.layers["Alpha"]
        rows = 0 if number == 6 else round(share * alpha.shape[0])
        alpha[:] = 0
        alpha[:rows] = 1
        for name in make_shot.COLORS:
            frame.layers[name][rows:] = 0
        frame.write(tmp_path / f"shot.{number:04d}.exr")
    ran, found = check(status)
    assert (6, "black") in found
    assert f"qc: frame 6: {severity} black: the picture is black" in ran.out


@pytest.mark.parametrize("frames", [1, 6])
def test_nothing_in_any_frame_is_an_error(tonetool, tmp_path, frames):
    for number in range(1, frames + 1):
        frame = make_shot.make_frame(number)
        make_shot.blacken(*make_shot.COLORS)(frame)
        frame.layers["Alpha"][:] = 0
        frame.write(tmp_path / f"shot.{number:04d}.exr")
    ran = tonetool("shot.#.exr", "--qc", status=3)
    assert ran.out.count("error black: the picture is black") == frames


def test_a_fade_to_black_is_told_and_no_fault(check, tmp_path):
    for number in range(1, make_shot.FRAMES + 1):
        frame = make_shot.make_frame(number)
        make_shot.light(frame, max(0, min(1, (18 - number) / 8)))
        frame.write(tmp_path / f"shot.{number:04d}.exr")
    ran, found = check(0)
    assert found == [(18, "black"), (19, "black"), (20, "black")]
    assert "qc: frame 18: info black: the picture is black at the end of a fade" in ran.out


def test_a_hold_at_the_end_may_be_made_an_error(check, tmp_path):
    make_shot.make_shot(tmp_path, "frozen-at-the-end")
    assert check(3, "--qc:frozen=error")[1] == [(16, "frozen")]
    assert check(2, "--qc:frozen=4")[1] == [(16, "frozen")]
    assert check(2, "--qc:frozen=6")[1] == [(16, "duplicate")]


def test_matte_bars_are_told(check, tmp_path):
    for number in range(1, make_shot.FRAMES + 1):
        frame = make_shot.make_frame(number)
        for layer in (frame.layers[name] for name in make_shot.COLORS):
            layer[:10] = layer[-8:] = 0
        frame.write(tmp_path / f"shot.{number:04d}.exr")
    ran, found = check(0)
    assert found == [(1, "bars"), (1, "bars")]
    assert "info bars: 96x10 pixels at (0, 0) are all 0 in all frames" in ran.out


def test_one_picture(tonetool):
    ran = tonetool(TESTIMAGES / "nan_center.exr", "--qc", status=3)
    assert "error nan: the picture is not a number in " in ran.out
    assert "faults" not in tonetool(TESTIMAGES / "cornell_ref.exr", "--qc").out
    assert "deep" in tonetool(TESTIMAGES / "deep.exr", "--qc", status=1).err


@pytest.mark.parametrize("folder", [TESTIMAGES / "anim", SHARED])
def test_the_light_group_that_goes_black(tonetool, tmp_path, folder):
    if not folder.exists():
        pytest.skip(f"no folder {folder}")
    ran = tonetool("--frames", "1-8", folder / "test.#.exr", "--qc", "--json", "check.json",
                   "--csv", "check.csv", "--junit", "check.xml", status=3)
    report = json.loads((tmp_path / "check.json").read_text())
    assert {frame for frame, _ in faults(tmp_path / "check.json")} == {5}
    assert report["worst"] == [{"frame": 5}]
    first = next(f for f in report["frames"] if f["frame"] == 5)["faults"][0]
    assert (first["code"], first["layer"]) == ("blacklayer", "ViewLayer.Combined_neonC")
    files = [(tmp_path / name).read_text() for name in ("check.csv", "check.xml")]
    for text in (ran.out, *files):
        assert "neonC is black in frame 5" in text
    tonetool("--frames", "1-8", folder / "ref.#.exr", "--qc", "--warnings-exit")


@pytest.mark.parametrize("more", [[], ["--colormap", "magma"], ["--ch", "Y", "--chnames", "R"]])
def test_an_error_map_is_no_render(tonetool, make_image, more):
    make_image("a.exr")
    make_image("b.exr", seed=2)
    ran = tonetool("a.exr", "b.exr", "--hdrflip", *more, "--qc", status=1)
    assert "--qc before the comparison" in ran.err
    tonetool("a.exr", "b.exr", "--qc", "--hdrflip")
