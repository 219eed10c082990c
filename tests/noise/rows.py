# SPDX-License-Identifier: BSD-3-Clause
"""The rows of acceptance.py: what is claimed, what came out, what is accepted."""

import time
from statistics import median
from typing import NamedTuple, Optional

import numpy as np
import synthetic
import tonetool
from renders import SCENES, drawn, mean
from trials import covered

ROWS = {}


class Claim(NamedTuple):
    what: str
    came: str
    accepted: str
    holds: Optional[bool]  # None: not judged


def row(function):
    ROWS[function.__name__.replace("_", "-")] = function
    return function


def tolerated(trials, count, part):
    """How many of so many trials may be wrong, where this part of them may. A quick run has too few for a
    rate: it takes the number that is exceeded once in a hundred runs where errors have just that rate."""
    if not trials.quick:
        return int(part * count + 1e-9)  # 0.07 of 100 is 7, and not 7.000000000000001
    chance, total = (1 - part) ** count, 0.0
    for errors in range(count):
        total += chance
        if total >= 0.99:
            return errors
        chance *= (count - errors) / (errors + 1) * part / (1 - part)
    return count


def at_most(trials, what, some, part, verdict="different", accepted=None):
    """A verdict that is wrong."""
    found, most = sum(t.verdict == verdict for t in some), tolerated(trials, len(some), part)
    text = f"<= {most}, quick run" if trials.quick else accepted or f"<= {100 * part:g} %"
    return Claim(what, f"{found} of {len(some)} {verdict}", text, found <= most)


def at_least(trials, what, some, part, verdict="different", accepted=None):
    """A verdict that is right."""
    found = sum(t.verdict == verdict for t in some)
    least = len(some) - tolerated(trials, len(some), 1 - part)
    text = f">= {least}, quick run" if trials.quick else accepted or f">= {100 * part:g} %"
    return Claim(what, f"{found} of {len(some)} {verdict}", text, found >= least)


def shown(what, some, why, verdict="different"):
    """A number that nothing is accepted for."""
    found = sum(t.verdict == verdict for t in some)
    return Claim(what, f"{found} of {len(some)} {verdict}", why, None)


# ------------------------------------------------------------------ false alarms

def alike_of(trials, scene):
    """By seeds a side: pairs of seeds, and, but for a quick run, pairs drawn by the pixel."""
    kinds = [("", trials.alike), (", drawn", trials.drawn_alike)][:trials.count(2, 1)]
    return {f"{seeds} a side{how}": made(scene, seeds) for seeds in (1, 2, 4)
            for how, made in kinds}


@row
def alike(trials):
    """Real renders with nothing changed and the same noise on both sides."""
    everything = []
    for scene in SCENES:
        of_scene = alike_of(trials, scene)
        for name, some in of_scene.items():
            yield at_most(trials, f"{scene}, {name}", some, 3 / 66, accepted="<= 3 of 66")
            everything += some
    yield at_most(trials, "all scenes and seeds", everything, 0.01)


@row
def unlike(trials):
    """The same, with less noise in the reference."""
    everything = []
    for scene in SCENES:
        of_scene = trials.unlike(scene)
        some = [trial for few in of_scene.values() for trial in few]
        hit = {name: sum(t.different for t in few) for name, few in of_scene.items()}
        by = ", ".join(f"{name}: {n} of {len(of_scene[name])}" for name, n in hit.items())
        yield Claim(scene, by, "with the other scenes below", None)
        everything += some
    yield at_most(trials, "all scenes and seeds", everything, 0.01)


@row
def synthetic_alike(trials):
    for kind in ("gamma", "lognormal", "fireflies"):
        some = trials.false_alarms(kind)
        yield at_most(trials, f"{kind}, 16 samples", some, 0.01)


@row
def synthetic_converged(trials):
    for kind in ("gamma", "lognormal"):
        some = trials.false_alarms(kind, converged=True)
        yield at_most(trials, kind, some, 0.01)
    for kind in ("fireflies 2 %", "fireflies 10 %"):
        some = trials.synthetic(kind, trials.count(200, 30), converged=True)
        yield at_most(trials, f"{kind} of the light at 1e-4", some, 0.03)


@row
def rare_fireflies(trials):
    """2.6 of them are expected in the whole image: what one has not seen cannot be known."""
    for kind in ("rare fireflies 2 %", "rare fireflies 10 %"):
        some = trials.synthetic(kind, 200, converged=True)
        yield shown(f"{kind} of the light at 1e-5", some, "stated in the manual")


@row
def few_fireflies(trials):
    """Eight pixels of one side, 50 times the mean of the picture brighter; each side in turn."""
    images = trials.renders.unchanged("gallery")
    some = []
    for trial in range(trials.count(30, 10)):
        rng = np.random.default_rng((8, trial))
        sides = [images[i].copy() for i in rng.choice(len(images), 2, replace=False)]
        hit = sides[trial % 2].reshape(-1, 3)
        hit[rng.choice(len(hit), 8, replace=False)] += 50 * sides[0].mean(dtype=float)
        some.append(trials.judge(*([side] for side in sides)))
    yield at_most(trials, "8 fireflies in one side, gallery", some, 0, accepted="none")


# ------------------------------------------------------------------ numbers

def within(trials, value, most, error):
    """A quick run's value has a noise of its own, which is allowed for three times."""
    limit = most + (3 * error if trials.quick else 0)
    return f"+-{limit:.4f}" + (", quick run" if trials.quick else ""), abs(value) <= limit


def unchanged_series(trials):
    """What false-alarm rows judged, by kind."""
    real = [t for scene in SCENES for some in alike_of(trials, scene).values() for t in some]
    yield "real", real
    for kind in ("gamma", "lognormal", "fireflies"):
        yield f"synthetic {kind}", trials.false_alarms(kind)


@row
def coverage(trials):
    """Part of the 95 % intervals that hold the truth. A quick run has 30 of a kind, of which 0.83 or more do
    with a chance of 0.997."""
    for name, some in unchanged_series(trials):
        for energy, what, lowest in ((False, "weighted gain", 0.91), (True, "energy", 0.90)):
            part = covered(some, energy)
            low, high = trials.count((lowest, 0.99), (0.83, 1))
            yield Claim(f"{what}, {name}", f"{part:.3f} of {len(some)}",
                        f"{low} to {high}", low <= part <= high)


@row
def bias(trials):
    """Real pairs both ways round, since pairs of twelve seeds are not independent: the noise of the mean gain
    cancels, and what an estimate gets wrong does not."""
    series = {}
    for scene in SCENES:
        once = trials.alike(scene, 1) + trials.drawn_alike(scene, 1)
        back = trials.alike(scene, 1, swap=True) + trials.drawn_alike(scene, 1, swap=True)
        series[scene] = [(a.gain + b.gain) / 2 for a, b in zip(once, back)]
        apart = trials.drawn_unlike(scene, trials.count(66, 4))
        series[f"{scene}, mean of 11 as reference"] = [t.gain for t in apart]
    for kind in ("gamma", "lognormal", "fireflies"):
        series[f"synthetic {kind}"] = [t.gain for t in trials.false_alarms(kind)]
    for kind in ("gamma", "lognormal"):
        some = trials.false_alarms(kind, converged=True)
        series[f"synthetic {kind}, converged reference"] = [t.gain for t in some]
    for name, gains in series.items():
        error = np.std(gains, ddof=1) / len(gains) ** 0.5
        yield Claim(name, f"{np.mean(gains):+.4f} +- {error:.4f} over {len(gains)}",
                    *within(trials, np.mean(gains), 0.003, error))


@row
def more(trials):
    """`more` of four times the samples is a quarter. 64 samples are the means of four seeds here. Medians,
    since it is the largest of many blocks'."""
    series = {}
    for scene in SCENES:
        for seeds in (1, 2, 4):
            series[scene, 16 * seeds] = trials.alike(scene, seeds)
    for samples in (1, 2, 4):
        some = trials.synthetic("gamma", trials.count(100, 20), samples=samples)
        series["synthetic gamma", samples] = some
    values = {key: [t.more for t in some if t.more] for key, some in series.items()}
    for name in (*SCENES, "synthetic gamma"):
        (first, one), *others = [(samples, median(some)) for (of, samples), some in values.items()
                                 if of == name]
        for samples, value in others:
            law = one * first / samples
            yield Claim(f"{name}, {first} and {samples} samples",
                        f"{one:.3g} and {value:.3g}", f"{law / 2:.3g} to {law * 2:.3g}",
                        0.5 <= value / law <= 2)


# ------------------------------------------------------------------ changes that are found

@row
def gain(trials):
    """All light, one seed a side: all 48 pairs of a scene. +5 % is the picture of +2 % times 1.05 / 1.02."""
    for scene in SCENES:
        yield at_least(trials, f"+2 %, {scene}", trials.changed(scene, "gain_1.02", 1), 0.95)
    for scene in SCENES:
        factor = np.float32(1.05)
        pairs = [(r, t * factor) for t in trials.renders.further(scene)
                 for r in trials.renders.unchanged(scene)][::trials.count(1, 8)]
        yield at_least(trials, f"+5 %, {scene}", [trials.judge([r], [t]) for r, t in pairs], 1,
                       accepted="all")


FOUND = [("cornell", "group_fill_1.3"), ("gallery", "group_warm_1.1"), ("nightstreet", "group_cars_1.2"),
         ("cornell", "hide_mover"), ("gallery", "hide_suzanne"), ("cornell", "tint_suzanne_0.9")]


@row
def changes(trials):
    """What is accepted comes from six pairs of each; here all 48 of one seed count."""
    for scene, change in FOUND:
        for seeds in (1, 2, 4, "converged"):
            side = "converged reference" if seeds == "converged" else f"{seeds} a side"
            yield at_least(trials, f"{change}, {scene}, {side}",
                           trials.changed(scene, change, seeds), 1, accepted="all")


@row
def clamp(trials):
    for scene in ("cornell", "gallery"):
        yield at_least(trials, f"clamp_1, {scene}, 1 a side", trials.changed(scene, "clamp_1", 1), 1,
                       accepted="all")


@row
def bounces(trials):
    for scene, seeds, part, accepted in (("cornell", 1, 1, "all"), ("gallery", 1, 4 / 6, ">= 4 of 6"),
                                         ("gallery", 2, 1, "all")):
        yield at_least(trials, f"bounces_3, {scene}, {seeds} a side",
                       trials.changed(scene, "bounces_3", seeds), part, accepted=accepted)
    yield shown("bounces_3, gallery, converged reference",
                trials.changed("gallery", "bounces_3", "converged"), "darker blocks are untested")


@row
def never_equal(trials):
    """Changes below the noise."""
    for scene, change in (("gallery", "tint_Icosphere_0.9"), ("nightstreet", "bounces_3"),
                          ("nightstreet", "clamp_1")):
        some = [t for seeds in (1, 2, 4, "converged") for t in trials.changed(scene, change, seeds)]
        yield at_most(trials, f"{change}, {scene}", some, 0, "equal", accepted="none")


@row
def large(trials):
    """384 x 384 and 480 x 270 against 1024 samples, all light times a factor."""
    for scene in SCENES:
        for samples, factors in ((16, (1, 1.01, 1.02, 1.05)), (4, (1, 1.02, 1.05))):
            reference = trials.renders.large(scene, "ref")
            test = trials.renders.large(scene, f"test_{samples}spp")
            for factor in factors:
                verdict = trials.judge([reference], [test * np.float32(factor)])
                want = "not found" if factor == 1 else "found"
                came = "found" if verdict.different else "not found"
                yield Claim(f"{samples} samples x {factor:.2f} against 1024, {scene}", came, want,
                            came == want)


# ------------------------------------------------------------------ equal

@row
def equal_wrongly(trials):
    """Brighter and darker, and of the whole picture also against a converged reference. The noise matters: with
    256 samples 16-blocks contradict the claim, with 8 and 16 only the bound of the 64-block can."""
    count = trials.count(125, 3)
    for times in (1, 1.2):
        some = [t for factor in (1 + 0.05 * times, 1 - 0.05 * times) for samples in (16, 256)
                for converged in (False, True)
                for t in trials.synthetic("gamma", count, converged, samples, factor)]
        yield at_most(trials, f"gain of {times:g} x the margin", some, 0.01, "equal")
    some = []
    for samples, factor in ((8, 1.05), (8, 0.95), (16, 1.05), (16, 0.95)):
        change = synthetic.one_block(factor)
        for trial in range(2 * count):
            sides = synthetic.pair("gamma", samples, trial, change)
            some.append(trials.judge(*([side] for side in sides)))
    yield at_most(trials, "one 64-block at the margin", some, 0.01, "equal")


@row
def equal_rightly(trials):
    for samples in (64, 256, 1024):
        some = trials.synthetic("gamma", trials.count(400, 10), samples=samples)
        yield at_least(trials, f"synthetic gamma, {samples} samples", some, 0.99, "equal")
    for scene in SCENES:
        yield shown(f"{scene}, 1 a side", trials.alike(scene, 1), "0 is right", "equal")


# ------------------------------------------------------------------ limits

QUANTITIES = ("mean", "p99", "p999", "max")


def flip_values(reference, tests):
    pools = [result.summary.pool for result in tonetool.hdr_flip(reference, tests, nthreads=1)]
    return {name: [getattr(pool, name) for pool in pools] for name in QUANTITIES}


def above(values, count, draws, seed):
    """Values that are left out of the limit of `count` of them: how many, and how many are above it."""
    rng = np.random.default_rng(seed)
    left = over = 0
    for _ in range(draws):
        mixed = rng.permutation(values)
        limit = tonetool.noise_floor(list(mixed[:count])).limit
        left += len(mixed) - count
        over += int((mixed[count:] > limit).sum())
    return over, left


def limit_series(trials):
    """Renders against a fixed reference that is none of them: all quantities of their HDR-FLIP.

    Seeds: four of the twelve are the reference, in turn; the other eight and the four that gain_1.02 gives
    are the renders. Drawn: the mean of those four is the reference, and 28 renders, as many as the figures come
    from, draw each pixel from another one of the twelve: HDR-FLIP sees a few pixels around each."""
    for scene in ("gallery",) if trials.quick else SCENES:
        images, further = trials.renders.unchanged(scene), trials.renders.further(scene)
        for first in range(0, trials.count(12, 1), 4):
            rest = images[:first] + images[first + 4:] + further
            yield "seeds", scene, flip_values(mean(images[first:first + 4]), rest)
        if not trials.quick:
            some = [drawn(np.random.default_rng((28, i)), images, 1)[0][0] for i in range(28)]
            yield "drawn", scene, flip_values(mean(further), some)


@row
def limits(trials):
    """The part of the renders above the limit of some of them, which is to hold 99 % of them; a render of
    twelve that is unlike the others is 8 % of a series, so that all series together are judged."""
    found = {}
    for how, scene, values in limit_series(trials):
        for number, (name, some) in enumerate(values.items()):
            for count in [6, 8, 12] if how == "drawn" else [6, 8]:
                over, left = above(some, count, trials.count(200, 20), number)
                found.setdefault((how, count), []).append((over / left, over, left, scene, name))
    for (how, count), series in found.items():
        over, left = sum(s[1] for s in series), sum(s[2] for s in series)
        parts = {name: np.mean([s[0] for s in series if s[4] == name]) for name in QUANTITIES}
        worst, _, _, scene, name = max(series)
        by = ", ".join(f"{name} {part:.4f}" for name, part in parts.items())
        came = f"{over / left:.4f} of {left} ({by}; worst of {len(series)} series {worst:.4f}, {scene} {name})"
        yield Claim(f"above the limit of {count} renders, {how}", came, "<= 1 % of 8 and more",
                    over <= 0.01 * left if count >= 8 else None)


# ------------------------------------------------------------------ the program

@row
def threads(trials):
    """The same bits from any number of threads."""
    first, second = synthetic.pair("gamma", 16, 0)
    bits = set()
    counts = (1, 2, 3, 8)
    for nthreads in counts:
        result = tonetool.bias_check([first], [second], map="all", nthreads=nthreads)
        bits.add((result.map.tobytes(), str(result.numbers), tuple(result.evidence)))
    yield Claim(f"results of {', '.join(map(str, counts))} threads", f"{len(bits)} in all", "1",
                len(bits) == 1)


@row
def speed(trials):
    """Of 1920 x 1080 arrays, the least of fifteen calls, with the making of the default map. A busy machine
    makes it longer: look at it on one that is idle."""
    rng = np.random.default_rng(1080)
    sides = [rng.standard_gamma(8, (1080, 1920, 3), dtype=np.float32) for _ in range(2)]
    taken = []
    for _ in range(15):
        start = time.process_time()
        tonetool.bias_check([sides[0]], [sides[1]], nthreads=1)
        taken.append(time.process_time() - start)
    yield Claim("CPU time of 1920 x 1080, 1 + 1 seeds", f"{min(taken):.3f} s", "<= 0.15 s",
                min(taken) <= 0.15)


# What a quick run leaves out, and why.
NOT_QUICK = {"speed": "another process may take the time",
             "large": "reading eight layers of nine files takes too long",
             "rare-fireflies": "nothing is accepted for it"}
