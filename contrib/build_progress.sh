#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Reads what make or ninja says, and tells how far the build is: on a terminal in
# one line that changes, else once every tenth. What compilers say is passed on as
# it is. Exits with what a last line `exit CODE` says. All goes to standard error.
# usage: { cmake --build build 2>&1; echo "exit $?"; } | contrib/build_progress.sh FILES
#   FILES  how many are to be built, if known; ninja tells it
set -eu
total=${1:-0}
n=0
tenths=0
code=1 # what was broken off says nothing
begin=$(date +%s)
terminal=
[ -t 2 ] && terminal=yes

# seconds since the begin, as people say it
elapsed() {
  seconds=$(($(date +%s) - begin))
  if [ "$seconds" -lt 60 ]; then
    echo "$seconds s"
  else
    echo "$((seconds / 60)) min $((seconds % 60)) s"
  fi
}

clear_line() {
  [ -z "$terminal" ] || printf '\r\033[K' >&2
}

tell() {
  [ "$n" -le "$total" ] || total=$n
  if [ -n "$terminal" ]; then
    clear_line
    printf 'Building %s of %s, %s' "$n" "$total" "$(elapsed)" >&2
  elif [ "$n" = 1 ] || [ $((10 * n / total)) -gt "$tenths" ]; then
    tenths=$((10 * n / total))
    echo "Building $n of $total, $(elapsed)" >&2
  fi
}

while IFS= read -r line; do
  case $line in
    "exit "[0-9]*)
      code=${line#exit }
      ;;
    "["[0-9]*/[0-9]*"] "*)
      n=${line#\[}; total=${n#*/}; n=${n%%/*}; total=${total%%\]*}
      tell
      ;;
    "["*%"] Building "*)
      n=$((n + 1))
      tell
      ;;
    "["*%"] "* | "Consolidate compiler generated"* | "Scanning dependencies"* | \
      "ninja: "*"no work to do."*) ;;
    *)
      clear_line
      printf '%s\n' "$line" >&2
      ;;
  esac
done
clear_line
[ "$n" = 0 ] || [ "$code" != 0 ] || echo "Built in $(elapsed)" >&2
exit "$code"
