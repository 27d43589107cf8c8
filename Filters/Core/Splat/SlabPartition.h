// SPDX-License-Identifier: BSD-3-Clause
// The planes of the grid that chunks of particles reach, and a partition of the grid into slabs of
// about equal work.
#ifndef RectifiedTransport_SlabPartition_h
#define RectifiedTransport_SlabPartition_h

#include "Core/Parallel/Executor.h"
#include "Core/Splat/Kernels/SplatKernels.h"

#include <vector>

namespace RectifiedTransport
{

constexpr std::int64_t splatChunk = 4096; // particles

template <int Dimension, class Real>
class SlabPartition
{
public:
  // Planes [Low, High) across the last axis.
  struct Planes
  {
    std::int32_t Low;
    std::int32_t High;
  };

  SlabPartition() = default;
  SlabPartition(const SplatJob<Dimension, Real>& job, BoxOfParticles<Dimension, Real> reach)
    : Job(&job)
    , Reach(reach)
  {
  }

  // Finds the planes of the chunks of particles [first, first + count).
  void FindChunks(std::int64_t first, std::int64_t count, const Executor& executor);

  std::int64_t NumberOfChunks() const { return static_cast<std::int64_t>(this->Chunks.size()); }
  // The planes that a chunk may reach.
  Planes Chunk(std::int64_t chunk) const { return this->Chunks[static_cast<std::size_t>(chunk)]; }

  // Cuts the grid into at most `wanted` slabs, after FindChunks. Returns the mean number of slabs
  // that a chunk reaches.
  double CutSlabs(std::int64_t wanted);

  std::int64_t NumberOfSlabs() const { return static_cast<std::int64_t>(this->Cuts.size()) - 1; }
  CellBox<Dimension> Slab(std::int64_t slab) const;

private:
  const SplatJob<Dimension, Real>* Job = nullptr;
  BoxOfParticles<Dimension, Real> Reach = nullptr;
  std::vector<Planes> Chunks;
  std::vector<double> Work; // of every plane
  std::vector<std::int32_t> Cuts;
};

} // namespace RectifiedTransport

#endif
