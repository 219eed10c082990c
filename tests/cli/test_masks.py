# SPDX-License-Identifier: BSD-3-Clause
"""mask= and ignore=: which pixels of a comparison count, and that none is left out unseen."""

import json
import os
import shutil

import numpy as np
import OpenImageIO as oiio
import pytest
from crypto_pair import Render

WIDTH, HEIGHT = 80, 64
BAD = (slice(10, 30), slice(20, 50))  # rows, columns; "30x20+20+10"
GEOM = "30x20+20+10,1x1+70+60"
MAPS = ["--hdrflip", "--ldrflip", "--flipdiff", "--errormap:metric=mse", "--errormap:metric=mpsnr",
        "--errormap:metric=smape"]
NUMBERS = ["--diff", "--pdiff"]
REFERENCE = np.random.default_rng(1).random((HEIGHT, WIDTH, 3)).astype(np.float32)


def damaged():
    """What is wrong with it lies in GEOM alone."""
    pixels = REFERENCE.copy()
    pixels[BAD] *= 1.5
    pixels[60, 70] = np.nan
    return pixels


def counts():
    """1 where the pixels are right."""
    mask = np.ones((HEIGHT, WIDTH, 1))
    mask[BAD] = mask[60, 70] = 0
    return mask


@pytest.fixture
def put(make_image):
    def write(name, pixels, kind="float", channels=None, **options):
        names = channels or ("RGBA"[:pixels.shape[2]] if pixels.shape[2] > 1 else "Y")
        return make_image(name, pixels.shape[1], pixels.shape[0], tuple(names), kind, pixels, **options)

    return write


@pytest.fixture
def pair(put):
    put("mask.png", counts(), "uint8")
    return put("ref.exr", REFERENCE), put("test.exr", damaged())


def measured(path):
    return json.loads(path.read_text())["frames"][0]["measurements"][0]


def without_share(record):
    record.get("parameters", {}).pop("ignored", None)
    return {key: value for key, value in record.items() if value != {}}


def pixels_of(path):
    image = oiio.ImageBuf(str(path))
    assert not image.has_error, image.geterror()
    return image.get_pixels(oiio.FLOAT)


@pytest.mark.parametrize("command", MAPS)
def test_a_mask_of_ones_changes_no_bit(tonetool, pair, put, tmp_path, command):
    put("ones.png", np.ones((HEIGHT, WIDTH, 1)), "uint8")
    for name, words in (("with", f"{command}:mask=ones.png"), ("without", command)):
        tonetool(*pair, words, "-o", f"{name}.exr", "--json", f"{name}.json")
    share = measured(tmp_path / "with.json")["parameters"]["ignored"]
    assert share == 0 and "ignored" not in measured(tmp_path / "without.json")["parameters"]
    assert without_share(measured(tmp_path / "with.json")) == measured(tmp_path / "without.json")
    assert pixels_of(tmp_path / "with.exr").tobytes() == pixels_of(tmp_path / "without.exr").tobytes()


@pytest.mark.parametrize("command", [*NUMBERS, "--biascheck:fail=0:inconclusive=pass"])
def test_a_mask_of_ones_changes_no_number(tonetool, pair, put, tmp_path, command):
    put("ones.png", np.ones((HEIGHT, WIDTH, 1)), "uint8")
    status = 1 if command in NUMBERS else 0
    records = []
    for words in (f"{command}:mask=ones.png", command):
        tonetool(*pair, words, "--json", "a.json", status=status)
        records.append(repr(without_share(measured(tmp_path / "a.json")))) # nan is nan
    assert records[0] == records[1]


@pytest.mark.parametrize("words", ["mask=mask.png", f"ignore={GEOM}"])
@pytest.mark.parametrize("command", MAPS)
def test_what_is_ignored_is_in_no_number(tonetool, pair, tmp_path, command, words):
    ran = tonetool(*pair, f"{command}:{words}", "-o", "map.exr", "--json", "a.json")
    found = measured(tmp_path / "a.json")
    assert found["status"] == "measured" and "warnings" not in found and not ran.err
    assert found["quantities"]["mean"] == found["quantities"]["max"] == 0
    assert found["parameters"]["ignored"] == pytest.approx(601 / (WIDTH * HEIGHT), rel=1e-12)
    assert found["pixels"] == sum(found["histogram"]) == WIDTH * HEIGHT - 601
    assert found["parameters"]["test-nonfinite"] == 0
    assert not pixels_of(tmp_path / "map.exr").any()
    assert "80x64 pixels, 11.7 % ignored" in ran.out


@pytest.mark.parametrize("words", ["mask=mask.png", f"ignore={GEOM}"])
@pytest.mark.parametrize("command", NUMBERS)
def test_diff_ignores(tonetool, pair, tmp_path, command, words):
    tonetool(*pair, command, status=1)
    ran = tonetool(*pair, f"{command}:{words}", "--json", "a.json")
    assert "PASS" in ran.out.splitlines() and "11.7 % ignored" in ran.out
    found = measured(tmp_path / "a.json")
    assert found["pixels"] == WIDTH * HEIGHT - 601 and found["quantities"]["max"] == 0


@pytest.mark.parametrize("command", [*MAPS, *NUMBERS])
def test_a_fault_that_counts_is_found_beside_ignored_ones(tonetool, pair, put, tmp_path, command):
    pixels = damaged()
    pixels[40:56, 54:74] = 0
    put("worse.exr", pixels)
    status = 1 if command in NUMBERS else 0
    tonetool("ref.exr", "worse.exr", f"{command}:mask=mask.png", "--json", "a.json", status=status)
    found = measured(tmp_path / "a.json")
    x, y = found["worst"]
    assert 54 <= x < 74 and 40 <= y < 56 and found["quantities"]["max"] > 0


def test_all_of_one_limit(tonetool, pair):
    tonetool(*pair, "--hdrflip:fail=0.001", status=3)
    ran = tonetool(*pair, f"--hdrflip:fail=0.001:ignore={GEOM}")
    assert "PASS mean 0 <= 0.001, 11.7 % ignored (test.exr)" in ran.out


# ---- laws

BORDER = "80x8+0+0,80x8+0+56,12x64+0+0,12x64+68+0"
INSIDE = "56x48+12+8"


def bordered(inside, mode):
    return np.pad(inside, ((8, 8), (12, 12), (0, 0)), mode)


@pytest.fixture
def crops(put):
    """A pair whose border is equal, and what is inside it."""
    random = np.random.default_rng(5)
    first = random.random((48, 56, 3)).astype(np.float32)
    second = (first * random.uniform(0.7, 1.3, first.shape)).astype(np.float32)
    border = random.random((HEIGHT, WIDTH, 3)).astype(np.float32) * 40
    for name, inside in (("r", first), ("t", second)):
        put(f"{name}_crop.exr", inside)
        whole = border.copy()
        whole[8:56, 12:68] = inside
        put(f"{name}.exr", whole)


@pytest.mark.parametrize("metric", ["mae", "mse", "rmae", "relmse", "smape", "psnr", "mpsnr"])
def test_a_mask_equals_a_crop(tonetool, crops, tmp_path, metric):
    command = f"--errormap:metric={metric}:fail=p99.95=1e9,above0.01=0.99" if metric == "mae" else \
        f"--errormap:metric={metric}"
    tonetool("r.exr", "t.exr", f"{command}:ignore={BORDER}", "-o", "mask.exr", "--json", "mask.json")
    tonetool("r_crop.exr", "t_crop.exr", command, "-o", "crop.exr", "--json", "crop.json")
    mask, crop = measured(tmp_path / "mask.json"), measured(tmp_path / "crop.json")
    for field in ("quantities", "histogram", "pixels", "exposures"):
        assert mask.get(field) == crop.get(field), field
    assert mask["worst"] == [crop["worst"][0] + 12, crop["worst"][1] + 8]
    inside = pixels_of(tmp_path / "mask.exr")[8:56, 12:68]
    assert inside.tobytes() == pixels_of(tmp_path / "crop.exr").tobytes()


def test_a_mask_equals_a_crop_for_diff(tonetool, crops, tmp_path):
    tonetool("r.exr", "t.exr", f"--diff:ignore={BORDER}", "--json", "mask.json", status=1)
    tonetool("r_crop.exr", "t_crop.exr", "--diff", "--json", "crop.json", status=1)
    mask, crop = measured(tmp_path / "mask.json"), measured(tmp_path / "crop.json")
    assert mask["quantities"] == crop["quantities"] and mask["pixels"] == crop["pixels"]
    assert mask["worst"] == [crop["worst"][0] + 12, crop["worst"][1] + 8]


@pytest.mark.parametrize("command", ["--hdrflip", "--ldrflip", "--biascheck"])
def test_threads_and_memory_change_no_bit(tonetool, crops, tmp_path, command):
    results = []
    for words in ([], ["--threads", "1"], ["--threads", "3"], ["--memory", "180M"]):
        tonetool(*words, "r.exr", "t.exr", f"{command}:ignore={BORDER},3x3+30+30", "-o", "a.exr",
                 "--json", "a.json", status=3 if command == "--biascheck" else 0)
        results.append((measured(tmp_path / "a.json"), pixels_of(tmp_path / "a.exr").tobytes()))
    assert all(result == results[0] for result in results)


def test_neighbours_see_the_reference(tonetool, put, tmp_path):
    """Of a pixel beside an ignored one FLIP's filters see as much as of equal images."""
    put("ref.exr", REFERENCE)
    one, other = REFERENCE.copy(), REFERENCE.copy()
    one[30:34, 30:34], other[30:34, 30:34] = 50, np.inf
    maps = []
    for pixels in (one, other):
        pixels[36, 36] *= 3
        put("test.exr", pixels)
        tonetool("ref.exr", "test.exr", "--hdrflip:ignore=4x4+30+30", "-o", "map.exr")
        maps.append(pixels_of(tmp_path / "map.exr"))
    assert maps[0].tobytes() == maps[1].tobytes() and maps[0][36, 36] > 0.1
    assert not maps[0][30:34, 30:34].any() and maps[0][35, 35] > 0


def test_exposures_are_of_what_counts(tonetool, put, tmp_path):
    pixels = REFERENCE.copy()
    pixels[5, 5] = 1000
    put("lamp.exr", pixels)
    put("ref.exr", REFERENCE)
    exposures = []
    for name in ("lamp", "ref"):
        for how in ("", ":exposures=shot"):
            files = [f"{name}.0001.exr", f"{name}.0002.exr"]
            for file in files:
                shutil.copy(tmp_path / f"{name}.exr", tmp_path / file)
                shutil.copy(tmp_path / file, tmp_path / f"test.{file}")
            tonetool(f"{name}.#.exr", f"test.{name}.#.exr", f"--hdrflip:ignore=1x1+5+5{how}", "--json",
                     "a.json")
            exposures.append(measured(tmp_path / "a.json")["exposures"])
    assert all(one == exposures[0] for one in exposures), exposures


# ---- what a mask is

def ring(value, other):
    mask = np.full((HEIGHT, WIDTH, 1), float(other))
    mask[BAD] = mask[60, 70] = value
    return mask


@pytest.mark.parametrize("mask, kind", [
    (ring(127 / 255, 128 / 255), "uint8"), (ring(32767 / 65535, 32768 / 65535), "uint16"),
    (ring(0.4999, 0.5), "float"), (ring(np.nan, 7), "float"), (ring(-np.inf, np.inf), "float"),
    (ring(-1, 0.5), "half")])
def test_what_counts(tonetool, pair, put, tmp_path, mask, kind):
    name = put("m.tif" if kind.startswith("u") else "m.exr", mask, kind)
    tonetool(*pair, f"--hdrflip:mask={name}", "--json", "a.json")
    found = measured(tmp_path / "a.json")
    assert found["quantities"]["max"] == 0 and found["pixels"] == WIDTH * HEIGHT - 601


@pytest.mark.parametrize("channels", ["RGB", "A", "YA"])
def test_the_first_channel_counts(tonetool, pair, put, channels):
    mask = np.repeat(1 - counts(), len(channels), axis=2)
    mask[..., 0] = counts()[..., 0]
    put("m.exr", mask, channels=channels)
    assert "11.7 % ignored" in tonetool(*pair, "--hdrflip:mask=m.exr").out


def test_a_mask_and_regions_together(tonetool, pair):
    ran = tonetool(*pair, "--hdrflip:mask=mask.png:ignore=80x1+0+0,1x64+0+0")
    assert f"{100 * (601 + 80 + 63) / (80 * 64):.3g} % ignored" in ran.out


def test_the_mask_lies_on_the_display_window(tonetool, put, tmp_path):
    """Wherever that begins; with overscan, which a mask of the display window does not know of."""
    window = (96, 46, 100, 50, WIDTH - 8, HEIGHT - 8)  # 4 pixels of overscan at each side
    pixels = damaged()
    pixels[60, 70] = REFERENCE[60, 70]
    put("ref.exr", REFERENCE, window=window)
    put("test.exr", pixels, window=window)
    put("mask.png", counts()[4:-4, 4:-4], "uint8")
    words = f"{WIDTH - 8}x{HEIGHT - 8}"
    tonetool("ref.exr", "test.exr", "--hdrflip:mask=mask.png", "--json", "a.json")
    assert measured(tmp_path / "a.json")["quantities"]["max"] == 0
    tonetool("ref.exr", "test.exr", "--hdrflip:ignore=30x20+116+56", "--json", "a.json")
    assert measured(tmp_path / "a.json")["quantities"]["max"] == 0
    pixels[0, 0] = 5  # in the overscan
    put("test.exr", pixels, window=window)
    tonetool("ref.exr", "test.exr", "--hdrflip:mask=mask.png", "--json", "a.json")
    assert measured(tmp_path / "a.json")["worst"] == [96, 46]
    tonetool("ref.exr", "test.exr", "--hdrflip:mask=mask.png:crop=1", status=0)
    put("mask.exr", counts(), window=window)  # knows of it
    tonetool("ref.exr", "test.exr", "--hdrflip:mask=mask.exr:ignore=1x1+96+46", "--json", "a.json")
    assert measured(tmp_path / "a.json")["quantities"]["max"] == 0
    put("mask.png", counts(), "uint8")
    assert f"it has 80x64 pixels, the reference {words}" in tonetool(
        "ref.exr", "test.exr", "--hdrflip:mask=mask.png", status=1).err


def test_a_mask_is_black_outside_its_data_window(tonetool, pair, put):
    """Nothing counts there."""
    put("m.exr", np.ones((10, 40, 1)), window=(20, 40, 0, 0, WIDTH, HEIGHT))
    ran = tonetool(*pair, "--hdrflip:mask=m.exr")
    assert f"{100 * (1 - 400 / 5120):.3g} % ignored" in ran.out and "mean 0," in ran.out


def test_the_mask_of_a_resized_comparison_is_the_references(tonetool, pair, put, tmp_path):
    put("large.exr", np.repeat(np.repeat(REFERENCE, 2, 0), 2, 1))
    tonetool("ref.exr", "large.exr", "--hdrflip:resize=1:mask=mask.png", "--json", "a.json")
    assert measured(tmp_path / "a.json")["pixels"] == WIDTH * HEIGHT - 601
    assert "they must be the same" in tonetool(
        "large.exr", "ref.exr", "--hdrflip:resize=1:mask=mask.png", status=1).err


def test_a_mask_must_be_turned_as_the_images_are(tonetool, pair, put):
    put("m.exr", counts(), attributes={"Orientation": 3})
    assert "its Orientation is 3, that of the reference 1" in tonetool(
        *pair, "--hdrflip:mask=m.exr", status=1).err


# ---- nothing is ignored unseen

@pytest.mark.parametrize("command", ["--hdrflip:fail=1e-6", "--ldrflip:fail=1e-6", "--flipdiff:fail=0.1",
                                     "--errormap:metric=mse:fail=1e-9", "--biascheck", *NUMBERS])
def test_nothing_left_is_an_error(tonetool, pair, put, command):
    put("zero.png", 0 * counts(), "uint8")
    put("dark.png", 0.3 * np.ones_like(counts()), "uint8")
    for words in ("mask=zero.png", "mask=dark.png", f"ignore={WIDTH}x{HEIGHT}+0+0", "ignore=40x64+0+0,40x64+40+0"):
        ran = tonetool(*pair, f"{command}:{words}", status=1)
        assert "mask and ignore leave no pixel that counts" in ran.err and "PASS" not in ran.out


@pytest.mark.parametrize("command", ["--hdrflip", "--errormap:metric=mse", "--diff", "--pdiff"])
def test_an_inverted_mask_is_told(tonetool, pair, put, command):
    put("inverted.png", 1 - counts(), "uint8")
    ran = tonetool("ref.exr", "ref.exr", f"{command}:mask=inverted.png", "--json", "a.json")
    assert "88.3 % of the pixels do not count" in ran.err and "88.3 % ignored" in ran.out
    tonetool("ref.exr", "ref.exr", f"{command}:mask=inverted.png", "--json", "a.json", "--warnings-exit",
             status=2)


@pytest.mark.parametrize("words, said", [
    ("mask=none.png", 'mask "none.png": there is no such file'),
    ("mask=text.png", "text.png"),
    ("mask=wide.png", 'mask "wide.png": it has 81x64 pixels, the reference 80x64'),
    ("mask=deep.exr", "deep images are not supported"),
    ("mask=", 'modifier "mask" has no value'),
    ("ignore=", 'modifier "ignore" has no value'),
    *((f"ignore={text}", f'ignore has "{bad}": must be WxH+X+Y, with commas between several')
      for text, bad in (("3x3", "3x3"), ("3x3+1", "3x3+1"), ("0x3+1+1", "0x3+1+1"), ("3x3+1+1+1", "3x3+1+1+1"),
                        ("3x3+1+1,", ""), ("3x3+1+1, 3x3+9+9", " 3x3+9+9"), ("-3x3+1+1", "-3x3+1+1"),
                        ("3x3+1e1+1", "3x3+1e1+1"), ("9999999999x3+1+1", "9999999999x3+1+1"),
                        ("3X3+1+1", "3X3+1+1"), ("50%", "50%"))),
    ("ignore=3x3+80+0", 'ignore has "3x3+80+0", which holds none of the compared pixels, 80x64+0+0'),
    ("ignore=3x3-9-9", "holds none of the compared pixels"),
    ("mask=mask.png:masks=x", 'unknown modifier "masks"')])
def test_refused(tonetool, pair, put, testimages, tmp_path, words, said):
    put("wide.png", np.ones((HEIGHT, WIDTH + 1, 1)), "uint8")
    shutil.copy(testimages / "deep.exr", tmp_path / "deep.exr")
    (tmp_path / "text.png").write_text("no image")
    for command in ("--hdrflip:fail=0.9", "--diff"):
        ran = tonetool(*pair, f"{command}:{words}", status=1)
        assert said in ran.err and "PASS" not in ran.out


def test_tmqi_has_no_mask(tonetool, pair):
    assert 'unknown modifier "mask"' in tonetool(*pair, "--tmqi:mask=mask.png", status=1).err


# ---- checks

@pytest.fixture
def shot(put):
    for frame in (1, 2):
        put(f"r.{frame:04}.exr", REFERENCE)
        put(f"t.{frame:04}.exr", damaged())
    put("m.0001.png", counts(), "uint8")
    return ["r.#.exr", "t.#.exr", "--hdrflip:fail=0.001:mask=m.#.png"]


def test_each_frame_has_its_mask(tonetool, shot, put, tmp_path):
    ran = tonetool(*shot, "--json", "a.json", status=1)
    frames = json.loads((tmp_path / "a.json").read_text())["frames"]
    assert [frame["status"] for frame in frames] == ["passed", "error"]
    assert 'mask "m.0002.png": there is no such file' in ran.err
    put("m.0002.png", 0 * counts(), "uint8")
    tonetool(*shot, "--json", "a.json", status=1)
    put("m.0002.png", counts(), "uint8")
    tonetool(*shot, "--json", "a.json", "--report", "page.html")
    assert [frame["status"] for frame in json.loads((tmp_path / "a.json").read_text())["frames"]] == ["passed"] * 2


def test_each_case_has_its_mask(tonetool, put, tmp_path):
    for folder in ("refs", "outs", "masks"):
        os.mkdir(tmp_path / folder)
    for name in ("a", "b"):
        put(f"refs/{name}.exr", REFERENCE)
        put(f"outs/{name}.exr", damaged())
    put("masks/a.png", counts(), "uint8")
    words = ["refs/%N.exr", "outs/%N.exr", "--hdrflip:fail=0.001:mask=masks/%N.png", "--json", "a.json"]
    assert 'mask "masks/b.png": there is no such file' in tonetool(*words, status=1).err
    put("masks/b.png", counts(), "uint8")
    tonetool(*words)


def test_a_check_that_goes_on_sees_that_the_mask_has_changed(tonetool, shot, put):
    put("m.0002.png", counts(), "uint8")
    tonetool(*shot, "--state", "state")
    put("m.0002.png", 1 - counts(), "uint8")
    ran = tonetool(*shot, "--state", "state", status=3)
    assert "1 failed, 1 passed" in ran.out


def test_a_mask_is_not_written_over(tonetool, pair, tmp_path):
    before = (tmp_path / "mask.png").read_bytes()
    assert '"mask.png" is read, and would be written over' in tonetool(
        *pair, "--hdrflip:mask=mask.png", "--json", "mask.png", status=1).err
    assert (tmp_path / "mask.png").read_bytes() == before


# ---- noise or change

def renders(size=160):
    light = np.full((size, size, 3), 0.5)
    return [(light * np.random.default_rng(seed).gamma(64, 1 / 64, (size, size, 1))).astype(np.float32)
            for seed in (1, 2)]


def test_biascheck_judges_what_counts(tonetool, put, tmp_path):
    first, second = renders()
    second[:70, :90] *= 1.5
    put("a.exr", first)
    put("b.exr", second)
    tonetool("a.exr", "b.exr", "--biascheck", status=3)
    ran = tonetool("a.exr", "b.exr", "--biascheck:ignore=90x70+0+0", "-o", "map.exr", "--json", "a.json")
    assert "PASS equal within 5 %" in ran.out and "160x160, 24.6 % ignored" in ran.out
    assert measured(tmp_path / "a.json")["pixels"] == 160 * 160 - 90 * 70
    assert not pixels_of(tmp_path / "map.exr")[:70, :90].any()


def test_biascheck_does_not_dilute_what_counts(tonetool, put):
    """Of each block a tenth counts, and that is changed: as much as if nothing else were there."""
    first, second = renders()
    mask = np.zeros((160, 160, 1))
    mask[:, ::5] = 1
    second[:, ::5] *= 1.3
    put("a.exr", first)
    put("b.exr", second)
    put("m.exr", mask)
    ran = tonetool("a.exr", "b.exr", "--biascheck:mask=m.exr", "-v", status=3)
    assert "FAIL different" in ran.out
    assert 0.28 < float(ran.fact("gain").split()[0]) < 0.32


@pytest.mark.parametrize("step", [2, 3])
def test_biascheck_of_a_sieve_is_no_false_alarm(tonetool, put, step):
    """Neither noise nor its correlation is taken for less where pixels between do not count."""
    first, second = renders()
    mask = np.zeros((160, 160, 1))
    mask[::step, :] = 1
    put("a.exr", first)
    put("b.exr", second)
    put("m.exr", mask)
    ran = tonetool("a.exr", "b.exr", "--biascheck:mask=m.exr")
    assert "PASS equal within 5 %" in ran.out and "pixels independent" in ran.out


def test_biascheck_of_dust_tells_nothing(tonetool, put):
    first, second = renders(640)
    mask = np.zeros((640, 640, 1))
    mask[::16, ::16] = 1
    put("a.exr", first)
    put("b.exr", second)
    put("m.exr", mask)
    ran = tonetool("a.exr", "b.exr", "--biascheck:mask=m.exr", status=3)
    assert "not enough samples: the image has 1600 pixel(s) that count" in ran.out


# ---- whose error is it

@pytest.fixture
def attributed(tonetool, tmp_path):
    """What is printed of a pair with attribute=1, and the attribution of its JSON."""

    def run(test, words, reference=None):
        (reference or Render()).write(tmp_path / "ref.exr")
        test.write(tmp_path / "test.exr")
        ran = tonetool("ref.exr", "test.exr", f"--hdrflip:attribute=1{words}", "--json", "a.json")
        return ran, measured(tmp_path / "a.json")

    return run


BALL = ":ignore=14x16+10+12"


def moved():
    render = Render(seed=2)
    render.color = (0.6, 0.5, 0.4)
    return render


def test_what_is_ignored_is_nobodys_error(attributed):
    ran, found = attributed(moved(), "")
    assert "object ball: other colour" in ran.out
    ran, found = attributed(moved(), BALL)
    assert "object" not in ran.out.replace("objects", "")
    mattes = {row["name"]: row for row in found["attribution"]["mattes"]["View.CryptoObject"]}
    assert "ball" not in mattes and mattes["floor"]["pixels_reference"] == 64 * 48 - 16 * 32 - 14 * 16
    assert sum(row["mass"] for row in mattes.values()) == pytest.approx(1, abs=1e-9)


def test_the_mean_that_is_attributed_is_the_one_that_is_measured(attributed):
    test = moved()
    test.lights = {"key": 0.5, "fill": 0.25}
    _, found = attributed(test, BALL)
    mean = found["quantities"]["mean"]
    for light in found["attribution"]["lights"]:
        assert light["explains"] == pytest.approx((mean - light["mean_replaced"]) / mean, rel=1e-6)


def test_layers_that_change_where_nothing_counts_have_not(attributed):
    test = moved()
    test.ball = (11, 12)
    ran, _ = attributed(test, "")
    assert "layer View.Depth: changed" in ran.out
    ran, found = attributed(test, ":ignore=15x16+10+12")
    depth = next(row for row in found["attribution"]["layers"] if row["kind"] == "depth")
    assert depth["changed"] == 0 and depth["max"] == 0 and "changed in" not in ran.out
