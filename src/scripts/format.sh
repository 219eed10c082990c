#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The house style: format.sh [--check] [FILE...], of all sources where no file is named. With --check
# nothing is written: it prints what would change, status 1. Needs clang-format 14 (CLANG_FORMAT names
# another program).
#
# Two passes, since clang-format 14 lays lambdas out differently while it removes the braces around a
# single statement: the first removes them, the second formats.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

format=${CLANG_FORMAT:-clang-format}
check=
if [[ ${1:-} == --check ]]; then
    check=1
    shift
fi
if [[ $# -gt 0 ]]; then
    files=("$@")
    for file in "${files[@]}"; do # clang-format takes Python for C++
        [[ $file == *.@(cpp|h) ]] || {
            echo "format.sh: \"$file\" is no C++ source (valid: .cpp, .h)" >&2
            exit 1
        }
    done
else
    mapfile -t files < <(find src tests plugins -name '*.cpp' -o -name '*.h' | sort)
fi
[[ ${#files[@]} -gt 0 ]] || exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp .clang-format "$work"
{ cat .clang-format; echo "RemoveBracesLLVM: true"; } >"$work/braces"
cp --parents -t "$work" "${files[@]}"
(cd "$work" && "$format" -i --style=file:braces "${files[@]}" && "$format" -i "${files[@]}")

status=0
for file in "${files[@]}"; do
    if [[ -n $check ]]; then
        diff -u --label "$file" --label "$file, formatted" "$file" "$work/$file" || status=1
    elif ! cmp -s "$file" "$work/$file"; then
        cp --no-preserve=mode "$work/$file" "$file"
    fi
done
exit "$status"
