#!/usr/bin/env bash
# Kills a conversion in tiles at random moments (SIGKILL), starts it again each time, and looks
# whether the file is in the end what an undisturbed conversion writes.
#
#   scripts/kill_conversions.sh RELIEF SCAN MEMORY [TIMES] [SEED]
set -euo pipefail
relief=$1
scan=$2
memory=$3
times=${4:-10}
RANDOM=${5:-1}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
start=$(date +%s.%N)
"$relief" convert "$scan" -o "$folder/whole.relief" --memory "$memory" --json >"$folder/whole.json" 2>/dev/null
seconds=$(echo "$(date +%s.%N) - $start" | bc)
echo "undisturbed: $seconds s, $(jq .tiles "$folder/whole.json") tiles"

# As long as a whole conversion, all of them together, so that some come late.
for ((kill = 1; kill <= times; ++kill)); do
  after=$(echo "scale=2; $seconds * $((RANDOM % 1000)) * 2 / $times / 1000" | bc)
  "$relief" convert "$scan" -o "$folder/killed.relief" --memory "$memory" >/dev/null 2>"$folder/error" &
  sleep "$after"
  if ! kill -KILL $! 2>/dev/null; then
    wait $! || { cat "$folder/error"; exit 1; }
    echo "kill $kill: it was done before $after s"
    break
  fi
  wait $! 2>/dev/null || true
  [ ! -e "$folder/killed.relief" ] || { echo "half a file was left"; exit 1; }
  echo "kill $kill after $after s: $(find "$folder/killed.relief.parts" -name 'survey-*' 2>/dev/null | wc -l) looked at," \
    "$(find "$folder/killed.relief.parts" -name 'part-*' 2>/dev/null | wc -l) made"
done
"$relief" convert "$scan" -o "$folder/killed.relief" --memory "$memory" --json >"$folder/killed.json"
cmp "$folder/whole.relief" "$folder/killed.relief"
[ "$(ls "$folder" | wc -l)" -eq 5 ] || { echo "something was left behind:"; ls -la "$folder"; exit 1; }
echo "the same bytes; $(jq .tiles_found "$folder/killed.json") tiles were there already"
