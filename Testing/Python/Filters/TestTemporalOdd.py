# SPDX-License-Identifier: BSD-3-Clause
"""Transport Temporal Interpolator: series that are not as they should be."""
import unittest

import numpy as np
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from rt_series import Series
from rt_temporal import MOVING, N, blob, centroid, interpolator, particles, rectifiedtransport, values
from rt_testing import Listener, digest, main, positions


class Odd(unittest.TestCase):
    def error(self, series, time, **properties):
        algorithm = interpolator(series, **properties)
        listener = Listener(algorithm)
        algorithm.UpdateTimeStep(time)
        self.assertEqual(len(listener.errors), 1, listener.errors)
        self.assertEqual(algorithm.GetDensity().GetNumberOfPoints(), 0)
        self.assertEqual(algorithm.GetParticles().GetNumberOfPoints(), 0)
        return listener.errors[0], algorithm

    def test_no_input(self):
        algorithm = rectifiedtransport.vtkRectifiedTransport.vtkTransportTemporalInterpolator()
        listener = Listener(algorithm)
        algorithm.Update()
        self.assertEqual(len(listener.errors), 1)

    def test_nan_in_one_step(self):
        steps = [step.copy() for step in MOVING]
        steps[1][3, 4] = np.nan
        text, algorithm = self.error(Series(steps), 1.5)
        self.assertIn("Time step 2 of 3 (t = 1): The density array 'rho' has 1 value that is NaN or infinite", text)
        algorithm.SetNaNValuesToEmpty()  # as it advises
        listener = Listener(algorithm)
        algorithm.UpdateTimeStep(1.5)
        self.assertEqual(listener.errors, [])
        self.assertGreater(algorithm.GetDensity().GetNumberOfPoints(), 0)

    def test_a_reader_that_fails(self):
        """VTK's own way to run a filter for several times would not end."""
        for chain in (0, 1):
            series = Series(MOVING)
            series.broken = 1
            algorithm = interpolator(series, TrackParticles=chain)
            listener = Listener(algorithm)
            algorithm.UpdateTimeStep(0.5)
            self.assertIn("The input could not be made at the time 1; mend the error", "".join(listener.errors))
            self.assertEqual(algorithm.GetDensity().GetNumberOfPoints(), 0)
            self.assertEqual(series.asked, [0, 1])
            series.broken = None
            series.Modified()
            algorithm.UpdateTimeStep(0.5)
            self.assertGreater(algorithm.GetDensity().GetNumberOfPoints(), 0)

    def test_after_an_error_other_times_work(self):
        steps = [*MOVING, -MOVING[0]]
        text, algorithm = self.error(Series(steps), 2.5)
        self.assertIn("Time step 4 of 4 (t = 3): The density array 'rho' has", text)
        algorithm.UpdateTimeStep(0.5)
        self.assertGreater(algorithm.GetDensity().GetNumberOfPoints(), 0)

    def test_a_step_that_lacks_the_density(self):
        series = Series([MOVING[0], {"other": MOVING[1]}])
        algorithm = interpolator(series)
        algorithm.SetInputArrayToProcess(0, 0, 0, 1, "rho")
        listener = Listener(algorithm)
        algorithm.UpdateTimeStep(0.5)
        self.assertEqual(len(listener.errors), 1)
        self.assertIn("Time step 2 of 2 (t = 1): The input image has no density array 'rho'; it has", listener.errors[0])

    def test_a_step_without_mass(self):
        empty = np.zeros((N, N))
        algorithm = interpolator(Series([empty, MOVING[0], empty, empty]))
        listener = Listener(algorithm)
        for time, factor in ((0, 0), (0.25, 0.25), (1, 1), (1.5, 0.5), (2, 0), (2.5, 0)):
            algorithm.UpdateTimeStep(time)
            np.testing.assert_allclose(values(algorithm), factor * MOVING[0].ravel(), atol=1e-12)
            self.assertTrue((particles(algorithm, "Velocity") == 0).all())
        self.assertEqual(listener.errors, [])
        self.assertTrue(any("Time step 1 of 4 (t = 0) has no mass: that of the next step appears where it is" in text
                            for text in listener.warnings), listener.warnings)
        text, algorithm = self.error(Series([MOVING[0], empty, MOVING[1]]), 1.5, TrackParticles=1)
        self.assertIn("Time step 2 of 3 (t = 1) has no mass, and TrackParticles follows particles through all steps; TrackParticles Off", text)
        algorithm.SetTrackParticles(0)  # as it advises
        algorithm.UpdateTimeStep(1.5)
        self.assertGreater(algorithm.GetDensity().GetNumberOfPoints(), 0)

    def test_one_step_and_none(self):
        for times in ([5], []):
            for chain in (0, 1):
                algorithm = interpolator(Series([MOVING[0]], times=times), TrackParticles=chain)
                listener = Listener(algorithm)
                for time in (5, 3, 8):
                    algorithm.UpdateTimeStep(time)
                    if not chain:
                        self.assertTrue((values(algorithm) == MOVING[0].ravel()).all())
                    self.assertTrue((particles(algorithm, "Velocity") == 0).all())
                self.assertEqual(listener.errors, [])
                self.assertEqual(len(listener.warnings), 1, listener.warnings)
                self.assertIn("no mass moves; the density comes out as it is", listener.warnings[0])

    def test_no_times_after_a_series(self):
        """Nothing of the series is left, whether it could be followed to its end or not."""
        for steps, times in ((MOVING, None), ([MOVING[0], np.zeros((N, N))], None), (MOVING[:1], [np.nan])):
            algorithm = interpolator(Series(steps, times=times), TrackParticles=1)
            algorithm.UpdateTimeStep(0.5)
            single = Series([blob(30, 10)], times=[])
            algorithm.SetInputConnection(single.GetOutputPort())
            algorithm.UpdateTimeStep(0.5)
            fresh = interpolator(single, TrackParticles=1)
            fresh.UpdateTimeStep(0.5)
            self.assertEqual(digest(algorithm.GetParticles()), digest(fresh.GetParticles()))

    def test_repeated_and_unordered_times(self):
        algorithm = interpolator(Series([MOVING[2], MOVING[0], MOVING[0], MOVING[1]], times=[2, 0, 0, 1]), ResampleFactor=2)
        algorithm.UpdateInformation()
        steps = algorithm.GetOutputInformation(0).Get(Pipeline.TIME_STEPS())
        np.testing.assert_allclose(steps, [0, 0.5, 1, 1.5, 2])
        plain = interpolator(Series(MOVING))
        for time in (0, 0.5, 1.5, 2):
            algorithm.UpdateTimeStep(time)
            plain.UpdateTimeStep(time)
            self.assertEqual(digest(algorithm.GetDensity()), digest(plain.GetDensity()))

    def test_times_at_the_ends_of_numbers(self):
        """Times that are not finite count as none; between the largest ones parts are what they are."""
        algorithm = interpolator(Series(MOVING, times=[-1.5e308, 1.5e308, np.inf]), ResampleFactor=2)
        plain = interpolator(Series(MOVING[:2], times=[0, 1]))
        plain.UpdateTimeStep(0.5)
        algorithm.UpdateTimeStep(0)
        np.testing.assert_allclose(values(algorithm), values(plain), atol=1e-12)
        self.assertEqual(list(algorithm.GetOutputInformation(0).Get(Pipeline.TIME_STEPS())), [-1.5e308, 0, 1.5e308])
        text, algorithm = self.error(Series(MOVING[:2], times=[0, 1e-307]), 0)
        self.assertIn("Time step 1 of 2 (t = 0) and the next one are 1e-307 apart in time, so that velocities pass "
                      "the largest double; the steps must be further apart", text)
        algorithm = interpolator(Series(MOVING[:2], times=[0, 1e-300]))
        algorithm.UpdateTimeStep(5e-301)
        self.assertTrue(np.isfinite(particles(algorithm, "Velocity")).all())

    def test_grids_that_change(self):
        fine = blob(60, 60, 10, 96)
        series = Series([MOVING[0], fine], spacing=1.0)
        image = series.image

        def half(step):
            made = image(step)
            if step == 1:
                made.SetSpacing(0.5, 0.5, 1)
            return made
        series.image = half
        algorithm = interpolator(series)
        algorithm.UpdateTimeStep(0.5)
        self.assertEqual(algorithm.GetDensity().GetDimensions(), (97, 97, 1))
        mass = 0.5 * (MOVING[0].sum() + fine.sum() / 4)
        self.assertAlmostEqual(values(algorithm).sum() / 4 / mass, 1, 9)
        algorithm.UpdateTimeStep(0)
        self.assertEqual(algorithm.GetDensity().GetDimensions(), (49, 49, 1))
        self.assertTrue((values(algorithm) == MOVING[0].ravel()).all())
        algorithm.UpdateTimeStep(1)
        self.assertTrue((values(algorithm) == fine.ravel()).all())

    def test_coarser_cells_leave_no_stripes(self):
        """Each step's particles have the size of its own cells, whichever of both is the finer one."""
        fine, coarse = blob(90, 90, 15, 144), blob(30, 30)
        for steps, spacings in (([fine, coarse], (1 / 3, 1)), ([coarse, fine], (1, 1 / 3))):
            series = Series(steps)
            image = series.image

            def spaced(step, image=image, spacings=spacings):
                made = image(step)
                made.SetSpacing(spacings[step], spacings[step], 1)
                return made
            series.image = spaced
            algorithm = interpolator(series)
            algorithm.UpdateTimeStep(0.5)
            self.assertLess(np.abs(values(algorithm) - fine.ravel()).max(), 0.1)

    def test_boxes_that_differ(self):
        algorithm = interpolator(Series([MOVING[0], MOVING[0]], origins=[0.0, 10.0]))
        algorithm.UpdateTimeStep(0.5)
        self.assertEqual(algorithm.GetDensity().GetBounds()[:2], (0, N + 10))
        place = np.average(positions(algorithm.GetParticles()), axis=0, weights=particles(algorithm, "Mass"))
        np.testing.assert_allclose(place[:2], centroid(MOVING[0]) + [5, 0], atol=0.05)

    def test_directions_that_differ(self):
        series = Series(MOVING)
        image = series.image

        def turned(step):
            made = image(step)
            if step == 1:
                made.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
            return made
        series.image = turned
        text, _ = self.error(series, 0.5)
        self.assertIn("Time step 2 of 3 (t = 1)", text)
        self.assertIn("direction", text)

    def test_properties_out_of_range(self):
        for name, value, rule in (("ResampleFactor", -1, "ResampleFactor is -1; it must be from 0 (any time) to 1000000"),
                                  ("ParticlesPerCell", 0, "ParticlesPerCell is 0; it must be at least 1"),
                                  ("Radius", 0, "Radius is 0"), ("Kernel", 9, "Kernel is 9"),
                                  ("Method", 2, "Method is 2; it must be 0 (RectifiedFlow)")):
            text, _ = self.error(Series(MOVING), 0.5, **{name: value})
            self.assertIn(rule, text)

    def test_abort(self):
        algorithm = interpolator(Series(MOVING))
        algorithm.AddObserver("ProgressEvent", lambda caller, event: caller.SetAbortExecute(1))
        algorithm.UpdateTimeStep(0.5)
        self.assertEqual(algorithm.GetDensity().GetNumberOfPoints(), 0)
        algorithm.RemoveAllObservers()
        algorithm.SetAbortExecute(0)
        algorithm.Modified()
        algorithm.UpdateTimeStep(0.5)
        self.assertGreater(algorithm.GetDensity().GetNumberOfPoints(), 0)

    def test_progress_moves(self):
        for properties in ({}, {"TrackParticles": 1}):
            algorithm = interpolator(Series(MOVING), **properties)
            seen = []
            algorithm.AddObserver("ProgressEvent", lambda caller, event: seen.append(caller.GetProgress()))
            algorithm.UpdateTimeStep(1.5)
            self.assertGreater(len(seen), 3)
            self.assertEqual(seen, sorted(seen))


if __name__ == "__main__":
    main()
