# SPDX-License-Identifier: BSD-3-Clause
"""ocio/: what programs that read OpenColorIO configurations show is what tonetool computes."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "ocio"
CONFIG = FOLDER / "tonetool.ocio"
LIMIT = 1_000_000


def curve_names():
    done = subprocess.run([os.environ["TONETOOL"], "--tonecurves:table=1"], check=True,
                          capture_output=True, text=True)
    return done.stdout.splitlines()[0].split(",")[1:]


def scene_light():
    """Greys, pure and mixed colours of 0 and 2^-12 to 2^10."""
    light = np.concatenate([[0], np.exp2(np.linspace(-12, 10, 255))])
    rows = [np.outer(light, np.array([bool(k & 1), bool(k & 2), bool(k & 4)], float))
            for k in range(1, 8)]
    random = np.random.default_rng(4)
    rows += [np.exp2(random.uniform(-12, 10, (256, 3))) for _ in range(25)]
    tinted = np.outer(light, [1, 0.8, 0.5])
    return np.array([*rows, tinted]).astype(np.float32)


@pytest.fixture
def light(make_image):
    pixels = scene_light()
    return make_image("light.exr", width=pixels.shape[1], height=pixels.shape[0], pixels=pixels)


@pytest.fixture
def shown(tonetool, oiiotool, read):
    """A picture by tonetool's curve, by tonetool through the view, by stock oiiotool."""

    def show(image, curve):
        view = f"display=sRGB:view={curve}"
        tonetool(image, f"--tonemap:curve={curve}", "-d", "float", "-o", "curve.exr")
        tonetool("--colorconfig", CONFIG, image, f"--tonemap:{view}", "-d", "float", "-o",
                 "view.exr")
        done = oiiotool("--colorconfig", CONFIG, image, "--ociodisplay", "sRGB", curve, "-d",
                        "float", "-o", "stock.exr")
        assert done.status == 0, done.err
        return [read(name)[0][..., :3] for name in ("curve.exr", "view.exr", "stock.exr")]

    return show


@pytest.mark.parametrize("curve", curve_names())
def test_a_view_is_its_curve(curve, light, shown):
    ours, view, stock = shown(light, curve)
    # Tables of 1024 entries; 12.92 is the slope of the encoding in the darks.
    assert np.abs(view - ours).max() <= 2e-3
    assert np.abs(stock - ours).max() <= 2e-3
    assert np.abs(view - ours).mean() <= 5e-5


@pytest.mark.parametrize("curve", ["agx", "neutral", "reinhard"])
@pytest.mark.parametrize("name", ["cornell_ref.exr", "acescg.exr"])
def test_of_pictures(curve, name, testimages, shown):
    ours, view, stock = shown(testimages / name, curve)
    assert np.abs(view - ours).max() <= 2e-3
    if name != "acescg.exr":  # stock oiiotool believes that file to be Rec.709
        assert np.abs(stock - ours).max() <= 2e-3


def test_other_displays_show_the_same_light(tonetool, read, light):
    """One curve serves every display: encoded, Rec.709's own white and black."""
    tonetool(light, "--tonemap:curve=agx:encode=rec1886", "-d", "float", "-o", "curve.exr")
    tonetool("--colorconfig", CONFIG, light, "--tonemap:display=Rec.1886:view=agx", "-d", "float",
             "-o", "view.exr")
    # The power of 2.4 is infinitely steep at 0: light of the table's error, encoded, compares ill.
    ours, view = (read(name)[0] ** 2.4 for name in ("curve.exr", "view.exr"))
    assert np.abs(view - ours).max() <= 1e-3


def scene_images():
    shared = os.environ.get("SHARED_DIR", "")
    kept = [ROOT / "testimages" / f"{name}_ref.exr" for name in ("cornell", "gallery")]
    return kept + sorted(Path(shared).glob("scenes/*/ref.exr")) if shared else kept


@pytest.mark.parametrize("image", scene_images(), ids=lambda p: "-".join(p.parts[-2:]))
@pytest.mark.parametrize("view", ["ACES SDR"])
def test_aces_view_is_that_of_stock_oiiotool(image, view, tonetool, oiiotool, read):
    colour = ",".join(f"ViewLayer.Combined.{c}" for c in "RGB")
    tonetool("--colorconfig", CONFIG, image, "--ch", colour,
             f"--tonemap:display=sRGB:view='{view}'", "-d", "float", "-o", "ours.exr")
    done = oiiotool("--colorconfig", CONFIG, image, "--ch", colour, "--ociodisplay", "sRGB", view,
                    "-d", "float", "-o", "stock.exr")
    assert done.status == 0, done.err
    np.testing.assert_allclose(read("ours.exr")[0], read("stock.exr")[0], atol=1e-5)


@pytest.mark.parametrize("space", ["sRGB", "acescg", "lin_rec2020", "ACES - ACEScg", "ACEScct",
                                   "lin_srgb", "lin_ap0", "Raw"])
def test_names_that_oiiotool_uses(space, light, oiiotool):
    done = oiiotool("--colorconfig", CONFIG, light, "--colorconvert", "linear", space, "-o",
                    "converted.exr")
    assert done.status == 0 and not done.err, done.err


def test_srgb_of_oiiotool_is_srgb(light, oiiotool, tonetool, read):
    oiiotool("--colorconfig", CONFIG, light, "--colorconvert", "linear", "sRGB", "-d", "float",
             "-o", "converted.exr")
    tonetool(light, "--tonemap:curve=linear:clamp=0", "-d", "float", "-o", "ours.exr")
    np.testing.assert_allclose(read("converted.exr")[0], read("ours.exr")[0], rtol=1e-5, atol=2e-5)


def test_hdr_display(light, tonetool, read):
    tonetool("--colorconfig", CONFIG, light,
             "--tonemap:display=Rec.2100-PQ:view='ACES HDR 1000'", "-d", "float", "-o", "pq.exr")
    grey = read("pq.exr")[0][6, :, 1]
    assert np.all(np.diff(grey) > -1e-6) and 0.7 < grey[-1] < 0.76  # 1000 cd/m2 is 0.7518


def test_ociocheck_has_nothing_to_say():
    check = shutil.which("ociocheck")
    if not check:
        pytest.skip("no ociocheck here")
    done = subprocess.run([check, "--iconfig", CONFIG], capture_output=True, text=True, timeout=60,
                          check=False)
    assert done.returncode == 0, done.stdout
    assert "warning" not in (done.stdout + done.stderr).lower()
    assert "error" not in (done.stdout + done.stderr).lower()


def test_every_curve_is_a_view_of_every_sdr_display():
    text = CONFIG.read_text()
    for curve in curve_names():
        assert text.count(f"- !<View> {{name: {curve}, view_transform: {curve},") == 3


def test_regenerated_byte_for_byte(program, tmp_path):
    subprocess.run([sys.executable, "-B", ROOT / "src/scripts/make_ocio.py", program, tmp_path],
                   check=True, timeout=300)

    def files(folder):
        return {str(f.relative_to(folder)): f.read_bytes() for f in Path(folder).rglob("*")
                if f.is_file()}

    kept, made = files(FOLDER), files(tmp_path)
    assert sorted(kept) == sorted(made)
    assert [name for name in kept if kept[name] != made[name]] == []
    assert sum(map(len, kept.values())) < LIMIT
