# SPDX-License-Identifier: BSD-3-Clause
"""Every field of a summary is said wherever summaries are shown, or stated here as one that is not."""

import inspect
import json
import re
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import files, write

ROOT = Path(__file__).resolve().parents[2]


def fields_of(class_):
    """The names of a result's fields, in order."""
    return [name for name, value in vars(class_).items() if isinstance(value, property)]


def structs():
    """The members of each struct of the public headers, with those of its base."""
    found = {}
    for header in sorted((ROOT / "src" / "include" / "tonetool").glob("*.h")):
        text = re.sub(r"//.*", "", header.read_text(encoding="utf-8"))
        for name, base, body in re.findall(r"^struct (\w+)(?: : (\w+))? \{(.*?)^\};", text, re.M | re.S):
            found[name] = (base, list(members(body)))
    return {name: own + found.get(base, ("", []))[1] for name, (base, own) in found.items()}


def members(body):
    body = re.sub(r"[^;]*\) const \{[^}]*\}", "", body)
    while re.search(r"<[^<>]*>|\{[^{}]*\}", body):
        body = re.sub(r"<[^<>]*>|\{[^{}]*\}", "", body)
    for declaration in body.split(";"):
        if declaration.strip() and "static" not in declaration:
            names = re.sub(r"^\s*[\w:]+\s", "", declaration)
            yield from (re.match(r"\s*(\w+)", name)[1] for name in names.split(","))


def test_python_has_all_members_of_the_structs():
    absent = {("QcPicture", "lit"), ("QcPicture", "unseen")}
    classes = {name: getattr(tonetool, name) for name in tonetool.__all__}
    results = {name: fields_of(class_) for name, class_ in classes.items() if inspect.isclass(class_)}
    assert "numbers" in results.pop("BiasResult")  # flat: test_bias_check looks at the numbers
    found, compared = set(), 0
    for name, wanted in structs().items():
        if results.get(name):
            found |= {(name, member) for member in wanted} - {(name, field) for field in results[name]}
            compared += 1
    assert found == absent
    assert compared >= 20


def nested(summary):
    """(of, name) of all fields: "reference" of a FlipSide, "pool" of the pooled values, else ""."""
    for name in fields_of(type(summary)):
        value = getattr(summary, name)
        inner = fields_of(type(value)) if type(value).__module__ == "tonetool" else []
        yield from ((name, one) for one in inner) if inner else [("", name)]


def missing(summary, key_of, said, renamed):
    """The fields that are not said; `renamed` has the keys that do not follow from their names."""
    return {name for of, name in nested(summary)
            if renamed.get(name, key_of("" if of in ("pool", "score") else of, name)) not in said}


def attribute(of, name):
    words = [word for word in (of, *name.split("_")) if word]
    return words[0] + "".join(word[0].upper() + word[1:] for word in words[1:])


def key(of, name):
    return "-".join(filter(None, (of, *name.split("_"))))


# Said by others: start and number of the exposures, the curve's own values, the worst pixel.
ATTRIBUTES = {"mean": "meanerror", "min": "minerror", "max": "maxerror", "max_x": "maxx", "max_y": "maxy",
              "weighted_q1": "weightedquartile1", "weighted_median": "weightedmedian",
              "weighted_q3": "weightedquartile3", "p999": "p99.9", "further": "p99.95",
              "nonfinite_both": "bothNonfinite", "nonfinite_unlike": "unlikeNonfinite",
              "alpha_mean": "alphaMeanError", "alpha_max": "alphaMaxError", "coeffs": "coefficients",
              "exposures": "numExposures"}
KEYS = {"p999": "p99.9", "further": "above0.25", "nonfinite_both": "nonfinite-in-both",
        "parameters": "curve-prescale", "coeffs": "coefficient-5", "median_of_lit": "median-of",
        "max_x": "worst", "max_y": "worst"}
# Of the comparison as a whole, or said by the presence of others.
UNSAID = {"region", "alpha_compared", "alpha_max_x", "alpha_max_y", "min_x", "min_y"}
UNSAID_OF_FLIP = UNSAID | {"hdr", "bright", "baked"}


@pytest.fixture
def pair(tmp_path):
    """Names of two images with alpha, one with a NaN, and the images."""
    rng = np.random.default_rng(1)
    reference = rng.uniform(0.1, 2, (24, 32, 4)).astype(np.float32)
    test = (reference * rng.uniform(0.9, 1.1, reference.shape)).astype(np.float32)
    test[3, 4, 0] = np.nan
    names = [str(tmp_path / name) for name in ("ref.exr", "test.exr")]
    for name, image in zip(names, (reference, test)):
        write(name, image)
    return names, [oiio.ImageBuf(name) for name in names]


def attributes_of(image, prefix):
    return {a.name[len(prefix):] for a in image.spec().extra_attribs if a.name.startswith(prefix)}


def record_of(tmp_path):
    frame = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))["frames"][0]
    measured = frame["measurements"][0]
    return set(measured).union(*(measured[part] for part in ("quantities", "parameters", "settings")))


VIEW = {"config": str(ROOT / "ocio" / "tonetool.ocio")}


def test_flip(pair, program, tmp_path):
    names, images = pair
    said = set()
    for how in ({"curve": "aces"}, {"view": VIEW}):
        result = tonetool.hdr_flip(*images, alpha="error", quantities=["p99.95"], ignore=["2x2+0+0"], **how)
        said |= attributes_of(result.map, "FLIP:")
    assert missing(result.summary, attribute, said, ATTRIBUTES) == UNSAID_OF_FLIP
    said = set()
    for how in ("tonemapper=aces", "display=sRGB"):
        program("--colorconfig", VIEW["config"], *names, f"--hdrflip:{how}:alpha=error:above=0.25:ignore=2x2+0+0",
                "--json", "out.json")
        said |= record_of(tmp_path)
    assert missing(result.summary, key, said, KEYS) == UNSAID_OF_FLIP


def test_errors(pair, program, tmp_path):
    names, images = pair
    attributes, keys = set(), set()
    for metric in tonetool.error_metrics():
        result = tonetool.error_map(*images, metric=metric, alpha="error", quantities=["p99.95"],
                                    ignore=["2x2+0+0"])
        attributes |= attributes_of(result.map, "Error:")
        program(*names, f"--errormap:metric={metric}:alpha=error:above=0.25:ignore=2x2+0+0",
                "--json", "out.json")
        keys |= record_of(tmp_path)
    assert missing(result.summary, attribute, attributes, ATTRIBUTES) == UNSAID
    assert missing(result.summary, key, keys, {**KEYS, "value": "psnr", "metric": "psnr", "decibels": "psnr"}) == UNSAID


def test_tmqi(pair, program, tmp_path):
    names, images = pair
    result = tonetool.tmqi(*images)
    capital = {"q": "Q", "s": "S", "n": "N", "scales": "S5"}
    assert missing(result.summary, attribute, attributes_of(result.map, "TMQI:"), capital) == {"region"}
    program(*names, "--tmqi", "--json", "out.json")
    renamed = {**capital, "mean": "ldr-mean", "deviation": "ldr-deviation"}
    assert missing(result.summary, key, record_of(tmp_path), renamed) == {"region"}


def test_bias_check(pair, program, tmp_path):
    names, images = pair
    result = tonetool.bias_check(*images)
    said = attributes_of(result.map, "Bias:")
    assert set(result.numbers) | {"verdict", "reason", "sentence", "within", "alpha"} <= said
    program(*names, "--biascheck:inconclusive=pass:fail=0", "--json", "out.json", status=3)  # too small
    record = record_of(tmp_path)
    assert set(result.numbers) | {"verdict", "reason", "sentence", "within", "alpha", "power"} <= record
    # Of a judged pair, every member of the structs that is a number of the whole picture.
    rng = np.random.default_rng(2)
    noisy = tonetool.bias_check(*(rng.gamma(4, 0.25, (96, 96, 3)).astype(np.float32) for _ in range(2)))
    members = {name for name in structs()["BiasResult"] if name not in NOT_NUMBERS}
    of_channels = {"gain": "gain.Y", "rare": "rare.B", "tested": "block-tests"}
    assert {of_channels.get(name, name) for name in members} <= set(noisy.numbers) | {"more", "ignored"}  # told beside them
    for name in structs()["BiasGain"]:
        shown = {"se": "gain-se", "energy_se": "energy-se"}.get(name, name)
        assert name == "rejected" or f"{shown}.G" in noisy.numbers


# Said in words, by the region, or of single blocks.
NOT_NUMBERS = {"verdict", "reason", "options", "x", "y", "width", "height", "judged", "dark", "scales", "contradicted"}


def test_luminance(program):
    path = files("cornell")[0]
    lines = program(path, "--luminancestats").splitlines()
    stats = tonetool.luminance_stats(oiio.ImageBuf(str(path)))
    found = {line.split()[1] for line in lines if line.startswith("luminancestats: ")}
    assert missing(stats, key, found, {"p999": "p99.9"}) == set()
