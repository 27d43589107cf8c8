// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/TJunctionRepair.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/PlaceOnSide.h"
#include "Surfaces/Mesh/Repair/MergePoints.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// openSidesOf lists sides in ascending order, so that searches and differences of lists take their
// numbers alone.
bool isBefore(const OpenSide& one, const OpenSide& other)
{
  return one.Side < other.Side;
}

bool isAmong(const std::vector<OpenSide>& sides, std::int64_t side)
{
  return std::binary_search(sides.begin(), sides.end(), OpenSide{ side, 0, 0, 0 }, isBefore);
}

// A repair with points merged in one way. First it leaves out triangles that are lines; if more
// edges are open then, it keeps them.
class RepairRun
{
public:
  RepairRun(const TriangleSurface& surface, const LargeBuffer<std::int64_t>& merged,
    double rounding, TJunctionScope scope, Progress& progress)
    : Surface(surface)
    , Merged(merged.data())
    , Rounding(rounding)
    , Scope(scope)
  {
    Stages stages(progress, { { "open sides", 3 }, { "flat triangles", 1 }, { "T-junctions", 6 } });
    this->Open = openSidesOf(surface, { this->Merged, nullptr }, stages["open sides"]);
    const std::int64_t flat = this->FindFlat(stages["flat triangles"]);
    const double withFlat = flat > 0 ? 1.0 : 0.0;
    Stages searches(stages["T-junctions"],
      { { "without flat", 2.0 * withFlat }, { "open sides", withFlat }, { "all", 1 } });
    if (flat > 0)
    {
      // Flat triangles leave cracks, which T-junctions of their longest sides close.
      this->Find(this->IsFlat.data(), searches["without flat"]);
      if (this->Made.Parts && this->CountOpen(searches["open sides"]) <= this->Open.size())
      {
        this->Made.FlatTriangles = flat;
        return;
      }
      this->Made = {};
    }
    if (scope == TJunctionScope::All)
    {
      this->Find(nullptr, searches["all"]);
    }
  }

  std::size_t OpenSides() const { return this->Open.size(); }
  TJunctionRepair Take() { return std::move(this->Made); }

private:
  // Marks the triangles that are lines. Returns their number.
  std::int64_t FindFlat(Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    const std::int64_t count = this->Surface.NumberOfTriangles;
    PointBounds bounds;
    // Points of no triangle have no part in the tolerance.
    progress.ForEachInOrder(3 * count, grain, [&](std::int64_t corner) {
      bounds.Add(this->Surface.Points[this->Surface.Triangles[corner]]);
    });
    // The tolerance is that of the whole surface.
    const PlaceOnSide place(bounds, this->Rounding);
    this->IsFlat = LargeBuffer<unsigned char>(count);
    progress.ForEach(count, grain, [&](std::int64_t triangle) {
      this->IsFlat.data()[triangle] = this->IsLine(triangle, place) ? 1 : 0;
    });
    return std::count(this->IsFlat.data(), this->IsFlat.data() + count, 1);
  }

  // Whether a corner is on the side across, and that side is not open: another triangle has it,
  // which can be cut there.
  bool IsLine(std::int64_t triangle, const PlaceOnSide& place) const
  {
    const std::int64_t* ids = this->Surface.Triangles + 3 * triangle;
    for (std::int64_t i = 0; i < 3; ++i)
    {
      const std::int64_t a = ids[i];
      const std::int64_t b = ids[(i + 1) % 3];
      const std::int64_t c = ids[(i + 2) % 3];
      const auto at = [this](std::int64_t point) { return this->Surface.Points[point]; };
      if (place.Of(at(a), at(b), at(c)) > 0.0)
      {
        // Two corners at one place make no line but an edge.
        const bool areThree = this->Merged[a] != this->Merged[b] &&
          this->Merged[b] != this->Merged[c] && this->Merged[c] != this->Merged[a];
        return areThree && !isAmong(this->Open, 3 * triangle + i);
      }
    }
    return false;
  }

  // Finds T-junctions and cuts the triangles. In the scope of flat triangles, only sides that are
  // open because these are missing are searched.
  void Find(const unsigned char* isLeftOut, Progress& progress)
  {
    Stages stages(progress, { { "open sides", 3 }, { "search", 4 }, { "parts", 3 } });
    std::vector<OpenSide> sides = isLeftOut
      ? openSidesOf(this->Surface, { this->Merged, isLeftOut }, stages["open sides"])
      : this->Open;
    if (this->Scope == TJunctionScope::OfDegenerateTriangles)
    {
      std::vector<OpenSide> opened;
      // Sides that are open only without the flat triangles.
      std::set_difference(sides.begin(), sides.end(), this->Open.begin(), this->Open.end(),
        std::back_inserter(opened), isBefore);
      sides = std::move(opened);
    }
    std::vector<TJunction> junctions =
      findTJunctions(this->Surface.Points, sides, this->Rounding, stages["search"]);
    if (junctions.empty())
    {
      return;
    }
    // This follows the search, which compares merged points, and precedes the cut, which takes
    // points as the triangles have them.
    this->Unmerge(sides, junctions);
    this->Made.Parts.emplace(this->Surface, junctions, stages["parts"], isLeftOut);
    this->Made.TJunctions = std::count_if(junctions.begin(), junctions.end(),
      [this](const TJunction& junction) { return isAmong(this->Open, junction.Side); });
  }

  // Open sides have merged points. Each T-junction at a merged point gets one of the points there
  // that an open side has, so that parts have points of the surface.
  void Unmerge(const std::vector<OpenSide>& sides, std::vector<TJunction>& junctions) const
  {
    std::vector<std::pair<std::int64_t, std::int64_t>> points;
    points.reserve(2 * sides.size());
    for (const OpenSide& side : sides)
    {
      points.emplace_back(side.From, this->Surface.Triangles[side.Side]);
      points.emplace_back(side.To, this->Surface.Triangles[nextSide(side.Side)]);
    }
    std::sort(points.begin(), points.end());
    for (TJunction& junction : junctions)
    {
      // The least of the points there: the result is deterministic.
      junction.Point = std::lower_bound(
        points.begin(), points.end(), std::make_pair(junction.Point, std::int64_t{ 0 }))
                         ->second;
    }
  }

  // The number of sides that are open after the cut.
  std::size_t CountOpen(Progress& progress)
  {
    const SplitSurface& parts = *this->Made.Parts;
    return openSidesOf({ this->Surface.Points, parts.Triangles(), parts.NumberOfTriangles() },
      { this->Merged, nullptr }, progress)
      .size();
  }

  const TriangleSurface Surface;
  const std::int64_t* Merged;
  const double Rounding;
  const TJunctionScope Scope;
  std::vector<OpenSide> Open;        // open sides of all triangles
  LargeBuffer<unsigned char> IsFlat; // by triangles
  TJunctionRepair Made;
};

} // namespace

TJunctionRepair repairTJunctions(
  const TriangleSurface& surface, TJunctionScope scope, const Context& context)
{
  Progress progress(context);
  LargeBuffer<std::int64_t> merged(surface.Points.size());
  Stages stages(progress,
    { { "rounding", 5 }, { "equal points", 10 }, { "merged equal", 35 }, { "near points", 10 },
      { "merged near", 40 } });
  const double rounding = roundingOfCorners(surface, stages["rounding"]);
  mergePoints<3>(surface.Points, merged.data(), stages["equal points"]);
  RepairRun equal(surface, merged, rounding, scope, stages["merged equal"]);
  TJunctionRepair repair = equal.Take();
  if (equal.OpenSides() == 0 || rounding == 0.0)
  {
    return repair;
  }
  if (mergeNearPoints(surface.Points, rounding, merged.data(), stages["near points"]))
  {
    RepairRun near(surface, merged, rounding, scope, stages["merged near"]);
    TJunctionRepair other = near.Take();
    // Merging near points must close edges and T-junctions both, else equal points do.
    if (near.OpenSides() < equal.OpenSides() && other.TJunctions > repair.TJunctions)
    {
      return other;
    }
  }
  return repair;
}

} // namespace RectifiedTransport
