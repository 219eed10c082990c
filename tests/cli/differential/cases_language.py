# SPDX-License-Identifier: BSD-3-Clause
"""Expressions, control flow, wildcards, frames, views, and where oiiotool is lenient."""

from case import table

EXPRESSIONS = r"""
numbers: --echo "{2+3*4} {(2+3)*4} {7/2} {7//2} {7%4} {-2} {1e3} {0.1+0.2} {10-4-3} {2*-3}"
comparisons: --echo "{1<2} {2<=1} {3>2} {3>=3} {1==1.0} {1!=2} {1<=>2} {2<=>2} {3<=>2}"
logic: --echo "{1&&0} {1||0} {!0} {!3} {not(1)} {not(0)}"
strings: --echo "{eq('a','a')} {neq('a','b')} {eq(\"x\",\"y\")}"
several: --echo "a{1+1}b{2+2}c"
nested-text: --set n rgb --echo "{n}.exr"
image: in/rgba.exr --echo "{TOP.width} {TOP.height} {TOP.nchannels} {TOP.x} {TOP.y} {TOP.geom}"
image-window: in/inside.exr --echo "{TOP.geom} {TOP.full_geom} {TOP.x+TOP.width} {TOP.full_width}"
image-format: in/u8.tif --echo "{TOP.format}" --mulc 0.5 --echo "{TOP.format}"
image-names: in/rgba.exr
    --echo "{TOP.filename} {TOP.file_extension} {TOP.file_noextension}"
image-colors: in/rgb.exr --echo "{TOP.MINCOLOR} | {TOP.MAXCOLOR} | {TOP.AVGCOLOR}"
image-meta: in/meta.exr --echo "{TOP.META}"
image-meta-brief: in/meta.exr --echo "{TOP.METABRIEF}"
image-stats: in/rgb.exr --echo "{TOP.STATS}"
image-constant!: --create 8x8 3 --echo "{TOP.IS_CONSTANT} {TOP.IS_BLACK}"
image-by-number: in/meta.exr in/rgb.exr --echo "{IMG[0].width} {IMG[1].width}"
image-by-label: in/grey.exr --label g in/rgb.exr --echo "{IMG[g].nchannels} {IMG[0].nchannels}"
metadata: in/meta.exr --echo "{TOP.camera} {TOP.Artist} {TOP.'shot:name'} {TOP.\"shot:take\"}"
metadata-number: in/meta.exr --echo "{TOP.'shot:take' + 1} {TOP.'shot:ratio' * 2}"
metadata-matrix: in/meta.exr --echo "{TOP.worldToCamera} {TOP.FramesPerSecond}"
attribute: --echo "{getattribute(threads)}"
attribute-set: --threads 1 --echo "{getattribute(threads)}"
as-argument: in/wide.exr --resize "{TOP.width//2}x{TOP.height}" -o out.exr
as-name: in/rgb.exr -o "{TOP.width}_{TOP.height}.exr"
as-modifier: in/rgb.exr --set f box --resize:filter={f} 32x24 -o out.exr
slate-name: in/rgb.exr -o "copy_of_{TOP.nchannels}.exr"
eval-off: --evaloff --echo "{1+1}" --evalon --echo "{1+1}"
eval-off-name: in/rgb.exr --evaloff -o "{x}.exr"
eval-on-again: --echo "{1+1}" --evaloff --evalon --echo "{2+1}"
unknown-name!: --echo "{nosuch}"
unknown-attribute!: in/rgb.exr --echo "{TOP.nosuch}"
no-image!: --echo "{TOP.width}"
unfinished!: in/rgb.exr --echo "{TOP.width +}"
bracket!: in/meta.exr --echo "{TOP[shot:take]}"
later-names!: in/parts.exr --echo "{TOP.SUBIMAGES} {NIMAGES} {TOP.nativeformat} {BOTTOM.width}"
"""

CONTROL = """
set: --set a 5 --echo "{a} {a+1}"
set-string: --set a hello --echo "{a}"
set-type: --set:type=float v 2 --set:type=string s 2 --echo "{v*3} {s}"
set-again: --set n 1 --set n "{n+1}" --echo "{n}"
set-from-image: in/rgb.exr --set w "{TOP.width}" --pop --echo "{w/2}"
if-true: --set x 5 --if "{x>3}" --echo big --else --echo small --endif
if-false: --set x 2 --if "{x>3}" --echo big --else --echo small --endif
if-empty: --if "" --echo no --endif --echo end
if-text: --if abc --echo yes --endif
if-nested: --if 1 --if 0 --echo a --else --echo b --endif --else --echo c --endif
if-skips-image: --if 0 nosuch.exr --endif in/rgb.exr -o out.exr
if-image: in/rgb.exr --if "{TOP.width>50}" --resize 32x24 --endif -o out.exr
else-image: in/small.exr --if "{TOP.width>50}" --resize 32x24 --else --mulc 2 --endif -o out.exr
endif-alone!: --endif
else-alone!: --else
endfor-alone!: --endfor
endwhile-alone!: --endwhile
if-unfinished: --if 1 --echo x
for-unfinished: --for i 3 --echo "{i}"
while-unfinished: --while 1 --echo a --set q 1
while: --set n 3 --while "{n>0}" --echo "{n}" --set n "{n-1}" --endwhile
while-never: --while 0 --echo no --endwhile --echo end
while-image: in/rgb.exr --while "{TOP.width > 10}" --resize 50% --endwhile -o out.exr
for-end: --for i 3 --echo "{i}" --endfor
for-range: --for i 1,3 --echo "{i}" --endfor
for-step: --for i 0,6,2 --echo "{i}" --endfor
for-none: --for i 5,0,-2 --echo "{i}" --endfor
for-text: --for i abc --echo "{i}" --endfor
for-nested: --for i 2 --for j 2 --echo "{i} {j}" --endfor --endfor
for-image: in/rgb.exr --for i 1,4 --mulc "{1.0/i}" -o out{i}.exr --endfor
for-expression: --set n 2 --for i "{n*2}" --echo "{i}" --endfor
for-expression-value: --for i 3 in/parts.exr --subimage "{i}" -o "part{i}.exr" --endfor
"""

FRAMES = """
scan: in/seq.#.exr -o out.#.exr
scan-hole: in/holes.#.exr -o out.#.exr
scan-printf: in/seq.%04d.exr --mulc 2 -o out.%03d.exr
range: --frames 1-3 in/seq.#.exr -o out.#.exr
range-list: --frames 1,3,7-8 in/seq.#.exr -o out.#.exr
range-step: --frames 1-9x4,20 in/seq.%04d.exr -o out.%02d.exr
range-complement: --frames 1-6y3 in/seq.@@@@.exr -o out.@@@.exr
range-backwards: --frames 3-1 in/seq.#.exr --echo "{FRAME_NUMBER}" -o out.@.exr
range-negative: --frames -2-1 --create 4x4 3 -o out.#.exr
range-in-name: in/seq.1-3#.exr in/bg.4-6#.exr --add -o out.1-3#.exr
range-in-one-name: in/seq.1-3#.exr -o out.#.exr
range-no-wildcard: --frames 1-2 in/rgb.exr -o out.exr
range-unequal!: in/seq.1-3#.exr in/bg.4-7#.exr --add -o out.#.exr
range-static: --frames 1-3 in/rgb.exr --resize 32x24 in/seq.#.exr --add -o out.#.exr
mixed-padding: --frames 1-2 in/seq.@@@@.exr -o out.##.exr
number: --frames 1-3 --echo "{FRAME_NUMBER} {FRAME_NUMBER_PAD} {FRAME_NUMBER/2.0}"
number-none: --echo "{FRAME_NUMBER}"
number-constant: --frames 1-3 in/seq.#.exr --mulc "{FRAME_NUMBER*0.5}" -o out.#.exr
number-attrib: --frames 9-10 in/seq.#.exr --attrib frame "{FRAME_NUMBER}" -o out.#.exr
padding: --frames 1-2 --framepadding 6 in/seq.%04d.exr -o out.#.exr
padding-number: --frames 1-3 --framepadding 3 --echo "{FRAME_NUMBER_PAD}"
padding-missing!: --frames 1-3 --framepadding 3 in/seq.####.exr -o out.#.exr
wildcard-off: --wildcardoff in/rgb.exr -o out.#.exr
wildcard-off-on: --frames 1-2 in/seq.#.exr --wildcardoff -o same#.exr --wildcardon -o out.#.exr
wildcard-on: --wildcardon --frames 2-3 in/seq.#.exr -o out.#.exr
no-match: in/nosuch.#.exr -o out.#.exr
no-file!: --frames 1-3 in/nosuch.#.exr -o out.#.exr
hole!: --frames 6-9 in/holes.#.exr -o out.#.exr
hole-skipped!: --frames 6-9 --skip-bad-frames in/holes.#.exr -o out.#.exr
hole-black!: --frames 6-9 --missingfile black in/holes.#.exr -o out.#.exr
hole-checker!: --frames 6-9 --missingfile checker in/holes.#.exr -o out.#.exr
hole-black-first!: --frames 7-9 --missingfile black in/holes.#.exr -o out.#.exr
broken!: in/broken.#.exr -o out.#.exr
broken-skipped!: --skip-bad-frames in/broken.#.exr -o out.#.exr
broken-chain-skipped!: --skip-bad-frames in/broken.#.exr in/seq.1-3#.exr --add -o out.#.exr
label-each: --frames 1-2 in/seq.#.exr --label a --mulc 2 a --add -o out.#.exr
if-frame: --frames 1-3 in/seq.#.exr --if "{FRAME_NUMBER==2}" --mulc 0 --endif -o out.#.exr
info: --info in/seq.1-3#.exr
options-again: --frames 1-2 in/seq.#.exr -o a.#.exr -d float -o b.#.exr
all-outputs: --frames 1-2 in/seq.#.exr in/bg.#.exr -o:all=1 out%d.exr
views: in/stereo.%V.#.exr -o out.%V.#.exr
views-one: --views left in/stereo.%V.#.exr -o out.%V.#.exr
views-one-later: in/stereo.%V.%04d.exr --views right -o out.%V.%04d.exr
views-short: in/eye.%v.@@.exr -o out.%V.@@.exr
views-short-one: --views left in/eye.%v.%02d.exr -o out.%V.%02d.exr
views-chain: --views left,right in/stereo.%V.#.exr in/stereo.%V.#.exr --flop --add -o o.%V.#.exr
"""

LENIENT = """
modifier-unknown: in/rgb.exr --addc:foo=1 1 -o out.exr
modifier-malformed: in/rgb.exr --addc:foo 1 -o out.exr
modifier-empty: in/rgb.exr --addc: 1 -o out.exr
modifier-twice: in/rgb.exr --resize:filter=box:filter=triangle 32x24 -o out.exr
modifier-quoted: in/rgb.exr --resize:filter='box' 32x24 -o out.exr
modifier-quoted-double: in/rgb.exr "--resize:filter=\\"box\\"" 32x24 -o out.exr
one-dash: in/rgb.exr -addc 0.5 -resize 50% -o out.exr
two-dashes: --i in/rgb.exr --addc 0.5 --d half --o out.exr
number-bad: in/rgb.exr --addc abc -o out.exr
number-trailing: in/rgb.exr --addc 0.5abc -o out.exr
number-list-long: in/rgb.exr --addc 1,2,3,4,5 -o out.exr
number-list-spaces: in/rgb.exr --addc "0.1, 0.2, 0.3" -o out.exr
blur-bad: in/rgb.exr --powc "" -o out.exr
pending: in/rgb.exr --add -o out.exr
pending-nothing: --add
pending-unary: --addc 1 -o out.exr
output-nothing: -o out.exr
saturate-bad: in/rgb.exr --saturate abc -o out.exr
fixnan-bad: in/nan.exr --fixnan nosuch -o out.exr
fullsize-scale: in/rgb.exr --fullsize 50% -o out.exr
no-arguments-but-flags: -v
threads-bad: --threads abc in/rgb.exr -o out.exr
order-of-flags: in/rgb.exr -o out.exr -a
"""

CASES = [*table("expression", EXPRESSIONS), *table("control", CONTROL), *table("frames", FRAMES),
         *table("lenient", LENIENT)]
