#!/usr/bin/env bash
# `make test`: builds with everything enforced (warnings, clang-tidy, clang-format), runs all tests,
# and each fuzz target on a fixed number of inputs.
set -euo pipefail
cd "$(dirname "$0")/.."

stage() { echo "== $1 (at ${SECONDS} s)"; }

stage "packages"
scripts/packages.sh build run test
stage "configure"
cmake --preset ci
stage "build"
cmake --build --preset ci
stage "clang-tidy"
scripts/tidy.py build/ci
stage "test"
ctest --preset ci --parallel "$(nproc)"
stage "fuzz"
scripts/fuzz.sh
