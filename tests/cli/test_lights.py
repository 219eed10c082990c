# SPDX-License-Identifier: BSD-3-Clause
"""Statistics from the scene: light index, tables of lights, panoramas, and what --cgtmo takes."""

import json
import os
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from conftest import TESTIMAGES

CORNELL = TESTIMAGES / "cornell_ref.exr"
GALLERY = TESTIMAGES / "gallery_ref.exr"
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
# Sources of the maximum in their order, and means of all pixels.
CLASSIC = "--cgtmo:preset=classic"
GROUPS = ("key", "lamp", "off")
CHANNELS = tuple("RGB") + tuple(f"RGBA_{g}.{c}" for g in GROUPS for c in "RGB")


def lit(make_image, name, luminances, beauty=None, **more):
    """An image of grey light groups key, lamp, off: {group: luminances[H][W]}."""
    layers = [np.asarray(luminances.get(g, 0), np.float32) for g in GROUPS]
    shape = np.broadcast_shapes(*(layer.shape for layer in layers))
    layers = [np.broadcast_to(layer, shape) for layer in layers]
    beauty = sum(layers) if beauty is None else np.broadcast_to(beauty, shape)
    pixels = np.repeat(np.stack([beauty] + layers, -1), 3, -1)
    return make_image(name, shape[1], shape[0], CHANNELS, pixels=pixels, **more)


@pytest.fixture
def two_lights(make_image):
    """Left half lit by key up to 8, right half by lamp up to 2, each with a little of the other."""
    ramp = np.linspace(0.1, 1, 16)
    left = np.arange(16) < 8
    key = np.where(left, 8 * ramp / ramp[7], 0.05) * np.ones((4, 1))
    lamp = np.where(left, 0.1, 2 * ramp) * np.ones((4, 1))
    return lit(make_image, "lit.exr", {"key": key, "lamp": lamp})


@pytest.fixture
def write(tmp_path):
    def text(name, what):
        (tmp_path / name).write_text(what if isinstance(what, str) else json.dumps(what))
        return name

    return text


def maximum(ran):
    return float(ran.fact("maximum")), ran.fact("maximum-from")


# ---- light index


def test_the_index_is_the_largest_contribution(tonetool, two_lights, read):
    ran = tonetool(two_lights, "--lightindex", "-o", "m.exr")
    pixels, spec = read("m.exr")
    assert spec.channelnames == ("lightindex",)
    assert spec.get_string_attribute("lightindex:names") == "key,lamp,off"
    assert (pixels[:, :8] == 0).all() and (pixels[:, 8:] == 1).all()
    assert ran.fact("group 0").startswith("key: pixels 32 maximum 8")
    assert ran.fact("group 2") == "off: pixels 0 maximum 0 black"
    assert float(ran.fact("difference")) < 1e-6 and "warning" not in ran.err


def test_by_power_the_largest_of_the_table_that_gives_one_percent(tonetool, two_lights, write,
                                                                  read):
    write("t.csv", "key,1\nlamp,100\noff,1e6\n")
    tonetool(two_lights, "--lightindex:index=power:lights=t.csv", "-o", "m.exr")
    # lamp gives 0.1 of 8.1 at most in the left half: more than 1 % everywhere.
    assert (read("m.exr")[0] == 1).all()
    write("t.csv", "key,100\nlamp,1\n")
    tonetool(two_lights, "--lightindex:index=power:lights=t.csv", "-o", "m.exr")
    # key gives 0.05 in the right half, 1 % of 5: everywhere.
    assert (read("m.exr")[0] == 0).all()
    assert "lights=" in tonetool(two_lights, "--lightindex:index=power", "-o", "x.exr",
                                 status=1).err


def test_no_light_is_minus_one(tonetool, make_image, read):
    source = lit(make_image, "half.exr", {"key": [[0, 1, 2, 0]]})
    assert tonetool(source, "--lightindex", "-o", "m.exr").fact("unlit") == "2"
    assert read("m.exr")[0][0, :, 0].tolist() == [-1, 0, 0, -1]
    black = lit(make_image, "dark.exr", {"key": [[0, 0]]})
    assert "black" in tonetool(black, "--lightindex", "-o", "m.exr").err


def test_rendered_groups_add_up(tonetool):
    for image in (CORNELL, GALLERY):
        ran = tonetool(image, "--lightindex", "-o", "m.exr")
        # Groups and picture are half: 2^-11 of each.
        assert float(ran.fact("difference")) < 1e-3
        assert float(ran.fact("sum")) == pytest.approx(1, abs=1e-3)


def test_groups_that_do_not_add_up(tonetool, make_image):
    key = np.linspace(0.5, 1, 8)[None]
    source = lit(make_image, "sum.exr", {"key": key}, beauty=2 * key)
    ran = tonetool(source, "--lightindex", "-o", "m.exr")
    assert "0.5 of" in ran.err and float(ran.fact("difference")) == pytest.approx(0.5)
    # Nobody asked for the groups: they are not used. Who asks gets them, and the warning.
    ran = tonetool(source, CLASSIC, "-o", "out.exr")
    assert maximum(ran) == (2, "image") and "add up" in ran.err
    ran = tonetool(source, f"{CLASSIC}:maximum=groups", "-o", "out.exr")
    assert maximum(ran) == (1, "groups key") and "add up" in ran.err


def test_clamped_pixels_do_not_count(tonetool, make_image):
    key = np.linspace(0.1, 4, 40)[None]
    source = lit(make_image, "clamped.exr", {"key": key}, beauty=np.minimum(key, 1))
    ran = tonetool(source, "--lightindex", "-o", "m.exr")
    assert float(ran.fact("difference")) < 1e-6 and "warning" not in ran.err


def test_groups_by_name(tonetool, two_lights, make_image):
    ran = tonetool(two_lights, "--lightindex:groups=lamp,RGBA_key", "-o", "m.exr")
    assert ran.fact("group 0").startswith("lamp") and ran.fact("group 1").startswith("key")
    for names, words in (("kay", ["kay", "key"]), ("key,key", ["twice"])):
        ran = tonetool(two_lights, f"--lightindex:groups={names}", "-o", "m.exr", status=1)
        assert all(word in ran.err for word in words), ran.err
    plain = make_image("plain.exr")
    assert "no light groups" in tonetool(plain, "--lightindex", "-o", "m.exr", status=1).err


# ---- the maximum


def test_the_fallbacks_in_their_order(tonetool, two_lights, make_image, write, read):
    pano = make_image("pano.exr", 8, 4, pixels=np.full((4, 8, 3), 3))
    write("t.csv", "name,luminance\nkey,50\nlamp,20\noff,900\n")
    plain = make_image("plain.exr", pixels=np.full((12, 16, 3), 0.5))
    for source, options, expected in (
            (two_lights, "lmax=7:lights=t.csv", (7, "lmax")),
            (two_lights, f"lights=t.csv:env={pano}", (50, "lights key")),
            (two_lights, f"env={pano}", (8, "groups key")),
            (two_lights, f"env={pano}:maximum=env", (3, "env")),
            (two_lights, f"env={pano}:maximum=image", (8.1, "image")),
            (plain, f"env={pano}", (3, "env")),
            (plain, "lwa=geometric", (0.5, "image"))):
        ran = tonetool(source, f"{CLASSIC}:{options}", "-o", "out.exr")
        value, origin = maximum(ran)
        assert (value, origin) == (pytest.approx(expected[0]), expected[1]), options
        spec = read("out.exr")[1]
        assert spec.get_string_attribute("tonemap:maximum_from") == origin.split()[0]
        assert spec.get_float_attribute("tonemap:maximum") == pytest.approx(value)


def test_only_lights_that_are_seen_count(tonetool, two_lights, write):
    write("t.json", {"key": 5, "lamp": 3, "off": 1e4})
    ran = tonetool(two_lights, f"{CLASSIC}:lights=t.json", "-o", "o.exr")
    assert maximum(ran) == (5, "lights key") and ran.fact("light-index") == "groups"


def test_what_was_asked_for_and_is_not_there(tonetool, two_lights, make_image, write):
    plain = make_image("plain.exr", pixels=np.full((12, 16, 3), 0.5))
    write("t.csv", "key,50\n")
    write("other.csv", "sun,50\nsky,1\n")
    guides = "position=none:normal=none:albedo=none"
    for source, options, words, expected in (
            (plain, "lights=t.csv", ["no light index", "of the image"], (0.5, "image")),
            (plain, "maximum=groups", ["no light groups", "of the image"], (0.5, "image")),
            (two_lights, "lights=other.csv", ["key, lamp, off", "sun, sky", "of the light groups"],
             (8, "groups key")),
            (two_lights, "lights=t.csv", ['"lamp" is not in', "2, is taken"], (50, "lights key"))):
        ran = tonetool(source, f"{CLASSIC}:{options}:{guides}", "-o", "out.exr")
        assert maximum(ran) == expected and all(word in ran.err for word in words), ran.err
        ran = tonetool(source, f"{CLASSIC}:{options}:{guides}:strict=1", "-o", "s.exr", status=1)
        assert words[0] in ran.err


def test_an_index_layer(tonetool, make_image, write):
    def image(name, m, channel):
        pixels = np.full((1, len(m), 4), 0.5)
        pixels[..., 3] = m
        return make_image(name, len(m), 1, ("R", "G", "B", channel), pixels=pixels)

    write("t.csv", "# cd/m2\nindex,r,g,b\n0,1,1,1\n1,4,4,4 # bulb\n2,9,9,9\n")
    for channel in ("lightindex", "M", "light_id.I", "view.lightIndex"):
        source = image("i.exr", [0, 0, 1, -1], channel)
        ran = tonetool(source, f"{CLASSIC}:lights=t.csv", "-o", "o.exr")
        assert maximum(ran) == (pytest.approx(4), "lights 1"), channel
        assert "maximum" not in ran.err
        assert ran.fact("light-index") == channel.removesuffix(".I")
    source = image("mine.exr", [2, 1], "which")
    assert maximum(tonetool(source, f"{CLASSIC}:lights=t.csv:lightindex=which", "-o", "o.exr"))[0] == \
        pytest.approx(9)
    assert "which" in tonetool(source, f"{CLASSIC}:lights=t.csv:lightindex=witch", "-o", "o.exr",
                               status=1).err
    # Out of range, NaN and what a filter made: left out, counted, said.
    source = image("bad.exr", [0, 7, 7, np.nan, np.inf, -3, 1.4], "M")
    ran = tonetool(source, f"{CLASSIC}:lights=t.csv", "-o", "o.exr")
    assert maximum(ran)[0] == pytest.approx(4)
    for words in ('index 7 of "M" (2 pixels)', "2 pixel(s) of \"M\"", "not whole numbers"):
        assert words in ran.err, ran.err
    assert "index 7" in tonetool(source, f"{CLASSIC}:lights=t.csv:strict=1:position=none:normal=none:"
                                 "albedo=none", "-o", "o.exr", status=1).err
    noise = np.random.default_rng(1).random((1100, 1000, 4))
    make_image("noise.exr", 1000, 1100, ("R", "G", "B", "M"), pixels=noise)
    assert "different values" in tonetool("noise.exr", f"{CLASSIC}:lights=t.csv", "-o", "o.exr",
                                          status=1).err
    source = image("none.exr", [-1, -1], "M")
    ran = tonetool(source, f"{CLASSIC}:lights=t.csv", "-o", "o.exr")
    assert maximum(ran) == (0.5, "image") and "holds no index" in ran.err


def test_an_index_of_whole_numbers(tonetool, tmp_path, write):
    """OpenImageIO makes 32-bit integers 0 to 1 on reading."""
    spec = oiio.ImageSpec(4, 1, 4, "float")
    spec.channelnames = ("R", "G", "B", "M")
    spec.channelformats = tuple(oiio.TypeDesc(t) for t in ("float", "float", "float", "uint"))
    pixels = np.full((1, 4, 4), 0.5, np.float32)
    pixels[0, :, 3] = np.array([0, 1, 2, 2]) / 4294967295
    out = oiio.ImageOutput.create(str(tmp_path / "u.exr"))
    assert out.open(str(tmp_path / "u.exr"), spec) and out.write_image(pixels)
    out.close()
    back = oiio.ImageInput.open(str(tmp_path / "u.exr")).spec()
    assert [str(f) for f in back.channelformats][3] == "uint"
    write("t.csv", "0,1\n1,4\n2,9\n")
    assert maximum(tonetool("u.exr", f"{CLASSIC}:lights=t.csv", "-o", "o.exr")) == (9, "lights 2")


@pytest.mark.parametrize("bits", (8, 16))
def test_an_index_of_whole_numbers_that_a_command_touched(tonetool, tmp_path, write, bits):
    """Its type is gone then, but the header tells its bits."""
    largest = 2**bits - 1
    pixels = np.full((4, 4, 4), 0.5, np.float32)
    pixels[..., 3] = np.array([0, 1, 2, 2]) / largest
    image = oiio.ImageBuf(oiio.ImageSpec(4, 4, 4, f"uint{bits}"))
    image.set_pixels(oiio.ROI(), pixels)
    assert image.write(str(tmp_path / "i.tif"))
    write("t.csv", "0,1\n1,4\n2,9\n")
    ran = tonetool("i.tif", "--chnames", "R,G,B,M", f"{CLASSIC}:lights=t.csv", "-o", "o.png")
    assert maximum(ran) == (9, "lights 2")


def test_an_index_in_a_file_of_its_own(tonetool, two_lights, make_image, write):
    tonetool(two_lights, "--lightindex", "-o", "m.exr")
    write("t.csv", "lamp,6\nkey,5\n")
    plain = make_image("plain.exr", 16, 4, ("R", "G", "B"), pixels=np.full((4, 16, 3), 0.5))
    ran = tonetool(plain, f"{CLASSIC}:lights=t.csv:lightindex=m.exr", "-o", "o.exr")
    assert maximum(ran) == (6, "lights lamp") and ran.fact("light-index") == "m.exr"
    make_image("one.exr", 16, 4, ("Y",), pixels=np.ones((4, 16, 1)))
    write("u.csv", "0,3\n1,7\n")
    ran = tonetool(plain, f"{CLASSIC}:lights=u.csv:lightindex=one.exr", "-o", "o.exr")
    assert maximum(ran) == (7, "lights 1")
    for name, size, channels, words in (("small.exr", (8, 4), ("M",), ("8x4", "16x4")),
                                        ("two.exr", (16, 4), ("a", "b"), ("two.exr", "lightindex"))):
        make_image(name, *size, channels, pixels=np.ones((size[1], size[0], len(channels))))
        ran = tonetool(plain, f"{CLASSIC}:lights=u.csv:lightindex={name}", "-o", "x.exr", status=1)
        assert all(word in ran.err for word in words)


def test_the_names_an_index_was_made_with(tonetool, two_lights, make_image, read, write):
    tonetool(two_lights, "--lightindex", "-o", "m.exr")
    pixels, spec = read("m.exr")
    color = np.concatenate([np.full(pixels.shape[:2] + (3,), 0.5), pixels], -1)
    names = spec.get_string_attribute("lightindex:names")
    source = make_image("both.exr", 16, 4, ("R", "G", "B", "lightindex"), pixels=color,
                        attributes={"lightindex:names": names})
    write("t.csv", "lamp,6\nkey,5\n")
    assert maximum(tonetool(source, f"{CLASSIC}:lights=t.csv", "-o", "o.exr")) == (6, "lights lamp")


def test_percentiles_leave_fireflies_out(tonetool, make_image):
    key = np.full((10, 100), 2.0)
    key[3, 7] = 500
    source = lit(make_image, "fly.exr", {"key": key, "lamp": 0.1})
    assert maximum(tonetool(source, CLASSIC, "-o", "o.exr"))[0] == 500
    assert maximum(tonetool(source, f"{CLASSIC}:maxpercentile=99.5", "-o", "o.exr"))[0] == 2
    ran = tonetool(source, f"{CLASSIC}:maxpercentile=99.5:maximum=image", "-o", "o.exr")
    assert maximum(ran)[0] == pytest.approx(2.1)


# ---- tables


LAMP = {"type": "AREA", "power_rgb_W": [10, 10, 10], "area_m2": 0.5}


@pytest.mark.parametrize("light,luminance", [
    (LAMP, 10 / (np.pi * 0.5)), ({**LAMP, "two_sided": True}, 10 / np.pi),
    ({**LAMP, "radiance_rgb": [3, 3, 3]}, 3), ({"power": 7, "area": 2}, 7 / (2 * np.pi)),
    ({"luminance": 12}, 12), ([1, 2, 3], float(np.dot([1, 2, 3], WEIGHTS))), (2.5, 2.5),
    ({"lights": [LAMP, {"luminance": 9}]}, 9), ({"lights": [LAMP, {"type": "POINT"}]}, 10 / np.pi * 2),
])
def test_lights_in_json(tonetool, two_lights, write, light, luminance):
    for what in ({"key": light}, {"groups": {"key": light}}, {"0": light}, [light],
                 {"lights": [light]}):
        write("t.json", what)
        ran = tonetool(two_lights, "--lightindex:lights=t.json", "-o", "m.exr")
        assert float(ran.fact("group 0").split("luminance ")[1]) == \
            pytest.approx(luminance, rel=1e-5), what


def test_lights_without_a_luminance_are_named(tonetool, two_lights, write):
    write("t.json", {"groups": {
        "key": {"lights": [{"name": "spot", "type": "SPOT", "power_lum_W": 11}]},
        "lamp": {"lights": [LAMP]}}})
    ran = tonetool(two_lights, f"{CLASSIC}:lights=t.json", "-o", "o.exr")
    assert "spot is a light without an area (SPOT)" in ran.err
    assert maximum(ran) == (8, "groups key")


def test_another_unit(tonetool, two_lights, write):
    write("t.csv", "key,5000\nlamp,20\n")
    assert maximum(tonetool(two_lights, f"{CLASSIC}:lights=t.csv:lightunit=0.01", "-o", "o.exr")) == \
        (50, "lights key")
    write("nits.csv", "key,5e5\nlamp,20\n")
    assert "lightunit=" in tonetool(two_lights, f"{CLASSIC}:lights=nits.csv", "-o", "o.exr").err
    # Powers without an area are no luminance: the groups' own maximum is.
    ran = tonetool(two_lights, f"{CLASSIC}:lights=t.csv:lightunit=power:index=power", "-o", "o.exr")
    assert maximum(ran) == (8, "groups key") and "without an area" in ran.err
    # A large panel of low luminance is the light of the largest power.
    write("t.json", {"key": {"power": 1, "area": 0.001}, "lamp": {"power": 50, "area": 100}})
    power = "--lightindex:index=power:lights=t.json"
    assert tonetool(two_lights, power, "-o", "m.exr").fact("group 0").startswith("key: pixels 64")
    assert tonetool(two_lights, power + ":lightunit=power", "-o", "m.exr").fact(
        "group 1").startswith("lamp: pixels 64")


BAD_TABLES = [
    ("t.csv", "key,1\nlamp,abc\n", ["t.csv", "line 2", "abc"]),
    ("t.csv", "key,-1\n", ["line 1", "-1"]), ("t.csv", "key,nan\n", ["line 1", "nan"]),
    ("t.csv", "key,1,2\n", ["line 1", "3 field"]), ("t.csv", "-1,2\n", ["line 1", "index -1"]),
    ("t.csv", "1.5,2\n", ["1.5"]), ("t.csv", "\n# x\nkey,1\nkey,2\n", ["line 4", "twice"]),
    ("t.csv", "# nothing\n", ["no light"]), ("t.csv", "key;1\n", ["line 1", "key;1"]),
    ("t.json", "{\n\"key\": }", ["t.json", "line 2"]), ("t.json", "3", ["by name"]),
    ("t.json", {"key": "bright"}, ["/key", "bright"]),
    ("t.json", {"groups": {"key": {"lights": [{"luminance": -2}]}}},
     ["/groups/key/lights/0/luminance", "-2"]),
    ("t.json", {"key": {"colour": 1}}, ["/key", "power"]), ("t.json", [[1, 2]], ["/0", "[1,2]"]),
    ("t.json", '{"key": 1e999}', ["t.json", "1e999"]), ("t.json", '{"key": NaN}', ["line 1"]),
    ("t.json", '[{"index": 1e99, "luminance": 1}]', ["/0/index", "1e+99"]),
    ("t.json", '{"key": ' * 101 + "1" + "}" * 101, ["t.json", "nested deeper than 100"]),
    ("t.txt", "key,1", [".csv"]), ("", "", ["missing.csv", "no such file"]),
]


@pytest.mark.parametrize("name,text,words", BAD_TABLES)
def test_what_is_wrong_with_a_table(tonetool, two_lights, write, tmp_path, name, text, words):
    file = write(name, text) if name else "missing.csv"
    for command in ("--cgtmo", "--lightindex"):
        ran = tonetool(two_lights, f"{command}:lights={file}", "-o", "out.exr", status=1)
        assert all(word in ran.err for word in words), ran.err
        assert not (tmp_path / "out.exr").exists()


# ---- panoramas


def adaptation(tonetool, options, source="grey.exr"):
    ran = tonetool(source, f"{CLASSIC}:{options}", "-o", "out.exr")
    return float(ran.fact("adaptation")), ran


@pytest.fixture
def grey(make_image):
    return make_image("grey.exr", pixels=np.full((12, 16, 3), 0.5))


@pytest.mark.parametrize("mean", ["geometric", "harmonic", "arithmetic", "median"])
def test_a_constant_panorama_gives_its_constant(tonetool, grey, make_image, mean):
    make_image("pano.exr", 64, 32, pixels=np.full((32, 64, 3), 0.75))
    for weight in ("solidangle", "none"):
        value, ran = adaptation(tonetool, f"env=pano.exr:lwa={mean}:weight={weight}")
        # The 1e-6 that geometric and harmonic means add, six digits.
        assert value == pytest.approx(0.75, rel=4e-6) and ran.fact("adaptation-from") == "env"


def test_solid_angles_against_the_integral(tonetool, grey, make_image):
    """ln L = sin(latitude)^2 has the mean 1/3 over the sphere, 1/2 over the rows."""
    rows = np.sin((0.5 - (np.arange(256) + 0.5) / 256) * np.pi)
    pixels = np.broadcast_to(np.exp(rows ** 2)[:, None, None], (256, 512, 3))
    make_image("pano.exr", 512, 256, pixels=pixels)
    # Rows are constant: their middle is off the mean over them by (pi / 256)^2 / 24 at most.
    assert adaptation(tonetool, "env=pano.exr")[0] == pytest.approx(np.exp(1 / 3), rel=1e-5)
    assert adaptation(tonetool, "env=pano.exr:weight=none")[0] == pytest.approx(np.exp(.5), rel=1e-5)


def test_turning_about_the_vertical_changes_nothing(tonetool, grey, make_image):
    pixels = np.random.default_rng(3).lognormal(size=(32, 64, 3))
    make_image("a.exr", 64, 32, pixels=pixels)
    make_image("b.exr", 64, 32, pixels=np.roll(pixels, 11, 1))
    make_image("c.exr", 64, 32, pixels=np.roll(pixels, 5, 0))
    a = adaptation(tonetool, "env=a.exr")[0]
    assert adaptation(tonetool, "env=b.exr")[0] == a
    assert adaptation(tonetool, "env=c.exr")[0] != a


def test_a_panorama_of_many_layers_and_an_image_of_one(tonetool, make_image):
    value, ran = adaptation(tonetool, f"env={GALLERY}:weight=none", CORNELL)
    stats = tonetool(GALLERY, "--luminancestats")
    assert float(stats.fact("min")) <= value <= float(stats.fact("mean"))
    assert ran.fact("adaptation-from") == "env"
    # layer= names the image's; the panorama has another one.
    make_image("pano.exr", 8, 4, pixels=np.full((4, 8, 3), 0.3))
    value, _ = adaptation(tonetool, "env=pano.exr:layer=ViewLayer.Combined", CORNELL)
    assert value == pytest.approx(0.3, rel=1e-5)


def test_what_is_wrong_with_a_panorama(tonetool, grey, make_image, tmp_path):
    make_image("square.exr", 32, 32)
    one = make_image("one.exr", 1, 1, pixels=np.full((1, 1, 3), 0.2))
    (tmp_path / "text.exr").write_text("no picture")
    for options, words in (("env=square.exr", ["32 x 32", "weight=none"]),
                           (f"env={one}", ["1 x 1"]), ("env=none.exr", ["none.exr", "no such file"]),
                           ("env=text.exr", ["text.exr"]), ("maximum=env", ["env="]),
                           ("env=square.exr:weight=area", ["area", "solidangle"])):
        ran = tonetool(grey, f"{CLASSIC}:{options}", "-o", "bad.exr", status=1)
        assert all(word in ran.err for word in words), ran.err
        assert not (tmp_path / "bad.exr").exists()
    assert adaptation(tonetool, f"env={one}:weight=none")[0] == pytest.approx(0.2, rel=1e-5)


def test_a_black_panorama_and_one_with_holes(tonetool, grey, make_image):
    make_image("black.exr", 8, 4, pixels=np.zeros((4, 8, 3)))
    value, ran = adaptation(tonetool, "env=black.exr:maximum=env")
    assert value == pytest.approx(0.5, rel=1e-5) and ran.fact("adaptation-from") == "image"
    assert maximum(ran) == (0.5, "image") and "is black and is left out" in ran.err
    ran = tonetool(grey, f"{CLASSIC}:env=black.exr:strict=1:position=none:normal=none:albedo=none",
                   "-o", "out.exr", status=1)
    assert "is black" in ran.err
    pixels = np.full((4, 8, 3), 0.25)
    pixels[1, 2] = np.nan
    make_image("holes.exr", 8, 4, pixels=pixels)
    value, ran = adaptation(tonetool, "env=holes.exr")
    assert value == pytest.approx(0.25, rel=1e-5) and "1 pixel(s) of the panorama" in ran.err
    make_image("nan.exr", 8, 4, pixels=np.full((4, 8, 3), np.nan))
    assert "no finite pixel" in tonetool(grey, f"{CLASSIC}:env=nan.exr", "-o", "x.exr", status=1).err


def test_a_panorama_at_another_exposure(tonetool, grey, make_image):
    make_image("pano.exr", 8, 4, pixels=np.full((4, 8, 3), 1e4))
    assert "one exposure" in adaptation(tonetool, "env=pano.exr")[1].err


def test_a_panorama_cut_to_its_data_window(tonetool, grey, make_image):
    """The rows that are there keep their place on the sphere."""
    pixels = np.random.default_rng(3).lognormal(size=(16, 64, 3))
    make_image("cut.exr", 64, 16, pixels=pixels, window=(0, 8, 0, 0, 64, 32))
    value, ran = adaptation(tonetool, "env=cut.exr")
    edges = np.cos(np.arange(8, 25) * np.pi / 32)
    weights = (edges[:-1] - edges[1:])[:, None] * np.ones(64)
    logs = np.log(pixels @ WEIGHTS + 1e-6)
    assert value == pytest.approx(np.exp((logs * weights).sum() / weights.sum()), rel=1e-5)
    assert "1024 pixel(s) of the panorama" in ran.err


# ---- images that have next to nothing


def test_sky_everywhere_and_one_pixel(tonetool, make_image, write):
    write("t.csv", "key,5\noff,3\n")
    sky = lit(make_image, "sky.exr", {"off": [[0.4] * 8] * 6})
    assert maximum(tonetool(sky, f"{CLASSIC}:lights=t.csv", "-o", "o.exr")) == (3, "lights off")
    assert maximum(tonetool(sky, CLASSIC, "-o", "o.exr")) == (pytest.approx(.4), "groups off")
    one = lit(make_image, "one.exr", {"key": [[2]]})
    assert maximum(tonetool(one, f"{CLASSIC}:lights=t.csv", "-o", "o.exr")) == (5, "lights key")
    dark = lit(make_image, "dark.exr", {"key": [[0]]})
    assert "black" in tonetool(dark, f"{CLASSIC}:lights=t.csv", "-o", "o.exr", status=1).err


BAD = [
    ("maximum=best", ["best", "auto"]), ("maximum=lights", ["lights="]),
    ("lights=t.csv:maximum=image", ["table"]), ("lightindex=M", ["lights="]),
    ("lightunit=power", ["lights="]), ("lights=t.csv:lightunit=nits", ["nits", "power"]),
    ("lights=t.csv:lightunit=-1", ["-1"]), ("index=most", ["most", "contribution"]),
    ("index=power", ["lights="]), ("maxpercentile=20", ["maxpercentile"]),
    ("groups=rim", ["rim", "key"]),
]


@pytest.mark.parametrize("modifiers,words", BAD)
def test_what_is_wrong_is_said(tonetool, two_lights, write, modifiers, words):
    write("t.csv", "key,1\n")
    ran = tonetool(two_lights, f"{CLASSIC}:{modifiers}", "-o", "out.exr", status=1)
    assert all(word in ran.err for word in words), ran.err


def scenes():
    folder = Path(os.environ.get("SHARED_DIR", "")) / "scenes"
    if not os.environ.get("SHARED_DIR") or not (folder / "gallery" / "lights.json").exists():
        pytest.skip("SHARED_DIR has no rendered scenes with lights.json")
    return folder


@pytest.mark.parametrize("scene,light", [("cornell", "key"), ("nightstreet", "cars"),
                                         ("gallery", "key")])
def test_rendered_scenes_with_their_lights(tonetool, scene, light):
    """The largest radiance in lights.json of a group that is seen, by its own arithmetic."""
    folder = scenes() / scene
    ran = tonetool(folder / "ref.exr", f"{CLASSIC}:lights={folder}/lights.json:env={folder}/"
                   "env_pano.exr", "-o", "out.exr")
    lights = json.loads((folder / "lights.json").read_text())["groups"][light]["lights"]
    brightest = max(np.dot(one["radiance_rgb"], WEIGHTS) for one in lights)
    assert maximum(ran) == (pytest.approx(brightest, rel=1e-5), f"lights {light}")
    assert ran.fact("adaptation-from") == "env"
