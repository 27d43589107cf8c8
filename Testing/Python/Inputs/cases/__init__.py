# SPDX-License-Identifier: BSD-3-Clause
"""Inputs that made other programs fail, retold from their public trackers, by kind of input."""
from . import images, maps, meshes, points, regions, surfaces, values
from .case import CASES
