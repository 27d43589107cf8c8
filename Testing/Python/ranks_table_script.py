# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksTable.py runs on each rank: filters on distributed images. Each rank writes what it
has of the outputs: a digest of each element, by its place."""
import pickle
import sys
import zlib

import numpy as np
from paraview import servermanager, simple
from rt_testing import load_plugin
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkParallelCore import vtkMultiProcessController

GHOSTS = "vtkGhostType"
RANK = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
gathered = {}


def digests(data, owner):
    """Of each point or cell that is no ghost, by its first point and number of points."""
    attributes = data.GetAttributes(owner)
    arrays = [attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())]
    ghosts = [array for array in arrays if array.GetName() == GHOSTS]
    arrays = sorted((array for array in arrays if array.GetName() != GHOSTS),
                    key=lambda array: array.GetName())
    found = []
    if owner == vtkDataObject.CELL and not arrays:
        return found, []
    for i in range(data.GetNumberOfElements(owner)):
        if ghosts and vtk_to_numpy(ghosts[0])[i] & 1:
            continue
        places = [i] if owner == vtkDataObject.POINT else [
            data.GetCell(i).GetPointId(k) for k in range(data.GetCell(i).GetNumberOfPoints())]
        place = b"".join(np.array(data.GetPoint(k)).tobytes() for k in places)
        values = b"".join(np.array(array.GetTuple(i)).tobytes() for array in arrays)
        found.append((place, zlib.crc32(values)))
    return found, [(array.GetName(), array.GetNumberOfComponents()) for array in arrays]


def give(name, proxy, port=0):
    proxy.UpdatePipeline()
    data = proxy.GetClientSideObject().GetOutputDataObject(port)
    fields = {array.GetName(): array.GetTuple(0) for array in (
        data.GetFieldData().GetArray(i) for i in range(data.GetFieldData().GetNumberOfArrays()))}
    gathered[name] = {"fields": fields, "points": digests(data, vtkDataObject.POINT),
                      "cells": digests(data, vtkDataObject.CELL)}


def give_tiled():
    """Of several tiles, and of a density that is empty in most places."""
    image = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[200, 10, 10],
                           StandardDeviation=2)
    sparse = simple.Calculator(Input=image, Function="(RTData > 270) * RTData",
                               ResultArrayName="Ink")
    tiled = dict(Tables="Tiled", NegativeValues="Clamp")
    wide = simple.ExtractSubset(Input=simple.Wavelet(WholeExtent=[0, 2100, 0, 900, 0, 1]),
                                VOI=[0, 2100, 0, 900, 0, 0])
    for name, density in (("long", image), ("sparse", sparse), ("wide", wide)):
        for maps in ("On", "Off"):
            give("%s maps %s" % (name, maps), simple.SampleDensity(
                Input=density, NumberOfParticles=3000, FlowMaps=maps, **tiled))
        give(name + " map", simple.TransportMap(
            Input=density, SampleDimensions=[40, 6, 7 if name != "wide" else 1], **tiled))
        give(name + " back", simple.TransportMap(
            Input=density, SampleDimensions=[40, 6, 7 if name != "wide" else 1], Direction="DensityToUniform", **tiled))
    give("long warp", simple.DensityEqualizingWarp(Input=simple.Contour(
        Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[260.0], ComputeNormals=0),
        Density=image, **tiled))


def give_both(name, proxy):
    give(name, proxy)
    give(name + " particles", proxy, 1)


def morph(**properties):
    simple.SetActiveSource(None)  # whose arrays would be the defaults of a new filter
    return simple.MorphDensities(**properties)


def barycenter(**properties):
    simple.SetActiveSource(None)
    return simple.DensityBarycenter(**properties)


def give_blends():
    """Of densities on points and cells, of one geometry and of several."""
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    whole = [-4, 8, 0, 7, 0, 10]
    image = simple.Wavelet(WholeExtent=whole)
    other = simple.Wavelet(WholeExtent=whole, StandardDeviation=0.2, XFreq=20, Center=[4, 1, 2])
    cells, other_cells = (simple.PointDatatoCellData(Input=density, ProcessAllArrays=1)
                          for density in (image, other))
    flat, other_flat = (simple.ExtractSubset(Input=density, VOI=[-4, 8, 3, 3, 0, 10])
                        for density in (image, other))
    long = simple.Wavelet(WholeExtent=[-2, 3, -2, 3, 0, 21], StandardDeviation=0.3)
    # A source that is asked for two pieces.
    wider = simple.GhostCellsGenerator(Input=other, BuildIfRequired=0, MinimumNumberOfGhosts=2)
    inputs = {"points": (image, other), "cells": (cells, other_cells),
              "flat": (flat, other_flat), "geometries": (image, long), "mixed": (cells, long),
              "twice": (image, image), "wider": (other, wider), "wider first": (wider, other)}
    for name, (source, target) in inputs.items():
        give_both("morph " + name, morph(Input=source, Target=target, Parameter=0.3, **usual))
    for count in (2, 3, 4, 8):
        give_both("morph of %d" % count, morph(
            Input=image, Target=long, ParticlesPerCell=count, **usual))
    for mode in ("Geometric", "Source", "Normalize"):
        give_both("morph " + mode, morph(Input=image, Target=other, MassMode=mode, **usual))
    for tables in ("Tiled", "Whole"):
        for count in (1, 3):
            give_both("morph %s %d" % (tables, count), morph(
                Input=cells, Target=long, Tables=tables, ParticlesPerCell=count,
                NegativeValues="Clamp", NumberOfSteps=32))
    far = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[200, 10, 10],
                         StandardDeviation=2)
    near = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[100, 10, 10])
    for maps in ("On", "Off"):
        give_both("morph tiles maps " + maps, morph(
            Input=far, Target=near, Tables="Tiled", FlowMaps=maps, Dimensions=[60, 6, 7],
            ParticlesPerCell=2, NegativeValues="Clamp"))
    sparse = simple.Calculator(Input=other, Function="(RTData > 150) * RTData",
                               ResultArrayName="RTData")
    give_both("morph sparse", morph(
        Input=image, Target=sparse, NegativeValues="Clamp", NumberOfSteps=2, Integrator="Euler"))
    give_both("morph coarse", morph(
        Input=image, Target=other, Dimensions=[5, 4, 3], Kernel="Gaussian", **usual))
    series = morph(Input=image, Target=long, PublishTime=1, NumberOfTimeSteps=4, **usual)
    for time in (0.0, 1 / 3, 1.0):
        series.UpdatePipeline(time)
        give_both("morph at %.2f" % time, series)
    mean = barycenter(Input=[image, other, long], Weights=[1, 2, 0.5], **usual)
    give_both("barycenter", mean)
    mean.Weights = [0, 2, 1]
    give_both("barycenter again", mean)
    give_both("barycenter blocks", barycenter(
        Input=simple.GroupDatasets(Input=[image, other, long]), ParticlesPerCell=2, **usual))
    behind = morph(Input=image, Target=other, **usual)
    give("morph contour", simple.Contour(Input=behind, ContourBy=["POINTS", "Density"],
                                         Isosurfaces=[120.0], ComputeNormals=0))
    give("morph slice", simple.Slice(Input=behind))
    give("morph threshold", simple.Threshold(
        Input=servermanager.OutputPort(behind, 1), Scalars=["POINTS", "SourcePosition"],
        LowerThreshold=1, UpperThreshold=1000))


def main(path):
    load_plugin()
    image = simple.Wavelet(WholeExtent=[-4, 8, 0, 7, 0, 10])
    cells = simple.PointDatatoCellData(Input=image, ProcessAllArrays=1)
    flat = simple.ExtractSubset(Input=image, VOI=[-4, 8, 3, 3, 0, 10])
    ghosts = simple.GhostCellsGenerator(Input=image, BuildIfRequired=0,
                                        MinimumNumberOfGhosts=2)
    inputs = {"points": image, "cells": cells, "flat": flat, "ghosts": ghosts}
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    seeds = simple.UniformSeeds(NumberOfPoints=300, Dimension=3, Pattern="Jittered")
    for name, density in inputs.items():
        give("sample " + name, simple.SampleDensity(
            Input=density, NumberOfParticles=500, **usual))
        give("map " + name, simple.TransportMap(Input=density, **usual))
    give("tiled", simple.SampleDensity(Input=image, NumberOfParticles=500, Tables="Tiled",
                                       NegativeValues="Clamp", NumberOfSteps=32))
    give("few", simple.SampleDensity(Input=image, NumberOfParticles=2, **usual))
    give("paths", simple.SampleDensity(
        Input=cells, NumberOfParticles=60, OutputPaths=1, SampleArrays=0, **usual))
    give("early", simple.SampleDensity(Input=image, NumberOfParticles=300, FlowTime=0.5, **usual))
    give("cell grid", simple.SampleDensity(
        Input=cells, SamplesPerCell=1, SeedPattern="Jittered", **usual))
    give("seeds", simple.SampleDensity(Input=image, Seeds=seeds, **usual))
    give("map back", simple.TransportMap(Input=image, Direction="DensityToUniform", **usual))
    give("map coarse", simple.TransportMap(Input=cells, SampleDimensions=[5, 7, 3], **usual))
    give("map tiled", simple.TransportMap(Input=image, Tables="Tiled", NegativeValues="Clamp",
                                          NumberOfSteps=32))
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    give("warp", simple.DensityEqualizingWarp(Input=shell, Density=image, **usual))
    give("warp cells", simple.DensityEqualizingWarp(Input=shell, Density=cells, **usual))
    give("seeds apart", simple.SampleDensity(
        Input=image, Seeds=simple.RedistributeDataSet(Input=seeds), **usual))
    field = simple.TransportMap(Input=image, **usual)
    give("contour", simple.Contour(Input=field, ContourBy=["POINTS", "Divergence"],
                                   Isosurfaces=[0.0], ComputeNormals=0))
    give("slice", simple.Slice(Input=field))
    give("threshold", simple.Threshold(Input=simple.SampleDensity(
        Input=image, NumberOfParticles=400, **usual), Scalars=["POINTS", "RTData"],
        LowerThreshold=150, UpperThreshold=1000))
    give_tiled()
    give_blends()
    with open("%s.%d" % (path, RANK), "wb") as file:
        pickle.dump(gathered, file)
    print("WROTE", RANK, flush=True)


main(sys.argv[1])
