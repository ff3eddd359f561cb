#!/usr/bin/env bash
# The filters of paper 000's Figure 8 on a checkerboard plane, from grazing to magnified: prints the
# Markdown tables of docs/measurements/filters.md and makes its images.
# usage: scripts/measure_filters.sh BUILD_DIR OUT_DIR
# Needs ImageMagick (Debian: imagemagick), which the project itself does not.
set -euo pipefail
build=$1 out=$2
images=$(cd "$(dirname "$0")/.." && pwd)/docs/images
mkdir -p "$out"
cmake --build "$build" --target filter_experiment >&2
"$build/tests/experiments/filter_experiment" "$out"

# sheet NAME CROP VIEW...: a row a view, pixel by pixel as they are.
sheet() {
  local name=$1 crop=$2
  shift 2
  local tiles=()
  for view in "$@"; do
    for method in truth ewa source-space circular unfiltered; do
      tiles+=("$out/filter_${view}_$method.png")
    done
  done
  montage "${tiles[@]}" -gravity center -crop "$crop+0+0" +repage -tile 5x -geometry +2+2 \
    -quality 75 -strip "$images/$name.jpg"
}
sheet filters_grazing 256x256 grazing70 grazing80 grazing85
sheet filters_frontal 128x128 tilted60x8 tilted60x05 frontal4 frontal1 frontal05 frontal025
