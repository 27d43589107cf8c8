# SPDX-License-Identifier: BSD-3-Clause
"""The same bits from every number of threads and every setting of Threading.

The numbers of threads are read when a process starts: one process a setting.
"""
import os
import subprocess
import sys
import unittest

from rt_testing import density_image, digest, main

SETTINGS = [("Serial", {})]
SETTINGS += [("OpenMP", {"OMP_NUM_THREADS": str(n)}) for n in (1, 2, 3)]
SETTINGS += [("VTK", {"VTK_SMP_BACKEND_IN_USE": backend, "VTK_SMP_MAX_THREADS": str(n)})
             for backend, n in (("Sequential", 1), ("STDThread", 2), ("STDThread", 3), ("TBB", 3))]
SETTINGS += [("Auto", {}), ("Auto", {"VTK_SMP_BACKEND_IN_USE": "STDThread"})]


def hashes(threading):
    """The hashes of all patterns in 2D and in 3D and of morphs with all kernels, with each
    integrator once."""
    from rectifiedtransport import vtkTransportInterpolator, vtkTransportSampler
    from vtkmodules.vtkCommonCore import vtkSMPTools
    if os.environ.get("VTK_SMP_MAX_THREADS"):
        vtkSMPTools.Initialize(int(os.environ["VTK_SMP_MAX_THREADS"]))
    lines = []
    for shape in ((200, 150), (40, 30, 20)):
        for pattern in range(5):
            sampler = vtkTransportSampler()
            sampler.SetInputData(density_image(shape))
            sampler.SetNumberOfParticles(5000)
            sampler.SetSeedPattern(pattern)
            sampler.SetIntegrator(pattern % 4)
            getattr(sampler, "SetThreadingTo" + threading)()
            sampler.Update()
            lines.append(digest(sampler.GetOutput()))
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


def in_a_process(threading, environment):
    done = subprocess.run([sys.executable, __file__, threading], env={**os.environ, **environment},
                          stdout=subprocess.PIPE, universal_newlines=True, check=True)
    return done.stdout.strip()


class Threads(unittest.TestCase):
    def test_same_bits(self):
        first = in_a_process(*SETTINGS[0])
        self.assertEqual(len(set(first.split())), 26)
        for threading, environment in SETTINGS[1:]:
            with self.subTest(threading=threading, **environment):
                self.assertEqual(in_a_process(threading, environment), first)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(hashes(sys.argv[1]))
    else:
        main()
