# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window: Transport Temporal Interpolator plays odd series, forwards and backwards, and from
a state that was saved between two steps."""
import os
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
from rt_gui import GuiTest, numbers, picture_of, save_state
from rt_series import Series, write_series
from rt_testing import OUTPUT, SOURCE, main, need_display
from rt_window import APPLY, LOADED, PANEL, choose

N = 32
RESAMPLE = (PANEL + "ResampleFactor/IntRangeWidget/LineEdit", "set_string", "4")
DELETE = ("propertiesDock/propertiesPanel/Delete", "activate", "")
FIRST, BACK, PLAY_BACK, PLAY, NEXT, LAST = (
    ("VCRToolbar/1QToolButton%d" % button, "activate", "") for button in range(6))

# A source that announces a time twice; of both steps it gives the first one.
REPEATED = """
import sys
sys.path.insert(0, %r)
from paraview.simple import *
made = ProgrammableSource(registrationName='Repeated', OutputDataSetType='vtkImageData')
asked = '''
import sys
sys.path.insert(0, %r)
from TestGuiSeries import repeated
repeated().%%s(None, None, self.GetExecutive().GetOutputInformation())'''
made.ScriptRequestInformation = asked %% 'RequestInformation'
made.Script = asked %% 'RequestData'
Show(made, GetActiveViewOrCreate('RenderView'))
ResetCamera()
SetActiveSource(made)
""" % ((os.path.join(SOURCE, "Testing", "Python", "Window"),) * 2)


def blob(x, y, n=N):
    c = (np.arange(n) + 0.5) * N / n
    return np.exp(-((c[None, :] - x) ** 2 + (c[:, None] - y) ** 2) / 18)


class Changing(Series):
    """The second step has finer cells, in another box, which ends at 40 and 36; the third is as the first."""

    def image(self, step):
        made = super().image(step)
        if step == 1:
            made.SetSpacing(0.5, 0.5, 1)
            made.SetOrigin(8, 4, 0)
        return made


def repeated():
    return Series([blob(8, 8), blob(20, 16), blob(8, 24), blob(24, 24)], times=[0, 1, 1, 2])


def warmth(name):
    """Of the pixels of a picture, without the axes in its corner and the bar of colours: red less blue."""
    picture = picture_of(name)
    inside = picture[:, int(0.2 * picture.shape[1]):int(0.85 * picture.shape[1])]
    return inside[..., 0] - inside[..., 2]


class GuiSeries(GuiTest):
    filtered = (choose("Filters", "TransportTemporalInterpolator"), RESAMPLE, APPLY)

    def opened(self, name, series):
        return (("menubar/menu_File", "activate", "actionFileOpen"),
                ("FileOpenDialog", "filesSelected", write_series(self.path(name), series)), APPLY,
                *self.filtered)

    def frames(self, name):
        """Saves a picture of each time step, gui-series-NAME.0000.png and so on."""
        return (("menubar/menu_File", "activate", "actionFileSaveAnimation"),
                ("SaveAnimationFileDialog", "filesSelected", os.path.join(OUTPUT, "gui-series-%s.png" % name)),
                ("SaveAnimationDialog/widget/OKButton", "activate", ""))

    def picture(self, name):
        return (("menubar/menu_File", "activate", "actionFileSaveScreenshot"),
                ("SaveScreenshotFileDialog", "filesSelected", os.path.join(OUTPUT, name)),
                ("SaveScreenshotDialog/widget/OKButton", "activate", ""))

    def numbers_of(self, name, values):
        """Of the time keeper in a state."""
        return numbers(ElementTree.parse(self.path(name + ".pvsm")).getroot(), "TimeKeeper", values)

    def assert_same(self, first, second):
        self.assertTrue((picture_of(first) == picture_of(second)).all(), (first, second))

    def assert_moves(self, name, frames, tolerance=0.1):
        """One round spot goes to the right and up by the same way in each frame of an interval."""
        places = []
        for frame in frames:
            y, x = np.nonzero(warmth("gui-series-%s.%04d.png" % (name, frame)) > 0.02)
            places.append((x.mean(), y.mean()))
            self.assertLess(abs(np.ptp(x) - np.ptp(y)), 0.3 * np.ptp(x))
        ways = np.diff(places, axis=0)
        self.assertTrue((ways[:, 0] > 0).all() and (ways[:, 1] < 0).all(), ways)
        np.testing.assert_allclose(ways, [ways.mean(0)] * len(ways), atol=tolerance * np.abs(ways).max())

    def test_odd_series(self):
        """One after the other in one window: played to the end and back, with a picture of each time. What is
        due is said once, as a warning; for errors `played` fails."""
        script = self.path("open.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(REPEATED)
        steps = [*self.filtered, *self.frames("repeated"), PLAY, *save_state(self.path("repeated.pvsm")),
                 DELETE, DELETE]
        for name, series in (("grids", Changing([blob(8, 8), blob(16, 16, 2 * N), blob(27, 26)])),
                             ("empty", Series([blob(8, 8), np.zeros((N, N)), blob(24, 16)])),
                             ("one", Series([blob(8, 8)], times=[5]))):
            steps += [*self.opened(name, series), *self.frames(name), LAST, BACK, BACK,
                      *self.picture("gui-series-%s-back.png" % name),
                      *save_state(self.path(name + "-between.pvsm")), PLAY,
                      *save_state(self.path(name + ".pvsm")), PLAY_BACK,
                      *save_state(self.path(name + "-back.pvsm")), DELETE, DELETE]
        log = self.played("gui-series.png", *steps, options=(*LOADED, "--script=" + script))
        for text, count in (("has no mass: that of the step before disappears where it is", 1),
                            ("has no mass: that of the next step appears where it is", 1),
                            ("The input has one time step", 1), ("WARN|", 3)):
            self.assertEqual(log.count(text), count, text)
        self.assert_played("repeated", 2)
        self.assert_moves("repeated", range(5))
        self.assert_moves("repeated", range(4, 9))
        self.assert_played("grids", 2)
        self.assert_moves("grids", range(5))
        self.assert_moves("grids", range(4, 9), 0.25)  # near the border
        self.assert_same("gui-series-grids-back.png", "gui-series-grids.0006.png")
        self.assert_played("empty", 2)
        self.assert_fades()
        self.assertEqual(self.numbers_of("one", "TimestepValues"), [5])
        self.assertEqual(self.numbers_of("one-back", "Time"), [5])
        for name in ("gui-series-one.0009.png", "gui-series-one-back.png"):
            self.assert_same(name, "gui-series-one.0000.png")
        self.check_state()

    def assert_played(self, name, end):
        self.assertEqual(self.numbers_of(name, "TimestepValues"), list(np.arange(0, end + 0.1, 0.25)))
        self.assertEqual(self.numbers_of(name, "Time"), [end])
        if name != "repeated":
            self.assertEqual(self.numbers_of(name + "-back", "Time"), [0])

    def assert_fades(self):
        """The spot of the first step fades where it is; that of the last one appears where it is."""
        seen = [warmth("gui-series-empty.%04d.png" % frame) for frame in range(9)]
        rows, columns = seen[0].shape
        # Inside of the image: the background is warmer than its blue.
        seen = [frame[rows // 4:3 * rows // 4, columns // 5:7 * columns // 10] for frame in seen]
        peaks = [picture.max() for picture in seen]
        self.assertEqual(peaks[:5], sorted(set(peaks[:5]), reverse=True))
        self.assertEqual(peaks[4:], sorted(set(peaks[4:])))
        for frame in (1, 2, 3, 5, 6, 7):
            places = [np.argwhere(picture > 0.5 * (picture.min() + picture.max())).mean(0)
                      for picture in (seen[frame], seen[0 if frame < 4 else 8])]
            np.testing.assert_allclose(*places, atol=6)
        self.assert_same("gui-series-empty-back.png", "gui-series-empty.0006.png")

    def check_state(self):
        """A state saved between two steps shows the same again, and plays on."""
        self.played("gui-series-state.png", *self.picture("gui-series-loaded.png"), NEXT,
                    *self.picture("gui-series-next.png"), *save_state(self.path("next.pvsm")),
                    options=(*LOADED, "--state=" + self.path("grids-between.pvsm")))
        self.assertEqual(self.numbers_of("grids-between", "Time"), [1.5])
        self.assert_same("gui-series-loaded.png", "gui-series-grids-back.png")
        self.assertEqual(self.numbers_of("next", "Time"), [1.75])
        self.assert_same("gui-series-next.png", "gui-series-grids.0007.png")


if __name__ == "__main__":
    need_display()
    main()
