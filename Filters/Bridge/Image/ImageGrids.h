// SPDX-License-Identifier: BSD-3-Clause
// Grids from images and to them, and grids that properties ask for.
#ifndef RectifiedTransport_ImageGrids_h
#define RectifiedTransport_ImageGrids_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

ImageGrid gridOf(vtkImageData* image, bool onPoints);

// What a pipeline has announced; it has no points where it has announced no extent.
ImageGrid announcedGrid(vtkInformation* information, bool onPoints);

// A box along the coordinate axes, {x0, x1, y0, y1, z0, z1}: one cell, and no axis where the box is
// flat (a billionth of its longest side is rounding).
ImageGrid gridOfBox(const double (&bounds)[6]);

// Throws Failure for an image that has no axis, or whose cells have no measure.
void requireCells(const ImageGrid& grid);

// Gives an image a grid. Ask for the memory of what the image will hold before that: from VTK 9.3
// on an image keeps the coordinates of its planes of points. Throws Failure where there is no
// memory for them.
void applyGrid(const ImageGrid& grid, vtkImageData* image);
void announceGrid(const ImageGrid& grid, vtkInformation* information);
// And that the active scalars will be the array Density, of doubles.
void announceDensity(const ImageGrid& grid, vtkInformation* information);

// The grid with other numbers of values on the domain that its cells cover; 0 for as many as there
// are. Throws Failure, which names `property`.
ImageGrid gridWithValues(const ImageGrid& grid, const int values[3], const char* property);

// The grid with `resolution` cells along the longest axis of the domain that the cells cover, and
// as nearly cubic ones as fit along the others. Throws Failure, which names `property`.
ImageGrid gridWithResolution(const ImageGrid& grid, int resolution, const char* property);

// Not an integer: what a user asks for may be more than fits into one.
double numberOfValues(const ImageGrid& grid);
// "8 x 4", without the axes of one point.
std::string describeValues(const ImageGrid& grid);

} // namespace RectifiedTransport

#endif
