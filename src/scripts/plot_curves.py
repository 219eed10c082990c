#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws testimages/curves.svg: every tone curve of the registry, one panel each.

    plot_curves.py TONETOOL FILE.svg
"""

import csv
import math
import re
import subprocess
import sys
from pathlib import Path
from xml.sax.saxutils import escape

GREY = 0.18
LOW, HIGH, TICK = -8, 8, 4  # stops from middle grey
COLUMNS = 4
PANEL_W, PANEL_H, GAP_X, GAP_Y = 200, 128, 26, 62
LEFT, TOP, RIGHT, BOTTOM = 44, 54, 20, 40
INK, PALE, RULE, PAPER = "#222222", "#d3d3d3", "#e6e6e6", "#ffffff"
# Okabe and Ito's colours, which the colour-blind tell apart.
KINDS = {"rgb": ("#0072b2", "on each channel"), "luminance": ("#d55e00", "on luminance"),
         "color": ("#009e73", "mixes the channels")}


def srgb(v):
    return 12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055


def run(program, *words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def registry(program):
    text = run(program, "--tonecurves")
    return re.findall(r"^(\S+): (.*); on (rgb|luminance|color)$", text, re.M)


def responses(program):
    """Stops from middle grey and code values, by the curve's name."""
    header, *rows = csv.reader(run(program, "--tonecurves:table=1").splitlines())
    stops = [float(row[0]) - math.log2(GREY) for row in rows]
    return {name: [(s, srgb(float(row[i]))) for s, row in zip(stops, rows)]
            for i, name in enumerate(header) if i > 0}


def within(points):
    """The part of a curve that the panels show, with its ends interpolated."""
    shown = []
    for (s0, y0), (s1, y1) in zip(points, points[1:]):
        for edge in (LOW, HIGH):
            if s0 < edge < s1:
                shown.append((edge, y0 + (y1 - y0) * (edge - s0) / (s1 - s0)))
        if LOW <= s1 <= HIGH:
            shown.append((s1, y1))
    return sorted(shown)


def at(points, stop):
    (s0, y0), (s1, y1) = next(p for p in zip(points, points[1:]) if p[0][0] <= stop <= p[1][0])
    return y0 + (y1 - y0) * (stop - s0) / (s1 - s0)


def x_of(stop):
    return PANEL_W * (stop - LOW) / (HIGH - LOW)


def y_of(value):
    return PANEL_H * (1 - value)


def path(points):
    return "M" + " ".join(f"{x_of(s):.1f} {y_of(v):.1f}" for s, v in within(points))


def text(x, y, words, size=11, anchor="start", colour=INK, weight="normal"):
    return (f'<text x="{x:g}" y="{y:g}" font-size="{size}" text-anchor="{anchor}" '
            f'fill="{colour}" font-weight="{weight}">{escape(words)}</text>')


def line(x1, y1, x2, y2, colour):
    return f'<line x1="{x1:g}" y1="{y1:g}" x2="{x2:g}" y2="{y2:g}" stroke="{colour}"/>'


def axes(first_column, last_row):
    parts = []
    for stop in range(LOW, HIGH + 1, TICK):
        parts.append(line(x_of(stop), 0, x_of(stop), PANEL_H, RULE))
        if last_row:
            label = f"{stop:+d}".replace("-", "\u2212") if stop else "0"
            parts.append(text(x_of(stop), PANEL_H + 15, label, 10, "middle"))
    for value in (0, 0.5, 1):
        parts.append(line(0, y_of(value), PANEL_W, y_of(value), RULE))
        if first_column:
            parts.append(text(-8, y_of(value) + 3.5, f"{value:g}", 10, "end"))
    return parts


def panel(curve, column, bottom):
    name, title, kind, points = curve
    colour = KINDS[kind][0]
    parts = axes(column == 0, bottom)
    parts.append('<use href="#all"/>')
    parts.append(f'<path d="{path(points)}" fill="none" stroke="{colour}" stroke-width="2.2"/>')
    parts.append(f'<circle cx="{x_of(0):g}" cy="{y_of(at(points, 0)):.1f}" r="3.4" '
                 f'fill="{colour}" stroke="{PAPER}"/>')
    parts.append(text(0, -22, name, 13, colour=colour, weight="bold"))
    parts.append(text(0, -8, title, 10))
    return parts


def key():
    """In the places that are left."""
    parts = [text(0, 8, "Across: stops from middle grey (0.18)."),
             text(0, 24, "Up: what a screen gets, sRGB-encoded."),
             text(0, 40, "Dot: middle grey. Pale: all the others.")]
    for i, (colour, words) in enumerate(KINDS.values()):
        y = 62 + 18 * i
        parts.append(f'<path d="M0 {y}H26" stroke="{colour}" stroke-width="2.2"/>')
        parts.append(text(34, y + 4, words))
    return parts


def figure(curves):
    rows = -(-(len(curves) + 1) // COLUMNS)
    width = LEFT + RIGHT + COLUMNS * PANEL_W + (COLUMNS - 1) * GAP_X
    height = TOP + BOTTOM + rows * PANEL_H + (rows - 1) * GAP_Y
    every = "".join(f'<path d="{path(points)}"/>' for *_, points in curves)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             f'width="{width}" height="{height}" '
             'font-family="Helvetica, Arial, \'DejaVu Sans\', sans-serif">',
             "<title>The tone curves of tonetool</title>",
             f'<rect width="{width}" height="{height}" fill="{PAPER}"/>',
             f'<defs><g id="all" fill="none" stroke="{PALE}">{every}</g></defs>']
    for i in range(len(curves) + 1):
        row, column = divmod(i, COLUMNS)
        x, y = LEFT + column * (PANEL_W + GAP_X), TOP + row * (PANEL_H + GAP_Y)
        bottom = i + COLUMNS >= len(curves)
        inner = panel(curves[i], column, bottom) if i < len(curves) else key()
        parts += [f'<g transform="translate({x} {y})">', *inner, "</g>"]
    return "\n".join([*parts, "</svg>", ""])


def main(program, file):
    light = responses(program)
    curves = [(name, title, kind, light[name]) for name, title, kind in registry(program)]
    Path(file).write_text(figure(curves), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
