# SPDX-License-Identifier: BSD-3-Clause
"""--against: each difference from the approved version alone, and what is none."""

import json
import re

import numpy as np
import OpenImageIO as oiio
import pytest
from fault_suite.kinds import alpha, colors, header, layer, without
from fault_suite.shots import APPROVED, FAR, HEIGHT, NEW, WIDTH, pan

TO_ACESCG = np.array([[0.61310, 0.33952, 0.04738], [0.07019, 0.91635, 0.01345],
                      [0.02062, 0.10957, 0.86981]])
ACESCG = (0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767)


def approved_frame():
    return pan(3, **APPROVED)


def new_frame():
    """The same moment with other seeds and fewer samples."""
    return pan(3, **NEW)


def found_in(text):
    return re.findall(r"^against: (\w+ \w+): ", text, re.MULTILINE)


@pytest.fixture
def against(tonetool, tmp_path):
    """Compares frames, or files of these names that are there, and returns what is found."""

    def run(approved=None, new=None, words=""):
        for name, frame in (("approved.exr", approved), ("new.exr", new)):
            if frame:
                frame.write(tmp_path / name)
        ran = tonetool("approved.exr", "new.exr", "--against" + words, "--exit-zero", "--json",
                       "check.json")
        return ran, found_in(ran.out)

    return run


@pytest.fixture
def layers(tmp_path):
    """What the last comparison has measured, by layer."""

    def read():
        frame = json.loads((tmp_path / "check.json").read_text())["frames"][0]
        return {one["name"]: one["quantities"] for one in frame["against"]["layers"]}

    return read


def setting(**values):
    def change(frame, *_):
        for name, value in values.items():
            setattr(frame, name, value)
        return frame
    return change


def added(name, value=0.5, channels=3):
    def change(frame, *_):
        frame.layers[name] = np.full((HEIGHT, WIDTH, channels), value, np.float32)
        return frame
    return change


def cropped(frame, *_):
    frame.layers = {name: a[4:-6, 3:-8] for name, a in frame.layers.items()}
    frame.origin = (3, 4)
    return frame


def part(count, change):
    """Changes the first `count` pixels of a layer, row by row."""
    def function(a):
        flat = a.reshape(-1, a.shape[2])
        flat[:count] = change(flat[:count])
        return a
    return function


PIXELS = WIDTH * HEIGHT
TILTED = np.array([[1, 0, 0], [0, np.cos(0.02), np.sin(0.02)], [0, -np.sin(0.02), np.cos(0.02)]])


def of(name, share, change):
    return layer(name, part(int(share * PIXELS), change))


# What is done to the new version, and all that must be found.
DIFFERENCES = {
    "layermissing": (without("DiffCol"), "error layermissing"),
    "layerextra": (added("Extra"), "warning layerextra"),
    "channels alpha": (layer("Combined", lambda a: a[..., :3]), "error channels"),
    "channels normal": (layer("Normal", lambda a: a[..., :2]), "error channels"),
    "displaywindow": (setting(display=(WIDTH + 16, HEIGHT)), "error displaywindow"),
    "datawindow": (cropped, "error datawindow"),
    "type": (setting(color_type="float"), "warning type"),
    "compression": (setting(compression="piz"), "warning compression"),
    "position few": (of("Position", 0.005, lambda a: a + 1), "warning position"),
    "position": (of("Position", 0.02, lambda a: a + 1), "error position"),
    "position, background": (of("Position", 0.02, lambda a: a * 0 + FAR), "error position"),
    "depth few": (of("Depth", 0.005, lambda a: a * 1.002), "warning depth"),
    "depth": (of("Depth", 0.02, lambda a: a * 1.002), "error depth"),
    "depth, background": (of("Depth", 0.02, lambda a: a * 0 + FAR), "error depth"),
    "normal little": (layer("Normal", lambda a: a @ TILTED), "warning normal"),
    "normal": (layer("Normal", lambda a: a @ TILTED @ TILTED), "error normal"),
    "normaloff few": (of("Normal", 0.1, lambda a: -a), "warning normaloff"),
    "normaloff": (of("Normal", 0.2, lambda a: -a), "error normaloff"),
    "normalone few": (of("Normal", 0.03, lambda a: a * 0), "warning normalone"),
    "normalone": (of("Normal", 0.07, lambda a: a * 0), "error normalone"),
    "vector little": (layer("Vector", lambda a: a + (0.1, 0)), "warning vector"),
    "vector": (layer("Vector", lambda a: a + (0.3, 0.3)), "error vector"),
    "vectoroff few": (of("Vector", 0.04, lambda a: a + (0.6, 0)), "warning vectoroff"),
    "vectoroff": (of("Vector", 0.06, lambda a: a + (0.6, 0)), "error vectoroff"),
    "id few": (of("CryptoObject00", 0.01, lambda a: a * (2, 1, 1, 1)), "warning id"),
    "id": (of("CryptoObject00", 0.03, lambda a: a * (2, 1, 1, 1)), "error id"),
    "id coverage": (layer("CryptoObject00", lambda a: a * (1, 0.95, 1, 1)), "error id"),
    "alpha little": (alpha(0.995), "warning alpha"),
    "alpha": (alpha(0.985), "error alpha"),
    "alphaoff few": (of("Combined", 0.005, lambda a: a * (1, 1, 1, 0.95)), "warning alphaoff"),
    "alphaoff": (of("Combined", 0.03, lambda a: a * (1, 1, 1, 0.95)), "error alphaoff"),
    "color little": (layer("Combined", lambda a: a * (1.05, 1.05, 1.05, 1)), "warning color"),
    "color": (layer("Combined", lambda a: a * (0.7, 0.7, 0.7, 1)), "error color"),
    "group little": (layer("Combined_key", lambda a: a * 1.06), "warning group"),
    "group": (layer("Combined_key", lambda a: a * 1.3), "error group"),
    "albedo little": (layer("DiffCol", lambda a: a * 1.02), "warning albedo"),
    "albedo": (layer("DiffCol", lambda a: a * 0.9), "error albedo"),
    "empty light": (layer("Combined_key", lambda a: a * 0), "error group"),
    "empty albedo": (layer("DiffCol", lambda a: a * 0), "error albedo"),
    "empty depth": (layer("Depth", lambda a: a * 0), "error depth"),
    "empty ids": (layer("CryptoObject00", lambda a: a * 0), "error id"),
    "empty motion": (layer("Vector", lambda a: a * 0), "error vector"),
}
# A row of blocks, and one of them: their median stays.
for _name, _code, _few in (("Combined", "color", 32), ("Combined_key", "group", 80),
                           ("DiffCol", "albedo", 16)):
    def _darker(width, name=_name):
        def function(a):
            a[:16, :width, :3] *= 0.2
            return a
        return layer(name, function)

    DIFFERENCES[_code + "blocks few"] = _darker(_few), f"warning {_code}blocks"
    DIFFERENCES[_code + "blocks"] = _darker(WIDTH), f"error {_code}blocks"


@pytest.mark.parametrize("name", DIFFERENCES)
def test_each_difference_alone(against, name):
    change, expected = DIFFERENCES[name]
    ran, found = against(approved_frame(), change(new_frame(), 0, None))
    assert found == [expected], ran.out


def test_other_noise_is_no_difference_and_the_same_pixels_are_none_at_all(against, layers):
    assert against(approved_frame(), new_frame())[1] == []
    assert {layers()[name]["off"] for name in ("Depth", "Position")} == {0}
    for name in ("Combined", "Combined_key", "Combined_env", "Combined_rim"):
        assert abs(layers()[name]["gain"]) < 0.01 and layers()[name]["blocks"] == 0
    ran, found = against(new_frame(), new_frame())
    assert found == [] and ran.err == ""
    quantities = [value for one in layers().values() for value in one.values()]
    assert len(layers()) == 10 and set(quantities) == {0}


HEADERS = {
    "PixelAspectRatio": 2.0,
    "framesPerSecond": 25.0,
    "view": "left",
    "cryptomatte/7f1a2b3/hash": "MurmurHash3_64",
    "cryptomatte/7f1a2b3/conversion": "float",
    "cryptomatte/7f1a2b3/name": "CryptoMaterial",
    "camera": "persp",
}


@pytest.mark.parametrize("name", HEADERS)
def test_what_headers_must_agree_in(against, name):
    ran, found = against(approved_frame(), header(**{name: HEADERS[name]})(new_frame(), 0, None))
    severity = "warning" if name == "camera" else "error"
    assert found == [f"{severity} header"]
    value = HEADERS[name]
    assert f'header: {name} is "{value if isinstance(value, str) else int(value)}", ' in ran.out


@pytest.mark.parametrize("name", ["Camera", "cameraName"])
def test_names_of_cameras(against, name):
    frames = [approved_frame(), new_frame()]
    for frame, camera in zip(frames, ("a", "b")):
        del frame.attributes["camera"]
        header(**{name: camera})(frame, 0, None)
    ran, found = against(*frames)
    assert found == ["warning header"] and f'{name} is "b", approved is "a"' in ran.out


def test_headers_that_may_differ(against):
    new = header(Software="renderer 4.3", DateTime="2026:11:29 10:00:00", PixelAspectRatio=1.0)
    assert against(approved_frame(), new(new_frame(), 0, None))[1] == []
    ran, found = against(words=":attribute=Software,camera")
    assert found == ["error header"]
    assert 'Software is "renderer 4.3", approved is "renderer 4.2"' in ran.out
    assert against(words=":attribute=Software:header=info")[1] == ["info header"]
    assert against(words=":attribute=Software:header=off")[1] == []


@pytest.mark.parametrize("name", ["Softwar", "software", "Soft*", "nosuch"])
def test_an_attribute_that_neither_has_holds_nothing(against, tonetool, name):
    against(header(Software="a")(approved_frame(), 0, None), header(Software="b")(new_frame(), 0, None))
    ran = tonetool("approved.exr", "new.exr", f"--against:attribute=camera, {name}", status=1)
    assert f'attribute: neither header has "{name}"' in ran.err
    assert ('did you mean "Software"?' in ran.err) == (name[:5].lower() == "softw")
    assert against(words=":attribute= Software ")[1] == ["error header"]


@pytest.mark.parametrize("kept, found", [(None, ["error header"]), ("{}", ["error header"]),
                                         ('{"lamp":"3f123456","new":"3f000001"}', [])])
def test_a_manifest_that_is_gone(against, kept, found):
    name = "cryptomatte/7f1a2b3/manifest"
    new = new_frame()
    if kept:
        header(**{name: kept})(new, 0, None)
    ran, all_found = against(header(**{name: '{"lamp":"3f123456"}'})(approved_frame(), 0, None), new)
    assert all_found == found and ("names no object" in ran.out) == bool(found)


def test_a_frame_rate_is_a_number_however_it_is_written(against):
    approved = header(framesPerSecond=(oiio.TypeDesc("rational"), (48, 2)))
    new = header(framesPerSecond=(oiio.TypeDesc("rational"), (24, 1)))
    assert against(approved(approved_frame(), 0, None), new(new_frame(), 0, None))[1] == []
    other = header(framesPerSecond=(oiio.TypeDesc("rational"), (24000, 1001)))
    assert against(None, other(new_frame(), 0, None))[1] == ["error header"]


# The file says that it is ACEScg, and the light is the same.
def test_another_space_is_told_and_the_light_compared(against):
    turn = colors(lambda a: a @ TO_ACESCG.T)
    new = turn(new_frame(), 0, None)
    new.layers["DiffCol"] = new.layers["DiffCol"] @ TO_ACESCG.T
    assert "error colorblocks" in against(approved_frame(), new)[1]
    new.attributes["chromaticities"] = oiio.TypeDesc("float[8]"), ACESCG
    ran, found = against(None, new)
    assert found == ["error header"] and "chromaticities" in ran.out
    assert against(words=":header=off")[1] == []


def test_colours_need_no_digits_and_data_do(against):
    approved, new = approved_frame(), new_frame()
    approved.color_type = "float"
    ran, found = against(approved, new)
    assert found == ["warning type"] and "Combined_rim" in ran.out
    new.color_type, new.data_type = "float", "half"
    ran, found = against(None, new)
    assert "error type" in found and "data needs all of its digits" in ran.out


def test_the_type_of_any_channel(against):
    new = new_frame()
    channels = new.channels
    new.channels = lambda: ((name, "half" if name == "Position.Z" else kind, a)
                            for name, kind, a in channels())
    ran, found = against(approved_frame(), new)
    assert found == ["error type"] and "Position is half, approved is float" in ran.out
    new.channels = lambda: ((name, "float" if name == "Combined.A" else kind, a)
                            for name, kind, a in channels())
    ran, found = against(None, new)
    assert found == ["warning type"] and "Combined is float, approved is half" in ran.out


@pytest.mark.parametrize("name", ["none", "zips", "rle", "piz", "pxr24", "b44", "b44a", "dwaa"])
def test_compressions_that_lose_digits(against, name):
    new = new_frame()
    new.compression = name
    severity = "warning" if name in ("none", "zips", "rle", "piz") else "error"
    assert f"{severity} compression" in against(approved_frame(), new)[1]
    approved = approved_frame()
    approved.compression = name
    assert against(approved, new)[1] == []


def test_ids_are_compared_by_their_bits(against, layers, tonetool):
    """Ids that are patterns of NaN, of the order of pairs, and of another rank."""
    ids = np.array([0x7FC01234, 0xFFC00007, 0x00000001, 0x80000001], np.uint32).view(np.float32)
    value = np.stack([np.resize(ids, (HEIGHT, WIDTH)), np.full((HEIGHT, WIDTH), 0.75),
                      np.resize(ids[::-1], (HEIGHT, WIDTH)), np.full((HEIGHT, WIDTH), 0.25)],
                     axis=-1).astype(np.float32)
    approved = layer("CryptoObject00", lambda a: value)(approved_frame(), 0, None)
    turned = layer("CryptoObject00", lambda a: value[..., [2, 3, 0, 1]])(new_frame(), 0, None)
    assert against(approved, turned)[1] == []
    assert layers()["CryptoObject00"] == {"mismatch": 0, "others": 0}
    assert "qc: " not in tonetool("approved.exr", "--qc").out
    signs = value.view(np.uint32) ^ np.array([0x80000000, 0, 0, 0], np.uint32)
    other = layer("CryptoObject00", lambda a: signs.view(np.float32))(new_frame(), 0, None)
    assert against(None, other)[1] == ["error id"]
    assert layers()["CryptoObject00"] == {"mismatch": 0.75, "others": 0.75}


def test_unknown_layers_are_told_unless_their_kind_is_said(against, tonetool):
    approved = added("Extra", 5, 1)(approved_frame())
    new = added("Extra", 5, 1)(new_frame())
    assert against(approved, new)[1] == []
    new = of("Extra", 0.03, lambda a: a + 1)(new, 0, None)
    ran, found = against(None, new)
    assert found == ["info data"]
    assert "layer Extra differs from the approved one in 3 % of the pixels" in ran.out
    assert against(words=":kind=Extra=depth")[1] == ["error depth"]
    assert against(words=":kind=Ex*=depth,Normal=data")[1] == ["error depth"]
    assert against(words=":data=off")[1] == []
    assert against(words=":data=error")[1] == ["error data"]
    assert against(words=":skip=E?tra")[1] == []
    for words, text in ((":kind=Extra=depht", 'unknown kind "depht"'),
                        (":kind=Extra", "LAYER=KIND"), (":kind==depth", "LAYER=KIND")):
        assert text in tonetool("approved.exr", "new.exr", "--against" + words, status=1).err


# Filtered depth is often written as a colour.
@pytest.mark.parametrize("name, channels", [("Depth", 1), ("ZDepth", 3), ("Z", 3), ("Extra", 2)])
def test_depth_of_any_number_of_channels(against, name, channels):
    depth = np.repeat(approved_frame().layers["Depth"], channels, axis=2)
    words = ":kind=Extra=depth" if name == "Extra" else ""
    frames = [frame() for frame in (approved_frame, new_frame, new_frame)]
    for frame in frames:
        del frame.layers["Depth"]
        frame.layers[name] = depth.copy()
    assert against(*frames[:2], words)[1] == []
    frames[2].layers[name] = depth * np.float32(1.01)
    assert against(None, frames[2], words)[1] == ["error depth"]
    frames[2].layers[name] = depth * (1, 1, 1, 1.01)[-channels:]  # the last one alone
    assert against(None, frames[2], words)[1] == ["error depth"]


@pytest.mark.parametrize("channels", [3, 4])
def test_normals_are_the_first_three_channels(against, channels):
    def with_extra(frame, sign):
        normal = frame.layers["Normal"] * sign
        frame.layers["Extra"] = np.concatenate([normal, normal[..., :1] * 0 + 1], axis=2)[..., :channels]
        return frame
    words = ":kind=Extra=normal"
    assert against(with_extra(approved_frame(), 1), with_extra(new_frame(), 1), words)[1] == []
    assert against(None, with_extra(new_frame(), -1), words)[1][0] == "error normal"


@pytest.mark.parametrize("channels", [1, 2])
def test_a_kind_that_does_not_fit_is_an_error(against, tonetool, channels):
    against(added("Extra", 1, channels)(approved_frame()), added("Extra", 1, channels)(new_frame()))
    ran = tonetool("approved.exr", "new.exr", "--against:kind=Extra=normal", status=1)
    assert ("kind= says that layer Extra is of the kind normal, which has three channels, and it has "
            f"{channels}") in ran.err
    assert against(words=":kind=Extra=data")[1] == []


def test_a_layer_that_noise_leaves_empty_is_no_fault(against):
    few = of("Extra", 15 / PIXELS, lambda a: a + 1)
    approved = few(added("Extra", 0, 1)(approved_frame()), 0, None)
    assert against(approved, added("Extra", 0, 1)(new_frame()))[1] == ["info data"]
    some = of("Extra", 0.002, lambda a: a + 1)
    approved = some(added("Extra", 0, 1)(approved_frame()), 0, None)
    ran, found = against(approved)
    assert found == ["error empty"] and "layer Extra is 0 everywhere, the approved one is not" in ran.out
    assert against(words=":empty=warning")[1] == ["warning empty"]
    assert against(words=":empty=off")[1] == ["info data"]
    assert against(some(added("Extra", 0, 1)(approved_frame()), 0, None), approved)[1] == []


def test_a_rank_of_the_edges_with_other_objects(against, layers):
    """Ranks above the first cover so little that a share of the picture never shows it."""
    def rank(ids):
        value = np.zeros((HEIGHT, WIDTH, 4), np.float32)
        value[::9, ::9, 0] = np.array(ids, np.uint32).view(np.float32)
        value[::9, ::9, 1] = 0.3
        return value
    approved, new = approved_frame(), new_frame()
    approved.layers["CryptoObject01"], new.layers["CryptoObject01"] = rank(0x3F123456), rank(0x3F654321)
    ran, found = against(approved, new)
    assert found == ["error idothers"] and "100 % of what layer CryptoObject01 covers are other objects" in ran.out
    assert layers()["CryptoObject01"]["mismatch"] < 0.005
    new.layers["CryptoObject01"] = rank(0x3F123456)
    new.layers["CryptoObject01"][:, : WIDTH // 2] *= 2  # noise of coverage
    assert against(None, new)[1] == []


# A pixel of four samples has four objects at most.
@pytest.mark.parametrize("rank, found", [("01", ["error empty"]), ("02", [])])
def test_ranks_that_fewer_samples_do_not_fill(against, rank, found):
    approved, new = approved_frame(), new_frame()
    value = np.zeros((HEIGHT, WIDTH, 4), np.float32)
    new.layers[f"CryptoObject{rank}"] = value.copy()
    value[::8, ::8] = (0.5, 0.1, 0, 0)
    approved.layers[f"CryptoObject{rank}"] = value
    assert against(approved, new)[1] == found


def test_layers_that_are_skipped_are_not_missed_either(against):
    new = without("DiffCol")(layer("Depth", lambda a: a * 2)(new_frame(), 0, None), 0, None)
    assert against(approved_frame(), new)[1] == ["error layermissing", "error depth"]
    assert against(words=":skip=DiffCol,Dep*")[1] == []


def test_severities_and_limits(against, tonetool):
    new = of("Depth", 0.02, lambda a: a * 1.002)(new_frame(), 0, None)
    assert against(approved_frame(), new)[1] == ["error depth"]
    assert against(words=":depth=0.05")[1] == ["warning depth"]
    assert against(words=":depth=0.2")[1] == []
    assert against(words=":depth=warning")[1] == ["warning depth"]
    assert against(words=":depth=0.05,info")[1] == ["info depth"]
    assert against(words=":depth=off")[1] == []
    assert tonetool("approved.exr", "new.exr", "--against", status=3).out.count("against: ") == 1
    tonetool("approved.exr", "new.exr", "--against:depth=warning")
    tonetool("approved.exr", "new.exr", "--against:depth=warning", "--warnings-exit", status=2)
    for words, text in (("depth=loud", "must be off"), ("depht=1", 'unknown modifier "depht"'),
                        ("layermissing=3", "must be off")):
        assert text in tonetool("approved.exr", "new.exr", "--against:" + words, status=1).err


def named(frame, prefix):
    channels = frame.channels
    frame.channels = lambda: ((prefix + name, kind, a) for name, kind, a in channels())
    return frame


def test_layers_of_other_view_layers_are_the_same(against, layers):
    approved = named(approved_frame(), "ViewLayer.")
    assert against(approved, named(new_frame(), "RenderLayer."))[1] == []
    assert "RenderLayer.Depth" in layers() and len(layers()) == 10
    new = named(layer("Depth", lambda a: a * 2)(new_frame(), 0, None), "RenderLayer.")
    assert against(None, new, ":skip=Normal")[1] == ["error depth"]
    assert against(approved, new_frame())[1] == []


def in_two_parts(path, frame, window=None, **attributes):
    """The picture in the first part, the rest in a second one, which may be cropped."""
    specs, images = [], []
    for first in (True, False):
        chosen = [(channel, kind, a) for channel, kind, a in frame.channels()
                  if (channel.rsplit(".", 1)[0] == "Combined") == first]
        pixels = np.stack([a for *_, a in chosen], axis=-1).astype(np.float32)
        x, y, width, height = window if window and not first else (0, 0, WIDTH, HEIGHT)
        images.append(np.ascontiguousarray(pixels[y:y + height, x:x + width]))
        spec = oiio.ImageSpec(width, height, len(chosen), "float")
        spec.x, spec.y, spec.full_width, spec.full_height = x, y, WIDTH, HEIGHT
        spec.channelnames = tuple(channel for channel, *_ in chosen)
        spec.attribute("oiio:subimagename", "picture" if first else "data")
        spec.attribute("compression", "zip")
        for key, value in {**frame.attributes, **({} if first else attributes)}.items():
            spec.attribute(key, value)
        specs.append(spec)
    output = oiio.ImageOutput.create("parts.exr")
    assert output.open(str(path), tuple(specs)), output.geterror()
    for i, (spec, pixels) in enumerate(zip(specs, images)):
        assert i == 0 or output.open(str(path), spec, "AppendSubimage")
        assert output.write_image(pixels), output.geterror()
    output.close()


def test_each_part_of_a_file_counts(against, tmp_path):
    in_two_parts(tmp_path / "approved.exr", approved_frame())
    in_two_parts(tmp_path / "new.exr", new_frame())
    assert against()[1] == []
    in_two_parts(tmp_path / "new.exr", new_frame(), window=(8, 8, 40, 30))
    ran, found = against()
    assert "error datawindow" in found and "the data window of " in ran.out
    in_two_parts(tmp_path / "new.exr", new_frame(), framesPerSecond=30.0)
    ran, found = against()
    assert found == ["error header"] and "framesPerSecond" in ran.out


@pytest.mark.parametrize("limit", ["colorblocks=8", "depth=1", "alpha=5,warning", "groupblocks=12"])
def test_a_share_that_nothing_can_exceed_is_no_limit(tonetool, against, limit):
    against(approved_frame(), new_frame())
    ran = tonetool("approved.exr", "new.exr", f"--against:{limit}", status=1)
    assert "no share is above 1, so this would find nothing (valid: below 1, 5 % is 0.05; or off)" in ran.err


def test_nothing_that_was_compared_is_no_pass(against, tonetool, shot):
    assert against(approved_frame(), new_frame())[1] == []
    ran = tonetool("approved.exr", "new.exr", "--against:skip=*", status=1)
    assert "no layer in common" in ran.err
    ran = tonetool("approved.exr", "new.exr", "--against:kind=Misk=depth:skip=nothing",
                   "--warnings-exit", status=2)
    assert 'no layer is called "Misk"' in ran.err and 'no layer is called "nothing"' in ran.err
    ran, frames = shot([None, None], [new_frame(), new_frame()], status=3)
    assert faults(frames) == [(1, "error noapproved"), (2, "error noapproved")]


JUDGES_NOTHING = ["kind=*=data", "skip=D*,N*,P*,V*,C*_*,CryptoO*:color=off:colorblocks=off:nonfinite=off",
                  "kind=*=data:data=info:alpha=off:alphaoff=off"]


@pytest.mark.parametrize("words", JUDGES_NOTHING)
def test_what_is_only_told_does_not_pass(tonetool, against, tmp_path, words):
    """A file of one AOV that is data, or rules that are all off: nothing could have failed."""
    dark = layer("Combined", lambda a: a * (0.1, 0.1, 0.1, 1))(new_frame(), 0, None)
    assert "error color" in against(approved_frame(), dark)[1]
    ran = tonetool("approved.exr", "new.exr", f"--against:{words}", "--json", "c.json")
    (frame,) = json.loads((tmp_path / "c.json").read_text())["frames"]
    assert frame["status"] == "measured"
    assert frame["message"].startswith("--against judges none of its layers")
    assert "passed" not in ran.out and "check: measured" in ran.out
    new_frame().write(tmp_path / "new.exr")
    tonetool("approved.exr", "new.exr", f"--against:{words}", "--qc", "--json", "c.json")
    assert json.loads((tmp_path / "c.json").read_text())["verdict"] == "passed"  # by --qc


def test_data_that_are_judged_pass(tonetool, against, tmp_path):
    assert against(approved_frame(), approved_frame(), words=":kind=*=data:data=error")[1] == []
    tonetool("approved.exr", "new.exr", "--against:kind=*=data:data=error", "--json", "c.json")
    assert json.loads((tmp_path / "c.json").read_text())["verdict"] == "passed"


@pytest.mark.parametrize("whole_names", [True, False])
def test_parts_and_layers_are_the_same(against, layers, tmp_path, whole_names):
    frame = new_frame()
    specs, images = [], []
    for name in frame.layers:
        chosen = [(channel, kind, a) for channel, kind, a in frame.channels()
                  if channel.rsplit(".", 1)[0] == name]
        spec = oiio.ImageSpec(WIDTH, HEIGHT, len(chosen), chosen[0][1])
        spec.channelnames = tuple(channel if whole_names else channel.rsplit(".", 1)[1]
                                  for channel, *_ in chosen)
        spec.attribute("oiio:subimagename", name)
        spec.attribute("compression", "zip")
        for key, value in frame.attributes.items():
            spec.attribute(key, value)
        specs.append(spec)
        images.append(np.stack([a for *_, a in chosen], axis=-1).astype(np.float32))
    output = oiio.ImageOutput.create("parts.exr")
    assert output.open(str(tmp_path / "new.exr"), tuple(specs)), output.geterror()
    for i, (spec, pixels) in enumerate(zip(specs, images)):
        assert i == 0 or output.open(str(tmp_path / "new.exr"), spec, "AppendSubimage")
        assert output.write_image(np.ascontiguousarray(pixels)), output.geterror()
    output.close()
    assert against(approved_frame())[1] == []
    assert len(layers()) == 10
    (tmp_path / "new.exr").rename(tmp_path / "parts.exr")
    frame.write(tmp_path / "new.exr")
    (tmp_path / "approved.exr").unlink()
    (tmp_path / "parts.exr").rename(tmp_path / "approved.exr")
    assert against()[1] == []
    assert {value for one in layers().values() for value in one.values()} == {0}


def test_pixels_that_are_not_finite(against, layers):
    bad = (slice(0, 20), slice(0, 40))

    def spoiled(frame, value, *names):
        for name in names:
            frame.layers[name][bad] = value
        return frame

    every = ("Combined_key", "Depth", "Normal", "Position", "Vector")
    for value in (np.nan, np.inf):
        assert against(spoiled(approved_frame(), value, *every),
                       spoiled(new_frame(), value, *every))[1] == []
        assert all(np.isfinite(v) for one in layers().values() for v in one.values())
        # Light is compared where both have it; data that is none differs.
        assert against(approved_frame(), spoiled(new_frame(), value, "Combined_key"))[1] == \
            ["error nonfinite"]
        assert against(None, spoiled(new_frame(), value, "Depth"))[1] == ["error depth"]
        assert against(None, spoiled(new_frame(), value, "Vector"))[1] == ["error vectoroff"]
        for name in ("Normal", "Vector"):
            few = of(name, 0.002, lambda a, value=value: a * 0 + value)(new_frame(), 0, None)
            ran, found = against(None, few)
            assert found == ["error nonfinite"] and f"layer {name} is NaN or infinite in 0.1" in ran.out
            few = of(name, 0.0005, lambda a, value=value: a * 0 + value)(new_frame(), 0, None)
            assert against(None, few)[1] == ["warning nonfinite"]
    assert against(spoiled(approved_frame(), np.inf, "Depth"),
                   spoiled(new_frame(), FAR, "Depth"))[1] == []


def test_pixels_that_are_not_finite_have_a_place(against):
    frame = new_frame()
    frame.layers["Combined_key"][17:23, 30:50] = np.nan
    ran, found = against(approved_frame(), frame)
    assert found == ["error nonfinite"]
    assert "NaN or infinite in only one version" in ran.out and "of the pixels, first at (30, 17)" in ran.out


@pytest.mark.parametrize("name", ["Combined", "Combined_key", "DiffCol"])
def test_light_of_which_nothing_is_finite_was_not_compared(against, tonetool, name):
    def spoiled(frame, pixels):
        frame.layers[name][pixels] = (frame.layers[name] * np.nan)[pixels]
        frame.layers[name][..., 3:] = 1
        return frame

    whole, but_one = np.full((HEIGHT, WIDTH), True), np.full((HEIGHT, WIDTH), True)
    but_one[5, 6] = False
    for approved in (spoiled(approved_frame(), whole), approved_frame()):
        ran, found = against(approved, spoiled(new_frame(), whole))
        assert found == ["error nonfinite"] and "no pixel that is finite in both versions" in ran.out
    tonetool("approved.exr", "new.exr", "--against:nonfinite=warning")
    assert against(spoiled(approved_frame(), but_one), spoiled(approved_frame(), but_one))[1] == []


@pytest.mark.parametrize("size", [1, 2, 15, 17])
def test_small_images(against, size):
    def small(frame):
        frame.layers = {name: a[20:20 + size, 30:30 + size] for name, a in frame.layers.items()}
        frame.display = (size, size)
        return frame

    assert against(small(approved_frame()), small(approved_frame()))[1] == []
    brighter = colors(lambda a: a * 2)(small(approved_frame()), 0, None)
    assert against(None, brighter)[1] == ["error color"] + 3 * ["error group"]
    turned = layer("Normal", lambda a: -a)(small(approved_frame()), 0, None)
    assert against(None, turned)[1] == ["error normal"]


# ---- shots


@pytest.fixture
def shot(tonetool, tmp_path):
    """Writes frames 1 and on of both versions, None being one that is not there, and compares."""

    def run(approved, new, *words, status=None):
        for version, frames in (("approved", approved), ("new", new)):
            (tmp_path / version).mkdir(exist_ok=True)
            for number, frame in enumerate(frames, 1):
                if frame:
                    frame.write(tmp_path / version / f"shot.{number:04d}.exr")
        ran = tonetool("--frames", f"1-{len(new)}", "approved/shot.#.exr", "new/shot.#.exr",
                       "--against", *words, "--json", "check.json", status=status)
        report = json.loads((tmp_path / "check.json").read_text())
        return ran, report["frames"]

    return run


def faults(frames):
    return [(frame["frame"], f"{fault['severity']} {fault['code']}") for frame in frames
            for fault in frame.get("faults", [])]


def test_a_frame_that_the_approved_version_has_not(shot):
    bad = new_frame()
    bad.layers["Combined"][20, 30] = np.nan
    frames = [approved_frame(), None, approved_frame()], [new_frame(), bad, new_frame()]
    qc = "--qc:duplicate=off:fewframes=off"
    ran, found = shot(*frames, qc, status=3)
    assert faults(found) == [(2, "error nan"), (2, "error noapproved")]
    assert [frame["status"] for frame in found] == ["passed", "failed", "passed"]
    assert ("against: frame 2: error noapproved: the approved version has no such frame, though it has "
            "earlier and later ones") in ran.out
    ran, found = shot(*frames, "--hdrflip", status=1)
    assert [frame["status"] for frame in found] == ["passed", "missing", "passed"]


@pytest.mark.parametrize("there, extra", [((1, 2), 3), ((2, 3), 1)])
def test_a_longer_version_has_frames_that_are_only_looked_at(shot, there, extra):
    approved = [approved_frame() if number in there else None for number in (1, 2, 3)]
    ran, found = shot(approved, [new_frame()] * 3, "--qc:duplicate=off:fewframes=off", status=0)
    assert faults(found) == [(extra, "info noapproved")]
    assert f"against: frame {extra}: info noapproved: the approved version has no such frame\n" in ran.out
    ran, found = shot(approved, [new_frame()] * 3, status=0)  # without --qc nothing is known of it
    assert [frame["status"] for frame in found] == ["passed" if n in there else "measured" for n in (1, 2, 3)]
    assert found[extra - 1]["message"] == "the approved version has no such frame"
    assert (f"check: measured, 3 frames: 1 measured, 2 passed; worst: frame {extra} (the approved version has no such "
            "frame)") in ran.out


def test_a_hole_in_the_approved_version_is_found_by_a_part_of_the_frames(tonetool, shot):
    shot([approved_frame(), None, approved_frame()], [new_frame()] * 3, status=3)
    line = ["approved/shot.#.exr", "new/shot.#.exr", "--against", "--json", "part.json"]
    ran = tonetool("--frames", "2-3", *line, status=3)
    assert "though it has earlier and later ones" in ran.out
    tonetool("--frames", "1", *line[:3], "--json", "rest.json")
    ran = tonetool("--merge", "rest.json", "part.json", "--frames", "1-3", status=3)
    assert "check: failed, 3 frames: 1 failed, 2 passed" in ran.out
    tonetool("--frames", "2-3", *line[:2], "--against:noapproved=info")


def test_a_frame_that_the_new_version_has_not(shot):
    ran, found = shot([approved_frame()] * 3, [new_frame(), None, new_frame()], status=1)
    assert [frame["status"] for frame in found] == ["passed", "missing", "passed"]
    assert "new/shot.0002.exr" in found[1]["message"]


def test_the_same_file_is_most_likely_a_slip(tonetool, tmp_path):
    new_frame().write(tmp_path / "new.exr")
    (tmp_path / "link.exr").symlink_to("new.exr")
    for other in ("new.exr", "link.exr"):
        ran = tonetool("new.exr", other, "--against")
        assert "are the same file" in ran.err
        assert found_in(ran.out) == []


def test_what_frames_have_in_common_is_told_once(shot):
    flipped = layer("Normal", lambda a: -a)
    new = [flipped(new_frame(), 0, None) if number in (2, 3, 4) else new_frame()
           for number in range(1, 7)]
    new[5].attributes["camera"] = "persp"
    ran, found = shot([approved_frame()] * 6, new, status=3)
    lines = re.findall(r"^against: (.*?: \w+ \w+): ", ran.out, re.MULTILINE)
    assert lines == ["frames 2 to 4: error normal", "frame 6: warning header"]
    assert faults(found) == [(number, "error normal") for number in (2, 3, 4)] + [
        (6, "warning header")]


def test_the_moment_of_another_frame_is_named(shot):
    approved = [pan(number, **APPROVED) for number in range(1, 6)]
    new = [pan(number, **NEW) for number in (1, 2, 2, 4, 1)]
    ran, found = shot(approved, new, status=3)
    sentences = {frame["frame"]: fault["sentence"] for frame in found
                 for fault in frame.get("faults", []) if fault["code"] == "depth"}
    assert sentences[3].endswith("; it is the moment of approved frame 2")
    assert "moment" not in sentences[5]  # four frames away
    assert set(sentences) == {3, 5}


def test_data_windows_that_are_cropped_frame_by_frame(shot):
    def window(frame, left, top):
        frame.layers = {name: a[top:80, left:140] for name, a in frame.layers.items()}
        frame.origin = (left, top)
        return frame

    approved = [window(approved_frame(), 10 + 3 * n, 12) for n in range(3)]
    wider = [window(new_frame(), 9 + 3 * n, 13) for n in range(3)]
    assert faults(shot(approved, wider, status=0)[1]) == []
    narrower = [window(new_frame(), 10 + 3 * n + (5 if n == 1 else 0), 12) for n in range(3)]
    ran, found = shot(approved, narrower, status=0)
    assert faults(found) == [(2, "warning datawindow")]
    fixed = [window(approved_frame(), 10, 12) for _ in range(3)]
    assert faults(shot(fixed, wider, status=3)[1])[0] == (1, "error datawindow")
