#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the small images that are easy to get wrong: make_edges.py [FOLDER] (default: its own).

Every value is an integer, a dyadic fraction or one matrix product of such, so that a second run
gives the same pixels anywhere.
"""
import pathlib
import sys

import numpy as np
import OpenImageIO as oiio

WIDTH, HEIGHT = 64, 48
CENTER = (HEIGHT // 2, WIDTH // 2)
RGB = ("R", "G", "B")
EPOCH = "2026:01:01 00:00:00"  # else the time of writing would be in the file

# CIE x, y of red, green, blue and white.
REC709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
AP1 = (0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767)
BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367],
                     [0.0389, -0.0685, 1.0296]])


def plain(width=WIDTH, height=HEIGHT, left=0, top=0):
    """A colourful ramp, 1/64 to 16, as [row, column, channel]; (left, top) is its first pixel."""
    y, x = np.mgrid[top:top + height, left:left + width].astype(np.float64)
    red = (x % 64 + 1) / 64
    green = (y % 48 + 1) / 64
    blue = ((x + 2 * y) % 64 + 1) / 64
    bright = np.where((x // 16 + y // 16) % 3 == 0, 16.0, 1.0)
    return np.dstack([red, green, blue]) * bright[:, :, None]


def with_pixel(value, at=CENTER):
    image = plain()
    image[at] = value
    return image


def constant(red, green, blue):
    return np.tile(np.array([red, green, blue], dtype=np.float64), (HEIGHT, WIDTH, 1))


def xyz_from_rgb(chromaticities):
    """Matrix of the primaries, scaled so that (1, 1, 1) is the white of luminance 1."""
    x, y = np.array(chromaticities[0::2]), np.array(chromaticities[1::2])
    columns = np.array([x / y, np.ones(4), (1 - x - y) / y])
    primaries, white = columns[:, :3], columns[:, 3]
    return primaries * np.linalg.solve(primaries, white), white


def ap1_from_rec709():
    """By Bradford adaptation from D65 to the white of ACES."""
    from_709, d65 = xyz_from_rgb(REC709)
    from_ap1, d60 = xyz_from_rgb(AP1)
    scale = np.diag((BRADFORD @ d60) / (BRADFORD @ d65))
    return np.linalg.inv(from_ap1) @ np.linalg.inv(BRADFORD) @ scale @ BRADFORD @ from_709


def write(path, pixels, channels=RGB, display=None, origin=(0, 0), chromaticities=None,
          compression="zip", fmt=oiio.FLOAT):
    """display: width, height of the display window at (0, 0); origin: x, y of the data window."""
    height, width, count = pixels.shape
    assert count == len(channels)
    spec = oiio.ImageSpec(width, height, count, fmt)
    spec.channelnames = tuple(channels)
    spec.x, spec.y = origin
    spec.full_width, spec.full_height = display or (width, height)
    if path.suffix == ".exr":
        spec.attribute("compression", compression)
        spec.attribute("DateTime", EPOCH)
    else:
        spec.attribute("oiio:ColorSpace", "sRGB")
    if chromaticities:
        spec.attribute("chromaticities", "float[8]", chromaticities)
    out = oiio.ImageOutput.create(str(path))
    if not (out and out.open(str(path), spec) and out.write_image(pixels) and out.close()):
        raise RuntimeError(f"{path}: {out.geterror() if out else oiio.geterror()}")


def write_rgb(folder):
    black = np.zeros((HEIGHT, WIDTH, 3))
    mostly_black = plain()
    mostly_black[:, :WIDTH * 5 // 8] = 0
    images = {
        "plain": plain(),
        "black": black,
        "mostly_black": mostly_black,
        "nan_last": with_pixel(np.nan, (HEIGHT - 1, WIDTH - 1)),
        "nan_center": with_pixel(np.nan),
        "inf": with_pixel(np.inf),
        "negative": with_pixel(-1.0),
        "huge": with_pixel(1e30),
        "constant": constant(0.5, 0.5, 0.5),
        "green": constant(0, 1, 0),
        "blue": constant(0, 0, 1),
        "white": constant(1, 1, 1),
        "one_pixel": constant(0.25, 0.5, 1)[:1, :1],
    }
    for name, pixels in images.items():
        write(folder / f"{name}.exr", pixels.astype(np.float32))


def write_channels(folder):
    image = plain().astype(np.float32)
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH].astype(np.float32)
    ramp = ((x + 1) / WIDTH)[:, :, None]
    write(folder / "y_only.exr", image[:, :, 1:2], ["Y"])
    write(folder / "rgba.exr", np.dstack([image * ramp, ramp]), RGB + ("A",))
    beauties = [f"{side}.beauty.{c}" for side in ("left", "right") for c in RGB]
    write(folder / "two_beauties.exr", np.dstack([image, image[:, ::-1]]), beauties)
    zero, one = np.zeros_like(x), np.ones_like(x)
    aovs = {"albedo.R": image[:, :, 0] / 16, "albedo.G": image[:, :, 1] / 16,
            "albedo.B": image[:, :, 2] / 16, "N.X": zero, "N.Y": zero, "N.Z": one,
            "P.X": x, "P.Y": y, "P.Z": zero, "depth.Z": one * 4}
    write(folder / "aovs_only.exr", np.dstack(list(aovs.values())), list(aovs))


def write_windows(folder):
    display = (WIDTH, HEIGHT)
    write(folder / "datawindow.exr", plain(40, 30, 12, 10).astype(np.float32), display=display,
          origin=(12, 10))
    write(folder / "overscan.exr", plain(80, 60, -8, -6).astype(np.float32), display=display,
          origin=(-8, -6))


def write_colors(folder):
    image = plain()
    write(folder / "rec709.exr", image.astype(np.float32), chromaticities=REC709)
    write(folder / "acescg.exr", (image @ ap1_from_rec709().T).astype(np.float32),
          chromaticities=AP1)
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    codes = np.dstack([x * 4 + 3, y * 5 + 10, (x + y) * 2 + 1])
    write(folder / "srgb8.png", codes.astype(np.uint8), fmt=oiio.UINT8)
    write(folder / "srgb16.png", (codes * 257).astype(np.uint16), fmt=oiio.UINT16)


def write_deep(folder):
    """Two samples in every pixel, none in the first column."""
    channels = ("R", "G", "B", "A", "Z")
    spec = oiio.ImageSpec(WIDTH, HEIGHT, len(channels), oiio.FLOAT)
    spec.channelnames = channels
    spec.deep = True
    spec.attribute("DateTime", EPOCH)
    deep = oiio.DeepData()
    deep.init(WIDTH * HEIGHT, len(channels), [oiio.FLOAT] * len(channels), channels)
    image = plain()
    for pixel in range(WIDTH * HEIGHT):
        y, x = divmod(pixel, WIDTH)
        deep.set_samples(pixel, 0 if x == 0 else 2)
        for sample in range(deep.samples(pixel)):
            values = [*(image[y, x] / 2), 0.5, 1.0 + sample]
            for channel, value in enumerate(values):
                deep.set_deep_value(pixel, channel, sample, float(value))
    path = folder / "deep.exr"
    out = oiio.ImageOutput.create(str(path))
    if not (out.open(str(path), spec) and out.write_deep_image(deep) and out.close()):
        raise RuntimeError(f"{path}: {out.geterror()}")


def write_broken(folder):
    whole = folder / "truncated.exr"
    write(whole, plain().astype(np.float32), compression="none")
    whole.write_bytes(whole.read_bytes()[:whole.stat().st_size * 6 // 10])
    (folder / "not_an_image.exr").write_text("This is a text, whatever its name says.\n")


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__)
    folder = folder if folder.is_dir() else folder.resolve().parent
    for step in (write_rgb, write_channels, write_windows, write_colors, write_deep, write_broken):
        step(folder)


if __name__ == "__main__":
    main()
