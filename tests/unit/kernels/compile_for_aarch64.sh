#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# compile_for_aarch64.sh <src> <folder that holds hwy/> [-D...] <source of src/kernels>...
# Checks, without writing anything, that the kernels compile for 64-bit ARM. 77: no compiler for it.
set -euo pipefail
src=$1 hwy=$2
shift 2

# Highway's headers suit every machine; the others beside them do not.
headers=$(mktemp -d)
trap 'rm -r "$headers"' EXIT
ln -s "$hwy/hwy" "$headers/hwy"

compiler=()
for candidate in aarch64-linux-gnu-g++ "clang++ --target=aarch64-linux-gnu" \
    "clang++-14 --target=aarch64-linux-gnu"; do
    read -ra words <<<"$candidate"
    if printf '#include <arm_neon.h>\n#include <cmath>\n' |
        "${words[@]}" -x c++ -fsyntax-only - 2>/dev/null; then
        compiler=("${words[@]}")
        break
    fi
done
if [[ ${#compiler[@]} -eq 0 ]]; then
    echo "skipped: no C++ compiler for aarch64 here (Debian: apt-get install g++-aarch64-linux-gnu)"
    exit 77
fi

definitions=()
while [[ ${1-} == -D* ]]; do
    definitions+=("$1")
    shift
done
for source in "$@"; do
    echo "${compiler[*]}: $source"
    "${compiler[@]}" -std=c++17 -fsyntax-only -Wall -Wextra -Wshadow -Wconversion -Werror \
        -ffp-contract=off "${definitions[@]}" -I "$src" -I "$src/include" -isystem "$headers" \
        "$src/kernels/$source"
done
