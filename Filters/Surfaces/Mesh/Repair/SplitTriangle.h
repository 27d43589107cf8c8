// SPDX-License-Identifier: BSD-3-Clause
// Cuts a triangle at points on its sides.
#ifndef RectifiedTransport_SplitTriangle_h
#define RectifiedTransport_SplitTriangle_h

#include "Core/Geometry/Points.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The points on the side from corner i to the next one, from there on; they are numbers of a
// caller's. No part has all three points on one side. The parts turn as the triangle does. Where
// there is a choice, new edges are short. O(points).
class SplitTriangle
{
public:
  using Side = std::vector<std::int64_t>;

  SplitTriangle(ConstPointSpan<3> points, const std::array<std::int64_t, 3>& corners,
    const std::array<Side, 3>& sides);

  // Three numbers of points each.
  const std::vector<std::array<std::int64_t, 3>>& Parts() const { return this->AllParts; }

private:
  void CutOff(const Side& left, const Side& right);
  void Fill(std::int64_t left, std::int64_t right, const Side& base);
  double Squared(std::int64_t a, std::int64_t b) const;
  void Add(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    this->AllParts.push_back({ a, b, c });
  }

  ConstPointSpan<3> Points;
  std::vector<std::array<std::int64_t, 3>> AllParts;
};

} // namespace RectifiedTransport

#endif
