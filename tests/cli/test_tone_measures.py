# SPDX-License-Identifier: BSD-3-Clause
"""The tables and the sheet of src/doc/tonemap.md are what src/scripts/tone_measures.py makes."""

import importlib.util
import os
import subprocess
import sys

import markdown
import numpy as np
import OpenImageIO as oiio
import pytest

SCRIPT = markdown.ROOT / "src" / "scripts" / "tone_measures.py"
TESTIMAGES = markdown.ROOT / "testimages"
PAGE = (markdown.ROOT / "src" / "doc" / "tonemap.md").read_text(encoding="utf-8")
# By columns: instruction sets differ by up to 2e-5 in a picture, which may change one pair at the limit (of
# 3247 or more) or one pixel (of 9216), and with them percentiles, and the last digit of all.
SCENES = {"wrong order %": 0.04, "after the clip %": 0.04, "noise": 0.0015, "of 8 samples": 0.0015,
          "clipped %": 0.02, "hue turned": 0.3, "samples %": 0.015}
SHOTS = {"exposure jumps %": 0.015, "noise seen": 0.0015}
# Cells of the sheet: their size, and the way from one to the next.
CELL, STEP, FIRST = (192, 120), (200, 176), (0, 48)


@pytest.fixture(scope="module")
def measures():
    spec = importlib.util.spec_from_file_location("tone_measures", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """What the script prints, and its sheet."""
    sheet = tmp_path_factory.mktemp("sheet") / "sheet.jpg"
    done = subprocess.run([sys.executable, "-B", SCRIPT, os.environ["TONETOOL"], TESTIMAGES, sheet],
                          check=False, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout, sheet


def table(text, head):
    """Cells by the first of their row, of the table that begins with the names in head."""
    lines = iter(text.splitlines())
    first = "| " + " | ".join(head) + " |"
    assert any(line == first for line in lines), first
    assert set(next(lines)) <= set("|-: ")
    rows = {}
    for line in lines:
        if not line.startswith("|"):
            break
        name, *cells = [cell.strip() for cell in line.strip("|").split("|")]
        rows[name] = [None if cell == "-" else float(cell) for cell in cells]
    return rows


@pytest.mark.parametrize("name,limits,count", [("scene", SCENES, 9), ("shot", SHOTS, 9)])
def test_the_tables_of_the_guide(made, name, limits, count):
    head = [f"{name}, kind", *limits]
    found, shown = table(made[0], head), table(PAGE, head)
    assert list(found) == list(shown) and len(found) == count
    for row, cells in found.items():
        for value, there, limit in zip(cells, shown[row], limits.values()):
            assert (value is None) == (there is None), row
            assert value is None or value == pytest.approx(there, abs=limit), row


def pixels(sheet):
    return oiio.ImageBuf(str(sheet)).get_pixels(oiio.FLOAT)


def test_the_sheet_of_the_guide(made):
    """Each cell, without the text, which is another one with other fonts."""
    new, kept = pixels(made[1]), pixels(TESTIMAGES / "tone_measures.jpg")
    assert new.shape == kept.shape == (1080, 792, 3)
    for y in range(FIRST[1], kept.shape[0], STEP[1]):
        for x in range(FIRST[0], kept.shape[1], STEP[0]):
            cells = [sheet[y:y + CELL[1], x:x + CELL[0]] for sheet in (new, kept)]
            assert abs(cells[0] - cells[1]).mean() < 0.003, (x, y)


def test_what_the_guide_says_of_the_default():
    head = ["scene, kind", *SCENES]
    rows = table(PAGE, head)
    for scene in ("cornell", "nightstreet", "gallery"):
        before, now = rows[f"{scene}, preset=classic"], rows[f"{scene}, default"]
        assert now[0] <= 0.1 < before[0] and now[1] < before[1]
        assert now[2] <= 0.8 and now[3] < before[3]
        assert now[5] <= 1 and before[5] > 20
        assert now[6] <= 0.5 < before[6]
    rows = table(PAGE, ["shot, kind", *SHOTS])
    assert rows["anim, adapt=shot"][0] <= 0.3 and rows["anim, adapt=frame"][0] > 3
    assert rows["still, adapt=shot, steady=1"][1] <= 0.4 < rows["still, adapt=shot"][1]


def test_order(measures):
    light = np.repeat(np.array([[1., 2, 4, 4.1], [1, 2, 4, 4.1]])[..., None], 3, -1)
    assert measures.wrong_order(light, light ** 0.3)[0] == 0
    turned = light.copy()
    turned[0, 2] = 1.8  # of the four strong pairs along rows one is the other way round
    share, where = measures.wrong_order(light, turned)
    assert share == 25
    assert np.argwhere(where).tolist() == [[0, 1], [0, 2]]


def test_hue(measures):
    free = np.full((20, 20, 3), 0.5)
    free[:2] = 1.5, 0.5, 0.1
    free[2:4] = 3, 2, 2  # its luminance is beyond white, too
    share, angle = measures.hue_turned(free, free * 0.6)
    assert share == pytest.approx(10) and angle == pytest.approx(0, abs=1e-5)
    clipped = np.minimum(free, 1)
    away = [colour - np.mean(colour) for colour in (np.array([1.5, .5, .1]), np.array([1, .5, .1]))]
    cosine = away[0] @ away[1] / np.sqrt((away[0] @ away[0]) * (away[1] @ away[1]))
    assert measures.hue_turned(free, clipped)[1] == pytest.approx(np.degrees(np.arccos(cosine)))


def test_flicker(measures):
    random = np.random.default_rng(3)
    lights = [np.exp(0.05 * random.standard_normal((30, 40, 1))) * np.ones(3) for _ in range(3)]
    path, jump, seen = measures.flicker(lights, [light * gain for light, gain in zip(lights, (1, 1.1, 1.04))])
    assert path == pytest.approx([0, 10, 4]) and jump == pytest.approx(10)
    assert measures.flicker(lights, [light ** 0.5 for light in lights])[2] == pytest.approx(0.5)


def test_noise(measures):
    """Of a picture whose contrast is half that of the light."""
    render = TESTIMAGES / "cornell_ref.exr"
    light = measures.colour(render)
    assert measures.noise_gain(render, light, light) == 1
    half = light * (light @ measures.LUMINANCE)[..., None].clip(1e-6) ** -0.5
    assert measures.noise_gain(render, light, half) == pytest.approx(0.5, abs=1e-3)
