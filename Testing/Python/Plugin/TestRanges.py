# SPDX-License-Identifier: BSD-3-Clause
"""A property has one range: the panel's text and the page give the same, its domain is that or, for
the slider, a part of it from its lowest, and the filter takes what is in it and refuses by name what is
just outside."""
import math
import re
import unittest
from typing import NamedTuple

from rt_filters import by_label
from rt_proxies import instance, page_rows, proxies
from rt_testing import Listener, connect_inputs, density_image, main, points_in, size_of

# A text on bounds or on a choice of several numbers states no range of one number.
WITHOUT = {"Bounds", "ValidRange"}
# A slider of 100 pixels has steps of a hundredth of this.
LONGEST_SLIDER = 100000
# What counts for Equal Mass Cells with Measure Density only.
DENSITY = {"Component", "DensityResolution", "NegativeValues", "NaNValues"}


class Range(NamedTuple):
    """From a lowest to a highest number, either of which may itself be excluded."""
    lowest: float = -math.inf
    excluded: bool = False
    highest: float = math.inf
    below: bool = False


def range_of(text):
    """The range that words give: «0 to 1», «2 or 3», «0 to less than 1», «1 and more», «above 0, at
    most 10000», «above 0, below 1»."""
    number = r"(-?\d+(?:\.\d+)?)"
    found = re.match("any integer$", text)
    if found:
        return Range()
    found = re.match("%s (?:to|or) %s(?=$|,)" % (number, number), text)
    if found:
        return Range(float(found[1]), False, float(found[2]))
    found = re.match("%s to less than %s(?=$|,)" % (number, number), text)
    if found:
        return Range(float(found[1]), False, float(found[2]), True)
    found = re.match("above %s, below %s(?=$|,)" % (number, number), text)
    if found:
        return Range(float(found[1]), True, float(found[2]), True)
    found = re.match("(?:above|greater than) %s(?:, at most %s)?(?=$|,)" % (number, number), text)
    if found:
        return Range(float(found[1]), True, float(found[2] or math.inf))
    found = re.match("(?:from )?%s(?: and more| to the number of|$)" % number, text)
    return Range(float(found[1])) if found else None


def panel_range(prop):
    found = re.search(r"Range: (.*?)\. Default", prop.documentation)
    return range_of(found[1]) if found else None


def domain(prop):
    return next((prop.element.find(tag) for tag in ("IntRangeDomain", "DoubleRangeDomain")
                 if prop.element.find(tag) is not None), None)


def number(value, whole):
    return int(value) if whole else value


def beside(value, whole, towards):
    """The next whole number or double in a direction."""
    return int(value + math.copysign(1, towards)) if whole else math.nextafter(value, towards)


def run(proxy, prop, value):
    """A filter with small inputs and one property set; its messages, and its first output."""
    filter_ = instance(proxy)
    connect_inputs(filter_)
    if hasattr(filter_, "SetDomainData"):  # a pixel holds one site
        image = density_image((4, 3))
        filter_.SetInputData(points_in(image, 1))
        filter_.SetDomainData(image)
        if prop.name in DENSITY:
            filter_.SetMeasureToDensity()
    if hasattr(filter_, "SetNumberOfParticles"):
        filter_.SetNumberOfParticles(100)
    reported = Listener(filter_)
    getattr(filter_, prop.command)(*[value] * len(prop.default.split()))
    filter_.Update()
    return reported, filter_.GetOutputDataObject(0)


class Ranges(unittest.TestCase):
    def each_range(self):
        for proxy in proxies():
            for name, prop in proxy.properties.items():
                if prop.is_value and not prop.texts and not prop.boolean and name not in WITHOUT:
                    yield self.subTest(proxy=proxy.label, property=name), proxy, prop

    def test_there_are_ranges_of_both_kinds(self):
        tags = [prop.element.tag for _, _, prop in self.each_range()]
        for tag in ("IntVectorProperty", "DoubleVectorProperty"):
            self.assertGreater(tags.count(tag), 5)

    def test_panel_text_and_domain(self):
        for case, _, prop in self.each_range():
            with case:
                stated = panel_range(prop)
                self.assertIsNotNone(stated, prop.documentation)
                shown = domain(prop)
                self.assertIsNotNone(shown, "a domain")
                self.assertEqual(shown.tag[:3], prop.element.tag[:3])
                self.assertEqual(float(shown.get("min", -math.inf)), stated.lowest)
                end = float(shown.get("max", math.inf))
                self.assertLessEqual(end, stated.highest, prop.documentation)
                for value in map(float, prop.default.split()):
                    self.assertLessEqual(value, end)
                if stated.lowest > -math.inf and end < math.inf:  # there is a slider
                    self.assertLessEqual(end, LONGEST_SLIDER)

    def test_panel_text_and_page(self):
        for case, proxy, prop in self.each_range():
            with case:
                self.assertEqual(range_of(page_rows(proxy)[prop.name][1].replace("−", "-")),
                                 panel_range(prop))

    def test_default_is_inside(self):
        for case, _, prop in self.each_range():
            with case:
                allowed = panel_range(prop)
                for value in map(float, prop.default.split()):
                    self.assertLessEqual(allowed.lowest, value)
                    self.assertLessEqual(value, allowed.highest)

    def assert_taken(self, proxy, prop, value):
        reported, output = run(proxy, prop, value)
        self.assertEqual(reported.errors, [], "%s = %r" % (prop.name, value))
        self.assertGreater(size_of(output), 0)

    def assert_refused(self, proxy, prop, value):
        reported, output = run(proxy, prop, value)
        self.assertTrue(reported.errors, "%s = %r" % (prop.name, value))
        self.assertIn(prop.name + " is ", reported.errors[0])
        self.assertEqual(size_of(output), 0)

    def test_filter(self):
        for case, proxy, prop in self.each_range():
            with case:
                allowed = panel_range(prop)
                whole = prop.element.tag == "IntVectorProperty"
                if allowed.lowest > -math.inf and allowed.excluded:
                    self.assert_taken(proxy, prop, allowed.lowest + 1e-6)
                    self.assert_refused(proxy, prop, allowed.lowest)
                elif allowed.lowest > -math.inf:
                    self.assert_taken(proxy, prop, number(allowed.lowest, whole))
                    self.assert_refused(proxy, prop, beside(allowed.lowest, whole, -math.inf))
                if allowed.below:
                    self.assert_taken(proxy, prop, beside(allowed.highest, whole, -math.inf))
                    self.assert_refused(proxy, prop, allowed.highest)
                elif allowed.highest < math.inf:
                    if prop.name not in by_label(proxy.label).slow_at_highest:
                        self.assert_taken(proxy, prop, number(allowed.highest, whole))
                    self.assert_refused(proxy, prop, beside(allowed.highest, whole, math.inf))
                elif not whole:
                    self.assert_taken(proxy, prop, 50.0)
                if not whole:
                    self.assert_refused(proxy, prop, math.nan)

    def test_choices(self):
        """The error says the name of each value."""
        for proxy in proxies():
            for prop in proxy.properties.values():
                if prop.texts:
                    with self.subTest(proxy=proxy.label, property=prop.name):
                        named = ["%d (%s)" % (i, prop.texts[str(i)]) for i in range(len(prop.texts))]
                        for value in (-1, len(named)):
                            reported, output = run(proxy, prop, value)
                            self.assertIn("%s is %d; it must be %s or %s" % (
                                prop.name, value, ", ".join(named[:-1]), named[-1]), reported.errors[0])
                            self.assertEqual(size_of(output), 0)

    def test_infinite(self):
        """The largest component is a norm; everything else is finite."""
        for case, proxy, prop in self.each_range():
            with case:
                if prop.element.tag == "DoubleVectorProperty":
                    norm = prop.name == "NormExponent"
                    (self.assert_taken if norm else self.assert_refused)(proxy, prop, math.inf)


if __name__ == "__main__":
    main()
