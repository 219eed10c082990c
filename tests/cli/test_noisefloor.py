# SPDX-License-Identifier: BSD-3-Clause
"""Limits from renders of the approved version: what --noisefloor writes, and fail= reads."""

import json
import math
import os
import re
import shutil

import numpy as np
import pytest
from conftest import call

SIZE = 64  # 4096 pixels: the fewest that the baseline can be judged by

# Factors of tolerance limits for content 0.99 and confidence 0.95, to the four decimals that tables
# have (Hahn and Meeker, "Statistical Intervals").
FACTORS = {6: 5.0620, 8: 4.3539, 12: 3.7471, 20: 3.2952}


def render(seed, spp=16, gain=1.0):
    """Light that varies slowly, with the noise of so many samples per pixel."""
    y, x = np.mgrid[0:SIZE, 0:SIZE]
    light = 0.5 + 0.2 * np.sin(x / 11) + 0.15 * np.cos(y / 9)
    noise = np.random.default_rng(seed).gamma(spp, 1 / spp, (SIZE, SIZE, 1))
    return gain * noise * np.stack([light * 1.1, light, light * 0.8], -1)


@pytest.fixture
def put(make_image):
    return lambda name, pixels, kind="half": make_image(name, SIZE, SIZE, kind=kind, pixels=pixels)


@pytest.fixture
def renders(put):
    """A converged reference, and so many seeds."""
    put("ref.exr", render(499, spp=4096), "float")

    def make(count, **options):
        seeds = [render(500 + i, **options) for i in range(count)]
        return ["ref.exr", *(put(f"s{i:02d}.exr", pixels) for i, pixels in enumerate(seeds))]

    return make


@pytest.fixture
def floor(tonetool, tmp_path):
    """Runs --noisefloor over the words, and returns what it has written."""

    def run(*words, modifiers=""):
        tonetool(*words, f"--noisefloor{modifiers}", "limits.json")
        return load(tmp_path / "limits.json")

    return run


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


def limits_of(found):
    return {one["quantity"]: one["limit"] for one in found["limits"]}


def lognormal(values, k):
    logs = np.log(values)
    return math.exp(logs.mean() + k * logs.std(ddof=1))


# ---- limits

@pytest.mark.parametrize("count", [6, 8, 12, 20])
def test_a_limit_is_the_tolerance_limit_of_its_values(floor, renders, count):
    found = floor(*renders(count))
    assert [one["quantity"] for one in found["limits"]] == ["mean", "p99"]
    for one in found["limits"]:
        assert len(one["values"]) == count
        # The factor is rounded at the fourth decimal; ln v has a deviation below 0.1.
        assert one["limit"] == pytest.approx(lognormal(one["values"], FACTORS[count]), rel=1e-5)
        assert one["method"] == f"lognormal, k {FACTORS[count]:.4f}"
        assert one["limit"] > max(one["values"])


def test_the_factor_is_that_of_the_noncentral_t(floor, renders):
    stats = pytest.importorskip("scipy.stats", reason="no python3-scipy here")
    for content, confidence in ((0.95, 0.9), (0.9, 0.99)):
        found = floor(*renders(5), modifiers=f":content={content}:confidence={confidence}")
        k = stats.nct.ppf(confidence, 4, stats.norm.ppf(content) * math.sqrt(5)) / math.sqrt(5)
        for one in found["limits"]:
            # Quantiles are iterated to about 10 digits.
            assert one["limit"] == pytest.approx(lognormal(one["values"], k), rel=1e-8)


def test_values_are_what_the_comparison_measures(tonetool, floor, renders, tmp_path):
    words = renders(5)
    found = floor(*words, modifiers=":quantity=mean,p99,p50")
    values = {one["quantity"]: one["values"] for one in found["limits"]}
    assert list(values) == ["mean", "p99", "p50"]
    for i, seed in enumerate(words[1:]):
        tonetool(words[0], seed, "--hdrflip:print=0:fail=mean=0.9,p99=0.9,p50=0.9", "--json",
                 "one.json")
        (frame,) = load(tmp_path / "one.json")["frames"]
        measured = frame["measurements"][0]["quantities"]
        assert {name: measured[name] for name in values} == {
            name: all_of[i] for name, all_of in values.items()}
    assert found["reference"] == words[0] and found["seeds"] == words[1:]
    assert (found["content"], found["confidence"]) == (0.99, 0.95)


@pytest.mark.parametrize("content, confidence, needed, rank", [
    # P(Binomial(10, 0.5) <= 6) = 0.828, <= 7 is 0.945: the eighth of ten
    ("0.5", "0.9", 4, 8),
    # P(Binomial(10, 0.7) <= 8) = 0.851, <= 9 is 0.972: the last of ten
    ("0.7", "0.9", 7, 10),
])
def test_order_statistics(floor, renders, content, confidence, needed, rank):
    found = floor(*renders(10), modifiers=f":content={content}:confidence={confidence}")
    for one in found["limits"]:
        assert one["method"] == f"order statistic {rank} of 10"
        assert one["limit"] == sorted(one["values"])[rank - 1]
        assert one["needed_for_order_statistic"] == needed


def test_what_the_order_statistic_needs(floor, renders):
    # ceil(ln(1 - confidence) / ln(content)): section of nonparametric limits in the book above.
    for modifiers, needed in (("", 299), (":content=0.95", 59)):
        found = floor(*renders(4), modifiers=modifiers)
        assert {one["needed_for_order_statistic"] for one in found["limits"]} == {needed}


def test_more_seeds_give_a_nearer_limit(floor, renders):
    few, many = limits_of(floor(*renders(4))), limits_of(floor(*renders(20)))
    assert many["mean"] < few["mean"] and many["p99"] < few["p99"]


@pytest.mark.parametrize("copied", ["ref.exr", "s02.exr"])
def test_a_copy_is_no_render_of_its_own(tonetool, renders, tmp_path, copied):
    """Of the reference its values are 0, of a seed they are there twice."""
    words = renders(4)
    shutil.copy(tmp_path / copied, tmp_path / "copy.exr")
    for modifiers in ("", ":quantity=p99:baseline=0"):
        ran = tonetool(*words, "copy.exr", f"--noisefloor{modifiers}", "limits.json", status=1)
        assert "copy.exr" in ran.err or "are the same image" in ran.err
        assert not (tmp_path / "limits.json").exists()


@pytest.mark.parametrize("modifiers, command, settings", [
    (":command=ldrflip", "ldrflip", {}),
    (":command=errormap:metric=relmse", "errormap", {"metric": "relmse"}),
    (":command=errormap:metric=mse:quantity=mse,max", "errormap", {"metric": "mse"}),
    (":ppd=40:tonemapper=hable", "hdrflip", {"ppd": "40", "tonemapper": "hable"}),
])
def test_limits_of_other_comparisons(tonetool, floor, renders, modifiers, command, settings):
    words = renders(6)
    found = floor(*words, modifiers=modifiers)
    assert found["command"] == command and found["modifiers"] == settings
    line = "".join(f":{name}={value}" for name, value in settings.items())
    ran = tonetool(words[0], words[3], f"--{command}{line}:fail=limits.json:print=0")
    assert ran.out.startswith(f"{command}: PASS ")
    for quantity, limit in limits_of(found).items():
        assert f"{quantity} " in ran.out and f"<= {limit:.6g}" in ran.out


def test_what_is_printed(tonetool, renders):
    words = renders(6)
    ran = tonetool(*words, "--noisefloor", "limits.json")
    assert all(line.startswith("noisefloor: ") for line in ran.out.splitlines())
    assert "hdrflip of 6 seeds against ref.exr" in ran.out and "wrote limits.json" in ran.out
    assert "with 95 % confidence at least 99 % of unbiased renders lie below" in ran.out
    assert tonetool("-q", *words, "--noisefloor", "limits.json").out == ""
    assert not ran.err


def test_the_standard_output(tonetool, floor, renders, tmp_path):
    words = renders(5)
    found = floor(*words)
    (tmp_path / "limits.json").unlink()
    before = sorted(os.listdir(tmp_path))
    assert json.loads(tonetool(*words, "--noisefloor", "-").out) == found
    assert sorted(os.listdir(tmp_path)) == before


def test_the_stack_is_what_the_help_says(tonetool, renders):
    """Either the images are left, or all are popped: the line cannot go on with some of them."""
    words = renders(4)
    (popped,) = re.findall(r"images popped: (\w+)", tonetool("--help", "noisefloor").out)
    assert popped in ("0", "all")
    tonetool(*words, "--noisefloor", "limits.json", "--pop", status=0 if popped == "0" else 1)


def test_threads_change_no_bit(tonetool, renders, tmp_path):
    words = renders(5)
    for threads in ("1", "4"):
        tonetool("--threads", threads, *words, "--noisefloor", f"{threads}.json")
    assert (tmp_path / "1.json").read_bytes() == (tmp_path / "4.json").read_bytes()


# ---- what gives no limits

def refused(tonetool, tmp_path, words, text, status=1, file="limits.json"):
    before = {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)}
    ran = tonetool(*words, file, status=status)
    assert text in ran.err + ran.out, (ran.err, ran.out)
    assert {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)} == before
    return ran


def test_fewer_than_four_seeds(tonetool, renders, tmp_path):
    words = renders(4)
    for count in range(4):
        ran = refused(tonetool, tmp_path, [*words[:count + 1], "--noisefloor"], "4 or more")
        assert "tonetool ERROR: noisefloor : " in ran.err


@pytest.mark.parametrize("modifiers, text", [
    (":command=errormap:metric=psnr:quantity=psnr", "higher is better"),
    (":command=errormap:metric=mpsnr:quantity=mpsnr", "higher is better"),
    (":quantity=psnr", 'unknown quantity "psnr"'),
    (":command=errormap", "needs metric="),
    (":command=diff", "(valid: hdrflip, ldrflip, errormap)"),
    (":content=0.4", "content 0.4 is out of range"),
    (":content=1", "content 1 is out of range"),
    (":confidence=0", "confidence 0 is out of range"),
    (":confidence=x", 'confidence "x" is not a number'),
    (":quantity=mean,p99,mean", "mean"),
    (":quantity=p99,p99.0", "p99"),
    (":baseline=2", "baseline "),
    (":layer=nosuch", "nosuch"),
    (":fail=0.5", '"fail"'),
    (":tonemapper=nosuch", "nosuch"),
])
def test_bad_values_are_errors(tonetool, renders, tmp_path, modifiers, text):
    ran = refused(tonetool, tmp_path, [*renders(4), f"--noisefloor{modifiers}"], text)
    assert "tonetool ERROR: noisefloor : " in ran.err


def test_a_limit_that_cannot_be_exceeded(tonetool, renders, put, tmp_path):
    """Seeds of one sample: four maxima near 1 have a tolerance limit above 1, where FLIP ends."""
    words = renders(4, spp=1)
    put("s00.exr", render(500, spp=64))
    ran = refused(tonetool, tmp_path, [*words, "--noisefloor:quantity=max"], "max")
    assert re.search(r"limit.*1\.\d|can(not| never) be exceeded|never", ran.err), ran.err
    assert "mean" in ran.err  # what to take in its place
    # An error that has no largest value has such limits.
    tonetool(*words, "--noisefloor:command=errormap:metric=relmse:quantity=max", "limits.json")
    assert limits_of(load(tmp_path / "limits.json"))["max"] > 1


@pytest.mark.parametrize("file", ["limits.exr", "limits", "s01.exr", "limits.tone", "json"])
def test_other_files_are_not_overwritten(tonetool, renders, tmp_path, file):
    refused(tonetool, tmp_path, [*renders(4), "--noisefloor"], f'"{file}"', file=file)


def test_files_that_cannot_be_written(tonetool, renders, tmp_path):
    words = [*renders(4), "--noisefloor"]
    refused(tonetool, tmp_path, words, "nowhere", file="nowhere/limits.json")
    os.mkdir(tmp_path / "folder.json")
    assert "folder.json" in tonetool(*words, "folder.json", status=1).err
    assert "missing argument" in tonetool(*words, status=1).err


def test_no_file_with_n(tonetool, renders, tmp_path):
    words = renders(4)
    before = sorted(os.listdir(tmp_path))
    tonetool("-n", *words, "--noisefloor", "limits.json")
    assert sorted(os.listdir(tmp_path)) == before


def test_images_that_cannot_be_compared(tonetool, renders, make_image, tmp_path):
    words = renders(4)
    make_image("small.exr", 32, 32)
    refused(tonetool, tmp_path, [*words, "small.exr", "--noisefloor"], "display window")
    refused(tonetool, tmp_path, [*words, "gone.exr", "--noisefloor"], "gone.exr")


def test_the_reference_among_the_seeds(tonetool, renders, tmp_path):
    """Pairs that have a render in common say less than they seem to; a seed twice is one seed."""
    words = renders(4)
    for more, one in ((["ref.exr"], "ref.exr"), (["s01.exr"], "s01.exr")):
        ran = refused(tonetool, tmp_path, [*words, *more, "--noisefloor"], "same file")
        assert one in ran.err


# ---- warnings

def test_a_seed_that_is_an_outlier_is_told(tonetool, floor, renders, put, tmp_path):
    words = renders(8)
    sound = floor(*words)
    assert "warnings" not in sound and all("outlier" not in one for one in sound["limits"])
    put("s05.exr", render(505, spp=4))  # four times the noise, no other light
    ran = tonetool(*words, "--noisefloor", "limits.json")
    found = load(tmp_path / "limits.json")
    assert 's05.exr' in ran.err and "WARNING: noisefloor : " in ran.err
    assert [one["outlier"] for one in found["limits"]] == [5, 5]  # counted from 0
    assert any("s05.exr" in text for text in found["warnings"])
    tonetool(*words, "--noisefloor", "limits.json", "--warnings-exit", status=2)


# ---- a baseline that is out of date

@pytest.fixture
def stale(renders, put):
    """The approved version is 10 % darker than its reference."""
    words = renders(4)
    put("ref.exr", render(499, spp=4096, gain=1.1), "float")
    return words


def test_a_stale_baseline_gives_no_limits(tonetool, stale, tmp_path):
    ran = refused(tonetool, tmp_path, [*stale, "--noisefloor"], "out of date", status=3)
    assert "FAIL" in ran.out and "different" in ran.out and "lies outside the seeds" in ran.out
    (tmp_path / "limits.json").write_text("old")
    refused(tonetool, tmp_path, [*stale, "--noisefloor"], "out of date", status=3)
    ran = tonetool(*stale, "--noisefloor", "-", status=3)
    assert '"limit"' not in ran.out
    refused(tonetool, tmp_path, ["-q", *stale, "--noisefloor"], "out of date", status=3)


def test_a_stale_baseline_that_is_wanted(tonetool, stale, floor):
    found = floor(*stale, modifiers=":baseline=0")
    assert "baseline" not in found or "equal" not in found["baseline"]
    assert limits_of(found)["mean"] > 0.1


def test_a_baseline_that_is_sound_says_so_with_its_sentence(floor, renders):
    found = floor(*renders(8))
    assert "equal within 5 %" in found["baseline"] and "64x64" in found["baseline"]


def test_a_baseline_that_cannot_be_judged_is_said(tonetool, renders, tmp_path):
    ran = tonetool(*renders(4, spp=0.3), "--noisefloor", "limits.json")
    found = load(tmp_path / "limits.json")
    text = found["baseline"] + ran.out + ran.err
    assert "not enough samples" in text and "equal within" not in found["baseline"]
    assert "could not be ruled out" in text or "cannot be ruled out" in text


# ---- the limits are used

@pytest.fixture
def calibrated(floor, renders, put):
    """Limits, a render that is one of the approved version's, and one that is not."""
    found = floor(*renders(8))
    put("good.exr", render(700)), put("bad.exr", render(701, spp=3))
    return limits_of(found)


def test_a_pair_against_the_limits(tonetool, calibrated):
    ran = tonetool("ref.exr", "good.exr", "--hdrflip:fail=limits.json:print=0")
    assert ran.out.startswith("hdrflip: PASS mean ") and ", p99 " in ran.out
    for limit in calibrated.values():
        assert f"<= {limit:.6g}" in ran.out
    ran = tonetool("ref.exr", "bad.exr", "--hdrflip:fail=limits.json:print=0", status=3)
    assert "FAIL mean" in ran.out and f"> {calibrated['mean']:.6g}" in ran.out
    ran = tonetool("ref.exr", "bad.exr", "--hdrflip:warn=limits.json:print=0", "--warnings-exit",
                   status=2)
    assert "WARNING mean" in ran.out


@pytest.fixture
def shot(calibrated, put):
    for number, spp in ((1, 16), (2, 3)):
        put(f"r.000{number}.exr", render(500 - number, spp=4096), "float")
        put(f"t.000{number}.exr", render(709 + number, spp=spp))
    return ["r.#.exr", "t.#.exr"]


def test_a_check_has_numbers_in_place_of_the_file(tonetool, calibrated, shot, tmp_path):
    words = [*shot, "--hdrflip:fail=limits.json:print=0"]
    tonetool(*words, "--json", "c.json", "--junit", "c.xml", status=3)
    found = load(tmp_path / "c.json")
    assert [frame["status"] for frame in found["frames"]] == ["passed", "failed"]
    text = (tmp_path / "c.json").read_text(encoding="utf-8")
    assert "limits.json" not in text
    (word,) = [word for word in found["check"] if word.startswith("--hdrflip")]
    for name, limit in calibrated.items():
        assert float(re.search(rf"\b{name}=([0-9.e+-]+)", word)[1]) == limit
        for frame in found["frames"]:
            (one,) = [t for t in frame["measurements"][0]["thresholds"] if t["quantity"] == name]
            assert one["fail"] == limit
    # The line of the result can be run without the file, and says the same.
    (tmp_path / "limits.json").unlink()
    tonetool(*shot, word, "--json", "again.json", status=3)
    assert (tmp_path / "again.json").read_bytes() == (tmp_path / "c.json").read_bytes()


def test_a_state_knows_other_limits(tonetool, shot, tmp_path):
    words = [*shot, "--hdrflip:fail=limits.json:print=0", "--json", "c.json", "--state", "s"]
    tonetool(*words, status=3)
    found = load(tmp_path / "limits.json")
    for one in found["limits"]:
        one["limit"] = 0.9
    (tmp_path / "limits.json").write_text(json.dumps(found))
    tonetool(*words)
    assert load(tmp_path / "c.json")["verdict"] == "passed"


def test_parts_merge_to_the_bytes_of_the_single_run(program, tonetool, shot, tmp_path):
    words = [*shot, "--hdrflip:fail=limits.json:print=0"]
    tonetool(*words, "--json", "whole.json", status=3)
    for frame in "12":
        call(program, ["--frames", frame, *words, "--json", f"{frame}.json"], tmp_path)
    tonetool("--merge", "2.json", "1.json", "--json", "merged.json", status=3)
    assert (tmp_path / "merged.json").read_bytes() == (tmp_path / "whole.json").read_bytes()


def call_it_passed(part):
    """All that a hand would change so that every frame has passed."""
    for name in part["counts"]:
        part["counts"][name] = len(part["frames"]) if name == "passed" else 0
    part["verdict"] = "passed"
    part["sentence"] = f"{part['sentence'].split(':')[0]}: {len(part['frames'])} passed"
    for frame in part["frames"]:
        frame.pop("message", None)
        frame["status"] = frame["measurements"][0]["status"] = "passed"


@pytest.fixture
def merge_forged(program, tmp_path):
    """Merges a forged part, in which what follows from the frames is what a merge says it is."""

    def run(part):
        call_it_passed(part)
        for _ in range(3):
            (tmp_path / "forged.json").write_text(json.dumps(part))
            ran = call(program, ["--merge", "forged.json", "--json", "c.json"], tmp_path)
            told = re.search(r'"(sentence|worst)" is .*, but that of its frames is (.*)$', ran.err,
                             re.M)
            if not told:
                break
            part[told[1]] = json.loads(told[2])
        return ran

    return run


def higher(part):
    for one in part["frames"][1]["measurements"][0]["thresholds"]:
        one["fail"] = 0.9


def one_less(part):
    part["frames"][1]["measurements"][0]["thresholds"].pop(0)


def none(part):
    part["frames"][1]["measurements"][0].pop("thresholds")


def other_line(part):
    part["check"] = [re.sub(r"=0\.[0-9]+", "=0.9", word) for word in part["check"]]


@pytest.mark.parametrize("change", [higher, one_less, none, other_line])
def test_results_whose_limits_were_altered_are_refused(tonetool, shot, merge_forged, tmp_path,
                                                       change):
    tonetool(*shot, "--hdrflip:fail=limits.json:print=0", "--json", "a.json", status=3)
    part = load(tmp_path / "a.json")
    change(part)
    ran = merge_forged(part)
    assert ran.status == 1 and '"forged.json": ' in ran.err
    assert not (tmp_path / "c.json").exists()


@pytest.mark.parametrize("words, text", [
    ("--hdrflip:fail=limits.json:ppd=40", "ppd=40"),
    ("--hdrflip:fail=limits.json:tonemapper=hable", "tonemapper=hable"),
    ("--hdrflip:fail=limits.json:startExposure=0:stopExposure=2", "Exposure"),
    ("--hdrflip:fail=limits.json:distance=1", "distance=1"),
    ("--errormap:metric=mse:fail=limits.json", "for --hdrflip, not for --errormap"),
    ("--ldrflip:fail=limits.json", "for --hdrflip, not for --ldrflip"),
    ("--hdrflip:fail=gone.json", "gone.json"),
    ("--hdrflip:fail=ref.exr", "ref.exr"),
    ("--hdrflip:fail=limits.json:quantity=mean", "quantity="),
])
def test_limits_that_do_not_fit(tonetool, calibrated, words, text):
    ran = tonetool("ref.exr", "good.exr", words, status=1)
    assert text in ran.err and "PASS" not in ran.out


def test_limits_of_an_error_map_are_not_those_of_flip(tonetool, floor, renders):
    floor(*renders(4), modifiers=":command=errormap:metric=mse")
    ran = tonetool("ref.exr", "s00.exr", "--hdrflip:fail=limits.json", status=1)
    assert "for --errormap, not for --hdrflip" in ran.err and "PASS" not in ran.out
    ran = tonetool("ref.exr", "s00.exr", "--errormap:metric=smape:fail=limits.json", status=1)
    assert "metric=smape" in ran.err
    tonetool("ref.exr", "s00.exr", "--errormap:metric=mse:fail=limits.json")


BROKEN = {
    "half a file": lambda text: text[:len(text) // 2],
    "nothing": lambda text: "",
    "another format": lambda text: text.replace("tonetool-limits", "tonetool-check"),
    "another version": lambda text: text.replace('"version": 1', '"version": 2'),
    "another command": lambda text: text.replace('"command": "hdrflip"', '"command": "diff"'),
    "no limits": lambda text: json.dumps({**json.loads(text), "limits": []}),
    "a list": lambda text: f"[{text}]",
}


@pytest.mark.parametrize("how", BROKEN)
def test_a_broken_file_is_an_error_that_names_it(tonetool, calibrated, tmp_path, how):
    file = tmp_path / "limits.json"
    file.write_text(BROKEN[how](file.read_text(encoding="utf-8")), encoding="utf-8")
    ran = tonetool("ref.exr", "good.exr", "--hdrflip:fail=limits.json", status=1)
    assert "limits.json" in ran.err and "PASS" not in ran.out


@pytest.mark.parametrize("value", ["0.1", None, -1, 1, 7.5, "nan", "inf", [0.1]])
def test_a_limit_that_means_nothing_is_an_error(tonetool, calibrated, tmp_path, value):
    found = load(tmp_path / "limits.json")
    found["limits"][0]["limit"] = value
    (tmp_path / "limits.json").write_text(json.dumps(found), encoding="utf-8")
    ran = tonetool("ref.exr", "good.exr", "--hdrflip:fail=limits.json", status=1)
    assert "limits.json" in ran.err and "PASS" not in ran.out


def test_an_unknown_quantity_is_an_error(tonetool, calibrated, tmp_path):
    found = load(tmp_path / "limits.json")
    found["limits"][0]["quantity"] = "gain"
    (tmp_path / "limits.json").write_text(json.dumps(found), encoding="utf-8")
    ran = tonetool("ref.exr", "good.exr", "--hdrflip:fail=limits.json", status=1)
    assert '"gain"' in ran.err and "PASS" not in ran.out


# ---- limits of every frame

@pytest.fixture
def calibrated_frames(tonetool, put):
    """Two frames, each with limits from four seeds of its own; the second test is noisier."""
    for number in (1, 2):
        put(f"r.000{number}.exr", render(500 - number, spp=4096), "float")
        put(f"t.000{number}.exr", render(719 + number, spp=16 if number == 1 else 3))
        for seed in range(4):
            put(f"s{seed}.000{number}.exr", render(800 + 10 * number + seed))
    words = ["r.#.exr", *(f"s{seed}.#.exr" for seed in range(4))]
    tonetool("-q", *words, "--noisefloor", "limits.#.json")
    return words


def test_every_frame_has_its_limits(tonetool, calibrated_frames, tmp_path):
    kept = [limits_of(load(tmp_path / f"limits.000{number}.json")) for number in (1, 2)]
    assert kept[0] != kept[1]
    tonetool("r.#.exr", "t.#.exr", "--hdrflip:fail=limits.#.json:print=0", "--json", "c.json",
             status=3)
    frames = load(tmp_path / "c.json")["frames"]
    assert [frame["status"] for frame in frames] == ["passed", "failed"]
    for frame, limits in zip(frames, kept):
        used = {one["quantity"]: one["fail"] for one in frame["measurements"][0]["thresholds"]}
        assert used == limits


def test_a_frame_does_not_overwrite_the_limits_of_another(tonetool, calibrated_frames):
    ran = tonetool(*calibrated_frames, "--noisefloor", "limits.json", status=1)
    assert '"limits.json" was written by frame 1' in ran.err


# The numbers are in the files of the frames: of a merge, only that there were limits is known.
@pytest.mark.parametrize("change", [none])
def test_altered_limits_of_frames_are_refused(tonetool, calibrated_frames, merge_forged, tmp_path,
                                              change):
    tonetool("r.#.exr", "t.#.exr", "--hdrflip:fail=limits.#.json:print=0", "--json", "a.json",
             status=3)
    part = load(tmp_path / "a.json")
    change(part)
    ran = merge_forged(part)
    assert ran.status == 1 and '"forged.json": ' in ran.err
    assert not (tmp_path / "c.json").exists()


# ---- recipes

def test_a_recipe_writes_no_limits(tonetool, renders, tmp_path):
    words = renders(4)
    for file in ("limits.json", "-"):
        (tmp_path / "n.tone").write_text(
            f"tonetool 1\n{' '.join(words)} --noisefloor {file}\n", encoding="utf-8")
        ran = tonetool("n.tone", "-o", "x.exr", status=1)
        assert "noisefloor" in ran.err and "not allowed" in ran.err
        assert not (tmp_path / "limits.json").exists() and not (tmp_path / "x.exr").exists()


def test_a_limit_of_a_check_that_nothing_can_exceed_is_told_with_its_file(tonetool, make_image):
    """1.1 times a large error is more than any."""
    make_image("black.exr", 16, 16, pixels=np.full((16, 16, 3), 1e-3))
    make_image("white.exr", 16, 16, pixels=np.full((16, 16, 3), 1e3))
    line = ["black.exr", "white.exr", "--errormap:metric=smape:print=0:quantity=max"]
    tonetool(*line[:2], line[2] + ":fail=0.9999999", "--json", "lim.json")
    ran = tonetool(*line[:2], line[2] + ":fail=lim.json", status=1)
    assert "is out of range (valid: 0 to 1); it follows from what \"lim.json\" has measured" in ran.err
