#!/bin/sh
# tests/install.sh BUILD COMPILER: installs a build into an empty prefix and builds two programs of
# 30 lines against it, one by find_package(gridshell), one by pkg-config, and runs them.
set -e
build=$1
compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" > "$work/log"
source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
mkdir "$work/project"
cd "$work/project"
cat > CMakeLists.txt << 'END'
cmake_minimum_required(VERSION 3.25)
project(mine LANGUAGES CXX)
find_package(gridshell 0.2 REQUIRED)
if(NOT EXISTS ${gridshell_PRESETS}/s1_actuation.toml)
  message(FATAL_ERROR "no presets in ${gridshell_PRESETS}")
endif()
add_executable(mine mine.cpp)
target_link_libraries(mine PRIVATE gridshell::gridshell)
END
cp "$source/app/examples/push.cpp" mine.cpp
cmake -S . -B build -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$work/prefix" > log
cmake --build build > log
build/mine | grep "released: .* mJ of bending"
pc=$(dirname "$(find "$work/prefix" -name gridshell.pc)")
flags=$(PKG_CONFIG_PATH="$pc" pkg-config --cflags --libs gridshell)
# shellcheck disable=SC2086
"$compiler" mine.cpp $flags -o by_pkg_config
./by_pkg_config | grep "released: .* mJ of bending"
# what a user sees of the program
if [ -x "$work/prefix/bin/gridshell" ]; then
  "$work/prefix/bin/gridshell" list > /dev/null
  test -s "$work/prefix/share/man/man1/gridshell.1"
  test -s "$work/prefix/share/bash-completion/completions/gridshell"
fi
# the pages of the manual are there, with what they point to
pages=$(dirname "$(find "$work/prefix" -name CHANGELOG.md)")
find "$pages" -name '*.md' >"$work/pages"
test "$(wc -l <"$work/pages")" -gt 10
while read -r page; do
  grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/[#)].*//' | while read -r link; do
    case $link in '' | http*) continue ;; esac
    [ -e "$(dirname "$page")/$link" ] || { echo "$page: no $link"; exit 1; }
  done
done <"$work/pages"
# headers name nothing that is not installed
grep -rhoE '#include "[^"]+"' "$work/prefix/include" | sort -u | sed 's/#include "\(.*\)"/\1/' |
  while read -r header; do
    test -f "$work/prefix/include/gridshell/$header" || { echo "missing: $header"; exit 1; }
  done
echo "installed, found and run"
