# SPDX-License-Identifier: BSD-3-Clause
"""--cgtmo: what its guides may look like, and where they may lie."""

import math

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

GALLERY = TESTIMAGES / "gallery_ref.exr"
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
PLAIN = "encode=none:clamp=0"


@pytest.fixture(scope="module")
def planes():
    """The gallery: names of channels without the view layer, and their planes."""
    image = oiio.ImageBuf(str(GALLERY))
    names = [name.replace("ViewLayer.", "") for name in image.spec().channelnames]
    pixels = image.get_pixels(oiio.FLOAT)
    keep = ("Combined.", "Position.", "Normal.", "DiffCol.", "Depth.")
    return {n: pixels[..., i].copy() for i, n in enumerate(names) if n.startswith(keep)}


@pytest.fixture
def write(tmp_path):
    def write(name, planes, attributes=None, format=oiio.FLOAT):
        first = next(iter(planes.values()))
        spec = oiio.ImageSpec(first.shape[1], first.shape[0], len(planes), format)
        spec.channelnames = tuple(planes)
        for key, value in (attributes or {}).items():
            spec.attribute(key, oiio.TypeDesc("matrix"), value)
        image = oiio.ImageBuf(spec)
        image.set_pixels(oiio.ROI(), np.stack(list(planes.values()), axis=-1))
        path = tmp_path / name
        assert image.write(str(path)), image.geterror()
        return path

    return write


@pytest.fixture
def mapped(tonetool, tmp_path):
    """Runs --cgtmo; the colours of the result, and what was printed."""

    def mapped(path, modifiers="", status=0):
        out = tmp_path / "mapped.exr"
        out.unlink(missing_ok=True)
        more = ":" + modifiers if modifiers else ""
        ran = tonetool("-v", path, f"--cgtmo:{PLAIN}{more}", "-d", "float", "-o", out,
                       status=status)
        if status:
            return None, ran
        image = oiio.ImageBuf(str(out))
        names = list(image.spec().channelnames)
        channels = [names.index("Combined." + c) for c in "RGB"]
        pixels = image.get_pixels(oiio.FLOAT)[..., channels]
        oiio.ImageCache(True).invalidate(str(out))
        return pixels, ran

    return mapped


def moved(planes, matrix, offset):
    """Positions and normals in another space."""
    out = dict(planes)
    for layer, shift in (("Position", offset), ("Normal", 0)):
        vectors = np.stack([planes[f"{layer}.{c}"] for c in "XYZ"], axis=-1).astype(float)
        vectors = vectors @ matrix.T + shift
        for i, c in enumerate("XYZ"):
            out[f"{layer}.{c}"] = vectors[..., i].astype(np.float32)
    return out


def rms(a, b):
    a, b = a @ WEIGHTS, b @ WEIGHTS
    lit = (a > 0) & (b > 0)
    return math.sqrt(np.mean((np.log(a[lit]) - np.log(b[lit])) ** 2))


def test_the_order_of_channels_is_nothing(planes, write, mapped):
    expected, _ = mapped(write("a.exr", planes))
    names = list(planes)
    np.random.default_rng(5).shuffle(names)
    assert names != list(planes)
    shuffled, _ = mapped(write("b.exr", {n: planes[n] for n in names}))
    assert np.array_equal(expected, shuffled)


@pytest.mark.parametrize("preset", ["default", "paper"])
def test_world_and_camera_space_are_one(planes, write, mapped, preset):
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]])
    expected, _ = mapped(write("a.exr", planes), f"preset={preset}")
    turned, _ = mapped(write("b.exr", moved(planes, turn, np.array([3, -2, 5.0]))),
                       f"preset={preset}")
    # Steps of a rotated normal are rounded elsewhere.
    assert rms(expected, turned) <= 1e-4


@pytest.mark.parametrize("factor", [0.001, 64, 3e4])
def test_the_unit_of_positions_is_nothing(planes, write, mapped, factor):
    expected, _ = mapped(write("a.exr", planes))
    scaled, _ = mapped(write("b.exr", moved(planes, np.eye(3), 0) | {
        f"Position.{c}": planes[f"Position.{c}"] * np.float32(factor) for c in "XYZ"}))
    assert rms(expected, scaled) <= (0 if factor == 64 else 1e-5)


def test_guides_in_files_of_their_own(planes, write, mapped):
    expected, _ = mapped(write("all.exr", planes))
    beauty = write("beauty.exr", {n: p for n, p in planes.items() if n.startswith("Combined")})
    files = {}
    for guide, layer, parts in (("position", "Position", "XYZ"), ("normal", "Normal", "XYZ"),
                                ("albedo", "DiffCol", "RGB"), ("depth", "Depth", "Z")):
        # As a renderer does that writes a file for each: R, G and B, whatever they are.
        names = "RGB" if len(parts) == 3 else "Z"
        files[guide] = write(f"{guide}.exr",
                             {n: planes[f"{layer}.{p}"] for n, p in zip(names, parts)})
    found, ran = mapped(beauty, ":".join(f"{g}={f.name}" for g, f in files.items()))
    assert np.array_equal(expected, found)
    assert ran.fact("position") == "position.exr"
    _, ran = mapped(beauty, "position=albedo.txt", status=1)
    assert "albedo.txt" in ran.err


def test_guides_in_other_parts(planes, write, mapped, tmp_path):
    expected, _ = mapped(write("all.exr", planes))
    specs, pixels = [], []
    for layer in ("Combined", "Position", "Normal", "DiffCol", "Depth"):
        here = {n: p for n, p in planes.items() if n.startswith(layer + ".")}
        spec = oiio.ImageSpec(next(iter(here.values())).shape[1],
                              next(iter(here.values())).shape[0], len(here), oiio.FLOAT)
        spec.channelnames = tuple(here)
        spec.attribute("oiio:subimagename", layer)
        specs.append(spec)
        pixels.append(np.stack(list(here.values()), axis=-1))
    path = str(tmp_path / "parts.exr")
    out = oiio.ImageOutput.create(path)
    assert out.open(path, tuple(specs)), out.geterror()
    for i, spec in enumerate(specs):
        if i > 0:
            assert out.open(path, spec, "AppendSubimage"), out.geterror()
        assert out.write_image(pixels[i]), out.geterror()
    out.close()
    found, ran = mapped(path)
    assert ran.fact("position") == "Position" and ran.fact("albedo") == "DiffCol"
    assert np.array_equal(expected, found)


def test_positions_of_depth(planes, write, mapped):
    expected, _ = mapped(write("all.exr", planes), "preset=classic:samples=0")
    rest = write("rest.exr", {n: p for n, p in planes.items() if not n.startswith("Position")})
    # The gallery's lens: 36 mm behind 45 mm and the like make about 40 degrees.
    found, ran = mapped(rest, "preset=classic:samples=0:fov=40")
    assert ran.fact("position").startswith("of Depth")
    without, _ = mapped(rest, "preset=classic:samples=0:position=none")
    assert rms(expected, found) < 0.02 < rms(expected, without) * 2
    assert rms(expected, found) < 0.5 * rms(expected, without)
    _, ran = mapped(rest)
    assert "field of view of 40" in ran.err
    _, ran = mapped(rest, "strict=1", status=1)
    assert "fov=" in ran.err


def test_the_cameras_footprint(planes, write, mapped):
    flat = {n: np.zeros((40, 60), np.float32) for n in planes}
    y, x = np.mgrid[0:40, 0:60].astype(np.float32)
    step, z = np.float32(2 * math.tan(math.radians(25)) / 60), np.float32(10)
    flat["Position.X"], flat["Position.Y"] = (x - 29.5) * step * z, (y - 19.5) * step * z
    flat["Position.Z"] = flat["Depth.Z"] = np.full((40, 60), z)
    flat["Normal.Z"] = np.ones((40, 60), np.float32)
    for c in "RGB":
        flat[f"Combined.{c}"] = np.exp(np.sin(x + 2 * y)).astype(np.float32)
    path = write("wall.exr", flat)
    own, ran = mapped(path)
    assert float(ran.fact("footprint")) == pytest.approx(float(step * z), rel=1e-5)
    by_view, ran = mapped(path, "footprint=camera:fov=50")
    assert float(ran.fact("footprint")) == pytest.approx(float(step * z), rel=1e-5)
    assert rms(own, by_view) <= 1e-5
    # The same from matrices as OpenEXR has them: points on the left, the picture 1 wide.
    f = 0.5 / math.tan(math.radians(25))
    identity = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    to_picture = (f, 0, 0, 0, 0, f * 60 / 40, 0, 0, 0.5, 0.5, 1, 1, 0, 0, -0.1, 0)
    path = write("told.exr", flat, {"worldToCamera": identity, "worldToNDC": to_picture})
    told, ran = mapped(path, "footprint=camera")
    assert float(ran.fact("footprint")) == pytest.approx(float(step * z), rel=1e-5)
    assert rms(own, told) <= 1e-5
    _, ran = mapped(write("wall2.exr", flat), "footprint=camera", status=1)
    assert "fov=" in ran.err


def test_half_positions_are_a_warning_at_most(planes, write, mapped):
    expected, _ = mapped(write("a.exr", planes), "samples=0")
    coarse = {n: p.astype(np.float16).astype(np.float32) if n.startswith("Position") else p
              for n, p in planes.items()}
    found, _ = mapped(write("b.exr", coarse), "samples=0")
    assert rms(expected, found) < 0.02
    far = dict(coarse)
    far["Position.X"] = (planes["Position.X"] + 1000).astype(np.float16).astype(np.float32)
    found, ran = mapped(write("c.exr", far), "samples=0")
    assert "as coarse as half" in ran.err
    assert np.isfinite(found).all()


def test_normals_from_0_to_1(planes, write, mapped):
    expected, _ = mapped(write("a.exr", planes))
    encoded = {n: 0.5 * p + 0.5 if n.startswith("Normal") else p for n, p in planes.items()}
    found, ran = mapped(write("b.exr", encoded))
    assert "2n - 1" in ran.err
    assert rms(expected, found) < 2e-3


def test_missing_albedo(planes, write, mapped):
    rest = write("rest.exr", {n: p for n, p in planes.items() if not n.startswith("DiffCol")})
    found, ran = mapped(rest)
    assert "no albedo among the layers" in ran.err and np.isfinite(found).all()
    asked, ran = mapped(rest, "albedo=none")
    assert "albedo" not in ran.err and np.array_equal(found, asked)
    _, ran = mapped(rest, "strict=1", status=1)
    assert "albedo" in ran.err


def test_nan_in_positions_and_sky_everywhere(planes, write, mapped):
    holes = dict(planes)
    holes["Position.Y"] = planes["Position.Y"].copy()
    holes["Position.Y"][10:12, 20:25] = np.nan
    found, ran = mapped(write("holes.exr", holes))
    assert "10 pixel(s) are taken for background" in ran.err
    assert np.isfinite(found).all() and (found[10:12, 20:25] > 0).any()
    sky = dict(planes)
    sky["Depth.Z"] = np.full_like(planes["Depth.Z"], 1e10)
    found, ran = mapped(write("sky.exr", sky))
    assert "no pixel shows a surface" in ran.err and np.isfinite(found).all()


def test_subsets_are_close_to_the_whole_window(planes, write, mapped):
    """At the size of the test images windows hold few pixels alike: scenes of full size are at
    0.008 to 0.02."""
    path = write("a.exr", planes)
    whole, _ = mapped(path, "samples=0")
    some, _ = mapped(path, "samples=240")
    fewer, _ = mapped(path, "samples=80")
    assert rms(whole, some) < rms(whole, fewer) < 0.05
