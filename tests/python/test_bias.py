# SPDX-License-Identifier: BSD-3-Clause
"""bias_check and noise_floor: what the program says, of arrays and of images."""

import copy
import json
import math
import pickle

import numpy as np
import OpenImageIO as oiio
import pytest
import tonetool
from conftest import pixels_of, same, write

SIZE = 96
VERDICTS = ["equal", "different", "not enough samples"]
MAPS = {"signed": ["difference", "halfwidth", "confidence"], "p": ["p16", "p32", "p64"],
        "rejected": ["means", "structures"]}
MAPS["all"] = sum(MAPS.values(), [])


def render(seed, spp=16, gain=1.0, size=SIZE):
    """Light that varies slowly, with the noise of so many samples per pixel."""
    y, x = np.mgrid[0:size, 0:size]
    light = 0.5 + 0.2 * np.sin(x / 11) + 0.15 * np.cos(y / 9)
    noise = np.random.default_rng(seed).gamma(spp, 1 / spp, (size, size, 1))
    return (gain * noise * np.stack([light * 1.1, light, light * 0.8], -1)).astype(np.float32)


def renders(verdict):
    """A pair that has this verdict; the seeds are none of the 1 % false alarms."""
    if verdict == "equal":
        return render(1), render(2)
    if verdict == "different":
        return render(1), render(3, gain=1.1)
    return render(20, spp=2), render(21, spp=2)


@pytest.fixture(params=VERDICTS)
def verdict(request):
    return request.param


@pytest.fixture(params=["array", "buf"])
def kind(request, tmp_path):
    """Makes the type of image of which a function is called."""
    made = []

    def make(array):
        if request.param == "array":
            return array
        path = tmp_path / f"kind{len(made)}.exr"
        write(path, array)
        made.append(oiio.ImageBuf(str(path)))
        return made[-1]

    return make


# ---- the same as the program

def test_the_verdict_is_that_of_the_program(kind, program, tmp_path, verdict):
    one, other = renders(verdict)
    write(tmp_path / "a.exr", one)
    write(tmp_path / "b.exr", other)
    program("a.exr", "b.exr", "--biascheck:map=all", "-o", "map.exr", "--json", "c.json",
            status=0 if verdict == "equal" else 3)
    (frame,) = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))["frames"]
    (measured,) = frame["measurements"]
    found = tonetool.bias_check(kind(one), kind(other), map="all")
    assert found.verdict == measured["verdict"] == verdict
    assert found.sentence == measured["sentence"]
    assert found.reason == measured["settings"]["reason"]
    assert found.evidence == measured.get("evidence", [])
    assert found.numbers == measured["quantities"]
    image = oiio.ImageBuf(str(tmp_path / "map.exr"))
    order = [image.spec().channelnames.index(name) for name in MAPS["all"]]
    assert np.array_equal(pixels_of(image)[..., order], pixels_of(found.map))


def test_options_are_those_of_the_program(program, tmp_path):
    one, other = renders("different")
    write(tmp_path / "a.exr", one)
    write(tmp_path / "b.exr", other)
    program("a.exr", "b.exr", "--biascheck:within=0.3:power=0.8:reference=converged:map=rejected",
            "-o", "map.exr", "--json", "c.json")
    (frame,) = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))["frames"]
    found = tonetool.bias_check(one, other, within=0.3, power=0.8, reference="converged",
                                map="rejected")
    assert found.verdict == "equal" and found.numbers["unlike"] == 1
    assert found.numbers == frame["measurements"][0]["quantities"]
    assert same(found.map, tmp_path / "map.exr")


# ---- results

def test_fields(verdict):
    found = tonetool.bias_check(*renders(verdict))
    numbers = found.numbers
    assert (found.gain, found.gain_se) == (numbers["gain.Y"], numbers["gain-se.Y"])
    assert (found.bound, found.shown) == (numbers["bound"], numbers["shown"])
    assert (numbers["references"], numbers["tests"], numbers["nonfinite"]) == (1, 1, 0)
    assert (found.region.width, found.region.height) == (SIZE, SIZE)
    if verdict == "equal":
        assert found.bound <= 0.05 and found.shown == 1 and found.evidence == []
        assert "within 5 %" in found.sentence and "64x64" in found.sentence
    elif verdict == "different":
        assert found.gain == pytest.approx(0.1, abs=4 * found.gain_se)  # 4 standard errors
        assert found.evidence and found.evidence[0] == "overall Y"
    else:
        assert found.more > 1 and found.more == numbers["more"] and found.evidence == []
        assert "pass" not in repr(found).lower()
    assert (found.more is None) == (verdict != "not enough samples")


def test_level():
    one, other = renders("equal")
    strict, usual, lax = (tonetool.bias_check(one, other, alpha=a) for a in (1e-4, 0.01, 0.1))
    assert strict.bound > usual.bound > lax.bound
    assert "with 90 % confidence" in lax.sentence and "with 99 % confidence" in usual.sentence


@pytest.mark.parametrize("name", MAPS)
def test_maps(kind, name):
    one, other = (kind(image) for image in renders("different"))
    found = tonetool.bias_check(one, other, map=name)
    assert type(found.map) is type(one)
    pixels = pixels_of(found.map)
    assert pixels.shape == (SIZE, SIZE, len(MAPS[name])) and pixels.dtype == np.float32
    whole = pixels_of(tonetool.bias_check(one, other, map="all").map)
    at = [MAPS["all"].index(channel) for channel in MAPS[name]]
    assert np.array_equal(whole[..., at], pixels)
    if isinstance(found.map, oiio.ImageBuf):
        assert list(found.map.spec().channelnames) == MAPS[name]
        assert found.map.spec().getattribute("Bias:verdict") == "different"


def test_values_of_maps():
    one, other = renders("different")
    shown = tonetool.bias_check(one, other, map="all").map
    values = {name: shown[..., i] for i, name in enumerate(MAPS["all"])}
    for name in ("p16", "p32", "p64"):
        assert values[name].max() <= 0 and values[name].min() >= -300
    assert set(np.unique(values["means"])) <= {-1, 0, 1, 2, 3} and values["means"].max() == 3
    assert 0 <= values["confidence"].min() and values["confidence"].max() <= 1
    assert (values["halfwidth"] > 0).all()
    # Each of 6x6 blocks has one value, or one value of each finer block.
    blocks = values["p16"].reshape(6, 16, 6, 16)
    assert (np.ptp(blocks, axis=(1, 3)) == 0).all() and len(np.unique(blocks)) > 6


# ---- seeds

def test_lists_of_seeds(kind):
    references = [kind(render(40 + i, spp=4)) for i in range(3)]
    tests = [kind(render(50 + i, spp=4, gain=1.15)) for i in range(2)]
    found = tonetool.bias_check(references, tests)
    assert (found.numbers["references"], found.numbers["tests"]) == (3, 2)
    assert found.verdict == "different" and found.gain == pytest.approx(0.15, abs=4 * found.gain_se)
    assert type(found.map) is type(references[0])
    assert tonetool.bias_check(tuple(references), tuple(tests)) == found
    back = tonetool.bias_check(tests, references)
    assert back.gain < 0 and back.numbers["references"] == 2


def test_a_list_of_one_is_the_image(verdict):
    one, other = renders(verdict)
    found = tonetool.bias_check(one, other)
    for words in (([one], other), (one, [other]), ([one], [other])):
        assert tonetool.bias_check(*words) == found


def test_more_seeds_are_needed_and_help():
    seeds = [render(60 + i, spp=4) for i in range(8)]
    one = tonetool.bias_check(seeds[0], seeds[4])
    four = tonetool.bias_check(seeds[:4], seeds[4:])
    assert (one.verdict, four.verdict) == ("not enough samples", "equal")
    # Half the standard error, which is itself an estimate.
    assert four.gain_se == pytest.approx(one.gain_se / 2, rel=0.1)


def test_halves(tmp_path):
    names = [f"{layer}.{c}" for layer in "AB" for c in "RGB"]
    images, parts = [], []
    for side in (0, 1):
        halves = [render(70 + 2 * side + i) for i in range(2)]
        parts.append(halves)
        images.append(tonetool.image(np.concatenate(halves, -1), channels=names))
    found = tonetool.bias_check(*images, halves=["A", "B"])
    apart = tonetool.bias_check(*parts)
    assert found.numbers == apart.numbers and found.numbers["references"] == 2
    with pytest.raises(tonetool.Error, match="two different layers"):
        tonetool.bias_check(*images, halves=["A"])
    with pytest.raises(tonetool.Error, match='"C"'):
        tonetool.bias_check(*images, halves=["A", "C"])


# ---- kinds of pixels

def test_layers_and_spaces():
    one, other = renders("different")
    names = [f"{layer}{c}" for layer in ("", "A.") for c in "RGB"]
    images = [tonetool.image(np.concatenate([image, one], -1), channels=names)
              for image in (one, other)]
    assert tonetool.bias_check(*images, pixels={"layer": "R,G,B"}).verdict == "different"
    found = tonetool.bias_check(*images, pixels={"layer": "A"})
    assert (found.verdict, found.reason) == ("equal", "identical")
    found = tonetool.bias_check(one, other, pixels={"from": "acescg"})
    assert found.reference.space == found.test.space == "acescg"


def test_types_of_arrays():
    one, other = renders("different")
    found = tonetool.bias_check(one, other)
    wide = tonetool.bias_check(one.astype(np.float64), other.astype(np.float64))
    assert wide.numbers == found.numbers
    halves = tonetool.bias_check(one, one.astype(np.float16))
    assert (halves.verdict, halves.reason) == ("equal", "rounding")
    turned = [np.ascontiguousarray(image.transpose(1, 0, 2)).transpose(1, 0, 2)
              for image in (one, other)]
    assert tonetool.bias_check(*turned) == found


def test_sizes():
    one, large = render(1), render(9, size=128)
    with pytest.raises(tonetool.Error, match="96x96.*128x128"):
        tonetool.bias_check(one, large)
    found = tonetool.bias_check(one, large, size="crop")
    assert found.numbers == tonetool.bias_check(one, large[:SIZE, :SIZE].copy()).numbers
    assert tonetool.bias_check(one, large, size="resize").map.shape == (SIZE, SIZE, 3)


def test_odd_pictures():
    one, other = renders("equal")
    broken = one.copy()
    broken[5, 7], broken[50, 60, 1] = np.nan, np.inf
    for words in ((broken, other), (one, broken), ([one, broken], other)):
        found = tonetool.bias_check(*words)
        assert (found.verdict, found.reason) == ("not enough samples", "non-finite pixels")
        assert found.numbers["nonfinite"] == 2 and found.warnings
    assert tonetool.bias_check(one * 0, one * 0).verdict == "equal"
    assert tonetool.bias_check(one, -one).gain == pytest.approx(-2, abs=1e-6)
    found = tonetool.bias_check(one[:1, :1], other[:1, :1])
    assert (found.verdict, found.reason) == ("not enough samples", "image too small")
    assert found.map.shape == (1, 1, 3)
    assert tonetool.bias_check(one, one).sentence == "equal: every pixel is the same"


def test_inputs_are_not_changed():
    one, other = renders("different")
    before = one.tobytes(), other.tobytes()
    tonetool.bias_check(one, other)
    tonetool.bias_check([one], [other])
    assert (one.tobytes(), other.tobytes()) == before


def test_threads_change_no_bit(verdict):
    one, other = renders(verdict)
    found = [tonetool.bias_check(one, other, map="all", nthreads=n) for n in (1, 2, 4)]
    assert found[0] == found[1] == found[2]
    assert len({result.map.tobytes() for result in found}) == 1


# ---- like other results

def results():
    return [tonetool.bias_check(*renders(verdict)) for verdict in VERDICTS] + [
        tonetool.noise_floor([1.0, 1.1, 1.2, 1.15, 1.05])]


def test_results_are_values(kind):
    made = results() + [tonetool.bias_check(*(kind(image) for image in renders("equal")))]
    for i, one in enumerate(made[:4]):
        assert one == results()[i]
        assert all(one != other for k, other in enumerate(made[:4]) if k != i)
    for one in made:
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
            again = pickle.loads(pickle.dumps(one, protocol))
            assert type(again) is type(one) and again == one and repr(again) == repr(one)
        assert copy.deepcopy(one) == one and copy.copy(one) == one
        lines = repr(one).splitlines()
        assert lines[0].startswith(type(one).__name__ + "(") and lines[-1].endswith(")")
        assert len(lines) <= 24 and max(map(len, lines)) <= 120


def test_a_verdict_cannot_be_overwritten():
    found = tonetool.bias_check(*renders("not enough samples"))
    with pytest.raises(AttributeError):
        found.verdict = "equal"


# ---- errors

A = render(1)


@pytest.mark.parametrize("words, options, kind_of_error, text", [
    ((A,), {}, TypeError, "tests is missing"),
    ((A, 3), {}, TypeError, r"tests is 3 \(int\)"),
    ((None, A), {}, TypeError, "references is None"),
    ((A, "a.exr"), {}, TypeError, "tests is 'a.exr'"),
    (([A, "a.exr"], A), {}, TypeError, r"references\[1\] is 'a.exr'"),
    ((A, A, A), {}, TypeError, "bias_check"),
    ((A, A), {"foo": 1}, TypeError, 'unknown keyword "foo"'),
    ((A, A), {"alpha": "x"}, TypeError, "alpha is 'x'"),
    ((A, A), {"within": None}, TypeError, "within is None"),
    ((A[..., :2], A), {}, ValueError, r"\(96, 96, 2\)"),
    ((A, A), {"size": "fit"}, ValueError, "match, resize, crop"),
    ((A, []), {}, tonetool.Error, "there is no test"),
    (([], A), {}, tonetool.Error, "there is no reference"),
    ((A, A), {"alpha": 0}, tonetool.Error, "alpha is 0: must be 1e-12 to 0.49"),
    ((A, A), {"alpha": 0.5}, tonetool.Error, "alpha is 0.5"),
    ((A, A), {"alpha": math.nan}, tonetool.Error, "alpha is nan"),
    ((A, A), {"within": 0}, tonetool.Error, "within is 0"),
    ((A, A), {"power": 1}, tonetool.Error, "power is 1"),
    ((A, A), {"map": "errors"}, tonetool.Error, "signed, p, rejected, all"),
    ((A, A), {"reference": "fine"}, tonetool.Error, "auto, alike, converged"),
    ((A, A), {"memory": 1000}, tonetool.Error, "memory is "),
    ((A, A), {"pixels": {"layer": "nosuch"}}, tonetool.Error, "nosuch"),
    ((A, A), {"pixels": {"from": "nosuch"}}, tonetool.Error, "nosuch"),
    ((A, A[:50]), {}, tonetool.Error, "96x96.*96x50"),
])
def test_errors(words, options, kind_of_error, text):
    with pytest.raises(kind_of_error, match=text) as raised:
        tonetool.bias_check(*words, **options)
    assert str(raised.value).startswith("bias_check")


def test_a_file_that_is_none(tmp_path):
    with pytest.raises(tonetool.Error, match="gone.exr"):
        tonetool.bias_check(oiio.ImageBuf(str(tmp_path / "gone.exr")), A)


# ---- limits

VALUES = [0.1, 0.12, 0.11, 0.125, 0.105, 0.115, 0.108, 0.118]


def test_a_limit():
    found = tonetool.noise_floor(VALUES)
    logs = np.log(VALUES)
    # k of 8 values for content 0.99 and confidence 0.95, as tables have it: four decimals.
    assert found.limit == pytest.approx(math.exp(logs.mean() + 4.3539 * logs.std(ddof=1)), rel=1e-4)
    assert (found.method, found.needed, found.outlier) == ("lognormal, k 4.3539", 299, None)
    for other in (tuple(VALUES), np.array(VALUES), VALUES[::-1]):
        # 1e-12: sums in another order
        assert tonetool.noise_floor(other).limit == pytest.approx(found.limit, rel=1e-12)


def test_the_limit_of_the_program(program, tmp_path):
    write(tmp_path / "ref.exr", render(499, spp=4096))
    for i in range(5):
        write(tmp_path / f"s{i}.exr", render(500 + i))
    program("ref.exr", *(f"s{i}.exr" for i in range(5)),
            "--noisefloor:content=0.95:confidence=0.9", "limits.json")
    kept = json.loads((tmp_path / "limits.json").read_text(encoding="utf-8"))
    for one in kept["limits"]:
        found = tonetool.noise_floor(one["values"], content=0.95, confidence=0.9)
        assert (found.limit, found.method) == (one["limit"], one["method"])
        assert found.needed == one["needed_for_order_statistic"]
    flips = [tonetool.hdr_flip(render(499, spp=4096), render(500 + i)) for i in range(5)]
    assert [flip.summary.pool.mean for flip in flips] == kept["limits"][0]["values"]


def test_order_statistics_and_zeros():
    # P(Binomial(8, 0.5) <= 5) = 0.855, <= 6 is 0.965: the seventh of eight
    found = tonetool.noise_floor(VALUES, content=0.5, confidence=0.9)
    assert found.limit == sorted(VALUES)[6] and found.method == "order statistic 7 of 8"
    assert found.needed == 4  # 1 - 0.5^4 = 0.9375
    zero = [0.0, *VALUES]
    found = tonetool.noise_floor(zero)
    k = float(found.method.removeprefix("normal, k "))
    # k is printed with four decimals.
    assert found.limit == pytest.approx(np.mean(zero) + k * np.std(zero, ddof=1), rel=1e-4)
    assert tonetool.noise_floor([1, 1, 1, 1]).limit == 1
    assert tonetool.noise_floor([1, 2, 3, 4]).limit > 4


def test_outliers():
    assert tonetool.noise_floor([*VALUES, 0.3]).outlier == len(VALUES)
    assert tonetool.noise_floor([0.3, *VALUES]).outlier == 0
    assert tonetool.noise_floor(VALUES).outlier is None


@pytest.mark.parametrize("words, options, kind_of_error, text", [
    ((), {}, TypeError, "values is missing"),
    (("abcd",), {}, TypeError, "values is 'abcd'"),
    ((3.0,), {}, TypeError, "values is 3"),
    (([1, 2, 3, "4"],), {}, TypeError, r"values\[3\] is '4'"),
    (([[1, 2, 3, 4]],), {}, TypeError, r"values\[0\] is "),
    ((VALUES,), {"x": 1}, TypeError, 'unknown keyword "x"'),
    ((VALUES,), {"content": "x"}, TypeError, "content is 'x'"),
    (([],), {}, tonetool.Error, "at least 4 renders, there are 0"),
    (([1, 2, 3],), {}, tonetool.Error, "at least 4 renders, there are 3"),
    (([1, 2, 3, math.nan],), {}, tonetool.Error, "not finite"),
    (([1, 2, 3, math.inf],), {}, tonetool.Error, "not finite"),
    ((VALUES,), {"content": 0.4}, tonetool.Error, "content is 0.4: must be 0.5 to 0.99999"),
    ((VALUES,), {"confidence": 1}, tonetool.Error, "confidence is 1"),
])
def test_errors_of_limits(words, options, kind_of_error, text):
    with pytest.raises(kind_of_error, match=text) as raised:
        tonetool.noise_floor(*words, **options)
    assert str(raised.value).startswith("noise_floor")
