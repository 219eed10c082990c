# SPDX-License-Identifier: BSD-3-Clause
"""Error maps: what --errormap prints and pushes, and the status it ends with."""

import json
import math
import os

import numpy as np
import pytest

METRICS = ["smape", "rmae", "relmse", "mse", "mae", "psnr", "mpsnr"]


def beauty(read, name):
    pixels, spec = read(name)
    names = list(spec.channelnames)
    at = [names.index(f"ViewLayer.Combined.{c}") for c in "RGB"]
    return np.maximum(pixels[:, :, at].astype(np.float64), 0)


@pytest.mark.parametrize("metric, formula", [
    ("smape", lambda r, t: abs(t - r) / (r + t + 0.01)),
    ("rmae", lambda r, t: abs(t - r) / (r + 0.01)),
    ("relmse", lambda r, t: (t - r) ** 2 / (r ** 2 + 0.01)),
    ("mse", lambda r, t: (t - r) ** 2),
    ("mae", lambda r, t: abs(t - r)),
])
def test_maps_are_their_formulas(tonetool_v, pair, read, metric, formula):
    ran = tonetool_v(*pair, f"--errormap:metric={metric}", "-o", "x.exr")
    expected = formula(beauty(read, pair[0]), beauty(read, pair[1])).mean(axis=2)
    pixels, spec = read("x.exr")
    np.testing.assert_allclose(pixels[:, :, 0], expected, rtol=1e-6)
    assert float(ran.fact(metric)) == pytest.approx(expected.mean(), rel=1e-5)
    assert ran.fact("mean") == ran.fact(metric)
    assert spec.getattribute("Error:metric") == metric


def test_psnr_and_mpsnr(tonetool_v, pair, read):
    r, t = beauty(read, pair[0]), beauty(read, pair[1])
    ran = tonetool_v(*pair, "--errormap:metric=psnr:peak=10")
    assert float(ran.fact("psnr")) == pytest.approx(10 * math.log10(100 / ((t - r) ** 2).mean()),
                                                    rel=1e-5)
    ran = tonetool_v(*pair, "--errormap:metric=mpsnr:startExposure=-2:stopExposure=2:numExposures=5")
    assert ran.fact("exposures") == "start -2 stop 2 count 5"

    def photo(x, stops):
        return np.floor(np.clip(255 * (2.0 ** stops * x) ** (1 / 2.2), 0, 255) + 0.5)

    mse = np.mean([((photo(t, c) - photo(r, c)) ** 2).mean() for c in range(-2, 3)])
    assert float(ran.fact("mpsnr")) == pytest.approx(10 * math.log10(255 ** 2 / mse), rel=1e-5)
    flip = tonetool_v(*pair, "--hdrflip")
    assert tonetool_v(*pair, "--errormap:metric=mpsnr").fact("exposures") == flip.fact("exposures")


@pytest.mark.parametrize("metric", METRICS)
def test_identical_images_give_exactly_zero(tonetool_v, pair, read, metric):
    higher = metric.endswith("psnr")
    limit = "1000" if higher else "0"
    ran = tonetool_v(pair[0], pair[0], f"--errormap:metric={metric}:fail={limit}", "-o", "x.exr")
    assert ran.fact(metric) == ("inf" if higher else "0")
    assert f"errormap: PASS {metric} " in ran.out
    assert not read("x.exr")[0].any()


def test_threshold_statuses(tonetool_v, pair, tmp_path):
    value = tonetool_v(*pair, "--errormap:metric=smape").fact("smape")
    ran = tonetool_v(*pair, "--errormap:metric=smape:fail=0.01", "-o", "x.exr", status=3)
    assert f"errormap: FAIL smape {value} > 0.01" in ran.out
    assert (tmp_path / "x.exr").exists()
    ran = tonetool_v(*pair, "--errormap:metric=smape:fail=0.9:warn=0.01")
    assert f"errormap: WARNING smape {value} > 0.01" in ran.out
    assert f"WARNING: errormap : smape {value} > 0.01" in ran.err
    tonetool_v(*pair, "--errormap:metric=smape:warn=0.01", "--warnings-exit", status=2)


@pytest.mark.parametrize("metric", ["psnr", "mpsnr"])
def test_decibels_must_reach_their_threshold(tonetool_v, pair, metric):
    value = tonetool_v(*pair, f"--errormap:metric={metric}").fact(metric)
    ran = tonetool_v(*pair, f"--errormap:metric={metric}:fail=60", status=3)
    assert f"errormap: FAIL {metric} {value} < 60" in ran.out
    ran = tonetool_v(*pair, f"--errormap:metric={metric}:fail={float(value) - 0.5}")
    assert f"errormap: PASS {metric} {value} >= " in ran.out
    # The quantities of the map are errors all the same.
    ran = tonetool_v(*pair, f"--errormap:metric={metric}:fail=0:quantity=max", status=3)
    assert "errormap: FAIL max " in ran.out


@pytest.mark.parametrize("metric", METRICS)
def test_threads_do_not_change_the_numbers(tonetool, pair, read, metric):
    one = tonetool("--threads", "1", *pair, f"--errormap:metric={metric}", "-o", "a.exr")
    two = tonetool("--threads", "2", *pair, f"--errormap:metric={metric}", "-o", "b.exr")
    assert one.out == two.out
    assert np.array_equal(read("a.exr")[0], read("b.exr")[0])
    bounded = tonetool("--memory", "110M", *pair, f"--errormap:metric={metric}")
    assert bounded.out == one.out


def test_nonfinite_pixels_are_the_largest_error(tonetool_v, testimages, read):
    words = [testimages / "plain.exr", testimages / "nan_center.exr"]
    ran = tonetool_v("--warnings-exit", *words, "--errormap:metric=relmse", "-o", "x.exr", status=2)
    assert ran.fact("test-nonfinite") == "1" and ran.fact("max") == "inf at 32,24"
    assert read("x.exr")[0][24, 32, 0] == 1
    ran = tonetool_v(words[1], words[1], "--errormap:metric=relmse")
    assert ran.fact("max").startswith("0 ") and ran.fact("nonfinite-in-both") == "1"


# A method must not gain by pixels that are no numbers, whatever its other errors are.
@pytest.mark.parametrize("metric, value", [("mse", "inf"), ("mae", "inf"), ("relmse", "inf"), ("rmae", "inf"),
                                           ("psnr", "-inf"), ("smape", None), ("mpsnr", None)])
def test_no_limit_holds_where_the_test_alone_is_not_finite(tonetool, tmp_path, testimages, metric, value):
    words = [testimages / "plain.exr", testimages / "nan_center.exr"]
    limit = "-299" if metric == "psnr" else "1e9"
    if value is None:  # the largest error there is
        assert tonetool(*words, f"--errormap:metric={metric}:print=0", "--csv", "-").out.count("inf") == 0
        return
    ran = tonetool(*words, f"--errormap:metric={metric}:fail={limit}", status=3)
    assert f"FAIL {metric} {value} " in ran.out
    most = 0.99 if metric == "psnr" else 1e9
    for quantity in ("max", "mean", "weighted-median", "p99.99"):
        ran = tonetool(*words, f"--errormap:metric={metric}:fail={quantity}={most}", "--json", "n.json", status=3)
        assert f"{quantity} inf > " in ran.out and "worst pixel 32,24" in ran.out
        # What was written is read again: merged, printed, taken for limits.
        assert f"{quantity} inf > " in tonetool("--merge", "n.json", "--json", "again.json", status=3).out
        assert (tmp_path / "again.json").read_bytes() == (tmp_path / "n.json").read_bytes()
    tonetool(*words, f"--errormap:metric={metric}:fail=p99.9={most}")  # one of 3072 pixels
    if metric != "psnr":
        tonetool(*words, f"--errormap:metric={metric}:fail=above5=0.001")
        tonetool(*words, f"--errormap:metric={metric}:fail=above5=0.0001", status=3)
    # Where the reference is not finite nobody can tell; where the pixel does not count it does not.
    assert "inf" not in tonetool(*words[::-1], f"--errormap:metric={metric}:fail={limit}").out
    assert "-inf" not in tonetool(*words, f"--errormap:metric={metric}:fail={limit}:ignore=1x1+32+24").out


def test_quiet_and_print(tonetool, pair):
    assert tonetool("-q", *pair, "--errormap:metric=mae:fail=1e9").out == ""
    ran = tonetool(*pair, "--errormap:metric=mae:fail=1e9:print=0")
    assert ran.out.startswith("errormap: PASS mae") and len(ran.out.splitlines()) == 1


@pytest.mark.parametrize("modifiers, text", [
    ("", "needs metric= (valid: smape, rmae"),
    (":metric=mspe", 'unknown metric "mspe"'),
    (":metric=SMAPE", 'unknown metric "SMAPE"'),
    (":metric=mse:eps=0.1", "eps= goes with metric=smape, rmae, relmse, not with mse"),
    (":metric=mse:peak=1", "peak= goes with metric=psnr, not with mse"),
    (":metric=psnr:numExposures=3", "numExposures= goes with metric=mpsnr"),
    (":metric=smape:eps=0", "eps "),
    (":metric=psnr:peak=-1", "peak "),
    (":metric=mpsnr:numExposures=0", "numExposures "),
    (":metric=smape:quantity=max", "quantity= needs fail= or warn="),
    (":metric=smape:quantity=psnr:fail=1", 'unknown quantity "psnr"'),
    (":metric=psnr:fail=mean=30", "mean is of the errors in the map, and the number in dB is psnr"),
    (":metric=smape:fail=-1", "fail "),
    (":metric=smape:print=2", "print "),
    (":metric=smape:ppd=67", '"ppd"'),
])
def test_bad_values_are_errors_and_write_nothing(tonetool, pair, tmp_path, modifiers, text):
    ran = tonetool(*pair, f"--errormap{modifiers}", "-o", "x.exr", status=1)
    assert "tonetool ERROR: " in ran.err and text in ran.err
    assert not os.listdir(tmp_path)


def test_geometry_and_files(tonetool_v, pair, make_image, testimages):
    small = make_image("a.exr", width=8, height=6)
    ran = tonetool_v(make_image("b.exr"), small, "--errormap:metric=mae", status=1)
    assert "display window" in ran.err
    tonetool_v("b.exr", small, "--errormap:metric=mae:resize=1")
    ran = tonetool_v("b.exr", small, "--errormap:metric=mae:crop=1")
    assert ran.fact("pixels") == "48"
    tonetool_v(pair[0], testimages / "not_an_image.exr", "--errormap:metric=mae", status=1)
    tonetool_v(pair[0], testimages / "y_only.exr", "--errormap:metric=mae", status=1)
    tonetool_v(pair[0], "--errormap:metric=mae", status=1)


def test_several_tests_against_one_reference(tonetool, make_image, read, tmp_path):
    """As so many commands, with one record and one map each, the last on top."""
    make_image("ref.exr", seed=1)
    for number in (1, 2):
        make_image(f"t{number}.exr", seed=1 + number)
        tonetool("ref.exr", f"t{number}.exr", "--errormap:metric=mse", "-o", f"one{number}.exr", "--json", f"{number}.json")
    tonetool("ref.exr", "t1.exr", "t2.exr", "--errormap:metric=mse:tests=2", "--json", "both.json",
             "-o", "top.exr", "--pop", "-o", "below.exr")
    for name, number in (("top", 2), ("below", 1)):
        assert (read(f"{name}.exr")[0] == read(f"one{number}.exr")[0]).all()
    both = json.loads((tmp_path / "both.json").read_text(encoding="utf-8"))["frames"][0]["measurements"]
    for number, found in enumerate(both, 1):
        alone = json.loads((tmp_path / f"{number}.json").read_text(encoding="utf-8"))
        assert [found] == alone["frames"][0]["measurements"]
    ran = tonetool("ref.exr", "t1.exr", "gone.exr", "--errormap:metric=mse:tests=2", status=1)
    assert "gone.exr" in ran.err
