#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian package and tries it in a new system without compilers, as root:
#   package.sh bookworm|trixie [--chroot | FILE.deb]
# The package is left in build/package-SUITE. It is built on this system where that is of the suite,
# else, and with --chroot, in the suite's build system of matrix.sh (see chroots.sh). FILE.deb is a
# package to try that is built already.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/chroots.sh"

suite=${1:?"package.sh: which suite? (valid: bookworm, trixie)"}
check_chroots "$suite"
out=$tree/build/package-$suite
packages=(src/scripts/packages.txt src/scripts/packages-package.txt)

# build FOLDER: by the preset "package", in the folder of a tree.
build='
    cd "$1"
    bash src/scripts/setup.sh --preset package -DTONETOOL_WARNINGS_AS_ERRORS=OFF --packages '"${packages[*]}"'
    rm -rf build/package/deb
    cpack --config build/package/CPackConfig.cmake -G DEB -B build/package/deb
'
given=
if [[ ${2:-} == *.deb ]]; then
    given=$(realpath "$2")
    [[ -f $given ]] || die "no file $2"
fi
rm -rf "$out.new"
mkdir -p "$out.new"
here=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
if [[ -n $given ]]; then
    cp "$given" "$out.new"
elif [[ $suite == "$here" && ${2:-} != --chroot ]]; then
    bash -euo pipefail -c "$build" bash "$tree"
    cp "$tree"/build/package/deb/*.deb "$out.new"
else
    root=$(build_chroot "$suite")
    in_chroot "$root" bash -euo pipefail -c "$build" bash /tonetool
    cp "$root"/build/package/deb/*.deb "$out.new"
fi
rm -rf "$out"
mv "$out.new" "$out"
package=$(ls "$out"/*.deb)

# A system that has never seen the sources. What is tried there, beside the package itself:
tried=(man-db bash-completion zsh fish openimageio-tools)
base=$(base_chroot "$suite")
root=$chroots/$suite-package
rm -rf "$root"
cp -a "$base" "$root"
# Minimal images leave man pages out.
rm -f "$root/etc/dpkg/dpkg.cfg.d/docker"
mkdir "$root/try"
cp "$package" "$tree/src/scripts/package_checks.sh" "$tree/README.md" "$root/try"
cp -r "$tree/testimages" "$root/try/testimages"
in_chroot "$root" bash -euo pipefail -c '
    umount /tonetool/build /tonetool
    cd /try
    apt-get update -q
    apt-get install -q -y ./tonetool*.deb
    apt-get install -q -y --no-install-recommends "$@"
    for compiler in c++ g++ cc gcc clang; do
        ! command -v "$compiler" || { echo "a compiler is here: $compiler" >&2; exit 1; }
    done
    bash package_checks.sh
    apt-get remove -q -y tonetool >/dev/null
    ! find /usr /etc -path "*tonetool*" -not -path "/usr/share/doc/tonetool*" | grep . ||
        { echo "files are left when the package is removed" >&2; exit 1; }
' bash "${tried[@]}"
rm -rf "$root"
echo "$package"
