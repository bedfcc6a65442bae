#!/bin/sh
# tests/images/visits.sh PROGRAM FOLDER [OPTIONS]: what the window shows at the end of each visit
# that is recorded in visits, as FOLDER/window/NAME.png.
set -e
program=$1 folder=$2 here=$(dirname "$0")
shift 2
mkdir -p "$folder/window"
for visit in "$here"/visits/*.txt; do
  "$program" view --play "$visit" --shot "$folder/window/$(basename "$visit" .txt).png" "$@" >/dev/null
done
