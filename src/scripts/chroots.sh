# SPDX-License-Identifier: BSD-3-Clause
# Debian systems in folders, for matrix.sh and package.sh, which source this file.
#   TONETOOL_CHROOTS   where they are kept (build/chroots); a few GB for each suite
#   TONETOOL_MIRROR    where their packages come from (http://deb.debian.org/debian)
shopt -s inherit_errexit # a step that fails in $(...) ends all
tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
chroots=$(realpath -m "${TONETOOL_CHROOTS:-$tree/build/chroots}")
mirror=${TONETOOL_MIRROR:-http://deb.debian.org/debian}

die() {
    echo "$(basename "$0"): $*" >&2
    exit 1
}

# What makes and enters a system needs root. A suite is known by its name alone.
check_chroots() {
    [[ $1 =~ ^(bookworm|trixie|sid)$ ]] || die "unknown suite \"$1\" (valid: bookworm, trixie, sid)"
    [[ $EUID -eq 0 ]] || die "making a system in a folder needs root"
    command -v debootstrap >/dev/null || die "debootstrap is not here (package debootstrap)"
}

# in_chroot FOLDER COMMAND...: runs a command in a system, at its root folder. The tree is there as
# /tonetool, not to be written to except for build/, which is the system's own. What is mounted and
# started for it ends with it.
in_chroot() {
    local root=$1
    shift
    mkdir -p "$root/tonetool" "$root/build" "$chroots/archives" "$tree/build"
    cp -L /etc/resolv.conf "$root/etc/resolv.conf"
    unshare --mount --pid --fork --kill-child bash -euo pipefail -c '
        root=$1 tree=$2 archives=$3
        shift 3
        mount -t proc proc "$root/proc"
        mount --rbind /sys "$root/sys"
        mount --rbind /dev "$root/dev"
        mount --bind "$archives" "$root/var/cache/apt/archives"
        mount --bind "$tree" "$root/tonetool"
        mount -o remount,bind,ro "$root/tonetool"
        mount --bind "$root/build" "$root/tonetool/build"
        # This shell stays, to take in processes whose parents are gone, as the first of a system
        # must: Slurm waits for jobs that it has killed until they are.
        chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
            LANG=C.UTF-8 TERM="${TERM:-dumb}" ${http_proxy:+http_proxy="$http_proxy"} \
            CXX="${CXX:-g++}" DEBIAN_FRONTEND=noninteractive "$@"
        exit
    ' bash "$root" "$tree" "$chroots/archives" "$@"
}

# base_chroot SUITE: the folder of a suite with the least that Debian is.
base_chroot() {
    local root=$chroots/$1-base
    if [[ ! -d $root ]]; then
        rm -rf "$root.new"
        mkdir -p "$chroots"
        debootstrap --variant=minbase "$1" "$root.new" "$mirror" >"$root.log" 2>&1 ||
            die "debootstrap failed, see $root.log"
        # Packages are kept for the next system, and nothing asks or starts.
        echo 'Binary::apt::APT::Keep-Downloaded-Packages "true";' \
            >"$root.new/etc/apt/apt.conf.d/01keep"
        # A mirror may be of a day gone by.
        echo 'Acquire::Check-Valid-Until "false";' >"$root.new/etc/apt/apt.conf.d/01snapshot"
        rm -f "$root.new/etc/apt/apt.conf.d/docker-clean"
        printf '#!/bin/sh\nexit 101\n' >"$root.new/usr/sbin/policy-rc.d"
        chmod +x "$root.new/usr/sbin/policy-rc.d"
        in_chroot "$root.new" apt-get update -q >>"$root.log" 2>&1 ||
            die "apt-get update failed, see $root.log"
        mv "$root.new" "$root"
    fi
    echo "$root"
}

# build_chroot SUITE: the folder of a suite in which the tree is built, and which keeps its build.
build_chroot() {
    local root=$chroots/$1-build base
    if [[ ! -d $root ]]; then
        base=$(base_chroot "$1")
        rm -rf "$root.new"
        cp -a "$base" "$root.new"
        mv "$root.new" "$root"
    fi
    echo "$root"
}
