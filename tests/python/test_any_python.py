# SPDX-License-Identifier: BSD-3-Clause
"""The module without OpenImageIO's module, and beside one that it does not know."""

import subprocess
import sys

import pytest
from conftest import files

HIDDEN = """
import sys
sys.modules["OpenImageIO"] = None  # import OpenImageIO fails
"""

# As a wheel of another version looks from here.
FOREIGN = """
import sys, types
OpenImageIO = types.ModuleType("OpenImageIO")
OpenImageIO.VERSION_STRING = "99.1.0"
OpenImageIO.ImageBuf = type("ImageBuf", (), {"__module__": "OpenImageIO"})
sys.modules["OpenImageIO"] = OpenImageIO
"""

# Of the right version, but its types are not known here: another pybind11 or compiler.
OTHER_PYBIND = FOREIGN.replace('"99.1.0"', "'%s'" % __import__("OpenImageIO").VERSION_STRING)


def run(begin, code, *arguments):
    done = subprocess.run([sys.executable, "-B", "-c", begin + code, *map(str, arguments)], capture_output=True,
                          text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


WORK = """
import copy, pickle
import numpy as np, tonetool

image = np.random.default_rng(1).random((24, 32, 3), np.float32) * 4
other = image * np.float32(0.9)
found = tonetool.hdr_flip(image, other, want_exposures=True, want_exposure_map=True)
assert isinstance(found.map, np.ndarray) and found.map.shape == (24, 32)
assert found.summary.region.xend == 32 and found.summary.region.yend == 24
assert "xend=32" in repr(found)
assert pickle.loads(pickle.dumps(found)) == found == copy.deepcopy(found)
part = found.summary.region._replace(xend=8)
assert np.array_equal(tonetool.hdr_flip(image, other, roi=part).map[:, :8], found.map[:, :8])
assert tonetool.tonemap(image, curve="agx").image.shape == image.shape
assert tonetool.chain("--dup", [image]).images[1].shape == image.shape
files = sys.argv[1:]
colors, mean, parameters = tonetool.evaluate(*files, "HDR")
assert isinstance(colors, np.ndarray) and mean > 0.2 and parameters["numExposures"] == 12
(left,) = tonetool.chain([*files, "--hdrflip"]).images
assert isinstance(left, np.ndarray) and left.dtype == np.float32
assert abs(float(left.mean()) - mean) < 1e-6
print("mean", mean)
"""


@pytest.mark.parametrize("begin", [HIDDEN, FOREIGN, OTHER_PYBIND], ids=["hidden", "foreign", "other pybind11"])
def test_arrays_and_paths_work(begin):
    said = run("import sys\n", WORK.split("image = ")[0] + "print('mean', tonetool.evaluate(*sys.argv[1:], 'HDR')[1])",
               *files("cornell"))
    assert run(begin, WORK, *files("cornell")) == said


@pytest.mark.parametrize("begin, why", [
    (HIDDEN, "the OpenImageIO module cannot be imported"),
    (FOREIGN, "the OpenImageIO module is 99.1.0, tonetool was built with "),
    (OTHER_PYBIND, "the OpenImageIO module was built with another pybind11 or compiler")])
def test_what_needs_an_imagebuf_says_so(begin, why):
    said = run(begin, """
import numpy as np, tonetool
try:
    tonetool.image(np.ones((4, 4, 3), np.float32))
except ImportError as error:
    print(error)
try:
    tonetool.chain([sys.argv[1]])
except tonetool.Error as error:
    print(error)
""", files("cornell")[0].parent / "deep.exr")
    image, deep = said.splitlines()
    assert image.startswith("image: makes an OpenImageIO.ImageBuf: " + why)
    assert deep.startswith("a deep image is no array") and why in deep


@pytest.mark.parametrize("begin", [FOREIGN, OTHER_PYBIND])
def test_an_imagebuf_from_elsewhere_is_an_error(begin):
    said = run(begin, """
import numpy as np, tonetool
for call in (tonetool.tonemap, lambda image: tonetool.evaluate(image, image, "HDR"),
             lambda image: tonetool.chain("--dup", [image])):
    try:
        call(OpenImageIO.ImageBuf())
    except TypeError as error:
        print(error)
""")
    lines = said.splitlines()
    assert len(lines) == 3
    for line in lines:
        assert "is an ImageBuf that tonetool does not know" in line and 'image.get_pixels("float")' in line


def test_pickles_travel(tmp_path):
    """What was pickled beside OpenImageIO is arrays where that is missing."""
    path = tmp_path / "result"
    run("import sys\n", """
import pickle, OpenImageIO, tonetool
images = [OpenImageIO.ImageBuf(name) for name in sys.argv[1:3]]
pickle.dump(tonetool.hdr_flip(*images), open(sys.argv[3], "wb"))
""", *files("cornell"), path)
    said = run(HIDDEN, """
import pickle, numpy, tonetool
found = pickle.load(open(sys.argv[1], "rb"))
print(type(found.map).__name__, found.map.shape == (found.summary.region.yend, found.summary.region.xend))
""", path)
    assert said == "ndarray True\n"
