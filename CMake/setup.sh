# SPDX-License-Identifier: BSD-3-Clause
# Sourced by Examples/run.sh and Testing/run.sh: installs by apt what is missing, and builds.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$root/build"
apt_log="$build/apt.log"
packages_build="cmake ninja-build g++ libeigen3-dev paraview-dev python3-paraview python3-dev
  libopenmpi-dev libfreetype-dev libglew-dev libopengl-dev libx11-dev"
packages_help="qhelpgenerator-qt5 python3-markdown python3-pil"
packages_render="xvfb xauth"
packages_examples="python3-scipy python-matplotlib-data openmpi-bin python3-mpi4py"
packages_test="libgtest-dev libbenchmark-dev librsvg2-bin poppler-utils clang-format pocl-opencl-icd
  ocl-icd-libopencl1 opencl-c-headers universal-ctags $packages_examples"
packages_gui="libqt5svg5 imagemagick xdotool"
packages_vtk="libtbb-dev"

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

# logged LOG COMMAND...: the command's output goes to the log; if it fails, the log's end is shown.
logged()
{
  local log="$1"
  shift
  mkdir -p "$(dirname "$log")"
  if ! "$@" >> "$log" 2>&1 < /dev/null; then
    printf 'Failed: %s\nThe end of %s:\n' "$*" "$log" >&2
    tail -n 40 "$log" >&2
    return 1
  fi
}

apt_get()
{
  as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 \
    apt-get -o DPkg::Lock::Timeout=300 "$@"
}

# Prints the sizes of an installation's download and of its packages, and an estimate of the
# minutes: with libraries of ParaView's size 150 MB a minute were downloaded and unpacked.
announce_installation()
{
  local bytes
  bytes="$(apt_get install -qq --print-uris --no-install-recommends "$@" |
    awk '{ sum += $3 } END { printf "%.0f", sum }')"
  apt_get install --assume-no --no-install-recommends "$@" 2> /dev/null |
    grep -E '^(Need to get|After this operation)' || true
  echo "That is about $((1 + bytes / 150000000)) min. What apt says is in $apt_log"
}

# From Debian 13 on ParaView's CMake files name Python modules X.so where X.cpython-….so is installed,
# and stop for it. Links, where that is so.
link_python_modules()
{
  local name plain files links=()
  while read -r name; do
    plain="/usr/lib/python3/${name%.so}"
    files=("$plain".cpython-*.so)
    if [ ! -e "$plain.so" ] && [ -e "${files[0]}" ]; then
      links+=("${files[0]}" "$plain.so")
    fi
  done < <(grep -rhoE 'dist-packages/[^"]*\.so' /usr/lib/*/cmake/paraview-* 2> /dev/null | sort -u)
  if [ ${#links[@]} -gt 0 ]; then
    say "Linking $((${#links[@]} / 2)) Python modules to the names that ParaView's CMake files have"
    printf '%s\0' "${links[@]}" | as_root xargs -0 -n 2 ln -sfr
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
    link_python_modules
    return
  fi
  say "Installing by apt:$missing"
  # Packages that an interrupted installation left unpacked prevent all others from being installed.
  # dpkg does not wait for an installation that is under way, as apt does.
  logged "$apt_log" as_root env DEBIAN_FRONTEND=noninteractive timeout 300 \
    bash -c 'until dpkg --configure -a; do [ $? = 2 ] || exit 1; sleep 5; done' || return 1
  logged "$apt_log" apt_get update -q || return 1
  # shellcheck disable=SC2086
  announce_installation $missing
  # shellcheck disable=SC2086
  logged "$apt_log" apt_get install -qy --no-install-recommends $missing || return 1
  link_python_modules
}

# paraview-dev contains the headers of a VTK of ParaView's own; Debian's ParaView 6 is built with
# libvtk9, and paraview-dev does not depend on libvtk9-dev.
has_vtk_apart()
{
  local files
  files="$(dpkg -L paraview-dev 2> /dev/null)" && [[ "$files" != */vtk-config.cmake* ]]
}

# Installs the packages of the build, and further ones.
need_to_build()
{
  need $packages_build "$@"
  if has_vtk_apart; then
    need libvtk9-dev
  fi
}

# What the plugin has in ParaView's window besides its filters; the build leaves out what it lacks.
need_for_window()
{
  local packages_panel=qtbase5-dev
  if grep -qs 'PARAVIEW_QT_MAJOR_VERSION "6"' /usr/lib/*/cmake/paraview-*/paraview-config.cmake; then
    packages_panel=qt6-base-dev
  fi
  if has_vtk_apart; then
    packages_panel="$packages_panel libvtk9-qt-dev"
  fi
  # shellcheck disable=SC2086
  need $packages_help || echo "The plugin is built without help in ParaView's window" >&2
  # shellcheck disable=SC2086
  need $packages_panel || echo "The plugin is built without its own widgets on ParaView's panel" >&2
}
# For configure_and_build: what these need may have come since the last time.
anew_for_window=(-URectifiedTransport_BUILD_HELP -URectifiedTransport_BUILD_PANEL)

# download PACKAGE...: into the current folder, which apt's own user must be able to write to.
download()
{
  # Without package lists there is nothing to download from.
  logged "$apt_log" apt-get download "$@" 2> /dev/null || {
    logged "$apt_log" apt_get update -q
    logged "$apt_log" apt-get download "$@"
  }
}

# Unpacks the meshes of libcgal-demo (24 MB), without the packages that it depends on, into
# build-meshes/, for the tests and examples that take real shapes.
need_meshes()
{
  local folder="$root/build-meshes"
  if [ -f "$folder/complete" ]; then
    return 0
  fi
  say "Fetching meshes (libcgal-demo, 24 MB)"
  rm -rf "$folder"
  mkdir -p "$folder" && chmod 777 "$folder"
  (
    cd "$folder"
    download libcgal-demo
    dpkg --fsys-tarfile libcgal-demo_*.deb | tar -xO --wildcards '*/data.tar.gz' |
      tar -xz --strip-components=2 data/meshes
    rm libcgal-demo_*.deb
    touch complete
  )
}

# configure_and_build FOLDER CMAKE-ARGUMENT...: all, or the targets in `target`, set for the call.
configure_and_build()
{
  local folder="$1" steps
  shift
  # The cache of a copied or moved clone names another folder.
  if [ -f "$folder/CMakeCache.txt" ] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    find "$folder" -mindepth 1 -maxdepth 1 ! -name '*.log' -exec rm -rf {} +
  fi
  rm -f "$folder/configure.log" "$folder/build.log"
  logged "$folder/configure.log" cmake -S "$root" -B "$folder" -G Ninja \
    -DPython3_EXECUTABLE=/usr/bin/python3 "$@" || return 1
  # A separate file, because a dry run of build.ninja itself only lists that CMake may run again.
  echo 'include build.ninja' > "$folder/count.ninja"
  # shellcheck disable=SC2086
  steps="$(cmake --build "$folder" --target ${target:-all} -- -f count.ninja -n |
    grep -c '^\[' || true)"
  if [ "$steps" != 0 ]; then
    say "Building in $folder: $steps steps, about $((1 + steps * 9 / 120 / $(nproc))) min"
    echo "What the compiler says is in $folder/build.log"
  fi
  # shellcheck disable=SC2086
  logged "$folder/build.log" \
    cmake --build "$folder" --target ${target:-all} -j "$(nproc)"
}

# The Release build that the examples and the tests share.
build_release()
{
  local warnings=OFF
  if [ "${CI:-}" = true ]; then
    warnings=ON
  fi
  need_for_window
  configure_and_build "$build" -DCMAKE_BUILD_TYPE=Release "${anew_for_window[@]}" \
    -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=ON -DRectifiedTransport_BUILD_EXAMPLES=ON \
    -DRectifiedTransport_UNITY_BUILD=ON \
    -DCMAKE_COMPILE_WARNING_AS_ERROR="$warnings" "$@"
}

# Runs a command on a virtual display: the same pictures with and without a screen.
with_display()
{
  xvfb-run -a -n "${first_display:-99}" -s "-screen 0 1600x1200x24 -noreset" "$@"
}
