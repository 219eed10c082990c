# SPDX-License-Identifier: BSD-3-Clause
"""What is printed: information, statistics, comparisons; and metadata."""

from case import table

PRINT = """
echo: --echo hello --echo "two words"
echo-newline: --echo:newline=0 one --echo two
echo-newlines: --echo:newline=2 one --echo:newline=1 two
info: --info in/rgb.exr in/u8.tif
info-verbose: --info -v in/meta.exr in/photo.jpg
info-layers: --info -v in/layers.exr
info-parts: --info -v in/parts.exr
info-all-parts: --info -v -a in/parts.exr
info-mips: --info -v -a in/mip.exr
info-deep: --info -v in/deep.exr
info-windows: --info -v in/inside.exr in/overscan.exr in/offset.exr
info-xml: --info:format=xml:verbose=1 in/meta.exr
info-xml-short: --info:format=xml in/grey.exr
info-verbose-modifier: --info:verbose=1 in/grey.exr
info-hash: --info --hash in/rgb.exr
info-stats: --info --stats in/rgb.exr
verbose: -v in/rgb.exr --mulc 0.5 -o out.exr
verbose-add: -v in/rgb.exr in/rgb2.exr --add -o out.exr
quiet: -q in/rgb.exr --mulc 0.5 -o out.exr
quiet-nothing: -q in/rgb.exr
nothing: in/rgb.exr
nothing-modified: in/rgb.exr --mulc 0.5
output-then-modified: in/rgb.exr -o out.exr --mulc 0.5
stats: --stats in/rgb.exr in/u8.tif
stats-nan: --stats in/nan.exr
stats-deep: --stats in/deep.exr
stats-parts: --stats -a in/pair.exr
stats-constant: --pattern constant:color=.5,.5,.5 8x8 3 --printstats
hash: --hash in/rgb.exr
hash-parts: --hash in/parts.exr
hash-all-parts: -a --hash in/parts.exr
metamatch: --metamatch "comp|shot" --info -v in/meta.exr
metamatch-none: --metamatch nosuch --info -v in/meta.exr
no-metamatch: --no-metamatch "comp|shot|screen" --info -v in/meta.exr
no-metamatch-print: --no-metamatch Date in/rgb.exr --printinfo
dumpdata: --dumpdata in/tiny.exr
dumpdata-array: --dumpdata:C=foo in/tiny.exr
dumpdata-deep: --dumpdata in/deep.exr
dumpdata-not-empty: --dumpdata:empty=0 in/deep.exr
dumpdata-nan: in/nan.exr --cut 3x3+5+5 -o n.exr && --dumpdata n.exr
printinfo: in/meta.exr --printinfo
printinfo-verbose: in/rgb.exr --mulc 2 --printinfo:verbose=1
printinfo-short: in/rgb.exr --printinfo:verbose=0
printinfo-xml: in/rgb.exr --printinfo:format=xml
printinfo-parts: -a in/parts.exr --printinfo
printinfo-created: --create 8x8 3 --printinfo
printstats: in/rgb.exr --printstats
printstats-changed: in/rgb.exr --crop 10x10+3+3 --printstats
printstats-roi: in/rgb.exr --printstats:roi=3,3,12,12
printstats-parts: -a in/pair.exr --printstats
printstats-modifier: in/pair.exr --printstats:allsubimages=1
colorcount: in/rgb3.exr --colorcount "1,1,1;0.5,0.5,0.5"
colorcount-eps: in/rgb3.exr --colorcount:eps=0.2,0.2,0.2 "0.5,0.5,0.5;1,1,1"
colorcount-grey: in/grey.exr --colorcount:eps=0.1 1
rangecheck: in/rgb.exr --rangecheck 0,0,0 0.9,0.8,0.7
rangecheck-one: in/signed.exr --rangecheck 0 1
rangecheck-grey: in/grey.exr --rangecheck 0.5 1
formats: --list-formats
formats-quiet: -q --list-formats
version: --version
version-quiet: -q --version
dumpdata-all: --dumpdata:empty=0:C=deep_array in/tiny.exr
printstats-all: in/pair.exr --printstats:allsubimages=0:roi=1,1,9,9
printinfo-all: in/pair.exr --printinfo:format=text:verbose=1:allsubimages=1
no-error-exit!: --no-error-exit nosuch.exr in/rgb.exr --addc 1 -o out.exr
debug: --debug in/rgb.exr --mulc 0.5 -o out.exr
debug-two: --debug in/rgb.exr in/rgb2.exr --add -o out.exr
runstats: --runstats in/rgb.exr -o out.exr
runstats-two: --runstats in/rgb.exr in/rgb2.exr --add -o out.exr
"""

DIFF = """
same: in/rgb.exr in/rgb.exr --diff
close!: in/rgb.exr in/close.exr --diff
far!: in/rgb.exr in/rgb2.exr --diff
early!: --diff in/rgb.exr in/rgb2.exr
fail-larger: --fail 0.01 in/rgb.exr in/close.exr --diff
fail-and-warn: --fail 0.01 --warn 0.01 in/rgb.exr in/close.exr --diff
warn: --fail 0.01 --warn 0.001 in/rgb.exr in/close.exr --diff
failpercent: --fail 0.001 --failpercent 100 in/rgb.exr in/close.exr --diff
failpercent-low!: --fail 0.002 --failpercent 10 in/rgb.exr in/close.exr --diff
hardfail!: --fail 0.1 --hardfail 0.001 in/rgb.exr in/close.exr --diff
hardfail-larger: --fail 0.1 --warn 0.1 --hardfail 0.5 in/rgb.exr in/close.exr --diff
hardwarn: --fail 0.1 --warn 0.1 --hardwarn 0.001 in/rgb.exr in/close.exr --diff
hardwarn-larger: --fail 0.1 --warn 0.1 --hardwarn 0.9 in/rgb.exr in/close.exr --diff
warnpercent: --fail 0.1 --warn 0.001 --warnpercent 100 in/rgb.exr in/close.exr --diff
warnpercent-low: --fail 0.1 --warn 0.002 --warnpercent 1 in/rgb.exr in/close.exr --diff
after-the-command!: in/rgb.exr in/close.exr --diff --fail 0.1
first-part!: in/parts.exr in/parts2.exr --diff
all-parts!: -a in/parts.exr in/parts2.exr --diff
equal-parts: -a in/parts.exr in/parts.exr --diff
equal-first-part: in/parts.exr in/parts.exr --diff
part-count!: -a in/parts.exr in/pair.exr --diff
sizes!: in/rgb.exr in/small.exr --diff
channels!: in/rgb.exr in/rgba.exr --diff
windows!: in/rgb.exr in/inside.exr --diff
deep!: in/deep.exr in/deep2.exr --diff
deep-same: in/deep.exr in/deep.exr --diff
nan!: in/rgb.exr in/nan.exr --diff
nan-same: in/nan.exr in/nan.exr --diff
integers!: in/u8.tif in/u8b.tif --diff
mips: -a in/mip.exr in/mip.exr --diff
in-memory: in/rgb.exr --mulc 2 in/rgb.exr --mulc 2 --diff
stays-on-stack: in/rgb.exr in/rgb.exr --diff --add -o out.exr
quiet!: -q in/rgb.exr in/rgb2.exr --diff
sequence!: --frames 1-3 in/seq.#.exr in/seq.#.exr --mulc 1.001 --diff
pdiff-same: in/rgb.exr in/rgb.exr --pdiff
pdiff-close: in/rgb.exr in/close.exr --pdiff
pdiff-far!: in/rgb.exr in/rgb2.exr --pdiff
pdiff-fail!: --fail 0.5 --failpercent 10 in/rgb.exr in/rgb2.exr --pdiff
pdiff-parts!: -a in/pair.exr in/parts.exr --pdiff
"""

PDIFF = {"without": "^  (Mean error|RMS error|Peak SNR) = ",
         "reason": "oiiotool prints memory that it never set for these after --pdiff"}

METADATA = """
attrib-kinds: in/rgb.exr --attrib i 3 --attrib f 2.5 --attrib s hello -o out.exr
attrib-types: in/rgb.exr --attrib:type=int i 5 --attrib:type=float f 5 --attrib:type=string s 5
    -o out.exr
attrib-arrays: in/rgb.exr --attrib:type=float[2] p 1,2 --attrib:type=int[3] q 1,2,3 -o out.exr
attrib-matrix: in/rgb.exr
    --attrib:type=matrix m 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1 -o out.exr
attrib-vector: in/rgb.exr --attrib:type=point p 1,2,3 --attrib:type=color c .1,.2,.3 -o out.exr
attrib-timecode: in/rgb.exr --attrib:type=timecode smpte:TimeCode 01:02:03:04 -o out.exr
attrib-rational: in/rgb.exr --attrib:type=rational captureRate 24000/1001 -o out.exr
attrib-expression: in/rgb.exr --attrib size "{TOP.width}x{TOP.height}" -o out.exr
attrib-parts: -a in/parts.exr --attrib owner me -o out.exr
attrib-first-part: in/parts.exr --attrib owner me -o out.exr
attrib-part: in/parts.exr --attrib:subimages=1 owner me -o out.exr
attrib-parts-named: in/parts.exr --attrib:subimages=albedo,0 owner me -o out.exr
attrib-exif: in/u8.tif --attrib Exif:FNumber 2.8 --attrib Make Maker -o out.tif
attrib-replaced: in/meta.exr --attrib camera other -o out.exr
attrib-erased: in/meta.exr --attrib camera "" -o out.exr
sattrib: in/rgb.exr --sattrib number 7 -o out.exr
sattrib-parts: -a in/pair.exr --sattrib number 7 -o out.exr
eraseattrib: in/meta.exr --eraseattrib "shot:.*" -o out.exr
eraseattrib-all: in/meta.exr --eraseattrib ".*" -o out.exr
eraseattrib-case: in/meta.exr --eraseattrib "SHOT.*" --eraseattrib nosuch -o out.exr
eraseattrib-parts: -a in/parts.exr --eraseattrib "name|oiio:sub.*" -o out.exr
caption: in/rgb.exr --caption "a caption" -o out.exr
caption-jpeg: in/plain.jpg --caption "a caption" -o out.jpg
keyword: in/rgb.exr --keyword one --keyword two -o out.exr
keyword-again: in/rgb.exr --keyword one --keyword one -o out.tif
clear-keywords: in/meta.exr --clear-keywords --keyword new -o out.exr
clear-keywords-only: in/rgb.exr --keyword one --clear-keywords -o out.exr
no-software: --nosoftwareattrib in/rgb.exr -o out.exr
no-software-tiff: --nosoftwareattrib in/u8.tif --mulc 0.5 -o out.tif
software: in/rgb.exr --sattrib foo bar -o out.tif
sansattrib: --sansattrib in/rgb.exr --sattrib foo bar --attrib b 2 -o out.tif
sansattrib-exr: --sansattrib in/rgb.exr --sattrib foo bar -o out.exr
orientation: in/u8.tif --orientation 6 -o out.tif
orientation-exr: in/rgb.exr --orientation 3 -o out.exr
orientcw: in/photo.jpg --orientcw -o out.tif
orientcw-thrice: in/rgb.exr --orientcw --orientcw --orientcw -o out.exr
orientccw: in/photo.jpg --orientccw -o out.jpg
orientccw-parts: -a in/pair.exr --orientation 5 --orientccw -o out.exr
orient180: in/photo.jpg --orient180 -o out.tif
orient180-mirrored: in/rgb.exr --orientation 2 --orient180 -o out.exr
iccwrite: in/u8.tif --iccread in/profile.icc -o out.tif --iccwrite out.icc
iccwrite-kept: in/u8.tif --iccread in/profile.icc -o out.tif && out.tif --iccwrite back.icc
iccread-png: in/u8.png --iccread in/profile.icc -o out.png
iccread-jpeg: in/plain.jpg --iccread in/profile.icc -o out.jpg
"""

# oiiotool reads through OpenImageIO's cache, which then tells of the files: their number, sizes and
# times. Of the times it leaves out those too short to measure.
RUNSTATS = {"without": r"^( +[\w/ ]+ time( only)? : TIME|  Images : .*| +ImageInputs : .*"
                       r"| +.* : SIZE|  +(Options:|autoscanline|accept_|unassociated).*|  No images opened|  Image file statistics:| +opens .*|  BROKEN .*| +\d+ +\S+"
                       r"| +\d+ +\d+ .*|  +Tot: .*|  \d+ (not tiled|was constant).*"
                       r"|  Broken or invalid files.*|)$",
            "reason": "counters of a cache that only one of the programs reads through, and times"}

VERSION = {"without": r"^\d+(\.\d+)+$", "reason": "each program has a version of its own"}

NOT_COMPARED = {"without": ".", "reason": "oiiotool fails without comparing deep with flat pixels, "
                                          "and prints memory that it never set"}

CASES = [*table("print", PRINT, runstats=RUNSTATS, runstats_two=RUNSTATS, version=VERSION,
                version_quiet=VERSION),
         *table("diff", DIFF, pdiff_far=PDIFF, pdiff_fail=PDIFF, pdiff_parts=PDIFF),
         *table("metadata", METADATA)]
