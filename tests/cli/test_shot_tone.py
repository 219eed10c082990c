# SPDX-License-Identifier: BSD-3-Clause
"""One exposure for a shot: what is measured of its frames, merged, and made of it."""

import json
import math
import os
import shutil
import subprocess
import sys
from itertools import permutations
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

SHARED = Path(os.environ.get("SHARED_DIR", ""))
ANIM = SHARED / "scenes" / "anim" / "ref.#.exr"
GOLDEN, MEASURES = SHARED / "golden/shot/shot.json", SHARED / "tools/picture_measures.py"
needs_scenes = pytest.mark.skipif(not GOLDEN.exists() or not ANIM.parent.exists(),
                                  reason="SHARED_DIR has no golden/shot and scenes/anim")
SEVEN_DIGITS = 1e-5  # of the goldens, and six of what is printed
LIGHT = "encode=none:clamp=0"


def golden():
    return json.loads(GOLDEN.read_text())


def pixels(file):
    return oiio.ImageBuf(str(file)).get_pixels(oiio.FLOAT)


def facts(ran, name):
    """The values of all frames."""
    return [line.split(f": {name} ")[1] for line in ran.out.splitlines() if f": {name} " in line]


def numbers(ran, name):
    return [float(value) for value in facts(ran, name)]


@pytest.fixture
def write(tmp_path):
    """Frames of 64 x 36 pixels: a wall with stripes, in a light."""

    def write(number, light=1.0, kind=0, name="s", alpha=None, attributes=()):
        y, x = np.mgrid[:36, :64]
        stripes = np.sin(x * 0.35) + 0.08 * y if kind == 0 else np.cos(y * 0.7) - 0.05 * x
        values = light * np.exp2(stripes)[..., None] * np.array([1.0, 0.9, 0.7])
        channels = ["R", "G", "B"]
        if alpha is not None:
            values = np.concatenate([values * alpha[..., None], alpha[..., None]], 2)
            channels.append("A")
        spec = oiio.ImageSpec(64, 36, len(channels), oiio.FLOAT)
        spec.channelnames = channels
        for key, value in attributes:
            spec.attribute(key, *value)
        image = oiio.ImageBuf(spec)
        image.set_pixels(spec.roi, np.ascontiguousarray(values, np.float32))
        assert image.write(str(tmp_path / f"{name}.{number:04}.exr")), image.geterror()

    return write


@pytest.fixture
def shot(write):
    for number, light in enumerate([1, 2, 4, 8, 4, 2], 1):
        write(number, light)
    return "s.#.exr"


# ---- goldens


@needs_scenes
def test_statistics_of_the_animation(tonetool, tmp_path):
    tonetool("--frames", "1-8", ANIM, "--cgtmo", "--statistics", "anim.json")
    found = json.loads((tmp_path / "anim.json").read_text())
    assert (found["format"], found["version"], found["mode"]) == ("tonetool-shot", 1, "shot")
    for number, (frame, wanted) in enumerate(zip(found["frames"], golden()["frames"]), 1):
        assert frame["frame"] == number
        assert frame["counted"] == wanted["counted"] == sum(frame["histogram"])
        for key, of_golden in {"lwa": "Lwa_cells", "lwa_geometric": "Lwa_geometric_counted",
                               "lmax": "Lmax_p99.99", "maximum": "maximum"}.items():
            assert frame[key] == pytest.approx(wanted[of_golden], rel=SEVEN_DIGITS), key
        assert len(frame["thumbnail"]) == 576 and frame["camera"] is None
    assert len(found["frames"]) == 8


@needs_scenes
@pytest.mark.parametrize("options, wanted", [("", [.1462899] * 8), ("adapt=eye", "causal_eye"),
                                             ("adapt=eye:tau=0.4", "causal_tau_0.4"),
                                             ("adapt=smooth", "smooth_tau_0.4")])
def test_exposures_of_the_animation(tonetool, options, wanted):
    wanted = golden()[wanted] if isinstance(wanted, str) else wanted
    more = f":{options}" if options else ""
    ran = tonetool("--frames", "1-8", ANIM, f"--cgtmo:filter=none:preset=default{more}", "-o",
                   "p.#.png")
    assert numbers(ran, "adaptation") == pytest.approx(wanted, rel=SEVEN_DIGITS)
    assert numbers(ran, "maximum") == pytest.approx([25.00251] * 8, rel=SEVEN_DIGITS)
    assert set(facts(ran, "adaptation-from")) == {"shot"}


@needs_scenes
def test_the_animation_does_not_flicker(tonetool, tmp_path):
    def flicker(options, *limits):
        tonetool("--frames", "1-8", ANIM, f"--cgtmo:{LIGHT}{options}", "-d", "float", "-o",
                 "p.#.exr")
        done = subprocess.run([sys.executable, "-B", MEASURES, "flicker", "--scene", ANIM,
                               "--picture", "p.#.exr", "--frames", "1-8", *limits], cwd=tmp_path,
                              capture_output=True, text=True, check=False, timeout=120)
        assert done.returncode == 0, done.stdout + done.stderr
        return json.loads(done.stdout)["global_max"]

    flicker("", "--global", ".001", "--visible", ".75")
    alone = flicker(":adapt=frame", "--global", ".03")
    assert alone > 0.01, "what the shot is against"
    assert flicker(":preset=classic") > 0.1


# ---- parts of a farm


@needs_scenes
@pytest.mark.parametrize("parts", [["1-8"], ["1-3", "4-8"], ["2,4,6", "1,8", "3,5,7"],
                                   [str(n) for n in range(8, 0, -1)]])
def test_any_split_gives_the_same_bytes(tonetool, tmp_path, parts):
    tonetool("--frames", "1-8", ANIM, "--cgtmo", "--statistics", "whole.json")
    for i, part in enumerate(parts):
        tonetool("--frames", part, ANIM, "--cgtmo", "--statistics", f"part{i}.json")
    files = [f"part{i}.json" for i in range(len(parts))]
    for order in list(permutations(files))[:6]:
        tonetool("--merge", *order, "--statistics", "merged.json")
        assert (tmp_path / "merged.json").read_bytes() == (tmp_path / "whole.json").read_bytes()
    quick = "--cgtmo:filter=none:preset=default:adapt="
    line = ["--no-history", ANIM]
    tonetool("--frames", "1-8", *line, f"{quick}shot", "-o", "whole.#.exr")
    for part in parts:
        tonetool("--frames", part, *line, f"{quick}merged.json", "-o", "part.#.exr")
    for number in range(1, 9):
        assert ((tmp_path / f"part.{number:04}.exr").read_bytes() ==
                (tmp_path / f"whole.{number:04}.exr").read_bytes())


def test_workers_and_threads_measure_the_same(tonetool, shot, tmp_path):
    texts = set()
    for words in (["--threads", "1"], ["--threads", "4"], ["--parallel-frames", "2"]):
        tonetool("--frames", "1-6", *words, shot, "--cgtmo", "--statistics", "s.json")
        texts.add((tmp_path / "s.json").read_bytes())
    assert len(texts) == 1


def test_merge_refuses_what_does_not_fit(tonetool, shot, write, tmp_path):
    tonetool("--frames", "1-3", shot, "--cgtmo", "--statistics", "a.json")
    write(3, 5)
    tonetool("--frames", "3-6", shot, "--cgtmo", "--statistics", "b.json")
    ran = tonetool("--merge", "a.json", "b.json", "--statistics", "m.json", status=1)
    assert "frame 3 is there twice, with other numbers" in ran.err
    assert not (tmp_path / "m.json").exists()
    tonetool("--frames", "4-6", shot, "--cgtmo:adapt=eye", "--statistics", "c.json")
    ran = tonetool("--merge", "a.json", "c.json", "--statistics", "m.json", status=1)
    assert '"shot"' in ran.err and '"eye"' in ran.err
    ran = tonetool("--frames", "1-6", "--merge", "a.json", "--statistics", "m.json", status=1)
    assert "no part has frames 4, 5, 6" in ran.err
    tonetool("--frames", "1-6", shot, shot, "--hdrflip:exposures=shot", "--statistics", "e.json")
    ran = tonetool("--merge", "a.json", "e.json", "--statistics", "m.json", status=1)
    assert "tonetool-exposures" in ran.err and "tonetool-shot" in ran.err
    for name in ("a.json", "e.json"):
        assert "--merge joins statistics with --statistics FILE" in tonetool(
            "--merge", name, "--json", "m.json", status=1).err


# ---- what is exposed by the shot, and what is not


def test_one_exposure_is_the_default_of_several_frames(tonetool, shot):
    ran = tonetool("--frames", "1-6", shot, "--cgtmo", "-o", "p.#.png")
    assert len(set(facts(ran, "adaptation"))) == 1
    assert facts(ran, "adapted") == ["shot of frames 1 to 6"] * 6
    alone = tonetool("--frames", "1-6", shot, "--cgtmo:adapt=frame", "-o", "p.#.png")
    lwa = numbers(alone, "adaptation")
    assert lwa == pytest.approx([lwa[0] * light for light in (1, 2, 4, 8, 4, 2)], rel=SEVEN_DIGITS)
    assert numbers(ran, "adaptation")[0] == pytest.approx(
        math.exp(np.mean(np.log(lwa))), rel=SEVEN_DIGITS)
    assert facts(tonetool("s.0001.exr", "--cgtmo", "-o", "p.png"), "adapted") == []


@pytest.mark.parametrize("options", ["preset=classic", "filter=wls", "lwa=median",
                                     "maxpercentile=99.9", "count=all"])
def test_what_a_shot_does_not_tell_is_of_each_frame(tonetool, shot, options):
    ran = tonetool("--frames", "1-2", shot, f"--cgtmo:{options}", "-o", "p.#.png")
    assert facts(ran, "adaptation-from") == ["image"] * 2
    ran = tonetool("--frames", "1-2", shot, f"--cgtmo:adapt=shot:{options}", "-o", "p.#.png",
                   status=1)
    assert "not in the statistics of a shot" in ran.err and "adapt=frame" in ran.err


def test_numbers_that_were_given_stay(tonetool, shot):
    tonetool("--frames", "1-6", shot, "--cgtmo", "--statistics", "s.json")
    ran = tonetool("--frames", "2", shot, "--cgtmo:adapt=s.json:lmax=77", "-o", "p.#.png")
    assert (ran.fact("maximum"), ran.fact("maximum-from")) == ("77", "lmax")
    assert ran.fact("adaptation-from") == "shot"
    ran = tonetool("--frames", "2", shot, "--cgtmo:adapt=s.json:lmax=77:lwa=1", "-o", "p.#.png",
                   status=1)
    assert "nothing is measured" in ran.err


def test_tonemap_and_calibrate_read_the_same_file(tonetool, shot, tmp_path):
    tonetool("--frames", "1-6", shot, "--calibrate:method=mean", "--statistics", "s.json")
    frames = json.loads((tmp_path / "s.json").read_text())["frames"]
    pixelwise = math.exp(np.mean([math.log(frame["lwa_geometric"]) for frame in frames]))
    cells = math.exp(np.mean([math.log(frame["lwa"]) for frame in frames]))
    ran = tonetool("--frames", "1-6", shot, "--calibrate:method=mean", "-o", "c.#.exr")
    assert numbers(ran, "mean") == pytest.approx([pixelwise] * 6, rel=SEVEN_DIGITS)
    ran = tonetool("--frames", "5", shot, "--calibrate:method=auto:means=cells:adapt=s.json", "-o",
                   "c.#.exr")
    assert numbers(ran, "mean") == pytest.approx([cells], rel=SEVEN_DIGITS)
    ran = tonetool("--frames", "1-6", shot, "--tonemap:curve=reinhard-extended:white=max", "-o",
                   "t.#.png")
    assert len(set(facts(ran, "white"))) == 1
    assert numbers(ran, "white")[0] == pytest.approx(max(frame["maximum"] for frame in frames))
    ran = tonetool("--frames", "1-6", shot, "--tonemap:curve=reinhard-extended:white=p90", "-o",
                   "t.#.png")
    brightest = np.percentile(pixels(tmp_path / "s.0004.exr") @ [.2126, .7152, .0722], 90)
    assert abs(math.log2(numbers(ran, "white")[0] / brightest)) <= 0.5
    ran = tonetool("--frames", "1-6", shot, "--tonemap", "-o", "t.#.png")
    assert facts(ran, "adapted") == [], "nothing is measured"
    for options, why in (("method=mean:level=1", "level=1"), ("method=mean:count=all", "count=lit"),
                         ("method=mean:epsilon=0.1", "epsilon=0.1")):
        ran = tonetool("--frames", "1-6", shot, f"--calibrate:adapt=s.json:{options}", "-o",
                       "c.#.exr", status=1)
        assert why in ran.err


def test_commands_that_follow_each_other_follow_the_shot(tonetool, shot):
    ran = tonetool("--frames", "1-6", shot, "--calibrate:method=mean",
                   "--tonemap:curve=reinhard-extended:white=max", "-o", "t.#.png")
    exposure, white = numbers(ran, "exposure")[0], numbers(ran, "white")[0]
    assert len(set(facts(ran, "white"))) == 1
    ran = tonetool("s.0004.exr", "--calibrate:stops=" + repr(exposure),
                   "--tonemap:curve=reinhard-extended:white=max", "-o", "t.png")
    assert numbers(ran, "white")[0] == pytest.approx(white, rel=1e-4)


# ---- time


def test_eye_and_smooth_in_time(tonetool, shot, tmp_path):
    tonetool("--frames", "1-6", shot, "--cgtmo:adapt=eye", "--statistics", "s.json")
    assert json.loads((tmp_path / "s.json").read_text())["mode"] == "eye"
    words = ["--frames", "4", shot]
    eye = numbers(tonetool(*words, "--cgtmo:adapt=s.json", "-o", "p.#.png"), "adaptation")[0]
    fast = numbers(tonetool(*words, "--cgtmo:adapt=s.json:tau=0.001", "-o", "p.#.png"),
                   "adaptation")[0]
    slow = numbers(tonetool(*words, "--cgtmo:adapt=s.json:tau=10000", "-o", "p.#.png"),
                   "adaptation")[0]
    assert fast / slow == pytest.approx(8, rel=1e-3) and slow < eye < fast
    smooth = numbers(tonetool(*words, "--cgtmo:adapt=s.json:mode=smooth", "-o", "p.#.png"),
                     "adaptation")[0]
    assert slow < smooth < fast
    assert numbers(tonetool("s.0004.exr", "--cgtmo:adapt=s.json:frame=4", "-o", "p.png"),
                   "adaptation")[0] == eye


def test_frames_per_second_of_the_header(tonetool, write):
    rate = ("FramesPerSecond", (oiio.TypeDesc("rational"), (48, 1)))
    for number, light in enumerate([1, 4, 4], 1):
        write(number, light, attributes=[rate])
        write(number, light, name="u")
    line = "--cgtmo:adapt=eye:tau=0.4"
    at = lambda *words: numbers(tonetool("--frames", "1-3", *words, "-o", "p.#.png"), "adaptation")
    header = at("s.#.exr", line)
    assert header == at("u.#.exr", f"{line}:fps=48")
    assert header != at("u.#.exr", line) == at("s.#.exr", f"{line}:fps=24")


# ---- cuts, and frames that are not as the others


def test_a_cut_begins_another_shot(tonetool, write):
    for number in range(1, 7):
        write(number, 1 if number < 4 else 16, kind=int(number >= 4))
    ran = tonetool("--frames", "1-6", "s.#.exr", "--cgtmo", "-o", "p.#.png")
    assert facts(ran, "adapted") == ["shot of frames 1 to 3"] * 3 + ["shot of frames 4 to 6"] * 3
    assert len(set(facts(ran, "adaptation"))) == 2
    ran = tonetool("--frames", "1-6", "s.#.exr", "--cgtmo:cuts=none", "-o", "p.#.png")
    assert facts(ran, "adapted") == ["shot of frames 1 to 6"] * 6
    ran = tonetool("--frames", "1-6", "s.#.exr", "--cgtmo:cuts=2,4", "-o", "p.#.png")
    assert facts(ran, "adapted")[:2] == ["shot of frame 1", "shot of frames 2 to 3"]
    ran = tonetool("--frames", "1-6", "s.#.exr", "--cgtmo:cuts=2,x", "-o", "p.#.png", status=1)
    assert '"x" is no number of a frame' in ran.err


def test_a_light_switched_off_is_no_cut(tonetool, write):
    for number in range(1, 7):
        write(number, 1 if number < 4 else 0.05)
    ran = tonetool("--frames", "1-6", "s.#.exr", "--cgtmo", "-o", "p.#.png")
    assert facts(ran, "adapted") == ["shot of frames 1 to 6"] * 6


def test_missing_frames_are_told(tonetool, shot, tmp_path):
    (tmp_path / "s.0003.exr").unlink()
    ran = tonetool("--frames", "1-6", shot, "--cgtmo", "-o", "p.#.png", status=1)
    assert "frame 3 has no part in the exposure of the shot" in ran.err
    assert "--skip-bad-frames" in ran.err and not list(tmp_path.glob("p.*.png"))
    ran = tonetool("--frames", "1-6", "--skip-bad-frames", shot, "--cgtmo", "-o", "p.#.png",
                   status=1)
    assert "WARNING: frame 3 has no part" in ran.err
    assert "is without frames 3" in ran.err and len(list(tmp_path.glob("p.*.png"))) == 5
    ran = tonetool(shot, "--cgtmo", "-o", "p.#.png")
    assert "exposure of frames 1 to 6 is without frames 3" in ran.err, "no --frames: a gap"
    ran = tonetool("--frames", "1,2,4-6", shot, "--cgtmo", "--statistics", "s.json")
    shutil.copy(tmp_path / "s.0002.exr", tmp_path / "s.0003.exr")
    ran = tonetool("--frames", "3", shot, "--cgtmo:adapt=s.json", "-o", "p.#.png", status=1)
    assert "frame 3 is not in the statistics of the shot" in ran.err
    ran = tonetool("--warnings-exit", "--frames", "4", shot, "--cgtmo:adapt=s.json", "-o",
                   "p.#.png", status=2)
    assert "is without frames 3" in ran.err
    ran = tonetool("--frames", "1-5x2", shot, "--cgtmo", "-o", "p.#.png")
    assert "without frames" not in ran.err, "every second frame lacks none"


def test_statistics_of_missing_frames_are_an_error(tonetool, shot, tmp_path):
    (tmp_path / "s.0003.exr").unlink()
    ran = tonetool("--frames", "1-6", shot, "--cgtmo", "--statistics", "s.json", status=1)
    assert "s.0003.exr" in ran.err
    assert len(json.loads((tmp_path / "s.json").read_text())["frames"]) == 5


def test_black_plates(tonetool, shot, write, tmp_path):
    whole = tonetool("--frames", "1-6", shot, "--cgtmo", "-o", "p.#.png")
    write(7, 0)
    ran = tonetool("--frames", "1-7", shot, "--cgtmo", "-o", "p.#.png")
    assert set(facts(ran, "adaptation")) == set(facts(whole, "adaptation"))
    assert pixels(tmp_path / "p.0007.png").max() == 0
    write(8, 0)
    ran = tonetool("--frames", "7-8", shot, "--cgtmo", "-o", "q.#.png", status=1)
    assert "no frame from 7 to 8 has any light" in ran.err


def test_masked_renders_are_exposed_by_what_they_show(tonetool, write):
    mask = np.zeros((36, 64))
    mask[:, :32] = 1
    for number in range(1, 4):
        write(number, 1, alpha=np.ones((36, 64)) if number == 2 else mask)
    ran = tonetool("--frames", "1-3", "s.#.exr", "--cgtmo:cuts=none", "-o", "p.#.png")
    alone = tonetool("--frames", "1-3", "s.#.exr", "--cgtmo:adapt=frame", "-o", "p.#.png")
    lwa = numbers(alone, "adaptation")
    assert numbers(ran, "adaptation")[0] == pytest.approx(math.exp(np.mean(np.log(lwa))),
                                                          rel=SEVEN_DIGITS)
    assert lwa[0] == pytest.approx(lwa[1], rel=0.2), "not the black around it"


def test_a_check_follows_the_shot_and_so_does_its_state(tonetool, shot, write, tmp_path):
    for number in range(1, 7):
        write(number, 1, name="t")
    line = ["--frames", "1-6", "-i", shot, "--calibrate:method=mean", "-i", "t.#.exr",
            "--calibrate:method=mean", "--errormap:metric=mse"]

    def means(*more):
        tonetool(*line, "--json", "c.json", *more)
        frames = json.loads((tmp_path / "c.json").read_text())["frames"]
        return [frame["measurements"][0]["quantities"]["mse"] for frame in frames]

    before = means("--state", "st")
    assert means("--state", "st") == before == means("--parallel-frames", "3")
    assert before[2] == before[4] > 0 and before[0] != before[1], "one exposure a side"
    write(6, 200)
    after = means("--state", "st")
    assert after == means() and all(a != b for a, b in zip(after, before))


# ---- what is wrong


@pytest.mark.parametrize("words, why", [
    (["s.0001.exr", "--cgtmo:adapt=shot"], "adapt=shot has no shot here"),
    (["s.0001.exr", "--cgtmo:adapt=nothing.json"], 'no file "nothing.json"'),
    (["s.0001.exr", "--cgtmo:adapt=s.0001.exr"], '"s.0001.exr": '),
    (["s.0001.exr", "--cgtmo:tau=1"], "tau= is of adapt=shot"),
    (["s.0001.exr", "--cgtmo:adapt=s.json:mode=eye"], "which frame is the image?"),
    (["s.0001.exr", "--cgtmo:adapt=s.json:mode=eyes"], "eyes"),
    (["s.0001.exr", "--cgtmo:adapt=s.json:frame=9"], "frame 9 is not in the statistics"),
    (["s.0001.exr", "--cgtmo:adapt=s.json:tau=1"], "tau is of adapt=eye and smooth"),
    (["--frames", "1-6", "s.#.exr", "--cgtmo:adapt=eye:mode=smooth"], "mode= and frame="),
    (["s.0001.exr", "--cgtmo:adapt=e.json"], '"tonetool-exposures"'),
])
def test_errors(tonetool, shot, words, why):
    tonetool("--frames", "1-6", shot, "--cgtmo", "--statistics", "s.json")
    tonetool("--frames", "1-6", shot, shot, "--hdrflip:exposures=shot", "--statistics", "e.json")
    output = "p.#.png" if "--frames" in words else "p.png"
    assert why in tonetool(*words, "-o", output, status=1).err


@pytest.mark.parametrize("change, why", [
    (lambda f: f.update(version=2), "is of version 2"),
    (lambda f: f.update(mode="day"), "day"),
    (lambda f: f["frames"][0].update(lwa=-1), '"lwa" is -1'),
    (lambda f: f["frames"][0].update(lwa="x"), '"lwa" is "x", not a number'),
    (lambda f: f["frames"][1].update(counted=0), "frame 2: some of lwa"),
    (lambda f: f["frames"][1].update(counted=7), "must be \"counted\", 7"),
    (lambda f: f["frames"][1].update(lwa=1e300), 'must not be above "maximum"'),
    (lambda f: f["frames"][1].update(lmax=1e30), 'must not be above "maximum"'),
    (lambda f: f["frames"][1].update(maximum=1e300), '"maximum" is 1e+300'),
    (lambda f: f["frames"][1].update(shown=1.5), '"shown" is 1.5: must be from 0 to 1'),
    (lambda f: f["frames"][1].update(unit=-3), '"unit" is -3'),
    (lambda f: f["frames"][1].update(fps=-24), '"fps" is -24'),
    (lambda f: f["frames"][1]["thumbnail"].__setitem__(3, 1e9), '"thumbnail" is 1000000000'),
    (lambda f: f["frames"][1]["histogram"].__setitem__(3, -2), '"histogram" is -2'),
    (lambda f: f["frames"][1]["thumbnail"].pop(), '"thumbnail" has 575'),
    (lambda f: f["frames"][1]["histogram"].pop(), '"histogram" has 63'),
    (lambda f: f["frames"].clear(), "there is no frame"),
])
def test_damaged_files(tonetool, shot, tmp_path, change, why):
    tonetool("--frames", "1-6", shot, "--cgtmo", "--statistics", "s.json")
    found = json.loads((tmp_path / "s.json").read_text())
    change(found)
    (tmp_path / "s.json").write_text(json.dumps(found))
    ran = tonetool("--frames", "2", shot, "--cgtmo:adapt=s.json", "-o", "p.#.png", status=1)
    assert why in ran.err and '"s.json"' in ran.err


def test_statistics_need_one_command_that_measures(tonetool, shot):
    ran = tonetool("--frames", "1-6", shot, "--tonemap", "--statistics", "s.json", status=1)
    assert "no command has it" in ran.err
    ran = tonetool("--frames", "1-6", shot, "--cgtmo:adapt=frame", "--statistics", "s.json",
                   status=1)
    assert "no command has it" in ran.err
    ran = tonetool("--frames", "1-6", shot, "--cgtmo:maxpercentile=99", "--statistics", "s.json",
                   status=1)
    assert '"--cgtmo:maxpercentile=99": maxpercentile=99 is not in the statistics' in ran.err
    ran = tonetool("--frames", "1-6", shot, "--calibrate:method=mean", "--cgtmo", "--statistics",
                   "s.json", status=1)
    assert "both measure a shot" in ran.err


def test_a_recipe_reads_a_file(tonetool, shot, tmp_path):
    tonetool("--frames", "1-6", shot, "--cgtmo", "--statistics", "s.json")
    (tmp_path / "look.tone").write_text("tonetool 1\ns.0002.exr --cgtmo:adapt=s.json:encode=none\n")
    tonetool("look.tone", "-d", "float", "-o", "r.exr")
    tonetool("--frames", "2", shot, "--cgtmo:adapt=s.json:encode=none", "-d", "float", "-o",
             "p.#.exr")
    assert (pixels(tmp_path / "r.exr") == pixels(tmp_path / "p.0002.exr")).all()
    (tmp_path / "bad.tone").write_text("tonetool 1\ns.0002.exr --cgtmo:adapt=shot\n")
    assert "adapt=shot has no shot here" in tonetool("bad.tone", "-o", "r.exr", status=1).err


def test_a_shot_of_one_image_is_the_image(tonetool):
    image = TESTIMAGES / "nightstreet_ref.exr"
    ran = tonetool(image, "--cgtmo", "-o", "p.png")
    tonetool(image, "--cgtmo", "--statistics", "one.json")
    shot = tonetool(image, "--cgtmo:adapt=one.json", "-o", "q.png")
    assert facts(shot, "adaptation") == facts(ran, "adaptation")
    assert facts(shot, "maximum") == facts(ran, "maximum")
