# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window: all entries are chosen from the menus and applied."""
import os
import re
import shutil
import unittest
from unittest import mock

import rectifiedtransport
from PIL import Image
from rt_filters import FILTERS, by_label
from rt_gui import PHOTOGRAPH, GuiTest, numbers, proxies_of, values
from rt_testing import OUTPUT, SOURCE, main, need_display
from rt_window import (ADVANCED, APPLY, HELP, HELP_PAGE, LOADED, PANEL, choose, play, tick,
                       write_settings)

ASCENT = os.path.join(SOURCE, "Testing", "Data", "ascent.png")
OPEN = """
from paraview.simple import *
photograph = PNGSeriesReader(registrationName='Photograph', FileNames=['%s'])
photograph.UpdatePipeline()
Show(photograph, GetActiveViewOrCreate('RenderView'))
SetActiveSource(photograph)
""" % ASCENT

# A second image for Morph Densities, small enough to be quick.
OPEN_TWO = OPEN + """
half = ExtractSubset(registrationName='Half', Input=photograph,
                     VOI=[0, 255, 0, 255, 0, 0])
Show(half)
ResetCamera()
SetActiveSource(half)
"""
# The same two, selected together.
OPEN_BOTH = OPEN_TWO + """
from paraview import servermanager
selected = servermanager.ProxyManager().GetSelectionModel('ActiveSources')
selected.Select(photograph.SMProxy, 2)
"""

# Half a sphere, from the side of its pole.
OPEN_DOME = """
from paraview.simple import *
dome = Sphere(registrationName='Dome', EndPhi=90, ThetaResolution=48, PhiResolution=24)
view = GetActiveViewOrCreate('RenderView')
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 1]
Show(dome, view)
ResetCamera(view)
SetActiveSource(dome)
"""

# The corners of a cube.
OPEN_CUBE = """
from paraview.simple import *
cube = Box(registrationName='Cube')
Show(cube, GetActiveViewOrCreate('RenderView'))
SetActiveSource(cube)
"""

# A cartogram that is stopped too early.
OPEN_CARTOGRAM = """
from paraview.simple import *
states = OpenDataFile('%s')
cartogram = Cartogram(states, MassArray=['CELLS', 'mass'], MaximumIterations=1)
Show(cartogram, GetActiveViewOrCreate('RenderView'))
SetActiveSource(cartogram)
""" % os.path.join(SOURCE, "Testing", "Data", "us-states.geojson")

# Two times of a series of photographs, each forced, which hides that they come of a series.
OPEN_SERIES = """
from paraview.simple import *
photographs = PNGSeriesReader(registrationName='Photographs', FileNames=['%s'] * 3,
                              ReadAsImageStack=0)
small = ExtractSubset(Input=photographs, VOI=[0, 63, 0, 63, 0, 0])
first, last = (ForceTime(registrationName=name, Input=small, ForcedTime=time)
               for name, time in (('First', 0), ('Last', 2)))
for source in (first, last):
    source.UpdatePipeline()
    Show(source, GetActiveViewOrCreate('RenderView'))
SetActiveSource(last)
""" % ASCENT

# Two time steps of smoke, of coarse grids.
OPEN_STEPS = """
from paraview.simple import *
plume = XMLImageDataReader(registrationName='Plume', FileName=%s)
coarse = ExtractSubset(registrationName='Coarse', Input=plume, VOI=[0, 47, 0, 47, 0, 95],
                       SampleRateI=4, SampleRateJ=4, SampleRateK=4)
Show(coarse, GetActiveViewOrCreate('RenderView'))
ResetCamera()
SetActiveSource(coarse)
""" % [os.path.join(SOURCE, "Examples", "Tutorial", "plume-%d.vti" % i) for i in range(2)]

PLAY = ("VCRToolbar/1QToolButton3", "activate", "")
# In the dialog that asks for the second input: the first source, and OK.
DENSITY = (("SelectInputDialog/buttonFrame/Density", "set_boolean", "true"),
           ("SelectInputDialog/pipelineView", "currentChanged", "/0/0|0"),
           ("SelectInputDialog/buttonBox/1QPushButton0", "activate", ""))
PANEL_WIDGETS = os.environ.get("RT_PANEL")


def weight(row, number):
    row = PANEL + "Weights/Weight%d" % row
    return (row, "set_string", str(number)), (row, "key", "16777220")


def typed_by_name(*numbers):
    return [step for i, number in enumerate(numbers) for step in weight(i, number)]


def typed_in_list(*numbers):
    """ParaView's own list, where the plugin's widgets are not built."""
    weights = PANEL + "Weights/ScalarValueList/"
    editor = weights + "Table/qt_scrollarea_viewport/1QExpandingLineEdit0"
    return [step for i, number in enumerate(numbers)
            for step in ((weights + "Add", "activate", ""),
                         (weights + "Table", "edit", "%d.0" % i),
                         (editor, "set_string", str(number)), (editor, "key", "16777220"))]


def colour_of(state, kind):
    """The array that colours the output of a filter."""
    identity = proxies_of(state)[kind].get("id")
    for proxy in state.iter("Proxy"):
        found = {prop.get("name"): prop for prop in proxy.findall("Property")}
        if "ColorArrayName" in found and found["Input"].find("Proxy").get("value") == identity:
            return values(proxy, "ColorArrayName")[-1]
    return None


class Gui(GuiTest):
    script = OPEN

    def test_menus(self):
        saved = self.state_after("gui.png", choose("Filters", "TransportSampler"), APPLY,
                                 choose("Sources", "UniformSeedSource"), APPLY)
        kinds = [proxy.get("type") for proxy in saved.iter("Proxy")]
        self.assertIn("UniformSeedSource", kinds)
        self.assertIn("TransportSampler", kinds)
        styles = [element.get("value") for prop in saved.iter("Property")
                  if prop.get("name") == "Representation" for element in prop.iter("Element")]
        self.assertEqual(styles.count("Point Gaussian"), 2)

    @unittest.skipUnless(os.environ.get("RT_HELP"), "the plugin is built without help")
    def test_help(self):
        """? opens the page of the filter that the panel shows."""
        self.state_after("gui-help.png", choose("Filters", "TransportSampler"), HELP,
                         (HELP_PAGE, "is documentTitle", "Sample Density"),
                         choose("Sources", "UniformSeedSource"), HELP,
                         (HELP_PAGE, "is documentTitle", "Uniform Seeds"))

    def test_two_inputs(self):
        saved = self.state_after("gui-two-inputs.png", choose("Filters", "TransportMap"), APPLY,
                                 choose("Sources", "UniformSeedSource"), APPLY,
                                 choose("Filters", "DensityEqualizingWarp"), *DENSITY, APPLY,
                                 choose("Filters", "TransportQuality"), *DENSITY, APPLY)
        found = proxies_of(saved)

        def input_of(kind, name):
            for prop in found[kind].iter("Property"):
                if prop.get("name") == name:
                    return prop.find("Proxy").get("value")
            return None

        def identity(kind):
            return found[kind].get("id")

        photograph = input_of("TransportMap", "Input")
        self.assertEqual(input_of("DensityEqualizingWarp", "Input"), identity("UniformSeedSource"))
        self.assertEqual(input_of("DensityEqualizingWarp", "Density"), photograph)
        self.assertEqual(input_of("TransportQuality", "Input"), identity("DensityEqualizingWarp"))
        self.assertEqual(input_of("TransportQuality", "Density"), photograph)
        self.assertIn("SpreadSheetView", found)

    @unittest.skipUnless(PANEL_WIDGETS, "the plugin is built without its own widgets")
    def test_component(self):
        """A list of what Auto takes, the luminance, the magnitude and the components of the array, by
        name."""
        script = OPEN.replace(ASCENT, PHOTOGRAPH).replace(
            "photograph.Update", "photograph.ReadAsImageStack = 0\nphotograph.Update")
        component = PANEL + "Component/ComboBox"
        sampler = choose("Filters", "TransportSampler")
        for steps, expected in (((), -1), (((component, "set_string", "Y"),), 1)):
            saved = self.state_after(
                "gui-component.png", sampler, (component, "is currentText", "Auto (luminance)"),
                (component, "is count", "6"), *steps, APPLY, script_text=script)
            self.assertEqual(numbers(saved, "TransportSampler", "Component"), [expected])

    def window(self, picture, *steps, script_text=OPEN, **options):
        """ParaView's output after steps that save no state."""
        script = self.path("open.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(script_text)
        return play(self.home, steps, os.environ["RT_PLUGIN"], os.path.join(OUTPUT, picture),
                    [*LOADED, "--script=" + script], **options)

    def test_panel(self):
        """The panel makes its widgets from top to bottom, advanced ones, too; ParaView lists them for
        a name that none of them has."""
        with mock.patch.dict(os.environ, PQOBJECTNAMING_MATCH_LIMIT="0"):
            log = self.window("gui-panel.png", ADVANCED, choose("Filters", "TransportSampler"),
                              (PANEL + "none", "is text", ""), until="Couldn't find")
        names = re.findall(r"/ProxyPanel/(\w+)`", log)
        panel = by_label("Sample Density").panel
        self.assertEqual([name for name in names if name in panel], panel)

    @unittest.skipUnless(PANEL_WIDGETS, "the plugin is built without its own widgets")
    def test_tip_of_a_greyed_filter(self):
        """The status bar says what to select for Solid Density, in a longer text than ParaView's
        \"Input must be vtkPolyData\" and \"Requires an input\"."""
        in_menu = sorted(filter_.label for filter_ in FILTERS if filter_.inputs)
        keys = ["Up", "Right", *["Down"] * in_menu.index("Solid Density")]  # Transport is the last menu
        for picture, script_text in (("gui-tip.png", OPEN), ("gui-tip-none.png", "")):
            with self.subTest(picture):
                shutil.rmtree(self.home)
                os.mkdir(self.home)
                write_settings(self.home, (1500, 1000))
                self.window(picture, script_text=script_text, clicks=[(215, 10)], keys=keys)
                with Image.open(os.path.join(OUTPUT, picture)) as shown:
                    bar = shown.convert("L").crop((4, 974, 485, 996))
                dark = [x for x in range(bar.width)
                        if min(bar.getpixel((x, y)) for y in range(bar.height)) < 90]
                self.assertGreater(max(dark, default=0), 330)

    def test_relaxation(self):
        """Of particles, shown as they are; the dialog that asks for the density has it already, and then the
        panel."""
        saved = self.state_after("gui-relaxation.png", choose("Filters", "TransportSampler"), APPLY,
                                 choose("Filters", "BlueNoiseRelaxation"), DENSITY[-1],
                                 (PANEL + "Density/1QComboBox0", "is currentText", "Photograph"), APPLY,
                                 script_text=OPEN + "ResetCamera()\n")
        kinds = [proxy.get("type") for proxy in saved.iter("Proxy")]
        self.assertIn("BlueNoiseRelaxation", kinds)
        styles = [element.get("value") for prop in saved.iter("Property")
                  if prop.get("name") == "Representation" for element in prop.iter("Element")]
        self.assertEqual(styles.count("Point Gaussian"), 2)

    def test_cells_of_seeds(self):
        """The domain is optional: nothing is asked. Cells and outlines are shown, not the sites."""
        saved = self.state_after("gui-cells.png", choose("Sources", "UniformSeedSource"), APPLY,
                                 choose("Filters", "EqualMassCells"), APPLY)
        found = proxies_of(saved)
        cells = found["EqualMassCells"].get("id")
        shown = {element.get("output_port") for prop in saved.iter("Property")
                 if prop.get("name") == "Input" for element in prop.findall("Proxy")
                 if element.get("value") == cells}
        self.assertEqual(shown, {"0", "2"})

    def test_cells_of_a_density(self):
        """The array is filled in as soon as there is a domain, before Apply."""
        array = PANEL + "DensityArray/ComboBox"
        saved = self.state_after("gui-cells-of-a-density.png", choose("Sources", "UniformSeedSource"), APPLY,
                                 choose("Filters", "EqualMassCells"), (array, "is currentText", ""),
                                 (PANEL + "Domain/1QComboBox0", "set_string", "Photograph"),
                                 (PANEL + "Measure/ComboBox", "set_string", "Density"),
                                 (array, "is currentText", "PNGImage"), APPLY)
        self.assertEqual(values(proxies_of(saved)["EqualMassCells"], "DensityArray"),
                         ["", "1", "0", "0", "PNGImage"])

    def test_map_of_a_surface(self):
        """A checkerboard on the surface; the square is there, too, but is not shown."""
        saved = self.state_after("gui-map.png", choose("Filters", "AreaPreservingParameterization"),
                                 APPLY, script_text=OPEN_DOME)
        mapped = proxies_of(saved)["AreaPreservingParameterization"].get("id")
        shown = {}
        for proxy in saved.iter("Proxy"):
            props = {prop.get("name"): prop for prop in proxy.iter("Property")}
            source = props["Input"].find("Proxy") if "Representation" in props else None
            if source is not None and source.get("value") == mapped:
                shown[source.get("output_port")] = props["Representation"].find("Element").get("value")
        self.assertEqual(shown, {"0": "Checkerboard"})
        with Image.open(os.path.join(OUTPUT, "gui-map.png")) as picture:
            view = picture.convert("RGB").crop((400, 250, 1050, 650))
        red = view.getchannel("R").histogram()  # of the background 0
        dark, light = sum(red[40:130]), sum(red[130:])
        self.assertGreater(dark + light, 0.2 * view.width * view.height)
        self.assertTrue(0.6 < light / dark < 1.6, (light, dark))

    def test_optional_inputs(self):
        """They are chosen on the panel, and taken away there."""
        domain = PANEL + "Domain/1QComboBox0"
        steps = (choose("Sources", "UniformSeedSource"), APPLY, choose("Filters", "EqualMassCells"),
                 (domain, "set_string", "Photograph"), APPLY)
        saved = self.states_after("gui-domain.png", steps, ((domain, "set_string", "(none)"), APPLY))
        given = [next(prop for prop in proxies_of(state)["EqualMassCells"].iter("Property")
                      if prop.get("name") == "Domain") for state in saved]
        self.assertEqual([len(prop.findall("Proxy")) for prop in given], [1, 0])

    @unittest.skipUnless(PANEL_WIDGETS, "the plugin's widgets are not built")
    def test_notes(self):
        """What a resolution means is said before Apply, and how many regions miss a tolerance after it."""
        number, note = (PANEL + "Resolution/" + name for name in ("IntRangeWidget/LineEdit", "Note"))
        self.state_after("gui-pixels.png", choose("Filters", "EqualMassCells"),
                         (note, "is text", "64 x 64 x 64 pixels take about 10.7 MB"),
                         (number, "set_string", "512"),
                         (note, "is text", "512 x 512 x 512 pixels take about 5.5 GB; a lower Resolution "
                                           "is quicker"), script_text=OPEN_CUBE)
        note = PANEL + "Tolerance/Note"
        self.state_after("gui-missed.png", ADVANCED, (note, "is text", "49 regions miss it"),
                         script_text=OPEN_CARTOGRAM)

    def test_names_of_a_chart(self):
        """The table beside the chart has them."""
        saved = self.state_after("gui-chart.png", choose("Filters", "TransportDistance"), APPLY,
                                 script_text=OPEN_BOTH.replace("255", "511"))
        tables = proxies_of(saved)["SpreadSheetRepresentation"]
        source = next(prop for prop in tables.iter("Property") if prop.get("name") == "Input").find("Proxy")
        self.assertEqual((source.get("value"), source.get("output_port")),
                         (proxies_of(saved)["TransportDistance"].get("id"), "2"))
        layout = proxies_of(saved)["ViewLayout"]
        shown = {item.get("view") for item in layout.iter("Item")} - {"0"}
        views = {proxy.get("type"): proxy.get("id") for proxy in saved.iter("Proxy")
                 if proxy.get("group") == "views"}
        self.assertEqual(shown, set(views.values()))

    @unittest.skipUnless(PANEL_WIDGETS, "the plugin's widgets are not built")
    def test_target_of_a_map(self):
        """Its array is shown with it alone; equal areas are those of the uniform measure. The panel goes on
        showing the map, whose colours are those of a map to a target."""
        target, array, direction, areas = (PANEL + widget for widget in (
            "Target/1QComboBox0", "TargetArray", "Direction/ComboBox", "EqualizeAreas"))
        steps = (choose("Filters", "TransportMap"), ADVANCED, (array, "is visible", "false"),
                 (areas, "is visible", "false"), (direction, "set_string", "DensityToUniform"),
                 (areas, "is visible", "true"), (target, "set_string", "Photograph"),
                 (array, "is visible", "true"), (areas, "is visible", "false"), APPLY,
                 (array, "is visible", "true"))
        without = ((target, "set_string", "(none)"), APPLY, (array, "is visible", "false"))
        saved = self.states_after("gui-target.png", steps, without, script_text=OPEN_TWO)
        given = [next(prop for prop in proxies_of(state)["TransportMap"].iter("Property")
                      if prop.get("name") == "Target") for state in saved]
        self.assertEqual([len(prop.findall("Proxy")) for prop in given], [1, 0])
        self.assertEqual([colour_of(state, "TransportMap") for state in saved],
                         ["CostDensity", "Displacement"])

    def test_devices(self):
        """Those of the machine are listed once OpenCL is applied. A name that is not in the list, given
        by a script, stays."""
        asked = rectifiedtransport.vtkTransportSampler()
        asked.SetDeviceToOpenCL()
        names = asked.GetDeviceNames()
        names = [names.GetValue(i) for i in range(names.GetNumberOfValues())]
        device, name = (PANEL + widget + "/ComboBox" for widget in ("Device", "DeviceName"))
        listed = (ADVANCED, choose("Filters", "TransportSampler"), (device, "set_string", "OpenCL"),
                  (name, "is visible", "true"), (name, "is currentText", ""), APPLY,
                  (name, "is count", str(len(names))))
        cpu = ((device, "set_string", "CPU"), (name, "is visible", "false"), APPLY)
        saved = self.states_after("gui-device.png", listed,
                                  ((name, "set_string", names[-1]), APPLY), cpu)
        for state, expected in zip(saved, (("1", ""), ("1", names[-1]), ("0", names[-1]))):
            sampler = proxies_of(state)["TransportSampler"]
            self.assertEqual((*values(sampler, "Device"), *values(sampler, "DeviceName")), expected)
        given = """
sampler = SampleDensity(Input=photograph, NumberOfParticles=50, Device='OpenCL', DeviceName='Another')
Show(sampler)
SetActiveSource(sampler)
"""
        number = PANEL + "NumberOfParticles/IntRangeWidget/LineEdit"
        saved = self.state_after("gui-another-device.png", (number, "set_string", "60"), APPLY,
                                 script_text=OPEN + given)
        self.assertEqual(values(proxies_of(saved)["TransportSampler"], "DeviceName"), ["Another"])
        self.assertEqual(numbers(saved, "TransportSampler", "NumberOfParticles"), [60])

    def test_numbers_beyond_a_slider_are_typed(self):
        number = PANEL + "NumberOfParticles/IntRangeWidget/LineEdit"
        saved = self.state_after("gui-typed.png", choose("Filters", "TransportSampler"),
                                 (number, "set_string", "150000"), APPLY)
        self.assertEqual(numbers(saved, "TransportSampler", "NumberOfParticles"), [150000])

    def test_morph_plays(self):
        """With PublishTime the play button runs over the filter's steps, to the last one."""
        target = ("SelectInputDialog/buttonFrame/Target", *DENSITY[0][1:])
        saved = self.state_after(
            "gui-morph.png", choose("Filters", "TransportInterpolator"), target, *DENSITY[1:],
            (PANEL + "Target/1QComboBox0", "is currentText", "Photograph"),
            tick("PublishTime"), APPLY, PLAY,
            script_text=OPEN_TWO)
        self.assertEqual(numbers(saved, "TransportInterpolator", "PublishTime"), [1])
        self.assertEqual(numbers(saved, "TimeKeeper", "TimestepValues"),
                         [i / 10 for i in range(11)])
        self.assertEqual(numbers(saved, "TimeKeeper", "Time"), [1])

    def test_morph_of_two_times(self):
        """Of a series: the scene has the morph's times alone, and the series' when it is deleted."""
        target = ("SelectInputDialog/buttonFrame/Target", *DENSITY[0][1:])
        make = (choose("Filters", "TransportInterpolator"), target, *DENSITY[1:],
                tick("PublishTime"), APPLY)
        delete = ("propertiesDock/propertiesPanel/Delete", "activate", "")
        for steps, times in (((PLAY,), [i / 10 for i in range(11)]), ((delete,), [0, 1, 2])):
            saved = self.state_after("gui-morph-series.png", *make, *steps, script_text=OPEN_SERIES)
            self.assertEqual(numbers(saved, "TimeKeeper", "TimestepValues"), times)

    def test_series_between_its_steps(self):
        """With ResampleFactor the play button runs over times between the steps, to the last one; then back."""
        resample = PANEL + "ResampleFactor/IntRangeWidget/LineEdit"
        first = ("VCRToolbar/1QToolButton0", "activate", "")
        make = (choose("Filters", "TransportTemporalInterpolator"), (resample, "set_string", "4"), APPLY)
        saved = self.states_after("gui-series.png", (*make, PLAY), (first,), script_text=OPEN_STEPS)
        for state, time in zip(saved, (1, 0)):
            self.assertEqual(numbers(state, "TransportTemporalInterpolator", "ResampleFactor"), [4])
            self.assertEqual(numbers(state, "TimeKeeper", "TimestepValues"), [0, 0.25, 0.5, 0.75, 1])
            self.assertEqual(numbers(state, "TimeKeeper", "Time"), [time])

    def test_barycenter_of_selected(self):
        """Images that are selected together are its inputs; weights are typed into the panel."""
        saved = self.state_after(
            "gui-barycenter.png", choose("Filters", "TransportBarycenter"), APPLY,
            *(typed_by_name if PANEL_WIDGETS else typed_in_list)(3, 1), APPLY,
            script_text=OPEN_BOTH)
        inputs = next(prop for proxy in saved.iter("Proxy")
                      if proxy.get("type") == "TransportBarycenter"
                      for prop in proxy.iter("Property") if prop.get("name") == "Input")
        self.assertEqual(len(inputs.findall("Proxy")), 2)
        self.assertEqual(numbers(saved, "TransportBarycenter", "Weights"), [3, 1])

    @unittest.skipUnless(PANEL_WIDGETS, "the plugin is built without its own widgets")
    def test_weights_by_name(self):
        """One row of two is typed: the list has both. Undone, or emptied, it has none."""
        typed = (*weight(0, 3), APPLY)
        undo = ("menubar/menu_Edit", "activate", "actionEditUndo")
        saved = self.states_after(
            "gui-weights.png", (choose("Filters", "TransportBarycenter"), APPLY, *typed), (undo,),
            typed, (*weight(0, ""), *weight(1, ""), APPLY), script_text=OPEN_BOTH)
        self.assertEqual([numbers(state, "TransportBarycenter", "Weights") for state in saved],
                         [[3, 1], [], [3, 1], []])

    @unittest.skipUnless(PANEL_WIDGETS, "the plugin is built without its own widgets")
    def test_bounds_of_data(self):
        """Those of the photograph, not of the seeds that are shown, too."""
        saved = self.state_after("gui-bounds.png", choose("Sources", "UniformSeedSource"), APPLY,
                                 (PANEL + "Bounds/TakeBounds", "activate", ""), APPLY)
        self.assertEqual(numbers(saved, "UniformSeedSource", "Bounds"),
                         [0, 511, 0, 511, 0, 0])


if __name__ == "__main__":
    need_display()
    main()
