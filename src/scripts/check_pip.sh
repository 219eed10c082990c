#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Python module with pip into a fresh virtual environment and uses it there:
#
#     src/scripts/check_pip.sh [PREFIX [PYTHON]]
#
# PREFIX is where tonetool is installed; without it build/release is installed into a folder of its own.
# It compiles for some minutes, and fetches nothing: PYTHON (/usr/bin/python3) must have numpy.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
python=${2:-/usr/bin/python3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

prefix=${1:-}
if [ -z "$prefix" ]; then
    prefix=$work/prefix
    cmake --install "$root/build/release" --prefix "$prefix" >"$work/install.log"
fi
"$python" -m venv --system-site-packages "$work/venv"
begin=$SECONDS
CMAKE_PREFIX_PATH=$prefix "$work/venv/bin/pip" install --no-index "$root/src/python"
echo "check_pip: pip install took $((SECONDS - begin)) s"

check=$work/check.py
cat >"$check" <<'CODE'
import sys

import numpy
import tonetool

assert tonetool.__file__.startswith(sys.prefix), tonetool.__file__
reference = numpy.random.default_rng(1).random((64, 96, 3), numpy.float32) * 4
found = tonetool.hdr_flip(reference, reference * numpy.float32(0.9))
assert found.map.shape == (64, 96) and 0 < found.summary.pool.mean < 1
assert tonetool.chain("--dup", [reference]).images[1].shape == reference.shape
_, mean, parameters = tonetool.evaluate(*sys.argv[1:], "HDR")
assert abs(mean - 0.267735) < 1e-6 and parameters["numExposures"] == 12
print("check_pip: tonetool", tonetool.__version__, "in Python", sys.version.split()[0], "with numpy", numpy.__version__)
CODE
pair=("$root/testimages/cornell_ref.exr" "$root/testimages/cornell_test.exr")
cd "$work"
venv/bin/python -I "$check" "${pair[@]}"
# The same where OpenImageIO's module is missing.
venv/bin/python -I -c "import sys; sys.modules['OpenImageIO'] = None; sys.argv = sys.argv[1:]
exec(open(sys.argv[0]).read())" "$check" "${pair[@]}"
venv/bin/pip show tonetool >/dev/null
# pytest finds the plug-in, where there is a pytest.
if venv/bin/python -I -c "import pytest" 2>/dev/null; then
    venv/bin/python -I -B -m pytest -p no:cacheprovider --help >pytest-help.txt # grep -q would end it early
    grep -q -- --tonetool-report pytest-help.txt
fi
venv/bin/pip uninstall -y tonetool >/dev/null
test -z "$(find venv/lib -name '_tonetool*' -o -path '*/pytest_tonetool/*.py')"
echo "check_pip: passed"
