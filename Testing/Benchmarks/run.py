# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and prints the tables of Documentation/Speed.md.

usage: python3 run.py [--repetitions N] [--quality | --morphs | --parameterization | --relaxation] PROGRAM

Every figure is the median of the repetitions, which are interleaved at random. One thread is
measured in processor time, two in wall-clock time.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile


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

    def timed(self, name, paper):
        return f"{milliseconds(self.median(name))}, {self.ratio(paper, name):.1f}×"

    def threads(self, name, side):
        return f"{self.ratio(f'{name}/{side}', f'{name}_2_threads/{side}', 'real_time'):.2f}×"


def milliseconds(value):
    return f"{value / 1000:.3g} s" if value >= 1000 else f"{value:.3g} ms"


def print_table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def machine(results):
    model = "unknown processor"
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
        model = names[0] if names else model
    except OSError:
        pass
    context = results.context
    return (f"{model}, {context['num_cpus']} processors, {context['mhz_per_cpu']} MHz, "
            f"{context.get('instruction_set', '?')} kernels, gcc {context.get('compiler', '?')}")


# Of one particle a cell: the text, the direction, the size and the filter.
GRIDS = (("one particle a pixel, photograph of 1024²: Transport Map", "2D/forward", 1024, "map"),
         ("the same backward", "2D/backward", 1024, "map"),
         ("one particle a cell, 64³: Sample Density", "3D/forward", 64, "sampler"),
         ("one particle a cell, 128³: Sample Density", "3D/forward", 128, "sampler"),
         ("one particle a cell, 256³: Sample Density", "3D/forward", 256, "sampler"),
         ("128³ backward: Transport Map", "3D/backward", 128, "map"))


def whole_jobs(r):
    jobs = [("40,000 particles, photograph of 1024²: Sample Density", "Photograph/%s", "filter")]
    jobs += [(text, f"OnePerCell{group}/%s/{side}", filter) for text, group, side, filter in GRIDS]
    rows = []
    for text, name, whole in jobs:
        paper = name % "paper"
        rows.append([text, milliseconds(r.median(paper))] +
                    [r.timed(name % kind, paper) for kind in
                     ("core", "core_again", "core_off", whole, f"{whole}_off")] +
                    [r.errors(name % kind) for kind in ("paper", "core", "core_off")])
    print_table(["work", "paper", "core, new density", "same density again",
                 "new density, without maps", "filter's whole update, new density", "without maps",
                 "error in cells (mean / 95 % / 99.9 %): paper", "core", "without maps"], rows)


def tables(r):
    rows = []
    for group, sides, power in (("Tables2D", (1024, 4096), "²"),
                                ("Tables3D", (64, 128, 256), "³")):
        for side in sides:
            name = f"{group}/%s/{side}"
            rows.append([f"{side}{power}", milliseconds(r.median(name % "paper")),
                         milliseconds(r.median(name % "core")),
                         f"{r.ratio(name % 'paper', name % 'core'):.1f}×",
                         f"{r.ratio(name % 'paper_reused', name % 'core_reused'):.1f}×",
                         f"{r.ratio(name % 'core', name % 'core_2_threads', 'real_time'):.2f}×"])
    print_table(["tables", "paper", "core", "ratio", "ratio in reused memory", "two threads"], rows)


def flows(r):
    costs, maps = [], []
    for group, sides, power in (("Flow2D", (256, 512, 1024, 2048, 4096), "²"),
                                ("Flow3D", (64, 128, 256), "³")):
        for side in sides:
            def cost(kind, what, scale, unit):
                return f"{scale * r.median(f'{group}/{kind}/{side}', what):.3g} {unit}"

            costs.append([f"{side}{power}"] +
                         [cost(kind, "per_velocity", 1e9, "ns") for kind in ("paper", "core_off")] +
                         [cost(kind, "per_particle", 1e6, "µs")
                          for kind in ("paper", "core_off", "core")] +
                         [r.threads(f"{group}/{kind}", side) for kind in ("core_off", "core")])
            made = f"{group}/maps/{side}"
            maps.append([f"{side}{power}", milliseconds(r.median(made)),
                         r.threads(f"{group}/maps", side),
                         *(f"{r.median(made, f'{what}_bytes') / 1e6:.3g} MB"
                           for what in ("map", "table"))])
    print_table(["flow", "one velocity: paper", "core", "one particle: paper", "core without maps",
                 "core with maps", "two threads: without maps", "with maps"], costs)
    print_table(["flow maps", "making", "two threads", "memory", "of the tables"], maps)
    growths = [f"{r.ratio(f'Flow2D/{kind}/4096', f'Flow2D/{kind}/256', 'per_particle'):.2f}"
               for kind in ("core", "core_off")]
    print(f"A particle costs {growths[0]} times as much on 4096² as on 256²; "
          f"{growths[1]} times without maps.", end=" ")
    for text, name in (("1,024 particles on 1024²", "Flow2D/%s/1024"),
                       ("8,192 in 256³", "Flow3D/%s/256")):
        print(f"{text}: {milliseconds(r.median(name % 'few'))} with Auto, "
              f"{milliseconds(r.median(name % 'few_off'))} with Off.", end=" ")
    for group in ("Sort2D", "Sort3D"):
        each = r.median(f"{group}/core/1000000")  # ms a million: ns each
        print(f"{group[4:]} sort: {each:.2g} ns a particle.", end=" ")
    print("\n")


BANDWIDTHS = (("read", "reading"), ("write", "writing"), ("add", "adding in place"),
              ("copy", "copying"), ("clear", "clearing"),
              ("first_write", "writing new huge pages"), ("none", "sums within a cache"))


def bandwidths(r):
    rows = []
    for kind, text in BANDWIDTHS:
        one, two = f"Bandwidth/{kind}", f"Bandwidth/{kind}_2_threads"
        speeds = [f"{r.median(name, 'bytes_per_second') / 1e9:.3g} GB/s" if kind != "none" else ""
                  for name in (one, two)]
        rows.append([text, *speeds, f"{r.ratio(one, two, 'real_time'):.2f}×"])
    print_table(["memory", "one thread", "two threads", "ratio"], rows)


# The work: its text, and the benchmarks of its tables, map, particles and filter; cells, particles,
# coordinates of each, and bytes of the filter's output a particle.
BREAKDOWNS = (("40,000 particles, photograph of 1024²: Sample Density", "Tables2D/core_reused/1024",
               "Photograph/maps", "Photograph/core_again", "Photograph/filter",
               1024 ** 2, 40000, 2, 104),
              ("one particle a cell, 256³: Transport Map", "Tables3D/core_reused/256",
               "Flow3D/maps/256", "OnePerCell3D/forward/core_again/256",
               "OnePerCell3D/forward/map/256", 256 ** 3, 256 ** 3, 3, 40))


def breakdown(r):
    """Each part's time, and the time of its bytes alone at the machine's bandwidth."""
    read, write, new = (r.median(f"Bandwidth/{kind}", "bytes_per_second") / 1000
                        for kind in ("read", "write", "first_write"))  # bytes a ms
    rows = []
    for text, tables, maps, again, whole, cells, particles, dimension, output in BREAKDOWNS:
        bytes_of = {what: r.median(maps, f"{what}_bytes") for what in ("table", "map")}
        points = 8 * dimension * particles
        floors = (8 * cells / read + bytes_of["table"] / write,
                  bytes_of["table"] / read + bytes_of["map"] / new,
                  (bytes_of["map"] + points) / read + points / write,
                  points / read + output * particles / new)
        times = [r.median(name) for name in (tables, maps, again)]
        total = r.median(whole)
        times.append(total - sum(times))
        rows.append([text] + [f"{milliseconds(time)} ({milliseconds(floor)})"
                              for time, floor in zip(times, floors)] + [milliseconds(total)])
    print_table(["filter's update, new density: time (of the bytes alone)", "tables",
                 "flow map", "particles", "input and output", "whole"], rows)


def remarks(r):
    peak, table, made = (r.median("Memory/core/256", f"{what}_bytes") / 1e6
                         for what in ("peak", "table", "map"))
    without = r.median("Memory/core_off/256", "peak_bytes") / 1e6
    print(f"Memory at 256³, input and particles aside: {peak:.0f} MB at most, {table:.0f} MB of "
          f"them tables, {made:.0f} MB flow maps; {without:.0f} MB at most without maps.")
    for name, shape in (("Holes2D/%s/256", "256²"), ("Holes3D/%s/64", "64³")):
        counts = [", ".join(f"{r.median(name % kind, what):.0f} {text}"
                            for what, text in (("in_empty_cells", "in empty cells"),
                                               ("lost", "outside or NaN")))
                  for kind in ("paper", "core")]
        particles = r.median(name % "core", "particles")
        print(f"0/1 shape with a hole, {shape}, {particles:.0f} particles: "
              f"paper {counts[0]}; core {counts[1]}.")
    print(f"With the correct velocity at t = 1 the paper's error on the photograph is "
          f"{r.errors('Photograph/paper_limit')}; with its seeds sorted it takes "
          f"{milliseconds(r.median('Photograph/paper_sorted'))}.")
    print(f"Two threads on the photograph: "
          f"{r.ratio('Photograph/core', 'Photograph/core_2_threads', 'real_time'):.2f}×.")
    particles, maps = (", ".join(
        f"{milliseconds(r.median(f'OnePerCell{place}'))} ({text})" for place, text in places)
        for places in ((("2D/forward/sampler/1024", "photograph"),),
                       [(f"3D/forward/map/{side}", f"{side}³") for side in (64, 128, 256)]))
    print(f"Sample Density with one particle a pixel: {particles}; Transport Map: {maps}.")


QUALITY = (("photograph", "photograph, 1024²"), ("gaussians_1024", "two Gaussians, 1024²"),
           ("shape_256", "0/1 shape with a hole, 256²"), ("gaussians_128", "two Gaussians, 128³"),
           ("shape_64", "0/1 shape with a hole, 64³"))
METHODS = (("paper", "paper, 50 steps of RK4"),
           ("multistep_16", "Multistep, 16"), ("multistep_16_off", "without maps"),
           ("multistep_32", "**Multistep, 32**"), ("multistep_32_off", "without maps"),
           ("multistep_64", "Multistep, 64"), ("multistep_64_off", "without maps"),
           ("adaptive", "Adaptive, 0.01"))


def quality(r):
    rows = []
    for density, text in QUALITY:
        for method, label in METHODS:
            name, backward = (f"Quality/{density}/{way}/{method}" for way in ("forward", "backward"))
            rows.append([text if method == "paper" else "", label,
                         f"{r.median(name, 'evaluations'):.0f}", r.errors(name),
                         r.errors(backward),
                         f"{r.median(name, 'density_error'):.3g}",
                         f"{r.median(name, 'in_empty_cells'):.0f}",
                         f"{r.median(name, 'lost'):.0f}"])
    print_table(["density", "integrator", "velocities a particle",
                 "error in cells (mean / 95 % / 99.9 %)", "backward", "density error",
                 "in empty cells",
                 "outside or NaN"], rows)


def filters(r):
    print(f"Cells of 1024 sites: {milliseconds(r.median('Filters/cells/512'))} at 512², "
          f"{milliseconds(r.median('Filters/cells/1024'))} at 1024².")
    sides = ", ".join(f"{milliseconds(r.median(f'Solid/50000/{side}'))} at {side}"
                      for side in (64, 128, 256))
    print(f"The density of a solid of 50,000 triangles: {sides}; at 128 of 200,000: "
          f"{milliseconds(r.median('Solid/200000/128'))}, of 800,000: "
          f"{milliseconds(r.median('Solid/800000/128'))}.\n")


def morphs(r):
    rows = []
    for name, work in (("Morph", "5 steps between two shapes"),
                       ("Barycenters", "5 × 5 barycenters of four shapes")):
        paper, whole = (f"{name}/{kind}" for kind in ("paper", "filter"))
        rows.append([f"{work}, 256², 65,536 particles", milliseconds(r.median(paper)),
                     r.timed(whole, paper), r.timed(f"{whole}_off", paper)])
    print_table(["transport and all", "paper", "filter", "without flow maps"], rows)
    print(f"A change of Parameter alone: {milliseconds(r.median('Morph/step2D/256'))} at 256², "
          f"{milliseconds(r.median('Morph/step3D/128'))} at 128³.\n")
    rows = []
    for side in (64, 128, 256):
        floor = f"Splat3D/read_and_write/{side}"
        rows.append([f"{side}³", milliseconds(r.median(floor))] +
                    [milliseconds(r.median(f"Splat3D/{kernel}/{side}")) for kernel in
                     ("CloudInCell", "NearestCell", "TriangularShapedCloud", "Gaussian",
                      "CloudInCell_random")] +
                    [f"{r.ratio(f'Splat3D/CloudInCell/{side}', floor):.1f}×"])
    print_table(["splat, one particle a cell", "read particles, write grid", "CloudInCell",
                 "NearestCell", "TriangularShapedCloud", "Gaussian", "CloudInCell, random order",
                 "CloudInCell / reading and writing"], rows)


def parameterization(r):
    rows = []
    for size in (1 << 14, 1 << 16, 1 << 18, 1 << 20):
        name = f"Parameterization/%s/{size}"
        paper, flow, polish = (name % kind for kind in ("flow/paper", "flow/core", "polish/core"))
        triangles = r.median(polish, "triangles")
        rows.append([f"{triangles:,.0f}", milliseconds(r.median(name % "conformal")),
                     *(milliseconds(r.median(kind)) for kind in (paper, flow, polish)),
                     f"{r.ratio(paper, flow):.1f}×",
                     f"{1e3 * r.median(polish) / triangles:.1f} µs",
                     *(f"{r.median(kind, 'rms'):.3f} / {r.median(kind, 'flipped'):.0f}"
                       for kind in (name % "conformal", paper, flow, polish))])
    print_table(["triangles", "conformal map", "flow: paper", "core", "and polish", "flow: ratio",
                 "flow and polish, a triangle", "rms / flipped: conformal", "flow: paper",
                 "core", "and polish"], rows)


def relaxation(r):
    rows = []
    for points in (2048, 8192, 32768):
        for method in ("transport", "repulsion"):
            row = [f"{points:,}", method]
            for start in ("flow", "random"):
                name = f"Relaxation/{method}/{start}/{points}"
                first, ten = (r.median(f"{name}/{iterations}") for iterations in (0, 10))
                row += [milliseconds(first), milliseconds((ten - first) / 10),
                        f"{r.median(f'{name}/10', 'energy_before'):.4f} → "
                        f"{r.median(f'{name}/10', 'energy'):.4f}"]
            rows.append(row)
    print_table(["points", "method", "flow: before the first iteration", "an iteration",
                 "energy, 10 iterations", "random: before", "an iteration",
                 "energy, 10 iterations"], rows)
    print("50 iterations of 8,192 points from the flow: " + ", ".join(
        f"{method} {milliseconds(r.median(f'Relaxation/{method}/flow/8192/50'))}"
        for method in ("transport", "repulsion")) + ".\n")


TILED = [  # cells, particles, direction, steps, tables
    ("256³", "one a cell", "forward", "32", "whole", "forward/whole/32/256"),
    ("256³", "one a cell", "forward", "32", "tiled", "forward/tiled/32/256"),
    ("512³", "one a cell", "forward", "32", "tiled", "forward/tiled/32/512"),
    ("512³", "one a cell", "forward", "48", "tiled", "forward/tiled/48/512"),
    ("256³", "one a cell", "backward", "32", "whole", "backward/whole/32/256"),
    ("256³", "one a cell", "backward", "32", "tiled", "backward/tiled/32/256"),
    ("512³", "one a cell", "backward", "32", "tiled", "backward/tiled/32/512"),
    ("1024³", "10,000,000", "forward", "64", "tiled", "points/tiled/64/1024"),
]


def tiles(r):
    rows = []
    for *text, name in TILED:
        name = f"Tiles/{name}"
        peak, foretold = (r.median(name, f"{what}_bytes") / 1e6 for what in ("peak", "foretold"))
        rows.append(text + [f"{r.median(name, 'real_time'):.1f} s", f"{peak:.0f} MB", f"{foretold:.0f} MB"])
    print_table(["cells", "particles", "direction", "steps", "tables", "two threads",
                 "memory beyond input and output", "foretold"], rows)


def run(arguments, names):
    """What the program reports of the benchmarks whose names match."""
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "benchmarks.json")
        done = subprocess.run(
            [arguments.program, f"--benchmark_filter={names}",
             f"--benchmark_repetitions={arguments.repetitions}",
             "--benchmark_enable_random_interleaving=true",
             f"--benchmark_out={output}", "--benchmark_out_format=json"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}\n{arguments.program} ended with {done.returncode}")
        with open(output, encoding="utf-8") as file:
            return json.load(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="RectifiedTransportBenchmarks")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--quality", action="store_true", help="only how good the particles are")
    parser.add_argument("--morphs", action="store_true", help="only morphs, barycenters and splats")
    parser.add_argument("--parameterization", action="store_true", help="only maps of disks")
    parser.add_argument("--relaxation", action="store_true", help="only blue noise")
    parser.add_argument("--tiles", action="store_true",
                        help="only large grids: 7 GB of memory, 8 minutes a repetition")
    arguments = parser.parse_args()

    if arguments.tiles:
        return tiles(Results(run(arguments, "Tiles")))
    if arguments.relaxation:
        return relaxation(Results(run(arguments, "Relaxation")))
    if arguments.parameterization:
        return parameterization(Results(run(arguments, "Parameterization")))
    if arguments.quality:
        return quality(Results(run(arguments, "Quality")))
    if arguments.morphs:
        return morphs(Results(run(arguments, "Morph|Barycenters|Splat3D")))
    # A process that has ever kept freed memory reuses it: those benchmarks run on their own.
    results = Results(run(arguments, "-_reused|Lattice|Tiles|Quality|_fresh|Parameterization|Relaxation"))
    results.add(run(arguments, "_reused"))

    print(f"{machine(results)}; median of {arguments.repetitions}; one thread unless stated.\n")
    whole_jobs(results)
    tables(results)
    flows(results)
    breakdown(results)
    bandwidths(results)
    remarks(results)
    filters(results)
    morphs(results)
    return None


if __name__ == "__main__":
    main()
