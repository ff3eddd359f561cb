#!/usr/bin/env bash
# Times a frame of a patch file with each primitive and interpolation, in turns, and prints a table of
# medians. usage: scripts/measure_frame.sh RELIEF_BINARY FILE.relief [ROUNDS]
set -euo pipefail
relief=$1
file=$2
rounds=${3:-5}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for round in $(seq "$rounds"); do
  for primitive in quad sprite cell; do
    for interpolation in corrected direct; do
      for material in lit mirror; do
        "$relief" render "$file" -o "$work/out.png" --size 1280x1024 --orbit 20,15 --frames 3 \
          --primitive "$primitive" --interpolation "$interpolation" --material "$material" --json \
          >"$work/$primitive.$interpolation.$material.$round"
      done
    done
  done
done
echo "| primitive | interpolation | material | frame_ms (median) | fragments | covered pixels |"
echo "| --- | --- | --- | ---: | ---: | ---: |"
for primitive in quad sprite cell; do
  for interpolation in corrected direct; do
    for material in lit mirror; do
      jq -rs --arg row "| $primitive | $interpolation | $material" \
        '(map(.frame_ms) | sort | .[length / 2 | floor] | round) as $ms
         | "\($row) | \($ms) | \(.[0].fragments) | \(.[0].covered_pixels) |"' \
        "$work/$primitive.$interpolation.$material".*
    done
  done
done
