# SPDX-License-Identifier: BSD-3-Clause
"""Channels, subimages, MIP levels, deep images, the stack."""

from case import table

CHANNELS = """
ch-shuffle: in/rgb.exr --ch B,G,R -o out.exr
ch-numbers: in/rgb.exr --ch 2,1,0 -o out.exr
ch-one: in/rgb.exr --ch G -o out.exr
ch-layer: in/layers.exr --ch diffuse.R,diffuse.G,diffuse.B -o out.exr
ch-rename: in/layers.exr --ch R=diffuse.R,G=diffuse.G,B=diffuse.B -o out.exr
ch-constant: in/rgb.exr --ch R,G=0.5,B,A=1.0 -o out.exr
ch-empty-places: in/rgb.exr --ch ,,,A=1.0 -o out.exr
ch-swap-names: in/rgb.exr --ch B=R,G,R=B -o out.exr
ch-twice: in/rgb.exr --ch R,R,R -o out.exr
ch-unknown: in/rgb.exr --ch R,nosuch -o out.exr
ch-number-out-of-range: in/rgb.exr --ch 0,7 -o out.exr
ch-mixed-types: in/layers.exr --ch R,Z,id -o out.exr
ch-depth: in/depth.exr --ch Z -o out.exr
ch-deep: in/deep.exr --ch R,G,B,A,Z -o out.exr
ch-parts: -a in/pair.exr --ch B,G,R -o out.exr
ch-modifier: in/pair.exr --ch:allsubimages=1 B,G,R -o out.exr
ch-modifier-off: -a in/pair.exr --ch:allsubimages=0 B,G,R -o out.exr
ch-to-png: in/rgba.exr --ch R,G,B -o out.png
chappend: in/rgb.exr in/grey.exr --chappend -o out.exr
chappend-late: in/rgb.exr --chappend in/grey.exr -o out.exr
chappend-three: in/rgb.exr in/grey.exr in/two.exr --chappend:n=3 -o out.exr
chappend-two: in/two.exr in/grey.exr in/rgb.exr --chappend:n=2 -o out.exr
chappend-windows: in/rgb.exr in/inside.exr --ch A=R --chappend -o out.exr
chappend-parts: -a in/pair.exr in/pair.exr --ch A=R --chappend -o out.exr
chnames: in/rgb.exr --chnames X,Y,Z -o out.exr
chnames-some: in/rgba.exr --chnames ,,,alpha -o out.exr
chnames-parts: -a in/pair.exr --chnames u,v,w -o out.exr
chnames-depth: in/two.exr --chnames A,Z -o out.exr
all-channels-kept: in/layers.exr -o out.exr
all-channels-native: in/layers.exr --native --ch R,G,B,Z -o out.exr
"""

PARTS = """
subimage-number: in/parts.exr --subimage 1 -o out.exr
subimage-name: in/parts.exr --subimage albedo -o out.exr
subimage-last: in/parts.exr --subimage 2 -o out.exr
subimage-delete: in/parts.exr --subimage:delete=1 1 -o out.exr
subimage-delete-name: in/parts.exr --subimage:delete=1 beauty -o out.exr
subimage-one: in/rgb.exr --subimage 0 -o out.exr
sisplit: in/parts.exr --sisplit -o a.exr --pop -o b.exr --pop -o c.exr
sisplit-one: in/rgb.exr --sisplit -o a.exr
sisplit-add: in/pair.exr --sisplit --add -o out.exr
siappend: in/rgb.exr in/rgb2.exr --siappend -o out.exr
siappend-parts: in/pair.exr in/grey.exr --siappend -o out.exr
siappend-count: in/rgb.exr in/rgb2.exr in/grey.exr --siappend:n=3 -o out.exr
siappend-count-two: in/rgb.exr in/rgb2.exr in/grey.exr --siappend:n=2 -o out.exr
siappendall: in/rgb.exr in/rgb2.exr in/grey.exr --siappendall -o out.exr
siappendall-parts: in/pair.exr in/rgb3.exr --siappendall -o out.exr
parts-kept: in/parts.exr -o out.exr
parts-to-tiff: in/pair.exr -o out.tif
unmip: in/mip.exr --unmip -o out.exr
unmip-texture: in/mip.tx --unmip -o out.tif
selectmip: in/mip.exr --selectmip 2 -o out.exr
selectmip-texture: in/mip.tx --selectmip 1 -o out.tif
mips-kept: in/mip.exr -o out.exr
mips-all: -a in/mip.exr -o out.exr
mips-texture: -a in/mip.tx --mulc 0.5 -o out.tx
"""

DEEP = """
flatten: in/deep.exr --flatten -o out.exr
flatten-flat: in/rgb.exr --flatten -o out.exr
deepen: in/depth.exr --deepen -o out.exr
deepen-flat!: in/rgba.exr --deepen -o out.exr
deepen-z: in/depth.exr --deepen:z=5 -o out.exr
deepen-z-channel: in/depth2.exr --ch R,G,B,A,Z --deepen:z=0.5 -o out.exr
deepen-there-and-back: in/depth.exr --deepen --flatten -o out.exr
deepmerge: in/deep.exr in/deep2.exr --deepmerge -o out.exr
deepmerge-flatten: in/deep.exr in/deep2.exr --deepmerge --flatten -o out.exr
deepholdout: in/deep.exr in/deep2.exr --deepholdout -o out.exr
deepholdout-swapped: in/deep2.exr in/deep.exr --deepholdout -o out.exr
deep-kept: in/deep.exr -o out.exr
deep-over!: in/deep.exr in/deep2.exr --over -o out.exr
deep-attrib: in/deep.exr --attrib owner me -o out.exr
deep-trimmed: in/deep.exr --trim --croptofull --reorient --deepen -o out.exr
deep-appended: in/deep.exr in/deep2.exr --siappend -o out.exr
deep-pastemeta: in/meta.exr in/deep2.exr --pastemeta -o out.exr
deep-to-half: in/deep.exr -d half -o out.exr
"""

STACK = """
dup: in/rgb.exr --dup --mulc 0.5 -o out.exr
dup-add: in/rgb.exr --dup --add -o out.exr
swap: in/rgb.exr in/rgb2.exr --swap --sub -o out.exr
swap-twice: in/rgb.exr in/rgb2.exr --swap --swap -o out.exr
pop: in/rgb.exr in/rgb2.exr --pop -o out.exr
pop-between: in/rgb.exr in/rgb2.exr --pop in/rgb3.exr --add -o out.exr
label: in/rgb.exr --label first in/rgb2.exr first --add -o out.exr
label-kept: in/rgb.exr --mulc 2 --label twice --pop in/grey.exr twice -o out.exr
label-wins: in/rgb.exr --label in/grey.exr --pop in/grey.exr -o out.exr
label-twice: in/rgb.exr --label a --pop in/rgb2.exr --label a --pop a -o out.exr
label-expression: in/grey.exr --label g in/rgb.exr --echo "{IMG[g].nchannels}"
stack-depth: in/rgb.exr in/rgb2.exr in/rgb3.exr in/unit.exr --add --add --add -o out.exr
two-waiting: --add --mul in/rgb.exr in/rgb2.exr in/rgb3.exr -o out.exr
output-in-between: in/rgb.exr -o a.exr --mulc 0.5 -o b.exr --mulc 0.5 -o c.exr
"""

CASES = [*table("channel", CHANNELS), *table("part", PARTS), *table("deep", DEEP),
         *table("stack", STACK)]
