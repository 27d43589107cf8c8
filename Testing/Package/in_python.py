# SPDX-License-Identifier: BSD-3-Clause
"""Run by python3 where the package is installed: its classes without ParaView's pipeline. The argument
is a photograph."""
import sys

import rectifiedtransport
from rectifiedtransport import vtkTransportSampler
from vtkmodules.vtkIOImage import vtkPNGReader

assert rectifiedtransport.__file__.startswith("/usr/lib/python3/dist-packages/"), rectifiedtransport.__file__
reader = vtkPNGReader()
reader.SetFileName(sys.argv[1])
sampler = vtkTransportSampler()
sampler.SetInputConnection(reader.GetOutputPort())
sampler.InvertDensityOn()
sampler.SetNumberOfParticles(2000)
sampler.Update()
dots = sampler.GetOutput()
assert dots.GetNumberOfPoints() == 2000, dots.GetNumberOfPoints()
width, height, _ = reader.GetOutput().GetDimensions()
low_x, high_x, low_y, high_y, _, _ = dots.GetBounds()
assert -.5 <= low_x < high_x <= width - .5 and -.5 <= low_y < high_y <= height - .5, dots.GetBounds()
between = rectifiedtransport.arrays.morph([[1, 0, 0]] * 3, [[0, 0, 1]] * 3)
assert between.shape == (3, 3) and abs(between.sum() - 3) < 1e-9, between
print("2000 particles,", rectifiedtransport.__version__)
