// SPDX-License-Identifier: BSD-3-Clause
// The particles of an advection in an order in which neighbours in memory are neighbours in space.
#ifndef RectifiedTransport_ParticleSource_h
#define RectifiedTransport_ParticleSource_h

#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/FlowSeeds.h"
#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Flow/Particles/SortedPoints.h"
#include "Core/Geometry/GridSize.h"

#include <cstdint>
#include <variant>

namespace RectifiedTransport
{

class Ranks;

template <int Dimension>
class ParticleSource
{
public:
  // On a box of `size`, in chunks of at most `chunk` points of an array. Throws
  // std::invalid_argument, also if there is not enough memory for the positions.
  ParticleSource(const FlowSeeds<Dimension>& seeds, const GridSize<Dimension>& size,
    std::int64_t positions, std::int64_t chunk = SortedPoints<Dimension>::UsualChunk)
    : Order(SortedPoints<Dimension>(seeds.Points(), chunk))
    , IsWhole(seeds.IsWholeLattice())
  {
    if (seeds.IsLattice())
    {
      this->Order = checkedOrder<Dimension>(seeds, size, positions);
      return;
    }
    checkCount(positions, static_cast<double>(seeds.Points().size()));
  }

  std::int64_t Count() const
  {
    return std::visit([](const auto& order) { return order.Count(); }, this->Order);
  }
  // The lattice, if the particles are all of its points: the results are in the order of its cells.
  const LatticeOrder<Dimension>* WholeLattice() const
  {
    return this->IsWhole ? std::get_if<LatticeOrder<Dimension>>(&this->Order) : nullptr;
  }
  std::int64_t Chunks() const
  {
    return std::visit([](const auto& order) { return order.Chunks(); }, this->Order);
  }
  // The number of particles of all ranks. Collective.
  double CountOfAll(const Ranks& ranks) const
  {
    return std::visit([&](const auto& order) { return order.CountOfAll(ranks); }, this->Order);
  }
  // Makes the chunk that begins at particle `first`; returns its length.
  std::int64_t Prepare(std::int64_t first)
  {
    return std::visit([&](auto& order) { return order.Prepare(first); }, this->Order);
  }
  // Reads `count` particles of the chunk from its number `first` on: the indices of their results,
  // and their coordinates.
  void Fill(std::int64_t first, int count, std::int64_t* index, double* points) const
  {
    if (const auto* lattice = std::get_if<LatticeOrder<Dimension>>(&this->Order))
    {
      lattice->Fill(first, count, index, points);
      return;
    }
    std::get_if<SortedPoints<Dimension>>(&this->Order)->Fill(first, count, index, points);
  }

private:
  std::variant<SortedPoints<Dimension>, LatticeOrder<Dimension>> Order;
  bool IsWhole;
};

} // namespace RectifiedTransport

#endif
