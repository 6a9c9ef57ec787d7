#!/bin/sh
# Sets up the machine and builds if needed, then measures what doc/performance.md
# tells: rates, growth, ranks, run time against error, the published way.
# usage: contrib/benchmark.sh [SECTION...]        (default: all; an hour)
# environment: BUILD (build), YARDSTICK: folder with programs `q4` and `h8` that
# print rates of hand-written loops, to compare with in the same run
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$root/build}
"$root/contrib/setup.sh" "$build"
exec /usr/bin/python3 "$root/contrib/benchmark.py" "$build/keyblock" "$@"
