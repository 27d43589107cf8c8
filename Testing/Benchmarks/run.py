# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and prints the tables of Documentation/Speed.md.

usage: python3 run.py [--help] [--repetitions N] [--quality | --steps | ...] PROGRAM
       python3 run.py --cartograms [--maps FOLDER] PROGRAM
       python3 run.py --surfaces [--meshes FOLDER] PROGRAM
       python3 run.py --device PROGRAM

Every figure is the median of the repetitions, which are interleaved at random. One thread is
measured in processor time, two in wall-clock time. --device runs RectifiedTransportDeviceReport,
which lies beside PROGRAM, for the table of Documentation/Devices.md, in wall-clock time.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

from benchmark_results import (Results, expect_no_strays, grids, machine, milliseconds, print_table,
                               print_text, processor)

SQUARES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "Maps", "square_maps.py")


# The job, its benchmarks, and the filter's among them: one beside the paper's, or several alone.
JOBS = (
    ("Sample Density: 40,000 particles, photograph of 1024²", "Photograph/%s", "filter"),
    ("Transport Map: one particle a pixel, photograph of 1024²",
     "OnePerCell2D/forward/%s/1024", "map"),
    ("Transport Map: the same backward", "OnePerCell2D/backward/%s/1024", "map"),
    *((f"Sample Density: one particle a cell, {side}³", f"OnePerCell3D/forward/%s/{side}",
       "sampler") for side in (64, 128, 256)),
    ("Transport Map: one particle a cell, 128³ backward", "OnePerCell3D/backward/%s/128", "map"),
    ("Sample Density: one particle a pixel, photograph of 1024²",
     "OnePerCell2D/forward/sampler/%s", (1024,)),
    ("Transport Map: one particle a cell, 64³, 128³, 256³", "OnePerCell3D/forward/map/%s",
     (64, 128, 256)),
    ("Morph Densities: 5 steps between two shapes, 256², 65,536 particles", "Morph/%s", "filter"),
    ("Morph Densities: a change of `Parameter`, 256², 128³", "Morph/%s",
     ("step2D/256", "step3D/128")),
    ("Density Barycenter: 5 × 5 barycenters of four shapes, 256², 65,536 particles",
     "Barycenters/%s", "filter"),
    ("Equal Mass Cells: 1024 sites, 512², 1024²", "Filters/cells/%s", (512, 1024)),
    ("Solid Density: 50,000 triangles, `Resolution` 64, 128, 256", "Solid/50000/%s",
     (64, 128, 256)),
    ("Solid Density: 200,000 and 800,000 triangles, `Resolution` 128", "Solid/%s/128",
     (200000, 800000)))
# What other tables call the first seven.
CORE = tuple(zip(("40,000 particles, photograph", "one a pixel, photograph", "the same backward",
                  "one a cell, 64³", "128³", "256³", "128³ backward"),
                 (name for _, name, _ in JOBS)))
FLOWS = grids("Flow", (256, 1024, 4096))


def jobs(r, chosen=JOBS):
    rows = []
    for text, name, kinds in chosen:
        if isinstance(kinds, str):
            paper = name % "paper"
            rows.append([text, r.timed(name % kinds, paper), r.timed(name % f"{kinds}_off", paper),
                         r.time(paper)])
        else:
            rows.append([text, ", ".join(r.time(name % kind) for kind in kinds), "", ""])
    print_table(["job", "time", "without flow maps", "paper"], rows)


def memory(r):
    peak, table, made = (r.median("Memory/core/256", f"{what}_bytes") / 1e6
                         for what in ("peak", "table", "map"))
    without = r.median("Memory/core_off/256", "peak_bytes") / 1e6
    print_text(f"One particle a cell of 256³, besides input and particles: {peak:.0f} MB at most, "
               f"of which {table:.0f} MB are tables and {made:.0f} MB flow maps; {without:.0f} MB "
               f"at most without maps.")


def core(r):
    print_table(["same density again", "core"],
                [[text, r.timed(name % "core_again", name % "paper")] for text, name in CORE])


def flows(r):
    print_table(["flow", "one velocity: paper", "core", "one particle: paper", "core without maps",
                 "core with maps", "two threads: without maps", "with maps"],
                [[text,
                  *(f"{1e9 * r.median(name % kind, 'per_velocity'):.3g} ns"
                    for kind in ("paper", "core_off")),
                  *(f"{1e6 * r.median(name % kind, 'per_particle'):.3g} µs"
                    for kind in ("paper", "core_off", "core")),
                  *(r.threads(name, kind) for kind in ("core_off", "core"))]
                 for text, name in FLOWS])
    growths = [f"{r.ratio(f'Flow2D/{kind}/4096', f'Flow2D/{kind}/256', 'per_particle'):.2f}"
               for kind in ("core", "core_off")]
    sorts = [r.median(f"Sort{group}/core/1000000") for group in ("2D", "3D")]  # ms a million: ns
    print_text(f"A particle costs {growths[0]} times as much on 4096² as on 256²; {growths[1]} "
               f"times without maps. The sort takes {sorts[0]:.2g} ns a particle in 2D and "
               f"{sorts[1]:.2g} ns in 3D.")


def tables(r):
    print_table(["tables", "paper", "core", "ratio", "ratio in reused memory", "two threads"],
                [[text, *(r.time(name % kind) for kind in ("paper", "core")),
                  *(f"{r.ratio(name % f'paper{memory}', name % f'core{memory}'):.1f}×"
                    for memory in ("", "_reused")), r.threads(name, "core")]
                 for text, name in grids("Tables", (1024, 4096))])
    print_table(["flow maps", "making", "two threads", "memory", "of the tables"],
                [[text, r.time(name % "maps"), r.threads(name, "maps"),
                  *(f"{r.median(name % 'maps', f'{what}_bytes') / 1e6:.3g} MB"
                    for what in ("map", "table"))] for text, name in FLOWS])


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


BANDWIDTHS = (("read", "reading"), ("write", "writing"), ("first_write", "writing new huge pages"),
              ("none", "sums within a cache"))


def bandwidths(r):
    rows = []
    for kind, text in BANDWIDTHS:
        speeds = [f"{r.median(f'Bandwidth/{kind}{threads}', 'bytes_per_second') / 1e9:.3g} GB/s"
                  if kind != "none" else "" for threads in ("", "_2_threads")]
        rows.append([text, *speeds, r.threads("Bandwidth/%s", kind)])
    print_table(["memory", "one thread", "two threads", "ratio"], rows)
    gain = r.threads("Photograph/%s", "core").replace("×", " times")
    print_text(f"40,000 particles of the photograph gain {gain}.")


def splats(r):
    print_table(["splat, one particle a cell", "read particles, write grid", "CloudInCell",
                 "NearestCell", "TriangularShapedCloud", "Gaussian", "CloudInCell, random order",
                 "CloudInCell / reading and writing"],
                [[text, *(r.time(name % kernel) for kernel in
                          ("read_and_write", "CloudInCell", "NearestCell", "TriangularShapedCloud",
                           "Gaussian", "CloudInCell_random")),
                  f"{r.ratio(name % 'CloudInCell', name % 'read_and_write'):.1f}×"]
                 for text, name in grids("Splat")])


def errors(r):
    expect_no_strays(r, "Holes2D/core/256")
    expect_no_strays(r, "Holes3D/core/64")
    print_table(["error in cells (mean / 95 % / 99.9 %)", "paper", "core", "without maps"],
                [[text] + [r.errors(name % kind) for kind in ("paper", "core", "core_off")]
                 for text, name in CORE[3:6]])
    print_text(f"With the correct velocity at t = 1 the paper's error on the photograph is "
               f"{r.errors('Photograph/paper_limit')}.")


QUALITY = (("photograph", "photograph, 1024²"), ("gaussians_1024", "two Gaussians, 1024²"),
           ("gaussians_128", "two Gaussians, 128³"), ("shape_64", "0/1 shape with a hole, 64³"))
METHODS = (("paper", "paper"),
           ("multistep_16", "Multistep, 16"),
           ("multistep_32", "**Multistep, 32**"), ("multistep_32_off", "without maps"),
           ("multistep_64", "Multistep, 64"), ("adaptive", "Adaptive, 0.01"))


def quality(r):
    rows = []
    for density, text in QUALITY:
        for method, label in METHODS:
            name = f"Quality/{density}/forward/{method}"
            rows.append([text if method == "paper" else "", label,
                         f"{r.median(name, 'evaluations'):.0f}", r.errors(name),
                         r.errors(name.replace("forward", "backward")),
                         f"{r.median(name, 'density_error'):.3g}"])
            if method != "paper" or "shape" not in density:
                expect_no_strays(r, name)
    print_table(["density", "integrator", "velocities a particle",
                 "error in cells (mean / 95 % / 99.9 %)", "backward", "density error"], rows)
    print_text("Particles in empty cells, and outside or NaN, for the shape with a hole: "
               f"{r.strays('Quality/shape_64/forward/paper')} of the paper's.")


STEPS = (("raccoon", "`raccoon.png`, ink, 1024 × 768"), ("raccoon-4", "the same, 256 × 192"),
         ("ascent", "`ascent.png`, ink, 512²"),
         ("night-europe", "`night-europe.png`, ink, 342 × 182"), ("gauss", "Gaussian, 256²"),
         ("gausses", "five Gaussians"), ("peak", "peak of 1000 over ones, smooth"),
         *((f"disc{ratio}", f"disc, {ratio} times as dense") for ratio in (10, 100, 1000)),
         ("disc1000-512", "the same, 512²"),
         *((f"disc100-{side}", f"disc of 100, {side}²") for side in (64, 512, 1024)),
         *((f"square{ratio}", f"square, {ratio} times as dense") for ratio in (10, 100, 1000)),
         *((f"checker{ratio}", f"8 × 8 squares, 1 and {ratio}") for ratio in (3, 10)),
         ("disc01", "disc, 0 outside"), ("star01", "star, 0 outside"),
         ("circle", "a thin circle over a millionth"),
         ("clumps", "150 lognormal clumps"), ("noise", "white noise"), ("noise3", "its cube"),
         ("noiselog", "lognormal noise"), ("ball10-3d", "ball, 10 times as dense, 64³"),
         ("ball100-3d", "100 times"), ("clumps-3d", "150 clumps, 64³"),
         ("brain", "`brain-t1.vti`, 5 % of the mean added"))


def steps(r):
    rows = []
    for density, text in STEPS:
        row = [text]
        for way in ("backward", "forward"):
            if way == "forward" and density.endswith(("3d", "brain")):
                row += [""] * 6
                continue
            name = f"Steps/{way}/{density}"
            row += [f"{r.median(name, 'steps'):.0f}"]
            row += [f"{r.median(name, what):.2g}"
                    for what in ("estimate", "error", "cost", "few_error", "paper_error")]
        rows.append(row)
    kinds = ("steps", "estimate", "error", "cost", "error of 32 steps", "of the paper")
    print_table(["areas of", *(f"{way}: {kind}" for way in ("backward", "forward")
                               for kind in kinds)], rows)


def morphs(r):
    jobs(r, [job for job in JOBS if job[1].startswith(("Morph", "Barycenters"))])
    splats(r)


def parameterization(r):
    rows = []
    for size in (1 << 14, 1 << 16, 1 << 18, 1 << 20):
        kinds = [f"Parameterization/{kind}/{size}"
                 for kind in ("conformal", "flow/paper", "flow/core", "polish/core")]
        times = [r.time(kind) for kind in kinds]
        times.insert(3, f"{r.ratio(kinds[1], kinds[2]):.1f}×")
        rows.append([f"{r.median(kinds[0], 'triangles'):,.0f}", *times] +
                    [f"{r.median(kind, 'rms'):.3f}, {r.median(kind, 'flipped'):.0f}"
                     for kind in kinds])
    print_table(["triangles", "conformal map", "flow: paper", "core", "ratio", "with the polish",
                 "rms of the areas, flipped: conformal", "flow: paper", "core", "with the polish"],
                rows)


PAIRS = (*((f"2D/{name}", text) for name, text in (
             ("blobs", "blobs to blobs"), ("star_ring", "star to ring"),
             ("disks_filaments", "disks to filaments"), ("star_cross", "star to cross"),
             ("turned_Gaussians", "a turned Gaussian"),
             ("unequal_disks_moved", "disks of unequal masses, one moves"),
             ("unequal_disks", "the same, both in place"),
             ("disk_line_2", "disk to a line of 2 cells"), ("disk_line_4", "of 4 cells"),
             ("still_void", "a still disk, and one that moves"),
             ("still_background", "the same over a background of 1 %"),
             ("still_Gaussians", "the same of Gaussians"), ("uniform_star", "uniform to star"),
             ("uniform_filaments", "uniform to filaments"), ("ring_star", "ring to star"),
             ("filaments_disks", "filaments to disks"), ("cross_blobs", "cross to blobs"))),
         *((f"3D/{name}", text) for name, text in (
             ("blobs", "3D: blobs to blobs"), ("animal_ring", "animal to ring"),
             ("ring_animal", "ring to animal"), ("cross_blobs", "cross to blobs"))))


def masses(r):
    rows = []
    for pair, text in PAIRS:
        row = [text]
        for mover in ("flow", "points", "samples"):
            def median(what, name=f"OptimalMasses{pair}/{mover}"):
                return r.median(name, what)
            row.append(" / ".join(f"{median(what):.2g}" for what in ("8", "4", "6", "boxes")) +
                       f"; {median('cost'):+.2f}")
        row.append(f"{median('still'):.3f}" if median("still") else "")
        rows.append(row)
    print_table(["8 / 4 / 6 / boxes; cost over the bound, %", "flow through the uniform density",
                 "map of single points", "samples together", "still part moves, cells"], rows)


BOUNDS = (*((f"2D/{pair}", text, side) for side in (256, 1024) for pair, text in (
              ("uniform_photograph", f"uniform → photograph, {side}²"),
              ("star_ring", f"star → ring, {side}²"))),
          *((f"3D/{pair}", text, side) for side in (64, 128) for pair, text in (
              ("blobs", f"blobs → blobs, {side}³"),
              ("animal_ring", f"animal → ring, {side}³"))))


def bounds(r):
    rows = []
    for pair, text, side in BOUNDS:
        name = f"OptimalBound{pair}/{side}"
        best = r.median(f"{name}/20/2", "bound")
        row = [text]
        for iterations in (0, 1, 5):
            one, two = (f"{name}/{iterations}/{threads}" for threads in (1, 2))
            low = 100 * (1 - r.median(one, "bound") / best)
            row.append(f"{milliseconds(r.median(one, 'real_time'))}, {low:.2g} %, "
                       f"{r.ratio(one, two, 'real_time'):.2f}×")
        rows.append(row)
    print_table(["iterations: one thread, below the bound of 20, gain of two threads", "0", "1",
                 "5"], rows)


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
    print_text("50 iterations of 8,192 points from the flow: " + ", ".join(
        f"{method} {r.time(f'Relaxation/{method}/flow/8192/50')}"
        for method in ("transport", "repulsion")) + ".")


SURFACES = {"sphere": "sphere, 22,500 triangles", "torus": "torus, 14,400", "box": "box, 19,200",
            "hemisphere": "hemisphere, 12,000", "fine": "torus, 1,000,000",
            "bunny": "bunny, 3,674", "dragon": "dragon, 871,414"}


def surfaces(r):
    rows = []
    for name, text in SURFACES.items():
        for points in (8192, 100000, 1000000):
            one = f"Surfaces/{name}/core/{points}"
            if one in r.runs:
                mean, least, patches = (r.median(one, what) for what in ("mean", "least", "patches"))
                rows.append([text if points == 8192 else "", f"{points:,}", f"{mean:.3f}",
                             f"{least:.2f}", f"{patches:.4f}", r.time(one),
                             f"{r.ratio(one, one.replace('core', 'core_2_threads'), 'real_time'):.2f}×",
                             f"{r.median(one, 'megabytes'):.0f} MB"])
    print_table(["surface", "points", "mean spacing", "least", "patches", "time", "two threads",
                 "memory"], rows)


TILED = (  # cells, particles, direction, steps, tables
    ("256³", "one a cell", "forward", "32", "whole", "forward/whole/32/256"),
    ("256³", "one a cell", "forward", "32", "tiled", "forward/tiled/32/256"),
    ("512³", "one a cell", "forward", "32", "tiled", "forward/tiled/32/512"),
    ("512³", "one a cell", "forward", "48", "tiled", "forward/tiled/48/512"),
    ("256³", "one a cell", "backward", "32", "whole", "backward/whole/32/256"),
    ("256³", "one a cell", "backward", "32", "tiled", "backward/tiled/32/256"),
    ("512³", "one a cell", "backward", "32", "tiled", "backward/tiled/32/512"),
    ("1024³", "10,000,000", "forward", "64", "tiled", "points/tiled/64/1024"))


def tiles(r):
    rows = []
    for *text, name in TILED:
        name = f"Tiles/{name}"
        rows.append(text + [f"{r.median(name, 'real_time'):.1f} s",
                            f"{r.median(name, 'peak_bytes') / 1e6:.0f} MB"])
    print_table(["cells", "particles", "direction", "steps", "tables", "two threads",
                 "memory beyond input and output"], rows)


MAPS = {"us-states": "United States", "world": "world, least masses",
        "16-squares": "16 squares, one 100×", "144-squares": "144 squares, one a thousandfold",
        "counties": "counties of the United States"}


def cartograms(r):
    rows = []
    for name, text in MAPS.items():
        for kind, program in (("", "Cartogram"), ("/go-cart", "go-cart-wasm")):
            one = f"Cartogram/{name}{kind}"
            if one not in r.runs:
                continue
            regions, before, after, overlap, largest, mean = (r.median(one, what) for what in (
                "regions", "crossing_before", "crossing", "overlap", "largest_error", "mean_error"))
            rows.append([
                "" if kind else f"{text}: {regions:,.0f} regions, "
                                f"{r.median(one, 'vertices'):,.0f} points",
                program, f"{100 * largest:.2g} %", f"{100 * mean:.2g} %",
                "" if kind else f"{r.median(one, 'passes'):.0f}", f"{before:.0f} → {after:.0f}",
                f"{overlap:.0e}" if overlap > 1e-12 else "0", f"{r.median(one, 'shape'):.3f}",
                f"{r.median(one, 'turn'):.1f}°", r.time(one),
                f"{r.median(one, 'megabytes'):.0f} MB"])
    print_table(["map", "program", "largest error", "mean", "passes", "crossing rings", "overlap",
                 "shape", "turn", "time", "memory"], rows)


def devices(report):
    """Times of a device, from the comma-separated lines of the report below the device's name."""
    name, *lines = report.splitlines()
    print_text(f"Whole flows in 32 steps on {name}, beside all {os.cpu_count()} threads of an "
               f"{processor()}, median of 5 and the least:")
    rows = []
    for run in csv.DictReader(lines):
        times = (f"{milliseconds(float(run[who]))} ({milliseconds(float(run[who + '_least']))})"
                 for who in ("processor", "device"))
        megabytes = (f"{int(run['bytes_' + way]) / 1e6:.3g} MB" for way in ("to", "from"))
        rows.append([run["case"].replace("^2", "²").replace("^3", "³"), run["tables"], *times,
                     *megabytes, run["kernels"]])
    print_table(["flow", "tables and maps", "processor", "device", "to the device",
                 "from the device", "kernels"], rows)


# What prints the figures without an option; of each option its help, benchmarks and what prints.
ALL = (jobs, memory, core, flows, tables, breakdown, bandwidths, splats, errors)
OPTIONS = {"quality": ("how good the particles are", "Quality", quality),
           "morphs": ("morphs, barycenters and splats", "Morph|Barycenters|Splat3D", morphs),
           "parameterization": ("maps of disks", "Parameterization", parameterization),
           "masses": ("masses of optimal maps", "OptimalMasses", masses),
           "bounds": ("certified bounds of the least cost", "OptimalBound", bounds),
           "relaxation": ("blue noise", "Relaxation", relaxation),
           "surfaces": ("points spread over surfaces", "Surfaces/", surfaces),
           "steps": ("how exactly areas are kept", "Steps", steps),
           "cartograms": ("cartograms of maps", "Cartogram/", cartograms),
           "tiles": ("large grids: 7 GB of memory, 8 minutes a repetition", "Tiles", tiles)}


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


def run_report(program):
    """What the report on a device says of times."""
    report = os.path.join(os.path.dirname(os.path.abspath(program)),
                          "RectifiedTransportDeviceReport")
    done = subprocess.run([report, "--times", "--csv"], stdout=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\n{report} ended with {done.returncode}")
    return done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="RectifiedTransportBenchmarks")
    parser.add_argument("--repetitions", type=int, default=5)
    for option, (text, _, _) in OPTIONS.items():
        parser.add_argument(f"--{option}", action="store_const", const=option, dest="option",
                            help=f"only {text}")
    parser.add_argument("--device", action="store_true",
                        help="only times of an OpenCL device, the first that can be used")
    parser.add_argument("--maps", help="a folder that Maps/make.sh has made, for --cartograms")
    parser.add_argument("--meshes", help="a folder that Surfaces/make.sh has made, for --surfaces")
    arguments = parser.parse_args()

    if arguments.device:
        return devices(run_report(arguments.program))
    if arguments.option:
        _, names, show = OPTIONS[arguments.option]
        with tempfile.TemporaryDirectory() as folder:
            if arguments.option == "cartograms" and not arguments.maps:
                subprocess.run([sys.executable, SQUARES, folder], check=True)
            os.environ["RECTIFIEDTRANSPORT_MAPS"] = arguments.maps or folder
            if arguments.meshes:
                os.environ["RECTIFIEDTRANSPORT_SURFACES"] = os.path.abspath(arguments.meshes)
            return show(Results(run(arguments, names)))
    # A process that has ever kept freed memory reuses it: those benchmarks run on their own.
    results = Results(run(
        arguments, "-_reused|Lattice|Tiles|Quality|_fresh|Parameterization|Relaxation|Areas|Steps|"
        "Cartogram|OptimalMasses|OptimalBound|Surfaces"))
    results.add(run(arguments, "_reused"))

    print_text("Whole updates of filters with a new density, on one thread of an "
               f"{machine(results)}, median of {arguments.repetitions}:")
    for show in ALL:
        show(results)
    return None


if __name__ == "__main__":
    main()
