#!/usr/bin/env bash
# `make demo`: from a bare machine to two images of a scan.
set -euo pipefail
cd "$(dirname "$0")/.."
out=build/demo
relief=build/release/cli/relief

stage() { echo "== $1 (at ${SECONDS} s)"; }

stage "packages"
scripts/packages.sh build run
stage "build, and the scan meanwhile"
mkdir -p "$out"
# npm needs some 300 packages. The build does not wait for them.
(scripts/packages.sh demo && models/fetch_dragon.sh "$out") >"$out/fetch.log" 2>&1 &
fetch=$!
trap 'kill $fetch 2>/dev/null || true' EXIT
cmake --preset release
cmake --build --preset release

stage "scan"
if wait $fetch; then
  scan=$out/dragon_vrip.ply.gz
else
  scan=$out/generated_knot.ply
  tail -n 1 "$out/fetch.log"
  echo "The Stanford Dragon can't be had: this is a generated scan instead."
  build/release/models/generate_scan 400000 >"$scan"
fi

stage "convert"
model=$out/model.relief
"$relief" convert "$scan" -o "$model" --json >"$out/convert.json"
stage "render"
for material in lit mirror; do
  "$relief" render "$model" -o "$out/$material.png" --material $material --orbit 20,10 \
    --frames 3 --json >"$out/$material.json"
done

# One value of a JSON object as the command prints it, a key a line; fractions rounded.
value() {
  local text
  text=$(sed -n "s/^  \"$2\": \(.*[^,]\),*\$/\1/p" "$out/$1.json")
  case $text in
    *[!0-9.]*) echo "$text" ;;
    *.*) LC_ALL=C printf '%.5g\n' "$text" ;;
    *) echo "$text" ;;
  esac
}
row() { printf '  %-18s %s\n' "$1" "$2"; }

echo
echo "What was measured (${scan##*/})"
for key in points points_dropped patches samples spacing psnr_db uncovered_points file_bytes seconds; do
  row "$key" "$(value convert $key)"
done
for material in lit mirror; do row "frame_ms, $material" "$(value $material frame_ms)"; done
row renderer "$(value lit renderer)"
row "seconds in all" "$SECONDS"
echo
echo "Patch file  $PWD/$model"
echo "Images      $PWD/$out/lit.png"
echo "            $PWD/$out/mirror.png"
