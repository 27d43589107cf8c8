# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvpython or pvbatch where the package is installed: ParaView has loaded the plugin by itself.
With a port as argument: the pvserver there, too. With a path: python3, where the plugin has to be
loaded."""
import sys

from paraview.simple import *

if len(sys.argv) > 1 and sys.argv[1].isdigit():
    Connect("localhost", int(sys.argv[1]))
elif len(sys.argv) > 1:
    assert "SampleDensity" not in globals(), "python3 needs no LoadPlugin any more: say so in README.Debian"
    LoadPlugin(sys.argv[1], remote=False, ns=globals())

for name in ["AreaPreservingParameterization", "DensityBarycenter", "DensityEqualizingWarp", "EqualMassCells",
             "MorphDensities", "RelaxBlueNoise", "SampleDensity", "SampleSurface", "SolidDensity", "SplatMass",
             "TransportMap", "TransportQuality", "UniformSeeds"]:
    assert name in globals(), f"{name} is not there: the plugin is not loaded"

wavelet = Wavelet()
dots = SampleDensity(Input=wavelet, NumberOfParticles=2000)
points = servermanager.Fetch(dots)
assert points.GetNumberOfPoints() == 2000, points.GetNumberOfPoints()
assert all(-10 <= value <= 10 for value in points.GetBounds()), points.GetBounds()
# Particles are where there is more of RTData than in the mean over the box.
values = points.GetPointData().GetArray("RTData")
mean = sum(values.GetValue(i) for i in range(2000)) / 2000
box = IntegrateVariables(Input=wavelet)
integral = servermanager.Fetch(box).GetPointData().GetArray("RTData").GetValue(0)
assert mean > 1.05 * integral / 20**3, (mean, integral / 20**3)
print("2000 particles, mean RTData", round(mean, 2), "against", round(integral / 20**3, 2))
