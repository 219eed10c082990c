# SPDX-License-Identifier: BSD-3-Clause
"""Noise or change: the three verdicts of --biascheck, what they say, and what becomes of them."""

import csv
import io
import json
import os
import re
import shutil
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from conftest import TESTIMAGES, call

SIZE = 96
CLAIM = "each block of about 64x64 pixels differs by at most that, in Y, R, G and B"
MORE = "about {} times more samples are needed to show equality within 5 %"
LUMINANCE = (0.2126, 0.7152, 0.0722)


def picture(height=SIZE, width=SIZE):
    """Light that varies slowly, without noise."""
    y, x = np.mgrid[0:height, 0:width]
    light = 0.5 + 0.2 * np.sin(x / 11) + 0.15 * np.cos(y / 9)
    return np.stack([light * 1.1, light, light * 0.8], -1)


def render(seed, spp=16, gain=1.0, height=SIZE, width=SIZE):
    """The picture with the noise of so many samples per pixel, each exponentially distributed."""
    noise = np.random.default_rng(seed).gamma(spp, 1 / spp, (height, width, 1))
    return picture(height, width) * gain * noise


# 16 samples show that two seeds are equal within 5 %; 2 samples show nothing. The seeds are chosen
# so that none is one of the 1 % false alarms.
NOISY = {"spp": 2}


@pytest.fixture
def put(make_image):
    def write(name, pixels, kind="half", channels="RGB", **options):
        return make_image(name, pixels.shape[1], pixels.shape[0], list(channels), kind, pixels,
                          **options)

    return write


@pytest.fixture
def files(put):
    """Pairs that have each of the verdicts."""
    put("a.exr", render(1))
    pairs = {"equal": ("a.exr", put("b.exr", render(2))),
             "different": ("a.exr", put("bright.exr", render(3, gain=1.1))),
             "not enough samples": (put("n0.exr", render(20, **NOISY)),
                                    put("n1.exr", render(21, **NOISY)))}
    return pairs


@pytest.fixture
def judge(tonetool, tmp_path):
    """Runs --biascheck over the words and returns its measurement."""

    def run(*words, status=0, modifiers=""):
        tonetool(*words, f"--biascheck:print=0{modifiers}", "--json", "judge.json", status=status)
        (frame,) = load(tmp_path / "judge.json")["frames"]
        (measured,) = frame["measurements"]
        return measured

    return run


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


def case(path):
    """The one case of a JUnit file."""
    (found,) = ElementTree.parse(path).getroot().iter("testcase")
    return found


# ---- the three verdicts and what becomes of them

PASSED, MEASURED, WARNING, FAILED = "passed", "measured", "warning", "failed"
# Verdict, modifiers, status of the frame, exit status, exit status with --warnings-exit.
OUTCOMES = [
    ("equal", "", PASSED, 0, 0),
    ("equal", ":inconclusive=pass:fail=0", PASSED, 0, 0),
    ("different", "", FAILED, 3, 3),
    ("different", ":fail=1", FAILED, 3, 3),
    ("different", ":inconclusive=pass", FAILED, 3, 3),
    ("different", ":fail=0", WARNING, 0, 2),
    ("not enough samples", "", FAILED, 3, 3),
    ("not enough samples", ":fail=0", FAILED, 3, 3),
    ("not enough samples", ":inconclusive=fail", FAILED, 3, 3),
    ("not enough samples", ":inconclusive=warn", WARNING, 0, 2),
    ("not enough samples", ":inconclusive=pass", MEASURED, 0, 0),
]


@pytest.mark.parametrize("verdict, modifiers, status, plain, strict", OUTCOMES)
def test_exit_statuses(tonetool, files, tmp_path, verdict, modifiers, status, plain, strict):
    words = [*files[verdict], f"--biascheck{modifiers}"]
    ran = tonetool(*words, status=plain)
    last = ran.out.splitlines()[-1]
    mark = {PASSED: "PASS ", MEASURED: "", WARNING: "WARNING ", FAILED: "FAIL "}[status]
    assert last.startswith(f"biascheck: {mark}{verdict}") and files[verdict][1] in last
    assert (verdict in ran.err) == (status == WARNING)
    tonetool(*words, "--warnings-exit", status=strict)
    ran = tonetool(*words, "--json", "c.json", status=plain)
    assert re.search(f"^check: {status}, 1 .*: 1 {status}", ran.out, re.M)
    (frame,) = load(tmp_path / "c.json")["frames"]
    (measured,) = frame["measurements"]
    assert (frame["status"], measured["status"]) == (status, status)
    assert measured["verdict"] == verdict and measured["sentence"].startswith(verdict)
    assert ("evidence" in measured) == (verdict == "different")


def test_no_limit_at_all_is_still_no_pass(tonetool, files, tmp_path):
    """Neither verdict ends the run, but neither is called good."""
    for verdict, found, status in (("different", WARNING, 2), ("not enough samples", MEASURED, 0)):
        words = [*files[verdict], "--biascheck:fail=0:inconclusive=pass", "--json", "c.json"]
        tonetool(*words)
        assert load(tmp_path / "c.json")["verdict"] == found
        tonetool(*words, "--warnings-exit", status=status)


@pytest.mark.parametrize("verdict, modifiers, kind", [
    ("equal", "", None),
    ("different", "", "failure"),
    ("not enough samples", "", "failure"),
    ("not enough samples", ":inconclusive=warn", "skipped"),
    ("not enough samples", ":inconclusive=pass", "skipped"),
])
def test_junit(tonetool, files, tmp_path, verdict, modifiers, kind):
    status = 3 if kind == "failure" else 0
    tonetool(*files[verdict], f"--biascheck{modifiers}", "--junit", "c.xml", status=status)
    found = case(tmp_path / "c.xml")
    assert [child.tag for child in found if child.tag != "system-out"] == [kind] * bool(kind)
    if kind:
        assert f"biascheck: {verdict}: " in found.find(kind).get("message")


# ---- words

@pytest.mark.parametrize("what", ["fail", "warn", "pass"])
def test_what_is_not_decided_is_never_called_a_pass(tonetool, files, tmp_path, what):
    words = [*files["not enough samples"], f"--biascheck:inconclusive={what}"]
    for detail in ([], ["-v"], ["-q"], ["--json", "c.json"]):
        ran = tonetool(*detail, *words, status=3 if what == "fail" else 0)
        assert "pass" not in (ran.out + ran.err).lower()
    tonetool(*words, "--json", "c.json", "--csv", "c.csv", "--junit", "c.xml", "-o", "map.exr",
             "--report", "page.html", status=3 if what == "fail" else 0)
    found = load(tmp_path / "c.json")
    # The command line has the modifier as it was typed, and counts names every status there is.
    assert words[2] in found.pop("check") and found.pop("counts")["passed"] == 0
    assert "pass" not in json.dumps(found).lower()
    assert "pass" not in (tmp_path / "c.csv").read_text(encoding="utf-8").lower()
    assert "pass" not in (tmp_path / "c.xml").read_text(encoding="utf-8").lower()
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    result = json.loads(re.search(r'id="result">(.*?)</script>', page, re.S)[1])["shot"]
    assert "pass" not in json.dumps(result["frames"]).lower()


def test_what_is_not_decided_says_how_many_samples_are_needed(tonetool, files, judge):
    pair = files["not enough samples"]
    more = judge(*pair, status=3)["quantities"]["more"]
    assert 1 < more < 10
    assert MORE.format(f"{more:.2g}") in tonetool(*pair, "--biascheck", status=3).out
    # One standard error is to be smaller: by the sum of the quantiles, of 0.99 and the power.
    likely = judge(*pair, status=3, modifiers=":power=0.5")["quantities"]["more"]
    # z(.99) = 2.32635, z(.9) = 1.28155, z(.5) = 0; each is given to 6 digits.
    assert more / likely == pytest.approx(((2.32635 + 1.28155) / 2.32635) ** 2, rel=1e-4)


def test_one_times_more_samples_is_no_advice(judge, put):
    """Just short of being shown, by a difference that is there by chance: N is near 1."""
    names = [put(f"s{i}.exr", render(40 + i + 16 * (i // 4), **NOISY)) for i in range(8)]
    found = judge(*names, modifiers=":seeds=4", status=3)
    assert found["verdict"] == "not enough samples" and found["quantities"]["more"] < 1.1
    assert "about 1 times" not in found["sentence"] and "samples" in found["sentence"]


def test_equality_is_never_claimed_without_its_sentence(tonetool, files, put, tmp_path):
    pair = files["equal"]
    for detail in ([], ["-v"]):
        ran = tonetool(*detail, *pair, "--biascheck", "--json", "c.json", "--junit", "c.xml")
        lines = [line for line in ran.out.splitlines() if "equal" in line.lower()]
        assert lines and all("equal within 5 %: with 99 % confidence" in line and CLAIM in line and
                             "a smaller object may differ more" in line for line in lines)
    assert CLAIM in load(tmp_path / "c.json")["frames"][0]["measurements"][0]["sentence"]
    ran = tonetool(*pair, "--biascheck:within=0.04:print=0")
    assert "equal within 4 %" in ran.out and CLAIM in ran.out
    # Fixed differences: nothing is statistical, but the blocks are the same.
    put("dim.exr", render(1) * 0.99, "float")
    ran = tonetool("a.exr", "dim.exr", "--biascheck:print=0")
    assert "equal within 5 %" in ran.out and "64x64" in ran.out and "confidence" not in ran.out


def test_a_difference_that_is_real_and_small_is_said(tonetool, put, judge):
    put("q0.exr", render(30, spp=1024), "float")
    put("q1.exr", render(31, spp=1024, gain=1.01), "float")
    found = judge("q0.exr", "q1.exr")
    assert found["verdict"] == "equal" and "real" in found["sentence"]
    assert re.search(r"are real: light overall: Y \+(0\.9|1)\S* %", found["sentence"]), found["sentence"]
    assert judge("q0.exr", "q1.exr", modifiers=":within=0.005", status=3)["verdict"] == "different"


def test_brief_lines(tonetool, files):
    lines = tonetool(*files["different"], "--biascheck", status=3).out.splitlines()
    assert lines[0].startswith("biascheck: 1 reference, 1 test, 96x96, noise alike (asymmetry ")
    assert re.match(r"biascheck: gain \+0\.1\d+ \+- 0\.00\d+ \(Y\), weighted; energy \+0\.1",
                    lines[1])
    assert re.search("overall Y R G B; mean 16: .* of 36; mean 32: 9 of 9; mean 64: 4 of 4",
                     lines[2])
    assert "untested 0" in lines[2]
    assert lines[3].startswith("biascheck: bound 0.1") and "shown for 0 %" in lines[3]
    assert lines[4].startswith("biascheck: FAIL different") and len(lines) == 5
    (line,) = tonetool(*files["different"], "--biascheck:print=0", status=3).out.splitlines()
    assert line == lines[4]


def test_quiet_and_verbose(tonetool, files):
    assert tonetool("-q", *files["equal"], "--biascheck").out == ""
    assert "different" in tonetool("-q", *files["different"], "--biascheck", status=3).out
    ran = tonetool("-v", *files["equal"], "--biascheck")
    assert ran.fact("within") == "0.05" and ran.fact("alpha") == "0.01"
    assert ran.fact("reference") == "a.exr" and ran.fact("test") == "b.exr"
    assert ran.fact("references") == "1" and ran.fact("block-tests") == str(4 * (36 + 9 + 4))


# ---- results

NAMES = ["bound", "shown", "references", "tests", "nonfinite", "absolute", "asymmetry", "unlike",
         "correlation", "correlated", "untested", "block-tests"]


def test_the_json_is_what_its_schema_says(tonetool, files, tmp_path):
    schema = pytest.importorskip("jsonschema", reason="no python3-jsonschema here")
    description = load(TESTIMAGES.parent / "src" / "sequence" / "check.schema.json")
    for verdict, pair in files.items():
        status = 0 if verdict == "equal" else 3
        tonetool(*pair, "--biascheck", "--json", "c.json", status=status)
        found = load(tmp_path / "c.json")
        schema.validate(found, description)
        found["frames"][0]["measurements"][0]["verdict"] = "pass"
        with pytest.raises(schema.ValidationError):
            schema.validate(found, description)


def test_the_json_has_every_number(judge, files):
    found = judge(*files["equal"])
    numbers = found["quantities"]
    assert set(NAMES) <= set(numbers) and "more" not in numbers
    for channel in "YRGB":
        for name in ("gain", "gain-se", "z", "p", "energy", "energy-se", "rare"):
            assert f"{name}.{channel}" in numbers
    assert found["pixels"] == SIZE * SIZE
    assert found["parameters"]["within"] == 0.05 and found["parameters"]["alpha"] == 0.01
    assert found["settings"]["reason"] == "means within"
    assert numbers["bound"] <= 0.05 and numbers["shown"] == 1


def test_the_energy_is_the_ratio_of_the_sums(judge, put):
    reference, test = render(1).astype(np.float32), render(3, gain=1.1).astype(np.float32)
    put("a.exr", reference, "float"), put("b.exr", test, "float")
    numbers = judge("a.exr", "b.exr", status=3)["quantities"]
    sums = [pixels.astype(np.float64).sum((0, 1)) for pixels in (reference, test)]
    sums = [np.append(one, one @ LUMINANCE) for one in sums]
    for channel, r, t in zip("RGBY", *sums):
        # Differences are made in single precision: 2^-24 of each pixel.
        assert numbers[f"energy.{channel}"] == pytest.approx(t / r - 1, abs=1e-6)
        error = numbers[f"gain-se.{channel}"]
        assert numbers[f"gain.{channel}"] == pytest.approx(0.1, abs=4 * error)


def test_csv(tonetool, files, tmp_path):
    tonetool(*files["different"], "--biascheck", "--csv", "c.csv", "--json", "c.json", status=3)
    (row,) = csv.DictReader(io.StringIO((tmp_path / "c.csv").read_text(encoding="utf-8")))
    (measured,) = load(tmp_path / "c.json")["frames"][0]["measurements"]
    assert row["biascheck.verdict"] == "different" and row["status"] == "failed"
    assert row["message"] == f"biascheck: {measured['sentence']}"
    for name, value in measured["quantities"].items():
        assert float(row[f"biascheck.{name}"]) == value


def test_margin_and_level(judge, files):
    pair = files["not enough samples"]
    assert judge(*pair, modifiers=":within=0.2")["verdict"] == "equal"
    found = judge(*files["equal"], modifiers=":alpha=0.05")
    assert found["parameters"]["alpha"] == 0.05 and "with 95 % confidence" in found["sentence"]
    # A claim at a weaker level excludes more.
    assert found["quantities"]["bound"] < judge(*files["equal"])["quantities"]["bound"]


# ---- laws

def test_sides_that_are_swapped(judge, files):
    one, other = files["different"]
    there, back = (judge(*pair, status=3)["quantities"] for pair in ((one, other), (other, one)))
    assert there["energy.Y"] > 0 > back["energy.Y"]
    # T = (1 + g) R is R = T / (1 + g); doubles of sums in another order.
    assert (1 + there["energy.Y"]) * (1 + back["energy.Y"]) == pytest.approx(1, abs=1e-9)
    assert there["asymmetry"] == -back["asymmetry"]


def test_brighter_by_stops_is_the_same(judge, put):
    for name, factor in (("x", 1), ("y", 2 ** 5)):
        put(f"{name}0.exr", render(1).astype(np.float32) * factor, "float")
        put(f"{name}1.exr", render(3, gain=1.1).astype(np.float32) * factor, "float")
    plain, bright = (judge(f"{name}0.exr", f"{name}1.exr", status=3) for name in "xy")
    assert plain["quantities"] == bright["quantities"] and plain["evidence"] == bright["evidence"]


def test_a_transposed_picture_has_the_same_tests_of_means(tonetool, put, read):
    pair = render(1), render(3, gain=1.05)
    for name, turn in (("x", (0, 1, 2)), ("y", (1, 0, 2))):
        for i, pixels in enumerate(pair):
            put(f"{name}{i}.exr", pixels.transpose(turn), "float")
        tonetool(f"{name}0.exr", f"{name}1.exr", "--biascheck:map=p", "-o", f"{name}.exr", status=3)
    there, back = read("x.exr")[0], read("y.exr")[0]
    # 1e-5: the sums are in another order, and the map is single precision.
    np.testing.assert_allclose(back.transpose(1, 0, 2), there, rtol=1e-5)
    assert np.ptp(there) > 1


def test_light_that_both_have_changes_no_difference(judge, put):
    """A steady light on both sides: the same differences of a brighter picture."""
    pair = render(1).astype(np.float32), render(3, gain=1.1).astype(np.float32)
    for name, light in (("x", 0), ("y", 0.5)):
        for i, pixels in enumerate(pair):
            put(f"{name}{i}.exr", pixels.astype(np.float64) + light, "float")
    plain, lit = (judge(f"{name}0.exr", f"{name}1.exr", status=3)["quantities"] for name in "xy")
    light = pair[0].astype(np.float64).sum((0, 1)) @ LUMINANCE / SIZE ** 2
    # 1e-5: what is added costs a bit of the pixels.
    assert lit["energy.Y"] == pytest.approx(plain["energy.Y"] * light / (light + 0.5), rel=1e-5)
    assert lit["asymmetry"] == pytest.approx(plain["asymmetry"], abs=1e-4)


@pytest.mark.parametrize("verdict", ["different", "not enough samples"])
def test_threads_change_no_bit(tonetool, files, read, tmp_path, verdict):
    found = set()
    for threads in ("1", "4"):
        tonetool("--threads", threads, *files[verdict], "--biascheck:map=all", "-o", "map.exr",
                 "--json", "c.json", status=3)
        found.add((read("map.exr")[0].tobytes(), (tmp_path / "c.json").read_bytes()))
    assert len(found) == 1


# ---- seeds

@pytest.fixture
def seeds(put):
    """Four seeds of each side; those of the test are brighter."""
    references = [put(f"r{i}.exr", render(40 + i, spp=4)) for i in range(4)]
    return references, [put(f"t{i}.exr", render(50 + i, spp=4, gain=1.15)) for i in range(4)]


@pytest.mark.parametrize("modifiers, k, j", [("references=3", 3, 1), ("tests=3", 1, 3),
                                             ("seeds=2", 2, 2), ("seeds=4", 4, 4),
                                             ("references=4:tests=2", 4, 2),
                                             ("seeds=2:tests=3", 2, 3)])
def test_seeds_are_taken_in_stack_order(judge, seeds, modifiers, k, j):
    references, tests = seeds[0][:k], seeds[1][:j]
    found = judge(*references, *tests, modifiers=f":{modifiers}", status=3)
    assert found["verdict"] == "different"
    assert (found["quantities"]["references"], found["quantities"]["tests"]) == (k, j)
    assert found["quantities"]["gain.Y"] == pytest.approx(
        0.15, abs=4 * found["quantities"]["gain-se.Y"])  # 4 standard errors
    for side, names in (("references", references), ("tests", tests)):
        assert found["settings"].get(side, names[0]) == " ".join(names)


def test_more_seeds_show_more(judge, seeds, put):
    for i in range(4):
        put(f"s{i}.exr", render(60 + i, spp=4))
    one = judge(seeds[0][0], "s0.exr", status=3)["quantities"]
    four = judge(*seeds[0], *(f"s{i}.exr" for i in range(4)), modifiers=":seeds=4")
    assert four["verdict"] == "equal"
    # Four times the samples: half the standard error, which is itself an estimate (5 %).
    assert four["quantities"]["gain-se.Y"] == pytest.approx(one["gain-se.Y"] / 2, rel=0.1)


def test_the_order_of_seeds_changes_no_means(judge, seeds):
    references, tests = seeds[0][:2], seeds[1][:2]
    there = judge(*references, *tests, modifiers=":seeds=2", status=3)["quantities"]
    back = judge(*references[::-1], *tests[::-1], modifiers=":seeds=2", status=3)["quantities"]
    for name, value in there.items():
        assert back[name] == pytest.approx(value, rel=1e-6, abs=1e-9), name  # sums of floats


def test_seeds_of_sequences(tonetool, seeds, tmp_path):
    for i, (one, other) in enumerate(zip(*(side[:2] for side in seeds))):
        for number in (1, 2):
            shutil.copy(tmp_path / one, tmp_path / f"r{i}.000{number}.exr")
            shutil.copy(tmp_path / other, tmp_path / f"t{i}.000{number}.exr")
    words = ["r0.#.exr", "r1.#.exr", "t0.#.exr", "t1.#.exr", "--biascheck:seeds=2:print=0",
             "--json", "c.json"]
    tonetool(*words, status=3)
    frames = load(tmp_path / "c.json")["frames"]
    assert [frame["status"] for frame in frames] == ["failed", "failed"]
    assert frames[1]["measurements"][0]["settings"]["references"] == "r0.0002.exr r1.0002.exr"
    (tmp_path / "r1.0002.exr").unlink()
    tonetool(*words, status=1)
    assert [frame["status"] for frame in load(tmp_path / "c.json")["frames"]] == ["failed",
                                                                                  "missing"]


def test_too_few_images_are_an_error(tonetool, seeds):
    (a, b, *_), (c, d, *_) = seeds
    for words, needed in (([a, "--biascheck"], 2), ([a, b, "--biascheck:seeds=2"], 4),
                          ([a, b, c, "--biascheck:references=3"], 4),
                          ([a, b, c, d, "--biascheck:tests=4"], 5)):
        ran = tonetool(*words, status=1)
        assert f"needs {needed} image(s), the stack has {len(words) - 1}" in ran.err
    assert tonetool("--biascheck", status=1).err


def test_one_render_twice_is_not_two_seeds(tonetool, seeds, tmp_path):
    (a, b, *_), (c, d, *_) = seeds
    os.link(tmp_path / a, tmp_path / "hard.exr")
    os.symlink(a, tmp_path / "soft.exr")
    for words in ([a, a, c, d], [a, "hard.exr", c, d], [a, "soft.exr", c, d], [a, b, c, c]):
        ran = tonetool(*words, "--biascheck:seeds=2", status=1)
        assert "are the same file" in ran.err and not ran.out


def test_a_copy_of_a_render_is_no_seed(tonetool, seeds, tmp_path):
    """Another file, but not another seed."""
    (a, *_), (c, *_) = seeds
    shutil.copy(tmp_path / c, tmp_path / "copy.exr")
    ran = tonetool(a, c, "copy.exr", "--biascheck:tests=2:fail=0", status=1)
    assert "are the same image" in ran.err


def test_a_picture_of_nans_is_no_matter_of_samples(tonetool, put):
    """A stray one is a pixel less; more than one in a hundred is an error, whatever may be undecided."""
    put("a.exr", render(4))
    holes = {}
    for name, count in (("few", 92), ("many", 93)):  # of 9216
        holes[name] = render(3)
        holes[name].reshape(-1, 3)[:count, 1] = np.nan
        put(f"{name}.exr", holes[name], "float")
    ran = tonetool("a.exr", "many.exr", "--biascheck:inconclusive=pass", status=1)
    assert "93 of 9216 pixels are NaN or Inf" in ran.err
    ran = tonetool("a.exr", "few.exr", "--biascheck:inconclusive=pass")
    assert "of 92 pixel(s), which are NaN or Inf, nothing is known" in ran.out


def test_versions_that_are_mixed_in_one_side_are_told(tonetool, put):
    """In the wrong order on the stack, each side has both versions, and their difference in its noise."""
    names = [put(f"v{i}.exr", render(600 + i, gain=1.2 if i % 2 else 1)) for i in range(4)]
    ran = tonetool(*names, "--biascheck:seeds=2:within=0.3:inconclusive=pass", status=1)
    assert "seeds 1 and 2 of the reference differ in more than their noise" in ran.err
    assert "references come first" in ran.err
    right = [names[i] for i in (0, 2, 1, 3)]
    assert "FAIL different" in tonetool(*right, "--biascheck:seeds=2", status=3).out


def test_a_file_on_both_sides_is_a_warning(tonetool, seeds, tmp_path):
    (a, b, *_), (c, *_) = seeds
    for words in ([a, a], [a, b, b, a]):
        modifiers = f":seeds={len(words) // 2}:fail=0:inconclusive=pass"
        ran = tonetool(*words, f"--biascheck{modifiers}", "--warnings-exit", status=2)
        assert "are the same file" in ran.err
        tonetool(*words, f"--biascheck{modifiers}", "--json", "c.json")
        assert load(tmp_path / "c.json")["verdict"] == "warning"


# ---- which pixels

HALVES = [f"{layer}{c}" for layer in ("", "A.", "B.") for c in "RGB"]


@pytest.fixture
def layered(put):
    """Files of a beauty that is 30 % brighter in the test, and of two halves that are not."""
    parts = {}
    for name, seed, gain in (("one", 70, 1), ("two", 80, 1.3)):
        parts[name] = [render(seed, gain=gain), render(seed + 1), render(seed + 2)]
        put(f"{name}.exr", np.concatenate(parts[name], -1), channels=HALVES)
        for i, layer in enumerate("AB", 1):
            put(f"{name}{layer}.exr", parts[name][i])
    return "one.exr", "two.exr"


def test_layers(judge, tonetool, layered):
    assert judge(*layered, modifiers=":layer=R,G,B", status=3)["verdict"] == "different"
    found = judge(*layered, modifiers=":layer=A")
    assert found["verdict"] == "equal" and found["settings"]["test-layer"].startswith("A")
    ran = tonetool(*layered, "--biascheck:layer=C", status=1)
    assert 'no colour layer "C"' in ran.err and "one.exr" in ran.err


def test_halves_count_as_two_seeds(judge, layered):
    halves = judge(*layered, modifiers=":halves=A,B")
    assert halves["quantities"]["references"] == halves["quantities"]["tests"] == 2
    apart = judge("oneA.exr", "oneB.exr", "twoA.exr", "twoB.exr", modifiers=":seeds=2")
    assert halves["quantities"] == apart["quantities"]
    assert halves["sentence"] == apart["sentence"]


@pytest.mark.parametrize("halves, text", [("A", "two different layers"),
                                          ("A,A", "two different layers"),
                                          ("A,C", '"C"'), ("A,B,A", "two different layers"),
                                          ("A,B:layer=A", "exclude each other")])
def test_halves_that_are_none(tonetool, layered, tmp_path, halves, text):
    before = sorted(os.listdir(tmp_path))
    ran = tonetool(*layered, f"--biascheck:halves={halves}", "-o", "x.exr", status=1)
    assert text in ran.err and "tonetool ERROR: biascheck : " in ran.err
    assert sorted(os.listdir(tmp_path)) == before


def test_colour_spaces(judge, put):
    reference = render(1)
    put("a.exr", reference, "float"), put("b.exr", reference * (1.2, 1, 1), "float")
    # ACEScg to linear Rec.709, first row, to five digits.
    row = np.array((1.70505, -0.62179, -0.08326))
    means = reference.mean((0, 1))
    expected = row @ (means * (1.2, 1, 1)) / (row @ means) - 1
    found = judge("a.exr", "b.exr", modifiers=":from=acescg", status=3)
    assert found["quantities"]["energy.R"] == pytest.approx(expected, abs=1e-4)
    assert found["settings"]["test-space"] == "acescg"
    plain = judge("a.exr", "b.exr", status=3)["quantities"]
    # 1e-6: the pixels are single precision.
    assert plain["energy.R"] == pytest.approx(0.2, abs=1e-6) and plain["energy.G"] == 0


def test_windows_that_differ(tonetool, judge, put, tmp_path):
    large = render(9, height=128, width=128)
    put("a.exr", render(1)), put("large.exr", large), put("part.exr", large[:SIZE, :SIZE])
    ran = tonetool("a.exr", "large.exr", "--biascheck", "-o", "x.exr", status=1)
    assert "display window" in ran.err and "crop=" in ran.err
    tonetool("a.exr", "large.exr", "--biascheck", "--json", "c.json", status=1)
    assert load(tmp_path / "c.json")["verdict"] == "size mismatch"
    assert not (tmp_path / "x.exr").exists()
    cropped = judge("a.exr", "large.exr", modifiers=":crop=1")
    assert cropped["quantities"] == judge("a.exr", "part.exr")["quantities"]
    ran = tonetool("a.exr", "large.exr", "--biascheck:crop=1:resize=1", status=1)
    assert "exclude each other" in ran.err


def test_tests_are_resized_to_the_reference(judge, put, tonetool, read):
    put("grey.exr", np.full((SIZE, SIZE, 3), 0.5)), put("wide.exr", np.full((128, 128, 3), 0.5))
    put("light.exr", np.full((128, 128, 3), 0.6))
    assert judge("grey.exr", "wide.exr", modifiers=":resize=1")["verdict"] == "equal"
    found = judge("grey.exr", "light.exr", modifiers=":resize=1", status=3)
    assert found["verdict"] == "different" and found["pixels"] == SIZE * SIZE
    tonetool("grey.exr", "light.exr", "--biascheck:resize=1", "-o", "map.exr", status=3)
    assert read("map.exr")[0].shape[:2] == (SIZE, SIZE)


# ---- odd pictures

def test_identical_and_rounded(judge, tonetool, put):
    noise = render(1)
    put("a.exr", noise), put("same.exr", noise), put("fine.exr", noise, "float")
    found = judge("a.exr", "same.exr")
    assert (found["verdict"], found["settings"]["reason"]) == ("equal", "identical")
    assert "every pixel is the same" in found["sentence"]
    for words in (("a.exr", "fine.exr"), ("fine.exr", "a.exr")):
        found = judge(*words)
        assert (found["verdict"], found["settings"]["reason"]) == ("equal", "rounding")
        assert "rounding of half" in found["sentence"]
    assert "asymmetry" not in tonetool("a.exr", "fine.exr", "--biascheck").out


def test_pixels_that_are_no_numbers_bar_equality(judge, tonetool, put):
    noise, broken = render(1), render(1)
    broken[5, 7], broken[50, 60, 1] = np.nan, np.inf
    put("a.exr", noise, "float"), put("holes.exr", broken, "float"), put("b.exr", render(2))
    put("bright.exr", render(3, gain=1.1))
    for words in (("a.exr", "holes.exr"), ("holes.exr", "a.exr"), ("holes.exr", "b.exr")):
        found = judge(*words, status=3)
        assert (found["verdict"], found["quantities"]["nonfinite"]) == ("not enough samples", 2)
        assert found["settings"]["reason"] == "non-finite pixels"
        assert "2 pixel(s)" in tonetool(*words, "--biascheck", status=3).err
    found = judge("holes.exr", "bright.exr", status=3)
    assert found["verdict"] == "different" and found["quantities"]["nonfinite"] == 2
    tonetool("holes.exr", "b.exr", "--biascheck:inconclusive=pass", "--warnings-exit", status=2)


def test_black_and_negative(judge, put):
    noise = render(1)
    put("a.exr", noise), put("minus.exr", -noise), put("minus2.exr", -render(2))
    for name in ("black", "dark"):
        put(f"{name}.exr", noise * 0)
    assert judge("black.exr", "dark.exr")["verdict"] == "equal"
    for words in (("black.exr", "a.exr"), ("a.exr", "black.exr"), ("a.exr", "minus.exr")):
        assert judge(*words, status=3)["verdict"] == "different"
    lost = judge("a.exr", "minus.exr", status=3)["quantities"]
    # Nothing is clamped: all light is there twice, with the other sign. 1e-9: sums of doubles.
    assert lost["energy.Y"] == pytest.approx(-2, abs=1e-9)
    assert judge("minus.exr", "minus2.exr")["verdict"] == "equal"


@pytest.mark.parametrize("height, width", [(1, 1), (65, 63), (63, 65), (1, 4095)])
def test_a_picture_that_is_too_small(judge, put, tonetool, height, width):
    noise = render(1, height=height, width=width)
    put("a.exr", noise), put("b.exr", noise * 2), put("c.exr", noise)
    for other in ("b.exr", "c.exr"):
        found = judge("a.exr", other, status=3)
        assert found["verdict"] == "not enough samples"
        assert found["settings"]["reason"] == "image too small" and "4096" in found["sentence"]
    # More samples would not help: it is not excused.
    tonetool("a.exr", "b.exr", "--biascheck:inconclusive=pass", "-o", "map.exr", status=3)


@pytest.mark.parametrize("height, width, blocks", [(64, 64, 16 + 4 + 1), (1, 4096, 256 + 128 + 64),
                                                   (4096, 1, 256 + 128 + 64),
                                                   (100, 75, 6 * 5 + 3 * 2 + 2 * 1)])
def test_sizes_that_are_no_multiple_of_a_block(judge, put, tonetool, read, height, width, blocks):
    size = {"height": height, "width": width}
    put("a.exr", render(1, **size)), put("b.exr", render(2, gain=1.5, **size))
    found = judge("a.exr", "b.exr", status=3)
    assert found["verdict"] == "different"
    assert found["quantities"]["block-tests"] == 4 * blocks
    tonetool("a.exr", "b.exr", "--biascheck", "-o", "map.exr", status=3)
    pixels, _ = read("map.exr")
    assert pixels.shape == (height, width, 3) and np.isfinite(pixels).all()


def test_fixed_light_has_no_noise(judge, put, tonetool, read):
    for name, light in (("grey", 0.5), ("light", 0.625)):
        put(f"{name}.exr", np.full((SIZE, SIZE, 3), light))
    found = judge("grey.exr", "light.exr", status=3)
    assert found["verdict"] == "different"
    # 1e-9: the weights of luminance are no binary fractions.
    assert found["quantities"]["energy.Y"] == pytest.approx(0.25, abs=1e-9)
    tonetool("grey.exr", "light.exr", "--biascheck:map=p", "-o", "map.exr", status=3)
    assert (read("map.exr")[0] == -300).all()  # p is 0: its logarithm ends here


def test_filtered_pictures_are_told(judge, put):
    def filtered(seed):
        noise = np.pad(render(seed, spp=4), ((1, 1), (1, 1), (0, 0)), mode="wrap")
        return sum(noise[y:y + SIZE, x:x + SIZE] for y in range(3) for x in range(3)) / 9

    put("a.exr", filtered(1)), put("b.exr", filtered(2))
    found = judge("a.exr", "b.exr", status=3)
    assert found["verdict"] == "not enough samples" and found["quantities"]["correlated"] == 1
    assert found["settings"]["reason"] == "correlated pixels" and "denoised" in found["sentence"]
    assert "times more samples" not in found["sentence"]


def test_noise_of_the_reference(judge, put):
    put("fine.exr", render(1, spp=4096), "float"), put("rough.exr", render(2))
    put("rough2.exr", render(3))
    assert judge("fine.exr", "rough.exr")["quantities"]["unlike"] == 1
    assert judge("rough.exr", "fine.exr")["quantities"]["unlike"] == -1
    assert judge("rough.exr", "rough2.exr")["quantities"]["unlike"] == 0
    for pair, modifier, unlike in ((("fine.exr", "rough.exr"), "alike", 0),
                                   (("rough.exr", "rough2.exr"), "converged", 1)):
        found = judge(*pair, modifiers=f":reference={modifier}")
        assert found["quantities"]["unlike"] == unlike
        assert found["settings"]["noise-of-reference"] == modifier


# ---- maps

GREY = (1, 1, 1)
MAPS = {"signed": {"difference", "halfwidth", "confidence"}, "p": {"p16", "p32", "p64"},
        "rejected": {"means", "structures"}}
MAPS["all"] = MAPS["signed"] | MAPS["p"] | MAPS["rejected"]


@pytest.fixture
def patched(put):
    """Grey renders; one block of 16 pixels of the test is half as bright again."""
    reference, test = (render(seed)[..., 1:2] * GREY for seed in (1, 2))
    test[32:48, 16:32] *= 1.5
    put("a.exr", reference, "float"), put("b.exr", test, "float")
    return reference.astype(np.float32)[..., 0], test.astype(np.float32)[..., 0]


def planes(read, name):
    pixels, spec = read(name)
    return {channel: pixels[..., i] for i, channel in enumerate(spec.channelnames)}


def relative(d, reference, rows, columns):
    level = max(abs(reference[rows, columns].mean()), 0.02 * reference.mean())
    return d[rows, columns].mean() / level


def test_the_map_shows_the_finest_block_that_differs(tonetool, patched, read):
    tonetool("a.exr", "b.exr", "--biascheck:map=all", "-o", "map.exr", status=3)
    found = planes(read, "map.exr")
    reference, test = (pixels.astype(np.float64) for pixels in patched)
    d = test - reference
    block = np.s_[32:48, 16:32]
    # 1e-5: sums of float differences.
    assert found["difference"][block] == pytest.approx(relative(d, reference, *block), rel=1e-5)
    # Student's quantile of 0.99 with 255 degrees is 2.34085 (to six digits).
    half = 2.34085 * d[block].std(ddof=1) / 16 / reference[block].mean()
    assert found["halfwidth"][block] == pytest.approx(half, rel=1e-4)
    assert (found["confidence"][block] > 0.9999).all() and (found["p16"][block] < -4).all()
    assert (found["means"][block] >= 1).all()
    far = np.s_[64:96, 64:96]  # a block of 32 pixels without any change
    assert found["difference"][far] == pytest.approx(relative(d, reference, *far), rel=1e-5)
    assert (found["means"][far] == 0).all() and (found["structures"][far] == 0).all()
    assert found["confidence"][far].max() < 0.99
    for name in ("p16", "p32", "p64"):
        assert found[name].max() <= 0
        assert np.ptp(found[name][block]) == 0
    # One block is brighter by 0.5, which is 0.125 of the 32-block and 0.055 of the whole.
    assert found["difference"][block].mean() == pytest.approx(0.5, abs=0.15)


def test_maps_are_parts_of_all(tonetool, patched, read):
    tonetool("a.exr", "b.exr", "--biascheck:map=all", "-o", "all.exr", status=3)
    whole = planes(read, "all.exr")
    for name, channels in {"": MAPS["signed"], **MAPS}.items():
        modifier = f":map={name}" if name else ""
        tonetool("a.exr", "b.exr", f"--biascheck{modifier}", "-o", "map.exr", status=3)
        part = planes(read, "map.exr")
        assert set(part) == channels
        assert all(np.array_equal(part[channel], whole[channel]) for channel in channels)
    pixels, spec = read("all.exr")
    assert pixels.shape == (SIZE, SIZE, 8) and spec.format == "float"


def test_what_was_not_tested_is_marked(tonetool, judge, put, read):
    """Darker blocks of skewed noise against a converged reference: too few effective pixels."""
    reference, test = picture()[..., 1:2] * GREY, render(6, spp=0.2, gain=0.8)[..., 1:2] * GREY
    put("clean.exr", reference, "float"), put("skewed.exr", test, "float")
    words = ("clean.exr", "skewed.exr")
    found = judge(*words, modifiers=":reference=converged", status=3)
    tonetool(*words, "--biascheck:reference=converged:map=all", "-o", "map.exr", status=3)
    shown = planes(read, "map.exr")
    untested = shown["means"] == -1
    assert found["quantities"]["untested"] > 0 and untested.any() and not untested.all()
    assert (shown["p16"][untested] == 0).all()
    d = (test - reference)[..., 0].reshape(6, 16, 6, 16).mean((1, 3))
    dark = np.repeat(np.repeat(d < 0, 16, 0), 16, 1)
    assert dark[untested].all()
    alike = judge(*words, modifiers=":reference=alike", status=3)
    assert alike["quantities"]["untested"] == 0


def test_attributes_of_the_map(tonetool, files, read, tmp_path):
    for verdict, pair in files.items():
        status = 0 if verdict == "equal" else 3
        tonetool(*pair, "--biascheck", "-o", "map.exr", "--json", "c.json", status=status)
        _, spec = read("map.exr")
        (measured,) = load(tmp_path / "c.json")["frames"][0]["measurements"]
        assert spec.getattribute("Bias:verdict") == verdict
        assert spec.getattribute("Bias:sentence") == measured["sentence"]
        for name, value in measured["quantities"].items():
            # Attributes are single precision.
            assert float(spec.getattribute(f"Bias:{name}")) == pytest.approx(value, rel=1e-6), name
        assert spec.getattribute("Bias:within") == pytest.approx(0.05)


# ---- sequences

@pytest.fixture
def shot(put):
    """Four frames; the third is brighter."""
    for number in range(1, 5):
        put(f"r.{number:04d}.exr", render(100 + number))
        put(f"t.{number:04d}.exr", render(200 + number, gain=1.1 if number == 3 else 1))
    return "r.#.exr", "t.#.exr"


STATUSES = ["passed", "passed", "failed", "passed"]
CHANCE = "false alarms of biascheck to be expected: at most {}"


def alphas(found):
    return {frame["measurements"][0]["parameters"]["alpha"] for frame in found["frames"]
            if "measurements" in frame}


def test_every_frame_is_judged(tonetool, shot, tmp_path):
    ran = tonetool(*shot, "--biascheck:print=0", "--json", "c.json", "--csv", "c.csv", "--junit",
                   "c.xml", status=3)
    found = load(tmp_path / "c.json")
    assert [frame["status"] for frame in found["frames"]] == STATUSES
    assert found["worst"] == [{"frame": 3}] and alphas(found) == {0.01}
    (line,) = [line for line in ran.out.splitlines() if line.startswith("check: ")]
    assert line.startswith("check: failed, 4 frames: 1 failed, 3 passed; ")
    assert CHANCE.format("0.04") in line and CHANCE.format("0.04") in found["sentence"]
    rows = list(csv.DictReader(io.StringIO((tmp_path / "c.csv").read_text(encoding="utf-8"))))
    assert [row["biascheck.verdict"] for row in rows] == ["equal", "equal", "different", "equal"]
    assert ElementTree.parse(tmp_path / "c.xml").getroot().find("testsuite").get("failures") == "1"


@pytest.mark.parametrize("frames, alpha, chance", [
    ("each", 0.01, "0.04"), ("family", 0.0025, "0.01"), ("4", 0.0025, "0.01"),
    ("10", 0.001, "0.004")])
def test_a_family_shares_its_false_alarms(tonetool, shot, tmp_path, frames, alpha, chance):
    ran = tonetool(*shot, f"--biascheck:frames={frames}", "--json", "c.json", status=3)
    found = load(tmp_path / "c.json")
    assert alphas(found) == {alpha} and CHANCE.format(chance) in ran.out
    assert [frame["status"] for frame in found["frames"]] == STATUSES


def test_a_family_with_a_level_of_its_own(tonetool, shot, tmp_path):
    tonetool(*shot, "--biascheck:frames=family:alpha=0.04", "--json", "c.json", status=3)
    assert alphas(load(tmp_path / "c.json")) == {0.01}


def test_missing_frames_never_pass(tonetool, shot, tmp_path):
    (tmp_path / "t.0002.exr").unlink()
    (tmp_path / "t.0004.exr").write_bytes(b"")
    for frames in ("each", "family"):
        tonetool(*shot, f"--biascheck:frames={frames}:fail=0:inconclusive=pass", "--json", "c.json",
                 status=1)
        found = load(tmp_path / "c.json")
        assert [frame["status"] for frame in found["frames"]] == ["passed", "missing", "warning",
                                                                  "unreadable"]
        # The family are the frames that were asked for, not those that could be read.
        assert alphas(found) == {0.01 if frames == "each" else 0.0025}


def test_frames_at_once_give_the_same_bytes(tonetool, shot, tmp_path):
    for jobs in ("1", "3"):
        tonetool("--parallel-frames", jobs, *shot, "--biascheck:print=0:frames=family", "--json",
                 f"{jobs}.json", "--csv", f"{jobs}.csv", status=3)
    for kind in ("json", "csv"):
        assert (tmp_path / f"1.{kind}").read_bytes() == (tmp_path / f"3.{kind}").read_bytes()


def test_a_state_is_resumed(tonetool, shot, tmp_path, put):
    words = [*shot, "--biascheck:frames=family", "--json", "c.json"]
    tonetool(*words, status=3)
    whole = (tmp_path / "c.json").read_bytes()
    for _ in range(2):
        tonetool(*words, "--state", "s", status=3)
        assert (tmp_path / "c.json").read_bytes() == whole
    kept = {file.name: file.stat().st_mtime_ns for file in (tmp_path / "s").iterdir()}
    put("t.0003.exr", render(203))
    tonetool(*words, "--state", "s")
    changed = {name for name, old in kept.items()
               if (tmp_path / "s" / name).stat().st_mtime_ns != old}
    assert changed == {"frame.0003.json"}


def test_another_number_of_frames_is_another_test(tonetool, shot, tmp_path):
    """Frames of a family of two were tested at another level than those of a family of four."""
    words = [*shot, "--biascheck:frames=family"]
    tonetool(*words, "--json", "fresh.json", status=3)
    tonetool("--frames", "1-2", *words, "--json", "part.json", "--state", "s")
    assert alphas(load(tmp_path / "part.json")) == {0.005}
    tonetool(*words, "--json", "c.json", "--state", "s", status=3)
    assert (tmp_path / "c.json").read_bytes() == (tmp_path / "fresh.json").read_bytes()


# ---- parts

@pytest.fixture
def parts_of(program, shot, tmp_path):
    """Checks ranges of the shot one by one, and returns the names of the results."""

    def run(frames, *ranges):
        for part in ranges:
            call(program, ["--frames", part, *shot, f"--biascheck:frames={frames}", "--json",
                           f"part{part}.json"], tmp_path)
        return [f"part{part}.json" for part in ranges]

    return run


@pytest.mark.parametrize("frames", ["4", "each"])
def test_parts_merge_to_the_bytes_of_the_single_run(tonetool, shot, parts_of, tmp_path, frames):
    tonetool(*shot, f"--biascheck:frames={frames}", "--json", "whole.json", "--csv", "whole.csv",
             status=3)
    names = parts_of(frames, "3-4", "1-2")
    ran = tonetool("--merge", *names, "--json", "merged.json", "--csv", "merged.csv", status=3)
    for kind in ("json", "csv"):
        assert ((tmp_path / f"merged.{kind}").read_bytes() ==
                (tmp_path / f"whole.{kind}").read_bytes())
    assert CHANCE.format("0.01" if frames == "4" else "0.04") in ran.out


def test_parts_of_other_families_do_not_fit(tonetool, parts_of, tmp_path):
    names = parts_of("family", "1", "2-4")
    ran = tonetool("--merge", *names, "--json", "merged.json", status=1)
    assert "is not of the same check" in ran.err and not (tmp_path / "merged.json").exists()


def measured_of(part):
    return part["frames"][0]["measurements"][0]


def call_it(part, status, verdict=None):
    """All that a hand would change so that the frame has this status."""
    frame, measured = part["frames"][0], measured_of(part)
    for name in part["counts"]:
        part["counts"][name] = int(name == status)
    frame["status"] = measured["status"] = part["verdict"] = status
    part["sentence"] = f"{part['sentence'].split(':')[0]}: 1 {status}"
    frame.pop("message", None)
    if verdict:
        measured["verdict"] = verdict
        measured["sentence"] = measured["sentence"].replace("different", verdict, 1).replace(
            "not enough samples", verdict, 1)


def of_equal(part):
    """As a program would write an equal frame, but with the numbers of the other."""
    call_it(part, "passed", "equal")
    measured = measured_of(part)
    measured.pop("evidence", None)
    limits = {"higher_is_better": False, "value": 0.0, "fail": 0.0}
    measured["thresholds"] = [{"quantity": name, **limits} for name in ("different", "undecided")]


def no_thresholds(part):
    call_it(part, "measured")
    measured_of(part).pop("thresholds")


def no_verdict(part):
    of_equal(part)
    measured_of(part).pop("verdict")


def no_evidence(part):
    measured_of(part)["evidence"] = []


FORGERIES = {
    "verdict": lambda part: measured_of(part).update(verdict="equal"),
    "verdict and status": lambda part: call_it(part, "passed", "equal"),
    "all but the numbers": of_equal,
    "no thresholds": no_thresholds,
    "no verdict": no_verdict,
    "another verdict": lambda part: measured_of(part).update(verdict="fine"),
    "higher limit": lambda part: measured_of(part)["thresholds"][0].update(fail=1.0),
    "alpha": lambda part: measured_of(part)["parameters"].update(alpha=0.3),
    "within": lambda part: measured_of(part)["parameters"].update(within=3.0),
    "no evidence": no_evidence,
    "another sentence": lambda part: measured_of(part).update(sentence="equal within 5 %"),
    "status of the frame": lambda part: part["frames"][0].update(status="passed"),
    "verdict of the check": lambda part: part.update(verdict="passed"),
}


@pytest.fixture(scope="module")
def kept_results():
    return {}


@pytest.fixture
def result_of(tonetool, files, tmp_path, kept_results):
    """The result of a pair that has this verdict, measured once for all tests."""

    def run(verdict, modifiers=""):
        if (verdict, modifiers) not in kept_results:
            status = 0 if verdict == "equal" or modifiers else 3
            tonetool(*files[verdict], f"--biascheck{modifiers}", "--json", "a.json", status=status)
            kept_results[verdict, modifiers] = (tmp_path / "a.json").read_text(encoding="utf-8")
        return json.loads(kept_results[verdict, modifiers])

    return run


@pytest.fixture
def is_refused(tonetool, tmp_path):
    """A merge of this result is an error that names the file; returns what it says."""

    def run(part):
        (tmp_path / "forged.json").write_text(json.dumps(part))
        ran = tonetool("--merge", "forged.json", "--json", "c.json", status=1)
        assert '"forged.json": ' in ran.err and not (tmp_path / "c.json").exists()
        return ran.err

    return run


# Only what is different has evidence.
@pytest.mark.parametrize("verdict, forgery", [
    (verdict, name) for verdict in ("different", "not enough samples") for name in FORGERIES
    if (verdict, name) != ("not enough samples", "no evidence")])
def test_altered_results_are_refused(result_of, is_refused, verdict, forgery):
    part = result_of(verdict)
    FORGERIES[forgery](part)
    is_refused(part)


@pytest.mark.parametrize("forgery", ["verdict", "verdict and status", "all but the numbers",
                                     "no thresholds", "no verdict", "alpha", "status of the frame"])
def test_what_was_not_decided_cannot_be_made_a_pass(result_of, is_refused, forgery):
    """Under inconclusive=pass there is no threshold of its own that would catch it."""
    part = result_of("not enough samples", ":inconclusive=pass")
    FORGERIES[forgery](part)
    is_refused(part)


def test_a_measurement_that_was_taken_out_is_missed(tonetool, files, tmp_path, is_refused):
    pair = files["not enough samples"]
    tonetool(*pair, "--biascheck", *pair, "--hdrflip:fail=0.9", "--json", "a.json", status=3)
    part = load(tmp_path / "a.json")
    part["frames"][0]["measurements"].pop(0)
    call_it(part, "passed")
    assert "has 0 measurements by biascheck" in is_refused(part)


@pytest.mark.parametrize("name", ["alpha", "within"])
@pytest.mark.parametrize("verdict", ["equal", "different", "not enough samples"])
def test_results_without_their_level_are_refused(result_of, is_refused, verdict, name):
    part = result_of(verdict)
    measured_of(part)["parameters"].pop(name)
    is_refused(part)


def test_statuses_alone_change_nothing(tonetool, files, tmp_path):
    """Statuses follow from the thresholds, which a merge compares again."""
    for verdict in ("different", "not enough samples"):
        tonetool(*files[verdict], "--biascheck", "--json", "a.json", status=3)
        part = load(tmp_path / "a.json")
        call_it(part, "passed")
        (tmp_path / "forged.json").write_text(json.dumps(part))
        tonetool("--merge", "forged.json", "--json", "c.json", status=3)
        found = load(tmp_path / "c.json")
        assert found["verdict"] == found["frames"][0]["status"] == "failed"
        assert measured_of(found)["status"] == "failed"


def test_results_as_they_were_written_merge(tonetool, files, tmp_path):
    for verdict, modifier, status in (("equal", "", 0), ("different", "", 3),
                                      ("different", ":fail=0", 0), ("not enough samples", "", 3),
                                      ("not enough samples", ":inconclusive=warn", 0),
                                      ("not enough samples", ":inconclusive=pass", 0)):
        tonetool(*files[verdict], f"--biascheck{modifier}", "--json", "a.json", status=status)
        tonetool("--merge", "a.json", "--json", "c.json", status=status)
        assert (tmp_path / "a.json").read_bytes() == (tmp_path / "c.json").read_bytes()


# ---- beside HDR-FLIP

@pytest.mark.parametrize("verdict, limit, status", [
    ("equal", 0.9, "passed"), ("equal", 0.001, "failed"), ("different", 0.9, "failed"),
    ("different", 0.001, "failed"), ("not enough samples", 0.9, "failed")])
def test_both_must_hold(tonetool, files, tmp_path, verdict, limit, status):
    pair = files[verdict]
    for words in ([*pair, f"--hdrflip:fail={limit}", *pair, "--biascheck"],
                  [*pair, "--biascheck", *pair, f"--hdrflip:fail={limit}"]):
        tonetool(*words, "--json", "c.json", status=0 if status == "passed" else 3)
        found = load(tmp_path / "c.json")
        assert found["verdict"] == found["frames"][0]["status"] == status
        assert [m["command"] for m in found["frames"][0]["measurements"]] == [
            word[2:].split(":")[0] for word in words if word.startswith("--")]


@pytest.mark.parametrize("what, status", [("fail", "failed"), ("warn", "warning"),
                                          ("pass", "measured")])
def test_a_passed_flip_does_not_decide_for_both(tonetool, files, tmp_path, what, status):
    pair = files["not enough samples"]
    for words in ([*pair, "--hdrflip:fail=0.9", *pair, f"--biascheck:inconclusive={what}"],
                  [*pair, f"--biascheck:inconclusive={what}", *pair, "--hdrflip:fail=0.9"]):
        tonetool(*words, "--json", "c.json", "--junit", "c.xml", status=3 if what == "fail" else 0)
        found = load(tmp_path / "c.json")
        assert found["verdict"] == found["frames"][0]["status"] == status
        tag = "failure" if what == "fail" else "skipped"
        assert "not enough samples" in case(tmp_path / "c.xml").find(tag).get("message")


def test_the_map_lies_on_the_stack(tonetool, files, read):
    pair = files["equal"]
    tonetool(*pair, "--biascheck:map=p", "--ch", "p64", "-o", "p.exr")
    assert read("p.exr")[1].channelnames == ("p64",)
    ran = tonetool(*pair, "--dup", "--biascheck", "--pop", "-o", "below.exr")
    assert "same file" in ran.err  # the duplicate was the reference's other side
    assert np.array_equal(read("below.exr")[0], read("a.exr")[0])


# ---- the rest of the chain

def test_a_recipe(tonetool, files, read, tmp_path):
    (tmp_path / "b.tone").write_text("tonetool 1\na.exr b.exr --biascheck\n", encoding="utf-8")
    tonetool("b.tone", "-o", "recipe.exr")
    tonetool("a.exr", "b.exr", "--biascheck", "-o", "line.exr")
    assert np.array_equal(read("recipe.exr")[0], read("line.exr")[0])
    for line in ("a.exr bright.exr --biascheck", "n0.exr n1.exr --biascheck"):
        (tmp_path / "b.tone").write_text(f"tonetool 1\n{line}\n", encoding="utf-8")
        assert "b.tone" in tonetool("b.tone", "-o", "x.exr", status=1).err
        assert not (tmp_path / "x.exr").exists()


def test_the_report_has_the_sentence_and_the_map(tonetool, shot, tmp_path):
    tonetool(*shot, "--biascheck:print=0", "--report", "page.html", "--json", "c.json", status=3)
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    blocks = {name: json.loads(text) for name, text in re.findall(
        r'<script type="application/json" id="([^"]+)">(.*?)</script>', page, re.S)}
    shown = blocks["result"]["shot"]
    frames = load(tmp_path / "c.json")["frames"]
    assert CHANCE.format("0.04") in shown["sentence"]
    for one, other in zip(shown["frames"], frames):
        assert one["measurements"][0]["sentence"] == other["measurements"][0]["sentence"]
        assert one["measurements"][0]["verdict"] == other["measurements"][0]["verdict"]
    maps = [blocks[f"full-{i}"]["bias"] for i in range(4)]
    assert all(re.match(r"data:image/png;base64,[A-Za-z0-9+/=]{300,}$", one) for one in maps)
    assert maps[2] not in maps[:2] + maps[3:]
    tonetool(*shot, "--biascheck:print=0", "--json", "again.json", status=3)
    assert (tmp_path / "again.json").read_bytes() == (tmp_path / "c.json").read_bytes()


def test_memory_that_is_too_small_is_an_error(tonetool, files, tmp_path):
    ran = tonetool("--memory", "1M", *files["equal"], "--biascheck", "-o", "x.exr", status=1)
    assert "memory is 1M: needs at least " in ran.err and not (tmp_path / "x.exr").exists()
    needed = re.search(r"needs at least (\w+)", ran.err)[1]
    bounded = tonetool("--memory", needed, *files["equal"], "--biascheck")
    assert bounded.out == tonetool(*files["equal"], "--biascheck").out


def test_no_files_with_n(tonetool, files, tmp_path):
    before = sorted(os.listdir(tmp_path))
    ran = tonetool("-n", *files["equal"], "--biascheck", "-o", "x.exr")
    assert "equal within 5 %" in ran.out and sorted(os.listdir(tmp_path)) == before
    tonetool("-n", *files["different"], "--biascheck", "-o", "x.exr", status=3)


@pytest.mark.parametrize("modifiers, text", [
    ("within=0", "within 0 is out of range"), ("within=x", "within "),
    ("alpha=0", "alpha 0 is out of range"), ("alpha=0.5", "alpha 0.5 is out of range"),
    ("alpha=x", 'alpha "x" is not a number'), ("power=0.4", "power "), ("power=1", "power "),
    ("reference=maybe", "(valid: auto, alike, converged)"),
    ("inconclusive=no", "(valid: fail, warn, pass)"), ("fail=0.5", "(valid: 0, 1)"),
    ("map=x", "(valid: signed, p, rejected, all)"),
    ("references=0", "references 0 is out of range"), ("tests=-1", "tests -1 is out of range"),
    ("seeds=x", "seeds "), ("frames=0", "frames is "),
    ("frames=some", "frames is "), ("from=nosuch", "nosuch"), ("layer=nosuch", "nosuch"),
    ("print=2", "print "), ("quantity=mean", '"quantity"'), ("ppd=67", '"ppd"'),
])
def test_bad_values_are_errors_and_write_nothing(tonetool, files, tmp_path, modifiers, text):
    before = sorted(os.listdir(tmp_path))
    ran = tonetool(*files["equal"], f"--biascheck:{modifiers}", "-o", "x.exr", status=1)
    assert "tonetool ERROR: biascheck : " in ran.err and text in ran.err
    assert sorted(os.listdir(tmp_path)) == before


def test_files_that_cannot_be_compared(tonetool, files, testimages, tmp_path):
    for name in ("deep.exr", "y_only.exr", "not_an_image.exr"):
        for words in (["a.exr", testimages / name], [testimages / name, "a.exr"]):
            ran = tonetool(*words, "--biascheck:crop=1", "-o", "x.exr", status=1)
            assert name in ran.err and "PASS" not in ran.out
            assert not (tmp_path / "x.exr").exists()


def test_the_place_of_the_largest_difference_is_in_the_map(tonetool, testimages, read):
    words = [testimages / "seeds/approved.1.exr", testimages / "seeds/clamped.1.exr"]
    ran = tonetool(*words, "--biascheck", "-o", "map.exr", status=3)
    x, y, percent = re.search(r"; most at (\d+),(\d+): (-?\d+) %", ran.out).groups()
    pixels, spec = read("map.exr")
    difference = pixels[:, :, spec.channelnames.index("difference")]
    assert round(100 * difference[int(y), int(x)]) == int(percent) == round(100 * difference.min())
