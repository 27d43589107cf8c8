# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window: both entries are chosen from the menus and applied, a picture is kept."""
import os
import shutil
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

from rt_testing import OUTPUT, SOURCE, main, need_display

OPEN = """
from paraview.simple import *
photograph = PNGSeriesReader(registrationName='Photograph', FileNames=[%r])
photograph.UpdatePipeline()
Show(photograph, GetActiveViewOrCreate('RenderView'))
SetActiveSource(photograph)
"""

WINDOW = "pqClientMainWindow/"
APPLY = ("propertiesDock/propertiesPanel/Accept", "activate", "")


def events(path, *steps):
    root = ElementTree.Element("pqevents")
    for target, command, arguments in steps:
        ElementTree.SubElement(root, "pqevent", object=WINDOW + target, command=command,
                               arguments=arguments)
    ElementTree.ElementTree(root).write(path)


class Gui(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.mkdtemp(dir=OUTPUT)
        self.addCleanup(shutil.rmtree, self.home)
        settings = os.path.join(self.home, ".config", "ParaView")
        os.makedirs(settings)
        for version in ("5.11.0", "5.13.2"):
            with open(os.path.join(settings, "ParaView%s.ini" % version), "w") as file:
                file.write("[General]\nGeneralSettings.ShowWelcomeDialog=false\n")

    def play(self, script, recording):
        """Starts ParaView, plays a recording, keeps a picture of the screen, ends ParaView."""
        log_path = os.path.join(self.home, "log")
        with open(log_path, "w") as log:
            window = subprocess.Popen(
                ["paraview", "--plugins=RectifiedTransport", "--script=" + script,
                 "--test-script=" + recording, "--test-directory=" + self.home],
                env={**os.environ, "HOME": self.home,
                     "PV_PLUGIN_PATH": os.path.dirname(os.environ["RT_PLUGIN"])},
                stdout=log, stderr=subprocess.STDOUT)
        try:
            for _ in range(120):
                time.sleep(1)
                with open(log_path, encoding="utf-8", errors="replace") as log:
                    said = log.read()
                if "is finished" in said or window.poll() is not None:
                    break
            time.sleep(2)  # the window draws what the last event changed
            subprocess.run(["import", "-window", "root", os.path.join(OUTPUT, "gui.png")],
                           check=True)
        finally:
            window.kill()
            window.wait()
        return said

    def test_menus(self):
        script, recording, state = (os.path.join(self.home, name)
                                    for name in ("open.py", "play.xml", "state.pvsm"))
        with open(script, "w", encoding="utf-8") as file:
            file.write(OPEN % os.path.join(SOURCE, "Testing", "Data", "ascent.png"))
        events(recording,
               ("menubar/menuFilters/Transport", "activate", "TransportSampler"), APPLY,
               ("menubar/menuSources/Transport", "activate", "UniformSeedSource"), APPLY,
               ("menubar/menu_File", "activate", "actionFileSaveServerState"),
               ("FileSaveServerStateDialog", "filesSelected", state))
        said = self.play(script, recording)
        self.assertRegex(said, r"Success =\s+true")
        saved = ElementTree.parse(state).getroot()
        kinds = [proxy.get("type") for proxy in saved.iter("Proxy")]
        self.assertIn("UniformSeedSource", kinds)
        self.assertIn("TransportSampler", kinds)
        styles = [element.get("value") for prop in saved.iter("Property")
                  if prop.get("name") == "Representation" for element in prop.iter("Element")]
        self.assertEqual(styles.count("Point Gaussian"), 2)


if __name__ == "__main__":
    need_display()
    main()
