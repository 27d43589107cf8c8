#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The bits that the filters compute: digests of the outputs of runs which take every filter,
dimension and family of options.

usage: python3 Testing/Python/run.py TestDigests [--record | --against FILE] [--device]

Without an option the digests are compared with Testing/Data/digests.json, which --record writes;
--against compares with another such file. A change that is meant to change bits records them anew
and says why; any other change may not.
"""
import argparse
import hashlib
import json
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkMultiBlockDataSet
import rectifiedtransport as rt
from rt_digest_inputs import (TURN, box_of_triangles, colours, image, points_in, sheet, values,
                              with_ghosts)
from rt_filters import FILTERS, PATTERNS
from rt_series import Series
from rt_testing import SOURCE, region_map

INTEGRATORS = ["Multistep", "RungeKutta4", "Euler", "Adaptive"]
MAPS = ["Auto", "On", "Off"]
KERNELS = ["CloudInCell", "NearestCell", "TriangularShapedCloud", "Gaussian"]
# From VTK 9.6 on vtkPolygon cuts quadrilaterals along other diagonals.
FROM_VTK_9_6 = {"parameterization of quads": "b0ed692eb35564b6", "surface of quads": "7cbad78545c10703",
                "surface of quads relaxed": "6cd4ae73633bc746"}
# What other tests look at: left out, as no bits of a result.
COUNTS = {"MovedParticles", "MovedSamples", "OutsideSeeds", "OutsidePoints", "OutsideSites",
          "SitesWithoutMass", "StepsTaken", "AreaErrorEstimate", "EqualAreaPasses", "FoldedCells",
          "LargestBlockError", "RegionsMissed", "DensityArrayName", "DensityComponent", "DensityInverted", "DensityRange"}


class Digest:
    """Of all that an output holds, to the last bit."""

    def __init__(self, *outputs):
        self.hash = hashlib.sha256()
        for output in outputs:
            self.add(output)

    def text(self):
        return self.hash.hexdigest()[:16]

    def add(self, data):
        self.hash.update(data.GetClassName().encode())
        if data.IsA("vtkImageData"):
            matrix = data.GetDirectionMatrix()
            self.add_numbers(data.GetExtent(), data.GetOrigin(), data.GetSpacing(),
                             [matrix.GetElement(i, j) for i in range(3) for j in range(3)])
        if data.IsA("vtkPointSet") and data.GetPoints():
            self.add_array(data.GetPoints().GetData())
        if data.IsA("vtkPolyData"):
            for cells in (data.GetVerts(), data.GetLines(), data.GetPolys()):
                self.add_array(cells.GetOffsetsArray())
                self.add_array(cells.GetConnectivityArray())
        owners = [vtkDataObject.ROW] if data.IsA("vtkTable") else \
            [vtkDataObject.POINT, vtkDataObject.CELL, vtkDataObject.FIELD]
        for owner in owners:
            attributes = data.GetAttributesAsFieldData(owner)
            for i in range(attributes.GetNumberOfArrays()):
                if attributes.GetArrayName(i) not in COUNTS:
                    self.hash.update(str(attributes.GetArrayName(i)).encode())
                    self.add_array(attributes.GetArray(i))

    def add_array(self, array):
        if array.GetNumberOfTuples() > 0:
            values = np.ascontiguousarray(vtk_to_numpy(array))
            if values.dtype.kind == "i":
                values = values.astype(np.int64)  # vtkIdType has two names
            self.hash.update(str(values.shape).encode() + values.tobytes())

    def add_numbers(self, *lists):
        for numbers in lists:
            self.hash.update(np.asarray(numbers, dtype=np.float64).tobytes())


class Devices:
    """Whether filters that can do their work on a device are to, and what they say if none did it."""
    asked = False
    faults = []
    keeper = None  # of the device between runs: to open it takes long

    @classmethod
    def serve(cls, filter_class):
        return hasattr(filter_class, "SetDeviceToOpenCL")

    @classmethod
    def ask(cls, algorithm):
        if cls.asked and cls.serve(algorithm):
            algorithm.SetDeviceToOpenCL()
            algorithm.AddObserver("WarningEvent", cls.keep)
            cls.keeper = cls.keeper or algorithm

    @classmethod
    def keep(cls, _, __, text):
        if "the processor did the work" in text:
            cls.faults.append(text)
    keep.__func__.CallDataType = "string0"


def run(filter_class, *inputs, array=None, time=None, **properties):
    """The outputs of a filter; inputs are those of its ports, None for none."""
    algorithm = filter_class()
    Devices.ask(algorithm)
    if filter_class is rt.vtkTransportSampler and "SampleArrays" not in properties:
        algorithm.SampleArraysOff()
    for port, data in enumerate(inputs):
        for part in data if isinstance(data, list) else [data]:
            if part is None:
                continue
            if isinstance(part, Series):
                algorithm.SetInputConnection(port, part.GetOutputPort())
                continue
            if isinstance(data, list):
                algorithm.AddInputDataObject(port, part)
            else:
                algorithm.SetInputDataObject(port, part)
    if array:
        algorithm.SetInputArrayToProcess(*array)
    for name, value in properties.items():
        if name in ("Weights", "Corners"):
            for k, item in enumerate(value):
                getattr(algorithm, "Set" + name[:-1])(k, item)
        else:
            setter = getattr(algorithm, "Set" + name)
            setter(*value) if isinstance(value, tuple) else setter(value)
    if time is None:
        algorithm.Update()
    else:
        algorithm.UpdateTimeStep(time)
    return [algorithm.GetOutputDataObject(p) for p in range(algorithm.GetNumberOfOutputPorts())]


def sampler_runs():
    sampler = rt.vtkTransportSampler
    line, plane, space = image((200,)), image(), image((23, 17, 19))
    for pattern, name in enumerate(PATTERNS):
        for data, dimension in ((line, 1), (plane, 2), (space, 3)):
            yield f"sample {name} {dimension}D", sampler, [data], dict(
                SeedPattern=pattern, NumberOfParticles=3000, RandomSeed=7)
    for integrator, name in enumerate(INTEGRATORS):
        for data, dimension in ((plane, 2), (space, 3)):
            yield f"sample {name} {dimension}D", sampler, [data], dict(
                Integrator=integrator, NumberOfParticles=2000, Tolerance=0.003, NumberOfSteps=24)
    yield "sample Nearest", sampler, [plane], dict(TableLookup=1)
    for maps, name in enumerate(MAPS):
        for data, dimension in ((image((210, 160)), 2), (image((84, 80, 72)), 3)):
            yield f"sample with maps {name} {dimension}D", sampler, [data], dict(
                FlowMaps=maps, NumberOfParticles=30000, SeedPattern=4)
    yield "sample FlowTime with maps", sampler, [image((210, 160))], dict(
        FlowMaps=1, FlowTime=0.99, NumberOfParticles=2000)
    yield "sample many steps", sampler, [plane], dict(NumberOfSteps=160, NumberOfParticles=2000)
    yield "sample FlowTime", sampler, [space], dict(FlowTime=0.6, NumberOfParticles=2000)
    yield "sample paths", sampler, [plane], dict(OutputPaths=1, NumberOfParticles=500)
    yield "sample paths 3D", sampler, [space], dict(OutputPaths=1, NumberOfParticles=500)
    yield "sample a grid in cells", sampler, [plane], dict(SeedPattern=2, SamplesPerCell=2)
    yield "sample given seeds", sampler, [plane, points_in(plane)], {}
    yield "sample given seeds 3D", sampler, [space, points_in(space, dtype=np.float32)], {}
    yield "sample points", sampler, [image(cells=False, dtype=np.float32)], {}
    yield "sample turned", sampler, [image(direction=TURN)], dict(NumberOfParticles=2000)
    yield "sample turned 3D", sampler, [image((23, 17, 19), direction=TURN, spacing=(1, -2, 0.5))], \
        dict(NumberOfParticles=2000)
    for data, dimension in ((line, 1), (plane, 2), (space, 3)):
        yield f"sample arrays {dimension}D", sampler, [data], dict(
            SampleArrays=1, NumberOfParticles=2000)
    yield "sample arrays of colours", sampler, [colours(3)], dict(
        SampleArrays=1, NumberOfParticles=2000)
    yield "sample ghosts", sampler, [with_ghosts(image())], {}
    for components in (2, 3, 4):
        yield f"sample {components} colours", sampler, [colours(components)], dict(
            InvertDensity=1, NumberOfParticles=2000)
    yield "sample a component", sampler, [colours(3, dtype=np.int32)], dict(Component=2)
    yield "sample clamped", sampler, [image(array=values((61, 47), 0) - 20.5)], dict(
        NegativeValues=1)
    flat = image((48, 36), spacing=(1, 1, 1))
    yield "sample many", sampler, [flat], dict(NumberOfParticles=100000, SeedPattern=3)


def optimal_runs():
    for shape in ((200,), (61, 47), (23, 17, 19)):
        density = image(shape)
        where = f"{len(shape)}D"
        for name, options in (("optimal", dict(Method=1)), ("certified", dict(Certify=1))):
            yield f"sample {name} {where}", rt.vtkTransportSampler, [density], dict(
                options, NumberOfParticles=2000)
            for direction in (0, 1):
                yield f"map {name} {direction} {where}", rt.vtkTransportMap, [density], dict(
                    options, Direction=direction)
            yield f"warp {name} {where}", rt.vtkDensityEqualizingWarp, [points_in(density), density], \
                options
    yield "sample optimal given seeds", rt.vtkTransportSampler, [image(), points_in(image())], dict(
        Method=1)
    yield "sample optimal paths", rt.vtkTransportSampler, [image()], dict(
        Method=1, OutputPaths=1, NumberOfParticles=300)
    yield "warp optimal equal areas", rt.vtkDensityEqualizingWarp, [points_in(image()), image()], dict(
        Method=1, EqualizeAreas=1)


def map_runs():
    transport = rt.vtkTransportMap
    for direction, name in enumerate(["to the density", "to the uniform measure"]):
        for shape in ((200,), (61, 47), (23, 17, 19)):
            yield f"map {name} {len(shape)}D", transport, [image(shape)], dict(Direction=direction)
        for shape in ((210, 160), (84, 80, 72)):
            yield f"map {name} {len(shape)}D with maps", transport, [image(shape)], dict(
                Direction=direction, FlowMaps=1)
    yield "map of points", transport, [image((23, 17, 19), cells=False)], {}
    yield "map of other samples", transport, [image()], dict(SampleDimensions=(30, 80, 1))
    yield "map turned 3D", transport, [image((23, 17, 19), direction=TURN)], {}
    for shape, other in (((200,), (150,)), ((61, 47), (50, 60)), ((23, 17, 19), (20, 21, 15))):
        both = [image(shape), image(other, seed=5, origin=(2, 3, 4)[:len(shape)] + (1, 2, 3)[len(shape):])]
        for name, options in (("", {}), (" optimal", dict(Method=1)), (" certified", dict(Certify=1))):
            yield f"map to a target{name} {len(shape)}D", transport, both, options
    both = [image(cells=False), image(seed=5)]
    yield "map from a target", transport, both, dict(Direction=1)
    yield "map to a target, of other samples", transport, both, dict(SampleDimensions=(30, 80, 1))
    yield "map to a target with maps", transport, [image((210, 160)), image((210, 160), seed=5)], dict(
        FlowMaps=1)


def distance_runs():
    distance = rt.vtkTransportDistance
    for shape in ((200,), (61, 47), (23, 17, 19)):
        for method in range(2):
            yield f"distances {method} {len(shape)}D", distance, [
                [image(shape, seed=s) for s in range(4)]], dict(Method=method)
    yield "distances of points", distance, [[image(cells=False, seed=s) for s in range(3)]], dict(
        NumberOfCoordinates=3)
    yield "distances turned", distance, [
        [image((23, 17, 19), direction=TURN, seed=s) for s in range(3)]], dict(Method=1)
    yield "distances of other sizes", distance, [
        [image(cells=False), image(cells=False, seed=5)]], dict(Component=0, NumberOfCoordinates=1)


def temporal_runs():
    temporal = rt.vtkTransportTemporalInterpolator
    for shape in ((200,), (47, 61), (19, 17, 23)):
        for method in range(2):
            steps = [values(shape, seed).reshape(shape) for seed in range(3)]
            yield f"temporal {method} {len(shape)}D", temporal, [Series(steps)], dict(time=1.3, Method=method)
    steps = [{"Values": values((47, 61), seed).reshape(47, 61), "Other": values((47, 61), seed + 5).reshape(47, 61)}
             for seed in range(3)]
    for kernel, name in enumerate(KERNELS):
        yield f"temporal {name}", temporal, [Series(steps, points=True)], dict(
            time=0.4, Kernel=kernel, ParticlesPerCell=kernel + 1, Radius=1.5)
    yield "temporal tracked", temporal, [Series(steps)], dict(time=1.5, TrackParticles=1)


def warp_runs():
    for shape in ((200,), (61, 47), (23, 17, 19)):
        density = image(shape)
        yield f"warp {len(shape)}D", rt.vtkDensityEqualizingWarp, [points_in(density), density], {}
    density = image(direction=TURN)
    yield "warp half", rt.vtkDensityEqualizingWarp, [points_in(density, dtype=np.float32), density], \
        dict(Blend=0.5)


def blend_runs():
    morph, barycenter = rt.vtkTransportInterpolator, rt.vtkTransportBarycenter
    yield "morph by default", morph, [image(), image(seed=5)], {}
    simplest = dict(ParticlesPerCell=1, Kernel=0)
    for shape in ((200,), (61, 47), (23, 17, 19)):
        yield f"morph {len(shape)}D", morph, [image(shape), image(shape, seed=5)], dict(
            simplest, Parameter=0.3)
    for mode in range(4):
        yield f"morph mass {mode}", morph, [image(), image(seed=5)], dict(
            simplest, MassMode=mode)
    for kernel, name in enumerate(KERNELS):
        yield f"morph {name}", morph, [image(), image((50, 60), seed=5, origin=(3, 3, 3))], dict(
            Kernel=kernel, ParticlesPerCell=kernel + 1, Radius=1.5)
    yield "morph of other values", morph, [image(cells=False), image(seed=2)], dict(
        simplest, Dimensions=(40, 0, 0))
    yield "morph Adaptive", morph, [image(), image(seed=5)], dict(
        simplest, Integrator=3)
    inputs = [image(seed=s) for s in range(3)]
    yield "barycenter 2D", barycenter, [inputs], dict(
        simplest, Weights=[1, 2, 0.5])
    blocks = vtkMultiBlockDataSet()
    for k in range(3):
        blocks.SetBlock(k, image((23, 17, 19), seed=k))
    yield "barycenter of blocks 3D", barycenter, [blocks], dict(
        simplest, Weights=[1, 0, 3])


def splat_runs():
    splatter = rt.vtkMassSplatter
    space, plane = image((23, 17, 19)), image()
    masses = (0, 0, 0, 0, "Mass")
    for kernel, name in enumerate(KERNELS):
        for boundary in range(2):
            yield f"splat {name} {boundary}", splatter, [points_in(space, 5000), space], dict(
                Kernel=kernel, Boundary=boundary, Radius=1.7, array=masses)
    yield "splat in a plane", splatter, [points_in(plane, 5000), plane], dict(array=masses)
    yield "splat without a reference", splatter, [points_in(space, dtype=np.float32)], dict(
        Dimensions=(16, 20, 24), Association=1, DivideByVolume=0)
    yield "splat many", splatter, [points_in(plane, 200000)], dict(Dimensions=(300, 200, 1))
    yield "splat on a line", splatter, [points_in(image((200,)), 3000), image((200,))], {}


def other_runs():
    cells, solid = rt.vtkEqualMassCells, rt.vtkSolidDensity
    yield "cells 1D", cells, [points_in(image((200,)), 9), image((200,))], dict(Resolution=100)
    yield "cells 2D", cells, [points_in(image(), 40)], dict(Resolution=120)
    yield "cells 3D", cells, [points_in(image((23, 17, 19)), 20)], dict(
        Resolution=24, NormExponent=3.0, CostExponent=1.5)
    yield "cells of a domain", cells, [points_in(image(), 40), image(direction=TURN)], dict(
        Resolution=90, Integrator=1)
    yield "cells of shared pixels", cells, [points_in(image(), 60)], dict(Resolution=12)
    yield "cells of least cost", cells, [points_in(image(), 60), image(direction=TURN)], dict(
        Resolution=90, Shape=1)
    yield from mass_cells_runs()
    yield "cartogram", rt.vtkCartogram, [region_map(), points_in(image())], dict(Resolution=64)
    yield "cartogram of degrees", rt.vtkCartogram, [region_map()], dict(
        Resolution=64, Projection=1, EmptyCells=2)
    yield "solid", solid, [box_of_triangles()], dict(Resolution=24)
    yield "solid turned", solid, [box_of_triangles(True)], dict(Resolution=17, Supersampling=5,
                                                                Association=1)
    for shape in ((200,), (61, 47), (23, 17, 19)):
        density = image(shape)
        particles = run(rt.vtkTransportSampler, density, NumberOfParticles=1500)[0]
        yield f"quality {len(shape)}D", rt.vtkTransportQuality, [particles, density], dict(
            BlockSize=5)
    density = image()
    yield "quality of given points", rt.vtkTransportQuality, [
        with_ghosts(points_in(density), cells=False), density], dict(BlockSize=8)
    yield "quality in usual blocks", rt.vtkTransportQuality, [points_in(density), density], {}
    wide = image((1100, 70))
    yield "quality by tiles", rt.vtkTransportQuality, [points_in(wide), wide], dict(Tables=2)
    for pattern, name in enumerate(PATTERNS):
        yield f"seeds {name}", rt.vtkUniformSeedSource, [], dict(
            Pattern=pattern, Dimension=2 + pattern % 2, NumberOfPoints=4000,
            Bounds=(0.0, 3.0, 1.0, 2.0, -1.0, 2.0))


def parameterization_runs():
    parameterization = rt.vtkAreaPreservingParameterization
    for resolution in (1, 40, 300):
        yield f"parameterization {resolution}", parameterization, [sheet()], dict(
            Resolution=resolution)
    yield "parameterization of quads", parameterization, [sheet(quads=True)], dict(Resolution=64)
    yield "parameterization by flow", parameterization, [sheet()], dict(Resolution=64, Polish=0)
    yield "parameterization of corners", parameterization, [sheet(60, 50)], dict(
        Resolution=64, Corners=[7, 121, 3100, 1952])


def surface_runs():
    sampler = rt.vtkSurfaceSampler
    surface = sheet()
    heights = numpy_to_vtk(values((surface.GetNumberOfPoints(),), 0).astype(np.float32), deep=1)
    heights.SetName("Heights")
    surface.GetPointData().AddArray(heights)
    numbers = numpy_to_vtk(values((surface.GetNumberOfCells(),), 3), deep=1)
    numbers.SetName("Numbers")
    surface.GetCellData().AddArray(numbers)
    for pattern, name in enumerate(PATTERNS):
        yield f"surface {name}", sampler, [surface], dict(
            Method=1, SeedPattern=pattern, NumberOfParticles=2000, RandomSeed=7, Resolution=200)
    yield "surface with a density", sampler, [surface], dict(
        Method=1, NumberOfParticles=2000, Resolution=64, array=(0, 0, 0, 0, "Heights"))
    yield "surface with a density of cells", sampler, [surface], dict(
        Method=1, NumberOfParticles=2000, Resolution=64, Integrator=1, array=(0, 0, 0, 1, "Numbers"))
    yield "surface of quads", sampler, [sheet(quads=True)], dict(Method=1, Resolution=64)
    yield "surface of corners", sampler, [sheet(60, 50)], dict(
        Method=1, Corners=[7, 121, 3100, 1952])
    for iterations in (0, 20):
        yield f"surface relaxed {iterations}", sampler, [surface], dict(
            NumberOfParticles=2000, RelaxationIterations=iterations, RandomSeed=7)
    yield "surface relaxed with a density", sampler, [surface], dict(
        NumberOfParticles=2000, array=(0, 0, 0, 0, "Heights"))
    yield "surface relaxed with a density of cells", sampler, [surface], dict(
        NumberOfParticles=2000, array=(0, 0, 0, 1, "Numbers"))
    yield "surface of quads relaxed", sampler, [sheet(quads=True)], dict(NumberOfParticles=3000)


def relaxation_runs():
    for method, name in enumerate(("gaussian", "transport")):
        yield f"relaxation {name} 2D", rt.vtkBlueNoiseRelaxation, [points_in(image()), image()], dict(
            Method=method, MaximumIterations=4)
        holes = image(array=np.maximum(values((61, 47), 0) - 11.0, 0.0))
        particles = run(rt.vtkTransportSampler, holes, NumberOfParticles=300)[0]
        yield f"relaxation {name} with holes", rt.vtkBlueNoiseRelaxation, [particles, holes], dict(
            Method=method, MaximumIterations=3)
    space = image((23, 17, 19))
    yield "relaxation gaussian 3D", rt.vtkBlueNoiseRelaxation, [points_in(space), space], dict(
        MaximumIterations=4)


def mass_cells_runs():
    cells = rt.vtkEqualMassCells
    lines = image((200,))
    yield "cells of mass 1D", cells, [points_in(lines, 9), lines], dict(Measure=1, Resolution=100)
    turned = image(direction=TURN)
    for shape, name in enumerate(("Flow", "Power")):
        yield f"cells of mass {name}", cells, [points_in(image(), 60), turned], dict(
            Measure=1, Shape=shape, Resolution=90)
    holes = image(array=np.maximum(values((61, 47), 0) - 11.0, 0.0))
    for shape, name in enumerate(("Flow", "Power")):
        yield f"cells of mass with holes {name}", cells, [points_in(image(), 40), holes], dict(
            Measure=1, Shape=shape, Resolution=75)
    space = image((23, 17, 19))
    yield "cells of mass 3D", cells, [points_in(space, 20), space], dict(
        Measure=1, Resolution=24, NormExponent=3.0, CostExponent=1.5, FlowMaps=1)


def digests():
    vtkObject.GlobalWarningDisplayOff()
    found = {}
    ran = set()
    for runs in (sampler_runs, optimal_runs, map_runs, distance_runs, temporal_runs, warp_runs, blend_runs,
                 splat_runs, other_runs, parameterization_runs, surface_runs, relaxation_runs):
        for name, filter_class, inputs, properties in runs():
            assert name not in found, name
            if Devices.asked and not Devices.serve(filter_class):
                continue
            outputs = run(filter_class, *inputs, **properties)
            count = outputs[0].GetNumberOfElements(
                vtkDataObject.ROW if outputs[0].IsA("vtkTable") else vtkDataObject.POINT)
            assert count > 0, name
            if filter_class is rt.vtkAreaPreservingParameterization:
                del outputs[1:]  # which shares its arrays, and has AreaPreservingExact as points
            if filter_class is rt.vtkTransportDistance:
                # Decompositions of Eigen's round as its version does: points, and bounds by moments.
                del outputs[2 if properties.get("Method") else 1:]
            found[name] = Digest(*outputs).text()
            ran.add(filter_class.__name__)
    assert ran == {filter_.class_name for filter_ in FILTERS
                   if not Devices.asked or Devices.serve(getattr(rt, filter_.class_name))}, ran
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--against", default=os.path.join(SOURCE, "Testing", "Data", "digests.json"))
    parser.add_argument("--device", action="store_true", help="of work that OpenCL devices do")
    options = parser.parse_args()
    Devices.asked = options.device
    found = digests()
    if Devices.faults:
        print(f"{len(Devices.faults)} runs without a device: {Devices.faults[0]}")
        return 1 if "RT_OPENCL" in os.environ else 77
    if options.record:
        with open(options.against, "w", encoding="utf-8") as file:
            json.dump(found, file, indent=1)
            file.write("\n")
        print(f"{len(found)} digests recorded in {options.against}")
        return 0
    with open(options.against, encoding="utf-8") as file:
        expected = json.load(file)
    if (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 6):
        expected.update(FROM_VTK_9_6)
    names = found if options.device else {*found, *expected}
    wrong = [name for name in sorted(names) if found.get(name) != expected.get(name)]
    for name in wrong:
        print(f"{name}: {found.get(name)}, expected {expected.get(name)}")
    print(f"{len(found)} runs, {len(wrong)} of other bits than expected")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
