# SPDX-License-Identifier: BSD-3-Clause
"""Maps for cartograms as GeoJSON: features with a name, a mass and polygons, each an outline and its
holes as closed lists of points."""
import json


def geometries(path, name):
    """Geometries of a TopoJSON file, each with its polygons; shared borders have the same points.
    Rings without area are left out."""
    with open(path, encoding="utf-8") as file:
        topology = json.load(file)
    scale, shift = topology["transform"]["scale"], topology["transform"]["translate"]
    arcs = []
    for arc in topology["arcs"]:
        x = y = 0
        points = []
        for dx, dy in arc:
            x, y = x + dx, y + dy
            points.append((x * scale[0] + shift[0], y * scale[1] + shift[1]))
        arcs.append(points)
    for geometry in topology["objects"][name]["geometries"]:
        polygons = geometry["arcs"] if geometry["type"] == "MultiPolygon" else [geometry["arcs"]]
        polygons = [[ring_of(ring, arcs) for ring in polygon] for polygon in polygons]
        yield geometry, [[ring for ring in polygon if len(ring) > 3] for polygon in polygons
                         if len(polygon[0]) > 3]


def ring_of(numbers, arcs):
    ring = []
    for number in numbers:
        arc = arcs[number] if number >= 0 else arcs[~number][::-1]
        ring += arc if not ring else arc[1:]
    return ring


def feature(name, mass, polygons):
    return {"type": "Feature", "properties": {"name": name, "mass": mass},
            "geometry": {"type": "MultiPolygon", "coordinates": polygons}}


def write(path, features):
    with open(path, "w", encoding="utf-8") as out:
        json.dump({"type": "FeatureCollection", "features": features}, out)
