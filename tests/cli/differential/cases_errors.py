# SPDX-License-Identifier: BSD-3-Clause
"""Errors: one of every command at least, together with those of the other tables."""

from case import table
from cases_printing import NOT_COMPARED, RUNSTATS, VERSION

TAKE_ARGUMENTS = """metamatch no-metamatch threads cache autotile oiioattrib set if while for
    frames framepadding views i iconfig missingfile o d tile compression
    planarconfig echo colorcount rangecheck attrib sattrib eraseattrib
    caption keyword orientation originoffset fullsize chnames fail
    failpercent hardfail warn warnpercent hardwarn addc subc mulc divc
    absdiffc powc quality pixelaspect dilate erode maxc minc saturate line point box
    fill label iscolorspace tocolorspace""".split()

NOT_DEEP_ONE = """invert abs noise rotate90 rotate180 rotate270 flip flop unsharp laplacian ifft
    polar unpolar fillholes clamp contrast rangecompress rangeexpand unpremult premult
    repremult""".split()

NOT_DEEP_TWO = """add sub mul div absdiff max min mad over zover st_warp
    convolve""".split()

# Deep images do nothing to these, or end oiiotool by a signal.
UNREADABLE = """chsum trim croptofull reorient transpose fft maxchan minchan deepen chappend
    pastemeta siappend siappendall sisplit unmip flatten dup printstats
    printinfo""".split()

MISSING = [f"missing-{name}!: in/rgb.exr --{name}" for name in TAKE_ARGUMENTS]
DEEP_ONE = [f"deep-{name}!: in/deep.exr --{name} -o out.exr" for name in NOT_DEEP_ONE]
DEEP_TWO = [f"deep-{name}!: in/deep.exr in/deep2.exr in/deep.exr --{name} -o out.exr"
            for name in NOT_DEEP_TWO]
CUT = [f"cut-short-{name}!: in/rgb.exr in/cut_short.exr --{name} -o out.exr"
       for name in UNREADABLE]

ERRORS = """
command-unknown!: in/rgb.exr --bogus -o out.exr
command-misspelt!: in/rgb.exr --resiz 32x24 -o out.exr
file-missing!: nosuch.exr -o out.exr
file-missing-second!: in/rgb.exr -o first.exr nosuch.exr --add -o out.exr
file-no-image!: in/text.exr -o out.exr
file-no-format!: in/words.txt -o out.exr
file-cut-short!: in/cut_short.exr -o out.exr
file-cut-short-changed!: in/cut_short.exr --mulc 2 -o out.exr
file-cut-short-printed!: in/cut_short.exr --printstats
file-cut-short-info: --info -v in/cut_short.exr
folder-missing!: in/rgb.exr -o nowhere/out.exr
format-unknown!: in/rgb.exr -o out.nosuch
type-unknown!: in/rgb.exr -d nosuch -o out.exr
type-of-channel-unknown: in/rgb.exr -d R=nosuch -o out.exr
resize-geometry!: in/rgb.exr --resize abc -o out.exr
resize-filter!: in/rgb.exr --resize:filter=nosuch 32x24 -o out.exr
resample-geometry!: in/rgb.exr --resample abc -o out.exr
fit-geometry!: in/rgb.exr --fit abc -o out.exr
fit-fillmode: in/rgb.exr --fit:fillmode=nosuch 32x24 -o out.exr
crop-geometry!: in/rgb.exr --crop abc -o out.exr
cut-geometry!: in/rgb.exr --cut abc -o out.exr
create-geometry!: --create abc 3 -o out.exr
create-channels: --create 32x24 abc -o out.exr
pattern-name: --pattern nosuch 32x24 3 -o out.exr
pattern-geometry!: --pattern black abc 3 -o out.exr
kernel-name!: --kernel nosuch 3x3 -o out.exr
kernel-geometry!: --kernel gaussian abc -o out.exr
paste-geometry!: in/rgb.exr in/rgb2.exr --paste abc -o out.exr
mosaic-geometry!: in/rgb.exr in/rgb2.exr --mosaic abc -o out.exr
origin-geometry!: in/rgb.exr --origin abc -o out.exr
cshift-geometry!: in/rgb.exr --cshift abc -o out.exr
blur-geometry!: in/rgb.exr --blur abc -o out.exr
blur-kernel!: in/rgb.exr --blur:kernel=nosuch 3x3 -o out.exr
unsharp-kernel!: in/rgb.exr --unsharp:kernel=nosuch -o out.exr
median-geometry!: in/rgb.exr --median abc -o out.exr
warp-matrix!: in/rgb.exr --warp 1,2,3 -o out.exr
warp-filter!: in/rgb.exr --warp:filter=nosuch 1,0,0,0,1,0,0,0,1 -o out.exr
rotate-filter!: in/rgb.exr --rotate:filter=nosuch 30 -o out.exr
ccmatrix-count!: in/rgb.exr --ccmatrix 1,2,3 -o out.exr
colormap-name!: in/grey.exr --colormap nosuch -o out.exr
colormap-count!: in/grey.exr --colormap 0,0 -o out.exr
subimage-name!: in/parts.exr --subimage nosuch -o out.exr
subimage-number!: in/parts.exr --subimage 9 -o out.exr
selectmip-number!: in/mip.exr --selectmip 20 -o out.exr
unmip-deep: in/deep.exr --unmip -o out.exr
swap-no-file!: in/rgb.exr nosuch.exr --swap -o out.exr
pop-no-file!: nosuch.exr --pop in/rgb.exr -o out.exr
ch-empty!: in/rgb.exr --ch "" -o out.exr
windows-of-parts!: -a in/parts.exr --minchan -o out.exr
over-without-alpha!: in/rgb.exr in/rgb2.exr --over -o out.exr
zover-without-depth!: in/rgba.exr in/rgba2.exr --zover -o out.exr
deepmerge-flat!: in/rgb.exr in/rgb2.exr --deepmerge -o out.exr
deepholdout-flat!: in/rgb.exr in/rgb2.exr --deepholdout -o out.exr
fixnan-error!: in/nan.exr --fixnan error -o out.exr
diff-missing!: in/rgb.exr nosuch.exr --diff
diff-deep-flat!: in/rgb.exr in/deep.exr --diff
colorspace-unknown!: in/rgb.exr --tocolorspace nosuch -o out.exr
colorconvert-unknown!: in/rgb.exr --colorconvert nosuch sRGB -o out.exr
colorconfig-missing!: --colorconfig nosuch.ocio in/rgb.exr --tocolorspace ACEScg -o out.exr
ociodisplay-unknown!: --colorconfig in/ocio/tonetool.ocio in/rgb.exr
    --ociodisplay nosuch "ACES SDR" -o out.exr
ociodisplay-view!: --colorconfig in/ocio/tonetool.ocio in/rgb.exr
    --ociodisplay sRGB nosuch -o out.exr
ociodisplay-empty!: --colorconfig in/ocio/tonetool.ocio in/rgb.exr --ociodisplay "" "" -o out.exr
ociolook-unknown!: --colorconfig in/ocio/tonetool.ocio in/rgb.exr --ociolook nosuch -o out.exr
ociofiletransform-missing!: in/rgb.exr --ociofiletransform nosuch.ctf -o out.exr
iccread-missing!: in/rgb.exr --iccread nosuch.icc -o out.exr
iccwrite-none!: in/rgb.exr --iccwrite out.icc
text-font!: in/rgb.exr --text:font=/nosuch.ttf Slate -o out.exr
missingfile-policy!: --missingfile nosuch in/rgb.exr nosuch.exr --add -o out.exr
otex-missing!: nosuch.exr -otex out.exr
oenv-missing!: nosuch.exr -oenv out.exr
obump-missing!: nosuch.exr -obump out.exr
list-formats-then!: --list-formats nosuch.exr --printinfo
version-then!: --version nosuch.exr
capture!: --capture -o out.exr
capture-camera!: --capture:camera=7 -o out.exr
help-unknown!: --help --bogus
flags-input!: --v --a --native --autoorient nosuch.exr -o out.exr
flags-output!: --q --n --u --no-clobber nosuch.exr -o out.exr
flags-color!: --no-autopremult --autopremult --autocc --noautocc --metamerge nosuch.exr -o out.exr
flags-language!: --wildcardoff --wildcardon --evaloff --evalon --skip-bad-frames nosuch.exr
flags-write!: --scanline --dither --adjust-time --noautocrop --autotrim --nosoftwareattrib
    --sansattrib nosuch.exr -o out.exr
flags-metadata!: in/rgb.exr --clear-keywords --orientcw --orientccw --orient180 --fullpixels
    nosuch.exr -o out.exr
flag-info!: --info nosuch.exr
flag-stats!: --stats nosuch.exr
flag-hash!: --hash nosuch.exr
flag-dumpdata!: --dumpdata nosuch.exr
flag-debug!: --debug nosuch.exr
flag-runstats!: --runstats nosuch.exr
flag-no-error-exit!: --no-error-exit nosuch.exr in/rgb.exr -o out.exr
"""

CAPTURE = {"without": r"^\[ WARN", "reason": "the camera library tells the time in its warnings"}

UNKNOWN_TYPE = {"within": 1e9, "reason": "oiiotool writes memory that it never set as the channel"}

CASES = table("error", "\n".join(MISSING + DEEP_ONE + DEEP_TWO + CUT) + ERRORS,
              capture=CAPTURE, capture_camera=CAPTURE, flag_runstats=RUNSTATS,
              version_then=VERSION, diff_deep_flat=NOT_COMPARED,
              type_of_channel_unknown=UNKNOWN_TYPE)
