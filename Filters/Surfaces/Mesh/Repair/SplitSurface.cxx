// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/SplitSurface.h"

#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

using Weights = std::array<double, 3>;

// A T-junction's barycentric coordinates on the triangle of its side.
Weights weightsOf(const TJunction& junction)
{
  Weights weights{ 0.0, 0.0, 0.0 };
  const auto side = static_cast<std::size_t>(junction.Side % 3);
  weights[side] = 1.0 - junction.Place;
  weights[(side + 1) % 3] = junction.Place;
  return weights;
}

// The corner that is cut off first. If two sides have points, it is the one between them; if one
// has, it is the one opposite to it.
std::size_t chooseTip(const std::array<SplitTriangle::Side, 3>& sides)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (sides[i].empty() && sides[(i + 1) % 3].empty())
    {
      return (i + 1) % 3;
    }
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (sides[i].empty())
    {
      return (i + 2) % 3;
    }
  }
  return 0;
}

} // namespace

SplitSurface::SplitSurface(const TriangleSurface& given, const std::vector<TJunction>& junctions,
  Progress& progress, const unsigned char* isLeftOut)
  : Junctions(static_cast<std::int64_t>(junctions.size()))
{
  // A triangle with n points on its sides has n + 1 parts.
  const std::int64_t leftOut =
    isLeftOut ? std::count(isLeftOut, isLeftOut + given.NumberOfTriangles, 1) : 0;
  // Each T-junction adds one triangle.
  const std::int64_t count = given.NumberOfTriangles - leftOut + this->Junctions;
  this->Corners = LargeBuffer<std::int64_t>(3 * count);
  this->Origins = LargeBuffer<std::int64_t>(count);
  std::size_t next = 0;
  std::int64_t number = 0;
  const auto append = [&](std::int64_t triangle, const std::int64_t* points) {
    std::copy_n(points, 3, this->Corners.data() + 3 * number);
    this->Origins.data()[number++] = triangle;
  };
  for (std::int64_t triangle = 0; triangle < given.NumberOfTriangles; ++triangle)
  {
    progress.Add(1);
    if (isLeftOut && isLeftOut[triangle] != 0)
    {
      continue;
    }
    const std::int64_t* ids = given.Triangles + 3 * triangle;
    const std::size_t first = next;
    std::array<SplitTriangle::Side, 3> sides;
    // T-junctions are sorted by sides, hence by triangles.
    for (; next < junctions.size() && junctions[next].Side / 3 == triangle; ++next)
    {
      // Points of each side are in the order along it.
      sides[static_cast<std::size_t>(junctions[next].Side % 3)].push_back(junctions[next].Point);
    }
    if (next == first)
    {
      append(triangle, ids);
      continue;
    }
    const std::array<std::int64_t, 3> corners{ ids[0], ids[1], ids[2] };
    const SplitTriangle split(given.Points, corners, sides);
    // The places of all points of the parts, to be found by number.
    std::vector<std::pair<std::int64_t, Weights>> placed{ { ids[0], { 1.0, 0.0, 0.0 } },
      { ids[1], { 0.0, 1.0, 0.0 } }, { ids[2], { 0.0, 0.0, 1.0 } } };
    for (std::size_t i = first; i < next; ++i)
    {
      placed.emplace_back(junctions[i].Point, weightsOf(junctions[i]));
    }
    std::sort(placed.begin(), placed.end());
    for (const std::array<std::int64_t, 3>& points : split.Parts())
    {
      Part part{ number, corners, {} };
      for (std::size_t i = 0; i < 3; ++i)
      {
        part.Weights[i] = std::lower_bound(
          placed.begin(), placed.end(), points[i], [](const auto& one, std::int64_t point) {
            return one.first < point;
          })->second;
      }
      this->Parts.push_back(part);
      append(triangle, points.data());
    }
  }
}

const SplitSurface::Part& SplitSurface::PartOf(std::int64_t triangle) const
{
  // Parts ascend by triangles.
  return *std::lower_bound(this->Parts.begin(), this->Parts.end(), triangle,
    [](const Part& part, std::int64_t number) { return part.Triangle < number; });
}

std::array<std::int64_t, 3> SplitSurface::GivenCorners(std::int64_t triangle) const
{
  if (this->IsPart(triangle))
  {
    return this->PartOf(triangle).GivenCorners;
  }
  const std::int64_t* points = this->Corners.data() + 3 * triangle;
  return { points[0], points[1], points[2] };
}

// The map from a part to the given triangle is linear: weights multiply.
PlaceOnTriangle SplitSurface::GivenPlace(const PlaceOnTriangle& place) const
{
  PlaceOnTriangle given{ this->GivenTriangle(place.Triangle), place.Weights };
  if (this->IsPart(place.Triangle))
  {
    const Part& part = this->PartOf(place.Triangle);
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      given.Weights[corner] = 0.0;
      for (std::size_t i = 0; i < 3; ++i)
      {
        // weight of a given corner = sum over the part's corners of their weights times its weight
        // there
        given.Weights[corner] += place.Weights[i] * part.Weights[i][corner];
      }
    }
  }
  return given;
}

// Cuts the tip off as a strip between the points of its two sides; what is left is a triangle
// between the last edge of the strip and the opposite side.
SplitTriangle::SplitTriangle(ConstPointSpan<3> points, const std::array<std::int64_t, 3>& corners,
  const std::array<Side, 3>& sides)
  : Points(points)
{
  const std::size_t tip = chooseTip(sides);
  Side left{ corners[tip] };
  Side right = left;
  left.insert(left.end(), sides[tip].begin(), sides[tip].end());
  const Side& last = sides[(tip + 2) % 3];
  right.insert(right.end(), last.rbegin(), last.rend());
  Side base{ corners[(tip + 1) % 3] };
  const Side& opposite = sides[(tip + 1) % 3];
  base.insert(base.end(), opposite.begin(), opposite.end());
  base.push_back(corners[(tip + 2) % 3]);
  this->CutOff(left, right);
  this->Fill(left.back(), right.back(), base);
}

// Adds the triangles of the part between two sides, from their common corner on: a strip whose next
// edge is always the shorter one of two.
void SplitTriangle::CutOff(const Side& left, const Side& right)
{
  if (left.size() == 1 || right.size() == 1)
  {
    return;
  }
  this->Add(left[0], left[1], right[1]);
  std::size_t i = 1;
  std::size_t j = 1;
  while (i + 1 < left.size() || j + 1 < right.size())
  {
    const bool isLeft = j + 1 == right.size() ||
      (i + 1 < left.size() &&
        this->Squared(left[i + 1], right[j]) <= this->Squared(left[i], right[j + 1]));
    if (isLeft)
    {
      this->Add(left[i], left[i + 1], right[j]);
      ++i;
    }
    else
    {
      this->Add(left[i], right[j + 1], right[j]);
      ++j;
    }
  }
}

// Adds the triangles of the part between an edge, which may be a point, and the side across. Points
// up to the middle are joined to the left end, the others to the right one. The middle has the
// least sum of squared distances to both ends.
void SplitTriangle::Fill(std::int64_t left, std::int64_t right, const Side& base)
{
  const auto sum = [&](std::int64_t point) {
    return this->Squared(point, left) + this->Squared(point, right);
  };
  const auto middle = std::min_element(base.begin(), base.end(),
                        [&](std::int64_t a, std::int64_t b) { return sum(a) < sum(b); }) -
    base.begin();
  for (std::size_t i = 1; i < base.size(); ++i)
  {
    const bool isLeft = static_cast<std::ptrdiff_t>(i) <= middle;
    this->Add(isLeft ? left : right, base[i - 1], base[i]);
    if (static_cast<std::ptrdiff_t>(i) == middle && left != right)
    {
      this->Add(left, base[i], right);
    }
  }
  if (middle == 0 && left != right)
  {
    this->Add(left, base[0], right);
  }
}

double SplitTriangle::Squared(std::int64_t a, std::int64_t b) const
{
  return squaredDistance(pointAt(this->Points, a), pointAt(this->Points, b));
}

} // namespace RectifiedTransport
