# SPDX-License-Identifier: BSD-3-Clause
"""What the remakes of the paper's figures share: photographs, maps, tables and pictures of panels.

A picture here is an array of rows, columns and RGB, the lowest row first, as in VTK.
"""
import os
import sys
import tempfile
import time

import numpy as np
import rectified_example as example
import vtkmodules.vtkRenderingFreeType  # noqa: F401, the text renderer needs it
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkImagingColor import vtkImageLuminance
from vtkmodules.vtkImagingCore import (vtkImageExtractComponents, vtkImageInterpolator,
                                       vtkImageResize, vtkImageShiftScale, vtkImageShrink3D)
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer

LUMINANCE = [0.2126, 0.7152, 0.0722]  # of red, green and blue, Rec. 709


def table(title, headings, rows):
    """Prints lines of texts under headings, two spaces or more between the columns."""
    lines = [headings, *rows]
    widths = [max(map(len, column)) for column in zip(*lines)]
    print("\n" + title)
    for line in lines:
        print("  " + "  ".join(map(str.ljust, line, widths)).rstrip())


def apply(algorithm, data, **options):
    """What a VTK filter makes of a data object."""
    algorithm.SetInputData(data)
    for name, value in options.items():
        getattr(algorithm, "Set" + name)(value)
    algorithm.Update()
    return algorithm.GetOutput()


def polydata(points):
    """A vtkPolyData of points, given as rows of x and y or of x, y and z."""
    coordinates = np.zeros((len(points), 3))
    coordinates[:, :np.shape(points)[1]] = points
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(coordinates, deep=1))
    return data


def cells(sizes, first=0):
    """Cells of so many points each, one after the other."""
    made = vtkCellArray()
    for size in sizes:
        made.InsertNextCell(size, range(first, first + size))
        first += size
    return made


def shape(points, sizes, kind="Lines"):
    """Lines, polygons or vertices through points, so many points each."""
    data = polydata(points)
    getattr(data, "Set" + kind)(cells(sizes))
    return data


def image_of(values):
    """A vtkImageData of pixels 1 apart from an array of rows and columns; it fills [0, w] x [0, h].
    """
    image = vtkImageData()
    image.SetDimensions(*values.shape[1::-1], 1)
    image.SetOrigin(0.5, 0.5, 0)
    shape = (-1,) if values.ndim == 2 else (-1, values.shape[2])
    scalars = numpy_to_vtk(np.ascontiguousarray(values).reshape(shape), deep=1)
    scalars.SetName("Values")
    image.GetPointData().SetScalars(scalars)
    return image


def values_of(image, plane=0):
    """The point scalars of an image as rows, columns and, where there are several, components."""
    width, height, planes = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    return scalars.reshape(planes, height, width, *scalars.shape[1:])[plane]


def resized(image, width, height):
    """An image with other numbers of pixels on the same rectangle."""
    # Means over whole pixels first: the window of vtkImageResize has an end.
    columns, rows = image.GetDimensions()[:2]
    factors = max(columns // width, 1), max(rows // height, 1)
    if factors != (1, 1):
        image = apply(vtkImageShrink3D(), image, ShrinkFactors=(*factors, 1), Mean=1)
    if image.GetDimensions()[:2] == (width, height):
        return image
    resize = vtkImageResize()
    if width > columns:  # without the overshoot of the sharper window
        linear = vtkImageInterpolator()
        linear.SetInterpolationModeToLinear()
        resize.SetInterpolator(linear)
    return apply(resize, image, OutputDimensions=(width, height, 1), Border=1)


def grey_square(image, side):
    """The middle square of an image as side x side greys of 8 bits, of pixels 1 apart."""
    columns, rows = image.GetDimensions()[:2]
    size = min(columns, rows)
    left, low = (columns - size) // 2, (rows - size) // 2
    image = image_of(values_of(image)[low:low + size, left:left + size])
    if image.GetNumberOfScalarComponents() > 2:
        colours = vtkImageExtractComponents()
        colours.SetComponents(0, 1, 2)
        image = apply(vtkImageLuminance(), apply(colours, image))
    elif image.GetNumberOfScalarComponents() == 2:  # the other is alpha
        image = apply(vtkImageExtractComponents(), image, Components=0)
    if image.GetScalarType() != VTK_UNSIGNED_CHAR:
        low, high = image.GetScalarRange()
        image = apply(vtkImageShiftScale(), image, Shift=-low, Scale=255 / ((high - low) or 1),
                      OutputScalarType=VTK_UNSIGNED_CHAR)
    return image_of(values_of(resized(image, side, side)))


def photograph(path, flat=True):
    """The data of the image in a file, a picture or, where it need not be flat, a volume."""
    image = example.fetch(example.open_image(path))
    dimensions = image.GetDimensions()
    if min(dimensions[:2]) < 2 or (flat and dimensions[2] > 1):
        sys.exit("%s has %d x %d x %d values; it must be a picture%s"
                 % (path, *dimensions, "" if flat else " or a volume"))
    if not image.GetPointData().GetScalars():
        sys.exit("%s has no values at its points that are its active scalars" % path)
    return image


def colours_of(image):
    """The colours of a photograph, 0 to 1, as rows, columns and RGB; alpha lies over white."""
    values = values_of(image).astype(float)
    values = values.reshape(*values.shape[:2], -1)
    values /= 255 if image.GetScalarSize() == 1 else values.max() or 1
    if values.shape[2] in (2, 4):
        values = 1 - values[..., -1:] * (1 - values[..., :-1])
    return values if values.shape[2] == 3 else values[..., :1].repeat(3, axis=2)


def seconds(proxy):
    """The processor's time that a filter needs to come up to date."""
    start = time.process_time()
    proxy.UpdatePipeline()
    return time.process_time() - start


def fastest(proxy, name, values):
    """The least time of runs with a property at one value after another."""
    times = []
    for value in values:
        setattr(proxy, name, value)
        times.append(seconds(proxy))
    return min(times)


def field(image, name):
    """A point array of an image as rows and columns; of vectors the components x and y."""
    width, height = image.GetDimensions()[:2]
    values = vtk_to_numpy(image.GetPointData().GetArray(name))
    return values.reshape(height, width) if values.ndim == 1 else values[:, :2].reshape(
        height, width, 2)


def displacement(transport, **options):
    """The Displacement of a Transport Map with options set."""
    return field(example.result(transport, **options), "Displacement").copy()


def lengths(vectors):
    return np.sqrt((vectors ** 2).sum(axis=-1))


def quality(particles, density, block):
    """The row of Transport Quality by column, for ink."""
    measure = simple.TransportQuality(particles, Density=density, InvertDensity=1,
                                      BlockSize=block)
    row = example.fetch(measure)
    simple.Delete(measure)
    return {row.GetColumnName(i): row.GetValue(0, i).ToDouble()
            for i in range(row.GetNumberOfColumns())}


def coloured(values, low, high):
    """The picture of numbers, from blue over grey to red; NaN is black."""
    colours = simple.GetColorTransferFunction("Picture")
    colours.ApplyPreset("Cool to Warm", True)
    colours.RescaleTransferFunction(low, high)
    colours.NanColor = [0, 0, 0]
    colours.UpdateVTKObjects()
    array = numpy_to_vtk(np.ascontiguousarray(values, float).ravel(), deep=1)
    mapped = colours.GetClientSideObject().MapScalars(array, 0, -1)
    return vtk_to_numpy(mapped).reshape(*values.shape, -1)[..., :3].copy()


def coloured_vectors(vectors, longest):
    """The picture of vectors: x is red and y green, from -longest (0) to longest (255)."""
    picture = np.full((*vectors.shape[:2], 3), 128, np.uint8)
    picture[..., :2] = np.clip(127.5 * (1 + vectors / longest), 0, 255).round()
    return picture


def bytes_of(values):
    """Numbers from 0 to 1 as bytes; what lies outside is cut."""
    return (255 * values.clip(0, 1)).round().astype(np.uint8)


def grey(values):
    """The picture of greys of 8 bits."""
    return np.repeat(values[..., None], 3, axis=2)


def fitted(picture, width):
    """A picture at another width; one of fewer pixels keeps them as squares where they divide it.
    """
    times, rest = divmod(width, picture.shape[1])
    if rest == 0:
        return picture.repeat(times, axis=0).repeat(times, axis=1)
    height = max(1, round(width * picture.shape[0] / picture.shape[1]))
    return values_of(resized(image_of(picture), width, height))


def read_picture(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return values_of(reader.GetOutput())[..., :3].copy()


def drawn(draw, *arguments):
    """The picture that a function writes to the file that is its first argument."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        draw(path, *arguments)
        return read_picture(path)


def stamp(picture, words, left, low, size=16, centred=False):
    """Writes black words into a picture from a row up and from a column on, or around it."""
    style = vtkTextProperty()
    style.SetFontSize(size)
    style.SetColor(0, 0, 0)
    image, used = vtkImageData(), [0, 0]
    vtkTextRenderer.GetInstance().RenderString(style, words, image, used, 72)
    ink = values_of(image)[:, :, 3:] / 255
    left = max(0, left - int(centred) * used[0] // 2)
    room = picture[low:low + ink.shape[0], left:left + ink.shape[1]]
    room[...] = (room * (1 - ink[:room.shape[0], :room.shape[1]])).round()


def montage(path, rows, width, gap=10, caption=26):
    """Writes rows of pictures, each at a width and with its words, if any, above, as a PNG."""
    strips = []
    for row in rows:
        panels = [(words, fitted(picture, width)) for words, picture in row]
        height = max(panel.shape[0] for _, panel in panels) + caption
        strip = np.full((height + gap, len(row) * (width + gap) + gap, 3), 255, np.uint8)
        for i, (words, panel) in enumerate(panels):
            left = gap + i * (width + gap)
            low = gap + height - caption - panel.shape[0]
            strip[low:low + panel.shape[0], left:left + width] = panel
            if words:
                stamp(strip[:, :left + width], words, left, gap + height - caption + 4)
        strips.append(strip)
    widest = max(strip.shape[1] for strip in strips)
    strips = [np.pad(strip, ((0, 0), (0, widest - strip.shape[1]), (0, 0)), constant_values=255)
              for strip in strips]
    save(path, np.concatenate(strips[::-1]))


def write_montage(arguments, name, rows, **layout):
    """Writes a montage of panels of --panel into the folder --output. Returns its path."""
    path = example.output(arguments, name)
    montage(path, rows, arguments.panel, **layout)
    return path


def save(path, picture):
    writer = vtkPNGWriter()
    writer.SetInputData(image_of(picture))
    writer.SetFileName(path)
    writer.Write()
