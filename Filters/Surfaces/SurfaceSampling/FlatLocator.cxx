// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceSampling/FlatLocator.h"

#include "Core/Geometry/ExactOrientation.h"
#include "Core/Geometry/Trees/BoxTree.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace RectifiedTransport
{

namespace
{

// Few triangles a leaf: a test of a triangle costs more than one of a box.
constexpr std::int64_t leafTriangles = 4;

// Triangles between two polls for cancellation.
constexpr std::int64_t mostAtOnce = std::int64_t{ 1 } << 15;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Barycentric coordinates from values in proportion to them: twice the areas of the three parts.
PlaceOnTriangle placeOf(std::int64_t triangle, double a, double b, double c)
{
  const double sum = a + b + c;
  return { triangle, { a / sum, b / sum, c / sum } };
}

} // namespace

// The nearest place so far, and its squared distance.
struct FlatLocator::Nearest
{
  double Squared = infinity;
  PlaceOnTriangle Place{ -1, {} };
};

FlatLocator::FlatLocator(const FlatMesh& mesh, const Context& context)
  : Mesh(mesh)
  , Items(mesh.NumberOfTriangles)
{
  Progress progress(context);
  // Every level of the tree reads each triangle twice.
  std::int64_t passes = 1;
  for (std::int64_t rest = mesh.NumberOfTriangles; rest > leafTriangles; rest /= 2)
  {
    passes += 2;
  }
  progress.Expect(passes * mesh.NumberOfTriangles);
  this->ReadTriangles(progress);
  if (this->NumberOfItems == 0)
  {
    throw std::invalid_argument("the plane mesh has no triangle with mass");
  }
  this->Build(progress);
}

// Lists the triangles with mass, and the centres of their bounds, by which they are divided.
void FlatLocator::ReadTriangles(Progress& progress)
{
  const FlatMesh& mesh = this->Mesh;
  for (std::int64_t first = 0; first < mesh.NumberOfTriangles; first += mostAtOnce)
  {
    const std::int64_t last = std::min(first + mostAtOnce, mesh.NumberOfTriangles);
    for (std::int64_t t = first; t < last; ++t)
    {
      const double* a = this->Corner(t, 0);
      const double* b = this->Corner(t, 1);
      const double* c = this->Corner(t, 2);
      // Without masses, all triangles count.
      if (!mesh.Masses || mesh.Masses[t] > 0.0)
      {
        Item& item = this->Items.data()[this->NumberOfItems++];
        for (int r = 0; r < 2; ++r)
        {
          const auto range = std::minmax({ a[r], b[r], c[r] });
          item.Centre[r] = 0.5 * (range.first + range.second);
        }
        item.Triangle = t;
      }
    }
    progress.Add(last - first);
  }
}

// Boxes are in depth-first order, so that the first child follows its parent and needs no index.
void FlatLocator::Build(Progress& progress)
{
  this->Boxes = makeBoxTree<Box>(
    this->NumberOfItems,
    [&](std::int64_t first, std::int64_t last) {
      Box made{ { infinity, infinity }, { -infinity, -infinity }, first, last, -1 };
      this->Bound(made, progress);
      return made;
    },
    [&](const Box& box) { return this->Divide(box, progress); });
}

// Extends a box to the triangles of its range.
void FlatLocator::Bound(Box& box, Progress& progress) const
{
  for (std::int64_t first = box.First; first < box.Last; first += mostAtOnce)
  {
    const std::int64_t last = std::min(first + mostAtOnce, box.Last);
    for (std::int64_t i = first; i < last; ++i)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const double* x = this->Corner(this->Items.data()[i].Triangle, corner);
        for (int r = 0; r < 2; ++r)
        {
          box.Low[r] = std::min(box.Low[r], x[r]);
          box.High[r] = std::max(box.High[r], x[r]);
        }
      }
    }
    progress.Add(last - first);
  }
}

// Partitions the triangles of a box by their centres about the median along its longer axis, or
// along the other one. Returns where the second part begins; the first triangle of the box if it is
// a leaf.
std::int64_t FlatLocator::Divide(const Box& box, Progress& progress)
{
  if (box.Last - box.First <= leafTriangles)
  {
    return box.First;
  }
  // Lengths of the rectangle, not of the unit square.
  const int longer = (box.High[1] - box.Low[1]) * this->Mesh.Lengths[1] >
      (box.High[0] - box.Low[0]) * this->Mesh.Lengths[0]
    ? 1
    : 0;
  for (const int axis : { longer, 1 - longer })
  {
    const std::int64_t middle = partitionAboutMedian(
      this->Items.data(), box.First, box.Last,
      [axis](const Item& item) { return item.Centre[axis]; }, progress);
    if (middle < box.Last)
    {
      return middle;
    }
  }
  return box.First; // all centres are one point
}

// Whether a triangle turns left and contains a point, by exact predicates: on an edge, both
// triangles contain it, and no point falls between two.
bool FlatLocator::Contains(std::int64_t triangle, const double* point) const
{
  const double* a = this->Corner(triangle, 0);
  const double* b = this->Corner(triangle, 1);
  const double* c = this->Corner(triangle, 2);
  const double first = turnOf(a, b, point);
  if (first < 0.0)
  {
    return false;
  }
  const double next = turnOf(b, c, point);
  if (next < 0.0)
  {
    return false;
  }
  const double last = turnOf(c, a, point);
  // All 0: the triangle has no area.
  return last >= 0.0 && (first > 0.0 || next > 0.0 || last > 0.0);
}

// The least number among `best` and the triangles below a box that contain a point.
std::int64_t FlatLocator::FirstContaining(
  const double* point, std::int64_t box, std::int64_t best) const
{
  const Box& at = this->Boxes[static_cast<std::size_t>(box)];
  // Boxes are bounds without rounding: a point beyond them is in none of their triangles.
  if (point[0] < at.Low[0] || point[0] > at.High[0] || point[1] < at.Low[1] ||
    point[1] > at.High[1])
  {
    return best;
  }
  // The first child is the next box.
  if (at.Second >= 0)
  {
    best = this->FirstContaining(point, box + 1, best);
    return this->FirstContaining(point, at.Second, best);
  }
  for (std::int64_t i = at.First; i < at.Last; ++i)
  {
    const std::int64_t triangle = this->Items.data()[i].Triangle;
    best = triangle < best && this->Contains(triangle, point) ? triangle : best;
  }
  return best;
}

// The squared distance of a point from a box, in units of the lengths.
double FlatLocator::Gap(const double* point, std::int64_t box) const
{
  const Box& at = this->Boxes[static_cast<std::size_t>(box)];
  double squared = 0.0;
  for (int r = 0; r < 2; ++r)
  {
    // 0 where the point is between both faces.
    const double gap = std::max({ at.Low[r] - point[r], point[r] - at.High[r], 0.0 }) *
      this->Mesh.Lengths[static_cast<std::size_t>(r)];
    squared += gap * gap;
  }
  return squared;
}

// Returns the squared distance of a place on a triangle from a point, in units of the lengths.
double FlatLocator::SquaredDistance(const PlaceOnTriangle& place, const double* point) const
{
  double squared = 0.0;
  for (int r = 0; r < 2; ++r)
  {
    double x = 0.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      x +=
        place.Weights[static_cast<std::size_t>(corner)] * this->Corner(place.Triangle, corner)[r];
    }
    const double gap = (x - point[r]) * this->Mesh.Lengths[static_cast<std::size_t>(r)];
    squared += gap * gap;
  }
  return squared;
}

// The nearest place on the triangle's three sides: the point is outside of it.
PlaceOnTriangle FlatLocator::NearestPlace(std::int64_t triangle, const double* point) const
{
  const Point<2>& lengths = this->Mesh.Lengths;
  Nearest best;
  for (std::size_t side = 0; side < 3; ++side)
  {
    const std::size_t next = (side + 1) % 3;
    const double* a = this->Corner(triangle, static_cast<int>(side));
    const double* b = this->Corner(triangle, static_cast<int>(next));
    double along = 0.0;
    double length = 0.0;
    for (int r = 0; r < 2; ++r)
    {
      const double scale = lengths[static_cast<std::size_t>(r)];
      // (b - a) . (x - a) and |b - a|^2, in the lengths of the rectangle.
      along += (b[r] - a[r]) * scale * ((point[r] - a[r]) * scale);
      length += (b[r] - a[r]) * scale * ((b[r] - a[r]) * scale);
    }
    // (b - a) . (x - a) / |b - a|^2, within the side; its begin if the side has no length.
    const double share = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
    PlaceOnTriangle place{ triangle, {} };
    place.Weights[side] = 1.0 - share;
    place.Weights[next] = share;
    const double squared = this->SquaredDistance(place, point);
    best = squared < best.Squared ? Nearest{ squared, place } : best;
  }
  return best.Place;
}

// Branch and bound: the nearer box first, and none that is farther than the best place.
void FlatLocator::FindNearest(const double* point, std::int64_t box, Nearest& best) const
{
  const Box& at = this->Boxes[static_cast<std::size_t>(box)];
  if (at.Second < 0)
  {
    for (std::int64_t i = at.First; i < at.Last; ++i)
    {
      const std::int64_t triangle = this->Items.data()[i].Triangle;
      const PlaceOnTriangle place = this->NearestPlace(triangle, point);
      const double squared = this->SquaredDistance(place, point);
      if (squared < best.Squared ||
        (squared == best.Squared && triangle < best.Place.Triangle)) // the first of several
      {
        best = { squared, place };
      }
    }
    return;
  }
  const std::int64_t children[2] = { box + 1, at.Second };
  const double gaps[2] = { this->Gap(point, children[0]), this->Gap(point, children[1]) };
  const int nearer = gaps[1] < gaps[0] ? 1 : 0;
  for (const int child : { nearer, 1 - nearer })
  {
    // Equal distances go on, for the first triangle of several.
    if (gaps[child] <= best.Squared)
    {
      this->FindNearest(point, children[child], best);
    }
  }
}

// First the triangles that contain the point, then, only if there are none, the nearest edge.
PlaceOnTriangle FlatLocator::Locate(const Point<2>& point) const
{
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  const double* x = point.data();
  const std::int64_t triangle = this->FirstContaining(x, 0, none);
  if (triangle != none)
  {
    const double* a = this->Corner(triangle, 0);
    const double* b = this->Corner(triangle, 1);
    const double* c = this->Corner(triangle, 2);
    // Twice the areas opposite to the corners.
    // They are not negative, and one of them is positive: Contains() has tested their signs.
    return placeOf(triangle, turnOf(b, c, x), turnOf(c, a, x), turnOf(a, b, x));
  }
  // The map does not cover the point, or rounding has put the point beside the square.
  Nearest best;
  this->FindNearest(x, 0, best);
  return best.Place;
}

} // namespace RectifiedTransport
