#!/bin/sh
# usage: check_tidy.sh [FILES]
# Fails if clang-tidy finds anything, by .clang-tidy, in the files (default: all
# of source/). BUILD: the folder with compile_commands.json (default: build).
set -eu
cd "$(dirname "$0")/.."
build=${BUILD:-build}
if [ ! -f "$build/compile_commands.json" ]; then
  echo "There is no $build/compile_commands.json; configure that folder first." >&2
  exit 1
fi
if grep -q cmake_pch "$build/compile_commands.json"; then
  echo "clang-tidy cannot read GCC's precompiled headers; configure $build with -DPRECOMPILE_HEADERS=OFF." >&2
  exit 1
fi
if [ $# -eq 0 ]; then
  # shellcheck disable=SC2046
  set -- $(find source -name '*.cc' | sort)
fi
status=0
for file in "$@"; do
  clang-tidy --quiet -p "$build" --warnings-as-errors='*' "$file" \
    2> /dev/null || status=1
done
exit $status
