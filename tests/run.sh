#!/bin/sh
# tests/run.sh [CTEST ARGUMENTS]: installs what is missing, builds everything, and runs the tests,
# quick, full and those of style; `tests/run.sh -L quick` runs the quick ones.
set -e
cd "$(dirname "$0")/.."
. app/setup.sh
install_missing_packages
build all
exec ctest --test-dir build --output-on-failure --no-tests=error -j "$(nproc)" "$@"
