# SPDX-License-Identifier: BSD-3-Clause
"""The classes of all VTK modules of the project, by the name of the module that stands for them."""
from .vtkRectifiedTransportCommon import *
from .vtkRectifiedTransportDensities import *
from .vtkRectifiedTransportDrawing import *
from .vtkRectifiedTransportMeshes import *
