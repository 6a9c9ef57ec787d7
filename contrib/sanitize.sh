#!/bin/sh
# Builds with the address and the undefined-behaviour sanitizer and runs the
# tests under them: a crash, or a line of a report, fails a test.
# usage: contrib/sanitize.sh [ctest options]      (default: labels quick and ranks)
# environment: BUILD (build-sanitized)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$root/build-sanitized}
# MPI and PETSc keep what they allocate until the end
export SANITIZE=ON ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
"$root/contrib/setup.sh" "$build"
cd "$build"
[ $# -gt 0 ] || set -- -L '^(quick|ranks)$'
exec ctest --output-on-failure --timeout 3000 "$@"
