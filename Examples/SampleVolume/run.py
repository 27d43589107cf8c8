# SPDX-License-Identifier: BSD-3-Clause
"""Turns a volume into particles and draws half of them as spheres, coloured by the volume."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example
from paraview import simple


def draw(path, particles, bounds, radius, pixels):
    """The half of the particles behind the plane through the middle, seen from the side of x."""
    size = [bounds[2 * i + 1] - bounds[2 * i] for i in range(3)]
    middle = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    half = simple.Clip(Input=particles, ClipType="Plane")
    half.ClipType.Origin = middle
    half.ClipType.Normal = [1, 0, 0]

    view = example.picture_view([pixels] * 2, [0.02, 0.02, 0.04])
    shown = simple.Show(half, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Sphere"
    shown.GaussianRadius = radius
    name = next(n for n in particles.PointData.keys() if n != "vtkValidPointMask")
    colors = example.colour_by(shown, view, ("POINTS", name), "Inferno")
    lowest, highest = particles.PointData[name].GetRange(-1)
    colors.RescaleTransferFunction(lowest + 0.15 * (highest - lowest), highest)

    away = 2.6 * max(size)
    view.CameraFocalPoint = middle
    view.CameraPosition = [m + away * d for m, d in zip(middle, (0.95, 0.26, 0.19))]
    view.CameraViewUp = [0, 0, 1]
    view.CameraViewAngle = 24
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--particles 50000 --pixels 400",
        volume=example.file(example.BRAIN,
                            "an image of three dimensions in any format that ParaView reads"),
        particles=example.number(300000, "number of particles"),
        pixels=example.number(1200, "side of the picture")).parse_args()

    example.load_plugin()
    volume = example.open_image(arguments.volume)
    cloud = simple.SampleDensity(volume, NumberOfParticles=arguments.particles)
    data = example.result(cloud)
    bounds = data.GetBounds()
    room = math.prod(bounds[2 * i + 1] - bounds[2 * i] for i in range(3))
    radius = 0.32 * (room / data.GetNumberOfPoints()) ** (1 / 3)
    coloured = simple.ResampleWithDataset(SourceDataArrays=volume, DestinationMesh=cloud)
    coloured.UpdatePipeline()

    path = example.output(arguments, "particles-" + example.stem(arguments.volume) + ".png")
    draw(path, coloured, bounds, radius, arguments.pixels)
    print("%d particles: %s" % (data.GetNumberOfPoints(), path))


if __name__ == "__main__":
    main()
