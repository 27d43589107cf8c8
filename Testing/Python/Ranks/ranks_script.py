# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanks.py runs on each rank: pipelines whose data lie on both ranks, on one, or whole on
each. The first rank prints what the filters gave, all their errors."""
from paraview import simple
from rt_proxies import proxies
from rt_testing import Listener, load_plugin
from TestRanks import cases
from vtkmodules.vtkParallelCore import vtkMultiProcessController

load_plugin()
controller = vtkMultiProcessController.GetGlobalController()
rank = controller.GetLocalProcessId()


def image():
    return simple.Wavelet(WholeExtent=[-5, 5] * 3)


def apart(source):
    return simple.RedistributeDataSet(Input=source)


def sphere():
    return simple.Sphere(ThetaResolution=20)


def plane():
    return simple.Plane(XResolution=8, YResolution=8)


def closed_apart():
    return simple.Contour(Input=simple.Wavelet(WholeExtent=[-7, 7] * 3),
                          ContourBy=["POINTS", "RTData"], Isosurfaces=[220.0], ComputeNormals=0)


def regions(source=simple.Plane):
    return simple.Calculator(Input=source(), AttributeType="Cell Data", ResultArrayName="Mass", Function="3")


WHOLE = {"density": image, "densities": lambda: [image(), image()], "image": image,
         "disk": simple.Plane, "solid": simple.Sphere, "map": regions,
         "points": lambda: simple.UniformSeeds(NumberOfPoints=500, Dimension=3)}
SHARED = {"disk": lambda: simple.ExtractSurface(Input=apart(plane())), "solid": closed_apart,
          "points": lambda: apart(sphere()),
          "map": lambda: regions(lambda: simple.ExtractSurface(Input=apart(plane())))}
GATHERED = {"points": lambda: simple.RedistributeDataSet(Input=sphere(), NumberOfPartitions=1)}
PLACES = {"whole": WHOLE, "shared": SHARED, "gathered": GATHERED}


PROPERTIES = {proxy.label: proxy.properties for proxy in proxies()}
SHORT = dict(NumberOfSteps=2, NegativeValues="Clamp", Resolution=16)


def run(name, proxy):
    errors = Listener(proxy.GetClientSideObject()).errors
    proxy.UpdatePipeline()
    data = proxy.GetDataInformation()
    count = max(data.GetNumberOfPoints(), data.GetNumberOfRows())
    different = any("not the same on rank 0 and on rank" in error for error in errors)
    if rank == 0:
        print("GAVE", name, ("some" if count else "none") + (" error" if different else ""), flush=True)


for filter_, case, place, optional in cases():
    sources = {**WHOLE, **PLACES[place.split()[-1]]}
    if place.startswith("block of"):
        sources["points"] = lambda points=sources["points"]: simple.GroupDatasets(Input=[points()])
    sources["mesh"] = sources["points"]
    properties = {name: value for name, value in SHORT.items()
                  if name in PROPERTIES[filter_.label]}
    run(case, filter_.make(simple, sources, optional, **properties))
