#!/usr/bin/env bash
# `make test`: installs what is needed, builds once and runs all tests. RELIEF_PRESET=ci makes
# warnings errors.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${RELIEF_PRESET:-dev}

stage() { echo "== $1 (at ${SECONDS} s)"; }

stage "packages"
scripts/packages.sh build run raster laz dicom test window-test
stage "configure"
cmake --preset "$preset"
stage "build"
cmake --build --preset "$preset"
stage "test"
ctest --preset "$preset" --no-tests=error --parallel "$(nproc)"
stage "done"
