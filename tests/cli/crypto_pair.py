# SPDX-License-Identifier: BSD-3-Clause
"""A small render with light groups, Cryptomatte and depth, and changes of it."""

import json
import struct

import numpy as np
import OpenImageIO as oiio

WIDTH, HEIGHT = 64, 48


def id_of(name):
    """MurmurHash3_x86_32 of a name, seed 0, as Cryptomatte wants it."""
    data, most = name.encode(), 0xffffffff
    h = 0

    def mixed(k):
        k = k * 0xcc9e2d51 & most
        return (k << 15 | k >> 17) * 0x1b873593 & most

    whole = len(data) // 4 * 4
    for (k,) in struct.iter_unpack("<I", data[:whole]):
        h ^= mixed(k)
        h = (h << 13 | h >> 19) & most
        h = h * 5 + 0xe6546b64 & most
    if data[whole:]:
        h ^= mixed(int.from_bytes(data[whole:], "little"))
    h ^= len(data)
    for factor, by in ((0x85ebca6b, 16), (0xc2b2ae35, 13), (1, 16)):
        h = (h ^ h >> by) * factor & most
    return h ^ 1 << 23 if h >> 23 & 255 in (0, 255) else h


class Render:
    """What is rendered; change it, then write() it."""

    def __init__(self, seed=1):
        self.lights = {"key": 1.0, "fill": 0.25}
        self.ball = (10, 12)
        self.color = (0.5, 0.5, 0.5)
        self.names = {"floor": "floor", "ball": "ball", "box": "box"}
        self.noise = np.random.default_rng(seed)
        self.attributes = {}

    def layers(self):
        y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float32)
        objects = np.full((HEIGHT, WIDTH), "floor")
        objects[8:40, 40:56] = "box"
        left, top = self.ball
        objects[top:top + 16, left:left + 14] = "ball"
        albedo = np.where((objects == "ball")[..., None], self.color, (0.8, 0.7, 0.6))
        made = {}
        for light, power in self.lights.items():
            fall = (4 + (x if light == "key" else WIDTH - x)) / 32
            made[f"View.Combined_{light}"] = (
                power * albedo * fall[..., None] * self.noise.uniform(0.9, 1.1, (HEIGHT, WIDTH, 1)))
        made["View.Combined"] = sum(made.values())
        depth = np.select([objects == "ball", objects == "box"], [3.0, 4.0], 6.0)
        made["View.Depth"] = depth[..., None]
        bits = np.zeros((HEIGHT, WIDTH), np.uint32)
        for name in self.names:
            bits[objects == name] = id_of(self.names[name])
        ids = bits.view(np.float32)
        zero = np.zeros_like(ids)
        made["View.CryptoObject00"] = np.stack([ids, np.ones_like(ids), zero, zero], -1)
        return made

    def write(self, path):
        layers = self.layers()
        names = []
        for layer, values in layers.items():
            components = {1: "Z", 3: "RGB", 4: "rgba"}[values.shape[2]]
            names += [f"{layer}.{c}" for c in components]
        spec = oiio.ImageSpec(WIDTH, HEIGHT, len(names), "float")
        spec.channelnames = tuple(names)
        start = "cryptomatte/1234567/"
        manifest = {name: f"{id_of(name):08x}" for name in self.names.values()}
        given = {"name": "View.CryptoObject", "hash": "MurmurHash3_32", "conversion": "uint32_to_float32",
                 "manifest": json.dumps(manifest), **self.attributes}
        for key, value in given.items():
            if value is not None:
                spec.attribute(start + key, value)
        out = oiio.ImageOutput.create(str(path))
        assert out and out.open(str(path), spec), oiio.geterror()
        pixels = np.concatenate(list(layers.values()), -1)
        assert out.write_image(np.ascontiguousarray(pixels, np.float32)), out.geterror()
        out.close()
        return path.name
