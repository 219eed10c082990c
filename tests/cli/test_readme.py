# SPDX-License-Identifier: BSD-3-Clause
"""Every command of the README runs and prints what it shows, and its picture is what it says it is."""

import os
import re
import subprocess
from pathlib import Path

import markdown
import numpy as np
import OpenImageIO as oiio
import pytest
from page_tests import NOT_RUN, cases, check, check_links

ROOT = markdown.ROOT
README = (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("block", cases(["README.md"]))
def test_command(block, program, tmp_path):
    check(block, program, tmp_path)


def test_there_are_commands_and_outputs():
    found = [case.values[0] for case in cases(["README.md"])]
    assert sum(len(block.commands()) for block in found) >= 20
    assert sum(block.shown is not None for block in found) >= 7


def test_links():
    check_links("README.md")


def test_it_stays_short():
    assert len(README.splitlines()) <= 220


def test_opening_picture(program, tmp_path):
    (line,) = re.findall(r"`(tonetool [^`]*--filmstrip[^`]*)`", README)
    check(markdown.Block("README.md", 0, line + "\n"), program, tmp_path)
    made = oiio.ImageBuf(str(tmp_path / "filmstrip.png")).get_pixels(oiio.FLOAT)
    kept = oiio.ImageBuf(str(ROOT / "testimages" / "filmstrip.png")).get_pixels(oiio.FLOAT)
    assert made.shape == kept.shape
    # A level of 255, and two where an error near 0 moves a colour; fonts may differ in a release.
    assert np.mean(np.abs(made - kept) > 2.5 / 255) < 1e-3


def test_set_up_commands():
    """The first two commands of the page are the two scripts; the second is what runs this test."""
    commands = [command for block in markdown.blocks("README.md") for command in block.commands()]
    assert commands[:2] == ["bash src/scripts/demo.sh", "bash src/scripts/test.sh"]
    for command in commands[:2]:
        assert (ROOT / command.split()[1]).is_file() and command in NOT_RUN


def test_demo(program):
    if Path(program).resolve() != ROOT / "build/release/src/program/tonetool":
        pytest.skip("demo.sh builds and runs build/release, this is another build")
    done = subprocess.run(["bash", "src/scripts/demo.sh"], cwd=ROOT, capture_output=True, text=True,
                          timeout=600, check=False, env={**os.environ})
    assert done.returncode == 0, (done.stdout, done.stderr)
    picture = Path(done.stdout.splitlines()[-1])
    assert picture.suffix == ".png"
    spec = oiio.ImageBuf(str(picture)).spec()
    assert spec.width > 3 * 256 and spec.nchannels >= 3
