#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# make_anim.sh FROM TO: the sequence of FROM (ref.0001.exr ..., test.0001.exr ...) in 48x27, the
# beauty and its light groups alone. Needs oiiotool.
set -euo pipefail
from=$1 to=$2

channels=ViewLayer.Combined.R,ViewLayer.Combined.G,ViewLayer.Combined.B,ViewLayer.Combined.A
for group in env fill key neonC neonM; do
    for color in R G B; do
        channels+=,ViewLayer.Combined_$group.$color
    done
done
mkdir -p "$to"
for name in ref test; do
    oiiotool --frames 1-8 "$from/$name.%04d.exr" --ch "$channels" --resize:filter=box 48x27 \
        -d half --compression zip --nosoftwareattrib -o "$to/$name.%04d.exr"
done
