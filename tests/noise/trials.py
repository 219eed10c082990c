# SPDX-License-Identifier: BSD-3-Clause
"""Runs tonetool.bias_check on pairs and keeps what acceptance.py counts."""

import functools
from typing import NamedTuple, Optional

import numpy as np
import tonetool
from renders import SEEDS, Renders, drawn, mean, subsets
from synthetic import pair

LAW = 1.96  # of a 95 % interval


class Trial(NamedTuple):
    verdict: str
    gain: float
    gain_se: float
    energy: float
    energy_se: float
    more: Optional[float]

    @property
    def different(self):
        return self.verdict == "different"

    @property
    def equal(self):
        return self.verdict == "equal"


class Trials:
    """Judges pairs, and the pairs that several rows share."""

    def __init__(self, shared, quick, reference=None):
        self.renders = Renders(shared)
        self.quick = quick
        self.reference = reference
        self.judged = self.against = 0
        for name in ("alike", "drawn_alike", "drawn_unlike", "synthetic"):
            setattr(self, name, functools.lru_cache(maxsize=None)(getattr(self, name)))

    def count(self, full, quick):
        return quick if self.quick else full

    def judge(self, references, tests):
        """Of lists of seeds. The map is the one that is cheapest to make; it changes no verdict."""
        result = tonetool.bias_check(references, tests, map="rejected", nthreads=1)
        self.judged += 1
        if self.reference:
            self.against += self.reference.biascheck(references, tests)["verdict"] != result.verdict
        return Trial(result.verdict, result.gain, result.gain_se, result.numbers["energy.Y"],
                     result.numbers["energy-se.Y"], result.more)

    def alike(self, scene, seeds, swap=False):
        """Pairs of the approved version with the same number of seeds a side: all 66 pairs of one, as many
        drawn sets of more."""
        images = self.renders.unchanged(scene)
        rng = np.random.default_rng(seeds)
        one = [([i], [j]) for i in range(len(images)) for j in range(i + 1, len(images))]
        sets = one if seeds == 1 else [subsets(rng, len(images), seeds, seeds) for _ in one]
        trials = []
        for a, b in sets[::self.count(1, 11)]:
            sides = [[images[i] for i in side] for side in ((b, a) if swap else (a, b))]
            trials.append(self.judge(*sides))
        return trials

    def drawn_alike(self, scene, seeds, swap=False):
        """As alike(), of images that draw each pixel from another seed: far more of them are independent."""
        trials = []
        for trial in range(self.count(66, 2)):
            rng = np.random.default_rng((seeds, trial))
            images, _ = drawn(rng, self.renders.unchanged(scene), 2 * seeds)
            sides = (images[seeds:], images[:seeds]) if swap else (images[:seeds], images[seeds:])
            trials.append(self.judge(*sides))
        return trials

    def unlike(self, scene):
        """Fewer seeds of the approved version against more of it, or the mean of more, by what they are."""
        images = self.renders.unchanged(scene)
        few, many = self.count(66, 2), len(SEEDS)
        rng = np.random.default_rng(41)
        four = [subsets(rng, many, 4, 1) for _ in range(few)]
        out = {"4 seeds against 1": [self.judge([images[i] for i in a], [images[i] for i in b])
                                     for a, b in four]}
        # The mean of twelve leaves out the seed that is judged, lest the two sides share its noise.
        eight = [subsets(rng, many, many - 4, 4) for _ in range(few)]
        apart = [([i for i in range(many) if i != one], [one]) for one in range(many)]
        for name, sets in (("mean of 8 against 4", eight), ("mean of 11 against 1", apart)):
            out[name] = [self.judge([mean([images[i] for i in a])], [images[i] for i in b])
                         for a, b in sets[:few]]
        further = self.renders.further(scene)
        out["mean of 12 against 1"] = [self.judge([self.renders.mean(scene)], [image])
                                       for image in further]
        out["mean of 12 against 4"] = [self.judge([self.renders.mean(scene)], further)]
        out["mean of 11 against 1, drawn"] = self.drawn_unlike(scene, few)
        return out

    def drawn_unlike(self, scene, trials):
        out = []
        for trial in range(trials):
            images, rest = drawn(np.random.default_rng((11, trial)), self.renders.unchanged(scene), 1)
            out.append(self.judge([rest], images))
        return out

    def synthetic(self, kind, count, converged=False, samples=16, change=1.0):
        return [self.judge(*([side] for side in pair(kind, samples, trial, change, converged)))
                for trial in range(count)]

    def false_alarms(self, kind, converged=False):
        """Trials of 16 samples with nothing changed, which several rows count."""
        return self.synthetic(kind, self.count(1000, 30), converged)

    def changed(self, scene, change, seeds):
        """A change against the approved version, `seeds` a side: all 48 pairs of one seed, the 2 sets of two
        and the set of four against each of the 6 and 3 of the approved version; "converged": each render
        of the change, and all four, against the mean of the twelve."""
        tests, images = self.renders.changed(scene, change), self.renders.unchanged(scene)
        if seeds == "converged":
            whole = [self.renders.mean(scene)]
            return [self.judge(whole, test) for test in [[t] for t in tests] + [tests]]
        sets = [side[i:i + seeds] for side in (images, tests) for i in range(0, len(side), seeds)]
        references = sets[:len(images) // seeds]
        pairs = [(r, t) for t in sets[len(references):] for r in references]
        return [self.judge(r, t) for r, t in pairs[::self.count(1, 12)]]


def covered(trials, energy=False):
    """Part of the 95 % intervals that hold 0, which is the truth."""
    hit = [abs(t.energy) <= LAW * t.energy_se if energy else abs(t.gain) <= LAW * t.gain_se
           for t in trials]
    return sum(hit) / len(hit)
