# SPDX-License-Identifier: BSD-3-Clause
"""The field cases of the shared folder: what users type, and what must come of it."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_all_field_cases_hold(program, tmp_path):
    cases = Path(os.environ.get("SHARED_DIR", "")) / "cases" / "run.py"
    if not cases.is_file():
        pytest.skip("the field cases need the folder shared/ beside the project")
    words = ["/usr/bin/python3", "-B", cases, program, "--keep", tmp_path]
    if os.environ.get("TONETOOL_MODULE"):
        words += ["--python", os.environ["TONETOOL_MODULE"]]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
