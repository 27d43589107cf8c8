#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, runs the benchmarks and prints the tables of
# Documentation/Speed.md. Arguments go to run.py.
source "$(dirname "${BASH_SOURCE[0]}")/../../CMake/setup.sh"

need_to_build $packages_render $packages_test
build_release -DRectifiedTransport_BUILD_TESTING=ON -DRectifiedTransport_BUILD_BENCHMARKS=ON
/usr/bin/python3 "$root/Testing/Benchmarks/run.py" "$build/bin/RectifiedTransportBenchmarks" "$@"
