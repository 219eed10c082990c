# SPDX-License-Identifier: BSD-3-Clause
"""What is written for a screen, and what the headers of files say about their colour."""

import base64
import json
import re
import struct
import zlib

import numpy as np
import OpenImageIO as oiio
import pytest

RGB = ["R", "G", "B"]


def linear(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def encoded(v):
    return np.where(v <= 0.0031308, v * 12.92, 1.055 * np.maximum(v, 1e-9) ** (1 / 2.4) - 0.055)


def channels_of(spec):
    return list(spec.channelnames), spec.alpha_channel


@pytest.mark.parametrize("extra", [["N.X"], ["Z"], ["left.R"], ["N.X", "N.Y", "N.Z"],
                                   ["left.R", "left.G", "left.B", "left.A"]])
def test_what_is_no_alpha_does_not_become_it(tonetool, make_image, read, extra):
    picture = make_image("a.exr", channels=RGB + extra)
    for name in ("a.png", "a.tga", "a.dpx", "a.sgi"):
        ran = tonetool("--warnings-exit", picture, "-d", "uint8", "-o", name, status=2)
        assert "saving only R,G,B" in ran.err
        assert channels_of(read(name)[1]) == (RGB, -1), name
    # The other view's picture is left out, which is said; the channels are not.
    ran = tonetool("--warnings-exit", picture, "--tonemap", "-o", "b.png",
                   status=2 if "left.A" in extra else 0)
    assert "saving only" not in ran.err
    assert channels_of(read("b.png")[1]) == (RGB, -1)
    # As oiiotool.
    tonetool("--compat", make_image("b.exr", channels=RGB + extra[:1]), "-o", "c.png")
    assert read("c.png")[1].nchannels == 4


def test_alpha_stays_alpha_wherever_it_is(tonetool, make_image, read):
    pixels = np.full((12, 16, 6), 0.25, np.float32)
    pixels[..., 5] = 0.5
    for names, alpha in ((["R", "G", "B", "Z", "N.X", "A"], 0.5),
                         (["C.R", "C.G", "C.B", "Z", "N.X", "C.A"], 0.5)):
        picture = make_image("a.exr", channels=names, pixels=pixels)
        tonetool(picture, "-o", "a.png")
        got, spec = read("a.png")
        assert (spec.nchannels, spec.alpha_channel) == (4, 3)
        assert abs(got[0, 0, 3] - alpha) < 0.01
    for command in (["--tonemap:layer=x"], ["--cgtmo:layer=x:filter=none:lmax=2"]):
        picture = make_image("l.exr", channels=RGB + ["x.R", "x.G", "x.B"])
        tonetool("--warnings-exit", picture, *command, "-o", "l.png")
        assert read("l.png")[1].nchannels == 3


def test_pictures_are_upright(tonetool, make_image, read):
    pixels = np.random.default_rng(1).random((12, 16, 3)).astype(np.float32)
    for orientation, turned in ((3, pixels[::-1, ::-1]), (6, np.rot90(pixels, -1)),
                                (2, pixels[:, ::-1])):
        name = make_image("a.tif", pixels=pixels, attributes={"Orientation": orientation})
        tonetool(name, "-d", "uint8", "-o", "a.png", "-o", "b.tif")
        got, spec = read("a.png")
        assert got.shape == turned.shape and np.abs(got - turned).max() < 0.003
        assert spec.getattribute("Orientation") in (None, 1)
        got, spec = read("b.tif")
        assert np.abs(got - pixels).max() < 0.003 and spec["Orientation"] == orientation


@pytest.mark.parametrize("words", [["--ldrflip"], ["--ldrflip", "--colormap", "magma"],
                                   ["--errormap:metric=mse"], ["--pop", "--colormap", "viridis"]])
def test_maps_lie_as_their_pictures(tonetool, make_image, read, words):
    a, b = (make_image(f"{seed}.exr", seed=seed, attributes={"Orientation": 6}) for seed in (1, 2))
    tonetool(a, b, *words, "-o", "map.exr", "-o", "map.png")
    stored, spec = read("map.exr")
    assert stored.shape[:2] == (12, 16) and spec["Orientation"] == 6
    shown, spec = read("map.png")
    assert shown.shape[:2] == (16, 12) and spec.getattribute("Orientation") in (None, 1)
    order = [np.argsort(one[..., 0].ravel()) for one in (np.rot90(stored, -1), shown)]
    assert np.corrcoef(*(np.argsort(one) for one in order))[0, 1] > 0.9  # turned alike


def picture_of(uri, folder):
    (folder / "decoded.jpg").write_bytes(base64.b64decode(uri.split(",")[1]))
    return oiio.ImageInput.open(str(folder / "decoded.jpg")).read_image("float")


@pytest.mark.parametrize("orientation", [2, 3, 6, 8])
def test_filmstrips_and_reports_are_upright(tonetool, make_image, read, tmp_path, orientation):
    """They are those of the same pictures that were turned before."""
    lying = orientation < 5
    size = (64, 48) if lying else (48, 64)
    across, down = np.meshgrid(np.linspace(0, 1, size[0]), np.linspace(0, 1, size[1]))
    meant = np.stack([across, down, across * down], -1)
    stored = {2: meant[:, ::-1], 3: meant[::-1, ::-1], 6: np.rot90(meant, 1),
              8: np.rot90(meant, -1)}[orientation]
    flip = "startExposure=0:stopExposure=1:numExposures=2"
    for kind, pixels, turn in (("upright", meant, 1), ("turned", stored, orientation)):
        for name, factor in (("r", 1), ("t", 0.7)):
            make_image(f"{name}.{kind}.0001.exr", pixels.shape[1], pixels.shape[0],
                       pixels=pixels * factor, attributes={"Orientation": turn})
        tonetool(f"r.{kind}.0001.exr", f"t.{kind}.0001.exr", f"--filmstrip:{flip}:width=120",
                 "-o", f"{kind}.png")
        tonetool(f"r.{kind}.#.exr", f"t.{kind}.#.exr", f"--hdrflip:{flip}", "--report",
                 f"{kind}.html", "--contactsheet", f"sheet.{kind}.png")
    for name in ("{}.png", "sheet.{}.png"):
        one, other = (read(name.format(kind))[0] for kind in ("upright", "turned"))
        assert one.shape == other.shape and np.abs(one - other).mean() < 0.01
    texts = [(tmp_path / f"{kind}.html").read_text(encoding="utf-8") for kind in ("upright", "turned")]
    pages, large = ([json.loads(re.search(rf'id="{block}-0">(.*?)</script>', text, re.S)[1])
                     for text in texts] for block in ("full", "large"))
    # The numbers under the pointer are the file's, the pictures are upright.
    stored_size = size if lying else size[::-1]
    assert [(page["width"], page["height"]) for page in pages] == [size, stored_size]
    assert [page["orientation"] for page in pages] == [1, orientation]
    for of, key in ((large, "test"), (pages, "error"), (large, "reference"), (pages, "stops")):
        one, other = (picture_of(page[key], tmp_path) for page in of)
        assert one.shape == other.shape and np.abs(one - other).mean() < 0.02


def test_alpha_that_hides_the_picture_is_said(tonetool, make_image):
    pixels = np.random.default_rng(4).random((12, 16, 4)).astype(np.float32) + 0.1
    pixels[..., 3] = 0
    hidden = make_image("a.exr", channels=RGB + ["A"], pixels=pixels)
    for words in (["--tonemap", "-o", "a.png"], ["-o", "a.tga"], ["-d", "uint8", "-o", "a.tif"]):
        ran = tonetool("--warnings-exit", hidden, *words, status=2)
        assert "alpha is 0 in 192 of the 192 pixels" in ran.err, words
    tonetool("--warnings-exit", hidden, "-o", "b.exr")
    tonetool("--warnings-exit", hidden, "--qc", status=2)
    assert "alphaempty" in tonetool(hidden, "--qc").out
    pixels[:11, :, 3] = 1
    pixels[11:, :, :3] = 0
    tonetool("--warnings-exit", make_image("c.exr", channels=RGB + ["A"], pixels=pixels),
             "--tonemap", "-o", "c.png")


def chunk(name, data):
    crc = struct.pack(">I", zlib.crc32(name + data) & 0xFFFFFFFF)
    return struct.pack(">I", len(data)) + name + data + crc


@pytest.fixture
def png_with(tmp_path):
    """A PNG whose header says `extra` of its colours and nothing else."""

    def make(source, name, extra):
        data = (tmp_path / source).read_bytes()
        out, at = data[:8], 8
        while at < len(data):
            size, kind = struct.unpack(">I", data[at:at + 4])[0], data[at + 4:at + 8]
            if kind not in (b"sRGB", b"gAMA", b"cHRM", b"iCCP"):
                out += data[at:at + 12 + size] + (extra if kind == b"IHDR" else b"")
            at += 12 + size
        (tmp_path / name).write_bytes(out)
        return name

    return make


def gamma(value):
    return chunk(b"gAMA", struct.pack(">I", round(100000 / value)))


def test_gamma_of_a_png_is_applied(tonetool, make_image, png_with, read):
    light = np.random.default_rng(2).random((12, 16, 3)).astype(np.float32)
    make_image("a.exr", pixels=light)
    for value in (1.0, 1.8, 2.2):
        make_image("plain.png", kind="uint16", pixels=light ** (1 / value))
        tagged = png_with("plain.png", "tagged.png", gamma(value))
        ran = tonetool("a.exr", tagged, "--hdrflip:fail=0.002")
        if value != 1: # a reader may call that linear
            assert f"its gamma of {value:g} is applied" in ran.out
        # and stays with the pixels
        tonetool("--warnings-exit", tagged, "-o", "copy.png")
        tonetool("a.exr", "copy.png", "--hdrflip:fail=0.002")
        ran = tonetool("--warnings-exit", tagged, "-o", "copy.tif", status=0 if value == 1 else 2)
        assert value == 1 or "not applied" in ran.err
    # what is said otherwise goes first
    tonetool(tagged, "--tonemap:curve=linear:from=rec709:encode=none", "-d", "float",
             "-o", "b.exr")
    assert np.abs(read("b.exr")[0] - light ** (1 / 2.2)).max() < 1e-4
    both = png_with("plain.png", "both.png", chunk(b"sRGB", b"\0") + gamma(1.8))
    assert "gamma" not in tonetool("a.exr", both, "--ldrflip").out


def test_exposure_of_a_radiance_file_is_divided_out(tonetool, make_image, read, tmp_path):
    make_image("a.hdr", pixels=np.random.default_rng(3).random((12, 16, 3)))
    raw = (tmp_path / "a.hdr").read_bytes()
    pixels, at = read("a.hdr")[0], raw.index(b"\n\n")
    (tmp_path / "b.hdr").write_bytes(raw[:at] + b"\nEXPOSURE=2\nEXPOSURE=8" + raw[at:])
    make_image("c.exr", pixels=pixels / 16)
    ran = tonetool("c.exr", "b.hdr", "--hdrflip:fail=1e-6")
    assert "its EXPOSURE of 16 is divided out" in ran.out
    for name, words in (("x.exr", ["--tonemap:curve=linear:encode=none:clamp=0"]),
                        ("y.exr", ["--cgtmo:filter=none:encode=none"])):
        tonetool("b.hdr", *words, "-o", name)
        tonetool("c.exr", *words, "-o", "w" + name)
        assert np.allclose(read(name)[0], read("w" + name)[0], atol=1e-6), name
    ours = float(tonetool("b.hdr", "--luminancestats").fact("max"))
    assert abs(ours - float(tonetool("c.exr", "--luminancestats").fact("max"))) < 1e-6
    ran = tonetool("--warnings-exit", "b.hdr", "-o", "d.exr", status=2)
    assert "EXPOSURE of 16 is not applied" in ran.err


def profile(gamma_of_curve):
    xyz = lambda t: b"XYZ \0\0\0\0" + b"".join(struct.pack(">i", round(v * 65536)) for v in t)
    tags = [(b"desc", b"desc\0\0\0\0" + struct.pack(">I", 5) + b"mine\0" + b"\0" * 78),
            (b"wtpt", xyz((0.9642, 1, 0.8249)))]
    tags += [(name, xyz(p)) for name, p in ((b"rXYZ", (0.4361, 0.2225, 0.0139)),
                                            (b"gXYZ", (0.3851, 0.7169, 0.0971)),
                                            (b"bXYZ", (0.1431, 0.0606, 0.7141)))]
    curve = b"curv\0\0\0\0" + struct.pack(">IH", 1, round(gamma_of_curve * 256))
    tags += [(name, curve) for name in (b"rTRC", b"gTRC", b"bTRC")]
    offset, table, data = 132 + 12 * len(tags), struct.pack(">I", len(tags)), b""
    for name, bytes_ in tags:
        bytes_ += b"\0" * (-len(bytes_) % 4)
        table += name + struct.pack(">II", offset + len(data), len(bytes_))
        data += bytes_
    white = b"".join(struct.pack(">i", round(v * 65536)) for v in (0.9642, 1, 0.8249))
    head = struct.pack(">I4sI4s4s4s", 128 + len(table + data), b"\0" * 4, 0x02400000, b"mntr",
                       b"RGB ", b"XYZ ")
    head += struct.pack(">6H", 2026, 1, 1, 0, 0, 0) + b"acsp" + b"\0" * 28 + white
    return head.ljust(128, b"\0") + table + data


def test_profiles_that_are_not_applied_are_said(tonetool, make_image, png_with, read):
    make_image("plain.png", kind="uint8")
    other = png_with("plain.png", "other.png",
                     chunk(b"iCCP", b"p\0\0" + zlib.compress(profile(1.8))))
    srgb = png_with("plain.png", "srgb.png",
                    chunk(b"iCCP", b"p\0\0" + zlib.compress(profile(2.2))))
    make_image("ref.exr")
    for words in (["ref.exr", other, "--ldrflip"], [other, "--luminancestats"],
                  [other, "--tonemap", "-o", "t.png"], [other, "--qc"]):
        ran = tonetool("--warnings-exit", *words, status=2)
        assert "ICC profile (mine) is not applied" in ran.err, words
    tonetool("--warnings-exit", "ref.exr", srgb, "--ldrflip")
    tonetool("--warnings-exit", "ref.exr", other, "--ldrflip:from=srgb")
    # Pixels that are encoded anew have no profile of before.
    for words in (["--tonemap"], ["--cgtmo:filter=none"], ["--colormap", "viridis"],
                  ["--colorconvert", "sRGB", "linear"]):
        tonetool(other, *words, "-o", "n.tif")
        assert read("n.tif")[1].getattribute("ICCProfile") is None, words
    tonetool(other, "-o", "same.png")
    assert read("same.png")[1].getattribute("ICCProfile") is not None


def test_our_files_say_their_primaries(tonetool, make_image, read, program):
    config = str(__import__("pathlib").Path(__file__).resolve().parents[2] / "ocio/tonetool.ocio")
    make_image("a.exr")
    for space in ("ACEScg", "ACES2065-1"):
        tonetool("--colorconfig", config, "a.exr", "--colorconvert", "lin_rec709", space, "-o",
                 "b.exr")
        tonetool("a.exr", "b.exr", "--hdrflip:fail=0.0005")
    # and not those of what was converted
    tonetool("--colorconfig", config, "b.exr", "--colorconvert", "ACES2065-1", "lin_rec709",
             "-o", "c.exr")
    tonetool("a.exr", "c.exr", "--hdrflip:fail=0.0005")


def test_the_name_of_a_space_does_not_outlive_it(tonetool, make_image, read):
    """colorInteropID, as newer writers of OpenEXR have it beside the chromaticities."""
    config = str(__import__("pathlib").Path(__file__).resolve().parents[2] / "ocio/tonetool.ocio")
    make_image("a.exr", attributes={"colorInteropID": "lin_ap1_scene", "oiio:ColorSpace": "ACEScg"})

    def name_of(*words):
        tonetool("--colorconfig", config, "a.exr", *words, "-o", "b.exr")
        return read("b.exr")[1].getattribute("colorInteropID")

    assert name_of() == name_of("--mulc", "2") == "lin_ap1_scene"
    assert name_of("--colorconvert", "ACEScg", "lin_rec709") in (None, "lin_rec709_scene")
    assert name_of("--tonemap:encode=none") in (None, "lin_rec709_scene")


def test_the_interop_id_names_the_space(tonetool, make_image):
    """Where nothing else does; OpenImageIO 2 passes it on as any attribute."""
    pixels = np.random.default_rng(3).random((12, 16, 3)) + 0.1
    to_rec709 = np.array([[1.70505, -0.62179, -0.08326], [-0.13026, 1.14080, -0.01055], [-0.02400, -0.12897, 1.15297]])
    make_image("rec709.exr", pixels=pixels @ to_rec709.T)
    make_image("ap1.exr", pixels=pixels, attributes={"colorInteropID": "lin_ap1_scene"})
    tonetool("rec709.exr", "ap1.exr", "--hdrflip:fail=0.0005")
    make_image("srgb.exr", pixels=pixels, attributes={"colorInteropID": "srgb_rec709_scene"})
    make_image("plain.exr", pixels=pixels)
    for name in ("ap1.exr", "srgb.exr"):
        tonetool("plain.exr", name, "--hdrflip:fail=0.01", status=3)
    tonetool("plain.exr", "srgb.exr", "--hdrflip:from=rec709:fail=0")
    for name in ("unknown", "data", ""):
        make_image("id.exr", pixels=pixels, attributes={"colorInteropID": name})
        tonetool("plain.exr", "id.exr", "--hdrflip:fail=0")
    make_image("id.exr", pixels=pixels, attributes={"colorInteropID": "lin_nonsense_scene"})
    said = tonetool("plain.exr", "id.exr", "--hdrflip:fail=0.9", status=1).err
    assert 'unknown colour space "lin_nonsense_scene" in colorInteropID' in said


def test_pfm_and_xyz_are_light(tonetool, make_image, tmp_path):
    pixels = np.random.default_rng(5).random((12, 16, 3)).astype("<f4") * 4
    make_image("a.exr", pixels=pixels)
    for name, magic, data in (("a.pfm", b"PF", pixels), ("grey.pfm", b"Pf", pixels[..., :1])):
        (tmp_path / name).write_bytes(magic + b"\n16 12\n-1.0\n" + data[::-1].tobytes())
    tonetool("a.exr", "a.pfm", "--hdrflip:fail=0")
    make_image("g.exr", channels=["Y"], pixels=pixels[..., :1])
    tonetool("g.exr", "grey.pfm", "--hdrflip:fail=0")
    m = np.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923],
                  [0.0193308, 0.1191948, 0.9505322]])
    axes = (oiio.TypeDesc("float[8]"), (1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1 / 3, 1 / 3))
    spec = oiio.ImageSpec(16, 12, 3, "float")
    spec.attribute("chromaticities", *axes)
    out = oiio.ImageOutput.create(str(tmp_path / "x.exr"))
    assert out.open(str(tmp_path / "x.exr"), spec)
    assert out.write_image(np.ascontiguousarray(pixels @ m.T, dtype=np.float32))
    out.close()
    tonetool("a.exr", "x.exr", "--hdrflip:fail=0.001")


@pytest.mark.parametrize("kind", ["uint8", "uint16"])
@pytest.mark.parametrize("extension", ["png", "tif", "tga"])
def test_colour_is_decoded_before_it_is_associated(tonetool, make_image, kind, extension, read):
    if (kind, extension) == ("uint16", "tga"):
        pytest.skip("TGA has no 16 bits")
    straight = np.random.default_rng(6).random((12, 16, 4))
    straight[..., 3] = 0.5 + straight[..., 3] / 2  # 8 bits of less alpha are few of the colour
    # The readers of PNG and TGA multiply 8 bits by alpha in 8 bits: 0.037 of this noise, where those
    # of TIFF, which multiply nothing, have 0.0096. Decoded after alpha it is at 0.31.
    limit = 0.05 if kind == "uint8" else 0.02
    light = np.concatenate([linear(straight[..., :3]) * straight[..., 3:], straight[..., 3:]], -1)
    make_image("a.exr", channels=RGB + ["A"], pixels=light)
    stored = np.concatenate([straight[..., :3] * straight[..., 3:], straight[..., 3:]], -1)
    make_image(f"b.{extension}", channels=RGB + ["A"], kind=kind, pixels=stored)
    tonetool("a.exr", f"b.{extension}", f"--ldrflip:fail={limit}")
    for before in ([], ["--flop", "--flop"]): # also of what a command made of it
        tonetool(f"b.{extension}", *before, "--tonemap:curve=linear:encode=none", "-o", "c.exr")
        assert np.abs(read("c.exr")[0][..., :3] - light[..., :3]).max() < 0.02
    # A decoded image is one.
    tonetool("a.exr", "c.exr", "--hdrflip:fail=0.05")


def test_gamma_is_applied_before_colour_is_associated(tonetool, make_image, png_with, read):
    straight = np.random.default_rng(7).random((12, 16, 4))
    straight[..., 3] = 0.5 + straight[..., 3] / 2
    stored = np.concatenate([straight[..., :3] * straight[..., 3:], straight[..., 3:]], -1)
    make_image("plain.png", channels=RGB + ["A"], kind="uint16", pixels=stored)
    tagged = png_with("plain.png", "tagged.png", gamma(1.8))
    tonetool(tagged, "--tonemap:curve=linear:encode=none", "-o", "light.exr")
    light = straight[..., :3] ** 1.8 * straight[..., 3:]
    assert np.abs(read("light.exr")[0][..., :3] - light).max() < 0.002


def test_gamma_of_a_targa_file_is_applied_before_colour_is_associated(tonetool, tmp_path, read):
    """Its reader multiplies by the power of alpha."""
    alphas, value = (0.25, 0.5, 0.75, 1), 0.4
    header = struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, 4, 1, 32, 8 | 0x20)
    pixels = b"".join(bytes([round(value * 255)] * 3 + [round(alpha * 255)]) for alpha in alphas)
    extension = bytearray(495)
    struct.pack_into("<H", extension, 0, 495)
    struct.pack_into("<HH", extension, 478, 18, 10)  # a gamma of 1.8
    extension[494] = 3  # alpha, not multiplied by
    (tmp_path / "a.tga").write_bytes(header + pixels + bytes(extension)
                                     + struct.pack("<II", len(header) + len(pixels), 0) + b"TRUEVISION-XFILE.\0")
    tonetool("a.tga", "--tonemap:curve=linear:encode=none", "-d", "float", "-o", "light.exr")
    # The reader rounds the product to 8 bits: half a step is 6 % of the darkest one.
    assert np.abs(read("light.exr")[0][0, :, 0] - value ** 1.8 * np.array(alphas)).max() < 0.006


def test_grey_pictures_and_data(tonetool, make_image, read):
    grey = make_image("y.exr", channels=["Y"])
    other = make_image("z.exr", channels=["Y"], seed=2)
    tonetool(grey, grey, "--hdrflip:fail=0")
    tonetool(grey, other, "--hdrflip:fail=0.01", status=3)
    tonetool(grey, "--qc", "--luminancestats")
    tonetool(grey, "--exposure", "1", "--calibrate:method=mean", "--tonemap", "-o", "y.png")
    assert read("y.png")[1].nchannels == 1
    for name, channels, holds in (("bumpNormals", RGB, "normals"), ("denoise_albedo", RGB, "albedo"),
                                  ("worldPos", RGB, "positions"), ("VRayZDepth", RGB, "depths"),
                                  ("depth", ["Z"], "depths"), ("N", ["X"], "normals")):
        data = make_image("d.exr", channels=[f"{name}.{c}" for c in channels])
        ran = tonetool(data, data, "--hdrflip:fail=0.1", status=1)
        assert f"holds {holds}" in ran.err and f"layer={name}" in ran.err, ran.err
        tonetool(data, data, f"--hdrflip:fail=0.1:layer={name}")
        tonetool(data, "--qc")
    for channels in (["N.X", "N.Y", "N.Z"], ["Z", "id"], ["u", "v"]):
        tonetool(make_image("e.exr", channels=channels), "--qc")
