#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What TMQI does not see in pictures of --cgtmo, as Markdown tables: tone_measures.py TONETOOL TESTIMAGES [SHEET]

Of the renders in the folder TESTIMAGES: the order of neighbours, the noise of flat surfaces, the hue of
what is clipped, the error of the samples, and flicker over frames. SHEET is a picture of the five."""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from OpenImageIO import ImageBufAlgo as iba

SCENES = ("cornell", "nightstreet", "gallery")
KINDS = {"preset=classic": "preset=classic", "filter=wls": "filter=wls", "default": ""}
# Shots: frames, and the kinds of pictures that are made of them.
ANIM = {"preset=classic, adapt=frame": "preset=classic:adapt=frame",
        "filter=wls, adapt=frame": "filter=wls:adapt=frame", "adapt=frame": "adapt=frame",
        "adapt=shot": "adapt=shot"}
STILL = {**ANIM, "adapt=shot, steady=1": "adapt=shot:steady=1"}
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
GUIDES = [f"ViewLayer.{layer}.{axis}" for layer, axes in
          (("Position", "XYZ"), ("Normal", "XYZ"), ("DiffCol", "RGB"), ("Depth", "Z")) for axis in axes]

# The sheet: parts of 30x18 pixels, each of 8x8, which are whole blocks of a JPEG.
SCALE, PART, GAP, LINE = 8, (30, 18), 8, 24
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
INK, DIM, MARK = (0.9, 0.9, 0.9), (0.45, 0.45, 0.45), (1, 0.1, 0.1)
QUALITY = 80


def layer(path, *names):
    """Channels of an image, float."""
    image = oiio.ImageBuf(str(path))
    have = list(image.spec().channelnames)
    return image.get_pixels(oiio.FLOAT)[..., [have.index(name) for name in names]].astype(float)


def colour(path):
    prefix = "" if "R" in oiio.ImageBuf(str(path)).spec().channelnames else "ViewLayer.Combined."
    return layer(path, *(prefix + channel for channel in "RGB"))


def ln(pixels):
    """The natural logarithm of the luminance."""
    return np.log(np.maximum(pixels @ LUMINANCE, 1e-6))


class Program:
    """tonetool, in a folder of its own."""

    def __init__(self, path, folder):
        self.path, self.folder, self.made = path, Path(folder), 0

    def run(self, *words):
        done = subprocess.run([self.path, "-q", *map(str, words)], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            sys.exit(f"tone_measures.py: exit status {done.returncode}\n{done.stderr}")

    def picture(self, image, options, frames=0):
        """Linear light of the picture of an image, or the pictures of frames from 1."""
        self.made += 1  # OpenImageIO remembers files by their names
        name = self.folder / f"{self.made}{'.#' if frames else ''}.exr"
        words = [f"--cgtmo:encode=none{options and ':' + options}", "-d", "float", "-o", name]
        self.run(*(["--frames", f"1-{frames}"] if frames else []), image, *words)
        made = [colour(str(name).replace("#", f"{k:04}")) for k in range(1, frames + 1)]
        return made or colour(name)


# --- What is measured ---


def wrong_order(light, shown):
    """Per cent of the neighbours whose light differs by 1.3 or more that the picture shows the other way
    round, by more than 3 %, and where they are. Light of 1e-4 and less is left out."""
    where, wrong, strong = np.zeros(light.shape[:2], bool), 0, 0
    for axis in (0, 1):
        dark = np.moveaxis(light @ LUMINANCE <= 1e-4, axis, 0)
        step = np.moveaxis(np.diff(ln(light), axis=axis), axis, 0)
        seen = np.moveaxis(np.diff(ln(shown), axis=axis), axis, 0) * np.sign(step)
        edge = (abs(step) > np.log(1.3)) & ~dark[1:] & ~dark[:-1]
        turned = edge & (seen < np.log(0.97))
        wrong, strong = wrong + turned.sum(), strong + edge.sum()
        np.moveaxis(where, axis, 0)[1:] |= turned
        np.moveaxis(where, axis, 0)[:-1] |= turned
    return 100 * wrong / strong, where


def neighbours(plane):
    """The four neighbours of all pixels but the outermost."""
    return [plane[:-2, 1:-1], plane[2:, 1:-1], plane[1:-1, :-2], plane[1:-1, 2:]]


def grain(pixels):
    logarithm = ln(pixels)
    return abs(logarithm[1:-1, 1:-1] - sum(neighbours(logarithm)) / 4)


def noise_gain(render, light, shown):
    """The contrast of noise in the picture over that in the light: where normal and albedo are those of the
    four neighbours, and the light has no edge."""
    normal, albedo = (layer(render, *names) for names in (GUIDES[3:6], GUIDES[6:9]))
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    normal = normal / np.maximum(length, 1e-9)
    flat = (length[1:-1, 1:-1, 0] > 1e-3) & (grain(light) < 0.3)
    for beside in neighbours(normal):
        flat &= (beside * normal[1:-1, 1:-1]).sum(-1) > 0.999
    for beside in neighbours(albedo):
        flat &= abs(beside - albedo[1:-1, 1:-1]).max(-1) < 0.01
    return np.median(grain(shown)[flat]) / np.median(grain(light)[flat])


def hue_turned(free, shown):
    """Per cent of the pixels with a component beyond white while their luminance is not, and the angle in degrees
    by which the clip turns the hue of all but 5 % of them."""
    clipped = (free.max(-1) > 1.0001) & (free @ LUMINANCE <= 1)
    chroma = [(pixels - pixels.mean(-1, keepdims=True))[clipped] for pixels in (free, shown)]
    length = [np.linalg.norm(one, axis=-1) for one in chroma]
    coloured = (length[0] > 0.02) & (length[1] > 0.02)
    cosine = (chroma[0] * chroma[1]).sum(-1)[coloured] / (length[0] * length[1])[coloured]
    return 100 * clipped.mean(), np.degrees(np.percentile(np.arccos(np.clip(cosine, -1, 1)), 95))


def flicker(lights, shown):
    """Of pixels whose light changes by less than a fifth between two frames: how the exposure goes from the
    first frame on, the largest step of it in per cent, and the change of the picture's light over that of the light,
    which is noise where the shot is still."""
    steps, seen, there = [], [], []
    for before, after, old, new in zip(lights, lights[1:], shown, shown[1:]):
        change, picture = ln(after) - ln(before), ln(new) - ln(old)
        same = (abs(change) < 0.2) & (np.minimum(after, before) @ LUMINANCE > 1e-4)
        steps.append(np.median((picture - change)[same]))
        seen.append(np.percentile(abs(picture[same]), 95))
        there.append(np.percentile(abs(change[same]), 95))
    path = 100 * np.expm1(np.cumsum([0, *steps]))
    return path, 100 * np.expm1(np.abs(steps).max()), np.mean(seen) / np.mean(there)


class Measured:
    """One render by one kind of --cgtmo, with the numbers of the table."""

    def __init__(self, program, folder, scene, kind):
        render, noisy = (Path(folder) / f"{scene}_{name}.exr" for name in ("ref", "test"))
        more = ":".join(filter(None, [KINDS[kind], "clamp=0"]))
        self.light, self.noisy = colour(render), colour(noisy)
        self.free, self.shown = program.picture(render, more), program.picture(render, KINDS[kind])
        self.noisy_shown = program.picture(noisy, more)
        self.order_free, _ = wrong_order(self.light, self.free)
        self.order, self.wrong = wrong_order(self.light, self.shown)
        self.noise = noise_gain(render, self.light, self.free)
        self.noise_noisy = noise_gain(noisy, self.noisy, self.noisy_shown)
        self.clipped, self.turned = hue_turned(self.free, self.shown)
        self.error = np.zeros(self.light.shape[:2])
        if kind != "filter=wls":  # which is solved for the whole image
            self.error = ln(self.free) - ln(program.picture(render, f"{more}:samples=0"))
        self.sampling = 100 * np.sqrt((self.error ** 2).mean())

    def cells(self):
        return [f"{self.order_free:.2f}", f"{self.order:.2f}", f"{self.noise:.3f}",
                f"{self.noise_noisy:.3f}", f"{self.clipped:.2f}", f"{self.turned:.1f}",
                f"{self.sampling:.2f}"]


def still_shot(program, folder):
    """Five renders of a still scene with different noise, and the guides of the scene."""
    for frame in range(1, 6):
        program.run(Path(folder) / f"seeds/approved.{frame}.exr", Path(folder) / "gallery_ref.exr", "--ch",
                    ",".join(GUIDES), "--chappend", "-d", "float", "-o",
                    program.folder / f"still.{frame:04}.exr")
    return program.folder / "still.#.exr"


def shots(program, folder):
    """Of both shots the frames, and by the kinds of pictures: the pictures and their flicker."""
    found = {}
    for name, image, count, kinds in (("anim", Path(folder) / "anim/ref.#.exr", 8, ANIM),
                                      ("still", still_shot(program, folder), 5, STILL)):
        lights = [colour(str(image).replace("#", f"{frame:04}")) for frame in range(1, count + 1)]
        found[name] = (lights, {})
        for kind, options in kinds.items():
            shown = program.picture(image, f"{options}:clamp=0", count)
            found[name][1][kind] = (shown, *flicker(lights, shown))
    return found


def print_table(head, rows):
    for cells in (head, ["---", *["--:"] * (len(head) - 1)], *rows):
        print("| " + " | ".join(cells) + " |")


def print_tables(scenes, found):
    print_table(["scene, kind", "wrong order %", "clipped, too %", "noise", "noise, 8 samples",
                 "beyond white %", "hue turned", "sampling %"],
                [[f"{scene}, {kind}", *one.cells()] for (scene, kind), one in scenes.items()])
    print()
    print_table(["shot, kind", "exposure jumps %", "noise seen"],
                [[f"{name}, {kind}", f"{jump:.2f}", f"{seen:.3f}" if name == "still" else "-"]
                 for name, (_, kinds) in found.items() for kind, (_, _, jump, seen) in kinds.items()])
