#!/usr/bin/env bash
# Format, clang-tidy and cppcheck over src/ and tests/, every finding an error. Not part of test.sh;
# needs clang-format, clang-tidy and cppcheck, and a build/release configured by setup.sh.
# With file names as arguments: only these.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

database=build/release/compile_commands.json
[[ -f $database ]] || { echo "lint.sh: no $database, run src/scripts/setup.sh first" >&2; exit 1; }
# clang cannot read what gcc has precompiled.
plain=build/lint
mkdir -p "$plain"
sed -E 's/ -Winvalid-pch//; s/ -include [^ ]*cmake_pch\.hxx//' "$database" >"$plain/compile_commands.json"

if [[ $# -gt 0 ]]; then
    all=("$@")
else
    mapfile -t all < <(find src tests -name '*.cpp' -o -name '*.h' | sort)
fi
mapfile -t sources < <(printf '%s\n' "${all[@]}" | grep '\.cpp$' || true)
status=0

clang-format --dry-run -Werror "${all[@]}" || status=1

printf '%s\0' "${sources[@]}" |
    xargs -0 -r -n 1 -P "$(nproc)" clang-tidy --quiet -p "$plain" --extra-arg=-Wno-unknown-warning-option || status=1

cppcheck --quiet --library=googletest --std=c++17 --language=c++ --inline-suppr --error-exitcode=1 \
    --enable=warning,performance,portability --suppressions-list=src/scripts/cppcheck.supp \
    -I src -I src/include "${sources[@]}" || status=1

[[ $status -eq 0 ]] && echo "lint: clean"
exit "$status"
