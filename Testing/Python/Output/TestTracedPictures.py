# SPDX-License-Identifier: BSD-3-Clause
"""What a traced script draws is what was drawn: the first picture of each filter."""
import os
import subprocess
import tempfile
import unittest

import numpy as np
from paraview import smtrace
from PIL import Image
from rt_filters import FILTERS
from rt_testing import OUTPUT, SOURCE, load_plugin, main, need_display

simple = load_plugin()
SIZE = [300, 200]


def photograph():
    image = simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data", "raccoon.png")])
    image.UpdatePipeline()
    return image


SOURCES = {"density": photograph, "densities": lambda: [photograph(), photograph()],
           "image": photograph, "mesh": lambda: simple.UniformSeeds(
               Bounds=[0, 300, 0, 200, 0, 0], NumberOfPoints=100),
           "points": lambda: simple.SampleDensity(photograph(), InvertDensity=1, NumberOfParticles=2000),
           "solid": simple.Sphere, "disk": simple.Plane,
           "map": lambda: simple.Calculator(Input=simple.Plane(XResolution=3, YResolution=2),
                                            AttributeType="Cell Data", ResultArrayName="Mass",
                                            Function="3")}


def draw(source, port, path):
    view = simple.CreateView("RenderView", ViewSize=SIZE)
    simple.Show(simple.OutputPort(source, port), view)
    simple.ResetCamera(view)
    simple.SaveScreenshot(path, view, ImageResolution=SIZE)


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")).astype(float).ravel()


class TracedPictures(unittest.TestCase):
    def test_first_pictures(self):
        folder = tempfile.mkdtemp(dir=OUTPUT)
        names = []
        smtrace.start_trace()
        for filter_ in FILTERS:
            if filter_.gives_table:
                continue
            made = filter_.make(simple, SOURCES)
            made.UpdatePipeline()
            for port in range(made.SMProxy.GetNumberOfOutputPorts()):
                names.append("%s-%d.png" % (filter_.name, port))
                draw(made, port, os.path.join(folder, names[-1]))
        text = smtrace.stop_trace()
        replayed = tempfile.mkdtemp(dir=OUTPUT)
        script = os.path.join(replayed, "trace.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(text.replace(folder, replayed))
        printed = subprocess.run([os.environ["RT_PVPYTHON"], script], text=True, check=False,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout
        for name in names:
            with self.subTest(name):
                drawn, again = (pixels(os.path.join(place, name)) for place in (folder, replayed))
                self.assertGreater(drawn.std(), 0, printed)
                self.assertGreater(np.corrcoef(drawn, again)[0, 1], 0.98, printed)


if __name__ == "__main__":
    need_display()
    main()
