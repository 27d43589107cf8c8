#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and runs every test; ctest's summary comes last.
source "$(dirname "${BASH_SOURCE[0]}")/../CMake/setup.sh"

usage()
{
  cat << 'TEXT'
usage: bash Testing/run.sh [--long] [--gui] [--asan] [--tsan] [--vtk91] [--all]
  Builds Release into build/ and runs its tests. Further legs:
  --long   also the tests that take minutes
  --gui    also the tests that drive ParaView's own window, on a virtual display
  --asan   the C++ tests under AddressSanitizer and UndefinedBehaviorSanitizer, in build-asan/
  --tsan   the core's parallel tests under ThreadSanitizer, with Clang's OpenMP, in build-tsan/
  --vtk91  the tests against a plain VTK 9.1, unpacked into build-vtk91/
  --all    all of these
TEXT
}

long=0 gui=0 asan=0 tsan=0 vtk91=0
for argument in "$@"; do
  case "$argument" in
    --long) long=1 ;;
    --gui) gui=1 ;;
    --asan) asan=1 ;;
    --tsan) tsan=1 ;;
    --vtk91) vtk91=1 ;;
    --all) long=1 gui=1 asan=1 tsan=1 vtk91=1 ;;
    --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

# Of the core, those that run on several threads.
parallel_tests="Invariance*:SplatOrder*:SplatMonitor*:Monitor*:Lattice*:Tables*:CellSamples*"
parallel_tests="$parallel_tests:MapDerivatives*:NearestNeighbours*:SiteCells*:SolidCoverage*"

# run_tests FOLDER CTEST-ARGUMENT...
run_tests()
{
  local folder="$1"
  shift
  say "Tests of $folder"
  with_display ctest --test-dir "$folder" --output-on-failure -j "$(nproc)" "$@" < /dev/null
}

# The legs below run as conditions, where bash does not stop at errors by itself: hence each &&.
run_asan()
{
  configure_and_build "$root/build-asan" --preset asan &&
    run_tests "$root/build-asan" -LE '^(long|gui|install)$'
}

# Archer tells the sanitizer what Clang's OpenMP guarantees; without it all is a race. Where one
# thread does everything there is none: the tests that are left out have no threads.
run_tsan()
{
  local folder="$root/build-tsan" archer
  need clang libomp-dev && mkdir -p "$folder" || return 1
  archer="$(dirname "$(readlink -f "$(command -v clang)")")/../lib/libarcher.so"
  cmake -S "$root" -B "$folder" -G Ninja --preset tsan -DPython3_EXECUTABLE=/usr/bin/python3 \
    > "$folder/configure.log" && cmake --build "$folder" -j "$(nproc)" \
    --target RectifiedTransportCoreTests || return 1
  say "Tests of $folder"
  OMP_NUM_THREADS=3 OMP_TOOL_LIBRARIES="$archer" \
    TSAN_OPTIONS="ignore_noninstrumented_modules=1 allocator_may_return_null=1 halt_on_error=1" \
    "$folder/bin/RectifiedTransportCoreTests" --gtest_brief=1 --gtest_filter="$parallel_tests"
}

# ParaView and libvtk9-dev exclude each other as packages; unpacked they do not meet.
unpack_vtk91()
{
  local prefix="$1" package
  if [ -f "$prefix/complete" ]; then
    return 0
  fi
  rm -rf "$prefix"
  mkdir -p "$prefix/debs" && chmod 777 "$prefix/debs" && cd "$prefix/debs" &&
    apt-get download libvtk9-dev libvtk9.1 libvtk9.1-qt vtk9 python3-vtk9 libvtk9-java || return 1
  for package in *.deb; do
    dpkg -x "$package" "$prefix" || return 1
  done
  touch "$prefix/complete"
}

run_vtk91()
{
  local folder="$root/build-vtk91" prefix="$root/build-vtk91/prefix" arch
  arch="$(gcc -print-multiarch)"
  need $packages_vtk91 && (unpack_vtk91 "$prefix") &&
    configure_and_build "$folder" -DCMAKE_BUILD_TYPE=Release \
      -DRectifiedTransport_BUILD_TESTING=ON -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=OFF \
      -DVTK_DIR="$prefix/usr/lib/$arch/cmake/vtk-9.1" &&
    LD_LIBRARY_PATH="$prefix/usr/lib/$arch" PYTHONPATH="$prefix/usr/lib/python3/dist-packages" \
      run_tests "$folder" -LE '^(long|gui)$'
}

failed=""
skipped=""
need $packages_build $packages_render $packages_test
need_meshes
if [ $long = 0 ]; then
  skipped="$skipped|long"
fi
if [ $gui = 0 ]; then
  skipped="$skipped|gui"
else
  need $packages_gui
fi
if [ $asan = 1 ]; then
  run_asan || failed="$failed --asan"
fi
if [ $tsan = 1 ]; then
  run_tsan || failed="$failed --tsan"
fi
if [ $vtk91 = 1 ]; then
  run_vtk91 || failed="$failed --vtk91"
fi
build_release -DRectifiedTransport_BUILD_TESTING=ON -DRectifiedTransport_BUILD_BENCHMARKS=ON
if [ -n "$failed" ]; then
  say "Failed legs, see above:$failed"
fi
run_tests "$build" -LE "^(none$skipped)\$"
[ -z "$failed" ]
