#!/usr/bin/env bash
# Makes the close-ups of docs/images/seams_*.jpg: patches that overlap, patches that meet, and the input mesh
# ray-traced; lit above, as mirrors below.
# usage: scripts/make_seam_images.sh RELIEF_BINARY lucy_50k.ply happy_buddha_50k.obj dragon_vrip_res3.ply
# Needs ImageMagick (Debian: imagemagick), which the project itself does not.
set -euo pipefail
relief=$1
lucy=$2
buddha=$3
dragon=$4
out=$(cd "$(dirname "$0")/.." && pwd)/docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# close_up NAME MESH CAMERA...
close_up() {
  local name=$1 mesh=$2
  shift 2
  "$relief" convert "$mesh" --overlap 1 -o "$work/overlap.relief" >/dev/null
  "$relief" convert "$mesh" -o "$work/seams.relief" >/dev/null
  for material in lit mirror; do
    local common=(--size 520x560 --samples 4 --material "$material" "$@")
    for patches in overlap seams; do
      "$relief" render "$work/$patches.relief" -o "$work/$material.$patches.png" "${common[@]}" >/dev/null
    done
    "$relief" render "$mesh" --engine raytrace -o "$work/$material.truth.png" "${common[@]}" >/dev/null
  done
  montage "$work"/lit.{overlap,seams,truth}.png "$work"/mirror.{overlap,seams,truth}.png \
    -tile 3x2 -geometry 520x560+2+2 -quality 85 -strip "$out/seams_$name.jpg"
}

close_up lucy "$lucy" --eye 1100,1800,900 --target 830,-100,720 --up 0,0,1 --fov 20
close_up buddha "$buddha" --eye 1.2,-3,0.9 --target 0,0,0.62 --up 0,0,1 --fov 18
close_up dragon "$dragon" --eye=-0.2,0.22,0.3 --target=-0.06,0.15,0.0 --fov 20
