# SPDX-License-Identifier: BSD-3-Clause
"""Two shots that look like renders, 24 frames of 160x90, made from nothing.

pan    a camera that moves along a wall with balls before it, and zooms
lock   a fixed camera, before which a light moves
Both have the picture with alpha, its light groups key, env and rim, which add up to it, and the
layers DiffCol, Normal, Position, Depth.Z, Vector and CryptoObject00. Light has the noise of a
number of samples per pixel; the other layers have none. The same numpy gives the same pixels.
"""

import functools

import numpy as np
import OpenImageIO as oiio

WIDTH, HEIGHT = 160, 90
FIRST, LAST, MIDDLE = 1001, 1024, 1013
FAR = 1e10
GROUPS = ("Combined_key", "Combined_env", "Combined_rim")
APPROVED, NEW = {"samples": 256, "seed": 1}, {"samples": 64, "seed": 2}


class Frame:
    """Layers, all height x width x channels, and what the header says."""

    PARTS = {"Normal": "XYZ", "Position": "XYZ", "Vector": "XY", "Depth": "Z",
             "CryptoObject00": "rgba"}

    def __init__(self, layers, attributes):
        self.layers, self.attributes = layers, attributes
        self.compression, self.color_type, self.data_type = "zip", "half", "float"
        self.origin, self.display = (0, 0), (WIDTH, HEIGHT)

    def colors(self):
        return [name for name in self.layers if name.startswith("Combined")]

    def add_up(self):
        total = sum(self.layers[group] for group in GROUPS)
        alpha = self.layers["Combined"][..., 3:]
        self.layers["Combined"] = np.concatenate([total, alpha], axis=-1)

    def channels(self):
        """Name, data type and values of each."""
        for name, layer in self.layers.items():
            parts = self.PARTS.get(name, "RGBA")
            kind = self.color_type if parts == "RGBA" else self.data_type
            for i in range(layer.shape[2]):
                yield f"{name}.{parts[i]}", kind, layer[..., i]

    def write(self, path):
        names, kinds, planes = zip(*self.channels())
        pixels = np.stack(planes, axis=-1).astype(np.float32)
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kinds[0])
        spec.channelnames = names
        spec.channelformats = tuple(oiio.TypeDesc(kind) for kind in kinds)
        spec.x, spec.y = self.origin
        spec.full_width, spec.full_height = self.display
        spec.attribute("compression", self.compression)
        for key, value in self.attributes.items():
            spec.attribute(key, *(value if isinstance(value, tuple) else (value,)))
        output = oiio.ImageOutput.create(str(path))
        assert output.open(str(path), spec), output.geterror()
        assert output.write_image(pixels), output.geterror()
        output.close()


def waves(x, y, rng, sizes):
    """Light and dark of several sizes."""
    value = np.zeros(np.broadcast(x, y).shape)
    for size in sizes:
        a, b, c, d = rng.uniform(0, 2 * np.pi, 4)
        value += np.sin(x / size * 2.1 + a + np.sin(y / size + b)) * np.sin(y / size * 1.7 + c + d)
    return value


class World:
    """The layers without noise of all that a camera may see: a wall that recedes, and balls."""

    def __init__(self, seed, width=320, height=180, balls=70):
        rng = np.random.default_rng(seed)
        y, x = np.mgrid[0:height, 0:width].astype(float)
        depth = 30 - 0.02 * x + 0.01 * y + 0.3 * np.sin(x / 23)
        normal = np.stack([0.1 * np.cos(x / 23), np.full_like(x, -0.1), np.ones_like(x)], axis=-1)
        albedo = np.exp2(0.35 * waves(x, y, rng, (31, 11, 5)))[..., None] * (0.42, 0.36, 0.3)
        ids = np.full(x.shape, 77, np.uint32)
        for number in range(balls):
            cx, cy, radius = rng.uniform(0, width), rng.uniform(0, height), rng.uniform(6, 22)
            color, near = rng.uniform(0.1, 0.9, 3), rng.uniform(6, 24)
            inside = np.hypot(x - cx, y - cy) < radius
            inside &= depth > near
            across = np.stack([(x - cx) / radius, (y - cy) / radius], axis=-1)
            up = np.sqrt(np.maximum(1 - (across**2).sum(-1), 0))
            depth[inside] = (near - 0.1 * radius * up)[inside]
            normal[inside] = np.concatenate([across, up[..., None]], axis=-1)[inside]
            texture = np.exp2(0.3 * waves(x, y, rng, (7, 4)))[..., None]
            albedo[inside] = (color * texture)[inside]
            ids[inside] = number + 1000
        normal /= np.linalg.norm(normal, axis=-1)[..., None]
        self.smooth = {"DiffCol": np.clip(albedo, 0.02, 0.95), "Normal": normal}
        self.add_light(x, y, rng)
        position = np.stack([x * depth / 100, y * depth / 100, depth], axis=-1)
        bits = (ids * np.uint32(2654435761) & np.uint32(0x3FFFFF)) | np.uint32(0x3E000000)
        self.sharp = {"Depth": depth[..., None], "Position": position,
                      "ids": bits.view(np.float32)[..., None]}

    def add_light(self, x, y, rng):
        normal, albedo = self.smooth["Normal"], self.smooth["DiffCol"]
        toward = np.array([-0.5, -0.6, 0.62])
        key = np.maximum(normal @ toward, 0.05) * np.exp2(0.5 * waves(x, y, rng, (90, 40)))
        glint = np.maximum(normal @ np.array([-0.28, -0.34, 0.9]), 0) ** 60
        self.smooth["Combined_key"] = 1.5 * albedo * key[..., None] + 4 * glint[..., None]
        sky = 0.5 - 0.4 * normal[..., 1]
        self.smooth["Combined_env"] = albedo * sky[..., None] * (0.5, 0.65, 0.9)
        rim = (1 - np.abs(normal[..., 2])) ** 2 + 0.1
        self.smooth["Combined_rim"] = albedo * rim[..., None] * (0.6, 0.4, 0.3)

    def seen(self, left, top, scale):
        """What a camera sees: its smooth layers interpolated, the others by the nearest."""
        ys, xs = top + np.arange(HEIGHT) * scale, left + np.arange(WIDTH) * scale
        yi, xi = ys.astype(int), xs.astype(int)
        fy, fx = (ys - yi)[:, None, None], (xs - xi)[None, :, None]
        layers = {}
        for name, a in self.smooth.items():
            above = a[yi][:, xi] * (1 - fx) + a[yi][:, xi + 1] * fx
            below = a[yi + 1][:, xi] * (1 - fx) + a[yi + 1][:, xi + 1] * fx
            layers[name] = above * (1 - fy) + below * fy
        for name, a in self.sharp.items():
            layers[name] = a[yi][:, xi]
        return layers


@functools.lru_cache
def world(seed):
    return World(seed)


def noise(rng, samples):
    """Factors of the mean 1: skewed, as those of path tracers."""
    shape = samples * 0.25
    return rng.gamma(shape, 1 / shape, (HEIGHT, WIDTH, 1))


def finished(layers, moment, samples, seed, motion):
    """A frame of these layers, with noise in its light groups."""
    ids = layers.pop("ids")
    rest = np.zeros((HEIGHT, WIDTH, 2))
    for i, name in enumerate(GROUPS):
        rng = np.random.default_rng([seed, moment + 1000, i])
        layers[name] = np.float32(np.float16(layers[name] * noise(rng, samples)))
    order = {"Combined": np.ones((HEIGHT, WIDTH, 4)), **{name: layers[name] for name in GROUPS}}
    order.update(layers)
    order["Vector"] = np.broadcast_to(np.array(motion, float), (HEIGHT, WIDTH, 2)).copy()
    order["CryptoObject00"] = np.concatenate([ids, np.ones((HEIGHT, WIDTH, 1)), rest],
                                             axis=-1).astype(np.float32)
    hashed = "cryptomatte/7f1a2b3/"
    frame = Frame(order, {"Software": "renderer 4.2", "framesPerSecond": 24.0, "camera": "shotCam",
                          hashed + "name": "CryptoObject", hashed + "hash": "MurmurHash3_32",
                          hashed + "conversion": "uint32_to_float32"})
    frame.add_up()
    return frame


def pan(moment, samples=64, seed=2, left=20.0, top=20.0, change=None):
    layers = world(5).seen(left + 2.45 * moment, top + 0.55 * moment, 1 - 0.004 * moment)
    if change:
        change(layers, moment)
    return finished(layers, moment, samples, seed, (-2.45, 0.55))


def lock(moment, samples=64, seed=2, change=None):
    layers = world(6).seen(70.0, 40.0, 0.9)
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    spot = np.exp(-((x - 6 - 3 * moment)**2 + (y - 60)**2) / 9.0)
    layers["Combined_key"] = layers["Combined_key"] + spot[..., None] * (8, 7, 5)
    if change:
        change(layers, moment)
    return finished(layers, moment, samples, seed, (0, 0))


SHOTS = {"pan": pan, "lock": lock}
