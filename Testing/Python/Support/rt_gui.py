# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of ParaView's own window share: a home of its own, plays and the states and pictures
that they leave."""
import os
import re
import shutil
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
from PIL import Image
from rt_testing import OUTPUT, SOURCE
from rt_window import LOADED, play, write_settings

PHOTOGRAPH = os.path.join(SOURCE, "Testing", "Data", "raccoon.png")
VIEW = (320, 210, 1130, 710)  # a part of the window that is inside of its view


def save_state(path):
    return (("menubar/menu_File", "activate", "actionFileSaveServerState"),
            ("FileSaveServerStateDialog", "filesSelected", path))


def proxies_of(state):
    """The proxies of a state by their types; of several the last."""
    return {proxy.get("type"): proxy for proxy in state.iter("Proxy") if proxy.get("type")}


def values(proxy, name):
    prop = next(prop for prop in proxy.iter("Property") if prop.get("name") == name)
    return [element.get("value") for element in prop.findall("Element")]


def numbers(state, kind, name):
    return [float(value) for value in values(proxies_of(state)[kind], name)]


def picture_of(name):
    with Image.open(os.path.join(OUTPUT, name)) as window:
        return np.asarray(window.convert("RGB")).astype(float) / 255


def view_of(name):
    """The greys of the active view in a picture of the window, 0 to 1: what is in its blue frame."""
    window = picture_of(name)
    frame = (window[..., 2] > 0.9) & (window[..., :2] < 0.1).all(axis=2)
    rows, columns = np.nonzero(frame)
    border = 4
    return window[rows.min() + border:rows.max() + 1 - border,
                  columns.min() + border:columns.max() + 1 - border].mean(axis=2)


def range_of(dark):
    """Where many pixels of a row are dark: not the axes in the corner of a view."""
    found = np.nonzero(dark.mean(axis=1) > 0.05)[0]
    return (found.min(), found.max() + 1) if len(found) else (0, 0)


def blocks(greys, rows=15, columns=20):
    """Means over blocks."""
    height, width = greys.shape[0] // rows, greys.shape[1] // columns
    return greys[:height * rows, :width * columns].reshape(
        rows, height, columns, width).mean(axis=(1, 3)).ravel()


class GuiTest(unittest.TestCase):
    script = ""  # which plays of states begin with

    def setUp(self):
        self.home = tempfile.mkdtemp(dir=OUTPUT)
        self.addCleanup(shutil.rmtree, self.home)
        write_settings(self.home)

    def path(self, name):
        return os.path.join(self.home, name)

    def played(self, picture, *steps, plugin=os.environ["RT_PLUGIN"], options=LOADED):
        """Plays steps without an error. Returns ParaView's output."""
        log = play(self.home, steps, plugin, os.path.join(OUTPUT, picture), options)
        shown = "\n".join(line for line in log.splitlines() if "Available widget" not in line)[-3000:]
        self.assertTrue(re.search(r"Success =\s+true", log), shown)
        for word in ("ERR|", "pqGenericPropertyWidgetDecorator"):
            self.assertFalse(word in log, shown)
        return log

    def states_after(self, picture, *parts, script_text=None):
        """The states that ParaView saves after each part of a play, begun by a script."""
        script = self.path("open.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(self.script if script_text is None else script_text)
        states = [self.path("state-%d.pvsm" % i) for i in range(len(parts))]
        steps = [step for part, state in zip(parts, states) for step in (*part, *save_state(state))]
        self.played(picture, *steps, options=(*LOADED, "--script=" + script))
        return [ElementTree.parse(state).getroot() for state in states]

    def state_after(self, picture, *steps, **options):
        return self.states_after(picture, steps, **options)[0]

    def assert_stippled(self, picture, path=PHOTOGRAPH):
        """The view shows a photograph in black dots on white: in its middle, with its tones."""
        view = view_of(picture)
        dark = view < 0.5
        self.assertGreater(view.max(), 0.99, "the background is white")
        low, high = range_of(dark)
        left, right = range_of(dark.T)
        self.assertGreater(high - low, 0.7 * view.shape[0], "the photograph fills the view")
        self.assertAlmostEqual(low + high, view.shape[0], delta=10)
        self.assertAlmostEqual(left + right, view.shape[1], delta=10)
        with Image.open(path) as image:
            self.assertAlmostEqual((right - left) / (high - low), image.width / image.height,
                                   delta=0.03)
            ink = 1 - np.asarray(image.convert("L").resize((600, 450))).astype(float) / 255
        drawn = blocks(1 - view[low:high, left:right])
        self.assertGreater(np.corrcoef(drawn, blocks(ink))[0, 1], 0.94)
        self.assertAlmostEqual(drawn.mean() / ink.mean(), 0.75, delta=0.15)
