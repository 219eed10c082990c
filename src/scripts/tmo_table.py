#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""TMQI of the pictures that local tone mapping makes of images, as a table: tmo_table.py TONETOOL IMAGE...

Each image holds a render and its guides (position, normal, albedo) in layers. Rows are images,
columns are kinds of base; a cell is Q, structure S and naturalness N of an 8-bit picture."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

KINDS = {"guided": "", "preset=paper": ":preset=paper", "bilateral": ":filter=bilateral",
         "WLS": ":filter=wls", "none": ":filter=none"}


def run(program, *words):
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"tmo_table.py: {' '.join(words)}: exit status {done.returncode}\n{done.stderr}")
    return done.stdout


def score(program, image, modifiers, folder):
    """Q, S and N of one picture."""
    picture = str(Path(folder) / "picture.png")
    run(program, "-q", image, f"--cgtmo:strict=1{modifiers}", "-d", "uint8", "-o", picture)
    facts = dict(line.split()[1:3] for line in run(program, image, picture, "--tmqi:print=1").splitlines())
    return [float(facts[name]) for name in "QSN"]


def names(images):
    """What tells the paths apart: "gallery/ref" of "scenes/gallery/ref.exr"."""
    if len(images) == 1:
        return [Path(images[0]).stem]
    folder = os.path.commonpath([os.path.abspath(image) for image in images])
    return [os.path.relpath(os.path.abspath(image), folder).rsplit(".", 1)[0] for image in images]


def line(cells, width):
    return "| " + " | ".join(cell.ljust(width[i > 0]) for i, cell in enumerate(cells)) + " |"


def main(program, images):
    labels = names(images)
    width = [max(map(len, [*labels, "Q S N"])), len("0.0000 0.000 0.000")]
    print(line(["Q S N", *KINDS], width))
    print("|" + "|".join("-" * (width[i > 0] + 2) for i in range(len(KINDS) + 1)) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for image, label in zip(images, labels):
            scores = [score(program, image, modifiers, folder) for modifiers in KINDS.values()]
            print(line([label, *(f"{q:.4f} {s:.3f} {n:.3f}" for q, s, n in scores)], width),
                  flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
