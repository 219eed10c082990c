# SPDX-License-Identifier: BSD-3-Clause
"""The commands of README and guides, and what they print.

In a page

* each line of a ```sh block is a command. A page's blocks run in the order of the page, each in a
  folder of its own, where testimages, ocio, src and build/release are what they are in the
  repository. All commands must succeed, but for one that the line `echo $?` follows;
* an indented block, or one that begins with ```text, directly below is all that the block's commands
  print, on standard output and standard error. A line `...` there stands for any number of lines,
  `...` within a line for any text. Numbers with a decimal point agree within a thousandth, or what
  `<!-- within 0.2 -->` above the output says; everything else is as it is shown;
* `tonetool ...`, `oiiotool ...` and scripts of src in a sentence or in a table are run, too.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GUIDES = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob("src/doc/*.md"))
# Installs packages and builds the project: src/scripts/matrix.sh does, in systems of their own.
ELSEWHERE = ("src/doc/building.md",)
PAGES = ["README.md", *(page for page in GUIDES if page not in ELSEWHERE)]

# Instruction sets differ by up to 2e-5 in an error; pages show six digits.
ABSOLUTE = 3e-5
RELATIVE = 1e-3

NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+(?:e[-+]?\d+)?|e[-+]?\d+)(?!\w|\.\d)")
INLINE = re.compile(r"`((?:tonetool|oiiotool|src/(?:farm|scripts)/[^\s`]+) [^`]*)`")
DOTS = "..."
PYTEST = "/usr/bin/pytest"  # of the interpreter that the module is built for
HOSTS = ("oiiotool", "iinfo", "idiff", "maketx", "iconvert")


class Block:
    """Commands, and what is shown of their output: the lines [begin, end) of the page, or None."""

    def __init__(self, page, line, text):
        self.page = page
        self.line = line
        self.text = text
        self.shown = None
        self.begin = self.end = 0
        self.indent = ""
        self.within = None

    def __repr__(self):
        return f"{self.page}:{self.line}"

    def commands(self):
        """One command a line; a line that ends in a backslash goes on, and one with <<'END' to that word."""
        commands, end = [], None
        for line in self.text.replace("\\\n", "").splitlines():
            if end:
                commands[-1] += f"\n{line}"
                end = None if line == end else end
            elif line.strip() and line.strip()[0] != "#":
                commands.append(line)
                here = re.search(r"<<'(\w+)'", line)
                end = here and here[1]
        return commands


def fenced(lines, kind):
    """(first line, end) of the insides of the blocks ```kind."""
    at = 0
    while at < len(lines):
        if lines[at].startswith("```"):
            end = next(i for i in range(at + 1, len(lines)) if lines[i].startswith("```"))
            if lines[at].strip() == f"```{kind}":
                yield at + 1, end
            at = end
        at += 1


def code(page, kind, root=ROOT):
    """The texts of a page's blocks ```kind."""
    lines = (root / page).read_text(encoding="utf-8").split("\n")
    return ["\n".join(lines[begin:end]) + "\n" for begin, end in fenced(lines, kind)]


def find_output(block, lines, at):
    """What is shown below a block whose fence ends before line `at`."""
    while at < len(lines) and (not lines[at].strip() or lines[at].startswith("<!-- within ")):
        if lines[at].strip():
            block.within = float(lines[at].split()[2])
        at += 1
    if at < len(lines) and lines[at].startswith("    "):
        block.indent = "    "
        end = at
        while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
            end += 1
        while not lines[end - 1].strip():
            end -= 1
    elif at < len(lines) and lines[at] == "```text":
        at += 1
        end = next(i for i in range(at, len(lines)) if lines[i] == "```")
    else:
        return
    block.begin, block.end = at, end
    block.shown = [line[len(block.indent):] for line in lines[at:end]]


def blocks(page, root=ROOT):
    """The ```sh blocks of a page."""
    lines = (root / page).read_text(encoding="utf-8").split("\n")
    found = []
    for begin, end in fenced(lines, "sh"):
        block = Block(page, begin + 1, "\n".join(lines[begin:end]) + "\n")
        find_output(block, lines, end + 1)
        found.append(block)
    return found


def inline(page, root=ROOT):
    """Commands in sentences and tables, as blocks of one line."""
    found = []
    inside = False
    for number, line in enumerate((root / page).read_text(encoding="utf-8").split("\n"), 1):
        inside ^= line.startswith("```")
        if not inside and not line.startswith("    "):
            for command in INLINE.findall(line):
                found.append(Block(page, number, command.replace(r"\|", "|") + "\n"))
    return found


def fill(folder, program):
    """Makes `folder` look like the repository after the set-up, whichever build this is."""
    for name in ("testimages", "ocio", "src"):
        (folder / name).symlink_to(ROOT / name)
    (folder / "build").mkdir()
    (folder / "build" / "release").symlink_to(Path(program).resolve().parents[2])


def script(block):
    """The block for bash, which leaves the status of each command on descriptor 3."""
    runtime = os.environ.get("SANITIZER_RUNTIME")
    text = []
    for command in block.commands():
        word = command.split()[0]
        if runtime and (word in HOSTS or "--doctor" in command):
            options = os.environ.get("ASAN_OPTIONS", "")
            command = f"LD_PRELOAD='{runtime}' ASAN_OPTIONS='{options}:detect_leaks=0' {command}"
        text.append(f"{command}\nstatus=$?\necho $status >&3\n(exit $status)\n")
    return "".join(text)


class Ran:
    """What a block did: the statuses of its commands, and the lines that were printed."""

    def __init__(self, block, statuses, text):
        self.lines = [line.rstrip() for line in text.splitlines()]
        self.text = text
        self.statuses = statuses
        followed = [after.split() == ["echo", "$?"] for after in [*block.commands()[1:], ""]]
        self.failed = [command for command, status, expected
                       in zip(block.commands(), [*statuses, *[None] * 99], followed)
                       if status != 0 and not expected]


def run(block, program, folder, timeout=180):
    """Runs a block in `folder`, which fill() has filled, as in a shell with the program on its path."""
    if os.environ.get("SANITIZER_RUNTIME"):
        timeout *= 5
    environment = {key: value for key, value in os.environ.items()
                   if key not in ("OIIO_LIBRARY_PATH", "OCIO", "PRESTART")}
    environment["PATH"] = f"{folder}/build/release/src/program:/usr/local/bin:/usr/bin:/bin"
    environment["PWD"] = str(folder)
    with open(folder / ".statuses", "w+", encoding="utf-8") as statuses:
        done = subprocess.run(["bash", "-c", f"exec 3>&{statuses.fileno()}\n" + script(block)],
                              cwd=folder, env=environment, stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout,
                              check=False, pass_fds=[statuses.fileno()])
        statuses.seek(0)
        return Ran(block, [int(word) for word in statuses.read().split()], done.stdout)


def lacks(block, program):
    """Why a block cannot run here; empty where it can."""
    plugin = Path(program).resolve().parents[1] / "tone.imageio" / "tone.imageio.so"
    for command in block.commands():
        word = command.split()[0]
        if word in HOSTS and not shutil.which(word, path="/usr/bin"):
            return f"no {word}"
        if "--doctor" in command or word in HOSTS and ".tone" in command:
            if not plugin.exists() or not shutil.which("oiiotool", path="/usr/bin"):
                return "no plugin, or no oiiotool"
        module = Path(program).resolve().parents[1] / "python" / "pytest_tonetool"
        if word == "pytest" and not (module.exists() and Path(PYTEST).exists()):
            return "no Python module, or no pytest"
    return ""


def pattern(shown):
    """A line as a regular expression: its numbers are groups, its dots any text."""
    parts = re.split(f"({NUMBER.pattern}|{re.escape(DOTS)})", shown)
    return "".join(".*" if part == DOTS else f"({NUMBER.pattern})" if NUMBER.fullmatch(part)
                   else re.escape(part) for part in parts)


def numbers(shown):
    return [part for part in re.split(f"({NUMBER.pattern})", shown)[1::2]]


def same_line(shown, actual, within=None):
    """Whether a line that a page shows is the one that is printed."""
    found = re.fullmatch(pattern(shown), actual)
    return found is not None and all(close(float(a), float(b), within)
                                     for a, b in zip(numbers(shown), found.groups()))


def close(shown, actual, within=None):
    if within is not None:
        return abs(shown - actual) <= within * max(abs(shown), abs(actual))
    return abs(shown - actual) <= RELATIVE * max(abs(shown), abs(actual)) + ABSOLUTE


def segments(shown):
    """The runs of lines between lines of dots."""
    found = [[]]
    for line in shown:
        if line.strip() == DOTS:
            found.append([])
        else:
            found[-1].append(line)
    return found


def same_output(shown, actual, within=None):
    """Whether the shown lines are the printed ones, with gaps only where lines of dots stand."""
    def fits(part, at):
        return len(actual) >= at + len(part) and all(
            same_line(a, b, within) for a, b in zip(part, actual[at:]))

    parts = segments(shown)
    if len(parts) == 1:
        return len(shown) == len(actual) and fits(shown, 0)
    if not fits(parts[0], 0):
        return False
    at = len(parts[0])
    for part in parts[1:-1]:
        at = next((i + len(part) for i in range(at, len(actual)) if fits(part, i)), None)
        if at is None:
            return False
    last = len(actual) - len(parts[-1])
    return last >= at and fits(parts[-1], last)
