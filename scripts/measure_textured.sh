#!/usr/bin/env bash
# Measures textured meshes for docs/measurements/textured-meshes.md: images of `onepass` and `multipass`
# against rays to the input mesh with its own texture, at one texel a cell and at the default; and
# meshes with normal maps likewise.
#
#   scripts/measure_textured.sh [RELIEF] [OUT] [colours|normals]
# Defaults: build/release/cli/relief, out/textured, both.
set -euo pipefail
cd "$(dirname "$0")/.."
relief=${1:-build/release/cli/relief}
out=${2:-out/textured}
what=${3:-colours normals}
data=../shared/data
mkdir -p "$out"

number() { sed -n "s/.*\"$1\": \([0-9.e+-]*\).*/\1/p" | head -1; }

# NAME MATERIAL TRUTH ARGUMENTS...: one row
row() {
  local name=$1 material=$2 truth=$3
  shift 3
  "$relief" render "$@" --material "$material" --background none -o "$out/test.exr" --frames 3 --json \
    >"$out/render.json"
  "$relief" compare "$out/test.exr" "$truth" --json >"$out/compare.json"
  printf '| %s | %s | %.2f | %.2f | %.0f | %s |\n' "$name" "$material" \
    "$(number psnr_covered_db <"$out/compare.json")" "$(number psnr_db <"$out/compare.json")" \
    "$(number frame_ms <"$out/render.json")" "$(number holes <"$out/compare.json")"
}

# NAME MESH OPTIONS-OF-THE-MESH VIEW
model() {
  local name=$1 mesh=$2 options=$3 view=$4
  # shellcheck disable=SC2086
  for texels in 1 default; do
    local file="$out/$name.$texels.relief" texel_options=()
    [ "$texels" = default ] || texel_options=(--texels-per-cell "$texels")
    "$relief" convert "$mesh" $options "${texel_options[@]}" -o "$file" --json >"$out/convert.json"
    "$relief" render "$file" $view --material unlit -o "$out/$name.$texels.png" --explain --json \
      >"$out/explain.json"
    printf '\n**%s, %s texels a cell**: %s samples, up to %s texels a cell, file %s bytes, colour maps %s bytes on the GPU\n\n' \
      "$name" "$texels" "$(number samples <"$out/convert.json")" \
      "$(number texels_per_cell <"$out/convert.json")" "$(number file_bytes <"$out/convert.json")" \
      "$(tr -d '\n' <"$out/explain.json" | grep -o '"colour maps"[^}]*' | number bytes)"
    echo '| drawn by | material | PSNR of what both cover | PSNR of all | frame ms | holes |'
    echo '| --- | --- | --- | --- | --- | --- |'
    for material in unlit lit; do
      local truth="$out/$name.$material.exr"
      [ -f "$truth" ] || "$relief" render "$mesh" $options $view --engine raytrace --material \
        "$material" --background none -o "$truth" >/dev/null
      row "cells" "$material" "$truth" "$file" $view
      [ "$texels" = default ] || continue
      row "cells, finest level" "$material" "$truth" "$file" $view --pixels-per-sample 0
      row "quads" "$material" "$truth" "$file" $view --primitive quad
      row "\`multipass\`" "$material" "$truth" "$file" $view --engine multipass
      row "rays to the patches" "$material" "$truth" "$file" $view --engine raytrace
    done
  done
}

# NAME VIEW: the mesh $out/NAME.obj with a normal map, against rays to it: without the map, with one
# texel a cell and with the map's own resolution
normal_map() {
  local name=$1 view=$2 mesh=$out/$1.obj
  sed '/^norm/d' "$out/$name.mtl" >"$out/$name.plain.mtl"
  sed "s/^mtllib .*/mtllib $name.plain.mtl/" "$mesh" >"$out/$name.plain.obj"
  printf '\n**%s**\n\n| map | samples | texels a cell | file | normal maps on the GPU |\n| --- | --- | --- | --- | --- |\n' "$name"
  for map in none one own; do
    local from=$mesh texel_options=()
    [ $map = none ] && from=$out/$name.plain.obj
    [ $map = one ] && texel_options=(--texels-per-cell 1)
    "$relief" convert "$from" "${texel_options[@]}" -o "$out/$name.$map.relief" --json >"$out/convert.json"
    # shellcheck disable=SC2086
    "$relief" render "$out/$name.$map.relief" $view -o "$out/$name.$map.png" --explain --json \
      >"$out/explain.json"
    printf '| %s | %s | %s | %s | %s |\n' $map "$(number samples <"$out/convert.json")" \
      "$(number normal_texels_per_cell <"$out/convert.json")" \
      "$(number file_bytes <"$out/convert.json")" \
      "$(tr -d '\n' <"$out/explain.json" | grep -o '"normal maps"[^}]*' | number bytes)"
  done
  printf '\n| drawn by | material | PSNR of what both cover | PSNR of all | frame ms | holes |\n'
  echo '| --- | --- | --- | --- | --- | --- |'
  # shellcheck disable=SC2086
  for material in lit mirror; do
    local truth="$out/$name.$material.exr" file="$out/$name"
    [ -f "$truth" ] || "$relief" render "$mesh" $view --engine raytrace --material "$material" \
      --background none -o "$truth" >/dev/null
    row "cells, no map" $material "$truth" "$file.none.relief" $view
    row "cells, one texel a cell" $material "$truth" "$file.one.relief" $view
    row "cells" $material "$truth" "$file.own.relief" $view
    row "cells, 16 samples a pixel" $material "$truth" "$file.own.relief" $view --samples 16
    row "quads" $material "$truth" "$file.own.relief" $view --primitive quad
    row "\`multipass\`" $material "$truth" "$file.own.relief" $view --engine multipass
    row "rays to the patches" $material "$truth" "$file.own.relief" $view --engine raytrace
  done
}

spot=$data/textured/spot
if [[ $what == *colours* ]]; then
  scripts/terrain_obj.py $data/terrain/vtkjs_dem.csv $data/terrain/vtkjs_dem.jpg \
    "$out/terrain/dem.obj"
  model spot $spot/spot_triangulated.obj "--texture $spot/spot_texture.png" "--orbit 215,15"
  model james $data/textured/james/james.obj "" "--orbit 0,0"
  model terrain "$out/terrain/dem.obj" "" "--orbit 20,12,1.1"
fi
if [[ $what == *normals* ]]; then
  scripts/normal_map_obj.py "$out/studs.obj"
  scripts/normal_map_obj.py "$out/studded_spot.obj" --mesh $spot/spot_triangulated.obj \
    --side 2048 --waves 64
  normal_map studs "--orbit 215,15"
  normal_map studded_spot "--orbit 215,15"
fi
