// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/SplitTriangle.h"

#include "Core/Geometry/Vectors.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

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
