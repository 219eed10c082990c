// SPDX-License-Identifier: BSD-3-Clause
#include "chain/manual/topics.h"

namespace tonetool::chain {

const char* const kExitStatusText =
    R"(0  everything passed
1  an error: bad command line, unreadable file, nothing to compare, a result not written;
   and a --diff or --pdiff that fails
2  only warnings, and --warnings-exit was given
3  a fail= threshold was exceeded, --biascheck found a difference or too few samples, or
   --qc or --against a fault that is an error
)";

namespace {

const char* const kCompare = R"(Comparing a test image with a reference

  tonetool ref.exr test.exr --hdrflip
  tonetool ref.exr test.exr --hdrflip:fail=p99.9=0.7 -o error.exr --colormap magma -o error.png

The reference comes first. HDR-FLIP shows both at several exposures through a tone curve, compares
what a viewer would see, and takes the largest error of each pixel: 0 no visible difference, 1 the
largest. The result is an error map on the image stack, and numbers:

  mean    of the map: how different the images are as a whole; noise raises it, a small fault hardly
  p99.9   a thousandth of the pixels have a larger error: finds what is larger than that
  max     the largest error, and where it is

-v prints every fact, --json FILE writes them, the map has them as FLIP:* attributes.

  layer=NAME        the layer to compare (the beauty, where only one can be it)
  from=SPACE        its colour space (what the file says)
  startExposure=, stopExposure=, numExposures=   in stops (from the reference's luminance)
  ppd=X             pixels per degree of visual angle (67: a 4K screen, 0.7 m wide, at 0.7 m)
  attribute=1       whose error it is: lights, objects (Cryptomatte) and layers that have changed

Others: --ldrflip for display-referred images, --flipdiff with OpenImageIO's option names, --errormap
for SMAPE, PSNR and the like, --filmstrip for a figure, --diff for the values themselves, --tmqi for
a tone-mapped picture. See --help threshold, --help check, --help hdrflip.
)";

const char* const kCheck = R"(Checking a sequence

  tonetool ref.#.exr test.#.exr --against --qc
  tonetool ref.#.exr test.#.exr --hdrflip:exposures=shot:fail=p99.9=0.7 --report check.html
  tonetool test.#.exr --qc --json check.json

# stands for the frame number; frames of both sequences are paired by number, and one that is missing
# or cannot be read does not pass. The last line is the verdict and names the worst frame. Only frames
that fail or warn print a line, with -v each does.

  --report FILE.html   a page to look at: the curve of the error, the worst frames, their pictures
  --json, --csv, --junit FILE   the results for other programs
  --contactsheet FILE  all frames as thumbnails
  --state DIR          a run that was killed goes on where it was
  --jobs N             N frames at a time
  --frames 1-100       the frames that must be there
  --dry-run            only looks whether the line can run and which frames are there
  --merge              joins the results of a farm's tasks, --json files of version 2 (others are
                       refused); tonetool-slurm does it all on Slurm

exposures=shot compares all frames at one range of exposures, so that their errors can be compared.
--biascheck tells noise from a change of the light (--help biascheck).
--against compares every layer with the approved version, the first image, and needs no limits.
--qc looks for faults that need no reference: holes, black and frozen frames, NaN, fireflies, flicker,
odd noise, missing layers; see --help against, --help qc and --help exit.
)";

const char* const kCases = R"(Checking many images by their names

  tonetool refs/%N.exr renders/%N.exr --hdrflip:fail=mean=0.5 --report page.html --junit junit.xml
  tonetool refs/%N.exr out/%M/%N.exr --hdrflip --csv methods.csv
  tonetool renders/%N.exr --qc

%N stands for the name of a case, folders included (hair/long), and %M for a method, without /. Cases
are the union of what both sides have: what one lacks is missing, and does not pass. A name that
stands twice is the same text; # and %V may stand beside it (%N.#.exr). What begins with a dot is left
out, links to folders are followed.

  refs/plain.exr renders/%N.exr   one reference for all; one test for many references is an error
  -o errors/%N.png                an output has each wildcard that differs; its folders are made
  --wildcardoff                   the words after it are plain text, as all are with --compat

A suite file gives cases their own limits, masks and reasons to be skipped, or compares them with the
images that somebody has approved. Only a line of its own approves any, as
tonetool --approve run.json 'hair/*' --reason 'new hair shader'; --approved lists what is approved.

  tonetool --suite suite.toml --json run.json --report page.html
  tonetool --suite suite.toml --only 'hair/*'
  tonetool --approved approved

In a crontab % is written \%, in a .bat file %%N. What holds over time (--qc, fail=auto) holds over the
frames of one name and method; exposures=shot and --bad-frames are of shots alone. See --help check.
)";

const char* const kThreshold = R"(Thresholds: when a comparison fails

  --hdrflip:fail=0.3                       the mean must be at most 0.3
  --hdrflip:fail=p99.9=0.7,mean=0.3        each must hold
  --hdrflip:warn=p99.9=0.6:fail=p99.9=0.7  a warning before it is a failure
  --hdrflip:fail=above0.2=0.001            at most a thousandth of the pixels above 0.2

A quantity is mean, weighted-median, weighted-q1, weighted-q3, min, max, a percentile (p50, p99.95)
or the share of the pixels above an error (above0.2). Without a name it is the first one that the
command has. Of psnr, mpsnr and --tmqi more is better, and a limit is what must be reached.

Noise alone gave a mean of 0.14 to 0.29 and a p99.9 of 0.5 to 0.85 in three scenes, so measure yours:
--noisefloor makes limits from renders of the approved version (--help biascheck). By hand: render a
frame twice with different seeds and compare the two: what they differ by is noise. Set the limit of
the mean a tenth above theirs, that of p99.9 a fifth. p99.9 leaves out a thousandth of the pixels,
45x45 of 1920x1080: for smaller faults add a limit of p99.99.

fail=FILE takes 1.1 times what a check that passed has measured, from its --json; fail=auto judges each
frame of a shot by the others, and never sees what all of them have.

A limit that cannot fail (fail=1 of a map from 0 to 1) is an error; NaN exceeds any limit; where a
limit could not be tested, the check has not passed. Status 3 says that fail= was exceeded.
)";

const char* const kBiascheck = R"(Noise or change?

  tonetool approved.exr test.exr --biascheck
  tonetool a1.exr a2.exr a3.exr a4.exr t1.exr t2.exr t3.exr t4.exr --biascheck:seeds=4:within=0.02
  tonetool approved.#.exr test.#.exr --biascheck:frames=family:inconclusive=warn --json check.json

HDR-FLIP sees noise as an eye does, and cannot see behind it: a noisy render that is 5 % too bright
may have a lower error than an honest one. --biascheck tests whether the light of two renders differs
in more than the noise of their samples, over the picture and in blocks of 16, 32 and 64 pixels. It
wants renders without a denoiser, of different seeds, of 4096 pixels or more. Three verdicts:

  different           beyond chance: alpha= is the rate of false alarms, 1 % of the images. Status 3
  equal               shown to be equal within the margin within=, 5 %, as the line says. Status 0
  not enough samples  neither; it says how many times more are needed. Status 3, unless
                      inconclusive=warn or inconclusive=pass; it is never called passed

Keep a few seeds of the approved version, at the samples per pixel of the tests, and compare as many
of each (seeds=K, or references=K and tests=K): with noise alike on both sides nothing is left
untested. Against a converged reference, or one of more seeds, darker parts may have to stay
untested, since the light of rare paths could be what is missing.

What it cannot know: an error that both sides have; a change that a denoiser has smeared over its
neighbours (more than 30 % is found); one firefly in a whole picture; an object smaller than a block
that changes a little. HDR-FLIP sees small objects, so use both.

  tonetool ref.exr a1.exr a2.exr a3.exr a4.exr --noisefloor limits.json
  tonetool ref.exr test.exr --hdrflip:fail=limits.json

--noisefloor finds limits of HDR-FLIP or --errormap from 4 or more renders of the approved version, so
that at most 1 % of honest renders exceed one (content=0.99), with 95 % confidence. It fails if the
reference is not what the renders converge to: then the baseline is out of date.
)";

const char* const kTonemap = R"(Showing an HDR picture

  tonetool picture.exr --tonemap:curve=agx -o picture.png
  tonetool picture.exr --tonemap:curve=agx:method=mean -o picture.png
  tonetool picture.exr --tonemap:curve=hable:stops=2 -o picture.png
  tonetool picture.exr --tonemap:method=camera:fnumber=16:shutter=0.008:iso=100 -o picture.png
  tonetool picture.exr --cgtmo -o picture.png
  tonetool picture.exr --bloom:threshold=6s --cgtmo -o picture.png

curve= is one of the tone curves that --tonecurves lists; stops= sets the exposure, method=mean
measures it, method=auto its key, too, and method=camera exposes as a camera does, by its settings or
the header's. The last two need to know what a pixel value of 1 is in cd/m2: unit=, else the header's
whiteLuminance, else 1. The result is sRGB-encoded (encode= takes others) and clamped to 0 to 1.
--cgtmo is a local tone mapper for rendered images: position, normal and albedo guide it. --bloom
spreads bright light as the eye does, in linear light: before the tone mapping.
The frames of a shot have one exposure (adapt=shot); adapt=frame, eye, smooth and FILE are others:

  tonetool shot.#.exr --cgtmo -o picture.#.png

A view of an OpenColorIO configuration instead of a curve: --help ocio. --tmqi scores the result.
)";

const char* const kHdr = R"(HDR values, and what becomes of them

Colour        linear; what the file's chromaticities or colour space say, or from=, is converted to
              linear Rec.709 by a matrix and never clipped before the tone curve.
Integers      are decoded from sRGB, or by what the file says, before they are compared.
Negative      values count as 0 and are counted.
NaN, Inf      in one image only: error 1; in both and of the same kind: 0. Counted, with a warning.
Alpha         is ignored, unless alpha=error; that it differs is a warning.
Windows       the union of the data windows is compared; what one image lacks is black. Display
              windows that differ are an error, unless resize=1 or crop=1.
Exposures     the first shows the reference's maximum luminance at 0.85, the last its median.
Stops         exposure by s stops multiplies linear values by 2^s.
)";

const char* const kOcio = R"(OpenColorIO

  tonetool --colorconfig ocio/tonetool.ocio shot.exr --tonemap:display=sRGB:view='ACES SDR' -o shot.png
  tonetool --colorconfig ocio/tonetool.ocio ref.exr test.exr --hdrflip:view='ACES SDR'
  tonetool --exportlut:curve=agx agx.ctf

The configuration is --colorconfig FILE, else $OCIO. --tonemap and --hdrflip take display=, view=,
looks= and context= instead of a tone curve; peak= is the white of an HDR display in cd/m2. --hdrflip
uses a table baked from the view, whose error it prints with -v; exact=1 uses none. The configuration
that comes with tonetool has ACES views and each tone curve as a view, for Nuke, RV or oiiotool.
--exportlut writes a curve or a view as .cube, .spi1d, .spi3d, .clf or .ctf. Conversions as in
oiiotool: --colorconvert, --ociodisplay, --ociolook, --ociofiletransform.
)";

const char* const kRecipes = R"(Recipes: command lines as images

A text file *.tone with the first line "tonetool 1", then a command line, is an image: the top of the
stack when the line has run.

  tonetool 1
  # The error of a rendered pair, with its own name for the shot.
  $shot = gallery
  ${shot}_ref.exr ${shot}_test.exr --hdrflip

  tonetool error.tone -o error.exr
  tonetool 'error.tone?shot=cornell' -o error.exr

With the plugin a program that uses the same version of OpenImageIO as a library reads recipes, too:
oiiotool, iinfo, maketx. --doctor says whether it is found. A recipe only reads; relative names are
relative to it.
)";

const char* const kExit = R"(Exit status

%

An error is never reported as a pass; of several statuses an error counts most, then 3, then 2. In a
sequence the worst frame counts: one that is missing, unreadable, of another size or whose threshold
could not be tested is an error. --compat: 1 for all failures, as oiiotool has it. Ctrl-C, TERM and HUP
end a check with 130, 143 and 129: no result is written, and --state has kept the finished frames.
)";

} // namespace

const std::vector<Topic>& topics() {
    static const std::vector<Topic> all = {
        {"compare", "a test image with a reference", kCompare},
        {"check", "a sequence of frames, with or without a reference", kCheck},
        {"cases", "many images by their names", kCases},
        {"threshold", "limits: what fails, and how to find a number", kThreshold},
        {"biascheck", "noise or change: what HDR-FLIP cannot see", kBiascheck},
        {"tonemap", "show an HDR picture on a display", kTonemap},
        {"hdr", "colour spaces, NaN, negative values, windows, alpha", kHdr},
        {"ocio", "views, displays and LUTs", kOcio},
        {"recipes", "command lines that other programs read as images", kRecipes},
        {"exit", "what the exit status means", kExit},
    };
    return all;
}

const Topic* find_topic(const std::string& name) {
    for (const Topic& topic : topics())
        if (name == topic.name)
            return &topic;
    return nullptr;
}

} // namespace tonetool::chain
