# SPDX-License-Identifier: BSD-3-Clause
"""Curves from files, the film, what a calibration shows, and curves written for Photoshop."""

import numpy as np
import pytest

import tonetool

X = np.array([0, 0.5, 1, 4])
Y = np.array([0, 0.4, 0.7, 1])


@pytest.fixture
def table(tmp_path):
    file = tmp_path / "t.csv"
    file.write_text("".join(f"{x},{y}\n" for x, y in zip(X, Y)))
    return str(file)


@pytest.fixture
def image():
    light = np.linspace(0, 5, 48, dtype=np.float32).reshape(4, 12, 1)
    return np.repeat(light, 3, axis=2)


def test_a_file_is_a_curve(table, image):
    found = tonetool.tonemap(image, curve=table, encode="none")
    assert np.abs(np.asarray(found.image) - np.interp(image, X, Y)).max() < 1e-6
    assert found.summary.curve == "t.csv" and found.summary.parameters == {"white": 1}
    assert found.summary.table == "4 rows of x 0 to 4, rising"
    found = tonetool.tonemap(image, curve={"name": table, "parameters": {"white": 2}}, encode="none")
    assert np.abs(np.asarray(found.image) - np.interp(image / 2, X, Y)).max() < 1e-6
    assert tonetool.tonemap(image, curve="aces").summary.table == ""


def test_responses_and_descriptions(table):
    assert tonetool.tone_curve_response([0.25, 9], name=table) == pytest.approx([0.2, 1])
    info = tonetool.tone_curve_of_file(name=table)
    assert info.name == "t.csv" and info.domain == "rgb" and info.parameters[0].name == "white"
    with pytest.raises(tonetool.Error, match="there is no such file"):
        tonetool.tone_curve_of_file(name=table + "x")
    with pytest.raises(tonetool.Error, match="is no file"):
        tonetool.tone_curve_of_file(name="aces")


def test_comparisons(table, image):
    same = tonetool.hdr_flip(image, image, curve=table)
    assert same.summary.pool.mean == 0 and same.summary.tonemapper == "t.csv"
    assert tonetool.hdr_flip(image, image * 1.2, curve=table).summary.bright == pytest.approx(2.5)


def test_a_film_for_each_channel(image):
    middle = np.array([0.2, 0.18, 0.15])
    curve = {"name": "film", "parameters": {"gamma": 1.5}, "channel_parameters": {"middle": list(middle)}}
    found = tonetool.tonemap(image, curve=curve, encode="none")
    with np.errstate(divide="ignore"):
        density = 3 / (1 + np.exp(2 * np.log10(image.astype(np.float64) / middle)))
    assert np.abs(np.asarray(found.image) - 10 ** -density).max() < 2e-6
    assert found.summary.parameters["middle.b"] == 0.15 and found.summary.parameters["gamma"] == 1.5
    film = next(info for info in tonetool.tone_curves() if info.name == "film")
    assert all(parameter.per_channel for parameter in film.parameters)
    with pytest.raises(tonetool.Error, match="must be 3"):
        tonetool.tonemap(image, curve={"name": "film", "channel_parameters": {"middle": [1, 2]}})
    with pytest.raises(tonetool.Error, match="for all channels and for each"):
        tonetool.tonemap(image, curve={"name": "film", "parameters": {"middle": 1},
                                       "channel_parameters": {"middle": [1, 2, 3]}})
    with pytest.raises(tonetool.Error, match="one number"):
        tonetool.tonemap(image, curve={"name": "aces", "channel_parameters": {"prescale": [1, 2, 3]}})


def test_the_exposure_is_what_makes_the_picture(image):
    how = {"method": "mean", "level": 1}
    picture = np.asarray(tonetool.calibrate(image, **how).image)
    factor = np.asarray(tonetool.calibrate(image, show="exposure", **how).image)
    assert np.ptp(factor) > 0 and np.abs(image * factor - picture).max() <= 1e-6 * picture.max()
    with pytest.raises(tonetool.Error, match="valid: mean, key, exposure"):
        tonetool.calibrate(image, show="median", **how)
    with pytest.raises(TypeError, match="show"):
        tonetool.tonemap(image, calibration={"show": "mean"})


def test_photoshop(tmp_path):
    made = tonetool.export_lut(tmp_path / "x.acv", curve="hable", white=5.6)
    assert made.format == "acv" and made.high == pytest.approx(5.6) and made.max_error < 1.5 / 255
    assert made.remarks == [] and (tmp_path / "x.acv").read_bytes()[:4] == b"\0\4\0\5"
    assert tonetool.export_lut(tmp_path / "x.acv", curve="drago").remarks == [
        "luminance curve: exact for greys only"]
    with pytest.raises(tonetool.Error, match="white is of .acv"):
        tonetool.export_lut(tmp_path / "x.cube", curve="hable", white=5.6)
