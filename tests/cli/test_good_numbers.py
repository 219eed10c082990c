# SPDX-License-Identifier: BSD-3-Clause
"""The tables of src/doc/good-numbers.md are what src/scripts/good_numbers.py measures."""

import os
import subprocess
import sys
from pathlib import Path

import markdown
import pytest

SCRIPT = markdown.ROOT / "src" / "scripts" / "good_numbers.py"
PAGE = (markdown.ROOT / "src" / "doc" / "good-numbers.md").read_text(encoding="utf-8")
SEEDS = Path(os.environ.get("SHARED_DIR", markdown.ROOT.parent / "shared")) / "scenes" / "seeds"
# Instruction sets differ by up to 2e-5, which may change the third digit.
DIGIT = 0.0011


def measured(program, *words):
    done = subprocess.run([sys.executable, "-B", SCRIPT, program, *map(str, words)], timeout=600,
                          check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return rows(done.stdout)


def rows(text):
    """Cells of the tables' rows, by the first of them."""
    found = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and "," in cells[0] and not cells[0].startswith(("scene, s", "scene, c")):
            found[cells[0]] = cells[1:]
    return found


def numbers(cells):
    return [float(word) for cell in cells for word in cell.split() if word[0].isdigit()]


@pytest.mark.parametrize("scene", ["cornell", "gallery", "nightstreet"])
def test_tables(scene, program):
    renders = sorted((SEEDS / scene).glob("*.exr"))
    if not renders:
        pytest.skip("the renders of the page are not here")
    same = [render for render in renders if render.name.startswith("none.")]
    changed = [render for render in renders if render not in same]
    words = ["--name", scene, "--samples", 16, *same]
    if scene != "nightstreet":
        words += ["--changed", *changed]
    found = measured(program, *words)
    shown = {name: cells for name, cells in rows(PAGE).items() if name.startswith(scene + ",")}
    assert list(found) == list(shown) and len(found) >= 3
    for name, cells in found.items():
        assert numbers(cells[:4]) == pytest.approx(numbers(shown[name][:4]), abs=DIGIT), name
        assert cells[4:] == shown[name][4:], name


def test_a_pair_of_seeds_that_the_limits_pass():
    """What the page says of the table: no pair without a change is above the limits."""
    shown = rows(PAGE)
    for scene in ("cornell", "gallery"):
        first = numbers(shown[f"{scene}, 16"])
        largest = numbers(shown[f"{scene}, none"])[1::2]
        for at, margin in enumerate((1.1, 1.1, 1.2)):
            assert largest[at] < margin * first[at]


def test_four_times_the_samples():
    """Mean falls by a fifth to a third."""
    shown = rows(PAGE)
    for scene in ("cornell", "gallery", "nightstreet"):
        ratio = numbers(shown[f"{scene}, 64"])[0] / numbers(shown[f"{scene}, 16"])[0]
        assert 1 - 0.34 < ratio < 1 - 0.2


def test_pair_of_the_tree(program, tonetool, pair):
    found = measured(program, *pair)
    ran = tonetool("-v", *pair, "--hdrflip")
    for name, value in zip(("mean", "p99", "p99.9"), numbers(found["scene, 1"])):
        assert float(ran.fact(name)) == pytest.approx(value, abs=DIGIT)


def test_two_renders_at_least(program, pair):
    done = subprocess.run([sys.executable, "-B", SCRIPT, program, pair[0]], check=False,
                          capture_output=True, text=True)
    assert done.returncode == 2 and "two renders" in done.stderr
