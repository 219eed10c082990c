#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes bias_goldens.json: what the method's reference implementation, noise_reference.py, says of the
pictures of bias_pictures.h.

    make_bias_goldens.py FOLDER_OF_NOISE_REFERENCE
"""
import json
import os
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
import noise_reference as reference  # noqa: E402

PLAIN = dict(noise=1.0, power=1, fireflies=0.0, gain=1.0, corner=1.0, smooth=0.0, level=0.0, shift=0,
             black_half=False, wave=0.0)


def uniform(x, y, c, seed):
    u = np.uint64
    z = ((u(seed) * u(8192) + y.astype(u)) * u(8192) + x.astype(u)) * u(4) + u(c)
    z = (z + u(1)) * u(0x9e3779b97f4a7c15)
    z = (z ^ (z >> u(30))) * u(0xbf58476d1ce4e5b9)
    z = (z ^ (z >> u(27))) * u(0x94d049bb133111eb)
    return ((z ^ (z >> u(31))) >> u(40)).astype(float) * 2.0 ** -24


def noise(x, y, c, seed, o):
    u = uniform(x, y, c, seed)
    v = u
    for _ in range(1, o["power"]):
        v = v * u
    n = 1 + o["noise"] * (v * (o["power"] + 1) - 1)
    if o["fireflies"] > 0:
        n = np.where(uniform(x, y, 3, seed) < o["fireflies"], n + 30, n)
    return n


def render(width, height, seed, options):
    o = dict(PLAIN, **options)
    y, x = np.mgrid[0:height, 0:width]
    planes = []
    for c in range(3):
        base = ((32 + 8 * (x // 8 % 8) * (c + 1)).astype(float) + (y // 16 % 4).astype(float)) / 1024
        edge = np.where((x + 8 - o["shift"]) // 4 % 4 == 0, 2.0, 1.0)
        n = noise(x, y, c, seed, o)
        if o["smooth"] > 0:
            n = n * (1 - o["smooth"]) + noise(x + 1, y, c, seed, o) * o["smooth"]
        gain = np.where((x < 24) & (y < 24), o["gain"] * o["corner"], o["gain"])
        phase = x % 64
        v = base * edge * n * gain + o["level"] + o["wave"] * np.where(phase < 32, 15.5 - phase, phase - 47.5) / 16
        if o["black_half"]:
            v = np.where(2 * x < width, o["level"], v)
        planes.append(v.astype(np.float32))
    return np.stack(planes, -1)


SKEW = dict(power=4)
RARE = dict(power=4, fireflies=0.002)
CLEAN = dict(noise=0.0)
CASES = [  # name, width, height, seeds of the reference, its options, seeds of the test, its options
    ("noise", 128, 96, [1], SKEW, [2], SKEW, {}),
    ("little_noise", 192, 128, [1], dict(noise=0.2), [2], dict(noise=0.2), {}),
    ("barely_found", 128, 96, [1], {}, [2], dict(gain=1.015), {}),
    ("gain", 128, 96, [1], {}, [2], dict(gain=1.03), {}),
    ("real_within", 192, 128, [1], dict(noise=0.2), [2], dict(noise=0.2, gain=1.01), {}),
    ("corner", 128, 96, [1], SKEW, [2], dict(SKEW, corner=4.0), {}),
    ("seeds", 128, 96, [1, 2, 3], SKEW, [4, 5], SKEW, {}),
    ("edges_moved", 128, 96, [1, 2], {}, [4, 5], dict(shift=1), {}),
    ("edges_moved_one_seed", 128, 96, [1], {}, [4], dict(shift=1), {}),
    ("converged", 128, 96, [1], CLEAN, [2], RARE, {}),
    ("converged_test", 128, 96, [1], RARE, [2], CLEAN, {}),
    ("converged_brighter", 160, 96, [1], CLEAN, [2], dict(RARE, gain=1.2), {}),
    ("converged_darker", 160, 96, [1], CLEAN, [2], dict(RARE, gain=0.7), {}),
    ("more_noise", 128, 96, [1], dict(noise=0.8), [2], {}, {}),
    ("much_more_noise", 128, 96, [1], dict(noise=0.6), [2], {}, {}),
    ("smoothed", 128, 96, [1], dict(smooth=0.4), [2], dict(smooth=0.4), {}),
    ("hardly_smoothed", 128, 96, [1], dict(smooth=0.2), [2], dict(smooth=0.2), {}),
    ("smoothed_gain", 128, 96, [1], dict(smooth=0.4), [2], dict(smooth=0.4, gain=1.2), {}),
    ("smooth_change", 128, 96, [1], {}, [1], dict(wave=0.01), {}),
    ("black_half", 128, 96, [1], dict(black_half=True), [2], dict(black_half=True, level=0.01), {}),
    ("odd_size", 63, 65, [1], SKEW, [2], dict(gain=1.4), {}),
    ("just_large_enough", 65, 64, [1], SKEW, [2], dict(gain=1.4), {}),
    ("one_row", 4096, 1, [1], {}, [2], {}, {}),
    ("strict", 128, 96, [1], SKEW, [2], dict(SKEW, corner=4.0), dict(alpha=0.0001)),
    ("lax", 128, 96, [1], SKEW, [2], SKEW, dict(within=0.5, alpha=0.1, power=0.8)),
]


def digest(scale):
    """Sums, which any change of a block moves."""
    finite = np.where(np.isfinite(scale["t"]), scale["t"], 0)
    out = dict(mean=np.abs(scale["mean"]).sum(), se=scale["se"].sum(), t=np.abs(finite).sum(),
               level=scale["level"].sum(), p=[p.sum() for p in scale["p"]],
               rejected=[int(r.sum()) for r in scale["rejected"]],
               untested=[int((~c[3]).sum()) for c in scale["channels"]])
    if "structure_p" in scale:
        out.update(structure_p=scale["structure_p"].sum(), structures=int(scale["structure_rejected"].sum()))
    return out


def main():
    cases = []
    for name, width, height, r_seeds, r, t_seeds, t, options in CASES:
        result = reference.biascheck([render(width, height, s, r) for s in r_seeds],
                                     [render(width, height, s, t) for s in t_seeds], **options)
        if "maps" in result:
            maps = result.pop("maps")
            result["scales"] = [digest(maps[b]) for b in reference.SCALES]
        result = reference.plain(result)
        print(name, result["verdict"], result.get("evidence"), *(result.get(k) for k in (
            "asymmetry", "correlation", "bound", "absolute", "untested", "more")))
        cases.append(dict(name=name, width=width, height=height, reference=dict(r, seeds=r_seeds),
                          test=dict(t, seeds=t_seeds), options=options, result=result))
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "bias_goldens.json"), "w") as out:
        out.write("[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]\n")


if __name__ == "__main__":
    main()
