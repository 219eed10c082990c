# SPDX-License-Identifier: BSD-3-Clause
"""mask and ignore of the comparisons: a file, an ImageBuf or an array."""

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import same, write

SHAPE = (48, 64)


@pytest.fixture
def images():
    reference = np.random.default_rng(1).random((*SHAPE, 3)).astype(np.float32)
    test = reference.copy()
    test[10:20, 30:50] *= 2
    return reference, test


@pytest.fixture
def mask():
    counts = np.ones(SHAPE, np.float32)
    counts[10:20, 30:50] = 0
    return counts


def compared(images, function, **options):
    if function == "error_map":
        options["metric"] = "mse"
    return getattr(tonetool, function)(*images, **options)


@pytest.mark.parametrize("function", ["hdr_flip", "ldr_flip", "error_map"])
def test_every_kind_of_mask(images, mask, tmp_path, function):
    path = tmp_path / "mask.exr"
    write(path, mask[..., None])
    kinds = [mask, mask[..., None], mask > 0.5, (mask * 255).astype(np.uint8), str(path), path,
             oiio.ImageBuf(str(path))]
    for kind in kinds:
        result = compared(images, function, mask=kind)
        assert result.summary.pool.max == 0 and not np.any(np.asarray(result.map))
        assert result.summary.ignored == pytest.approx(200 / (48 * 64), rel=1e-12)
        assert result.summary.pool.pixels == 48 * 64 - 200
    result = compared(images, function, ignore=["20x10+30+10"])
    assert result.summary.pool.max == 0


@pytest.mark.parametrize("function", ["hdr_flip", "ldr_flip", "error_map"])
def test_none_and_ones_change_no_bit(images, function):
    plain = compared(images, function)
    assert plain.summary.ignored is None
    for options in ({"mask": None}, {"mask": np.ones(SHAPE, bool)}, {"ignore": []}):
        result = compared(images, function, **options)
        assert same(result.map, plain.map) and result.summary.pool == plain.summary.pool


def test_bias_check(images, mask):
    assert tonetool.bias_check(images[0], images[1]).verdict == "not enough samples"  # too small
    result = tonetool.bias_check(np.tile(images[0], (2, 2, 1)), np.tile(images[1], (2, 2, 1)),
                                 mask=np.tile(mask, (2, 2)))
    assert (result.verdict, result.reason) == ("equal", "identical")
    assert result.ignored == pytest.approx(200 / (48 * 64), rel=1e-12)


@pytest.mark.parametrize("options, said", [
    ({"mask": np.ones((48, 65))}, "it has 65x48 pixels, the reference 64x48"),
    ({"mask": np.zeros(SHAPE)}, "leave no pixel that counts"),
    ({"mask": np.ones(SHAPE, np.uint8)}, "leave no pixel that counts"), # 1 of 255
    ({"mask": "none.png"}, "there is no such file"),
    ({"ignore": ["3x3"]}, "must be WxH\\+X\\+Y")])
def test_refused(images, options, said):
    with pytest.raises(tonetool.Error, match=said):
        tonetool.hdr_flip(*images, **options)


@pytest.mark.parametrize("options", [{"mask": 3}, {"mask": [1, 2]}, {"ignore": "3x3+1+1"}, {"ignore": [3]}])
def test_wrong_types(images, options):
    with pytest.raises(TypeError, match=f"hdr_flip: {next(iter(options))}"):
        tonetool.hdr_flip(*images, **options)
