# SPDX-License-Identifier: BSD-3-Clause
"""Draws an island, a raster whose sea is nodata, and its cartograms: with the sea at the mean, and with
a sea of nothing."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_raster as raster
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def corners(cells):
    """Of pixels, which are no rectangles after a warp: their x and y, counter-clockwise."""
    ids = vtk_to_numpy(cells.GetCells().GetConnectivityArray()).reshape(-1, 4)[:, [0, 1, 3, 2]]
    return vtk_to_numpy(cells.GetPoints().GetData())[ids, :2].astype(float)


def largest_error(land, warped):
    """Of the areas of squares of 8 x 8 cells of the raster: 99 in 100 are better."""
    people = vtk_to_numpy(land.GetCellData().GetArray("Elevation"))
    x, y = np.moveaxis(corners(warped), 2, 0)
    area = 0.5 * (x * np.roll(y, -1, 1) - y * np.roll(x, -1, 1)).sum(axis=1)
    places = corners(land).mean(axis=1) // (8 * raster.CELL)
    square = np.unique(places, axis=0, return_inverse=True)[1].ravel()
    of_area, of_people, count = (np.bincount(square, weights) for weights in (area, people, None))
    whole = count == 64
    return np.quantile(abs(of_area / area.sum() / (of_people / people.sum()) - 1)[whole], 0.99)


def draw(path, parts, bounds, pixels):
    x0, x1, y0, y1 = bounds
    step = 1.06 * (x1 - x0)
    width = 2 * step + x1 - x0
    view = example.picture_view([pixels, round(pixels * (y1 - y0) / width)], [1, 1, 1])
    for column, part in enumerate(parts):
        frame = simple.Plane(Origin=[x0, y0, 0], Point1=[x1, y0, 0], Point2=[x0, y1, 0])
        sea = simple.Show(example.moved(frame, column * step, 0, -1), view)
        example.paint(sea, [0.86, 0.91, 0.96])
        sea.Ambient, sea.Diffuse = 1, 0
        shown = simple.Show(example.moved(part, column * step, 0, 0), view)
        shown.Ambient, shown.Diffuse = 1, 0
        colours = example.colour_by(shown, view, ("CELLS", "Elevation"), "Viridis")
        colours.RescaleTransferFunction(0, 300)
    example.look_down(view, [x0 + width / 2, (y0 + y1) / 2], y1 - y0, 2 * step)
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--pixels 600",
        pixels=example.number(1800, "width of the picture")).parse_args()
    example.load_plugin()
    path = example.output(arguments, "island.tif")
    raster.write_geotiff(path, raster.island())

    people = simple.GDALRasterReader(FileName=path)
    land = simple.Threshold(Input=people, Scalars=["CELLS", "Elevation"], LowerThreshold=0,
                            UpperThreshold=1e9)
    kept, filled = (simple.DensityEqualizingWarp(land, Density=people, **options)
                    for options in ({}, {"EmptyCells": "Zero"}))
    data = example.fetch(people)
    for name, warp in ("Mean", kept), ("Zero", filled):
        cells = example.result(warp)
        low, high = np.array(cells.GetBounds()).reshape(3, 2)[:2].T
        box = np.array(data.GetBounds()).reshape(3, 2)[:2].T
        print("EmptyCells %s: areas of squares within %.1f %%, the island's box is %.0f %% of the raster's"
              % (name, 100 * largest_error(example.result(land), cells),
                 100 * np.prod((high - low) / (box[1] - box[0]))))
    picture = example.output(arguments, "gaps.png")
    draw(picture, (land, kept, filled), data.GetBounds()[:4], arguments.pixels)
    print(picture)


if __name__ == "__main__":
    main()
