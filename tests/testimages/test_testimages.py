# SPDX-License-Identifier: BSD-3-Clause
"""testimages/ is what its README, its generator and its manifest say."""
import hashlib
import pathlib
import re
import subprocess
import sys

import numpy as np
import OpenImageIO as oiio
import pytest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "testimages"
FILES = sorted(f for f in FOLDER.rglob("*") if f.is_file() and "__pycache__" not in f.parts)
LIMIT = 6_000_000


@pytest.fixture(scope="session")
def regenerated(tmp_path_factory):
    folder = tmp_path_factory.mktemp("edges")
    subprocess.run([sys.executable, FOLDER / "make_edges.py", folder], check=True)
    return folder


def edge_names():
    """File names in the table of the README's last section."""
    section = (FOLDER / "README.md").read_text().split("## Edge cases")[1]
    rows = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row)]


def contents(path):
    """Header facts and pixels of an image; deep pixels as a list of samples."""
    image = oiio.ImageInput.open(str(path))
    assert image, oiio.geterror()
    spec = image.spec()
    facts = {name: getattr(spec, name) for name in
             ("x", "y", "width", "height", "full_x", "full_y", "full_width", "full_height",
              "channelnames", "deep")}
    facts["format"] = str(spec.format)
    facts["chromaticities"] = spec.getattribute("chromaticities")
    if not spec.deep:
        return facts, image.read_image(spec.format)
    deep = image.read_native_deep_image()
    pixels = [[deep.deep_value(p, c, s) for c in range(deep.channels)]
              for p in range(deep.pixels) for s in range(deep.samples(p))]
    facts["samples"] = [deep.samples(p) for p in range(deep.pixels)]
    return facts, np.array(pixels)


def test_the_generator_writes_the_files_of_the_readme(regenerated):
    assert sorted(f.name for f in regenerated.iterdir()) == sorted(edge_names())


@pytest.mark.parametrize("name", edge_names())
def test_regenerated_pixels_are_the_same(name, regenerated):
    if name in ("truncated.exr", "not_an_image.exr"):
        assert (FOLDER / name).read_bytes() == (regenerated / name).read_bytes()
        return
    (facts, pixels), (new_facts, new_pixels) = map(contents, (FOLDER / name, regenerated / name))
    assert facts == new_facts
    if name == "acescg.exr":  # a product of matrices: linear algebra libraries differ in the last bit
        np.testing.assert_allclose(new_pixels, pixels, rtol=2 ** -22)
    else:
        np.testing.assert_array_equal(new_pixels, pixels)  # NaN equals NaN here


def test_truncated_has_a_header_but_not_its_pixels():
    image = oiio.ImageInput.open(str(FOLDER / "truncated.exr"))
    assert image and image.spec().width == 64
    assert image.read_image("float") is None


def test_not_an_image_does_not_open():
    assert oiio.ImageInput.open(str(FOLDER / "not_an_image.exr")) is None
    assert oiio.geterror()


def test_manifest_lists_every_golden_file_with_its_checksum():
    lines = (FOLDER / "golden" / "MANIFEST").read_text().splitlines()
    listed = dict(reversed(line.split()[:2]) for line in lines if not line.startswith("#"))
    actual = {f.name: hashlib.sha256(f.read_bytes()).hexdigest()
              for f in FILES if f.parent.name == "golden" and f.name != "MANIFEST"}
    assert listed == actual


def test_every_file_is_named_in_the_readme():
    text = (FOLDER / "README.md").read_text()
    named = [f.name for f in FILES if f.parent == FOLDER and f.name != "README.md"]
    assert [name for name in named if f"`{name}`" not in text] == []
    assert "`golden/MANIFEST`" in text


def test_all_together_stay_small():
    assert sum(f.stat().st_size for f in FILES) < LIMIT
