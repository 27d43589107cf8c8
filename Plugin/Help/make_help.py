# SPDX-License-Identifier: BSD-3-Clause
"""Makes pages for ParaView's help of those in Documentation/, and the project file that qhelpgenerator
compiles.

A filter's page gets the name that ParaView's ? asks for: the proxy's group and name. The pages are in
the part of HTML that Qt's text browser knows.
"""
import argparse
import glob
import os
import re
import shutil
import xml.etree.ElementTree as ElementTree
from html import escape

import markdown
from PIL import Image

NAME = "RectifiedTransport"
# ParaView looks for qthelp://<namespace>/<folder>/<group>.<proxy>.html, and takes for the folder the
# namespace without its ending.
NAMESPACE = NAME + ".org"
INDEX = "index.html"
WIDEST = 640  # pixels of a picture: as many as the help's window shows beside its list of pages
BACKGROUND = ("Tutorial", "Gallery", "Recipes", "Properties", "Density", "MissingData", "OtherData",
              "Flow", "Seeds", "Inks", "Speed", "Server")
TABLE = '<table border="1" cellspacing="0" cellpadding="4">'
CODE = '<pre style="background-color: #f0f0f0; white-space: pre-wrap">'


class Page:
    """A page: its file in Documentation/, its file in the help, title, and line in the index."""

    def __init__(self, source, name, title="", summary="", menu=""):
        self.source, self.name, self.title, self.summary = source, name, title, summary
        self.menu = menu


def filter_pages(plugin):
    """The pages of what stands in ParaView's menus, by the proxies' XML."""
    pages = []
    for path in sorted(glob.glob(os.path.join(plugin, "*.xml"))):
        for group in ElementTree.parse(path).getroot().iter("ProxyGroup"):
            for proxy in group:
                if proxy.find("Hints/ShowInMenu") is None:
                    continue
                label = proxy.get("label")
                pages.append(Page(label.replace(" ", "") + ".md",
                                  "%s.%s.html" % (group.get("name"), proxy.get("name")), label,
                                  proxy.find("Documentation").get("short_help"),
                                  group.get("name")))
    return sorted(pages, key=lambda page: (page.menu, page.title))


def background_pages(documentation):
    pages = []
    for name in BACKGROUND:
        with open(os.path.join(documentation, name + ".md"), encoding="utf-8") as file:
            pages.append(Page(name + ".md", name + ".html", file.readline().strip("# \n")))
    return pages


def slug(heading, _separator):
    """What a link to a heading ends with, as on GitHub."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def shrink(source, target):
    """A picture no wider than the window, of 256 colours: a third of the bytes in the plugin."""
    with Image.open(source) as picture:
        picture = picture.convert("RGB")
        if picture.width > WIDEST:
            height = round(picture.height * WIDEST / picture.width)
            picture = picture.resize((WIDEST, height), Image.LANCZOS)
        picture.quantize(256).save(target, optimize=True)


def html_of(text, names):
    """The page in HTML. Links to pages that are not in the help become plain text."""
    def link(found):
        page, _, anchor = found.group(1).partition("#")
        if page.startswith(("http:", "https:")):
            return found.group(0)
        if page and page not in names:
            return found.group(2)
        return '<a href="%s%s">%s</a>' % (names[page] if page else "", anchor and "#" + anchor,
                                          found.group(2))

    text = re.sub(r"^<!--.*?-->$", "", text, flags=re.MULTILINE)
    made = markdown.markdown(text, extensions=["tables", "fenced_code", "toc", "sane_lists"],
                             extension_configs={"toc": {"slugify": slug}})
    made = re.sub(r'<a href="([^"]*)">(.*?)</a>', link, made, flags=re.DOTALL)
    # Qt's browser goes to names, not to identities, and draws no borders by itself.
    made = re.sub(r'<(h\d) id="([^"]*)">', r'<\1><a name="\2"></a>', made)
    return made.replace("<table>", TABLE).replace("<pre>", CODE)


def index_of(pages):
    parts = ["<h1>%s</h1>" % NAME]
    for menu, heading in (("filters", "Filters ▸ Transport"), ("sources", "Sources ▸ Transport"),
                          ("", "Background")):
        parts.append("<h2>%s</h2><ul>" % heading)
        parts += ['<li><a href="%s">%s</a>%s</li>' % (
            page.name, escape(page.title), page.summary and ": " + escape(page.summary))
                  for page in pages if page.menu == menu]
        parts.append("</ul>")
    return "\n".join(parts)


def write_page(folder, name, title, body):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write('<html><head><meta http-equiv="Content-Type" content="text/html; charset=utf-8">'
                   "<title>%s</title></head>\n<body>\n%s\n</body></html>\n" % (escape(title), body))


def write_project(folder, pages, pictures):
    sections = "\n".join('<section title="%s" ref="%s"/>' % (escape(page.title), page.name)
                         for page in pages)
    keywords = "\n".join('<keyword name="%s" ref="%s"/>' % (escape(page.title), page.name)
                         for page in pages)
    files = "\n".join("<file>%s</file>" % name
                      for name in [INDEX, *(page.name for page in pages), *sorted(pictures)])
    with open(os.path.join(folder, NAME + ".qhp"), "w", encoding="utf-8") as file:
        file.write("""<?xml version="1.0" encoding="UTF-8"?>
<QtHelpProject version="1.0">
<namespace>%s</namespace>
<virtualFolder>%s</virtualFolder>
<filterSection>
<toc><section title="%s" ref="%s">
%s
</section></toc>
<keywords>
%s
</keywords>
<files>
%s
</files>
</filterSection>
</QtHelpProject>
""" % (NAMESPACE, NAME, NAME, INDEX, sections, keywords, files))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", help="the project's folder")
    parser.add_argument("plugin", help="the folder of the plugin's XML, with its entities in it")
    parser.add_argument("output", help="the folder of the pages, made anew")
    arguments = parser.parse_args()
    documentation = os.path.join(arguments.source, "Documentation")
    pages = filter_pages(arguments.plugin) + background_pages(documentation)
    names = {page.source: page.name for page in pages}

    shutil.rmtree(arguments.output, ignore_errors=True)
    os.makedirs(os.path.join(arguments.output, "Images"))
    pictures = set()
    for page in pages:
        with open(os.path.join(documentation, page.source), encoding="utf-8") as file:
            body = html_of(file.read(), names)
        write_page(arguments.output, page.name, page.title, body)
        pictures.update(re.findall(r'<img[^>]* src="([^"]+)"', body))
    for picture in pictures:
        shrink(os.path.join(documentation, picture), os.path.join(arguments.output, picture))
    write_page(arguments.output, INDEX, NAME, index_of(pages))
    write_project(arguments.output, pages, pictures)


if __name__ == "__main__":
    main()
