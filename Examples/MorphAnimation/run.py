# SPDX-License-Identifier: BSD-3-Clause
"""Plays a morph as ParaView's play button does, beside a cross-fade of the same two images."""
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_shapes as shapes
import rectified_video as video
from paraview import simple
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter


def time_series(folder, images):
    """A reader of images as time steps 0, 1 ..."""
    files = []
    for image in images:
        files.append(os.path.join(folder, "step-%d.vti" % len(files)))
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(files[-1])
        writer.SetInputData(image)
        writer.SetDataModeToBinary()  # appended: see Testing/Data/README.md
        writer.Write()
    return simple.XMLImageDataReader(FileName=files)


def flat_view(sources, size, pixels):
    """A view of images side by side, white where they are 0 and dark where they are 1."""
    view = example.picture_view([round(2.05 * pixels), pixels], [1, 1, 1])
    for column, source in enumerate(sources):
        shown = simple.Show(source, view, "UniformGridRepresentation")
        shown.SetRepresentationType("Slice")
        place = "Translation" if hasattr(shown, "Translation") else "Position"  # of 5.11
        setattr(shown, place, [1.05 * size * column, 0, 0])
        simple.ColorBy(shown, ("POINTS", "Density"))
        shown.SetScalarBarVisibility(view, False)
    colours = simple.GetColorTransferFunction("Density")
    colours.RGBPoints = [0, 1, 1, 1, 1, 0.1, 0.27, 0.55]
    colours.ColorSpace = "RGB"
    example.look_down(view, [1.025 * size, size / 2], size, 10 * size)
    return view


def main():
    parser = example.parser(
        __doc__, small="--size 64 --frames 5 --seconds 1 --pictures 3 --panel 120",
        shapes=shapes.names(["knot", "coupling"], "two shapes"), size=256, particles=9,
        frames=example.number(21, "of the animation", 2),
        seconds=dict(type=float, default=2, help="that it takes, one way"),
        pictures=example.number(5, "how many frames the strip shows", 2), panel=320)
    arguments = parser.parse_args()
    if len(arguments.shapes) != 2:
        parser.error("%d shapes are given; it must be two" % len(arguments.shapes))
    if arguments.seconds <= 0:
        parser.error("--seconds is %g; it must be more than 0" % arguments.seconds)

    example.load_plugin()
    images = [shapes.silhouette(name, arguments.size) for name in arguments.shapes]
    for image in images:
        image.GetPointData().GetScalars().SetName("Density")
    morph = simple.MorphDensities(example.producer(images[0]),
                                  Target=example.producer(images[1]),
                                  ParticlesPerCell=arguments.particles, PublishTime=1,
                                  NumberOfTimeSteps=arguments.frames, **shapes.SMOOTH)
    example.result(morph)
    frames = []
    with tempfile.TemporaryDirectory() as folder:
        fade = simple.TemporalInterpolator(Input=time_series(folder, images),
                                           DiscreteTimeStepInterval=1 / (arguments.frames - 1))
        view = flat_view([morph, fade], arguments.size, arguments.panel)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        scene.PlayMode = "Snap To TimeSteps"
        for moment in morph.TimestepValues:
            scene.AnimationTime = moment
            frames.append(figures.drawn(example.save_picture, view))

    path = example.output(arguments, "morph-animation")
    video.write_film(path + ".gif", frames + frames[-2:0:-1],
                     arguments.seconds / (arguments.frames - 1))
    chosen = np.linspace(0, arguments.frames - 1, arguments.pictures).round().astype(int)
    figures.montage(path + ".png",
                    [[("%s, t = %.2f" % (words, morph.TimestepValues[i]), frames[i][:, part])
                      for i in chosen]
                     for words, part in (("morph", slice(None, arguments.panel)),
                                         ("fade", slice(-arguments.panel, None)))],
                    arguments.panel)
    print("%d frames: %s.gif\n%d of them: %s.png" % (len(frames), path, len(chosen), path))


if __name__ == "__main__":
    main()
