# SPDX-License-Identifier: BSD-3-Clause
"""The defaults of the XML, the C++ constructors and the documentation are the same."""
import glob
import os
import re
import unittest

from rt_proxies import instance, page_rows, proxies, written_files
from rt_testing import SOURCE, main


def getter(prop):
    return "G" + prop.command[1:]


def numbers(text):
    return [float(x) for x in text.split()]


def numbers_for(prop, text):
    """Of the type that the property's setter takes."""
    return [x if prop.element.tag == "DoubleVectorProperty" else int(x) for x in numbers(text)]


def others(prop):
    """Values that are not the default, as in the XML."""
    if prop.texts:
        return [value for value in prop.texts if value != prop.default]
    if prop.boolean:
        return ["10"[int(prop.default)]]
    return [" ".join("%g" % (x + step) for x in numbers(prop.default)) for step in (1, 7)]


def printed(prop, value):
    """A value as Print() has it."""
    if prop.boolean:
        return ("Off", "On")[int(value)]
    return prop.texts.get(value, value)


def header_comment(class_name, name):
    """The comment above a property's setter in the header of a class or of its superclasses."""
    path, = glob.glob(os.path.join(SOURCE, "Filters", "*", class_name + ".h"))
    with open(path, encoding="utf-8") as file:
        header = file.read()
    pattern = r"/\*\*((?:(?!\*/).)*)\*/\s*vtkSet\w*Macro\(%s,"
    found = re.search(pattern % name, header, re.DOTALL)
    if found:
        return " ".join(re.sub(r"^ *\* ?", "", found.group(1), flags=re.MULTILINE).split())
    base = re.search(r'#include "(vtkTransportBlend|vtkTransportVectorWriter|vtk\w*Algorithm)\.h"', header).group(1)
    return header_comment(base, name)


def says_default(comment, text):
    """Whether a comment names a default: «Default 8192», «Error (default)», «Off by default»."""
    text = re.escape(text)
    return any(re.search(pattern % text, comment, re.IGNORECASE) for pattern in (
        r"\bdefault(?: is|,|:)? %s(?![\w]|\.\d)", r"(?<![\w.])%s \(default\)",
        r"(?<![\w.])%s by default"))


class Defaults(unittest.TestCase):
    def each_value(self):
        for proxy in proxies() + written_files():
            for name, prop in proxy.properties.items():
                if prop.is_value:
                    yield self.subTest(proxy=proxy.class_name, property=name), proxy, prop

    def test_constructor(self):
        for case, proxy, prop in self.each_value():
            with case:
                value = getattr(instance(proxy), getter(prop))()
                value = list(value) if isinstance(value, tuple) else [value]
                self.assertEqual(value, numbers(prop.default))

    def test_printed(self):
        """Print() has every property, by default and after it is set."""
        for case, proxy, prop in self.each_value():
            with case:
                filter_ = instance(proxy)
                self.assertIn("  %s: %s\n" % (prop.name, printed(prop, prop.default)), str(filter_))
                for value in others(prop):
                    getattr(filter_, prop.command)(*numbers_for(prop, value))
                    self.assertIn("  %s: %s\n" % (prop.name, printed(prop, value)), str(filter_))
                if prop.texts:
                    getattr(filter_, prop.command)(len(prop.texts) + 1)
                    self.assertEqual(getattr(filter_, getter(prop) + "AsString")(), "Unknown")
                    self.assertIn("  %s: Unknown\n" % prop.name, str(filter_))

    def test_enumeration_texts(self):
        for case, proxy, prop in self.each_value():
            with case:
                for value, text in prop.texts.items():
                    filter_ = instance(proxy)
                    getattr(filter_, prop.command)(int(value))
                    self.assertEqual(getattr(filter_, getter(prop) + "AsString")(), text)
                    getattr(filter_, "%sTo%s" % (prop.command, text))()
                    self.assertEqual(getattr(filter_, getter(prop))(), int(value))

    def test_panel_text(self):
        for case, _, prop in self.each_value():
            with case:
                self.assertTrue(prop.documentation.endswith("Default: %s." % prop.shown_default),
                                prop.documentation)

    def test_header_text(self):
        for case, proxy, prop in self.each_value():
            with case:
                comment = header_comment(proxy.class_name, prop.name)
                self.assertTrue(says_default(comment, prop.shown_default), comment)

    def test_page(self):
        for case, proxy, prop in self.each_value():
            with case:
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
                filter_ = instance(proxy)
                self.assertEqual(getattr(filter_, "G" + count[1:])(), 0)
                self.assertRegex(str(filter_), r"\n  %s: (automatic|equal)\n" % prop.name)
                self.assertTrue(prop.documentation.endswith("Default: none."), prop.documentation)
                self.assertEqual(page_rows(proxy)[prop.name][0], "none")

    def test_page_has_nothing_else(self):
        for proxy in proxies() + written_files():
            self.assertLessEqual(set(page_rows(proxy)), set(proxy.properties))


if __name__ == "__main__":
    main()
