# SPDX-License-Identifier: BSD-3-Clause
"""What the examples of relaxed stipplings share: starts, runs, and an energy to compare them by."""
import math
import time

import numpy as np
import rectified_example as example
from paraview import simple
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import vtk_to_numpy

METHODS = "GaussianBlueNoise", "OptimalTransport"
BLACK = 255.0


def start(image, number, **options):
    """Particles of an image's ink."""
    # The image by its place: a name would come after the choice of the array.
    return simple.SampleDensity(image, InvertDensity=1, NumberOfParticles=number, **options)


def relaxation(dots, image, method, **options):
    return simple.RelaxBlueNoise(dots, Density=image, InvertDensity=1, Method=method, **options)


def timed(make, clock=time.process_time, repeats=1):
    """The last of some filters that a function makes, what it makes, and the median of their times.
    """
    times = []
    for again in range(repeats):
        if again:
            simple.Delete(proxy)
        proxy = make()
        begin = clock()
        proxy.UpdatePipeline()
        times.append(clock() - begin)
    return proxy, example.result(proxy), float(np.median(times))


def places(data):
    """Where the points of a data set are in the plane."""
    return vtk_to_numpy(data.GetPoints().GetData())[:, :2].copy()


def energies(data):
    """The energy before the first iteration of Relax Blue Noise and after each."""
    return vtk_to_numpy(data.GetFieldData().GetArray("Energy")).copy()


def pixel_energy(points, ink):
    """N / (M A) times the sum of ink times squared distance from the nearest of N points over the
    centres of the pixels, whose ink is M and number A: the energy of OptimalTransport without equal
    masses, the same measure for points of any origin."""
    height, width = ink.shape
    centres = np.indices((height, width)).reshape(2, -1)[::-1].T + 0.5
    distances = cKDTree(points).query(centres, workers=-1)[0]
    return len(points) * float((ink.ravel() * distances ** 2).sum()) / (ink.sum() * ink.size)


def disc_radius(ink, number):
    """The radius of discs that together have the area of the ink, in pixels."""
    return math.sqrt(ink.sum() / BLACK / number / math.pi)
