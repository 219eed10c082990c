# SPDX-License-Identifier: BSD-3-Clause
"""--qc of stereo pairs (%V): eyes that are one file, layers and objects in one eye only."""

import json

import make_shot
import numpy as np
import pytest

FRAMES = range(1, 7)
WALL, BALL, FAR = 0x3F0A11C2, 0x40B0C0DE, 0xC1234567  # the last is a negative number as a float
CRYPTO = [f"ViewLayer.CryptoObject00.{c}" for c in "rgba"]


class Eye(make_shot.Frame):
    """A frame with the IDs of what is behind each pixel."""

    def __init__(self, number, shift):
        frame = make_shot.make_frame(number)
        layers = {name: np.roll(layer, shift, axis=1) for name, layer in frame.layers.items()}
        super().__init__(layers)
        self.channels += CRYPTO
        self.kind = "float"
        self.ids = np.full((make_shot.HEIGHT, make_shot.WIDTH), WALL, np.uint32)
        self.ids[20:30, 40 + shift:52 + shift] = BALL
        self.ids[5:9, 0:6] = FAR

    def pixels(self):
        self.channels, all_channels = self.channels[:-4], self.channels
        flat = make_shot.Frame.pixels(self)
        self.channels = all_channels
        crypto = np.zeros((*self.ids.shape, 4), np.float32)
        crypto[..., 0] = self.ids.view(np.float32)
        crypto[..., 1] = 1
        return np.concatenate([flat, crypto], axis=-1)


@pytest.fixture
def check(tonetool, tmp_path):
    """Writes both eyes, changed by change(eye's name, number, frame), and returns what is found."""

    def run(change, status=0, *words):
        for number in FRAMES:
            for shift, name in enumerate(("left", "right")):
                eye = Eye(number, 2 * shift)
                change(name, number, eye)
                eye.write(tmp_path / f"a.{name}.{number:04d}.exr")
        tonetool("--frames", "1-6", "--views", "left,right", "a.%V.#.exr", "--qc",
                 "--warnings-exit", "--json", "c.json", *words, status=status)
        found = json.loads((tmp_path / "c.json").read_text())
        return [(frame["view"], frame["frame"], fault["code"], fault["sentence"])
                for frame in found["frames"] for fault in frame.get("faults", [])]

    return run


def test_a_healthy_pair(check):
    assert check(lambda name, number, eye: None) == []


def test_one_file_for_both_eyes(check):
    def change(name, number, eye):
        if number == 4:
            eye.__init__(number, 0)

    found = check(change, 3)
    assert [one[:3] for one in found] == [("right", 4, "sameeyes")]
    assert found[0][3] == "the same pixels as view left"


@pytest.mark.parametrize("blind, other", [("left", "right"), ("right", "left")])
def test_a_layer_that_is_black_in_one_eye(check, blind, other):
    def change(name, number, eye):
        if name == blind:
            eye.layers["Combined_key"] = eye.layers["Combined_key"] * 0
            make_shot.add_up(eye.layers)

    found = check(change, 2)
    assert [one[:3] for one in found] == [(blind, 1, "oneeye")]
    assert found[0][3].endswith(f"is black, but not in view {other}")


@pytest.mark.parametrize("blind, other", [("left", "right"), ("right", "left")])
def test_an_object_in_one_eye_only(check, blind, other):
    def change(name, number, eye):
        if name == blind:
            eye.ids[eye.ids == BALL] = WALL

    found = check(change, 2)
    assert [one[:3] for one in found] == [(other, 1, "oneeye")]
    assert found[0][3] == (f"object <{BALL:08x}> of ViewLayer.CryptoObject00 (120 pixels) "
                           f"is not in view {blind}")


def test_what_one_eye_may_not_see(check):
    def change(name, number, eye):
        if name == "right":
            eye.ids[eye.ids == FAR] = WALL  # beyond the border
        else:
            eye.ids[40, 50] = 0x3F111111  # too small to tell
        if name == "left" or number == 6:
            eye.ids[35:38, 40:44] = 0x3F222222  # a small one behind something, for a while

    assert check(change) == []


def test_a_large_object_that_one_eye_lacks_in_one_frame(check, tonetool, tmp_path):
    def change(name, number, eye):
        if name == "right" and number == 3:
            eye.ids[eye.ids == BALL] = WALL

    assert [one[:3] for one in check(change, 2)] == [("left", 3, "oneeye")]
    tonetool("--merge", "c.json", "--warnings-exit", status=2)


def test_objects_are_told_before_materials(check):
    """Layers come by name, and two objects may share a material."""
    def change(name, number, eye):
        if name == "right":
            eye.ids[eye.ids == BALL] = WALL
        eye.channels += [f"ViewLayer.CryptoMaterial00.{c}" for c in "rgba"]

    Eye.pixels, before = with_one_material(Eye.pixels), Eye.pixels
    try:
        found = check(change, 2)
    finally:
        Eye.pixels = before
    assert found[0][2:] == ("oneeye", f"object <{BALL:08x}> of ViewLayer.CryptoObject00 "
                            "(120 pixels) is not in view right")


def with_one_material(pixels):
    def all_pixels(eye):
        eye.channels, channels = eye.channels[:-4], eye.channels
        flat = pixels(eye)
        eye.channels = channels
        material = np.zeros((*eye.ids.shape, 4), np.float32)
        material[..., :2] = 1
        return np.concatenate([flat, material], axis=-1)

    return all_pixels


def test_parts_of_the_shot_find_the_same(check, tonetool, tmp_path):
    def change(name, number, eye):
        if name == "right":
            eye.ids[eye.ids == BALL] = WALL

    check(change, 2)
    words = ["--views", "left,right", "a.%V.#.exr", "--qc", "--exit-zero"]
    for frames in ("1-2", "3-6"):
        tonetool("--frames", frames, *words, "--json", f"part.{frames}.json")
    tonetool("--merge", "part.1-2.json", "part.3-6.json", "--json", "whole.json")
    assert json.loads((tmp_path / "whole.json").read_text())["frames"] == json.loads(
        (tmp_path / "c.json").read_text())["frames"]
