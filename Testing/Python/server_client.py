# SPDX-License-Identifier: BSD-3-Clause
"""What TestServer.py runs as the client of a server: image filters that fail, before they were ever
shown and after, with filters downstream, and are corrected."""
import os
import sys

from paraview import simple

simple.Connect("localhost", int(sys.argv[1]))
for remote in (True, False):
    simple.LoadPlugin(os.environ["RT_PLUGIN"], remote=remote, ns=vars(simple))
view = simple.CreateView("RenderView", ViewSize=[64, 64])


def points_shown(proxy):
    simple.Render(view)
    return proxy.GetDataInformation().GetNumberOfPoints()


def check(name, proxy, prop, wrong, right):
    """From the start wrong, then right, then wrong again with a filter downstream."""
    setattr(proxy, prop, wrong)
    simple.Show(proxy, view)
    counts = [points_shown(proxy)]
    setattr(proxy, prop, right)
    counts.append(points_shown(proxy))
    setattr(proxy, prop, wrong)
    counts.append(points_shown(proxy))
    downstream = simple.Contour(Input=proxy)
    simple.Show(downstream, view)
    counts.append(points_shown(downstream))
    setattr(proxy, prop, right)
    counts.append(points_shown(proxy))
    simple.Delete(downstream)
    setattr(proxy, prop, wrong)
    counts.append(points_shown(proxy))
    simple.Hide(proxy, view)
    print("CHECK", name, [count > 0 for count in counts], flush=True)


def wavelet():
    return simple.Wavelet(WholeExtent=[-4, 4] * 3)


SHORT = dict(NegativeValues="Clamp", NumberOfSteps=2)
check("splat", simple.SplatMass(Input=simple.Sphere(), Dimensions=[9, 9, 9]), "Radius", 0, 1)
check("solid", simple.SolidDensity(Input=simple.Sphere(), Resolution=9), "Supersampling", 99, 2)
check("cells", simple.EqualMassCells(Input=simple.Sphere(), Resolution=9), "NormExponent", 0, 2)
check("map", simple.TransportMap(Input=wavelet(), **SHORT), "NumberOfSteps", 0, 2)
check("morph", simple.MorphDensities(Input=wavelet(), Target=wavelet(), **SHORT), "Parameter", 2,
      0.5)
check("barycenter", simple.DensityBarycenter(Input=[wavelet(), wavelet()], **SHORT),
      "ParticlesPerCell", 0, 1)
check("sampler", simple.SampleDensity(Input=wavelet(), NumberOfParticles=99, **SHORT),
      "NumberOfSteps", 0, 2)
simple.Disconnect()
