#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes FOLDER/__init__.pyi, FOLDER being the built package tonetool: write_stubs.py FOLDER."""

import sys
from pathlib import Path

package = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(package.parent))
from tonetool import _tonetool  # noqa: E402

(package / "__init__.pyi").write_text(_tonetool._stubs, encoding="utf-8")
