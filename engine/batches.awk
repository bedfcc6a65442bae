# Which files are compiled together: prints "BATCH FILE" a line. As many as `size` files of one folder
# share a batch, but never two that have the same name in an anonymous namespace; one that defines
# macros stays alone.
#   awk -v size=4 -f batches.awk FILE...
FNR == 1 { take(); file = FILENAME; inside = alone = 0 }
/^#define / { alone = 1 }
/^namespace \{/ { inside = 1; next }
/^\}  \/\/ namespace$/ { inside = 0 }
# a name at the left border of an anonymous namespace: of a type, or before the first of ( = { [ ;
# and of a list of constants each, which may go on in a line further in
inside && (/^const/ || constants) {
  line = $0
  while (match(line, /[A-Za-z0-9_]+( = |\{)/)) {
    name = substr(line, RSTART, RLENGTH)
    sub(/[ {].*/, "", name)
    names[name] = 1
    line = substr(line, RSTART + RLENGTH)
  }
}
{ constants = inside && (/^const/ || constants) && /,$/ }
inside && /^[A-Za-z]/ || /^(static|using) / {
  line = $0
  sub(/^template <.*> ?/, "", line)
  if (line ~ /^(struct|class|enum) /) sub(/ *[{:].*/, "", line)
  sub(/^using namespace .*/, "", line)
  sub(/ *(\(|=|\{|\[|;).*/, "", line)
  sub(/.*[^A-Za-z0-9_]/, "", line)
  if (line != "") names[line] = 1
}
END { take() }

function take(folder, k, name) {
  if (file == "" || alone) { split("", names); return }
  folder = file
  sub(/\/[^\/]*$/, "", folder)
  sub(/.*\//, "", folder)
  for (k = 1; (folder, k) in count; ++k)
    if (count[folder, k] < size && fits(folder, k)) break
  ++count[folder, k]
  for (name in names) taken[folder, k, name] = 1
  split("", names)
  print folder "_" k " " file
}

function fits(folder, k, name) {
  for (name in names) if ((folder, k, name) in taken) return 0
  return 1
}
