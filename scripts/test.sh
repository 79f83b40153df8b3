#!/usr/bin/env bash
# Usage: scripts/test.sh [--fast] [--no-install]
#
# Installs the missing Debian packages, builds hlodbench with its tests, runs every test, then
# builds the unit tests with the address and undefined-behaviour sanitizers and runs them too.
# ctest's summaries of both stand at the end. What is already built is kept.
#
# The build is build/dev, or build/ci where the variable CI is "true": as users get it, and with
# compiler warnings as errors. Some tests read large meshes (*.ply, *.ply.zst) from the folder that
# HLODBENCH_MODELS names; without it they are reported as skipped.
#
#   --fast        without the sanitizers
#   --no-install  install no package; end with code 2 if one is missing
#   --help        this text
#
# Exit codes: 0 all passed; 1 a build or a test failed; 2 wrong usage or a missing package;
# 130 interrupted.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
# shellcheck source=scripts/lib.sh
. "$root/scripts/lib.sh"

# run_tests PRESET [CTEST OPTION...]: runs ctest and keeps its summary for the end.
run_tests() {
  local preset=$1 log="$root/build/$1/ctest.log"
  shift
  ctest --test-dir "$root/build/$preset" --output-on-failure --no-tests=error \
    --parallel "$(nproc)" --timeout 600 "$@" 2>&1 | tee "$log" || failed=yes
  summaries+="== $preset"$'\n'$(sed -n '/tests passed,/,$p' "$log")$'\n'
}

fast=no install=yes failed=no summaries=''
while [ $# -gt 0 ]; do
  case $1 in
    --fast) fast=yes ;;
    --no-install) install=no ;;
    -h | --help)
      usage
      exit 0
      ;;
    *) unknown_option "$1" ;;
  esac
  shift
done
preset=dev
[ "${CI:-}" != true ] || preset=ci
exit_on_signals

ensure_dependencies "$install" --tests
say "[$SECONDS s] Building build/$preset"
configure "$preset"
build "$preset"
say "[$SECONDS s] Running all tests"
run_tests "$preset"

if [ "$fast" = no ]; then
  say "[$SECONDS s] Building the unit tests with sanitizers in build/asan-ubsan"
  configure asan-ubsan
  build asan-ubsan unit_tests
  say "[$SECONDS s] Running the unit tests with sanitizers"
  export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1:halt_on_error=1}
  run_tests asan-ubsan --label-regex '^unit$'
fi

say "[$SECONDS s] Done"
printf '\n%s' "$summaries"
[ "$failed" = no ] || exit 1
