# SPDX-License-Identifier: BSD-3-Clause
"""The README's Python runs."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_example(tmp_path):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", readme, re.S)
    (tmp_path / "testimages").symlink_to(ROOT / "testimages")
    done = subprocess.run([sys.executable, "-c", code + "print(picture.shape, colors.shape)"],
                          cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith("(90, 160, 3) (90, 160, 3)\n")
    assert (tmp_path / "error.exr").stat().st_size > 0
