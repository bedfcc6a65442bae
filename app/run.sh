#!/bin/sh
# app/run.sh [ARGUMENTS]: installs missing packages, builds, and runs gridshell with the arguments;
# without arguments it makes Movie S1 in out/s1_actuation.
set -e
start=$PWD
cd "$(dirname "$0")/.."
root=$PWD
. app/setup.sh
install_packages
case "${1:-}" in
view) build gridshell_window ;; # the window is a program of its own, which takes longer to build
esac
build gridshell
finish_packages
[ $# -gt 0 ] || set -- movie s1_actuation -o "$root/out/s1_actuation"
# paths in the arguments are relative to the folder in which the user started this script
cd "$start"
exec "$root/build/gridshell" "$@"
