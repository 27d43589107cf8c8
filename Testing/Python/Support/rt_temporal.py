# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of Transport Temporal Interpolator share: a series of blobs that move, and the filter."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from rt_testing import load_plugin

simple = load_plugin()
import rectifiedtransport

N = 48


def blob(x, y, width=5.0, n=N, height=1.0):
    c = np.arange(n) + 0.5
    values = height * np.exp(-((c[None, :] - x) ** 2 + (c[:, None] - y) ** 2) / (2 * width ** 2))
    return np.where(values > 1e-4 * height, values, 0)


def interpolator(series, **properties):
    algorithm = rectifiedtransport.vtkRectifiedTransport.vtkTransportTemporalInterpolator()
    algorithm.SetInputConnection(series.GetOutputPort())
    for name, value in properties.items():
        getattr(algorithm, "Set" + name)(value)
    return algorithm


def values(algorithm, name="rho", points=False):
    image = algorithm.GetDensity()
    array = (image.GetPointData() if points else image.GetCellData()).GetArray(name)
    return None if array is None else vtk_to_numpy(array).copy()


def particles(algorithm, name):
    return vtk_to_numpy(algorithm.GetParticles().GetPointData().GetArray(name)).copy()


def centroid(density, n=N):
    c = np.arange(n) + 0.5
    density = density.reshape(n, n)
    return np.array([(density.sum(0) * c).sum(), (density.sum(1) * c).sum()]) / density.sum()


MOVING = [blob(12, 14), blob(30, 22, 5, height=1.5), blob(34, 34, 6)]
