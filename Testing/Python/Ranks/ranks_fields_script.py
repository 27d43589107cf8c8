# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksFields.py runs on each rank: all filters of the register, on inputs with field data of
names that are given. Each rank writes the field data of all outputs."""
import json
import pickle
import sys

from paraview import simple
from ranks_rows import RANK, given_here
from rt_filters import FILTERS
from rt_testing import load_plugin, region_map
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

WRONG = -77.0  # what the inputs have
NAMES = json.loads(sys.argv[2])


def with_fields(source):
    """What this rank has of a source, with those field data."""
    source.UpdatePipeline()
    algorithm = source.GetClientSideObject()
    data = algorithm.GetOutputDataObject(0)
    copy = data.NewInstance()
    copy.ShallowCopy(data)
    for name in NAMES:
        array = vtkDoubleArray()
        array.SetName(name)
        array.InsertNextValue(WRONG)
        copy.GetFieldData().AddArray(array)
    whole = algorithm.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT())
    return given_here(copy, list(whole) if whole else None)


def image(flat=False):
    return with_fields(simple.Wavelet(WholeExtent=[-6, 6, 0, 9, 0, 0 if flat else 5], StandardDeviation=5))


def seeds():
    return with_fields(simple.UniformSeeds(NumberOfPoints=40, Dimension=3, Bounds=[-6, 6, 0, 9, 0, 5]))


def sources(flat=False):
    return {
        "density": lambda: image(flat),
        "densities": lambda: [image(flat), image(flat)],
        "image": lambda: image(flat),
        "points": seeds,
        "mesh": seeds,
        "disk": lambda: with_fields(simple.Plane(XResolution=6, YResolution=6)),
        "solid": lambda: with_fields(simple.Sphere()),
        "map": lambda: with_fields(given_here(region_map())),
    }


def fields(data):
    """By name, in all tuples."""
    arrays = data.GetFieldData()
    return {arrays.GetArrayName(i): [arrays.GetArray(i).GetTuple(k)
                                     for k in range(arrays.GetArray(i).GetNumberOfTuples())]
            for i in range(arrays.GetNumberOfArrays()) if arrays.GetArray(i)}


def give(name, proxy):
    proxy.UpdatePipeline()
    algorithm = proxy.GetClientSideObject()
    for port in range(algorithm.GetNumberOfOutputPorts()):
        given["%s, port %d" % (name, port)] = fields(algorithm.GetOutputDataObject(port))


given = {}
load_plugin()
for filter_ in FILTERS:
    if not filter_.on_ranks:
        continue
    properties = {"Certify": 1} if "Certify" in filter_.panel else {}
    for optional in (False, True)[:1 + bool(filter_.optional)]:
        give("%s, %s" % (filter_.name, "with all" if optional else "alone"),
             filter_.make(simple, sources(), optional=optional, **properties))
for name, properties in (("a density", {"Measure": "Density"}),
                         ("power", {"Measure": "Density", "Shape": "Power"})):
    give("EqualMassCells of " + name, simple.EqualMassCells(
        seeds(), Domain=image("Shape" in properties), Resolution=16, **properties))
# Of particles that have all of them.
sampled = simple.SampleDensity(simple.Wavelet(), NumberOfParticles=500)
give("EqualMassCells of particles", simple.EqualMassCells(sampled, Resolution=32))
give("SampleSurface by the flow", simple.SampleSurface(
    sources()["disk"](), Method="Flow", NumberOfParticles=40, Resolution=32))
with open("%s.%d" % (sys.argv[1], RANK), "wb") as file:
    pickle.dump(given, file)
print("WROTE")
