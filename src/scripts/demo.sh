#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the program if it is not built yet, compares a rendered pair and leaves the pictures in
# build/demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

tonetool=build/release/src/program/tonetool
if [[ ! -x $tonetool ]]; then
    echo "The first run installs the packages that are missing and compiles for about five minutes on"
    echo "two cores; later runs take seconds. The pictures come at the end."
    echo
fi
bash src/scripts/setup.sh --targets tonetool_program tonetool_plugin

reference=testimages/nightstreet_ref.exr
test=testimages/nightstreet_test.exr
out=build/demo
mkdir -p "$out"

echo
echo "HDR-FLIP of $test against $reference:"
"$tonetool" "$reference" "$test" --hdrflip -o "$out/error.exr" --colormap magma -o "$out/error.png"
"$tonetool" "$reference" "$test" --filmstrip -o "$out/filmstrip.png" >/dev/null

font=$(dpkg -L fonts-dejavu-core | grep '/DejaVuSans\.ttf$')
# panel INPUT LABEL OUTPUT [ACTION...]: four times as large, each pixel a square, with a label.
panel() {
    oiiotool "$1" "${@:4}" --resample:interp=0 512x288 \
        --text:x=10:y=30:size=24:shadow=2:font="$font" "$2" -d uint8 -o "$3"
}
beauty=ViewLayer.Combined
display=(--ch "R=$beauty.R,G=$beauty.G,B=$beauty.B"
    --mulc 4 --clamp:min=0:max=1 --colorconvert linear sRGB)
panel "$reference" "reference, +2 stops" "$out/reference.png" "${display[@]}"
panel "$test" "test, +2 stops" "$out/test.png" "${display[@]}"
panel "$out/error.png" "HDR-FLIP error" "$out/error_large.png"
oiiotool "$out/reference.png" "$out/test.png" "$out/error_large.png" \
    --mosaic:pad=8 3x1 -o "$out/side_by_side.png"

cat <<EOF

$out/error.exr         the error map, 0 (same) to 1
$out/filmstrip.png     one column per exposure: reference, test, their error; at the right the
                            largest error and the exposure it comes from

Look at the picture below: the reference, the same street with few samples, and where the eye would
see the difference: black is none, bright is most.
$PWD/$out/side_by_side.png
EOF
