#!/bin/sh
# app/run.sh [ARGUMENTS]: installs what is missing, builds, and runs gridshell with the arguments;
# without any it makes Movie S1 in out/s1_actuation.
set -e
start=$PWD
cd "$(dirname "$0")/.."
root=$PWD
. app/setup.sh
install_packages
case "${1:-}" in
view) build gridshell_window ;; # a program of its own, which takes longer to build
esac
build gridshell
finish_packages
[ $# -gt 0 ] || set -- movie s1_actuation -o "$root/out/s1_actuation"
# paths among the arguments are meant from the folder of the user
cd "$start"
exec "$root/build/gridshell" "$@"
