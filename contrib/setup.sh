#!/bin/sh
# Installs what building, testing and plotting need (Debian 12 or 13,
# Ubuntu 24.04), unless it is there already, then configures and builds.
# Says on standard error what it does, and how far it is.
# usage: contrib/setup.sh [BUILD_FOLDER]      (default: build)
# environment: BUILD_TYPE (Release), WARNINGS_AS_ERRORS (OFF), SANITIZE (OFF),
# PYTHON_MODULE (as before, at first OFF), JOIN_UNITS (as before, at first ON:
# 2/3 of the time of a first build, but a change compiles its neighbours, too),
# JOBS (all cores)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$root/build}
packages="libdeal.ii-dev libgmsh-dev libboost-program-options-dev
  nlohmann-json3-dev zlib1g-dev cmake g++ make
  clang-format python3 python3-matplotlib openmpi-bin python3-jsonschema
  python3-sphinx python3-myst-parser libjs-mathjax
  pybind11-dev python3-dev python3-numpy"

say() {
  echo "$*" >&2
}

missing=
for package in $packages; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
    missing="$missing $package"
done
sudo=
[ "$(id -u)" = 0 ] || sudo=sudo
if [ -n "$missing" ]; then
  say "Installing packages:$missing"
  $sudo apt-get update -qq
  # shellcheck disable=SC2086
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    --no-install-recommends $missing >/dev/null
fi
# Debian 13: what deal.II was linked with, its programs ask for, too
if grep -qs 'fuse-ld=mold' /usr/share/cmake/deal.II/*.cmake \
    /usr/lib/*/cmake/deal.II/*.cmake && ! command -v mold >/dev/null; then
  say "Installing packages: mold"
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    --no-install-recommends mold >/dev/null
fi

if [ ! -e "$build/CMakeCache.txt" ]; then
  say "Configuring"
  JOIN_UNITS=${JOIN_UNITS:-ON}
fi
cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE="${BUILD_TYPE:-Release}" \
  -DWARNINGS_AS_ERRORS="${WARNINGS_AS_ERRORS:-OFF}" \
  -DSANITIZE="${SANITIZE:-OFF}" \
  ${PYTHON_MODULE:+-DPYTHON_MODULE="$PYTHON_MODULE"} \
  ${JOIN_UNITS:+-DJOIN_UNITS="$JOIN_UNITS"} >"$root/cmake.log" 2>&1 ||
  { cat "$root/cmake.log"; exit 1; }
mv "$root/cmake.log" "$build/cmake.log"
# files that are not there yet, or that make finds to be old
objects=$(grep -c '"file":' "$build/compile_commands.json" || true)
built=$(find "$build" -name '*.o' | wc -l)
old=$(make -C "$build" -n -k --no-print-directory 2>/dev/null |
  grep -c '"Building ' || true)
files=$((objects - built))
[ "$files" -ge "$old" ] || files=$old
{
  code=0
  cmake --build "$build" -j "${JOBS:-$(nproc)}" 2>&1 || code=$?
  echo "exit $code"
} | "$root/contrib/build_progress.sh" "$files"
