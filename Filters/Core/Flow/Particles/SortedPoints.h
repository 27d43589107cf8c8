// SPDX-License-Identifier: BSD-3-Clause
// The particles of an array, for an advection.
#ifndef RectifiedTransport_SortedPoints_h
#define RectifiedTransport_SortedPoints_h

#include "Core/Flow/Particles/ParticleOrder.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

// Points of an array in chunks, each in ParticleOrder; the same interface as LatticeOrder.
template <int Dimension>
class SortedPoints
{
public:
  static constexpr std::int64_t UsualChunk = std::int64_t{ 1 } << 20;

  explicit SortedPoints(ConstPointSpan<Dimension> points, std::int64_t chunk = UsualChunk)
    : Points(points)
    , Chunk(chunk)
  {
  }

  std::int64_t Count() const { return this->Points.size(); }
  std::int64_t Chunks() const { return (this->Count() + this->Chunk - 1) / this->Chunk; }
  // The number of points of all ranks. Collective.
  double CountOfAll(const Ranks& ranks) const
  {
    return static_cast<double>(sumOverRanks(ranks, this->Count()));
  }

  std::int64_t Prepare(std::int64_t first)
  {
    constexpr int particlesPerTile = 8;
    const std::int64_t length = std::min(this->Chunk, this->Count() - first);
    const std::int64_t wrong = this->Sort.Sort(this->Points, first, length, particlesPerTile);
    if (wrong >= 0)
    {
      throw std::invalid_argument("point " + std::to_string(wrong) + " is not finite");
    }
    return length;
  }

  void Fill(std::int64_t first, int count, std::int64_t* index, double* points) const
  {
    const std::int64_t* order = this->Sort.Order();
    for (int i = 0; i < count; ++i)
    {
      index[i] = order[first + i];
      std::copy_n(this->Points[index[i]], Dimension, points + i * Dimension);
    }
  }

private:
  ConstPointSpan<Dimension> Points;
  std::int64_t Chunk; // particles
  ParticleOrder<Dimension> Sort;
};

} // namespace RectifiedTransport

#endif
