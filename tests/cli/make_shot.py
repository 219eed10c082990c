# SPDX-License-Identifier: BSD-3-Clause
"""Makes a small rendered-looking shot of 20 frames, and breaks one of them.

    make_shot.py FOLDER [--fault NAME] [--noisy] [--cut]

A camera moves over a textured wall with a ball and a lamp before it. Layers: the picture with
alpha, its light groups key and env, which add up to it, Depth and Normal. shot.0001.exr to shot.0020.exr.
"""

import argparse
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

WIDTH, HEIGHT, FRAMES = 96, 54, 20
LAYER = "ViewLayer."
COLORS = ("Combined", "Combined_key", "Combined_env")
CHANNELS = ([LAYER + "Combined." + c for c in "RGBA"] +
            [f"{LAYER}{name}.{c}" for name in COLORS[1:] for c in "RGB"] +
            [LAYER + "Depth.Z"] + [LAYER + "Normal." + c for c in "XYZ"])


class Frame:
    """Layers as arrays, and what the header says."""

    def __init__(self, layers):
        self.layers = layers
        self.compression = "zip"
        self.kind = "half"
        self.attributes = {"Software": "renderer 4.2", "PixelAspectRatio": 1.0, "camera": "main"}
        self.window = (0, 0)  # origin of the data window
        self.display = (WIDTH, HEIGHT)
        self.channels = list(CHANNELS)

    def pixels(self):
        flat = {LAYER + "Depth.Z": self.layers["Depth"]}
        for name in (*COLORS, "Normal"):
            for i, c in enumerate("XYZ" if name == "Normal" else "RGB"):
                flat[f"{LAYER}{name}.{c}"] = self.layers[name][..., i]
        flat[LAYER + "Combined.A"] = self.layers["Alpha"]
        return np.stack([flat[c] for c in self.channels], axis=-1).astype(np.float32)

    def write(self, path):
        pixels = self.pixels()
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], self.kind)
        spec.channelnames = tuple(self.channels)
        spec.channelformats = tuple(
            oiio.TypeDesc("float" if c.endswith(("X", "Y", "Z")) else self.kind)
            for c in self.channels)
        spec.x, spec.y = self.window
        spec.full_width, spec.full_height = self.display
        spec.attribute("compression", self.compression)
        for key, value in self.attributes.items():
            spec.attribute(key, value)
        output = oiio.ImageOutput.create(str(path))
        assert output.open(str(path), spec), output.geterror()
        assert output.write_image(pixels), output.geterror()
        output.close()


def texture(x, y, seed):
    """Light and dark patches of several sizes, the same for a seed."""
    rng = np.random.default_rng(seed)
    value = np.zeros_like(x)
    for size in (40, 17, 7):
        a, b, c, d = rng.uniform(0, 2 * np.pi, 4)
        value += np.sin(x / size * 2.1 + a + np.sin(y / size + b)) * np.sin(y / size * 1.7 + c + d)
    return value


def scene(number, seed):
    """The layers of a frame without noise and lamp, by the seed of its scene; where the lamp is."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH].astype(float)
    rng = np.random.default_rng(seed + 100)
    pan, tint, lamp = rng.uniform(0.5, 1.2), rng.uniform(0.4, 1, 3), rng.uniform(0.2, 0.8, 2)
    wall = np.exp2(1.2 * texture(x + pan * number, y + 0.3 * number, seed) - 1.5)
    env = wall[..., None] * tint
    center = (12 + 3.4 * number % WIDTH, HEIGHT * (0.5 + 0.2 * np.sin(number / 4 + seed)))
    distance = np.hypot(x - center[0], y - center[1])
    ball = np.clip(9 - distance, 0, 1)
    key = 0.15 * wall[..., None] * rng.uniform(0.5, 1, 3)
    key += (ball * 1.5 * np.clip(1 - distance / 12, 0, 1))[..., None] * np.array([1, 0.8, 0.5])
    env = env * (1 - 0.8 * ball[..., None])
    # A small lamp, as bright as a firefly, that moves with the wall.
    at = int(lamp[1] * HEIGHT), int(lamp[0] * WIDTH - pan * number) % WIDTH
    normal = np.stack([np.clip((x - center[0]) / 9, -1, 1) * ball,
                       np.clip((y - center[1]) / 9, -1, 1) * ball, 1 - 0.5 * ball], axis=-1)
    return {"Combined_key": key, "Combined_env": env, "Depth": 10 - 3 * ball, "Normal": normal,
            "Alpha": np.ones((HEIGHT, WIDTH))}, at


def add_noise(layers, number, samples=8):
    """Noise of so many samples a pixel: of the mean, skewed, with pixels that no sample lit."""
    rng = np.random.default_rng(1000 + number)
    for name in COLORS[1:]:
        shape = samples * 0.25
        noise = rng.gamma(shape, 1 / shape, (HEIGHT, WIDTH, 1))
        spikes = rng.pareto(2.5, (HEIGHT, WIDTH, 1)) * (rng.random((HEIGHT, WIDTH, 1)) < 0.01)
        layers[name] = layers[name] * (noise + 2 * spikes)


def make_frame(number, noisy=False, cut=False):
    layers, lamp = scene(number, 7 if cut and number > FRAMES // 2 else 3)
    if noisy:
        add_noise(layers, number)
    layers["Combined_key"][lamp] += 300
    add_up(layers)
    return Frame(layers)


def add_up(layers):
    layers["Combined"] = layers["Combined_key"] + layers["Combined_env"]


def light(frame, gain):
    for name in COLORS:
        frame.layers[name] = frame.layers[name] * gain


def patch(layer, value, count=3):
    def change(frame):
        frame.layers[layer][20, 30:30 + count] = value
    return change


def replace(**values):
    def change(frame):
        for name, value in values.items():
            setattr(frame, name, value)
    return change


def blacken(*names):
    def change(frame):
        for name in names:
            frame.layers[name] = np.zeros_like(frame.layers[name])
        add_up(frame.layers)
    return change


def without(ending):
    def change(frame):
        frame.channels = [c for c in frame.channels if ending not in c]
    return change


def negative(frame):
    frame.layers["Combined_env"][20, 30, 2] = -0.25
    add_up(frame.layers)


def firefly(frame):
    frame.layers["Combined_env"][40, 70] = 900
    add_up(frame.layers)


def one_color(frame):
    for name in COLORS:
        frame.layers[name] = np.full((HEIGHT, WIDTH, 3), 0.5 if name == "Combined" else 0.25)


def unlike_groups(frame):
    frame.layers["Combined_env"] = frame.layers["Combined_env"] * 0.9


def crop(frame):
    frame.layers = {name: layer[2:-2, 3:-3] for name, layer in frame.layers.items()}
    frame.window = (3, 2)


def metadata(frame):
    frame.attributes["Software"] = "renderer 4.1"


def camera(frame):
    frame.attributes["camera"] = "persp"


def hole(frame):
    """A bucket that was not rendered."""
    for layer in frame.layers.values():
        layer[16:28, 40:56] = 0


def other_noise(frame):
    """Other seeds, the same moment."""
    rng = np.random.default_rng(1)
    for name in COLORS[1:]:
        frame.layers[name] = frame.layers[name] * rng.uniform(0.9, 1.1, (HEIGHT, WIDTH, 1))
    add_up(frame.layers)


def enlarged(frame):
    """Half the resolution, each pixel twice."""
    for name in COLORS:
        half = frame.layers[name][::2, ::2]
        frame.layers[name] = np.repeat(np.repeat(half, 2, 0), 2, 1)


def nearly(frame):
    """Nearly the same picture, where no layer tells the moment: its depth is a mean of samples."""
    rng = np.random.default_rng(1)
    for name in COLORS[1:]:
        frame.layers[name] = frame.layers[name] * rng.uniform(0.999, 1.001, (HEIGHT, WIDTH, 1))
    frame.layers["Depth"] = frame.layers["Depth"] * rng.uniform(0.999, 1.001, (HEIGHT, WIDTH))
    add_up(frame.layers)


# The code of the fault, the first frame that has it, what is done to the frames first to last.
FAULTS = {
    "missing": ("missing", 8, 8, None),
    "duplicate": ("duplicate", 9, 9, lambda frame: None),
    "near-duplicate": ("nearduplicate", 9, 9, nearly),
    "duplicate-other-noise": ("duplicate", 9, 9, other_noise),
    "frozen": ("frozen", 9, 13, lambda frame: None),
    "frozen-at-the-end": ("frozen", 16, 20, lambda frame: None),
    "repeat": ("repeat", 15, 15, other_noise),
    "hole": ("hole", 10, 10, hole),
    "black": ("black", 6, 6, blacken(*COLORS)),
    "constant": ("constant", 6, 6, one_color),
    "nan": ("nan", 7, 7, patch("Combined", np.nan)),
    "nan-data": ("nan", 7, 7, patch("Normal", np.nan, 1)),
    "inf": ("inf", 12, 12, patch("Combined", np.inf)),
    "negative": ("negative", 4, 4, negative),
    "firefly": ("firefly", 13, 13, firefly),
    "light": ("light", 11, 20, lambda frame: light(frame, 1.6)),
    "flicker": ("flicker", 5, 5, lambda frame: light(frame, 0.7)),
    "flicker-two": ("flicker", 5, 6, lambda frame: light(frame, 1.5)),
    "data-window": ("datawindow", 10, 10, crop),
    "display-window": ("displaywindow", 10, 10, replace(display=(WIDTH + 8, HEIGHT))),
    "channels": ("channels", 14, 14, without("Combined.A")),
    "type": ("type", 14, 14, replace(kind="float")),
    "compression": ("compression", 14, 20, replace(compression="piz")),
    "metadata": ("metadata", 15, 20, metadata),
    "metadata-camera": ("metadata", 15, 20, camera),
    "proxy": ("proxy", 11, 11, enlarged),
    "alpha-empty": ("alphaempty", 16, 16, blacken("Alpha")),
    "alpha": ("alpha", 16, 16, patch("Alpha", 1.5)),
    "alpha-negative": ("alpha", 16, 16, patch("Alpha", -0.5)),
    "light-sum": ("lightsum", 17, 17, unlike_groups),
    "black-layer": ("blacklayer", 5, 5, blacken("Combined_key")),
    "black-layer-stays": ("blacklayer", 15, 20, blacken("Combined_key")),
    "black-data-layer": ("blacklayer", 15, 15, blacken("Normal")),
    "missing-layer": ("missinglayer", 18, 18, without("Combined_key")),
}


def moment_of(number, code, first):
    """What a broken frame shows."""
    if code in ("duplicate", "nearduplicate", "frozen"):
        return first - 1
    return 4 if code == "repeat" else number


def make_shot(folder, fault=None, noisy=False, cut=False):
    """Writes the frames; the code of the fault and the number of the first frame that has it."""
    code, first, last, change = FAULTS[fault] if fault else ("", 0, -1, None)
    for number in range(1, FRAMES + 1):
        broken = first <= number <= last
        if broken and code == "missing":
            continue
        frame = make_frame(moment_of(number, code, first) if broken else number, noisy, cut)
        if broken:
            change(frame)
        frame.attributes["DateTime"] = f"2024:05:01 10:00:{number:02d}"
        frame.write(Path(folder) / f"shot.{number:04d}.exr")
    return code, first


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--fault", choices=sorted(FAULTS))
    parser.add_argument("--noisy", action="store_true")
    parser.add_argument("--cut", action="store_true")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    make_shot(arguments.folder, arguments.fault, arguments.noisy, arguments.cut)
