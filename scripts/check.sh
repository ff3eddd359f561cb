#!/usr/bin/env bash
# `make check`: what `make test` leaves to the machine that guards main: the format, include cycles,
# links and paths in the documentation, the experiments, clang-tidy, fuzzing with a fixed seed, and the
# readers' tests with sanitizers. Every finding is an error.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${RELIEF_PRESET:-dev}

stage() { echo "== $1 (at ${SECONDS} s)"; }

stage "packages"
scripts/packages.sh build run test check
stage "format"
scripts/format.sh --check
stage "include cycles"
scripts/include_cycles.py --fail
stage "documentation and experiments"
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target relief relief_experiments
scripts/check_docs.py "build/$preset/cli/relief"
stage "clang-tidy"
cmake --preset tidy >/dev/null
scripts/tidy.py build/tidy
stage "fuzz"
scripts/fuzz.sh
stage "sanitizers"
cmake --preset asan-ubsan >/dev/null
cmake --build --preset asan-ubsan --target preprocess_test
ctest --preset asan-ubsan --parallel "$(nproc)" -R "$(tr -d ' \n' <<<"
  ^(Ply|Pcd|Las|Ptx|Xyz|Gltf|Drc|Hostile|ReadPoints|MeshFormats|CleanPoints)")"
stage "done"
