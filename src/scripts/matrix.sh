#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the tree and runs its tests in a Debian of another suite, as root:
#   matrix.sh bookworm|trixie|sid [-DNAME=VALUE...] [ARGUMENT OF CTEST...]
# The system is made in build/chroots at the first run (see chroots.sh), and so is its build; later
# runs build what has changed. A compiler of another name than g++ is in CXX, its package in
# TONETOOL_PACKAGES.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/chroots.sh"

suite=${1:?"matrix.sh: which suite? (valid: bookworm, trixie, sid)"}
shift
check_chroots "$suite"
root=$(build_chroot "$suite")
if [[ -n ${TONETOOL_PACKAGES:-} ]]; then
    # shellcheck disable=SC2086 # a list of names
    in_chroot "$root" apt-get install -q -y --no-install-recommends $TONETOOL_PACKAGES
fi
in_chroot "$root" bash /tonetool/src/scripts/test.sh "$@"
