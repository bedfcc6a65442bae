#!/bin/sh
# presets/pictures/cards.sh PROGRAM [PRESET...]: draws what the window shows presets by, of all of
# them or of those named, into presets/pictures/cards. A preset without a shell gets none.
program=$1 here=$(dirname "$0")
shift
[ $# -gt 0 ] || set -- $(cd "$here/.." && ls ./*.toml | sed 's/^..//; s/\.toml$//')
mkdir -p "$here/cards"
for preset; do
  "$program" view "$preset" --picture "$here/cards/$preset.png" --size 256x160 --bare >/dev/null
done
