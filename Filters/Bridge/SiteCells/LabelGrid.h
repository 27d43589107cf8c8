// SPDX-License-Identifier: BSD-3-Clause
// The pixels of a domain that is divided among sites.
#ifndef RectifiedTransport_LabelGrid_h
#define RectifiedTransport_LabelGrid_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Ranks.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// If the data are distributed, the functions are collective. They throw Failure.
struct LabelGrid
{
  int Resolution; // 0: by the dimension

  // In the box of a domain: the box of an image, as for a density, or the bounds of other data. A
  // domain without points gives a grid without points.
  ImageGrid On(vtkDataObject* domain, const Ranks& ranks = SoloRanks::Get()) const;
  // In the box of a density.
  ImageGrid On(const ImageGrid& density) const;
  // In the bounds of sites, 10 % longer along each axis; the sites of all ranks are two or more.
  ImageGrid Around(vtkPointSet* sites, const Ranks& ranks = SoloRanks::Get()) const;
};

} // namespace RectifiedTransport::Bridge

#endif
