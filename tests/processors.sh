#!/bin/sh
# tests/processors.sh PROGRAM: runs the program on a processor without AVX, on the first with AVX2
# and on one with AVX-512, all emulated by qemu-user. Every run must succeed, and all must give
# the same states: joints to 1e-9 of the footprint's radius, energies to 1e-9 of themselves.
# Exits with 77 (skipped) where the emulator is missing.
#
# What differs is in the last digits (joints 2e-15, energies 4e-14): where the processor has fused
# multiply-adds the factorisation and the assembly use them, the two files that may contract a*b+c
# (engine/engine.cmake), and so do the C library's functions and the kernels below CHOLMOD.
set -u
program=$1
if ! command -v qemu-x86_64 >/dev/null; then
  echo "skipped: qemu-x86_64 is missing (package qemu-user)"
  exit 77
fi
if [ "$(uname -m)" != x86_64 ]; then
  echo "skipped: the program is not built for x86-64"
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
processors="Nehalem Haswell Skylake-Client"
first=${processors%% *}

for processor in $processors; do
  # the emulator lacks some features of these models; it prints messages about them, which do not matter
  # emulated vectors are slow: half as many rods as the paper's
  qemu-x86_64 -cpu "$processor" "$program" run s1_actuation --frames 3 --quiet \
    --set accuracy.edges_per_segment=4 --set footprint.rods=6 --set footprint.radius_mm=66 \
    --set actuation.radius_mm=50 -o "$folder/$processor" 2>"$folder/$processor.txt"
  status=$?
  if [ $status -ne 0 ]; then
    echo "$processor: the program left with $status"
    grep -v "doesn't support requested feature" "$folder/$processor.txt"
    exit 1
  fi
done

# the largest difference of the columns given, over SCALE, or over the value itself (SCALE 0)
largest_difference() {  # FILE COLUMNS SCALE PROCESSOR
  # texts have commas of their own
  for one in "$first" "$4"; do sed 's/"[^"]*"//g' "$folder/$one/$1" >"$folder/$one.csv"; done
  paste -d, "$folder/$first.csv" "$folder/$4.csv" | awk -F, -v columns="$2" -v scale="$3" '
    NR == 1 { half = NF / 2; n = split(columns, wanted, " ")
              for (c = 1; c <= half; ++c) for (k = 1; k <= n; ++k) if ($c == wanted[k]) use[c]
              for (c in use) ++found
              if (found != n) { print "column missing"; exit }
              next }
    { for (c in use) { d = $c - $(c + half); if (d < 0) d = -d
                       s = scale ? scale : ($c < 0 ? -$c : $c)
                       if (d > 0) d /= s
                       if (d > largest) largest = d; ++count } }
    END { if (count) printf "%.3g\n", largest; else print "nothing compared" }'
}

result=0
compare() {  # FILE COLUMNS SCALE PROCESSOR
  difference=$(largest_difference "$@")
  echo "$4 compared with $first, $1 ($2): $difference"
  case $difference in
    *[a-z]\ *) result=1 ;;
    *) awk -v d="$difference" 'BEGIN { exit !(d <= 1e-9) }' || result=1 ;;
  esac
}
for processor in $processors; do
  [ "$processor" = "$first" ] && continue
  compare joints.csv "x_mm y_mm z_mm" 66 "$processor"
  compare frames.csv "energy_bend_mJ height_mm" 0 "$processor"
done
exit $result
