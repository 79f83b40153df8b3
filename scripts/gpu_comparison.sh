#!/usr/bin/env bash
# Usage: scripts/gpu_comparison.sh [OPTION...]
#
# Scenes 1 and 2 on the GPU of this machine: hlodbench is built, the dragon fetched, and each session
# is replayed at 640x480, 1920x1080 and 3840x2160, with the settings of the paper and with those of
# --preset best. Ends by printing the tables (Markdown) on stdout; all else is said on stderr.
#
#   --repetitions N   how often each session is replayed (9)
#   --sizes LIST      WIDTHxHEIGHT, comma-separated (640x480,1920x1080,3840x2160)
#   --out DIR         the records (results/runs/UTCTIME); must not exist
#   --context NAME    how to get OpenGL: egl, or auto or osmesa (egl)
#   --no-install      install no package; end with code 2 if one is missing
#   --help            this text
#
# Refuses a software rasteriser unless HLODBENCH_SOFTWARE=yes: its times say nothing about a GPU.
#
# Exit codes: 0 all was made; 1 a build or a replay failed; 2 wrong usage or missing package; 3 no
# usable OpenGL; 130 interrupted.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
# shellcheck source=scripts/lib.sh
. "$root/scripts/lib.sh"

repetitions=9 sizes=640x480,1920x1080,3840x2160 results='' context=egl install=yes
while [ $# -gt 0 ]; do
  case $1 in
    --repetitions)
      repetitions=$(repetitions_value "$@")
      shift
      ;;
    --sizes)
      sizes=$(option_value "$@")
      [[ $sizes =~ ^[1-9][0-9]*x[1-9][0-9]*(,[1-9][0-9]*x[1-9][0-9]*)*$ ]] ||
        die 2 "--sizes expects sizes like 640x480,1920x1080, not '$sizes'"
      shift
      ;;
    --out)
      results=$(option_value "$@")
      results=$(absolute_path "$results")
      shift
      ;;
    --context)
      context=$(option_value "$@")
      shift
      ;;
    --no-install) install=no ;;
    -h | --help)
      usage
      exit 0
      ;;
    *) unknown_option "$1" ;;
  esac
  shift
done

cache=$(cache_folder)
export HLODBENCH_CACHE=$cache # the scene files name the dragon by it
results=${results:-$root/results/runs/$(date -u +%Y%m%dT%H%M%SZ)}
[ ! -e "$results" ] || die 2 "--out: $results already exists; name another folder"
exit_on_signals
ensure_dependencies "$install"
configure release
build release hlodbench
program=$root/build/release/bench/hlodbench
mkdir -p -- "$cache"
"$root/scripts/fetch_dragon.sh" >&2

folders=()
# replay SCENE PRESET SIZE HIERARCHY OPTION...
replay() {
  local scene=$1 preset=$2 size=$3 hierarchy=$4
  shift 4
  local out=$results/$scene.$preset.$size
  say "Replaying $scene, $preset, $size"
  "$program" run --scene "$hierarchy" --session "$root/sessions/$scene.session.json" \
    --size "$size" --context "$context" --repetitions "$repetitions" --out "$out" "$@" >&2
  folders+=("$out")
}

# is_software HIERARCHY: whether a software rasteriser draws, seen by a short replay.
is_software() {
  local probe software=no
  probe=$(mktemp -d)
  "$program" run --scene "$1" --session "$root/sessions/courtyard.session.json" --size 64x48 \
    --strategy bool --images none --context "$context" --out "$probe/run" 2>/dev/null || software=unknown
  ! grep -q 'software rasteriser' "$probe/run/run.json" 2>/dev/null || software=yes
  rm -rf -- "$probe"
  [ "$software" = unknown ] && die 3 "no usable OpenGL by --context $context; see 'Running' in docs/building.md"
  [ "$software" = yes ]
}

"$program" build "$root/sessions/courtyard.scene.json" -o "$cache/courtyard.hlod" >&2
if [ "${HLODBENCH_SOFTWARE:-no}" != yes ] && is_software "$cache/courtyard.hlod"; then
  die 3 "no GPU: a software rasteriser draws; see 'Running' in docs/building.md"
fi
mkdir -p -- "$results"
for scene in scene1 scene2; do
  for preset in paper best; do
    hierarchy=$cache/$scene.hlod
    options=()
    if [ "$preset" = best ]; then
      hierarchy=$cache/$scene.best.hlod
      options=(--preset best)
    fi
    "$program" build "$root/sessions/$scene.scene.json" -o "$hierarchy" --preset "$preset" >&2
    for size in ${sizes//,/ }; do
      replay "$scene" "$preset" "$size" "$hierarchy" "${options[@]}"
    done
  done
done
"$program" table "${folders[@]}"
