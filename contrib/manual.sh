#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Makes the manual, HTML with a search, from doc/ by Sphinx and MyST (Debian:
# python3-sphinx, python3-myst-parser). With libjs-mathjax there the formulas need
# no network. A warning is an error.
# usage: contrib/manual.sh [--pdf] [FOLDER]      (default: build/manual)
# Open FOLDER/index.html. --pdf also prints all pages to FOLDER/keyblock.pdf, with
# chromium. Exits with 77 if there is no Sphinx, or no MyST, so that a test can skip.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
pdf=
case ${1:-} in
  -h | --help) sed -n '3,9s/^# //p' "$0"; exit 0 ;;
  --pdf) pdf=yes; shift ;;
esac
folder=${1:-$root/build/manual}
# the system's Python has them, another one in PATH need not
build=$(PATH=/usr/bin:$PATH command -v sphinx-build) &&
  $(sed -n '1s/^#!//p' "$build") -c 'import myst_parser' 2>/dev/null || {
  echo "manual.sh: there is no Sphinx or no MyST; install python3-sphinx and python3-myst-parser." >&2
  exit 77
}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
"$build" -q -W --keep-going -b html -d "$folder/.doctrees" "$root/doc" "$folder"
echo "$folder/index.html"
[ -n "$pdf" ] || exit 0
command -v chromium >/dev/null || {
  echo "manual.sh: there is no chromium to print with; install it, or print from a browser." >&2
  exit 1
}
"$build" -q -W --keep-going -b singlehtml -d "$folder/.doctrees" "$root/doc" "$folder/single"
chromium --headless --no-sandbox --disable-gpu --virtual-time-budget=120000 \
  --no-pdf-header-footer --print-to-pdf="$folder/keyblock.pdf" \
  "file://$folder/single/index.html" >/dev/null 2>&1
rm -r "$folder/single"
echo "$folder/keyblock.pdf"
