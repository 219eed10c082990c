# SPDX-License-Identifier: BSD-3-Clause
"""steady=1 of --cgtmo: the detail of a shot's frames by the frames about each, along its surfaces."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

SHARED = Path(os.environ.get("SHARED_DIR", ""))
ANIM, MEASURES = SHARED / "scenes" / "anim" / "ref.#.exr", SHARED / "tools/picture_measures.py"
needs_scenes = pytest.mark.skipif(not MEASURES.exists() or not ANIM.parent.exists(),
                                  reason="SHARED_DIR has no tools and scenes/anim")
WIDTH, HEIGHT = 96, 54
LIGHT = "encode=none:clamp=0"
WEIGHTS = np.array([.2126, .7152, .0722])
GUIDES = ["P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B"]
MOTION = ["Vector.X", "Vector.Y", "Vector.Z", "Vector.W"]
CARD = 3  # pixels that the card goes to the right in each frame


def logarithm(file):
    """ln of the luminance of a picture of linear light."""
    image = oiio.ImageBuf(str(file))
    names = list(image.spec().channelnames)
    layer = "ViewLayer.Combined." if "ViewLayer.Combined.R" in names else ""
    pixels = image.get_pixels(oiio.FLOAT)
    return np.log(np.maximum(pixels[..., [names.index(layer + c) for c in "RGB"]] @ WEIGHTS, 1e-9))


def facts(ran, name):
    return [line.split(f": {name} ")[1] for line in ran.out.splitlines() if f": {name} " in line]


class Surfaces:
    """A wall, a floor and, if there is one, a card that moves before them, as a camera sees them."""

    def __init__(self, camera=0.0, card=None, depth_of_card=2.0):
        y, x = np.mgrid[:HEIGHT, :WIDTH]
        rays = np.stack([(x + .5 - WIDTH / 2) / WIDTH, (y + .5 - HEIGHT / 2) / WIDTH,
                         np.ones(x.shape)], -1)
        with np.errstate(divide="ignore"):
            floor = np.where(rays[..., 1] > 0, .6 / rays[..., 1], np.inf)
        depth = np.minimum(floor, 4)
        self.position = rays * depth[..., None] + [camera, 0, 0]
        self.normal = np.where((floor < 4)[..., None], [0., -1, 0], [0., 0, -1])
        self.albedo = np.where((floor < 4)[..., None], .3, [.5, .5, .6])
        self.motion = np.zeros((HEIGHT, WIDTH, 4))
        if card is not None:
            there = (x >= card) & (x < card + 24) & (y >= 8) & (y < 24)
            self.position[there] = rays[there] * depth_of_card + [camera, 0, 0]
            self.albedo[there] = .8
            self.motion[there] = [-CARD, 0, -CARD, 0]
            self.card = there
        across = self.position[..., 0] + .7 * self.position[..., 1]
        self.light = np.exp(.4 * np.sin(2 * across) + .3 * np.cos(3 * self.position[..., 2]))


@pytest.fixture
def write(tmp_path):
    """A frame of a shot; noise differs from frame to frame."""

    def write(number, surfaces, gain=1.0, noise=.2, without=(), seed=None, name="s", motion=False,
              change=None):
        random = np.random.default_rng(number if seed is None else seed)
        light = gain * surfaces.light * np.exp(noise * random.standard_normal((HEIGHT, WIDTH)))
        layers = [light[..., None] * surfaces.albedo, surfaces.position, surfaces.normal,
                  surfaces.albedo] + ([surfaces.motion] if motion else [])
        pixels = np.concatenate(layers, 2)
        if change:
            change(pixels)
        names = ["R", "G", "B"] + GUIDES + (MOTION if motion else [])
        kept = [i for i, channel in enumerate(names) if channel.split(".")[0] not in without]
        spec = oiio.ImageSpec(WIDTH, HEIGHT, len(kept), oiio.FLOAT)
        spec.channelnames = [names[i] for i in kept]
        image = oiio.ImageBuf(spec)
        image.set_pixels(spec.roi, np.ascontiguousarray(pixels[..., kept], np.float32))
        assert image.write(str(tmp_path / f"{name}.{number:04}.exr")), image.geterror()

    return write


@pytest.fixture
def shot(write):
    """Ten frames along a wall."""
    for number in range(1, 11):
        write(number, Surfaces(.05 * number))
    return "s.#.exr"


@pytest.fixture
def make(tonetool, tmp_path):
    """Pictures of linear light: their bytes by number."""

    def make(frames, options="", name="p", words=(), scene="s.#.exr", **status):
        more = f":{options}" if options else ""
        ran = tonetool("--no-history", "--frames", frames, *words, scene, f"--cgtmo:{LIGHT}{more}",
                       "-d", "float", "-o", f"{name}.#.exr", **status)
        made = {int(file.name.split(".")[-2]): file.read_bytes()
                for file in sorted(tmp_path.glob(f"{name}.*.exr"))}
        return ran, made

    return make


# ---- what it is for


def flicker(folder, scene, picture, *limits):
    done = subprocess.run([sys.executable, "-B", MEASURES, "flicker", "--scene", scene,
                           "--picture", picture, "--frames", "1-8", *limits], cwd=folder,
                          capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout)["visible"]


@needs_scenes
def test_the_animation_is_steady(make, tmp_path):
    make("1-8", "steady=1", scene=ANIM)
    steady = flicker(tmp_path, ANIM, "p.#.exr", "--global", ".002", "--visible", ".40")
    make("1-8", "", scene=ANIM)
    assert flicker(tmp_path, ANIM, "p.#.exr") > 1.5 * steady, "what the limit is against"


@needs_scenes
@pytest.mark.parametrize("off", [[5], [5, 6, 7, 8]])
def test_a_lamp_switched_off_shows_at_once(make, tmp_path, off):
    for number in range(1, 9):
        image = oiio.ImageBuf(str(ANIM).replace("#", f"{number:04}"))
        pixels, names = image.get_pixels(oiio.FLOAT), list(image.spec().channelnames)
        for c in "RGB":
            lamp = names.index(f"ViewLayer.Combined_neonC.{c}")
            if number in off:
                pixels[..., names.index(f"ViewLayer.Combined.{c}")] -= pixels[..., lamp]
                pixels[..., lamp] = 0
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], len(names), oiio.FLOAT)
        spec.channelnames = names
        lit = oiio.ImageBuf(spec)
        lit.set_pixels(spec.roi, pixels)
        assert lit.write(str(tmp_path / f"lamp.{number:04}.exr"))
    make("1-8", "", "still", scene="lamp.#.exr")
    ran, _ = make("1-8", "steady=1", scene="lamp.#.exr")
    assert facts(ran, "steady")[4] == "by frames 1-8", "a lamp is no cut"
    for number in (4, 5, 6):
        away = np.abs(logarithm(tmp_path / f"p.{number:04}.exr") -
                      logarithm(tmp_path / f"still.{number:04}.exr"))
        assert np.percentile(away, 95) <= .12
        assert away.max() > .05, "it is not the still"


def test_noise_of_surfaces_is_averaged(make, write, shot, tmp_path):
    make("1-10", "", "still")
    make("1-10", "steady=1")
    for number in range(1, 11):
        write(number, Surfaces(.05 * number), noise=0, name="clean")
    make("1-10", "adapt=shot", "clean_p", scene="clean.#.exr")
    for number in (1, 5, 10):
        clean = logarithm(tmp_path / f"clean_p.{number:04}.exr")
        rms = [np.std(logarithm(tmp_path / f"{name}.{number:04}.exr") - clean)
               for name in ("still", "p")]
        assert rms[1] < (.7 if number == 5 else .8) * rms[0]


# ---- what it depends on


@pytest.mark.parametrize("camera", [0, .05])
def test_a_still_that_is_repeated_stays_as_it_is(make, write, camera):
    for number in range(1, 7):
        write(number, Surfaces(camera), seed=1)
    _, still = make("1-6", "adapt=shot", "still")
    ran, steady = make("1-6", "steady=1")
    assert facts(ran, "steady") == [f"by frames 1-{min(6, number + 4)}" if number < 6 else
                                    "by frames 2-6" for number in range(1, 7)]
    assert steady == still and len(steady) == 6


def test_parts_orders_and_jobs_make_the_same_bytes(make, tonetool, shot, tmp_path):
    tonetool("--frames", "1-10", shot, "--cgtmo:steady=1", "--statistics", "shot.json")
    _, whole = make("1-10", "steady=1")
    assert len(whole) == 10
    for frames, words in (("7,8", ()), ("1-3", ()), ("10-1", ()), ("1-10", ("--threads", "1")),
                          ("1-10", ("--parallel-frames", "3"))):
        _, part = make(frames, "steady=1:adapt=shot.json", "part", words)
        assert part and all(part[number] == whole[number] for number in part), (frames, words)
        for file in tmp_path.glob("part.*.exr"):
            file.unlink()


def test_four_frames_to_each_side_decide_a_picture(make, write, tonetool, shot, tmp_path):
    tonetool("--frames", "1-10", shot, "--cgtmo", "--statistics", "shot.json")
    _, before = make("6", "steady=1:adapt=shot.json")
    write(1, Surfaces(.05), gain=3, seed=77)
    assert make("6", "steady=1:adapt=shot.json")[1] == before
    write(2, Surfaces(.1), seed=77)
    assert make("6", "steady=1:adapt=shot.json")[1] != before


def test_frames_are_made_by_the_commands_before(make, tonetool, shot, tmp_path):
    tonetool("--no-history", "--frames", "1-10", shot, "--crop", "80x50+8+2", "-o", "crop.#.exr")
    made = []
    for words in (["s.#.exr", "--crop", "80x50+8+2"], ["crop.#.exr"]):
        tonetool("--no-history", "--frames", "1-10", *words, f"--cgtmo:steady=1:{LIGHT}", "-o",
                 "p.#.exr")
        made.append([logarithm(file) for file in sorted(tmp_path.glob("p.*.exr"))])
    assert len(made[0]) == 10 and np.array_equal(made[0], made[1])


def test_each_view_of_a_stereo_pair_is_steadied_by_its_own_frames(make, write, tmp_path):
    """With the light given, so that the views have one exposure whatever is in them."""
    for number in range(1, 4):
        write(number, Surfaces(.05 * number), name="s.left")
        write(number, Surfaces(.05 * number + .5), name="s.right", seed=number + 50)
    given = "steady=1:lwa=0.4:lmax=8"
    make("1-3", given, "p.%V", words=("--views", "left,right"), scene="s.%V.#.exr")
    for view in ("left", "right"):
        _, alone = make("1-3", given, f"alone.{view}", scene=f"s.{view}.#.exr")
        assert len(alone) == 3
        for number, picture in alone.items():
            assert (tmp_path / f"p.{view}.{number:04}.exr").read_bytes() == picture
    assert (tmp_path / "p.left.0002.exr").read_bytes() != (tmp_path / "p.right.0002.exr").read_bytes()


# ---- windows that are not whole


def test_a_cut_ends_the_window(make, write, tmp_path):
    for number in range(1, 9):
        surfaces = Surfaces(.05 * number)
        if number > 4:
            surfaces.light = surfaces.light[::-1, ::-1] ** 3
        write(number, surfaces)
    ran, made = make("1-8", "steady=1:cuts=5")
    assert facts(ran, "steady") == ["by frames 1-4"] * 4 + ["by frames 5-8"] * 4
    _, alone = make("5-8", "steady=1", "alone")
    assert [made[number] for number in range(5, 9)] == [alone[number] for number in range(5, 9)]
    ran, _ = make("1-8", "steady=1")
    assert facts(ran, "adapted")[0] == "shot of frames 1 to 4", "it is found, too"


def test_frames_that_the_statistics_lack_have_no_part(make, tonetool, shot, tmp_path):
    (tmp_path / "s.0004.exr").unlink()
    ran, made = make("1-10", "steady=1", words=["--skip-bad-frames"], status=1)
    assert facts(ran, "steady")[3] == "by frames 1-3,5-9" and len(made) == 9
    assert "is without frames 4" in ran.err
    tonetool("--frames", "1-3,5-10", shot, "--cgtmo", "--statistics", "gap.json")
    _, part = make("5", "steady=1:adapt=gap.json", "part")
    assert part[5] == made[5]


def test_a_frame_of_the_statistics_that_is_not_there_is_an_error(make, tonetool, shot, tmp_path):
    tonetool("--frames", "1-10", shot, "--cgtmo", "--statistics", "shot.json")
    (tmp_path / "s.0009.exr").unlink()
    ran, made = make("7", "steady=1:adapt=shot.json", status=1)
    assert "frame 9, which steady=1 needs: " in ran.err and "s.0009.exr" in ran.err
    assert not made
    assert make("4", "steady=1:adapt=shot.json")[1], "it is not in this window"
    (tmp_path / "s.0009.exr").write_bytes((tmp_path / "s.0008.exr").read_bytes()[:5000])
    ran, made = make("7", "steady=1:adapt=shot.json", "q", status=1)
    assert "frame 9, which steady=1 needs: " in ran.err and not made


# ---- positions that tell no camera


def bent(pixels):
    """As a wide lens distorts."""
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    radius = ((x - WIDTH / 2) / WIDTH) ** 2 + ((y - HEIGHT / 2) / WIDTH) ** 2
    depth = pixels[..., 5]
    for c in (0, 1):
        pixels[..., 3 + c] += [x - WIDTH / 2, y - HEIGHT / 2][c] / WIDTH * radius * depth
    return pixels


def flat(pixels):
    pixels[..., 5] = 4
    for c in (3, 4):
        pixels[..., c] = 4 * (np.mgrid[:HEIGHT, :WIDTH][4 - c] + .5 - [WIDTH, HEIGHT][c - 3] / 2)
        pixels[..., c] /= WIDTH


def sky(pixels):
    pixels[..., 3:6] = np.nan


@pytest.mark.parametrize("change, without, why",
                         [(bent, (), "no camera sees its positions where they are"),
                          (flat, (), "all surfaces are in a plane"),
                          (sky, (), "no position of the scene"),
                          (None, ("P",), "no position of the scene"),
                          (None, ("P", "N", "albedo"), "no position of the scene")])
def test_without_a_camera_a_frame_is_made_alone(make, write, change, without, why):
    for number in range(1, 4):
        write(number, Surfaces(.05 * number), change=change, without=without)
    _, still = make("1-3", "adapt=shot", "still")
    ran, steady = make("1-3", "steady=1")
    assert ran.err.count(f"steady=1: {why}") == 3 and facts(ran, "steady") == []
    assert steady == still


def test_one_frame_without_a_camera_is_left_out(make, write):
    for number in range(1, 4):
        write(number, Surfaces(.05 * number), change=bent if number == 2 else None)
    ran, made = make("1-3", "steady=1")
    assert ran.err.count("the positions of frame 2 tell no camera: it is left out") == 2
    assert ran.err.count("the frame is made alone") == 1
    assert facts(ran, "steady") == ["by frames 1,3"] * 2
    assert made[2] == make("1-3", "adapt=shot", "still")[1][2] and len(made) == 3


def test_positions_that_are_not_finite_are_no_surface(make, write, tmp_path):
    def hole(pixels):
        pixels[10:20, 30:50, 3] = np.nan
    for number in range(1, 6):
        write(number, Surfaces(.05 * number), change=hole)
    ran, _ = make("1-5", "steady=1")
    make("1-5", "adapt=shot", "still")
    steady, still = logarithm(tmp_path / "p.0003.exr"), logarithm(tmp_path / "still.0003.exr")
    assert np.isfinite(steady).all() and facts(ran, "steady")[2] == "by frames 1-5"
    assert np.array_equal(steady[10:20, 30:50], still[10:20, 30:50])
    assert np.mean(steady != still) > .7


# ---- surfaces that move


def test_what_moves_is_steadied_along_its_motion(make, write, tmp_path):
    def shot(**options):
        for number in range(1, 10):
            surfaces = Surfaces(card=10 + CARD * number, depth_of_card=3 - .1 * number)
            surfaces.light[surfaces.card] = 1.3
            write(number, surfaces, motion=True, **options)

    def one_way(pixels):
        pixels[..., 14:] *= -1

    shot()
    card = Surfaces(card=10 + CARD * 5).card
    inside = card & np.roll(card, 4, 1) & np.roll(card, -4, 1)
    make("1-9", "adapt=shot", "still")
    make("1-9", "steady=1", "static")
    make("1-9", "steady=1:motion=Vector", "moving")
    shot(change=one_way)
    make("1-9", "steady=1:motion=Vector", "against")
    of = {name: logarithm(tmp_path / f"{name}.0005.exr")[inside]
          for name in ("still", "static", "moving", "against")}
    assert np.array_equal(of["static"], of["still"]), "it is nowhere where it was"
    assert np.std(of["moving"]) < .7 * np.std(of["still"])
    assert np.array_equal(of["against"], of["still"]), "the ways there and back do not agree"


# ---- options


@pytest.mark.parametrize("options, why", [
    ("steady=1:adapt=frame", "steady=1 is of the frames of a shot"),
    ("steady=1:base=mean", "steady=1 is of base=edges"),
    ("steady=1:preset=classic", "steady=1 is of base=edges"),
    ("steady=1:filter=wls", "steady=1 is of filter=guided with base=edges"),
    ("motion=Vector", "motion is of steady=1"),
    ("steady=1:motion=Vector", 'there is no channel "Vector.X"')])
def test_what_does_not_fit_is_refused(make, write, options, why):
    for number in (1, 2):
        write(number, Surfaces())
    ran, made = make("1-2", options, status=1)
    assert why in ran.err and not made


def test_an_image_that_is_no_frame_is_refused(tonetool, shot):
    ran = tonetool("s.0003.exr", "--cgtmo:steady=1", "-o", "p.exr", status=1)
    assert "steady=1 is of the frames of a shot" in ran.err
    tonetool("--frames", "1-10", shot, "--cgtmo", "--statistics", "shot.json")
    ran = tonetool("s.0003.exr", "--cgtmo:steady=1:adapt=shot.json:frame=3", "-o", "p.exr",
                   status=1)
    assert "--frames N s.#.exr" in ran.err


def test_the_camera_is_in_the_statistics(tonetool, shot, tmp_path):
    tonetool("--frames", "1-10", shot, "--cgtmo", "--statistics", "plain.json")
    tonetool("--frames", "1-10", shot, "--cgtmo:steady=1", "--statistics", "shot.json")
    plain, found = (json.loads((tmp_path / name).read_text())["frames"]
                    for name in ("plain.json", "shot.json"))
    assert all(frame["camera"] is None for frame in plain)
    for frame in found:
        rows = np.array(frame["camera"]).reshape(3, 4)
        wanted = np.eye(3, 4)
        wanted[0, 3] = -.05 * frame["frame"]
        assert np.allclose(rows, wanted / np.linalg.norm(wanted), atol=1e-5)
        assert np.linalg.norm(rows) == pytest.approx(1)
    tonetool("--merge", "shot.json", "--statistics", "again.json")
    assert (tmp_path / "again.json").read_bytes() == (tmp_path / "shot.json").read_bytes()


@pytest.mark.parametrize("show", ["base", "detail", "share"])
def test_factors_are_those_of_the_steady_picture(make, shot, tmp_path, show):
    make("5-7", f"steady=1:show={show}")
    make("5-7", f"adapt=shot:show={show}", "still")
    steady, still = logarithm(tmp_path / "p.0006.exr"), logarithm(tmp_path / "still.0006.exr")
    assert np.isfinite(steady).all() and .001 < np.abs(steady - still).max() < 9
    if show == "detail":
        assert np.std(steady) < np.std(still)
