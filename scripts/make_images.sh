#!/usr/bin/env bash
# Makes the images of docs/images from a patch file of the Stanford Dragon.
# usage: scripts/make_images.sh RELIEF_BINARY DRAGON.relief ENVIRONMENT
# ENVIRONMENT: an EXR or HDR image for the materials (venice_sunset_1k.hdr).
# Needs ImageMagick (Debian: imagemagick), which the project itself does not.
set -euo pipefail
relief=$1
dragon=$2
environment=$3
out=$(cd "$(dirname "$0")/.." && pwd)/docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# render_quads NAME MATERIAL INTERPOLATION CAMERA...: quads show the difference of interpolations best.
render_quads() {
  local name=$1 material=$2 interpolation=$3
  shift 3
  "$relief" render "$dragon" -o "$work/$name.png" --size 1280x1024 --primitive quad --material "$material" \
    --interpolation "$interpolation" "$@" >/dev/null
}

# Four orbits, one a row: lit and mirror, corrected and direct.
for azimuth in 20 110 200 290; do
  for material in lit mirror; do
    for interpolation in corrected direct; do
      render_quads "orbit_${azimuth}_${material}_$interpolation" "$material" "$interpolation" \
        --orbit "$azimuth,15,2.2"
    done
  done
done
montage "$work"/orbit_20_lit_corrected.png "$work"/orbit_20_lit_direct.png \
  "$work"/orbit_20_mirror_corrected.png "$work"/orbit_20_mirror_direct.png \
  "$work"/orbit_110_lit_corrected.png "$work"/orbit_110_lit_direct.png \
  "$work"/orbit_110_mirror_corrected.png "$work"/orbit_110_mirror_direct.png \
  "$work"/orbit_200_lit_corrected.png "$work"/orbit_200_lit_direct.png \
  "$work"/orbit_200_mirror_corrected.png "$work"/orbit_200_mirror_direct.png \
  "$work"/orbit_290_lit_corrected.png "$work"/orbit_290_lit_direct.png \
  "$work"/orbit_290_mirror_corrected.png "$work"/orbit_290_mirror_direct.png \
  -tile 4x4 -geometry 400x320+2+2 -quality 85 -strip "$out/dragon_orbits.jpg"

# A close-up of the neck, where a splat covers tens of pixels (paper 001, Figures 5 and 7).
for material in lit mirror; do
  for interpolation in corrected direct; do
    render_quads "close_${material}_$interpolation" "$material" "$interpolation" \
      --eye=-0.05,0.12,0.09 --target=-0.055,0.118,0 --fov 12
  done
done
montage "$work"/close_lit_corrected.png "$work"/close_lit_direct.png \
  "$work"/close_mirror_corrected.png "$work"/close_mirror_direct.png \
  -tile 2x2 -geometry 800x640+2+2 -quality 85 -strip "$out/dragon_close.jpg"

convert "$work/orbit_20_lit_corrected.png" -resize 640x512 -quality 90 -strip "$out/dragon_lit.jpg"
convert "$work/orbit_20_mirror_corrected.png" -resize 640x512 -quality 90 -strip \
  "$out/dragon_mirror.jpg"

# The head in surroundings: smooth and rough mirror, clear and tinted glass.
material() {
  local name=$1
  shift
  render_quads "head_$name" "$1" corrected --eye=-0.105,0.175,0.1 --target=-0.06,0.15,0.02 \
    --env "$environment" "${@:2}"
}
material mirror mirror
material rough mirror --roughness 0.35
material glass glass
material tinted glass --absorption 0.9,0.2,0.35
montage "$work"/head_mirror.png "$work"/head_rough.png "$work"/head_glass.png \
  "$work"/head_tinted.png -tile 2x2 -geometry 640x512+2+2 -quality 85 -strip \
  "$out/dragon_materials.jpg"
