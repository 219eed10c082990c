# SPDX-License-Identifier: BSD-3-Clause
"""What help() shows is complete, and so are the stubs that the build writes."""

import ast
import inspect
import pydoc
import re
import subprocess
import sys
from pathlib import Path

import pytest
import tonetool
from tonetool import _tonetool

ROOT = Path(__file__).resolve().parents[2]
STUBS = Path(tonetool.__file__).parent / "__init__.pyi"
FUNCTIONS = sorted(name for name in tonetool.__all__ if inspect.isbuiltin(getattr(tonetool, name)))
CLASSES = sorted(name for name in tonetool.__all__ if inspect.isclass(getattr(tonetool, name))
                 and not issubclass(getattr(tonetool, name), Exception))


def sections(name):
    """The docstring's sections by their titles; "" is what is above them."""
    text = inspect.getdoc(getattr(tonetool, name))
    parts = re.split(r"^(\w+)\n-+$", text, flags=re.M)
    return dict(zip([""] + parts[1::2], [part.strip() for part in parts[::2]]))


def test_every_public_function_is_there():
    """All that the headers export, but for what only C++ needs."""
    names = set()
    for header in (ROOT / "src" / "include" / "tonetool").glob("*.h"):
        text = re.sub(r"//.*|#.*", "", header.read_text(encoding="utf-8"))
        names |= set(re.findall(r"TONETOOL_API[^(;]*?(\w+)\(", text))
    only_cpp = {"version", "attribute_findings", "bias_evidence", "bias_numbers", "bias_place", "bias_reason_name", "bias_sentence", "bias_verdict_name",
                "noise_floor_method", "color_config_files", "lut_references", "drop_profile", "find_part", "flip_exposed", "ignored_pixels", "flip_quantity_name",
                "measures", "merge_shots", "not_of_shots", "shot_of_text", "retag", "state_chromaticities", "stated_exposure", "stated_gamma", "steady_frame", "take_whole_exposure",
                "unapplied_profile", "write_texture"}
    assert only_cpp <= names
    names -= only_cpp
    assert names <= set(FUNCTIONS)
    assert set(FUNCTIONS) - names == {"chain", "evaluate", "image"}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_function_has_its_sections(name):
    found = sections(name)
    parameters = list(inspect.signature(getattr(tonetool, name)).parameters.values())
    wanted = {"", "Returns", "Raises", "Notes", "References"} | ({"Parameters"} if parameters else set())
    assert set(found) == wanted and all(found.values())
    for word in ("TypeError", "ValueError", "tonetool.Error"):
        assert word in found["Raises"]
    shown = re.findall(r"^(\w+) : (.+)\n    \S", found.get("Parameters", ""), re.M)
    assert [parameter for parameter, _ in shown] == [parameter.name for parameter in parameters]
    for parameter, (_, text) in zip(parameters, shown):
        if parameter.default is not inspect.Parameter.empty:
            assert text.endswith(f", default {parameter.default!r}")


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if any(
    word in str(inspect.signature(getattr(tonetool, name))) for word in ("image,", "reference"))])
def test_functions_of_images_say_what_images(name):
    notes = sections(name)["Notes"]
    for word in ("Shapes", "Units", "NaN"):
        assert word in notes, (name, word)


@pytest.mark.parametrize("name", CLASSES)
def test_fields_are_described(name):
    thing = getattr(tonetool, name)
    assert inspect.getdoc(thing) and thing.__module__ == "tonetool"
    fields = [field for field in vars(thing).values() if isinstance(field, property)]
    assert fields and all(re.match(r".+: .+[.,]$", field.__doc__) for field in fields)


def bare(text):
    return re.sub(r"\s", "", text).lower()


def test_pydoc():
    done = subprocess.run([sys.executable, "-m", "pydoc", "tonetool"], capture_output=True, text=True,
                          check=True)
    text = done.stdout
    for name in FUNCTIONS:
        assert re.search(rf"^    {name}\(", text, re.M), name
    for word in ("tonetool - HDR image comparison", "hdr_flip(reference, test, *, pixels=None",
                 "class FlipSummary", "CurveOptions: A tone curve", "white_percentile : float | None", "pixels per degree", "Eurographics 2021"):
        # Python 3.13 breaks long signatures into lines.
        assert bare(word) in bare(text), word
    assert not re.search(r"^    \w+\(.*\*args", text, re.M)
    lines = pydoc.plain(text).splitlines()
    # Signatures, and how Python 3.14 ends those of several lines, are as long as they are.
    assert max(len(line) for line in lines if "(" not in line and ") method of" not in line) <= 120


def test_stubs_are_those_of_the_module():
    """src/scripts/write_stubs.py makes them whenever the module is built."""
    assert STUBS.read_text(encoding="utf-8") == _tonetool._stubs


def test_stubs_declare_all():
    tree = ast.parse(STUBS.read_text(encoding="utf-8"))
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    assert set(functions) == set(FUNCTIONS)
    assert set(classes) == set(CLASSES) | {"Error", "CheckFailed"}
    for name, node in functions.items():
        ours = inspect.signature(getattr(tonetool, name)).parameters
        assert [a.arg for a in node.args.args + node.args.kwonlyargs] == list(ours)
        assert all(a.annotation for a in node.args.args + node.args.kwonlyargs) and node.returns
    for name in CLASSES:
        declared = {node.name for node in classes[name].body if isinstance(node, ast.FunctionDef)}
        there = vars(getattr(tonetool, name)).items()
        assert declared == {field for field, value in there if isinstance(value, property)}
    assert (STUBS.parent / "py.typed").exists()


def test_version():
    assert tonetool.__version__ == _tonetool.__version__
    project = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    assert f"project(tonetool VERSION {tonetool.__version__} " in project
