# SPDX-License-Identifier: BSD-3-Clause
"""Transport Temporal Interpolator: a series at its steps and between them, its particles and the arrays
that it carries. Series that are not as they should be: TestTemporalOdd.py."""
import os
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersGeneral import vtkTemporalStatistics

from rt_series import Series, write_series
from rt_temporal import (MOVING, N, blob, centroid, interpolator, particles, rectifiedtransport, simple,
                         values)
from rt_testing import OUTPUT, Listener, digest, main, positions


class Times(unittest.TestCase):
    def test_at_steps_the_input_comes_out(self):
        for kind in ("f4", "f8", "u1"):
            steps = [(200 * step / step.max()).astype(kind) for step in MOVING]
            for method in (0, 1):
                algorithm = interpolator(Series(steps), Method=method)
                for time, step in enumerate(steps):
                    algorithm.UpdateTimeStep(time)
                    self.assertTrue((values(algorithm) == step.ravel()).all(), (kind, method, time))
                    self.assertAlmostEqual(particles(algorithm, "Mass").sum() / step.sum(dtype=float), 1, 12)
                    self.assertEqual(algorithm.GetDensity().GetInformation().Get(
                        vtkImageData.DATA_TIME_STEP()), time)

    def test_between_steps_mass_moves(self):
        for method in (0, 1):
            algorithm = interpolator(Series(MOVING, times=[1, 3, 4]), Method=method)
            for time in (1.25, 2, 2.9):
                part = (time - 1) / 2
                algorithm.UpdateTimeStep(time)
                density = values(algorithm)
                mass = (1 - part) * MOVING[0].sum() + part * MOVING[1].sum()
                self.assertAlmostEqual(density.sum() / mass, 1, 9)
                self.assertAlmostEqual(particles(algorithm, "Mass").sum() / mass, 1, 9)
                field = algorithm.GetDensity().GetFieldData().GetArray("TotalMass").GetValue(0)
                self.assertAlmostEqual(field / mass, 1, 9)
                expected = (1 - part) * centroid(MOVING[0]) + part * centroid(MOVING[1])
                np.testing.assert_allclose(centroid(density), expected, atol=0.15)
                # One blob, not two: nothing has cross-faded.
                faded = (1 - part) * MOVING[0] + part * MOVING[1]
                truth = blob(*expected, 5, height=1 + 0.5 * part).ravel()
                self.assertLess(np.linalg.norm(density - truth), 0.3 * np.linalg.norm(faded.ravel() - truth))
            velocities = particles(algorithm, "Velocity")
            self.assertEqual(algorithm.GetParticles().GetPointData().GetVectors().GetName(), "Velocity")
            mean = np.average(velocities, axis=0, weights=particles(algorithm, "Mass"))
            np.testing.assert_allclose(mean[:2], (centroid(MOVING[1]) - centroid(MOVING[0])) / 2, atol=0.1)

    def test_a_map_that_spreads_leaves_no_stripes(self):
        algorithm = interpolator(Series([blob(24, 24, 4), blob(24, 24, 7, height=16 / 49)]))
        algorithm.UpdateTimeStep(0.5)
        truth = blob(24, 24, 5.5, height=16 / 5.5 ** 2).ravel()
        self.assertLess(np.abs(values(algorithm) - truth).max(), 0.06 * truth.max())

    def test_where_mass_comes_apart_there_is_none(self):
        """Halves of a blob go to both sides: halfway, from column 20 to 28, there is a gap."""
        columns = np.arange(N)[None, :]
        halves = blob(8, 24, 6) * (columns < 16) + blob(40, 24, 6) * (columns >= 32)
        algorithm = interpolator(Series([blob(24, 24, 6), halves]))
        algorithm.UpdateTimeStep(0.5)
        density = values(algorithm).reshape(N, N)
        self.assertLess(density[:, 21:27].sum(), 5e-4 * density.sum())

    def test_units_of_lengths_do_not_matter(self):
        """To the last bit in units that are powers of two; in others as far as rounding leaves the map."""
        spreading = [blob(20, 24, 4), blob(26, 24, 7)]
        for method, share in ((1, 1e-3), (0, 1e-12)):
            found = {}
            for spacing in (1.0, 2.0 ** -200, 2.0 ** 200, 1e-60, 1e60):
                algorithm = interpolator(Series(spreading, spacing=(spacing, spacing, 1)), Method=method)
                algorithm.UpdateTimeStep(0.5)
                found[spacing] = values(algorithm)
            for spacing in (2.0 ** -200, 2.0 ** 200):
                self.assertTrue((found[spacing] == found[1.0]).all(), spacing)
            for spacing in (1e-60, 1e60):
                self.assertLess(np.abs(found[spacing] - found[1.0]).sum(), share * found[1.0].sum())

    def test_near_a_step_is_near_that_step(self):
        algorithm = interpolator(Series(MOVING))
        for step in (0, 1, 2):
            for time in (step - 1e-9, step + 1e-9):
                algorithm.UpdateTimeStep(time)
                self.assertLess(np.abs(values(algorithm) - MOVING[step].ravel()).max(), 1e-6)

    def test_times_outside_are_the_ends(self):
        algorithm = interpolator(Series(MOVING))
        for time, step in ((-7, 0), (99, 2)):
            algorithm.UpdateTimeStep(time)
            self.assertTrue((values(algorithm) == MOVING[step].ravel()).all())

    def test_the_range_is_continuous_or_resampled(self):
        algorithm = interpolator(Series(MOVING, times=[0, 1, 3]))
        algorithm.UpdateInformation()
        for port in (0, 1):
            info = algorithm.GetOutputInformation(port)
            self.assertEqual(list(info.Get(Pipeline.TIME_RANGE())), [0, 3])
            self.assertFalse(info.Has(Pipeline.TIME_STEPS()))
        algorithm.SetResampleFactor(4)
        algorithm.UpdateInformation()
        for port in (0, 1):
            steps = algorithm.GetOutputInformation(port).Get(Pipeline.TIME_STEPS())
            np.testing.assert_allclose(steps, [0, 0.25, 0.5, 0.75, 1, 1.5, 2, 2.5, 3])

    def test_two_intervals_are_kept(self):
        series = Series([*MOVING, MOVING[0]])
        algorithm = interpolator(series)
        for time in (0.5, 0.7, 1.5, 0.2, 1.1, 0.9):
            algorithm.UpdateTimeStep(time)
        self.assertEqual(algorithm.GetNumberOfMaps(), 2)
        self.assertEqual(series.asked, [0, 1, 2])
        algorithm.UpdateTimeStep(2.5)
        self.assertEqual(algorithm.GetNumberOfMaps(), 3)

    def test_playing_backwards_gives_the_same(self):
        times = np.linspace(0, 2, 9)
        forward = interpolator(Series(MOVING))
        found = []
        for time in times:
            forward.UpdateTimeStep(time)
            found.append(digest(forward.GetDensity()))
        backward = interpolator(Series(MOVING))
        for time, before in zip(times[::-1], found[::-1]):
            backward.UpdateTimeStep(time)
            self.assertEqual(digest(backward.GetDensity()), before)

    def test_threads_do_not_change_a_bit(self):
        found = set()
        for threading in (1, 2, 3):
            algorithm = interpolator(Series(MOVING), Threading=threading)
            algorithm.UpdateTimeStep(0.3)
            found.add(digest(algorithm.GetDensity()) + digest(algorithm.GetParticles()))
        self.assertEqual(len(found), 1)

    def test_a_change_of_the_input_counts(self):
        series = Series(MOVING)
        algorithm = interpolator(series)
        algorithm.UpdateTimeStep(1)
        series.steps[1] = {"rho": 2 * MOVING[1]}
        series.Modified()
        algorithm.UpdateTimeStep(1)
        self.assertTrue((values(algorithm) == 2 * MOVING[1].ravel()).all())

    def test_a_change_of_the_times_or_the_spacing_alone_counts(self):
        series = Series(MOVING)
        algorithm = interpolator(series)
        algorithm.UpdateTimeStep(0.5)
        velocities = particles(algorithm, "Velocity")
        series.times = [0.0, 10.0, 20.0]
        series.Modified()
        algorithm.UpdateTimeStep(5)
        np.testing.assert_allclose(particles(algorithm, "Velocity"), velocities / 10, atol=1e-12)
        mass = particles(algorithm, "Mass").sum()
        series.spacing = (2.0, 3.0, 1.0)
        series.Modified()
        algorithm.UpdateTimeStep(5)
        self.assertAlmostEqual(particles(algorithm, "Mass").sum() / mass, 6, 9)
        self.assertEqual(algorithm.GetDensity().GetBounds()[:4], (0, 2 * N, 0, 3 * N))

    def test_properties_act(self):
        def run(**properties):
            algorithm = interpolator(Series(MOVING), **properties)
            algorithm.UpdateTimeStep(0.4)
            return digest(algorithm.GetDensity()) + digest(algorithm.GetParticles())
        runs = [run(), run(Method=0), run(TrackParticles=1), run(ParticlesPerCell=4), run(ParticlesPerCell=3), run(Kernel=1),
                run(Kernel=2), run(Kernel=3), run(Kernel=3, Radius=2), run(InvertDensity=1)]
        self.assertEqual(len(set(runs)), len(runs))

    def test_points_lines_and_volumes(self):
        line = [blob(10, 10)[10], blob(30, 10)[10]]
        volume = [np.multiply.outer(blob(x, x, 2, 16)[int(x)], blob(x, 6, 2, 16)) for x in (5, 9)]
        for steps, points in ((line, False), (MOVING, True), (volume, False), (volume, True)):
            algorithm = interpolator(Series(steps, points=points))
            algorithm.UpdateTimeStep(0.5)
            density = values(algorithm, points=points)
            self.assertAlmostEqual(density.sum() / (0.5 * (steps[0].sum() + steps[1].sum())), 1, 9)
            algorithm.UpdateTimeStep(1)
            self.assertTrue((values(algorithm, points=points) == steps[1].ravel()).all())


class Chains(unittest.TestCase):
    def test_particles_keep_their_identity(self):
        for method in (0, 1):
            algorithm = interpolator(Series(MOVING), TrackParticles=1, Method=method)
            at = {}
            for time in (0, 0.5, 1, 1.5, 2):
                algorithm.UpdateTimeStep(time)
                self.assertTrue((particles(algorithm, "SeedId") == np.arange(N * N)).all())
                at[time] = positions(algorithm.GetParticles())
                mass = particles(algorithm, "Mass")
                self.assertEqual(len(set(mass)), 1)
                if time == int(time):
                    self.assertAlmostEqual(mass.sum() / MOVING[int(time)].sum(), 1, 9)
                    # The masses of blocks are those of the step.
                    blocks = [v.reshape(6, 8, 6, 8).sum((1, 3)) for v in (values(algorithm), MOVING[int(time)])]
                    self.assertLess(np.linalg.norm(blocks[0] - blocks[1]), 0.02 * np.linalg.norm(blocks[1]))
            np.testing.assert_allclose(at[0.5], 0.5 * (at[0] + at[1]), atol=1e-9)
            np.testing.assert_allclose(at[1.5], 0.5 * (at[1] + at[2]), atol=1e-9)

    def test_a_late_time_is_as_after_those_before_it(self):
        late = interpolator(Series(MOVING), TrackParticles=1)
        late.UpdateTimeStep(1.75)
        played = interpolator(Series(MOVING), TrackParticles=1)
        for time in (0, 1.5, 0.25, 1.75):
            played.UpdateTimeStep(time)
        self.assertEqual(digest(late.GetParticles()), digest(played.GetParticles()))
        self.assertEqual(played.GetNumberOfMaps(), 3)  # the samples of the first step count

    def test_a_change_of_a_property_counts(self):
        algorithm = interpolator(Series(MOVING), TrackParticles=1)
        algorithm.UpdateTimeStep(1.5)
        for name, value in (("Method", 0), ("ParticlesPerCell", 2)):
            getattr(algorithm, "Set" + name)(value)
            algorithm.UpdateTimeStep(1.5)
            fresh = interpolator(Series(MOVING), TrackParticles=1, Method=0, ParticlesPerCell=algorithm.GetParticlesPerCell())
            fresh.UpdateTimeStep(1.5)
            self.assertEqual(digest(algorithm.GetParticles()), digest(fresh.GetParticles()), name)

    def test_a_change_of_what_is_read_counts(self):
        algorithm = interpolator(Series(MOVING), TrackParticles=1)
        algorithm.UpdateTimeStep(1.5)
        algorithm.SetInvertDensity(1)
        algorithm.UpdateTimeStep(1.5)
        fresh = interpolator(Series(MOVING), TrackParticles=1, InvertDensity=1)
        fresh.UpdateTimeStep(1.5)
        self.assertEqual(digest(algorithm.GetParticles()), digest(fresh.GetParticles()))

    def test_a_change_of_an_early_step_counts(self):
        series = Series(MOVING)
        algorithm = interpolator(series, TrackParticles=1)
        algorithm.UpdateTimeStep(1.5)
        before = digest(algorithm.GetParticles())
        series.Modified()
        algorithm.UpdateTimeStep(1.5)
        self.assertEqual(algorithm.GetNumberOfMaps(), 3)
        series.steps[0] = {"rho": blob(8, 20)}
        series.Modified()
        algorithm.UpdateTimeStep(1.5)
        self.assertNotEqual(digest(algorithm.GetParticles()), before)
        fresh = interpolator(series, TrackParticles=1)
        fresh.UpdateTimeStep(1.5)
        self.assertEqual(digest(algorithm.GetParticles()), digest(fresh.GetParticles()))


class Carrying(unittest.TestCase):
    def steps(self):
        c = np.arange(N) + 0.5
        return [{"rho": density, "x": np.broadcast_to(c - centroid(density)[0], (N, N)).copy(),
                 "label": np.full((N, N), 7, "i4"),
                 "vector": np.stack([np.full((N, N), float(i))] * 3, -1)} for i, density in enumerate(MOVING)]

    def test_arrays_move_along(self):
        algorithm = interpolator(Series(self.steps()))
        algorithm.UpdateTimeStep(0.5)
        density, x = values(algorithm), values(algorithm, "x")
        here = np.tile(np.arange(N) + 0.5, N) - centroid(density)[0]
        filled = density > 0.1 * density.max()
        # What is at a blob's centre is at its centre on the way, which is far from there in both images.
        self.assertLess(np.abs(x - here)[filled].max(), 0.6)
        self.assertEqual(values(algorithm, "label").dtype, np.int32)
        self.assertTrue((values(algorithm, "label") == 7).all())
        np.testing.assert_allclose(values(algorithm, "vector"), 0.5, atol=1e-12)

    def test_at_steps_they_are_those_of_the_input(self):
        steps = self.steps()
        algorithm = interpolator(Series(steps))
        for time in (1, 2, 0):
            algorithm.UpdateTimeStep(time)
            for name in ("x", "label"):
                self.assertTrue((values(algorithm, name) == steps[time][name].ravel()).all())

    def test_off_gives_the_density_alone(self):
        algorithm = interpolator(Series(self.steps()), AdvectArrays=0)
        for time in (0, 0.5):
            algorithm.UpdateTimeStep(time)
            self.assertEqual(algorithm.GetDensity().GetCellData().GetNumberOfArrays(), 1)
        algorithm.SetAdvectArrays(1)
        algorithm.Update()
        self.assertEqual(algorithm.GetDensity().GetCellData().GetNumberOfArrays(), 4)
        self.assertEqual(algorithm.GetNumberOfMaps(), 1)

    def test_an_array_that_a_step_lacks(self):
        steps = self.steps()
        del steps[1]["x"]
        algorithm = interpolator(Series(steps))
        listener = Listener(algorithm)
        algorithm.UpdateTimeStep(0.5)
        self.assertIsNone(values(algorithm, "x"))
        self.assertIsNotNone(values(algorithm, "label"))
        self.assertEqual(listener.errors, [])
        self.assertEqual(len(listener.warnings), 1)
        self.assertIn("Time step 1 of 3 (t = 0) and the next one do not both have", listener.warnings[0])
        self.assertIn("'x'", listener.warnings[0])


class Upstream(unittest.TestCase):
    def test_filters_of_all_times_downstream(self):
        """A filter of several times downstream runs each of ours once for each time."""
        for make in (rectifiedtransport.vtkTransportMap, rectifiedtransport.vtkTransportTemporalInterpolator):
            series, algorithm = Series(MOVING), make()
            algorithm.SetInputConnection(series.GetOutputPort())
            runs = []
            algorithm.AddObserver("EndEvent", lambda *_, runs=runs: runs.append(1))
            if make is not rectifiedtransport.vtkTransportMap:
                algorithm.SetResampleFactor(1)
            statistics = vtkTemporalStatistics()
            statistics.SetInputConnection(algorithm.GetOutputPort())
            statistics.Update()
            self.assertEqual(series.asked, [0, 1, 2])
            self.assertEqual(len(runs), 3)


class InParaView(unittest.TestCase):
    def reader(self, name, steps):
        return simple.PVDReader(FileName=write_series(os.path.join(OUTPUT, name), Series(steps)))

    def density(self, proxy, time, points=False):
        proxy.UpdatePipeline(time)
        data = proxy.GetClientSideObject().GetOutputDataObject(0)
        return vtk_to_numpy((data.GetPointData() if points else data.GetCellData()).GetArray("rho"))

    def test_files_and_a_filter_downstream(self):
        proxy = simple.TransportTemporalInterpolator(self.reader("temporal", MOVING), DensityArray=["CELLS", "rho"])
        downstream = simple.CellDatatoPointData(proxy)
        calculator = simple.Calculator(proxy, AttributeType="Cell Data", ResultArrayName="rho", Function="2*rho")
        for time in (0.5, 1, 0.75, 0):
            twice = self.density(calculator, time).copy()
            np.testing.assert_allclose(twice, 2 * self.density(proxy, time))
            downstream.UpdatePipeline(time)
            self.assertEqual(downstream.GetDataInformation().GetNumberOfPoints(), (N + 1) ** 2)
        self.assertTrue((self.density(proxy, 2) == MOVING[2].ravel()).all())

    def test_any_data_set(self):
        reader = self.reader("temporal-mesh", MOVING)
        mesh = simple.Threshold(reader, Scalars=["CELLS", "rho"], LowerThreshold=1e-6, UpperThreshold=1e6)
        proxy = simple.TransportTemporalInterpolator(mesh, DensityArray=["CELLS", "rho"], DensityResolution=64)
        for time in (0.5, 1, 1.5):
            proxy.UpdatePipeline(time)
            data = proxy.GetClientSideObject().GetOutputDataObject(0)
            low, part = int(time), time - int(time)
            mass = (1 - part) * MOVING[low].sum() + part * MOVING[min(2, low + 1)].sum()
            cell = np.prod([s for s in data.GetSpacing()[:2]])
            self.assertAlmostEqual(vtk_to_numpy(data.GetCellData().GetArray("rho")).sum() * cell / mass, 1, 2)

    def test_paths(self):
        proxy = simple.TransportTemporalInterpolator(self.reader("temporal-paths", MOVING), DensityArray=["CELLS", "rho"],
                                                     TrackParticles=1, ResampleFactor=2)
        proxy.UpdatePipelineInformation()
        self.assertEqual(list(proxy.TimestepValues), [0, 0.5, 1, 1.5, 2])
        paths = simple.TemporalParticlesToPathlines(simple.OutputPort(proxy, 1), MaskPoints=100, MaxTrackLength=10,
                                                    IdChannelArray="SeedId", MaxStepDistance=[N, N, N])
        for time in proxy.TimestepValues:
            paths.UpdatePipeline(time)
        self.assertGreater(paths.GetDataInformation().GetNumberOfCells(), 10)


if __name__ == "__main__":
    main()
