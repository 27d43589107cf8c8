# SPDX-License-Identifier: BSD-3-Clause
"""Transport Distance: distances that are known, bounds, points, what is kept, time steps, names and bad
inputs."""
import unittest

import numpy as np
from rt_series import Series
from rt_testing import Listener, density_image, digest, load_plugin, main, producer
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkTable
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

simple = load_plugin()
from rectifiedtransport import vtkTransportDistance  # after the plugin's package

SIDE = 40


def bell(x, y, width=3.0):
    """Over nothing; cells are 0.5 by 2."""
    columns, rows = np.arange(SIDE) + 0.5, np.arange(SIDE) + 0.5
    squared = (columns[None, :] - x) ** 2 + (rows[:, None] - y) ** 2
    return np.where(squared < 64, np.exp(-squared / (2 * width ** 2)), 0)


def image(values):
    return density_image(values.shape[::-1], values=values.ravel())


def bells(*places):
    return [image(bell(*place)) for place in places]


def algorithm_of(inputs, **properties):
    algorithm = vtkTransportDistance()
    for data in inputs:
        algorithm.AddInputDataObject(data)
    for name, value in properties.items():
        getattr(algorithm, "Set" + name)(value)
    return algorithm


def run(inputs, **properties):
    algorithm = algorithm_of(inputs, **properties)
    algorithm.Update()
    return algorithm


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


def names(algorithm):
    table = algorithm.GetDistances()
    return [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]


def matrix(algorithm):
    table = algorithm.GetDistances()
    return np.array([vtk_to_numpy(table.GetColumn(i)) for i in range(table.GetNumberOfColumns())])


def errors_of(algorithm):
    listener = Listener(algorithm)
    algorithm.Update()
    return listener.errors, listener.warnings


class Distances(unittest.TestCase):
    PLACES = (12, 12), (20, 12), (12, 18), (24, 26)

    def truth(self):
        places = np.array(self.PLACES) * (0.5, 2)
        return np.linalg.norm(places[:, None] - places[None], axis=2)

    def test_translations(self):
        off = ~np.eye(len(self.PLACES), dtype=bool)
        for method, tolerance in (0, 0.02), (1, 0.01):
            with self.subTest(method):
                found = matrix(run(bells(*self.PLACES), Method=method))
                np.testing.assert_array_equal(found, found.T)
                np.testing.assert_array_equal(np.diag(found), 0)
                np.testing.assert_allclose((found / np.maximum(self.truth(), 1e-9))[off], 1,
                                           atol=tolerance)

    def test_bounds_hold(self):
        i, j = np.triu_indices(len(self.PLACES), 1)
        truth = self.truth()[i, j]
        for method in (0, 1):
            distances = run(bells(*self.PLACES), Method=method)
            bounds = distances.GetBounds()
            np.testing.assert_array_equal(column(bounds, "First"), i)
            np.testing.assert_array_equal(column(bounds, "Second"), j)
            lower, upper = column(bounds, "LowerBound"), column(bounds, "UpperBound")
            self.assertTrue((lower <= truth * (1 + 1e-9)).all())
            self.assertTrue((lower <= upper).all())
            np.testing.assert_array_equal(matrix(distances)[i, j], lower if method else upper)
            self.assertTrue((lower >= truth * 0.99).all())
            self.assertTrue((upper >= truth * (1 - (1e-9 if method else 0.02))).all())
            self.assertTrue((upper <= truth * 1.06).all())

    def test_linearized_is_a_metric_above_certified(self):
        rng = np.random.default_rng(3)
        inputs = [image(rng.random((12, 12)) ** 8) for _ in range(6)]
        found, certified = (matrix(run(inputs, Method=method)) for method in (0, 1))
        for middle in range(len(inputs)):
            self.assertTrue((found <= found[:, [middle]] + found[[middle], :] + 1e-12).all())
        self.assertTrue((found >= 0.98 * certified).all())

    def test_other_resolutions(self):
        """Linearized takes any, Certified says that it does not."""
        coarse, fine = density_image((20, 20), values=bell(20, 20)[::2, ::2].ravel()), bells((26, 20))[0]
        coarse.SetSpacing(1, 4, 1)
        self.assertAlmostEqual(matrix(run([coarse, fine]))[0, 1], 3, delta=0.3)
        errors, _ = errors_of(algorithm_of([coarse, fine], Method=1))
        self.assertIn("same number of cells along each axis", errors[0])
        self.assertIn("20 x 20", errors[0])

    def test_lines_and_solids(self):
        values = np.zeros((2, 24, 10, 12))
        values[0, 4:8, 2:5, 3:6] = 1
        values[1, 14:18, 2:5, 3:6] = 1
        for inputs, way in (([density_image((12, 10, 24), values=v.ravel()) for v in values], 10),
                            ([density_image((24,), values=v[:, 3, 4].copy()) for v in values], 5)):
            for method in (0, 1):
                self.assertAlmostEqual(matrix(run(inputs, Method=method))[0, 1] / way, 1, delta=0.06)


class Coordinates(unittest.TestCase):
    def test_line(self):
        algorithm = run(bells((10, 20), (14, 20), (22, 20), (30, 20)), Method=1)
        table = algorithm.GetCoordinates()
        x = column(table, "Coordinate0")
        np.testing.assert_allclose(np.abs(x - x[0]), [0, 2, 6, 10], atol=0.02)
        self.assertLess(np.abs(column(table, "Coordinate1")).max(), 0.2)
        self.assertLess(table.GetFieldData().GetArray("Stress").GetValue(0), 0.01)
        self.assertGreater(x[np.argmax(np.abs(x))], 0)

    def test_dimensions(self):
        inputs = bells((10, 20), (14, 28), (22, 14))
        stresses = []
        for dimensions in (1, 2, 5):
            table = run(inputs, NumberOfCoordinates=dimensions).GetCoordinates()
            self.assertIsNone(table.GetColumnByName("Coordinate%d" % dimensions))
            self.assertEqual(len(column(table, "Coordinate%d" % (dimensions - 1))), 3)
            stresses.append(table.GetFieldData().GetArray("Stress").GetValue(0))
        self.assertGreater(stresses[0], stresses[1])
        self.assertLess(stresses[2], 1e-9)
        np.testing.assert_allclose(column(table, "Coordinate4"), 0, atol=1e-6)


class Kept(unittest.TestCase):
    def test_nothing_twice(self):
        for method, first, one_more in (0, 4, 1), (1, 6, 4):
            with self.subTest(method):
                inputs = bells((10, 20), (14, 28), (22, 14), (25, 25))
                algorithm = run(inputs, Method=method)
                before = matrix(algorithm)
                self.assertEqual(algorithm.GetNumberOfSolutions(), first)

                def changed(now):
                    algorithm.RemoveAllInputs()
                    for data in now:
                        algorithm.AddInputDataObject(data)
                    algorithm.Update()
                    return matrix(algorithm)

                np.testing.assert_array_equal(changed(inputs[::-1]), before[::-1, ::-1])
                copies = bells((10, 20), (14, 28), (22, 14), (25, 25))
                np.testing.assert_array_equal(changed(copies), before)
                algorithm.SetNumberOfCoordinates(3)
                algorithm.SetInputName(0, "first")
                algorithm.Update()
                self.assertEqual(algorithm.GetNumberOfSolutions(), first)
                more = changed(copies + bells((18, 20)))
                np.testing.assert_array_equal(more[:4, :4], before)
                self.assertEqual(algorithm.GetNumberOfSolutions(), first + one_more)
                np.testing.assert_array_equal(changed(inputs[:3]), before[:3, :3])
                self.assertEqual(algorithm.GetNumberOfSolutions(), first + one_more)

    def test_both_methods(self):
        algorithm = run(bells((10, 20), (14, 28), (22, 14)))
        for method in (1, 0, 1):
            algorithm.SetMethod(method)
            algorithm.Update()
        self.assertEqual(algorithm.GetNumberOfSolutions(), 6)

    def test_same_twice_is_one(self):
        algorithm = run(bells((10, 20), (10, 20), (22, 14)))
        self.assertEqual(algorithm.GetNumberOfSolutions(), 2)
        self.assertEqual(matrix(algorithm)[0, 1], 0)

    def test_a_value(self):
        inputs = bells((10, 20), (14, 28))
        algorithm = run(inputs)
        before = matrix(algorithm)
        inputs[0].GetCellData().GetScalars().SetValue(0, 1.0)
        inputs[0].GetCellData().GetScalars().Modified()
        algorithm.Update()
        self.assertEqual(algorithm.GetNumberOfSolutions(), 3)
        self.assertNotEqual(matrix(algorithm)[0, 1], before[0, 1])

    def test_threads_and_weights(self):
        """The same bits by all kinds of threads; what a property changes is computed anew."""
        inputs = bells((10, 20), (14, 28), (22, 14))
        for method in (0, 1):
            digests = set()
            for threading in range(4):
                algorithm = run(inputs, Method=method, Threading=threading)
                digests.add(tuple(digest(algorithm.GetOutputDataObject(port)) for port in range(3)))
            self.assertEqual(len(digests), 1)
        algorithm = run(inputs)
        algorithm.SetInvertDensity(1)
        algorithm.Update()
        self.assertEqual(algorithm.GetNumberOfSolutions(), 6)


class Masses(unittest.TestCase):
    def test_normalize(self):
        a, b = bell(12, 20), bell(24, 20)
        same = run([image(a), image(b)], Method=1)
        errors, warnings = errors_of(algorithm_of([image(a), image(4 * b)], Method=1))
        self.assertFalse(errors)
        self.assertIn("each is divided by its mass", warnings[0])
        self.assertIn("Input 2 of 2", warnings[0])
        other = run([image(a), image(4 * b)], Method=1)
        np.testing.assert_allclose(matrix(other), matrix(same))
        masses = column(other.GetCoordinates(), "TotalMass")
        np.testing.assert_allclose(masses, [a.sum(), 4 * b.sum()])

    def test_said_once(self):
        algorithm = algorithm_of([image(bell(12, 20)), image(4 * bell(24, 20))])
        listener = Listener(algorithm)
        for dimensions in (1, 2, 3):
            algorithm.SetNumberOfCoordinates(dimensions)
            algorithm.Update()
        self.assertEqual(len(listener.warnings), 1)

    def test_error(self):
        a, b = bell(12, 20), bell(24, 20)
        errors, warnings = errors_of(algorithm_of([image(a), image(1.001 * b)], MassDifference=1))
        self.assertIn("MassDifference Normalize", errors[0])
        self.assertFalse(warnings)
        self.assertFalse(errors_of(algorithm_of([image(a), image(a)], MassDifference=1))[0])


def moving(times, bad=None):
    """A bell that moves with time; one step may be bad."""
    steps = [bell(10 + 4 * time, 20) for time in times]
    if bad is not None:
        steps[list(times).index(bad)][3, 4] = np.nan
    return Series(steps, times, spacing=image(steps[0]).GetSpacing())


class OverTime(unittest.TestCase):
    STEPS = [0, 0.5, 1, 2, 4]

    def over(self, series, **properties):
        algorithm = algorithm_of([], OverTime=1, **properties)
        algorithm.SetInputConnection(series.GetOutputPort())
        return algorithm

    def test_steps(self):
        for method in (0, 1):
            series = moving(self.STEPS)
            algorithm = self.over(series, Method=method)
            progress = []
            algorithm.AddObserver("ProgressEvent", lambda *_: progress.append(algorithm.GetProgress()))
            algorithm.Update()
            self.assertEqual(series.asked, self.STEPS)
            self.assertEqual(names(algorithm), ["t = 0", "t = 0.5", "t = 1", "t = 2", "t = 4"])
            np.testing.assert_allclose(matrix(algorithm)[0], 2 * np.array(self.STEPS), atol=0.1)
            np.testing.assert_array_equal(column(algorithm.GetCoordinates(), "Time"), self.STEPS)
            self.assertEqual(progress, sorted(progress))
            self.assertGreater(len(progress), len(self.STEPS))
            self.assertEqual(progress[-1], 1)
            same = run(bells(*((10 + 4 * time, 20) for time in self.STEPS)), Method=method)
            np.testing.assert_array_equal(matrix(algorithm), matrix(same))

    def test_runs_once(self):
        """Whatever time is asked for, and through a filter after it."""
        series = moving(self.STEPS)
        algorithm = self.over(series)
        for time in (0, 2, 1):
            algorithm.UpdateTimeStep(time)
        self.assertEqual(series.asked, self.STEPS)
        self.assertFalse(algorithm.GetOutputInformation(0).Has(
            vtkStreamingDemandDrivenPipeline.TIME_STEPS()))
        series.Modified()
        algorithm.Update()
        self.assertEqual(series.asked, 2 * self.STEPS)
        self.assertEqual(algorithm.GetNumberOfSolutions(), len(self.STEPS))

    def test_errors(self):
        errors, _ = errors_of(self.over(moving(self.STEPS, bad=1)))
        self.assertIn("Time step 3 of 5 (t = 1)", errors[0])
        self.assertIn("NaN or infinite", errors[0])
        errors, _ = errors_of(self.over(moving([3])))
        self.assertIn("one time step", errors[0])
        errors, _ = errors_of(algorithm_of(bells((10, 20)), OverTime=1))
        self.assertIn("no time steps", errors[0])
        errors, _ = errors_of(algorithm_of(bells((10, 20), (12, 20)), OverTime=1))
        self.assertIn("there are 2 inputs", errors[0])

    def test_a_reader_that_fails(self):
        """VTK's own way to run a filter for several times would not end."""
        series = moving(self.STEPS)
        algorithm = self.over(series)
        series.broken = 1
        errors, _ = errors_of(algorithm)
        self.assertIn("The input could not be made at the time 1; mend the error", "".join(errors))
        self.assertEqual(series.asked, self.STEPS[:3])
        series.broken = None
        series.Modified()
        algorithm.Update()
        self.assertEqual(algorithm.GetDistances().GetNumberOfRows(), len(self.STEPS))

    def test_again_after_an_error(self):
        series = moving(self.STEPS, bad=2)
        algorithm = self.over(series)
        listener = Listener(algorithm)
        algorithm.Update()
        self.assertTrue(listener.errors)
        self.assertEqual(algorithm.GetDistances().GetNumberOfRows(), 0)
        series.steps, series.asked = moving(self.STEPS).steps, []
        series.Modified()
        algorithm.Update()
        self.assertEqual(series.asked, self.STEPS)
        self.assertEqual(algorithm.GetDistances().GetNumberOfRows(), len(self.STEPS))
        algorithm.SetOverTime(0)
        algorithm.Update()
        self.assertIn("There is one density", listener.errors[-1] + listener.errors[-2])


class Names(unittest.TestCase):
    def test_numbers_and_names(self):
        algorithm = algorithm_of(bells((10, 20), (14, 28), (22, 14), (12, 12)))
        algorithm.SetInputName(1, "wind")
        algorithm.SetInputName(2, "wind")
        algorithm.SetInputName(3, "wind")
        algorithm.Update()
        self.assertEqual(names(algorithm), ["Input 1", "wind", "wind (2)", "wind (3)"])
        labels = algorithm.GetCoordinates().GetColumnByName("Name")
        self.assertEqual([labels.GetValue(i) for i in range(4)], names(algorithm))
        algorithm.SetNumberOfInputNames(0)
        algorithm.Update()
        self.assertEqual(names(algorithm)[1:3], ["Input 2", "Input 3"])

    def test_blocks(self):
        blocks = vtkMultiBlockDataSet()
        for i, data in enumerate(bells((10, 20), (14, 28), (22, 14))):
            blocks.SetBlock(i, data)
        blocks.GetMetaData(1).Set(vtkMultiBlockDataSet.NAME(), "middle")
        self.assertEqual(names(run([blocks])), ["Input 1", "middle", "Input 3"])
        blocks.SetBlock(3, vtkTable())
        errors, warnings = errors_of(algorithm_of([blocks]))
        self.assertFalse(errors)
        self.assertIn("passed over", warnings[0])

    def test_pipeline(self):
        """Of ParaView's browser."""
        sources = [producer(simple, data) for data in bells((10, 20), (14, 28))]
        simple.RenameSource("calm", sources[0])
        simple.RenameSource("storm", sources[1])
        distance = simple.TransportDistance(Input=sources)
        distance.UpdatePipeline()
        self.assertEqual(names(distance.GetClientSideObject()), ["calm", "storm"])


class BadInputs(unittest.TestCase):
    def refused(self, text, inputs, **properties):
        algorithm = algorithm_of(inputs, **properties)
        errors, _ = errors_of(algorithm)
        self.assertTrue(errors, text)
        self.assertIn(text, errors[0])
        for port in range(3):
            self.assertEqual(algorithm.GetOutputDataObject(port).GetNumberOfColumns(), 0)

    def test_inputs(self):
        good = bells((10, 20), (14, 28))
        nan = bells(*((10 + i / 4, 20) for i in range(40)))
        nan[16].GetCellData().GetScalars().SetValue(7, np.nan)
        moved, turned, other, zero, negative = bells(*5 * [(20, 20)])
        moved.SetOrigin(0.25, 0, 0)
        turned.SetDirectionMatrix(0, 1, 0, -1, 0, 0, 0, 0, 1)
        other.GetCellData().GetScalars().SetName("Other")
        zero.GetCellData().GetScalars().Fill(0)
        negative.GetCellData().GetScalars().SetValue(3, -1)
        self.refused("There is one density", good[:1])
        self.refused("Input 17 of 40: The density array 'Density' has 1 value that is NaN", nan)
        self.refused("Input 2 of 2 reaches from 0.25 to 20.25 along x", [good[0], moved])
        self.refused("different direction matrices", [good[0], turned])
        self.refused("Input 3 of 3: The density array 'Density' has a total mass of zero", [*good, zero])
        self.refused("negative value", [*good, negative])
        self.refused("axes", [good[0], density_image((4, 4, 4))])
        for name, value in ("Method", 2), ("MassDifference", -1), ("NumberOfCoordinates", 0), ("NumberOfCoordinates", 101):
            self.refused("%s is %d; it must be" % (name, value), good, **{name: value})
        algorithm = algorithm_of([*good, other])
        algorithm.SetInputArrayToProcess(0, 0, 0, 1, "Density")
        errors, _ = errors_of(algorithm)
        self.assertIn("Input 3 of 3: The input image has no density array 'Density'", errors[0])
        self.assertIn("Other", errors[0])

    def test_none(self):
        algorithm = vtkTransportDistance()
        errors, _ = errors_of(algorithm)
        self.assertIn("0 connections", errors[0])

    def test_empty(self):
        from vtkmodules.vtkCommonDataModel import vtkImageData
        algorithm = algorithm_of([*bells((10, 20)), vtkImageData()])
        self.assertEqual(errors_of(algorithm), ([], []))
        self.assertEqual(algorithm.GetDistances().GetNumberOfColumns(), 0)

    def test_the_advice_helps(self):
        """Images of other boxes, resampled as the message says."""
        from vtkmodules.vtkFiltersCore import vtkResampleToImage
        small, large = bells((20, 20), (24, 20))
        small.SetSpacing(0.4, 1.6, 1)
        resampled = []
        for data in (small, large):
            resample = vtkResampleToImage()
            resample.SetInputDataObject(data)
            resample.UseInputBoundsOff()
            resample.SetSamplingBounds(0, 20, 0, 80, 0, 0)
            resample.SetSamplingDimensions(60, 60, 1)
            resample.Update()
            resampled.append(resample.GetOutput())
        algorithm = algorithm_of(resampled)
        algorithm.SetInputArrayToProcess(0, 0, 0, 0, "Density")
        self.assertFalse(errors_of(algorithm)[0])


class Abort(unittest.TestCase):
    def test_ends_soon(self):
        rng = np.random.default_rng(1)
        inputs = [density_image((96, 96), values=rng.random(96 * 96)) for _ in range(12)]
        for method in (0, 1):
            algorithm = algorithm_of(inputs, Method=method)
            seen = []

            def stop(*_):
                seen.append(algorithm.GetProgress())
                if 0.3 < seen[-1] < 1:
                    algorithm.SetAbortExecute(1)

            algorithm.AddObserver("ProgressEvent", stop)
            errors, warnings = errors_of(algorithm)
            self.assertEqual(errors, [])
            self.assertIn("The run was aborted", *warnings)
            self.assertEqual(seen, sorted(seen))
            self.assertLess(max(progress for progress in seen if progress < 1), 0.7)
            self.assertEqual(algorithm.GetDistances().GetNumberOfColumns(), 0)
            done = algorithm.GetNumberOfSolutions()
            algorithm.RemoveAllObservers()
            algorithm.SetAbortExecute(0)
            algorithm.Modified()
            algorithm.Update()
            self.assertEqual(algorithm.GetDistances().GetNumberOfColumns(), 12)
            self.assertGreaterEqual(algorithm.GetNumberOfSolutions(), done)


if __name__ == "__main__":
    main()
