# shellcheck shell=bash
# What the scripts of this folder share; sourced, never run. The caller has set $root, the folder of
# the repository. Everything is said on stderr: stdout belongs to results.

# say MESSAGE...: one line on stderr.
say() { printf '%s\n' "$*" >&2; }

# die CODE MESSAGE...: one line on stderr, then the end.
die() {
  local code=$1
  shift
  say "${0##*/}: $*"
  exit "$code"
}

# usage: prints the comment at the top of the script that runs, which is its help text.
usage() { sed -n '2,/^[^#]/{s/^# \{0,1\}//p}' "$0"; }

# unknown_option TEXT: ends with the code for wrong usage.
unknown_option() { die 2 "unknown option or argument '$1'; see ${0##*/} --help"; }

# option_value OPTION [VALUE...]: prints VALUE, or ends if there is none.
option_value() {
  [ -n "${2-}" ] || die 2 "$1 expects a value; see ${0##*/} --help"
  printf '%s\n' "$2"
}

# repetitions_value OPTION [VALUE...]: prints VALUE, or ends unless it is a number of repetitions.
repetitions_value() {
  local value
  value=$(option_value "$@") || exit
  [[ $value =~ ^[1-9][0-9]{0,3}$ ]] || die 2 "$1 expects a number from 1 to 9999, not '$value'"
  printf '%s\n' "$value"
}

# absolute_path PATH: PATH seen from the working directory; it need not exist.
absolute_path() {
  case $1 in
    /*) printf '%s\n' "$1" ;;
    *) printf '%s/%s\n' "$PWD" "$1" ;;
  esac
}

# cache_folder: where hierarchies and fetched models are kept between runs.
cache_folder() { absolute_path "${HLODBENCH_CACHE:-$root/.cache}"; }

# exit_on_signals: lets an interrupted script run its EXIT trap and end with the usual code.
exit_on_signals() {
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
}

# is_debian: whether Debian's package tools are here.
is_debian() { command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; }

# missing_packages NAME...: those of the Debian packages that are not installed, one a line.
missing_packages() {
  local installed name
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
    sed -n 's/ installed$//p') || true
  for name in "$@"; do
    grep -qxF -- "$name" <<<"$installed" || printf '%s\n' "$name"
  done
}

# ensure_dependencies INSTALL [OPTION...]: installs what is missing when INSTALL is yes, and only
# checks otherwise. Elsewhere than on Debian CMake names what is missing.
ensure_dependencies() {
  local install=$1
  shift
  if [ "$install" = yes ] && is_debian; then
    "$root/scripts/install_dependencies.sh" "$@" >&2
  else
    "$root/scripts/install_dependencies.sh" --no-install "$@" >&2
  fi
}

# quietly COMMAND...: runs it and shows what it printed only if it fails.
quietly() {
  local output code=0
  output=$("$@" 2>&1) || code=$?
  [ "$code" -eq 0 ] || say "$output"
  return "$code"
}

# The system's Python is preferred: it is the one that sees Debian's Python packages.
python=${HLODBENCH_PYTHON:-/usr/bin/python3}
[ -x "$python" ] || python=$(command -v python3 || echo python3)

# configure PRESET: writes build/PRESET.
configure() {
  local -a options=(--preset "$1" -DPython3_EXECUTABLE="$python")
  (cd "$root" && quietly cmake "${options[@]}") || die 2 "CMake could not configure build/$1 (above)"
}

# build PRESET [TARGET]: compiles it, or one target of it.
build() {
  local -a options=(--build "$root/build/$1")
  [ $# -lt 2 ] || options+=(--target "$2")
  cmake "${options[@]}" >&2 || die 1 "build/$1 could not be compiled (above)"
}
