# SPDX-License-Identifier: BSD-3-Clause
"""What the examples share: where the plugin and the inputs are, and how a picture is framed."""
import glob
import os
import re
import runpy
import sys
import types

from paraview import simple
from rectified_arguments import number, output, parser  # for the examples, which import this
from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
DATA = os.path.join(ROOT, "Testing", "Data")
IMAGES = os.path.join(ROOT, "Documentation", "Images")
PHOTOGRAPH = os.path.join(DATA, "raccoon.png")
BRAIN = os.path.join(DATA, "brain-t1.vti")
NIGHT = os.path.join(DATA, "night-europe.png")


def file(default=PHOTOGRAPH, words="a photograph in any format that ParaView reads"):
    """An argument of a parser that is a file."""
    return dict(nargs="?", default=default, help=words)


def stem(path):
    """The name of a file without folder and ending."""
    return os.path.splitext(os.path.basename(path))[0]


def plugin_path():
    """The plugin that RT_PLUGIN names, else the one in build/, else None: ParaView looks itself."""
    built = glob.glob(os.path.join(ROOT, "build", "lib*", "**", "RectifiedTransport.so"),
                      recursive=True)
    return os.environ.get("RT_PLUGIN") or next(
        (path for path in built if os.sep + "plugins" + os.sep in path), None)


def load_plugin():
    path = plugin_path()
    if path:
        simple.LoadPlugin(path, remote=False, ns=vars(simple))
    else:
        simple.LoadDistributedPlugin("RectifiedTransport", remote=False, ns=vars(simple))


def script(name):
    """What the run.py of an example defines."""
    return types.SimpleNamespace(**runpy.run_path(os.path.join(HERE, name, "run.py")))


def fetch(source):
    """The data that a source or filter makes, brought up to date."""
    source.UpdatePipeline()
    return simple.servermanager.Fetch(source)


def result(proxy, **options):
    """What a filter makes with options set, which must not be empty; not a copy."""
    for name, value in options.items():
        setattr(proxy, name, value)
    proxy.UpdatePipeline()
    data = proxy.GetClientSideObject().GetOutputDataObject(0)
    if data.GetNumberOfPoints() == 0:
        sys.exit(1)  # the filter has said why
    return data


def producer(data):
    """A source that holds a data object."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    return source


# ParaView's guess for these may be a reader of maps.
PHOTOGRAPHS = {".png": "PNGSeriesReader", ".jpg": "JPEGSeriesReader", ".jpeg": "JPEGSeriesReader",
               ".tif": "TIFFSeriesReader", ".tiff": "TIFFSeriesReader"}


def open_image(path):
    """A reader of the image in a file of any format that ParaView reads."""
    if not os.path.isfile(path):
        sys.exit("There is no file " + path)
    kind = PHOTOGRAPHS.get(os.path.splitext(path)[1].lower())
    try:
        reader = getattr(simple, kind)(FileNames=[path]) if kind else simple.OpenDataFile(path)
    except RuntimeError:
        sys.exit("ParaView has no reader for " + path)
    image = fetch(reader)
    if not image or not image.IsA("vtkImageData") or image.GetNumberOfPoints() < 2:
        sys.exit(path + " holds no image that ParaView can read")
    return reader


def picture_view(size, background):
    """A render view without the ornaments of the window."""
    view = simple.CreateView("RenderView")
    view.ViewSize = size
    view.UseColorPaletteForBackground = 0
    view.Background = background
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    return view


def new_session(size, layout):
    """An empty session with a white view, lit as ParaView lights it."""
    simple.ResetSession()
    view = simple.CreateRenderView(registrationName="View", ViewSize=size)
    # Views that no layout has are not seen in the window that opens a state.
    simple.AssignViewToLayout(view, simple.CreateLayout(layout))
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    return view


def pixel_bounds(image):
    """The rectangle that the pixels of a photograph cover, centres and halves around them."""
    x, y = image.GetSpacing()[:2]
    return [b + s for b, s in zip(image.GetBounds(), (-x / 2, x / 2, -y / 2, y / 2))]


def look_down(view, middle, height, distance):
    """Sets the camera above a point of the plane, to show a height of it."""
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [*middle, 0]
    view.CameraPosition = [*middle, distance]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = height / 2


def moved(source, x, y, z):
    """A source's data at another place."""
    place = simple.Transform(Input=source, Transform="Transform")
    place.Transform.Translate = [x, y, z]
    return place


def paint(shown, colour):
    """Shows data in one colour."""
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = colour


def colour_by(shown, view, array, preset):
    """Shows data in one of matplotlib's maps of an array, without a legend. Returns the map."""
    simple.ColorBy(shown, array)
    shown.SetScalarBarVisibility(view, False)
    colours = simple.GetColorTransferFunction(array[1])
    try:
        colours.ApplyPreset(preset + " (matplotlib)", True)
    except RuntimeError:  # from 6 on ParaView refuses the old name
        colours.ApplyPreset(preset, True)
    return colours


def save_picture(path, view):
    """Draws a view at twice its size and averages: smooth edges for round points."""
    simple.SaveScreenshot(path, view, ImageResolution=[2 * n for n in view.ViewSize])
    drawn = vtkPNGReader()
    drawn.SetFileName(path)
    mean = vtkImageShrink3D()
    mean.SetInputConnection(drawn.GetOutputPort())
    mean.SetShrinkFactors(2, 2, 1)
    mean.MeanOn()
    mean.Update()
    writer = vtkPNGWriter()
    writer.SetInputConnection(mean.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


def save_state(path):
    """Writes the session to a state. Its paths of data are relative to the state's folder: ParaView
    finds them from any clone, by "Search files under specified directory"."""
    folder = os.path.dirname(path)
    simple.SaveState(path)
    with open(path, encoding="utf-8") as file:
        state = file.read()

    def relative(found):
        place = os.path.join(ROOT, found.group(1))
        return '"%s"' % os.path.relpath(place, folder) if os.path.isfile(place) else found.group()

    with open(path, "w", encoding="utf-8") as file:
        file.write(re.sub('"([^"]*/[^"]*)"', relative, state))
