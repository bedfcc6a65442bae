#!/bin/sh
# presets/pictures/draw.sh PROGRAM [NAME...]: draws the pictures of README, accuracy.md and gallery into
# presets/pictures: those named, as `s1_actuation`, `cards` or `cards/timber_dome`, or all, which takes an hour.
# A card is what the window shows of a preset. The pictures of the tutorials are made by
# their own commands (DRAW=1 tests/manual.sh), `anatomy.svg` and `symbols.svg` by anatomy.py. $TO: another folder.
set -e
program=$(realpath "$1") here=$(cd "$(dirname "$0")" && pwd)
shift
[ $# -gt 0 ] || set -- s1_actuation s2_indentation lit_rigidity fig2_phase_diagram accuracy stability cards
at=$(mktemp -d)
to=${TO:-$here}
trap 'rm -rf "$at" "$picture.part"' EXIT
mkdir -p "$to/cards"
copy() {  # no incomplete picture has a final name
  cp "$1" "$picture.part"
  mv "$picture.part" "$picture"
}
for name; do
  picture=$to/$name.png
  case $name in
    cards)
      for preset in "$here"/../*.toml; do "$0" "$program" "cards/$(basename "$preset" .toml)"; done
      ;;
    cards/*) "$program" view "${name#cards/}" --picture "$picture" --size 256x160 --bare >/dev/null ;;
    s1_actuation | s2_indentation)
      "$program" movie "$name" --frames 24 --size 800x450 --quiet -o "$at/$name"
      copy "$(ls "$at/$name/frames/"*.png | tail -n 1)"
      ;;
    lit_rigidity | fig2_phase_diagram)
      "$program" sweep "$name" --quiet -o "$at/$name"
      case $name in
        lit_rigidity) copy "$at/$name/stiffness_N_per_mm_law.png" ;;
        *) copy "$at/$name/classes.png" ;;
      esac
      ;;
    accuracy | stability)
      "$program" chart "$name" fig1_actuation --quiet -o "$at/$name"
      copy "$at/$name/$name.png"
      ;;
    *)
      echo "$name: no picture of that name" >&2
      exit 2
      ;;
  esac
done
