#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What HDR-FLIP gives for noise alone, and for changes, as Markdown tables:

    good_numbers.py TONETOOL [--name SCENE] [--samples N] RENDER RENDER... [--changed RENDER...]

The first renders are of one scene with different seeds and N samples per pixel each; the mean of 2, 4, ...
of them stands for a render of as many times the samples. A changed render has something else changed, and
a seed of its own; NAME.SEED.exr and NAME.SEED2.exr are two of one change. Limits are what good-numbers.md
recommends: those of the first two renders, a tenth or a fifth above. A change is found by a quantity if
every render of it is above the limit."""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

QUANTITIES = ("mean", "p99", "p99.9", "max")
# How far above one pair's noise a limit is set; max has none, since one pixel decides it.
MARGINS = {"mean": 1.1, "p99": 1.1, "p99.9": 1.2}


def run(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"good_numbers.py: exit status {done.returncode}\n{done.stderr}")


def measure(program, reference, tests, folder):
    """The quantities of each test against the reference."""
    found = Path(folder) / "found.json"
    run(program, reference, *tests, f"--hdrflip:tests={len(tests)}:print=0", "--json", found)
    (frame,) = json.loads(found.read_text())["frames"]
    by_test = {one["test"]: one["quantities"] for one in frame["measurements"]}
    return [{name: by_test[str(test)][name] for name in QUANTITIES} for test in tests]


def mean_image(program, renders, made):
    """The mean of renders, which is a render of as many times the samples."""
    words = [renders[0]]
    for render in renders[1:]:
        words += [render, "--add"]
    run(program, *words, "--mulc", 1 / len(renders), "-d", "float", "-o", made)
    return made


def row(*cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def rule(*names):
    row(*names)
    print("|---" + "|--:" * (len(names) - 1) + "|")


def noise_table(given, folder):
    """Two renders of different seeds, for more and more samples."""
    rule("scene, samples per pixel", *QUANTITIES)
    count = 1
    while 2 * count <= len(given.renders):
        pair = [mean_image(given.tonetool, given.renders[at:at + count], Path(folder) / f"{at}.exr")
                for at in (0, count)]
        (found,) = measure(given.tonetool, pair[0], pair[1:], folder)
        row(f"{given.name}, {given.samples * count}", *(f"{value:.3f}" for value in found.values()))
        count *= 2


def changes(renders):
    """Renders by the name of their change."""
    found = {}
    for render in renders:
        found.setdefault(re.sub(r"\.\d+$", "", Path(render).stem), []).append(render)
    return found


def change_table(given, folder):
    """The range of each quantity over the seeds, without and with each change."""
    rule("scene, change", *QUANTITIES, "found by")
    same = {"none": given.renders[1:]}
    limits = None
    for name, files in {**same, **changes(given.changed)}.items():
        found = measure(given.tonetool, given.renders[0], files, folder)
        limits = limits or {key: found[0][key] * margin for key, margin in MARGINS.items()}
        ends = {key: (min(one[key] for one in found), max(one[key] for one in found))
                for key in QUANTITIES}
        above = [key for key, limit in limits.items() if ends[key][0] > limit]
        row(f"{given.name}, {name}", *(f"{low:.3f} to {high:.3f}" for low, high in ends.values()),
            ", ".join(above) or "-")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tonetool")
    parser.add_argument("renders", nargs="+")
    parser.add_argument("--name", default="scene")
    parser.add_argument("--samples", type=int, default=1)
    parser.add_argument("--changed", nargs="+", default=[])
    given = parser.parse_args()
    if len(given.renders) < 2:
        parser.error("it takes two renders or more")
    with tempfile.TemporaryDirectory() as folder:
        noise_table(given, folder)
        if given.changed:
            print()
            change_table(given, folder)


if __name__ == "__main__":
    main()
