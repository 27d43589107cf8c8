# SPDX-License-Identifier: BSD-3-Clause
"""Two and more times of one series into one filter: each input has its own time, whatever was requested
before, after a state is loaded and from cold."""
import os
import subprocess
import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

from rt_filters import FILTERS
from rt_proxies import proxies
from rt_testing import OUTPUT, density_image, digest, load_plugin, main

simple = load_plugin()

STEPS = 12
SHAPE = (48, 16)
ARRAYS = {"DensityArray": ["CELLS", "Density"]}
BOTH = {**ARRAYS, "TargetArray": ["CELLS", "Density"]}


def place(step):
    """Where the blob of a step is, in cells along x."""
    return 6 + 3 * step


def write_series():
    """A blob that moves along x: the files of its steps, and a collection of them."""
    x, y = np.arange(SHAPE[0]) + 0.5, np.arange(SHAPE[1]) + 0.5
    files = []
    for step in range(STEPS):
        squared = (x[None, :] - place(step)) ** 2 + (y[:, None] - 8) ** 2
        values = np.where(squared < 16, np.exp(-squared / 8), 0)
        image = density_image(SHAPE, values=values.ravel())
        image.SetSpacing(1, 1, 1)
        files.append(os.path.abspath(os.path.join(OUTPUT, "series-%d.vti" % step)))
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(files[-1])
        writer.SetInputData(image)
        writer.SetDataModeToBinary()  # appended: see Testing/Data/README.md
        writer.Write()
    collection = os.path.abspath(os.path.join(OUTPUT, "series.pvd"))
    with open(collection, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="Collection" version="0.1"><Collection>%s</Collection></VTKFile>'
                   % "".join('<DataSet timestep="%d" file="%s"/>' % (step, os.path.basename(path))
                             for step, path in enumerate(files)))
    return files, collection


os.makedirs(OUTPUT, exist_ok=True)
FILES, COLLECTION = write_series()


def read(kind="vti"):
    reader = (simple.PVDReader(FileName=COLLECTION) if kind == "pvd" else
              simple.XMLImageDataReader(FileName=FILES, TimeArray="None"))
    reader.UpdatePipelineInformation()
    return reader


def passed(source):
    return simple.PassArrays(source, CellDataArrays=["Density"])


def extracted(source, step):
    return simple.ExtractTimeSteps(source, SelectionMode="Select Time Steps",
                                   TimeStepIndices=[step])


# A series to its data of one step, at every time.
WAYS = {
    "force": lambda series, step: simple.ForceTime(series, ForcedTime=float(step)),
    "extract": extracted,
    "passed, force": lambda series, step: simple.ForceTime(passed(series), ForcedTime=float(step)),
    "force, passed": lambda series, step: passed(simple.ForceTime(series, ForcedTime=float(step))),
    "interpolated, force": lambda series, step: simple.ForceTime(
        simple.TemporalInterpolator(series), ForcedTime=float(step)),
}
ORDERS = ([0], [11], [5], [None], [11, 0, 0], [None, 4.5, None])


def reset():
    """The time that a new source takes grows with the number of those there are."""
    for source in list(simple.GetSources().values()):
        simple.Delete(source)


def update(proxy, time):
    if time is None:
        proxy.UpdatePipeline()
    else:
        proxy.UpdatePipeline(float(time))


def centroid(proxy):
    values = vtk_to_numpy(proxy.GetClientSideObject().GetDensity().GetCellData()
                          .GetArray("Density")).reshape(SHAPE[::-1])
    return (values.sum(0) * (np.arange(SHAPE[0]) + 0.5)).sum() / values.sum()


def morph_of(source, target, **properties):
    return simple.MorphDensities(source, Target=target, ParticlesPerCell=4, **BOTH, **properties)


def ends(morph, ask):
    """The centroids at Parameter 0 and 1, and at 0 again."""
    found = []
    for parameter in (0, 1, 0):
        morph.Parameter = parameter
        ask(morph)
        found.append(centroid(morph))
    return found


def mesh(source, least=0.001):
    return simple.Threshold(source, Scalars=["CELLS", "Density"], LowerThreshold=least,
                            UpperThreshold=9)


def points(source):
    return simple.CellCenters(mesh(source, 0.3), VertexCells=1)


PROPERTIES = {proxy.label: proxy.properties for proxy in proxies()}


# With these the output depends on both inputs, and not on their names.
BOTH_COUNT = {"Measure": "Density", "Weights": [3, 1], "InputNames": ["one", "other"]}


def of_two_inputs(filter_):
    """What makes a filter of two data sets of a series, or None if it has one input at the most."""
    names = list(filter_.ports)
    if len(names) < 2 and "densities" not in filter_.ports.values():
        return None
    arrays = {name: ["CELLS", "Density"] for name in ("DensityArray", "TargetArray")
              if name in PROPERTIES[filter_.label]}
    given = {name: value for name, value in BOTH_COUNT.items() if name in filter_.panel}
    if "Measure" in given:
        given["Resolution"] = 192

    def make(one, other):
        by_name = {}
        for name, source in zip(names, (one, other)):
            wants_points = filter_.ports[name] in ("points", "mesh")
            by_name[name] = lambda source=points(source) if wants_points else source: source
        if filter_.port_of("densities") is not None:
            by_name = {names[0]: lambda: [one, other]}
        return filter_.make(simple, by_name, bool(filter_.optional), **arrays, **given)
    return make


MAKERS = {filter_.name: of_two_inputs(filter_) for filter_ in FILTERS if of_two_inputs(filter_)}
MAKERS["morph of meshes"] = lambda one, other: simple.MorphDensities(
    mesh(one), Target=mesh(other), Parameter=0.25, DensityResolution=32, **BOTH)


class Series(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()

    def tearDown(self):
        reset()

    def expect_ends(self, morph, ask, source, target):
        for found, expected in zip(ends(morph, ask), (source, target, source)):
            self.assertAlmostEqual(found, place(expected), delta=0.5)

    def test_every_order_of_requests(self):
        for kind in ("vti", "pvd"):
            for name, way in WAYS.items():
                for order in ORDERS if kind == "vti" else ([5], [None]):
                    with self.subTest(kind=kind, way=name, order=order):
                        reset()
                        series = read(kind)
                        morph = morph_of(way(series, 1), way(series, 10))

                        def ask(morph, order=order):
                            for time in order:
                                update(morph, time)
                        self.expect_ends(morph, ask, 1, 10)
                        morph.Input, morph.Target = morph.Target, morph.Input
                        self.expect_ends(morph, ask, 10, 1)

    def test_one_input_follows_the_time(self):
        for name in ("force", "extract"):
            for time in (0, 11, 5, None):
                with self.subTest(way=name, time=time):
                    reset()
                    series = read()
                    chosen = WAYS[name](series, 8)
                    self.expect_ends(morph_of(series, chosen), lambda m: update(m, time),
                                     time or 0, 8)
                    self.expect_ends(morph_of(chosen, series), lambda m: update(m, time),
                                     8, time or 0)
        for time in (0, 4, None):
            series = read()
            later = simple.TemporalShiftScale(series, PostShift=-7)
            self.expect_ends(morph_of(series, later), lambda m: update(m, time),
                             time or 0, (time or 0) + 7)

    def test_both_at_one_time(self):
        for name, way in WAYS.items():
            with self.subTest(way=name):
                series = read()
                self.expect_ends(morph_of(way(series, 3), way(series, 3)),
                                 lambda m: update(m, 6), 3, 3)

    def test_filters_that_mixed_up_the_times(self):
        """ParaView's own filters of several inputs get all of them from the last request; Force Time and
        Temporal Interpolator keep what they got."""
        for name in WAYS:
            for time in (0, 11, 5):
                with self.subTest(way=name, time=time):
                    reset()
                    series = read()
                    one, other = WAYS[name](series, 1), WAYS[name](series, 10)
                    simple.AppendAttributes(Input=[one, other]).UpdatePipeline(time)
                    self.expect_ends(morph_of(one, other), lambda m: update(m, time), 1, 10)

    def test_every_filter_has_the_inputs_of_two_readers(self):
        for name, make in MAKERS.items():
            for first, second in (("force", "force"), ("extract", None), (None, "force")):
                for order in ([0], [5, 11]):
                    with self.subTest(filter=name, ways=(first, second), order=order):
                        reset()
                        found = []
                        for other in (None, "another reader"):
                            series = read()
                            readers = series, read() if other else series
                            inputs = [WAYS[way](reader, step) if way else reader for way, step, reader
                                      in zip((first, second), (2, 7), readers)]
                            proxy = make(*inputs)
                            for time in order:
                                update(proxy, time)
                            found.append(digest(proxy.GetClientSideObject().GetOutputDataObject(0)))
                        self.assertEqual(*found)

    def test_three_times_in_a_barycenter(self):
        for name in ("force", "extract", "passed, force"):
            for time in (0, 11, 5, None):
                with self.subTest(way=name, time=time):
                    reset()
                    series = read()
                    steps = (1, 10, 6)
                    barycenter = simple.DensityBarycenter(
                        Input=[WAYS[name](series, step) for step in steps], ParticlesPerCell=4,
                        **ARRAYS)
                    for weights, step in zip(np.eye(3), steps):
                        barycenter.Weights = list(weights)
                        update(barycenter, time)
                        self.assertAlmostEqual(centroid(barycenter), place(step), delta=0.5)

    def test_play(self):
        """The maps are made once, whichever way chose the times."""
        for source, target in (("force", "force"), ("extract", "extract"), (None, "shift")):
            with self.subTest(ways=(source, target)):
                series = read()
                one = WAYS[source](series, 0) if source else series
                other = (WAYS[target](series, 9) if target in WAYS else
                         simple.TemporalShiftScale(series, PostShift=-9))
                morph = morph_of(one, other, PublishTime=1)
                built = set()
                for time in (1, 0, 0.5, 1):
                    update(morph, time)
                    self.assertAlmostEqual(centroid(morph), place(9 * time), delta=0.5)
                    built.add(morph.GetClientSideObject().GetTableBuildTime())
                self.assertEqual(len(built), 1)

    def test_times_of_the_scene(self):
        """Those of the morph alone with PublishTime on, whatever is upstream; else those of the
        series, as before, but where the user ignores them."""
        own = [i / 10 for i in range(11)]

        def times():
            return list(simple.GetTimeKeeper().TimestepValues)

        for name in ("force", "extract", "passed, force"):
            with self.subTest(way=name):
                reset()
                series = read()
                of_series = times()
                self.assertEqual(len(of_series), STEPS)
                inputs = [WAYS[name](series, step) for step in (1, 10)]
                before = times()
                morph = morph_of(*inputs)
                update(morph, 0)
                off = times()
                for _ in range(2):
                    morph.PublishTime = 1
                    self.assertEqual(times(), own)
                    self.assertEqual(list(simple.GetAnimationScene().TimeKeeper.TimestepValues), own)
                    morph.PublishTime = 0
                    self.assertEqual(times(), off)
                morph.PublishTime = 1
                path = os.path.abspath(os.path.join(OUTPUT, "series-times.pvsm"))
                simple.SaveState(path)
                simple.Delete(morph)
                self.assertEqual(times(), before)
                reset()
                simple.LoadState(path)
                self.assertEqual(times(), own)
                loaded = next(source for (label, _), source in simple.GetSources().items()
                              if label.startswith("MorphDensities"))
                loaded.PublishTime = 0
                self.assertEqual(times(), off)

    def test_times_that_a_user_ignores(self):
        reset()
        series = read()
        morph = morph_of(*(WAYS["force"](series, step) for step in (1, 10)))
        keeper = simple.GetTimeKeeper()
        keeper.SMProxy.SetSuppressTimeSource(series.SMProxy, True)
        for published in (1, 0):
            morph.PublishTime = published
            self.assertFalse(keeper.SMProxy.IsTimeSourceTracked(series.SMProxy))
        keeper.SMProxy.SetSuppressTimeSource(series.SMProxy, False)
        morph.PublishTime = 1
        keeper.SMProxy.SetSuppressTimeSource(series.SMProxy, False)  # chosen again
        morph.NumberOfTimeSteps = 5
        self.assertTrue(keeper.SMProxy.IsTimeSourceTracked(series.SMProxy))

    def test_states(self):
        """Saved here, and loaded in another process, where nothing has been read yet."""
        for name, time in (("force", 0), ("force", 11), ("passed, force", 5), ("extract", 5)):
            with self.subTest(way=name, time=time):
                reset()
                series = read()
                morph = morph_of(WAYS[name](series, 1), WAYS[name](series, 10),
                                 registrationName="Morph")
                update(morph, time)
                path = os.path.abspath(os.path.join(OUTPUT, "series.pvsm"))
                simple.SaveState(path)
                subprocess.run([os.environ.get("RT_PVPYTHON", "pvpython"), __file__, path,
                                str(time)], check=True)
                found = np.loadtxt(path + ".txt")
                os.remove(path + ".txt")
                np.testing.assert_allclose(found, [place(step) for step in (1, 10, 1)], atol=0.5)

    @unittest.skipUnless(os.environ.get("DISPLAY"), "needs a display")
    def test_views(self):
        """A view shows the series, its times and the morph of them at the time of the scene."""
        series = read()
        shown = [WAYS["force"](series, 1), WAYS["force"](series, 10)]
        morph = morph_of(*shown)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        view = simple.CreateRenderView()
        for proxy in (series, morph, *shown):
            simple.Show(proxy, view)
        for time in (5, 0, 11, 11):
            scene.AnimationTime = time
            self.expect_ends(morph, lambda _: simple.Render(view), 1, 10)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        simple.LoadState(sys.argv[1])
        np.savetxt(sys.argv[1] + ".txt",
                   ends(simple.FindSource("Morph"), lambda m: update(m, float(sys.argv[2]))))
        os._exit(0)
    main()
