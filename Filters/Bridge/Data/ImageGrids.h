// SPDX-License-Identifier: BSD-3-Clause
// Conversion between ImageGrid, vtkImageData and pipeline information.
#ifndef RectifiedTransport_ImageGrids_h
#define RectifiedTransport_ImageGrids_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

#include <array>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

ImageGrid gridOf(vtkImageData* image, bool onPoints);

// The grid of the pipeline information; without points if there is no WHOLE_EXTENT.
ImageGrid announcedGrid(vtkInformation* information, bool onPoints);

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
// Also announces the active scalars: doubles, whose name may be unknown before the data (nullptr).
void announceDensity(
  const ImageGrid& grid, vtkInformation* information, const char* name = "Density");

} // namespace RectifiedTransport::Bridge

#endif
