#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Fuzzes what reads texts: fuzz.sh [SECONDS [TARGET...]], 60 seconds for each target of tests/fuzz.
# Wants clang with libFuzzer (clang++, or the one in CXX). An input that ends a target is left in
# build/fuzz/found; status 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds=${1:-60}
targets=("${@:2}")
[[ ${#targets[@]} -gt 0 ]] || targets=(words recipe lights results options)
compiler=${CXX:-$(command -v clang++ || true)}
[[ -n $compiler ]] || { echo "fuzz.sh: no clang++ here (or set CXX)" >&2; exit 1; }

[[ -f build/release/src/libtonetool.so ]] || bash src/scripts/setup.sh --targets tonetool
# Where it is killed while it writes, the corpus is what it was: new inputs go to a folder beside it.
cmake --preset fuzz -DCMAKE_CXX_COMPILER="$compiler" > /dev/null
cmake --build build/fuzz --target "${targets[@]/#/fuzz_}"
mkdir -p build/fuzz/found
status=0
for target in "${targets[@]}"; do
    mkdir -p "build/fuzz/corpus/$target"
    # A picture's sums may leak in libraries below: only what this project's targets do counts.
    # The rooms of libtonetool are built without the checks: what they add to a string or vector is
    # no overflow.
    ASAN_OPTIONS=detect_container_overflow=0 nice "build/fuzz/tests/fuzz/fuzz_$target" \
        -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -max_len=16384 \
        -print_final_stats=0 -verbosity=0 -detect_leaks=0 \
        -artifact_prefix="build/fuzz/found/$target-" \
        "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" || status=1
    echo "fuzz: $target, $(find "build/fuzz/found" -name "$target-*" | wc -l) findings"
done
exit $status
