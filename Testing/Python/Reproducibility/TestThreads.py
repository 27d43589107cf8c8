# SPDX-License-Identifier: BSD-3-Clause
"""The same bits from every number of threads and every setting of Threading.

The numbers of threads are read when a process starts: one process a setting.
"""
import os
import signal
import subprocess
import sys
import unittest

from rt_filters import PATTERNS
from rt_testing import density_image, digest, main

SETTINGS = [("Serial", {})]
SETTINGS += [("OpenMP", {"OMP_NUM_THREADS": str(n)}) for n in (1, 2, 3)]
SETTINGS += [("VTK", {"VTK_SMP_BACKEND_IN_USE": backend, "VTK_SMP_MAX_THREADS": str(n)})
             for backend, n in (("Sequential", 1), ("STDThread", 2), ("STDThread", 3), ("TBB", 3))]
SETTINGS += [("Auto", {}), ("Auto", {"VTK_SMP_BACKEND_IN_USE": "STDThread"})]


def samples(threading, shape):
    """The hashes of all patterns, with each integrator once."""
    from rectifiedtransport import vtkTransportSampler
    lines = []
    for pattern in range(len(PATTERNS)):
        sampler = vtkTransportSampler()
        sampler.SetInputData(density_image(shape))
        sampler.SetNumberOfParticles(5000)
        sampler.SetSeedPattern(pattern)
        sampler.SetIntegrator(pattern % 4)
        getattr(sampler, "SetThreadingTo" + threading)()
        sampler.Update()
        lines.append(digest(sampler.GetOutput()))
    return lines


def hashes(threading):
    """Those of samples in 2D and in 3D and of morphs with all kernels."""
    from rectifiedtransport import vtkTransportInterpolator
    from vtkmodules.vtkCommonCore import vtkSMPTools
    if os.environ.get("VTK_SMP_MAX_THREADS"):
        vtkSMPTools.Initialize(int(os.environ["VTK_SMP_MAX_THREADS"]))
    lines = samples(threading, (200, 150)) + samples(threading, (40, 30, 20))
    for shape in ((90, 70), (20, 15, 10)):
        for kernel in range(4):
            morph = vtkTransportInterpolator()
            morph.SetInputData(density_image(shape))
            morph.SetTargetData(density_image(shape, seed=1))
            morph.SetKernel(kernel)
            morph.SetParticlesPerCell(kernel + 1)
            morph.SetIntegrator(kernel)
            getattr(morph, "SetThreadingTo" + threading)()
            morph.Update()
            lines += [digest(morph.GetDensity()), digest(morph.GetParticles())]
    return " ".join(lines)


def in_a_process(threading, environment, *options):
    done = subprocess.run([sys.executable, __file__, threading, *options],
                          env={**os.environ, **environment}, stdout=subprocess.PIPE,
                          universal_newlines=True, check=True, timeout=200)
    return done.stdout.strip()


def print_of_child(threading):
    """The hashes of samples by a child that fork() makes after a run with threads."""
    samples(threading, (40, 30))
    if os.fork() == 0:
        signal.alarm(60)  # ends it if it hangs
        print(" ".join(samples(threading, (200, 150))), flush=True)
        os._exit(0)
    if os.wait()[1] != 0:
        sys.exit("the child did not end")


class Threads(unittest.TestCase):
    def test_same_bits(self):
        first = in_a_process(*SETTINGS[0])
        self.assertEqual(len(set(first.split())), 26)
        for threading, environment in SETTINGS[1:]:
            with self.subTest(threading=threading, **environment):
                self.assertEqual(in_a_process(threading, environment), first)
        if hasattr(os, "fork"):
            for threading, environment in SETTINGS[2:3] + SETTINGS[5:6] + SETTINGS[7:8]:
                with self.subTest("forked", threading=threading, **environment):
                    self.assertEqual(in_a_process(threading, environment, "forked").split(),
                                     first.split()[:5])


if __name__ == "__main__":
    if len(sys.argv) > 2:
        print_of_child(sys.argv[1])
    elif len(sys.argv) > 1:
        print(hashes(sys.argv[1]))
    else:
        main()
