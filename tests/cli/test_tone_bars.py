# SPDX-License-Identifier: BSD-3-Clause
"""Artefacts of tone mapped scenes, within the limits that the default of --cgtmo is made for."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SHARED = Path(os.environ.get("SHARED_DIR", ""))
SCENES, MEASURES = SHARED / "scenes", SHARED / "tools" / "picture_measures.py"
pytestmark = pytest.mark.skipif(not SCENES.exists() or not MEASURES.exists(),
                                reason="SHARED_DIR has no scenes and tools/picture_measures.py")
LIGHT = "encode=none:clamp=0"
STILLS = ["cornell", "nightstreet", "gallery"]


def measured(folder, *words):
    """The measures of each picture; a limit that is passed ends the script with 1."""
    done = subprocess.run([sys.executable, "-B", MEASURES, *map(str, words)], cwd=folder,
                          capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


@pytest.fixture
def picture(tonetool):
    def picture(image, name, options=""):
        more = f":{options}" if options else ""
        tonetool(image, f"--cgtmo{more}", "-d", "uint8" if name.endswith("png") else "float", "-o",
                 name)
        return name

    return picture


@pytest.mark.parametrize("scene", STILLS)
def test_strong_edges_keep_their_order_and_noise_is_not_amplified(picture, tmp_path, scene):
    image = SCENES / scene / "ref.exr"
    light = picture(image, "light.exr", LIGHT)
    shown = picture(image, "shown.exr", "encode=none")
    measured(tmp_path, "still", image, light, shown, "--reversed", 0.1, "--noise", 0.8)
    classic = picture(image, "classic.exr", f"preset=classic:{LIGHT}")
    (before,) = measured(tmp_path, "still", image, classic)
    assert before["reversed"] > 0.3 and before["noise"] > 0.9, "what the limits are against"


@pytest.mark.parametrize("scene", STILLS)
def test_eighty_samples_are_as_good_as_the_whole_window(picture, tmp_path, scene):
    image = SCENES / scene / "ref.exr"
    whole = picture(image, "whole.exr", f"samples=0:{LIGHT}")
    measured(tmp_path, "sampling", whole, picture(image, "some.exr", LIGHT), "--rms", 0.005)


@pytest.mark.parametrize("scene", STILLS)
def test_quality_is_near_that_of_weighted_least_squares(tonetool, picture, scene):
    image = SCENES / scene / "ref.exr"

    def quality(options):
        return float(tonetool(image, picture(image, "x.png", options), "--tmqi:print=1").fact("Q"))

    assert quality("") >= quality("preset=default:clip=channel:filter=wls") - 0.01


def test_frames_of_a_shot_flicker_little_more_than_their_light(picture, tmp_path):
    for frame in range(1, 9):
        picture(SCENES / "anim" / f"ref.{frame:04}.exr", f"p.{frame:04}.exr", LIGHT)
    measured(tmp_path, "flicker", "--scene", SCENES / "anim" / "ref.#.exr", "--picture", "p.#.exr",
             "--frames", "1-8", "--global", 0.03, "--visible", 0.75)
