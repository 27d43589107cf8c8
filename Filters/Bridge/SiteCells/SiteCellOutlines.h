// SPDX-License-Identifier: BSD-3-Clause
// The borders of the cells of a labelled image, along the sides of its pixels.
#ifndef RectifiedTransport_SiteCellOutlines_h
#define RectifiedTransport_SiteCellOutlines_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Each cell's own closed border with its label in the cell array `SiteId`: vertices in 1D, lines in
// 2D, quads in 3D, these seen from outside against the clock. Lines go around their cell as
// the first of the image's axes turns to the second. What is between two cells is there once for
// each; points are shared. Throws Cancelled.
template <int D>
void outlineSiteCells(
  const ImageGrid& geometry, const std::int64_t* labels, Progress& progress, vtkPolyData* output);

} // namespace RectifiedTransport

#endif
