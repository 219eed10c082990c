# SPDX-License-Identifier: BSD-3-Clause
"""The fixture tonetool_check, run by pytest in processes of its own."""

import json
import os
import subprocess

import pytest

pytest_plugins = ["pytester"]

TEST = """
import numpy as np
def test_grey(tonetool_check):
    tonetool_check(np.full((24, 32, 3), {value}, np.float32), fail="{fail}")
"""


@pytest.fixture
def run(pytester):
    def run_pytest(text, *words):
        pytester.makepyfile(test_looks=text)
        return pytester.runpytest_subprocess("-p", "tonetool.pytest_plugin", *words)

    return run_pytest


@pytest.fixture
def approve(pytester):
    def run_program(*words):
        (output,) = (pytester.path / "tonetool-results").glob("*/run.json")
        done = subprocess.run([os.environ["TONETOOL"], "--approve", output, *words, "--reason", "seen", "--by", "Ada"],
                              cwd=pytester.path, text=True, capture_output=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr

    return run_program


def test_first_run_fails_then_approved_passes_then_change_fails(run, approve, pytester):
    first = run(TEST.format(value=0.5, fail="mean=0.1"))
    first.assert_outcomes(failed=1)
    first.stdout.fnmatch_lines(["*no approved image*", "*to approve: tonetool --approve *run.json*"])
    assert not (pytester.path / "approved").exists()
    approve("test_looks/test_grey")
    page = pytester.path / "page.html"
    run(TEST.format(value=0.5, fail="mean=0.1"), "--tonetool-report", page).assert_outcomes(passed=1)
    assert page.is_file()
    changed = run(TEST.format(value=0.05, fail="mean=0.1"))
    changed.assert_outcomes(failed=1)
    changed.stdout.fnmatch_lines(["*FAIL mean * > 0.1*"])


def test_edited_baseline_fails(run, approve, pytester):
    run(TEST.format(value=0.5, fail="mean=0.1"))
    approve("test_looks/test_grey")
    (image,) = (pytester.path / "approved").rglob("*.exr")
    image.chmod(0o644)
    image.write_bytes(image.read_bytes() + b"x")
    edited = run(TEST.format(value=0.5, fail="mean=0.1"))
    edited.assert_outcomes(failed=1)
    edited.stdout.fnmatch_lines(["*is not what was approved*"])


def test_call_without_a_limit_is_an_error(run):
    result = run(TEST.format(value=0.5, fail=""))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*ValueError: tonetool_check: no limit*"])


def test_two_of_one_name_and_ids(run, pytester):
    result = run("""
import numpy as np, pytest
@pytest.mark.parametrize("text", ["a b", "a/b"])
def test_grey(tonetool_check, text):
    tonetool_check(np.ones((24, 32, 3), np.float32), fail="mean=0.1")
""")
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["*two images are named test_looks/test_grey_a_b_*"])
    (output,) = (pytester.path / "tonetool-results").glob("*/run.json")
    assert [case["name"] for case in json.loads(output.read_text())["frames"]] == ["test_looks/test_grey_a_b_"]


def test_program_missing_is_an_error(run, monkeypatch):
    monkeypatch.delenv("TONETOOL")
    monkeypatch.setenv("PATH", "")
    result = run(TEST.format(value=0.5, fail="mean=0.1"))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*the program tonetool is neither*"])
    assert result.ret != 0
