# SPDX-License-Identifier: BSD-3-Clause
"""Remakes the pictures of Documentation/Gallery.md and Recipes.md and, where no --output is given, the
states beside the scripts that draw them: all, or those named."""
import contextlib
import glob
import os
import runpy
import sys

from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import rectified_example as example
from paraview import simple

NAMES = sorted(example.stem(path) for path in glob.glob(os.path.join(HERE, "*.py"))
               if not path.endswith("run.py"))


def draw(name):
    """The view that a script fills or puts in the place of ours. It finds its data from the project's
    folder."""
    example.new_session([600, 450], "Gallery")
    with contextlib.chdir(example.ROOT):
        runpy.run_path(os.path.join(HERE, name + ".py"))
    return simple.FindView("View")


def save(path, view):
    """A picture of 256 colours: a third of the bytes."""
    example.save_picture(path, view)
    with Image.open(path) as picture:
        small = picture.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    small.save(path, optimize=True)


def main():
    arguments = example.parser(
        __doc__, output=example.IMAGES,
        names=dict(nargs="*", choices=[[], *NAMES], default=[], metavar="NAME",
                   help="which pictures: " + ", ".join(NAMES))).parse_args()
    example.load_plugin()
    for name in arguments.names or NAMES:
        view = draw(name)
        path = example.output(arguments, "gallery-%s.png" % name)
        save(path, view)
        if arguments.output == example.IMAGES:
            example.save_state(os.path.join(HERE, name + ".pvsm"))
        print(path)


if __name__ == "__main__":
    main()
