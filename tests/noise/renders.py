# SPDX-License-Identifier: BSD-3-Clause
"""The labelled renders of acceptance.py: scenes/seeds/SCENE/CHANGE.SEED.exr below the shared folder, 16
samples per pixel, twelve seeds of the approved version and four of each change, all independent."""

import functools
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

oiio.attribute("threads", 1)

SCENES = ("cornell", "gallery", "nightstreet")
SEEDS = range(101, 113)
CHANGED = range(201, 205)


class Missing(Exception):
    """A file that is not there."""


def read(path, layer=""):
    if not path.is_file():
        raise Missing(path)
    image = oiio.ImageBuf(str(path))
    names = list(image.spec().channelnames)
    pixels = image.get_pixels(oiio.FLOAT)
    if image.has_error:
        raise Missing(f"{path} ({image.geterror()})")
    return np.ascontiguousarray(pixels[..., [names.index(layer + c) for c in "RGB"]])


def mean(images):
    return np.mean(images, 0, dtype=np.float64).astype(np.float32)


class Renders:
    def __init__(self, shared):
        self.scenes = Path(shared) / "scenes"
        self.changed = functools.lru_cache(maxsize=None)(self.changed)
        self.mean = functools.lru_cache(maxsize=None)(self.mean)
        self.large = functools.lru_cache(maxsize=None)(self.large)

    def changed(self, scene, change, seeds=CHANGED):
        folder = self.scenes / "seeds" / scene
        return [read(folder / f"{change}.{seed:04d}.exr") for seed in seeds]

    def unchanged(self, scene):
        return self.changed(scene, "none", SEEDS)

    def mean(self, scene):
        """Of the twelve seeds: what stands for a converged reference."""
        return mean(self.unchanged(scene))

    def further(self, scene):
        """Four more renders of the approved version: all light times a factor is the picture times it."""
        return [image / np.float32(1.02) for image in self.changed(scene, "gain_1.02")]

    def large(self, scene, name):
        return read(self.scenes / scene / f"{name}.exr", "ViewLayer.Combined.")


def drawn(rng, images, count):
    """`count` images that draw each pixel from another one of `images`; and the mean of the others."""
    stack = np.stack(images)
    order = rng.permuted(np.broadcast_to(np.arange(len(images))[:, None, None],
                                         stack.shape[:3]), axis=0)[..., None]
    mixed = np.take_along_axis(stack, order, 0)
    return list(mixed[:count]), mean(mixed[count:])


def subsets(rng, count, *sizes):
    """Disjoint sets of these sizes of range(count)."""
    order = rng.permutation(count)
    ends = np.cumsum(sizes)
    return [sorted(order[end - size:end]) for size, end in zip(sizes, ends)]
