#!/bin/sh
# tests/images/draw.sh PROGRAM FOLDER [NAME...]: runs the program with the arguments that list.txt has for
# each NAME. The run with its pictures is written to FOLDER/NAME, what the program prints to FOLDER/NAME.txt.
# For the name `window` it draws what the window shows at the end of each visit recorded in visits:
# FOLDER/window/VISIT.png. Without names it makes all of them. The program also gets the options of $OPTIONS.
# To make the pictures the new references:
#   PROGRAM compare tests/images FOLDER --selected --update --why "..."
set -e
program=$1 folder=$2 here=$(dirname "$0")
shift 2
mkdir -p "$folder"
# shellcheck disable=SC2046
[ $# -gt 0 ] || set -- $(sed -n 's/^\([a-z][^:]*\):.*/\1/p' "$here/list.txt") window
for name in "$@"; do
  rm -rf "${folder:?}/$name" "$folder/$name.txt"
  if [ "$name" = window ]; then
    mkdir "$folder/window"
    for visit in "$here"/visits/*.txt; do
      # shellcheck disable=SC2086
      "$program" view --play "$visit" --shot "$folder/window/$(basename "$visit" .txt).png" $OPTIONS >/dev/null
    done
  else
    arguments=$(sed -n "s/^$name: //p" "$here/list.txt")
    # shellcheck disable=SC2086
    "$program" ${arguments:?no line of that name in list.txt} -o "$folder/$name" $OPTIONS >"$folder/$name.txt"
  fi
done
