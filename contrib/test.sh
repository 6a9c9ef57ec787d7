#!/bin/sh
# Sets up the machine and builds if needed, then runs the tests.
# usage: contrib/test.sh [ctest options]      slow tests: contrib/test.sh -C slow
# environment: BUILD (build), JOBS (all cores)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$root/build}
WARNINGS_AS_ERRORS=ON PYTHON_MODULE=ON "$root/contrib/setup.sh" "$build"
"$root/contrib/check_format.sh"
# ranks of tests share a machine: Open MPI need not look for networks each time
export OMPI_MCA_pml="${OMPI_MCA_pml:-ob1}"
cd "$build"
exec ctest --output-on-failure -j "${JOBS:-$(nproc)}" --timeout 120 "$@"
