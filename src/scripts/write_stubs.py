#!/usr/bin/python3
"""Writes src/python/tonetool/__init__.pyi from the built module, which PYTHONPATH must lead to."""

from pathlib import Path

from tonetool import _tonetool

STUBS = Path(__file__).resolve().parents[1] / "python" / "tonetool" / "__init__.pyi"
STUBS.write_text(_tonetool._stubs, encoding="utf-8")
