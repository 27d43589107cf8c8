# SPDX-License-Identifier: BSD-3-Clause
"""Turns a volume into a cloud of particles and draws it."""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import rectified_example as example
from paraview import simple


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("volume", nargs="?", default=os.path.join(example.DATA, "brain-t1.vti"),
                        help="an image of three dimensions in any format that ParaView reads")
    parser.add_argument("--particles", type=int, default=200000, help="number of particles")
    parser.add_argument("--pixels", type=int, default=1200, help="side of the picture")
    parser.add_argument("--output", default=".", help="folder of the picture")
    arguments = parser.parse_args()

    example.load_plugin()
    volume = example.open_image(arguments.volume)
    cloud = simple.SampleDensity(Input=volume)
    cloud.NumberOfParticles = arguments.particles
    cloud.UpdatePipeline()

    view = example.picture_view([arguments.pixels] * 2, [0.02, 0.02, 0.04])
    shown = simple.Show(cloud, view, "GeometryRepresentation")
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Sphere"
    shown.GaussianRadius = 1.0
    simple.ResetCamera(view)
    os.makedirs(arguments.output, exist_ok=True)
    name = os.path.splitext(os.path.basename(arguments.volume))[0]
    path = os.path.join(arguments.output, "particles-" + name + ".png")
    simple.SaveScreenshot(path, view, ImageResolution=[arguments.pixels] * 2)
    print("%d particles: %s" % (arguments.particles, path))


if __name__ == "__main__":
    main()
