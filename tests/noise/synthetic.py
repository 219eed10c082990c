# SPDX-License-Identifier: BSD-3-Clause
"""Synthetic renders whose expected value and noise are known, for acceptance.py.

The text that the figures come from names the noise (gamma, lognormal of sigma 1.5, fireflies) and the size;
what it leaves open is chosen here:

* The picture that is expected has a decade of light from left to right, over squares of 16 pixels that are
  lit by half or in full and whose edges are not those of blocks. Noise is a factor of it with mean 1.
* A gamma sample has shape 1/2: with 16 of them a pixel's relative noise is 0.35, that of real renders
  0.28 to 0.64. The mean of `samples` such samples is a gamma variable again.
* Every second trial has the same noise in R, G and B, as paths that carry all three have; the others have
  independent noise in each. Fireflies are in all three channels always, and all of the same brightness."""

import functools

import numpy as np

SIZE = 128
SHAPE = 0.5
SIGMA = 1.5
TINT = (1.0, 0.8, 0.6)


@functools.lru_cache(maxsize=None)
def expected():
    y, x = np.mgrid[:SIZE, :SIZE]
    dim = ((x + 5) // 16 + (y + 11) // 16) % 2 == 0
    light = 0.2 * 10 ** (x / SIZE) * np.where(dim, 0.5, 1.0)
    return (light[..., None] * np.array(TINT)).astype(np.float32)


def gamma(rng, samples, channels):
    shape = SHAPE * samples
    return rng.standard_gamma(shape, (SIZE, SIZE, channels), dtype=np.float32) / np.float32(shape)


def lognormal(rng, samples, channels):
    z = rng.standard_normal((samples, SIZE, SIZE, channels), dtype=np.float32)
    return np.exp(np.float32(SIGMA) * z - np.float32(SIGMA ** 2 / 2)).mean(0)


def fireflies(share, chance):
    """Gamma noise, and a part of the light that comes from one sample in 1 / chance."""

    def noise(rng, samples, channels):
        bright = rng.poisson(chance * samples, (SIZE, SIZE, 1)) * (share / (chance * samples))
        return (1 - share) * gamma(rng, samples, channels) + bright.astype(np.float32)

    return noise


KINDS = {"gamma": gamma, "lognormal": lognormal, "fireflies": fireflies(0.1, 1e-4),
         "fireflies 2 %": fireflies(0.02, 1e-4), "fireflies 10 %": fireflies(0.1, 1e-4),
         "rare fireflies 2 %": fireflies(0.02, 1e-5),
         "rare fireflies 10 %": fireflies(0.1, 1e-5)}


def pair(kind, samples, trial, change=1.0, converged=False):
    """A reference and a test whose expected value is the reference's times `change`, a number or a
    picture. The same numbers give the same pair."""
    rng = np.random.default_rng((list(KINDS).index(kind), samples, trial, converged))
    channels = 1 if trial % 2 else 3
    sides = [expected() if converged else expected() * KINDS[kind](rng, samples, channels),
             expected() * np.float32(change) * KINDS[kind](rng, samples, channels)]
    return [np.ascontiguousarray(side, np.float32) for side in sides]


def one_block(factor):
    """A change of the upper left 64 x 64 pixels alone."""
    change = np.ones((SIZE, SIZE, 1))
    change[:64, :64] = factor
    return change
