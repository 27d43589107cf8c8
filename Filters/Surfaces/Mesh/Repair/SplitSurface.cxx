// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/SplitSurface.h"

#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/Repair/SplitTriangle.h"

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

} // namespace RectifiedTransport
