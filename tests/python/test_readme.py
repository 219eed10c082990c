# SPDX-License-Identifier: BSD-3-Clause
"""The Python of the README and of its guide runs, and prints what they say."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
GUIDE = ROOT / "src" / "doc" / "python.md"


def run(code, folder):
    (folder / "testimages").symlink_to(ROOT / "testimages")
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, timeout=120,
                          check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_example(tmp_path):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", readme, re.S)
    said = run(code + "print(picture.shape, colors.shape)", tmp_path)
    assert said.endswith("(90, 160, 3) (90, 160, 3)\n")
    assert (tmp_path / "error.exr").stat().st_size > 0


def examples(page=GUIDE):
    """(code, what it prints or None) of a page, in order."""
    text = page.read_text(encoding="utf-8")
    for code, printed in re.findall(r"```python\n(.*?)```\n\n((?:    [^\n]*\n)*)", text, re.S):
        yield code, re.sub(r"^    ", "", printed, flags=re.M) or None


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """What each example prints; they follow one another in one run."""
    folder = tmp_path_factory.mktemp("guide")
    code = "\nprint('=====')\n".join(code for code, _ in examples())
    outputs = run(code, folder).split("=====\n")
    assert (folder / "error.exr").stat().st_size > 0
    return outputs


def test_guide_runs(printed):
    assert len(printed) == len(list(examples())) >= 8


@pytest.mark.parametrize("number", [n for n, (_, said) in enumerate(examples()) if said])
def test_guide_prints_what_it_says(printed, number):
    assert printed[number] == list(examples())[number][1]


@pytest.mark.parametrize("name", sorted(page.stem for page in GUIDE.parent.glob("*.md")
                                        if page != GUIDE and "```python" in page.read_text(encoding="utf-8")))
def test_examples_of_other_guides(name, tmp_path):
    for number, (code, said) in enumerate(examples(GUIDE.with_stem(name))):
        folder = tmp_path / str(number)
        folder.mkdir()
        assert said is None or run(code, folder) == said


def test_guide_names_what_there_is():
    import tonetool
    text = GUIDE.read_text(encoding="utf-8")
    words = set(re.findall(r"`(?:tonetool\.)?(\w+)\(\)`", text)) | set(re.findall(r"tonetool\.(\w+)\(", text))
    assert len(words) > 8 and all(hasattr(tonetool, word) for word in words), words
