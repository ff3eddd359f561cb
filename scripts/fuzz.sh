#!/usr/bin/env bash
# Builds the fuzz targets (tests/fuzz, preset `fuzz`) and runs each, one a core at a time. Fails on any finding:
# a crash, a broken promise, undefined behaviour, a leak, more than 10 s for one input or more than 2 GB.
# Inputs that reach new code are kept in build/fuzz/corpus, those that are findings in build/fuzz/findings.
#
#   scripts/fuzz.sh [SECONDS [TARGET...]]     30 seconds each; all targets, named as tests/fuzz/CMakeLists.txt does
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-30}
shift $(($# > 0 ? 1 : 0))

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
cd build/fuzz
targets=("$@")
if [ $# -eq 0 ]; then
  for program in tests/fuzz/fuzz_*; do [ -f "$program" ] && targets+=("${program#tests/fuzz/fuzz_}"); done
fi
mkdir -p findings nowhere logs
tests/fuzz/relief_fuzz_seeds seeds ../../tests/common/data

# In an empty folder: what an input names beside itself is not there. Inputs are small, as large ones are slow.
run() {
  local name=$1 root=$PWD
  mkdir -p "corpus/$name"
  if (cd nowhere && "$root/tests/fuzz/fuzz_$name" -max_total_time="$2" -timeout=10 -rss_limit_mb=2048 -max_len=8192 \
        -dict="$root/../../tests/fuzz/dictionaries/$name.dict" -artifact_prefix="$root/findings/$name-" \
        -print_final_stats=1 "$root/corpus/$name" "$root/seeds/$name") >"logs/$name" 2>&1; then
    echo "fuzz $name: no finding in $(sed -n 's/^stat::number_of_executed_units: //p' "logs/$name") inputs"
  else
    echo "fuzz $name: a FINDING, kept in build/fuzz/findings:"
    grep -v -E '^#[0-9]+|DEDUP' "logs/$name" | tail -n 40
    return 1
  fi
}
export -f run
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c 'run {} '"$seconds"
