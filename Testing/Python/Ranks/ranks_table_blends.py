# SPDX-License-Identifier: BSD-3-Clause
"""Rows of TestRanksTable.py: filters that take several densities."""
from paraview import servermanager, simple
from ranks_rows import give, give_both, give_tables, with_ghosts


def give_rows(_inputs):
    give_blends()
    give_targets()
    give_distances()


def morph(**properties):
    simple.SetActiveSource(None)  # whose arrays would be the defaults of a new filter
    return simple.MorphDensities(**properties)


def barycenter(**properties):
    simple.SetActiveSource(None)
    return simple.DensityBarycenter(**properties)


def transport_map(**properties):
    simple.SetActiveSource(None)
    return simple.TransportMap(**properties)


def give_distances():
    """More pairs than ranks and fewer; points and cells, other resolutions, a mesh, kept ones."""
    whole = [-4, 8, 0, 7, 0, 10]
    images = [simple.Wavelet(WholeExtent=whole, Center=[x, 1, 2], Maximum=300) for x in range(5)]
    simple.SetActiveSource(None)
    usual = dict(NegativeValues="Clamp")
    for method in ("Linearized", "Certified"):
        give_tables("distances two " + method, simple.TransportDistance(
            Input=images[:2], Method=method, **usual))
        several = simple.TransportDistance(Input=images[:4], Method=method, **usual)
        give_tables("distances " + method, several)
        several.Input = images[::-1]
        give_tables("distances and one more " + method, several)
        flat = [simple.ExtractSubset(Input=image, VOI=[-4, 8, 3, 3, 0, 10]) for image in images[:3]]
        give_tables("distances flat " + method, simple.TransportDistance(
            Input=[with_ghosts(flat[0], 1), *flat], Method=method, **usual))
        cells = [simple.PointDatatoCellData(Input=image, ProcessAllArrays=1) for image in images[:3]]
        mesh = simple.Threshold(Input=cells[0], Scalars=["CELLS", "RTData"], LowerThreshold=0,
                                UpperThreshold=1000)
        give_tables("distances mesh " + method, simple.TransportDistance(
            Input=[mesh, *cells], Method=method, **usual))


def give_targets():
    """Maps from one density to another: points, cells, other boxes and data, tiles, both directions."""
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    whole = [-4, 8, 0, 7, 0, 10]
    image = simple.Wavelet(WholeExtent=whole)
    other = simple.Wavelet(WholeExtent=whole, StandardDeviation=0.2, XFreq=20, Center=[4, 1, 2])
    cells = simple.PointDatatoCellData(Input=image, ProcessAllArrays=1)
    flat, other_flat = (simple.ExtractSubset(Input=density, VOI=[-4, 8, 3, 3, 0, 10])
                        for density in (image, other))
    long = simple.Wavelet(WholeExtent=[-2, 3, -2, 3, 0, 21], StandardDeviation=0.3)
    mesh = simple.Threshold(Input=cells, Scalars=["CELLS", "RTData"], LowerThreshold=0,
                            UpperThreshold=1000)
    inputs = {"points": (image, other), "flat": (flat, other_flat), "geometries": (cells, long),
              "twice": (image, image), "wider": (with_ghosts(other, 2), other), "mesh": (cells, mesh),
              "from mesh": (mesh, image)}
    for name, (source, target) in inputs.items():
        for direction in ("UniformToDensity", "DensityToUniform"):
            give("map to %s %s" % (name, direction), transport_map(
                Input=source, Target=target, Direction=direction, **usual))
    for name, choice in (("optimal", dict(Method="Optimal")), ("certified", dict(Certify=1, NumberOfSteps=8))):
        for kind, source, target in (("", cells, long), (" flat", flat, other_flat)):
            give("map to %s%s" % (name, kind), transport_map(
                Input=source, Target=target, NegativeValues="Clamp", **choice))
    give("map to coarse", transport_map(Input=cells, Target=long, SampleDimensions=[5, 7, 3], **usual))
    field = transport_map(Input=image, Target=other, **usual)
    give("costs contour", simple.Contour(Input=field, ContourBy=["POINTS", "CostDensity"],
                                            Isosurfaces=[0.001], ComputeNormals=0))
    give("costs slice", simple.Slice(Input=field))
    far = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[200, 10, 10],
                         StandardDeviation=2)
    near = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[100, 10, 10])
    give("map to tiles", transport_map(Input=far, Target=near, Tables="Tiled", NegativeValues="Clamp",
                                       SampleDimensions=[40, 6, 7]))


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
    wider = with_ghosts(other, 2)
    inputs = {"points": (image, other), "cells": (cells, other_cells),
              "flat": (flat, other_flat), "geometries": (image, long), "mixed": (cells, long),
              "twice": (image, image), "wider": (other, wider), "wider first": (wider, other)}
    for name, (source, target) in inputs.items():
        give_both("morph " + name, morph(Input=source, Target=target, Parameter=0.3, **usual))
    for parameter in (0.0, 0.03, 0.98, 1.0):
        for name in ("points", "flat", "mixed", "wider"):
            source, target = inputs[name]
            give_both("morph %s %g" % (name, parameter), morph(
                Input=source, Target=target, Parameter=parameter, **usual))
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
    # Of a barycenter each tenth of the tolerance takes several more rounds of solves.
    for name, choice, mean in (("optimal", dict(Method="Optimal"), dict(OptimalityTolerance=0.1)),
                               ("certified", dict(Certify=1), {})):
        give_both("morph " + name, morph(Input=image, Target=other, **choice, **usual))
        give_both("morph geometries " + name, morph(Input=cells, Target=long, **choice, **usual))
        give_both("barycenter " + name, barycenter(
            Input=[image, other], Weights=[1, 2], **choice, **mean, **usual))
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
    give("morph contour", simple.Contour(Input=behind, ContourBy=["POINTS", "RTData"],
                                         Isosurfaces=[120.0], ComputeNormals=0))
    give("morph slice", simple.Slice(Input=behind))
    give("morph threshold", simple.Threshold(
        Input=servermanager.OutputPort(behind, 1), Scalars=["POINTS", "SourcePosition"],
        LowerThreshold=1, UpperThreshold=1000))
