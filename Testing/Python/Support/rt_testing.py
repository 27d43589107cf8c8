# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: small inputs, a filter's messages, hashes of its output, the plugin."""
import ctypes
import hashlib
import os
import sys
import tempfile
import time
import unittest

import numpy as np
from rt_filters import by_class
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData

SOURCE = os.environ.get("RT_SOURCE") or os.path.join(os.path.dirname(__file__), "..", "..", "..")
OUTPUT = os.environ.get("RT_OUTPUT") or "."
SKIPPED = 77


def main():
    """Runs the caller's tests; the exit code is ctest's."""
    os.makedirs(OUTPUT, exist_ok=True)
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    sys.stdout.flush()
    sys.stderr.flush()
    # Past the interpreter's end ParaView may still draw; nothing of the test is left to do.
    os._exit(0 if result.wasSuccessful() else 1)


def need_display():
    if not os.environ.get("DISPLAY"):
        print("Needs a display: xvfb-run -a ctest")
        sys.stdout.flush()
        os._exit(SKIPPED)
    keep_display()


def keep_display():
    """Connects to the X server until the process ends. Without -noreset, as `xvfb-run -a` starts it, a
    server starts anew whenever its last client leaves, and refuses who connects meanwhile."""
    try:
        library = ctypes.CDLL("libX11.so.6")
    except OSError:
        return
    library.XOpenDisplay.restype = ctypes.c_void_p
    for _ in range(50):
        if library.XOpenDisplay(None):
            return
        time.sleep(0.2)


def density_image(shape=(12, 10), cells=True, seed=0, values=None):
    """A vtkImageData of shape cells (x, y[, z]) or points with a random array Density."""
    dimensions = [n + 1 if cells else n for n in shape] + [1] * (3 - len(shape))
    image = vtkImageData()
    image.SetDimensions(dimensions)
    image.SetSpacing(0.5, 2, 1)
    if values is None:
        values = 0.1 + np.random.default_rng(seed).random(int(np.prod(shape)))
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
    array.SetName("Density")
    (image.GetCellData() if cells else image.GetPointData()).SetScalars(array)
    return image


def points_in(image, number=50, seed=3):
    """A vtkPolyData of random points in the bounds of an image."""
    low, high = np.array(image.GetBounds()).reshape(3, 2).T
    points = vtkPoints()
    points.SetData(numpy_to_vtk(
        low + (high - low) * np.random.default_rng(seed).random((number, 3)), deep=1))
    data = vtkPolyData()
    data.SetPoints(points)
    return data


def closed_surface():
    """A sphere: a vtkPolyData of triangles without an open edge."""
    from vtkmodules.vtkFiltersSources import vtkSphereSource
    source = vtkSphereSource()
    source.Update()
    return source.GetOutput()


def disk_surface():
    """A hemisphere: a vtkPolyData of triangles with one boundary."""
    from vtkmodules.vtkFiltersSources import vtkSphereSource
    source = vtkSphereSource()
    source.SetThetaResolution(12)
    source.SetEndPhi(90)
    source.Update()
    return source.GetOutput()


def region_map():
    """16 squares with a cell array Mass: a vtkPolyData of polygons in a plane."""
    from vtkmodules.vtkFiltersSources import vtkPlaneSource
    source = vtkPlaneSource()
    source.SetResolution(4, 4)
    source.Update()
    data = source.GetOutput()
    masses = numpy_to_vtk(1 + np.arange(16.0) % 5, deep=1)
    masses.SetName("Mass")
    data.GetCellData().AddArray(masses)
    return data


SURFACES = {"disk": disk_surface, "solid": closed_surface, "map": region_map}


def connect_inputs(algorithm, shape=(4, 3), number=50, cells=True):
    """Gives data to the inputs that a filter of the register requires, small images by default."""
    for port, kind in enumerate(by_class(algorithm.GetClassName()).inputs.values()):
        image = density_image(shape, cells, seed=port)
        algorithm.SetInputData(port, SURFACES[kind]() if kind in SURFACES else
                               points_in(image, number) if kind in ("points", "mesh") else image)
        if kind == "densities":
            algorithm.AddInputDataObject(port, density_image(shape, cells, seed=5))


def quick_algorithm(filter_, *inputs, **properties):
    """A new object of the class of a filter of the register, for a quick run; the arguments are those of
    connect_inputs."""
    import rectifiedtransport
    algorithm = getattr(rectifiedtransport, filter_.class_name)()
    connect_inputs(algorithm, *inputs)
    for name, value in {**filter_.quick, **properties}.items():
        set_property(algorithm, name, value)
    return algorithm


def set_property(algorithm, name, value):
    getattr(algorithm, "Set" + name)(*(value if isinstance(value, (list, tuple)) else [value]))


def chain(*algorithms):
    """The last of algorithms, each of which reads what the one before it makes."""
    for source, reader in zip(algorithms, algorithms[1:]):
        reader.SetInputConnection(source.GetOutputPort())
    return algorithms[-1]


def size_of(data):
    """How many points a data set or rows a table has."""
    return data.GetNumberOfElements(data.ROW if data.IsA("vtkTable") else data.POINT)


def positions(polydata):
    return vtk_to_numpy(polydata.GetPoints().GetData()).copy()


def digest(data):
    """A hash of the arrays of points, cells or rows, and of the points or the bounds of an image,
    to the last bit."""
    sha = hashlib.sha256()
    if data.IsA("vtkPointSet") and data.GetPoints():
        sha.update(positions(data).tobytes())
    elif data.IsA("vtkDataSet"):
        sha.update(np.array(data.GetBounds()).tobytes())
    for owner in (data.POINT, data.CELL, data.ROW):
        attributes = data.GetAttributes(owner)
        for i in range(attributes.GetNumberOfArrays() if attributes else 0):
            sha.update(attributes.GetArrayName(i).encode())
            array = attributes.GetAbstractArray(i)
            sha.update(vtk_to_numpy(array).tobytes() if array.IsNumeric() else
                       "".join(array.GetValue(j) + "\0" for j in range(array.GetNumberOfValues())).encode())
    return sha.hexdigest()


class Listener:
    """The errors and warnings of an algorithm and its executive while it runs."""

    def __init__(self, algorithm):
        self.errors = []
        self.warnings = []
        for source in (algorithm, algorithm.GetExecutive()):
            source.AddObserver("ErrorEvent", self._keeper(self.errors))
            source.AddObserver("WarningEvent", self._keeper(self.warnings))

    @staticmethod
    def _keeper(messages):
        @calldata_type(VTK_STRING)
        def keep(_source, _event, message):
            messages.append(message)
        return keep


def paraview_simple():
    """ParaView's simple module. Its functions have no help, for which ParaView searches all proxies a
    thousand times, half of what the start of a session takes."""
    from paraview import servermanager
    servermanager.ProxyNamespace.getDocumentation = lambda self, name: ""
    from paraview import simple
    return simple


def load_plugin():
    """The same with the plugin's filters in it."""
    import rectifiedtransport  # before the plugin: client-side objects then have their own classes
    simple = paraview_simple()
    simple.LoadPlugin(os.environ["RT_PLUGIN"], remote=False, ns=vars(simple))
    return simple


def surface(points, cells):
    """Polygons."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    data.SetPolys(vtkCellArray())
    for cell in cells:
        data.GetPolys().InsertNextCell(len(cell), [int(i) for i in cell])
    return data


def producer(simple, data):
    """A ParaView source that holds a data object."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def output_of(proxy):
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def reads_appended_data():
    """Whether VTK's XML readers take raw data, by which ParaView's Redistribute DataSet and its servers
    send data sets: Debian's libexpat 2.5.0-1+deb12u2 keeps ParaView 5.11 from it."""
    from vtkmodules.vtkCommonCore import vtkOutputWindow
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
    points = vtkPoints()
    for i in range(1000):
        points.InsertNextPoint(i / 7, i / 11, i / 13)
    data = vtkPolyData()
    data.SetPoints(points)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "points.vtp")
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(data)
        writer.SetFileName(path)
        writer.SetDataModeToAppended()
        writer.EncodeAppendedDataOff()
        writer.SetCompressorTypeToNone()
        writer.Write()
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(path)
        window = vtkOutputWindow.GetInstance()
        mode = window.GetDisplayMode()
        window.SetDisplayModeToNever()
        reader.Update()
        window.SetDisplayMode(mode)
        return reader.GetOutput().GetNumberOfPoints() == points.GetNumberOfPoints()
