# SPDX-License-Identifier: BSD-3-Clause
"""A model of the time and memory of several ranks under Tables Tiled, from times on one core and
the latency and bandwidth of messages, both measured here. No rank waits for a slower one in it:
particles and tiles are divided evenly.

    python3 rank_model.py build/bin/RectifiedTransportRankPlan

usage: rank_model.py PROGRAM [--alpha SECONDS] [--bandwidth BYTES-A-SECOND]
With --alpha and --bandwidth for the network of another machine, in place of this one's memory."""
import argparse
import dataclasses
import json
import math
import os
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
D = 3
VALUE = 4  # bytes of a value of the density, float
NODE = 32  # bytes of a node of the graded tables: four doubles
TABLE_CELL = 0.02  # what a cell of a tile's tables costs, in particles
BIT = 1 / 8  # bytes of a cell's bit that says whether it has mass


@dataclasses.dataclass
class Machine:
    """Seconds on one core, and of messages."""
    alpha: float  # a message
    beta: float  # a byte that arrives
    graded_cell: float  # a cell of the density, into the graded tables
    graded_node: float  # a node of them, which every rank sums up
    evaluation: float  # a velocity of a node of the flow map
    tile_cell: float  # a cell of a tile's tables
    velocity: float  # a step of a particle after the hand-over, its interpolation counted as one


@dataclasses.dataclass
class Job:
    """What is asked for: particles, at last each in one place, or a map with a sample a cell."""
    particles: float
    is_map: bool


@dataclasses.dataclass
class Phase:
    name: str
    work: float = 0.0  # seconds of the rank that has most
    exchanges: float = 0.0  # each of all ranks with all
    bytes: float = 0.0  # that arrive at a rank in them

    def seconds(self, ranks, machine):
        return self.work + messages(ranks, self.exchanges, self.bytes, machine)


def messages(ranks, exchanges, arriving, machine):
    """Seconds of exchanges in which so many bytes arrive at each rank."""
    if ranks == 1:
        return 0.0
    # Before each exchange all gather how each fares and what it sends to whom: P + 1 words of each.
    announced = 8 * ranks * (ranks + 1)
    latency = math.ceil(math.log2(ranks)) + ranks - 1  # of the gathering; a message of each other
    each = latency * machine.alpha + announced * machine.beta
    return exchanges * each + arriving * machine.beta


def phases(plan, job, ranks, machine):
    """The parts of a run in their order. `plan` is what RectifiedTransportRankPlan prints."""
    cells = plan["side"] ** D
    own = 1 / ranks  # a rank's share of what is divided evenly
    others = (ranks - 1) / ranks  # of what all get, or what goes anywhere: what others have
    particles = job.particles * own
    units = max(plan["tiles"], ranks)  # a tile may be divided: each makes its tables then
    # Tables that a rank makes in a pass: of all tiles where its own particles pay for them
    # (TileSchedule.cxx), else of its share, for the particles of all ranks.
    shared = math.ceil(units / ranks)
    keeps = particles / plan["tiles"] >= 4 * TABLE_CELL * plan["most_tile_cells"]
    rounds = plan["tiles"] if keeps else shared
    if plan["levels"]:
        rounds += shared  # another pass, of the few particles that the flow map does not serve
    tile_cells = rounds * plan["tile_cells"] / plan["tiles"]  # with halos
    steps = plan["hand_over"] + 1  # of a particle: the interpolation at the hand-over and the rest
    face = (cells * own) ** (1 - 1 / D)  # samples in a face of a rank's piece
    return [
        Phase("density to layers", 0, 1, VALUE * cells * own * others),  # each value once
        Phase("graded tables", machine.graded_cell * cells * own),
        # Records, bits and summaries of all layers, to all.
        Phase("graded tables to all", 0, 3, (NODE * plan["graded_nodes"] + BIT * cells) * others),
        Phase("sums of graded tables", machine.graded_node * plan["graded_nodes"]),
        Phase("flow map", machine.evaluation * plan["map_evaluations"] * own),
        Phase("flow map to all", 0, plan["levels"], plan["map_bytes"] * others),
        # Of a tile with its halo others have all but this rank's share.
        Phase("density of tiles", 0, rounds, VALUE * tile_cells * others),
        Phase("tables of tiles", machine.tile_cell * tile_cells),
        # Out: the seed, D doubles; back: the place and a byte, which says whether it is one. Of
        # particles that no map serves, few for smooth densities, four times as much goes out.
        Phase("particles to tiles", 0, 2 * (shared if keeps else rounds),
              0 if keeps else particles * (8 * D + 8 * D + 1) * others),
        Phase("particles in tiles", machine.velocity * steps * particles),
        # A sample of a map at the lower faces of a piece; particles with their arrays.
        Phase("output", 0, 1, 40 * D * face if job.is_map and ranks > 1 else
              88 * particles * others if not job.is_map else 0)]


def memory(plan, job, ranks):
    """Bytes of a rank by what they are for."""
    cells = plan["side"] ** D
    return {"density, its piece and its layers": 2 * VALUE * cells / ranks if ranks > 1 else
            VALUE * cells,
            "graded tables": NODE * plan["graded_nodes"],
            "bits of cells": BIT * cells,
            "flow map": plan["map_bytes"],
            "a tile": plan["tile_table_bytes"] + VALUE * plan["most_tile_cells"],
            # Displacement, in whose memory positions are, and two numbers; seeds and the arrays of a
            # particle.
            "particles and output": (40 if job.is_map else 24 + 104) * job.particles / ranks}


def efficiency(plan, job, ranks, machine):
    """The time on one core over the sum of the times of all."""
    alone, together = (sum(phase.seconds(count, machine)
                           for phase in phases(plan, job, count, machine))
                       for count in (1, ranks))
    return alone / (ranks * together)


def ask(program, *numbers):
    """What RectifiedTransportRankPlan prints."""
    done = subprocess.run([program, *map(str, numbers)], stdout=subprocess.PIPE, text=True,
                          check=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    return json.loads(done.stdout)


def compute_times(program):
    """The constants of computation, at 256³ on one thread."""
    found = ask(program, 256, 32, 0, 2000000)
    tiles = found["tile_seconds"] * found["tiles"]
    node = max(0, (found["graded_seconds"] - found["few_graded_seconds"]) /
               (found["graded_nodes"] - found["few_graded_nodes"]))
    return {"graded_cell": (found["graded_seconds"] - node * found["graded_nodes"]) /
            found["side"] ** D, "graded_node": node,
            "evaluation": found["map_seconds"] / found["map_evaluations"],
            "tile_cell": found["tile_seconds"] / found["most_tile_cells"],
            "velocity": (found["flow_seconds"] - tiles) / found["particles"] /
            (found["hand_over"] + 1)}


def message_times():
    """alpha and beta of VTK's controller between two ranks here."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "times.json")
        subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", "2", "pvbatch",
                        "--sym", os.path.join(HERE, "rank_messages.py"), path],
                       check=True, timeout=300)
        with open(path, encoding="utf-8") as file:
            return json.load(file)


def report(title, plan, job, ranks, machine):
    print("\n%s: tiles %d, halo %d, hand-over %d, graded stride %d" % (
        title, plan["tiles"], plan["halo"], plan["hand_over"], plan["graded_stride"]))
    print("| phase | seconds on 1 core | seconds of a rank of %d | MB that arrive |" % ranks)
    print("|---|---|---|---|")
    alone = phases(plan, job, 1, machine)
    for one, phase in zip(alone, phases(plan, job, ranks, machine)):
        print("| %s | %.4g | %.4g | %.4g |" % (
            phase.name, one.seconds(1, machine), phase.seconds(ranks, machine), phase.bytes / 1e6))
    print("| all | %.4g | %.4g | |" % tuple(
        sum(phase.seconds(count, machine) for phase in phases(plan, job, count, machine))
        for count in (1, ranks)))
    print("\nEfficiency %.0f %%. GB of a rank, of 1 and of %d:" % (
        100 * efficiency(plan, job, ranks, machine), ranks))
    whole, share = memory(plan, job, 1), memory(plan, job, ranks)
    for name in whole:
        print("  %-34s %9.3g %9.3g" % (name, whole[name] / 1e9, share[name] / 1e9))
    print("  %-34s %9.3g %9.3g" % ("all", sum(whole.values()) / 1e9, sum(share.values()) / 1e9))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="RectifiedTransportRankPlan")
    parser.add_argument("--alpha", type=float, help="seconds a message, instead of those measured")
    parser.add_argument("--bandwidth", type=float, help="bytes a second, instead of those measured")
    arguments = parser.parse_args()
    times = compute_times(arguments.program)
    measured = message_times()
    machine = Machine(
        alpha=arguments.alpha or measured["alpha"],
        beta=1 / arguments.bandwidth if arguments.bandwidth else measured["beta"], **times)
    print("Measured: a message %.3g µs, %.3g GB/s (all-gather %.3g GB/s)" % (
        1e6 * measured["alpha"], 1e-9 / measured["beta"], 1e-9 / measured["gather_beta"]))
    print("Taken: a message %.3g µs, %.3g GB/s; a cell of graded tables %.3g ns, a node %.3g ns; a "
          "cell of a tile %.3g ns; a velocity of a node %.3g ns, of a particle %.3g ns" % (
              1e6 * machine.alpha, 1e-9 / machine.beta,
              *(1e9 * value for value in (machine.graded_cell, machine.graded_node,
                                          machine.tile_cell, machine.evaluation,
                                          machine.velocity))))
    for side, steps, ranks, nodes in ((1024, 64, 8, 0), (8192, 64, 512, 0),
                                      (8192, 64, 512, 1 << 28), (8192, 64, 512, 1 << 31)):
        plan = ask(arguments.program, side, steps, nodes)
        title = "Transport Map of %d³, %d steps, %d ranks, %s graded nodes" % (
            side, steps, ranks, "at most %d million" % (nodes >> 20) if nodes else "the usual")
        if plan["possible"]:
            report(title, plan, Job(side ** D, True), ranks, machine)
        else:
            print("\n%s: no tiles; boxes are too wide at every step" % title)
        if side == 1024:
            report("Sample Density of 1024³, 100 million particles, 8 ranks", plan, Job(1e8, False),
                   ranks, machine)


if __name__ == "__main__":
    main()
