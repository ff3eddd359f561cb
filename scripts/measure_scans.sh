#!/usr/bin/env bash
# Converts every scan below the given folders and prints one Markdown table of what was measured.
# usage: scripts/measure_scans.sh RELIEF_BINARY DIR...
set -euo pipefail
relief=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "| file | points | dropped | duplicates | normals repaired | patches | samples | seconds | psnr_db | uncovered | file bytes | bits/point |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
find "$@" -type f | LC_ALL=C sort | while read -r scan; do
  case "${scan,,}" in
    *.ply | *.ply.gz | *.pcd | *.obj | *.obj.gz | *.off | *.off.gz | *.stl | *.xyz) ;;
    *) continue ;;
  esac
  name=$(basename "$scan")
  if "$relief" convert "$scan" -o "$work/out.relief" --json >"$work/json" 2>"$work/err"; then
    jq -r --arg name "$name" '"| \($name) | \(.points) | \(.points_dropped) | \(.duplicates_merged) | \(.normals_repaired) | \(.patches) | \(.samples) | \(.seconds * 100 | round / 100) | \(.psnr_db * 100 | round / 100) | \(.uncovered_points) | \(.file_bytes) | \(.file_bytes * 80 / .points | round / 10) |"' "$work/json"
  else
    echo "| $name | $(tail -n 1 "$work/err") |"
  fi
done
