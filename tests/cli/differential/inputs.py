# SPDX-License-Identifier: BSD-3-Clause
"""The small images that the differential cases read. Every byte follows from fixed seeds."""

import shutil
import struct
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

WIDTH, HEIGHT = 64, 48
FRAMES = range(1, 21)
HOLES = (7, 8, 15)
OCIO = Path(__file__).resolve().parents[3] / "ocio"


def picture(seed, channels=3, width=WIDTH, height=HEIGHT, low=0.0, high=2.0):
    """A gradient with noise and a bright square: every filter and every window shows in it."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[0:height, 0:width]
    pixels = np.empty((height, width, channels), np.float32)
    for channel in range(channels):
        wave = 0.5 + 0.5 * np.sin((x * (channel + 1) + y * 2 + seed) * 0.15)
        pixels[..., channel] = 0.7 * wave + 0.3 * random.random((height, width))
    pixels[height // 4: height // 2, width // 3: width // 2] *= 0.25
    pixels[2:4, 5:9] = 1.0
    return (low + (high - low) * pixels).astype(np.float32)


def with_alpha(seed, **options):
    """Premultiplied, with fully transparent, opaque and partial pixels."""
    color = picture(seed, 3, **options)
    height, width = color.shape[:2]
    alpha = np.clip(np.linspace(-0.25, 1.25, width), 0, 1)[None, :, None]
    alpha = np.repeat(alpha, height, 0).astype(np.float32)
    if seed % 2:
        alpha = alpha[:, ::-1]
    return np.concatenate([color * alpha, alpha], 2)


def spec_of(pixels, kind, names, window, attributes):
    height, width, channels = pixels.shape
    spec = oiio.ImageSpec(width, height, channels, kind)
    if names:
        spec.channelnames = tuple(names)
        spec.alpha_channel = names.index("A") if "A" in names else -1
        spec.z_channel = names.index("Z") if "Z" in names else -1
    if window:
        spec.x, spec.y, spec.full_x, spec.full_y, spec.full_width, spec.full_height = window
    for key, value in {"DateTime": "2020:01:02 03:04:05", **(attributes or {})}.items():
        if isinstance(value, tuple):
            spec.attribute(key, *value)
        else:
            spec.attribute(key, value)
    return spec


def write(path, pixels, kind="half", names=None, window=None, tile=0, kinds=None, **attributes):
    spec = spec_of(pixels, kind, names, window, {k.replace("__", ":"): v
                                                 for k, v in attributes.items()})
    if tile:
        spec.tile_width = spec.tile_height = tile
    if kinds:
        spec.channelformats = tuple(oiio.TypeDesc(one) for one in kinds)
    out = oiio.ImageOutput.create(str(path))
    assert out and out.open(str(path), spec), oiio.geterror()
    assert out.write_image(np.ascontiguousarray(pixels, dtype=np.float32)), out.geterror()
    out.close()


def write_parts(path, parts):
    """parts: (name, pixels, channel names, window)."""
    specs = []
    for name, pixels, names, window in parts:
        specs.append(spec_of(pixels, "half", names, window, {"oiio:subimagename": name}))
    out = oiio.ImageOutput.create(str(path))
    assert out.open(str(path), tuple(specs)), oiio.geterror()
    for index, (_, pixels, _, _) in enumerate(parts):
        if index:
            assert out.open(str(path), specs[index], "AppendSubimage")
        assert out.write_image(pixels)
    out.close()


def write_deep(path, seed, width=20, height=14):
    names = ("R", "G", "B", "A", "Z", "ZBack")
    random = np.random.default_rng(seed)
    data = oiio.DeepData()
    data.init(width * height, len(names), tuple([oiio.TypeDesc("float")] * 6), names)
    for pixel in range(width * height):
        count = int(random.integers(0, 4))
        data.set_samples(pixel, count)
        depth = 1.0 + seed
        for sample in range(count):
            depth += float(random.random()) + 0.1
            values = [*(float(v) for v in random.random(3) * 0.5), 0.5, depth, depth + 0.05]
            for channel, value in enumerate(values):
                data.set_deep_value(pixel, channel, sample, value)
    spec = spec_of(np.zeros((height, width, 6), np.float32), "float", names, None, None)
    spec.deep = True
    out = oiio.ImageOutput.create(str(path))
    assert out.open(str(path), spec), oiio.geterror()
    assert out.write_deep_image(data), out.geterror()
    out.close()


def make_plain(to):
    write(to / "rgb.exr", picture(1))
    write(to / "rgb2.exr", picture(2))
    write(to / "rgb3.exr", picture(3, high=1.0))
    write(to / "close.exr", picture(1) + np.float32(0.002))
    write(to / "float.exr", picture(4), "float")
    write(to / "signed.exr", picture(5, low=-1.5, high=1.5), "float")
    write(to / "rgba.exr", with_alpha(6), names="RGBA")
    write(to / "rgba2.exr", with_alpha(7), names="RGBA")
    write(to / "grey.exr", picture(8, 1), names="Y")
    write(to / "two.exr", picture(9, 2), "float", names=("u", "v"))
    write(to / "small.exr", picture(10, 3, 24, 16))
    write(to / "wide.exr", picture(11, 3, 90, 40), PixelAspectRatio=2.0)
    write(to / "tiny.exr", picture(12, 3, 4, 3), "float")
    write(to / "unit.exr", picture(13, high=1.0), "float")
    write(to / "depth.exr", np.dstack([with_alpha(14), 1 + 9 * picture(14, 1, high=1.0)]),
          names="RGBAZ")
    write(to / "depth2.exr", np.dstack([with_alpha(15), 1 + 9 * picture(15, 1, high=1.0)]),
          names="RGBAZ")
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    place = np.stack([(x + 0.5) / WIDTH * 0.8 + 0.1, 1 - (y + 0.5) / HEIGHT], 2)
    write(to / "st.exr", place, "float", names=("R", "G"))


def make_integer(to):
    write(to / "u8.tif", picture(20, high=1.0), "uint8")
    write(to / "u8b.tif", picture(21, high=1.0), "uint8")
    write(to / "u16.tif", picture(22, high=1.0), "uint16")
    write(to / "f32.tif", picture(23), "float")
    write(to / "grey.tif", picture(24, 1, high=1.0), "uint8")
    write(to / "tiled.tif", picture(25, high=1.0), "uint8", tile=16)
    write(to / "u8.png", picture(26, high=1.0), "uint8")
    write(to / "u16.png", picture(27, high=1.0), "uint16")
    write(to / "straight.png", with_alpha(28, high=1.0), "uint8", names="RGBA")
    write(to / "photo.jpg", picture(29, high=1.0), "uint8", Orientation=6, Make="Maker",
          Exif__FNumber=2.8, ImageDescription="a photo")
    write(to / "plain.jpg", picture(30, high=1.0), "uint8")
    write(to / "scan.dpx", picture(31, high=1.0), "uint16")
    write(to / "plate_sRGB.tif", picture(32, high=1.0), "uint16")


def make_windows(to):
    write(to / "inside.exr", picture(40, 3, 40, 30), window=(12, 9, 0, 0, WIDTH, HEIGHT))
    write(to / "overscan.exr", picture(41, 3, 80, 60), window=(-8, -6, 0, 0, WIDTH, HEIGHT))
    write(to / "offset.exr", picture(42), window=(10, 20, 10, 20, WIDTH, HEIGHT))
    write(to / "inside_a.exr", with_alpha(43, width=40, height=30), names="RGBA",
          window=(4, 5, 0, 0, WIDTH, HEIGHT))
    border = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    border[10:30, 20:50] = picture(44, 3, 30, 20)
    write(to / "border.exr", border)
    holes = with_alpha(45)
    holes[16:24, 20:40] = 0
    write(to / "holes.exr", holes, names="RGBA")


def make_special(to):
    bad = picture(50, 3)
    bad[5, 6] = np.nan
    bad[7, 8:11, 1] = np.inf
    bad[40, 60, 2] = -np.inf
    bad[20:23, 20:23] = np.nan
    write(to / "nan.exr", bad, "float")
    for kind in ("zip", "piz", "dwaa", "none", "rle"):
        write(to / f"{kind}.exr", picture(51), compression=kind)
    write(to / "tiled.exr", picture(52), tile=16)
    write(to / "meta.exr", picture(53, 3, 16, 12), Artist="An Artist", Copyright="2020 nobody",
          ImageDescription="a description", keywords="one; two", camera="cam A",
          shot__name="sh010", shot__take=7, shot__ratio=1.5, studio="a studio",
          worldToCamera=("matrix", tuple(float(v) for v in range(16))),
          smpte__TimeCode=("timecode", (18356486, 4294967295)),
          FramesPerSecond=("rational", (24, 1)),
          oiio__ColorSpace="Linear", Orientation=1)
    whole = (to / "rgb.exr").read_bytes()
    (to / "cut_short.exr").write_bytes(whole[:len(whole) // 2])
    (to / "text.exr").write_text("not an image\n")
    (to / "words.txt").write_text("not an image\n")
    (to / "profile.icc").write_bytes(icc_profile())


def make_layers(to):
    names = ["R", "G", "B", "A", "Z", "diffuse.R", "diffuse.G", "diffuse.B", "specular.R",
             "specular.G", "specular.B", "N.X", "N.Y", "N.Z", "id"]
    kinds = ["half"] * 4 + ["float"] + ["half"] * 6 + ["float"] * 3 + ["uint"]
    pixels = picture(60, len(names))
    pixels[..., 3] = 1
    pixels[..., 14] = np.floor(pixels[..., 14] * 3) / 4294967295.0
    write(to / "layers.exr", pixels, "float", names=names, kinds=kinds)
    beauty = ("beauty", with_alpha(61), ("R", "G", "B", "A"), None)
    albedo = ("albedo", picture(62), ("R", "G", "B"), None)
    normal = ("normal", picture(63, 3, 40, 30), ("N.X", "N.Y", "N.Z"), (4, 6, 0, 0, WIDTH, HEIGHT))
    write_parts(to / "parts.exr", [beauty, albedo, normal])
    write_parts(to / "parts2.exr", [("beauty", with_alpha(64), ("R", "G", "B", "A"), None),
                                    ("albedo", picture(65), ("R", "G", "B"), None), normal])
    write_parts(to / "pair.exr", [("left", picture(66), ("R", "G", "B"), None),
                                  ("right", picture(67), ("R", "G", "B"), None)])
    write_deep(to / "deep.exr", 70)
    write_deep(to / "deep2.exr", 71)


def make_mips(to):
    config = oiio.ImageSpec()
    config.attribute("DateTime", "2020:01:02 03:04:05")
    for name, source in (("mip.exr", "rgb.exr"), ("mip.tx", "u8.tif")):
        config.attribute("maketx:fileformatname", "openexr" if name.endswith("exr") else "tiff")
        assert oiio.ImageBufAlgo.make_texture(oiio.MakeTxTexture, str(to / source),
                                              str(to / name), config), oiio.geterror()


def make_sequences(to):
    for frame in FRAMES:
        one = picture(100 + frame, 3, 32, 24)
        write(to / f"seq.{frame:04d}.exr", one, frame=frame)
        write(to / f"bg.{frame:04d}.exr", with_alpha(200 + frame, width=32, height=24),
              names="RGBA")
        if frame not in HOLES:
            write(to / f"holes.{frame:04d}.exr", one)
        for seed, long in ((300, "left"), (400, "right")):
            eye = picture(seed + frame, 3, 32, 24)
            write(to / f"stereo.{long}.{frame:04d}.exr", eye)
            if frame <= 3:
                write(to / f"eye.{long[0]}.{frame:02d}.exr", eye)
    write(to / "eye_left.exr", picture(80, 3, 32, 24))
    write(to / "eye_right.exr", picture(81, 3, 32, 24))
    shutil.copy(to / "seq.0001.exr", to / "broken.0001.exr")
    shutil.copy(to / "cut_short.exr", to / "broken.0002.exr")
    shutil.copy(to / "seq.0003.exr", to / "broken.0003.exr")


def icc_profile():
    """The smallest profile that is whole: a header and one description."""
    text = b"desc\0\0\0\0" + struct.pack(">I", 5) + b"test\0" + b"\0" * 83
    table = struct.pack(">I4sII", 1, b"desc", 144, len(text))
    head = bytearray(128)
    head[0:4] = struct.pack(">I", 144 + len(text))
    head[8:12] = bytes([2, 0x40, 0, 0])
    head[12:24] = b"mntrRGB XYZ "
    head[36:44] = b"acspAPPL"
    head[48:56] = b"nonenone"
    head[68:80] = struct.pack(">III", 0xF6D6, 0x10000, 0xD32D)
    head[80:84] = b"none"
    return bytes(head) + table + text


def make_inputs(to):
    to = Path(to)
    to.mkdir(parents=True, exist_ok=True)
    for make in (make_plain, make_integer, make_windows, make_special, make_layers, make_mips,
                 make_sequences):
        make(to)
    shutil.copytree(OCIO, to / "ocio")
    return to
