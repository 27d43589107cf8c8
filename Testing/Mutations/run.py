#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the tests notice wrong programs.

Copies the sources, plants all wrong changes of mutations.py behind a switch, builds once and runs
the tests with each of them switched on, until one fails. Prints a table.

usage: run.py --source DIR --build DIR [--jobs N] [--only NUMBER...] [--set survived|others|all]
       run.py --check    only whether each change still finds its place in the sources
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import mutations

SWITCH = "RECTIFIEDTRANSPORT_MUTATION"
HEADER = f"""#pragma once
#ifdef __cplusplus
#include <cstdlib>
inline int {SWITCH}_read()
{{
  const char* number = std::getenv("{SWITCH}");
  return number ? std::atoi(number) : 0;
}}
inline int {SWITCH} = {SWITCH}_read();
#endif
"""
# Which tests come first, by where the change is: what fails, fails soon.
ORDER = [
    ("Filters/Core/", ["^core[.]", "Cxx-", "^python[.]"]),
    ("Filters/", ["Cxx-", "^core[.]", "^python[.]"]),
    ("Plugin/", ["^python[.]"]),
]
LEFT_OUT = "long|gui|install|benchmark|example|campaign"
# Tells that something has changed, not that it is wrong.
DIGESTS = "^core[.]Bits|TestDigests"


def changed(text, mutation, number):
    """The source with the change behind its switch, or for XML in place of what was right."""
    marked = re.fullmatch("(.*)«(.*)»(.*)", mutation.right, re.S)
    before, right, after = marked.groups() if marked else ("", mutation.right, "")
    place = before + right + after
    if text.count(place) != 1:
        raise SystemExit(f"{mutation.file} has {text.count(place)} times: {place}")
    condition = f"({SWITCH} == {number})"
    if mutation.kind == "E":
        # What begins with a binary operator takes its left side along.
        operator = re.match(r"([-+<>=!*/]+)(?=\s)", right)
        if operator:
            raise SystemExit(f"{mutation.file}: begin left of the operator: {right}")
        new = f"({condition} ? ({mutation.wrong}) : ({right}))"
    elif mutation.kind == "S":
        new = f"if {condition} {{ {mutation.wrong} }} else {{ {right} }}"
    elif mutation.kind == "T":
        new = mutation.wrong.replace("MUTANT", condition)
    else:
        new = mutation.wrong
    return text.replace(place, before + new + after)


def write(target, data):
    """Leaves a file that would not change its time, for quick builds. Returns whether it wrote."""
    if target.exists() and target.read_bytes() == data:
        return False
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(data)
    return True


def planted(path, name, chosen):
    """A file's bytes with the changes behind their switch."""
    data = path.read_bytes()
    here = [(n, m) for n, m in chosen if m.file == name and m.kind != "X"]
    if here:
        text = data.decode()
        for number, mutation in here:
            text = changed(text, mutation, number)
        data = text.encode()
    return data


def check(source, chosen):
    """Fails where a change does not find its place."""
    for name in sorted({mutation.file for _, mutation in chosen}):
        planted(pathlib.Path(source, name), name, chosen)
    for number, mutation in chosen:
        if mutation.kind == "X":
            changed(pathlib.Path(source, mutation.file).read_text(), mutation, number)
    print(f"all {len(chosen)} wrong changes find their place")


def plant(source, copy, chosen):
    """Copies the tracked files, with the changes behind their switch."""
    names = subprocess.run(["git", "-C", source, "ls-files", "-z"], check=True,
                           capture_output=True, text=True).stdout.split("\0")[:-1]
    for name in names:
        path = pathlib.Path(source, name)
        if not path.exists():
            continue
        target = pathlib.Path(copy, name)
        if write(target, planted(path, name, chosen)):
            shutil.copymode(path, target)
    write(pathlib.Path(copy, "mutation.h"), HEADER.encode())


def build(copy, folder, meshes, jobs):
    if not pathlib.Path(folder, "CMakeCache.txt").exists():
        subprocess.run(
            ["cmake", "-S", copy, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             "-DPython3_EXECUTABLE=/usr/bin/python3", f"-DCMAKE_CXX_FLAGS=-include {copy}/mutation.h",
             "-DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=ON", "-DRectifiedTransport_BUILD_TESTING=ON",
             f"-DRectifiedTransport_MESHES={meshes}"],
            check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "-j", str(jobs)], check=True,
                   stdout=subprocess.DEVNULL)


def first_failure(folder, file, number, jobs):
    """The first test that fails, or None."""
    environment = dict(os.environ, OMP_WAIT_POLICY="passive", **{SWITCH: str(number)})
    groups = next(groups for prefix, groups in ORDER if file.startswith(prefix))
    for group in groups:
        result = subprocess.run(
            ["xvfb-run", "-a", "-s", "-screen 0 1600x1200x24 -noreset", "ctest", "--test-dir",
             folder, "-j", str(jobs), "-R", group, "-LE", LEFT_OUT, "-E", DIGESTS,
             "--stop-on-failure", "--timeout", "240"],
            env=environment, capture_output=True, text=True)
        failed = re.findall(r"Test +#\d+: (\S+) .*\*\*\*(?!Not Run|Skipped)(.*)", result.stdout)
        if failed:
            return failed[0][0].replace("RectifiedTransport::vtkRectifiedTransport", "")
        if result.returncode != 0:
            raise SystemExit(result.stdout + result.stderr)
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    here = pathlib.Path(__file__).resolve().parent
    parser.add_argument("--source", default=str(here.parent.parent))
    parser.add_argument("--build", default=str(here.parent.parent / "build-mutations"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--set", default="all", choices=["survived", "others", "all"])
    parser.add_argument("--only", type=int, nargs="+")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    # CMake and the compiler run in other folders.
    options.source = os.path.abspath(options.source)
    options.build = os.path.abspath(options.build)
    meshes = f"{options.source}/build-meshes"

    everything = list(enumerate(mutations.SURVIVED + mutations.OTHERS, 1))
    known = len(mutations.SURVIVED)
    chosen = [(n, m) for n, m in everything
              if (options.set == "all" or (n <= known) == (options.set == "survived"))
              and (not options.only or n in options.only)]
    if options.check:
        check(options.source, everything)
        return 0
    copy = pathlib.Path(options.build, "source")
    folder = str(pathlib.Path(options.build, "build"))
    plant(options.source, str(copy), everything)
    build(str(copy), folder, meshes, options.jobs)
    failure = first_failure(folder, "Filters/Core/", 0, options.jobs)
    if failure:
        raise SystemExit(f"{failure} fails without any wrong change")

    caught = 0
    print("| | file | change | noticed by |\n|---|---|---|---|")
    for number, mutation in chosen:
        start = time.time()
        target = copy / mutation.file
        before = target.read_text()
        if mutation.kind == "X":
            target.write_text(changed(before, mutation, number))
            build(str(copy), folder, meshes, options.jobs)
        try:
            failure = first_failure(folder, mutation.file, number, options.jobs)
        finally:
            if mutation.kind == "X":
                target.write_text(before)
        caught += failure is not None
        wrong = " ".join(mutation.wrong.split()).replace("|", "\\|")
        print(f"| {number} | {mutation.file} | `{wrong}` | {failure or '**nothing**'} "
              f"({time.time() - start:.0f} s) |", flush=True)
    print(f"\n{caught} of {len(chosen)} wrong changes noticed")
    return 0 if caught >= 0.95 * len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
