# SPDX-License-Identifier: BSD-3-Clause
"""Runs a case through a program in a fresh folder, and says how two runs differ."""

import hashlib
import json
import os
import re
import shutil
import threading
from dataclasses import dataclass
from pathlib import Path

from image_differences import image_differences
from prestart import run_bytes

READ_LOCK = threading.Lock()
SET = {"OPENIMAGEIO_METADATA_HISTORY": "1"}     # 3.x writes none by itself
PRIVATE = ("OCIO", "OPENIMAGEIO_", "OIIO_", "EXR_", "TONETOOL")


@dataclass
class Ran:
    folder: Path
    status: int
    out: str
    err: str

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*")
                      if path.is_file() and path.relative_to(self.folder).parts[0] != "in")


def run_case(case, program, options, inputs, folder):
    """All command lines of the case in `folder`, where in/ leads to the inputs."""
    folder.mkdir(parents=True)
    (folder / "in").symlink_to(inputs)
    environment = {key: value for key, value in os.environ.items()
                   if not key.startswith(PRIVATE)}
    environment.update(SET)
    if "capture" in case.commands() and "ASAN_OPTIONS" in environment:
        # What libraries of cameras leave allocated is known by the whole stack.
        environment["ASAN_OPTIONS"] += ":fast_unwind_on_malloc=0"
    status, out, err = 0, "", ""
    for words in case.command_lines():
        done = run_bytes(program, [*options, *words], folder, 120, environment)
        status = done.returncode
        out += done.stdout.decode(errors="replace").replace(str(folder), "FOLDER")
        err += done.stderr.decode(errors="replace").replace(str(folder), "FOLDER")
    return Ran(folder, status, out, err)


class StockRuns:
    """What stock oiiotool does with cases. Where DIFFERENTIAL_CACHE names a folder, runs stay there
    for the next session; a run is known by the program, the inputs and the command line."""

    def __init__(self, program, inputs, scratch):
        self.program, self.inputs = program, inputs
        kept = os.environ.get("DIFFERENTIAL_CACHE")
        self.keeps = bool(kept)
        self.root = Path(kept) if kept else scratch
        self.root.mkdir(parents=True, exist_ok=True)
        made_by = Path(__file__).with_name("inputs.py").read_bytes()
        built = os.stat(program)
        self.known = hashlib.sha1(made_by + f"{built.st_size} {built.st_mtime_ns} {SET}".encode())

    def run(self, case):
        key = self.known.copy()
        key.update(case.line.encode())
        folder = self.root / key.hexdigest()
        record = folder.with_suffix(".json")
        if self.keeps and record.exists():
            return Ran(folder, **json.loads(record.read_text()))
        shutil.rmtree(folder, ignore_errors=True)
        ran = run_case(case, self.program, [], self.inputs, folder)
        (folder / "in").unlink()
        if self.keeps:
            unfinished = record.with_suffix(".unfinished")
            unfinished.write_text(json.dumps({"status": ran.status, "out": ran.out,
                                              "err": ran.err}))
            unfinished.rename(record)
        return ran

    def forget(self, ran):
        if not self.keeps:
            shutil.rmtree(ran.folder)


def normalised(text, without=""):
    """Without what may differ between two programs that do the same: their name, the time that
    passed, memory, names of unfinished files, the usage text after an unknown option, warnings of
    modifiers that do nothing."""
    text = re.sub(r"(?ms)^(oiiotool|tonetool) -- .*", "", text)
    text = re.sub(r"\b(oiiotool|tonetool)\b", "PROGRAM", text).replace(" --compat", "")
    # What --compat says beyond oiiotool: a modifier that does nothing.
    text = re.sub(r"(?m)^PROGRAM WARNING:? .*has no effect.*\n?", "", text)
    text = re.sub(r"\.[0-9a-f]{8}\.temp\.", ".", text)
    text = re.sub(r"\.(\w+\.\w+)\.\d+-\d+\.\w+", r"\1", text)
    text = re.sub(r"\b\d+(\.\d+)? ?[KMG]?B(?![\w=])", "SIZE", text)
    text = re.sub(r"(?<=\[ERROR:0@)\d+\.\d+", "TIME", text)     # OpenCV's clock
    # A server that forks for the program is older than a minute on a slow machine: "2m 3.1s".
    text = re.sub(r"(\b\d+h )?(\b\d+m )?\b\d+\.\d+ ?s\b|(?<=: )\s*\d+\.\d\d$", "TIME", text,
                  flags=re.M)
    lines = [line.rstrip() for line in text.strip().splitlines()]
    return "\n".join(line for line in lines if not without or not re.search(without, line))


def text_difference(what, stock, own, without):
    first, second = normalised(stock, without), normalised(own, without)
    if first == second:
        return []
    return [f"{what} differs\n--- oiiotool\n{first}\n--- tonetool\n{second}"]


def differences(case, stock, own):
    """What differs between the runs of the two programs: one text each."""
    found = []
    if stock.status != own.status:
        found.append(f"exit status {own.status}, oiiotool's is {stock.status}")
    found += text_difference("stdout", stock.out, own.out, case.without)
    found += text_difference("stderr", stock.err, own.err, case.without)
    if stock.files() != own.files():
        found.append(f"files {own.files()}, oiiotool wrote {stock.files()}")
    for name in sorted(set(stock.files()) & set(own.files())):
        with READ_LOCK:
            found += [f"{name}: {one}" for one in
                      image_differences(stock.folder / name, own.folder / name, case.within)]
    return found


def is_meaningful(case, stock, same_version=True):
    """What is wrong with the case itself, seen from stock oiiotool alone. Another version than the
    case was written for may end it with another status."""
    found = []
    if same_version and stock.status != case.status:
        found.append(f"oiiotool's exit status is {stock.status}, the case says {case.status}:\n"
                     f"{stock.out}{stock.err}")
    if not (stock.files() or stock.out or stock.err):
        found.append("oiiotool writes nothing and prints nothing")
    return found
