#!/bin/sh
# tests/run.sh [CTEST ARGUMENTS]: installs what is missing, builds everything, and runs the tests, all but
# those that only a release needs (label full). Arguments choose others: -L quick, -L full, -R words.
set -e
cd "$(dirname "$0")/.."
. app/setup.sh
install_packages tests
build all
finish_packages
[ $# -gt 0 ] || set -- -LE full
exec ctest --test-dir build --output-on-failure --no-tests=error -j "$(nproc)" "$@"
