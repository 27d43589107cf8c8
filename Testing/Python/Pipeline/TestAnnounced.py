# SPDX-License-Identifier: BSD-3-Clause
"""What pipelines announce and what they hold: extents that follow from points that move with time,
images that are less than announced, and blocks of other types."""
import unittest

import numpy as np
import rectifiedtransport as rt
from rt_filters import FILTERS
from rt_testing import (Listener, chain, closed_surface, density_image, main, points_in,
                        positions, quick_algorithm, size_of)
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkImagingCore import vtkImageShiftScale


class Growing(VTKPythonAlgorithmBase):
    """A sphere whose height is the time."""

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")
        self.times = []

    def RequestInformation(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        times = [1.0, 2.0, 3.0, 5.0]
        info.Set(Pipeline.TIME_STEPS(), times, 4)
        info.Set(Pipeline.TIME_RANGE(), [1.0, 5.0], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        key = Pipeline.UPDATE_TIME_STEP()
        time = info.Get(key) if info.Has(key) else 1.0
        self.times.append(time)
        sphere = closed_surface()
        points = sphere.GetPoints()
        for i in range(points.GetNumberOfPoints()):
            x, y, z = points.GetPoint(i)
            points.SetPoint(i, x, y, z * time)
        vtkPolyData.GetData(outputs).ShallowCopy(sphere)
        return 1


class Part(VTKPythonAlgorithmBase):
    """An image that is half of what it announces."""

    def __init__(self, image):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.image = image

    def RequestInformation(self, request, inputs, outputs):
        extent = list(self.image.GetExtent())
        extent[1] = 2 * extent[1] + 1
        outputs.GetInformationObject(0).Set(Pipeline.WHOLE_EXTENT(), extent, 6)
        return 1

    def RequestData(self, request, inputs, outputs):
        vtkImageData.GetData(outputs).ShallowCopy(self.image)
        return 1


class Announced(unittest.TestCase):
    def timed(self, filter_):
        source = Growing()
        last = chain(source, filter_, vtkImageShiftScale(), vtkImageShiftScale())
        heights = []
        for time in (3.0, 1.0, 5.0, 2.0, 2.0, 1.0):
            last.UpdateTimeStep(time)
            self.assertEqual(source.times[-1], time)
            made = filter_.GetOutput()
            self.assertEqual(last.GetOutput().GetExtent(), made.GetExtent(), time)
            self.assertEqual(last.GetOutput().GetBounds(), made.GetBounds(), time)
            heights.append(made.GetDimensions()[0])
        runs = len(source.times)
        last.UpdateTimeStep(1.0)
        self.assertEqual(len(source.times), runs)
        return heights

    def test_solid_of_a_growing_surface(self):
        solid = rt.vtkSolidDensity()
        solid.SetResolution(30)
        widths = self.timed(solid)
        self.assertEqual(widths[1], 30)
        self.assertLess(widths[2], widths[0])

    def test_splat_of_growing_points(self):
        splat = rt.vtkMassSplatter()
        splat.SetDimensions(6, 7, 8)
        self.timed(splat)

    def expect(self, filter_, text):
        reported = Listener(filter_)
        filter_.Update()
        self.assertTrue(reported.errors and text in reported.errors[0], reported.errors)
        self.assertEqual(size_of(filter_.GetOutputDataObject(0)), 0)

    def test_less_than_announced(self):
        part = Part(density_image((4, 3)))
        text = " is an image of the extent 0 4 0 3 0 0 out of 0 9 0 3 0 0; it must be whole"
        for filter_ in FILTERS:
            for port, kind in enumerate(filter_.ports.values()):
                if kind in ("density", "densities", "image"):
                    with self.subTest(filter=filter_.name, port=port):
                        algorithm = quick_algorithm(filter_)
                        algorithm.SetInputConnection(port, part.GetOutputPort())
                        self.expect(algorithm, "Input port %d" % port + text)

    def test_domain_of_blocks_that_are_no_images(self):
        """The box that holds all of them."""
        blocks = vtkMultiBlockDataSet()
        surface = closed_surface()
        moved = closed_surface()
        moved.DeepCopy(surface)
        points = positions(surface) + [0, 3, 0]
        moved.GetPoints().SetData(numpy_to_vtk(points, deep=1))
        blocks.SetBlock(0, surface)
        blocks.SetBlock(1, moved)
        cells = rt.vtkEqualMassCells()
        cells.SetInputData(points_in(surface, 9))
        cells.SetDomainData(blocks)
        cells.SetResolution(40)
        reported = Listener(cells)
        cells.Update()
        self.assertEqual(reported.errors + reported.warnings, [])
        low, high = np.array(surface.GetBounds()).reshape(3, 2).T
        np.testing.assert_allclose(
            cells.GetLabels().GetBounds(), np.c_[low, high + [0, 3, 0]].ravel(), atol=1e-12)
        self.assertEqual(cells.GetLabels().GetDimensions()[1], 41)


if __name__ == "__main__":
    main()
