# SPDX-License-Identifier: BSD-3-Clause
"""One image against the approved one."""

import json
import os
import shutil
import uuid
from pathlib import Path

import pytest

from .program import approve_line, run_program, statuses, told, typed, write_suite
from .session import STATE, Store, clean


def is_exr(file):
    """By its name and, where there is anything in it, its first bytes: else the program says what is wrong with it."""
    if Path(file).suffix.lower() != ".exr":
        return False
    with open(file, "rb") as opened:
        return opened.read(4) in (b"", b"\x76\x2f\x31\x01")


def write_image(image, path):
    if isinstance(image, (str, os.PathLike)):
        if not is_exr(image):
            raise ValueError(f"tonetool_check: \"{image}\" is no OpenEXR file (valid: a .exr file, an ImageBuf, an "
                             "array of float32)")
        shutil.copyfile(image, path)
        return
    kind = str(image.spec().format if hasattr(image, "geterror") else getattr(image, "dtype", type(image).__name__))
    if kind not in (("half", "float", "double", "unknown") if hasattr(image, "geterror") else ("float32",)):
        raise TypeError(f"tonetool_check: the image is of {kind} (valid: an array of float32, an ImageBuf of half or "
                        "float, both linear, or the name of an OpenEXR file)")
    try:
        import tonetool
    except ImportError as error:
        raise RuntimeError(f"the module tonetool cannot be loaded: {error}") from None
    tonetool.write_image(image, str(path))


def check_limit(fail):
    if isinstance(fail, str) and fail.strip():
        return
    said = "no limit" if fail is None or fail == "" else f"the limit is {fail!r}"
    raise ValueError(f"tonetool_check: {said} (valid: a string as fail=\"mean=0.3,p99.9=0.6\")")


class Check:
    """The fixture of one test."""

    def __init__(self, request):
        self.config = request.config
        self.state = request.config.stash[STATE]
        self.node = request.node
        self.cwd = request.config.invocation_params.dir
        self.store = Store(request.config, Path(request.node.path))
        self.mine = set()

    def __call__(self, image, fail=None, name=None):
        __tracebackhide__ = True
        full = f"{clean(Path(self.node.path).stem)}/{clean(name or self.node.name)}"
        node = self.node.nodeid
        try:
            check_limit(fail)
            self.state.reserve(self.store, full, node, self.mine)
            problem = self.judge(image, {"name": full, "fail": fail, "id": node})
        except (OSError, RuntimeError) as error:
            problem = f"tonetool_check: {full}: {told(error)}"
        except Exception as error:
            self.state.remember(node, f"{full}/{uuid.uuid4().hex}", f"{full}: {told(error)}")
            raise
        self.state.remember(node, full, problem)
        if problem:
            pytest.fail(problem, pytrace=False)

    def judge(self, image, part):
        """What is wrong; empty where the image passes."""
        file = self.state.place(self.store, "images", f"{part['name']}.exr")
        file.unlink(missing_ok=True)
        write_image(image, file)
        output = self.state.place(self.store, "runs", f"{part['name']}.json")
        output.unlink(missing_ok=True)
        suite = output.with_name(f"{output.stem}.toml")
        write_suite(suite, self.store.path, self.state.folder / self.store.folder / "images", [part])
        status, said = run_program(["--suite", suite, "--only", part["name"], "--json", output], self.cwd)
        cases = statuses(output)
        part["passed"] = status == 0 and set(cases) == {part["name"]} and cases[part["name"]][0] == "passed"
        if cases:
            self.state.place(self.store, "parts", f"{part['name']}.json").write_text(json.dumps(part), encoding="utf-8")
        return "" if part["passed"] else self.sentence(part["name"], status, said, cases)

    def sentence(self, name, status, said, cases):
        if name not in cases:
            return f"tonetool_check: {name}: the program has no result, exit status {status}\n{said}".strip()
        folder = self.state.results / self.store.folder
        lines = [f"tonetool_check: {name}: {': '.join(cases[name])}"]
        lines += [line for line in said.splitlines() if line.startswith("tonetool WARNING")]
        if cases[name][0] == "failed":
            lines.append(f"pictures: {typed(folder / name, self.cwd)}.reference.png, .test.png, .error.png")
        else:
            lines.append(f"the image: {typed(folder / name, self.cwd)}.exr")
        if "\nto approve" in f"\n{said}":
            lines.append(f"to approve, after a look: {approve_line(folder / 'run.json', [name], self.cwd)}")
        return "\n".join(lines)
