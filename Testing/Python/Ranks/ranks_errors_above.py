# SPDX-License-Identifier: BSD-3-Clause
"""Of TestRanksErrors.py: images whose extents do not begin at 0, where ranks have no part, as an image
or as another type."""
import numpy as np
from rectifiedtransport import vtkEqualMassCells, vtkTransportMap, vtkTransportSampler
from rt_testing import Listener
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkImageData, vtkMultiBlockDataSet, vtkPolyData,
                                           vtkRectilinearGrid)
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkParallelCore import vtkMultiProcessController

RANK = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
WHOLE = [3, 9, 2, 7, 5, 17]
LAYERS = {
    "last has none": [(5, 11), (11, 17), None],
    "first has none": [None, (5, 11), (11, 17)],
    "one has all": [None, (5, 17), None],
}


def layers(low, high, cells):
    """Of an image whose values are those of the whole one."""
    image = vtkImageData()
    image.SetExtent(*WHOLE[:4], low, high)
    count = image.GetNumberOfCells() if cells else image.GetNumberOfPoints()
    first = (low - WHOLE[4]) * (30 if cells else 42)
    array = numpy_to_vtk(1.0 + np.arange(first, first + count) % 7, deep=1)
    array.SetName("Density")
    (image.GetCellData() if cells else image.GetPointData()).SetScalars(array)
    return image


def sites():
    points = vtkPoints()
    for i in range(4):
        points.InsertNextPoint(4.0 + i, 4.0, 7.0 + 2.0 * i)
    cloud = vtkPolyData()
    cloud.SetPoints(points)
    return cloud


def report_above(report, finish, produce):
    """Rows "CLASS above cells|points WHO TYPE", by functions of the script."""
    for name, of_ranks in LAYERS.items():
        for cells in (True, False):
            for nothing in (vtkImageData, vtkRectilinearGrid, vtkMultiBlockDataSet):
                own = of_ranks[RANK]
                source = vtkTrivialProducer()
                source.SetOutput(layers(*own, cells) if own else nothing())
                if own:
                    source.SetWholeExtent(WHOLE)
                row = " above %s %s %s" % ("cells" if cells else "points", name, nothing.__name__)
                sampler = vtkTransportSampler()
                sampler.SetNumberOfParticles(60)
                report(sampler.GetClassName() + row, sampler, source)
                report("vtkTransportMap" + row, vtkTransportMap(), source)
                divided = vtkEqualMassCells()
                errors = Listener(divided).errors
                places = produce(sites())
                divided.SetInputConnection(0, places.GetOutputPort())
                divided.SetInputConnection(1, source.GetOutputPort())
                divided.SetResolution(12)
                divided.SetMeasureToDensity()
                finish("vtkEqualMassCells" + row, divided, errors)
