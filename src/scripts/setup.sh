#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs packages that are missing, then configures and builds:
#   setup.sh [--preset NAME] [--packages FILE...] [--targets TARGET...] [-DNAME=VALUE...]
# FILEs list packages (packages.txt where none is given), TARGETs are what is built (everything where
# none is given), NAME is one of CMakePresets.json. Without --preset a build/release that is configured
# is taken as it is; a new one is for the program alone, without tests and Python module.
# Does nothing over again, so that a second run is quick and needs no network.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

die() {
    echo "setup.sh: $*" >&2
    exit 1
}

preset=
packages=()
targets=()
definitions=()
option=
for word in "$@"; do
    case $word in
    --preset | --packages | --targets) option=$word ;;
    -D*) definitions+=("$word") ;;
    -*) die "unknown option $word" ;;
    *)
        case $option in
        --preset) preset=$word option= ;;
        --packages) packages+=("$word") ;;
        --targets) targets+=("$word") ;;
        *) die "unexpected word $word" ;;
        esac
        ;;
    esac
done
[[ ${#packages[@]} -gt 0 ]] || packages=(src/scripts/packages.txt)

missing_packages() {
    local wanted
    mapfile -t wanted < <(sed 's/#.*//; s/[[:space:]]//g; /^$/d' "$@")
    # dpkg-query complains about, and fails on, names it has never seen; comm lists them as missing.
    comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
        <(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "${wanted[@]}" \
            2>/dev/null | sed -n 's/^installed //p' | sort -u)
}

# The links that make services start at boot.
boot_services() {
    find /etc/systemd/system -path '*.wants/*.service' 2>/dev/null | sort
}

# Run as root. Some packages of the tests are daemons, which nobody wants for themselves: none is
# started now (Debian's maintainer scripts ask policy-rc.d) or at the next boot. A policy that is there
# is somebody's own, and is kept.
install_packages() {
    local policy=/usr/sbin/policy-rc.d services
    export DEBIAN_FRONTEND=noninteractive
    apt-get update -q
    services=$(boot_services)
    if [[ ! -e $policy ]]; then
        trap "rm -f $policy" EXIT
        printf '#!/bin/sh\nexit 101\n' >"$policy"
        chmod +x "$policy"
    fi
    apt-get install -q -y --no-install-recommends "$@"
    comm -13 <(echo "$services") <(boot_services) | xargs -r rm -f
}

command -v dpkg-query >/dev/null || die "this is written for Debian 12; dpkg-query is not here"
mapfile -t missing < <(missing_packages "${packages[@]}")
if [[ ${#missing[@]} -gt 0 ]]; then
    as_root=()
    if [[ $EUID -ne 0 ]]; then
        command -v sudo >/dev/null ||
            die "these packages are missing: ${missing[*]}; installing them needs root or sudo"
        as_root=(sudo)
    fi
    echo "Installing: ${missing[*]}"
    "${as_root[@]}" bash -euo pipefail -c \
        "$(declare -f boot_services install_packages); install_packages \"\$@\"" setup.sh "${missing[@]}"
fi

folder=build/${preset:-release}
if [[ ! -f $folder/build.ninja ]]; then
    # Warnings are errors for who runs the tests, and no obstacle for who wants the program.
    [[ -z $preset ]] || definitions=(-DTONETOOL_WARNINGS_AS_ERRORS=ON "${definitions[@]}")
    preset=${preset:-program}
fi
if [[ -n $preset || ${#definitions[@]} -gt 0 ]]; then
    cmake --preset "${preset:-release}" "${definitions[@]}"
fi
cmake --build "$folder" --parallel "$(nproc)" ${targets[0]:+--target "${targets[@]}"}
