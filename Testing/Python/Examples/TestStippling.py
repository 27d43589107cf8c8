# SPDX-License-Identifier: BSD-3-Clause
"""Stippling for print and of films: pages, dots and their ink and colours; series that are played.

`python3 Testing/Python/run.py TestStippling --update` draws the reference pictures anew.
"""
import os
import re
import shutil
import subprocess
import unittest
import zlib

import numpy as np
from PIL import Image
from rt_examples import DATA, ExampleTest, blurred, first, read, run, tables
from rt_testing import OUTPUT, load_plugin, main, need_display, positions

PHOTOGRAPH = os.path.join(DATA, "raccoon.png")
STYLES = ["equal", "sizes", "colours", "inks"]
POINT = 25.4 / 72  # millimetres
NUMBER = r"(-?[\d.]+)"


def colours(path=PHOTOGRAPH):
    """A photograph's colours from 0 to 1, the highest row first."""
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")) / 255


def inks(picture, style):
    return 1 - (picture.min(axis=2) if style == "inks" else picture @ [0.2126, 0.7152, 0.0722])


def svg_dots(path):
    """The sides of an SVG's page in mm, and x, y, radius in mm and red, green, blue of its circles."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    sides = re.search(r'width="%smm" height="%smm" viewBox="0 0 \1 \2"' % (NUMBER, NUMBER),
                      text).groups()
    circles = re.findall(r'<circle cx="%s" cy="%s" r="%s"(?: fill="#(\w+)")?/>' % ((NUMBER,) * 3),
                         text)
    rows = [[*map(float, dot[:3]), *bytes.fromhex(dot[3] or "000000")] for dot in circles]
    return [float(side) for side in sides], np.array(rows)


def pdf_dots(path):
    """The sides of a PDF's page in points, and x, y, radius in mm and red, green, blue of its dots,
    0 to 1; those that are printed with black ink alone have NaN instead of red."""
    with open(path, "rb") as file:
        data = file.read()
    sides = [float(side) for side in
             re.search(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\s*\]", data).groups()]
    content = "".join(zlib.decompress(stream).decode() for stream in re.findall(
        rb"<<  /Filter /FlateDecode /Length \d+ >>\nstream\n(.*?)\nendstream", data, re.DOTALL))
    colour, dots = [np.nan, 0, 0], []
    for line in content.splitlines():
        *values, operation = line.split(" ")
        if operation == "g":
            colour = [np.nan, *[float(values[0])] * 2]
        elif operation == "rg":
            colour = [float(value) for value in values]
        elif operation == "Q":
            _, radius, _, _, other, x, y, *_ = values
            assert radius == other
            dots.append([float(x), float(y), float(radius), *colour])
    return sides, np.array(dots)


class Photographs(ExampleTest):
    def test_stipple_has_the_tone_of_the_photograph(self):
        """The dots' discs overlap a little, so that the drawing is somewhat lighter."""
        self.ran("StippleImage", os.path.join(DATA, "ascent.png"))
        drawn = 1 - read(os.path.join(OUTPUT, "stipple-ascent.png"))[0].mean() / 255
        ink = 1 - read(os.path.join(DATA, "ascent.png"))[0].mean() / 255
        self.assertLess(abs(drawn - ink), 0.1)

    def test_colour_stippling(self):
        """The picture's colours: on the average over blocks those of the photograph, but for the
        paper between the dots."""
        self.ran("ColourStippling")
        self.check_picture("colours-raccoon.png")
        drawn = read(os.path.join(OUTPUT, "colours-raccoon.png"))[0]
        photograph = Image.open(os.path.join(DATA, "raccoon.png")).resize(drawn.shape[1::-1])
        expected = .84 * np.asarray(photograph, float)[::-1] + .16 * 24
        difference = blurred(drawn, 40) - blurred(expected, 40)
        self.assertLess(np.abs(difference).mean(), 6)


class Print(ExampleTest):
    @classmethod
    def setUpClass(cls):
        cls.printed, messages, code = run("StipplePrint", "--width", "150")
        assert code == 0, cls.printed + messages

    def path(self, style, ending, name="raccoon"):
        return os.path.join(OUTPUT, "print-%s-%s.%s" % (name, style, ending))

    def test_picture(self):
        self.check_picture("print-raccoon.png")

    def test_dots_and_ink(self):
        """The SVG has all dots, and their area is the photograph's ink."""
        picture = colours()
        rows = tables(self.printed)[0]
        for style, row in zip(STYLES, rows):
            with self.subTest(style):
                sides, dots = svg_dots(self.path(style, "svg"))
                self.assertEqual((sides, len(dots)), ([150, 112.5], 3000))
                unit = 150 / picture.shape[1]
                area = np.pi * (dots[:, 2] ** 2).sum() / unit ** 2
                ratio = area / inks(picture, style).sum()
                self.assertAlmostEqual(ratio, 1, delta=0.01)
                self.assertAlmostEqual(first(row[3]), ratio, delta=0.001)
                low, _, high = row[2].split()
                np.testing.assert_allclose(
                    2 * np.quantile(dots[:, 2], [0, 1]), [float(low), float(high)], atol=0.001)
                self.assertEqual(low == high, style == "equal")

    def test_colours(self):
        """They are the photograph's; as inks they are right for the part of the paper they take."""
        picture = colours()
        for style in STYLES:
            dots = svg_dots(self.path(style, "svg"))[1]
            column, row = (dots[:, :2] * picture.shape[1] / 150).astype(int).T
            expected = np.zeros((len(dots), 3))
            if style == "colours":
                expected = picture[row, column]
            elif style == "inks":
                ink = inks(picture, style)[row, column][:, None]
                expected = 1 - (1 - picture[row, column]) / ink
            # A place may be rounded into the next pixel.
            wrong = (np.abs(dots[:, 3:] / 255 - expected) > 0.003).any(axis=1)
            self.assertLess(wrong.mean(), 0.01, style)

    def test_pdf(self):
        """It has the dots of the SVG, on a page of the size asked for, and black is grey."""
        for style in STYLES:
            with self.subTest(style):
                expected = svg_dots(self.path(style, "svg"))[1]
                sides, found = pdf_dots(self.path(style, "pdf"))
                np.testing.assert_allclose(np.array(sides) * POINT, [150, 112.5], atol=0.001)
                self.assertEqual(len(found), 3000)
                expected[:, 1] = 112.5 - expected[:, 1]
                np.testing.assert_allclose(found[:, :3], expected[:, :3], atol=1e-3)
                np.testing.assert_allclose(255 * found[:, 4:], expected[:, 4:], atol=0.1)
                grey = np.isnan(found[:, 3])
                if style in ("equal", "sizes"):
                    self.assertTrue(grey.all() and not found[:, 4:].any())
                else:
                    self.assertLess(grey.mean(), 0.01)
                    np.testing.assert_allclose(255 * found[~grey, 3], expected[~grey, 3], atol=0.1)

    @unittest.skipUnless(shutil.which("pdftocairo"), "needs poppler-utils")
    def test_pdf_drawn(self):
        """Another program's drawing of it has the photograph's tone, less where dots overlap."""
        picture = colours()
        for style in STYLES:
            drawn = os.path.join(OUTPUT, "print-drawn")
            subprocess.run(["pdftocairo", "-png", "-singlefile", "-r", "300",
                            self.path(style, "pdf"), drawn], check=True)
            found = colours(drawn + ".png")
            np.testing.assert_allclose(found.shape[1::-1], [150 / 25.4 * 300, 112.5 / 25.4 * 300],
                                       atol=1)
            mean, expected = found.mean(axis=(0, 1)), picture.mean(axis=(0, 1))
            if style in ("equal", "sizes"):
                expected = np.full(3, expected @ [0.2126, 0.7152, 0.0722])
            if style != "colours":  # lighter, by the paper between its dots
                np.testing.assert_allclose(mean, expected, atol=0.04)
                self.assertTrue((mean > expected - 0.005).all(), (style, mean, expected))
            left, low = (n // 6 for n in found.shape[1::-1])
            ink = inks(found, style)[:6 * low, :6 * left].reshape(6, low, 6, left).mean(axis=(1, 3))
            there = inks(picture, style)[:, :1020].reshape(6, 128, 6, 170).mean(axis=(1, 3))
            self.assertGreater(np.corrcoef(ink.ravel(), there.ravel())[0, 1], 0.99 - 0.1 *
                               (style == "colours"), style)

    def test_grey_photograph(self):
        self.ran("StipplePrint", os.path.join(DATA, "ascent.png"), "--styles", "inks",
                 "--exponent", "1")
        dots = svg_dots(self.path("inks", "svg", "ascent"))[1]
        self.assertEqual(len(np.unique(dots[:, 2])), 1)  # grey of exponent 1: as equal
        self.assertEqual(dots[:, 3:].max(), 0)

    def test_order(self):
        """With --order Path the same dots, on a shorter way."""
        found = {}
        for order in ("File", "Path"):
            self.ran("StipplePrint", os.path.join(DATA, "ascent.png"), "--styles", "equal",
                     "--order", order)
            found[order] = svg_dots(self.path("equal", "svg", "ascent"))[1]
        self.assertEqual(*[sorted(map(tuple, dots)) for dots in found.values()])
        length = [np.linalg.norm(np.diff(dots[:, :2], axis=0), axis=1).sum()
                  for dots in found.values()]
        self.assertLess(length[1], 0.8 * length[0])

    def test_refused(self):
        for option, value, words in (
                ("--order", "Shortest", "invalid choice: 'Shortest'"),
                ("--width", "0", "--width: 0 is not more than 0 and at most 5080 mm"),
                ("--width", "nan", "--width: nan is not more than 0 and at most 5080 mm"),
                ("--exponent", "0", "--exponent is 0; it must be more than 0 and at most 1"),
                ("--styles", "pretty", "invalid choice: 'pretty'"),
                ("--particles", "0", "--particles: 0 is not a whole number of at least 1")):
            self.assertIn(words, self.refused("StipplePrint", option, value))


class Video(ExampleTest):
    def test_film(self):
        """Dots of the same seeds move least and most evenly; those whose seeds go with the picture
        go with it."""
        film, edit = tables(self.ran("VideoStippling"))
        same, moving, other, random = film
        for row in other, random:
            for column in 2, 4:
                self.assertLess(first(same[column]), first(row[column]) / 1.5)
        self.assertEqual(same[5], "0.0 %")
        self.assertLess(first(moving[3]), first(moving[1]) / 2)
        self.assertLess(first(moving[3]), first(other[3]))
        self.assertLess(first(moving[5]), first(other[5]))
        self.assertLess(first(other[5]), first(random[5]))
        moved = [float(row[1].split(",")[0]) for row in edit]
        self.assertEqual(moved, sorted(moved, reverse=True))
        with Image.open(os.path.join(OUTPUT, "video-stippling.gif")) as gif:
            self.assertEqual((gif.n_frames, gif.info["duration"], gif.size), (8, 370, (320, 120)))
        self.check_picture("video-stippling.png")

    def test_refused(self):
        for arguments, words in (
                (["a", "b", "c"], "3 photographs are given; it must be one or two"),
                (["--seconds", "0"], "--seconds is 0; it must be more than 0"),
                (["--particles", "9"], "--particles: 9 is not a whole number of at least 100"),
                (["--frames", "3"], "argument --frames: 3 is not a whole number of at least 4")):
            self.assertIn(words, self.refused("VideoStippling", *arguments))

    def test_fade(self):
        printed = self.ran("VideoStippling", PHOTOGRAPH, os.path.join(DATA, "ascent.png"))
        self.assertIn("8 frames: ", printed)

    def test_played_series(self):
        """Play brings the sampler up to date: a step that changes nothing moves nothing, one that
        changes a corner moves what is far from it little, and particle i stays particle i."""
        simple = load_plugin()
        with Image.open(PHOTOGRAPH) as image:
            still = np.asarray(image.convert("L").resize((128, 96)))
        edited = still.copy()
        edited[-12:, :12] = 0
        files = []
        for i, frame in enumerate((still, still, edited, still)):
            files.append(os.path.join(OUTPUT, "played-%d.png" % i))
            Image.fromarray(frame).save(files[-1])
        series = simple.PNGSeriesReader(FileNames=files, ReadAsImageStack=0)
        sampler = simple.SampleDensity(Input=series, InvertDensity=1, NumberOfParticles=500)
        view = simple.CreateView("RenderView")
        simple.Show(sampler, view)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual(list(scene.TimeKeeper.TimestepValues), [0, 1, 2, 3])
        scene.PlayMode = "Snap To TimeSteps"
        frames = []
        for move in ["GoToFirst", *["GoToNext"] * 3, "GoToFirst"]:
            getattr(scene, move)()
            data = sampler.GetClientSideObject().GetOutputDataObject(0)
            ids = data.GetPointData().GetArray("SeedId")
            self.assertEqual([ids.GetValue(i) for i in range(500)], list(range(500)))
            self.assertEqual(data.GetInformation().Get(data.DATA_TIME_STEP()), view.ViewTime)
            frames.append(positions(data))
        scene.Play()
        self.assertEqual(view.ViewTime, 3)
        frames.append(positions(sampler.GetClientSideObject().GetOutputDataObject(0)))
        for again in 1, 3, 4, 5:
            np.testing.assert_array_equal(frames[again], frames[0])
        moved = np.linalg.norm(frames[2] - frames[0], axis=1)
        distance = np.linalg.norm(frames[0][:, :2] - [6, 6], axis=1)
        self.assertGreater(moved[distance < 20].mean(), 1)
        self.assertLess(moved[distance > 80].mean(), 0.4)
        self.assertLess(moved[distance > 80].max(), moved[distance < 20].max() / 4)


if __name__ == "__main__":
    need_display()
    main()
