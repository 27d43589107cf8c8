# SPDX-License-Identifier: BSD-3-Clause
"""Inputs, outputs, choices, hints and the visibility of properties in the XML agree with the public
names and with the classes."""
import math
import os
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
from rt_filters import FILTERS, PROPERTIES, Property, by_label
from rt_proxies import instance, proxies, written_files
from rt_testing import SOURCE, connect_inputs, density_image, digest, main
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkRectilinearGrid
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline

# Of a filter that has Measure: shown where it is Density. Two values of each, and the kind of domain
# that they differ for.
OF_MEASURE = {
    "DensityArray": None,  # no value
    "Component": ((-1, 0), "colours"),
    "InvertDensity": ((0, 1), "colours"),
    "NegativeValues": ((0, 1), "negative"),
    "NaNValues": ((0, 1), "missing"),
    "ValidRange": (((-1e299, 1e299), (0.3, 1e299)), "colours"),
    "DensityResolution": ((256, 3), "mesh"),
    "AreaTolerance": None,  # see test_tolerance_is_shown_where_it_sets_steps
}


# Of a filter that can take the optimal map: shown where it does not. Two values that give different
# results of small inputs there.
OF_FLOW = {
    "Integrator": (0, 2),
    "NumberOfSteps": (32, 1),
    "AreaTolerance": (0.5, 1e-5),
    "TableLookup": (0, 1),
    "Tolerance": None,  # of one integrator, see rt_filters.py
    "FlowMaps": None,  # of large inputs
    "Certify": None,  # see TestOptimal.py
    "Tables": None,  # these change no result
    "Device": None,
    "DeviceName": None,
}


def inputs(proxy):
    return {int(prop.element.get("port_index", 0)): prop for prop in proxy.properties.values()
            if prop.element.tag == "InputProperty"}


def known(prop):
    """What the register has of a property."""
    return PROPERTIES.get(prop.name, Property())


def depends_on(proxy, prop):
    """The properties one of which decides whether a property of a proxy is shown."""
    return () if prop.name in by_label(proxy.label).always_shown else known(prop).shown_by


def decorators(prop):
    return prop.element.findall("Hints/PropertyWidgetDecorator")


def is_shown(decorator, value):
    """What ParaView's GenericDecorator makes of a value, given as text."""
    if decorator.get("values") is not None:
        shown = value in decorator.get("values").split()
    else:
        shown = value == decorator.get("value")
    return shown != (decorator.get("inverse") == "1")


def domain_of(kind, shape):
    """Data with a density."""
    if kind == "colours":
        values = 0.1 + np.random.default_rng(2).random((int(np.prod(shape)), 3))
        return density_image(shape, values=values)
    image = density_image(shape)
    if kind == "negative":
        image.GetCellData().GetScalars().SetValue(3, -0.5)
    if kind == "missing":
        image.GetCellData().GetScalars().SetValue(3, math.nan)
    if kind == "mesh":
        grid = vtkRectilinearGrid()
        grid.SetDimensions(image.GetDimensions())
        x, y = (numpy_to_vtk(np.linspace(0, 5, n + 1) ** 2, deep=1) for n in shape)
        grid.SetXCoordinates(x)
        grid.SetYCoordinates(y)
        grid.GetCellData().SetScalars(image.GetCellData().GetScalars())
        return grid
    return image


def result(proxy, values, domain=None):
    """All that comes out with some properties set."""
    filter_ = instance(proxy)
    large = any(PROPERTIES[name].needs_large for name in values if name in PROPERTIES)
    shape, number, resolution = ((260, 240), 20000, 512) if large else ((4, 3), 50, 40)
    connect_inputs(filter_, shape, number)
    if hasattr(filter_, "SetNumberOfParticles"):
        filter_.SetNumberOfParticles(30)
    if hasattr(filter_, "SetTrackParticles") and "TrackParticles" not in values:
        filter_.SetTrackParticles(1)  # else the kernel has no effect on a single step
    if hasattr(filter_, "SetNumberOfPoints"):
        filter_.SetNumberOfPoints(30)
    if hasattr(filter_, "SetResolution"):
        filter_.SetResolution(resolution)
    if domain:
        filter_.SetDomainData(domain_of(domain, shape))
    if "EmptyCells" in values and hasattr(filter_, "SetNaNValuesToEmpty"):
        port = by_label(proxy.label).port_of("density")
        filter_.SetInputData(port, domain_of("missing", shape))
        filter_.SetNaNValuesToEmpty()
    for name, value in values.items():
        getattr(filter_, proxy.properties[name].command)(value)
    filter_.UpdateInformation()
    filter_.UpdateTimeStep(0.125)
    times = filter_.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    return times, [digest(filter_.GetOutputDataObject(port))
                   for port in range(filter_.GetNumberOfOutputPorts())]


class XML(unittest.TestCase):
    def each(self):
        for proxy in proxies():
            yield self.subTest(proxy=proxy.label), proxy

    def each_property(self):
        for proxy in proxies():
            for name, prop in proxy.properties.items():
                yield self.subTest(proxy=proxy.label, property=name), proxy, prop

    def test_writers(self):
        """A writer of ParaView's menu has every property of what makes its file."""
        files = written_files()
        self.assertEqual([proxy.class_name for proxy in files],
                         ["vtkTransportSVGWriter", "vtkTransportPDFWriter"])
        path = os.path.join(SOURCE, "Plugin", "VectorWriters.xml")
        writers = {writer.find("SubProxy/Proxy").get("proxyname"): writer for writer in
                   ElementTree.parse(path).getroot().findall("ProxyGroup/WriterProxy[@class]")}
        for proxy in files:
            with self.subTest(proxy.class_name):
                writer = writers[proxy.element.get("name")]
                self.assertEqual(writer.get("supports_parallel"), "1")
                exposed = [e.get("name") for e in writer.findall(
                    "SubProxy/ExposedProperties/PropertyGroup/Property")]
                self.assertEqual(set(exposed), set(proxy.properties) - {"DrawnInput"})
                for prop in proxy.properties.values():
                    if prop.command:
                        self.assertTrue(prop.documentation)
                        self.assertTrue(hasattr(instance(proxy), prop.command))

    def test_panel_widgets(self):
        """Names that ParaView or this plugin knows: ParaView takes no notice of others."""
        with open(os.path.join(SOURCE, "Plugin", "CMakeLists.txt"), encoding="utf-8") as file:
            made = file.read()
        for case, proxy in self.each():
            with case:
                for element in proxy.element.iter():
                    name = element.get("panel_widget")
                    if name not in (None, "input_selector"):
                        self.assertIn('"WIDGET %s pq' % name, made)

    def test_public_names(self):
        self.assertEqual({proxy.label: proxy.class_name for proxy in proxies()},
                         {filter_.label: filter_.class_name for filter_ in FILTERS})
        for case, proxy in self.each():
            with case:
                found = inputs(proxy)
                names = [found[port].name for port in sorted(found)]
                public = by_label(proxy.label)
                self.assertEqual(names, list(public.ports))
                self.assertEqual(proxy.menu, "filters" if found else "sources")
                self.assertEqual(proxy.element.get("multiprocess_support"),
                                 "both" if public.on_ranks else "single_process")

    def test_nothing_is_overridden(self):
        """ParaView applies an override once, to the first proxy of a base before another plugin is
        loaded."""
        for case, _, prop in self.each_property():
            with case:
                self.assertIsNone(prop.element.get("override"))

    def test_choices(self):
        for case, proxy, prop in self.each_property():
            with case:
                if prop.texts:
                    choices = by_label(proxy.label).choices.get(
                        prop.name, PROPERTIES[prop.name].choices)
                    expected = {str(i): text for i, text in enumerate(choices)}
                    self.assertEqual(prop.texts, expected)
                    self.assertEqual(prop.texts[prop.default], by_label(proxy.label).defaults.get(
                        prop.name, prop.texts["0"]))
                    if prop.name in ("EmptyCells", "Method"):  # the default is listed first
                        self.assertEqual(next(iter(prop.texts)), prop.default)

    def test_commands(self):
        for case, proxy, prop in self.each_property():
            with case:
                commands = [prop.element.get(name) for name in (
                    "command", "clean_command", "set_number_command") if prop.element.get(name)]
                self.assertTrue(commands or prop.element.get("information_only"))
                for command in commands:
                    self.assertTrue(hasattr(instance(proxy), command), command)

    def test_numbers_of_elements(self):
        for case, proxy, prop in self.each_property():
            with case:
                if prop.is_value:
                    value = getattr(instance(proxy), "G" + prop.command[1:])()
                    values = value if isinstance(value, tuple) else (value,)
                    count = len(values)
                    self.assertEqual(prop.element.get("number_of_elements"), str(count))
                    self.assertEqual(len(prop.default.split()), count)
                    kind = "Double" if isinstance(values[0], float) else "Int"
                    self.assertEqual(prop.element.tag, kind + "VectorProperty")

    def test_inputs(self):
        """Ports, types, and which may stay empty or have several, as the class has them."""
        for case, proxy in self.each():
            with case:
                filter_ = instance(proxy)
                found = inputs(proxy)
                self.assertEqual(set(found), set(range(filter_.GetNumberOfInputPorts())))
                for port, prop in found.items():
                    information = filter_.GetInputPortInformation(port)
                    optional = not filter_.NeedsInput(port)
                    self.assertEqual(prop.element.find("Hints/Optional") is not None, optional)
                    self.assertEqual(prop.element.get("null_on_empty") == "1", optional)
                    self.assertEqual(prop.element.get("panel_widget") == "input_selector", port > 0)
                    several = bool(information.Has(vtkAlgorithm.INPUT_IS_REPEATABLE()))
                    self.assertEqual(prop.element.get("multiple_input") == "1", several)
                    self.assertEqual(prop.element.get("clean_command") is not None, several)
                    kind = prop.element.find("DataTypeDomain/DataType").get("value")
                    self.assertEqual(kind, information.Get(
                        vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), 0))
                    self.assertEqual({e.get("name") for e in prop.element.iter("Group")},
                                     {"sources", "filters"})

    def test_outputs(self):
        for case, proxy in self.each():
            with case:
                ports = {}
                for element in proxy.ports:
                    ports[int(element.get("index"))] = element.get("name")
                names = by_label(proxy.label).outputs
                self.assertEqual([ports[i] for i in sorted(ports)], names)
                self.assertEqual(instance(proxy).GetNumberOfOutputPorts(), max(1, len(names)))

    def test_arrays(self):
        """An array is chosen from the input that it is read of."""
        for case, proxy, prop in self.each_property():
            with case:
                listed = next((child for child in prop.element
                               if child.tag == "ArrayListDomain"), None)
                if listed is None:
                    continue
                self.assertEqual(prop.command, "SetInputArrayToProcess")
                required = listed.find("RequiredProperties/Property")
                self.assertEqual(required.get("function"), "Input")
                owner = proxy.properties[required.get("name")]
                names = [e.get("name") for e in owner.element.findall("InputArrayDomain")]
                self.assertIn(listed.get("input_domain_name"), names)
                if prop.default is not None:
                    port = prop.default.split(";")[1]
                    self.assertEqual(port, owner.element.get("port_index", "0"))

    def test_animation(self):
        for case, _, prop in self.each_property():
            with case:
                if prop.is_value or prop.is_list:
                    self.assertEqual(prop.element.get("animateable", "1") == "1",
                                     known(prop).animateable)

    def test_integration_is_advanced(self):
        for case, proxy, prop in self.each_property():
            with case:
                if known(prop).advanced and not (
                        proxy.menu and prop.name in by_label(proxy.label).always_shown):
                    self.assertEqual(prop.element.get("panel_visibility"), "advanced")

    def test_groups(self):
        """A group has properties that there are, each in one group."""
        for case, proxy in self.each():
            with case:
                names = [e.get("name") for group in proxy.groups for e in group.findall("Property")]
                self.assertEqual(len(names), len(set(names)))
                self.assertLessEqual(set(names), set(proxy.properties))

    def test_hints(self):
        for case, proxy in self.each():
            with case:
                of_states = ("WithoutProperty", "RenamedProperty", "RenumberedProperty")  # see TestState.py
                hints = [(e.tag, dict(e.attrib)) for e in proxy.element.find("Hints")
                         if e.tag not in of_states]
                self.assertEqual(hints[0], ("ShowInMenu", {"category": "Transport"}))
                self.assertEqual(hints[1:], by_label(proxy.label).shown)

    def test_what_an_error_names_is_not_advanced(self):
        for case, _, prop in self.each_property():
            with case:
                if prop.name in {"Component", "NegativeValues", "InvertDensity"}:
                    self.assertIsNone(prop.element.get("panel_visibility"))

    def test_panel(self):
        """First what the filter is about, then the density, the output, the integration. ParaView
        keeps the order of the XML, except that a group stands where its first property does."""
        for case, proxy in self.each():
            with case:
                groups = [[e.get("name") for e in group.findall("Property")]
                          for group in proxy.groups]
                for group in groups:
                    self.assertEqual(group, [name for name in proxy.properties if name in group])
                order = []
                for name, prop in proxy.properties.items():
                    shown = prop.element.get("panel_widget") == "input_selector" or (
                        prop.element.tag != "InputProperty"
                        and not prop.element.get("information_only"))
                    group = next((group for group in groups if name in group), [name])
                    order += [each for each in group if shown and each not in order]
                self.assertEqual(order, by_label(proxy.label).panel)

    def test_tips_of_greyed_filters(self):
        """They fit into the status bar, and say what ParaView does not: to apply."""
        for case, proxy in self.each():
            with case:
                if inputs(proxy):
                    tip = inputs(proxy)[0].element.find("Hints/SelectionTip").get("text")
                    self.assertTrue(tip.startswith("Select and apply ") and len(tip) < 70, tip)

    def test_decorators_name_what_there_is(self):
        for case, proxy, prop in self.each_property():
            with case:
                found = decorators(prop)
                if "Certify" in proxy.properties:
                    shown = [one for one in found if one.get("property") == "Method"]
                    self.assertEqual([dict(one.attrib) for one in shown],
                                     [{"type": "GenericDecorator", "mode": "visibility",
                                       "property": "Method", "value": "0"}]
                                     if prop.name in OF_FLOW else [])
                    found = [one for one in found if one not in shown]
                if proxy.label == "Sample Surface" and prop.name == "RandomSeed":  # by one of two
                    self.assertEqual(
                        [[(one.get("property"), one.get("value"), one.get("inverse"))
                          for one in either.find("Expression")] for either in found],
                        [[("Method", "0", None), ("SeedPattern", "1", "1")]])
                    continue
                shown_at = by_label(proxy.label).shown_at
                if shown_at:
                    shown = [one for one in found if one.get("property") == "Method"]
                    self.assertEqual([one.get("value") for one in shown],
                                     [value for value, names in shown_at.items() if prop.name in names])
                    found = [one for one in found if one not in shown]
                if prop.name == "OptimalityTolerance":  # by one of two
                    self.assertEqual([one.get("type") for one in found], ["CompositeDecorator"])
                    either = found[0].find("Expression")
                    self.assertEqual(either.get("type"), "or")
                    self.assertEqual([(one.get("property"), one.get("value")) for one in either],
                                     [("Method", "1"), ("Certify", "1")])
                    continue
                if "Measure" in proxy.properties:
                    shown = [one for one in found if one.get("property") == "Measure"]
                    self.assertEqual([dict(one.attrib) for one in shown],
                                     [{"type": "GenericDecorator", "mode": "visibility",
                                       "property": "Measure", "value": "1"}]
                                     if prop.name in OF_MEASURE else [])
                    found = [one for one in found if one not in shown]
                elif prop.name == "DensityArray":  # where it is read
                    own = "InputIsAroundSolid" in proxy.properties
                    self.assertEqual(own, list(by_label(proxy.label).inputs.values())[0]
                                     in ("density", "densities"))
                    self.assertEqual([dict(one.attrib) for one in found],
                                     [{"type": "GenericDecorator", "mode": "visibility",
                                       "property": "InputIsAroundSolid", "value": "0"}] if own else [])
                    continue
                elif prop.name == "DensityResolution":  # by the type of the input
                    self.assertEqual([(one.get("type"), one.get("name"), one.get("exclude"))
                                      for one in found],
                                     [("InputDataTypeDecorator", "vtkImageData", "1")])
                    continue
                if prop.name == "AreaTolerance":  # by both
                    self.assertEqual([dict(one.attrib) for one in found], [
                        {"type": "GenericDecorator", "mode": "visibility", "property": "Integrator",
                         "value": "3", "inverse": "1"},
                        {"type": "GenericDecorator", "mode": "visibility",
                         "property": "NumberOfSteps", "value": "0"}])
                    continue
                self.assertEqual(len(found), 1 if depends_on(proxy, prop) else 0)
                for decorator in found:
                    self.assertEqual(decorator.get("type"), "GenericDecorator")
                    self.assertEqual(
                        decorator.get("mode"),
                        "enabled_state" if prop.name == "Parameter" else "visibility")
                    self.assertIn(decorator.get("property"), depends_on(proxy, prop))
                    owner = proxy.properties[decorator.get("property")]
                    values = (decorator.get("values") or decorator.get("value") or "").split()
                    if owner.texts or owner.boolean:
                        self.assertTrue(values)
                        self.assertLessEqual(set(values), set(owner.texts or {"0", "1"}))

    def test_properties_are_shown_where_they_change_something(self):
        for case, proxy, prop in self.each_property():
            with case:
                for decorator in decorators(prop):
                    if (decorator.get("property") in (None, "Measure", "Method")
                            or prop.name == "AreaTolerance"):
                        continue  # shown by the type of the input, and see below
                    if prop.name == "DeviceName":
                        continue  # it changes no result
                    owner = proxy.properties[decorator.get("property")]
                    method = {"Method": int(value) for value, names in
                              by_label(proxy.label).shown_at.items() if prop.name in names}
                    for value in owner.texts or (("0", "1") if owner.boolean else ()):
                        with self.subTest(**{owner.name: value}):
                            one, other = (result(
                                proxy, {**method, owner.name: int(value), prop.name: number})
                                          for number in known(prop).differing)
                            self.assertEqual(one != other, is_shown(decorator, value))

    def test_density_is_shown_where_it_is_the_measure(self):
        proxy = next(proxy for proxy in proxies() if "Measure" in proxy.properties)
        for name, case in OF_MEASURE.items():
            for measure in (0, 1) if case else ():
                with self.subTest(property=name, measure=measure):
                    one, other = (result(proxy, {"Measure": measure, name: number}, case[1])
                                  for number in case[0])
                    self.assertEqual(one != other, measure == 1)

    def test_flow_is_shown_where_it_moves_points(self):
        for proxy in proxies():
            if proxy.label not in ("Sample Density", "Transport Map", "Density Equalizing Warp"):
                continue
            backward = {"Direction": 1} if "Direction" in proxy.properties else {}
            for name, values in OF_FLOW.items():
                for method in (0, 1) if values else ():
                    if name == "AreaTolerance" and proxy.label == "Sample Density":
                        continue  # small images take the fewest steps
                    with self.subTest(proxy=proxy.label, property=name, method=method):
                        one, other = (result(proxy, {**backward, "Method": method, name: number})
                                      for number in values)
                        self.assertEqual(one != other, method == 0)

    def test_tolerance_is_shown_where_it_sets_steps(self):
        proxy = next(proxy for proxy in proxies() if proxy.label == "Density Equalizing Warp")
        for shown, values in ((True, {}), (True, {"Integrator": 2}), (False, {"NumberOfSteps": 32}),
                              (False, {"Integrator": 3})):
            with self.subTest(**values):
                one, other = (result(proxy, {**values, "AreaTolerance": number})
                              for number in known(proxy.properties["AreaTolerance"]).differing)
                self.assertEqual(one != other, shown)

    def test_component_is_shown_for_arrays_of_several(self):
        for case, proxy, prop in self.each_property():
            with case:
                if prop.name == "Component" and depends_on(proxy, prop):
                    attributes = dict(decorators(prop)[0].attrib)
                    # The array is not the one of a single component: fifth element, its name.
                    self.assertEqual((attributes["index"], attributes["number_of_components"],
                                      attributes["inverse"]), ("4", "1", "1"))


if __name__ == "__main__":
    main()
