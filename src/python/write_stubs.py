#!/usr/bin/python3
"""Writes tonetool/__init__.pyi from the built module, which PYTHONPATH must lead to."""

from pathlib import Path

from tonetool import _tonetool

Path(__file__).with_name("tonetool").joinpath("__init__.pyi").write_text(_tonetool._stubs)
