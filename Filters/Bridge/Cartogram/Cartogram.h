// SPDX-License-Identifier: BSD-3-Clause
// Makes the areas of regions their masses: the worker of vtkCartogram.
#ifndef RectifiedTransport_CartogramWorker_h
#define RectifiedTransport_CartogramWorker_h

#include "Bridge/Cartogram/OverlayParts.h"
#include "Bridge/Cartogram/RegionCells.h"
#include "Bridge/Store/DataIdentity.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Cartogram/Cartogram.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Kept between runs: what depends on the regions' shapes alone.
struct MapCache
{
  DataIdentity Content;
  CartogramStart Start;
};

struct CartogramOutputs
{
  vtkPolyData* Regions;
  vtkPolyData* Graticule;
  std::vector<OverlayPart> Overlay;
};

// The members are the properties of that class.
struct CartogramWorker
{
  CartogramOptions Options;
  RegionArrays Arrays;
  bool IsInDegrees; // project to equal areas
  double MinimumShare;
  double Blend;

  // Returns warnings. Throws Failure, InvalidDensity and Cancelled.
  std::vector<std::string> Run(const std::vector<DensityBlock>& blocks, MapCache& cache,
    Progress& progress, const CartogramOutputs& outputs) const;
};

} // namespace RectifiedTransport::Bridge

#endif
