# SPDX-License-Identifier: BSD-3-Clause
"""--images, what --junit and --ctest say of them, and --ctest itself."""

import os
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from base64 import b64decode
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

MSE = "--errormap:metric=mae:print=0:fail=max=0.2"
FLIP = "--hdrflip:print=0:fail=mean=0.3"
KINDS = ("error", "reference", "test")


@pytest.fixture
def suite(tmp_path, make_image):
    """One case passes, one fails, one is missing."""
    for side in "rt":
        (tmp_path / side / "hair").mkdir(parents=True)
        make_image(f"{side}/cornell.exr", 4, 4)
        make_image(f"{side}/hair/long.exr", 6, 4, pixels=step(side == "t"))
    make_image("r/plane.exr", 4, 4)
    return tmp_path


WORDS = ["r/%N.exr", "t/%N.exr", MSE, "-q"]


def step(other):
    """The second column of the test is red."""
    pixels = np.full((4, 6, 3), 0.2)
    if other:
        pixels[:, 1] = (0.9, 0, 0)
    return pixels


def images(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def of(*names):
    return sorted(f"{name}.{kind}.png" for name in names for kind in KINDS)


def pixels_of(path):
    image = oiio.ImageInput.open(str(path))
    assert image.spec().format == oiio.UINT8 and image.spec().nchannels == 3
    return image.read_image(oiio.UINT8)


def test_what_did_not_pass(tonetool, suite):
    tonetool(*WORDS, "--images", "out/png", "--junit", "j.xml", status=1)
    assert images(suite / "out") == [f"png/{name}" for name in of("hair/long")]
    test, reference, error = (pixels_of(suite / f"out/png/hair/long.{kind}.png")
                              for kind in ("test", "reference", "error"))
    assert test.shape == reference.shape == error.shape == (4, 6, 3)
    assert (test[:, 1, 0] > 200).all() and (test[:, 1, 1] == 0).all()
    assert (reference == reference[0, 0]).all() and (test[:, 2:] == reference[:, 2:]).all()
    assert tuple(error[0, 0]) == (0, 0, 4)  # magma at 0
    assert error[0, 1].min() > 100  # and at the largest
    (case,) = [one for one in ElementTree.parse(suite / "j.xml").iter("testcase")
               if one.get("name") == "hair/long"]
    assert [one.tag for one in case] == ["failure", "system-out"]
    assert case.find("system-out").text.splitlines() == [
        f"[[ATTACHMENT|out/png/hair/long.{kind}.png]]" for kind in ("error", "test", "reference")]
    assert (suite / "j.xml").read_text().count("ATTACHMENT") == 3


def test_the_exposure_of_the_worst_pixel(tonetool, tmp_path, make_image):
    """A dark pixel whose error shows only where the picture is bright."""
    pixels = np.full((12, 16, 3), 1.0)
    pixels[:8] = 0.001
    make_image("r.exr", pixels=pixels)
    pixels[2:6, 2:6] = 0.004
    make_image("t.exr", pixels=pixels)
    tonetool("r.exr", "t.exr", "--hdrflip:fail=max=0.01:print=0", "--images", "out", status=3)
    assert images(tmp_path / "out") == of("t")
    assert pixels_of(tmp_path / "out/t.reference.png")[8:].min() == 255  # far too bright
    dark = pixels_of(tmp_path / "out/t.test.png")
    assert dark[3, 3, 0] > dark[0, 0, 0] + 30


@pytest.mark.parametrize("jobs", [(), ("--parallel-frames", "--jobs", "2")])
def test_names(tonetool, tmp_path, make_image, jobs):
    for frame in (7, 8):
        for side in "rt":
            for view in ("left", "right"):
                make_image(f"{side}.{view}.{frame:03}.exr", 6, 4, pixels=step(side == "t" and frame == 8))
    for side in ("r", "o/a@1", "o/b", "r2", "t2"):
        (tmp_path / side).mkdir(parents=True, exist_ok=True)
        make_image(f"{side}/50% [x].exr", 6, 4, pixels=step(side[0] in "ot"))
        make_image(f"{side}/w.0003.exr", 6, 4, pixels=step(side[0] in "ot"))
    two = "--views", "left,right"
    tonetool(*two, *jobs, "r.%V.%03d.exr", "t.%V.%03d.exr", MSE, "--images", "i", status=3)
    assert images(tmp_path / "i") == of("008@left", "008@right")
    tonetool(*jobs, "r/%N.exr", "o/%M/%N.exr", MSE, "--images", "m/", status=3)
    case, other = "50%25 %5bx%5d", "w.0003"
    assert images(tmp_path / "m") == of(*(f"{name}@{method}" for name in (case, other)
                                          for method in ("a%401", "b")))
    tonetool(*jobs, "r2/%N.#.exr", "t2/%N.#.exr", MSE, "--images", "f", status=3)
    assert images(tmp_path / "f") == of("w@0003")


def test_long_names_are_cut_and_differ(tonetool, suite):
    for end in "ab":
        for side in "rt":
            shutil.copy(suite / side / "hair/long.exr", suite / side / ("ö" * 120 + end + ".exr"))
    tonetool(*WORDS, "--images", "out", status=1)
    found = [name for name in images(suite / "out") if name.startswith("ö" * 90 + "@")]
    assert len(found) == 6 and len({name.split(".")[0] for name in found}) == 2


def test_no_image_of_an_earlier_run_remains(tonetool, suite):
    (suite / "out").mkdir()
    shutil.copy(suite / "r/cornell.exr", suite / "out/cornell.test.png")  # somebody else's
    tonetool(*WORDS, "--images", "out", status=1)
    mine = suite / "out/gone.test.png"  # of a case that this check does not have
    shutil.copy(suite / "out/hair/long.test.png", mine)
    shutil.copy(suite / "r/hair/long.exr", suite / "t/hair/long.exr")
    tonetool(*WORDS, "--images", "out", "--junit", "j.xml", status=1)
    assert images(suite / "out") == ["cornell.test.png", "gone.test.png"]
    assert "ATTACHMENT" not in (suite / "j.xml").read_text()


def test_of_a_case_that_cannot_be_compared_any_more(tonetool, suite):
    tonetool(*WORDS, "--images", "out", status=1)
    (suite / "t/hair/long.exr").unlink()
    tonetool(*WORDS, "--images", "out", status=1)
    assert not images(suite / "out")


def test_a_kept_result_has_its_images(tonetool, suite):
    line = [*WORDS, "--state", "st", "--images", "out"]
    tonetool(*line, status=1)
    whole = {name: (suite / "out" / name).read_bytes() for name in images(suite / "out")}
    times = [os.stat(suite / "out" / name).st_mtime_ns for name in whole]
    tonetool(*line, status=1)
    assert times == [os.stat(suite / "out" / name).st_mtime_ns for name in whole]
    (suite / "out/hair/long.test.png").unlink()
    tonetool(*line, status=1)
    assert whole == {name: (suite / "out" / name).read_bytes() for name in images(suite / "out")}


def test_parts(tonetool, suite):
    (suite / "r/plane.exr").unlink()
    tonetool(*WORDS, "--json", "j.json", "--images", "out", status=3)
    tonetool("--merge", "j.json", "--images", "out", "--junit", "j.xml", status=3)
    assert (suite / "j.xml").read_text().count("[[ATTACHMENT|out/hair/long") == 3
    ran = tonetool("--merge", "j.json", "--images", "other", "--junit", "j.xml", status=3)
    assert "WARNING: --images: none of 1 that did not pass in \"other\"" in ran.err
    assert "ATTACHMENT" not in (suite / "j.xml").read_text() and not (suite / "other").exists()


def test_faults_and_limits_that_are_found_at_the_end(tonetool, tmp_path, make_image):
    """The images of all frames must be there until then, and only these after."""
    for frame in range(1, 13):
        for side in "rt":
            pixels = step(False)
            if side == "t":
                pixels = pixels + 0.001 * frame + (0.5 if frame == 5 else 0)
            make_image(f"{side}.{frame:04}.exr", 6, 4, pixels=pixels)
    tonetool("r.#.exr", "t.#.exr", "--errormap:metric=mae:print=0:fail=auto", "--images", "out", status=3)
    assert images(tmp_path / "out") == of("0005")
    make_image("t.0009.exr", 6, 4, pixels=np.where(np.arange(3) == 1, np.nan, step(True)))
    tonetool("t.#.exr", "--qc", "--images", "qc", status=3)
    assert "0009.test.png" in images(tmp_path / "qc")
    assert (pixels_of(tmp_path / "qc/0009.test.png") == (255, 0, 255)).all()


def test_no_images(tonetool, suite):
    tonetool(*WORDS, "-n", "--images", "out", status=1)
    tonetool(*WORDS, "--dry-run", "--images", "out", status=0)
    assert not (suite / "out").exists()
    (suite / "file").write_text("")
    assert "cannot make the folder" in tonetool(*WORDS, "--images", "file/x", status=1).err
    (suite / "out/hair/long.test.png").mkdir(parents=True)
    ran = tonetool(*WORDS, "--images", "out", "--json", "j.json", status=1)
    assert "ERROR: --images: " in ran.err and "is a directory" in ran.err
    for name in ("x.test", "y"):
        shutil.copy(suite / "r/cornell.exr", suite / f"t/{name}.png")
    tonetool("t/y.png", "t/x.test.png", MSE, "--images", "t")  # that would be t/x.test.test.png
    ran = tonetool("r/%N.exr", "t/%N.test.png", MSE, "--images", "t", status=1)
    assert '"t/cornell.test.png" is read, and would be written over' in ran.err


def test_names_of_junit_are_unique(tonetool, tmp_path, make_image):
    names = ["a\x01", "a\x02"]
    for side in ("r", "t"):
        (tmp_path / side).mkdir()
        for name in names:
            make_image(f"{side}/{name}.exr", 4, 4)
    tonetool("r/%N.exr", "t/%N.exr", MSE, "--junit", "j.xml")
    found = [one.get("name") for one in ElementTree.parse(tmp_path / "j.xml").iter("testcase")]
    assert found == ["a\ufffd", "a\ufffd (2)"]


# ---- CTest

def lines_of(ran):
    return [line for line in ran.out.splitlines() if line.startswith("<CTest")]


def test_the_lines_of_the_design(tonetool, tmp_path, testimages):
    """To the byte, but for the number."""
    for side in ("ref", "test"):
        (tmp_path / side).mkdir()
        shutil.copy(testimages / f"gallery_{side}.exr", tmp_path / side / "gallery.exr")
    ran = tonetool("ref/%N.exr", "test/%N.exr", "--hdrflip:fail=mean=0.1", "--ctest", "--images",
                   "out", status=3)
    (number,) = re.findall(r"mean (\S+) > 0.1", ran.out.splitlines()[0])
    golden = Path(os.environ.get("SHARED_DIR", "")) / "golden/suites/ci/ctest.txt"
    wanted = golden.read_text() if golden.exists() else pytest.skip("no goldens here")
    wanted = wanted.replace("0.364424", number).replace("0.3<", "0.1<").replace("/abs", str(tmp_path))
    assert "\n".join(lines_of(ran)) + "\n" == wanted
    for file in re.findall(r">(/.*?)<", wanted):
        assert Path(file).is_file()


def test_several_cases(tonetool, suite):
    shutil.copy(suite / "t/hair/long.exr", suite / "t/plane & <sons>.exr")
    ran = tonetool(*WORDS, "--ctest", "--images", "out", status=1)
    start = "<CTestMeasurement type="
    at = suite / "out/hair"
    assert lines_of(ran) == [
        f'{start}"numeric/double" name="cornell/errormap.max">0</CTestMeasurement>',
        f'{start}"text/string" name="cornell/verdict">passed</CTestMeasurement>',
        f'{start}"numeric/double" name="hair/long/errormap.max">0.366667</CTestMeasurement>',
        f'{start}"text/string" name="hair/long/verdict">failed: errormap: max 0.366667 &gt; 0.2</CTestMeasurement>',
        f'{start}"text/string" name="plane/verdict">missing: no test &quot;t/plane.exr&quot;</CTestMeasurement>',
        f'{start}"text/string" name="plane &amp; &lt;sons&gt;/verdict">missing: no reference '
        '&quot;r/plane &amp; &lt;sons&gt;.exr&quot;</CTestMeasurement>',
        *(f'<CTestMeasurementFile type="image/png" name="{name}">{at}/long.{kind}.png</CTestMeasurementFile>'
          for name, kind in (("TestImage", "test"), ("ValidImage", "reference"),
                             ("DifferenceImage2", "error")))]
    assert ran.out.index("check: missing") < ran.out.index("<CTest")


def test_ctest_takes_them(program, suite):
    ctest = shutil.which("ctest") or pytest.skip("no ctest here")
    line = " ".join(f'"{word}"' for word in [program, *WORDS, "--ctest", "--images", "out"])
    (suite / "CTestTestfile.cmake").write_text(
        f'add_test(looks {line})\nset_tests_properties(looks PROPERTIES WORKING_DIRECTORY "{suite}")\n')
    (suite / "DartConfiguration.tcl").write_text(f"BuildDirectory: {suite}\nSite: here\nBuildName: it\n")
    done = subprocess.run([ctest, "-T", "Test", "--no-compress-output"], cwd=suite, check=False,
                          capture_output=True, text=True, timeout=60)
    assert done.returncode != 0 and "looks" in done.stdout
    (found,) = suite.glob("Testing/*/Test.xml")
    named = {one.get("name"): one for one in ElementTree.parse(found).iter("NamedMeasurement")}
    assert named["hair/long/errormap.max"].findtext("Value") == "0.366667"
    assert named["hair/long/verdict"].findtext("Value") == "failed: errormap: max 0.366667 > 0.2"
    for name, kind in (("TestImage", "test"), ("ValidImage", "reference"), ("DifferenceImage2", "error")):
        image = named[name]
        assert image.get("type") == "image/png" and image.get("encoding") == "base64"
        assert b64decode(image.findtext("Value")) == (suite / f"out/hair/long.{kind}.png").read_bytes()
