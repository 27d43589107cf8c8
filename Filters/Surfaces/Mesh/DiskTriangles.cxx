// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/DiskTriangles.h"

#include "Core/Parallel/Stages.h"

#include <algorithm>

namespace RectifiedTransport
{

// Tries the triangles as they are, repaired as little as possible. If that is no disk, or if
// triangles without area may have left cracks, tries again with triangles cut at T-junctions.
DiskTriangles::DiskTriangles(SurfaceTriangles& triangles, Progress& progress)
  : Cut(&triangles)
{
  Stages stages(progress, { { "disk", 5 }, { "T-junctions", 2 }, { "repaired disk", 3 } });
  std::optional<NoDisk> defect;
  try
  {
    this->Make(stages["disk"]);
  }
  catch (const NoDisk& found)
  {
    defect = found;
  }
  // A cut that makes the surface a disk stays open.
  const TJunctionScope scope = defect ? TJunctionScope::All : TJunctionScope::OfDegenerateTriangles;
  const bool isCut = (defect || this->Mesh->Repairs().FlatTriangles > 0) &&
    triangles.CloseTJunctions(scope, stages["T-junctions"]);
  if (defect && !isCut)
  {
    throw NoDisk(*defect);
  }
  if (isCut)
  {
    try
    {
      this->Make(stages["repaired disk"]);
    }
    catch (const NoDisk& found)
    {
      const auto hasNoArea = [](const NoDisk& one) {
        return one.Defect() == DiskDefect::TrianglesWithoutArea;
      };
      // Parts without area are more than the triangles that the user has.
      throw defect && hasNoArea(*defect) && hasNoArea(found) ? *defect : found;
    }
  }
  progress.EndSlice(1);
}

void DiskTriangles::Make(Progress& progress)
{
  try
  {
    this->Mesh.emplace(this->Cut->Surface(), this->Cut->Rounding(), progress);
  }
  catch (const NotADisk& defect)
  {
    const bool isTriangle = defect.Defect() == DiskDefect::TrianglesWithoutArea;
    throw NoDisk(defect, isTriangle ? this->Cut->GivenTriangle(defect.First()) : -1);
  }
}

bool DiskTriangles::IsPart(std::int64_t triangle) const
{
  const std::optional<SplitSurface>& parts = this->Cut->Parts();
  return parts && parts->IsPart(this->Mesh->GivenTriangle(triangle));
}

// Weights in the disk's triangle become weights in the given one, if that was cut: the part's
// corners have known places on it.
PointWeights DiskTriangles::InGiven(const PlaceOnTriangle& place) const
{
  PointWeights found{ this->CornersOf(place.Triangle), place.Weights };
  if (!this->IsPart(place.Triangle))
  {
    return found;
  }
  // The corners of the part, perhaps in another order.
  const SplitSurface& parts = *this->Cut->Parts();
  PlaceOnTriangle onPart{ this->Mesh->GivenTriangle(place.Triangle), { 0.0, 0.0, 0.0 } };
  const std::int64_t* corners = parts.Triangles() + 3 * onPart.Triangle;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::int64_t* corner = std::find(corners, corners + 3, found.Points[i]);
    if (corner == corners + 3)
    {
      return found; // without area, the part was cut at a point of another one
    }
    onPart.Weights[static_cast<std::size_t>(corner - corners)] = place.Weights[i];
  }
  return { parts.GivenCorners(onPart.Triangle), parts.GivenPlace(onPart).Weights };
}

} // namespace RectifiedTransport
