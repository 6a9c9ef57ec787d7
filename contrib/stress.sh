#!/bin/sh
# Sets up the machine and builds if needed, then runs scenes made to break the
# program, and mutated input files; writes doc/stability.md.
# usage: contrib/stress.sh [--files N]      (mutated files of each kind: 1000)
# environment: BUILD (build)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$root/build}
"$root/contrib/setup.sh" "$build"
exec /usr/bin/python3 "$root/contrib/stress.py" "$build/keyblock" "$@"
