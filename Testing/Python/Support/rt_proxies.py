# SPDX-License-Identifier: BSD-3-Clause
"""Reads the plugin's XML: every concrete proxy with what it takes over, its class and its page."""
import glob
import os
import re
import xml.etree.ElementTree as ElementTree

from rt_testing import SOURCE


class Property:
    """A property of a proxy as its XML declares it."""

    def __init__(self, element):
        self.element = element
        self.name = element.get("name")
        self.command = element.get("command")
        self.documentation = " ".join((element.findtext("Documentation") or "").split())
        self.texts = {e.get("value"): e.get("text") for e in element.iter("Entry")}
        self.boolean = element.find("BooleanDomain") is not None

    @property
    def default(self):
        return self.element.get("default_values")

    @property
    def is_value(self):
        """Whether it is numbers with one setter, not an input, an array's choice, a list or what
        is only read."""
        return (self.element.tag in ("IntVectorProperty", "DoubleVectorProperty",
                                     "IdTypeVectorProperty")
                and not self.is_list and not self.element.get("information_only"))

    @property
    def is_list(self):
        """Whether it is as many numbers as one likes, set one by one."""
        return self.element.get("repeat_command") == "1"

    @property
    def shown_default(self):
        """The default as a person reads it."""
        if self.boolean:
            return "on" if self.default == "1" else "off"
        return self.texts.get(self.default, self.default)


class Proxy:
    """A concrete proxy: its own element, and with what it takes over its properties by name, its
    output ports and its groups. Its page has the name of its label."""

    def __init__(self, menu, elements):
        self.element = elements[-1]
        self.menu = menu
        self.label = self.element.get("label", "Vector Files")
        self.class_name = self.element.get("class")
        every = [e for element in elements for e in element]
        # Those that go on a client with the plugin are of state files of before.
        self.properties = {e.get("name"): Property(e) for e in every
                           if e.tag.endswith("Property") and e.get("client_element") != ""}
        self.ports = [e for e in every if e.tag == "OutputPort"]
        self.groups = [e for e in every if e.tag == "PropertyGroup"]


def parse(path):
    """The root of one of the plugin's XML files, with its entities in it as in the built plugin."""
    texts = []
    names = "Common", "Measure", "Method", "Surface"
    for name in (path, *(os.path.join(SOURCE, "Plugin", "Transport%s.ent" % name)
                         for name in names)):
        with open(name, encoding="utf-8") as file:
            texts.append(file.read())
    xml, common, *of_kinds = texts
    for name, entities in zip(names, ("", *of_kinds)):
        xml = xml.replace('SYSTEM "Transport%s.ent"' % name, "[%s]" % (entities + common))
    return ElementTree.fromstring(xml)


def concrete(*groups):
    """The proxies in some groups that have a class."""
    elements = {}
    for path in sorted(glob.glob(os.path.join(SOURCE, "Plugin", "*.xml"))):
        for group in parse(path):
            for element in group:
                elements[group.get("name"), element.get("name")] = element

    def chain(element):
        base = element.get("base_proxygroup"), element.get("base_proxyname")
        return (chain(elements[base]) if base[0] else []) + [element]

    return [Proxy(group, chain(element)) for (group, _), element in elements.items()
            if group in groups and element.get("class")]


def proxies():
    """The filters and sources."""
    return concrete("filters", "sources")


def written_files():
    """What the writers of ParaView's menu make files with."""
    return concrete("internal_writers")


def instance(proxy):
    """A new object of a proxy's class."""
    import rectifiedtransport
    return getattr(rectifiedtransport, proxy.class_name)()


def read_page(name):
    with open(os.path.join(SOURCE, "Documentation", name), encoding="utf-8") as file:
        return file.read()


def rows_in(text):
    """The rows of the tables of properties in a text: name, default and range."""
    tables = re.findall(r"^\| property \| default \| range \| meaning \|\n((?:\|.*\n)*)", text,
                        re.MULTILINE)
    return {row[0]: row[1:] for row in re.findall(
        r"^\| `(\w+)` \| ([^|]*) \| ([^|]*) \|[^|]*\|$", "".join(tables), re.MULTILINE)}


def shared_rows():
    """The tables in each section of the page of shared properties, by the link to its heading."""
    parts = re.split(r"^#+ (.*)$", read_page("Properties.md"), flags=re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-"): rows_in(text)
            for heading, text in zip(parts[1::2], parts[2::2])}


def page_rows(proxy):
    """The properties that a proxy's page documents, in its tables and in the sections of the page
    of shared properties that it links to. Where both have a row, the page's own counts."""
    text = read_page(proxy.label.replace(" ", "") + ".md")
    shared = shared_rows()
    rows = {}
    for section in re.findall(r"\]\(Properties\.md#([^)]*)\)", text):
        rows.update(shared[section])
    return {**rows, **rows_in(text)}
