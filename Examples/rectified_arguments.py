# SPDX-License-Identifier: BSD-3-Clause
"""The arguments of the examples: the same names and words for the same things, and --small. Needs no
ParaView."""
import argparse
import os

# Numbers that several examples take: what they say, and the least that they may be.
NUMBERS = {"size": ("pixels along the sides of the images", 8),
           "particles": ("particles a pixel; the paper has 1", 1),
           "resolution": ("cells along the longest axis of a solid; the paper has 256", 8),
           "frames": ("pictures of a morph", 2),
           "panel": ("side of each of the pictures", 16)}


class Parser(argparse.ArgumentParser):
    """A parser whose argument --small stands for others. Those that are given beside it win."""

    small = None

    def parse_args(self, args=None, namespace=None):
        given = super().parse_args(args, namespace)
        if self.small and given.small:
            # As defaults they do not depend on where --small stands among the arguments.
            self.set_defaults(**vars(super().parse_args(self.small.split())))
            given = super().parse_args(args, namespace)
        return given


def number(default, words, least=1):
    """An argument of a parser that is a whole number or, if its default is a list, are several."""
    def parsed(text):
        if not text.isdigit() or int(text) < least:
            raise argparse.ArgumentTypeError("%s is not a whole number of at least %d"
                                             % (text, least))
        return int(text)
    several = {"nargs": "+"} if isinstance(default, list) else {}
    return dict(type=parsed, default=default, help=words + " (default: %(default)s)", **several)


def parser(description, output=".", small=None, **arguments):
    """A parser of arguments: each is a default of one of NUMBERS, or keywords of add_argument; what
    has nargs "?" or "*" is given by its place, the others by --name. `small` are arguments for a quick
    try, as they are typed; the tests run an example with them."""
    made = Parser(description=description)
    for name, keywords in arguments.items():
        if isinstance(keywords, int):
            keywords = number(keywords, *NUMBERS[name])
        dashes = "" if keywords.get("nargs") in ("?", "*") else "--"
        made.add_argument(dashes + name.replace("_", "-"), **keywords)
    if small:
        made.small = small
        made.add_argument("--small", action="store_true", help="a quick try: as " + small)
    made.add_argument("--output", default=output,
                      help="folder of the pictures (default: %(default)s)")
    return made


def output(arguments, name):
    """The path of a file in the folder --output, which is made."""
    os.makedirs(arguments.output, exist_ok=True)
    return os.path.join(arguments.output, name)
