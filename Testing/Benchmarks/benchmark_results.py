# SPDX-License-Identifier: BSD-3-Clause
"""What the benchmarks reported, and how run.py prints it."""
import os
import statistics
import sys
import textwrap


class Results:
    """Medians of the repetitions' times (ms) and counters by benchmark name."""

    def __init__(self, report):
        self.context = report["context"]
        self.runs = {}
        self.add(report)

    def add(self, report):
        for entry in report["benchmarks"]:
            if entry.get("error_occurred"):
                sys.exit(f"{entry['name']}: {entry['error_message']}")
            if entry["run_type"] == "iteration":
                name = entry["run_name"]
                for suffix in ("/real_time", "/manual_time", "/iterations:1", "/repeats:1"):
                    name = name.replace(suffix, "")
                manual = entry["run_name"].endswith("/manual_time")
                entry["time"] = entry["real_time" if manual else "cpu_time"]
                self.runs.setdefault(name, []).append(entry)

    def median(self, name, what="time"):
        return statistics.median(entry[what] for entry in self.runs[name])

    def ratio(self, slow, fast, what="time"):
        return self.median(slow, what) / self.median(fast, what)

    def errors(self, name):
        return " / ".join(f"{self.median(name, what):.2g}"
                          for what in ("error_mean", "error_95", "error_999"))

    def time(self, name):
        return milliseconds(self.median(name))

    def timed(self, name, paper):
        return f"{self.time(name)}, {self.ratio(paper, name):.1f}×"

    def threads(self, name, kind):
        return f"{self.ratio(name % kind, name % f'{kind}_2_threads', 'real_time'):.2f}×"

    def strays(self, name):
        return " and ".join(f"{self.median(name, what):.0f}" for what in ("in_empty_cells", "lost"))


def milliseconds(value):
    return f"{value / 1000:.3g} s" if value >= 1000 else f"{value:.3g} ms"


def print_table(head, rows):
    lines = ["|" + "".join(f" {cell} |" if cell else " |" for cell in row) for row in (head, *rows)]
    print(lines[0], "|" + "---|" * len(head), *lines[1:], "", sep="\n")


def print_text(text):
    print(textwrap.fill(text, 100) + "\n")


def expect_no_strays(r, name):
    if r.strays(name) != "0 and 0":
        print(f"Speed.md says none, but {name} has strays: {r.strays(name)}", file=sys.stderr)


def grids(group, squares=()):
    """The labels and benchmarks of squares with these sides, and of the cubes."""
    return ([(f"{side}²", f"{group}2D/%s/{side}") for side in squares] +
            [(f"{side}³", f"{group}3D/%s/{side}") for side in (64, 128, 256)])


def processor():
    if os.path.exists("/proc/cpuinfo"):
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            for line in lines:
                if line.startswith("model name"):
                    return line.split(":")[1].strip()
    return "unknown processor"


def machine(results):
    context = results.context
    return (f"{processor()} ({context['num_cpus']} processors, {context['mhz_per_cpu']} MHz, "
            f"{context.get('instruction_set', '?')} kernels, gcc {context.get('compiler', '?')})")
