// SPDX-License-Identifier: BSD-3-Clause
// The planes of the grid that chunks of particles reach, and a partition of the cells in memory
// into slabs of about equal work.
#ifndef RectifiedTransport_SlabPartition_h
#define RectifiedTransport_SlabPartition_h

#include "Core/Parallel/Executor.h"
#include "Core/Splat/Kernels/SplatKernels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Particles in a chunk. A chunk of a lattice in its own order is a few cells high, so that few
// chunks reach two slabs; only their weights are computed twice.
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
  void FindChunks(std::int64_t first, std::int64_t count, const Executor& executor)
  {
    const std::int64_t chunks = (count + splatChunk - 1) / splatChunk;
    this->Chunks.resize(static_cast<std::size_t>(chunks));
    executor.For(chunks, 128, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t chunk = begin; chunk < end; ++chunk)
      {
        const std::int64_t start = chunk * splatChunk;
        this->Chunks[static_cast<std::size_t>(chunk)] = this->ChunkOf(
          this->Reach(*this->Job, first + start, std::min(splatChunk, count - start)));
      }
    });
    this->SumPlanes();
  }

  // After FindChunks: whether most chunks reach more cells than caches hold.
  bool IsScattered() const { return this->Scattered; }

  // After FindChunks: cuts the cells in memory into at most `wanted` slabs of about equal work.
  // Returns the mean number of slabs that a chunk reaches.
  double CutSlabs(std::int64_t wanted)
  {
    const std::int32_t start = this->Job->Box.Low[Dimension - 1];
    const std::int32_t planes = this->Job->Box.High[Dimension - 1] - start;
    const auto chunks = static_cast<double>(this->Chunks.size());
    const double share = chunks / static_cast<double>(std::max<std::int64_t>(wanted, 1));
    this->Cuts.assign(1, start);
    std::int64_t visits = this->NumberOfChunks();
    for (std::int32_t cut = 1;
         cut < planes && static_cast<std::int64_t>(this->Cuts.size()) < wanted; ++cut)
    {
      // A new slab begins when the work of the planes so far reaches its share; chunks across the
      // cut are visited once more.
      const double work = this->Work[static_cast<std::size_t>(cut) - 1];
      if (work >= share * static_cast<double>(this->Cuts.size()))
      {
        this->Cuts.push_back(start + cut);
        visits += this->Crossings[static_cast<std::size_t>(cut)];
      }
    }
    this->Cuts.push_back(start + planes);
    return static_cast<double>(visits) / chunks;
  }

  std::int64_t NumberOfSlabs() const { return static_cast<std::int64_t>(this->Cuts.size()) - 1; }
  // Returns the next run from a chunk on, or an empty one.
  Run NextRun(std::int64_t slab, std::int64_t chunk) const
  {
    const std::int32_t low = this->Cuts[static_cast<std::size_t>(slab)];
    const std::int32_t high = this->Cuts[static_cast<std::size_t>(slab) + 1];
    // Whether a chunk reaches the slab, and whether it reaches no other one.
    const auto reaches = [&](std::int64_t c) {
      const Chunk& planes = this->Chunks[static_cast<std::size_t>(c)];
      return planes.Low < high && planes.High > low;
    };
    const auto isInside = [&](std::int64_t c) {
      const Chunk& planes = this->Chunks[static_cast<std::size_t>(c)];
      return planes.Low >= low && planes.High <= high;
    };
    const std::int64_t chunks = this->NumberOfChunks();
    while (chunk < chunks && !reaches(chunk))
    {
      ++chunk;
    }
    Run run = { chunk, chunk, chunk < chunks && isInside(chunk) };
    while (run.Last < chunks && reaches(run.Last) && isInside(run.Last) == run.IsInside)
    {
      ++run.Last;
    }
    return run;
  }

  CellBox<Dimension> Slab(std::int64_t slab) const
  {
    CellBox<Dimension> box = this->Job->Box;
    box.Low[Dimension - 1] = this->Cuts[static_cast<std::size_t>(slab)];
    box.High[Dimension - 1] = this->Cuts[static_cast<std::size_t>(slab) + 1];
    return box;
  }

private:
  // Planes [Low, High) across the last axis; none if no cell in memory is reached.
  struct Chunk
  {
    std::int32_t Low;
    std::int32_t High;
    bool IsScattered;
  };

  std::int64_t NumberOfChunks() const { return static_cast<std::int64_t>(this->Chunks.size()); }
  Chunk ChunkOf(const CellBox<Dimension>& reached) const
  {
    constexpr int last = Dimension - 1;
    constexpr double cellsInCaches = 1 << 20; // 8 MB
    const CellBox<Dimension>& box = this->Job->Box;
    Chunk chunk{ box.Low[last], box.Low[last], false };
    // The cells in memory that the chunk reaches; 0 if there are none.
    double cells = 1.0;
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int32_t low = std::max(reached.Low[a], box.Low[a]);
      cells *= std::max(0, std::min(reached.High[a], box.High[a]) - low);
    }
    if (cells > 0.0)
    {
      chunk = { std::max(reached.Low[last], box.Low[last]),
        std::min(reached.High[last], box.High[last]), cells > cellsInCaches };
    }
    return chunk;
  }

  void SumPlanes()
  {
    // First as differences between planes; prefix sums then give the work and the crossings. A
    // chunk's work is 1, spread evenly over its planes.
    const std::int32_t start = this->Job->Box.Low[Dimension - 1];
    const auto planes = static_cast<std::size_t>(this->Job->Box.High[Dimension - 1] - start);
    this->Work.assign(planes + 1, 0.0);
    this->Crossings.assign(planes + 1, 0);
    std::int64_t scattered = 0;
    for (const Chunk& chunk : this->Chunks)
    {
      if (chunk.Low == chunk.High)
      {
        continue;
      }
      const auto low = static_cast<std::size_t>(chunk.Low - start);
      const auto high = static_cast<std::size_t>(chunk.High - start);
      const double each = 1.0 / static_cast<double>(high - low);
      this->Work[low] += each;
      this->Work[high] -= each;
      ++this->Crossings[low + 1];
      --this->Crossings[high];
      scattered += chunk.IsScattered ? 1 : 0;
    }
    this->Scattered = 2 * scattered > this->NumberOfChunks();
    double work = 0.0;
    double sum = 0.0;
    std::int64_t crossings = 0;
    for (std::size_t plane = 0; plane < planes; ++plane)
    {
      work += this->Work[plane];
      sum += work;
      this->Work[plane] = sum;
      crossings += this->Crossings[plane];
      this->Crossings[plane] = crossings;
    }
  }

  const SplatJob<Dimension, Real>* Job = nullptr;
  BoxOfParticles<Dimension, Real> Reach = nullptr;
  std::vector<Chunk> Chunks;
  bool Scattered = false;
  std::vector<double> Work;            // work of the planes up to each one
  std::vector<std::int64_t> Crossings; // chunks that reach both sides of each plane's lower face
  std::vector<std::int32_t> Cuts;
};

} // namespace RectifiedTransport

#endif
