# SPDX-License-Identifier: BSD-3-Clause
"""What the examples share: where the plugin and the inputs are, and how a picture is framed."""
import glob
import os
import sys

from paraview import simple

HERE = os.path.dirname(os.path.abspath(__file__))
DATA = os.path.join(HERE, os.pardir, "Testing", "Data")


def load_plugin():
    """Loads the plugin from RT_PLUGIN, else from build/, else from where ParaView looks itself."""
    built = glob.glob(os.path.join(HERE, os.pardir, "build", "lib*", "**", "RectifiedTransport.so"),
                      recursive=True)
    path = os.environ.get("RT_PLUGIN") or next(
        (p for p in built if os.sep + "plugins" + os.sep in p), None)
    if path:
        simple.LoadPlugin(path, remote=False, ns=vars(simple))
    else:
        simple.LoadDistributedPlugin("RectifiedTransport", remote=False, ns=vars(simple))


def open_image(path):
    """The image in a file of any format that ParaView reads, and its first array's name."""
    if not os.path.isfile(path):
        sys.exit("There is no file " + path)
    reader = simple.OpenDataFile(path)
    if reader is None:
        sys.exit("ParaView has no reader for " + path)
    reader.UpdatePipeline()
    if not reader.GetClientSideObject().GetOutputDataObject(0).IsA("vtkImageData"):
        sys.exit(path + " holds no image")
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
