# SPDX-License-Identifier: BSD-3-Clause
"""Checks of sequences: every frame has a result, and the worst of them is the exit status."""

import csv
import io
import json
import os
import shutil
import signal
import subprocess
import time
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from conftest import TESTIMAGES, call

ANIM = TESTIMAGES / "anim"
FLIP = "--hdrflip:layer=ViewLayer.Combined:quantity=p99:fail=0.5:print=0"


@pytest.fixture
def anim(tmp_path):
    """The eight frames in the folder that the program runs in."""
    for file in ANIM.glob("*.exr"):
        shutil.copy(file, tmp_path)
    return tmp_path


def flip(exposures="frame"):
    return f"{FLIP}:exposures={exposures}"


def pair(*words):
    return ["ref.#.exr", "test.#.exr", *words]


def statuses(folder, name="c.json"):
    return {frame["frame"]: frame["status"] for frame in load(folder / name)["frames"]}


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


def image_bytes(make_image, tmp_path, name, **options):
    make_image(name, **options)
    return (tmp_path / name).read_bytes()


# ---- what is found

@pytest.mark.parametrize("exposures", ["frame", "shot"])
def test_the_frame_without_its_light_group_is_found(tonetool, anim, exposures):
    ran = tonetool(*pair(flip(exposures), "--json", "c.json", "--csv", "c.csv", "--junit", "c.xml"),
                   status=3)
    assert "check: failed, 8 frames: 1 failed, 7 passed; worst: frame 5" in ran.out
    found = load(anim / "c.json")
    assert found["verdict"] == "failed"
    assert found["worst"] == [{"frame": 5}]
    assert [f["frame"] for f in found["frames"]] == list(range(1, 9))
    p99 = {f["frame"]: f["measurements"][0]["quantities"]["p99"] for f in found["frames"]}
    assert max(p99, key=p99.get) == 5
    assert ("exposures" in found) == (exposures == "shot")
    rows = list(csv.DictReader(io.StringIO((anim / "c.csv").read_text())))
    assert [row["frame"] for row in rows if row["status"] == "failed"] == ["5"]
    assert float(rows[4]["hdrflip.p99"]) == p99[5]
    suite = ElementTree.parse(anim / "c.xml").getroot().find("testsuite")
    assert suite.get("tests") == "8" and suite.get("failures") == "1" and suite.get("errors") == "0"
    failed = [case.get("name") for case in suite.findall("testcase") if case.find("failure") is not None]
    assert failed == ["frame 0005"]


def test_without_a_threshold_nothing_is_passed(tonetool, anim):
    ran = tonetool(*pair("--hdrflip:layer=ViewLayer.Combined:print=0", "--json", "c.json", "--junit",
                         "c.xml"))
    assert "check: measured" in ran.out
    assert set(statuses(anim).values()) == {"measured"}
    assert load(anim / "c.json")["worst"] == [{"frame": 5}]
    suite = ElementTree.parse(anim / "c.xml").getroot().find("testsuite")
    assert suite.get("skipped") == "8"


def test_nothing_measured_is_an_error(tonetool, anim):
    tonetool(*pair("--pop", "--pop", "--json", "c.json"), status=1)
    assert set(statuses(anim).values()) == {"error"}
    tonetool(*pair("--if", "0", flip(), "--endif", "--json", "c.json"), status=1)
    assert set(statuses(anim).values()) == {"error"}


def test_the_json_is_what_its_schema_says(tonetool, anim):
    schema = pytest.importorskip("jsonschema", reason="no python3-jsonschema here")
    damage(anim)
    tonetool(*pair(flip("shot"), "--json", "c.json"), status=1)
    description = load(TESTIMAGES.parent / "src" / "sequence" / "check.schema.json")
    schema.Draft7Validator.check_schema(description)
    found = load(anim / "c.json")
    schema.validate(found, description)
    found["frames"][0]["unknown"] = 1
    with pytest.raises(schema.ValidationError):
        schema.validate(found, description)


# ---- frames that cannot be compared

def damage(anim):
    (anim / "test.0002.exr").unlink()
    whole = (anim / "test.0003.exr").read_bytes()
    (anim / "test.0003.exr").write_bytes(whole[:len(whole) // 2])
    (anim / "ref.0004.exr").write_bytes(b"not an image")
    shutil.copy(TESTIMAGES / "cornell_ref.exr", anim / "test.0006.exr")
    (anim / "ref.0007.exr").unlink()
    (anim / "test.0007.exr").unlink()
    (anim / "test.0008.exr").write_bytes(b"")
    shutil.copy(ANIM / "ref.0001.exr", anim / "ref.0009.exr")


DAMAGED = {1: "passed", 2: "missing", 3: "unreadable", 4: "unreadable", 5: "failed",
           6: "size mismatch", 7: "missing", 8: "unreadable", 9: "missing"}


@pytest.mark.parametrize("exposures", ["frame", "shot"])
def test_every_bad_frame_has_its_own_status_and_the_rest_goes_on(tonetool, anim, exposures):
    damage(anim)
    ran = tonetool(*pair(flip(exposures), "--json", "c.json", "--csv", "c.csv", "--junit", "c.xml"),
                   status=1)
    assert statuses(anim) == DAMAGED
    found = load(anim / "c.json")
    assert found["counts"]["missing"] == 3
    messages = {f["frame"]: f.get("message", "") for f in found["frames"]}
    assert messages[2] == 'no file "test.0002.exr"'
    assert "ref.0004.exr" in messages[4] and "96x96" in messages[6]
    assert found["worst"][-1] == {"frame": 5}
    assert "(frame 2)" in ran.err
    suite = ElementTree.parse(anim / "c.xml").getroot().find("testsuite")
    assert (suite.get("failures"), suite.get("errors")) == ("1", "7")


@pytest.mark.parametrize("kind", ["bmp", "dpx", "exr", "hdr", "jpg", "png", "tga", "tif"])
def test_half_a_file_is_unreadable_in_every_format(tonetool, oiiotool, tmp_path, kind):
    oiiotool("--pattern", "noise", "128x128", "3", "-o", f"a.{kind}")
    whole = (tmp_path / f"a.{kind}").read_bytes()
    (tmp_path / f"b.{kind}").write_bytes(whole[:len(whole) // 2])
    tonetool(f"a.{kind}", f"b.{kind}", "--ldrflip:fail=0.999", "--json", "c.json", status=1)
    assert statuses(tmp_path) == {0: "unreadable"}
    (tmp_path / f"b.{kind}").write_bytes(b"")
    for more in ([], ["--json", "c.json"]):
        ran = tonetool(f"a.{kind}", f"b.{kind}", "--ldrflip:fail=0.999", *more, status=1)
        assert "it is empty (0 bytes)" in ran.err


def test_a_range_asks_for_frames_that_nobody_has(tonetool, anim):
    tonetool("--frames", "7-10", *pair(flip(), "--json", "c.json"), status=1)
    assert statuses(anim) == {7: "passed", 8: "passed", 9: "missing", 10: "missing"}


def test_pairs_are_made_by_number_not_by_place(tonetool, anim):
    (anim / "ref.0001.exr").unlink()
    (anim / "test.0008.exr").unlink()
    tonetool(*pair(flip(), "--json", "c.json"), status=1)
    assert statuses(anim) == {1: "missing", 2: "passed", 3: "passed", 4: "passed", 5: "failed",
                              6: "passed", 7: "passed", 8: "missing"}


def test_steps_are_no_holes(tonetool, anim):
    for number in (2, 4, 6, 8):
        (anim / f"ref.000{number}.exr").unlink()
        (anim / f"test.000{number}.exr").unlink()
    tonetool(*pair(flip(), "--json", "c.json"), status=3)
    assert sorted(statuses(anim)) == [1, 3, 5, 7]


def test_no_file_at_all_is_an_error(tonetool, tmp_path):
    ran = tonetool(*pair(flip(), "--json", "c.json"), status=1)
    assert 'no file matches "ref.#.exr"' in ran.err
    assert not os.listdir(tmp_path)


def test_one_side_without_any_file(tonetool, anim):
    for file in anim.glob("test.*"):
        file.unlink()
    tonetool(*pair(flip(), "--json", "c.json"), status=1)
    assert set(statuses(anim).values()) == {"missing"}


def test_a_pair_without_numbers(tonetool, anim):
    tonetool("ref.0005.exr", "test.0005.exr", flip(), "--json", "c.json", status=3)
    assert statuses(anim) == {0: "failed"}
    tonetool("ref.0005.exr", "gone.exr", flip(), "--json", "c.json", status=1)
    assert statuses(anim) == {0: "missing"}


def test_every_comparison_is_recorded(tonetool, anim):
    tonetool("--frames", "1-2", *pair(flip(), "ref.#.exr", "test.#.exr",
             "--ldrflip:layer=ViewLayer.Combined:print=0:fail=0.999", "ref.#.exr", "test.#.exr",
             "--errormap:metric=psnr:layer=ViewLayer.Combined:print=0:fail=10",
             "ref.#.exr", "test.#.exr", "--flipdiff:layer=ViewLayer.Combined:print=0",
             "ref.#.exr", "test.#.exr", "--fail", "100", "--warn", "100",
             "--diff", "--json", "c.json"))
    (first, _) = load(anim / "c.json")["frames"]
    assert [m["command"] for m in first["measurements"]] == ["hdrflip", "ldrflip", "errormap",
                                                             "flipdiff", "diff"]
    assert [m["status"] for m in first["measurements"]] == ["passed", "passed", "passed",
                                                            "measured", "passed"]
    assert first["measurements"][2]["thresholds"][0]["higher_is_better"] is True


def test_a_failing_diff_is_a_failed_frame(tonetool, anim):
    tonetool("--frames", "1-2", *pair("--diff", "--json", "c.json"), status=1)
    assert set(statuses(anim).values()) == {"failed"}


def test_warnings(tonetool, anim):
    words = pair("--hdrflip:layer=ViewLayer.Combined:quantity=p99:warn=0.5:print=0", "--json",
                 "c.json")
    tonetool(*words)
    assert statuses(anim)[5] == "warning" and statuses(anim)[4] == "passed"
    tonetool("--warnings-exit", *words, status=2)
    tonetool("--warnings-exit", *words, "--state", "s", status=2)
    tonetool(*words, "--state", "s")
    tonetool("--warnings-exit", *words, "--state", "s", status=2)


# ---- exposures of the shot

def test_a_shot_has_one_range(tonetool, anim):
    tonetool(*pair(flip("shot"), "--json", "c.json"), status=3)
    found = load(anim / "c.json")
    stops = {tuple(f["measurements"][0]["exposures"]) for f in found["frames"]}
    assert len(stops) == 1
    own = []
    for number in range(1, 9):
        ran = tonetool(f"ref.000{number}.exr", "--luminancestats:layer=ViewLayer.Combined")
        own.append((float(ran.fact("max")), float(ran.fact("median"))))
    assert found["exposures"]["max_luminance"] == pytest.approx(max(m for m, _ in own), rel=1e-5)
    assert found["exposures"]["median_luminance"] == pytest.approx(sorted(m for _, m in own)[4],
                                                                  rel=1e-5)
    assert found["exposures"]["frames"] == 8


def test_a_shot_of_one_frame_is_as_the_frame(tonetool, anim):
    words = ["--frames", "3", *pair()]
    tonetool(*words, flip("shot"), "--csv", "shot.csv")
    tonetool(*words, flip("frame"), "--csv", "frame.csv")
    assert (anim / "shot.csv").read_bytes() == (anim / "frame.csv").read_bytes()


def test_exposures_are_written_and_read(tonetool, anim):
    tonetool(*pair(flip("shot"), "--json", "shot.json"), status=3)
    tonetool(*pair(flip("shot"), "--statistics", "range.json"))
    tonetool(*pair(flip("range.json"), "--json", "read.json"), status=3)
    assert (anim / "read.json").read_bytes() == (anim / "shot.json").read_bytes()
    tonetool(*pair(flip("shot.json"), "--json", "again.json"), status=3)
    assert (anim / "again.json").read_bytes() == (anim / "shot.json").read_bytes()
    for part in ("1-3", "4", "5-8"):
        tonetool("--frames", part, *pair(flip("shot"), "--statistics", f"{part}.range"))
    tonetool("--merge", "5-8.range", "1-3.range", "4.range", "--statistics", "merged.range")
    assert (anim / "merged.range").read_bytes() == (anim / "range.json").read_bytes()


def test_exposures_of_the_shot_work_without_a_check(tonetool, anim):
    ran = tonetool(*pair(flip("shot").replace("print=0", "print=1")), status=3)
    assert len({line for line in ran.out.splitlines() if "exposures start" in line}) == 1


def test_a_black_frame_has_no_say(tonetool, make_image, tmp_path):
    for name in ("a", "b"):
        make_image(f"{name}.1.exr", pixels=np.zeros((12, 16, 3)))
        make_image(f"{name}.2.exr", seed=5)
    tonetool("a.#.exr", "b.#.exr", "--framepadding", "1", "--hdrflip:exposures=shot:fail=0",
             "--json", "c.json")
    assert load(tmp_path / "c.json")["exposures"]["frames"] == 1


@pytest.mark.parametrize("words, text", [
    (["--hdrflip:exposures=gone.json"], 'no file "gone.json"'),
    (["--hdrflip:exposures=ref.0001.exr"], "exposures of"),
    (["--hdrflip:exposures=shot:maxluminance=3"], "goes without maxluminance="),
    (["--hdrflip", "--statistics", "x.json"], "--hdrflip:exposures=shot"),
    (["--json"], "missing argument FILE"),
    (["--hdrflip", "--json", "--csv", "x"], "missing argument FILE"),
    (["--hdrflip", "--json", "x", "--json", "y"], "--json is given twice"),
    (["--hdrflip", "--json", "x", "--csv", "x"], "another's file"),
    (["--hdrflip", "--json", "no/x.json"], 'no folder "no"'),
    (["--hdrflip", "--json", "."], "is a folder"),
    (["--hdrflip", "--state", "ref.0001.exr"], "cannot make the folder"),
])
def test_errors(tonetool, anim, words, text):
    before = sorted(os.listdir(anim))
    assert text in tonetool("--frames", "1", *pair(*words), status=1).err
    assert sorted(set(os.listdir(anim)) - {"x", "y"}) == before


def test_a_full_disk_is_an_error(tonetool, anim):
    ran = tonetool("--frames", "1", *pair(flip(), "--json", "/dev/full"), status=1)
    assert "No space left" in ran.err


# ---- parts

SPLITS = {"one": [(n, n) for n in range(1, 9)], "fours": [(5, 8), (1, 4)], "all": [(1, 8)],
          "mixed": [(3, 3), (4, 8), (1, 2)]}


@pytest.mark.parametrize("split", SPLITS)
@pytest.mark.parametrize("exposures", ["frame", "shot"])
def test_parts_merge_to_the_bytes_of_the_single_run(tonetool, anim, split, exposures):
    (anim / "test.0007.exr").unlink()
    tonetool(*pair(flip(exposures), "--json", "whole.json", "--csv", "whole.csv"), status=1)
    own = "frame"
    if exposures == "shot":
        tonetool(*pair(flip("shot"), "--statistics", "range.json"), status=1)
        own = "range.json"
    for begin, end in SPLITS[split]:
        call(os.environ["TONETOOL"], ["--frames", f"{begin}-{end}", *pair(flip(own)), "--jobs",
                                      "2", "--json", f"part{begin}.json"], anim)
    parts = [f"part{begin}.json" for begin, _ in SPLITS[split]]
    tonetool("--merge", *parts, "--json", "merged.json", "--csv", "merged.csv", status=1)
    assert (anim / "merged.json").read_bytes() == (anim / "whole.json").read_bytes()
    assert (anim / "merged.csv").read_bytes() == (anim / "whole.csv").read_bytes()


def test_frames_that_no_part_has_are_errors(tonetool, anim):
    tonetool("--frames", "1-3", *pair(flip(), "--json", "a.json"))
    tonetool("--merge", "a.json", "--json", "c.json")
    ran = tonetool("--merge", "a.json", "b.json", "--frames", "1-5", "--json", "c.json", status=1)
    assert 'no file "b.json"' in ran.err
    assert statuses(anim) == {1: "passed", 2: "passed", 3: "passed", 4: "error", 5: "error"}


def test_views_are_frames_of_their_own(tonetool, make_image, tmp_path):
    for view in ("left", "right"):
        for number in (1, 2, 3):
            make_image(f"r_{view}.{number}.exr")
            make_image(f"t_{view}.{number}.exr")
    (tmp_path / "t_right.2.exr").unlink()
    words = ["r_%V.#.exr", "t_%V.#.exr", "--framepadding", "1", "--hdrflip:fail=0"]
    tonetool(*words, "--json", "c.json", status=1)
    found = load(tmp_path / "c.json")["frames"]
    assert [(f["frame"], f["view"], f["status"]) for f in found] == [
        (1, "left", "passed"), (1, "right", "passed"), (2, "left", "passed"),
        (2, "right", "missing"), (3, "left", "passed"), (3, "right", "passed")]
    tonetool("--frames", "3", *words, "--json", "part.json")
    tonetool("--merge", "part.json", "--frames", "3", "--json", "c.json")
    tonetool("--merge", "part.json", "--frames", "2-3", "--json", "c.json", status=1)
    found = load(tmp_path / "c.json")["frames"]
    assert [(f["frame"], f["view"], f["status"]) for f in found] == [
        (2, "left", "error"), (2, "right", "error"), (3, "left", "passed"), (3, "right", "passed")]


@pytest.mark.parametrize("words, text", [
    ([], "no part"),
    (["gone.json"], 'no file "gone.json"'),
    (["a.json", "a.json"], "there twice"),
    (["a.json", "b.json"], "not of the same check"),
    (["bad.json"], '"bad.json"'),
    (["a.json", "--hdrflip"], "takes results alone"),
    (["a.json", "--state", "s"], "exclude each other"),
])
def test_parts_that_do_not_fit(tonetool, anim, words, text):
    tonetool("--frames", "1", *pair(flip(), "--json", "a.json"))
    tonetool("--frames", "2", *pair(flip() + ":ppd=60", "--json", "b.json"))
    (anim / "bad.json").write_text("{}")
    assert text in tonetool("--merge", *words, "--json", "c.json", status=1).err
    assert not (anim / "c.json").exists()


def forge(file, change):
    """Frame 5, the bad one, is called good; so is it in what the file says of all frames."""
    part = load(file)
    bad = next(frame for frame in part["frames"] if frame["frame"] == 5)
    measured = bad["measurements"][0]
    part["counts"].update(passed=len(part["frames"]), failed=0)
    change(part, measured, measured["thresholds"][0])
    bad.pop("message", None)
    bad["status"] = measured["status"] = part["verdict"] = "passed"
    (file.parent / "forged.json").write_text(json.dumps(part))


def zero(part, measured, threshold):
    measured["quantities"][threshold["quantity"]] = threshold["value"] = 0.0


DIFFERS = {"quantity": "differing-pixels", "value": 0.0, "higher_is_better": False, "fail": 0.0}


@pytest.mark.parametrize("words, change, text", [
    (["--hdrflip:fail=0.1"], lambda p, m, t: t.update(higher_is_better=True), "lower is"),
    (["--hdrflip:fail=0.1"], zero, "has a mean of 0"),
    (["--hdrflip:fail=0.1"], lambda p, m, t: m.update(command="diff", thresholds=[DIFFERS]),
     "which the check does not have"),
    (["--hdrflip:fail=0.1"], lambda p, m, t: p["frames"].pop(0), "counts/"),
    (["--errormap:metric=psnr:fail=60"], lambda p, m, t: t.update(higher_is_better=False),
     "higher is"),
    (["--diff"], lambda p, m, t: t.update(value=0.0), "above a limit of the check"),
    (["--diff"], lambda p, m, t: t.update(fail=1e9), "but the check's limit is 0"),
])
def test_a_part_that_contradicts_itself_or_its_check(tonetool, anim, words, change, text):
    call(os.environ["TONETOOL"], ["--frames", "4-5", *pair(*words, "--json", "a.json")], anim)
    forge(anim / "a.json", change)
    ran = tonetool("--merge", "forged.json", "--json", "c.json", status=1)
    assert '"forged.json": ' in ran.err and text in ran.err
    assert not (anim / "c.json").exists()


def test_without_a_limit_the_worst_frame_is_the_lowest_where_higher_is_better(tonetool, anim):
    for metric in ("psnr", "mpsnr"):
        tonetool("--frames", "4-6", *pair(f"--errormap:metric={metric}", "--json", "c.json"))
        found = load(anim / "c.json")
        value = {f["frame"]: f["measurements"][0]["quantities"][metric] for f in found["frames"]}
        assert found["worst"] == [{"frame": min(value, key=lambda one: float(value[one]))}]


# ---- state

def test_a_state_gives_the_same_bytes_and_what_has_changed_is_checked_anew(tonetool, anim):
    words = pair(flip("shot"), "--json", "c.json", "-o", "map.#.exr")
    first = tonetool(*words, "--state", "s", status=3)
    bytes_of_first = (anim / "c.json").read_bytes()
    kept = {file: file.stat().st_mtime_ns for file in (anim / "s").iterdir()}
    assert len(kept) == 16
    again = tonetool(*words, "--state", "s", status=3)
    assert again.out == first.out and (anim / "c.json").read_bytes() == bytes_of_first
    assert {file: file.stat().st_mtime_ns for file in (anim / "s").iterdir()} == kept

    shutil.copy(ANIM / "ref.0005.exr", anim / "test.0005.exr")
    (anim / "map.0003.exr").unlink()
    tonetool(*words, "--state", "s")
    assert statuses(anim)[5] == "passed"
    assert (anim / "map.0003.exr").exists()
    changed = {file.name for file in kept if file.stat().st_mtime_ns != kept[file]}
    assert {"frame.0003.json", "frame.0005.json"} <= changed
    assert "frame.0001.json" not in changed


def test_a_missing_frame_that_comes_is_checked(tonetool, anim):
    (anim / "test.0002.exr").unlink()
    tonetool(*pair(flip(), "--json", "c.json", "--state", "s"), status=1)
    shutil.copy(ANIM / "test.0002.exr", anim / "test.0002.exr")
    tonetool(*pair(flip(), "--json", "c.json", "--state", "s"), status=3)
    assert statuses(anim)[2] == "passed"


CONFIG = """ocio_profile_version: 2
search_path: .
environment: {LK: lut.spi1d}
roles: {default: lin_srgb, scene_linear: lin_srgb, data: lin_srgb}
file_rules: [!<Rule> {name: Default, colorspace: default}]
displays: {sRGB: [!<View> {name: V, colorspace: out}]}
colorspaces:
  - !<ColorSpace> {name: lin_srgb, encoding: scene-linear}
  - !<ColorSpace> {name: out, from_scene_reference: !<FileTransform> {src: $LK, interpolation: linear}}
"""


def write_lut(path, top):
    path.write_text(f"Version 1\nFrom 0.0 1.0\nLength 2\nComponents 1\n{{\n0.0\n{top}\n}}\n")


@pytest.mark.parametrize("how", ["context", "environment", "reference"])
def test_a_state_knows_all_that_a_configuration_reads(tonetool, make_image, tmp_path, monkeypatch,
                                                      how):
    """Through the first LUTs nothing is seen; the ones that come into their places show all."""
    matrix = ('<ProcessList id="b" version="1.3"><Matrix inBitDepth="32f" outBitDepth="32f">'
              '<Array dim="3 3 3">{0} 0 0 0 {0} 0 0 0 {0}</Array></Matrix></ProcessList>')
    (tmp_path / "c.ocio").write_text(CONFIG)
    (tmp_path / "ref.ctf").write_text(
        '<ProcessList id="a" version="1.3"><Reference inBitDepth="32f" outBitDepth="32f" '
        'path="in.ctf"/></ProcessList>')
    (tmp_path / "in.ctf").write_text(matrix.format("0.00001"))
    for name, top in (("lut", 0.0001), ("lut2", 1.0)):
        write_lut(tmp_path / f"{name}.spi1d", 0.0001 if how == "context" else top)
    images = [make_image(f"{seed}.exr", 64, 48, seed=seed) for seed in (1, 2)]
    flip = "--hdrflip:fail=0.02:print=0:startExposure=0:stopExposure=1"
    view = ":display=sRGB:view=V:encoding=linear"
    words = {"context": [*images, flip + view + ":context=LK=lut2.spi1d"],
             "environment": [*images, flip + view],
             "reference": [images[0], "--ociofiletransform", "ref.ctf", images[1],
                           "--ociofiletransform", "ref.ctf", flip + ":from=rec709"]}[how]
    words = ["--colorconfig", "c.ocio", *words, "--state", "s"]
    tonetool(*words)
    if how == "context":
        write_lut(tmp_path / "lut2.spi1d", 1.0)
    elif how == "environment":
        monkeypatch.setenv("LK", "lut2.spi1d")
    else:
        (tmp_path / "in.ctf").write_text(matrix.format("1.0"))
    tonetool(*words, status=3, **({"env": dict(os.environ)} if how == "environment" else {}))


def test_a_damaged_state_is_made_anew(tonetool, anim):
    tonetool(*pair(flip(), "--json", "c.json", "--state", "s"), status=3)
    whole = (anim / "c.json").read_bytes()
    (anim / "s" / "frame.0005.json").write_text("{")
    (anim / "s" / "frame.0006.json").write_text('{"format": "tonetool-state", "version": 99}')
    tonetool(*pair(flip(), "--json", "c.json", "--state", "s"), status=3)
    assert (anim / "c.json").read_bytes() == whole


def test_views_cannot_leave_the_state_folder(tonetool, make_image, tmp_path):
    make_image("a_.._up.1.exr")
    make_image("b_.._up.1.exr")
    tonetool("--views", ".._up", "a_%V.#.exr", "b_%V.#.exr", "--framepadding", "1", "--hdrflip",
             "--state", "s", "--json", "c.json")
    assert [file.name for file in (tmp_path / "s").iterdir()] == ["frame.0001.%2E%2E_up.json"]


def leftovers(folder):
    return [file for file in folder.rglob(".*") if file.is_file()]


@pytest.mark.parametrize("turn", range(50))
def test_killed_at_a_random_moment_and_resumed(program, tmp_path_factory, turn):
    folder = tmp_path_factory.getbasetemp() / "killed"
    if not folder.exists():
        folder.mkdir()
        for file in ANIM.glob("*.exr"):
            shutil.copy(file, folder)
    words = [program, "--jobs", "2", *pair(flip("shot")), "-o", "map.#.exr", "--json", "c.json",
             "--csv", "c.csv"]
    wanted = {}
    outputs = ["c.json", "c.csv", *(f"map.000{n}.exr" for n in range(1, 9))]
    if not (folder / "wanted").exists():
        begin = time.monotonic()
        subprocess.run(words, cwd=folder, check=False, capture_output=True)
        (folder / "seconds").write_text(str(time.monotonic() - begin))
        (folder / "wanted").mkdir()
        for name in outputs:
            (folder / name).rename(folder / "wanted" / name)
    wanted = {name: (folder / "wanted" / name).read_bytes() for name in outputs}
    words += ["--state", "s"]
    shutil.rmtree(folder / "s", ignore_errors=True)
    for name in outputs:
        (folder / name).unlink(missing_ok=True)
    seconds = float((folder / "seconds").read_text())
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        time.sleep(float(np.random.default_rng(turn).random()) * seconds)
        process.send_signal(signal.SIGKILL)
        process.wait()
    for name in outputs:  # whole or not at all
        if (folder / name).exists() and name.startswith("c."):
            assert (folder / name).read_bytes() == wanted[name], name
    done = subprocess.run(words, cwd=folder, check=False, capture_output=True)
    assert done.returncode == 3, done.stderr
    for name in ("c.json", "c.csv"):
        assert (folder / name).read_bytes() == wanted[name], name
    for file in (folder / "s").iterdir():
        load(file)
    assert leftovers(folder) == []


# ---- names

@pytest.mark.parametrize("name", ["<img onerror=alert(1)>", "a,b\"c", "=cmd", "it's & so"])
def test_names_are_only_text(tonetool, make_image, tmp_path, name):
    make_image(f"{name}.0001.exr")
    make_image(f"{name}.0002.exr", width=4)
    make_image("r.0001.exr")
    make_image("r.0002.exr")
    tonetool("r.#.exr", f"{name}.#.exr", "--hdrflip:fail=0", "--json", "c.json", "--csv", "c.csv",
             "--junit", "c.xml", status=1)
    found = load(tmp_path / "c.json")
    assert [frame["test"] for frame in found["frames"]] == [f"{name}.0001.exr", f"{name}.0002.exr"]
    rows = list(csv.DictReader(io.StringIO((tmp_path / "c.csv").read_text(), newline="")))
    start = "'" if name.startswith("=") else ""
    assert [row["test"] for row in rows] == [f"{start}{name}.0001.exr", f"{start}{name}.0002.exr"]
    suite = ElementTree.parse(tmp_path / "c.xml").getroot().find("testsuite")
    assert [case.get("classname") for case in suite.findall("testcase")] == [
        f"{name}.0001.exr", f"{name}.0002.exr"]


def test_only_named_files_are_written(tonetool, anim):
    before = set(os.listdir(anim))
    (anim / "out").mkdir()
    tonetool(*pair(flip("shot"), "--json", "out/c.json", "--csv", "out/c.csv", "--junit",
                   "out/c.xml", "--state", "out/s"), status=3)
    assert set(os.listdir(anim)) - before == {"out"}
    assert set(os.listdir(anim / "out")) == {"c.json", "c.csv", "c.xml", "s"}


# ---- progress

def test_a_line_for_every_finished_frame(tonetool, anim):
    ran = tonetool("-v", "--jobs", "2", *pair(flip(), "--json", "c.json"), status=3)
    lines = [line for line in ran.err.splitlines() if line.startswith("frame ")]
    assert [int(line.split()[1].rstrip(":")) for line in lines] == list(range(1, 9))
    assert lines[4].startswith("frame 5: failed (hdrflip: p99 0.")
    assert " passed, " in lines[3]


def test_two_results_in_one_file_by_a_link(tonetool, tmp_path, pair):
    """Also before the file is there."""
    (tmp_path / "b").symlink_to("a")
    (tmp_path / "folder").mkdir()
    (tmp_path / "same").symlink_to("folder")
    for first, second in (("a", "b"), ("a", tmp_path / "a"), ("folder/x", "same/x")):
        ran = tonetool(*pair, "--hdrflip", "--json", first, "--csv", second, status=1)
        assert "is also another's file" in ran.err
    assert not (tmp_path / "a").exists()
    tonetool(*pair, "--hdrflip", "--json", "b")
    assert (tmp_path / "b").is_symlink() and (tmp_path / "a").read_text().startswith("{")
