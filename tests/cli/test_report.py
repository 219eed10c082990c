# SPDX-License-Identifier: BSD-3-Clause
"""--report, --contactsheet and --pictures, without a browser; test_report_page.py opens the page."""

import base64
import json
import math
import re
import shutil
import signal
import subprocess
import time

import make_shot
import numpy as np
import OpenImageIO as oiio
import pytest

FLIP = "--hdrflip:exposures=shot:fail=0.7:quantity=p99"


@pytest.fixture
def anim(tmp_path, testimages):
    """The eight pairs, the last without its reference."""
    for file in (testimages / "anim").glob("*.exr"):
        shutil.copy(file, tmp_path / file.name)
    (tmp_path / "ref.0008.exr").unlink()
    return tmp_path


def blocks(page):
    """The data in a page by its id."""
    found = re.findall(r'<script type="application/json" id="([^"]+)">(.*?)</script>', page, re.S)
    return {name: json.loads(text) for name, text in found}


def frames(first, last):
    return ["--frames", f"{first}-{last}", "-q", "ref.#.exr", "test.#.exr"]


def test_a_page_of_all_frames(tonetool, anim):
    tonetool(*frames(1, 8), FLIP, "--report", "page.html", status=1)
    data = blocks((anim / "page.html").read_text(encoding="utf-8"))
    result = data["result"]["shot"]
    assert result["verdict"] == "missing"
    assert [result["frames"][index]["frame"] for index in result["worst"]] == [8, 5]
    assert {name for name in data if name.startswith("full-")} == {f"full-{i}" for i in range(7)}
    worst = data["full-4"]
    assert {name for name in data if name.startswith("large-")} == {f"large-{i}" for i in range(7)}
    assert {name for name in data if name.startswith("exact-")} == {"exact-4"}
    assert "pictures" not in worst  # those of the full size are there instead
    for picture in (worst["error"], worst["stops"], data["large-4"]["reference"],
                    data["large-4"]["test"], worst["near"]["test"]["high"],
                    data["exact-4"]["reference"]["low"], worst["spots"][0]["test"]):
        assert re.match(r"data:image/(jpeg|png);base64,[A-Za-z0-9+/=]{300,}$", picture)
    assert [worst["spots"][0]["x"], worst["spots"][0]["y"]] == (
        result["frames"][4]["measurements"][0]["worst"])


def test_the_result_is_the_same_with_and_without_a_report(tonetool, anim):
    line = [*frames(1, 8), FLIP, "-o", "map.#.exr"]
    tonetool(*line, "--json", "plain.json", status=1)
    plain = [(anim / f"map.000{i}.exr").read_bytes() for i in range(1, 8)]
    tonetool(*line, "--json", "shown.json", "--report", "page.html", status=1)
    assert (anim / "plain.json").read_bytes() == (anim / "shown.json").read_bytes()
    hashes = [tonetool("--hash", f"map.000{i}.exr").out for i in range(1, 8)]
    for i, old in enumerate(plain, 1):
        (anim / f"map.000{i}.exr").write_bytes(old)
    assert hashes == [tonetool("--hash", f"map.000{i}.exr").out for i in range(1, 8)]


def test_the_page_does_not_depend_on_how_it_was_made(tonetool, anim):
    tonetool(*frames(1, 8), FLIP, "--report", "one.html", "--json", "one.json", status=1)
    tonetool("--parallel-frames", "3", *frames(1, 8), FLIP, "--report", "three.html", status=1)
    assert (anim / "one.html").read_bytes() == (anim / "three.html").read_bytes()
    fixed = FLIP.replace("=shot", "=one.json")
    for first, last, status in ((6, 8, 1), (1, 3, 0), (4, 5, 3)):
        tonetool(*frames(first, last), fixed, "--json", f"{first}.json", "--pictures", "kept",
                 status=status)
    tonetool("--merge", "6.json", "1.json", "4.json", "--pictures", "kept", "--report",
             "merged.html", "--contactsheet", "merged.png", status=1)
    assert (anim / "one.html").read_bytes() == (anim / "merged.html").read_bytes()


def test_a_killed_run_goes_on_and_ends_with_the_same_page(program, tonetool, anim):
    tonetool(*frames(1, 8), FLIP, "--report", "whole.html", status=1)
    line = [*frames(1, 8), FLIP, "--state", "state", "--report", "page.html"]
    for wait in (0.15, 0.3, 0.45, 0.6):
        with subprocess.Popen([program, *line], cwd=anim, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as running:
            time.sleep(wait)
            running.send_signal(signal.SIGKILL)
    tonetool(*line, status=1)
    assert (anim / "page.html").read_bytes() == (anim / "whole.html").read_bytes()
    left = {file.name for file in (anim / "state" / "pictures").iterdir()}
    assert left == {f"000{i}.{size}.json" for i in range(1, 8)
                    for size in ("full", "large", "small")} | {"0005.exact.json"}
    before = {file: file.stat().st_mtime_ns for file in (anim / "state" / "pictures").iterdir()}
    tonetool(*line, status=1)
    assert before == {file: file.stat().st_mtime_ns
                      for file in (anim / "state" / "pictures").iterdir()}


def test_pictures_of_files_that_changed_are_drawn_anew(tonetool, anim):
    line = [*frames(4, 5), "--hdrflip", "--state", "state"]
    tonetool(*line, "--report", "page.html")
    old = blocks((anim / "page.html").read_text())
    shutil.copy(anim / "test.0006.exr", anim / "test.0005.exr")
    tonetool(*line)  # without pictures: those in the folder are of the old file
    tonetool(*line, "--report", "page.html")
    new = blocks((anim / "page.html").read_text())
    assert new["small-0"] == old["small-0"]
    assert new["small-1"]["test"] != old["small-1"]["test"]


def halves(numbers, read, folder):
    """The half floats of a block of numbers, as the page joins them."""
    parts = []
    for key in ("high", "low"):
        (folder / f"{key}.png").write_bytes(base64.b64decode(numbers[key].split(",")[1]))
        source = oiio.ImageInput.open(str(folder / f"{key}.png"))
        parts.append(source.read_image("uint8").astype("uint16"))
        source.close()
    return parts[0] << 8 | parts[1]


def beauty(file):
    source = oiio.ImageInput.open(str(file))
    names = [f"ViewLayer.Combined.{c}" for c in "RGB"]
    pixels = source.read_image("float")[..., [source.spec().channelnames.index(n) for n in names]]
    source.close()
    return pixels


def test_a_comparison_after_qc_gives_the_pictures(tonetool, anim):
    tonetool(*frames(5, 5), "--qc", FLIP, "--report", "page.html", status=3)
    data = blocks((anim / "page.html").read_text())
    assert data["large-0"]["reference"] and data["large-0"]["test"] and data["full-0"]["error"]
    # Where nothing is compared after all, the image itself is drawn.
    tonetool("--frames", "5", "-q", "test.#.exr", "--qc", "--report", "page.html")
    data = blocks((anim / "page.html").read_text())
    assert data["large-0"]["reference"] == "" and data["large-0"]["test"]


def test_numbers_are_those_of_the_file_and_more_of_them_where_asked(tonetool, anim, read):
    line = [*frames(4, 6), FLIP, "--report:pixels=2", "page.html"]
    tonetool(*line, status=3)
    data = blocks((anim / "page.html").read_text())
    assert {name for name in data if name.startswith("exact-")} == {"exact-1", "exact-2"}
    exact = data["exact-1"]
    assert (exact["columns"], exact["rows"]) == beauty(anim / "test.0005.exr").shape[1::-1]
    file = np.clip(beauty(anim / "test.0005.exr"), -65504, 65504).astype("float16")
    bits = file.view("uint16").astype("uint32")
    rounded = ((bits & 0x7fff) + 4) >> 3 << 3 | (bits & 0x8000)
    assert (halves(exact["test"], read, anim) == rounded).all()
    near = data["full-1"]["near"]
    x, y = near["x"], near["y"]
    assert (halves(near["test"], read, anim)
            == rounded[y:y + near["height"], x:x + near["width"]]).all()
    ran = tonetool(*frames(4, 6), FLIP, "--report:pixels=30", "page.html", status=1)
    assert "--report: pixels" in ran.err and "24" in ran.err
    ran = tonetool(*frames(4, 6), FLIP, "--pictures:size=3", "kept", status=1)
    assert 'no modifier "size"' in ran.err


def test_a_page_takes_no_more_than_it_may(tonetool, anim):
    tonetool(*frames(1, 7), FLIP, "--report:size=1", "page.html", status=3)
    assert (anim / "page.html").stat().st_size < 1 << 20
    page = (anim / "page.html").read_text()
    assert "this file takes at most 1 MB" in page
    assert "in full of 0 of 7 frames" in page


def test_pictures_of_an_earlier_version_are_left_out_and_that_is_said(tonetool, anim):
    line = [*frames(4, 5), "--hdrflip", "--state", "state", "--report", "page.html"]
    tonetool(*line)
    whole = (anim / "page.html").read_bytes()
    for file in (anim / "state" / "pictures").iterdir():
        file.write_text('{"of":"0123456789abcdef","test":"x","error":"","spots":[]}')
    (anim / "kept").mkdir()
    shutil.copy(anim / "state" / "pictures" / "0004.small.json", anim / "kept")
    ran = tonetool(*line)
    assert "are in the form of an earlier version" in ran.err
    assert (anim / "page.html").read_bytes() == whole
    tonetool(*frames(4, 5), "--hdrflip", "--json", "a.json")
    ran = tonetool("--merge", "a.json", "--pictures", "kept", "--report", "page.html")
    assert "are in the form of an earlier version" in ran.err
    assert set(blocks((anim / "page.html").read_text())) == {"result"}


def test_links_in_the_folder_of_a_state_are_not_followed(tonetool, anim):
    line = [*frames(4, 5), "--hdrflip", "--state", "state", "--report", "page.html"]
    (anim / "state").mkdir()
    (anim / "out").mkdir()
    (anim / "state" / "pictures").symlink_to(anim / "out")
    ran = tonetool(*line, status=1)
    assert '"state/pictures" is a symbolic link, which is not followed here' in ran.err
    assert not list((anim / "out").iterdir()) and not (anim / "page.html").exists()
    (anim / "state" / "pictures").unlink()
    (anim / "state" / "pictures").mkdir()
    planted = anim / "state" / "pictures" / "0004.small.json"
    planted.symlink_to(anim / "out" / "target")
    ran = tonetool(*line, status=1)
    assert '0004.small.json": is a symbolic link' in ran.err
    assert not list((anim / "out").iterdir())
    # The user's own folder may be a link where its name says so.
    (anim / "kept").symlink_to(anim / "out")
    tonetool(*frames(4, 5), "--hdrflip", "--pictures", "kept/", "--json", "a.json")
    assert list((anim / "out").iterdir())


def test_a_merge_without_pictures_is_a_page_without_pictures(tonetool, anim):
    tonetool(*frames(5, 5), "--hdrflip", "--json", "a.json")
    tonetool("--merge", "a.json", "--report", "page.html")
    page = (anim / "page.html").read_text()
    assert set(blocks(page)) == {"result"}
    assert "in full of 0 of 1 frames" in page
    ran = tonetool("--merge", "a.json", "--pictures", "nowhere", "--report", "b.html", status=1)
    assert 'there is no folder "nowhere"' in ran.err
    assert not (anim / "b.html").exists()


@pytest.mark.parametrize("command", ["--ldrflip", "--flipdiff", "--flipdiff:hdr=0",
                                     "--errormap:metric=smape", "--errormap:metric=mse"])
def test_other_measures_have_pictures_too(tonetool, anim, command):
    tonetool(*frames(5, 6), command, "--report", "page.html")
    data = blocks((anim / "page.html").read_text())
    full = data["full-0"]
    assert data["large-0"]["reference"] and data["large-0"]["test"]
    assert bool(full["error"]) == (command != "--errormap:metric=mse")
    assert bool(full["stops"]) == (command == "--flipdiff")
    if command in ("--ldrflip", "--flipdiff:hdr=0"):  # what is compared is what is shown
        assert full["start"] == 0


def test_images_that_do_not_fit_into_the_memory_have_no_pictures(tonetool, anim, make_image):
    make_image("a.0001.exr", 2000, 2000, seed=1)
    make_image("b.0001.exr", 2000, 2000, seed=2)
    line = ["--memory", "220M", "--frames", "1", "a.#.exr", "b.#.exr", "--hdrflip", "--report",
            "page.html"]
    ran = tonetool(*line)
    assert "no pictures for the report: the images do not fit into --memory" in ran.out
    assert set(blocks((anim / "page.html").read_text())) == {"result"}
    line[1] = "600M"
    tonetool(*line)
    assert "full-0" in blocks((anim / "page.html").read_text())


def test_a_contact_sheet_shows_every_frame(tonetool, anim, read):
    tonetool(*frames(1, 8), FLIP, "--contactsheet", "sheet.png", status=1)
    pixels, spec = read("sheet.png")
    assert spec.nchannels == 3 and spec.width > 3 * 160
    orange = (abs(pixels - [1.0, 0.45, 0.15]) < 0.01).all(axis=2)
    violet = (abs(pixels - [0.91, 0.60, 0.83]) < 0.01).all(axis=2)
    for frame_color, row, column in ((orange, 1, 1), (violet, 2, 1)):
        cell = frame_color[row * spec.height // 3:(row + 1) * spec.height // 3,
                           column * spec.width // 3:(column + 1) * spec.width // 3]
        assert cell.sum() > 500
        assert frame_color.sum() == cell.sum()


@pytest.mark.parametrize("word", ["--report", "--contactsheet"])
def test_a_file_that_cannot_be_written(tonetool, anim, word):
    ran = tonetool(*frames(5, 6), "--hdrflip", word, "nowhere/out.png", status=1)
    assert f'{word}: there is no folder "nowhere"' in ran.err
    assert "mean" not in ran.out  # before the work
    ran = tonetool(*frames(5, 6), "--hdrflip", word, status=1)
    assert "missing argument" in ran.err
    ran = tonetool(*frames(5, 6), "--hdrflip", "--contactsheet", "out.nothing", status=1)
    assert "out.nothing" in ran.err


def test_a_view_or_a_frame_does_not_lead_out_of_the_folder(tonetool, anim):
    for part in ("ref", "test"):
        (anim / f"{part}.0001.exr").rename(anim / f"{part}.up_0001.exr")
    tonetool("--views", "up", "--frames", "1", "-q", "ref.%V_#.exr", "test.%V_#.exr", "--hdrflip",
             "--pictures", "kept", "--report", "page.html")
    assert {file.name for file in (anim / "kept").iterdir()} == {
        f"0001.up.{size}.json" for size in ("full", "large", "exact", "small")}


def test_faults_are_seen_from_near(tonetool, anim, read):
    """Frame 5 without a light group, and with a NaN that is put in here."""
    file = anim / "test.0003.exr"
    source = oiio.ImageInput.open(str(file))
    spec, pixels = source.spec(), source.read_image("float")
    source.close()
    pixels[10, 20, spec.channelnames.index("ViewLayer.Combined.R")] = math.nan
    out = oiio.ImageOutput.create(str(file))
    assert out.open(str(file), spec) and out.write_image(pixels)
    out.close()
    tonetool("--frames", "1-7", "-q", "test.#.exr", "--qc", "--report", "page.html", status=3)
    data = blocks((anim / "page.html").read_text())
    found = data["result"]["shot"]["frames"]
    codes = {frame["frame"]: {fault["code"] for fault in frame.get("faults", [])}
             for frame in found}
    assert "nan" in codes[3] and "blacklayer" in codes[5]
    assert [20, 10] in [fault.get("position") for fault in found[2]["faults"]]
    (spot,) = [spot for spot in data["full-2"]["spots"] if (spot["x"], spot["y"]) == (20, 10)]
    (anim / "spot.png").write_bytes(base64.b64decode(spot["test"].split(",")[1]))
    near, _ = read("spot.png")
    assert tuple(near[10, 16]) == (1, 0, 1)  # the image's edge is above
    assert spot["reference"] == ""
    assert data["large-4"]["reference"] == ""
    assert data["full-4"]["near"]["reference"] is None
    assert data["full-4"]["error"] == ""


def pixels_of(uri, folder):
    file = folder / "picture.png"
    file.write_bytes(base64.b64decode(uri.split(",", 1)[1]))
    return oiio.ImageInput.open(str(file)).read_image("float")


def test_layers_with_a_fault_are_in_the_page(tonetool, tmp_path):
    for folder, fault in (("a", None), ("b", "black-layer")):
        (tmp_path / folder).mkdir()
        make_shot.make_shot(tmp_path / folder, fault)
    tonetool("--frames", "1-8", "a/shot.#.exr", "b/shot.#.exr", "--against", "--qc", "--report",
             "page.html", status=3)
    data = blocks((tmp_path / "page.html").read_text(encoding="utf-8"))
    assert [name for name in data if name.startswith("layers-")] == ["layers-4"]
    layers = {one["layer"]: one for one in data["layers-4"]}
    key = layers["ViewLayer.Combined_key"]
    test, reference = (pixels_of(key[side], tmp_path) for side in ("test", "reference"))
    assert test.shape == (make_shot.HEIGHT, make_shot.WIDTH, 3)
    assert test.max() == 0 and reference.max() == 1
    # As light: sRGB of the value over that of 99 % of all values.
    file = oiio.ImageInput.open(str(tmp_path / "a/shot.0005.exr"))
    first = file.spec().channelindex("ViewLayer.Combined_key.R")
    light = file.read_image("float")[..., first:first + 3]
    light = np.clip(light / np.quantile(light, 0.99), 0, 1)
    code = np.where(light > 0.0031308, 1.055 * light ** (1 / 2.4) - 0.055, 12.92 * light)
    assert np.abs(reference - code).max() < 0.02
    # A merge reads the files again; where they are gone there are no pictures.
    tonetool("--frames", "1-8", "a/shot.#.exr", "b/shot.#.exr", "--against", "--qc", "--exit-zero",
             "--json", "c.json", "--pictures", "p")
    shutil.rmtree(tmp_path / "b")
    (tmp_path / "a" / "shot.0005.exr").unlink()
    tonetool("--merge", "c.json", "--pictures", "p", "--report", "page.html", status=3)
    data = blocks((tmp_path / "page.html").read_text(encoding="utf-8"))
    assert "full-4" in data and "layers-4" not in data
