# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and grids of flow and finite elements, adaptive ones among them."""
import time

import numpy as np
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import (VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, VTK_BIQUADRATIC_QUADRATIC_WEDGE,
                                           VTK_HEXAHEDRON, VTK_POLYHEDRON, VTK_PYRAMID, VTK_QUAD,
                                           VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_LINEAR_WEDGE,
                                           VTK_QUADRATIC_TETRA, VTK_QUADRATIC_WEDGE, VTK_TETRA, VTK_TRIANGLE,
                                           VTK_TRIQUADRATIC_HEXAHEDRON, VTK_VOXEL, VTK_WEDGE, vtkAMRBox,
                                           vtkGenericCell, vtkOverlappingAMR, vtkRectilinearGrid, vtkUniformGrid,
                                           vtkUnstructuredGrid)

from .case import (BOX_FACES, blocks, box_points, case, expect_mass, mesh, named, point_list, polygons,
                   simple)

UNIT = box_points((0, 0, 0), (1, 1, 1))
HEXAHEDRON = [0, 1, 3, 2, 4, 5, 7, 6]  # of corners of which x is fastest


def tetrahedra_of_a_cube():
    """Six about its diagonal."""
    paths = [(1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)]
    return [[0, a, b, 7] for a, b in paths]


@case(17)
def blocks_without_the_array(check):
    """Element blocks of a file, one of which does not have the variable.

    Source: gdtk issue 49, visit issue 5720.
    Right: the mass of the others, and a warning.
    """
    def block(low, value):
        places = box_points((low, 0, 0), (low + 1, 1, 1))
        return mesh(places, [(VTK_HEXAHEDRON, HEXAHEDRON)], [value])
    without = block(4, 0)
    without.GetCellData().RemoveArray("v")
    for order in ((block(0, 2), block(2, 5), without), (without, block(0, 2), block(2, 5))):
        result = expect_mass(check, blocks(*order), 7, 1e-6, DensityResolution=40)
        check.assertEqual(len(result.warnings), 1)


@case(19)
def hyper_tree_grid(check):
    """An adaptive grid of trees.

    Source: inducer/pyvisfile pull request 39.
    Right: what Integrate Variables finds in the same cells as a mesh.
    """
    grid = simple.HyperTreeGridRandom()
    integral = simple.IntegrateVariables(simple.HyperTreeGridToUnstructuredGrid(grid))
    integral.UpdatePipeline()
    mass = integral.GetClientSideObject().GetOutput().GetCellData().GetArray("Depth").GetTuple1(0)
    expect_mass(check, grid, mass, 1e-6, array="Depth", DensityResolution=64)


@case(46)
def wedges_turned_inside_out(check):
    """Wedges whose first triangle turns inwards: their volume is negative by VTK's order of points.

    Source: ansys/pydpf-core issue 1969, pyvista/pyvista issue 3708.
    Right: the volume has no sign: 2 x .5 + 3 x .5.
    """
    cells = [(VTK_WEDGE, [0, 1, 3, 4, 5, 7]), (VTK_WEDGE, [0, 2, 3, 4, 6, 7])]
    expect_mass(check, mesh(UNIT, cells, [2, 3]), 2.5, 1e-3)


@case(47)
def half_of_the_tetrahedra_inverted(check):
    """Tetrahedra of a subdivision, every other one with its points in the wrong order.

    Source: pyvista/pyvista issue 6254 (the volumes added up to nearly nothing).
    Right: the cube's mass, 1 + 2 + ... + 6 sixths.
    """
    cells = [(VTK_TETRA, ids if i % 2 else [ids[1], ids[0]] + ids[2:])
             for i, ids in enumerate(tetrahedra_of_a_cube())]
    expect_mass(check, mesh(UNIT, cells, range(1, 7)), 21 / 6, 1e-3)


def polyhedra(places, cells, values):
    """A mesh of polyhedra, each a list of faces."""
    grid = vtkUnstructuredGrid()
    grid.SetPoints(point_list(places))
    for faces in cells:
        stream = vtkIdList()
        stream.InsertNextId(len(faces))
        for face in faces:
            stream.InsertNextId(len(face))
            for point in face:
                stream.InsertNextId(int(point))
        grid.InsertNextCell(VTK_POLYHEDRON, stream)
    grid.GetCellData().SetScalars(named(np.asarray(values, float)))
    return grid


@case(48)
def polyhedral_cells(check):
    """Cells that are lists of faces: a prism with six sides, and a cube beside it.

    Source: amanzi/amanzi issue 319 (viewers crash), tkeskita/BVtkNodes issue 21 (only corners shown).
    Right: 2 x (3 sqrt 3 / 2) + 5 x 1.
    """
    angles = np.arange(6) * np.pi / 3
    ring = np.c_[np.cos(angles), np.sin(angles)]
    places = np.concatenate([np.c_[ring, np.zeros(6)], np.c_[ring, np.ones(6)], UNIT + [2, 0, 0]])
    prism = [list(range(6))[::-1], list(range(6, 12))] + [
        [i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i] for i in range(6)]
    grid = polyhedra(places, [prism, BOX_FACES + 12], [2, 5])
    expect_mass(check, grid, 2 * 1.5 * np.sqrt(3) + 5, 1e-3)


@case(49)
def wedge_of_five_degrees(check):
    """The one-cell-thick wedge by which a flow with an axis is computed: prisms at the axis, then
    hexahedra.

    Source: code-mphi/ECOGEN issue 44 (OpenFOAM's wedge patches), Kitware/vtk-examples pull request 9.
    Right: with the density 1 length x R^2 x tan(2.5 degrees); with the density by the distance from
    the axis each ring has its own share.
    """
    slope = np.tan(np.radians(2.5))
    count, length = 8, 2.0
    places = [[x, 0, 0] for x in (0, length)]
    for k in range(1, count + 1):
        places += [[x, k / count, side * slope * k / count] for x in (0, length) for side in (-1, 1)]
    cells = [(VTK_WEDGE, [0, 2, 3, 1, 4, 5])]
    for k in range(1, count):
        a, b = 4 * k - 2, 4 * k + 2
        cells.append((VTK_HEXAHEDRON, [a, a + 2, b + 2, b, a + 1, a + 3, b + 3, b + 1]))
    expect_mass(check, mesh(places, cells, np.ones(count)), length * slope, 1e-3)
    edges = np.arange(count + 1) / count
    volumes = length * slope * np.diff(edges**2)
    expect_mass(check, mesh(places, cells, edges[1:]), (volumes * edges[1:]).sum(), 1e-3)


@case(50)
def flat_mesh_in_an_oblique_plane(check):
    """Triangles and quadrangles of a flat mesh that lies obliquely in space, with values on cells.

    Source: mfem/mfem pull request 2566 (flat surface meshes read with the wrong dimension).
    Right: the sum of value x area, far from the origin, too.
    """
    u = np.array([1, 2, 2]) / 3
    w = np.array([2, 1, -2]) / 3
    flat = np.array([[0, 0], [4, 0], [4, 3], [0, 3], [7, 0], [7, 3]], float)
    cells = [(VTK_QUAD, [0, 1, 2, 3]), (VTK_TRIANGLE, [1, 4, 2]), (VTK_TRIANGLE, [4, 5, 2])]
    for origin in ([0, 0, 0], [5e4, -3e4, 1e4]):
        places = flat[:, :1] * u + flat[:, 1:] * w + origin
        found = expect_mass(check, mesh(places, cells, [2, 1, 3]), 24 + 4.5 + 13.5, 1e-6).places()
        across = (found - origin) @ np.cross(u, w)
        check.assertLess(np.abs(across).max(), 1e-5)


@case(51)
def plane_flow_of_one_cell(check):
    """A flow in the plane of x and z, computed on hexahedra that are one cell thick in y.

    Source: fluiddyn/fluidfoam pull request 35 (a mesh in another plane than that of x and y).
    Right: value x volume.
    """
    x, z = np.meshgrid(np.linspace(0, 1, 9) ** 2, np.linspace(0, 0.5, 5))
    places = np.concatenate([np.c_[x.ravel(), np.full(x.size, y), z.ravel()] for y in (0, 0.01)])
    cells = []
    for row in range(4):
        for column in range(8):
            a = row * 9 + column
            low = [a, a + 1, a + 10, a + 9]
            cells.append((VTK_HEXAHEDRON, low + [i + 45 for i in low]))
    values = np.arange(1.0, 33)
    areas = np.outer(np.full(4, 0.125), np.diff(np.linspace(0, 1, 9) ** 2)).ravel()
    expect_mass(check, mesh(places, cells, values), (values * areas).sum() * 0.01, 1e-3)


def rectilinear(x, y, z, values):
    grid = vtkRectilinearGrid()
    grid.SetDimensions(len(x), len(y), len(z))
    for axis, places in zip("XYZ", (x, y, z)):
        getattr(grid, f"Set{axis}Coordinates")(named(np.asarray(places, float), axis))
    grid.GetCellData().SetScalars(named(values.ravel()))
    return grid


@case(52)
def latitudes_from_north_to_south(check):
    """A grid of degrees whose latitudes fall, as climate files have them.

    Source: OSGeo/gdal issue 11041, serapeum-org/pyramids issue 1148.
    Right: the mass is positive, and the first row is in the north.
    """
    values = np.zeros((1, 6, 5))
    values[0, 0] = [1, 2, 3, 4, 5]
    grid = rectilinear(np.linspace(-10, 10, 6), np.linspace(60, 0, 7), [0], values)
    found = expect_mass(check, grid, 15 * 4 * 10.0).places()
    check.assertGreaterEqual(found[:, 1].min(), 50 - 60 / 256)


@case(121)
def boxes_whose_diagonals_lie_along_an_axis(check):
    """A box of cubes, each of them six tetrahedra, two prisms along an axis or a polyhedron.

    Source: FEniCS/dolfinx and mfem/mfem threads on resampling box meshes (minutes for a small mesh).
    Right: value x volume up to rounding, and as quick as if no face lay along an axis.
    """
    count = 3
    places = np.stack(np.meshgrid(*3 * [np.arange(count + 1) / count], indexing="ij"), -1).reshape(-1, 3)
    steps = np.array([(count + 1) ** 2, count + 1, 1])  # of the numbers of points along the axes
    lows = np.array(list(np.ndindex(count, count, count))) @ steps
    corners = [sum(steps[axis] for axis in range(3) if corner >> axis & 1) for corner in range(8)]

    def cells(kind, parts):
        return [(kind, [low + corners[corner] for corner in part]) for low in lows for part in parts]
    prisms = [[[a ^ turn for a in side] + [a ^ turn ^ 1 << axis for a in side]
               for side in ([0, 1 << (axis + 1) % 3, 7 ^ 1 << axis], [0, 7 ^ 1 << axis, 1 << (axis + 2) % 3])]
              for axis in range(3) for turn in (0, 1 << (axis + 1) % 3)]
    meshes = [cells(VTK_TETRA, tetrahedra_of_a_cube())] + [cells(VTK_WEDGE, parts) for parts in prisms]
    values = np.arange(1.0, count**3 + 1)
    begin = time.process_time()
    for all_cells in meshes:
        expect_mass(check, mesh(places, all_cells, np.repeat(values, len(all_cells) // count**3)),
                    values.mean(), 1e-12, DensityResolution=70)
    faces = [[[low + corners[point] for point in face] for face in BOX_FACES] for low in lows]
    expect_mass(check, polyhedra(places, faces, values), values.mean(), 1e-12, DensityResolution=70)
    check.assertLess(time.process_time() - begin, 10)


@case(53)
def stretched_axis(check):
    """A grid that is fine at the wall and grows from cell to cell by a fifth.

    Source: openPMD/openPMD-standard issue 142, GenericMappingTools/gmt issue 3108 (the mean spacing
    was taken).
    Right: the sum of value x volume of each cell.
    """
    steps = 1e-3 * 1.2 ** np.arange(30)
    x = np.concatenate([[0], np.cumsum(steps)])
    values = np.random.default_rng(12).random((3, 4, 30)) + 0.1
    grid = rectilinear(x, np.arange(5) * 0.1, np.arange(4) * 0.2, values)
    expect_mass(check, grid, (values * steps).sum() * 0.02)


@case(54)
def refinement_by_four(check):
    """An adaptive grid whose fine level has cells of a quarter of the length.

    Source: yt-project/yt issues 2811 and 763 (uniform grids made of such data had holes).
    Right: coarse cells that fine ones cover do not count: 2 x (64 - 4) + 7 x 4.
    """
    plane, zero = 5, [0.0, 0.0, 0.0]  # of x and y
    amr = vtkOverlappingAMR()
    amr.Initialize(2, [1, 1])
    amr.SetOrigin(zero)
    amr.SetGridDescription(plane)
    for level, (step, low, count, value) in enumerate([(1.0, 0, 8, 2.0), (0.25, 12, 8, 7.0)]):
        origin, spacing = [low * step, low * step, 0], [step, step, step]
        grid = vtkUniformGrid()
        grid.SetOrigin(origin)
        grid.SetSpacing(spacing)
        grid.SetDimensions(count + 1, count + 1, 1)
        grid.GetCellData().SetScalars(named(np.full(count * count, value)))
        amr.SetSpacing(level, spacing)
        amr.SetAMRBox(level, 0, vtkAMRBox(origin, grid.GetDimensions(), spacing, zero, plane))
        amr.SetDataSet(level, 0, grid)
    amr.SetRefinementRatio(0, 4)
    expect_mass(check, amr, 2.0 * 60 + 7.0 * 4, DensityResolution=64)


@case(55)
def leaves_of_an_octree(check):
    """The leaves of an octree as voxels of five sizes.

    Source: pynbody/pynbody issue 336 (an eighth of the cells was missing), yt-project/yt issue 4818
    (the mass depended on how fine the tree was).
    Right: 8^-k x density k, over all leaves.
    """
    cells, places, values, expected = [], [], [], 0.0

    def add(low, size, depth):
        nonlocal expected
        for i in range(8):
            corner = low + size / 2 * np.array([i & 1, i >> 1 & 1, i >> 2])
            if i == 0 and depth < 5:
                add(corner, size / 2, depth + 1)
                continue
            cells.append((VTK_VOXEL, range(len(places), len(places) + 8)))
            places.extend(box_points(corner, corner + size / 2))
            values.append(4.0**depth)
            expected += 4.0**depth * (size / 2) ** 3
    add(np.zeros(3), 1.0, 1)
    expect_mass(check, mesh(places, cells, values), expected, 1e-9, DensityResolution=64)


@case(56)
def pyramids(check):
    """A cube as six pyramids that meet in a point off its middle, with a density each.

    Source: GEOS-DEV/GEOS issue 2253 (two programs gave other volumes for them).
    Right: base x height / 3 each.
    """
    top = np.array([0.4, 0.5, 0.7])
    places = np.concatenate([UNIT, [top]])
    heights = [top[2], 1 - top[2], top[1], 1 - top[1], top[0], 1 - top[0]]
    cells = [(VTK_PYRAMID, list(face) + [8]) for face in BOX_FACES]
    values = np.arange(1.0, 7)
    expect_mass(check, mesh(places, cells, values), (values * heights).sum() / 3, 1e-3)


@case(57)
def patches_beside_the_volume(check):
    """A reader gives the cells of the volume and the patches of its boundary as blocks, both with
    the array.

    Source: tkeskita/BVtkNodes issue 21 (OpenFOAM's internal mesh and boundary regions).
    Right: the volume's mass; faces have no volume.
    """
    volume = mesh(UNIT, [(VTK_HEXAHEDRON, HEXAHEDRON)], [3])
    patch = polygons(UNIT, BOX_FACES, np.full(6, 100.0))
    expect_mass(check, blocks(volume, patch), 3.0, 1e-9)
    expect_mass(check, blocks(blocks(patch), volume), 3.0, 1e-9)


@case(58)
def faces_of_the_boundary_in_the_mesh(check):
    """Tetrahedra and the triangles of their boundary in one mesh, as mesh generators write them.

    Source: meshpro/pygalmesh issues 172 and 212 (triangles among the tetrahedra), nschloe/meshio issue
    470 (the volume came out larger).
    Right: the tetrahedra's mass.
    """
    cells = [(VTK_TETRA, ids) for ids in tetrahedra_of_a_cube()]
    cells += [(VTK_TRIANGLE, [0, 1, 3]), (VTK_TRIANGLE, [0, 3, 2])]
    expect_mass(check, mesh(UNIT, cells, [1, 2, 3, 4, 5, 6, 1e6, 1e6]), 21 / 6, 1e-3)


@case(170)
def cells_of_27_nodes(check):
    """Hexahedra and wedges with nodes in their faces and their middle, as finite elements have them.

    Source: Exodus files with the element block HEX27, and threads on vtkTriQuadraticHexahedron.
    Right: value x volume; VTK itself divides these types to a half, or not at all.
    """
    turned = np.array([[2.0, 0.5, 0.1], [-0.3, 1.5, 0.2], [0.4, -0.2, 1.8]])
    for kind, volume in ((VTK_TRIQUADRATIC_HEXAHEDRON, 1), (VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 1),
                         (VTK_QUADRATIC_HEXAHEDRON, 1), (VTK_BIQUADRATIC_QUADRATIC_WEDGE, 0.5),
                         (VTK_QUADRATIC_LINEAR_WEDGE, 0.5), (VTK_QUADRATIC_WEDGE, 0.5), (VTK_QUADRATIC_TETRA, 1 / 6)):
        cell = vtkGenericCell.InstantiateCell(kind)
        count = cell.GetNumberOfPoints()
        nodes = np.reshape([cell.GetParametricCoords()[i] for i in range(3 * count)], (count, 3)) @ turned
        places = np.concatenate([nodes, nodes + [9, 0, 0], UNIT + [5, 5, 0]])
        cells = [(kind, range(count)), (kind, range(count, 2 * count)),
                 (VTK_HEXAHEDRON, np.array(HEXAHEDRON) + 2 * count)]
        mass = (3 + 4) * volume * np.linalg.det(turned) + 5
        expect_mass(check, mesh(places, cells, [3, 4, 5]), mass, 1e-6, DensityResolution=48)
