#!/bin/sh
# Sets up the machine and builds if needed, then runs a scene.
# Says on standard error what it does.
# usage: contrib/run.sh [options] SCENE.prm       (options as for keyblock)
# environment: RANKS (1), BUILD (build)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$root/build}
"$root/contrib/setup.sh" "$build"
ranks=${RANKS:-1}
if [ "$ranks" = 1 ]; then
  set -- "$build/keyblock" "$@"
else
  set -- mpirun --allow-run-as-root --oversubscribe -n "$ranks" \
    "$build/keyblock" "$@"
fi
echo "Running $*" >&2
exec "$@"
