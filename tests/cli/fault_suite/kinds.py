# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong with the frames of a shot, what must be found then, and shots without a fault.

A change takes (frame, number, render) and returns the frame as it came out of the farm, where
render(number, ...) makes another frame of the same shot.
"""

from collections import namedtuple

import numpy as np
from fault_suite.shots import (FAR, FIRST, GROUPS, HEIGHT, LAST, MIDDLE, WIDTH, lock, noise, pan)

ALL = range(FIRST, LAST + 1)


def colors(function):
    """Changes R, G, B of the picture and of its light groups."""
    def change(frame, number, render):
        for name in frame.colors():
            layer = frame.layers[name].copy()
            layer[..., :3] = function(layer[..., :3])
            frame.layers[name] = layer
        return frame
    return change


def layer(name, function):
    def change(frame, number, render):
        frame.layers[name] = function(frame.layers[name].copy())
        return frame
    return change


def every(function):
    """Each layer as a whole, for example mirrored."""
    def change(frame, number, render):
        frame.layers = {name: function(a).copy() for name, a in frame.layers.items()}
        return frame
    return change


def fill(rows, columns, value, names=None):
    def change(frame, number, render):
        for name in names or frame.layers:
            frame.layers[name][rows, columns] = value
        return frame
    return change


def part_of(rows, columns, other):
    """A rectangle of another frame, which the farm has left."""
    def change(frame, number, render):
        old = render(other)
        for name, a in frame.layers.items():
            a[rows, columns] = old.layers[name][rows, columns]
        return frame
    return change


def other(number, **how):
    return lambda frame, here, render: render(number, **how)


def without(*names):
    def change(frame, number, render):
        for name in names:
            del frame.layers[name]
        return frame
    return change


def header(**values):
    def change(frame, number, render):
        frame.attributes.update(values)
        return frame
    return change


def group(name, factor):
    def change(frame, number, render):
        frame.layers[name] = frame.layers[name] * factor
        frame.add_up()
        return frame
    return change


def swap(first, second):
    def change(frame, number, render):
        layers = frame.layers
        layers[first], layers[second] = layers[second], layers[first]
        return frame
    return change


def noisier(frame, number, render):
    rng = np.random.default_rng([77, number])
    for name in GROUPS:
        frame.layers[name] = frame.layers[name] * noise(rng, 8)
    frame.add_up()
    return frame


def swapped(frame, number, render):
    return render(MIDDLE + 1 if number == MIDDLE else MIDDLE)


def thing(frame):
    """An object before the wall."""
    depth = frame.layers["Depth"][..., 0]
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    return (depth < 25) & (np.hypot(x - 80, y - 50) < 20)


def without_texture(frame, number, render):
    found = thing(frame)
    for name in frame.colors():
        frame.layers[name][found, :3] *= (1.8, 0.02, 1.8)
    frame.layers["DiffCol"][found] = (1, 0, 1)
    return frame


def without_object(frame, number, render):
    found = thing(frame)
    for name, a in frame.layers.items():
        a[found] = a.max() if name == "Depth" else a[~found].mean(axis=0)
    return frame


def alpha(value):
    def change(frame, number, render):
        frame.layers["Combined"][..., 3] = value
        return frame
    return change


PROXY = every(lambda a: np.repeat(np.repeat(a[::2, ::2], 2, axis=0), 2, axis=1))
HOLE = fill(slice(32, 56), slice(80, 104), 0)

Kind = namedtuple("Kind", "shot frames change alone against")


# alone: all that --qc finds, as (frame, severity, code). against: what --against finds, at least, in
# each frame that has changed, as (severity, code); it finds nothing in others.
def kind(shot, frames, change, alone, against):
    found = [(frames[0], *words.split()) for words in alone]
    return Kind(shot, frames, change, found, {tuple(words.split()) for words in against})


def one(shot, change, *alone, against=()):
    return kind(shot, [MIDDLE], change, alone, against)


# From the first frame to the last, which only the approved version tells.
def whole(change, *against):
    return kind("pan", ALL, change, (), against)


# Layers that tell another moment, or another place.
GEOMETRY = ("error depth", "error position", "error id")
LIGHT = ("error colorblocks", "error groupblocks")

KINDS = {
    "hole": one("pan", HOLE, "error hole", against=("error depth", "error position")),
    "hole, fixed camera": one("lock", HOLE, "error hole",
                              against=("error depth", "error position")),
    "not a number": one("pan", fill(slice(40, 64), slice(80, 104), np.nan, ["Combined"]),
                        "error nan", "error hole", against=("error alpha",)),
    "stale bucket": one("pan", part_of(slice(40, 64), slice(80, 104), 1005), "error stalebucket",
                        against=GEOMETRY),
    "black": one("pan", colors(lambda a: a * 0), "error black",
                 against=("error color", "error group")),
    "frozen": kind("pan", range(1013, 1020), other(1012), ["error frozen"], GEOMETRY),
    "moment of another frame": one("pan", other(1003, seed=99), "error repeat", against=GEOMETRY),
    "swapped": kind("pan", [MIDDLE, MIDDLE + 1], swapped, ["warning order"], GEOMETRY),
    "mirrored, fixed camera": one("lock", every(lambda a: a[:, ::-1]), "warning flicker",
                                  "warning oddframe", against=(*GEOMETRY, "error normal")),
    "another camera at the end": kind("pan", [LAST], other(LAST, left=110, top=60),
                                      ["warning cutatend"], GEOMETRY),
    "object missing, fixed camera": kind("lock", range(MIDDLE, LAST + 1), without_object,
                                         ["warning pop"], GEOMETRY),
    "tint": one("pan", colors(lambda a: a * (1.1, 1, 0.9)), "warning tint", "warning tint",
                "warning saturation", against=LIGHT),
    "tint, fixed camera": one("lock", colors(lambda a: a * (1.1, 1, 0.9)), "warning tint",
                              "warning tint", "warning saturation", against=LIGHT),
    "noise": one("pan", noisier, "warning noise"),
    "noise, fixed camera": one("lock", noisier, "warning noise"),
    "clipped": one("pan", colors(lambda a: np.minimum(a, 1)), "warning clip", against=LIGHT),
    "texture missing": one("pan", without_texture, "warning magenta",
                           against=("error albedoblocks", "error colorblocks")),
    "proxy": one("pan", PROXY, "warning proxy", against=GEOMETRY),
    "a tenth brighter": one("pan", colors(lambda a: a * 1.1), "warning light",
                            against=("error colorblocks", "warning group")),
    "alpha empty": one("pan", alpha(0), "error alphaempty", against=("error alpha",)),
    "light group at 0.3": one("pan", group("Combined_rim", 0.3), "warning light",
                              against=("error group",)),
    "light groups swapped": one("pan", swap("Combined_env", "Combined_rim"), "warning layerlight",
                                "warning layerlight", against=("error group",)),
    "light group off": one("pan", group("Combined_key", 0), "error blacklayer",
                           against=("error color", "error group")),
    "depth of another frame": one("pan", layer("Depth", lambda a: pan(5).layers["Depth"]),
                                  "warning oddframe", against=("error depth",)),
    "layer missing": one("pan", without("Normal"), "error missinglayer",
                         against=("error layermissing",)),
    "normals with y for z": whole(layer("Normal", lambda a: a[..., [0, 2, 1]]), "error normal"),
    "depth in other units": whole(layer("Depth", lambda a: a * 100), "error depth"),
    "layer missing everywhere": whole(without("DiffCol"), "error layermissing"),
    "motion down for up": whole(layer("Vector", lambda a: a * (1, -1)), "error vector"),
    "other ids": whole(layer("CryptoObject00", lambda a: np.roll(a, 24, axis=1)), "error id"),
    "frames per second": whole(header(framesPerSecond=25.0), "error header"),
    "half a stop everywhere": whole(colors(lambda a: a * 2**0.5), "error color", "error group"),
    "light group off everywhere": whole(group("Combined_rim", 0), "error group"),
}


def times(name, factor):
    def change(layers, moment):
        layers[name] = layers[name] * factor(moment)
    return change


def faded(moment):
    frame = pan(moment)
    return colors(lambda a: a * np.clip((21 - moment) / 16, 0, 1))(frame, moment, pan)


def walks_in(moment):
    """An element on black that is in the picture from the seventh frame on."""
    frame = pan(moment)
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    shape = np.clip(1.5 - np.hypot((x + 17 - 6.5 * (moment - 6)) / 14, (y - 46) / 26), 0, 1)
    frame.layers = {name: a * shape[..., None] for name, a in frame.layers.items()}
    frame.layers["Combined"][..., 3] = shape
    frame.layers["Depth"] = np.where(shape[..., None] > 0, frame.layers["Depth"], FAR)
    return frame


SHAKES = np.random.default_rng(4).normal(0, 1.5, (LAST - FIRST + 2, 2))
FIRE = np.random.default_rng(4).uniform(0.6, 1.5, LAST - FIRST + 2)

# Shots without a fault, by the moment from 1 on, and all that may be told of them.
HEALTHY = {
    "pan": (pan, set()),
    "lock": (lock, set()),
    "fade-out": (faded, {("info", "black")}),
    "lamp switched on": (lambda i: lock(i, change=times("Combined_rim", lambda i: i >= 13)),
                         {("warning", "blacklayer")}),
    "on twos": (lambda i: pan(i // 2 * 2), set()),
    "on threes": (lambda i: pan(i // 3 * 3), set()),
    "still, then moves": (lambda i: pan(max(i, 10)), {("warning", "frozen")}),
    "few samples": (lambda i: pan(i, samples=8), set()),
    "walks in": (walks_in, {("info", "black")}),
    "shakes": (lambda i: pan(i, left=25 + SHAKES[i][0], top=25 + SHAKES[i][1]), set()),
    "fire": (lambda i: lock(i, change=times("Combined_rim", lambda i: FIRE[i])), set()),
}
