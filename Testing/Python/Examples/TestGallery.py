# SPDX-License-Identifier: BSD-3-Clause
"""The states of the gallery and of the recipes open from a copy of the project elsewhere and draw their
pictures; their scripts remake them."""
import glob
import os
import re
import shutil
import tempfile
import unittest

import numpy as np
from rt_examples import DATA, read
from rt_scripts import run_script
from rt_testing import OUTPUT, SOURCE, load_plugin, main, need_display

simple = load_plugin()
FOLDER = os.path.join(SOURCE, "Examples", "Gallery")
IMAGES = os.path.join(SOURCE, "Documentation", "Images")
NAMES = sorted(os.path.basename(path)[:-5] for path in glob.glob(os.path.join(FOLDER, "*.pvsm")))
DRAWN = [1200, 900]  # pixels, twice those of the pictures: as wide as these have their lines


def means(path, down=15, across=20):
    """Means of a picture, from 0 to 1, over 15 × 20 square blocks."""
    pixels = read(path)[0] / 255
    height, width = pixels.shape[:2]
    return pixels.reshape(down, height // down, across, width // across, 3).mean(axis=(1, 3))


def difference(drawn, shown):
    """The mean absolute difference of two pictures and their correlation, 0 if one is even."""
    ours, theirs = drawn - drawn.mean(), shown - shown.mean()
    lengths = np.sqrt((ours ** 2).sum() * (theirs ** 2).sum())
    correlation = (ours * theirs).sum() / lengths if lengths else 0
    return np.abs(drawn - shown).mean(), correlation


def alike(drawn, shown):
    apart, correlation = difference(drawn, shown)
    return apart < 0.04 and correlation > 0.93


class Gallery(unittest.TestCase):
    def check(self, path, name):
        shown = means(os.path.join(IMAGES, "gallery-%s.png" % name))
        drawn = means(path)
        self.assertTrue(alike(drawn, shown), "%s: difference %.3f, correlation %.3f"
                        % (path, *difference(drawn, shown)))

    def test_complete(self):
        """Each is a script, a state and a picture, which a page shows."""
        scripts = {os.path.basename(path)[:-3] for path in glob.glob(os.path.join(FOLDER, "*.py"))}
        self.assertEqual(scripts - {"run"}, set(NAMES))
        found = set()
        for page, number in (("Gallery", 21), ("Recipes", 5), ("Inks", 2)):
            shown = self.shown(page)
            self.assertEqual((len(shown), len(set(shown))), (number, number))
            found.update(shown)
        self.assertEqual(found, set(NAMES))

    @staticmethod
    def shown(page):
        """The names of the pictures of a page, each of which leads to its script."""
        with open(os.path.join(SOURCE, "Documentation", page + ".md"), encoding="utf-8") as file:
            return [name for name, script in re.findall(
                r"\(Images/gallery-([\w-]+)\.png\)\]\(\.\./Examples/Gallery/([\w-]+)\.py\)", file.read())
                    if name == script]

    def test_states(self):
        folder = tempfile.mkdtemp(dir=OUTPUT)
        self.addCleanup(shutil.rmtree, folder)
        ignored = shutil.ignore_patterns("Baseline")
        shutil.copytree(DATA, os.path.join(folder, "Testing", "Data"), ignore=ignored)
        for name in ("Gallery", "Tutorial"):
            shutil.copytree(os.path.join(SOURCE, "Examples", name),
                            os.path.join(folder, "Examples", name))
        place = os.path.join(folder, "Examples", "Gallery")
        for name in NAMES:
            with self.subTest(name):
                self.check(self.opened(place, folder, name), name)

    @staticmethod
    def listed(files):
        """The files of a property, which is a text if it takes one alone."""
        return [files] if isinstance(files, str) else files or []

    def opened(self, place, folder, name):
        """The picture of a state whose data are those of a copy."""
        simple.ResetSession()
        path = os.path.join(place, name + ".pvsm")
        with open(path, encoding="utf-8") as file:
            self.assertEqual(re.findall(r'value="((?:/|[A-Z]:).+?)"', file.read()), [])
        simple.LoadState(path, data_directory=place)
        read_files = [path for source in simple.GetSources().values()
                      for files in ("FileName", "FileNames")
                      for path in self.listed(getattr(source, files, None))]
        with open(os.path.join(FOLDER, name + ".py"), encoding="utf-8") as file:
            self.assertEqual(len(read_files) > 0, "FileName" in file.read())
        for file in read_files:
            self.assertTrue(file.startswith(folder), file)
        view = simple.FindView("View")
        self.assertIsNotNone(simple.GetLayout(view), "the window would not show the view")
        drawn = os.path.join(OUTPUT, "gallery-state-%s.png" % name)
        simple.SaveScreenshot(drawn, view, ImageResolution=DRAWN)
        return drawn

    def test_comparison(self):
        """It fails for an empty, a white and a shifted picture, and for another one."""
        all_shown = [means(os.path.join(IMAGES, "gallery-%s.png" % name)) for name in NAMES]
        for i, (name, shown) in enumerate(zip(NAMES, all_shown)):
            with self.subTest(name):
                empty = np.broadcast_to(shown[0, 0], shown.shape)
                for picture in (empty, np.ones_like(shown), np.roll(shown, 2, axis=1),
                                *all_shown[:i], *all_shown[i + 1:]):
                    self.assertTrue(alike(shown, shown))
                    self.assertFalse(alike(picture, shown), difference(picture, shown))

    def test_script(self):
        """Of those named, without a change of the states."""
        names = ["raccoon", "checkerboard", "lights", "histograms"]
        printed, messages, code = run_script(os.path.join(FOLDER, "run.py"), *names, "--output",
                                             OUTPUT)
        self.assertEqual(code, 0, printed + messages)
        for name in names:
            path = os.path.join(OUTPUT, "gallery-%s.png" % name)
            self.assertIn(path, printed)
            self.check(path, name)
        printed, messages, code = run_script(os.path.join(FOLDER, "run.py"), "racoon")
        self.assertNotEqual(code, 0)
        self.assertIn("invalid choice: 'racoon'", messages)


if __name__ == "__main__":
    need_display()
    main()
