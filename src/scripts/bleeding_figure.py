#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How bases keep objects apart: bleeding_figure.py TONETOOL CORNELL GALLERY SHEET

For the renders of testimages/scenes.py in any size: a picture, and of the part that is framed the
luminance, the base of the classic bilateral filter and that of the guided one."""

import subprocess
import sys
import tempfile
from pathlib import Path

import OpenImageIO as oiio
from OpenImageIO import ImageBufAlgo as iba

PANEL, LABEL, GAP = 294, 22, 8
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
INK, FRAME = (0.85, 0.85, 0.85), (1, 1, 0)
# Squares by their left and upper end and their side, in heights of the image: what is shown of the
# picture, and the part of it whose objects are as bright as what is behind them.
PLACES = [((0, 0, 1), (0.22, 0.38, 0.32)), ((0, 0, 1), (0.2, 0.66, 0.33))]
COLUMNS = {"CG-TMO": "--cgtmo:preset=classic:samples=0",
           "luminance": "--cgtmo:filter=none:show=base",
           "base, bilateral filter of luminance": "--cgtmo:filter=bilateral:samples=0:show=base",
           "base, guided filter": "--cgtmo:preset=classic:samples=0:show=base"}


def made(program, image, command, folder):
    """The colour of an image after a command: encoded for a picture, linear for a part of it."""
    part = "show=" in command
    name = str(Path(folder) / ("made.exr" if part else "made.png"))
    colour = ",".join("ViewLayer.Combined." + c for c in "RGB")
    subprocess.run([program, "-q", image, command, "--ch", colour, "--chnames", "R,G,B",
                    "-d", "float" if part else "uint8", "-o", name], check=True)
    out = oiio.ImageBuf(name)
    out.read(force=True)  # before the file is written again
    return out


def cut(image, place):
    height = image.spec().height
    x, y, side = (round(v * height) for v in place)
    part = iba.cut(image, roi=oiio.ROI(x, x + side, y, y + side, 0, 1, 0, 3))
    return iba.resize(part, "box", roi=oiio.ROI(0, PANEL, 0, PANEL, 0, 1, 0, 3))


def framed(picture, shown, part):
    """The picture with a frame round the part."""
    out = cut(picture, shown)
    scale = PANEL / shown[2]
    x, y, side = ((part[0] - shown[0]) * scale, (part[1] - shown[1]) * scale, part[2] * scale)
    for grow in (0, 1):
        iba.render_box(out, round(x) - grow, round(y) - grow, round(x + side) + grow,
                       round(y + side) + grow, FRAME)
    return out


def grey(panels):
    """All in the same grey, encoded: the brightest of the last one is white."""
    white = max(iba.computePixelStats(panels[-1]).max)
    return [iba.pow(iba.clamp(iba.mul(panel, 1 / white), 0, 1), 1 / 2.2) for panel in panels]


def row(program, image, place, folder):
    picture, *parts = [made(program, image, command, folder) for command in COLUMNS.values()]
    return [framed(picture, *place), *grey([cut(part, place[1]) for part in parts])]


def main(program, *images_and_sheet):
    *images, sheet = images_and_sheet
    out = oiio.ImageBuf(oiio.ImageSpec(len(COLUMNS) * (PANEL + GAP) - GAP,
                                       len(images) * (PANEL + GAP) - GAP + LABEL, 3, "uint8"))
    with tempfile.TemporaryDirectory() as folder:
        for y, (image, place) in enumerate(zip(images, PLACES)):
            for x, panel in enumerate(row(program, image, place, folder)):
                iba.paste(out, x * (PANEL + GAP), y * (PANEL + GAP), 0, 0, panel)
    for x, label in enumerate(COLUMNS):
        iba.render_text(out, x * (PANEL + GAP) + 4, out.spec().height - 6, label, 14, FONT, INK)
    out.specmod().attribute("oiio:ColorSpace", "sRGB")
    out.specmod().attribute("Compression", "jpeg:90")
    if not out.write(sheet):
        sys.exit(out.geterror())


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
