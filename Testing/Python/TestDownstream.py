# SPDX-License-Identifier: BSD-3-Clause
"""Filters downstream of an image that failed, was aborted or is a later piece: they would read all
that was announced, so that nothing may be requested of them. A crash is a failure here."""
import functools
import unittest

import rectifiedtransport as rt
from rt_testing import Listener, chain, closed_surface, density_image, main, points_in
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkFlyingEdges2D, vtkFlyingEdges3D
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkImagingGeneral import vtkImageGradient


def splatter():
    splat = rt.vtkMassSplatter()
    splat.SetInputData(points_in(density_image((4, 3, 2)), 20000))
    splat.SetDimensions(20, 20, 20)
    return splat, splat.SetRadius, 0, 1


def solid():
    made = rt.vtkSolidDensity()
    made.SetInputData(closed_surface())
    made.SetResolution(20)
    return made, made.SetSupersampling, 99, 2


def cells():
    divided = rt.vtkEqualMassCells()
    divided.SetInputData(points_in(density_image((4, 3, 2))))
    divided.SetResolution(20)
    return divided, divided.SetNormExponent, 0, 2


def transport_map():
    made = rt.vtkTransportMap()
    made.SetInputData(density_image((12, 9, 8), cells=False))
    return made, made.SetNumberOfSteps, 0, 4


def morph():
    blend = rt.vtkTransportInterpolator()
    blend.SetInputData(density_image((12, 9, 8), cells=False))
    blend.SetTargetData(density_image((12, 9, 8), cells=False, seed=1))
    return blend, blend.SetParameter, 2, 0.5


def barycenter():
    blend = rt.vtkTransportBarycenter()
    for seed in range(2):
        source = rt.vtkTransportMap()  # any producer of an image
        source.SetInputData(density_image((9, 8, 7), cells=False, seed=seed))
        blend.AddInputConnection(source.GetOutputPort())
    blend.SetInputArrayToProcess(0, 0, 0, 0, "Density")
    return blend, blend.SetParticlesPerCell, 0, 1


PRODUCERS = (splatter, solid, cells, transport_map, morph, barycenter)
READERS = (vtkImageShiftScale, vtkImageGradient, vtkContourFilter, vtkFlyingEdges2D,
           vtkFlyingEdges3D)


def each_producer(test):
    """Runs a test with every producer."""
    @functools.wraps(test)
    def run(self):
        for make in PRODUCERS:
            with self.subTest(producer=make.__name__):
                test(self, make, *make())
    return run


class Downstream(unittest.TestCase):
    def readers_of(self, producer):
        """Each kind of reader, and each downstream of an image filter."""
        return [chain(producer, *between, kind()) for kind in READERS
                for between in ((), (vtkImageShiftScale(),))]

    def check(self, readers, empty):
        """After an update."""
        for reader in readers:
            reader.Update()
            points = reader.GetOutput().GetNumberOfPoints()
            self.assertEqual(points == 0, empty, reader.GetClassName())

    @each_producer
    def test_failures(self, make, producer, turn, wrong, right):
        turn(wrong)
        reported = Listener(producer)
        readers = self.readers_of(producer)
        for _ in range(2):
            for reader in readers:
                reader.Update()
                self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)
        self.assertEqual(len(reported.errors), 2, reported.errors)  # one, and the executive's
        self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)
        turn(right)
        if make is cells:
            return  # its labels are on cells
        images = [r for r in readers if r.IsA("vtkImageAlgorithm")]
        self.check(images, False)
        turn(wrong)
        for reader in images:
            reader.Update()
        self.check(images, True)
        turn(right)
        producer.Update()
        self.assertGreater(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)

    @each_producer
    def test_aborts(self, make, producer, turn, wrong, right):
        turn(right)
        reported = Listener(producer)
        readers = self.readers_of(producer)
        for reader in readers:
            tag = producer.AddObserver("ProgressEvent", lambda *_: producer.SetAbortExecute(1))
            producer.Modified()
            reader.Update()
            self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)
            self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)
            producer.RemoveObserver(tag)
            producer.SetAbortExecute(0)
        self.assertEqual(reported.errors, [])
        producer.Modified()
        if make is not cells:
            self.check(readers[:1], False)

    @each_producer
    def test_later_pieces(self, make, producer, turn, wrong, right):
        turn(right)
        for reader in self.readers_of(producer):
            reader.UpdatePiece(1, 2, 0)
            self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)
            self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)

    @each_producer
    def test_deleted_readers(self, make, producer, turn, wrong, right):
        """VTK does not forget them."""
        turn(wrong)
        reader = self.readers_of(producer)[0]
        reader.Update()
        reader.Update()
        self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)
        turn(right)
        if make is not cells:
            self.check([reader], False)
        producer.AddObserver("ProgressEvent", lambda *_: producer.SetAbortExecute(1))
        producer.Modified()
        reader.Update()
        self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)

    def test_only_the_first_piece_of_a_solid(self):
        made = solid()[0]
        counts = []
        for piece in range(3):
            made.UpdatePiece(piece, 3, 0)
            counts.append(made.GetOutput().GetNumberOfPoints() > 0)
        self.assertEqual(counts, [True, False, False])


if __name__ == "__main__":
    main()
