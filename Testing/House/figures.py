# SPDX-License-Identifier: BSD-3-Clause
"""Figures of the sources that show whether the project stays simple. `python3 Testing/House/figures.py`
prints them, one `name=value` a line. TestFigures.py compares them with budgets.json."""
import collections
import json
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
CODE = (".h", ".hxx", ".cxx", ".txx", ".cl")
BRIDGE = "Filters/Bridge/"
MATHEMATICS = ("Filters/Core/", "Filters/Surfaces/", "Filters/Devices/")
# Sources of which the build takes one or the other.
ALTERNATIVES = ("Filters/Devices/WithoutDevices.cxx",)
LONGER_PAGES = ("Documentation/Contributing.md", "Documentation/Speed.md")

Figure = collections.namedtuple("Figure", ["count", "advice"])
FIGURES = {}


def figure(advice):
    """Registers a function of a Tree as the figure of its name. `advice` says how to get below the
    budget."""
    def register(count):
        FIGURES[count.__name__] = Figure(count, advice)
        return count
    return register


class Tree:
    """The files of a checkout or of an unpacked archive, by their paths from its root. Git is not
    asked, as an archive does not have it; the folders that are read contain nothing that is built."""

    def __init__(self, root=ROOT):
        self.root = root
        self.texts = {}
        self.sources = self.files(("Filters", "Plugin"), CODE)

    def files(self, folders, endings):
        found = []
        for folder in folders:
            for path, _, names in os.walk(os.path.join(self.root, folder)):
                found += [os.path.relpath(os.path.join(path, name), self.root).replace(os.sep, "/")
                          for name in names if name.endswith(endings)]
        return sorted(found)

    def text(self, path):
        if path not in self.texts:
            with open(os.path.join(self.root, path), encoding="utf-8") as file:
                self.texts[path] = file.read()
        return self.texts[path]

    def matches(self, pattern, paths):
        return sum(len(re.findall(pattern, self.text(path), re.MULTILINE)) for path in paths)

    def under(self, *folders):
        return [path for path in self.sources if path.startswith(folders)]

    def code(self, paths):
        return sum(code_lines(self.text(path)) for path in paths)

    def rooms(self):
        """For each folder of Bridge, the folders of Bridge and Core that it includes."""
        known = collections.defaultdict(set)
        for path in self.under(BRIDGE):
            if path.count("/") < 3:
                continue
            room = path.split("/")[2]
            included = re.findall(r'#include "((?:Bridge|Core)/[A-Za-z]+)/', self.text(path))
            known[room] |= set(included) - {"Bridge/" + room}
        return known


TOKEN = re.compile(r'"(?:\\.|[^"\\])*"?|//|/\*|[^\s"/]+|/')


def code_lines(text):
    """The number of lines with code: those that are neither blank nor only a comment."""
    count = 0
    in_comment = False
    for line in text.split("\n"):
        has_code = False
        position = 0
        while position < len(line):
            if in_comment:
                end = line.find("*/", position)
                if end < 0:
                    break
                in_comment = False
                position = end + 2
            token = TOKEN.search(line, position)
            if not token or token.group() == "//":
                break
            in_comment = token.group() == "/*"
            has_code = has_code or not in_comment
            position = token.end()
        count += has_code
    return count


@figure("remove code, or use a library's")
def product(tree):
    """Lines of code of the filters and the plugin, with the XML. What is not there needs no test."""
    xml = tree.files(["Plugin"], (".xml", ".ent"))
    lines = sum(1 for path in xml for line in tree.text(path).split("\n") if line.strip())
    return tree.code(tree.sources) + lines


@figure("move what needs no VTK to Filters/Core, or use a class of VTK")
def bridge(tree):
    """Lines of code between VTK and the mathematics. No other program can use them."""
    return tree.code(tree.under(BRIDGE))


@figure("move what needs no VTK to Filters/Core, or use a class of VTK")
def share(tree):
    """The lines of code of Bridge divided by those of the mathematics."""
    return round(bridge(tree) / max(1, tree.code(tree.under(*MATHEMATICS))), 3)


@figure("move a source that hardly names VTK to Filters/Core")
def bridge_vtk_poor(tree):
    """Sources of Bridge that name VTK fewer than five times. They are mathematics in the wrong
    library."""
    def names(path):
        return re.findall(r"\bvtk[A-Z]\w*", tree.text(path).replace("vtkRectifiedTransport", ""))
    return sum(len(names(path)) < 5 for path in tree.under(BRIDGE) if path.endswith(".cxx"))


@figure("put the files into a folder of Bridge that exists")
def bridge_rooms(tree):
    """Folders of Bridge. A reader has to know what each of them is for."""
    return len({path.split("/")[2] for path in tree.under(BRIDGE) if path.count("/") > 2})


@figure("make a folder of some of the files")
def large_folders(tree):
    """Folders of Filters with more than 30 files. Nobody reads longer lists."""
    folders = collections.Counter(os.path.dirname(path) for path in tree.files(["Filters"], ("",)))
    return sum(number > 30 for number in folders.values())


@figure("include fewer folders, through one header that offers what is needed of them")
def bridge_most_known(tree):
    """The most folders of Bridge and Core that one folder of Bridge includes. A change in any of them
    may concern it."""
    return max(map(len, tree.rooms().values()), default=0)


@figure("let a folder of Bridge include one that is lower")
def bridge_floors(tree):
    """The longest chain of folders of Bridge that include each other; 99 where it is a circle."""
    known = tree.rooms()

    def floor(room, above=()):
        if room in above:
            return 99
        below = [name.split("/")[1] for name in known.get(room, ()) if name.startswith("Bridge/")]
        return 1 + max((floor(name, above + (room,)) for name in below), default=0)
    return max(map(floor, list(known)), default=0)


@figure("rename one of them, or put it into an anonymous namespace")
def doubled(tree):
    """Qualified names of several types or functions, which is undefined behaviour: the linker keeps
    one of them, whatever the others are."""
    return doubled_names(tree)


# A name follows a type and ends its parameter: words of types, as in "unsigned char", stay.
PARAMETER_NAME = re.compile(
    r"(?:(?<=[\w>])\s+|(?<=[&*])\s*)(?!(?:bool|char|double|float|int|long|short)\b)\w+"
    r"(?=\s*(?:[,)=\[]|$))")


def without_names(parameters):
    """A list of parameters, of a function or a template, as far as it distinguishes overloads."""
    return re.sub(r"\s*=[^,)]*", "", PARAMETER_NAME.sub("", parameters))


def doubled_names(tree, more=()):
    """The names, with their files, in the sources and in further folders."""
    paths = [path for path in tree.sources + tree.files(more, CODE)
             if path.endswith((".h", ".hxx", ".cxx")) and path not in ALTERNATIVES]
    ctags = subprocess.run(
        ["ctags", "--options=NONE", "--output-format=json", "--fields=+SKZ",
         "--fields-C++=+{template}{specialization}{properties}", "--language-force=C++",
         "--kinds-C++=csguf", "-L", "-", "-f", "-"],
        input="\n".join(paths), cwd=tree.root, text=True, capture_output=True, check=False)
    if ctags.returncode != 0:
        raise RuntimeError(ctags.stderr)
    found = collections.defaultdict(set)
    for tag in map(json.loads, ctags.stdout.splitlines()):
        # Members belong to their class. Names of anonymous namespaces are their file's own, as static
        # functions are.
        scope = tag.get("scope", "")
        name = scope + "::" + tag["name"] if scope else tag["name"]
        if (scope and tag["scopeKind"] != "namespace" or "__anon" in name or name == "main" or
                "static" in (tag.get("properties") or "")):
            continue
        variant = [tag.get("specialization")]
        if tag["kind"] == "function":
            name += without_names(tag.get("signature", ""))
            variant.append(without_names(tag.get("template") or ""))
        found[name, str(variant)].add(tag["path"])
    return sorted("%s (%s)" % (name, ", ".join(sorted(files)))
                  for (name, _), files in found.items() if len(files) > 1)


@figure("give the enumerator of one of the classes another name, or the same value")
def enumerators_of_two_values(tree):
    """Enumerators of the public classes that have one name and several values. A script that sets one
    class's value on another class gets something else."""
    values = collections.defaultdict(dict)
    for path in tree.sources:
        if not re.search(r"/vtk\w+\.h$", path) or path.startswith((BRIDGE, *MATHEMATICS)):
            continue
        for body in re.findall(r"enum \w+\s*\{([^}]*)\}", tree.text(path)):
            value = -1
            for entry in re.sub(r"//.*", "", body).split(","):
                found = re.fullmatch(r"\s*(\w+)\s*(?:=\s*(-?\d+)\s*)?", entry)
                if found:
                    value = int(found.group(2)) if found.group(2) else value + 1
                    values[found.group(1)][path] = value
    return sorted(name for name, of in values.items() if len(set(of.values())) > 1)


@figure("take a stage of the caller's progress instead of a share of it")
def progress_signatures(tree):
    """Parameters that say where the progress of a function ends. Every caller has to know the shares
    of what it calls."""
    return tree.matches(r"Progress& \w+, double end", tree.under(BRIDGE, *MATHEMATICS))


@figure("make the comment a sentence with a verb")
def fragments(tree):
    """Comments that begin with "of": fragments, which cannot be read without the code beside them."""
    return tree.matches(r"^\s*(?://|///) (?:Of|of) |; // of ", tree.sources)


def words_of_pages(tree):
    """The words of the README and of each page of Documentation."""
    pages = tree.files(["Documentation"], (".md",))
    pages += ["README.md"] if os.path.exists(os.path.join(tree.root, "README.md")) else []
    return {page: len(tree.text(page).split()) for page in pages}


@figure("shorten a page")
def words(tree):
    """Words of the README and the pages of Documentation. Nobody reads much."""
    return sum(words_of_pages(tree).values())


@figure("shorten the page, or part it by what its readers want")
def long_pages(tree):
    """Pages of more than 2000 words; those of developers, with their tables, may have 3000."""
    return sorted("%s (%d words)" % (page, count) for page, count in words_of_pages(tree).items()
                  if count > (3000 if page in LONGER_PAGES else 2000))


def without_ctags():
    """Why ctags cannot be used; empty if it can."""
    path = shutil.which("ctags")
    if not path:
        return "needs universal-ctags; there is no ctags"
    said = subprocess.run([path, "--version"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False).stdout
    return "" if "Universal Ctags" in said else "needs universal-ctags; ctags is another one"


def value_of(counted):
    """The value of a figure, and what it lists, if it does."""
    return (len(counted), counted) if isinstance(counted, list) else (counted, [])


def main():
    missing = without_ctags()
    if missing:
        sys.exit("figures.py " + missing)
    tree = Tree()
    for name, (count, _) in FIGURES.items():
        value, listed = value_of(count(tree))
        print(" ".join(["%s=%s" % (name, value), *listed]))


if __name__ == "__main__":
    main()
