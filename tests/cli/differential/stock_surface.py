# SPDX-License-Identifier: BSD-3-Clause
"""What oiiotool 2.4.7 takes: read out of its help and its binary, and, where neither says it, written
down here from its manual, its changelog and what it was seen to look for while it ran."""

import re
import subprocess
from pathlib import Path

# Its help hides them: older spellings and switches without effect.
HIDDEN = set("""nostderr auto-orient cadd csub cmul cpow flipflop force-tiles noclobber rot180 rotcw
    rotccw quality""".split())
# Of its makers: run its own tests, crash on purpose. Within it, "--i" is how -i calls itself.
OF_ITS_MAKERS = {"unittest", "crash", "i"}

# Modifiers by command, as the program asks for them; these are beside the two of every command on
# pixels.
SHARED = {"allsubimages", "subimages"}
_OUTPUT = """all autocc autocrop autotrim bits contig datatype dither fileformatname scanline separate
    tile type unpremult"""
_TEXTURE = """bumpformat cdf cdfbits cdfsigma compute_average constant_color_detect fileformatname
    filter filtername handed hicomp highlightcomp incolorspace monochrome_detect nomipmap oiio
    oiio_options opaque_detect outcolorspace prman prman_metadata prman_options resize sharpen swrap
    twrap unpremult updatemode uvslopes_scale wrap"""
_NOISE = "type min max mean stddev portion value mono seed"
_FILL = "color top bottom left right topleft topright bottomleft bottomright"
MODIFIERS = {
    "info": "format verbose", "dumpdata": "empty C", "autocc": "unpremult", "oiioattrib": "type",
    "set": "type", "i": "autocc ch info infoformat now type unpremult", "iconfig": "type",
    "o": _OUTPUT, "otex": _TEXTURE + " datatype type all autocc", "oenv": _TEXTURE,
    "obump": _TEXTURE, "echo": "newline", "printinfo": "native stats verbose allsubimages",
    "printstats": "window allsubimages", "colorcount": "eps", "attrib": "type", "create": "type",
    "pattern": f"{_NOISE} {_FILL} width height depth color1 color2", "capture": "camera",
    "invert": "chbegin chend", "noise": _NOISE + " nchannels", "chsum": "weight",
    "paste": "all mergeroi", "mosaic": "pad fit", "zover": "zeroisinf", "resample": "interp",
    "resize": "filter highlightcomp", "fit": "filter pad fillmode exact highlightcomp",
    "pixelaspect": "filter highlightcomp", "rotate": "filter center recompute_roi highlightcomp",
    "warp": "filter recompute_roi highlightcomp wrap",
    "st_warp": "filter chan_s chan_t flip_s flip_t", "blur": "kernel",
    "unsharp": "kernel width contrast threshold", "clamp": "min max clampalpha",
    "contrast": "black white min max scontrast sthresh clamp", "rangecompress": "luma",
    "rangeexpand": "luma", "line": "color", "point": "color", "box": "color fill", "fill": _FILL,
    "text": "x y size font color xalign yalign shadow", "chappend": "n", "siappend": "n",
    "subimage": "delete", "deepen": "z",
    "tocolorspace": "key value unpremult strict", "colorconvert": "key value unpremult strict",
    "ccmatrix": "unpremult transpose invert inverse",
    "ociolook": "from to inverse key value unpremult",
    "ociodisplay": "from looks key value unpremult", "ociofiletransform": "inverse unpremult",
    "add": "allsubimages", "mulc": "subimages",
}

# What {} may hold.
EXPRESSIONS = """TOP. IMG[ .width .height .nchannels .x .y .geom .full_geom .format .filename
    .file_extension .file_noextension MINCOLOR MAXCOLOR AVGCOLOR META METABRIEF STATS FRAME_NUMBER
    FRAME_NUMBER_PAD TOP[ getattribute( var( not( eq( neq( <=> // && ||""".split()


def stock_help(program):
    return subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout


def help_lines(program):
    """(command, the text behind it) of every option that the help lists."""
    lines = [line.split(None, 1) for line in stock_help(program).splitlines()
             if line.startswith("    -")]
    return [(line[0].lstrip("-"), line[1] if len(line) > 1 else "") for line in lines]


def listed_commands(program):
    return {name for name, _ in help_lines(program)}


def declared_commands(program):
    """What the binary declares to its parser: "--resize %s:GEOM", "--noclobber"."""
    found = re.findall(rb"(?<=\0)--?([A-Za-z][-A-Za-z_0-9]+)(?: %[^\0]*)?(?=\0)",
                       Path(program).resolve().read_bytes())
    return {name.decode() for name in found} - OF_ITS_MAKERS


def all_commands(program):
    return listed_commands(program) | HIDDEN


def listed_modifiers(program):
    """(command, modifier) of what the help has behind "options:"."""
    return {(name, key) for name, text in help_lines(program) if "options:" in text
            for key in re.findall(r"([A-Za-z]\w*)=", text.split("options:")[1])}


def all_modifiers(program):
    return listed_modifiers(program) | {(name, key) for name, keys in MODIFIERS.items()
                                        for key in keys.split()}
