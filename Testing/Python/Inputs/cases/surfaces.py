# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of scanners and of modelling programs."""
import os
import tempfile

import numpy as np
from vtkmodules.vtkCommonComputationalGeometry import (vtkParametricBoy, vtkParametricCrossCap,
                                                       vtkParametricEllipsoid, vtkParametricTorus)
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource

from .case import (BOX_FACES, Result, box_points, case, expect_error, image, named, point_list,
                   polygons, simple, source, triangles_of)

CUBE = box_points((0, 0, 0), (2, 2, 2))
CUBE_TRIANGLES = triangles_of(BOX_FACES)


def solid(data, **properties):
    return Result(simple.SolidDensity(source(data), **properties))


def expect_volume(check, data, volume, tolerance=0.01, **properties):
    result = solid(data, **properties)
    check.assertEqual(result.errors, [])
    found = result.values("Density").sum() * np.prod(result.data.GetSpacing())
    check.assertLess(abs(found / volume - 1), tolerance, f"volume {found}, right {volume}")


def joined(*surfaces):
    """Several lists of points and faces in one."""
    places, faces, first = [], [], 0
    for more, of in surfaces:
        places.append(np.asarray(more, float))
        faces += [[first + point for point in face] for face in of]
        first += len(more)
    return polygons(np.concatenate(places), faces)


@case(4)
def texture_coordinates_in_a_file(check):
    """A parameterized surface saved as PLY, whose writer takes texture coordinates of single precision
    alone.

    Source: marcomusy/vedo issue 1303.
    Right: the file, with as many points; the program goes on. (A crash is seen in a program apart.)
    """
    surface = simple.AreaPreservingParameterization(simple.Sphere(EndPhi=90))
    surface.UpdatePipeline()
    output = surface.GetClientSideObject().GetOutputDataObject(0)
    active = output.GetPointData().GetTCoords()
    check.assertIsNotNone(active)
    check.assertEqual(active.GetDataTypeAsString(), "float")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "surface.ply")
        simple.SaveData(path, surface)
        with open(path, "rb") as file:
            head = file.read(2000).split(b"end_header")[0].decode()
    check.assertIn(f"element vertex {output.GetNumberOfPoints()}", head)


@case(5)
def voxels_that_touch_along_an_edge(check):
    """The outer faces of two voxels that have one edge in common, and of random voxels.

    Source: autotwin/automesh issue 359, the atlas AICHA of mricron.
    Right: the volume of the voxels: inside is what an odd number of faces is in front of.
    """
    random = (np.random.default_rng(33).random((5, 5, 5)) < 0.5).astype(np.uint8)
    for voxels in (np.array([[[1, 0], [0, 1]]], np.uint8), random):
        kept = simple.Threshold(Input=source(image(voxels)), Scalars=["CELLS", "v"],
                                LowerThreshold=1, UpperThreshold=1)
        expect_volume(check, simple.ExtractSurface(Input=kept), voxels.sum(), 0.03,
                      Resolution=66, Supersampling=4)


@case(7)
def seams_of_rounding(check):
    """A torus and an ellipsoid whose seams close but for the rounding of sines.

    Source: pyvista/pyvista issue 1301 and pull request 1676.
    Right: 2 pi^2 R r^2 with R = 1 and r = .5, and 4/3 pi, less what facets lack.
    """
    for function, volume in ((vtkParametricTorus(), np.pi**2 / 2),
                             (vtkParametricEllipsoid(), np.pi * 4 / 3)):
        surface = vtkParametricFunctionSource()
        surface.SetParametricFunction(function)
        surface.Update()
        expect_volume(check, surface.GetOutput(), volume, 0.02)


@case(14)
def points_that_no_triangle_uses(check):
    """A sheet with a point far away that no triangle has.

    Source: boundary-first-flattening issue 77.
    Right: the sheet's area, on as many particles as asked for, and its parameterization.
    """
    data = polygons([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (9, 9, 9)], [[0, 1, 2], [0, 2, 3]])
    result = Result(simple.SampleSurface(source(data), NumberOfParticles=300))
    check.assertEqual(result.errors, [])
    check.assertEqual(result.data.GetNumberOfPoints(), 300)
    check.assertAlmostEqual(result.field("TotalMass"), 1, 9)
    check.assertEqual(Result(simple.AreaPreservingParameterization(source(data))).errors, [])


def area_of(surface):
    integral = simple.IntegrateVariables(surface)
    integral.UpdatePipeline()
    return integral.GetClientSideObject().GetOutput().GetCellData().GetArray("Area").GetTuple1(0)


def expect_samples(check, surface, area):
    result = Result(simple.SampleSurface(surface, NumberOfParticles=1000))
    check.assertEqual(result.errors, [])
    check.assertEqual(result.data.GetNumberOfPoints(), 1000)
    check.assertLess(abs(result.field("TotalMass") / area - 1), 1e-5)


@case(21)
def clipped_sphere(check):
    """A sphere, Clip through its centre, and Extract Surface: cells with coinciding points.

    Source: pyvista issue 238, vmtk pull request 509.
    Right: half of the area of the sphere's triangles.
    """
    sphere = simple.Sphere()
    half = simple.ExtractSurface(Input=simple.Clip(Input=sphere, ClipType="Plane"))
    expect_samples(check, half, area_of(sphere) / 2)


@case(23)
def oblique_slice(check):
    """A slice through points of the grid, with triangles that have no area.

    Source: unibas-gravis/scalismo issue 262, phoebe-project/phoebe2 issue 53.
    Right: the area that Integrate Variables finds.
    """
    cut = simple.Slice(Input=simple.Wavelet())
    cut.SliceType.Normal = [1, 1, 0.2]
    expect_samples(check, cut, area_of(cut))


@case(26)
def beams_and_plates(check):
    """Boxes along the axes, at the resolution that is put first.

    Source: msml issue 246, pyvista/pyvista issue 1743.
    Right: length x width x height.
    """
    for x, y, z in ((10, 1, 1), (1, 10, 1), (10, 3, 0.5), (7, 1, 1.3), (1, 1, 1)):
        expect_volume(check, simple.Box(XLength=x, YLength=y, ZLength=z), x * y * z)


@case(71)
def winding_turned_over(check):
    """A cube that was mirrored, so that its faces turn inwards.

    Source: clbarnes/ncollpyde issue 8 (its inside was then outside), flexcompute/tidy3d pull request
    1976.
    Right: 8, either way.
    """
    expect_volume(check, polygons(CUBE, CUBE_TRIANGLES), 8)
    expect_volume(check, polygons(CUBE * [1, -1, 1], CUBE_TRIANGLES), 8)
    mixed = [face[::-1] if i % 3 else face for i, face in enumerate(CUBE_TRIANGLES)]
    expect_volume(check, polygons(CUBE, mixed), 8)


@case(72)
def hollow_solid(check):
    """A cube with a cavity, whose inner faces turn to the one side or to the other.

    Source: mikedh/trimesh issues 2082 and 1789 (repaired normals gave 9 instead of 7).
    Right: 8 - 1 where they turn the other way than the outer ones; turned alike, the inner cube is a second
    body within the first, as for vtkMassProperties: 8, the union.
    """
    inner = box_points((0.5, 0.5, 0.5), (1.5, 1.5, 1.5))
    for faces, volume in ((CUBE_TRIANGLES[:, ::-1], 7), (CUBE_TRIANGLES, 8)):
        expect_volume(check, joined((CUBE, CUBE_TRIANGLES), (inner, faces)), volume, 0.02)


@case(73)
def triangles_without_common_points(check):
    """Triangles as STL files have them: each with three points of its own.

    Source: cnr-isti-vclab/meshlab issue 1420 (closed on one system, open on the other).
    Right: equal points are one: the volume is 8.
    """
    soup = CUBE[CUBE_TRIANGLES.ravel()]
    data = polygons(soup, np.arange(len(soup)).reshape(-1, 3))
    expect_volume(check, data, 8)
    data.SetPoints(point_list(soup.astype(np.float32)))
    expect_volume(check, data, 8)


@case(74)
def wall_between_two_bodies(check):
    """Two parts of a print, put together again: the wall between them is there twice.

    Source: cnr-isti-vclab/meshlab issue 1316, mikedh/trimesh issue 1789.
    Right: the volume of both, 8 + 4.
    """
    other = box_points((2, 0, 0), (3, 2, 2))
    expect_volume(check, joined((CUBE, CUBE_TRIANGLES), (other, CUBE_TRIANGLES)), 12)


@case(75)
def one_body_of_two_is_open(check):
    """Two boxes, one of which lacks a face.

    Source: mikedh/trimesh issue 165 (then neither was repaired).
    Right: an error that counts the four open edges.
    """
    other = box_points((5, 0, 0), (6, 1, 1))
    result = solid(joined((CUBE, BOX_FACES), (other, BOX_FACES[:-1])))
    expect_error(check, result, "4 open edges")


@case(76)
def point_that_is_no_number(check):
    """A file whose bytes are mixed up: one coordinate is NaN, others reach 1e31.

    Source: prusa3d/PrusaSlicer issue 14343 (the program ended), AcademySoftwareFoundation/openvdb pull
    request 352 (memory without end), libfive/libfive issue 439.
    Right: one error that names the point, of every filter that takes surfaces.
    """
    broken = CUBE.copy()
    broken[5, 2] = np.nan
    expect_error(check, solid(polygons(broken, CUBE_TRIANGLES)), "1 point that", "index 5")
    surface = polygons(broken[[0, 1, 3, 2, 5]], [[0, 1, 2], [0, 2, 3], [1, 4, 2]])
    for filter_ in (simple.SampleSurface, simple.AreaPreservingParameterization):
        result = Result(filter_(source(surface)))
        expect_error(check, result, "index 4")
    far = CUBE.copy()
    far[5] = 1e31
    result = solid(polygons(far, CUBE_TRIANGLES))
    check.assertLessEqual(len(result.errors), 1)


@case(77)
def model_far_from_the_origin(check):
    """A part at 400 and 800 kilometres, in metres.

    Source: CloudCompare/CloudCompare issue 232 (the shape was lost in single precision).
    Right: 8.
    """
    expect_volume(check, polygons(CUBE + [400000, 800000, 0], CUBE_TRIANGLES), 8)


@case(78)
def as_many_as_asked_for(check):
    """A large triangle beside a thousand small ones.

    Source: mikedh/trimesh issue 558 (2,730 of 4,000 came out), isl-org/Open3D issue 6144 (numbers by
    triangle rounded).
    Right: exactly as many as asked for, shared by area.
    """
    n = 16
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    places = np.c_[x.ravel(), y.ravel(), 0 * x.ravel()]
    corners = [(row * (n + 1) + column) for row in range(n) for column in range(n)]
    faces = [[a, a + 1, a + n + 2] for a in corners] + [[a, a + n + 2, a + n + 1] for a in corners]
    # The large triangle's side is the last column's: as a polygon through all of its points.
    right = [row * (n + 1) + n for row in range(n, -1, -1)]
    places = np.r_[places, [[5, 0.5, 0]]]
    data = polygons(places, faces + [right + [len(places) - 1]])
    result = Result(simple.SampleSurface(source(data), NumberOfParticles=4001))
    check.assertEqual(result.errors, [])
    check.assertEqual(result.data.GetNumberOfPoints(), 4001)
    check.assertAlmostEqual(result.field("TotalMass"), 3, 9)
    check.assertAlmostEqual((result.places()[:, 0] < 1).mean(), 1 / 3, 2)


@case(79)
def property_that_is_no_number(check):
    """A property of the points is NaN, where it was not measured.

    Source: elalish/manifold issue 1140 (memory out of bounds).
    Right: the particles are all there; it is passed on as it is.
    """
    data = polygons([(0, 0), (1, 0), (1, 1), (0, 1)], [[0, 1, 2], [0, 2, 3]])
    data.GetPointData().AddArray(named(np.array([np.nan, 1, 2, 3]), "measured"))
    result = Result(simple.SampleSurface(source(data), NumberOfParticles=200))
    check.assertEqual(result.errors, [])
    check.assertTrue(np.isfinite(result.places()).all())
    found = result.values("measured")
    check.assertTrue(np.isnan(found).any())
    check.assertTrue((np.isnan(found) | ((found >= 1) & (found <= 3))).all())


@case(80)
def faces_of_four_corners(check):
    """A model of quadrangles, cut open at the top.

    Source: InteractiveComputerGraphics/SPlisHSPlasH issue 16 (every face became one triangle),
    cnr-isti-vclab/meshlab issue 288.
    Right: five squares of 4.
    """
    faces = [face for i, face in enumerate(BOX_FACES) if i != 1]
    result = Result(simple.SampleSurface(source(polygons(CUBE, faces)), NumberOfParticles=1000))
    check.assertEqual(result.errors, [])
    check.assertAlmostEqual(result.field("TotalMass"), 20, 9)
    on_top = (result.places()[:, 2] > 1).mean()
    check.assertAlmostEqual(on_top, 0.4, 1)


@case(81)
def scanned_quadrangles_that_are_not_flat(check):
    """A closed box of quadrangles, one corner of which is off the plane of its faces.

    Source: InteractiveComputerGraphics/SPlisHSPlasH issue 16, ladybug-tools/ladybug-geometry issue 6.
    Right: cut into triangles either way the volume is within 1/6 of that corner's shift of the cube's.
    """
    bent = CUBE.copy()
    bent[7] += 0.03
    expect_volume(check, polygons(bent, BOX_FACES), 8, 0.03)


@case(125)
def closed_surfaces_with_one_side(check):
    """Boy's surface and a cross-cap: projective planes, whose Euler characteristic is that of a disk.

    Source: boundary-first-flattening issue 77, libigl threads on cutting to a disk.
    Right: cut open to a disk whose triangles have their areas. They are no solids.
    """
    for function in vtkParametricBoy(), vtkParametricCrossCap():
        surface = vtkParametricFunctionSource()
        surface.SetParametricFunction(function)
        for set_resolution in surface.SetUResolution, surface.SetVResolution:
            set_resolution(24)
        surface.Update()
        result = Result(simple.AreaPreservingParameterization(source(surface.GetOutput())))
        check.assertEqual(result.errors, [])
        check.assertLess(result.field("AreaDistortionRMS"), 0.05)
        check.assertEqual(result.field("FlippedCount"), 0)
        expect_error(check, solid(surface.GetOutput()), "one side only")
