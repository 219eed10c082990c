# SPDX-License-Identifier: BSD-3-Clause
"""The pages of src/doc/reference are what src/scripts/make_reference.py makes now."""

import json
import os
import subprocess
import sys

import markdown
import pytest
from page_tests import check_links

SCRIPT = markdown.ROOT / "src" / "scripts" / "make_reference.py"
FOLDER = markdown.ROOT / "src" / "doc" / "reference"
PAGES = sorted(path.name for path in FOLDER.glob("*.md"))


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("reference")
    done = subprocess.run([sys.executable, "-B", SCRIPT, os.environ["TONETOOL"], folder], check=False,
                          capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return folder


def test_there_are_pages(made):
    assert PAGES == sorted(path.name for path in made.glob("*"))


@pytest.mark.parametrize("name", PAGES)
def test_page_is_what_the_script_makes(name, made):
    assert (FOLDER / name).read_text(encoding="utf-8") == (made / name).read_text(encoding="utf-8"), (
        "remake the pages: src/scripts/make_reference.py build/release/src/program/tonetool")


@pytest.mark.parametrize("name", PAGES)
def test_links(name):
    check_links(f"src/doc/reference/{name}")


def test_every_command_and_modifier_is_there(program):
    text = (FOLDER / "commands.md").read_text(encoding="utf-8")
    sections = dict(section.split("\n", 1) for section in text.split("\n### --")[1:])
    found = json.loads(subprocess.run([program, "--help=json"], capture_output=True, text=True,
                                      check=True).stdout)
    assert len(found) > 200 and len(sections) == len(found)
    for command in found:
        for modifier in command["modifiers"]:
            assert f"`{modifier['key']}=" in sections[command["names"][0]], (command, modifier)
