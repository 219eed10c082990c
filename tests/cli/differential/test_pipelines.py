# SPDX-License-Identifier: BSD-3-Clause
"""Ten chains as productions write them, on sequences of twenty frames."""

import pytest
from case import Case
from conftest import FONT

CONFIG = "--colorconfig in/ocio/tonetool.ocio"

DAILIES = f"""
    --frames 1-20 {CONFIG} --autocc in/seq.#.exr --resize:filter=lanczos3 64x48
    --ociodisplay:from=ACEScg sRGB 'ACES SDR'
    --box:color=0,0,0:fill=1 0,38,63,47
    --text:x=2:y=45:size=8:font={FONT}:color=1,1,1 'sh010 {{FRAME_NUMBER_PAD}}'
    --text:x=62:y=45:size=8:font={FONT}:xalign=right '{{TOP.width}}x{{TOP.height}}'
    --attrib:type=timecode smpte:TimeCode 01:00:00:00 -d uint8 --compression jpeg:90
    -o dailies.#.jpg
"""

DISPLAY = f"""
    --frames 1-20 {CONFIG} in/seq.%04d.exr --iscolorspace ACEScg --ociodisplay sRGB 'ACES SDR'
    --clamp:min=0:max=1 -d uint16 --dither -o view.%04d.png
"""

SHEET = """
    in/seq.0001.exr in/seq.0005.exr in/seq.0009.exr in/seq.0013.exr in/seq.0017.exr
    in/seq.0020.exr --mosaic:pad=2:fit=32x24 3x2 --fullpixels --box:color=1,0,0 0,0,99,49
    -o:datatype=uint8 sheet.png
"""

AOVS = """
    --frames 1-20 in/layers.exr --label all --ch R,G,B,A --attrib frame {FRAME_NUMBER}
    --nosoftwareattrib -o beauty.#.exr all --ch R=diffuse.R,G=diffuse.G,B=diffuse.B
    -d half --compression zips -o diffuse.#.exr all --ch Z -d float -o depth.#.exr
"""

STEREO = """
    --views left,right in/stereo.%V.#.exr --fit:pad=1 48x48 --flop
    -d half --compression dwaa:60 -o eyes.%V.#.exr
"""

PROXIES = """
    --frames 1-20 in/seq.#.exr --fit:filter=lanczos3:highlightcomp=1 16x16 --fullpixels
    --eraseattrib 'render.*' --caption 'proxy of {TOP.filename}' -o proxy.#.jpg
    --pop in/bg.#.exr --unpremult --ch R,G,B --resize 50% --premult -o bg.#.tif
"""

REPACK = """
    --frames 1-20 --native in/seq.#.exr -d half --tile 16 16 --compression zip --attrib owner me
    --sattrib 'version' 'v{FRAME_NUMBER}' --keyword repacked -o packed.#.exr
    --scanline --compression piz -o lines.#.exr
"""

HOLES = """
    --skip-bad-frames --frames 1-20 in/holes.#.exr in/seq.#.exr --absdiff --maxchan
    --if "{TOP.MAXCOLOR > 0}" --mulc 100 --endif --colormap viridis -o error.#.png
"""

COMPOSITE = """
    --frames 1-20 in/bg.#.exr --premult --dup --blur 5x5 --over in/seq.#.exr --ch R,G,B,A=1 --over
    --crop 4,2,27,21 --croptofull --fixnan box3 --saturate 0.9 --contrast:black=0.01:white=1.5
    --rangecompress --resize 24x18 --rangeexpand --clamp:min=0 -d half -o comp.#.exr
"""

CHECK = """
    --fail 0.004 --failpercent 1 --hardfail 0.1 --warn 0.002 --frames 1-20 in/seq.#.exr
    --dup --addc 0.001 --diff --echo "frame {FRAME_NUMBER}: {TOP.AVGCOLOR}" --rangecheck 0 1.9
    --printstats
"""

PIPELINES = [Case(name, " ".join(line.split()), status)
             for name, line, status in (
                 ("dailies", DAILIES, 0), ("display", DISPLAY, 0), ("sheet", SHEET, 0),
                 ("aovs", AOVS, 0), ("stereo", STEREO, 0), ("proxies", PROXIES, 0),
                 ("repack", REPACK, 0), ("holes", HOLES, 1), ("composite", COMPOSITE, 0),
                 ("check", CHECK, 0))]


@pytest.mark.parametrize("case", PIPELINES, ids=lambda case: case.name)
def test_pipeline_is_identical(assert_identical, case):
    assert_identical(case)
