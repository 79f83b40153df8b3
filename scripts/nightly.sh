#!/usr/bin/env bash
# Usage: scripts/nightly.sh [OPTION...]
#        scripts/nightly.sh accept --why TEXT [--cell CELL]... [--who NAME] [--key KEY] [--history DIR]
#        scripts/nightly.sh trend [--out FILE] [--machine KEY]... [--history DIR] [--plot-library DIR]
#
# Measures this checkout, compares it with earlier nights and with a baseline, adds the night to a
# history and says whether anything is worse (docs/nightly.md). Two tiers: exact values (nodes,
# queries, triangles, pictures, with a fixed latency), where any change is one until it is accepted;
# and times, in interleaved repetitions. A cell is SCENE/STRATEGY, such as courtyard/coh-b.
#
#   (no option)        the courtyard with bool, sw-b, simp-b, coh-b and reuse-b
#   --paper            scenes 1 and 2 of the paper instead; fetches the Stanford dragon
#   --cell CELL        only this one; may be repeated
#   --history DIR      the folder that nights are added to (results/runs/history;
#                      HLODBENCH_HISTORY names another)
#   --out DIR          put results, summary.md and exports into DIR, new or empty, instead of
#                      results/runs/nightly/UTCTIME-RANDOM
#   --baseline REV     compare times with this revision, built in build/nightly/REV; without it, with
#                      earlier nights of the same machine
#   --bisect GOOD[..BAD]  find the commit from GOOD to BAD (HEAD) at which times changed; builds
#                      commits in build/nightly, and adds nothing to the history. Not with
#                      --baseline, --baseline-program, --program or --no-times
#   --repetitions N    of the times of each cell, 9 or more (9)
#   --no-times         only the exact tier
#   --no-report        no report.html of the exact tier
#   --min-change P     least change that is called SLOW or FAST, per cent (1.5)
#   --min-traversal P  the same of the traversal alone, whose time also depends on where the compiler
#                      puts it (as --min-change)
#   --max-spread P     more spread of side-by-side runs or of the calibration is a noisy machine,
#                      per cent (15)
#   --max-others P     so is more time of the processors used by other programs, per cent (25)
#   --calibration W    numpy: a fixed workload tells how fast the processor is; none (numpy)
#   --core C           the core of the processor that timed replays run on: its number; any; or auto:
#                      the last one where a GPU draws, any with a software rasteriser (auto)
#   --machine NAME     tells machines apart that look alike
#   --context NAME     how to get OpenGL: auto, egl or osmesa (auto)
#   --seed N           of the order of the runs (1)
#   --program FILE     this hlodbench instead of building the checkout
#   --baseline-program FILE  the same for the baseline
#   --help             this text
#
# accept takes the newest night's changes for good; who and why are recorded in the history:
#   --why TEXT         the reason
#   --cell CELL        only this one; may be repeated (all that changed)
#   --who NAME         who accepts it (git's user)
#   --key KEY          of which machine: the beginning of its folder's name (the only one)
#
# trend makes one HTML file of the history, which loads nothing:
#   --out FILE         the page (results/runs/nightly/trend.html)
#   --machine KEY      only this machine: the beginning of its folder's name; may be repeated (all)
#   --plot-library DIR  has dygraph.min.js and dygraph.min.css (/usr/share/javascript/dygraphs)
#
# Safe to kill at any moment, to run twice at once (measuring waits for its turn) and from several
# machines into one history. stdout has the summary; all else is on stderr.
#
# Exit codes: 0 nothing is worse; 1 a regression: a cell is DIFFERENT or SLOW (with --bisect, BAD is
# SLOW in some cell); 2 could not run, the history is as it was; 130 interrupted.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
# shellcheck source=scripts/lib.sh
. "$root/scripts/lib.sh"

for argument; do
  case $argument in
    -h | --help)
      usage
      exit 0
      ;;
  esac
done
exec "$python" "$root/scripts/nightly.py" "$@"
