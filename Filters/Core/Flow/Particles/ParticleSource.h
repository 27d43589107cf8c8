// SPDX-License-Identifier: BSD-3-Clause
// The particles of an advection in an order in which neighbours in memory are neighbours in space.
#ifndef RectifiedTransport_ParticleSource_h
#define RectifiedTransport_ParticleSource_h

#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/FlowSeeds.h"
#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Flow/Particles/ParticleOrder.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

// The points of a lattice in LatticeOrder, or those of an array in chunks, each in ParticleOrder.
template <int Dimension>
class ParticleSource
{
public:
  // On a box of `size`, in chunks of at most `chunk` points of an array. Throws
  // std::invalid_argument, also if there is not enough memory for the positions.
  ParticleSource(const FlowSeeds<Dimension>& seeds, const GridSize<Dimension>& size,
    std::int64_t positions, std::int64_t chunk = std::int64_t{ 1 } << 20)
    : Points(seeds.Points())
    , Chunk(chunk)
    , IsWhole(seeds.IsWholeLattice())
  {
    if (seeds.IsLattice())
    {
      this->Lattice = checkedOrder<Dimension>(seeds, size, positions);
      return;
    }
    checkCount(positions, static_cast<double>(this->Points.size()));
  }

  std::int64_t Count() const
  {
    return this->Lattice ? this->Lattice->Count() : this->Points.size();
  }
  // The lattice, if the particles are all of its points: the results are in the order of its cells.
  const LatticeOrder<Dimension>* WholeLattice() const
  {
    return this->IsWhole ? &*this->Lattice : nullptr;
  }
  std::int64_t Chunks() const
  {
    return this->Lattice ? 1 : (this->Count() + this->Chunk - 1) / this->Chunk;
  }
  // The number of points of the whole lattice, or of the arrays of all ranks. Collective.
  double CountOfAll(const Ranks& ranks) const
  {
    return this->Lattice ? numberOfCells<Dimension>(this->Lattice->Cells())
                         : static_cast<double>(sumOverRanks(ranks, this->Count()));
  }

  // Makes the chunk that begins at particle `first`; returns its length.
  std::int64_t Prepare(std::int64_t first)
  {
    if (this->Lattice)
    {
      return this->Count() - first;
    }
    constexpr int particlesPerTile = 8;
    const std::int64_t length = std::min(this->Chunk, this->Count() - first);
    const std::int64_t wrong = this->Sorted.Sort(this->Points, first, length, particlesPerTile);
    if (wrong >= 0)
    {
      throw std::invalid_argument("point " + std::to_string(wrong) + " is not finite");
    }
    return length;
  }

  // Reads `count` particles of the chunk from its number `first` on: the indices of their results,
  // and their coordinates.
  void Fill(std::int64_t first, int count, std::int64_t* index, double* points) const
  {
    if (this->Lattice)
    {
      this->Lattice->Fill(first, count, index, points);
      return;
    }
    const std::int64_t* order = this->Sorted.Order();
    for (int i = 0; i < count; ++i)
    {
      index[i] = order[first + i];
      std::copy_n(this->Points[index[i]], Dimension, points + i * Dimension);
    }
  }

private:
  std::optional<LatticeOrder<Dimension>> Lattice; // else the points count
  const ConstPointSpan<Dimension> Points;
  const std::int64_t Chunk; // points
  const bool IsWhole;
  ParticleOrder<Dimension> Sorted; // the points of a chunk
};

} // namespace RectifiedTransport

#endif
