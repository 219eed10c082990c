# SPDX-License-Identifier: BSD-3-Clause
"""The figure of the tone curves is drawn from the registry and kept."""

import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "testimages" / "curves.svg"
SVG = "{http://www.w3.org/2000/svg}"


def test_redrawn_byte_for_byte(program, tmp_path):
    made = tmp_path / "curves.svg"
    subprocess.run([sys.executable, "-B", ROOT / "src/scripts/plot_curves.py", program, made],
                   check=True, timeout=60)
    assert made.read_bytes() == KEPT.read_bytes()


def test_every_curve_has_its_panel(tonetool):
    names = tonetool("--tonecurves:table=1").out.splitlines()[0].split(",")[1:]
    texts = [t.text for t in ElementTree.parse(KEPT).iter(SVG + "text")]
    assert [t for t in texts if t in names] == names
