#!/usr/bin/env bash
# `make check`: what `make test` leaves to the machine that guards main: the format, include cycles,
# links and paths in the documentation, the experiments, clang-tidy, and fuzzing with a fixed seed, in programs
# built with AddressSanitizer and UndefinedBehaviorSanitizer. Every finding is an error. The test programs with
# sanitizers take longer: presets asan-ubsan and tsan, by hand.
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
stage "names"
scripts/same_names.py --fail
stage "documentation and experiments"
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target relief relief_experiments
scripts/check_docs.py "build/$preset/cli/relief"
stage "clang-tidy"
cmake --preset tidy >/dev/null
scripts/tidy.py build/tidy
stage "fuzz, with sanitizers"
scripts/fuzz.sh
stage "done"
