#!/usr/bin/env bash
# Formats every C++ file of the tree, and the header that GLSL shares, in place. With --check it only
# lists the files that are not formatted.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(-i)
if [ "${1:-}" = --check ]; then mode=(--dry-run -Werror); fi
find cli common integrations loader models preprocess renderer shaders tests viewer \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format "${mode[@]}"
