#!/bin/sh
# Fails if a source file is not formatted as .clang-format says.
set -eu
cd "$(dirname "$0")/.."
files=$(find source include tests -name '*.cc' -o -name '*.h')
# shellcheck disable=SC2086
clang-format --dry-run --Werror $files
