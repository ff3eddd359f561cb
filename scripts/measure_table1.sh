#!/usr/bin/env bash
# Table 1 of paper 001 remade: direct and corrected interpolation against splatting in three passes with
# radius factors 1 and 2 ("standard"), all with sprites, in turns. Prints a Markdown table. Needs jq.
# usage: scripts/measure_table1.sh RELIEF_BINARY DATA_FOLDER [FRAMES [MODEL[=SPACING]...]]
set -euo pipefail
relief=$1
data=$2
frames=${3:-20}
shift $(($# < 3 ? $# : 3))
models=("$@")
# The Dragon's spacing gives the paper's 462,814 samples within 5 %; the others have their own.
if [ ${#models[@]} -eq 0 ]; then
  models=(scans/dragon/dragon_vrip.ply.gz=0.0004 scans/bunny/bun_zipper.ply.gz scans/igea.ply
    scans/lucy_50k.ply)
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "| model | samples | direct | correct | standard 1 | standard 2 | standard 2 / correct | standard 2 / default |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
for model in "${models[@]}"; do
  spacing=()
  case $model in *=*) spacing=(--spacing "${model#*=}") ;; esac
  "$relief" convert "$data/${model%=*}" -o "$work/model.relief" --overlap 1 "${spacing[@]}" >/dev/null
  "$relief" bench "$work/model.relief" --frames "$frames" --json >"$work/bench.json"
  jq -r --arg model "$(basename "${model%=*}")" '
    def ms(f): [.rows[] | select(.primitive == "sprite" and f) | .frame_ms][0];
    def round1: . * 10 | round / 10;
    def round2: . * 100 | round / 100;
    ms(.engine == "onepass" and .interpolation == "direct") as $direct
    | ms(.engine == "onepass" and .interpolation == "corrected") as $correct
    | ms(.radius_factor == 1) as $one | ms(.radius_factor == 2) as $two
    | ([.rows[] | select(.default and .engine == "onepass") | .frame_ms][0]) as $default
    | "| \($model) | \(.samples) | \($direct | round1) | \($correct | round1) | \($one | round1)"
      + " | \($two | round1) | \($two / $correct | round2) | \($two / $default | round2) |"' "$work/bench.json"
done
