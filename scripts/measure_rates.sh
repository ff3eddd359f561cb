#!/usr/bin/env bash
# Bits a point against accuracy: patch files of two spacings and two height steps, with Draco's point clouds
# beside them at the number of bits that gives as much. Prints a Markdown table. Needs jq, bc and draco_encoder
# (Debian: draco).
# usage: scripts/measure_rates.sh RELIEF_BINARY DATA_FOLDER [MODEL...]
set -euo pipefail
relief=$1
data=$2
shift 2
models=("$@")
if [ ${#models[@]} -eq 0 ]; then
  models=(scans/dragon/dragon_vrip.ply.gz scans/igea.ply)
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# draco MODEL PSNR: the bits of coordinates that give at least that PSNR (error of rounding in one direction:
# a step over the root of 12), and the bits a point that they take.
draco() {
  local diagonal side bits psnr
  # Box of the points as relief reads them.
  read -r diagonal side < <("$relief" info "$work/model.relief" --json |
    jq -r '[.bounds_max, .bounds_min] | transpose | map(.[0] - .[1]) | "\(map(. * .) | add | sqrt) \(max)"')
  for bits in $(seq 8 20); do
    psnr=$(jq -n --argjson d "$diagonal" --argjson s "$side" --argjson b "$bits" \
      '($d * (12 | sqrt) * (pow(2; $b) - 1) / $s) | log10 * 20')
    if [ "$(echo "$psnr >= $2" | bc -l)" = 1 ]; then break; fi
  done
  case $1 in
    *.gz) gunzip -c "$1" >"$work/model.ply" ;;
    *) cp "$1" "$work/model.ply" ;;
  esac
  draco_encoder -point_cloud -i "$work/model.ply" -o "$work/model.drc" -qp "$bits" -cl 10 --skip NORMAL >/dev/null
  echo "$bits $psnr $(stat -c %s "$work/model.drc")"
}

echo "| model | spacing | height step | samples | psnr_db | heights and mask, bits a sample | file, bits a point | Draco: coordinate bits | its PSNR | its bits a point |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
for model in "${models[@]}"; do
  "$relief" convert "$data/$model" -o "$work/model.relief" --json >"$work/default.json"
  spacing=$(jq .spacing "$work/default.json")
  for factor in 1 1.41; do
    for steps in 20 16 12 10; do
      s=$(jq -n --argjson s "$spacing" --argjson f "$factor" '$s * $f')
      h=$(jq -n --argjson s "$s" --argjson n "$steps" '$s / $n')
      "$relief" convert "$data/$model" -o "$work/model.relief" --codec compact --normal-degrees 90 \
        --spacing "$s" --height-step "$h" --json >"$work/convert.json"
      read -r bits drc_psnr bytes < <(draco "$data/$model" "$(jq .psnr_db "$work/convert.json")")
      jq -r --arg model "$(basename "$model")" --arg factor "$factor" --arg steps "$steps" \
        --arg bits "$bits" --argjson drc_psnr "$drc_psnr" --argjson bytes "$bytes" '
        def rounded(digits): . * pow(10; digits) | round / pow(10; digits);
        "| \($model) | \($factor) h | spacing / \($steps) | \(.samples) | \(.psnr_db | rounded(2))"
        + " | \(8 * .height_bytes / .samples | rounded(2)) | \(8 * .file_bytes / .points | rounded(2))"
        + " | \($bits) | \($drc_psnr | rounded(1)) | \(8 * $bytes / .points | rounded(2)) |"' "$work/convert.json"
    done
  done
done
