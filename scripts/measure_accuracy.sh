#!/usr/bin/env bash
# Renders models with every engine from twelve views and compares the images with ray-traced ones:
# prints a Markdown table. Needs jq.
# usage: scripts/measure_accuracy.sh RELIEF_BINARY DATA_FOLDER [WIDTHxHEIGHT [MODEL...]]
# METHODS="METHOD;METHOD" in the environment: only these rows, named as in the table. SETTINGS, a JSON object:
# further settings of all views (docs/scene.md).
set -euo pipefail
relief=$1
data=$2
size=${3:-1280x1024}
shift $(($# < 3 ? $# : 3))
models=("$@")
if [ ${#models[@]} -eq 0 ]; then
  models=(scans/dragon/dragon_vrip.ply.gz scans/bunny/bun_zipper.ply.gz scans/igea.ply scans/lucy_50k.ply
    scans/happy_buddha_50k.obj.gz sharp/fandisk_large.off.gz sharp/iron_scan.ply
    colour/lion_takanawa_rgb_normals.ply.gz)
fi
IFS=';' read -ra methods <<<"${METHODS:-onepass cell corrected 4;onepass cell corrected;onepass quad corrected;onepass quad direct;onepass sprite corrected;onepass sprite direct;ewa}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Eight views around, two from above, two from below.
views=$(for azimuth in 0 45 90 135 180 225 270 315; do echo "[$azimuth, 15]"; done
  printf '%s\n' '[20, 60]' '[200, 75]' '[110, -35]' '[290, -60]')
# scene FILE MODEL: a scene of one model with those views.
scene() {
  jq -n --arg model "$2" --argjson views "$(jq -s . <<<"$views")" --arg size "$size" \
    --argjson settings "${SETTINGS:-{\}}" \
    '{models: [{file: $model}], size: ($size | split("x") | map(tonumber)), background: "none",
      views: [$views | to_entries[] | {name: "\(.key)", orbit: .value}]} + $settings' >"$1"
}
# render_views NAME SCENE OPTION...: renders twelve images NAME/VIEW.exr.
render_views() {
  local name=$1 scene=$2
  shift 2
  mkdir -p "$work/$name"
  "$relief" render "$scene" -o "$work/$name/{view}.exr" --frames 1 --json "$@" >"$work/$name.json"
}
# errors NAME TRUTH: one JSON object a view.
errors() {
  local view
  for view in "$work/$1"/*.exr; do
    "$relief" compare "$view" "$work/$2/$(basename "$view")" --flip ldr --json
  done
}

echo "| model | engine | holes | border missing | border extra | normal rms | normal p99 | depth rms | PSNR lit | PSNR mirror |"
echo "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
for model in "${models[@]}"; do
  rm -rf "${work:?}"/*
  "$relief" convert "$data/$model" -o "$work/model.relief" --json >"$work/convert.json"
  scene "$work/patches.json" model.relief
  scene "$work/mesh.json" "$(realpath "$data/$model")"
  render_views truth.lit "$work/mesh.json" --engine raytrace --samples 1 --material lit
  # One ray a pixel reads one point of the environment, which no other engine does.
  render_views truth.mirror "$work/mesh.json" --engine raytrace --samples 16 --material mirror --outputs colour
  for method in "${methods[@]}"; do
    # ENGINE, or ENGINE PRIMITIVE INTERPOLATION [PIXELS A SAMPLE].
    read -ra words <<<"$method"
    options=(--engine "${words[0]}")
    if [ ${#words[@]} -gt 2 ]; then
      options+=(--primitive "${words[1]}" --interpolation "${words[2]}" --pixels-per-sample "${words[3]:-0}")
    fi
    render_views lit "$work/patches.json" "${options[@]}" --material lit
    render_views mirror "$work/patches.json" "${options[@]}" --material mirror --outputs colour
    errors lit truth.lit >"$work/lit.errors"
    errors mirror truth.mirror >"$work/mirror.errors"
    jq -rn --arg row "| $(basename "$model") | $method" --slurpfile lit "$work/lit.errors" \
      --slurpfile mirror "$work/mirror.errors" '
      def mean(f): (map(f) | add / length);
      def total(f): (map(f) | add);
      def rounded(digits): . * pow(10; digits) | round / pow(10; digits);
      "\($row) | \($lit | total(.holes)) | \($lit | total(.border_missing)) | \($lit | total(.border_extra))"
      + " | \($lit | mean(.normal_rms_deg) | rounded(2)) | \($lit | mean(.normal_p99_deg) | rounded(1))"
      + " | \($lit | mean(.depth_rms_relative) | . * 1e4 | rounded(2))e-4"
      + " | \($lit | mean(.psnr_covered_db) | rounded(2)) | \($mirror | mean(.psnr_covered_db) | rounded(2)) |"'
  done
done
