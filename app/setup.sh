# Sourced by app/run.sh and tests/run.sh: the Debian 12 packages that building, running and testing
# take, and how to get the missing ones. Expects to run in the folder of the sources.

packages="
  g++ cmake make ninja-build pkg-config
  libeigen3-dev libspectra-dev libsuitesparse-dev libopenblas-serial-dev libmuparser-dev
  libexpected-dev libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libhdf5-dev
  libpango1.0-dev libcairo2-dev libpng-dev libdeflate-dev fonts-dejavu-core
  libgl-dev libegl-dev libegl1 libgl1-mesa-dri libosmesa6-dev libosmesa6 libglfw3-dev
  libimgui-dev libfontconfig-dev
  pybind11-dev python3-dev python3-numpy python3-pytest
  catch2 ffmpeg parallel qemu-user clang clang-format clang-tidy
  similarity-tester
"

install_missing_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This is no Debian: make sure that the counterparts of these are installed:" $packages >&2
    return 0
  fi
  missing=""
  for package in $packages; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || status=""
    [ "$status" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "As root, install these packages first: apt-get install$missing" >&2
      return 1
    fi
    as_root="sudo"
  fi
  echo "Installing${as_root:+ with sudo}:$missing" >&2
  $as_root apt-get update -q >&2 &&
    $as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -q -y --no-install-recommends $missing >&2
}

# build TARGET: a Release in build/, with all cores; what the tools say goes to stderr. Ninja, where it
# is, keeps them all busy; a folder that was begun with make goes on with it.
build() {
  generator=""
  [ -e build/CMakeCache.txt ] || ! command -v ninja >/dev/null || generator="-GNinja"
  cmake -S . -B build $generator -DCMAKE_BUILD_TYPE=Release >&2 &&
    cmake --build build -j "$(nproc)" --target "$1" >&2
}
