// SPDX-License-Identifier: BSD-3-Clause
// Conversion between ImageGrid, vtkImageData and pipeline information, and grids of given sizes.
#ifndef RectifiedTransport_ImageGrids_h
#define RectifiedTransport_ImageGrids_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

#include <array>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

ImageGrid gridOf(vtkImageData* image, bool onPoints);

// The grid of the pipeline information; without points if there is no WHOLE_EXTENT.
ImageGrid announcedGrid(vtkInformation* information, bool onPoints);

// An axis-aligned box, {x0, x1, y0, y1, z0, z1}, as one cell. Sides shorter than a billionth of the
// longest one are no axes.
ImageGrid gridOfBox(const double (&bounds)[6]);

// Throws Failure for an image that has no axis, or whose cells have no measure.
void requireCells(const ImageGrid& grid);

// Sets extent, origin, spacing and direction of an image. First check the memory for its arrays:
// from VTK 9.3 on SetExtent allocates the coordinates of the planes of points. Throws Failure if
// there is no memory for them.
void applyGrid(const ImageGrid& grid, vtkImageData* image);
// Sets the same in the pipeline information.
void announceGrid(const ImageGrid& grid, vtkInformation* information);
// Announces that each of several ranks gives the extent that is requested of it; a single rank
// gives all.
void announceSubExtents(vtkInformation* information);
// The extent that is requested of an image output; empty for nothing.
std::array<int, 6> requestedExtent(vtkInformation* information);
// Also announces the active scalars: the array Density of doubles.
void announceDensity(const ImageGrid& grid, vtkInformation* information);

// The grid with other numbers of values on the same domain; 0 keeps the number along an axis.
// Throws Failure, which names `property`.
ImageGrid gridWithValues(const ImageGrid& grid, const int values[3], const char* property);

// The grid on the same domain with `resolution` cells along its longest axis; the numbers along the
// others make the cells as near to cubes as possible. Throws Failure, which names `property`.
ImageGrid gridWithResolution(const ImageGrid& grid, int resolution, const char* property);

// A double, because it may exceed every integer.
double numberOfValues(const ImageGrid& grid);
// "8 x 4", without the axes of one point.
std::string describeValues(const ImageGrid& grid);

} // namespace RectifiedTransport::Bridge

#endif
