#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random pipelines through all filters, each case under several numbers of threads, threading
backends and instruction sets.

usage: python3 run.py [--first N] [--count N] [--seed S] [--jobs N] [--limit SECONDS]
                     [--crafted | --written] [--once] [--filter NAME] PROGRAM

With --crafted the cases are inputs that are broken on purpose, through all filters: files that
VTK's readers read, and data objects with the same defects. Where a reader itself ends the program,
the case is counted and left out. With --written they are the writers' files, to targets of any
kind. --once runs each case under the last setting alone, for sanitizers.
--filter runs only the cases of one filter, as the table names it.

PROGRAM (Campaign.cxx) runs the cases and looks at each output. This script compares what comes out
under every setting, to the last bit, and goes on where PROGRAM does not: a case that crashes or
hangs is reported, and the next one follows. `PROGRAM --case N --seed S` prints the steps of a case.
"""
import argparse
import collections
import concurrent.futures
import os
import signal
import subprocess
import sys
import tempfile

# (name, instruction set, VTK's backend, threads). Auto and OpenMP run on OMP_NUM_THREADS threads,
# VTK on its backend. Where a machine lacks an instruction set it runs the widest that it has. The
# first computes on the processor what the others compute on a device, if there is one.
SETTINGS = [
    ("SSE2, one thread", "SSE2", "Sequential", 1),
    ("AVX2, two threads of OpenMP", "AVX2", "Sequential", 2),
    ("AVX512, two threads of VTK", "AVX512", "STDThread", 2),
]
BLOCK = 100


class Case:
    def __init__(self, line):
        fields = line.split()
        self.number = int(fields[0])
        self.digest = fields[1]
        self.filter = fields[3]
        self.counts = [int(field) for field in fields[4:8]]
        self.milliseconds = float(fields[8])
        self.input = fields[9]
        self.findings = []


def run_cases(program, setting, seed, first, count, limit, kind, files, only):
    """The cases of a block, and the ends of processes: [(case, text)]. Kind: crafted, written or
    neither; their files are in a folder.
    Only: the name of a filter."""
    _, instructions, backend, threads = setting
    environment = dict(os.environ, RECTIFIEDTRANSPORT_ISA=instructions, OMP_NUM_THREADS=str(threads),
                       OMP_WAIT_POLICY="passive", OMP_DYNAMIC="false",
                       RT_CAMPAIGN_PROCESSOR=str(int(setting == SETTINGS[0])))
    cases, ends = [], []
    end = first + count
    while first < end:
        command = [program, "--first", str(first), "--count", str(end - first), "--seed", str(seed),
                   "--backend", backend, "--threads", str(threads)]
        if threads > 1:
            command += ["--fork", "16"]  # children have none of the threads
        if only:
            command += ["--filter", only]
        if kind:
            folder = os.path.join(files, f"{backend}-{threads}-{first}")
            os.makedirs(folder)
            command += [f"--{kind}", folder]
        process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        try:
            output, errors = process.communicate(timeout=limit)
            code = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            output, errors = process.communicate()
            code = None
        doing = ""
        for line in output.splitlines():
            if line.startswith("#"):
                doing = line[2:]
            elif line.startswith("!"):
                if line[2:] not in cases[-1].findings:
                    cases[-1].findings.append(line[2:])
            elif line:
                cases.append(Case(line))
                first = cases[-1].number + 1
        if code in (0, 1) and (first == end or only):
            break
        if code is None or code == -signal.SIGPROF:
            how = "did not end"
        else:
            how = f"ended the program with {code}"
        ends.append((first, doing, f"{how}{' while ' + doing if doing else ''}: {errors.strip()[-2000:]}"))
        first += 1
    return cases, ends


def available(program):
    """VTK has not always all of the backends."""
    settings = []
    for setting in SETTINGS:
        probe = subprocess.run([program, "--count", "0", "--backend", setting[2]],
                               stderr=subprocess.DEVNULL)
        if probe.returncode == 0:
            settings.append(setting)
        elif probe.returncode == 2:
            print(f"left out, VTK has no backend {setting[2]}: {setting[0]}")
        else:
            sys.exit(f"{program} ends with {probe.returncode} before its first case")
    if not settings:
        sys.exit("VTK has none of the backends")
    return settings


class Campaign:
    def __init__(self, settings):
        self.settings = settings
        self.done = 0
        self.wrong = 0
        self.readers = set()  # cases whose reader ended the program
        self.by_filter = collections.defaultdict(lambda: [0, 0, 0, 0, 0, 0.0])

    def report(self, number, text):
        print(f"case {number}: {text}", flush=True)

    def judge(self, results):
        """The block's results of all settings."""
        failed = set()
        for setting, (cases, ends) in zip(self.settings, results):
            for number, doing, text in ends:
                if doing.startswith("reading"):
                    self.readers.add(number)
                    continue
                failed.add(number)
                self.report(number, f"{setting[0]}: {text}")
            for case in cases:
                for finding in case.findings:
                    failed.add(case.number)
                    self.report(case.number, f"{case.filter}, {setting[0]}: {finding}")
        digests = collections.defaultdict(set)
        for cases, _ in results:
            for case in cases:
                digests[case.number, case.input].add(case.digest)
        for (number, _), found in sorted(digests.items()):
            if len(found) > 1:
                failed.add(number)
                self.report(number, f"{len(found)} results that differ")
        for case in results[0][0]:
            row = self.by_filter[case.filter]
            row[0] += 1
            for i, count in enumerate(case.counts):
                row[i + 1] += count
            row[5] += case.milliseconds
        self.wrong += len(failed)

    def summarize(self):
        head = ["filter", "cases", "runs", "errors", "aborts", "out of memory", "ms a case"]
        print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
        rows = sorted(self.by_filter.items())
        totals = [sum(row[i] for _, row in rows) for i in range(6)]
        if totals[0] == 0:
            sys.exit("no case ran: names for --filter are those of the first column, as Sampler")
        for name, row in rows + [("all", totals)]:
            mean = f"{row[5] / max(1, row[0]):.1f}"
            print("| " + " | ".join([name] + [str(value) for value in row[:5]] + [mean]) + " |")
        if self.readers:
            print(f"left out, VTK's own reader ends the program: {len(self.readers)}")
        print(f"{totals[0]} cases under {len(self.settings)} settings each, {self.wrong} of them wrong")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--limit", type=int, default=600, help="seconds for a block of cases")
    parser.add_argument("--crafted", dest="kind", action="store_const", const="crafted",
                        help="broken inputs")
    parser.add_argument("--written", dest="kind", action="store_const", const="written",
                        help="files of the writers")
    parser.add_argument("--filter", help="its random cases alone")
    parser.add_argument("--once", action="store_true", help="under the last setting alone")
    parser.add_argument("program")
    arguments = parser.parse_args()
    settings = available(arguments.program)[-1 if arguments.once else 0:]
    campaign = Campaign(settings)
    end = arguments.first + arguments.count
    blocks = [(first, min(BLOCK, end - first)) for first in range(arguments.first, end, BLOCK)]
    with tempfile.TemporaryDirectory() as folder, \
            concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        jobs = [[pool.submit(run_cases, arguments.program, setting, arguments.seed, first, count,
                             arguments.limit, arguments.kind, folder, arguments.filter)
                 for setting in settings] for first, count in blocks]
        for block in jobs:
            campaign.judge([job.result() for job in block])
    campaign.summarize()
    return 1 if campaign.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
