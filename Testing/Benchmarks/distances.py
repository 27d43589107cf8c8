# SPDX-License-Identifier: BSD-3-Clause
"""Whole updates of Transport Distance, in processor time.

usage: OMP_NUM_THREADS=1 python3 distances.py METHOD DIMENSION CELLS INPUTS [...]

For example `Linearized 3 64 40`: 40 inputs of 64³ cells, each of three blobs at random places over a
hundredth. Prints the seconds, and how far the bounds are apart, as a part of the squared distance. With
Linearized also the seconds of a change that needs no map. PYTHONPATH has to name the folder of the
package `rectifiedtransport`.
"""
import sys
import time

import numpy as np
from rectifiedtransport import vtkTransportDistance
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonDataModel import vtkImageData


def blobs(engine, dimension, side):
    axis = (np.arange(side) + 0.5) / side
    values = np.zeros((side,) * dimension)
    for _ in range(3):
        place, width = engine.uniform(0.2, 0.8, dimension), engine.uniform(0.04, 0.1)
        blob = np.array(engine.uniform(0.5, 1))
        for coordinate in place:
            blob = np.multiply.outer(blob, np.exp(-(axis - coordinate) ** 2 / (2 * width ** 2)))
        values += blob
    return values + 0.01 * values.max()


def image_of(values):
    image = vtkImageData()
    side, dimension = len(values), values.ndim
    image.SetDimensions([side + 1] * dimension + [1] * (3 - dimension))
    image.SetSpacing([1 / side] * 3)
    array = numpy_to_vtk(values.ravel(), deep=True)
    array.SetName("density")
    image.GetCellData().SetScalars(array)
    return image


def seconds(algorithm):
    begin = time.process_time()
    algorithm.Update()
    return time.process_time() - begin


def measure(method, dimension, side, count):
    engine = np.random.default_rng(1)
    algorithm = vtkTransportDistance()
    for _ in range(count):
        algorithm.AddInputDataObject(image_of(blobs(engine, dimension, side)))
    getattr(algorithm, "SetMethodTo" + method)()
    text = f"{method}, {count} inputs of {side}^{dimension}: {seconds(algorithm):.2f} s"
    if method == "Linearized":
        algorithm.SetNumberOfCoordinates(3)
        print(f"{text}, a change without maps {seconds(algorithm):.2f} s")
        return
    bounds = algorithm.GetBounds()
    lower, upper = (vtk_to_numpy(bounds.GetColumnByName(name)) for name in ("LowerBound", "UpperBound"))
    apart = (upper / lower) ** 2 - 1
    print(f"{text}, bounds {100 * apart.mean():.2f} % apart, at most {100 * apart.max():.2f} %")


def main():
    if len(sys.argv) < 5 or len(sys.argv) % 4 != 1:
        sys.exit(__doc__)
    vtkObject.GlobalWarningDisplayOff()  # the masses differ
    for method, *numbers in zip(*[iter(sys.argv[1:])] * 4):
        measure(method, *map(int, numbers))


if __name__ == "__main__":
    main()
