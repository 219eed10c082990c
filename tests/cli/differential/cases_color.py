# SPDX-License-Identifier: BSD-3-Clause
"""Colour management, premultiplication, colour maps."""

from case import table

CONFIG = "--colorconfig in/ocio/tonetool.ocio"

COLOR = f"""
colorconfig: {CONFIG} in/rgb.exr --tocolorspace ACEScg -o out.exr
colorconfig-later: in/rgb.exr {CONFIG} --colorconvert ACEScg ACEScct -o out.exr
tocolorspace: in/rgb.exr --tocolorspace sRGB -o out.exr
tocolorspace-alpha: in/rgba.exr --tocolorspace sRGB -o out.exr
tocolorspace-unpremult: in/rgba.exr --tocolorspace:unpremult=1 sRGB -o out.exr
tocolorspace-integer: in/u8.png --tocolorspace linear -d half -o out.exr
tocolorspace-parts: -a in/pair.exr --tocolorspace sRGB -o out.exr
tocolorspace-config: {CONFIG} in/u8.png --iscolorspace "sRGB - Texture" --tocolorspace ACEScg
    -d half -o out.exr
tocolorspace-keys: {CONFIG} in/rgb.exr --tocolorspace:key=A:value=b:strict=0 ACEScg -o out.exr
tocolorspace-strict: in/rgb.exr --tocolorspace:strict=0 nosuch -o out.exr
iscolorspace: in/rgb.exr --iscolorspace sRGB -o out.exr
iscolorspace-then: in/rgb.exr --iscolorspace sRGB --tocolorspace linear -o out.exr
iscolorspace-parts: -a in/pair.exr --iscolorspace Rec709 -o out.exr
colorconvert: in/rgb.exr --colorconvert linear sRGB -o out.exr
colorconvert-back: in/rgb3.exr --colorconvert sRGB linear -o out.exr
colorconvert-rec709: in/rgb3.exr --colorconvert linear Rec709 -o out.exr
colorconvert-unpremult: in/rgba.exr --colorconvert:unpremult=1 linear sRGB -o out.exr
colorconvert-strict: in/rgb.exr --colorconvert:strict=1 linear sRGB -o out.exr
colorconvert-lax: in/rgb.exr --colorconvert:strict=0 nosuch sRGB -o out.exr
colorconvert-key-two: {CONFIG} in/rgb.exr --colorconvert:key=A,B:value=a,b:strict=1 ACEScg ACEScct
    -o out.exr
ociodisplay-all: {CONFIG} in/rgba.exr
    --ociodisplay:from=ACEScct:key=A:value=b:looks=other:unpremult=1 Rec.1886 linear -o out.exr
ociolook-all: {CONFIG} in/rgba.exr --ociolook:from=ACEScct:to=ACEScct:inverse=0:key=A:value=b
    "ACES 1.3 Reference Gamut Compression" -o out.exr
ociofiletransform-all: {CONFIG} in/rgba.exr
    --ociofiletransform:inverse=1:unpremult=1 hable.clf -o out.exr
tocolorspace-unpremult-config: {CONFIG} in/rgba.exr --tocolorspace:unpremult=1 ACEScct -o out.exr
autocc-unpremult-png: --autocc:unpremult=1 in/rgba.exr -o out.png
ccmatrix-all: in/rgba.exr --ccmatrix:unpremult=1:transpose=1 .8,.1,.1,.2,.7,.1,0,.1,.9 -o out.exr
colorconvert-key: {CONFIG} in/rgb.exr --colorconvert:key=SHOT:value=a ACEScg ACES2065-1 -o out.exr
colorconvert-parts: -a in/pair.exr --colorconvert linear sRGB -o out.exr
colorconvert-grey: in/grey.exr --colorconvert linear sRGB -o out.exr
colorconvert-config: {CONFIG} in/rgb.exr --colorconvert ACEScg ACEScct -o out.exr
ociodisplay: {CONFIG} in/rgb.exr --ociodisplay sRGB "ACES SDR" -o out.exr
ociodisplay-from: {CONFIG} in/rgb.exr --ociodisplay:from=ACEScg sRGB "ACES SDR" -o out.exr
ociodisplay-curve: {CONFIG} in/rgb.exr --ociodisplay Rec.1886 agx -d uint8 -o out.png
ociodisplay-hdr: {CONFIG} in/rgb.exr --ociodisplay Rec.2100-PQ "ACES HDR 1000" -d uint16 -o out.tif
ociodisplay-unpremult: {CONFIG} in/rgba.exr --ociodisplay:unpremult=1 sRGB reinhard -o out.exr
ociodisplay-key: {CONFIG} in/rgb.exr --ociodisplay:key=SHOT:value=a sRGB Raw -o out.exr
ociodisplay-looks: {CONFIG} in/rgb.exr --ociodisplay:looks=nosuch sRGB "ACES SDR" -o out.exr
ociodisplay-default!: {CONFIG} in/rgb.exr --ociodisplay default default -o out.exr
ociodisplay-parts: {CONFIG} -a in/pair.exr --ociodisplay sRGB hable -o out.exr
ociolook: {CONFIG} in/rgb.exr
    --ociolook:from=ACEScg:to=ACEScg "ACES 1.3 Reference Gamut Compression" -o out.exr
ociolook-inverse: {CONFIG} in/rgb.exr
    --ociolook:from=ACEScg:to=ACES2065-1:inverse=1 "ACES 1.3 Reference Gamut Compression" -o out.exr
ociolook-unpremult: {CONFIG} in/rgba.exr
    --ociolook:unpremult=1:key=A:value=b "ACES 1.3 Reference Gamut Compression" -o out.exr
ociofiletransform: {CONFIG} in/rgb.exr --ociofiletransform reinhard.ctf -o out.exr
ociofiletransform-name: {CONFIG} in/rgb.exr --ociofiletransform hable.clf -o out.exr
ociofiletransform-inverse: {CONFIG} in/rgb3.exr
    --ociofiletransform:inverse=1 reinhard.ctf -o out.exr
ociofiletransform-unpremult: {CONFIG} in/rgba.exr
    --ociofiletransform:unpremult=1 reinhard.ctf -o out.exr
autocc: --autocc in/rgb.exr -o out.png
autocc-input: --autocc in/u8.png -o out.exr
autocc-name: --autocc in/plate_sRGB.tif -d half -o out_linear.exr
autocc-unpremult: --autocc:unpremult=1 in/straight.png -o out.exr
autocc-off: --autocc --noautocc in/rgb.exr -o out.png
autocc-output: in/rgb.exr -o:autocc=1 out.jpg
autocc-output-off: --autocc in/rgb.exr -o:autocc=0 out.png
autocc-config: {CONFIG} --autocc in/u8.png --mulc 0.5 -o out.exr
noautocc: --noautocc in/u8.png -o out.exr
ccmatrix-nine: in/rgb.exr --ccmatrix .8,.1,.1,.2,.7,.1,0,.1,.9 -o out.exr
ccmatrix-sixteen: in/rgba.exr --ccmatrix .8,.1,.1,0,.2,.7,.1,0,0,.1,.9,0,0,0,0,1 -o out.exr
ccmatrix-transpose: in/rgb.exr --ccmatrix:transpose=1 .8,.1,.1,.2,.7,.1,0,.1,.9 -o out.exr
ccmatrix-unpremult: in/rgba.exr
    --ccmatrix:unpremult=1 .8,.1,.1,0,.2,.7,.1,0,0,.1,.9,0,.1,0,0,1 -o out.exr
ccmatrix-parts: -a in/pair.exr --ccmatrix .8,.1,.1,.2,.7,.1,0,.1,.9 -o out.exr
premult: in/rgba.exr --premult -o out.exr
premult-parts: -a in/pair.exr --premult -o out.exr
unpremult: in/rgba.exr --unpremult -o out.exr
unpremult-premult: in/rgba.exr --unpremult --premult -o out.exr
repremult: in/rgba.exr --unpremult --repremult -o out.exr
repremult-alone: in/rgba.exr --repremult -o out.exr
premult-rgb: in/rgb.exr --premult --unpremult -o out.exr
"""

MAPS = ["names: " + " ".join(f"in/grey.exr --colormap {name} -o {name}.exr" for name in (
    "inferno", "viridis", "magma", "turbo", "plasma", "blue-red", "spectrum", "heat"))]

COLORMAP = """
first-channel: in/rgb.exr --colormap magma -o out.exr
list: in/grey.exr --colormap 0,0,0,1,0,0,1,1,1 -o out.exr
list-of-two: in/signed.exr --colormap .25,.25,.25,0,.5,0 -d uint8 -o out.png
parts: -a in/pair.exr --colormap viridis -o out.exr
chain: in/rgb.exr in/rgb2.exr --absdiff --maxchan --colormap inferno -d uint8 -o out.png
"""

CASES = [*table("color", COLOR), *table("colormap", "\n".join(MAPS) + COLORMAP)]
