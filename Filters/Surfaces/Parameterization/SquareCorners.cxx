// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/SquareCorners.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr double pi = 3.14159265358979323846;
// Surfaces with exactly four boundary points of at most 120 degrees are taken for quadrilaterals.
constexpr double sharpAngle = 2.0 * pi / 3.0;
constexpr std::size_t rotations = 256; // number of starts that are tried for the four quarters

// The boundary as a closed curve: its points by their places on it, 0 to Count - 1, and the lengths
// from place 0 up to each.
class BoundaryPlaces
{
public:
  // The lengths are those of the polygon's edges, in the mesh's unit.
  explicit BoundaryPlaces(const DiskMesh& disk)
    : Loop(disk.Boundary())
    , Places(static_cast<std::size_t>(disk.NumberOfPoints()), -1)
    , Lengths(this->Loop.size() + 1, 0.0)
  {
    const ConstPointSpan<3> points = disk.Surface().Points;
    for (std::size_t i = 0; i < this->Loop.size(); ++i)
    {
      const Eigen::Map<const Eigen::Vector3d> from(points[this->Loop[i]]);
      const Eigen::Map<const Eigen::Vector3d> to(points[this->Loop[(i + 1) % this->Loop.size()]]);
      this->Places[static_cast<std::size_t>(this->Loop[i])] = static_cast<std::int64_t>(i);
      this->Lengths[i + 1] = this->Lengths[i] + (to - from).norm();
    }
  }

  std::int64_t Count() const { return static_cast<std::int64_t>(this->Loop.size()); }
  std::int64_t PointAt(std::int64_t place) const
  {
    return this->Loop[static_cast<std::size_t>(place)];
  }
  // -1 for points that are not on the boundary.
  std::int64_t PlaceOf(std::int64_t point) const
  {
    return this->Places[static_cast<std::size_t>(point)];
  }
  // Places passed from one to another.
  std::int64_t Steps(std::int64_t from, std::int64_t to) const
  {
    return to >= from ? to - from : to - from + this->Count();
  }

  double Total() const { return this->Lengths.back(); }
  double LengthAt(std::int64_t place) const
  {
    return this->Lengths[static_cast<std::size_t>(place)];
  }
  // The shorter of the two ways along the boundary.
  double Distance(double a, double b) const
  {
    const double distance = std::abs(a - b);
    return std::min(distance, this->Total() - distance);
  }
  // The place whose length is nearest to a length from place 0; both are taken along the closed
  // curve.
  std::int64_t Nearest(double length) const
  {
    // The entry of the whole length is left out: it is place 0 again.
    const auto above = std::lower_bound(this->Lengths.begin(), this->Lengths.end() - 1, length);
    const std::int64_t high = (above - this->Lengths.begin()) % this->Count();
    const std::int64_t low = (high + this->Count() - 1) % this->Count();
    return this->Distance(this->LengthAt(low), length) <
        this->Distance(this->LengthAt(high), length)
      ? low
      : high;
  }

private:
  const std::vector<std::int64_t>& Loop;
  std::vector<std::int64_t> Places; // by points; -1 inside
  std::vector<double> Lengths;      // by places, and the whole length at the end
};

// The places strictly between two.
struct BoundaryArc
{
  std::int64_t From;
  std::int64_t To;
};

// Whether a place is strictly inside an arc; its ends are not.
bool contains(const BoundaryPlaces& places, const BoundaryArc& arc, std::int64_t place)
{
  const std::int64_t steps = places.Steps(arc.From, place);
  return steps > 0 && steps < places.Steps(arc.From, arc.To);
}

// The arcs that edges inside of the surface cut off and that contain no other such arc. As edges
// do not cross these are disjoint, and where each has a corner all have.
std::vector<BoundaryArc> smallestArcs(const DiskMesh& disk, const BoundaryPlaces& places)
{
  std::vector<BoundaryArc> arcs;
  for (std::int64_t side = 0; side < 3 * disk.NumberOfTriangles(); ++side)
  {
    // Edges of the boundary cut off nothing.
    if (disk.Edges().Other(side) < 0)
    {
      continue;
    }
    const std::int64_t* triangle = disk.Triangle(side / 3);
    const std::int64_t from = places.PlaceOf(triangle[side % 3]);
    const std::int64_t to = places.PlaceOf(triangle[(side + 1) % 3]);
    // The edge is an inner one and joins two boundary points.
    if (from >= 0 && to >= 0)
    {
      arcs.push_back({ from, to }); // the other arc is that of the other side
    }
  }
  // Ascending by steps: an arc comes after all that it could contain.
  std::sort(arcs.begin(), arcs.end(), [&](const BoundaryArc& a, const BoundaryArc& b) {
    return std::make_pair(places.Steps(a.From, a.To), a.From) <
      std::make_pair(places.Steps(b.From, b.To), b.From);
  });
  std::vector<BoundaryArc> smallest;
  // Beginnings of the smallest arcs, with their steps.
  std::set<std::pair<std::int64_t, std::int64_t>> begins;
  for (const BoundaryArc& arc : arcs)
  {
    const std::int64_t steps = places.Steps(arc.From, arc.To);
    // As the smallest arcs are disjoint, only the next one that begins at or after this arc's
    // beginning can be within it.
    auto next = begins.lower_bound({ arc.From, 0 });
    next = next == begins.end() ? begins.begin() : next;
    if (next == begins.end() || places.Steps(arc.From, next->first) + next->second > steps)
    {
      smallest.push_back(arc);
      begins.insert({ arc.From, steps });
    }
  }
  const auto length = [&places](const BoundaryArc& arc) {
    const double between = places.LengthAt(arc.To) - places.LengthAt(arc.From);
    return between < 0.0 ? between + places.Total() : between;
  };
  // If there are more than four, the four longest get a corner: they cut off most.
  std::stable_sort(smallest.begin(), smallest.end(),
    [&](const BoundaryArc& a, const BoundaryArc& b) { return length(a) > length(b); });
  smallest.resize(std::min(smallest.size(), SquareCorners().size()));
  return smallest;
}

// These are the places of the square's corners on the boundary.
using CornerPlaces = std::array<std::int64_t, 4>;

// Whether some corner is strictly inside an arc, so that what the arc's edge cuts off has an area.
bool hasCorner(const BoundaryPlaces& places, const BoundaryArc& arc, const CornerPlaces& corners)
{
  return std::any_of(corners.begin(), corners.end(),
    [&](std::int64_t corner) { return contains(places, arc, corner); });
}

// The arcs without a corner, whose triangles collapse onto a side of the square.
std::ptrdiff_t countMissed(
  const BoundaryPlaces& places, const std::vector<BoundaryArc>& arcs, const CornerPlaces& corners)
{
  return std::count_if(arcs.begin(), arcs.end(),
    [&](const BoundaryArc& arc) { return !hasCorner(places, arc, corners); });
}

// Whether an arc would have no corner without corner `q`.
bool isNeeded(const BoundaryPlaces& places, const std::vector<BoundaryArc>& arcs,
  const CornerPlaces& corners, std::size_t q)
{
  return std::any_of(arcs.begin(), arcs.end(), [&](const BoundaryArc& arc) {
    const auto inside = [&](std::int64_t corner) { return contains(places, arc, corner); };
    return inside(corners[q]) && std::count_if(corners.begin(), corners.end(), inside) == 1;
  });
}

// The place strictly in an arc that is nearest to a length along the boundary: at its ends the arc
// begins and stops, so that the first or the last place inside comes next.
std::int64_t nearestIn(const BoundaryPlaces& places, const BoundaryArc& arc, double length)
{
  const std::int64_t nearest = places.Nearest(length);
  if (contains(places, arc, nearest))
  {
    return nearest;
  }
  const std::int64_t first = (arc.From + 1) % places.Count();
  const std::int64_t last = (arc.To + places.Count() - 1) % places.Count();
  return places.Distance(places.LengthAt(first), length) <=
      places.Distance(places.LengthAt(last), length)
    ? first
    : last;
}

// Moves to an arc the corner that is nearest to it, unless another arc needs that one.
void moveCornerTo(const BoundaryPlaces& places, const std::vector<BoundaryArc>& arcs,
  const BoundaryArc& arc, const std::array<double, 4>& quarters, CornerPlaces& corners)
{
  double least = std::numeric_limits<double>::max();
  std::size_t moved = 0;
  std::int64_t target = corners[0];
  for (std::size_t q = 0; q < corners.size(); ++q)
  {
    const std::int64_t place = nearestIn(places, arc, quarters[q]);
    const double distance = places.Distance(places.LengthAt(place), quarters[q]);
    if (distance < least && !isNeeded(places, arcs, corners, q))
    {
      least = distance;
      moved = q;
      target = place;
    }
  }
  corners[moved] = target;
}

// Corners near the quarters of the boundary's length, from a place on.
CornerPlaces cornersFrom(
  const BoundaryPlaces& places, const std::vector<BoundaryArc>& arcs, std::int64_t start)
{
  // Quarter q is at s + q L / 4 along the boundary of the length L, modulo L.
  std::array<double, 4> quarters;
  CornerPlaces corners;
  for (std::size_t q = 0; q < corners.size(); ++q)
  {
    quarters[q] = std::fmod(
      places.LengthAt(start) + 0.25 * static_cast<double>(q) * places.Total(), places.Total());
    corners[q] = places.Nearest(quarters[q]);
  }
  // Longer arcs come first, and keep their corners when later ones need some.
  for (const BoundaryArc& arc : arcs)
  {
    if (!hasCorner(places, arc, corners))
    {
      moveCornerTo(places, arcs, arc, quarters, corners);
    }
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

// The sum over the sides of (share of the length - 1/4)^2; infinite where two corners meet.
double unevenness(const BoundaryPlaces& places, const CornerPlaces& corners)
{
  double sum = 0.0;
  for (std::size_t q = 0; q < corners.size(); ++q)
  {
    const std::int64_t next = corners[(q + 1) % corners.size()];
    if (next == corners[q])
    {
      return std::numeric_limits<double>::infinity();
    }
    const double length = places.LengthAt(next) - places.LengthAt(corners[q]);
    const double share = (length < 0.0 ? length + places.Total() : length) / places.Total();
    sum += (share - 0.25) * (share - 0.25);
  }
  return sum;
}

// The places where the triangles' angles sum to at most sharpAngle.
std::vector<std::int64_t> sharpPlaces(const DiskMesh& disk, const BoundaryPlaces& places)
{
  std::vector<double> angles(static_cast<std::size_t>(places.Count()), 0.0);
  const ConstPointSpan<3> points = disk.Surface().Points;
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::int64_t* triangle = disk.Triangle(t);
      const std::int64_t place = places.PlaceOf(triangle[i]);
      if (place < 0)
      {
        continue;
      }
      const Eigen::Map<const Eigen::Vector3d> apex(points[triangle[i]]);
      const Eigen::Vector3d a =
        Eigen::Map<const Eigen::Vector3d>(points[triangle[(i + 1) % 3]]) - apex;
      const Eigen::Vector3d b =
        Eigen::Map<const Eigen::Vector3d>(points[triangle[(i + 2) % 3]]) - apex;
      // The angle at the apex, by atan2 of cross and dot product: accurate also near 0 and pi.
      angles[static_cast<std::size_t>(place)] += std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  std::vector<std::int64_t> sharp;
  for (std::size_t place = 0; place < angles.size(); ++place)
  {
    if (angles[place] <= sharpAngle)
    {
      sharp.push_back(static_cast<std::int64_t>(place));
    }
  }
  return sharp;
}

// Returns the points at four places.
SquareCorners pointsAt(const BoundaryPlaces& places, const CornerPlaces& corners)
{
  SquareCorners points;
  std::transform(corners.begin(), corners.end(), points.begin(),
    [&places](std::int64_t place) { return places.PointAt(place); });
  return points;
}

} // namespace

// Four sharp corners of the surface become those of the square, if they do not leave an arc without
// one. Otherwise starts are tried, evenly by the boundary's points: all of a short boundary, 256 to
// 511 of a long one. They bound the cost, and finer ones would hardly make sides more even.
SquareCorners chooseCorners(const DiskMesh& disk)
{
  const BoundaryPlaces places(disk);
  const std::vector<BoundaryArc> arcs = smallestArcs(disk, places);

  const std::vector<std::int64_t> sharp = sharpPlaces(disk, places);
  if (sharp.size() == SquareCorners().size())
  {
    CornerPlaces corners;
    std::copy(sharp.begin(), sharp.end(), corners.begin());
    if (countMissed(places, arcs, corners) == 0)
    {
      return pointsAt(places, corners);
    }
  }

  constexpr double rounding = 1e-12; // differences that must not decide
  const auto step =
    std::max<std::int64_t>(1, places.Count() / static_cast<std::int64_t>(rotations));
  // These are valid for every boundary of four points and more, so that there always is a result.
  CornerPlaces best{ 0, 1, 2, 3 };
  auto fewest = countMissed(places, arcs, best);
  double least = unevenness(places, best);
  // Fewest arcs without a corner come first, then the most even sides.
  for (std::int64_t start = 0; start < places.Count(); start += step)
  {
    const CornerPlaces corners = cornersFrom(places, arcs, start);
    const double uneven = unevenness(places, corners);
    const auto misses = countMissed(places, arcs, corners);
    if (std::isfinite(uneven) &&
      (misses < fewest || (misses == fewest && uneven < least - rounding)))
    {
      best = corners;
      fewest = misses;
      least = uneven;
    }
  }
  return pointsAt(places, best);
}

// A conformal map depends on its corners: callers compare the distortions of several turns.
SquareCorners turnCorners(const DiskMesh& disk, const SquareCorners& corners, double part)
{
  const BoundaryPlaces places(disk);
  const std::vector<BoundaryArc> arcs = smallestArcs(disk, places);
  CornerPlaces known;
  std::transform(corners.begin(), corners.end(), known.begin(),
    [&](std::int64_t point) { return places.PlaceOf(point); });
  const double start = places.LengthAt(known[0]) + part * places.Total();
  const CornerPlaces turned =
    cornersFrom(places, arcs, places.Nearest(std::fmod(start, places.Total())));
  const bool isBetter = std::isfinite(unevenness(places, turned)) &&
    countMissed(places, arcs, turned) <= countMissed(places, arcs, known);
  return isBetter ? pointsAt(places, turned) : corners;
}

// The messages are predicates of a sentence whose subject is the corners. The first point stays the
// first, to let users choose which corner of the square it goes to.
SquareCorners orderCorners(const DiskMesh& disk, const std::vector<std::int64_t>& points,
  const std::vector<std::int64_t>& names)
{
  const BoundaryPlaces places(disk);
  CornerPlaces corners;
  if (points.size() != corners.size())
  {
    throw std::invalid_argument(
      "are " + std::to_string(points.size()) + " points; they must be 4 of the boundary, or none");
  }
  for (std::size_t q = 0; q < corners.size(); ++q)
  {
    const std::int64_t point = points[q];
    const std::string name = std::to_string(names.empty() ? point : names[q]);
    if (point < 0 || point >= disk.NumberOfPoints())
    {
      throw std::invalid_argument("have the point " + name + "; there are points 0 to " +
        std::to_string(disk.NumberOfPoints() - 1));
    }
    if (places.PlaceOf(point) < 0)
    {
      throw std::invalid_argument("have the point " + name +
        ", which is not on the boundary of the surface; they must be 4 points of it");
    }
    if (std::find(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(q), point) !=
      points.begin() + static_cast<std::ptrdiff_t>(q))
    {
      throw std::invalid_argument(
        "have the point " + name + " twice; they must be 4 different points");
    }
    corners[q] = places.PlaceOf(point);
  }
  const std::int64_t first = corners[0];
  std::sort(corners.begin(), corners.end(), [&](std::int64_t a, std::int64_t b) {
    return places.Steps(first, a) < places.Steps(first, b);
  });
  return pointsAt(places, corners);
}

// O(points + triangles): marks the sides of each boundary point, then compares them by triangles.
std::int64_t countCollapsed(const DiskMesh& disk, const SquareCorners& corners)
{
  const BoundaryPlaces places(disk);
  // By points; bit q is set on side q.
  std::vector<unsigned char> sides(static_cast<std::size_t>(disk.NumberOfPoints()), 0);
  for (std::size_t q = 0; q < corners.size(); ++q)
  {
    const std::int64_t from = places.PlaceOf(corners[q]);
    const std::int64_t steps =
      places.Steps(from, places.PlaceOf(corners[(q + 1) % corners.size()]));
    // Both ends belong to a side, so that a corner has the bits of two.
    for (std::int64_t i = 0; i <= steps; ++i)
    {
      sides[static_cast<std::size_t>(places.PointAt((from + i) % places.Count()))] |=
        static_cast<unsigned char>(1u << q);
    }
  }
  std::int64_t collapsed = 0;
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    // A triangle collapses if its points have the bit of a side in common.
    unsigned int common = ~0u;
    for (int i = 0; i < 3; ++i)
    {
      common &= sides[static_cast<std::size_t>(disk.Triangle(t)[i])];
    }
    collapsed += common != 0 ? 1 : 0;
  }
  return collapsed;
}

} // namespace RectifiedTransport
