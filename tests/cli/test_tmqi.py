# SPDX-License-Identifier: BSD-3-Clause
"""TMQI: what --tmqi prints and pushes, and the status it ends with."""

import json
import os

import numpy as np
import pytest

from conftest import TESTIMAGES

GOLDENS = [json.loads(line) for line in
           (TESTIMAGES / "golden" / "tmqi.jsonl").read_text().splitlines()]


@pytest.fixture
def shown():
    """An HDR image and a picture of it."""
    return TESTIMAGES / "gallery_ref.exr", TESTIMAGES / "golden" / "gallery_drago85.png"


@pytest.mark.parametrize("golden", GOLDENS, ids=lambda g: f"{g['scene']}_{g['ldr']}")
def test_numbers_are_those_of_the_authors_program(tonetool_v, golden):
    ran = tonetool_v(TESTIMAGES / f"{golden['scene']}_ref.exr",
                   TESTIMAGES / "golden" / f"{golden['scene']}_{golden['ldr']}.png", "--tmqi")
    for name in "QSN":
        assert float(ran.fact(name)) == pytest.approx(golden[name], abs=1e-5)
    for i, value in enumerate(golden["s_local"]):
        assert float(ran.fact(f"S{i + 1}")) == pytest.approx(value, abs=1e-5)
    assert ran.err == ""


def test_the_map_is_the_finest_scale(tonetool_v, shown, read):
    ran = tonetool_v(*shown, "--tmqi", "-o", "x.exr")
    assert all(line.startswith("tmqi: ") for line in ran.out.splitlines())
    pixels, spec = read("x.exr")
    assert pixels.shape == (72, 128, 1)
    assert float(ran.fact("S1")) == pytest.approx(pixels.astype(np.float64).mean(), abs=1e-5)
    assert pixels.max() <= 1
    assert spec.getattribute("TMQI:Q") == pytest.approx(float(ran.fact("Q")), abs=1e-5)
    assert ran.fact("hdr") == str(shown[0]) and ran.fact("ldr-space") == "srgb"


def test_pictures_made_on_the_way(tonetool_v, shown):
    straight = tonetool_v(shown[0], "--dup", "--tonemap:curve=aces", "-o", "x.png", "--tmqi")
    read_again = tonetool_v(shown[0], "x.png", "--tmqi")
    assert float(straight.fact("Q")) == pytest.approx(float(read_again.fact("Q")), abs=5e-3)
    linear = tonetool_v(shown[0], "--dup", "--tonemap:curve=aces:encode=none", "--tmqi")
    assert linear.fact("ldr-space") == "rec709"
    assert float(linear.fact("Q")) == pytest.approx(float(straight.fact("Q")), abs=1e-4)


def test_thresholds_are_to_be_reached(tonetool_v, shown):
    q = tonetool_v(*shown, "--tmqi").fact("Q")
    ran = tonetool_v(*shown, "--tmqi:fail=0.99", status=3)
    assert f"tmqi: FAIL Q {q} < 0.99" in ran.out
    assert f"tmqi: PASS Q {q} >= 0.1" in tonetool_v(*shown, "--tmqi:fail=0.1").out
    ran = tonetool_v(*shown, "--tmqi:fail=0.1:warn=0.99")
    assert f"tmqi: WARNING Q {q} < 0.99" in ran.out
    assert f"WARNING: tmqi : Q {q} < 0.99" in ran.err
    tonetool_v(*shown, "--tmqi:warn=0.99", "--warnings-exit", status=2)
    for quantity in "SN":
        ran = tonetool_v(*shown, f"--tmqi:fail=0.9999:quantity={quantity}", status=3)
        assert f"tmqi: FAIL {quantity} " in ran.out
    assert "higher is better" in tonetool_v("--help", "--tmqi").out


def test_threads_do_not_change_the_numbers(tonetool, shown, read):
    one = tonetool("--threads", "1", *shown, "--tmqi", "-o", "a.exr")
    two = tonetool("--threads", "2", *shown, "--tmqi", "-o", "b.exr")
    assert one.out == two.out
    assert np.array_equal(read("a.exr")[0], read("b.exr")[0])


def test_holes_are_warnings(tonetool_v, testimages):
    ran = tonetool_v("--warnings-exit", testimages / "nan_center.exr", testimages / "plain.exr",
                   "--tmqi", status=2)
    assert ran.fact("hdr-nonfinite") == "1"
    assert "1 pixel(s) of the HDR image are NaN or Inf" in ran.err


def test_each_image_has_its_own_layer_and_space(tonetool_v, shown, make_image):
    ran = tonetool_v(shown[0], shown[0], "--tmqi:layer=ViewLayer.Combined_daylight", status=1)
    assert "ViewLayer.Combined" in ran.err
    ran = tonetool_v(shown[0], shown[0], "--tmqi:ldrlayer=ViewLayer.Combined:ldrfrom=srgb")
    assert ran.fact("ldr-space") == "srgb" and ran.fact("hdr-space") == "rec709"


@pytest.mark.parametrize("modifiers, text", [
    (":fail=1.5", "fail "),
    (":fail=x", "fail "),
    (":quantity=Q", "quantity= needs fail= or warn="),
    (":fail=1:quantity=q", 'unknown quantity "q"'),
    (":ppd=67", '"ppd"'),
    (":ldrfrom=nosuch", "nosuch"),
    (":resize=1", '"resize"'),
])
def test_bad_values_are_errors_and_write_nothing(tonetool, shown, tmp_path, modifiers, text):
    ran = tonetool(*shown, f"--tmqi{modifiers}", "-o", "x.exr", status=1)
    assert "tonetool ERROR: " in ran.err and text in ran.err
    assert not os.listdir(tmp_path)


def test_what_cannot_be_scored_is_an_error(tonetool, shown, testimages, make_image):
    ran = tonetool(testimages / "constant.exr", testimages / "plain.exr", "--tmqi", status=1)
    assert "there is no range to show" in ran.err
    tonetool(testimages / "plain.exr", testimages / "constant.exr", "--tmqi")
    low = make_image("low.exr", width=40, height=10)
    assert "40x10 pixels are compared: needs 11" in tonetool(low, low, "--tmqi", status=1).err
    ran = tonetool(shown[0], testimages / "plain.exr", "--tmqi", status=1)
    assert "display window" in ran.err
    ran = tonetool("--memory", "1M", *shown, "--tmqi", status=1)
    assert "memory is 1M: needs at least" in ran.err
    tonetool("--memory", "200M", *shown, "--tmqi")
    tonetool(shown[0], "--tmqi", status=1)
