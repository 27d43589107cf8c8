// SPDX-License-Identifier: BSD-3-Clause
// Particles in an order in which neighbours in memory are neighbours in space: their boxes then
// read the same parts of the tables. The order changes only the speed, never a result.
#ifndef RectifiedTransport_ParticleOrder_h
#define RectifiedTransport_ParticleOrder_h

#include "Core/Geometry/Points.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class ParticleOrder
{
public:
  // Orders particles [first, first + count) along a Morton curve of tiles with about
  // `particlesPerTile` in each. Returns the index of the first particle whose coordinates are not
  // finite, -1 if there is none.
  std::int64_t Sort(
    ConstPointSpan<Dimension> points, std::int64_t first, std::int64_t count, int particlesPerTile);
  const std::int64_t* Order() const { return this->Sorted.data(); }

private:
  std::vector<std::uint32_t> Tile;
  std::vector<std::uint32_t> Start;
  std::vector<std::int64_t> Sorted;
};

} // namespace RectifiedTransport

#endif
