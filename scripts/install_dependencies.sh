#!/usr/bin/env bash
# Usage: scripts/install_dependencies.sh [--tests] [--print | --no-install]
#
# Installs the Debian packages that building and running hlodbench needs, and only those that are
# missing. With nothing missing it calls neither apt-get nor sudo. Made for Debian 12; later Debian
# and Ubuntu releases mostly have the same names. Other systems: docs/building.md.
#
#   --tests       also what the tests need
#   --print       print the names, one a line, and do nothing else
#   --no-install  only check, and name what is missing
#   --help        this text
#
# Exit codes: 0 everything is there; 2 wrong usage, something is missing, or it cannot be installed.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
# shellcheck source=scripts/lib.sh
. "$root/scripts/lib.sh"

# What each is for stands in docs/building.md.
build_packages=(
  g++ cmake ninja-build git ca-certificates curl pkg-config
  python3 python3-glad python3-numpy python3-pil python3-matplotlib python3-jinja2 libjs-dygraphs
  libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
  libglm-dev libopenmesh-dev libmeshoptimizer-dev libopenimageio-dev libimath-dev
  libglfw3-dev libimgui-dev
  libcli11-dev nlohmann-json3-dev libfmt-dev libxxhash-dev zlib1g-dev
)
# Installed along with the others where the system has them. OSMesa left Mesa with version 25.1.
optional_packages=(libosmesa6-dev)
test_packages=(
  libgtest-dev libgmock-dev python3-pytest python3-jsonschema zstd clang-format shellcheck
  snakemake python3-yaml
  ffmpeg chromium chromium-driver python3-selenium poppler-utils
  xvfb xdotool
)

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get -o DPkg::Lock::Timeout=120 -o Acquire::Retries=3 "$@" </dev/null >&2
}

# has_candidate NAME: whether the package lists hold a version that can be installed.
has_candidate() { LC_ALL=C apt-cache policy "$1" | grep '^  Candidate: [^(]' >/dev/null; }

tests=no
mode=install
while [ $# -gt 0 ]; do
  case $1 in
    --tests) tests=yes ;;
    --print) mode=print ;;
    --no-install) mode=check ;;
    -h | --help)
      usage
      exit 0
      ;;
    *) unknown_option "$1" ;;
  esac
  shift
done

required=("${build_packages[@]}")
[ "$tests" = no ] || required+=("${test_packages[@]}")
if [ "$mode" = print ]; then
  printf '%s\n' "${required[@]}" "${optional_packages[@]}"
  exit 0
fi

if ! is_debian; then
  [ "$mode" = check ] || die 2 "no apt-get here: install what docs/building.md lists by hand"
  say "No dpkg here: cannot check the packages that docs/building.md lists"
  exit 0
fi

mapfile -t missing < <(missing_packages "${required[@]}")
[ ${#missing[@]} -gt 0 ] || exit 0
[ "$mode" = install ] || die 2 "missing packages: ${missing[*]}"
if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
  die 2 "neither root nor sudo here; ask for: apt-get install ${missing[*]}"
fi

say "Installing ${missing[*]}"
apt_get update || say "apt-get update failed; trying with the package lists at hand"
mapfile -t optional < <(missing_packages "${optional_packages[@]}")
for name in "${optional[@]}"; do
  if has_candidate "$name"; then
    missing+=("$name")
  else
    say "Going without the optional package $name: it does not exist here"
  fi
done
apt_get install --yes --no-install-recommends "${missing[@]}" ||
  die 2 "apt-get could not install: ${missing[*]}"
