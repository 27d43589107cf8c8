// SPDX-License-Identifier: BSD-3-Clause
// The distribution of particles and grid cells to tasks. At any time one task adds to a cell, in
// the order of the particles: the sums are those of a serial loop, however the cells are divided
// among tasks and the particles into slices.
#include "Core/Splat/Splat.h"

#include "Core/Parallel/Stages.h"
#include "Core/Splat/SlabPartition.h"
#include "Core/Splat/SplatSetup.h"
#include "Core/Splat/SplatTiles.h"

#include <algorithm>
#include <atomic>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A slice of particles is small enough that long work has several slices, dense enough that loading
// a tile into the cache pays, and short enough for 32-bit numbers within it.
constexpr double shortestSlice = 1 << 22; // shares of particles in cells
constexpr double densestSlice = 0.25;     // particles a cell
constexpr std::int64_t longestSlice = std::int64_t{ 1 } << 24;

// The mean number of slabs that a chunk may reach, since its weights are computed for each. Up to
// 1.2 there may be more slabs than tasks, for balance; beyond 8, sorting particles into tiles is
// cheaper. It is cheaper, too, if chunks are scattered over more cells than the caches hold. (A
// single task gains nothing from sorting: its cache misses overlap.)
constexpr double fewVisits = 1.2;
constexpr double mostVisits = 8.0;
constexpr std::int64_t mostSlabs = 4; // a task

// Wider kernels have so many cells that sorting gains nothing. Groups of tiles are the tasks.
constexpr std::int64_t widestSorted = 16;
constexpr std::int64_t groupsOfTiles = 256;

template <int Dimension, class Real>
class SplatRun
{
public:
  SplatRun(const SplatParticles<Dimension, Real>& particles, const GridSize<Dimension>& size,
    const LatticePart<Dimension>& part, const SplatOptions& options, double scale, double* cells)
    : Setup(particles, size, options)
    , Tiles(this->Job)
    , NumberOfCells(part.Count())
    , IsWhole(part.Cells == size)
  {
    this->Job.Scale = scale;
    this->Job.Memory.Cells = cells;
    std::int64_t stride = 1;
    double reached = 1.0;
    for (int a = 0; a < Dimension; ++a)
    {
      this->Job.Box.Low[a] = static_cast<std::int32_t>(part.Low[a]);
      this->Job.Box.High[a] = static_cast<std::int32_t>(part.Low[a] + part.Cells[a]);
      this->Job.Memory.Stride[a] = stride;
      // Offsets in memory are those of the grid's cells less this start.
      this->Job.Memory.Start += stride * part.Low[a];
      stride *= part.Cells[a];
      reached *= this->Job.Span[a];
    }
    // Slices of wide kernels have fewer particles, as each has `reached` shares.
    const double shortest = std::clamp(shortestSlice / reached, 64.0, shortestSlice / 8.0);
    // Particles between two checks for cancellation: the wider the kernel, the fewer.
    this->Step = static_cast<std::int64_t>(shortest);
    const double dense =
      std::min(densestSlice * static_cast<double>(stride), static_cast<double>(longestSlice));
    this->ShortestSlice = static_cast<std::int64_t>(
      this->Job.Width > widestSorted ? shortest : std::max(shortest, dense));
    this->Slabs = SlabPartition<Dimension, Real>(this->Job, this->Kernels.Reach);
    this->Tiles.Divide();
  }

  SplatReport Run(const Context& context)
  {
    const std::int64_t count = this->Job.Particles.Points.size();
    Progress progress(context);
    Stages stages(progress, { { "cells", 1 }, { "particles", count > 0 ? 9.0 : 0.0 } });
    this->Clear(stages["cells"]);
    Progress& work = stages["particles"].Expect(count);
    for (std::int64_t begin = 0; begin < count;)
    {
      const std::int64_t slice =
        std::min({ count - begin, work.NextSlice(this->ShortestSlice), longestSlice });
      this->AddSlice(begin, slice, work);
      begin += slice;
      work.EndSlice(slice);
    }
    return { this->Outside };
  }

private:
  // Threads clear ranges of cells in parallel, as new memory is slow to write for the first time.
  void Clear(Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
    double* cells = this->Job.Memory.Cells;
    progress.For(
      this->NumberOfCells, grain,
      [cells](
        std::int64_t first, std::int64_t last) { std::fill(cells + first, cells + last, 0.0); },
      16 * grain);
  }

  // Chooses how the threads divide the particles of a slice. Each way adds the particles of a cell
  // in their order, so that the sums have the same bits.
  void AddSlice(std::int64_t first, std::int64_t count, Progress& progress)
  {
    const int tasks = progress.Threads().Concurrency();
    if (tasks == 1)
    {
      this->AddInOrder(first, count, progress);
      return;
    }
    this->Slabs.FindChunks(first, count, progress.Threads());
    double visits = 0.0;
    for (std::int64_t slabs = mostSlabs; slabs > 0; slabs /= 2)
    {
      // Halve the number of slabs until few chunks are visited twice.
      visits = this->Slabs.CutSlabs(slabs * tasks);
      if (visits <= fewVisits)
      {
        break;
      }
    }
    const bool isSortCheaper = visits > mostVisits || this->Slabs.IsScattered();
    if (isSortCheaper && this->Job.Width <= widestSorted)
    {
      this->AddByTiles(first, count, progress);
    }
    else
    {
      this->AddBySlabs(first, count, progress);
    }
  }

  // One task adds everything in order, without any partition.
  void AddInOrder(std::int64_t first, std::int64_t count, Progress& progress)
  {
    this->MakeScratch(1);
    this->Outside += this->AddRange(first, count, this->BoxOf(this->Job.Box, true), 0, progress);
  }

  // Each task adds the chunks that reach its slab to the cells of the slab.
  void AddBySlabs(std::int64_t first, std::int64_t count, Progress& progress)
  {
    const std::int64_t slabs = this->Slabs.NumberOfSlabs();
    this->MakeScratch(slabs);
    progress.Threads().For(slabs, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t slab = begin; slab < end; ++slab)
      {
        const CellBox<Dimension> box = this->Slabs.Slab(slab);
        std::int64_t outside = 0;
        for (auto run = this->Slabs.NextRun(slab, 0);
             run.First < run.Last && !progress.IsCancelled();
             run = this->Slabs.NextRun(slab, run.Last))
        {
          const std::int64_t start = run.First * splatChunk;
          const std::int64_t number = std::min(run.Last * splatChunk, count) - start;
          outside +=
            this->AddRange(first + start, number, this->BoxOf(box, run.IsInside), slab, progress);
        }
        this->Outside += outside;
      }
    });
  }

  // A tile has all its particles in their order, so that the sum in a cell is that of a serial
  // loop.
  void AddByTiles(std::int64_t first, std::int64_t count, Progress& progress)
  {
    this->Outside += this->Tiles.Sort(this->Kernels.Find, first, count, progress);
    if (progress.IsCancelled())
    {
      return;
    }
    // Groups of consecutive tiles are tasks.
    const std::int64_t tiles = this->Tiles.Count();
    const std::int64_t groups = std::min(tiles, groupsOfTiles);
    this->MakeScratch(groups);
    progress.Threads().For(groups, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t group = begin; group < end; ++group)
      {
        for (std::int64_t tile = group * tiles / groups;
             tile < (group + 1) * tiles / groups && !progress.ShouldStop(); ++tile)
        {
          const CellBox<Dimension> box = this->Tiles.Box(tile);
          this->Kernels.Add(this->Job, first, this->Tiles.Begin(tile), this->Tiles.CountOf(tile),
            &box, this->ScratchOf(group));
        }
      }
    });
  }

  // Adds a range of particles in steps that are short for kernels of any width, with a poll for
  // cancellation between them.
  std::int64_t AddRange(std::int64_t first, std::int64_t count, const CellBox<Dimension>* box,
    std::int64_t task, Progress& progress)
  {
    std::int64_t outside = 0;
    for (std::int64_t begin = 0; begin < count && !progress.ShouldStop(); begin += this->Step)
    {
      outside += this->Kernels.Add(this->Job, first + begin, nullptr,
        std::min(this->Step, count - begin), box, this->ScratchOf(task));
    }
    return outside;
  }

  // Returns the box to which a kernel clips particles, or nullptr if they lie within the box as far
  // as they lie within the grid.
  const CellBox<Dimension>* BoxOf(const CellBox<Dimension>& box, bool isInside) const
  {
    return isInside && this->IsWhole ? nullptr : &box;
  }

  // Kernels of variable width need memory for their weights along each axis.
  void MakeScratch(std::int64_t tasks)
  {
    this->ScratchEach = this->Kernels.Width > 0 ? 0 : std::int64_t{ Dimension } * this->Job.Width;
    this->Scratch.resize(static_cast<std::size_t>(this->ScratchEach * tasks));
  }
  double* ScratchOf(std::int64_t task) { return this->Scratch.data() + task * this->ScratchEach; }

  SplatSetup<Dimension, Real> Setup;
  SplatJob<Dimension, Real>& Job = this->Setup.Job;
  const SplatKernels<Dimension, Real>& Kernels = this->Setup.Kernels;
  SlabPartition<Dimension, Real> Slabs;
  SplatTiles<Dimension, Real> Tiles;
  const std::int64_t NumberOfCells; // in memory
  const bool IsWhole;               // they are those of the grid
  std::int64_t ShortestSlice = 0;
  std::int64_t Step = 0; // particles between two polls for cancellation
  std::vector<double> Scratch;
  std::int64_t ScratchEach = 0;
  std::atomic<std::int64_t> Outside{ 0 };
};

} // namespace

template <int Dimension, class Real>
SplatReport splatMass(const SplatParticles<Dimension, Real>& particles,
  const GridSize<Dimension>& size, const LatticePart<Dimension>& part, const SplatOptions& options,
  double scale, double* cells, const Context& context)
{
  return part.Count() > 0
    ? SplatRun<Dimension, Real>(particles, size, part, options, scale, cells).Run(context)
    : SplatReport();
}

template SplatReport splatMass<1, float>(const SplatParticles<1, float>&, const GridSize<1>&,
  const LatticePart<1>&, const SplatOptions&, double, double*, const Context&);
template SplatReport splatMass<2, float>(const SplatParticles<2, float>&, const GridSize<2>&,
  const LatticePart<2>&, const SplatOptions&, double, double*, const Context&);
template SplatReport splatMass<3, float>(const SplatParticles<3, float>&, const GridSize<3>&,
  const LatticePart<3>&, const SplatOptions&, double, double*, const Context&);
template SplatReport splatMass<1, double>(const SplatParticles<1, double>&, const GridSize<1>&,
  const LatticePart<1>&, const SplatOptions&, double, double*, const Context&);
template SplatReport splatMass<2, double>(const SplatParticles<2, double>&, const GridSize<2>&,
  const LatticePart<2>&, const SplatOptions&, double, double*, const Context&);
template SplatReport splatMass<3, double>(const SplatParticles<3, double>&, const GridSize<3>&,
  const LatticePart<3>&, const SplatOptions&, double, double*, const Context&);

} // namespace RectifiedTransport
