# Sourced by app/run.sh and tests/run.sh, in the folder of the sources: the packages of Debian 12 and 13 that
# the program and its tests need, and functions that install missing ones and build.

build_packages="
  g++ cmake make ninja-build pkg-config
  libeigen3-dev libspectra-dev libsuitesparse-dev libopenblas-serial-dev libmuparser-dev
  libexpected-dev libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libhdf5-dev
  libpango1.0-dev libcairo2-dev libpng-dev libdeflate-dev
  libgl-dev libegl-dev libosmesa6-dev libosmesa6 libglfw3-dev libimgui-dev libfontconfig-dev
"
test_build_packages="catch2 pybind11-dev python3-dev"
# the build does not need these, so they are installed while it runs
run_packages="ffmpeg fonts-dejavu-core fonts-dejavu-extra libegl1 libgl1-mesa-dri"
test_run_packages="python3-numpy python3-pytest"
# programs of some tests; a test whose program is missing is skipped with a message
checker_packages="parallel qemu-user clang clang-format clang-tidy similarity-tester"

# missing_packages PACKAGE...: prints those that are not installed
missing_packages() {
  for package in "$@"; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || status=""
    [ "$status" = installed ] || printf ' %s' "$package"
  done
}

as_root=""
apt_install() {
  echo "Installing${as_root:+ with sudo}:$*" >&2
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $* >&2
}

# install_packages [tests]: installs missing packages of the program, and with `tests` those of its tests;
# those that the build does not need in the background, until finish_packages
install_packages() {
  later=""
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This is not Debian: install the packages of this system that contain the same as these:" \
      $build_packages $run_packages $test_build_packages $test_run_packages >&2
    return 0
  fi
  missing=$(missing_packages $build_packages)
  runs=$(missing_packages $run_packages)
  checkers=""
  if [ "${1:-}" = tests ]; then
    missing="$missing$(missing_packages $test_build_packages)"
    runs="$runs$(missing_packages $test_run_packages)"
    checkers=$(missing_packages $checker_packages)
  fi
  [ -n "$missing$runs$checkers" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      [ -n "$missing$runs" ] || return 0
      echo "As root, install these packages first: apt-get install$missing$runs" >&2
      return 1
    fi
    as_root="sudo"
  fi
  $as_root apt-get update -q >&2 || return 1
  for package in $checkers; do
    if apt-cache show "$package" >/dev/null 2>&1; then
      runs="$runs $package"
    else
      echo "This system has no package $package: the test that needs it is skipped" >&2
    fi
  done
  [ -z "$missing" ] || apt_install "$missing" || return 1
  [ -z "$runs" ] || { apt_install "$runs" & later=$!; }
}

finish_packages() {
  [ -z "$later" ] || wait "$later"
}

# build TARGET: builds it as Release in build/, on all cores; the output of the tools goes to stderr. Uses Ninja
# if it is installed and the folder was not configured for make before.
build() {
  generator=""
  [ -e build/CMakeCache.txt ] || ! command -v ninja >/dev/null || generator="-GNinja"
  cmake -S . -B build $generator -DCMAKE_BUILD_TYPE=Release >&2 &&
    cmake --build build -j "$(nproc)" --target "$1" >&2
}
