# SPDX-License-Identifier: BSD-3-Clause
"""Arithmetic of images and constants, values in range, arithmetic on subimages."""

from case import table

BINARY = [f"{command}: in/rgb.exr in/rgb2.exr --{command} -o out.exr"
          for command in ("add", "sub", "mul", "div", "absdiff", "max", "min")]

CONSTANT = [f"{command}: in/signed.exr --{command} 0.3 -o a.exr --{command} 0.1,-0.5,2 -o b.exr"
            for command in ("addc", "subc", "mulc", "divc", "absdiffc", "maxc", "minc")]

PLAIN = """
add-windows: in/rgb.exr in/inside.exr --add -o out.exr
add-overscan: in/overscan.exr in/inside.exr --add -o out.exr
add-alpha-to-color: in/rgb.exr in/rgba.exr --add -o out.exr
add-float-to-half: in/rgb.exr in/float.exr --add -o out.exr
add-integers: in/u8.tif in/u8b.tif --add -o out.tif
add-first: --add in/rgb.exr in/rgb2.exr -o out.exr
add-between: in/rgb.exr --add in/rgb2.exr -o out.exr
add-all-parts: -a in/parts.exr in/parts2.exr --add -o out.exr
add-first-part: in/parts.exr in/parts2.exr --add -o out.exr
add-modifier: in/parts.exr in/parts2.exr --add:allsubimages=1 -o out.exr
sub-grey: in/grey.exr in/grey.exr --mulc 0.5 --sub -o out.exr
sub-all-parts: -a in/parts.exr in/parts2.exr --sub -o out.exr
mul-windows: in/offset.exr in/inside.exr --mul -o out.exr
mul-grey: in/rgb.exr in/grey.exr --mul -o out.exr
div-by-zero: in/rgb.exr in/border.exr --div -o out.exr
div-nan: in/nan.exr in/rgb.exr --div -o out.exr
addc-int: in/u8.tif --addc 0.25 -o out.tif
addc-nan: in/nan.exr --addc 1 -o out.exr
addc-two-of-three: in/rgb.exr --addc 0.5,0.25 -o out.exr
addc-deep: in/deep.exr --addc 0.5 -o out.exr
mulc-deep: in/deep.exr --mulc 0.5,1,2,1,1,1 -o out.exr
mulc-all-parts: -a in/parts.exr --mulc 0.5 -o out.exr
mulc-first-part: in/parts.exr --mulc 0.5 -o out.exr
mulc-part: in/parts.exr --mulc:subimages=1 0.5 -o out.exr
mulc-part-by-name: in/parts.exr --mulc:subimages=albedo 0.5 -o out.exr
mulc-parts: in/parts.exr --mulc:subimages=0,2 2 -o out.exr
mulc-not-part: in/parts.exr --mulc:subimages=-0 0.5 -o out.exr
mulc-mips: -a in/mip.exr --mulc 0.5 -o out.exr
divc-zero: in/rgb.exr --divc 0 -o out.exr
maxc-alpha: in/rgba.exr --maxc 0.2,0.2,0.2,0.5 -o out.exr
minc-all-parts: -a in/parts.exr --minc 0.5 -o out.exr
mad: in/rgb.exr in/rgb2.exr in/rgb3.exr --mad -o out.exr
mad-windows: in/rgb.exr in/inside.exr in/overscan.exr --mad -o out.exr
mad-late: in/rgb.exr in/rgb2.exr --mad in/rgb3.exr -o out.exr
invert: in/rgb3.exr --invert -o out.exr
invert-alpha: in/rgba.exr --invert -o out.exr
invert-channels: in/rgba.exr --invert:chbegin=1:chend=2 -o out.exr
invert-all-channels: in/rgba.exr --invert:chend=4 -o out.exr
invert-integer: in/u8.tif --invert -o out.tif
invert-two: in/rgba.exr --invert:chbegin=2:chend=4 -o out.exr
sub-modifier: in/parts.exr in/parts2.exr --sub:allsubimages=1 -o out.exr
chsum-weight-of-four: in/rgba.exr --chsum:weight=.1,.2,.3,.4 -o out.exr
abs: in/signed.exr --abs -o out.exr
abs-all-parts: -a in/parts.exr --subc 1 --abs -o out.exr
absdiff-parts: -a in/parts.exr in/parts2.exr --absdiff -o out.exr
powc-one: in/rgb.exr --powc 2.2 -o out.exr
powc-each: in/rgb.exr --powc 2.2,1,0.5 -o out.exr
powc-negative: in/signed.exr --powc 0.5 -o out.exr
max-parts: -a in/parts.exr in/parts2.exr --max -o out.exr
min-windows: in/rgb.exr in/inside.exr --min -o out.exr
max-nan: in/nan.exr in/rgb.exr --max -o out.exr
maxchan: in/rgb.exr --maxchan -o out.exr
maxchan-alpha: in/rgba.exr --maxchan -o out.exr
minchan: in/rgb.exr --minchan -o out.exr
minchan-parts: -a in/pair.exr --minchan -o out.exr
chsum: in/rgb.exr --chsum -o out.exr
chsum-weight: in/rgb.exr --chsum:weight=0.2126,0.7152,0.0722 -o out.exr
chsum-weight-alpha: in/rgba.exr --chsum:weight=1,0.5 -o out.exr
chain: in/rgb.exr --mulc 0.5 --addc 0.1 in/rgb2.exr --sub --abs --powc 0.5 -o out.exr
chain-to-integer: in/rgb.exr --mulc 0.5 in/u8.tif --add --divc 2 -d uint8 -o out.tif
constant-from-image: in/rgb.exr --mulc "{1.0/TOP.width}" -o out.exr
"""

RANGES = """
clamp-default: in/signed.exr --clamp -o out.exr
clamp-both: in/signed.exr --clamp:min=-0.2:max=0.8 -o out.exr
clamp-each: in/signed.exr --clamp:min=0,0.1,0.2:max=1,0.9,0.8 -o out.exr
clamp-max: in/rgb.exr --clamp:max=0.7 -o out.exr
clamp-min: in/signed.exr --clamp:min=0 -o out.exr
clamp-alpha: in/rgba.exr --mulc 2 --clamp:clampalpha=1 -o out.exr
clamp-no-alpha: in/rgba.exr --mulc 2 --clamp:clampalpha=0:max=1.5 -o out.exr
clamp-nan: in/nan.exr --clamp:min=0:max=1 -o out.exr
clamp-parts: -a in/parts.exr --clamp:max=0.5 -o out.exr
contrast-default: in/rgb.exr --contrast -o out.exr
contrast-points: in/rgb.exr --contrast:black=0.1:white=0.75 -o out.exr
contrast-each: in/rgb.exr --contrast:black=0.1,0.2,0:white=0.75,1,2 -o out.exr
contrast-gamma: in/rgb.exr --contrast:white=0.8:gamma=2.2 -o out.exr
contrast-sigmoid: in/rgb3.exr --contrast:scontrast=5:sthresh=0.3 -o out.exr
contrast-sigmoid-each: in/rgb3.exr --contrast:scontrast=5,2,3:sthresh=0.3,0.5,0.6 -o out.exr
contrast-clamp: in/rgb.exr --contrast:black=0.2:white=0.6:clamp=1 -o out.exr
contrast-inverse: in/rgb.exr --contrast:black=1:white=0:min=0.2:max=0.7 -o out.exr
contrast-parts: -a in/parts.exr --contrast:white=0.5 -o out.exr
saturate-none: in/rgb.exr --saturate 0 -o out.exr
saturate-more: in/rgba.exr --saturate 1.7 -o out.exr
saturate-parts: -a in/pair.exr --saturate 0.5 -o out.exr
rangecompress: in/rgb.exr --rangecompress -o out.exr
rangecompress-luma: in/rgb.exr --mulc 8 --rangecompress:luma=1 -o out.exr
rangecompress-no-luma: in/rgba.exr --mulc 8 --rangecompress:luma=0 -o out.exr
rangeexpand: in/rgb.exr --rangeexpand -o out.exr
rangeexpand-luma: in/rgb.exr --rangeexpand:luma=1 -o out.exr
range-there-and-back: in/rgb.exr --mulc 20 --rangecompress --resize 50% --rangeexpand -o out.exr
fixnan-black: in/nan.exr --fixnan black -o out.exr
fixnan-box3: in/nan.exr --fixnan box3 -o out.exr
fixnan-none: in/nan.exr --fixnan none -o out.exr
fixnan-parts: -a in/parts.exr --fixnan black -o out.exr
fixnan-clean: in/rgb.exr --fixnan error -o out.exr
fixnan-deep: in/deep.exr --fixnan black -o out.exr
noise-default: in/rgb.exr --noise -o out.exr
noise-gaussian: in/rgb.exr --noise:type=gaussian:mean=0.1:stddev=0.2 -o out.exr
noise-uniform: in/rgb.exr --noise:type=uniform:min=-0.1:max=0.3 -o out.exr
noise-white: in/rgb.exr --noise:type=white:min=0:max=0.2 -o out.exr
noise-salt: in/rgb.exr --noise:type=salt:value=1:portion=0.1 -o out.exr
noise-seed: in/rgb.exr --noise:type=uniform:seed=42 -o out.exr
noise-mono: in/rgb.exr --noise:type=gaussian:mono=1:seed=3 -o out.exr
noise-channels: in/rgb.exr --noise:type=uniform:nchannels=1 -o out.exr
noise-two-channels: in/rgb.exr --noise:type=salt:value=2:portion=0.3:nchannels=2 -o out.exr
noise-wide: in/grey.exr --noise:type=gaussian:mean=0.5:stddev=1:mono=1 -o out.exr
contrast-clamp-each: in/rgb.exr --contrast:black=0.2,0,0:white=1.5:clamp=1:min=0.1:max=0.9
    -o out.exr
contrast-gamma-ignored: in/rgb3.exr --contrast:gamma=0.5:scontrast=3:clamp=0 -o out.exr
rangeexpand-no-luma: in/rgba.exr --rangeexpand:luma=0 -o out.exr
"""

CASES = [*table("arith", "\n".join(BINARY + CONSTANT)), *table("arith", PLAIN),
         *table("range", RANGES)]
