#!/bin/sh
# Sets up the machine and builds if needed, then runs the tests.
# usage: contrib/test.sh [--all | CTEST_OPTIONS...]
#   The tests with the labels quick and ranks; --all: those of all labels. Options
#   take the place of the labels: contrib/test.sh -L nightly, contrib/test.sh -R bolt
# environment: BUILD (build), JOBS (all cores), WARNINGS_AS_ERRORS (OFF)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$root/build}
PYTHON_MODULE=ON "$root/contrib/setup.sh" "$build"
"$root/contrib/check_format.sh"
if [ $# = 0 ]; then
  set -- -L '^(quick|ranks)$'
elif [ "$1" = --all ]; then
  shift
fi
# ranks of tests share a machine: Open MPI need not look for networks each time
export OMPI_MCA_pml="${OMPI_MCA_pml:-ob1}"
# runs that end remove the folder of Open MPI's sessions while others begin to use it:
# it stays as long as something is in it
sessions=$(mktemp -d)
trap 'rm -rf "$sessions"' EXIT
mkdir -p "$sessions/ompi.$(hostname -s).$(id -u)/jf.0/keep"
export OMPI_MCA_orte_tmpdir_base="$sessions"
cd "$build"
code=0
ctest --output-on-failure -j "${JOBS:-$(nproc)}" "$@" || code=$?
echo
echo "The ten longest tests [s]:"
awk '/^[0-9]+\/[0-9]+ Testing: / { name = $3 } /^Test time = / { print $4, name }' \
  Testing/Temporary/LastTest.log | sort -rn | sed 10q
exit $code
