#!/usr/bin/env bash
# Measures the cost of shader code for features that a scene does not use. Takes the shaders of an image, removes
# what their preprocessor leaves out, and times frames with both versions, alternating. Prints the number of lines
# of both, and the median and quartiles of the ratio (with the code over without it). Only Mesa can exchange shaders like this. Needs jq and cpp.
# usage: scripts/measure_unused.sh RELIEF_BINARY SCENE [ROUNDS [OPTION...]]
set -euo pipefail
relief=$1
scene=$2
rounds=${3:-20}
shift $(($# < 3 ? $# : 3))
options=(--size 1280x1024 --orbit 45,15 "$@")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/whole" "$work/stripped"

MESA_SHADER_DUMP_PATH=$work/whole "$relief" render "$scene" -o "$work/whole.png" "${options[@]}" --frames 1 --json >"$work/log"
for shader in "$work"/whole/*.glsl; do
  # Directives that GLSL's compiler needs are hidden from C's preprocessor, which has other line numbers.
  sed -E '/^#line/d; s/^#(version|extension)/@\1/' "$shader" | cpp -P -undef -D__VERSION__=450 -x c - |
    sed -E 's/^@/#/' >"$work/stripped/$(basename "$shader")"
done
frame() { "$relief" render "$scene" -o "$work/$1.png" "${options[@]}" --frames 9 --json | jq .frame_ms; }
for round in $(seq "$rounds"); do
  with=$(frame with)
  without=$(MESA_SHADER_READ_PATH=$work/stripped frame without)
  jq -n "$with / $without"
done >"$work/ratios"
cmp "$work/with.png" "$work/without.png"
echo "lines of shaders: $(cat "$work"/whole/*.glsl | wc -l) with, $(cat "$work"/stripped/*.glsl | wc -l) without"
jq -rs 'sort | (.[length / 4 | floor], .[length / 2 | floor], .[length * 3 / 4 | floor])
  | . * 1000 | round / 1000' "$work/ratios" | paste -sd ' ' | sed 's/^/with over without, quartile median quartile: /'
