// SPDX-License-Identifier: BSD-3-Clause
// Where particles lie among the points and cells of data sets whose density was resampled.
#ifndef RectifiedTransport_PlacesInMeshes_h
#define RectifiedTransport_PlacesInMeshes_h

#include "Bridge/Blocks/BlockValues.h"
#include "Bridge/Meshes/PlacesInRegions.h"
#include "Bridge/Points/SampledArrays.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"

#include <vector>

namespace RectifiedTransport
{
class ImageGrid;
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// A place is in the first cell that contains it, else in the nearest cell within a grid cell. It is
// linear between points on the simplices of the cell; in a region, between the outline to the left
// and to the right.
class PlacesInMeshes : public SampledPlaces
{
public:
  // `places` are physical, in grid cells that cells of the blocks reach. Throws Failure and
  // Cancelled.
  PlacesInMeshes(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
    ConstPointSpan<3> places, Progress& progress);

  std::int64_t Count() const override { return this->Found.size(); }
  SampledPlace Find(std::int64_t place) const override;

private:
  LargeBuffer<MeshPlace> Found;
};

} // namespace RectifiedTransport::Bridge

#endif
