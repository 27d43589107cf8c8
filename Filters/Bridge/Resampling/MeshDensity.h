// SPDX-License-Identifier: BSD-3-Clause
// The density of other data sets, resampled to an image: the value of a grid cell is the mean over
// it, 0 outside the data sets.
#ifndef RectifiedTransport_MeshDensity_h
#define RectifiedTransport_MeshDensity_h

#include "Bridge/Blocks/BlockValues.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

struct MeshDensity
{
  // The image has one cell array, of doubles, called `name`.
  vtkSmartPointer<vtkImageData> Image;
  std::vector<std::string> Warnings; // of what carries no mass

  // Point values are linear on the simplices of a cell; a region has one value. Throws Failure and
  // Cancelled.
  static MeshDensity Make(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
    const char* name, Progress& progress);

  // The integral of the densities, in cells of the grid.
  static double IntegralOf(
    const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress);
};

} // namespace RectifiedTransport

#endif
