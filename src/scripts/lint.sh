#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Format, names of tests, clang-tidy and cppcheck over src/, tests/ and plugins/, and the program linked
# under watch of the one-definition rule; every finding an error. Not part of test.sh; needs the
# packages of packages-lint.txt and a build/release configured by test.sh.
# With file names as arguments: only these, and no link.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

[[ -d build/release ]] || { echo "lint.sh: no build/release, run src/scripts/test.sh first" >&2; exit 1; }
# Each source by itself, and without what gcc has precompiled, which clang cannot read.
plain=build/lint
cmake --preset release -B "$plain" -DTONETOOL_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    >/dev/null

if [[ $# -gt 0 ]]; then
    all=("$@")
else
    mapfile -t all < <(find src tests plugins -name '*.cpp' -o -name '*.h' | sort)
fi
mapfile -t sources < <(printf '%s\n' "${all[@]}" | grep '\.cpp$' || true)
status=0

bash src/scripts/format.sh --check "${all[@]}" || status=1

# The example of src/doc/cpp.md begins as it does there.
if grep -L 'SPDX-License-Identifier: BSD-3-Clause' "${all[@]}" | grep -v '^tests/package/example/'; then
    echo "lint.sh: these files lack the SPDX line" >&2
    status=1
fi

# GoogleTest makes names of its own with underscores.
if grep -nE '^ *(TYPED_)?TEST(_[FP])?\([^)]*_' /dev/null "${sources[@]}"; then
    echo "lint.sh: names of tests have no underscore" >&2
    status=1
fi

printf '%s\0' "${sources[@]}" |
    xargs -0 -r -n 1 -P "$(nproc)" clang-tidy --quiet -p "$plain" --extra-arg=-Wno-unknown-warning-option || status=1

cppcheck --quiet --library=googletest --std=c++17 --language=c++ --inline-suppr --error-exitcode=1 \
    --enable=warning,performance,portability --suppressions-list=src/scripts/cppcheck.supp \
    -I src -I src/include -I $plain/src/include "${sources[@]}" || status=1

if [[ $# -eq 0 ]]; then
    cmake --preset odr >/dev/null
    cmake --build --preset odr --parallel "$(nproc)" || status=1
fi

[[ $status -eq 0 ]] && echo "lint: clean"
exit "$status"
