# SPDX-License-Identifier: BSD-3-Clause
"""Damaged cells: ids of points that are not there, offsets, types and faces, in every filter."""
import unittest

import numpy as np
from rt_filters import of_kind
from rt_testing import Listener, density_image, main, points_in, quick_algorithm, size_of
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkConstants import VTK_ID_TYPE
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (VTK_HEXAHEDRON, VTK_POLYHEDRON, VTK_QUAD, VTK_TETRA,
                                           vtkCellArray, vtkMultiBlockDataSet, vtkPolyData,
                                           vtkRectilinearGrid, vtkStructuredGrid,
                                           vtkUnstructuredGrid)

import rectifiedtransport as rt


def integers(values):
    return numpy_to_vtk(np.array(values, np.int64), deep=1, array_type=VTK_ID_TYPE)


def cells_of(ids, offsets):
    cells = vtkCellArray()
    cells.SetData(integers(offsets), integers(ids))
    return cells


def add_values(data, count=None):
    count = data.GetNumberOfCells() if count is None else count
    values = numpy_to_vtk(np.ones(count), deep=1)
    values.SetName("Density")
    data.GetCellData().SetScalars(values)
    return data


CORNERS = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]
CUBE = [0, 1, 3, 2, 4, 5, 7, 6]


def corner_points():
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.array(CORNERS, float), deep=1))
    return points


def grid_of(ids, offsets, types):
    grid = vtkUnstructuredGrid()
    grid.SetPoints(corner_points())
    array = numpy_to_vtk(np.array(types, np.uint8), deep=1)
    grid.SetCells(array, cells_of(ids, offsets))
    return add_values(grid, len(offsets) - 1)


def surface_of(ids, offsets, kind="Polys"):
    surface = vtkPolyData()
    surface.SetPoints(corner_points())
    getattr(surface, "Set" + kind)(cells_of(ids, offsets))
    return add_values(surface, len(offsets) - 1)


# What is wrong, and what the error says.
BROKEN = [
    (lambda: grid_of(CUBE[:7] + [8] + [0, 1, 2, 4], [0, 8, 12], [VTK_HEXAHEDRON, VTK_TETRA]),
     "Cell 0 of the input has the point 8; there are points 0 to 7"),
    (lambda: grid_of(CUBE + [0, 1, 2, -1], [0, 8, 12], [VTK_HEXAHEDRON, VTK_TETRA]),
     "Cell 1 of the input has the point -1; there are points 0 to 7"),
    (lambda: grid_of(CUBE + [0, 1, 2, 4], [0, 8, 99], [VTK_HEXAHEDRON, VTK_TETRA]),
     "Cell 1 of the input has its points from place 8 to 99 of 12"),
    (lambda: grid_of(CUBE + [0, 1, 2, 4], [0, 8, 4], [VTK_HEXAHEDRON, VTK_TETRA]),
     "Cell 1 of the input has its points from place 8 to 4 of 12"),
    (lambda: grid_of(CUBE + [0, 1, 2, 4], [0, 4, 12], [VTK_HEXAHEDRON, VTK_TETRA]),
     "Cell 0 of the input is of type 12 and has 4 points; it must have 8"),
    (lambda: grid_of(CUBE, [0, 8], [240]),
     "Cell 0 of the input is of type 240, which VTK does not have"),
    (lambda: grid_of([0, 1, 3, 2] + [0, 1, 5], [0, 4, 7], [VTK_QUAD, VTK_QUAD]),
     "Cell 1 of the input is of type 9 and has 3 points; it must have 4"),
    (lambda: surface_of([0, 1, 3, 0, 3, 2147483648], [0, 3, 6]),
     "Cell 1 of the input has the point 2147483648; there are points 0 to 7"),
    (lambda: surface_of([0, 1, 3, 11], [0, 4], "Strips"),
     "Cell 0 of the input has the point 11; there are points 0 to 7"),
    (lambda: surface_of([0, 1, 3, 2, 9], [0, 5], "Lines"),
     "Cell 0 of the input has the point 9; there are points 0 to 7"),
]


def polyhedron(faces, place=0):
    grid = vtkUnstructuredGrid()
    grid.SetPoints(corner_points())
    types = vtkUnsignedCharArray()
    types.InsertNextValue(VTK_POLYHEDRON)
    places = vtkIdTypeArray()
    places.InsertNextValue(place)
    grid.SetCells(types, cells_of(list(range(8)), [0, 8]), places, integers(faces))
    return add_values(grid, 1)


class BrokenCells(unittest.TestCase):
    def expect(self, algorithm, part):
        listener = Listener(algorithm)
        algorithm.Update()
        own = [error for error in listener.errors if "vtkExecutive" not in error]  # VTK adds one
        self.assertEqual(len(own), 1, own)
        self.assertIn(part, own[0])
        for port in range(algorithm.GetNumberOfOutputPorts()):
            self.assertEqual(size_of(algorithm.GetOutputDataObject(port)), 0)

    def test_densities(self):
        for make, part in BROKEN:
            for filter_, port in of_kind("density"):
                with self.subTest(part, filter=filter_.name):
                    algorithm = quick_algorithm(filter_)
                    algorithm.SetInputDataObject(port, make())
                    self.expect(algorithm, part)
            blocks = vtkMultiBlockDataSet()
            blocks.SetBlock(0, grid_of(CUBE, [0, 8], [VTK_HEXAHEDRON]))
            blocks.SetBlock(1, make())
            sampler = rt.vtkTransportSampler()
            sampler.SetInputDataObject(blocks)
            with self.subTest(part, block=2):
                self.expect(sampler, part.replace("the input", "the block 2 of the input"))

    @unittest.skipUnless(hasattr(vtkUnstructuredGrid, "GetFaces") and
                         not hasattr(vtkUnstructuredGrid, "GetPolyhedronFaces"),
                         "faces are cell arrays")
    def test_faces(self):
        faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
        stream = [6] + [i for face in faces for i in [4] + face]
        for place in (-1, 31):
            sampler = rt.vtkTransportSampler()
            sampler.SetInputDataObject(polyhedron(stream, place))
            self.expect(sampler, "Cell 0 of the input is a polyhedron whose faces are not there")
        for change, part in (({7: 50}, "Cell 0 of the input has the point 50"),
                             ({0: 9}, "a polyhedron whose faces are not there"),
                             ({1: 1000}, "a polyhedron whose faces are not there")):
            broken = list(stream)
            for place, value in change.items():
                broken[place] = value
            sampler = rt.vtkTransportSampler()
            sampler.SetInputDataObject(polyhedron(broken))
            if change == {1: 1000}:
                part = "Cell 0 of the input"  # the next numbers may be points that are not there
            self.expect(sampler, part)

    def test_lattices(self):
        lattice = vtkRectilinearGrid()
        lattice.SetDimensions(4, 3, 2)
        for axis, count in zip("XYZ", (4, 2, 2)):
            getattr(lattice, "Set%sCoordinates" % axis)(numpy_to_vtk(np.arange(count) * 1.0, deep=1))
        structured = vtkStructuredGrid()
        structured.SetDimensions(3, 2, 2)
        structured.SetPoints(corner_points())
        for data, part in ((lattice, "2 coordinates along axis 1, but 3 points"),
                           (structured, "8 points, but its extent is of 12")):
            sampler = rt.vtkTransportSampler()
            sampler.SetInputDataObject(add_values(data, 6))
            self.expect(sampler, part)

    def test_ghosts_of_another_length(self):
        """Lattices read them for the types of their cells."""
        for owner, kind in (("CellData", "cells"), ("PointData", "points")):
            structured = vtkStructuredGrid()
            structured.SetDimensions(2, 2, 2)
            structured.SetPoints(corner_points())
            add_values(structured)
            flags = vtkUnsignedCharArray()
            flags.SetName("vtkGhostType")
            getattr(structured, "Get" + owner)().AddArray(flags)
            for filter_, port in of_kind("density", "mesh"):
                with self.subTest(owner, filter=filter_.name):
                    algorithm = quick_algorithm(filter_)
                    algorithm.SetInputDataObject(port, structured)
                    self.expect(algorithm, "The ghost array 'vtkGhostType' of the %s of the " % kind)

    def test_surfaces(self):
        for filter_, _ in of_kind("disk", "solid"):
            for make, part in (
                    (lambda: surface_of([0, 1, 3, 0, 3, 99], [0, 3, 6]), "has the point 99"),
                    (lambda: surface_of([0, 1, 3, 0, 3, 2], [0, 3, 77]), "has its points from place 3 to 77")):
                with self.subTest(filter=filter_.name, part=part):
                    algorithm = quick_algorithm(filter_)
                    algorithm.SetInputDataObject(make())
                    self.expect(algorithm, "Cell 1 of the input surface " + part)

    def test_point_sets_whose_cells_pass(self):
        for filter_, port in of_kind("mesh"):
            with self.subTest(filter=filter_.name):
                points = points_in(density_image((4, 3)))
                points.SetVerts(cells_of([0, 1, 2, 400], [0, 2, 4]))
                algorithm = quick_algorithm(filter_)
                algorithm.SetInputDataObject(port, points)
                name = "Overlay" if list(filter_.ports)[port] == "Overlay" else "input"
                self.expect(algorithm, "Cell 1 of the %s has the point 400; there are points 0 to 49" % name)

    def test_domain(self):
        cells = rt.vtkEqualMassCells()
        cells.SetInputDataObject(0, points_in(density_image((1, 1))))
        cells.SetInputDataObject(1, surface_of([0, 1, 3, 0, 3, 99], [0, 3, 6]))
        self.expect(cells, "Cell 1 of the input has the point 99")

    def test_points_alone(self):
        """Filters that read and pass no cells do not mind."""
        image = density_image((4, 3))
        points = points_in(image)
        points.SetVerts(cells_of([0, 1, 2, 400], [0, 2, 4]))
        for filter_, port in of_kind("points"):
            algorithm = quick_algorithm(filter_)
            algorithm.SetInputDataObject(port, points)
            listener = Listener(algorithm)
            algorithm.Update()
            self.assertEqual(listener.errors, [])
            self.assertGreater(size_of(algorithm.GetOutputDataObject(0)), 0)


main()
