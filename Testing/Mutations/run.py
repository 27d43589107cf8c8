#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the tests notice wrong programs.

Copies the sources, plants all wrong changes of mutations.py behind a switch, builds once and runs
the tests with each of them switched on, until one fails. Prints a table.

usage: run.py --source DIR --build DIR [--jobs N] [--only NUMBER...] [--set survived|others|all]
       run.py --check    only whether each change still finds its place in the sources
"""
import argparse
import math
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
# Devices compile texts at run time: they get the switch as an option of their compilers.
DEVICE_OPTIONS = ("Filters/Devices/FlowPrograms.cxx", '"-cl-std=CL1.2 -D RT_D="',
                  f'"-cl-std=CL1.2 -D {SWITCH}=" + std::to_string({SWITCH}) + " -D RT_D="')
# Which tests come first: whether only those near the change, and how many seconds they may take.
ORDER = [(True, 2), (True, 20), (False, 2), (True, math.inf), (False, 20), (False, math.inf)]
LEFT_OUT = "long|gui|install|benchmark|example|campaign"
# Digests tell that something has changed, not that it is wrong; the switch is in no namespace and
# breaks lines as it likes, and changes can be planted only once. Budgets of lines leave no room for it.
LEFT_OUT_NAMES = "^core[.]Bits|TestDigests|abi_namespace|^house[.]|^mutations[.]"


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
    file, right, wrong = DEVICE_OPTIONS
    if name == file:
        assert data.count(right.encode()) == 1, f"{file} has not once: {right}"
        data = data.replace(right.encode(), wrong.encode())
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
    """Copies the tracked files, with the changes behind their switch. Whether any is new."""
    new = False
    names = subprocess.run(["git", "-C", source, "ls-files", "-z"], check=True,
                           capture_output=True, text=True).stdout.split("\0")[:-1]
    for name in names:
        path = pathlib.Path(source, name)
        if not path.exists():
            continue
        target = pathlib.Path(copy, name)
        if write(target, planted(path, name, chosen)):
            shutil.copymode(path, target)
            new = True
    return write(pathlib.Path(copy, "mutation.h"), HEADER.encode()) or new


def build(copy, folder, meshes, jobs):
    if not pathlib.Path(folder, "CMakeCache.txt").exists():
        subprocess.run(
            ["cmake", "-S", copy, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             "-DPython3_EXECUTABLE=/usr/bin/python3", f"-DCMAKE_CXX_FLAGS=-include {copy}/mutation.h",
             "-DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=ON", "-DRectifiedTransport_BUILD_TESTING=ON",
             "-DRectifiedTransport_UNITY_BUILD=ON",
             f"-DRectifiedTransport_MESHES={meshes}"],
            check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "-j", str(jobs)], check=True,
                   stdout=subprocess.DEVNULL)


def ctest(folder, number, arguments):
    """The first test that fails, or None, and ctest's output."""
    environment = dict(os.environ, OMP_WAIT_POLICY="passive", **{SWITCH: str(number)})
    # With these ctest would begin with the longest.
    costs = pathlib.Path(folder, "Testing/Temporary/CTestCostData.txt")
    costs.unlink(missing_ok=True)
    result = subprocess.run(
        ["xvfb-run", "-a", "-s", "-screen 0 1600x1200x24 -noreset", "ctest", "--test-dir", folder,
         "--stop-on-failure", "--timeout", "240", *arguments],
        env=environment, capture_output=True, text=True)
    failed = re.findall(r"Test +#\d+: (\S+) .*\*\*\*(?!Not Run|Skipped)(.*)", result.stdout)
    if not failed and result.returncode != 0:
        raise SystemExit(result.stdout + result.stderr)
    return (failed[0][0] if failed else None), result.stdout


class Tests:
    """Those of a build without wrong changes, by number, with the seconds that they took."""

    def __init__(self, source, folder, jobs, new):
        self.source = pathlib.Path(source)
        self.folder = folder
        self.jobs = jobs
        log = pathlib.Path(folder, "without_changes.log")
        if new:
            log.unlink(missing_ok=True)
        if not log.exists():
            failure, output = ctest(folder, 0, ["-j", str(jobs), "-LE", LEFT_OUT,
                                                "-E", LEFT_OUT_NAMES])
            if failure:
                raise SystemExit(f"{failure} fails without any wrong change")
            log.write_text(output)
        # With filters ctest numbers otherwise.
        listed = subprocess.run(["ctest", "--test-dir", folder, "-N"], check=True,
                                capture_output=True, text=True).stdout
        numbers = {name: int(number) for number, name in
                   re.findall(r"Test +#(\d+): (\S+)", listed)}
        self.found = [(numbers[name], name, float(seconds)) for name, seconds in
                      re.findall(r"Test +#\d+: (\S+) .*Passed +([0-9.]+) sec", log.read_text())]

    def near(self, file):
        """Matches tests whose source names the changed file, or lies in a room of its name."""
        rooms = pathlib.Path(file).parent.parts[2:]
        word = re.compile(rf"\b{pathlib.Path(file).stem}\b")
        names = {f"Test{room}\\w*" for room in rooms}
        for path in [*self.source.glob("Testing/[CDS]*/**/Test*.cxx"),
                     *self.source.glob("Testing/Python/*/Test*.py")]:
            text = path.read_text()
            if word.search(text) or set(rooms) & set(path.parent.parts):
                names |= {path.stem, *re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+)", text, re.M)}
        return re.compile(rf"(?:.*[./-])?(?:{'|'.join(names)})(?:[./<].*)?").fullmatch

    def groups(self, file):
        """Lists of numbers: what is near the change and what is quick comes first."""
        near = self.near(file)
        inside = file.startswith(("Filters/Core/", "Filters/Surfaces/", "Filters/Devices/"))
        left = [test for test in self.found if inside or not test[1].startswith("core.")]
        for closest, longest in ORDER:
            group = [test for test in left if test[2] < longest and (not closest or near(test[1]))]
            left = [test for test in left if test not in group]
            yield [number for number, _, _ in group]

    def first_failure(self, file, number):
        """The first test that fails with a wrong change, or None."""
        for group in self.groups(file):
            if not group:
                continue
            listed = ",".join(map(str, ["0,0,0", *group]))
            failure, _ = ctest(self.folder, number, ["-j", str(self.jobs), "-I", listed])
            if failure:
                return failure.replace("RectifiedTransport::vtkRectifiedTransport", "")
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
    new = plant(options.source, str(copy), everything)
    build(str(copy), folder, meshes, options.jobs)
    tests = Tests(copy, folder, options.jobs, new)

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
            failure = tests.first_failure(mutation.file, number)
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
