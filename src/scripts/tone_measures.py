#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What TMQI does not see in pictures of --cgtmo, as Markdown tables:

    tone_measures.py TONETOOL TESTIMAGES [SHEET]

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

# The sheet: parts of 24x16 pixels, each of 8x8, which are whole blocks of a JPEG.
SCALE, PART, GAP, LINE = 8, (24, 16), 8, 24
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
INK, DIM, MARK = (0.9, 0.9, 0.9), (0.45, 0.45, 0.45), (1, 0.1, 0.1)
QUALITY = 62


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
    """Per cent of the pixels with a component beyond white while their luminance is not, and the largest angle
    in degrees by which the clip turns the hue of all but 5 % of them."""
    clipped = (free.max(-1) > 1.0001) & (free @ LUMINANCE <= 1)
    chroma = [(pixels - pixels.mean(-1, keepdims=True))[clipped] for pixels in (free, shown)]
    length = [np.linalg.norm(one, axis=-1) for one in chroma]
    coloured = (length[0] > 0.02) & (length[1] > 0.02)
    cosine = (chroma[0] * chroma[1]).sum(-1)[coloured] / (length[0] * length[1])[coloured]
    return 100 * clipped.mean(), np.degrees(np.percentile(np.arccos(np.clip(cosine, -1, 1)), 95))


def flicker(lights, shown):
    """Of pixels whose light changes by less than a fifth between two frames: the exposure of each frame
    against the first one, and its largest step, in per cent; and the change of the picture over that of the
    light, which is noise where the shot is still."""
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
    print_table(["scene, kind", "wrong order %", "after the clip %", "noise", "of 8 samples", "clipped %",
                 "hue turned", "samples %"],
                [[f"{scene}, {kind}", *one.cells()] for (scene, kind), one in scenes.items()])
    print()
    print_table(["shot, kind", "exposure jumps %", "noise seen"],
                [[f"{name}, {kind}", f"{jump:.2f}", f"{seen:.3f}" if name == "still" else "-"]
                 for name, (_, kinds) in found.items() for kind, (_, _, jump, seen) in kinds.items()])


# --- The sheet ---


def encoded(light):
    light = np.clip(light, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def grey(plane):
    return np.repeat(np.clip(plane, 0, 1)[..., None], 3, -1)


def part(pixels, place):
    x, y = place
    return pixels[y:y + PART[1], x:x + PART[0]]


def enlarged(pixels, tall=1):
    return np.kron(pixels, np.ones((SCALE * tall, SCALE, 1)))


def levelled(pixels):
    """Encoded, with the same median of the luminance."""
    return encoded(pixels * (0.25 / np.median(pixels @ LUMINANCE)))


def of(scenes, scene):
    """What a row shows of one scene: by kind, with the light first."""
    kinds = {kind: scenes[scene, kind] for kind in KINDS}
    return kinds["default"], kinds.values()


def order_row(scenes):
    place = (46, 20)
    any_kind, kinds = of(scenes, "cornell")
    cells = [("", enlarged(grey(0.55 + part(ln(any_kind.light), place) / 12)))]
    for one in kinds:
        cell = enlarged(part(encoded(grey(one.shown @ LUMINANCE)), place))
        for y, x in np.argwhere(part(one.wrong, place)) * SCALE:
            cell[y + 3:y + 5, x + 3:x + 5] = MARK
        cells.append((f"{one.order:.1f} %", cell))
    return "1  Order: pixels in the wrong order (dots)", cells


def noise_row(scenes):
    place = (22, 21)
    any_kind, kinds = of(scenes, "cornell")
    cells = [("1", any_kind.noisy), *((f"{one.noise_noisy:.2f}", one.noisy_shown) for one in kinds)]
    return ("2  Noise: what is left of that of the light",
            [(text, enlarged(levelled(part(pixels, place)))) for text, pixels in cells])


def hue_row(scenes):
    place = (46, 20)
    any_kind, kinds = of(scenes, "cornell")
    light = part(any_kind.light, place)
    cells = [("", light / light.max()), *((f"{one.turned:.0f} degrees", part(one.shown, place))
                                          for one in kinds)]
    return ("3  Hue: how far the clip turns it",
            [(text, enlarged(encoded(pixels))) for text, pixels in cells])


def sampling_row(scenes):
    place = (29, 19)
    any_kind, kinds = of(scenes, "nightstreet")
    cells = [("", encoded(part(any_kind.shown, place))),
             *((f"{one.sampling:.1f} %", grey(0.5 + 3 * part(one.error, place))) for one in kinds)]
    return ("4  Samples: the error of 80 pixels for the whole window",
            [(text, enlarged(pixels)) for text, pixels in cells])


def plot(paths):
    """Exposures over the frames, 10 % up and down, the last path in front."""
    width, height = PART[0] * SCALE, PART[1] * SCALE
    out = oiio.ImageBuf(oiio.ImageSpec(width, height, 3, "float"))
    iba.fill(out, (0.1, 0.1, 0.1))
    for level in (-5, 0, 5):
        y = round(height * (0.5 - level / 20))
        iba.render_box(out, 8, y, width - 9, y, DIM, True)
        iba.render_text(out, 8, y - 3, f"{level:+} %" if level else "0", 11, FONT, DIM)
    for ink, path in zip([DIM, INK][-len(paths):], paths):
        points = [(round(44 + frame * (width - 60) / 7), round(height * (0.5 - value / 20)))
                  for frame, value in enumerate(path)]
        for (x, y), (to_x, to_y) in zip(points, points[1:]):
            for down in (0, 1):
                iba.render_line(out, x, y + down, to_x, to_y + down, ink, True)
        for x, y in points:
            iba.render_box(out, x - 2, y - 2, x + 2, y + 3, ink, True)
    return out.get_pixels(oiio.FLOAT)


def exposure_row(found):
    _, kinds = found["anim"]
    names = list(kinds)
    cells = [("", enlarged(encoded(part(kinds["adapt=shot"][0][0], (12, 6)))))]
    for shown in (names[0:1], names[1:2], names[2:4]):
        cells.append((f"{kinds[shown[-1]][2]:.1f} %", plot([kinds[name][1] for name in shown])))
    return "5  Flicker: exposure of 8 frames, largest jump", cells


def noise_over_frames_row(found):
    place, row = (56, 2), 7
    _, kinds = found["still"]
    where = enlarged(levelled(part(kinds["adapt=shot"][0][0], place)))
    where[[row * SCALE - 1, (row + 1) * SCALE]] = (1, 1, 0)
    cells = [("", where)]
    for name, text in zip(("preset=classic, adapt=frame", "adapt=shot", "adapt=shot, steady=1"),
                          ("preset=classic: ", "default: ", "steady=1: ")):
        shown, _, _, seen = kinds[name]
        lines = np.stack([part(ln(one), place)[row] for one in shown])
        cells.append((f"{text}{seen:.2f}", enlarged(grey(0.5 + 1.2 * (lines - lines.mean())), 3)))
    return "    Flicker: one row of pixels, 5 frames downwards, noise that is seen", cells


def draw(scenes, found, sheet):
    rows = [order_row(scenes), noise_row(scenes), hue_row(scenes), sampling_row(scenes),
            exposure_row(found), noise_over_frames_row(found)]
    width, tall = PART[0] * SCALE + GAP, PART[1] * SCALE + 2 * LINE
    pixels = np.zeros((LINE + len(rows) * tall, 4 * width - GAP, 3), np.float32)
    words = [(0, name, column, INK) for column, name in enumerate(("the scene", *KINDS))]
    for y, (title, cells) in zip(range(LINE, pixels.shape[0], tall), rows):
        words.append((y, title, 0, INK))
        for column, (text, cell) in enumerate(cells):
            pixels[y + LINE:y + LINE + cell.shape[0],
                   column * width:column * width + cell.shape[1]] = cell
            words.append((y + tall - LINE, text, column, INK))
    out = oiio.ImageBuf(oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, "uint8"))
    out.set_pixels(out.roi, pixels)
    for y, text, column, ink in words:
        iba.render_text(out, column * width + 2, y + LINE - 7, text, 14, FONT, ink)
    out.specmod().attribute("oiio:ColorSpace", "sRGB")
    out.specmod().attribute("Compression", f"jpeg:{QUALITY}")
    if not out.write(sheet):
        sys.exit(out.geterror())


def main(program, folder, sheet=None):
    with tempfile.TemporaryDirectory() as made:
        tonetool = Program(program, made)
        scenes = {(scene, kind): Measured(tonetool, folder, scene, kind)
                  for scene in SCENES for kind in KINDS}
        found = shots(tonetool, folder)
    print_tables(scenes, found)
    if sheet:
        draw(scenes, found, sheet)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
