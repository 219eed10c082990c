# SPDX-License-Identifier: BSD-3-Clause
"""What another version of oiiotool does otherwise than the one that the cases were written for.

A case that is listed must differ, in what its row says; any other must not. src/doc/building.md shows
the rows, as table() makes them."""

import re
import subprocess
from dataclasses import dataclass

import pytest

WRITTEN_FOR = (2, 4)    # what tonetool --compat is like, with every version of the library

TEXT = "text"           # what is printed
RESULT = "result"       # exit status, files, images; maybe what is printed as well


@dataclass(frozen=True)
class Difference:
    since: tuple        # (major, minor) of OpenImageIO
    kind: str
    reason: str         # what oiiotool does since then, for the page
    names: str          # of the cases
    before: tuple = (99, 0)     # the first version of which it is not true any more

    def cases(self):
        return self.names.split()


DIFFERENCES = (
    Difference((2, 5), TEXT, "`--diff` prints the largest error and the values with all their digits",
               """diff-close diff-far diff-early diff-fail-larger diff-warn diff-failpercent
               diff-failpercent-low diff-hardfail diff-hardwarn diff-warnpercent-low
               diff-after-the-command diff-all-parts diff-part-count diff-sizes diff-deep diff-nan
               diff-integers diff-quiet diff-sequence"""),
    Difference((2, 5), TEXT, "`--pdiff` prints so as well, without the counts of pixels over the limits, "
               "and counts as output of the command line",
               """diff-pdiff-same diff-pdiff-close diff-pdiff-far diff-pdiff-fail
               diff-pdiff-parts"""),
    Difference((2, 5), RESULT, "`--diff` of a deep and a flat image prints `PASS` and ends with status 0",
               "error-diff-deep-flat", before=(3, 1)),
    Difference((2, 5), RESULT, "without `-d` a file has the data type of the channels of its own inputs, "
               "not the widest type that was read",
               """arith-add-float-to-half channel-ch-layer channel-ch-rename channel-ch-mixed-types
               channel-chappend-three channel-all-channels-kept channel-all-channels-native
               deep-deep-pastemeta stack-stack-depth write-type-of-first turn-st-warp
               turn-st-warp-filter turn-st-warp-channels turn-st-warp-flips turn-st-warp-all
               composite-paste-all aovs"""),
    Difference((2, 5), RESULT, "a frame that cannot be read does not end the sequence: the next ones "
               "are written",
               "frames-hole frames-broken"),
    Difference((2, 5), TEXT, "nor does one that is missing: the error is told for each frame",
               "frames-padding-missing frames-no-file"),
    Difference((2, 5), RESULT, "a file that could not be written stays there, unfinished and under a name "
               "of its own",
               "error-windows-of-parts"),
    Difference((2, 5), TEXT, "errors that nobody asked for are printed when an image is let go of, here of a "
               "file that is cut short",
               """error-cut-short-trim error-cut-short-siappend error-cut-short-siappendall
               error-cut-short-sisplit"""),
    Difference((2, 5), TEXT, "warnings of `--ch` name no program and are not moved by `--nostderr`; "
               "`--autocc` prints them too",
               "channel-ch-unknown hidden-nostderr-warning written-autocc-parts"),
    Difference((2, 5), TEXT, "the warning of channels that a format cannot hold says `saving only channels "
               "R,G,B`",
               "read-alpha-to-jpeg written-autocc-unpremult"),
    Difference((2, 5), TEXT, "`--runstats` has lines about the memory and the reads of images",
               "error-flag-runstats print-runstats print-runstats-two"),
    Difference((2, 5), TEXT, "`--printinfo:native=1` prints what is in the file",
               "printed-printinfo-native printed-printinfo-mips"),
    Difference((2, 5), TEXT, "`{NIMAGES}` and `{TOP.nativeformat}` have values",
               "expression-later-names"),
    Difference((3, 1), RESULT, "so have `{TOP.SUBIMAGES}`, `{TOP.IS_CONSTANT}` and `{TOP.IS_BLACK}`",
               "expression-later-names expression-image-constant"),
    Difference((3, 1), RESULT, "an image that an expression asks about is written as the floats that it was "
               "read as",
               """arith-constant-from-image window-crop-expression resample-resize-expression
               expression-as-argument control-if-image control-else-image control-while-image"""),
    Difference((3, 1), RESULT, "`--autocc` and `-i:ch=` keep the data type of the file",
               "color-autocc-config read-input-channels-order"),
    Difference((3, 1), RESULT, "`--tocolorspace` of an image that names no space takes it for the role "
               "`scene_linear`, which is ACEScg in the configuration of OpenColorIO",
               """color-tocolorspace color-tocolorspace-alpha color-tocolorspace-unpremult
               color-tocolorspace-parts"""),
    Difference((3, 1), RESULT, "`-o:tile=` sets no tiles: it is taken for an origin",
               "write-tile-modifier write-output-all-options"),
    Difference((3, 1), TEXT, "so it is of textures, which keep theirs",
               "written-oenv-output written-obump-output written-otex-output"),
    Difference((3, 1), RESULT, "`--missingfile black` and `checker` warn, and the status is 0",
               """frames-hole-black frames-hole-black-first frames-hole-checker read-missing-black
               read-missing-checker"""),
    Difference((3, 1), RESULT, "`--label` and `--set` take names of letters, digits and `_` alone",
               "stack-label-wins taken-var-colon"),
    Difference((3, 1), RESULT, "`--pastemeta` leaves the windows of the image",
               "composite-pastemeta composite-pastemeta-late"),
    Difference((3, 1), TEXT, "`--for` counts down with a negative step", "control-for-none"),
    Difference((3, 1), RESULT, "a pattern without a frame is read as a name", "frames-no-match"),
    Difference((3, 1), TEXT, "the error of a file that is cut short names it, and is the only one",
               """error-cut-short-printstats error-file-cut-short-printed error-cut-short-chsum
               error-cut-short-croptofull error-cut-short-reorient error-cut-short-transpose
               error-cut-short-fft error-cut-short-maxchan error-cut-short-minchan
               error-cut-short-deepen error-cut-short-chappend error-cut-short-pastemeta
               error-cut-short-unmip error-cut-short-flatten error-cut-short-dup
               error-cut-short-printinfo error-file-cut-short error-file-cut-short-changed
               frames-broken-skipped frames-broken-chain-skipped"""),
    Difference((3, 1), TEXT, "errors of folders and files that are not there have other words",
               "error-folder-missing error-flags-color"),
    Difference((3, 1), TEXT, "`--capture` is left to OpenCV (tonetool reads no camera with this version)",
               "error-capture error-capture-camera"),
    Difference((3, 1), TEXT, "`--debug` tells when the colour configuration is read",
               "print-debug print-debug-two"),
    Difference((3, 1), TEXT, "`-d` is not overruled by the colour space of a file's name, which tonetool warns of",
               "dailies"),
)

# What oiiotool takes since then, and tonetool does not: commands, and modifiers as COMMAND:NAME.
NOT_TAKEN = {
    (2, 5): """buildinfo colorconfiginfo normalize normalize:incenter normalize:outcenter
        normalize:scale ociodisplay:inverse resize:from resize:to resize:edgeclamp""",
    (3, 1): """cicp create-dir cryptomatte-colors demosaic demosaic:algorithm demosaic:layout
        demosaic:pattern demosaic:white_balance eraseattrib:fromfile experimental gpu gpu:device
        i:get_thumbnail i:native layersplit nchannels obump:bumpinverts obump:bumpinvertt
        obump:bumprange obump:bumpscale obump:slopefilter ocionamedtransform
        ocionamedtransform:inverse ocionamedtransform:key ocionamedtransform:unpremult
        ocionamedtransform:value pastemeta:merge pastemeta:pattern popbottom scale stackclear
        stackextract stackreverse testread thumbnail-get thumbnail-get:fail thumbnail-get:index
        thumbnail-set""",
}


def version_of(program):
    """(major, minor) of oiiotool."""
    said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    return tuple(map(int, re.match(r"(\d+)\.(\d+)", said).groups()))


def expected(name, version, rows=None):
    """The row of a case with a version of oiiotool, or None. Older versions' rows stay valid until a newer
    one has the case, too."""
    valid = [row for row in (DIFFERENCES if rows is None else rows)
             if row.since <= version < row.before and name in row.cases()]
    return max(valid, key=lambda row: row.since, default=None)


def not_taken(version):
    """The commands, and the (command, modifier) pairs, that are only oiiotool's."""
    words = [word for since, words in NOT_TAKEN.items() if version >= since
             for word in words.split()]
    return ({word for word in words if ":" not in word},
            {tuple(word.split(":")) for word in words if ":" in word})


def is_text(found):
    """Whether a difference that differences() found is one of printed text."""
    return found.startswith(("stdout differs", "stderr differs"))


def judge(name, found, version, rows=None):
    """Fails a case that differs without being listed, or is listed and does not differ so; an
    expected difference is reported as such."""
    row = expected(name, version, rows)
    if row is None:
        return found
    kind = TEXT if all(map(is_text, found)) else RESULT
    if not found:
        return [f"versions.py says that this differs since {row.since}: {row.reason}"]
    if kind != row.kind:
        return [f"versions.py says that the {row.kind} differs, it is the {kind}:", *found]
    pytest.xfail(row.reason)


def table():
    """The rows as a table of the page."""
    lines = ["| since | what | with oiiotool of that version | cases |", "|---|---|---|---|"]
    for row in DIFFERENCES:
        since = ".".join(map(str, row.since))
        since += f", before {'.'.join(map(str, row.before))}" if row.before[0] < 99 else ""
        lines.append(f"| {since} | {row.kind} | {row.reason} | {len(row.cases())} |")
    return "\n".join(lines)


def table_of_commands():
    """The same of what it takes."""
    lines = ["| since | commands and modifiers that are only oiiotool's |", "|---|---|"]
    for since, words in NOT_TAKEN.items():
        named = ("`--" + word + ("=`" if ":" in word else "`")
                 for word in words.split())
        lines.append(f"| {'.'.join(map(str, since))} | {', '.join(named)} |")
    return "\n".join(lines)
