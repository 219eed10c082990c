# SPDX-License-Identifier: BSD-3-Clause
"""Other Python threads run while a function computes."""

import threading
import time

import numpy as np
import pytest
import tonetool

CALLS = {
    "hdr_flip": lambda a, b: tonetool.hdr_flip(a, b, num_exposures=2, start_exposure=0,
                                               stop_exposure=1, nthreads=1),
    "tonemap": lambda a, b: tonetool.tonemap(a, curve="agx", nthreads=1),
    "error_map": lambda a, b: tonetool.error_map(a, b, metric="smape", nthreads=1),
    "chain": lambda a, b: tonetool.chain("--threads 1 --hdrflip:startExposure=0:stopExposure=1",
                                         [a, b]),
}


@pytest.fixture(scope="module")
def pair_4k():
    ramp = np.linspace(0, 1, 3840 * 2160, dtype=np.float32).reshape(2160, 3840, 1)
    reference = np.repeat(ramp, 3, axis=2)
    return reference, reference * np.float32(0.9)


@pytest.mark.parametrize("name", CALLS)
def test_another_thread_counts(name, pair_4k):
    """The longest time in which the other thread did not count is far below the call's."""
    ticks, done = [], threading.Event()

    def count():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.perf_counter()
    try:
        result = CALLS[name](*pair_4k)
        end = time.perf_counter()
    finally:
        done.set()
        thread.join()
    during = [begin] + [tick for tick in ticks if begin < tick < end] + [end]
    longest = max(b - a for a, b in zip(during, during[1:]))
    assert result is not None
    assert len(during) > 10 and longest < max(0.8 * (end - begin), 0.05), (longest, end - begin)


def test_many_threads_have_the_same_result(noise):
    other = noise[::-1].copy()
    expected = tonetool.hdr_flip(noise, other).map.tobytes()
    found = []

    def work():
        for _ in range(5):
            found.append(tonetool.hdr_flip(noise, other).map.tobytes() == expected)

    threads = [threading.Thread(target=work) for _ in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [True] * 80
