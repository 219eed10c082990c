#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tries an installed tonetool as somebody does who has the README: in a folder that holds README.md and
# testimages. One line for each check; the exit status is 1 if one fails. The packages man-db,
# bash-completion, zsh, fish and openimageio-tools must be there.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
here=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$here/testimages" "$work/testimages"
ln -s /usr/share/tonetool/ocio "$work/ocio"
cd "$work"
failed=0

# check NAME COMMAND...: what the command prints is shown if it fails.
check() {
    local name=$1
    shift
    if "$@" >"$work/said" 2>&1; then
        echo "ok      $name"
    else
        echo "FAILED  $name"
        sed 's/^/        /' "$work/said"
        failed=1
    fi
}

# A line of the README. A verdict (3) is no fault of the package; an error (1) is.
readme_line() {
    local status=0
    bash -c "$1" || status=$?
    [[ $status -eq 0 || $status -eq 3 ]]
}

readme_lines() {
    sed -n '/^```sh$/,/^```$/{/^```/d; /^\(tonetool\|oiiotool\|iinfo\|maketx\) /p}' "$here/README.md"
}

# The line that mends it, to be typed as it is printed.
doctors_line() {
    tonetool --doctor 2>&1 | grep '^ *export OIIO_LIBRARY_PATH='
}

stock_reads_recipe() {
    local line
    line=$(doctors_line)
    if [[ -n $line ]]; then
        echo "$line"
        eval "$line"
    fi
    oiiotool testimages/flip.tone -o recipe.exr && [[ -s recipe.exr ]] &&
        tonetool --doctor | grep -q 'oiiotool reads recipes'
}

python_flip() {
    python3 - <<'PYTHON'
import numpy
import tonetool

pixels = numpy.random.default_rng(1).random((64, 96, 3), numpy.float32)
assert tonetool.hdr_flip(pixels, pixels).summary.pool.mean == 0
assert tonetool.hdr_flip(pixels, pixels * 1.5).summary.pool.mean > 0
assert tonetool.__file__.startswith("/usr/lib/python3/dist-packages/"), tonetool.__file__
PYTHON
}

# Where there is a pytest, which the package does not need.
pytest_plugin() {
    python3 - <<'PYTHON'
from importlib.metadata import entry_points

(found,) = [entry for entry in entry_points(group="pytest11") if entry.name == "pytest_tonetool"]
try:
    import pytest
except ImportError:
    pass
else:
    assert found.load().tonetool_check
PYTHON
}

manual() {
    man tonetool >page && grep -q -- '--hdrflip' page && [[ $(man -w tonetool) == /usr/share/man/* ]]
}

# What pressing the tabulator offers, in each shell as the distribution sets it up.
in_bash() {
    bash --norc -c '
        source /usr/share/bash-completion/bash_completion
        for load in _comp_load _completion_loader; do
            ! declare -F "$load" >/dev/null || "$load" tonetool || true
        done
        f=$(complete -p tonetool | sed "s/.*-F \([^ ]*\) .*/\1/")
        COMP_LINE="tonetool --hdrf" COMP_POINT=15 COMP_WORDS=(tonetool --hdrf) COMP_CWORD=1
        "$f" tonetool --hdrf tonetool
        printf "%s\n" "${COMPREPLY[@]}"' | grep -- '--hdrflip'
}

in_zsh() {
    zsh -f -c '
        zmodload zsh/zpty
        zpty shell zsh -f -i
        zpty -w shell "PS1=; autoload -U compinit; compinit -u -D"
        zpty -w -n shell $'"'"'tonetool --hdrf\t'"'"'
        text= deadline=$((SECONDS + 20))
        while (( SECONDS < deadline )); do
            while zpty -r -t shell piece; do text+=$piece; done
            [[ $text == *--hdrflip* ]] && break
            sleep 0.1
        done
        zpty -d shell
        print -r -- "$text"
        [[ $text == *--hdrflip* ]]'
}

in_fish() {
    fish -c 'complete -C "tonetool --hdrf"' | grep -- '--hdrflip'
}

slurm_scripts() {
    tonetool-slurm --dry-run -- --frames 1-8 testimages/anim/ref.#.exr testimages/anim/test.#.exr \
        --hdrflip:fail=p99.9=0.9 --json check.json >scripts && grep -q '^/usr/bin/tonetool ' scripts
}

# The program beside the script, whatever is on the path.
slurm_without_path() {
    env PATH=/nonexistent /usr/bin/python3 /usr/bin/tonetool-slurm --dry-run -- --frames 1-2 \
        "$here/testimages/anim/ref.#.exr" "$here/testimages/anim/test.#.exr" --hdrflip \
        --json check.json | grep '/usr/bin/tonetool'
}

licences() {
    tonetool --licenses >texts && grep -q 'Chart.js' texts && grep -q 'BSD 3-Clause License' texts &&
        grep -q 'BSD 3-Clause License' /usr/share/doc/tonetool/copyright
}

documents() {
    local name
    for name in README.md THIRD_PARTY.md LICENSE changelog.gz copyright; do
        [[ -s /usr/share/doc/tonetool/$name ]] || { echo "no $name"; return 1; }
    done
    [[ -s /usr/share/tonetool/check.schema.json && -s /usr/share/tonetool/ocio/tonetool.ocio ]]
}

for_developers() {
    local library
    library=$(dirname "$(ls /usr/lib/*/libtonetool.so)")
    [[ -s $library/cmake/tonetool/tonetoolConfig.cmake && -s $library/pkgconfig/tonetool.pc &&
        -s /usr/include/tonetool/tonetool.h && -s /usr/include/tonetool/version.h ]]
}

check "tonetool --version" tonetool --version
count=0
while IFS= read -r line; do
    if [[ $line != tonetool* ]]; then
        eval "$(doctors_line)"
    fi
    # --doctor is for whoever has not set the variable: its status says that.
    [[ $line != "tonetool --doctor" ]] || continue
    check "README: $line" readme_line "$line" </dev/null
    count=$((count + 1))
done < <(readme_lines)
check "README has commands" test "$count" -ge 5
unset OIIO_LIBRARY_PATH
check "oiiotool recipe.tone -o recipe.exr" stock_reads_recipe
check "python3: import tonetool" python3 -c "import tonetool"
check "python3: hdr_flip of arrays" python_flip
check "python3: plug-in of pytest" pytest_plugin
check "man tonetool" manual
check "completion in bash" in_bash
check "completion in zsh" in_zsh
check "completion in fish" in_fish
check "tonetool-slurm --dry-run" slurm_scripts
check "tonetool-slurm finds the program beside it" slurm_without_path
check "licences" licences
check "documentation" documents
check "headers, CMake and pkg-config files" for_developers
exit $failed
