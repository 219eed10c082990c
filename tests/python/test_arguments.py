# SPDX-License-Identifier: BSD-3-Clause
"""Wrong calls raise, and say what was wrong, with the shape."""

import gc
import os
import re
import subprocess
import sys

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool


@pytest.mark.parametrize("shape", [(3,), (2, 2, 3, 1), (0, 4, 3), (3, 24, 32), (1, 24, 32),
                                   (24, 32, 2), (24, 32, 5), (24, 32, 0)])
def test_wrong_shape(shape):
    with pytest.raises(ValueError) as raised:
        tonetool.tonemap(np.zeros(shape, np.float32))
    text = str(raised.value)
    assert str(shape) in text and "height x width" in text and "tonemap: image" in text


@pytest.mark.parametrize("call", [
    lambda a: tonetool.hdr_flip(a, a), lambda a: tonetool.ldr_flip(a, a), lambda a: tonetool.luminance_stats(a),
    lambda a: tonetool.write_image(a, "never.exr"), lambda a: tonetool.chain("--luminancestats", [a]),
    lambda a: tonetool.image(a), lambda a: tonetool.qc_facts(a)])
def test_channels_first_is_no_image_of_many_channels(call):
    with pytest.raises(ValueError, match=r"\(3, 24, 32\).*moveaxis\(array, 0, -1\)"):
        call(np.ones((3, 24, 32), np.float32))
    with pytest.raises(ValueError, match=r"\(24, 32, 7\).*tonetool.image\(array, channels"):
        call(np.ones((24, 32, 7), np.float32))


@pytest.mark.parametrize("kind", [">f4", np.int64, np.int32, np.uint32, np.int8, np.bool_, np.complex64,
                                  np.longdouble, "datetime64[s]", "S3"])
def test_wrong_type_of_array(kind):
    with pytest.raises(TypeError) as raised:
        tonetool.tonemap(np.zeros((4, 5, 3), kind))
    text = str(raised.value)
    assert str(np.dtype(kind)) in text and "(4, 5, 3)" in text
    assert "float32, float16 or float64 (linear), uint8 or uint16 (sRGB" in text


def test_masked_array():
    with pytest.raises(TypeError, match="without a mask"):
        tonetool.tonemap(np.ma.zeros((4, 5, 3), np.float32))


@pytest.mark.parametrize("kind, largest", [(np.uint8, 255), (np.uint16, 65535)])
def test_integers_are_srgb_like_files(tmp_path, noise, kind, largest):
    coded = (noise * largest).astype(kind)
    path = tmp_path / "coded.png"
    tonetool.write_image(coded, path)
    file = oiio.ImageBuf(str(path))
    assert np.array_equal(file.get_pixels(str(np.dtype(kind))), coded)
    assert tonetool.find_color(coded).space == "srgb" == tonetool.find_color(file).space
    assert tonetool.luminance_stats(coded).mean == tonetool.luminance_stats(file).mean
    white = np.full_like(coded, largest)
    found = tonetool.ldr_flip(coded, white).map
    assert found.tobytes() == np.ascontiguousarray(
        tonetool.ldr_flip(file, white).map.get_pixels(oiio.FLOAT)[..., 0]).tobytes() and found.max() > 0.3
    linear = tonetool.luminance_stats(coded, pixels={"from": "rec709"})
    assert linear.mean == pytest.approx(float(tonetool.luminance_stats(
        coded.astype(np.float32) / largest).mean), rel=1e-6)
    assert tonetool.tonemap(coded).image.dtype == np.float32
    with pytest.raises(tonetool.Error, match="display-encoded"):
        tonetool.exposure(coded, 1)


@pytest.mark.parametrize("kind", [np.float16, np.float64])
def test_other_floats_are_linear(tmp_path, noise, kind):
    values = noise.astype(kind)
    same_values = values.astype(np.float32)
    assert np.array_equal(tonetool.tonemap(values).image, tonetool.tonemap(same_values).image)
    found, wanted = tonetool.hdr_flip(values, noise), tonetool.hdr_flip(same_values, noise)
    assert found.map.tobytes() == wanted.map.tobytes()
    tonetool.write_image(values, tmp_path / "values.exr")
    assert np.array_equal(oiio.ImageBuf(str(tmp_path / "values.exr")).get_pixels("float"), same_values)


def test_float64_beyond_float32(noise):
    large = noise.astype(np.float64)
    large[2, 3, 0] = 1e300
    assert tonetool.tonemap(large).summary.nonfinite == 1


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_right_shapes(noise, channels):
    image = np.dstack([noise, noise])[..., :channels]
    assert tonetool.encode_srgb(image).shape == image.shape
    assert tonetool.encode_srgb(image[..., 0]).shape == (24, 32)


@pytest.mark.parametrize("thing", [None, "ref.exr", [[1.0]], 3, oiio.ImageSpec(4, 4, 3, "float")])
def test_not_an_image(thing):
    with pytest.raises(TypeError, match="tonemap: image is .*must be an OpenImageIO.ImageBuf"):
        tonetool.tonemap(thing)


@pytest.mark.parametrize("keywords, said", [
    ({"pdd": 60}, 'unknown keyword "pdd"; did you mean "ppd"'),
    ({"curve": {"nam": "aces"}}, 'curve: unknown keyword "nam"; did you mean "name"'),
    ({"ppd": "60"}, r"ppd is '60' \(str\): must be a float"),
    ({"ppd": True}, r"ppd is True \(bool\): must be a float"),
    ({"num_exposures": 2.5}, r"num_exposures is 2.5 \(float\): must be an int"),
    ({"exact": 1}, r"exact is 1 \(int\): must be a bool"),
    ({"curve": 3}, r"curve is 3 \(int\): must be a str \(name\) or a mapping"),
    ({"curve": {"coeffs": [1, "x"]}}, r"curve: coeffs\[1\] is 'x'"),
    ({"roi": (0, 1, 0, 1)}, "roi is .*OpenImageIO.ROI"),
    ({"reference": None}, "reference is given twice"),
])
def test_wrong_keywords(noise, keywords, said):
    with pytest.raises(TypeError, match=said):
        tonetool.hdr_flip(noise, noise, **keywords)


@pytest.mark.parametrize("keywords, said", [
    ({"size": "rezise"}, 'size: unknown name "rezise".*match, resize, crop'),
    ({"memory": -1}, "memory is -1: must be 0 to"),
    ({"num_exposures": 1 << 40}, "num_exposures is 1099511627776"),
])
def test_wrong_values(noise, keywords, said):
    with pytest.raises(ValueError, match=said):
        tonetool.hdr_flip(noise, noise, **keywords)


@pytest.mark.parametrize("keywords, said", [
    ({"ppd": -3}, "hdr_flip: ppd is -3: must be 1 to 1000"),
    ({"curve": "acess"}, 'unknown tone curve "acess"; did you mean "aces"'),
    ({"pixels": {"from": "srgbb"}}, "srgbb"),
    ({"start_exposure": 5.0, "stop_exposure": 1.0}, "hdr_flip: .*exposure"),
])
def test_what_the_library_refuses(noise, keywords, said):
    with pytest.raises(tonetool.Error, match=said):
        tonetool.hdr_flip(noise, noise, **keywords)
    assert issubclass(tonetool.Error, RuntimeError)


def test_missing_and_too_many(noise):
    with pytest.raises(TypeError, match="hdr_flip: test is missing"):
        tonetool.hdr_flip(noise)
    with pytest.raises(TypeError, match="hdr_flip: 3 positional arguments: takes 2"):
        tonetool.hdr_flip(noise, noise, 60)
    with pytest.raises(TypeError, match="color_maps"):
        tonetool.color_maps(sort=True)


def test_different_sizes_are_named(noise):
    with pytest.raises(tonetool.Error, match="32x24.*32x10"):
        tonetool.hdr_flip(noise, noise[:10])


def cut(tmp_path, name, image, share=0.6):
    """A file that lost its end."""
    path = tmp_path / name
    tonetool.write_image(image, path, compression="none" if name.endswith("exr") else "")
    path.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])
    return oiio.ImageBuf(str(path))


CUT = [("cut.exr", np.float32), ("cut.png", np.uint8)]
# ImageBuf says of a TIFF file that it was read whole. That of OpenImageIO 2.4 leaves the pixels in the
# file until they are wanted, so that they can be read otherwise; that of 2.5 reads them at once.
if oiio.VERSION < 20500:
    CUT.append(("cut.tif", np.float32))


@pytest.mark.parametrize("name, kind", CUT)
@pytest.mark.parametrize("call", [
    tonetool.encode_srgb, tonetool.image, tonetool.tonemap, tonetool.luminance_stats,
    lambda b: tonetool.tonemap(b, calibration="mean"), lambda b: tonetool.calibrate(b, pixels={"from": "rec709"}),
    lambda b: tonetool.exposure(b, 1, pixels={"from": "rec709"}), lambda b: tonetool.color_map(b, "magma"),
    lambda b: tonetool.hdr_flip(b, b), lambda b: tonetool.qc_facts(b), lambda b: tonetool.cg_tmo(b),
    lambda b: tonetool.write_image(b, b.name + ".out.exr"), lambda b: tonetool.chain("--luminancestats", [b])])
def test_truncated_file(tmp_path, noise, name, kind, call):
    broken = cut(tmp_path, name, (noise * 255).astype(kind) if kind == np.uint8 else noise)
    with pytest.raises(tonetool.Error, match=re.escape(name)):
        call(broken)
    if not broken.read(force=True):
        broken.geterror()  # whoever looks at it takes it
        with pytest.raises(tonetool.Error, match=re.escape(name)):
            call(broken)
    assert not list(tmp_path.glob("*.out.exr"))


def latin1(tmp_path, noise, names):
    """A file whose names of channels are Latin-1."""
    path = tmp_path / f"latin1.{names}.exr"
    tonetool.write_image(tonetool.image(noise, channels=["QQ.R", "QQ.G", names]), path)
    data = path.read_bytes()
    path.write_bytes(data[:400].replace(b"QQ", b"\xfc\xe9") + data[400:])
    return oiio.ImageBuf(str(path))


def test_names_that_are_no_utf8(tmp_path, noise):
    with pytest.raises(tonetool.Error, match="needs R,G,B.*\ufffd\ufffd"):
        tonetool.tonemap(latin1(tmp_path, noise, "Z"))
    layers = latin1(tmp_path, noise, "QQ.B")
    assert tonetool.color_layers(layers) == ["\ufffd\ufffd"]
    assert tonetool.luminance_stats(layers).layer == "\ufffd\ufffd"
    assert "\ufffd" in repr(tonetool.qc_facts(layers))
    with pytest.raises(tonetool.Error, match="no colour layer"):
        tonetool.tonemap(layers, pixels=os.fsdecode(b"\xe4"))
    with pytest.raises(ValueError, match="size: unknown name"):
        tonetool.hdr_flip(noise, noise, size=os.fsdecode(b"\xe4"))
    with pytest.raises(TypeError, match="ppd is"):
        tonetool.hdr_flip(noise, noise, ppd=os.fsdecode(b"\xe4"))


def test_file_name_that_is_no_utf8(tmp_path, noise):
    path = os.fsdecode(os.fsencode(str(tmp_path)) + b"/\xfc.exr")
    tonetool.write_image(noise, path)
    assert os.path.exists(path)
    with pytest.raises(tonetool.Error, match="\ufffd"):
        tonetool.write_image(noise, os.path.join(path, "below.exr"))


def test_missing_file(tmp_path, noise):
    with pytest.raises(tonetool.Error, match="none.exr"):
        tonetool.hdr_flip(noise, oiio.ImageBuf(str(tmp_path / "none.exr")))


def test_output_that_cannot_be_written(tmp_path, noise):
    with pytest.raises(tonetool.Error, match="write_image: .*nofolder"):
        tonetool.write_image(noise, tmp_path / "nofolder" / "x.exr")
    with pytest.raises(ValueError, match="halff"):
        tonetool.write_image(noise, tmp_path / "x.exr", format="halff")
    assert not list(tmp_path.iterdir())


def test_write(tmp_path, noise):
    tonetool.write_image(noise, tmp_path / "half.exr", format="half", compression="zips")
    spec = oiio.ImageBuf(str(tmp_path / "half.exr")).nativespec()
    assert spec.format == "half" and spec.getattribute("compression") == "zips"
    tonetool.write_images([noise, noise[..., 0]], tmp_path / "two.exr")
    assert oiio.ImageBuf(str(tmp_path / "two.exr")).nsubimages == 2
    tonetool.write_bytes(b"ab\0c", tmp_path / "text")
    assert (tmp_path / "text").read_bytes() == b"ab\0c"


def test_numpy_numbers_are_numbers(noise):
    found = tonetool.hdr_flip(noise, noise * np.float32(0.5), ppd=np.float32(40),
                              num_exposures=np.int64(3), want_exposure_map=np.bool_(True))
    assert found.summary.ppd == 40 and len(found.summary.exposures) == 3
    assert found.exposure_stops is not None


@pytest.mark.parametrize("view", [
    lambda a: a[::-1], lambda a: a[:, ::2], lambda a: np.asfortranarray(a),
    lambda a: np.dstack([a, a[..., :1]])[..., :3]])
def test_any_strides(noise, view):
    one = tonetool.tonemap(view(noise)).image
    assert np.array_equal(one, tonetool.tonemap(np.ascontiguousarray(view(noise))).image)


def test_arrays_are_not_copied():
    """Of an array of 192 MB; luminance_stats itself needs 4 bytes a pixel, 64 MB."""
    code = """
import resource, numpy, tonetool
peak = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
big = numpy.ones((4096, 4096, 3), numpy.float32)
tonetool.luminance_stats(big[:8])
begin = peak()
tonetool.luminance_stats(big)
read = peak()
made = tonetool.exposure(big, 1.0)
assert made[5, 5, 1] == 2 and made.flags.c_contiguous and made.flags.writeable
print(read - begin, peak() - begin)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    read, made = map(float, done.stdout.split())
    assert read < 64 + 40 and made < 192 + 60


def test_input_is_neither_changed_nor_kept(noise):
    before, references = noise.copy(), sys.getrefcount(noise)
    found = tonetool.hdr_flip(noise, noise[::-1].copy(), want_exposures=True)
    assert np.array_equal(noise, before)
    gc.collect()
    assert sys.getrefcount(noise) == references
    assert found.map.shape == (24, 32) and found.exposures[0].test.shape == (24, 32, 3)


def test_results_outlive_their_source(noise):
    image = tonetool.tonemap(noise).image
    kept = image.copy()
    del noise
    gc.collect()
    churn = [np.ones((24, 32, 3), np.float32) for _ in range(50)]
    assert np.array_equal(image, kept) and len(churn) == 50


def test_nan_and_alpha(noise):
    rgba = np.dstack([noise, np.full(noise.shape[:2], 0.5, np.float32)])
    rgba[3, 4, 1] = np.nan
    found = tonetool.tonemap(rgba)
    assert found.summary.nonfinite == 1 and found.summary.warnings
    assert np.array_equal(found.image[..., 3], rgba[..., 3])
    flip = tonetool.hdr_flip(noise, rgba)
    assert flip.map[3, 4] == 1 and flip.summary.test.nonfinite == 1


def test_color_space_option(noise):
    linear = tonetool.luminance_stats(noise)
    coded = tonetool.luminance_stats(noise, pixels={"from": "srgb"})
    assert coded.mean < linear.mean and (linear.space, coded.space) == ("rec709", "srgb")


def test_named_image(noise):
    image = tonetool.image(noise, channels=["beauty.R", "beauty.G", "beauty.B"])
    assert image.spec().channelnames == ("beauty.R", "beauty.G", "beauty.B")
    assert tonetool.color_layers(image) == ["beauty"]
    assert tonetool.find_color(image).layer == "beauty"
    noise[:] = 0
    assert image.getpixel(0, 0)[0] != 0
    with pytest.raises(ValueError, match="2 names.*3 channels"):
        tonetool.image(noise, channels=["a", "b"])
    many = tonetool.image(np.dstack([noise, noise]), channels=["R", "G", "B", "N.X", "N.Y", "N.Z"])
    assert tonetool.luminance_stats(many).pixels == 24 * 32


def test_reprs(noise):
    found = tonetool.hdr_flip(noise, noise, want_exposures=True)
    text = repr(found)
    assert text.startswith("FlipResult(") and "<array (24, 32) float32>" in text
    assert "ROI(0 32 0 24" in text and "tonemapper='aces'" in text
    assert max(map(len, text.splitlines())) < 140
    with pytest.raises(AttributeError):
        found.summary.ppd = 3


@pytest.mark.parametrize("write", [tonetool.write_image,
                                   lambda image, path: tonetool.write_images([image], path)])
def test_pictures_for_a_screen_are_upright(tmp_path, write):
    pixels = np.random.default_rng(1).random((12, 16, 3)).astype(np.float32)
    image = oiio.ImageBuf(oiio.ImageSpec(16, 12, 3, "float"))
    image.set_pixels(oiio.ROI(), pixels)
    image.specmod().attribute("Orientation", 6)
    for name, wanted, turned in (("a.png", np.rot90(pixels, -1), 1), ("a.exr", pixels, 6)):
        write(image, str(tmp_path / name))
        read = oiio.ImageBuf(str(tmp_path / name))
        assert read.spec().get_int_attribute("Orientation", 1) == turned
        assert np.abs(read.get_pixels() - wanted).max() < 0.003
    assert image.spec().get_int_attribute("Orientation") == 6
