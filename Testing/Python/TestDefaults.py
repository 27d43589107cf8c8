# SPDX-License-Identifier: BSD-3-Clause
"""The defaults and ranges of the XML, the C++ constructors and the documentation are the same."""
import os
import re
import unittest

from rt_proxies import proxies
from rt_testing import SOURCE, Listener, density_image, feed, main, points_in, size_of

import rectifiedtransport


def instance(proxy):
    return getattr(rectifiedtransport, proxy.class_name)()


def getter(prop):
    return "G" + prop.command[1:]


def numbers(text):
    return [float(x) for x in text.split()]


def header_comment(class_name, name):
    """The comment above a property's setter in the header of a class or of its superclasses."""
    with open(os.path.join(SOURCE, "Filters", class_name + ".h"), encoding="utf-8") as file:
        header = file.read()
    pattern = r"/\*\*((?:(?!\*/).)*)\*/\s*vtkSet\w*Macro\(%s,"
    found = re.search(pattern % name, header, re.DOTALL)
    if found:
        return " ".join(re.sub(r"^ *\* ?", "", found.group(1), flags=re.MULTILINE).split())
    base = re.search(r'#include "(vtkTransportBlend|vtk\w*Algorithm)\.h"', header).group(1)
    return header_comment(base, name)


def page_rows(proxy):
    """The tables of properties on a proxy's page: name, default and range."""
    name = proxy.label.replace(" ", "").replace("-", "") + ".md"
    with open(os.path.join(SOURCE, "Documentation", name), encoding="utf-8") as file:
        return {row[0]: row[1:] for row in re.findall(
            r"^\| `(\w+)` \| ([^|]*) \| ([^|]*) \|[^|]*\|$", file.read(), re.MULTILINE)}


def says_default(comment, text):
    """Whether a comment names a default: «Default 8192», «Error (default)», «Off by default»."""
    text = re.escape(text)
    return any(re.search(pattern % text, comment, re.IGNORECASE) for pattern in (
        r"\bdefault(?: is|,|:)? %s(?![\w]|\.\d)", r"(?<![\w.])%s \(default\)",
        r"(?<![\w.])%s by default"))


class Defaults(unittest.TestCase):
    def each_value(self):
        for proxy in proxies():
            for name, prop in proxy.properties.items():
                if prop.is_value:
                    with self.subTest(proxy=proxy.label, property=name):
                        yield proxy, prop

    def test_constructor(self):
        for proxy, prop in self.each_value():
            value = getattr(instance(proxy), getter(prop))()
            value = list(value) if isinstance(value, tuple) else [value]
            self.assertEqual(value, numbers(prop.default))

    def test_enumeration_texts(self):
        for proxy, prop in self.each_value():
            for value, text in prop.texts.items():
                filter_ = instance(proxy)
                getattr(filter_, prop.command)(int(value))
                self.assertEqual(getattr(filter_, getter(prop) + "AsString")(), text)
                getattr(filter_, "%sTo%s" % (prop.command, text))()
                self.assertEqual(getattr(filter_, getter(prop))(), int(value))

    def test_panel_text(self):
        for _, prop in self.each_value():
            self.assertTrue(prop.documentation.endswith("Default: %s." % prop.shown_default),
                            prop.documentation)

    def test_header_text(self):
        for proxy, prop in self.each_value():
            comment = header_comment(proxy.class_name, prop.name)
            self.assertTrue(says_default(comment, prop.shown_default), comment)

    def test_page(self):
        for proxy, prop in self.each_value():
            default, values = page_rows(proxy)[prop.name]
            self.assertEqual(default, prop.shown_default)
            if prop.texts:
                self.assertEqual(values.split(", "), list(prop.texts.values()))

    def test_lists_are_empty(self):
        lists = [(proxy, prop) for proxy in proxies() for prop in proxy.properties.values()
                 if prop.is_list]
        self.assertTrue(lists)
        for proxy, prop in lists:
            with self.subTest(proxy=proxy.label, property=prop.name):
                self.assertEqual(prop.element.get("number_of_elements"), "0")
                self.assertIsNone(prop.default)
                count = prop.element.get("set_number_command")
                self.assertEqual(getattr(instance(proxy), "G" + count[1:])(), 0)
                self.assertTrue(prop.documentation.endswith("Default: none."), prop.documentation)
                self.assertEqual(page_rows(proxy)[prop.name][0], "none")

    def test_page_has_nothing_else(self):
        for proxy in proxies():
            self.assertLessEqual(set(page_rows(proxy)), set(proxy.properties))

    def test_ranges(self):
        """A value on the edge of a range runs; the next one outside is refused by name."""
        for proxy, prop in self.each_value():
            domain = prop.element.find("IntRangeDomain")
            if domain is None:
                continue
            for edge, step in (("min", -1), ("max", 1)):
                if domain.get(edge) is None:
                    continue
                for value, refused in ((int(domain.get(edge)), False),
                                       (int(domain.get(edge)) + step, True)):
                    filter_ = instance(proxy)
                    feed(filter_)
                    if hasattr(filter_, "SetDomainData"):  # a pixel holds one site
                        image = density_image((4, 3))
                        filter_.SetInputData(points_in(image, 1))
                        filter_.SetDomainData(image)
                    if hasattr(filter_, "SetNumberOfParticles"):
                        filter_.SetNumberOfParticles(100)
                    heard = Listener(filter_)
                    getattr(filter_, prop.command)(*[value] * len(numbers(prop.default)))
                    filter_.Update()
                    if refused:
                        self.assertIn(prop.name, heard.errors[0])
                        self.assertIn(str(value), heard.errors[0])
                        self.assertEqual(size_of(filter_.GetOutputDataObject(0)), 0)
                    else:
                        self.assertEqual(heard.errors, [])


if __name__ == "__main__":
    main()
