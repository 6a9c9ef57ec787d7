#!/bin/sh
# Builds and tests on another release of Debian, in a folder of its own.
# usage: contrib/test_debian.sh SUITE [FOLDER] [ctest options]
#   SUITE    bookworm, trixie, ...
#   FOLDER   of that system, made if it is not there (/var/tmp/keyblock-SUITE)
# Options take the place of those that choose the labels quick and ranks.
# environment: MIRROR (http://deb.debian.org/debian), JOBS (all cores).
# Needs root and debootstrap. The system stays for the next call; to be rid of it,
# remove the folder.
set -eu
suite=${1:?"usage: contrib/test_debian.sh SUITE [FOLDER] [ctest options]"}
shift
system=/var/tmp/keyblock-$suite
case ${1:-} in
  /*) system=$1; shift ;;
esac
root=$(cd "$(dirname "$0")/.." && pwd)
if [ ! -e "$system/etc/debian_version" ]; then
  debootstrap --variant=minbase "$suite" "$system" \
    "${MIRROR:-http://deb.debian.org/debian}"
fi

leave() {
  umount "$system/sys" "$system/proc" "$system/dev/pts" "$system/dev/shm" \
    "$system/dev" 2>/dev/null || true
}
trap leave EXIT
mount --bind /dev "$system/dev"
mount -t tmpfs none "$system/dev/shm"
mount --bind /dev/pts "$system/dev/pts"
mount -t proc none "$system/proc"
mount -t sysfs none "$system/sys"

# the checkout as it is, without what was built from it
mkdir -p "$system/keyblock"
find "$system/keyblock" -mindepth 1 -maxdepth 1 ! -name 'build*' \
  -exec rm -rf {} +
[ $# -gt 0 ] || set -- -L '^(quick|ranks)$'
tar -C "$root" --exclude='./build*' --exclude='./.git' -c . |
  tar -C "$system/keyblock" -x
chroot "$system" env JOBS="${JOBS:-$(nproc)}" HOME=/root LC_ALL=C.UTF-8 OMPI_MCA_btl=^tcp \
  TMPDIR=/tmp sh -c '
    cd /keyblock && PYTHON_MODULE=ON contrib/setup.sh && cd build &&
    ctest --output-on-failure -j "$JOBS" --timeout 120 "$@"' sh "$@"
