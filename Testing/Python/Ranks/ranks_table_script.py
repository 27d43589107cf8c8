# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksTable.py runs on each rank: filters on distributed images. Each rank writes what it
has of the outputs: a digest of each element, by its place. Further rows are those of give_rows in the
other files ranks_table_*.py."""
import glob
import importlib
import os
import pickle
import sys

from paraview import simple
from ranks_rows import (RANK, gathered, give, give_row, redistributed, refined, tiles, turned,
                        with_ghosts)
from rt_filters import PATTERNS
from rt_testing import load_plugin, producer
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController


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
            particles = simple.SampleDensity(
                Input=density, NumberOfParticles=3000, FlowMaps=maps, **tiled)
            give("%s maps %s" % (name, maps), particles)
        give_row("quality " + name, simple.TransportQuality(
            Input=particles, Density=density, **tiled))
        give(name + " map", simple.TransportMap(
            Input=density, SampleDimensions=[40, 6, 7 if name != "wide" else 1], **tiled))
        give(name + " back", simple.TransportMap(
            Input=density, SampleDimensions=[40, 6, 7 if name != "wide" else 1], Direction="DensityToUniform", **tiled))
    give("long warp", simple.DensityEqualizingWarp(Input=simple.Contour(
        Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[260.0], ComputeNormals=0),
        Density=image, **tiled))


def scattered_torus():
    """Every so many triangles on a rank, with points of their own; its seams close but for rounding."""
    ranks = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(vtkParametricTorus())
    source.SetUResolution(20)
    source.SetVResolution(15)
    source.Update()
    torus = source.GetOutput()
    points, faces = vtkPoints(), vtkCellArray()
    for cell in range(RANK, torus.GetNumberOfCells(), ranks):
        corners = torus.GetCell(cell).GetPoints()
        faces.InsertNextCell(3)
        for corner in range(3):
            faces.InsertCellPoint(points.InsertNextPoint(corners.GetPoint(corner)))
    part = vtkPolyData()
    part.SetPoints(points)
    part.SetPolys(faces)
    return producer(simple, part)


def give_data():
    """Seeds in pieces; densities that are no images; filters that gather their inputs."""
    for pattern in PATTERNS:
        give("uniform " + pattern, simple.UniformSeeds(
            NumberOfPoints=700, Dimension=3 if pattern == "Random" else 2, Pattern=pattern))
    image = simple.Wavelet(WholeExtent=[-4, 8, 0, 7, 0, 10])
    cells = simple.PointDatatoCellData(Input=image, ProcessAllArrays=1)
    meshes = {
        "structured": simple.ImageDatatoPointSet(Input=image),
        "structured cells": simple.ImageDatatoPointSet(Input=cells),
        "mesh": simple.Threshold(Input=cells, Scalars=["CELLS", "RTData"],
                                 LowerThreshold=0, UpperThreshold=1000),
        "ghost mesh": with_ghosts(simple.Threshold(
            Input=cells, Scalars=["CELLS", "RTData"], LowerThreshold=0, UpperThreshold=1000), 1),
        "block": simple.GroupDatasets(Input=[simple.ImageDatatoPointSet(Input=cells)]),
        "amr": simple.AMRGaussianPulseSource(Dimension=3, RootSpacing=0.5),
        "refined": refined(False),
        "flat refined": refined(True),
        "tiles": tiles(),
    }
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8, DensityResolution=12)
    for name, density in meshes.items():
        chosen = dict(DensityArray=["CELLS", "Gaussian-Pulse"]) if name == "amr" else {}
        give("sample " + name, simple.SampleDensity(
            density, NumberOfParticles=400, **chosen, **usual))
        give("map " + name, simple.TransportMap(density, **chosen, **usual))
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    give("equal areas", simple.DensityEqualizingWarp(
        Input=shell, Density=image, EqualizeAreas=1, NegativeValues="Clamp", NumberOfSteps=8))
    give("map of equal areas", simple.TransportMap(
        image, Direction="DensityToUniform", EqualizeAreas=1, NegativeValues="Clamp",
        NumberOfSteps=8))
    give("warp mesh", simple.DensityEqualizingWarp(Input=shell, Density=meshes["mesh"], **usual))
    drum = simple.Cylinder(Resolution=24)  # whole on each rank
    hill = simple.Contour(Input=simple.Wavelet(WholeExtent=[-7, 7] * 3), ComputeNormals=0,
                          ContourBy=["POINTS", "RTData"], Isosurfaces=[220.0])
    for name, surface in (("drum", drum), ("hill", hill),
                          ("hill apart", simple.ExtractSurface(
                              Input=redistributed(Input=hill))),
                          ("ball", simple.Sphere(ThetaResolution=24)),
                          ("ball apart", simple.ExtractSurface(
                              Input=redistributed(Input=simple.Sphere(ThetaResolution=24)))),
                          ("torus by triangles", scattered_torus())):
        for association in ("Points", "Cells"):
            give("solid %s %s" % (name, association), simple.SolidDensity(
                Input=surface, Resolution=14, Association=association))
    give("solid slice", simple.Slice(Input=simple.SolidDensity(Input=drum, Resolution=14)))
    sites = simple.UniformSeeds(NumberOfPoints=40)
    relaxed = simple.UniformSeeds(NumberOfPoints=90, Dimension=3, Bounds=[-4, 8, 0, 7, 0, 10])
    give("relaxed", simple.RelaxBlueNoise(
        Input=relaxed, Density=image, MaximumIterations=3, NegativeValues="Clamp"))
    give("relaxed by mesh", simple.RelaxBlueNoise(
        Input=relaxed, Density=meshes["block"], MaximumIterations=3, NegativeValues="Clamp",
        DensityResolution=12))
    flat = simple.ExtractSubset(Input=image, VOI=[-4, 8, 0, 7, 3, 3])
    for name, options in (("", {}), (" on", dict(Domain=flat)),
                          (" by mass", dict(Domain=flat, Measure="Density",
                                            NegativeValues="Clamp")),
                          (" by power", dict(Domain=flat, Shape="Power"))):
        divided = simple.EqualMassCells(Input=sites, Resolution=40, **options)
        for port, output in enumerate(("labels", "sites", "outlines")):
            give(output + name, divided, port)
    give("few labels", simple.EqualMassCells(
        Input=simple.UniformSeeds(NumberOfPoints=2), Resolution=3))
    plane = simple.Plane(XResolution=9, YResolution=7)
    give("surface", simple.SampleSurface(Input=plane, Resolution=24, NumberOfParticles=200))
    mapped = simple.AreaPreservingParameterization(Input=plane, Resolution=24)
    give("parameterization", mapped)
    give("parameterization laid flat", mapped, 1)
    cut = simple.ExtractSurface(Input=redistributed(Input=plane))
    give("surface apart", simple.SampleSurface(Input=cut, Resolution=24, NumberOfParticles=200))
    give("parameterization apart", simple.AreaPreservingParameterization(Input=cut, Resolution=24))


def give_optimal(image, flat, seeds):
    """Each rank solves, and moves its share."""
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    for name, choice in (("optimal", dict(Method="Optimal")),
                         ("certified", dict(Certify=1, NumberOfSteps=8))):
        choice["NegativeValues"] = "Clamp"
        give("sample " + name, simple.SampleDensity(Input=image, NumberOfParticles=500, **choice))
        give("sample flat " + name, simple.SampleDensity(
            Input=flat, NumberOfParticles=3000, **choice))
        give("seeds " + name, simple.SampleDensity(Input=image, Seeds=seeds, **choice))
        give("paths " + name, simple.SampleDensity(
            Input=image, NumberOfParticles=40, OutputPaths=1, SampleArrays=0, **choice))
        for direction in ("UniformToDensity", "DensityToUniform"):
            give("map %s %s" % (direction, name), simple.TransportMap(
                Input=image, Direction=direction, **choice))
        give("warp " + name, simple.DensityEqualizingWarp(Input=shell, Density=image, **choice))
    give("equal areas optimal", simple.DensityEqualizingWarp(
        Input=shell, Density=image, EqualizeAreas=1, NegativeValues="Clamp", Method="Optimal"))


def main(path):
    load_plugin()
    image = simple.Wavelet(WholeExtent=[-4, 8, 0, 7, 0, 10])
    cells = simple.PointDatatoCellData(Input=image, ProcessAllArrays=1)
    flat = simple.ExtractSubset(Input=image, VOI=[-4, 8, 3, 3, 0, 10])
    ghosts = with_ghosts(image, 2)
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
    hidden = simple.Calculator(
        Input=cells, Function="2*(coordsX^2 + coordsY^2 < 9)", AttributeType="Point Data",
        ResultArrayName="vtkGhostType", ResultArrayType="Unsigned Char")
    inputs["hidden"] = hidden
    for tables in ("Whole", "Tiled"):  # the largest values are hidden
        give("hidden points " + tables, simple.SampleDensity(
            Input=hidden, NumberOfParticles=500, InvertDensity=1, Tables=tables, NumberOfSteps=32,
            DensityArray=["CELLS", "RTData"]))
    give("paths", simple.SampleDensity(
        Input=cells, NumberOfParticles=60, OutputPaths=1, SampleArrays=0, **usual))
    give("paths of seeds", simple.SampleDensity(
        Input=image, Seeds=simple.Calculator(Input=seeds, Function="coordsX + coordsY",
                                             ResultArrayName="Begin"), OutputPaths=1, **usual))
    give("early", simple.SampleDensity(Input=image, NumberOfParticles=300, FlowTime=0.5, **usual))
    give("cell grid", simple.SampleDensity(
        Input=cells, SamplesPerCell=1, SeedPattern="Jittered", **usual))
    give("seeds", simple.SampleDensity(Input=image, Seeds=seeds, **usual))
    give("map back", simple.TransportMap(Input=image, Direction="DensityToUniform", **usual))
    give("map coarse", simple.TransportMap(Input=cells, SampleDimensions=[5, 7, 3], **usual))
    give("map tiled", simple.TransportMap(Input=image, Tables="Tiled", NegativeValues="Clamp",
                                          NumberOfSteps=32))
    steep = simple.Calculator(Input=image, Function="if(coordsX^2 + coordsY^2 < 9, 1000, 1)",
                              ResultArrayName="Steep")
    folds = dict(DensityArray=["POINTS", "Steep"], NumberOfSteps=6)
    give("map folds", simple.TransportMap(Input=steep, **folds))
    give("map folds back", simple.TransportMap(Input=steep, Direction="DensityToUniform", **folds))
    give("map folds tiled", simple.TransportMap(
        Input=steep, Direction="DensityToUniform", Tables="Tiled",
        **dict(folds, NumberOfSteps=32)))
    give("warp of volumes", simple.DensityEqualizingWarp(
        Input=with_ghosts(simple.Threshold(Input=steep, Scalars=["POINTS", "RTData"],
                                           LowerThreshold=-1000, UpperThreshold=1000), 1),
        Density=steep, **folds))
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    give("warp", simple.DensityEqualizingWarp(Input=shell, Density=image, **usual))
    give("warp cells", simple.DensityEqualizingWarp(Input=shell, Density=cells, **usual))
    give_optimal(image, flat, seeds)
    give("seeds apart", simple.SampleDensity(
        Input=image, Seeds=redistributed(Input=seeds), **usual))
    field = simple.TransportMap(Input=image, **usual)
    give("contour", simple.Contour(Input=field, ContourBy=["POINTS", "Divergence"],
                                   Isosurfaces=[0.0], ComputeNormals=0))
    give("slice", simple.Slice(Input=field))
    give("threshold", simple.Threshold(Input=simple.SampleDensity(
        Input=image, NumberOfParticles=400, **usual), Scalars=["POINTS", "RTData"],
        LowerThreshold=150, UpperThreshold=1000))
    for name, density in (("turned points", turned(image)), ("turned cells", turned(cells))):
        give("sample " + name, simple.SampleDensity(density, NumberOfParticles=300, **usual))
        give("map " + name, simple.TransportMap(density, **usual))
        give("warp " + name, simple.DensityEqualizingWarp(
            Input=simple.UniformSeeds(NumberOfPoints=80, Dimension=3, Bounds=[0, 10, -4, 8, -7, 0]),
            Density=density, **usual))
    give_tiled()
    give_data()
    for file in sorted(glob.glob("ranks_table_*.py", root_dir=os.path.dirname(__file__))):
        if file != os.path.basename(__file__):
            importlib.import_module(file[:-3]).give_rows(inputs)
    with open("%s.%d" % (path, RANK), "wb") as file:
        pickle.dump(gathered, file)
    print("WROTE", RANK, flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
