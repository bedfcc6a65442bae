#!/bin/sh
# tests/python.sh PYTHON: the tests of the Python module, which PYTHONPATH leads to. Exits with 77
# (skipped) where pytest or numpy is missing.
cd "$(dirname "$0")/.." || exit 1
for package in pytest numpy; do
  "$1" -c "import $package" 2>/dev/null && continue
  echo "skipped: Python has no $package (package python3-$package)"
  exit 77
done
export GRIDSHELL_SOURCE="$PWD"
exec "$1" -m pytest -q -p no:cacheprovider --durations=5 tests/app/python
