# SPDX-License-Identifier: BSD-3-Clause
"""A differential case: one command line, or several joined by &&, and what may differ in it."""

import shlex
from dataclasses import dataclass


@dataclass(frozen=True)
class Case:
    name: str
    line: str
    status: int = 0         # of the last command line, of stock oiiotool
    within: float = 0.0     # largest difference of a value; needs a reason
    without: str = ""       # expression of printed lines that are not compared; needs a reason
    reason: str = ""

    def command_lines(self):
        """The words of each command line."""
        lines = [[]]
        for word in shlex.split(self.line):
            if word == "&&":
                lines.append([])
            else:
                lines[-1].append(word)
        return lines

    def commands(self):
        """Names of the commands used, without dashes and modifiers."""
        return {word.lstrip("-").split(":")[0] for line in self.command_lines() for word in line
                if word.startswith("-") and len(word) > 1 and not word[1].isdigit()}

    def modifiers(self):
        """(command, modifier) of every modifier used; a pattern's name takes them as well."""
        used = set()
        for line in self.command_lines():
            for before, word in zip(["", *line], line):
                name, _, rest = word.lstrip("-").partition(":")
                if before.lstrip("-") == "pattern":
                    name = "pattern"
                elif not word.startswith("-"):
                    continue
                used |= {(name, part.split("=")[0]) for part in rest.split(":") if "=" in part}
        return used


def table(group, text, **exceptions):
    """Cases of one group: a line "name: command line" each, indented lines continue it. "name!:"
    is a command line that stock oiiotool ends with status 1.

    exceptions: the fields of a case by its name, with dashes as underlines.
    """
    lines = []
    for line in text.strip("\n").splitlines():
        if line.startswith(" "):
            lines[-1] += " " + line.strip()
        elif line.strip():
            lines.append(line.strip())
    cases = []
    for line in lines:
        name, command_line = line.split(": ", 1)
        status, name = int(name.endswith("!")), name.rstrip("!")
        fields = exceptions.pop(name.replace("-", "_"), {})
        assert not fields or fields.get("reason"), f"{name}: an exception without a reason"
        cases.append(Case(f"{group}-{name}", command_line.strip(), **{"status": status, **fields}))
    assert not exceptions, f"exceptions of no case: {exceptions}"
    return cases
