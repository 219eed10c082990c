# SPDX-License-Identifier: BSD-3-Clause
"""The scripts that show and score the bases of --cgtmo."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

ROOT = Path(__file__).resolve().parents[2]
TESTIMAGES = ROOT / "testimages"
PROGRAM = "build/release/src/program/tonetool"


def script(name, *words):
    return subprocess.run([sys.executable, "-B", ROOT / "src/scripts" / name, *words], check=False,
                          capture_output=True, text=True, timeout=240, cwd=ROOT)


def test_the_table_of_the_guide_is_what_tmqi_prints(program, tonetool):
    (line,) = re.findall(rf"^    src/scripts/tmo_table.py {PROGRAM} (.*)$",
                         (ROOT / "src/doc/tonemap.md").read_text(), re.M)
    images = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob(line))
    assert len(images) == 3
    done = script("tmo_table.py", program, *images)
    assert done.returncode == 0, done.stderr
    head, rule, *rows = [[cell.strip() for cell in text.strip("|").split("|")]
                         for text in done.stdout.splitlines()]
    assert head == ["Q S N", "guided", "preset=paper", "bilateral", "WLS", "none"]
    assert all(set(cell) == {"-"} for cell in rule)
    assert [row[0] for row in rows] == ["cornell_ref", "gallery_ref", "nightstreet_ref"]
    assert all(0 < float(value) < 1 for row in rows for cell in row[1:] for value in cell.split())
    image = TESTIMAGES / "gallery_ref.exr"
    tonetool(image, "--cgtmo:filter=wls", "-d", "uint8", "-o", "x.png")
    ran = tonetool(image, "x.png", "--tmqi:print=1")
    shown = [float(value) for value in rows[1][head.index("WLS")].split()]
    assert shown == pytest.approx([float(ran.fact(name)) for name in "QSN"], abs=6e-4)


def test_a_table_needs_guides(program):
    done = script("tmo_table.py", program, TESTIMAGES / "plain.exr")
    assert done.returncode == 1
    assert "no position among the layers" in done.stderr


def test_the_figure_shows_that_guides_keep_objects_apart(program, tmp_path):
    made = tmp_path / "bleeding.png"
    done = script("bleeding_figure.py", program, TESTIMAGES / "cornell_ref.exr",
                  TESTIMAGES / "gallery_ref.exr", made)
    assert done.returncode == 0, done.stderr
    pixels = oiio.ImageBuf(str(made)).get_pixels(oiio.FLOAT)
    kept = oiio.ImageBuf(str(TESTIMAGES / "bleeding.jpg")).spec()
    assert pixels.shape == (kept.height, kept.width, 3)
    for row in range(2):
        panels = [pixels[row * 302:row * 302 + 294, column * 302:column * 302 + 294]
                  for column in range(4)]
        _, light, classic, guided = [np.abs(np.diff(p, axis=1)).mean() for p in panels]
        assert classic < guided < light
