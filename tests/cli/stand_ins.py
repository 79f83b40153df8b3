"""Runs the shell scripts with small stand-ins for what they call (cmake, hlodbench, npm, ...), in a
copy at a path with spaces, so that a test builds, installs and downloads nothing."""

import pathlib
import subprocess

HLODBENCH = r"""#!/bin/bash
echo "$*" >>"$LOG"
command=$1
[ "$command" != "${FAIL_AT-}" ] || { echo partial >"${!#}/left" 2>/dev/null; exit "$FAIL_CODE"; }
while [ $# -gt 0 ]; do
  case $1 in -o | --out) target=$2 ;; esac
  shift
done
case $command in
  build) echo "50 % of $target" >&2; echo tree >"$target" ;;
  run) echo "chatter"; echo record >"$target/run.json"; [ -z "${SLOW-}" ] || sleep 30 ;;
  table) echo "| DN | RARN | D |" ;;
esac
"""
CMAKE = r"""#!/bin/bash
echo "cmake $*" >>"$LOG"
echo "-- configuring"
if [ "$1" = --build ]; then
  mkdir -p "$2/bench"
  cp "$FAKE_HLODBENCH" "$2/bench/hlodbench"
fi
"""

# python3 SCRIPT ... --out TARGET: a report or figures.
PYTHON = r"""#!/bin/bash
echo "python ${1##*/} ${*:2}" >>"$LOG"
[ "${1##*/}" != "${FAIL_AT-}" ] || exit "$FAIL_CODE"
echo made >"${!#}"
"""

# Every package is installed but those that MISSING names, separated by spaces.
DPKG_QUERY = r"""#!/bin/bash
shift 2
for name; do [[ " ${MISSING-} " = *" $name "* ]] || echo "$name installed"; done
"""


def run(*command, **options):
    options.setdefault("timeout", 60)
    return subprocess.run([*map(str, command)], capture_output=True, text=True, **options)


def add_program(folder, name, text):
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / name
    path.write_text(text)
    path.chmod(0o755)
    return path


def everything_under(folder):
    return sorted(p.relative_to(folder).as_posix() for p in folder.rglob("*"))


def add_stand_in(environment, name, text):
    """Puts a program in front of the path of an environment made by the fixture `environment`."""
    return add_program(pathlib.Path(environment["PATH"].split(":")[0]), name, text)


def calls(environment):
    """How cmake, ctest and hlodbench were called, one line each."""
    return pathlib.Path(environment["LOG"]).read_text().splitlines()
