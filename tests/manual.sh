#!/bin/sh
# tests/manual.sh PROGRAM PYTHON PAGE...: runs the code blocks of pages, each page in an empty folder.
#
#   ```sh             commands, run in order by `sh -e`; ```sh not run: shown alone, its syntax is checked
#   ```text           lines of what the commands before printed; … is for what differs from run to run
#   ```toml, ```python, ... whose first line is `# NAME`, or ```json NAME: the file NAME
#   ```python         without a name: a script; ```bibtex and ```math are not run
#   <!-- FILE -->     over a picture: the picture is the FILE that the commands made; with DRAW=1 it becomes that
#
# PYTHONPATH leads to the Python module; scripts whose imports are missing are left out, with a message.
set -u
program=$1 python=$2
shift 2
source=$(cd "$(dirname "$0")/.." && pwd)
export PYTHONDONTWRITEBYTECODE=1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin"
ln -s "$program" "$scratch/bin/gridshell"
ln -s "$(command -v "$python")" "$scratch/bin/python3"
PATH=$scratch/bin:$PATH

# the blocks of a page: NUMBER.KIND, and for files the name in NUMBER.name
split() {
  awk -v to="$2" '
    /^ *```/ && !inside {
      info = $0; sub(/^ *```/, "", info); count = split(info, part, " ")
      inside = 1; first = 1; line = NR; indent = match($0, /`/) - 1
      file = sprintf("%s/%03d.%s", to, ++number, part[1] == "" ? "none" : part[1])
      if (info ~ /^sh not run/) file = sprintf("%s/%03d.shown", to, number)
      else if (count > 1) { print part[2] >(file ".name"); close(file ".name") }
      printf "" >file
      next
    }
    /^ *```/ { inside = 0; close(file); next }
    inside {
      text = substr($0, indent + 1)
      if (first && text ~ /^# [A-Za-z0-9_.-]+\.[a-z]+$/) {
        print substr(text, 3) >(file ".name"); close(file ".name")
      }
      first = 0
      print text >file
    }
    # code must be in a fence, or no test would see it
    !inside && /^    [^ ]/ && blank { print FILENAME ":" NR ": an indented code block" >to "/indented" }
    { blank = $0 == "" }' "$1"
}

# every line of $1 is in $2, in parts around …
said() {
  awk 'NR == FNR { all = all "\n" $0; next }
    { gsub(/^ +| +$/, ""); n = split($0, part, /…/); at = all
      for (k = 1; k <= n; ++k) {
        gsub(/^ +| +$/, "", part[k])
        if (part[k] == "") continue
        found = index(at, part[k])
        if (!found) { print "not printed: " part[k]; missing = 1; break }
        at = substr(at, found + length(part[k]))
      } }
    END { exit missing }' "$2" "$1"
}

fail() {
  echo "$1" >&2
  status=1
}

left_out() {
  echo "$1: left out a script: $(grep ModuleNotFoundError "$out")"
}

status=0 ran=0
for page; do
  blocks=$scratch/blocks folder=$scratch/folder out=$scratch/out
  rm -rf "$blocks" "$folder"
  mkdir "$blocks" "$folder"
  split "$source/$page" "$blocks"
  [ -e "$blocks/indented" ] && fail "$(cat "$blocks/indented")"
  : >"$out"
  for block in "$blocks"/[0-9]*; do
    case $block in *.name | *'*'*) continue ;; esac
    ran=$((ran + 1))
    if [ -e "$block.name" ]; then
      cp "$block" "$folder/$(cat "$block.name")"
      continue
    fi
    case $block in
      *.shown) sh -n "$block" || fail "$page: not a script: $block" ;;
      *.sh)
        if ! (cd "$folder" && GRIDSHELL_SOURCE=$source sh -e "$block") >"$out" 2>&1; then
          grep -q ModuleNotFoundError "$out" && left_out "$page" && continue
          fail "$page: this block failed:
$(cat "$block")
$(tail -n 20 "$out")"
          break
        fi
        ;;
      *.python)
        (cd "$folder" && "$python" "$block") >"$out" 2>&1 && continue
        grep -q ModuleNotFoundError "$out" && left_out "$page" && continue
        fail "$page: this script failed:
$(cat "$block")
$(tail -n 20 "$out")"
        ;;
      *.text)
        grep -q ModuleNotFoundError "$out" || said "$block" "$out" || fail "$page: printed was
$(cat "$out")" ;;
      *.bibtex | *.math) ;;
      *) fail "$page: what is ${block##*.}? a file has its name in its first line" ;;
    esac
  done
  awk '/^<!-- .* -->$/ { made = $2; next } made && match($0, /\]\(.*\)$/) { print made, substr($0, RSTART + 2, RLENGTH - 3) }
    { made = "" }' "$source/$page" >"$scratch/pictures"
  while read -r made picture; do
    picture=$(dirname "$source/$page")/$picture
    [ "${DRAW:-0}" = 0 ] || cp "$folder/$made" "$picture" || status=1
    "$program" compare "$picture" "$folder/$made" >"$out" 2>&1 || fail "$page: $(cat "$out")"
  done <"$scratch/pictures"
done
echo "$ran blocks of $# pages"
exit $status
