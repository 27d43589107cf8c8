# SPDX-License-Identifier: BSD-3-Clause
"""Run by python3 where the package is installed: its classes without ParaView's pipeline."""
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

import rectifiedtransport
from rectifiedtransport import vtkTransportSampler

assert rectifiedtransport.__file__.startswith("/usr/lib/python3/dist-packages/"), rectifiedtransport.__file__
sampler = vtkTransportSampler()
source = vtkRTAnalyticSource()
sampler.SetInputConnection(source.GetOutputPort())
sampler.SetNumberOfParticles(2000)
sampler.Update()
assert sampler.GetOutput().GetNumberOfPoints() == 2000
print("2000 particles,", rectifiedtransport.__version__)
