# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanks.py runs on each rank: pipelines whose data lie on both ranks, on one, or whole on
each. The first rank prints what the filters gave, all their errors."""
from paraview import simple
from rt_testing import Listener, load_plugin
from vtkmodules.vtkParallelCore import vtkMultiProcessController

load_plugin()
controller = vtkMultiProcessController.GetGlobalController()
rank = controller.GetLocalProcessId()


def whole_points():
    return simple.UniformSeeds(NumberOfPoints=500, Dimension=3)


def shared_points():
    return simple.RedistributeDataSet(Input=simple.Sphere(ThetaResolution=20))


def shared_surface(of):
    return simple.ExtractSurface(Input=simple.RedistributeDataSet(Input=of))


def gathered_points():
    return simple.RedistributeDataSet(Input=simple.Sphere(ThetaResolution=20),
                                      NumberOfPartitions=1)


def image():
    return simple.Wavelet(WholeExtent=[-5, 5] * 3)


def run(name, proxy):
    errors = Listener(proxy.GetClientSideObject()).errors
    proxy.UpdatePipeline()
    data = proxy.GetDataInformation()
    count = max(data.GetNumberOfPoints(), data.GetNumberOfRows())
    different = any("not the same on rank 0 and on rank" in error for error in errors)
    if rank == 0:
        print("GAVE", name, ("some" if count else "none") + (" error" if different else ""), flush=True)


SHORT = dict(NumberOfSteps=2, NegativeValues="Clamp")
for kind, points in (("whole", whole_points), ("shared", shared_points),
                     ("gathered", gathered_points)):
    run("splat %s" % kind, simple.SplatMass(Input=points(), Dimensions=[8, 8, 8]))
    run("cells %s" % kind, simple.EqualMassCells(Input=points(), Resolution=16))
    run("seeds %s" % kind,
        simple.SampleDensity(Input=image(), Seeds=points(), **SHORT))
    run("quality %s" % kind, simple.TransportQuality(Input=points(), Density=image(),
                                                     NegativeValues="Clamp"))
    run("relaxation %s" % kind, simple.RelaxBlueNoise(
        Input=points(), Density=image(), MaximumIterations=2, NegativeValues="Clamp"))
    run("reference %s" % kind, simple.SplatMass(Input=points(), Reference=image()))
    run("domain %s" % kind, simple.EqualMassCells(Input=points(), Domain=image(), Resolution=16))
    run("block %s" % kind, simple.SplatMass(Input=simple.GroupDatasets(Input=[points()]),
                                            Dimensions=[8, 8, 8]))
run("morph", simple.MorphDensities(Input=image(), Target=image(), **SHORT))
run("barycenter", simple.DensityBarycenter(Input=[image(), image()], **SHORT))
run("map", simple.TransportMap(Input=image(), **SHORT))
run("warp", simple.DensityEqualizingWarp(Input=shared_points(), Density=image(), **SHORT))
run("solid", simple.SolidDensity(Input=simple.Sphere(), Resolution=12))
run("parameterization", simple.AreaPreservingParameterization(Input=simple.Plane(), Resolution=12))
run("surface", simple.SampleSurface(Input=simple.Plane(), Resolution=12))
plane = simple.Plane(XResolution=8, YResolution=8)
run("surface shared", simple.SampleSurface(Input=shared_surface(plane), Resolution=12))
run("parameterization shared", simple.AreaPreservingParameterization(
    Input=shared_surface(plane), Resolution=12))
run("solid shared", simple.SolidDensity(
    Input=simple.Contour(Input=simple.Wavelet(WholeExtent=[-7, 7] * 3),
                         ContourBy=["POINTS", "RTData"], Isosurfaces=[220.0], ComputeNormals=0),
    Resolution=12))
