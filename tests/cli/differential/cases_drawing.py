# SPDX-License-Identifier: BSD-3-Clause
"""Created images, drawing, filters, Fourier transforms."""

from case import table

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"

CREATE = """
create: --create 32x24 3 -o out.exr
create-offset: --create 32x24+5-7 4 -d half -o out.exr
create-channels: --create 32x24 7 -o out.exr
create-integer: --create 32x24 1 -d uint8 -o out.tif
create-type: --create:type=half 32x24 3 -o out.exr
create-type-integer: --create:type=uint8 32x24+2+2 3 -o out.tif
pattern-type: --pattern constant:color=.1,.2,.3:type=uint16 16x16 3 -o out.tif
pattern-type-half: --pattern checker:type=half:width=4:height=2 16x16 3 -o out.exr
pattern-noise-options: --pattern
    noise:type=gaussian:mean=1:stddev=.5:mono=1:seed=4 16x16 3 -o out.exr
pattern-noise-salt-options: --pattern
    noise:type=salt:value=2:portion=.4:seed=9:nchannels=1 16x16 3 -o out.exr
pattern-noise-range: --pattern noise:type=uniform:min=-1:max=1 16x16 3 -o out.exr
pattern-checker-depth: --pattern checker:depth=2:color1=1,0,0:color2=0,0,1 16x16 3 -o out.exr
pattern-fill-top: --pattern fill:top=1,1,1 16x16 3 -o out.exr
pattern-black: --pattern black 32x24 3 -o out.exr
pattern-constant: --pattern constant:color=0.1,0.5,0.9 32x24 3 -o out.exr
pattern-constant-offset: --pattern constant:color=0.1,0.5,0.9,1 32x24+4+4 4 -d half -o out.exr
pattern-fill-vertical: --pattern fill:top=0.1,0.2,0.3:bottom=1,0.5,0.2 32x24 3 -o out.exr
pattern-fill-horizontal: --pattern fill:left=0.1,0.2,0.3:right=1,0.5,0.2 32x24 3 -o out.exr
pattern-fill-corners: --pattern
    fill:topleft=.1,.1,.1:topright=1,0,0:bottomleft=0,1,0:bottomright=0,0,1 32x24 3 -o out.exr
pattern-fill-color: --pattern fill:color=0.3,0.4,0.5 32x24 3 -o out.exr
pattern-checker: --pattern checker 32x24 3 -o out.exr
pattern-checker-size: --pattern checker:width=4:height=6 32x24 3 -o out.exr
pattern-checker-colors: --pattern checker:color1=0.1,0.2,0.3:color2=0.9,0.8,0.7 32x24 3 -o out.exr
pattern-noise: --pattern noise 32x24 3 -o out.exr
pattern-noise-uniform: --pattern noise:type=uniform:min=1:max=2:mono=1 32x24 3 -o out.exr
pattern-noise-gaussian: --pattern noise:type=gaussian:mean=0.5:stddev=0.2:seed=5 32x24 3 -o out.exr
pattern-noise-salt: --pattern noise:type=salt:value=1:portion=0.2 32x24 3 -o out.exr
pattern-noise-blue: --pattern noise:type=blue 32x24 3 -o out.exr
kernel-gaussian: --kernel gaussian 5x5 -o out.exr
kernel-box: --kernel box 3x3 -o out.exr
kernel-laplacian: --kernel laplacian 3x3 -o out.exr
"""

DRAW = """
line: in/rgb.exr --line 2,3,40,30 -o out.exr
line-color: in/rgb.exr --line:color=1,0,0 2,3,40,30,60,5 -o out.exr
line-alpha: in/rgba.exr --line:color=0,0.5,0,0.5 2,3,40,30 -o out.exr
line-parts: -a in/pair.exr --line:color=1,1,0 2,3,40,30 -o out.exr
point: in/rgb.exr --point 2,3,40,30 -o out.exr
point-color: in/rgb.exr --point:color=0,1,0 2,3,40,30,63,47 -o out.exr
box: in/rgb.exr --box 5,6,50,40 -o out.exr
box-color: in/rgb.exr --box:color=0,1,1 5,6,50,40 -o out.exr
box-fill: in/rgb.exr --box:color=0,1,1:fill=1 5,6,50,40 -o out.exr
box-alpha: in/rgba.exr --box:color=0,0.25,0.25,0.5:fill=1 5,6,50,40 -o out.exr
fill: in/rgb.exr --fill:color=0.5,0.1,0.2 30x20+10+10 -o out.exr
fill-default: in/rgb.exr --fill 30x20+10+10 -o out.exr
fill-gradient: in/rgb.exr --fill:top=1,0,0:bottom=0,0,1 64x48 -o out.exr
fill-left-right: in/rgb.exr --fill:left=1,0,0:right=0,0,1 40x30+5+5 -o out.exr
fill-corners: in/rgb.exr
    --fill:topleft=1,0,0:topright=0,1,0:bottomleft=0,0,1:bottomright=1,1,1 64x48 -o out.exr
fill-corners-geometry: in/rgb.exr --fill:color=1,1,1 5,6,20,21 -o out.exr
fill-corners-small: in/rgb.exr
    --fill:topleft=0,0,0:topright=0,1,1:bottomleft=1,0,1:bottomright=.1,.2,.3 20x10+4+4 -o out.exr
fill-top-bottom-alpha: in/rgba.exr --fill:top=1,0,0,.5:bottom=0,0,1,1 32x24 -o out.exr
fill-left-right-alpha: in/rgba.exr --fill:left=1,0,0,.5:right=0,0,1,1 32x24 -o out.exr
point-alpha: in/rgba.exr --point:color=0,.5,0,.5 2,3 -o out.exr
box-fill-off: in/rgb.exr --box:color=0,1,1:fill=0 5,6,50,40 -o out.exr
fill-parts: -a in/pair.exr --fill:color=0.5,0.1,0.2 10x10+4+4 -o out.exr
"""

TEXT = f"""
text: in/rgb.exr --text:font={FONT}:size=12 Slate -o out.exr
text-place: in/rgb.exr --text:x=5:y=40:size=14:font={FONT} Abc -o out.exr
text-color: in/rgb.exr --text:font={FONT}:size=12:color=1,0.5,0 Slate -o out.exr
text-center: in/rgb.exr --text:font={FONT}:size=12:xalign=center:yalign=center Slate -o out.exr
text-right-top: in/rgb.exr
    --text:font={FONT}:size=12:x=60:y=2:xalign=right:yalign=top Slate -o out.exr
text-left-bottom: in/rgb.exr
    --text:font={FONT}:size=12:x=2:y=46:xalign=left:yalign=bottom Slate -o out.exr
text-baseline: in/rgb.exr --text:font={FONT}:size=12:x=2:y=40:yalign=baseline Slate -o out.exr
text-shadow: in/rgb.exr --text:font={FONT}:size=14:shadow=3 Slate -o out.exr
text-no-shadow: in/rgb.exr --text:font={FONT}:size=14:shadow=0:x=3:y=20 Slate -o out.exr
text-alpha: in/rgba.exr --text:font={FONT}:size=14:color=1,1,1,0.5 Slate -o out.exr
text-colon: in/rgb.exr --text:font="{FONT}":size=10 "take: 2" -o out.exr
text-expression: in/rgb.exr --text:font={FONT}:size=10 "{{TOP.width}} wide" -o out.exr
text-lines: in/rgb.exr --text:font={FONT}:size=10:x=2:y=12 "one\\ntwo" -o out.exr
text-parts: -a in/pair.exr --text:font={FONT}:size=12 both -o out.exr
"""

FILTERS = """
blur: in/rgb.exr --blur 5x5 -o out.exr
blur-kernel: in/rgb.exr --blur:kernel=box 7x3 -o out.exr
blur-parts: -a in/pair.exr --blur 3x3 -o out.exr
blur-inside: in/inside.exr --blur 5x5 -o out.exr
median: in/rgb.exr --median 3x3 -o out.exr
median-wide: in/rgb.exr --median 5x1 -o out.exr
dilate: in/rgb.exr --dilate 3x3 -o out.exr
dilate-parts: -a in/pair.exr --dilate 5x3 -o out.exr
erode: in/rgb.exr --erode 3x3 -o out.exr
erode-inside: in/inside.exr --erode 5x5 -o out.exr
open-close: in/rgb.exr --dilate 3x3 --erode 3x3 -o out.exr
unsharp: in/rgb.exr --unsharp -o out.exr
unsharp-kernel: in/rgb.exr --unsharp:kernel=box:width=5 -o out.exr
unsharp-contrast: in/rgb.exr --unsharp:contrast=1.5:threshold=0.05 -o out.exr
unsharp-median: in/rgb.exr --unsharp:kernel=median -o out.exr
unsharp-all: in/rgb.exr --unsharp:kernel=gaussian:width=7:contrast=0.5:threshold=0.2 -o out.exr
unsharp-parts: -a in/pair.exr --unsharp:width=3 -o out.exr
laplacian: in/rgb.exr --laplacian -o out.exr
laplacian-parts: -a in/pair.exr --laplacian -o out.exr
convolve: in/rgb.exr --kernel gaussian 5x5 --convolve -o out.exr
convolve-binomial: in/rgb.exr --kernel binomial 3x3 --convolve -o out.exr
convolve-parts: -a in/pair.exr --kernel gaussian 3x3 --convolve -o out.exr
fft: in/rgb.exr --fft -o out.exr
fft-there-and-back: in/grey.exr --fft --ifft -o out.exr
ifft: in/two.exr --ifft -o out.exr
polar: in/two.exr --polar -o out.exr
fft-polar: in/rgb.exr --ch G --fft --polar -o out.exr
unpolar: in/two.exr --unpolar -o out.exr
polar-there-and-back: in/two.exr --polar --unpolar -o out.exr
"""

CASES = [*table("create", CREATE), *table("draw", DRAW), *table("text", TEXT),
         *table("filter", FILTERS)]
