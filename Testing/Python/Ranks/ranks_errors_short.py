# SPDX-License-Identifier: BSD-3-Clause
"""Of TestRanksErrors.py: arrays that have a tuple too few on one rank."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkParallelCore import vtkMultiProcessController

FAULTY = vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 1


def short(data, owner="Point"):
    """The data with an array Short, which is what it says on one rank."""
    count = getattr(data, "GetNumberOf%ss" % owner)()
    array = numpy_to_vtk(np.arange(max(0, count - FAULTY), dtype=float), deep=1)
    array.SetName("Short")
    getattr(data, "Get%sData" % owner)().AddArray(array)
    return data
