# SPDX-License-Identifier: BSD-3-Clause
"""Filters downstream of an image that failed, was aborted or is a later piece: they would read all
that was announced, so that nothing may be requested of them. A crash is a failure here."""
import functools
import unittest

from rt_filters import FILTERS, by_label
from rt_testing import Listener, chain, main, quick_algorithm, set_property
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkFlyingEdges2D, vtkFlyingEdges3D
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkImagingGeneral import vtkImageGradient


def make(filter_):
    """An image filter with work for several steps of its progress."""
    properties = {name: {"Resolution": 20, "Dimensions": (20, 20, 20)}.get(name, value)
                  for name, value in filter_.quick.items()}
    return quick_algorithm(filter_, (12, 9, 8), 20000 if filter_.port_of("points") == 0 else 50, False,
                           **properties)


def gives_image(filter_):
    information = make(filter_).GetOutputPortInformation(0)
    return information.Get(vtkDataObject.DATA_TYPE_NAME()) == "vtkImageData"


PRODUCERS = [filter_ for filter_ in FILTERS if gives_image(filter_)]
READERS = (vtkImageShiftScale, vtkImageGradient, vtkContourFilter, vtkFlyingEdges2D,
           vtkFlyingEdges3D)


def each_producer(test):
    """Runs a test with every producer, how its wrong and its right value are set, and whether readers
    find an array on its points."""
    @functools.wraps(test)
    def run(self):
        self.assertGreater(len(PRODUCERS), 5)
        for filter_ in PRODUCERS:
            name, wrong, right = filter_.refused
            usual = make(filter_)
            usual.Update()
            on_points = usual.GetOutputDataObject(0).GetPointData().GetNumberOfArrays() > 0
            with self.subTest(producer=filter_.name):
                producer = make(filter_)
                test(self, producer, functools.partial(set_property, producer, name, wrong),
                     functools.partial(set_property, producer, name, right), on_points)
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
    def test_failures(self, producer, turn_wrong, turn_right, on_points):
        turn_wrong()
        reported = Listener(producer)
        readers = self.readers_of(producer)
        for _ in range(2):
            for reader in readers:
                reader.Update()
                self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)
        self.assertEqual(len(reported.errors), 1, reported.errors)
        self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)
        turn_right()
        if not on_points:
            return
        images = [r for r in readers if r.IsA("vtkImageAlgorithm")]
        self.check(images, False)
        turn_wrong()
        for reader in images:
            reader.Update()
        self.check(images, True)
        turn_right()
        producer.Update()
        self.assertGreater(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)

    @each_producer
    def test_aborts(self, producer, turn_wrong, turn_right, on_points):
        turn_right()
        reported = Listener(producer)
        readers = self.readers_of(producer)
        for reader in readers:
            tag = producer.AddObserver("ProgressEvent", lambda *_: producer.SetAbortExecute(1))
            producer.Modified()
            reader.Update()
            self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)
            self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)
            producer.RemoveObserver(tag)
        self.assertEqual(reported.errors, [])
        self.assertEqual(len(reported.warnings), len(readers), reported.warnings)
        self.assertIn("The run was aborted", reported.warnings[0])
        (readers[0] if on_points else producer).Update()  # runs again by itself
        self.assertGreater(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)
        if on_points:
            self.check(readers[:1], False)

    @each_producer
    def test_later_pieces(self, producer, turn_wrong, turn_right, on_points):
        turn_right()
        for reader in self.readers_of(producer):
            reader.UpdatePiece(1, 2, 0)
            self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)
            self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)

    @each_producer
    def test_deleted_readers(self, producer, turn_wrong, turn_right, on_points):
        """VTK does not forget them."""
        turn_wrong()
        reader = self.readers_of(producer)[0]
        reader.Update()
        reader.Update()
        self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 0)
        turn_right()
        if on_points:
            self.check([reader], False)
        producer.AddObserver("ProgressEvent", lambda *_: producer.SetAbortExecute(1))
        producer.Modified()
        reader.Update()
        self.assertEqual(producer.GetOutputDataObject(0).GetNumberOfPoints(), 0)

    def test_only_the_first_piece_of_a_solid(self):
        made = make(by_label("Solid Density"))
        counts = []
        for piece in range(3):
            made.UpdatePiece(piece, 3, 0)
            counts.append(made.GetOutput().GetNumberOfPoints() > 0)
        self.assertEqual(counts, [True, False, False])


if __name__ == "__main__":
    main()
