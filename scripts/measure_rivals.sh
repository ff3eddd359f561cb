#!/usr/bin/env bash
# A bumpy sphere of 400,000 coloured points against its analytic truth: prints the Markdown table of
# docs/measurements/coloured-points.md and makes its image. Needs jq and ImageMagick (Debian: imagemagick), which the
# project itself does not.
# usage: scripts/measure_rivals.sh BUILD_DIR OUT_DIR [CUBE]
# CUBE: side of the checker's cubes, in radii (0.06).
set -euo pipefail
build=$1 out=$2 cube=${3:-0.06}
relief=$build/cli/relief
mkdir -p "$out"
cmake --build "$build" --target rival_experiment relief >&2
"$build/tests/experiments/rival_experiment" "$out" "$cube"

# psnr VIEW INPUT OPTION...: dB against the truth.
psnr() {
  local view=$1 input=$2 eye=0,0,3
  shift 2
  [ "$view" = full ] || eye=0,0,1.6
  "$relief" render "$input" -o "$out/test.exr" --outputs colour --eye $eye --target 0,0,0 \
    --material unlit --frames 1 "$@" >/dev/null
  "$relief" compare "$out/test.exr" "$out/truth_$view.exr" --flip ldr --json |
    jq -r '.psnr_db * 10 | round / 10'
}

# row NAME MODEL|SCAN OPTION...: a rendering method, for both scans and both views.
row() {
  local name=$1 form=$2 line scan view
  shift 2
  line="| $name |"
  for scan in even random; do
    for view in full close; do
      line+=" $(psnr "$view" "$out/$scan.$form" "$@") |"
    done
  done
  echo "$line"
}

images=$(cd "$(dirname "$0")/.." && pwd)/docs/images
for scan in even random; do
  "$relief" convert "$out/$scan.ply" -o "$out/$scan.relief" --overlap 1 >/dev/null
done
echo '| | even, full | even, close | random, full | random, close |'
echo '| --- | ---: | ---: | ---: | ---: |'
row '`--samples 4`' relief --samples 4
row '`--samples 16`' relief --samples 16
row 'one sample' relief
row '`--primitive quad --samples 4`' relief --primitive quad --samples 4
row '`--engine multipass --samples 4`' relief --engine multipass --samples 4
row '`--engine multipass`' relief --engine multipass
row '`--engine ewa`, the points' ply --engine ewa
row '`--engine ewa --filter unfiltered`, the points' ply --engine ewa --filter unfiltered

close=(--eye 0,0,1.6 --target 0,0,0 --material unlit --frames 1)
"$relief" render "$out/random.relief" -o "$out/relief.png" --samples 4 "${close[@]}" >/dev/null
"$relief" render "$out/random.ply" -o "$out/ewa.png" --engine ewa "${close[@]}" >/dev/null
montage "$out/truth_close.png" "$out/relief.png" "$out/ewa.png" -gravity center \
  -crop 320x320+0+0 +repage -tile 3x -geometry +2+2 -quality 85 -strip "$images/rivals_close.jpg"
