#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One picture of an image under every tone curve: curve_sheet.py TONETOOL IMAGE SHEET [MODIFIERS]

Each curve is run by the program with its default parameters and the same MODIFIERS of --tonemap
(":method=mean"), so that the exposure is the same for all."""

import subprocess
import sys
import tempfile
from pathlib import Path

import OpenImageIO as oiio
from OpenImageIO import ImageBufAlgo as iba

WIDTH, COLUMNS, LABEL, GAP = 260, 5, 22, 4
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
INK = (0.85, 0.85, 0.85)


def picture(program, image, curve, modifiers, folder):
    """The image under one curve, with its name below."""
    name = str(Path(folder) / f"{curve}.png")
    subprocess.run([program, "-q", image, f"--tonemap:curve={curve}{modifiers}", "-o", name],
                   check=True, stderr=subprocess.DEVNULL)
    shown = iba.channels(oiio.ImageBuf(name), (0, 1, 2))
    height = round(WIDTH * shown.spec().height / shown.spec().width)
    small = iba.resize(shown, roi=oiio.ROI(0, WIDTH, 0, height, 0, 1, 0, 3))
    out = oiio.ImageBuf(oiio.ImageSpec(WIDTH, height + LABEL, 3, "uint8"))
    iba.paste(out, 0, 0, 0, 0, small)
    iba.render_text(out, 4, height + LABEL - 6, curve, 14, FONT, INK)
    return out


def main(program, image, sheet, modifiers=""):
    table = subprocess.run([program, "--tonecurves:table=1"], check=True, capture_output=True,
                           text=True).stdout
    curves = table.splitlines()[0].split(",")[1:]
    with tempfile.TemporaryDirectory() as folder:
        pictures = [picture(program, image, curve, modifiers, folder) for curve in curves]
    cell = pictures[0].spec()
    rows = -(-len(pictures) // COLUMNS)
    out = oiio.ImageBuf(oiio.ImageSpec(COLUMNS * (cell.width + GAP) - GAP,
                                       rows * (cell.height + GAP) - GAP, 3, "uint8"))
    for i, one in enumerate(pictures):
        iba.paste(out, i % COLUMNS * (cell.width + GAP), i // COLUMNS * (cell.height + GAP), 0, 0,
                  one)
    out.specmod().attribute("oiio:ColorSpace", "sRGB")
    out.specmod().attribute("Compression", "jpeg:86")
    if not out.write(sheet):
        sys.exit(out.geterror())


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    main(*sys.argv[1:])
