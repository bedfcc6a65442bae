#!/bin/sh
# tests/style.sh format [--fix]  every source file is as .clang-format says; --fix makes it so
# tests/style.sh tidy [--all]    clang-tidy with the checks of .clang-tidy, on what changed or on all
# tests/style.sh clang [--all]   clang takes every source file without a warning, what changed or all
# tests/style.sh warnings        every source file is built with warnings as errors, none silenced
# tests/style.sh equal           no 50 tokens occur twice in engine/ unless equal_tokens.txt says why
# tests/style.sh names           every source file that a comment or a .md file names is there
# tests/style.sh pages           pages have short paragraphs and cells; the README and versions of CHANGELOG are short
# tests/style.sh words           pages, comments, strings and identifiers use the words of the glossary, not those of
#                                tests/words.txt
#
# BUILD (default build) is a folder that cmake has configured. `tidy` and `clang` take the files that differ
# from the merge base with the main branch (BASE, default main), also by changes that are not committed.
# If the merge base is this commit itself, they take the files of the last commit. They check the ten with
# the most changed lines (LIMIT); for a header, the .cpp of its name. Without git or without a commit to
# compare with, they check the files below, one of each kind of code there is.
# Exits with 77 (skipped) where the tool is missing.
set -u
cd "$(dirname "$0")/.." || exit 1
build=${BUILD:-build}
limit=${LIMIT:-10}
without_git="engine/core/file_io.cpp engine/footprint/mesh.cpp engine/preset/field_values.cpp
  render/gl/image.cpp app/cli/staged_folder.cpp"

need() {
  command -v "$1" >/dev/null && return
  echo "skipped: $1 is missing (package ${2:-$1})"
  exit 77
}

sources() {  # files whose names match, in the folders of sources
  find engine render app tests -name "$1" | sort
}

format() {
  need clang-format
  if ! clang-format --version | grep -q 'version 14'; then
    echo "skipped: only clang-format 14 (Debian 12) lays out as .clang-format means it"
    exit 77
  fi
  files="$(sources '*.h') $(sources '*.cpp')"
  if [ "${1:-}" = --fix ]; then
    clang-format -i $files
  else
    clang-format --dry-run -Werror $files
  fi
}

# lines of "CHANGED FILE"; fails where there is nothing to compare with
changes() {
  git rev-parse -q --verify HEAD >/dev/null 2>&1 || return 1
  head=$(git rev-parse HEAD)
  base=""
  for name in ${BASE:-origin/main main}; do
    base=$(git merge-base HEAD "$name" 2>/dev/null) && break
  done
  if [ -z "$base" ] || [ "$base" = "$head" ]; then
    base=$(git rev-parse -q --verify HEAD~1) || return 1
  fi
  git diff --numstat --diff-filter=d "$base" -- engine render app tests |
    awk '{ print $1 + $2, $3 }'
}

# sources of the changed files, those with the most changed lines first
changed_sources() {
  changes >"$scratch/changes" || return 1
  sort -rn "$scratch/changes" | while read -r _ file; do
    case $file in
      *.cpp) echo "$file" ;;
      *.h) [ -f "${file%.h}.cpp" ] && echo "${file%.h}.cpp" ;;
    esac
  done | awk '!seen[$0]++'
}

# writes the chosen files that this build compiles into $scratch/built, and compile commands that clang takes
choose_files() {
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  if [ "${1:-}" = --all ]; then
    sources '*.cpp' >"$scratch/files"
  elif changed_sources >"$scratch/all"; then
    head -n "$limit" "$scratch/all" >"$scratch/files"
    left=$(($(wc -l <"$scratch/all") - limit))
    [ "$left" -gt 0 ] && echo "$left more changed files are left to --all"
  else
    echo "no commit to compare with: a few files of each kind"
    printf '%s\n' $without_git >"$scratch/files"
  fi
  # the commands that compile each file by itself
  cmake -S . -B "$scratch" -DCMAKE_BUILD_TYPE=Release -DGRIDSHELL_BATCHES=OFF >"$scratch/said" ||
    { cat "$scratch/said"; return 1; }
  # a file that this build leaves out has no command to look at
  while read -r file; do
    grep -q "\"file\": \"$PWD/$file\"" "$scratch/compile_commands.json" && echo "$file"
  done <"$scratch/files" >"$scratch/built"
  # GCC's precompiled headers are nothing to clang; a file includes what it uses
  sed -i 's/ --param=ggc-min-heapsize=[0-9]*//; s/-Winvalid-pch -include [^ ]*cmake_pch\.hxx//' "$scratch/compile_commands.json"
}

tidy() {
  need clang-tidy
  choose_files "${1:-}" || return 1
  echo "clang-tidy on $(wc -l <"$scratch/built") files"
  xargs -r -P "$(nproc)" -n 1 clang-tidy --quiet -p "$scratch" <"$scratch/built" 2>"$scratch/said"
  status=$?
  # how many warnings of libraries' headers were left out does not matter
  grep -vE '^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header' "$scratch/said"
  return $status
}

clang() {
  need clang++ clang
  choose_files "${1:-}" || return 1
  echo "clang on $(wc -l <"$scratch/built") files"
  while read -r file; do
    # "command": "/usr/bin/c++ OPTIONS -o X.o -c FILE"
    grep -F -B 1 "\"file\": \"$PWD/$file\"" "$scratch/compile_commands.json" |
      sed -n 's/^ *"command": "[^ ]* \(.*\) -o [^ ]* -c \([^ ]*\)",$/\1 \2/p' | sed 's/\\\(["\\]\)/\1/g; q'
  done <"$scratch/built" >"$scratch/commands"
  (cd "$scratch" && xargs -P "$(nproc)" -d '\n' -I {} sh -c 'clang++ -fsyntax-only {}' <commands)
}

warnings() {
  result=0
  if grep -q '^set(CMAKE_CXX_COMPILER_VERSION "1[3-9]' "$build"/CMakeFiles/*/CMakeCXXCompiler.cmake; then
    echo "this compiler is newer than those that all warnings were taken away for: they are no errors"
  elif ! awk '/"command":/ && / -Werror( |$)/ { ++with } /"command":/ { ++all }
            END { printf "%d of %d files are built with -Werror\n", with, all
                  exit !(all > 0 && with == all) }' "$build/compile_commands.json"; then
    echo "configure with -DGRIDSHELL_WERROR=ON"
    result=1
  fi
  if grep -nE ' -(w|Wno-[a-z-]+) ' "$build/compile_commands.json" | head -3 | grep .; then
    echo "a warning is switched off on the command line"
    result=1
  fi
  if grep -rnE '#pragma +(GCC|clang) +(diagnostic +ignored|system_header)' --include='*.h' \
    --include='*.cpp' engine render app tests; then
    echo "a warning is switched off in the source"
    result=1
  fi
  # an enumerator that is forgotten must not fall through a default
  if grep -nE '^ *default *:' $(sources '*.h' | grep -v ^tests) $(sources '*.cpp' | grep -v ^tests); then
    echo "a switch over an enum names every enumerator: no default"
    result=1
  fi
  return $result
}

equal() {
  need sim_c++ similarity-tester
  # "FILE: line A-B|FILE: line C-D[TOKENS]" with blanks as they fall
  sim_c++ -r 50 -n $(find engine -name '*.h' -o -name '*.cpp' | sort) 2>&1 | grep '|' | tr -d ' ' |
    awk -F '|' '
      NR == FNR { if ($0 !~ /^#/) { sub(/^[^:]*: /, ""); list[++lists] = " " $0 " " } next }
      { a = $1; b = $2; sub(/:.*/, "", a); sub(/:.*/, "", b)
        sub(/^engine\//, "", a); sub(/^engine\//, "", b); ++pairs
        for (k = 1; k <= lists; ++k)
          if (index(list[k], " " a " ") && index(list[k], " " b " ")) { ++known; used[k] = 1; next }
        print "equal: " $0 }
      END {
        for (k = 1; k <= lists; ++k) if (!used[k]) { print "no such pair any more:" list[k]; ++old }
        printf "%d pairs of passages are equal, %d of them with a reason\n", pairs, known
        exit !(pairs > 0 && known == pairs && !old) }' tests/equal_tokens.txt -
}

names() {
  list=$(mktemp)
  find engine render app tests -name '*.h' -o -name '*.cpp' >"$list"
  # names are looked for behind the last // of a line, and in all of a .md file
  grep -rnE '[a-z0-9_]+\.(h|cpp)\>' --include='*.h' --include='*.cpp' --include='*.md' \
    engine render app shaders presets tests ./*.md |
    awk 'NR == FNR { sub(/.*\//, ""); there[$0] = 1; next }
      { split($0, part, ":"); text = $0; sub(/^[^:]*:[0-9]*:/, "", text)
        gsub(/<[^>]*>/, "", text)  # of others
        if (part[1] !~ /\.md$/ && !sub(/^.*\/\/ ?/, "", text)) next
        while (match(text, /[a-z0-9_]+\.(h|cpp)/)) {
          name = substr(text, RSTART, RLENGTH); text = substr(text, RSTART + RLENGTH); ++all
          if (!(name in there)) { print part[1] ":" part[2] ": no " name; ++lost }
        } }
      END { printf "%d names of source files, %d of files that are not there\n", all, lost
            exit !(all > 0 && !lost) }' "$list" -
  status=$?
  rm "$list"
  return $status
}

# pages that people write; WHY.md is a log that `compare --update` writes
pages() {
  find ./*.md app engine render presets shaders tests -name '*.md' ! -name WHY.md | sort
}

lengths() {
  awk -v cells=30 -v words=90 '
    function bad(text) { print FILENAME ":" start ": " text; ++errors }
    function count(text, part) { return split(text, part, " ") }
    function end() { if (paragraph > words) bad("a paragraph of " paragraph " words, at most " words); paragraph = 0 }
    FNR == 1 { end(); code = 0; recipe = 0; version = ""; ++files }
    /^ *```/ { end(); code = !code; next }
    code { if (FILENAME ~ /recipes/ && ++recipe > 10) { start = FNR; bad("a recipe of more than ten lines") } next }
    /^## / { recipe = 0; version = FILENAME ~ /CHANGELOG/ ? $2 : ""; since = FNR }
    version == "0.2.0," && FNR == since + 41 { start = FNR; bad("version 0.2.0 has more than 40 lines") }
    FILENAME ~ /^(\.\/)?README.md$/ && FNR == 121 { start = FNR; bad("the README has more than 120 lines") }
    /^\|/ {
      end(); start = FNR; gsub(/\\\|/, "")
      n = split($0, cell, "|")
      for (k = 1; k <= n; ++k) if (count(cell[k]) > cells) bad("a cell of " count(cell[k]) " words, at most " cells)
      next
    }
    /^$/ || /^#/ { end(); next }
    /^ *([*-]|[0-9]+\.) / { end() }
    { if (!paragraph) start = FNR; paragraph += count($0) }
    END { end(); printf "%d pages, %d too long\n", files, errors; exit !(files > 10 && !errors) }' $(pages)
}

# folders whose comments follow the glossary
commented="engine render app tests"

# the text of each comment as FILE:LINE: text, without names and quotations; "1" where a comment begins
comments() {
  # shellcheck disable=SC2086 # a list of folders
  find $commented CMakeLists.txt -name '*.h' -o -name '*.cpp' -o -name '*.py' -o -name '*.sh' -o -name '*.cmake' \
    -o -name CMakeLists.txt | sort | xargs awk '
    FNR == 1 { inside = 0 }
    { script = FILENAME !~ /\.(h|cpp)$/; line = $0; gsub(/"([^"\\]|\\.)*"/, "\"", line)
      at = match(line, script ? "(^|[ ;])#( |$)" : "//+<?( |$)") }
    !at { inside = 0; next }
    { whole = line ~ (script ? "^ *#" : "^ *//"); text = substr(line, RSTART + RLENGTH)
      gsub(/`[^`]*`/, "`", text); gsub(/[A-Za-z0-9_]*(::|_|\()[A-Za-z0-9_:()]*/, "`", text)
      printf "%s:%d:%d: %s\n", FILENAME, FNR, !(inside && whole), text; inside = whole }'
}

# the text of each string of the program and name of a test that has a blank, as FILE:LINE:0: text,
# without quoted names
strings() {
  find engine render app tests -name '*.h' -o -name '*.cpp' | sort | xargs awk '
    /TEST_CASE\(/ || FNR == 1 { named = FNR > 1 }
    FILENAME ~ /^tests/ && !named { next }
    / [{]$/ { named = 0 }
    { line = $0; sub(/(^|[ ;])\/\/+<?( .*)?$/, "", line)
      while (match(line, /"([^"\\]|\\.)*"/)) {
        text = substr(line, RSTART + 1, RLENGTH - 2); line = substr(line, RSTART + RLENGTH)
        gsub(/\\"[^"]*\\"/, "`", text); gsub(/`[^`]*`/, "`", text); gsub(/[{][^}]*([}]|$)|^[^{]*[}]/, "`", text)
        gsub(/\\n/, " ", text); gsub(/--?[a-z-]+/, "`", text)
        if (text ~ / /) printf "%s:%d:0: %s\n", FILENAME, FNR, text } }'
}

# words that users write in presets, and names of libraries, which code repeats
of_others='(StepKind|Do|K)::hold|case hold:|Lateral::held|hold_first_s|hold_s|OnContact::tell|(M::|movie[.])beside|bool beside = true'
of_others="$of_others|enum class (StepKind|Lateral|OnContact) [{].*|holds_alternative|reverseInPlace"

# identifiers that have a word of the third column of words.txt as a part, by _ or capitals
identifiers() {
  find engine render app shaders -name '*.h' -o -name '*.cpp' -o -path 'shaders/*.*' ! -name '*.md' | sort |
    xargs awk -v of_others="$of_others" '
    NR == FNR { if (!/^#/ && split($0, part, "\t") > 2) { bad[++n] = part[3]; good[n] = part[2] } next }
    { line = $0; gsub(/"([^"\\]|\\.)*"/, "\"", line); sub(/\/\/.*/, "", line); gsub(of_others, "", line)
      while (match(line, /[A-Za-z_][A-Za-z0-9_]*/)) {
        name = parts = substr(line, RSTART, RLENGTH); line = substr(line, RSTART + RLENGTH); ++all
        while (match(parts, /[a-z0-9][A-Z]/)) parts = substr(parts, 1, RSTART) " " substr(parts, RSTART + 1)
        gsub(/_/, " ", parts); parts = " " tolower(parts) " "
        for (k = 1; k <= n; ++k) if (match(parts, " (" bad[k] ") ")) {
          printf "%s:%d: %s: \"%s\": write %s\n", FILENAME, FNR, name, substr(parts, RSTART + 1, RLENGTH - 2), good[k]
          ++errors } } }
    END { printf "%d identifiers, %d to rename\n", all, errors; exit !(all > 300000 && n > 5 && !errors) }' tests/words.txt
}

words() {
  pages_status=0
  identifiers || pages_status=1
  awk 'NR == FNR { if ($0 !~ /^#/) { split($0, part, "\t"); bad[++n] = part[1]; good[n] = part[2] } next }
    FNR == 1 { code = 0; ++files }
    /^ *```/ { code = !code; next }
    code { next }
    { text = tolower($0); gsub(/`[^`]*`/, "`", text); gsub(/"[^"]*"/, "\"", text); gsub(/[{][^}]*[}]/, "", text); gsub(/\]\([^)]*\)/, "]", text)
      gsub(/[^a-z]+/, " ", text); text = " " text " "
      for (k = 1; k <= n; ++k) if (match(text, " (" bad[k] ") ")) {
        printf "%s:%d: \"%s\": write %s\n", FILENAME, FNR, substr(text, RSTART + 1, RLENGTH - 2), good[k]; ++errors } }
    END { printf "%d pages, %d words to replace\n", files, errors; exit !(files > 10 && n > 20 && !errors) }' \
    tests/words.txt $(pages) || pages_status=1
  # comments may contain "apart" (a distance), "thrown" (an exception) and "in place" (of vectors)
  { comments; strings; } | awk 'NR == FNR { if ($0 !~ /^#|^apart|^thrown/) { split($0, part, "\t"); bad[++n] = part[1]; good[n] = part[2] } next }
    { ++lines; split($0, at, ":"); where = at[1] ":" at[2]; text = $0; sub(/^[^ ]* /, "", text)
      if (at[3] == 1 && text ~ /^(Of |And |The same(\.|,|;|:| (of|for|with|without|in|by|on|to|from|as|where|when|but|along|within) ))/) {
        printf "%s: \"%s\": begin with the thing that is described\n", where, substr(text, 1, 20); ++errors }
      text = tolower(text); gsub(/in place($|[ ,.:;])/, "", text); gsub(/[^a-z]+/, " ", text); text = " " text " "
      for (k = 1; k <= n; ++k) if (match(text, " (" bad[k] ") ")) {
        printf "%s: \"%s\": write %s\n", where, substr(text, RSTART + 1, RLENGTH - 2), good[k]; ++errors } }
    END { printf "%d lines of comments and strings, %d words to replace\n", lines, errors; exit !(lines > 12000 && n > 20 && !errors) }' \
    tests/words.txt - && [ "$pages_status" = 0 ]
}

case ${1:-} in
  pages) lengths ;;
  words) words ;;
  format) format "${2:-}" ;;
  tidy) tidy "${2:-}" ;;
  clang) clang "${2:-}" ;;
  warnings) warnings ;;
  equal) equal ;;
  names) names ;;
  *) sed -n '2,10p' "$0"; exit 2 ;;
esac
