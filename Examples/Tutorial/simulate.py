# SPDX-License-Identifier: BSD-3-Clause
"""Simulates smoke that rises from a ball, and writes two moments of it: plume-0.vti, plume-1.vti,
and the second one of a run with wind: plume-wind.vti.

An incompressible fluid in a box of 4 x 4 x 8 m, periodic along x and y: the smoke is carried along
and pushes the air up where it is. Advection is semi-Lagrangian, of second order along the paths;
the pressure is solved by FFT.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
from scipy.ndimage import map_coordinates
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

SPACING = 1 / 12  # m
SHAPE = (48, 48, 96)  # cells along x, y, z
STEP = 0.05  # s
LIFT = 3.0  # m/s² where there is nothing but smoke
MOMENTS = (30, 54)  # steps after which the smoke is written
WIND = 0.25  # m/s, in the middle of the height of the run with wind


def start(centres):
    """A ball of smoke with bumps, so that it rises without symmetry."""
    away = centres - np.reshape([2.0, 2.0, 1.6], (3, 1, 1, 1))
    around = np.arctan2(away[1], away[0])
    radius = np.sqrt((away ** 2).sum(axis=0))
    edge = 0.75 * (1 + 0.12 * np.sin(3 * around + 1) + 0.1 * np.sin(4 * away[2] / 0.75 + around))
    return 1 / (1 + np.exp((radius - edge) / 0.05))


def carried(fields, speed, cells):
    """Fields after a step along the flow: looked up where they were, by the midpoint's speed."""
    def look(field, where):
        return map_coordinates(field, where, order=3, mode="grid-wrap")

    half = cells - 0.5 * STEP / SPACING * speed
    middle = np.stack([look(component, half) for component in speed])
    origin = cells - STEP / SPACING * middle
    return [look(field, origin) for field in fields]


def without_divergence(speed, waves, squares):
    """The part of a velocity that keeps volumes."""
    spectrum = np.fft.fftn(speed, axes=(1, 2, 3))
    spectrum -= waves * (waves * spectrum).sum(axis=0) / squares
    return np.fft.ifftn(spectrum, axes=(1, 2, 3)).real


def write(path, smoke):
    """Points at the middles of the cells, of 8 bits: 255 is smoke alone."""
    image = vtkImageData()
    image.SetDimensions(SHAPE)
    image.SetSpacing(SPACING, SPACING, SPACING)
    image.SetOrigin(SPACING / 2, SPACING / 2, SPACING / 2)
    values = np.round(255 * smoke.clip(0, 1)).astype(np.uint8)
    array = numpy_to_vtk(values.transpose(2, 1, 0).ravel(), deep=1)
    array.SetName("Smoke")
    image.GetPointData().SetScalars(array)
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.SetDataModeToBinary()  # appended: see Testing/Data/README.md
    writer.Write()


def run(wind):
    """The smoke and the speed after each step."""
    cells = np.stack(np.meshgrid(*(np.arange(n, dtype=float) for n in SHAPE), indexing="ij"))
    waves = np.stack(np.meshgrid(*(np.fft.fftfreq(n) for n in SHAPE), indexing="ij"))
    squares = (waves ** 2).sum(axis=0)
    squares[0, 0, 0] = 1
    smoke = start((cells + 0.5) * SPACING)
    speed = np.zeros((3, *SHAPE))
    speed[0] = wind * np.sin(np.pi * (cells[2] + 0.5) / SHAPE[2]) ** 2
    while True:
        smoke, *speed = carried([smoke, *speed], speed, cells)
        speed = np.stack(speed)
        speed[2] += STEP * LIFT * (smoke - smoke.mean())
        speed = without_divergence(speed, waves, squares)
        yield smoke, speed


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    arguments = example.parser(__doc__, output=here).parse_args()
    for wind, moments, names in ((0.0, MOMENTS, "01"), (WIND, MOMENTS[1:], ["wind"])):
        for step, (smoke, speed) in zip(range(1, moments[-1] + 1), run(wind)):
            if step in moments:
                path = example.output(arguments, "plume-%s.vti" % names[moments.index(step)])
                write(path, smoke)
                print("%s: %.1f s, fastest %.2f m/s" % (path, step * STEP, np.abs(speed).max()))


if __name__ == "__main__":
    main()
