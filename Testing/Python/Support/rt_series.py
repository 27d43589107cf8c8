# SPDX-License-Identifier: BSD-3-Clause
"""A source of images with time steps, and files of them."""
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter


class Series(VTKPythonAlgorithmBase):
    """Images of cells (or points), of dictionaries of arrays: the first one is the density. At the time
    `broken`, if any, it fails."""

    broken = None

    def __init__(self, steps, times=None, points=False, spacing=1.0, origins=None):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.steps = [step if isinstance(step, dict) else {"rho": step} for step in steps]
        self.times = [float(t) for t in (range(len(steps)) if times is None else times)]
        self.points, self.spacing, self.asked = points, spacing, []
        self.origins = origins or [0.0] * len(steps)

    def image(self, step):
        arrays, image = self.steps[step], vtkImageData()
        shape = next(iter(arrays.values())).shape[:next(iter(arrays.values())).ndim][::-1]
        image.SetDimensions([n + (0 if self.points else 1) for n in shape] + [1] * (3 - len(shape)))
        image.SetSpacing(np.broadcast_to(self.spacing, 3))
        image.SetOrigin(self.origins[step], 0, 0)
        for name, values in arrays.items():
            flat = np.ascontiguousarray(values).reshape(int(np.prod(shape)), -1)
            array = numpy_to_vtk(flat if flat.shape[1] > 1 else flat[:, 0], deep=1)
            array.SetName(name)
            (image.GetPointData() if self.points else image.GetCellData()).AddArray(array)
        (image.GetPointData() if self.points else image.GetCellData()).SetActiveScalars(next(iter(arrays)))
        return image

    def RequestInformation(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        info.Set(Pipeline.WHOLE_EXTENT(), self.image(0).GetExtent(), 6)
        if len(self.times) > 0:
            info.Set(Pipeline.TIME_STEPS(), self.times, len(self.times))
            info.Set(Pipeline.TIME_RANGE(), [min(self.times), max(self.times)], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        time = info.Get(Pipeline.UPDATE_TIME_STEP()) if self.times else 0
        self.asked.append(time)
        if time == self.broken:
            return 0
        step = int(np.argmin(np.abs(np.array(self.times) - time))) if self.times else 0
        vtkImageData.GetData(outputs).ShallowCopy(self.image(step))
        vtkImageData.GetData(outputs).GetInformation().Set(vtkImageData.DATA_TIME_STEP(), time)
        return 1


def write_series(folder, series):
    """The images in files. Returns the path of the .pvd file that has their times."""
    os.makedirs(folder, exist_ok=True)
    rows = []
    for step, time in enumerate(series.times):
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(os.path.join(folder, "%d.vti" % step))
        writer.SetInputData(series.image(step))
        writer.SetDataModeToBinary()
        writer.Write()
        rows.append('<DataSet timestep="%r" file="%d.vti"/>' % (time, step))
    path = os.path.join(folder, "series.pvd")
    with open(path, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="Collection" version="0.1"><Collection>%s</Collection></VTKFile>' %
                   "".join(rows))
    return path
