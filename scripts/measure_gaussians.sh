#!/usr/bin/env bash
# 3D Gaussians in each form of their file, against exact rays, and by engine volume. Prints Markdown tables. Needs jq and
# npm, which gets splat-transform: other software, which writes the forms. Images stay in WORK_FOLDER.
# usage: scripts/measure_gaussians.sh RELIEF_BINARY DATA_FOLDER WORK_FOLDER
set -euo pipefail
relief=$1
scene=$2/splats/biker
work=$3
mkdir -p "$work"
transform() { npx --yes --prefix "$work" @playcanvas/splat-transform@2.7.1 -q -w "$@" >/dev/null; }

camera=(--eye=-3,2.4,3.4 "--target=-0.06,1.6,0.03" --up 0,1,0 --fov 45 --size 1280x1024 --background 0,0,0)
# render NAME FILE OPTION...: writes WORK_FOLDER/NAME.exr; wall milliseconds of the frame.
render() {
  local name=$1 file=$2
  shift 2
  "$relief" render "$file" "${camera[@]}" "$@" -o "$work/$name.exr" --json | jq -r '.frame_ms | round'
}
# compare A B: PSNR in dB, or "same".
compare() {
  "$relief" compare "$work/$1.exr" "$work/$2.exr" --json |
    jq -r '.psnr_db | if . == null then "same" else . * 10 | round / 10 end'
}

transform "$scene.compressed.ply" "$work/plain.ply"
transform "$scene.compressed.ply" "$work/written4.spz"
transform --spz-version 3 "$scene.compressed.ply" "$work/written3.spz"
transform "$scene.spz" "$work/of_spz.ply"
render plain "$work/plain.ply" >/dev/null

echo "| form | bytes | PSNR to the plain .ply, dB |"
echo "| --- | ---: | ---: |"
form() {
  render form "$2" >/dev/null
  echo "| $1 | $(stat -Lc %s "$2") | $(compare form plain) |"
}
form "biker.compressed.ply" "$scene.compressed.ply"
form "biker.spz" "$scene.spz"
form "plain .ply of biker.compressed.ply" "$work/plain.ply"
form "plain .ply of biker.spz" "$work/of_spz.ply"
form ".spz version 4 of biker.compressed.ply" "$work/written4.spz"
form ".spz version 3 of biker.compressed.ply" "$work/written3.spz"
render spz "$scene.spz" >/dev/null
render form "$work/of_spz.ply" >/dev/null
echo "| biker.spz, against the plain .ply of it | | $(compare form spz) |"

echo
render ray "$work/plain.ply" --engine volume-truth >/dev/null
render centre "$work/plain.ply" --engine volume-truth --order centre >/dev/null
echo "| volume-reference | frame, ms | --order ray | --order centre |"
echo "| --- | ---: | ---: | ---: |"
against_truth() {
  local name=$1 ms
  shift
  ms=$(render splatted "$work/plain.ply" --engine volume-reference "$@")
  echo "| $name | $ms | $(compare splatted ray) | $(compare splatted centre) |"
}
against_truth "defaults"
against_truth "\`--filter ewa\`" --filter ewa
against_truth "\`--filter unfiltered\`" --filter unfiltered
against_truth "\`--filter unfiltered --jacobian-clamp 0\`" --filter unfiltered --jacobian-clamp 0
echo "| the truth by centres | | $(compare centre ray) | |"

echo
echo "| volume | frame, ms | by shaders, ms | PSNR to volume-reference, dB | shaders' |"
echo "| --- | ---: | ---: | ---: | ---: |"
by_volume() {
  local name=$1 ms
  shift
  render splatted "$work/plain.ply" --engine volume-reference "$@" >/dev/null
  ms=$(render drawn "$work/plain.ply" --engine volume --drawn-by cpu --frames 3 "$@")
  ms+=" | $(render shaded "$work/plain.ply" --engine volume --drawn-by shaders --frames 3 "$@")"
  echo "| $name | $ms | $(compare drawn splatted) | $(compare shaded splatted) |"
}
by_volume "defaults"
by_volume "\`--min-transmittance 0\`" --min-transmittance 0
by_volume "\`--filter ewa\`" --filter ewa
by_volume "\`--filter unfiltered\`" --filter unfiltered
by_volume "\`--blend linear\`" --blend linear
