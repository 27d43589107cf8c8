# SPDX-License-Identifier: BSD-3-Clause
"""Maps whose regions have areas in proportion to masses."""
import copy
import sys
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData

from .. import vtkRectifiedTransport as filters
from ._data import vtk_array
from ._numbers import all_numbers
from ._run import set_properties, update


def mapping_of(thing):
    """Its __geo_interface__, a mapping as GeoJSON has it; mappings are their own. None without it."""
    return thing if isinstance(thing, dict) else getattr(thing, "__geo_interface__", None)


def interface_of(thing, name):
    mapping = mapping_of(thing)
    if not isinstance(mapping, dict):
        raise TypeError("%s is a %s without __geo_interface__; it must be a geometry of shapely or the "
                        "like, or GeoJSON" % (name, type(thing).__name__))
    return mapping


def polygons_of(mapping, name):
    """The polygons of a geometry, each a list of rings."""
    geometry = mapping.get("geometry") if mapping.get("type") == "Feature" else mapping
    kind = None if geometry is None else geometry.get("type")
    if kind not in ("Polygon", "MultiPolygon"):
        raise ValueError("%s is %s; it must be a Polygon or MultiPolygon"
                         % (name, "missing" if kind is None else "a " + kind))
    polygons = geometry["coordinates"] if kind == "MultiPolygon" else [geometry["coordinates"]]
    if not any(ring for polygon in polygons for ring in polygon):
        raise ValueError("%s is empty; each region needs an area" % name)
    return polygons


def ring_of(coordinates, name):
    """x and y of the places along a ring, the last of which is the first."""
    try:
        places = np.array([place[:2] for place in coordinates], float).reshape(-1, 2)
    except (TypeError, ValueError):
        places = np.full((1, 2), np.nan)
    if not np.isfinite(places).all():
        raise ValueError("%s has a ring whose coordinates are not all finite numbers" % name)
    return places if (places[0] == places[-1]).all() else np.vstack([places, places[:1]])


class _Rings:
    """The rings of all regions, one after the other, as closed lines."""

    def __init__(self, regions, names):
        self.regions, self.numbers, rings = regions, [], []
        for number, (polygons, name) in enumerate(zip(regions, names)):
            for polygon in polygons:
                for ring in polygon:
                    rings.append(ring_of(ring, name))
                    self.numbers.append(number)
        self.rings = rings

    def data(self, masses):
        """The lines, with the masses and numbers of their regions."""
        data, points, lines = vtkPolyData(), vtkPoints(), vtkCellArray()
        points.SetDataTypeToDouble()
        for ring in self.rings:
            ids = [points.InsertNextPoint(x, y, 0) for x, y in ring[:-1]]
            lines.InsertNextCell(len(ids) + 1)
            for point in [*ids, ids[0]]:
                lines.InsertCellPoint(point)
        data.SetPoints(points)
        data.SetLines(lines)
        for name, values in (("masses", masses[self.numbers]), ("Region", np.array(self.numbers))):
            data.GetCellData().AddArray(vtk_array(np.ascontiguousarray(values), name))
        return data

    def moved(self, data):
        """Polygons of each region, as the regions have them, with the coordinates of moved lines."""
        places = vtk_to_numpy(data.GetPoints().GetData())[:, :2]
        lines = data.GetLines()
        ids = vtk_to_numpy(lines.GetConnectivityArray())
        ends = vtk_to_numpy(lines.GetOffsetsArray())
        rings = iter([tuple(map(tuple, places[ids[first:end]].tolist()))
                      for first, end in zip(ends, ends[1:])])
        return [[[next(rings) for _ in polygon] for polygon in polygons] for polygons in self.regions]


def geometry_like(mapping, polygons):
    """A geometry or feature as a mapping, with other coordinates, and without the former bounds."""
    if mapping.get("type") == "Feature":
        kept = {key: value for key, value in mapping.items() if key != "bbox"}
        return {**kept, "geometry": geometry_like(mapping["geometry"], polygons)}
    whole = tuple(map(tuple, polygons))
    return {"type": mapping["type"],
            "coordinates": whole if mapping["type"] == "MultiPolygon" else whole[0]}


def made_like(thing, mapping):
    """An object of the kind of another one; those of packages by their function shape."""
    if isinstance(thing, dict):
        made = copy.copy(thing)  # maybe of a class of its own
        made.pop("bbox", None)
        made.update(mapping)
        return made
    package = sys.modules.get(type(thing).__module__.partition(".")[0])
    shape = getattr(getattr(package, "geometry", package), "shape", None) or getattr(package, "shape", None)
    if shape is None:
        raise TypeError("geometries of type %s cannot be made: their package has no function shape"
                        % type(thing).__name__)
    return shape(mapping)


def all_like(geometries, mappings, keeps_crs):
    """What holds geometries, of the kind of the given one."""
    if isinstance(geometries, dict):  # a FeatureCollection
        return made_like(geometries, {"features": mappings})
    if hasattr(geometries, "set_geometry"):  # a GeoDataFrame
        given = geometries.geometry
        return geometries.set_geometry(all_like(given, mappings, keeps_crs).rename(given.name))
    if hasattr(geometries, "geom_type"):  # a GeoSeries
        made = [made_like(thing, mapping) for thing, mapping in zip(geometries, mappings)]
        return type(geometries)(made, index=geometries.index, name=geometries.name,
                                crs=geometries.crs if keeps_crs else None)
    made = [made_like(thing, mapping) for thing, mapping in zip(geometries, mappings)]
    return tuple(made) if isinstance(geometries, tuple) else made


def cartogram(geometries: Any, masses: ArrayLike, **properties: Any) -> Any:
    """A map whose regions have areas in proportion to masses, such as populations, by Cartogram
    (vtkCartogram).

    geometries  the regions: a GeoSeries or GeoDataFrame of GeoPandas; a sequence of polygons and
                multipolygons of shapely, or of other objects that have __geo_interface__; GeoJSON: a
                FeatureCollection, or a sequence of features or geometries. Coordinates must be those
                of a projection that keeps areas, or degrees with Projection="EqualArea".
    masses      (number of regions): one for each, 0 and more with a sum above 0
    properties  of the filter, such as Projection="EqualArea", Tolerance, EmptyCells="Minimum",
                MinimumShare=0.001 so that no region vanishes

    Returns the same kind of object with moved borders, which have more points; all else is kept.
    Regions that share borders still do. Coordinates are x and y; with Projection they are in
    kilometres, and a GeoSeries has no crs.

    Raises ValueError for another number of masses, for missing and empty geometries and others than
    polygons, for masses that are negative or not finite, and for a property that the filter refuses;
    TypeError for what is no geometry and no number.
    """
    mapping = mapping_of(geometries)
    if mapping is not None and mapping.get("type") != "FeatureCollection":
        raise ValueError("geometries is one %s; it must be several regions" % mapping.get("type"))
    things = list(geometries if mapping is None else mapping["features"])
    names = ["geometries[%d]" % i for i in range(len(things))]
    mappings = list(map(interface_of, things, names))
    rings = _Rings(list(map(polygons_of, mappings, names)), names)
    shares = all_numbers(masses, "masses").astype(float)
    if shares.shape != (len(things),) or not len(things):
        raise ValueError("masses has the shape %s and geometries %d regions; there must be a mass for "
                         "each" % (shares.shape, len(things)))
    algorithm = filters.vtkCartogram()
    set_properties(algorithm, {}, properties)
    algorithm.SetInputData(rings.data(shares))
    for place, name in enumerate(("masses", "Region")):
        algorithm.SetInputArrayToProcess(place, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, name)
    update(algorithm, {"masses": shares.shape})
    moved = map(geometry_like, mappings, rings.moved(algorithm.GetRegions()))
    if mapping is not None and not isinstance(geometries, dict):
        moved = (feature["geometry"] for feature in moved)  # those of GeoPandas, one by one
    keeps_crs = algorithm.GetProjection() == filters.vtkCartogram.PROJECTION_NONE
    return all_like(geometries, list(moved), keeps_crs)
