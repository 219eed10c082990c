"""Wrong calls raise, and say what was wrong, with the shape."""

import gc
import sys

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool


@pytest.mark.parametrize("shape", [(3,), (2, 2, 3, 1), (0, 4, 3)])
def test_wrong_shape(shape):
    with pytest.raises(ValueError) as raised:
        tonetool.tonemap(np.zeros(shape, np.float32))
    text = str(raised.value)
    assert str(shape) in text and "height x width" in text and "tonemap: image" in text


@pytest.mark.parametrize("kind", [np.float64, np.uint8, np.float16, ">f4"])
def test_wrong_type_of_array(kind):
    with pytest.raises(TypeError) as raised:
        tonetool.tonemap(np.zeros((4, 5, 3), kind))
    assert str(np.dtype(kind)) in str(raised.value) and "(4, 5, 3)" in str(raised.value)


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


def test_arrays_are_not_copied(noise):
    big = np.zeros((2048, 2048, 3), np.float32)
    big[0, 0] = 1
    result = tonetool.exposure(big, 1.0)
    # The result owns its pixels through its base; none of them were copied by way of Python.
    assert result.base is not None and result.flags.c_contiguous and result.flags.writeable
    assert result[0, 0, 0] == 2 and big[0, 0, 0] == 1


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


def test_reprs(noise):
    found = tonetool.hdr_flip(noise, noise, want_exposures=True)
    text = repr(found)
    assert text.startswith("FlipResult(") and "<array (24, 32) float32>" in text
    assert "ROI(0 32 0 24" in text and "tonemapper='aces'" in text
    assert max(map(len, text.splitlines())) < 140
    with pytest.raises(AttributeError):
        found.summary.ppd = 3
