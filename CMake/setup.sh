# SPDX-License-Identifier: BSD-3-Clause
# Sourced by Examples/run.sh and Testing/run.sh: installs by apt what is missing, and builds.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$root/build"
packages_build="cmake ninja-build g++ paraview-dev python3-paraview libopenmpi-dev"
packages_render="xvfb xauth"
packages_test="libgtest-dev libbenchmark-dev python3-scipy"
packages_gui="libqt5svg5 imagemagick xdotool"
packages_vtk91="libtbb-dev"

say()
{
  printf '\n== %s\n' "$*"
}

as_root()
{
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    echo "Neither root nor sudo. Please run as root: $*" >&2
    return 1
  fi
}

# Installs those of the named packages that are missing; quick and without the network if none is.
need()
{
  local name missing=""
  if ! command -v dpkg-query > /dev/null; then
    echo "Not a Debian system: what these Debian packages hold must be there: $*" >&2
    return 0
  fi
  for name in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2> /dev/null)" != installed ]; then
      missing="$missing $name"
    fi
  done
  if [ -z "$missing" ]; then
    return 0
  fi
  say "Installing by apt:$missing"
  local wait="-o DPkg::Lock::Timeout=300"
  # An interrupted installation leaves packages unpacked that nothing can be installed beside.
  as_root env DEBIAN_FRONTEND=noninteractive dpkg --configure -a
  as_root env DEBIAN_FRONTEND=noninteractive apt-get $wait update -q
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get $wait install -qy --no-install-recommends \
    $missing < /dev/null
}

# Unpacks the meshes of libcgal-demo (24 MB), without the packages that it depends on, into
# build-meshes/, for the tests and examples that take real shapes.
need_meshes()
{
  local folder="$root/build-meshes"
  if [ -f "$folder/complete" ]; then
    return 0
  fi
  say "Fetching meshes (libcgal-demo)"
  rm -rf "$folder"
  mkdir -p "$folder" && chmod 777 "$folder"
  (
    cd "$folder"
    # Without package lists there is nothing to download from.
    apt-get download libcgal-demo || {
      as_root apt-get -o DPkg::Lock::Timeout=300 update -q
      apt-get download libcgal-demo
    }
    dpkg --fsys-tarfile libcgal-demo_*.deb | tar -xO --wildcards '*/data.tar.gz' |
      tar -xz --strip-components=2 data/meshes
    rm libcgal-demo_*.deb
    touch complete
  )
}

# configure_and_build FOLDER CMAKE-ARGUMENT...
configure_and_build()
{
  local folder="$1"
  shift
  # A copied or moved clone brings a cache that names the place it was made for.
  if [ -f "$folder/CMakeCache.txt" ] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    rm -rf "$folder"
  fi
  mkdir -p "$folder"
  say "Building in $folder (the first time takes minutes)"
  if ! cmake -S "$root" -B "$folder" -G Ninja -DPython3_EXECUTABLE=/usr/bin/python3 "$@" \
    > "$folder/configure.log" 2>&1; then
    tail -n 40 "$folder/configure.log" >&2
    return 1
  fi
  cmake --build "$folder" -j "$(nproc)"
}

# The Release build that the examples and the tests share.
build_release()
{
  local warnings=OFF
  if [ "${CI:-}" = true ]; then
    warnings=ON
  fi
  configure_and_build "$build" -DCMAKE_BUILD_TYPE=Release \
    -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=ON -DRectifiedTransport_BUILD_EXAMPLES=ON \
    -DCMAKE_COMPILE_WARNING_AS_ERROR="$warnings" "$@"
}

# Runs a command on a virtual display: the same pictures with and without a screen.
with_display()
{
  xvfb-run -a -s "-screen 0 1600x1200x24 -noreset" "$@"
}
