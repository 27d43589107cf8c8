# SPDX-License-Identifier: BSD-3-Clause
"""Which array is the density, and how its values are read: vectors, text, ids, flags."""
import numpy as np
from vtkmodules.vtkCommonCore import vtkBitArray, vtkStringArray
from vtkmodules.vtkFiltersCore import vtkAppendFilter

from .case import Result, blocks, case, expect_error, expect_mass, image, named, rings, simple, source

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def texts(values, name):
    array = vtkStringArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value if isinstance(value, bytes) else str(value))
    return array


def mesh_of(data):
    append = vtkAppendFilter()
    append.AddInputData(data)
    append.Update()
    return append.GetOutput()


def flow(cells=True, scalar=True, active=None):
    """Water that is faster in half of a channel; and the share of water in a cell."""
    velocity = np.zeros((6, 8, 3))
    velocity[..., 0], velocity[..., 1] = 3, np.where(np.arange(8) < 4, 4, 0)
    share = np.ones((6, 8)) + (np.arange(8) > 3)
    data = image(share, cells)
    arrays = data.GetCellData() if cells else data.GetPointData()
    arrays.Initialize()
    arrays.AddArray(named(velocity.reshape(-1, 3), "U"))
    if scalar:
        arrays.AddArray(named(share.ravel(), "alpha"))
    if active == "scalars":
        arrays.SetActiveScalars("U")
    elif active == "vectors":
        arrays.SetActiveVectors("U")
    return data, share.sum(), np.linalg.norm(velocity, axis=2).sum()


def untold(data, **properties):
    """Sample Density of the array that ParaView chooses at first."""
    return Result(simple.SampleDensity(source(data), NumberOfParticles=100, **properties))


@case(131)
def velocity_is_no_colour(check):
    """A flow as solvers write it: a velocity, then a scalar.

    Source: fluiddyn/fluidfoam issue 35, yt and AMReX plotfiles.
    Right: the scalar; of the velocity alone the magnitude, never the luminance that colours have.
    """
    for cells in (True, False):
        for active in (None, "vectors", "scalars"):
            data, mass, norms = flow(cells, active=active)
            for form in (data, mesh_of(data)) if cells else (data,):
                result = untold(form)
                check.assertEqual(result.errors + result.warnings, [])
                check.assertAlmostEqual(result.field("TotalMass") / mass, 1, 9)
                check.assertEqual(result.field("DensityComponent"), 0)
            alone, _, _ = flow(cells, scalar=False, active=active)
            result = untold(alone)
            check.assertAlmostEqual(result.field("TotalMass") / norms, 1, 9)
            check.assertEqual(result.field("DensityComponent"), -3)
    given = source(alone)
    dots = simple.SampleDensity(given, NumberOfParticles=100)
    for filter_, port, densities in (
            (dots, 0, 1), (simple.TransportMap(given), 0, 1), (simple.TransportMap(given, Target=given), 0, 2),
            (simple.DensityEqualizingWarp(dots, Density=given), 0, 1),
            (simple.RelaxBlueNoise(dots, Density=given, MaximumIterations=1), 0, 1),
            (simple.TransportQuality(dots, Density=given), 0, 1),
            (simple.EqualMassCells(dots, Domain=given, Measure="Density"), 0, 1),
            (simple.EqualMassCells(dots, Domain=given, Measure="Density"), 1, 1),
            (simple.MorphDensities(given, Target=given), 0, 2),
            (simple.MorphDensities(given, Target=given), 1, 2),
            (simple.DensityBarycenter(Input=[given]), 0, 1),
            (simple.TransportDistance(Input=[given, given]), 2, 2),
            (simple.TransportTemporalInterpolator(given), 0, 1)):
        filter_.InvertDensity = 1
        filter_.UpdatePipeline()
        fields = filter_.GetClientSideObject().GetOutputDataObject(port).GetFieldData()
        read = {name: [fields.GetAbstractArray("Density" + name).GetVariantValue(i).ToString()
                       for i in range(fields.GetAbstractArray("Density" + name).GetNumberOfValues())]
                for name in ("ArrayName", "Component", "Inverted", "Range")}
        check.assertEqual(read, {"ArrayName": densities * ["U"], "Component": densities * ["-3"],
                                 "Inverted": densities * ["1"],
                                 "Range": densities * ["-1e+299", "1e+299"]}, filter_)


@case(116)
def text_before_the_numbers(check):
    """Features with a name, then the one number that they have, as GeoJSON gives them.

    Source: sjewo/cartogram pull request 22, Natural Earth.
    Right: the number is the mass, for the cartogram and as a density; text never is.
    """
    people = np.array([1., 5., 2., 4.])
    data = rings(*([(x + a, b) for a, b in SQUARE] for x in range(4)), values=people)
    arrays = data.GetCellData()
    arrays.Initialize()
    for name in ("code", "Name"):
        arrays.AddArray(texts((f"{name}{i}" for i in range(4)), name))
    arrays.AddArray(named(people, "people"))
    check.assertEqual(simple.Cartogram(Input=source(data)).MassArray[1], "people")
    result = untold(data, DensityResolution=32)
    check.assertEqual(result.errors, [])
    check.assertAlmostEqual(result.field("TotalMass") / people.sum(), 1, 9)
    arrays.RemoveArray("people")
    expect_error(check, untold(data), "no active scalars")


@case(151)
def numbers_of_features_before_the_people(check):
    """The first column of a table of a map numbers its features: FID, OBJECTID, gid.

    Source: ArcGIS and PostGIS, which number features so.
    Right: the people are the mass.
    """
    people = np.array([1., 5., 2., 4.])
    for name in ("FID", "OBJECTID", "objectid_1", "gid", "GEOID", "osm_id", "ogc_fid"):
        data = rings(*([(x + a, b) for a, b in SQUARE] for x in range(4)), values=people)
        arrays = data.GetCellData()
        arrays.Initialize()
        arrays.AddArray(named(np.arange(4.), name))
        arrays.AddArray(named(people, "people"))
        check.assertEqual(simple.Cartogram(Input=source(data)).MassArray[1], "people", name)


@case(114)
def whole_numbers_of_64_bits(check):
    """Populations that a reader gives as text, with blanks, exponents, and of twenty digits.

    Source: geopandas issue 691, geoda pull request 2436.
    Right: the mass of the numbers; a text that is none is named.
    """
    for values in (["1", " 5", "2 ", "+4"], ["1e9", "5E+09", "2000000000", "4.0e9"],
                   ["10000000000000000000", "50000000000000000000", "2e19", "4e19"]):
        data = rings(*([(x + a, b) for a, b in SQUARE] for x in range(4)), values=np.ones(4))
        data.GetCellData().Initialize()
        data.GetCellData().AddArray(texts(values, "v"))
        expect_mass(check, data, sum(map(float, values)), DensityResolution=32)
        cartogram = Result(simple.Cartogram(
            Input=source(data), MassArray=["CELLS", "v"], Resolution=128))
        check.assertEqual(cartogram.errors, [])
        check.assertLess(np.abs(cartogram.values("AreaError", True)).max(), 0.011)
    data.GetCellData().AddArray(texts(["1", "many", "2", "?"], "v"))
    data.GetCellData().AddArray(texts(["Aa", "Bb", "Cc", "Dd"], "name"))
    result = Result(simple.Cartogram(Input=source(data), MassArray=["CELLS", "v"], Resolution=128))
    expect_error(check, result, "2 of 4 texts", "'many' of the region 'Bb'")
    data.GetCellData().AddArray(texts(["1", "", "2", "4"], "v"))
    result = Result(simple.Cartogram(Input=source(data), MassArray=["CELLS", "v"], Resolution=128))
    expect_error(check, result, "The mass of the region 'Bb' in 'v' is nan")


@case(152)
def reader_of_one_file_gives_text(check):
    """Two files of one map: of one the reader gives numbers, of the other, whose numbers are larger,
    text.

    Source: the driver of GDAL for GeoJSON, which takes the type of a column from its values.
    Right: the mass of both.
    """
    parts = []
    for x, array in ((0, named(np.array([5]), "v")), (1, texts(["6000000000"], "v"))):
        data = rings([(x + a, b) for a, b in SQUARE], values=np.ones(1))
        data.GetCellData().Initialize()
        data.GetCellData().AddArray(array)
        parts.append(data)
    expect_mass(check, blocks(*parts), 6000000005, DensityResolution=32)
    expect_mass(check, blocks(*parts[::-1]), 6000000005, DensityResolution=32)


@case(153)
def flags_of_another_type(check):
    """Blanked cells whose flags numpy made integers of 64 bits.

    Source: the promotion of types in numpy 2, where HIDDENCELL * uint8 is int64.
    Right: the flags of bytes hide cells; others hide none, and a warning names them.
    """
    values = np.arange(1., 13).reshape(3, 4)
    hidden = (32 * (np.arange(12) < 4)).astype(np.uint8)
    for kind in (np.uint8, np.int64, np.int8, float):
        data = image(values)
        data.GetCellData().AddArray(named(hidden.astype(kind), "vtkGhostType"))
        result = expect_mass(check, data, 68 if kind == np.uint8 else 78)
        told = [text for text in result.warnings if "'vtkGhostType' of the cells" in text]
        check.assertEqual(len(told), 0 if kind == np.uint8 else 1, result.warnings)


@case(154)
def names_of_old_files(check):
    """A map whose names are Latin-1, as in the tables of old shapefiles; one region has no people.

    Source: QGIS and GDAL threads on the encoding of .dbf.
    Right: a message that names the region. Python hands on no message with a byte that is no UTF-8.
    """
    def messages(name, values=(1, 2), **properties):
        data = rings(SQUARE, [(x + 1, y) for x, y in SQUARE])
        data.GetCellData().AddArray(texts([name, "Mali"], "name"))
        data.GetCellData().AddArray(texts(values, "people"))
        result = Result(simple.Cartogram(
            Input=source(data), MassArray=["CELLS", "people"], RegionArray=["CELLS", "name"],
            Resolution=64, **properties))
        return result.errors + result.warnings

    latin = "Côte d'Ivoire".encode("latin-1")
    for name in (latin, "Côte d'Ivoire"):
        for values, properties in ((("no", 2), {}), ((0, 2), {})):
            text, = messages(name, values, **properties)
            check.assertIn("Côte d'Ivoire", text)


@case(167)
def flags_of_bits(check):
    """A flag of one bit a cell, which a map is divided by: towns, and the land.

    Source: VTK's arrays of bits, whose variants have no value.
    Right: two regions, with 1 and 3 of 4.
    """
    data = rings(*([(x + a, b) for a, b in SQUARE] for x in range(4)), values=[1, 3, 1, 3])
    flags = vtkBitArray()
    flags.SetName("town")
    for flag in (1, 0, 1, 0):
        flags.InsertNextValue(flag)
    data.GetCellData().AddArray(flags)
    result = Result(simple.Cartogram(Input=source(data), MassArray=["CELLS", "v"], RegionArray=["CELLS", "town"],
                                     Resolution=128))
    check.assertEqual(result.errors + result.warnings, [])
    check.assertLess(abs(result.values("TargetArea", True) - [1, 3, 1, 3]).max(), 1e-9)
