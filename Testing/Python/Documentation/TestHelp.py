# SPDX-License-Identifier: BSD-3-Clause
"""The help that is compiled for ParaView's window: a page for each filter under the name that its ?
asks for, with all of its properties or links to them; links and pictures that are there; and the
plugin has it."""
import base64
import os
import re
import sqlite3
import unittest
import urllib.parse
import zlib

from rt_filters import FILTERS, by_label
from rt_proxies import proxies
from rt_testing import main

INDEX = "index.html"
SHARED = "Properties.html"


def compiled():
    """The namespace, the folder and the files of the compiled help by their names."""
    database = sqlite3.connect("file:%s?mode=ro" % os.environ["RT_HELP"], uri=True)
    namespace, = database.execute("select Name from NamespaceTable").fetchone()
    folder, = database.execute("select Name from FolderTable").fetchone()
    files = {name: zlib.decompress(data[4:])  # after the length that Qt writes
             for name, data in database.execute(
                 "select Name, Data from FileNameTable join FileDataTable on FileId = Id "
                 "where Data is not null")}
    database.close()
    return namespace, folder, files


class Help(unittest.TestCase):
    def setUp(self):
        self.namespace, self.folder, files = compiled()
        self.pages = {name: data.decode() for name, data in files.items() if name.endswith(".html")}
        self.pictures = {name: data for name, data in files.items() if name not in self.pages}
        self.assertGreater(len(self.pages), len(FILTERS))

    def test_where_paraview_looks(self):
        """It takes the folder to be the namespace without what follows the last point."""
        self.assertEqual(self.namespace, "RectifiedTransport.org")
        self.assertEqual(self.folder, "RectifiedTransport")

    def shared_section(self, anchor):
        """A section of the page of properties that several filters share."""
        found = re.search(r'<a name="%s">.*?(?=<h\d>|$)' % anchor, self.pages[SHARED], re.DOTALL)
        return found.group()

    def test_filters(self):
        for proxy in proxies():
            with self.subTest(proxy.label):
                name = "%s.%s.html" % (proxy.menu, proxy.element.get("name"))
                page = self.pages[name]
                self.assertIn("<title>%s</title>" % proxy.label, page)
                self.assertIn('href="%s"' % name, self.pages[INDEX])
                if not by_label(proxy.label).gives_table:
                    self.assertIn("<img", page)
                text = page + "".join(self.shared_section(link) for link in
                                      re.findall('href="%s#([^"]*)"' % SHARED, page))
                for prop in proxy.properties:
                    self.assertIn("<code>%s</code>" % prop, text)

    def test_markdown_is_gone(self):
        for name, page in self.pages.items():
            text = re.sub("<pre.*?</pre>|<code>.*?</code>", "", page, flags=re.DOTALL)
            with self.subTest(name):
                self.assertNotRegex(text, r"\]\(|```|\*\*|^\||^#|<!--|^\* ")

    def test_links(self):
        for name, page in self.pages.items():
            for link in re.findall(r'href="([^"]*)"', page):
                target, _, anchor = urllib.parse.unquote(link).partition("#")
                if target.startswith(("http:", "https:")):
                    continue
                with self.subTest("%s: %s" % (name, link)):
                    there = self.pages[target or name]
                    if anchor:
                        self.assertIn('<a name="%s">' % anchor, there)

    def test_pictures(self):
        wanted = {source for page in self.pages.values()
                  for source in re.findall(r'<img[^>]* src="([^"]*)"', page)}
        self.assertEqual(wanted, set(self.pictures))
        for name, data in self.pictures.items():
            self.assertEqual(data[:4], b"\x89PNG", name)
            self.assertLessEqual(int.from_bytes(data[16:20], "big"), 640, name)

    def test_plugin_has_it(self):
        with open(os.environ["RT_HELP"], "rb") as file:
            begin = base64.b64encode(file.read(300))
        with open(os.environ["RT_PLUGIN"], "rb") as file:
            self.assertIn(begin, file.read())


if __name__ == "__main__":
    main()
