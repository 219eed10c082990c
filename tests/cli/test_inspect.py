# SPDX-License-Identifier: BSD-3-Clause
"""--info, -v and --stats print what oiiotool 2.4.7 prints."""

import numpy as np
import pytest


@pytest.fixture
def images(make_image, make_parts, testimages):
    odd = np.random.default_rng(3).random((4, 5, 3)).astype(np.float32)
    odd[0, 0] = np.nan
    odd[1, 1] = np.inf
    odd[2, 2] = -1e-9
    odd[3, 3] = 1e8
    makers = {
        "float": lambda: make_image("float.exr"),
        "half": lambda: make_image("half.exr", kind="half"),
        "uint8": lambda: make_image("uint8.png", kind="uint8"),
        "uint16": lambda: make_image("uint16.tif", kind="uint16"),
        "uint10": lambda: make_image("uint10.tif", kind="uint16",
                                     attributes={"oiio:BitsPerSample": 10}),
        "uint32": lambda: make_image("uint32.tif", kind="uint32"),
        "double": lambda: make_image("double.tif", kind="double"),
        "grey": lambda: make_image("grey.png", kind="uint8", channels=("Y",)),
        "constant": lambda: make_image("constant.exr", pixels=np.full((12, 16, 3), 0.25)),
        "odd": lambda: make_image("odd.exr", width=5, height=4, pixels=odd),
        "window": lambda: make_image("window.exr", window=(3, 2, -1, 0, 30, 20)),
        "long": lambda: make_image("a_name_longer_than_twenty_letters.exr"),
        "parts": lambda: make_parts("parts.exr", 0.25, 0.5),
        "rendered": lambda: testimages / "cornell_ref.exr",
        "png": lambda: testimages / "srgb16.png",
        "window2": lambda: testimages / "datawindow.exr",
    }
    return lambda name: makers[name]()


NAMES = ["float", "half", "uint8", "uint16", "uint10", "uint32", "double", "grey", "constant",
         "odd", "window", "long", "parts", "rendered", "png", "window2"]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("words", [["--info"], ["-v", "--info"], ["--stats"],
                                   ["-v", "--stats"], ["--info:verbose=1"]])
def test_same_text_as_oiiotool(tonetool, oiiotool, images, name, words):
    image = images(name)
    assert tonetool(*words, image).out == oiiotool(*words, image).out


def test_deep(tonetool, oiiotool, testimages):
    deep = testimages / "deep.exr"
    assert tonetool("-v", "--info", deep).out == oiiotool("-v", "--info", deep).out
    assert tonetool("--stats", deep).out == oiiotool("--stats", deep).out


def test_several_and_one_by_one(tonetool, oiiotool, images):
    words = ["--info", images("half"), images("uint8")]
    assert tonetool(*words).out == oiiotool(*words).out
    for level in ("1", "2"):
        words = [f"-i:info={level}", images("half"), images("uint8"), "--pop"]
        assert tonetool(*words).out == oiiotool(*words).out


def test_info_comes_after_it_only(tonetool, images):
    assert "printed nothing" in tonetool(images("half"), "--info", status=1).err


def test_verbose_names_what_is_written(tonetool, oiiotool, images):
    words = ["-v", images("half"), "-o", "x.exr"]
    assert tonetool(*words).out == oiiotool(*words).out


@pytest.mark.parametrize("kind", ["half", "float", "uint8", "uint16"])
def test_values_of_any_stored_type(tonetool, make_image, kind):
    pixels = np.linspace(0, 1, 24).reshape(2, 4, 3)
    make_image("a.exr", 4, 2, pixels=pixels)
    name = "a.exr" if kind in ("half", "float") else "a.tif"
    tonetool("a.exr", "-d", kind, "-o", "b" + name)
    assert tonetool("--native", "--dumpdata", "b" + name).out == tonetool("--dumpdata", "b" + name).out
