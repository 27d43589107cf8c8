# SPDX-License-Identifier: BSD-3-Clause
"""The gallery's states open from a copy of the project elsewhere and draw its pictures; its scripts
remake them."""
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
SIZE = [600, 450]


def means(path, blocks=(15, 20)):
    """Means of a picture from 0 to 1 over 15 × 20 blocks of 30² pixels."""
    pixels = colours(path)
    height, width = pixels.shape[:2]
    down, across = blocks
    return pixels.reshape(down, height // down, across, width // across, 3).mean(axis=(1, 3))


def colours(path):
    """The rows, columns and colours of a PNG, whether it has a palette or not."""
    return np.broadcast_to(read(path)[0], (*SIZE[::-1], 3)) / 255


def difference(drawn, shown):
    """The mean absolute difference of two pictures and their correlation."""
    return np.abs(drawn - shown).mean(), np.corrcoef(drawn.ravel(), shown.ravel())[0, 1]


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
        """Twelve, each a script, a state and a picture that the page shows."""
        scripts = {os.path.basename(path)[:-3] for path in glob.glob(os.path.join(FOLDER, "*.py"))}
        self.assertEqual(scripts - {"run"}, set(NAMES))
        self.assertEqual(len(NAMES), 12)
        with open(os.path.join(SOURCE, "Documentation", "Gallery.md"), encoding="utf-8") as file:
            self.assertEqual(sorted(re.findall(r"\(Images/gallery-(\w+)\.png\)", file.read())), NAMES)

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

    def opened(self, place, folder, name):
        """The picture of a state whose data are those of a copy."""
        simple.ResetSession()
        path = os.path.join(place, name + ".pvsm")
        with open(path, encoding="utf-8") as file:
            self.assertEqual(re.findall(r'value="((?:/|[A-Z]:).+?)"', file.read()), [])
        simple.LoadState(path, data_directory=place)
        read_files = [path for source in simple.GetSources().values()
                      for files in ("FileName", "FileNames")
                      for path in getattr(source, files, None) or []]
        self.assertGreater(len(read_files), 0)
        for file in read_files:
            self.assertTrue(file.startswith(folder), file)
        view = simple.FindView("View")
        self.assertIsNotNone(simple.GetLayout(view), "the window would not show the view")
        drawn = os.path.join(OUTPUT, "gallery-state-%s.png" % name)
        simple.SaveScreenshot(drawn, view, ImageResolution=SIZE)
        return drawn

    def test_comparison(self):
        """It fails for an empty, a white, a mirrored and a shifted picture, and for another one."""
        all_shown = [means(os.path.join(IMAGES, "gallery-%s.png" % name)) for name in NAMES]
        for i, (name, shown) in enumerate(zip(NAMES, all_shown)):
            with self.subTest(name):
                corner = np.broadcast_to(shown[0, 0], shown.shape)
                nearly = corner + 1e-3 * np.random.default_rng(1).random(shown.shape)
                wrong = [nearly, np.clip(nearly + 1, 0.999, 1) + 1e-4 * nearly, shown[:, ::-1],
                         np.roll(shown, 2, axis=1), *all_shown[:i], *all_shown[i + 1:]]
                for picture in wrong:
                    self.assertFalse(alike(picture, shown), difference(picture, shown))

    def test_script(self):
        """Of those named, without a change of the states."""
        names = ["raccoon", "checkerboard", "lights"]
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
