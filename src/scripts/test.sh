#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds what is not built yet and runs every test; ctest has the last word.
#   test.sh [--preset release|asan|tsan] [-DNAME=VALUE...] [ARGUMENT OF CTEST...]
# A compiler of another name than g++ is in CXX when the folder is built for the first time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

preset=release
if [[ ${1:-} == --preset ]]; then
    preset=${2:?"test.sh: --preset wants a name of CMakePresets.json"}
    shift 2
fi
definitions=()
while [[ ${1:-} == -D* ]]; do
    definitions+=("$1")
    shift
done

bash src/scripts/setup.sh --preset "$preset" "${definitions[@]}" \
    --packages src/scripts/packages.txt src/scripts/packages-test.txt src/scripts/packages-browser.txt
# Many tests wait for processes that they have started: one more than there are cores.
exec ctest --preset "$preset" --parallel "$(($(nproc) + 1))" "$@"
