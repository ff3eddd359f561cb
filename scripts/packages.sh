#!/usr/bin/env bash
# The one list of the system packages that Relief needs: the names are those of Debian 12 and 13 and of
# Ubuntu 24.04. Installs the missing packages of the given groups; prints nothing if none is missing.
#
#   scripts/packages.sh build run [raster] [laz] [dicom] [test] [window-test] [check] [demo] [integrations]
#   scripts/packages.sh --list build run        # prints the names and installs nothing
set -euo pipefail

group() {
  case $1 in
    build) echo cmake ninja-build g++ pkg-config libeigen3-dev libtbb-dev libglm-dev \
      libfmt-dev libcli11-dev nlohmann-json3-dev libzstd-dev zlib1g-dev libexpat1-dev libopenexr-dev libpng-dev libturbojpeg0-dev libtinygltf-dev libdraco-dev \
      libembree-dev libegl-dev libgl-dev $(group window) ;;
    window) echo libglfw3-dev libimgui-dev ;;        # without them all but `relief view` is built
    # Opened while running; Mesa draws without a GPU; the font is that of the window.
    run) echo libegl1 libgl1-mesa-dri libosmesa6 fonts-dejavu-core ;;
    raster) echo gdal-bin ;;                         # brings libgdal, which is opened while running
    laz) if ! grep -qs '^VERSION_ID="12"' /etc/os-release; then echo liblaszip-dev; fi ;;  # not in Debian 12
    dicom) echo libgdcm-dev ;;                       # 17 MB
    test) echo libgtest-dev python3 ;;
    window-test) echo xvfb xdotool ;;                # a display without a screen, and hands that use it
    check) echo clang-tidy clang-format clang libclang-rt-dev ;;  # -rt: libFuzzer
    demo) echo npm ca-certificates ;;                # the Dragon comes in an npm package
    integrations) echo libpcl-dev libopenmesh-dev ;; # 1 GB; tests of <relief/pcl.h> and <relief/openmesh.h>
    *) echo "packages.sh: no group '$1'; there are build, window, run, raster, laz, dicom, test, window-test, check, demo and" \
      "integrations" >&2; return 2 ;;
  esac
}

# npm may also have come with a Node.js that is not Debian's, which Debian's npm conflicts with.
installed() {
  [ "$1" = npm ] && command -v npm >/dev/null && return
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

list_only=false
if [ "${1:-}" = --list ]; then list_only=true; shift; fi
names=()
for name in "$@"; do
  found=$(group "$name")
  read -ra more <<<"$found"
  names+=("${more[@]}")
done
if $list_only; then printf '%s\n' "${names[@]}"; exit; fi

if ! command -v apt-get >/dev/null; then
  echo "packages.sh: this is no Debian; going on, but these are needed: ${names[*]}" >&2
  exit 0
fi
missing=()
for name in "${names[@]}"; do installed "$name" || missing+=("$name"); done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=(env)
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "packages.sh: not root and no sudo; as root run: apt-get install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo env)
fi
as_root+=(DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes)
echo "Installing: ${missing[*]}"
# A list that can't be refreshed (some other source of this machine) may still hold what we need.
"${as_root[@]}" apt-get update -qq || true
"${as_root[@]}" apt-get install -y -qq --no-install-recommends -o Acquire::Retries=3 \
  -o Dpkg::Use-Pty=0 "${missing[@]}" >/dev/null
