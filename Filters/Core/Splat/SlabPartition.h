// SPDX-License-Identifier: BSD-3-Clause
// The planes of the grid that chunks of particles reach, and a partition of the cells in memory
// into slabs of about equal work.
#ifndef RectifiedTransport_SlabPartition_h
#define RectifiedTransport_SlabPartition_h

#include "Core/Parallel/Executor.h"
#include "Core/Splat/Kernels/SplatKernels.h"

#include <vector>

namespace RectifiedTransport
{

// Particles. A chunk of a lattice that is splat in its own order is a few cells high: few chunks
// reach two slabs, and only their weights are computed twice.
constexpr std::int64_t splatChunk = 512;

template <int Dimension, class Real>
class SlabPartition
{
public:
  // Consecutive chunks [First, Last) that reach a slab.
  struct Run
  {
    std::int64_t First;
    std::int64_t Last;
    bool IsInside; // they reach no other slab
  };

  SlabPartition() = default;
  SlabPartition(const SplatJob<Dimension, Real>& job, BoxOfParticles<Dimension, Real> reach)
    : Job(&job)
    , Reach(reach)
  {
  }

  // Finds the planes that chunks of the particles [first, first + count), count > 0, may reach.
  void FindChunks(std::int64_t first, std::int64_t count, const Executor& executor);

  // After FindChunks: whether most chunks reach more cells than caches hold.
  bool IsScattered() const { return this->Scattered; }

  // After FindChunks: cuts the cells in memory into at most `wanted` slabs. Returns the mean number
  // of slabs that a chunk reaches.
  double CutSlabs(std::int64_t wanted);

  std::int64_t NumberOfSlabs() const { return static_cast<std::int64_t>(this->Cuts.size()) - 1; }
  // The next run from a chunk on; an empty one if there is none.
  Run NextRun(std::int64_t slab, std::int64_t chunk) const;
  CellBox<Dimension> Slab(std::int64_t slab) const;

private:
  // Planes [Low, High) across the last axis; none if no cell in memory is reached.
  struct Chunk
  {
    std::int32_t Low;
    std::int32_t High;
    bool IsScattered;
  };

  std::int64_t NumberOfChunks() const { return static_cast<std::int64_t>(this->Chunks.size()); }
  Chunk ChunkOf(const CellBox<Dimension>& reached) const;
  void SumPlanes();

  const SplatJob<Dimension, Real>* Job = nullptr;
  BoxOfParticles<Dimension, Real> Reach = nullptr;
  std::vector<Chunk> Chunks;
  bool Scattered = false;
  std::vector<double> Work;            // of the planes up to each
  std::vector<std::int64_t> Crossings; // chunks that reach both sides of each plane's lower face
  std::vector<std::int32_t> Cuts;
};

} // namespace RectifiedTransport

#endif
