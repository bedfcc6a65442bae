#!/bin/sh
# A visit to the real window under Xvfb, by xdotool: plays Movie S1, scrubs, changes R_a, pushes a joint,
# undoes the push, saves a picture and the preset, closes. The saved preset must run to the state to
# which the recording of the visit plays. Exits with 77 (skipped) where Xvfb or xdotool is missing.
# usage: tests/window.sh build/gridshell
program=$(realpath "$1")
for tool in Xvfb xdotool; do
  command -v $tool >/dev/null || { echo "no $tool: skipped"; exit 77; }
done
folder=$(mktemp -d)
cd "$folder" || exit 1
Xvfb -displayfd 3 -screen 0 1280x720x24 3>display 2>/dev/null &
server=$!
view=
cleanup() {
  [ -z "$view" ] || kill "$view" 2>/dev/null
  kill $server
  rm -rf "$folder"
}
trap cleanup EXIT
fail() { echo "$1" >&2; exit 1; }

# until_true COMMAND...: repeats the command until it succeeds, at most 20 seconds
until_true() {
  for _ in $(seq 200); do
    "$@" && return 0
    sleep 0.1
  done
  return 1
}
until_true test -s display || fail "Xvfb did not start"
export DISPLAY=":$(cat display)"

"$program" view s1_actuation --record visit.txt --workspace workspace.json -o kept 2>error.txt &
view=$!
window=$(xdotool search --sync --onlyvisible --name '^gridshell$' | head -1)
xdotool windowfocus "$window"
sleep 3

# the button is down for longer than a frame
drag() {
  xdotool mousemove "$1" "$2"; sleep 0.4
  xdotool mousedown 1; sleep 0.4
  xdotool mousemove "$3" "$4"; sleep 0.4
  xdotool mousemove "$5" "$6"; sleep 0.4
  xdotool mouseup 1; sleep 1
}
key() { xdotool key "$1"; sleep "${2:-0.6}"; }

key Home 1
key space 6        # plays to the end
drag 156 182 90 182 158 182   # scrubs back and to the end again
drag 69 226 80 226 90 226   # R_a
drag 658 277 658 287 658 297   # a joint
key ctrl+z 1
key ctrl+p 3
key ctrl+s 1
[ -s kept/s1_actuation_1.png ] || fail "no picture was kept"
[ -s kept/s1_actuation_1.toml ] || fail "no preset was kept"
key ctrl+q 1
wait "$view" || fail "the window ended with $?: $(cat error.txt)"
view=

grep -q '^press left' visit.txt || fail "the visit was not recorded"
"$program" run kept/s1_actuation_1.toml -o ran --frames 2 --quiet || fail "the preset kept does not run"
"$program" view --play visit.txt -o again >state.json || fail "the recording does not play"
python3 - <<'P' || fail "the preset kept ends in another state"
import json, sys
state, ran = json.load(open("state.json")), json.load(open("ran/summary.json"))
print(state["boundary_radius_mm"], state["energy_bend_mJ"], ran["energy_bend_mJ"])
close = abs(state["energy_bend_mJ"] - ran["energy_bend_mJ"]) < 1e-7 * ran["energy_bend_mJ"]
sys.exit(0 if close and state["boundary_radius_mm"] != 94.5 else 1)
P
