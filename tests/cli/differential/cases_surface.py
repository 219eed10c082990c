# SPDX-License-Identifier: BSD-3-Clause
"""What oiiotool takes without saying so: hidden commands, modifiers that no help lists, and what
comes of values that are left out, of files without alpha, of deep files."""

from case import table
from conftest import FONT

HIDDEN = """
nostderr!: --nostderr nosuch.exr -o out.exr
nostderr-warning: --nostderr in/parts.exr --ch R,nosuch -o out.exr
nostderr-late!: in/rgb.exr --nostderr --resize bogus -o out.exr
auto-orient: --auto-orient in/photo.jpg -o out.tif
auto-orient-missing!: --auto-orient nosuch.exr -o out.exr
cadd: in/rgb.exr --cadd 0.1,0.2 -o out.exr
csub: in/rgb.exr --csub 0.25 -o out.exr
cmul: in/rgb.exr --cmul 0.5,1,2 -o out.exr
cpow: in/rgb.exr --cpow 0.45,0.45,0.45 -o out.exr
flipflop: in/rgb.exr --flipflop -o out.exr
force-tiles: in/rgb.exr --force-tiles -o out.exr --force-tiles -o out.tif
force-tiles-tile: in/rgb.exr --force-tiles --tile 16 32 -o out.tif
force-tiles-missing!: --force-tiles nosuch.exr -o out.exr
noclobber: in/rgb.exr --noclobber -o out.exr --mulc 0.5 -o out.exr
rot180: in/photo.jpg --rot180 -o out.tif
rotcw: in/photo.jpg --rotcw -o out.tif
rotccw: in/photo.jpg --rotccw -o out.tif
quality-hidden: in/rgb3.exr --quality 40 -d uint8 -o out.jpg
"""

LANGUAGE = """
var: --set x 3 --echo "{var(x)} {var(x)+1} {var('x')}" --set y x --echo "{var(y)}"
var-unset: --echo "[{var(nosuch)}]"
var-colon: --set a:b 7 --echo "{var(a:b)}"
bracket-missing: in/rgb.exr --echo "[{TOP[nosuch]}] [{TOP['nosuch']}]"
set-timecode: --set:type=timecode tc 01:02:03:04 --echo "{tc}"
set-rational: --set:type=rational r 1/50 --echo "{r}"
set-array: --set:type=float[3] a 1,2,3 --echo "{a}" --set:type=int[4] b 1,2,3,4 --echo "{b}"
set-point: --set:type=point p 1,2,3 --echo "{p}" --set:type=double d 0.1 --echo "{d}"
subimages-all: -a in/parts.exr --mulc:subimages=all 0.5 -o a.exr --mulc:subimages=ALL,-0 0.5 -o b.exr
subimages-all-first: in/parts.exr --mulc:subimages=all 0.5 -o a.exr --mulc:subimages=-all 2 -o b.exr
subimages-both: -a in/parts.exr --mulc:subimages=-0,1 0 -o a.exr --mulc:subimages=0,-2,1 0 -o b.exr
subimages-unknown: in/parts.exr --mulc:subimages=nosuch 0 -o a.exr
subimages-beyond: in/parts.exr --mulc:subimages=7 0 -o a.exr
letters: in/rgba.exr --ch RGB -o a.exr --ch B,G,R in/rgba.exr --ch RGBA -o b.exr
range-output: in/seq.1-3#.exr -o out.11-13#.exr
range-output-short!: in/seq.#.exr -o out.1-3#.exr
unknown-modifier: in/rgb.exr --resize:bogus=1:filter=box 30x20 -o out.exr
malformed-modifier: in/rgb.exr --resize:1=2:: 30x20 -o out.exr
"""

WRITE = """
type: in/rgb.exr -o:type=uint8 a.tif -o:datatype=half:type=uint8 b.tif
type-bits: in/rgb.exr -o:type=uint16:bits=10 a.tif -o:type=uint10 b.tif -o:type=bogus c.tif
small-types: in/rgb3.exr -d uint1 -o a.tif -d uint2 -o b.tif -d uint4 -o c.tif -d uint6 -o d.tif
autocc-jpeg: --autocc in/rgb.exr -d uint8 -o a.jpeg -o b.JPG -o c.webp -o d.gif
autocc-rec709: --autocc in/rgb.exr -d uint8 -o a.ppm -o b.pnm -o c.pgm -o d.PPM
autocc-none: --autocc in/rgb.exr -d uint8 -o a.png -o b.tif -d half -o c.exr
autocc-unpremult: --autocc:unpremult=1 in/rgba.exr -o a.ppm -o b.png -o c.webp -o d.bmp
    -o:autocc=1:unpremult=1 e.ppm
autocc-parts: -a --autocc in/parts.exr -o a.jpg
otex-type: in/rgb.exr -otex:type=uint8 a.tx -otex:datatype=half b.exr
otex-all: in/rgb.exr in/rgb2.exr -otex:all=1 out%d.tx
otex-autocc: --autocc in/rgb.exr -otex:autocc=1 out_srgb.tx -otex:autocc=0 b_srgb.tx
otex-prman-options: in/rgb.exr -otex:prman_options=1 a.tx -otex:prman_metadata=1 b.tx
otex-oiio-options: in/rgb.exr -otex:oiio_options=1 a.tx
otex-filtername: in/rgb.exr -otex:filtername=lanczos3 a.tx
otex-hicomp: in/rgb.exr --mulc 9 -otex:hicomp=1:filtername=lanczos3 a.tx
otex-cdf: in/rgb3.exr -otex:cdf=1 a.tx -otex:cdf=1:cdfbits=6:cdfsigma=0.25 b.tx
otex-average: in/rgb.exr -otex:compute_average=0 a.tx
otex-handed: in/rgb3.exr -otex:handed=left a.tx
otex-tile: in/rgb.exr --tile 16 32 -otex a.tx
otex-layout: in/rgb3.exr -d uint8 --compression lzw --planarconfig separate -otex a.tx
otex-no-clobber: in/rgb.exr -otex a.tx --no-clobber --mulc 0.5 -otex a.tx
oenv-rest: in/rgb.exr --resize 64x32
    -oenv:filtername=box:hicomp=1:prman_options=0:prman_metadata=1:oiio_options=0:handed=right:cdf=0:cdfbits=8:cdfsigma=0.2:compute_average=0
    out.exr
obump-rest: in/grey.exr
    -obump:filtername=box:hicomp=0:prman_options=0:prman_metadata=1:oiio_options=0:handed=right:cdf=0:cdfbits=8:cdfsigma=0.2:compute_average=0
    out.exr
oenv-output: in/rgb.exr --resize 64x32
    -oenv:all=1:type=half:datatype=half:bits=16:autocc=0:autocrop=1:autotrim=0:contig=1:separate=0:dither=0:scanline=0:tile=16x16:compression=zip
    out%d.exr
obump-output: in/grey.exr
    -obump:all=1:type=half:datatype=half:bits=16:autocc=0:autocrop=1:autotrim=0:contig=1:separate=0:dither=0:scanline=0:tile=16x16:compression=zip
    out%d.exr
otex-output: in/rgb.exr
    -otex:bits=16:autocrop=1:autotrim=0:contig=1:separate=0:dither=0:scanline=0:tile=16x16:compression=zip
    out.exr
"""

COLOUR = """
ccmatrix-invert: in/rgb.exr --ccmatrix:invert=1 0.5,0.1,0,0,0.8,0,0.1,0,0.9 -o out.exr
ccmatrix-inverse: in/rgba.exr --ccmatrix:inverse=1:transpose=1 0.5,0.1,0,0,0.8,0,0.1,0,0.9 -o out.exr
ccmatrix-singular: in/rgb.exr --ccmatrix:invert=1 1,0,0,0,0,0,0,0,0 -o out.exr
clamp-blank: in/rgb.exr --clamp:max=,,1 -o a.exr --clamp:min=0.5,,:max=,0.8 -o b.exr
blank-constant: in/rgb.exr --mulc ,2,0.5 -o a.exr --addc 1,,2 -o b.exr
box-alpha: in/rgb.exr --box:color=0,0,0,0.6:fill=1 5,5,30,30 -o a.exr --box:color=0.5 2,2,50,40 -o b.exr
box-alpha-grey: in/grey.exr --box:color=1,0.25:fill=1 5,5,30,30 -o a.exr
line-alpha: in/rgb.exr --line:color=1,0,0,0.5 1,1,30,20,40,3 -o a.exr --line:color=0.5 3,40,60,1 -o b.exr
text-alpha: in/rgb.exr --text:color=1,0,0,0.5:size=20:x=5:y=30:font=FONT Ab -o a.exr
text-alpha-one: in/rgb.exr --text:color=0.5:size=20:x=5:y=30:font=FONT Ab -o a.exr
point-alpha: in/rgb.exr --point:color=1,0,0,0.5 5,5,6,6 -o a.exr --point:color=0.5 9,9 -o b.exr
fill-alpha: in/rgb.exr --fill:color=1,0,0,0.5 20x20+3+3 -o a.exr
fill-ramp-alpha: in/rgb.exr --fill:top=1,0,0,0.5:bottom=0,1,0,0.2 20x20+3+3 -o a.exr
pattern-alpha: --pattern constant:color=1,0,0,0.5 32x32 3 -o a.exr
    --pattern checker:color1=1,0,0,0.5:color2=0,1,0,0.2 32x32 3 -o b.exr
    --pattern fill:top=1,0,0,0.5:bottom=0,0,1,0.1 32x32 3 -o c.exr
"""

PRINT = """
colorcount-colon: in/rgb3.exr --colorcount 1,1,1:0.5,0.5,0.5
colorcount-semicolon: in/rgb3.exr --colorcount "1,1,1;0.5,0.5,0.5"
printstats-window: in/rgb.exr --printstats:window=20x20+5+5
printstats-corners: in/rgb.exr --printstats:window=10,10,12,12
printstats-scaled: in/rgb.exr --printstats:window=50%
printstats-outside: in/rgb.exr --printstats:window=5x5-20-20
printstats-bad!: in/rgb.exr --printstats:window=bad
printstats-parts: in/parts.exr --printstats:window=5x5+2+2:allsubimages=1
printstats-deep: in/deep.exr --printstats:window=5x5+2+2
printinfo-stats: in/u8.tif --printinfo:stats=1:verbose=0
printinfo-native: in/u8.tif --printinfo:native=1:stats=1
printinfo-deep: in/deep.exr --printinfo:native=1:stats=1
printinfo-mips: -a in/mip.exr --printinfo:native=1:stats=1:verbose=0
hash-deep: --hash in/deep.exr
hash-mixed: --hash in/layers.exr
hash-parts: -a --hash in/parts.exr
hash-integer: --hash in/u8.tif in/photo.jpg
hash-tiled: --hash in/tiled.exr in/mip.exr
"""

# oiiotool warns of the channels of all subimages, of which JPEG holds one.
ONE_IMAGE = {"without": "^PROGRAM WARNING", "reason": "subimages that are not written are not looked "
             "at, and the warning says how many they are"}

CASES = [*table("hidden", HIDDEN), *table("taken", LANGUAGE), *table("written", WRITE, autocc_parts=ONE_IMAGE),
         *table("coloured", COLOUR.replace("FONT", FONT)), *table("printed", PRINT)]
