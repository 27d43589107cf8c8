# SPDX-License-Identifier: BSD-3-Clause
"""Device and DeviceName in ParaView: the list of devices, no driver before it is needed, and states
that open on machines without a device."""
import json
import os
import subprocess
import tempfile
import unittest

from rt_filters import with_property
from rt_testing import main

SCRIPT = os.path.join(os.path.dirname(__file__), "device_script.py")
INSTEAD = "; the processor did the work, with the same result"
FILTERS = [filter_.name for filter_ in with_property("Device")]
# MPI would load all drivers to see the machine.
USUAL = {"HWLOC_COMPONENTS": "-opencl"}
# OpenCL's loader then finds no driver.
WITHOUT = {"OCL_ICD_VENDORS": "/nonexistent"}
NO_DEVICE = ("OpenCL has no device on this machine", "There is no OpenCL on this machine",
             "This library was built without OpenCL")


def run(folder, *arguments, environment=None):
    done = subprocess.run([os.environ.get("RT_PVPYTHON", "pvpython"), SCRIPT, folder, *arguments],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300,
                          env={**os.environ, **USUAL, **(environment or {})})
    if done.returncode != 0:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-4000:])
    with open(os.path.join(folder, "found.json"), encoding="utf-8") as file:
        return json.load(file)


class Device(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.usual = run(folder)
            state = os.path.join(folder, "device.pvsm")
            cls.loaded = run(folder, state)
            cls.loaded_without = run(folder, state, environment=WITHOUT)
            cls.without = run(folder, environment=WITHOUT)
        cls.devices = cls.usual[FILTERS[0]]["names"][1:]

    def assert_no_device(self, warnings):
        self.assertEqual(len(warnings), 1, warnings)
        self.assertTrue(any(text in warnings[0] for text in NO_DEVICE), warnings)
        self.assertIn(INSTEAD, warnings[0])

    def test_there_is_a_device(self):
        if os.environ.get("RT_OPENCL"):
            self.assertTrue(self.devices)

    def test_no_driver_is_loaded_for_the_processor(self):
        for found in (self.usual, self.without):
            self.assertFalse(found["driver"]["cpu"])
            for name in FILTERS:
                self.assertEqual(found[name]["cpu names"], {"names": [""], "offered": [""]})
                self.assertEqual(found[name]["cpu warnings"], [])
        if any("pthread" in name for name in self.devices):  # of pocl
            self.assertTrue(self.usual["driver"]["opencl"])

    def test_list(self):
        self.assertEqual(len(set(self.devices)), len(self.devices))
        self.assertNotIn("", self.devices)
        for name in FILTERS:
            for found, expected in ((self.usual, self.devices), (self.without, [])):
                with self.subTest(name, devices=expected):
                    self.assertEqual(found[name]["names"], ["", *expected])
                    self.assertEqual(found[name]["offered"], ["", *expected])
                    self.assertEqual(found[name]["default name"], "")

    def test_same_bits(self):
        for name in FILTERS:
            with self.subTest(name):
                found, without = self.usual[name], self.without[name]
                self.assertEqual(found["digest"], found["cpu"])
                self.assertEqual(without["digest"], found["cpu"])
                if self.devices:
                    self.assertEqual(found["warnings"], [])
                self.assert_no_device(without["warnings"])

    def test_name_that_is_not_in_the_list(self):
        for name in FILTERS:
            with self.subTest(name):
                self.assertEqual(self.usual[name]["kept name"], "Another")
                hashed, warnings = self.usual[name]["unlisted"]
                self.assertEqual(hashed, self.usual[name]["cpu"])
                if self.devices:
                    self.assertEqual(len(warnings), 1)
                    self.assertIn("No OpenCL device is named 'Another'; there are '" +
                                  self.devices[0], warnings[0])
                    self.assertIn(INSTEAD, warnings[0])
                else:
                    self.assert_no_device(warnings)

    def test_states(self):
        for found, devices in ((self.loaded, self.devices), (self.loaded_without, [])):
            for name in FILTERS:
                with self.subTest(name, devices=devices):
                    self.assertEqual(found[name]["Device"], "OpenCL")
                    self.assertEqual(found[name]["DeviceName"],
                                     "Another" if name == FILTERS[0] else "")
                    self.assertEqual(found[name]["digest"], self.usual[name]["cpu"])
                    given = ["Another"] if name == FILTERS[0] else []  # is kept in the list
                    self.assertEqual(found[name]["offered"], ["", *devices, *given])
                    if not devices:
                        self.assert_no_device(found[name]["warnings"])
                    elif name != FILTERS[0]:
                        self.assertEqual(found[name]["warnings"], [])


if __name__ == "__main__":
    main()
