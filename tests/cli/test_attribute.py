# SPDX-License-Identifier: BSD-3-Clause
"""attribute= of the commands that compare: whose error is it?"""

import csv
import json
import math
import os
import re
from pathlib import Path

import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES, call
from crypto_pair import Render, id_of

ROOT = TESTIMAGES.parent
SHARED = Path(os.environ.get("SHARED_DIR", ""))
ANIM = TESTIMAGES / "anim"


def changed(**what):
    """Another seed, with members of Render set."""
    render = Render(seed=2)
    for name, value in what.items():
        setattr(render, name, value)
    return render


@pytest.fixture
def pair(tonetool, tmp_path):
    """Writes a pair, compares it, and returns what was printed and the attribution in the JSON."""

    def run(test, words="--hdrflip:attribute=1", reference=None, status=0):
        (reference or Render()).write(tmp_path / "ref.exr")
        test.write(tmp_path / "test.exr")
        ran = tonetool("ref.exr", "test.exr", words, "--json", "c.json", status=status)
        if status:
            return ran
        measured = json.loads((tmp_path / "c.json").read_text())["frames"][0]["measurements"]
        return ran, measured[0].get("attribution")

    return run


def findings(ran, command="hdrflip"):
    """Lines of findings, without their numbers."""
    words = (r"off|weaker|stronger|new|missing|replaced by \w+|replaces \w+|moved or reshaped|larger|smaller|"
             "uncovered or hidden|other colour|changed")
    return re.findall(rf"^{command}: ((?:light|object|layer) .*: (?:{words}))\b", ran.out, re.MULTILINE)


def rows(table):
    return {row["name"]: row for row in table}


def test_the_ids_of_the_pair_are_those_of_the_specification():
    assert id_of("torus") == 0xf19c73fd and id_of("равнина") == 0x9623511e


CHANGES = {
    "nothing": ({}, []),
    "off": ({"lights": {"fill": 0.25}}, ["light key: off"]),
    "weaker": ({"lights": {"key": 0.5, "fill": 0.25}}, ["light key: weaker"]),
    "new": ({"lights": {"key": 1, "fill": 0.25, "rim": 0.4}}, ["light rim: new"]),
    "colour": ({"color": (0.6, 0.5, 0.4)}, ["object ball: other colour"]),
    "moved": ({"ball": (18, 12)}, ["object ball: moved or reshaped", "object floor: uncovered or hidden",
                                   "layer View.Depth: changed"]),
    "renamed": ({"names": {"floor": "floor", "ball": "sphere", "box": "box"}},
                ["object sphere: replaces ball", "object ball: replaced by sphere"]),
}


@pytest.mark.parametrize("change", CHANGES)
def test_what_has_changed_is_told(pair, change):
    what, wanted = CHANGES[change]
    ran, found = pair(changed(**what))
    assert sorted(findings(ran)) == sorted(wanted), ran.out
    assert len(found["findings"]) == len(wanted)
    for sentence in found["findings"]:
        assert f"hdrflip: {sentence}\n" in ran.out


@pytest.mark.parametrize("command", ["hdrflip", "ldrflip", "errormap:metric=smape", "errormap:metric=psnr"])
def test_of_each_command(pair, command):
    ran, found = pair(changed(lights={"fill": 0.25}), f"--{command}:attribute=1")
    assert findings(ran, command.split(":")[0]) == ["light key: off"]
    light = rows(found["lights"])["key"]
    assert light["gain"] == 0 and 0.5 < light["explains"] <= 1 and light["mean_alone"] > light["mean_replaced"]
    assert sum(row["mass"] for row in found["mattes"]["View.CryptoObject"]) == pytest.approx(1, abs=1e-9)


def test_replace_leaves_out_what_each_does_alone(pair):
    _, all_ = pair(changed(lights={"fill": 0.25}))
    _, some = pair(changed(lights={"fill": 0.25}), "--hdrflip:attribute=replace")
    for light in all_["lights"]:
        del light["mean_alone"]
    assert some == all_


def test_it_is_off_by_default(pair):
    for words in ("--hdrflip", "--hdrflip:attribute=0"):
        ran, found = pair(changed(lights={"fill": 0.25}), words)
        assert found is None and findings(ran) == []


def test_print_and_quiet(pair, tonetool):
    pair(changed(lights={"fill": 0.25}))
    for words in (("--hdrflip:attribute=1:print=0",), ("-q", "--hdrflip:attribute=1")):
        assert "light key" not in tonetool("ref.exr", "test.exr", *words).out


def test_wrong_words(pair, tonetool):
    ran = pair(Render(), "--hdrflip:attribute=2", status=1)
    assert "attribute" in ran.err and "valid: 0, 1, replace" in ran.err
    ran = pair(Render(), "--hdrflip:attribute=1:resize=1", status=1)
    assert "attribute= goes without resize=1" in ran.err


def test_the_json_is_what_its_schema_says(pair, tmp_path):
    schema = pytest.importorskip("jsonschema", reason="no python3-jsonschema here")
    description = json.loads((ROOT / "src" / "sequence" / "check.schema.json").read_text())
    pair(changed(ball=(18, 12), names={"floor": "floor", "ball": "ball", "box": "cube"}))
    found = json.loads((tmp_path / "c.json").read_text())
    schema.validate(found, description)
    attribution = found["frames"][0]["measurements"][0]["attribution"]
    assert attribution["manifest_only"] == {"View.CryptoObject": {"reference": ["box"], "test": ["cube"]}}
    attribution["lights"][0]["finding"] = "weak"
    with pytest.raises(schema.ValidationError):
        schema.validate(found, description)


def test_csv_has_findings_only_where_they_were_asked_for(pair, tonetool, tmp_path):
    pair(changed(lights={"fill": 0.25}, ball=(18, 12)))
    tonetool("ref.exr", "test.exr", "--hdrflip:attribute=1", "--csv", "c.csv")
    (row,) = csv.DictReader((tmp_path / "c.csv").open())
    assert row["hdrflip.findings"].startswith("light key: off, explains ")
    assert row["hdrflip.findings"].count("; ") == 3
    tonetool("ref.exr", "test.exr", "--hdrflip", "--csv", "d.csv")
    assert "findings" not in (tmp_path / "d.csv").read_text()


def test_frames_name_their_file_and_merge_to_the_same_bytes(tonetool, tmp_path):
    check = (ANIM / "ref.#.exr", ANIM / "test.#.exr", "--hdrflip:attribute=1")
    whole = tonetool(*check, "--json", "all.json")
    (line,) = [line for line in whole.out.splitlines() if "light neonC" in line]
    assert "hdrflip: light neonC: off, explains " in line and line.endswith("test.0005.exr)")
    assert findings(whole) == ["light neonC: off"]
    for part in ("1-4", "5-8"):
        tonetool("--frames", part, *check, "--json", f"{part}.json")
    tonetool("--merge", "1-4.json", "5-8.json", "--json", "merged.json")
    assert (tmp_path / "merged.json").read_bytes() == (tmp_path / "all.json").read_bytes()


@pytest.mark.parametrize("threads", [2, 4])
def test_threads_change_no_byte(pair, tonetool, tmp_path, threads):
    pair(changed(lights={"key": 0.6, "fill": 0.25}, ball=(18, 12)))
    tonetool("--threads", 1, "ref.exr", "test.exr", "--hdrflip:attribute=1", "--json", "one.json")
    tonetool("--threads", threads, "ref.exr", "test.exr", "--hdrflip:attribute=1", "--json", "many.json")
    assert (tmp_path / "one.json").read_bytes() == (tmp_path / "many.json").read_bytes()


def test_several_tests_have_each_their_own(tonetool, tmp_path):
    Render().write(tmp_path / "ref.exr")
    changed(lights={"fill": 0.25}).write(tmp_path / "a.exr")
    changed(color=(0.6, 0.5, 0.4)).write(tmp_path / "b.exr")
    tonetool("ref.exr", "a.exr", "b.exr", "--hdrflip:tests=2:attribute=1", "--json", "c.json")
    a, b = json.loads((tmp_path / "c.json").read_text())["frames"][0]["measurements"]
    assert [text.split(",")[0] for text in a["attribution"]["findings"]] == ["light key: off"]
    assert [text.split(" (")[0] for text in b["attribution"]["findings"]] == ["object ball: other colour"]


def test_layers_in_parts_of_their_own_and_two_views(tonetool, tmp_path):
    """What is compared chooses the view; its other layers lie in other parts."""
    for name, lights in (("ref", {"key": 1, "fill": 0.25}), ("test", {"fill": 0.25})):
        images = []
        for view in ("left", "right"):
            render = changed(lights=lights if view == "right" else {"key": 1, "fill": 0.25})
            file = tmp_path / f"{name}.{view}.exr"
            render.write(file)
            one = oiio.ImageBuf(str(file))
            names = one.spec().channelnames
            for part in ("Combined", "Depth"):
                keep = tuple(c for c in names if c.startswith("View.Combined") == (part == "Combined"))
                images.append(oiio.ImageBufAlgo.channels(one, keep))
                images[-1].specmod().attribute("oiio:subimagename", f"{part} {view}")
                images[-1].specmod().attribute("view", view)
        out = oiio.ImageOutput.create("parts.exr")
        assert out.open(str(tmp_path / f"{name}.exr"), tuple(image.spec() for image in images))
        for i, image in enumerate(images):
            assert i == 0 or out.open(str(tmp_path / f"{name}.exr"), image.spec(), "AppendSubimage")
            assert image.write(out)
        out.close()
    for view, wanted in (("left", []), ("right", ["light key: off"])):
        ran = tonetool("ref.exr", "test.exr", f"--hdrflip:attribute=1:layer=Combined {view}", "--json", "c.json")
        assert findings(ran) == wanted, ran.out
        found = json.loads((tmp_path / "c.json").read_text())["frames"][0]["measurements"][0]["attribution"]
        assert [row["name"] for row in found["layers"]] == ["View.Depth"]
        assert len(found["mattes"]["View.CryptoObject"]) == 3 and found["lights"]


# ---- what files may hold

HOSTILE = ["a b", "quote\"d", "per%cent", "new\nline", "<script>alert(1)</script>", "x" * 250, "../../etc/passwd"]


@pytest.mark.parametrize("name", HOSTILE, ids=range(len(HOSTILE)))
def test_names_are_only_text(pair, tonetool, tmp_path, name):
    test = changed(color=(0.9, 0.2, 0.2), names={"floor": "floor", "ball": name, "box": "box"})
    reference = Render()
    reference.names = test.names
    ran, found = pair(test, reference=reference)
    assert rows(found["mattes"]["View.CryptoObject"])[name]["finding"] == "other colour"
    assert ran.out.count("\nhdrflip: object ") == 1 and "\nline" not in ran.out
    tonetool("ref.exr", "test.exr", "--hdrflip:attribute=1", "--csv", "c.csv", "--report", "p.html")
    assert len(list(csv.DictReader((tmp_path / "c.csv").open(newline="")))) == 1
    assert "<script>alert" not in (tmp_path / "p.html").read_text()


def test_a_manifest_that_is_none_is_a_warning(pair):
    broken = changed(color=(0.9, 0.2, 0.2))
    broken.attributes["manifest"] = "{"
    ran, found = pair(broken, reference=broken)
    assert "attribute: the test: the manifest of View.CryptoObject is no JSON object" in ran.err
    assert set(rows(found["mattes"]["View.CryptoObject"])) == {f"<{id_of(n):08x}>" for n in ("floor", "ball", "box")}


def test_ids_that_have_been_through_half(pair, tonetool):
    pair(Render())
    tonetool("test.exr", "-d", "half", "-o", "half.exr")
    ran = tonetool("ref.exr", "half.exr", "--hdrflip:attribute=1", status=1)
    assert "the ids of View.CryptoObject in the test have been through half" in ran.err


def test_ids_that_were_resized(pair, tonetool):
    pair(Render())
    for name in ("ref", "test"):
        tonetool(f"{name}.exr", "--resize", "50x40", "-d", "float", "-o", f"{name}.small.exr")
    ran = tonetool("ref.small.exr", "test.small.exr", "--hdrflip:attribute=1", status=1)
    assert "ids of View.CryptoObject are not in its manifest, and 3 are: they have been resized" in ran.err


# ---- goldens

def near(value, wanted):
    """A thousandth, or 1e-4: instruction sets differ by 2e-5 in the map."""
    return abs(value - wanted) <= max(1e-3 * abs(wanted), 1e-4)


def same(value, wanted):
    if wanted is None:  # cannot be told
        return value is None or value == "nan"
    if isinstance(wanted, list):
        return len(value) == len(wanted) and all(map(same, value, wanted))
    if isinstance(wanted, (int, float)):
        return isinstance(value, (int, float)) and near(value, wanted)
    return value == wanted


def compare(table, golden):
    found = rows(table)
    for wanted in golden:
        row = found[wanted["name"]]
        assert row.get("finding") == wanted.get("finding"), wanted["name"]
        for key, value in wanted.items():
            assert same(row.get(key), value), (wanted["name"], key, row.get(key), value)
    return set(found) - {wanted["name"] for wanted in golden}


GOLDENS = {"anim_0001": ("anim/ref.0001.exr", "anim/test.0001.exr", {"ViewLayer.DiffCol"}),
           "anim_0005": ("anim/ref.0005.exr", "anim/test.0005.exr", {"ViewLayer.DiffCol"}),
           "gallery_test": ("crypto/gallery_ref.exr", "crypto/gallery_test.exr", set()),
           "gallery_same": ("crypto/gallery_ref.exr", "crypto/gallery_same.exr", set())}


def shared_pair(tonetool, tmp_path, *names):
    paths = [SHARED / "scenes" / name for name in names]
    if not os.environ.get("SHARED_DIR") or not all(path.exists() for path in paths):
        pytest.skip(f"no scenes/{names[0]} below SHARED_DIR")
    ran = tonetool(*paths, "--hdrflip:attribute=1", "--json", "c.json")
    measured = json.loads((tmp_path / "c.json").read_text())["frames"][0]["measurements"][0]
    return ran, measured


@pytest.mark.parametrize("name", GOLDENS)
def test_golden(tonetool, tmp_path, name):
    reference, test, further = GOLDENS[name]
    _, measured = shared_pair(tonetool, tmp_path, reference, test)
    golden = json.loads((SHARED / "golden" / "suites" / f"{name}.json").read_text())
    found = measured["attribution"]
    assert near(measured["quantities"]["mean"], golden["mean"])
    assert compare(found["lights"], golden["lights"]) == set()
    # Not in the golden: colours of surfaces, which have no finding.
    extra = compare(found["layers"], golden["layers"])
    assert extra == further and not any("finding" in rows(found["layers"])[one] for one in extra)
    assert set(found["mattes"]) == set(golden["mattes"])
    for kind, table in found["mattes"].items():
        assert compare(table, golden["mattes"][kind]) == set()
        assert math.isclose(sum(row["mass"] for row in table), 1, abs_tol=1e-6)
        order = [("finding" not in row, -row["mass"]) for row in table]
        assert order == sorted(order)
    assert "manifest_only" not in found


@pytest.mark.parametrize("frame", [1, 2, 3, 4, 6, 7, 8])
def test_honest_frames_have_no_finding(tonetool, tmp_path, frame):
    ran, measured = shared_pair(tonetool, tmp_path, f"anim/ref.{frame:04}.exr", f"anim/test.{frame:04}.exr")
    assert measured["attribution"]["findings"] == [] and findings(ran) == []


def test_one_dimmed_lamp_colours_no_object(tonetool, tmp_path):
    source = SHARED / "scenes" / "crypto" / "gallery_same.exr"
    if not os.environ.get("SHARED_DIR") or not source.exists():
        pytest.skip("no scenes/crypto/gallery_same.exr below SHARED_DIR")
    image = oiio.ImageInput.open(str(source))
    spec, pixels = image.spec(), image.read_image("float")
    for c in "RGB":
        beauty, warm = (spec.channelindex(f"ViewLayer.Combined{group}.{c}") for group in ("", "_warm"))
        pixels[..., beauty] -= 0.3 * pixels[..., warm]
        pixels[..., warm] *= 0.7
    out = oiio.ImageOutput.create(str(tmp_path / "warm.exr"))
    assert out.open(str(tmp_path / "warm.exr"), spec) and out.write_image(pixels)
    out.close()
    ran = tonetool(source.with_name("gallery_ref.exr"), "warm.exr", "--hdrflip:attribute=1")
    assert findings(ran) == ["light warm: weaker"], ran.out


@pytest.mark.parametrize("value", ["3", "[]", '"text"'])
def test_results_with_an_attribution_that_is_none_are_refused(pair, tonetool, tmp_path, value):
    pair(changed(lights={"fill": 0.25}))
    found = json.loads((tmp_path / "c.json").read_text())
    found["frames"][0]["measurements"][0]["attribution"] = json.loads(value)
    (tmp_path / "c.json").write_text(json.dumps(found))
    ran = tonetool("--merge", "c.json", "--json", "d.json", status=1)
    assert '"attribution" is ' in ran.err and "not an object" in ran.err


def test_the_sentences_of_the_guide(tonetool, tmp_path):
    """What src/doc/attribute.md shows of a render that is not in the repository."""
    ran, _ = shared_pair(tonetool, tmp_path, "crypto/gallery_ref.exr", "crypto/gallery_test.exr")
    guide = (ROOT / "src" / "doc" / "attribute.md").read_text()
    shown = re.findall(r"^    (hdrflip: (?:object|material|layer) .*)$", guide, re.MULTILINE)
    assert len(shown) >= 8
    printed = ran.out.splitlines()
    for line in shown:
        assert line in printed, line
