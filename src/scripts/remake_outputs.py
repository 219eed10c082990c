#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Renews what README and guides show of the program's output: remake_outputs.py TONETOOL [PAGE...]

Runs the commands of the pages (of all, relative to the repository) as tests/cli/markdown.py describes,
and writes what they print below them, where that is no longer what is shown. Lines of dots stay where
they leave lines out. Read the difference before you commit it."""

import difflib
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))

# pylint: disable=wrong-import-position
import markdown  # noqa: E402

WHOLE = 8  # lines that are shown whole where the old ones are not found in them


def likeness(shown, actual):
    """0 to 1: how much of a line is still the same, whatever its numbers are; 0 is another line."""
    ratio = difflib.SequenceMatcher(None, markdown.NUMBER.sub("#", shown),
                                    markdown.NUMBER.sub("#", actual)).ratio()
    return ratio if ratio > 0.6 else 0


def aligned(shown, actual):
    """Pairs of a shown line and the printed line that has become of it, in order."""
    best = [[(0, [])] * (len(actual) + 1) for _ in range(len(shown) + 1)]
    for i, old in enumerate(shown, 1):
        for j, new in enumerate(actual, 1):
            score, pairs = best[i - 1][j - 1]
            like = likeness(old, new)
            both = (score + like, [*pairs, (i - 1, j - 1)]) if like else best[i - 1][j]
            best[i][j] = max(both, best[i - 1][j], best[i][j - 1], key=lambda found: found[0])
    return best[-1][-1][1]


def with_dots(shown, actual):
    """The printed line, shortened where the shown one is if that still fits."""
    return shown if markdown.same_line(shown, actual) else actual


def remade(shown, actual):
    """What a page shows of the printed lines."""
    if not any(markdown.DOTS in line for line in shown):
        return actual
    lines = [line for line in shown if line.strip() != markdown.DOTS]
    pairs = aligned(lines, actual)
    if len(pairs) * 2 < len(lines) and len(actual) <= WHOLE:
        return actual
    if not pairs:
        return [*actual[:3], markdown.DOTS, actual[-1]]
    made = []
    at = 0
    for old, new in pairs:
        if new > at:
            made.append(markdown.DOTS)
        made.append(with_dots(lines[old], actual[new]))
        at = new + 1
    return made + ([markdown.DOTS] if at < len(actual) else [])


def remake(page, program):
    """Renews one page; the number of commands that failed."""
    path = ROOT / page
    lines = path.read_text(encoding="utf-8").split("\n")
    failed = 0
    for block in reversed(markdown.blocks(page)):
        if block.shown is None or markdown.lacks(block, program):
            continue
        with tempfile.TemporaryDirectory() as folder:
            markdown.fill(Path(folder), program)
            ran = markdown.run(block, program, Path(folder))
        if ran.failed:
            print(f"{block}: failed: {ran.failed[0]}\n{ran.text}")
            failed += 1
        elif not markdown.same_output(block.shown, ran.lines, block.within):
            made = remade(block.shown, ran.lines)
            lines[block.begin:block.end] = [(block.indent + line).rstrip() for line in made]
            print(f"{block}: {len(block.shown)} lines are now {len(made)}")
    path.write_text("\n".join(lines), encoding="utf-8")
    return failed


def main(program, pages):
    program = str(Path(program).resolve())
    return sum(remake(page, program) for page in pages or markdown.PAGES)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(1 if main(sys.argv[1], sys.argv[2:]) else 0)
