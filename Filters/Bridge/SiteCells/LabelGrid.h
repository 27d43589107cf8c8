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

namespace RectifiedTransport
{

// Where the data lie on several ranks, all of them call a function together. Throw Failure.
struct LabelGrid
{
  int Resolution;

  // In the box of a domain: that of an image, as of a density, or the bounds of other data. A grid
  // without points for a domain without points.
  ImageGrid On(vtkDataObject* domain, const Ranks& ranks = SoloRanks::Get()) const;
  // In that of a density.
  ImageGrid On(const ImageGrid& density) const;
  // In the bounds of sites, 10 % longer along each axis; the sites of all ranks are two or more.
  ImageGrid Around(vtkPointSet* sites, const Ranks& ranks = SoloRanks::Get()) const;
};

} // namespace RectifiedTransport

#endif
