// SPDX-License-Identifier: BSD-3-Clause
// Sorts particles by the tiles of the grid that they reach, keeping their order within a tile.
// Tasks for the tiles then add spatially unordered particles and compute no other weights.
#ifndef RectifiedTransport_SplatTiles_h
#define RectifiedTransport_SplatTiles_h

#include "Core/Splat/Kernels/SplatKernels.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

template <int Dimension, class Real>
class SplatTiles
{
public:
  explicit SplatTiles(const SplatJob<Dimension, Real>& job)
    : Job(job)
  {
  }

  // Divides the cells in memory into tiles. The job must have the cells.
  void Divide();

  // Sorts `count` < 2^32 particles from `first` on. Returns how many are outside; results are
  // undefined after cancellation. Throws std::bad_alloc.
  std::int64_t Sort(
    FindCells<Dimension, Real> find, std::int64_t first, std::int64_t count, Progress& progress);

  std::int64_t Count() const { return this->NumberOfTiles; }
  CellBox<Dimension> Box(std::int64_t tile) const;
  // Particles of a tile, counted from `first`.
  const std::uint32_t* Begin(std::int64_t tile) const;
  std::int64_t CountOf(std::int64_t tile) const;

private:
  // Calls visit(tile) for the tiles of the cells that a particle reaches; `cells` are the first
  // cells along each axis.
  template <class Visit>
  void VisitTiles(const std::int32_t* cells, const Visit& visit) const;

  const SplatJob<Dimension, Real>& Job;
  int Shift[Dimension];
  std::int64_t Tiles[Dimension];
  std::int64_t NumberOfTiles = 1;
  std::vector<std::int64_t> Start;    // of every tile, and the end
  std::vector<std::int64_t> Position; // of every tile in every part of the particles
  std::vector<std::uint32_t> Index;
};

} // namespace RectifiedTransport

#endif
