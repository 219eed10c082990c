# SPDX-License-Identifier: BSD-3-Clause
"""Results print on one screen, compare by value, and can be copied and pickled."""

import copy
import inspect
import pickle
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import TESTIMAGES, files, pixels_of


def cornell():
    return [oiio.ImageBuf(str(path)) for path in files("cornell")]


def hdr_of_arrays():
    rng = np.random.default_rng(3)
    reference = rng.random((24, 32, 3), np.float32)
    test = reference * np.float32(0.9)
    test[0, 0, 0] = np.nan
    return tonetool.hdr_flip(reference, test, want_exposures=True, want_exposure_map=True, quantities=["p99.95"])


def check_failed():
    with pytest.raises(tonetool.CheckFailed) as raised:
        tonetool.chain("--hdrflip:fail=0.01", cornell())
    return raised.value.result


def exported_lut():
    with tempfile.TemporaryDirectory() as folder:
        return tonetool.export_lut(folder + "/aces.cube")


# One of each class, some with arrays and some with ImageBufs.
def with_a_hole():
    pixels = np.random.default_rng(1).random((32, 48, 3), np.float32)
    pixels[8:24, 8:24] = 0.5
    image = oiio.ImageBuf(oiio.ImageSpec(48, 32, 3, "float"))
    image.set_pixels(oiio.ROI(0, 48, 0, 32), pixels)
    return image


def with_objects():
    spec = oiio.ImageSpec(32, 24, 4, "float")
    spec.channelnames = ["R", "G", "B", "IndexOB.X"]
    pixels = np.random.default_rng(1).random((24, 32, 4), np.float32)
    pixels[..., 3] = 1
    pixels[8:16, 12:20, 3] = 2
    image = oiio.ImageBuf(spec)
    image.set_pixels(oiio.ROI(0, 32, 0, 24), pixels)
    return image


def matted(key, names):
    """A render of one light whose left half is the first object and whose right half the second."""
    channels = [f"{layer}.{c}" for layer in ("Combined", "Combined_key") for c in "RGB"]
    channels += ["Depth.Z"] + [f"CryptoObject00.{c}" for c in "rgba"]
    spec = oiio.ImageSpec(32, 24, len(channels), "float")
    spec.channelnames = channels
    ids = {name: np.uint32(0x3f000000 + sum(name.encode())) for name in names}
    manifest = ",".join(f'"{name}":"{number:08x}"' for name, number in ids.items())
    for attribute, value in (("name", "CryptoObject"), ("hash", "MurmurHash3_32"),
                             ("conversion", "uint32_to_float32"), ("manifest", "{" + manifest + "}")):
        spec.attribute("cryptomatte/1234567/" + attribute, value)
    pixels = np.zeros((24, 32, len(channels)), np.float32)
    pixels[..., :6] = key * np.linspace(0.5, 1, 32)[None, :, None]
    pixels[..., 6] = 2
    for half, number in zip((slice(0, 16), slice(16, 32)), ids.values()):
        pixels[:, half, 7] = number.view(np.float32)
    pixels[..., 8] = 1
    image = oiio.ImageBuf(spec)
    image.set_pixels(oiio.ROI(0, 32, 0, 24), pixels)
    return image


def shot():
    lights = [tonetool.frame_light(picture, frame=number) for number, picture in enumerate(cornell())]
    return tonetool.shot_text(lights)


def read_shot():
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "shot.json"
        file.write_text(shot(), encoding="utf-8")
        return tonetool.read_shot(file)


MAKERS = {
    "hdr_flip of arrays": hdr_of_arrays,
    "hdr_flip of images": lambda: tonetool.hdr_flip(*cornell(), want_exposure_map=True),
    "ldr_flip": lambda: tonetool.ldr_flip(*cornell(), alpha="error"),
    "one exposure": lambda: hdr_of_arrays().exposures[0],
    "pool": lambda: hdr_of_arrays().summary.pool,
    "side": lambda: hdr_of_arrays().summary.test,
    "filmstrip": lambda: tonetool.flip_filmstrip(*cornell(), thumb_width=48),
    "error_map": lambda: tonetool.error_map(*cornell(), metric="mpsnr"),
    "bias_check": lambda: tonetool.bias_check(*cornell()),
    "noise_floor": lambda: tonetool.noise_floor([0.1, 0.11, 0.12, 0.13, 0.14]),
    "tmqi": lambda: tonetool.tmqi(cornell()[0], tonetool.tonemap(cornell()[0]).image),
    "read_shot": read_shot,
    "shot_exposure": lambda: tonetool.shot_exposure(read_shot(), mode="smooth", frame=1),
    "tonemap": lambda: tonetool.tonemap(cornell()[0], curve="agx", calibration="mean"),
    "calibrate": lambda: tonetool.calibrate(cornell()[0], method="mean"),
    "bloom": lambda: tonetool.bloom(cornell()[0], threshold="2s"),
    "cg_tmo": lambda: tonetool.cg_tmo(cornell()[0]),
    "luminance_stats": lambda: tonetool.luminance_stats(cornell()[0]),
    "find_color": lambda: tonetool.find_color(cornell()[0]),
    "against_facts": lambda: tonetool.against_facts(*cornell()),
    "attribute": lambda: tonetool.attribute(matted(1, ["wall", "cup"]), matted(0.5, ["wall", "jug"])),
    "qc_facts": lambda: tonetool.qc_facts(cornell()[0]),
    "qc_facts of objects": lambda: tonetool.qc_facts(with_objects()),
    "qc_facts of a place of one colour": lambda: tonetool.qc_facts(with_a_hole()),
    "tone_curve": lambda: next(curve for curve in tonetool.tone_curves() if len(curve.parameters) > 2),
    "light_index": lambda: tonetool.light_index(cornell()[0]),
    "panorama_stats": lambda: tonetool.panorama_stats(oiio.ImageBuf(str(TESTIMAGES / "gallery_pano.exr"))),
    "export_lut": exported_lut,
    "chain": lambda: tonetool.chain("--hdrflip --dup", cornell()),
    "check that failed": check_failed,
}


@pytest.fixture(scope="module", params=MAKERS)
def result(request):
    return MAKERS[request.param]()


def classes_of(value):
    """Names of the classes of a result and of all results in it."""
    if isinstance(value, list):
        return set().union(*map(classes_of, value))
    if type(value).__module__ != "tonetool":
        return set()
    names = [name for name, field in vars(type(value)).items() if isinstance(field, property)]
    return {type(value).__name__}.union(*(classes_of(getattr(value, name)) for name in names))


def test_all_classes_are_tried():
    every = {name for name in tonetool.__all__ if inspect.isclass(getattr(tonetool, name))
             and not issubclass(getattr(tonetool, name), Exception)}
    assert every == set().union(*(classes_of(make()) for make in MAKERS.values()))


def test_repr_is_one_screen(result):
    lines = repr(result).splitlines()
    assert lines[0].startswith(type(result).__name__ + "(") and lines[-1].endswith(")")
    assert len(lines) <= 24 and max(map(len, lines)) <= 120
    for name, field in vars(type(result)).items():
        if isinstance(field, property):
            assert f"{name}=" in repr(result)


def test_repr_has_values():
    found = hdr_of_arrays()
    text = repr(found)
    assert f"mean={found.summary.pool.mean:.6g}," in text and "ppd=67.0206" in text
    assert "histogram=[" in text and "100 in all]" in text
    assert "exposures=[FlipExposure(" in text and f"{len(found.exposures)} in all]" in text


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_pickle(result, protocol):
    again = pickle.loads(pickle.dumps(result, protocol))
    assert type(again) is type(result) and again == result and not again != result
    assert repr(again) == repr(result)


@pytest.mark.parametrize("how", [copy.copy, copy.deepcopy])
def test_copies(result, how):
    again = how(result)
    assert again == result and again is not result


def test_deepcopy_shares_nothing():
    found = hdr_of_arrays()
    again = copy.deepcopy(found)
    again.map[:] = 7
    assert found.map.max() <= 1 and again != found


def test_a_changed_value_is_not_equal():
    found = hdr_of_arrays()
    assert found == hdr_of_arrays() and found != found.summary and found.summary != found.summary.pool
    other = tonetool.hdr_flip(np.ones((4, 4, 3), np.float32), np.full((4, 4, 3), 0.5, np.float32))
    assert other != found and other.summary != found.summary and other.summary.pool != found.summary.pool


def test_images_keep_pixels_and_header():
    found = tonetool.hdr_flip(*cornell())
    again = pickle.loads(pickle.dumps(found))
    assert isinstance(again.map, oiio.ImageBuf) and again.map.spec().format == found.map.spec().format
    assert pixels_of(again.map).tobytes() == pixels_of(found.map).tobytes()

    def header(image):
        return {a.name: (str(a.type), a.value) for a in image.spec().extra_attribs}

    assert header(again.map) == header(found.map) and "FLIP:meanerror" in header(again.map)
    assert again.map.roi_full.xend == found.map.roi_full.xend
    assert again.map.spec().channelnames == found.map.spec().channelnames


def test_any_image_of_chain(tmp_path):
    """Half floats, names of channels and a data window come back."""
    path = tmp_path / "half.exr"
    (image,) = tonetool.chain(["--pattern", "noise", "40x30+5+6", "4", "--fullsize", "60x50+0+0",
                               "-d", "half", "-o", path]).images
    (left,) = tonetool.chain([path]).images
    found = tonetool.chain("--dup", [left, oiio.ImageBuf(str(path))])
    again = pickle.loads(pickle.dumps(found))
    assert again == found and len(again.images) == 3
    assert (again.images[0].xbegin, again.images[0].ybegin, again.images[0].roi_full.xend) == (5, 6, 60)
    assert image.nchannels == 4


def test_deep_images_say_what_to_do(tmp_path):
    found = tonetool.chain([TESTIMAGES / "deep.exr"])
    assert found.images[0].deep
    for how in (pickle.dumps, copy.deepcopy):
        with pytest.raises(TypeError, match="deep image cannot be pickled: write it to a file"):
            how(found)


def test_error_of_a_check_pickles():
    with pytest.raises(tonetool.CheckFailed) as raised:
        tonetool.chain("--hdrflip:fail=0.01", cornell())
    again = pickle.loads(pickle.dumps(raised.value))
    assert str(again) == str(raised.value) and again.result == raised.value.result


def new(kind):
    return kind.__new__(kind)


class Broken:
    """A FlipPool with a text for its mean."""

    def __reduce__(self):
        pool = hdr_of_arrays().summary.pool
        state = pool.__getstate__()
        assert state["mean"] == pool.mean and len(state["histogram"]) == 100
        return new, (type(pool),), {**state, "mean": "much"}


def test_a_broken_pickle_is_refused():
    data = pickle.dumps(Broken())
    with pytest.raises(TypeError, match="FlipPool: mean"):
        pickle.loads(data)
