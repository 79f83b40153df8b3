#!/usr/bin/env bash
# Usage: scripts/reproduce.sh [--paper] [OPTION...]
#
# Reproduces Table 1 of Charalambos, Bittner, Wimmer and Romero, "Optimized HLOD Refinement Driven
# by Hardware Occlusion Queries" (ISVC 2007): installs what is missing, builds hlodbench, builds the
# hierarchy of a scene, replays a recorded camera session with the four strategies bool, sw-b,
# simp-b and coh-b, and prints the table as Markdown on stdout. All else is said on stderr. It ends by
# making a report (one HTML file to open in a browser: tables, plots, pictures) and the figures.
#
#   (no option)        the courtyard, a scene that hlodbench makes itself; nothing is downloaded
#                      but missing Debian packages
#   --paper            scenes 1 and 2 as in the paper, of copies of the Stanford dragon, which
#                      scripts/fetch_dragon.sh downloads (11 MB; its terms: fetch_dragon.sh --help)
#   --repetitions N    how often each session is replayed (1 for the courtyard, 5 with --paper)
#   --out DIR          put everything into DIR instead of results/runs/UTCTIME: the records in
#                      DIR/SCENE, DIR/report.html and DIR/figures, none of which may exist yet
#   --context NAME     how to get OpenGL: auto, egl or osmesa (auto)
#   --no-install       install no package; end with code 2 if one is missing
#   --help             this text
#
# Needs no GPU, screen or X server: without a GPU Mesa's software renderer draws. On two cores and
# no GPU the courtyard takes four to five minutes the first time, under two later; --paper about half
# an hour. A line with the time passed and the usual time left is printed for every step. What is
# already built is kept.
#
# Writes only into the repository's folder: build/release (about 100 MB), .cache with hierarchies
# and models (about 100 MB; with --paper about 3 GB; HLODBENCH_CACHE names another place), and the
# results (20 to 60 MB, most of it pictures). Ctrl-C is safe: unfinished records are removed, finished steps stay.
#
# HLODBENCH_PYTHON names the Python that sees the packages, /usr/bin/python3 where there is one.
#
# Exit codes: 0 all was made; 1 a build, a check, the report or a figure failed; 2 wrong usage, missing package
# or bad input; 3 no usable OpenGL; 130 interrupted.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
# shellcheck source=scripts/lib.sh
. "$root/scripts/lib.sh"

readonly strategies=bool,sw-b,simp-b,coh-b
readonly gl_packages=(libegl1 libegl-mesa0 libgl1-mesa-dri)

# Usual seconds on two cores and no GPU; they only weigh the steps in the estimate of the time left.
readonly compile_seconds=120 fetch_seconds=30
hierarchy_seconds() {
  case $1 in
    courtyard) echo 12 ;;
    scene1) echo 45 ;;
    *) echo 120 ;;
  esac
}
repetition_seconds() {
  case $1 in
    courtyard) echo 45 ;;
    scene1) echo 95 ;;
    *) echo 140 ;;
  esac
}
picture_seconds() {
  case $1 in
    courtyard) echo 15 ;;
    scene1) echo 30 ;;
    *) echo 50 ;;
  esac
}
replay_seconds() { echo $((repetitions * $(repetition_seconds "$1") + $(picture_seconds "$1"))); }
readonly report_seconds=25

# begin_step SECONDS TITLE: says how far we are; SECONDS is what the step usually takes.
begin_step() {
  end_step
  step_number=$((step_number + 1))
  step_seconds=$1
  step_start=$SECONDS
  local left=$((planned_seconds * pace / 100 / 60))
  say "[$((SECONDS / 60)) min $((SECONDS % 60)) s] $step_number/$step_count $2" \
    "(about $((left + 1)) min left)"
}

# end_step: the steps that really worked tell how fast this machine is; cached ones do not.
end_step() {
  local taken=$((SECONDS - step_start))
  planned_seconds=$((planned_seconds - step_seconds))
  if [ "$step_seconds" -gt 0 ] && [ "$taken" -gt 10 ]; then
    worked_seconds=$((worked_seconds + taken))
    usual_seconds=$((usual_seconds + step_seconds))
    pace=$((worked_seconds * 100 / usual_seconds))
  fi
}
step_number=0 step_seconds=0 step_start=0 worked_seconds=0 usual_seconds=0 pace=100

# bench ARGUMENT...: runs hlodbench; its failure is ours.
bench() {
  local code=0
  "$root/build/release/bench/hlodbench" "$@" || code=$?
  [ "$code" -ne 3 ] || explain_missing_gl
  [ "$code" -eq 0 ] || exit "$code"
}

explain_missing_gl() {
  if ! is_debian; then
    say "No usable OpenGL: see 'Running' in docs/building.md"
    return
  fi
  local missing
  missing=$(missing_packages "${gl_packages[@]}" | tr '\n' ' ')
  if [ -n "$missing" ]; then
    say "No usable OpenGL; missing packages: $missing"
  else
    say "No usable OpenGL although ${gl_packages[*]} are installed; see docs/building.md"
  fi
}

# replay SCENE: one session with all strategies. The records appear in their place when complete.
replay() {
  local records=$results/$1
  local -a context_option=()
  [ "$context" = auto ] || context_option=(--context "$context")
  mkdir -p -- "${records%/*}"
  partial=$(mktemp -d "${records%/*}/.$1.XXXXXX")
  chmod 755 "$partial"
  bench run --scene "$cache/$1.hlod" --session "$root/sessions/$1.session.json" \
    --strategy "$strategies" --repetitions "$repetitions" "${context_option[@]}" \
    --overlay bias --out "$partial" >&2
  mv -T -- "$partial" "$records"
  partial=
}

clean_up() {
  [ -z "$partial" ] || rm -rf -- "$partial"
  [ ! -d "$results" ] || rmdir --ignore-fail-on-non-empty -- "$results"
}

# make_pages: the report and the figures; without them the records and the table stay.
make_pages() {
  local program=$root/build/release/bench/hlodbench failed=no
  "$python" "$root/scripts/report.py" "${folders[@]}" --hlodbench "$program" \
    --out "$results/report.html" >&2 || failed=yes
  "$python" "$root/scripts/figures.py" "${folders[@]}" --hlodbench "$program" \
    --out "$results/figures" >&2 || failed=yes
  [ "$failed" = no ]
}

paper=no install=yes repetitions='' results='' context=auto partial=''
while [ $# -gt 0 ]; do
  case $1 in
    --paper) paper=yes ;;
    --no-install) install=no ;;
    --repetitions)
      repetitions=$(repetitions_value "$@")
      shift
      ;;
    --out)
      results=$(option_value "$@")
      results=$(absolute_path "$results")
      shift
      ;;
    --context)
      context=$(option_value "$@")
      case $context in
        auto | egl | osmesa) ;;
        *) die 2 "--context expects auto, egl or osmesa, not '$context'" ;;
      esac
      shift
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    *) unknown_option "$1" ;;
  esac
  shift
done

if [ "$paper" = yes ]; then
  scenes=(scene1 scene2)
  repetitions=${repetitions:-5}
else
  scenes=(courtyard)
  repetitions=${repetitions:-1}
fi
cache=$(cache_folder)
export HLODBENCH_CACHE=$cache # the scene files name the dragon by it

results=${results:-$root/results/runs/$(date -u +%Y%m%dT%H%M%SZ)}
folders=()
step_count=$((2 + 2 * ${#scenes[@]}))
planned_seconds=$((compile_seconds + report_seconds))
for scene in "${scenes[@]}"; do
  folders+=("$results/$scene")
  planned_seconds=$((planned_seconds + $(hierarchy_seconds "$scene") + $(replay_seconds "$scene")))
done
for made in "${folders[@]}" "$results/report.html" "$results/figures"; do
  [ ! -e "$made" ] || die 2 "--out: $made already exists; name another folder"
done
if [ "$paper" = yes ]; then
  step_count=$((step_count + 1))
  planned_seconds=$((planned_seconds + fetch_seconds))
fi

exit_on_signals
trap clean_up EXIT

ensure_dependencies "$install"
begin_step "$compile_seconds" "Building hlodbench in build/release"
configure release
build release hlodbench

mkdir -p -- "$cache"
if [ "$paper" = yes ]; then
  begin_step "$fetch_seconds" "Fetching the Stanford dragon"
  "$root/scripts/fetch_dragon.sh" >&2
fi
for scene in "${scenes[@]}"; do
  begin_step "$(hierarchy_seconds "$scene")" "Building the hierarchy of $scene"
  bench build "$root/sessions/$scene.scene.json" -o "$cache/$scene.hlod" >&2
done
for scene in "${scenes[@]}"; do
  begin_step "$(replay_seconds "$scene")" \
    "Replaying $scene $repetitions times with $strategies"
  replay "$scene"
done

begin_step "$report_seconds" "Making the report and the figures"
pages=made
make_pages || pages=failed

bench table "${folders[@]}" --format markdown
say "Done in $((SECONDS / 60)) min $((SECONDS % 60)) s. Records in:"
for folder in "${folders[@]}"; do
  say "  $folder"
done
[ "$pages" = made ] || die 1 "the report or a figure could not be made (above)"
say "Open in a browser: $results/report.html"
say "Figures: $results/figures"
