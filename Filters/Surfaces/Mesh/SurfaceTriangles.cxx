// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/SurfaceTriangles.h"

#include <algorithm>

namespace RectifiedTransport
{

SurfaceTriangles::SurfaceTriangles(
  LargeBuffer<double> coordinates, LargeBuffer<std::int64_t> corners, double rounding)
  : Coordinates(std::move(coordinates))
  , Corners(std::move(corners))
  , RoundingOfPoints(rounding)
{
}

bool SurfaceTriangles::CloseTJunctions(TJunctionScope scope, const Context& context)
{
  // A second search would find nothing more: parts have no T-junctions that can be closed.
  if (!std::exchange(this->IsSearched, true))
  {
    TJunctionRepair repair = repairTJunctions(this->Surface(), scope, context);
    if (repair.Parts)
    {
      this->NumberOfTJunctions = repair.TJunctions;
      this->NumberOfFlat = repair.FlatTriangles;
      this->Split = std::move(repair.Parts);
      this->Corners = LargeBuffer<std::int64_t>(3 * this->Split->NumberOfTriangles());
      std::copy_n(this->Split->Triangles(), this->Corners.size(), this->Corners.data());
    }
  }
  return this->Split.has_value();
}

} // namespace RectifiedTransport
