#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and runs every test; ctest's summary comes last.
source "$(dirname "${BASH_SOURCE[0]}")/../CMake/setup.sh"

usage()
{
  cat << 'TEXT'
usage: bash Testing/run.sh [--long] [--gui] [--core] [--asan] [--tsan] [--vtk]
                           [--package] [--all] [--quick] [--suite SUITE]...
  Builds Release into build/ and runs its tests. Further legs:
  --long   also the tests that take minutes; others run on more ranks
  --gui    also the tests that drive ParaView's own window, on a virtual display
  --core   the core without VTK and OpenCL, its tests and its installation, in build-core/
  --asan   the C++ tests under AddressSanitizer and UndefinedBehaviorSanitizer, in build-asan/
  --tsan   the core's parallel tests under ThreadSanitizer, with Clang's OpenMP, in build-tsan/
  --vtk    the tests against the suite's own plain VTK, unpacked into build-vtk-prefix/
  --package  makes a Debian package in build-package/, and installs, uses and removes it in a bare
           system of this suite, made by debootstrap in build-suites/. Needs root or sudo, and 4 GB.
  --all    all of these
  --quick  the Python tests alone, without slow ones and the examples, and a build of what they need
  --suite  runs Examples/run.sh, and this command with the other arguments, in another suite of
           Debian (trixie, sid) instead of here: a bare system made by debootstrap, which is kept
           in build-suites/, or in the folder that RT_SUITES names. Needs root or sudo, and up to
           6 GB a suite. With --quick, of the examples only the main job.
TEXT
}

arguments=() suites=()
long=0 gui=0 core=0 asan=0 tsan=0 vtk=0 package=0 quick=0
while [ $# -gt 0 ]; do
  case "$1" in
    --long) long=1 ;;
    --gui) gui=1 ;;
    --core) core=1 ;;
    --asan) asan=1 ;;
    --tsan) tsan=1 ;;
    --vtk) vtk=1 ;;
    --package) package=1 ;;
    --all) long=1 gui=1 core=1 asan=1 tsan=1 vtk=1 package=1 ;;
    --quick) quick=1 ;;
    --suite)
      if ! [[ "${2:-}" =~ ^[a-z]+$ ]]; then
        echo "--suite needs the name of a suite of Debian: trixie or sid" >&2
        exit 2
      fi
      suites+=("$2")
      shift 2
      continue
      ;;
    --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
  arguments+=("$1")
  shift
done

# The files that git tracks, as they are now; without git, all but what is built.
pack_source()
{
  if git -C "$root" rev-parse --verify -q HEAD > /dev/null 2>&1; then
    (cd "$root" && git ls-files | while read -r file; do [ ! -e "$file" ] || echo "$file"; done |
      tar --files-from - -cf "$1")
  else
    tar -C "$root" --exclude './build*' --exclude './install*' --exclude ./Examples/output -cf "$1" .
  fi
}

run_suites()
{
  local suite source="$root/build-suites/source.tar" commit
  local folder="${RT_SUITES:-$root/build-suites}"
  if [ "$(id -u)" != 0 ] && ! command -v sudo > /dev/null; then
    echo "--suite makes a system by debootstrap, for which it needs root or sudo" >&2
    failed=" --suite"
    return
  fi
  need debootstrap debian-archive-keyring
  mkdir -p "$root/build-suites" "$folder"
  exec 9> "$folder/lock"
  if ! flock --nonblock 9; then
    echo "Waiting for another run in $folder"
    flock 9
  fi
  pack_source "$source"
  commit="$(git -C "$root" describe --always --dirty 2> /dev/null || echo 'no commit')"
  for suite in "${suites[@]}"; do
    as_root env RT_SUITES="$folder" \
      bash "$root/Testing/suite.sh" "$suite" "$source" "$commit" "${arguments[@]}" || {
      [ $? != 130 ] || exit 130 # interrupted
      failed="$failed $suite"
    }
  done
}

# Of the core, those that run on several threads.
parallel_tests="Invariance*:FlowMap*:SplatOrder*:SplatContext*:Context*:Progress*:Lattice*:Tables*"
parallel_tests="$parallel_tests:PivotLattice*:MapDerivatives*:NearestNeighbours*:SiteCells*"
parallel_tests="$parallel_tests:SolidCoverage*:Executors*:LoopTeam*"
parallel_tests="$parallel_tests:AreaPreserving*:ConformalMap*:CutSurface*:MassRaster*:SurfaceSamples*"
parallel_tests="$parallel_tests:Tiles*:TilesOnRanks*:TileSchedule*:PartTables*:Ranks*:RankOrder*:SplatPart*"
parallel_tests="$parallel_tests:BoxesByTiles*:BlockShares*:ParticleQuality*"
parallel_tests="$parallel_tests:PowerDiagram*:EqualMassPartition*:PowerSiteCells*:Repulsion*"
# Limits the memory of its process, which the sanitizer needs more of.
parallel_tests="$parallel_tests:-*.TakeTheMemoryForetold"

# run_tests FOLDER CTEST-ARGUMENT...
run_tests()
{
  local folder="$1"
  shift
  say "Tests of $folder"
  # As on a fresh system: it hides what a test does not flush.
  unset PYTHONUNBUFFERED
  with_display ctest --test-dir "$folder" --output-on-failure -j "$(nproc)" "$@" < /dev/null
}

# The legs below run as conditions, where bash does not stop at errors by itself: hence each &&.
run_core()
{
  # All other legs have OpenCL, if its header is there.
  configure_and_build "$root/build-core" --preset core -DRectifiedTransport_OPENCL=OFF &&
    run_tests "$root/build-core"
}

run_asan()
{
  configure_and_build "$root/build-asan" --preset asan &&
    run_tests "$root/build-asan" -LE '^(long|gui|install)$'
}

# Archer tells the sanitizer what Clang's OpenMP guarantees; without it all is a race. Where one
# thread does everything there is none: the tests that are left out have no threads.
run_tsan()
{
  local folder="$root/build-tsan" archer library
  need clang libomp-dev || return 1
  archer="$(dirname "$(readlink -f "$(command -v clang)")")/../lib/libarcher.so"
  target="RectifiedTransportCoreTests RectifiedTransportSurfacesTests" \
    configure_and_build "$folder" --preset tsan || return 1
  say "Tests of $folder"
  for library in Core Surfaces; do
    OMP_NUM_THREADS=3 OMP_TOOL_LIBRARIES="$archer" \
      TSAN_OPTIONS="ignore_noninstrumented_modules=1 allocator_may_return_null=1 halt_on_error=1" \
      "$folder/bin/RectifiedTransport${library}Tests" --gtest_brief=1 \
      --gtest_filter="$parallel_tests" || return 1
  done
}

# ParaView and libvtk9-dev exclude each other as packages; unpacked they do not meet.
unpack_vtk()
{
  local prefix="$1" package
  if [ -f "$prefix/complete" ]; then
    return 0
  fi
  say "Fetching the plain VTK (libvtk9-dev, 40 MB)"
  rm -rf "$prefix"
  mkdir -p "$prefix/debs" && chmod 777 "$prefix/debs" && cd "$prefix/debs" &&
    download libvtk9-dev vtk9 python3-vtk9 libvtk9-java \
      $(apt-cache depends python3-vtk9 | sed -n 's/.*Depends: \(libvtk9\.[0-9a-z.-]*\)$/\1/p') ||
    return 1
  for package in *.deb; do
    dpkg -x "$package" "$prefix" || return 1
  done
  touch "$prefix/complete"
}

run_vtk()
{
  local folder="$root/build-vtk" prefix="$root/build-vtk-prefix" arch
  arch="$(gcc -print-multiarch)"
  need $packages_vtk && (unpack_vtk "$prefix") &&
    configure_and_build "$folder" -DCMAKE_BUILD_TYPE=Release \
      -DRectifiedTransport_BUILD_TESTING=ON -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=OFF \
      -DVTK_DIR="$(echo "$prefix/usr/lib/$arch/cmake"/vtk-9.*)" &&
    LD_LIBRARY_PATH="$prefix/usr/lib/$arch" PYTHONPATH="$prefix/usr/lib/python3/dist-packages" \
      run_tests "$folder" -LE '^(long|gui)$'
}

run_package()
{
  local folder="$root/build-package" suite
  need debootstrap debian-archive-keyring dpkg-dev file || return 1
  # As apt has it, if it has lists: in sid VERSION_CODENAME is that of the next release.
  suite="$(apt-get indextargets --format '$(ORIGIN) $(LABEL) $(CODENAME)' |
    sed -nE 's/^Debian Debian ([a-z]+)$/\1/p' | head -n 1)"
  # shellcheck disable=SC1091
  suite="${suite:-$(. /etc/os-release && echo "${VERSION_CODENAME:-}")}"
  if [ -z "$suite" ]; then
    echo "--package needs a suite of Debian, in apt's sources or as VERSION_CODENAME in /etc/os-release:" \
      "the package is tried in a bare one" >&2
    return 1
  fi
  need_for_window
  configure_and_build "$folder" --preset package "${anew_for_window[@]}" || return 1
  rm -f "$folder"/*.deb
  (cd "$folder" && logged "$folder/cpack.log" cpack -G DEB) || return 1
  mkdir -p "$root/build-suites"
  as_root bash "$root/Testing/package.sh" "$suite" "$(echo "$folder"/*.deb)" || {
    [ $? != 130 ] || exit 130 # interrupted
    return 1
  }
}

failed=""
skipped=""
if [ ${#suites[@]} -gt 0 ]; then
  run_suites
  [ -z "$failed" ]
  exit
fi
need_to_build $packages_render $packages_test
if [ "$(dpkg-query -W -f '${db:Status-Status}' pocl-opencl-icd 2> /dev/null)" = installed ]; then
  export RT_OPENCL=1 # there is a device: no test may be skipped for want of one
fi
need_meshes
if [ $long = 0 ]; then
  skipped="$skipped|long"
else
  export RT_RANKS="2 3 4"
fi
if [ $gui = 0 ]; then
  skipped="$skipped|gui"
else
  need $packages_gui
fi
if [ $core = 1 ]; then
  run_core || failed="$failed --core"
fi
if [ $asan = 1 ]; then
  run_asan || failed="$failed --asan"
fi
if [ $tsan = 1 ]; then
  run_tsan || failed="$failed --tsan"
fi
if [ $vtk = 1 ]; then
  run_vtk || failed="$failed --vtk"
fi
if [ $package = 1 ]; then
  run_package || failed="$failed --package"
fi
if [ $quick = 1 ]; then
  tests=(-L '^python$')
  skipped="$skipped|example|slow"
  target=RectifiedTransportPythonTests build_release -DRectifiedTransport_BUILD_TESTING=ON
else
  tests=()
  build_release -DRectifiedTransport_BUILD_TESTING=ON -DRectifiedTransport_BUILD_BENCHMARKS=ON
fi
if [ -n "$failed" ]; then
  say "Failed legs, see above:$failed"
fi
run_tests "$build" "${tests[@]}" -LE "^(none$skipped)\$"
[ -z "$failed" ]
