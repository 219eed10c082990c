# SPDX-License-Identifier: BSD-3-Clause
"""Reading and writing: formats, data types, options of outputs and inputs."""

from case import table

TYPES = [f"type-{name}: in/unit.exr " + " ".join(f"-d {kind} -o {kind}.{name}" for kind in kinds)
         for name, kinds in (
             ("tif", ("uint8", "uint16", "int8", "int16", "uint32", "half", "float", "double")),
             ("exr", ("half", "float", "uint32", "uint8")), ("dpx", ("uint8", "uint10", "uint12")),
             ("png", ("uint8", "uint16", "half")), ("jpg", ("uint8", "uint16")))]
FORMATS = ["formats: in/unit.exr " + " ".join(
    f"-o out.{name}" for name in ("bmp", "tga", "hdr", "gif", "ppm", "fits", "rla", "iff", "webp"))]
# Data and display windows left of and above 0, which few formats can hold.
PLACES = {"left": "-20-10 100x100+0+0", "all-left": "-20+5 70x70-30+5", "same": "-5-5 64x64-5-5",
          "right": "+3+3 64x64+3+3", "outside": "-70-70 64x64+0+0", "around": "+0+0 100x100-5-5",
          "within": "+0+0 32x32+10+10"}
WINDOWS = [f"window-{name}-{kind}: --pattern checker 64x64 3 --origin {place.split()[0]} "
           f"--fullsize {place.split()[1]} {command} out.{kind}"
           for name, place in PLACES.items()
           for kind, command in (("dpx", "-d uint8 -o"), ("tif", "-d uint8 -o"), ("png", "-o"),
                                 ("jpg", "-o"), ("rla", "-d uint8 -o"), ("tx", "-otex"))]

WRITE = """
copy: in/rgb.exr -o out.exr
formats-sgi: in/unit.exr --caption "described, for else it writes what lies in memory" -o out.sgi
copy-meta: in/meta.exr -o out.exr
type-of-channels: in/layers.exr -d float -d R=half -d G=half -o out.exr
type-one-channel: in/rgba.exr -d half -d A=float -o out.exr
type-kept: in/u16.tif --mulc 0.5 -o out.tif
type-of-first: in/u8.tif in/float.exr --add -o out.exr
type-changed-later: in/rgb.exr -d float -o a.exr -d half -o b.exr
datatype: in/rgb3.exr -o:datatype=uint16 out.tif
bits: in/rgb3.exr -d uint16 -o:bits=10 out.dpx
datatype-half: in/float.exr -o:datatype=half out.exr
compression: in/rgb.exr --compression piz -o out.exr
compression-quality: in/rgb.exr --compression dwaa:200 -o out.exr
compression-zips: in/rgb.exr --compression zips -o out.exr
compression-jpeg: in/u8.tif --compression jpeg:40 -o out.jpg
compression-tiff: in/u8.tif --compression lzw -o out.tif
compression-modifier: in/rgb.exr -o:compression=rle out.exr
compression-kept: in/piz.exr --mulc 0.5 -o out.exr
compression-dwaa-kept: in/dwaa.exr -o out.exr
quality: in/u8.tif --quality 30 -o out.jpg
quality-high: in/photo.jpg --quality 98 -o out.jpg
tile: in/rgb.exr --tile 16 16 -o out.exr
tile-modifier: in/rgb.exr -o:tile=32x32 out.exr
tile-tiff: in/u8.tif --tile 32 16 -o out.tif
scanline: in/tiled.exr --scanline -o out.exr
scanline-modifier: in/tiled.exr -o:scanline=1 out.exr
tile-then-scanline: in/rgb.exr --tile 16 16 -o a.exr --scanline -o b.exr
planarconfig: in/u8.tif --planarconfig separate -o out.tif
planarconfig-contig: in/u8.tif --planarconfig contig -o out.tif
separate: in/u8.tif -o:separate=1 out.tif
contig: in/u8.tif -o:contig=1 out.tif
dither: in/unit.exr --dither -d uint8 -o out.tif
dither-seed: in/unit.exr --dither -d uint8 -o out.png
dither-modifier: in/unit.exr -o:dither=1:datatype=uint8 out.png
noautocrop: in/inside.exr --noautocrop -o out.png
autocrop: in/inside.exr -o out.png
autocrop-modifier: in/overscan.exr -o:autocrop=0 out.png
autocrop-tiff: in/inside.exr -d uint16 -o out.tif
autotrim: in/border.exr --autotrim -o out.exr
output-all-options: in/inside.exr
    -o:datatype=half:tile=16x16:autocrop=1:autotrim=1:autocc=0:compression=zip out.exr
output-tiff-options: in/unit.exr -o:scanline=1:separate=1:bits=8:dither=1 out.tif
output-contig: in/u8.tif --planarconfig separate -o:contig=1:unpremult=0 out.tif
otex-options-all: in/u8.tif -otex:swrap=black:twrap=periodic:nomipmap=0:resize=0:sharpen=0.2 out.tx
otex-detect: --pattern constant:color=.5,.5,.5,1 64x64 4
    -otex:constant_color_detect=1:monochrome_detect=1:opaque_detect=1:unpremult=0:updatemode=0
    out.exr
otex-highlight: in/rgb.exr --mulc 9 -otex:wrap=clamp:filter=box:highlightcomp=1 out.exr
obump-auto: in/rgb3.exr -obump:bumpformat=auto:uvslopes_scale=0.5 out.exr
autotrim-modifier: in/border.exr -o:autotrim=1 out.exr
fileformatname: in/rgb.exr -o:fileformatname=tiff out.image
fileformatname-exr: in/u8.tif -o:fileformatname=openexr out.dat
unpremult-output: in/rgba.exr -o:unpremult=1 out.tif
output-all: in/rgb.exr in/rgb2.exr in/grey.exr -o:all=1 out%d.exr
output-all-padded: in/rgb.exr in/rgb2.exr -o:all=5 out.%04d.exr
type-documented!: in/unit.exr -d sint8 -o out.tif
otex: in/rgb.exr -otex out.exr
otex-tiff: in/u8.tif -otex out.tx
otex-tiff-overscan: in/rgb.exr --fullsize 20x10+5+5 -otex out.tx
otex-tiff-inside: in/rgb.exr --fullsize 100x80+0+0 --origin +10+5 -otex out.tif
otex-tiff-below-zero: in/rgb.exr --fullsize 30x20-3-3 -otex out.tif
otex-exr-overscan: in/rgb.exr --fullsize 20x10+5+5 -otex out.exr
oenv-tiff-overscan: in/rgb.exr --fullsize 20x10+5+5 -oenv out.tx
otex-options: in/u8.tif -otex:wrap=periodic:filter=lanczos3 out.tx
otex-no-mips: in/u8.tif -otex:nomipmap=1 out.tx
otex-resize: in/u8.tif -otex:resize=1:swrap=clamp:twrap=mirror out.tx
otex-sharpen: in/rgb.exr -otex:sharpen=0.5:highlightcomp=1 out.exr
otex-opaque: in/rgb.exr --ch R,G,B,A=1 -otex:opaque_detect=1 out.exr
otex-half: in/float.exr -d half -otex:unpremult=1 out.exr
otex-constant: --pattern constant:color=.5,.5,.5 64x64 3 -otex:constant_color_detect=1 out.exr
otex-mono: in/grey.tif --ch Y,Y,Y --chnames R,G,B -otex:monochrome_detect=1:updatemode=0 out.tx
otex-colors!: in/u8.tif -otex:incolorspace=sRGB:outcolorspace=linear out.exr
otex-prman: in/rgb.exr -otex:prman=1 out.exr
otex-oiio: in/rgb.exr -otex:oiio=1:fovcot=1.5:fileformatname=tiff out.exr
otex-bump-keys: in/rgb.exr -otex:bumpformat=height:uvslopes_scale=2 out.exr
oenv-wrap: in/rgb.exr --resize 64x32 -oenv:wrap=clamp:swrap=periodic:twrap=clamp:filter=box out.exr
oenv-sizes: in/rgb.exr --resize 60x30 -oenv:resize=1:nomipmap=1:updatemode=0:sharpen=0.3 out.exr
oenv-detect: in/rgba.exr --resize 64x32
    -oenv:monochrome_detect=1:opaque_detect=1:constant_color_detect=1:unpremult=1:highlightcomp=1
    out.exr
oenv-colors!: in/u8.tif --resize 64x32 -oenv:incolorspace=sRGB:outcolorspace=linear out.exr
oenv-kinds: in/rgb.exr --resize 64x32
    -oenv:prman=1:oiio=0:fovcot=2:fileformatname=tiff:bumpformat=auto:uvslopes_scale=1 out.exr
obump-wrap: in/grey.exr -obump:wrap=clamp:swrap=mirror:twrap=black:filter=box out.exr
obump-sizes: in/grey.exr -obump:resize=1:nomipmap=1:updatemode=0:sharpen=0.3 out.exr
obump-detect: in/grey.exr
    -obump:monochrome_detect=1:opaque_detect=1:constant_color_detect=1:unpremult=1:highlightcomp=1
    out.exr
obump-colors!: in/grey.tif -obump:incolorspace=sRGB:outcolorspace=linear out.exr
obump-kinds: in/grey.exr -obump:prman=1:oiio=0:fovcot=2:fileformatname=tiff out.exr
oenv: --pattern fill:top=1,0,0:bottom=0,0,1 64x32 3 -oenv out.exr
oenv-half: in/rgb.exr --resize 64x32 -d half -oenv out.exr
obump: in/grey.exr -obump out.exr
obump-height: in/grey.exr -obump:bumpformat=height out.exr
obump-normal: in/rgb3.exr -obump:bumpformat=normal out.exr
obump-scale: in/grey.exr -obump:bumpformat=height:uvslopes_scale=2 out.exr
no-save: -n in/rgb.exr --printinfo -o out.exr
no-clobber: in/rgb.exr -o out.exr && --no-clobber in/rgb2.exr -o out.exr
clobber: in/rgb.exr -o out.exr && in/rgb2.exr -o out.exr
update-older: in/rgb.exr -o out.exr && -u in/rgb2.exr -o out.exr
update-new: -u in/rgb2.exr -o out.exr
adjust-time: --adjust-time in/meta.exr -o out.exr
threads: --threads 1 in/rgb.exr --resize 50% -o out.exr
threads-two: --threads 2 in/rgb.exr --blur 5x5 -o out.exr
cache: --cache 64 in/rgb.exr --mulc 2 -o out.exr
cache-small: --cache 1 in/tiled.exr in/rgb.exr --add -o out.exr
autotile: --autotile 16 in/rgb.exr --mulc 2 -o out.exr
autotile-parts: --autotile 32 -a in/pair.exr -o out.exr
native: --native in/u8.tif --rotate90 -o out.tif
native-half: --native in/rgb.exr --mulc 1.1 -o out.exr
oiioattrib: --oiioattrib exr_threads 1 in/rgb.exr -o out.exr
oiioattrib-string: --oiioattrib:type=string plugin_searchpath in in/rgb.exr -o out.exr
oiioattrib-type: --oiioattrib:type=int imagebuf:use_imagecache 0 in/rgb.exr -o out.exr
metamerge: --metamerge in/meta.exr in/u8.tif --add -o out.exr
metamerge-over: --metamerge in/rgba.exr in/rgba2.exr --attrib owner me --over -o out.exr
"""

READ = """
input: -i in/rgb.exr -o out.exr
input-channels: -i:ch=R,G in/rgba.exr -o out.exr
input-channels-order: -i:ch=B,G,R in/rgb.exr -o out.exr
input-type: -i:type=half in/float.exr -o out.exr
input-type-integer: -i:type=uint8 in/u16.tif -o out.tif
input-info: -i:info=1 in/rgb.exr -o out.exr
input-info-verbose: -i:info=2 in/meta.exr -o out.exr
input-info-xml: -i:info=2:infoformat=xml in/grey.exr -o out.exr
input-now: -i:now=1 in/rgb.exr -o out.exr
input-now-type: -i:now=1:type=half in/float.exr -o out.exr
input-unpremult: -i:autocc=1:unpremult=1 in/rgba.exr -o out.exr
input-all: -i:autocc=1:ch=R,G,B,A:info=1:infoformat=text:now=1:type=float:unpremult=1
    in/straight.png
    -o out.exr
iconfig-types: --iconfig:type=string a b --iconfig:type=float c 1.5 -i in/rgb.exr -o out.exr
input-autocc: -i:autocc=1 in/u8.png -o out.exr
iconfig: --iconfig oiio:UnassociatedAlpha 1 -i in/straight.png -o out.exr
iconfig-type: --iconfig:type=int oiio:UnassociatedAlpha 1 -i in/straight.png -o out.tif
autopremult: in/straight.png -o out.exr
no-autopremult: --no-autopremult in/straight.png -o out.exr
autopremult-again: --no-autopremult --autopremult in/straight.png -o out.exr
png-to-jpeg: in/u8.png -o out.jpg
alpha-to-jpeg: in/straight.png -o out.jpg
jpeg-to-exr: in/photo.jpg -o out.exr
grey-to-png: in/grey.exr -d uint8 -o out.png
dpx: in/scan.dpx -d half -o out.exr
tiff-float: in/f32.tif --mulc 0.5 -o out.tif
exr-zip: in/zip.exr -o out.exr
exr-none: in/none.exr --rotate180 -o out.exr
exr-rle: in/rle.exr --compression none -o out.exr
in-place: in/rgb.exr -o out.exr && out.exr --mulc 0.5 -o out.exr
missing-black!: --missingfile black in/rgb.exr nosuch.exr --add -o out.exr
missing-checker!: --missingfile checker in/rgb.exr nosuch.exr --add -o out.exr
missing-error: --missingfile error in/rgb.exr --mulc 2 -o out.exr
"""

CASES = [*table("write", "\n".join(TYPES + FORMATS + WINDOWS) + WRITE), *table("read", READ)]
