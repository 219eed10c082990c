# SPDX-License-Identifier: BSD-3-Clause
"""Every command of the README runs, and its picture is what it says it is."""

import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import for_hosts

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def shell_commands():
    blocks = re.findall(r"```sh\n(.*?)```", README, re.S)
    return [line for block in blocks for line in block.splitlines() if line.strip()]


@pytest.fixture
def folder(tmp_path):
    for name in ("testimages", "ocio"):
        (tmp_path / name).symlink_to(ROOT / name)
    return tmp_path


def run(line, program, cwd):
    words = shlex.split(line)
    plugin = Path(program).resolve().parents[1] / "tone.imageio"
    environment = {**os.environ, "OIIO_LIBRARY_PATH": str(plugin)}
    if words[0] != "tonetool" or "--doctor" in words:
        environment = for_hosts(environment)
    if words[0] in ("oiiotool", "iinfo", "maketx"):
        program = shutil.which(words[0], path="/usr/bin")
        if not program or not (plugin / "tone.imageio.so").exists():
            pytest.skip(f"no {words[0]}, or no plugin for it")
    else:
        assert words[0] == "tonetool", line
    return subprocess.run([program, *words[1:]], cwd=cwd, capture_output=True, text=True,
                          timeout=120, check=False, env=environment)


def test_there_are_commands():
    assert len(shell_commands()) >= 10


@pytest.mark.parametrize("line", shell_commands())
def test_command(line, program, folder):
    done = run(line, program, folder)
    assert done.returncode == 0, (line, done.stdout, done.stderr)
    words = shlex.split(line)
    for flag, name in zip(words, words[1:]):
        if flag == "-o":
            written = [file.stat().st_size for file in folder.glob(name.replace("#", "*"))]
            assert written and min(written) > 0, name


def test_printed_figures(program, folder):
    """The figures that the page shows are those of the command above them."""
    done = run(shell_commands()[0], program, folder)
    shown = re.findall(r"^    (hdrflip: (?!PASS|FAIL).*)$", README, re.M)
    assert len(shown) >= 3
    printed = done.stdout.splitlines()
    for line in shown:
        name = line.split()[1]
        (actual,) = [text for text in printed if text.startswith(f"hdrflip: {name} ")]
        ours = [float(v) for v in re.findall(r"-?\d+\.?\d*", line)]
        theirs = [float(v) for v in re.findall(r"-?\d+\.?\d*", actual)]
        # Instruction sets differ by up to 2e-5; the page shows six digits.
        assert theirs == pytest.approx(ours, abs=3e-5), (line, actual)


def test_printed_error_of_a_table(program, folder):
    (line,) = [command for command in shell_commands() if command.endswith("neutral.ctf")]
    shown = re.findall(r"^    (exportlut: error .*)$", README, re.M)
    printed = run(line, program, folder).stdout.splitlines()
    (actual,) = [text for text in printed if text.startswith("exportlut: error ")]
    # Sums of roundings: the processor's instructions may differ in the last bits.
    for ours, theirs in zip(re.findall(r"\d\S*", shown[0]), re.findall(r"\d\S*", actual)):
        assert float(theirs) == pytest.approx(float(ours), rel=0.2)


def test_opening_picture(program, folder):
    (line,) = re.findall(r"`(tonetool [^`]*--filmstrip[^`]*)`", README)
    done = run(line, program, folder)
    assert done.returncode == 0, done.stderr
    made = oiio.ImageBuf(str(folder / "filmstrip.png")).get_pixels(oiio.FLOAT)
    kept = oiio.ImageBuf(str(ROOT / "testimages" / "filmstrip.png")).get_pixels(oiio.FLOAT)
    assert made.shape == kept.shape
    # A level of 255, and two where an error near 0 moves a colour; fonts may differ in a release.
    assert np.mean(np.abs(made - kept) > 2.5 / 255) < 1e-3


def test_set_up_commands():
    """The two commands of the page are the two scripts; the second is what runs this test."""
    commands = re.findall(r"^    (bash .*)$", README, re.M)
    assert commands == ["bash src/scripts/demo.sh", "bash src/scripts/test.sh"]
    for command in commands:
        assert (ROOT / command.split()[1]).is_file()


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
