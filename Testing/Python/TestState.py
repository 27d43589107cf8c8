# SPDX-License-Identifier: BSD-3-Clause
"""A pipeline comes back from a state file, a Python state and a Python trace."""
import os
import subprocess
import unittest

from rt_testing import OUTPUT, SOURCE, digest, load_plugin, main, output_of

simple = load_plugin()


def pipeline():
    """A photograph, seeds of its own, and a sampler with settings that are not the defaults."""
    photograph = simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data",
                                                                "ascent.png")])
    seeds = simple.UniformSeeds(Bounds=[0, 511, 0, 511, 0, 0], NumberOfPoints=500,
                                Pattern="Jittered")
    sampler = simple.SampleDensity(registrationName="Sampler", Input=photograph, Seeds=seeds,
                                   InvertDensity=1, FlowTime=0.75, Integrator="RungeKutta4",
                                   NumberOfSteps=12)
    return sampler


def in_a_process(script, path):
    """Runs a saved script in a new pvpython; its sampler's hash is printed by what is added."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("import sys; sys.path.insert(0, %r)\n" % os.path.dirname(__file__))
        file.write("import rt_testing; rt_testing.load_plugin()\n" + script)
        file.write("\nfrom paraview.simple import FindSource, GetSources\n"
                   "found = [s for s in GetSources().values() if s.GetXMLName() == "
                   "'TransportSampler']\n"
                   "print('HASH', len(found), rt_testing.digest(rt_testing.output_of(found[0])))\n")
    done = subprocess.run([os.environ.get("RT_PVPYTHON", "pvpython"), path],
                          stdout=subprocess.PIPE, universal_newlines=True, check=True)
    return [line for line in done.stdout.splitlines() if line.startswith("HASH")][0].split()[1:]


class State(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()

    def test_state_file(self):
        expected = digest(output_of(pipeline()))
        path = os.path.join(OUTPUT, "state.pvsm")
        simple.SaveState(path)
        simple.ResetSession()
        simple.LoadState(path)
        sampler = simple.FindSource("Sampler")
        self.assertEqual(sampler.Integrator, "RungeKutta4")
        self.assertEqual(sampler.NumberOfSteps, 12)
        self.assertEqual(digest(output_of(sampler)), expected)

    def test_python_state(self):
        from paraview import smstate
        expected = digest(output_of(pipeline()))
        script = smstate.get_state()
        self.assertIn("SampleDensity(", script)
        self.assertEqual(in_a_process(script, os.path.join(OUTPUT, "state.py")), ["1", expected])

    def test_trace(self):
        from paraview import smtrace
        smtrace.start_trace()
        expected = digest(output_of(pipeline()))
        script = smtrace.stop_trace()
        self.assertIn("SampleDensity(", script)
        self.assertEqual(in_a_process(script, os.path.join(OUTPUT, "trace.py")), ["1", expected])


if __name__ == "__main__":
    main()
