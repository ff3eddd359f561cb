#!/usr/bin/env bash
# Builds the fuzz programs (tests/fuzz, preset `fuzz`) and runs each target, one a core at a time.
# Fails on any finding: a crash, a broken promise, undefined behaviour, a leak, more than 60 s for one
# input (10 s by hand) or more than 2 GB. Findings are kept in build/fuzz/findings.
#
#   scripts/fuzz.sh [TARGET...]             fixed seed, 20000 inputs a target, from the seeds only: as CI does
#   scripts/fuzz.sh --runs N [TARGET...]    fixed seed, N inputs a target
#   scripts/fuzz.sh SECONDS [TARGET...]     random seed, SECONDS a target; inputs that reach new code are kept in
#                                           build/fuzz/corpus and continued from
#
# Targets are the folders of build/fuzz/seeds: the formats of points by their first extension (ply, las, ...)
# and the programs of tests/fuzz/CMakeLists.txt. CXX chooses the compiler; by default the newest clang++ found.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() { sed -n 's/^# \{0,1\}//; 6,10p' "$0" >&2; exit 2; }
budget="-seed=1 -runs=20000"
fixed=yes
timeout=60 # of the clock: a busy machine may stand still for seconds
case "${1:-}" in
  --runs)
    [[ "${2:-}" =~ ^[0-9]+$ ]] || usage
    budget="-seed=1 -runs=$2"
    shift 2
    ;;
  -*) usage ;;
  [0-9]*)
    [[ "$1" =~ ^[0-9]+$ ]] || usage
    budget="-max_total_time=$1"
    fixed=no
    timeout=10
    shift
    ;;
esac

# libFuzzer comes with clang only.
newest_clang() {
  local name
  for name in clang++ clang++-{19,18,17,16,15,14}; do
    if command -v "$name"; then return; fi
  done
  echo "fuzz.sh: no clang++ found; install clang, or name one in CXX" >&2
  return 1
}
compiler=${CXX:-$(newest_clang)}

cmake --preset fuzz -DCMAKE_CXX_COMPILER="$compiler" >/dev/null
cmake --build --preset fuzz
cd build/fuzz
rm -rf seeds fresh
tests/fuzz/relief_fuzz_seeds seeds ../../tests/common/data
targets=("$@")
[ $# -gt 0 ] || mapfile -t targets < <(ls seeds)
mkdir -p findings nowhere logs

# In an empty folder, so that nothing that an input names beside itself exists. Inputs are small, as large ones
# are slow.
run() {
  local name=$1 root=$PWD corpus=$PWD/corpus/$1
  if [ "$fixed" = yes ]; then corpus=$root/fresh/$name; fi
  mkdir -p "$corpus"
  local command=("$root/tests/fuzz/fuzz_$name")
  [ -x "${command[0]}" ] || command=("$root/tests/fuzz/fuzz_points" "--format=$name")
  local words=$root/../../tests/fuzz/dictionaries/$name.dict
  if [ -f "$words" ]; then command+=("-dict=$words"); fi
  local begin=$SECONDS
  # shellcheck disable=SC2086 # the budget is several words
  if (cd nowhere && "${command[@]}" $budget -timeout="$timeout" -rss_limit_mb=2048 -max_len=8192 \
        -artifact_prefix="$root/findings/$name-" -print_final_stats=1 "$corpus" "$root/seeds/$name") \
      >"logs/$name" 2>&1; then
    echo "fuzz $name: no finding in $(sed -n 's/^stat::number_of_executed_units: //p' "logs/$name") inputs," \
      "$((SECONDS - begin)) s"
  else
    echo "fuzz $name: a FINDING, kept in build/fuzz/findings:"
    grep -v -E '^#[0-9]+|DEDUP' "logs/$name" | tail -n 40
    return 1
  fi
}
export -f run
export budget fixed timeout
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c 'run {}'
