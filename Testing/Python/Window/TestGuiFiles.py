# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window: the first picture, what it writes, and what it is begun with again: states,
vector files, frames of an animation, and the plugin by Auto Load."""
import os
import re
import shutil

import numpy as np
from PIL import Image
from rt_gui import GuiTest, PHOTOGRAPH, numbers, proxies_of, save_state, values, view_of
from rt_testing import SOURCE, main, need_display
from rt_window import (APPLY, PANEL, choose, first_stippling, load_new, manage_plugins, open_state,
                       write_settings)

DATA = os.path.join(SOURCE, "Testing", "Data")
WRITER = "WriterSettingsDialog/scrollArea/qt_scrollarea_viewport/Container/ProxyWidget/"
TRACKS = "animationViewDock/animationView/pqAnimationWidget/"
MORPH = """
from paraview.simple import *
ball = SolidDensity(Sphere(), Resolution=16)
box = SolidDensity(Box(XLength=2), Resolution=16)
for solid in ball, box:
    solid.UpdatePipeline()
morph = MorphDensities(registrationName='Morph', Input=ball, Target=box, Parameter=0.25)
morph.UpdatePipeline()
Show(morph, GetActiveViewOrCreate('RenderView'))
ResetCamera()
SetActiveSource(morph)
"""
BALL = """
from paraview.simple import *
ball = Sphere(registrationName='Ball')
Show(ball, GetActiveViewOrCreate('RenderView'))
SetActiveSource(ball)
"""


def save_data(path, *steps):
    """File, Save Data, with steps in the dialog of the writer's properties."""
    return (("menubar/menu_File", "activate", "actionFileSaveData"),
            ("FileSaveDialog", "filesSelected", path), *steps,
            ("WriterSettingsDialog/widget/OKButton", "activate", ""))


class GuiFiles(GuiTest):
    def test_first_stippling(self):
        """The README's clicks, on a photograph that ParaView itself opens: at once a picture in dots. It is
        saved as SVG, as large as is typed, with the dots of the view."""
        svg = self.path("dots.svg")
        saved = self.state_after(
            "gui-first-stippling.png", *first_stippling(PHOTOGRAPH),
            *save_data(svg, (WRITER + "Width/DoubleLineEdit0", "set_string", "150")))
        self.assert_stippled("gui-first-stippling.png")
        self.assertIn("PNGSeriesReader", proxies_of(saved))
        self.assertEqual(numbers(saved, "TransportSampler", "InvertDensity"), [1])
        shown = proxies_of(saved)["GeometryRepresentation"]
        self.assertEqual(values(shown, "Representation"), ["Point Gaussian"])
        self.assertEqual(values(shown, "ShaderPreset"), ["3"])  # Plain circle
        self.assertEqual(values(shown, "DiffuseColor"), ["0", "0", "0"])  # the background is white
        with open(svg, encoding="utf-8") as file:
            text = file.read()
        self.assertEqual(text.count("<circle"), 8192)
        height, radius = (float(re.search(pattern, text)[1]) for pattern in
                          (r'width="150mm" height="([\d.]+)mm"', r' r="([\d.]+)"'))
        self.assertAlmostEqual(height, 112.5, delta=0.5)
        unit = 150 / (1024 + 2 * float(values(shown, "GaussianRadius")[0]))
        self.assertAlmostEqual(radius / unit, float(values(shown, "GaussianRadius")[0]), delta=0.05)

    def test_closed_surface(self):
        """Particles inside, in one step: no array is asked for."""
        array = PANEL + "DensityArray"
        steps = (choose("Filters", "TransportSampler"), (array, "is visible", "false"), APPLY,
                 (array, "is visible", "false"))
        saved = self.state_after("gui-solid.png", *steps, script_text=BALL)
        self.assertIn("TransportSampler", proxies_of(saved))

    def test_auto_load(self):
        """The plugin is ticked in the list, and is there when ParaView starts again; so is what a state
        holds that was saved before."""
        plugin, state = os.environ["RT_PLUGIN"], self.path("dots.pvsm")
        tree = "splitter/localGroup/localPlugins"
        self.played("gui-ticked.png",
                    *manage_plugins(*load_new(plugin, "Local"),
                                    # of ParaView's own plugin and ours the second, its Auto Load
                                    (tree, "setTreeItemCheckState", "1.5,1,2")),
                    *first_stippling(PHOTOGRAPH), *save_state(state),
                    ("menubar/menu_File", "activate", "actionFileExit"), plugin=None, options=())
        self.played("gui-auto-load.png", *open_state(state, "Use File Names From State"),
                    choose("Sources", "UniformSeedSource"), plugin=None, options=())
        self.assert_stippled("gui-auto-load.png")

    def test_parameter_track(self):
        """A track of Morph Densities' Parameter animates it: each frame differs from the one before. A Contour
        begins with half of the solids' density."""
        press = "1,1,0,0,0,2"  # the plus of the row after Time
        saved = self.state_after(
            "gui-track.png", ("menubar/menu_View", "activate", "Animation View"),
            (TRACKS + "CreateDeleteWidget/PropertyCombo", "set_string", "Parameter"),
            (TRACKS + "1QHeaderView0", "mousePress", press),
            (TRACKS + "1QHeaderView0", "mouseRelease", press),
            ("menubar/menu_File", "activate", "actionFileSaveAnimation"),
            ("SaveAnimationFileDialog", "filesSelected", self.path("frame.png")),
            ("SaveAnimationDialog/widget/OKButton", "activate", ""),
            ("menubar/menuFilters/Common", "activate", "Contour"), APPLY, script_text=MORPH)
        self.assertEqual(numbers(saved, "Contour", "ContourValues"), [0.5])
        frames = []
        for i in range(10):
            with Image.open(self.path("frame.%04d.png" % i)) as frame:
                frames.append(np.asarray(frame.convert("L")).astype(float))
        seen = [np.ptp(frame) for frame in frames]
        self.assertGreater(min(seen), 50)
        apart = [np.abs(after - before).max() for before, after in zip(frames, frames[1:])]
        self.assertGreater(min(apart), 5)
        wide = [np.ptp(np.nonzero(np.abs(frame - frame[0, 0]).max(axis=0) > 8)[0]) for frame in
                (frames[0], frames[-1])]
        self.assertGreater(wide[1], wide[0])  # from the ball to the long box

    def test_map(self):
        """A map that ParaView itself opens becomes a cartogram in colours, with outlines and a grid, which
        is saved as SVG as it is seen."""
        svg = self.path("people.svg")
        saved = self.state_after(
            "gui-map.png", ("menubar/menu_File", "activate", "actionFileOpen"),
            ("FileOpenDialog", "filesSelected", os.path.join(DATA, "us-states.geojson")), APPLY,
            choose("Filters", "Cartogram"), APPLY, *save_data(svg))
        self.assertEqual(values(proxies_of(saved)["Cartogram"], "MassArray")[-1], "mass")
        styles = [values(proxy, "Representation")[0] for proxy in saved.iter("Proxy")
                  if proxy.get("type") == "GeometryRepresentation"]
        self.assertIn("Filled Outlines With Edges", styles)
        with open(svg, encoding="utf-8") as file:
            text = file.read()
        self.assertGreater(len(set(re.findall(r'fill="(#\w+)"', text))), 40)

    def test_tutorial(self):
        """Its states open in the window, with their data and their views."""
        for name in ("slice", "morph", "compare", "people", "mesh"):
            picture = "gui-tutorial-%s.png" % name
            path = os.path.join(SOURCE, "Examples", "Tutorial", name + ".pvsm")
            shutil.rmtree(self.home)
            os.mkdir(self.home)
            write_settings(self.home)
            saved = self.state_after(picture, *open_state(path))
            layouts = [proxy for proxy in saved.iter("Proxy") if proxy.get("group") == "misc"
                       and proxy.get("type") == "ViewLayout"]
            self.assertEqual(len(list(layouts[0].iter("Item"))), 1)
            view = view_of(picture)
            self.assertEqual(view.max(), 1)  # its background is white
            self.assertGreater((view < 0.8).mean(), 0.02)


if __name__ == "__main__":
    need_display()
    main()
