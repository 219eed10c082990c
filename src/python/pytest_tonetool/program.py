# SPDX-License-Identifier: BSD-3-Clause
"""The program tonetool: where it is, what it is given, what it found, and what is said of that."""

import json
import os
import shlex
import shutil
import subprocess
from pathlib import Path


def program():
    """As the variable TONETOOL says, else of the same installation, else of PATH."""
    named = os.environ.get("TONETOOL")
    beside = Path(__file__).resolve().parents[4:5]  # below lib/python3.11/dist-packages/pytest_tonetool
    found = named or next((str(file / "bin/tonetool") for file in beside if (file / "bin/tonetool").is_file()), None)
    found = found or shutil.which("tonetool")
    if not found:
        raise RuntimeError("the program tonetool is neither beside this module nor in PATH, nor does TONETOOL name it")
    return found


def run_program(words, cwd):
    """Its exit status, and what it printed. Files have names from here: one of a folder above may have wildcards."""
    found = program()
    try:
        words = [os.path.relpath(word, cwd) if isinstance(word, Path) else word for word in words]
        done = subprocess.run([found, *words], cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", errors="replace", check=False)
    except OSError as error:
        raise RuntimeError(f"the program \"{found}\" cannot be run: {error.strerror}") from None
    return done.returncode, done.stdout.strip()


def write_suite(file, store, images, parts):
    rows = "".join(f"\n[[case]]\nname = {json.dumps(part['name'])}\nfail = {json.dumps(part['fail'])}\n"
                   for part in parts)
    reference, test = (json.dumps(os.path.relpath(path, file.parent)) for path in (store, images / "%N.exr"))
    file.write_text(f"tonetool-suite = 1\nname = \"pytest\"\nreference = {reference}\ntest = {test}\n"
                    f"check = \"--hdrflip\"\n{rows}", encoding="utf-8")


def statuses(output):
    """Status and message of each case of a run; none where it wrote no result."""
    try:
        cases = json.loads(output.read_text(encoding="utf-8"))["frames"]
        return {case["name"]: (case["status"], case.get("message", "")) for case in cases}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def told(error):
    return f"\"{error.filename}\": {error.strerror}" if isinstance(error, OSError) and error.filename else str(error)


def typed(path, cwd):
    """As it is typed in a shell."""
    return shlex.quote(os.path.relpath(path, cwd))


def approve_line(run, names, cwd, *more):
    return " ".join(["tonetool --approve", typed(run, cwd), *names, *more, "--reason 'WHY'"])
