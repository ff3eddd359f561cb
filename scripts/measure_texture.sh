#!/usr/bin/env bash
# Texture acquisition (paper 000, section 5) at Figure 6's three magnifications, each method against
# the texture itself: prints the Markdown table of docs/measurements/texture-acquisition.md and keeps the images.
# usage: scripts/measure_texture.sh BUILD_DIR DATA_DIR OUT_DIR     (DATA_DIR: shared/data)
set -euo pipefail
build=$1 data=$2 out=$3
mkdir -p "$out"
cmake --build "$build" --target texture_experiment >&2
experiment=$build/tests/experiments/texture_experiment
# Relief reads no JPEG.
/usr/bin/convert "$data/textured/james/james.jpg" "$out/james.png"

echo "| subject | cutoff | coefficients | rms error | minification | magnification | extreme | minified function | steps | residual | condition |"
echo "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
for cutoff in 1 2; do
  "$experiment" "$out" checkerboard - - 10000 0,30 "$cutoff"
  "$experiment" "$out" spot "$data/textured/spot/spot_triangulated.obj" \
    "$data/textured/spot/spot_texture.png" 50000 200,20 "$cutoff"
  "$experiment" "$out" james "$data/textured/james/james.obj" "$out/james.png" 50000 0,0 "$cutoff"
done
