# SPDX-License-Identifier: BSD-3-Clause
"""What TestRankModel.py runs on two ranks, of which Open MPI counts what they send: Sample Density
of few particles, if any.

usage: rank_bytes_script.py SIDE none|On|Off"""
import sys

from paraview import simple
from rt_testing import load_plugin

load_plugin()
side, maps = int(sys.argv[1]), sys.argv[2]
image = simple.Wavelet(WholeExtent=[0, side - 1] * 3)
image.UpdatePipeline()
if maps != "none":
    simple.SampleDensity(Input=image, Tables="Tiled", NumberOfParticles=100, FlowMaps=maps,
                         NegativeValues="Clamp", SampleArrays=0, NumberOfSteps=32).UpdatePipeline()
