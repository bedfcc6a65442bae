#!/bin/sh
# tests/fresh.sh bookworm|trixie [MIRROR]: the two commands of the README on a fresh Debian of that name,
# made by debootstrap in a temporary folder ($TMPDIR) and removed afterwards; prints how long each took.
# MIRROR: the source of packages; by default the first of the sources that apt has on this machine.
# The fresh system only knows of this one how it reaches the mirror ($TMPDIR does not exist there).
# Must run as root. Exits with 77 (skipped) if debootstrap is missing or the user is not root.
set -e
cd "$(dirname "$0")/.."
suite=${1:?bookworm or trixie}
command -v debootstrap >/dev/null || { echo "skipped: debootstrap is missing (package debootstrap)"; exit 77; }
[ "$(id -u)" -eq 0 ] || { echo "skipped: a fresh system is made as root"; exit 77; }
mirror=${2:-$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
  sed -n 's/^\(deb\|URIs:\) .*\(http[^ ]*\/debian\/*\)\( .*\)\{0,1\}$/\2/p' | head -n 1)}
root=$(mktemp -d)
chmod 755 "$root" # others than root read the system as well
leave() {
  umount "$root/proc" "$root/dev" 2>/dev/null || :
  rm -rf --one-file-system "$root"
}
trap leave EXIT
trap 'exit 130' INT TERM
minutes() { # minutes WHAT COMMAND...
  what=$1 begun=$(date +%s)
  shift
  "$@" >"$root.log" 2>&1 || { tail -n 40 "$root.log"; echo "$suite: $what failed"; exit 1; }
  took=$(($(date +%s) - begun))
  printf '%s: %s took %d min %02d s\n' "$suite" "$what" $((took / 60)) $((took % 60))
}
minutes debootstrap debootstrap --variant=minbase "$suite" "$root" "${mirror:?no mirror of Debian known}"
# settings by which this machine reaches the mirror
cp /etc/resolv.conf "$root/etc/"
apt-config dump | grep '^Acquire::\(http\|https\|ftp\|Check-\)' >"$root/etc/apt/apt.conf.d/90host" || :
mount --bind /dev "$root/dev"
mount -t proc proc "$root/proc"
mkdir "$root/gridshell"
git ls-files -z | xargs -0 tar -c | tar -x -C "$root/gridshell"
minutes "app/run.sh" env -u TMPDIR chroot "$root" /gridshell/app/run.sh
ls "$root/gridshell/out/s1_actuation/movie.mp4" >/dev/null
minutes "tests/run.sh" env -u TMPDIR chroot "$root" /gridshell/tests/run.sh
grep 'tests passed' "$root.log"
rm "$root.log"
