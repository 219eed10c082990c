# SPDX-License-Identifier: BSD-3-Clause
"""What README and guides claim to be within a bound, or to be done by another program, is so."""

import re
import shutil
import subprocess

import markdown
import pytest

OCIO = (markdown.ROOT / "src" / "doc" / "ocio.md").read_text(encoding="utf-8")
ROWS = [".clf` of a curve", ".spi1d`, and", ".ctf`", "largest error", "mean error"]


def claimed(row, encoding):
    """The bound in the table of errors of look-up tables."""
    (cells,) = [line.strip("|").split("|") for line in OCIO.splitlines()
                if line.startswith("| `") and row in line and line.count("|") == 4
                and re.search(r"\d \|$", line)]
    return float(cells[1 if encoding == "srgb" else 2])


@pytest.mark.parametrize("encoding", ["srgb", "rec1886"])
def test_errors_of_look_up_tables(encoding, tonetool):
    """No curve exceeds a row, and some curve comes near it."""
    curves = re.findall(r"^(\S+): .*; on \w+$", tonetool("--tonecurves").out, re.M)
    assert len(curves) == 19
    largest = dict.fromkeys(ROWS, 0.0)
    for curve in curves:
        for kind in ("clf", "ctf", "cube"):
            out = tonetool(f"--exportlut:curve={curve}:encode={encoding}", f"lut.{kind}").out
            error, mean = map(float, re.search(r"error max (\S+) mean (\S+)", out).groups())
            if "3D" not in out:
                row = {"clf": ROWS[0], "cube": ROWS[1], "ctf": ROWS[2]}[kind]
                largest[row] = max(largest[row], error)
            elif kind == "cube":
                largest[ROWS[3]] = max(largest[ROWS[3]], error)
                largest[ROWS[4]] = max(largest[ROWS[4]], mean)
    for row, found in largest.items():
        assert 0.5 * claimed(row, encoding) < found <= claimed(row, encoding), row


def stock(name):
    path = shutil.which(name, path="/usr/bin")
    if not path:
        pytest.skip(f"no {name}")

    def run(*words):
        return subprocess.run([path, *map(str, words)], capture_output=True, text=True, check=False,
                              cwd=markdown.ROOT, timeout=120)

    return run


def test_other_programs_pass_a_nan(tonetool, testimages):
    pair = testimages / "nan_center.exr", testimages / "plain.exr"
    assert stock("idiff")(*pair).returncode == 0
    assert stock("oiiotool")(*pair, "--diff").returncode == 0
    ran = tonetool(*pair, "--hdrflip:fail=max=0.9", status=3)
    assert "max 1 " in ran.out and "NaN or Inf" in ran.err


def test_other_programs_compare_all_channels_at_once(tonetool, pair):
    for done in (stock("idiff")(*pair), stock("oiiotool")(*pair, "--diff")):
        assert done.returncode != 0 and "ViewLayer.Emit" in done.stdout
    assert "ViewLayer.Combined" in tonetool(*pair, "--hdrflip").out


def test_other_programs_compare_numbers_in_whatever_primaries(tonetool, testimages):
    same = testimages / "rec709.exr", testimages / "acescg.exr"
    assert stock("idiff")(*same).returncode != 0
    assert stock("oiiotool")(*same, "--diff").returncode != 0
    tonetool(*same, "--hdrflip:fail=max=0.0001")


def test_other_programs_and_sequences(testimages, tmp_path):
    frames = testimages / "anim/ref.#.exr", testimages / "anim/test.#.exr"
    assert stock("idiff")(*frames).returncode != 0 and "Could not read" in stock("idiff")(*frames).stderr
    for number in (1, 3):
        shutil.copy(testimages / f"anim/ref.000{number}.exr", tmp_path)
    missing = stock("oiiotool")(frames[0], tmp_path / "ref.#.exr", "--diff")
    assert missing.returncode != 0 and "Not all sequence specifications matched" in missing.stderr
    assert stock("oiiotool")(*frames, "--diff").stdout.count("Computing diff") >= 1


def test_oiiotool_has_no_flip(pair):
    """2.4 has none; from 3.2 on it has --flipdiff."""
    done = stock("oiiotool")("--version")
    if tuple(map(int, re.findall(r"\d+", done.stdout)[:2])) >= (3, 2):
        pytest.skip("this one has it")
    assert stock("oiiotool")(*pair, "--flipdiff").returncode != 0


def test_the_record_of_a_frame_is_small(tonetool, testimages):
    """What --qc keeps for the merge: 13 to 22 kB a frame."""
    ran = tonetool(testimages / "anim/ref.#.exr", "--qc", "--json", "-")
    assert 13_000 < len(ran.out) / 8 < 22_000


def test_the_readme_names_the_noise_floor():
    """The range that it gives is that of the guide's table."""
    guide = (markdown.ROOT / "src/doc/good-numbers.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| \w+, 16 \| (\S+) \| \S+ \| (\S+) \|", guide, re.M)
    assert len(rows) == 3
    for mean, p999 in rows:
        assert 0.2 <= float(mean) <= 0.3 and 0.6 <= float(p999) <= 0.9
