#!/bin/sh
# tests/images/draw.sh PROGRAM FOLDER [OPTIONS]: draws all that list.txt names into FOLDER, and what
# the window shows after each of visits; pictures alone. To keep them: PROGRAM compare tests/images FOLDER --update --why "..."
# RUNS=FOLDER keeps the runs that they are of.
set -e
program=$1 folder=$2 here=$(dirname "$0")
shift 2
mkdir -p "$folder"
if [ -n "$RUNS" ]; then
  work=$RUNS
  mkdir -p "$work"
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
grep -v '^#' "$here/list.txt" | while IFS=: read -r name arguments; do
  # shellcheck disable=SC2086
  "$program" $arguments -o "$work/$name" --quiet "$@" || echo "$name: exit code $?" >&2
  (cd "$work" && find "$name" -name '*.png') | while read -r kept; do
    mkdir -p "$folder/$(dirname "$kept")"
    cp "$work/$kept" "$folder/$kept"
  done
done
"$here/visits.sh" "$program" "$folder" "$@"
