# SPDX-License-Identifier: BSD-3-Clause
"""Runs a simulation on several ranks of MPI that samples its density in situ, and the same on one
rank: the particles must have the same bits. Draws three moments and the trajectories between."""
import glob
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

LIMIT = 300  # seconds for a run; it takes about 10
BOX = (2, 1)


def simulate(folder, ranks, particles):
    """Runs simulation.py, which writes into a folder."""
    # pvpython is a process of MPI itself; what that left would keep mpirun from starting others.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "ORTE_", "PMIX_"))}
    # Open MPI refuses root, and more ranks than cores, unless it is told.
    environment.update(PARTICLES=str(particles), OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1")
    plugin = example.plugin_path()
    if plugin:
        environment["RT_PLUGIN"] = os.path.abspath(plugin)
    python = os.path.join(sys.prefix, "bin", "python3")  # sys.executable is pvpython
    done = subprocess.run(
        ["mpirun", "-np", str(ranks), python, os.path.join(HERE, "simulation.py")], cwd=folder,
        env=environment, stdout=subprocess.PIPE, universal_newlines=True, timeout=LIMIT, check=True)
    figures.table("Ranks of MPI: %d" % ranks,
                  ["time", "particles", "on the ranks", "on another rank than a sample before"],
                  [line.split("  ") for line in done.stdout.splitlines()])


def read(path):
    """The data in a file, with the particles in the order of SeedId and, of one, of time."""
    kind = simple.XMLPartitionedPolydataReader if path.endswith(".pvtp") else \
        simple.XMLPolyDataReader
    data = example.fetch(kind(FileName=[path]))
    arrays = {data.GetPointData().GetArrayName(i): vtk_to_numpy(data.GetPointData().GetArray(i))
              for i in range(data.GetPointData().GetNumberOfArrays())}
    arrays["Position"] = vtk_to_numpy(data.GetPoints().GetData())
    order = np.lexsort((arrays.get("Time", arrays["SeedId"]), arrays["SeedId"]))
    return {name: values[order] for name, values in sorted(arrays.items())}


def compare(folder, other):
    """Exits where the files of two folders have not the same bits. Returns what the first has."""
    names = [os.path.basename(path) for path in sorted(glob.glob(os.path.join(folder, "*.*vtp")))]
    names = [name for name in names if "_" not in name]  # the others are parts of these
    read_here = {name: read(os.path.join(folder, name)) for name in names}
    for name, arrays in read_here.items():
        expected = read(os.path.join(other, name))
        different = [key for key in {*arrays, *expected} if key not in arrays or key not in expected
                     or not np.array_equal(arrays[key], expected[key])]
        if different:
            sys.exit("%s: %s is not that of one rank" % (name, ", ".join(different)))
    return read_here


def colours(seeds):
    """Of places in the box: red to blue along x, darker upwards."""
    x, y = seeds[:, 0] / BOX[0], seeds[:, 1] / BOX[1]
    ends = np.array([[0.86, 0.2, 0.13], [0.93, 0.62, 0.12], [0.16, 0.62, 0.45], [0.12, 0.35, 0.75]])
    along = np.column_stack([np.interp(x, np.linspace(0, 1, len(ends)), ends[:, k])
                             for k in range(3)])
    return figures.bytes_of(along * (1.1 - 0.55 * y[:, None]))


def draw(path, parts, pixels):
    """Draws parts: points of a radius or lines of a width, coloured by where their particles began.
    """
    view = example.picture_view([pixels, pixels * BOX[1] // BOX[0]], [1, 1, 1])
    for data, seeds, measure in parts:
        array = numpy_to_vtk(colours(seeds), deep=1)
        array.SetName("Colour")
        data.GetPointData().SetScalars(array)
        shown = simple.Show(example.producer(data), view)
        simple.ColorBy(shown, ("POINTS", "Colour"))
        shown.MapScalars, shown.Ambient, shown.Diffuse = 0, 1, 0
        if data.GetNumberOfVerts():
            shown.SetRepresentationType("Point Gaussian")
            shown.ShaderPreset = "Plain circle"
            shown.GaussianRadius = measure
        else:
            shown.LineWidth = measure
    walls = simple.Show(simple.Box(XLength=BOX[0], YLength=BOX[1], ZLength=0,
                                   Center=[BOX[0] / 2, BOX[1] / 2, 0]), view)
    walls.SetRepresentationType("Outline")
    example.paint(walls, [0.6] * 3)
    example.look_down(view, [BOX[0] / 2, BOX[1] / 2], 1.03 * BOX[1], 5)
    example.save_picture(path, view)


def dots(points, seeds, radius):
    return figures.shape(points, [1] * len(points), "Verts"), seeds, radius


def panels(files, pixels):
    """Three moments, and the trajectories."""
    moments = sorted(name for name in files if name.endswith(".pvtp"))
    begins = files[moments[0]]["SeedPosition"]
    parts = [(words, [dots(files[name]["Position"], begins, 0.3 / len(begins) ** 0.5)])
             for name, words in zip(moments, ("start", "middle", "end"))]

    ways = files["trajectories.vtp"]
    seeds, counts = np.unique(ways["SeedId"], return_counts=True)
    lines = figures.shape(ways["Position"], counts), begins[ways["SeedId"]], 2
    parts.append(("trajectories of %d particles, to the dots" % len(seeds),
                  [lines, dots(ways["Position"][np.cumsum(counts) - 1], begins[seeds], 0.012)]))
    drawn = [(words, figures.drawn(draw, shown, pixels)) for words, shown in parts]
    return [drawn[:2], drawn[2:]]


def main():
    arguments = example.parser(
        __doc__, small="--particles 2000 --panel 320",
        ranks=example.number(2, "ranks of MPI"),
        particles=example.number(4000, "number of particles", 16),
        panel=example.number(640, "width of each of the four pictures", 16)).parse_args()
    find = importlib.util.find_spec
    needed = {"mpirun (Debian's openmpi-bin)": shutil.which("mpirun"),
              "mpi4py (Debian's python3-mpi4py)": find("mpi4py"),
              "ParaView's Catalyst for Python": find("paraview.modules.vtkPVCatalyst")}
    missing = [name for name, there in needed.items() if not there]
    if missing:
        print("Left out, for there is no " + " and no ".join(missing))
        return

    with tempfile.TemporaryDirectory() as alone:
        folder = os.path.abspath(example.output(arguments, "in-situ"))
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        for where, ranks in ((folder, arguments.ranks), (alone, 1)):
            try:
                simulate(where, ranks, arguments.particles)
            except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
                sys.exit(str(error))
        files = compare(folder, alone)
    ways = files["trajectories.vtp"]
    moves = figures.lengths(np.diff(ways["Position"], axis=0))[np.diff(ways["SeedId"]) == 0]
    print("\nThe bits of one rank: %s" % ", ".join(files))
    print("From one sample to the next a particle moves by %.3f on average, 99 %% by less than %.3f"
          % (moves.mean(), np.quantile(moves, 0.99)))
    path = figures.write_montage(arguments, "in-situ.png", panels(files, arguments.panel))
    print("\n" + path)


if __name__ == "__main__":
    main()
