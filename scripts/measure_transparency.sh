#!/usr/bin/env bash
# Crossing semi-transparent surfaces (paper 000, Figure 7) with 1 to 8 layers a pixel: prints the
# Markdown table of docs/measurements/transparency.md and makes its image.
# usage: scripts/measure_transparency.sh BUILD_DIR DATA_DIR OUT_DIR     (DATA_DIR: shared/data)
# Needs ImageMagick (Debian: imagemagick), which the project itself does not.
set -euo pipefail
build=$1 data=$2 out=$3
images=$(cd "$(dirname "$0")/.." && pwd)/docs/images
mkdir -p "$out"
cmake --build "$build" --target transparency_experiment >&2
"$build/tests/experiments/transparency_experiment" "$out" "$data/scans/bunny/bun_zipper.ply.gz"

tiles=()
for view in sheets_20_60 sheets_60_35 scan_20_30 scan_140_60; do
  for method in truth 1 2 3 8; do
    # The scan is small in its image.
    case $view in scan*) crop=280x280 ;; *) crop=400x400 ;; esac
    convert "$out/transparency_${view}_$method.png" -gravity center -crop "$crop+0+0" +repage \
      -resize 280x280 "$out/tile_${view}_$method.png"
    tiles+=("$out/tile_${view}_$method.png")
  done
done
montage "${tiles[@]}" -tile 5x -geometry +2+2 -quality 85 -strip "$images/transparency.jpg"
