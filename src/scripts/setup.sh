#!/usr/bin/env bash
# Installs the missing packages of packages.txt (and of lists like it that are given), then configures
# and builds build/release.
# Does nothing over again, so that a second run is quick and needs no network.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

die() {
    echo "setup.sh: $*" >&2
    exit 1
}

missing_packages() {
    local wanted
    mapfile -t wanted < <(sed 's/#.*//; s/[[:space:]]//g; /^$/d' "$@")
    # dpkg-query complains about, and fails on, names it has never seen; comm lists them as missing.
    comm -23 <(printf '%s\n' "${wanted[@]}" | sort) \
        <(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "${wanted[@]}" \
            2>/dev/null | sed -n 's/^installed //p' | sort -u)
}

install_packages() {
    local as_root=()
    if [[ $EUID -ne 0 ]]; then
        command -v sudo >/dev/null ||
            die "these packages are missing: $*; installing them needs root or sudo"
        as_root=(sudo)
    fi
    echo "Installing: $*"
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -q -y --no-install-recommends "$@"
}

command -v dpkg-query >/dev/null || die "this is written for Debian 12; dpkg-query is not here"
mapfile -t missing < <(missing_packages src/scripts/packages.txt "$@")
if [[ ${#missing[@]} -gt 0 ]]; then
    install_packages "${missing[@]}"
fi

cmake --preset release
cmake --build --preset release --parallel "$(nproc)"
