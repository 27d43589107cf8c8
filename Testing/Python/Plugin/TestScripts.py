# SPDX-License-Identifier: BSD-3-Clause
"""Traced and saved scripts of a session in which the plugin was loaded before: they run as
Documentation/Server.md says. The display that tests keep open."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from rt_testing import OUTPUT, SOURCE, main, need_display

PLUGIN = os.environ["RT_PLUGIN"]
FOLDER = {"PV_PLUGIN_PATH": os.path.dirname(PLUGIN)}
IMPORT = "from paraview.simple import *\n"
RECORD = IMPORT + """
from paraview import smstate, smtrace
smtrace.start_trace()
image = Wavelet(registrationName='Image', WholeExtent=[-5, 5, -5, 5, 0, 0])
dots = SampleDensity(registrationName='Dots', Input=image, NumberOfParticles=50)
Show(dots, GetActiveViewOrCreate('RenderView'))
for name, text in ('trace.py', smtrace.stop_trace()), ('state.py', smstate.get_state()):
    with open(name, 'w', encoding='utf-8') as file:
        file.write(text + '\\n')
"""
COUNT = """
dots = FindSource('Dots')
dots.UpdatePipeline()
print('%d dots' % dots.GetDataInformation().GetNumberOfPoints())
"""
INTERRUPT = """
import os, threading
image = Wavelet(WholeExtent=[-200, 200, -200, 200, 0, 0])
dots = RelaxBlueNoise(SampleDensity(image, NumberOfParticles=2000), Density=image,
                      MaximumIterations=100000, Tolerance=0)
dots.Input.UpdatePipeline()
threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    update(dots)
except KeyboardInterrupt:
    print('interrupted')
print('%d dots' % dots.GetDataInformation().GetNumberOfPoints())
dots.MaximumIterations = 1
dots.UpdatePipeline()
print('%d dots' % dots.GetDataInformation().GetNumberOfPoints())
"""
# A server that starts anew forgets the atoms that clients have made.
ATOM = """
import ctypes
from rt_testing import need_display
need_display()
library = ctypes.CDLL('libX11.so.6')
library.XOpenDisplay.restype = ctypes.c_void_p
def atom(must_exist):
    display = ctypes.c_void_p(library.XOpenDisplay(None))
    found = library.XInternAtom(display, b'RectifiedTransport', must_exist)
    library.XCloseDisplay(display)
    return found
made = atom(0)
print('kept' if made and atom(1) == made else 'lost')
"""


def line_of_page():
    with open(os.path.join(SOURCE, "Documentation", "Server.md"), encoding="utf-8") as file:
        line, = re.findall(r"^```\n(LoadPlugin.*)\n```$", file.read(), re.MULTILINE)
    return re.sub(r'\("[^"]*"', "(%r" % PLUGIN, line) + "\n"


class Scripts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(dir=OUTPUT)
        printed = cls.run_script(RECORD, **FOLDER)
        assert os.path.exists(os.path.join(cls.folder, "state.py")), printed

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def run_script(cls, text, **environment):
        path = os.path.join(cls.folder, "run.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return subprocess.run([os.environ["RT_PVPYTHON"], path], cwd=cls.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
                              env={**os.environ, **environment}).stdout

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read() + COUNT

    def test_trace(self):
        text = self.read("trace.py")
        self.assertEqual(text.count(PLUGIN), 1, text)
        self.assertIn("50 dots", self.run_script(text))

    def test_state(self):
        text = self.read("state.py")
        self.assertNotIn("LoadPlugin", text)
        self.assertIn("name 'SampleDensity' is not defined", self.run_script(text))
        self.assertIn("50 dots", self.run_script(text, **FOLDER))
        self.assertEqual(text.count(IMPORT), 1)
        self.assertIn("50 dots", self.run_script(text.replace(IMPORT, IMPORT + line_of_page())))

    def test_interrupt(self):
        """Ctrl+C ends the run alone, and the next one runs, with the lines of the page."""
        with open(os.path.join(SOURCE, "Documentation", "Server.md"), encoding="utf-8") as file:
            lines, = re.findall(r"^```\n(import signal.*?)```$", file.read(), re.MULTILINE | re.DOTALL)
        printed = self.run_script(IMPORT + line_of_page() + lines + INTERRUPT)
        self.assertRegex(printed, r"(?s)interrupted.*0 dots.*2000 dots")

    @unittest.skipUnless(shutil.which("xvfb-run"), "needs xvfb-run")
    def test_display(self):
        path = os.path.join(self.folder, "atom.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write(ATOM)
        number = 1000 + os.getpid() % 30000  # nobody else's
        result = subprocess.run(["xvfb-run", "-a", "-n", str(number), os.environ["RT_PVPYTHON"], path],
                                text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertIn("kept", result.stdout)


if __name__ == "__main__":
    need_display()
    main()
