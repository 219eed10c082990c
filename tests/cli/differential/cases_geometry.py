# SPDX-License-Identifier: BSD-3-Clause
"""Windows, resampling, rotations, warps, compositing and mosaics."""

from case import table

WINDOWS = """
crop-size-offset: in/rgb.exr --crop 30x20+10+5 -o out.exr
crop-corners: in/rgb.exr --crop 10,5,39,24 -o out.exr
crop-pads: in/rgb.exr --crop 100x80-10-10 -o out.exr
crop-size-only: in/rgb.exr --crop 30x20 -o out.exr
crop-offset-only: in/rgb.exr --crop +10+5 -o out.exr
crop-to-tiff: in/u8.tif --crop 30x20+10+5 -o out.tif
crop-to-png: in/u8.png --crop 30x20+10+5 -o out.png
crop-expression: in/rgb.exr --crop "0,0,{TOP.width/2-1},{TOP.height/2-1}" -o out.exr
crop-parts: -a in/parts.exr --crop 20x20+10+10 -o out.exr
crop-first-part: in/parts.exr --crop:allsubimages=0 20x20+10+10 -o out.exr
crop-all-modifier: in/parts.exr --crop:allsubimages=1 20x20+10+10 -o out.exr
crop-deep: in/deep.exr --crop 10x8+3+2 -o out.exr
crop-no-change: in/rgb.exr --crop 64x48+0+0 -o out.exr
crop-then-resize: in/rgb.exr --crop 10x10+5+5 --resize 32x24 -o out.exr
croptofull-inside: in/inside.exr --croptofull -o out.exr
croptofull-overscan: in/overscan.exr --croptofull -o out.exr
croptofull-parts: -a in/parts.exr --croptofull -o out.exr
trim: in/border.exr --trim -o out.exr
trim-nothing: in/rgb.exr --trim -o out.exr
trim-black: --create 32x24 3 --trim -o out.exr
trim-parts: -a in/parts.exr --trim -o out.exr
cut-size-offset: in/rgb.exr --cut 30x20+10+5 -o out.exr
cut-corners: in/inside.exr --cut 10,5,39,24 -o out.exr
cut-size-only: in/overscan.exr --cut 30x20 -o out.exr
cut-parts: -a in/parts.exr --cut 20x20+10+10 -o out.exr
fullsize: in/rgb.exr --fullsize 100x80-5-5 -o out.exr
fullsize-size: in/inside.exr --fullsize 40x30 -o out.exr
fullsize-percent: in/rgb.exr --fullsize 50% -o out.exr
fullsize-offset: in/rgb.exr --fullsize +20+10 -o out.exr
fullsize-parts: -a in/parts.exr --fullsize 80x70 -o out.exr
fullpixels: in/inside.exr --fullpixels -o out.exr
fullpixels-overscan: in/overscan.exr --fullpixels -o out.exr
fullpixels-parts: -a in/pair.exr --fullsize 80x70 --fullpixels -o out.exr
origin: in/rgb.exr --origin +20+10 -o out.exr
origin-negative: in/inside.exr --origin -16-16 -o out.exr
originoffset: in/inside.exr --originoffset +3-4 -o out.exr
originoffset-parts: -a in/pair.exr --originoffset -5+5 -o out.exr
"""

RESAMPLE = """
resize: in/rgb.exr --resize 32x24 -o out.exr
resize-up: in/rgb.exr --resize 100x90 -o out.exr
resize-percent: in/rgb.exr --resize 50% -o out.exr
resize-two-percents: in/rgb.exr --resize 50%x150% -o out.exr
resize-keep-aspect-width: in/rgb.exr --resize 32x0 -o out.exr
resize-keep-aspect-height: in/rgb.exr --resize 0x30 -o out.exr
resize-inside: in/inside.exr --resize 128x96 -o out.exr
resize-overscan: in/overscan.exr --resize 50% -o out.exr
resize-integer: in/u8.tif --resize 30x20 -o out.tif
resize-highlight: in/rgb.exr --mulc 20 --resize:highlightcomp=1 32x24 -o out.exr
resize-highlight-filter: in/rgba.exr --mulc 9 --resize:highlightcomp=1:filter=lanczos3 40x24
    -o out.exr
resize-modifier-unknown: in/rgb.exr --resize:nosuch=1 32x24 -o out.exr
resize-offset: in/rgb.exr --resize 32x24+5+5 -o out.exr
resize-parts: -a in/pair.exr --resize 50% -o out.exr
resize-first-part: in/pair.exr --resize 50% -o out.exr
resize-nan: in/nan.exr --resize 50% -o out.exr
resize-expression: in/wide.exr --resize "{TOP.width*2}x{TOP.height}" -o out.exr
resample: in/rgb.exr --resample 40x30 -o out.exr
resample-nearest: in/rgb.exr --resample:interp=0 100x90 -o out.exr
resample-interp: in/rgb.exr --resample:interp=1 40x30 -o out.exr
resample-percent: in/inside.exr --resample 150% -o out.exr
resample-parts: -a in/pair.exr --resample 50% -o out.exr
fit: in/rgb.exr --fit 40x40 -o out.exr
fit-up: in/small.exr --fit 100x100 -o out.exr
fit-pad: in/rgb.exr --fit:pad=1 40x40 -o out.exr
fit-filter: in/rgb.exr --fit:filter=box 40x20 -o out.exr
fit-width: in/rgb.exr --fit:fillmode=width 40x20 -o out.exr
fit-height: in/rgb.exr --fit:fillmode=height 20x40 -o out.exr
fit-letterbox: in/rgb.exr --fit:fillmode=letterbox:pad=1 20x40 -o out.exr
fit-exact: in/rgb.exr --fit:exact=1 37x29 -o out.exr
fit-exact-pad: in/rgb.exr --fit:exact=1:pad=1 37x29 -o out.exr
fit-highlight: in/rgb.exr --mulc 20 --fit:highlightcomp=1 40x40 -o out.exr
fit-pad-to-jpeg: in/u8.tif --fit:pad=1 40x40 -o out.jpg
fit-overscan: in/overscan.exr --fit 40x40 -o out.exr
fit-no-change: in/rgb.exr --fit 64x48 -o out.exr
fit-parts: -a in/pair.exr --fit 40x40 -o out.exr
pixelaspect: in/wide.exr --pixelaspect 1 -o out.exr
pixelaspect-two: in/rgb.exr --pixelaspect 2.0 -o out.exr
pixelaspect-filter: in/wide.exr --pixelaspect:filter=triangle 1.0 -o out.exr
pixelaspect-half: in/rgb.exr --pixelaspect:highlightcomp=1 0.5 -o out.exr
pixelaspect-all: in/wide.exr --mulc 5 --pixelaspect:filter=box:highlightcomp=1 1.5 -o out.exr
fit-all: in/rgb.exr --mulc 5 --fit:filter=lanczos3:pad=1:exact=1:fillmode=width:highlightcomp=1
    50x50
    -o out.exr
"""

SHRINK = ("box", "gaussian", "blackman-harris", "sinc", "lanczos3", "radial-lanczos3",
          "nuke-lanczos6", "disk")
ENLARGE = ("triangle", "sharp-gaussian", "catmull-rom", "mitchell", "bspline", "cubic", "keys",
           "simon", "rifman")
FILTERS = ["resize-filters-down: " + " ".join(
    f"in/rgb.exr --resize:filter={name} 32x24 -o {name}.exr" for name in SHRINK),
           "resize-filters-up: " + " ".join(
    f"in/small.exr --resize:filter={name} 45x40 -o {name}.exr" for name in ENLARGE)]

ROTATIONS = [f"{command}: in/rgb.exr --{command} -o a.exr in/inside.exr --{command} -o b.exr"
             for command in ("rotate90", "rotate180", "rotate270", "flip", "flop", "transpose")]

TURNS = """
flip-parts: -a in/parts.exr --flip -o out.exr
flop-modifier: in/parts.exr --flop:allsubimages=1 -o out.exr
rotate90-parts: -a in/pair.exr --rotate90 -o out.exr
rotate180-tiff: in/u8.tif --rotate180 -o out.tif
transpose-offset: in/offset.exr --transpose -o out.exr
flip-mips: -a in/mip.exr --flip -o out.exr
reorient: in/photo.jpg --reorient -o out.tif
reorient-each: in/rgb.exr --orientation 8 --reorient -o out.exr
reorient-parts: -a in/pair.exr --orientation 3 --reorient -o out.exr
autoorient: --autoorient in/photo.jpg -o out.tif
autoorient-plain: --autoorient in/u8.tif -o out.tif
cshift: in/rgb.exr --cshift +20-10 -o out.exr
cshift-inside: in/inside.exr --cshift +5+7 -o out.exr
cshift-parts: -a in/pair.exr --cshift -5-7 -o out.exr
rotate: in/rgb.exr --rotate 30 -o out.exr
rotate-filter: in/rgb.exr --rotate:filter=triangle 30 -o out.exr
rotate-center: in/rgb.exr --rotate:center=10,10 -45 -o out.exr
rotate-roi: in/rgb.exr --rotate:recompute_roi=1 30 -o out.exr
rotate-highlight: in/rgb.exr --mulc 9 --rotate:highlightcomp=1 12.5 -o out.exr
rotate-parts: -a in/pair.exr --rotate 30 -o out.exr
rotate-all: in/inside.exr --rotate:filter=box:center=5,40:recompute_roi=1:highlightcomp=1 77
    -o out.exr
warp-all: in/inside.exr --warp:filter=triangle:wrap=mirror:recompute_roi=1:highlightcomp=1
    0.9,0.2,0,-0.2,0.9,0,4,4,1 -o out.exr
warp: in/rgb.exr --warp 0.7,0.5,0,-0.5,0.7,0,10,8,1 -o out.exr
warp-filter: in/rgb.exr --warp:filter=box 1.5,0,0,0,1.5,0,-5,-5,1 -o out.exr
warp-roi: in/rgb.exr --warp:recompute_roi=1 1.5,0,0,0.2,1.5,0,-5,-5,1 -o out.exr
warp-highlight: in/rgb.exr --mulc 9 --warp:highlightcomp=1 1,0.1,0,0,1,0,0,0,1 -o out.exr
warp-wrap: in/rgb.exr --warp:wrap=periodic 0.7,0.5,0,-0.5,0.7,0,10,8,1 -o out.exr
warp-parts: -a in/pair.exr --warp 0.7,0.5,0,-0.5,0.7,0,10,8,1 -o out.exr
st-warp: in/rgb.exr in/st.exr --st_warp -o out.exr
st-warp-filter: in/rgb.exr in/st.exr --st_warp:filter=triangle -o out.exr
st-warp-channels: in/rgb.exr in/st.exr --st_warp:chan_s=1:chan_t=0 -o out.exr
st-warp-flips: in/rgb.exr in/st.exr --st_warp:flip_s=1:flip_t=1 -o out.exr
st-warp-all: in/rgba.exr in/st.exr --st_warp:filter=box:chan_s=1:chan_t=0:flip_s=1:flip_t=0
    -o out.exr
"""

COMPOSITE = """
over: in/rgba.exr in/rgba2.exr --over -o out.exr
over-windows: in/inside_a.exr in/rgba2.exr --over -o out.exr
over-parts: in/rgba.exr in/rgba2.exr --siappend -o two.exr &&
    -a two.exr --mulc 0.5 two.exr --over -o out.exr
over-first-part: in/parts.exr in/parts2.exr --over -o out.exr
over-unpremultiplied: in/straight.png in/rgba2.exr --over -o out.exr
over-late: in/rgba.exr --over in/rgba2.exr -o out.exr
zover: in/depth.exr in/depth2.exr --zover -o out.exr
zover-zero: in/depth.exr --mulc 1,1,1,1,0 in/depth2.exr --zover:zeroisinf=1 -o out.exr
zover-zero-near: in/depth.exr --mulc 1,1,1,1,0 in/depth2.exr --zover:zeroisinf=0 -o out.exr
paste: in/small.exr in/rgb.exr --paste +20+10 -o out.exr
paste-outside: in/small.exr in/rgb.exr --paste -10+40 -o out.exr
paste-auto: in/inside.exr in/rgb.exr --paste auto -o out.exr
paste-dash: in/inside.exr in/rgb2.exr --paste - -o out.exr
paste-merge: in/small.exr in/inside.exr --paste:mergeroi=1 +50+40 -o out.exr
paste-no-merge: in/small.exr in/inside.exr --paste:mergeroi=0 +50+40 -o out.exr
paste-all: in/tiny.exr in/small.exr in/rgb.exr --paste:all=1 +5+5 -o out.exr
paste-all-merge: in/small.exr in/inside.exr in/tiny.exr --paste:all=1:mergeroi=1 - -o out.exr
paste-rgb-on-rgba: in/small.exr in/rgba.exr --paste +3+3 -o out.exr
pastemeta: in/meta.exr in/rgb.exr --pastemeta -o out.exr
pastemeta-late: in/meta.exr --pastemeta in/u8.tif -o out.tif
mosaic: in/rgb.exr in/rgb2.exr in/rgb3.exr in/small.exr --mosaic 2x2 -o out.exr
mosaic-pad: in/rgb.exr in/rgb2.exr --mosaic:pad=4 2x1 -o out.exr
mosaic-fit: in/rgb.exr in/wide.exr in/small.exr --mosaic:fit=40x30:pad=2 3x1 -o out.exr
mosaic-short: in/rgb.exr in/rgb2.exr in/rgb3.exr --mosaic 2x2 -o out.exr
mosaic-more: in/rgb.exr in/rgb2.exr in/rgb3.exr --mosaic 1x2 -o out.exr
mosaic-formats: in/u8.tif in/rgba.exr --mosaic 2x1 -o out.exr
mosaic-fit-only: in/small.exr in/wide.exr --mosaic:fit=20x20 1x2 -o out.exr
fillholes: in/holes.exr --fillholes -o out.exr
fillholes-chain: in/holes.exr --fillholes --premult --ch R,G,B -o out.exr
"""

SECOND_PART = {"within": 1e9,
               "reason": "oiiotool writes the pixels of the first subimage in the second, too"}

CASES = [*table("window", WINDOWS, originoffset_parts=SECOND_PART), *table("resample", "\n".join(FILTERS) + RESAMPLE),
         *table("turn", "\n".join(ROTATIONS) + TURNS), *table("composite", COMPOSITE)]
