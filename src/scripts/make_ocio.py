#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes ocio/: the configuration tonetool.ocio, and a table per curve of the registry in luts/.

    make_ocio.py TONETOOL FOLDER

Names and tables come from the program; nothing in ocio/ is edited by hand.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

ENTRIES = 1024
D65 = (0.3127, 0.3290)
ACES_WHITE = (0.32168, 0.33767)
PRIMARIES = {  # of red, green, blue, and the white
    "aces": ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.077), ACES_WHITE),
    "rec709": ((0.640, 0.330), (0.300, 0.600), (0.150, 0.060), D65),
    "rec2020": ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046), D65),
    "p3-d65": ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060), D65),
}
BRADFORD = ((0.8951, 0.2664, -0.1614), (-0.7502, 1.7135, 0.0367), (0.0389, -0.0685, 1.0296))
SDR_DISPLAYS = {"sRGB": "sRGB - Display", "Rec.1886": "Rec.1886 Rec.709 - Display",
                "P3-D65": "P3-D65 - Display"}
HDR_DISPLAYS = {"Rec.2100-PQ": "Rec.2100-PQ - Display"}
ALL_DISPLAYS = {**SDR_DISPLAYS, **HDR_DISPLAYS}


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(len(b[0]))] for i in range(3)]


def inverse(m):
    def minor(i, j):
        r, c = [x for x in range(3) if x != i], [x for x in range(3) if x != j]
        return m[r[0]][c[0]] * m[r[1]][c[1]] - m[r[0]][c[1]] * m[r[1]][c[0]]

    det = sum((-1) ** j * m[0][j] * minor(0, j) for j in range(3))
    return [[(-1) ** (i + j) * minor(j, i) / det for j in range(3)] for i in range(3)]


def xyz(x, y):
    return [[x / y], [1.0], [(1 - x - y) / y]]


def to_xyz(name):
    """Linear RGB to CIE XYZ under the white of its own."""
    *rgb, white = PRIMARIES[name]
    columns = [xyz(x, y) if y else [[x], [y], [1 - x - y]] for x, y in rgb]
    m = [[columns[j][i][0] for j in range(3)] for i in range(3)]
    scale = multiply(inverse(m), xyz(*white))
    return [[m[i][j] * scale[j][0] for j in range(3)] for i in range(3)]


def adapt(source, target):
    cones = [multiply(BRADFORD, xyz(*white)) for white in (source, target)]
    gain = [[cones[1][i][0] / cones[0][i][0] if i == j else 0.0 for j in range(3)]
            for i in range(3)]
    return multiply(inverse(BRADFORD), multiply(gain, [list(row) for row in BRADFORD]))


def to_aces(name):
    m = multiply(adapt(PRIMARIES[name][3], ACES_WHITE), to_xyz(name))
    return multiply(inverse(to_xyz("aces")), m)


def matrix(m):
    rows = [", ".join(f"{v:.12g}" for v in row) + ", 0" for row in m]
    return "!<MatrixTransform> {matrix: [" + ", ".join(rows) + ", 0, 0, 0, 1]}"


def builtin(style):
    return "!<BuiltinTransform> {style: " + style + "}"


def exponent(value):
    return "!<ExponentTransform> {value: " + f"[{value}, {value}, {value}, 1]" + "}"


def group(*steps):
    return "!<GroupTransform>\n      children:\n" + "\n".join(f"        - {s}" for s in steps)


SRGB = "!<ExponentWithLinearTransform> {gamma: [2.4, 2.4, 2.4, 1], offset: [0.055, 0.055, 0.055, 0]}"


def colour_space(name, aliases="", family="", description="", encoding="", categories="",
                 data=False, **transform):
    lines = ["  - !<ColorSpace>", f"    name: {name}"]
    lines += [f"    aliases: [{aliases}]"] if aliases else []
    lines += [f"    family: {family}"] if family else []
    lines += ["    bitdepth: 32f"]
    lines += [f"    description: {description}"] if description else []
    lines += [f"    isdata: {str(data).lower()}"]
    lines += [f"    categories: [{categories}]"] if categories else []
    lines += [f"    encoding: {encoding}"] if encoding else []
    lines += ["    allocation: uniform"]
    lines += [f"    {key}: {value}" for key, value in transform.items()]
    return "\n".join(lines) + "\n"


def scene_spaces():
    def linear(name, aliases, space):
        return colour_space(name, aliases, "Linear", "", "scene-linear", "file-io, working-space",
                            to_scene_reference=matrix(to_aces(space)))

    def texture(name, aliases, decode):
        return colour_space(name, aliases, "Texture", "", "sdr-video", "file-io",
                            to_scene_reference=group(decode, matrix(to_aces("rec709"))))

    return [
        colour_space("ACES2065-1", "aces2065_1, ACES - ACES2065-1, lin_ap0, lin_ap0_scene", "ACES",
                     "What the other spaces are defined by.", "scene-linear", "file-io"),
        colour_space("ACEScg", "ACES - ACEScg, lin_ap1, lin_ap1_scene", "ACES", "",
                     "scene-linear", "file-io, working-space",
                     to_scene_reference=builtin("ACEScg_to_ACES2065-1")),
        colour_space("ACEScct", "ACES - ACEScct, acescct_ap1", "ACES", "", "log",
                     "working-space", to_scene_reference=builtin("ACEScct_to_ACES2065-1")),
        linear("Linear Rec.709 (sRGB)",
               "Linear, lin_rec709, lin_rec709_scene, lin_srgb, Utility - Linear - sRGB, "
               "Utility - Linear - Rec.709", "rec709"),
        linear("Linear Rec.2020", "lin_rec2020, lin_rec2020_scene, Utility - Linear - Rec.2020",
               "rec2020"),
        linear("Linear P3-D65", "lin_p3d65, lin_p3d65_scene, Utility - Linear - P3-D65", "p3-d65"),
        texture("sRGB - Texture",
                "sRGB, srgb_tx, srgb_texture, sRGB Texture, srgb_rec709_scene, "
                "Utility - sRGB - Texture", SRGB),
        texture("Gamma 2.2 Rec.709 - Texture", "g22_rec709, g22_rec709_tx, GammaCorrected2.2",
                exponent("2.2")),
        texture("Gamma 2.4 Rec.709 - Texture", "g24_rec709, g24_rec709_tx, GammaCorrected2.4, "
                "Rec709", exponent("2.4")),
        colour_space("Raw", "Utility - Raw", "Data", "Numbers that are no colours.", "data",
                     "file-io", data=True),
    ]


def display_spaces():
    def display(name, aliases, style, encoding="sdr-video"):
        return colour_space(name, aliases, "Display", "", encoding, "file-io",
                            from_display_reference=builtin("DISPLAY - CIE-XYZ-D65_to_" + style))

    return [
        colour_space("CIE-XYZ-D65", "cie_xyz_d65", "", "What the displays are defined by."),
        display("sRGB - Display", "srgb_display, srgb_rec709_display", "sRGB"),
        display("Rec.1886 Rec.709 - Display", "rec1886_rec709_display", "REC.1886-REC.709"),
        display("P3-D65 - Display", "p3d65_display", "G2.6-P3-D65"),
        display("Rec.2100-PQ - Display", "rec2100_pq_display", "REC.2100-PQ", "hdr-video"),
    ]


def view_transforms(curves):
    aces = "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - "

    def transform(name, description, steps):
        return ("  - !<ViewTransform>\n"
                f"    name: {name}\n"
                f"    description: {description}\n"
                f"    from_scene_reference: {steps}\n")

    rows = [
        transform("ACES SDR", "ACES 1.0 output transform for SDR video, 100 cd/m2",
                  builtin(aces + "SDR-VIDEO_1.0")),
        transform("ACES HDR 1000", "ACES 1.1 output transform for HDR video, 1000 cd/m2, Rec.2020",
                  builtin(aces + "HDR-VIDEO-1000nit-15nit-REC2020lim_1.1")),
        transform("Un-tone-mapped", "Scene light 1 is the display's white",
                  builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD")),
    ]
    for name, (title, _) in curves.items():
        rows.append(transform(name, f'"{title}; what --tonemap:curve={name} computes"', group(
            matrix(inverse(to_aces("rec709"))),
            "!<FileTransform> {src: " + file_of(name, curves) + ", interpolation: linear}",
            matrix(to_xyz("rec709")))))
    return rows


def displays(curves):
    def view(name, space):
        return (f"    - !<View> {{name: {name}, view_transform: {name}, "
                f"display_colorspace: {space}}}\n")

    text = ""
    for display, space in ALL_DISPLAYS.items():
        first = ["ACES SDR", *curves] if display in SDR_DISPLAYS else ["ACES HDR 1000"]
        text += f"  {display}:\n"
        text += "".join(view(name, space) for name in [*first, "Un-tone-mapped"])
        text += "    - !<View> {name: Raw, colorspace: Raw}\n"
    return text


def file_of(name, curves):
    return f"{name}.{'clf' if curves[name][1] == 'rgb' else 'ctf'}"


def config(curves):
    views = ["ACES SDR", *curves, "ACES HDR 1000", "Un-tone-mapped", "Raw"]
    return f"""ocio_profile_version: 2.1

environment:
  {{}}
search_path: luts
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]
name: tonetool
description: |
  ACES spaces and views, and tonetool's curves as views: what --tonemap computes, in any program
  that reads OpenColorIO 2.1 configurations. Made by make_ocio.py.

roles:
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE-XYZ-D65
  color_picking: sRGB - Texture
  color_timing: ACEScct
  compositing_linear: ACEScg
  compositing_log: ACEScct
  data: Raw
  default: Linear Rec.709 (sRGB)
  matte_paint: sRGB - Texture
  reference: ACES2065-1
  rendering: Linear Rec.709 (sRGB)
  scene_linear: Linear Rec.709 (sRGB)
  texture_paint: sRGB - Texture

file_rules:
  - !<Rule> {{name: PNG, extension: png, pattern: "*", colorspace: sRGB - Texture}}
  - !<Rule> {{name: JPEG, extension: jpg, pattern: "*", colorspace: sRGB - Texture}}
  - !<Rule> {{name: Default, colorspace: default}}

displays:
{displays(curves)}
active_displays: [{", ".join(ALL_DISPLAYS)}]
active_views: [{", ".join(views)}]
inactive_colorspaces: [CIE-XYZ-D65]

looks:
  - !<Look>
    name: ACES 1.3 Reference Gamut Compression
    process_space: ACES2065-1
    transform: {builtin("ACES-LMT - ACES 1.3 Reference Gamut Compression")}

default_view_transform: Un-tone-mapped

view_transforms:
{chr(10).join(view_transforms(curves))}
display_colorspaces:
{chr(10).join(display_spaces())}
colorspaces:
{chr(10).join(scene_spaces())}"""


def registry(program):
    """Title and domain of each curve, by name."""
    text = subprocess.run([program, "--tonecurves"], check=True, capture_output=True,
                          text=True).stdout
    found = re.findall(r"^(\S+): (.*); on (rgb|luminance|color)$", text, re.M)
    return {name: (title, domain) for name, title, domain in found}


def main(program, folder):
    curves = registry(program)
    luts = Path(folder) / "luts"
    if luts.exists():
        shutil.rmtree(luts)
    luts.mkdir(parents=True)
    for name in curves:
        command = f"--exportlut:curve={name}:encode=none:size={ENTRIES}"
        subprocess.run([program, command, luts / file_of(name, curves)], check=True,
                       stdout=subprocess.DEVNULL)
    (Path(folder) / "tonetool.ocio").write_text(config(curves), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
