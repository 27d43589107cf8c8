// SPDX-License-Identifier: BSD-3-Clause
// One advection of many particles (paper, Section 3.3): ranges of blocks for the kernels.
// Unresolved particles are advected again with smaller steps; the rest are moved to the nearest
// mass.
#ifndef RectifiedTransport_AdvectionRun_h
#define RectifiedTransport_AdvectionRun_h

#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/Compaction.h"
#include "Core/Flow/FlowMap.h"
#include "Core/Flow/ParticleSource.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/NearestMass.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

constexpr int rangeBlocks = 16;

// The grains of a range, one by one: an executor may join several.
template <class Kernel>
void forGrains(std::int64_t first, std::int64_t last, std::int64_t grain, const Kernel& kernel)
{
  for (; first < last; first += grain)
  {
    kernel(first, std::min(first + grain, last));
  }
}

// Counted over the ranges of one advection. Sums of integers do not depend on their order.
struct Counters
{
  std::atomic<std::int64_t> Redone{ 0 };
  std::atomic<std::int64_t> MovedToMass{ 0 };
  std::atomic<std::int64_t> Evaluations{ 0 };
};

// Particles that met an empty box or ended in an empty cell, to be redone.
template <int Dimension>
struct UnresolvedParticles
{
  std::vector<std::int64_t> Index; // in the output
  std::vector<double> Seeds;
};

// Moves a particle that ends in an empty cell even with the smallest steps to the nearest mass.
template <int Dimension>
void moveToMass(const FlowJob<Dimension>& job, std::int64_t particle, Counters& counters)
{
  const std::int64_t last = (particle + 1) * job.TimeCount - 1;
  const bool atEnd = !job.Times || job.Times[job.TimeCount - 1] >= 1.0;
  double* position = job.Output + last * Dimension;
  Point<Dimension> point;
  std::copy_n(position, Dimension, point.begin());
  if (atEnd && !hasMass<Dimension>(job.Tables, point))
  {
    point = nearestMass<Dimension>(job.Tables, point);
    std::copy_n(point.begin(), Dimension, position);
    ++counters.MovedToMass;
  }
}

// Advects particles, at most rangeBlocks * BlockSize.
template <int Dimension>
class RangeAdvection
{
public:
  RangeAdvection(const FlowJob<Dimension>& job, Counters& counters, Progress& progress)
    : Job(job)
    , Count(counters)
    , Work(progress)
    , Advect(flowKernels().Advect<Dimension>())
  {
  }

  // Reads `count` particles of a source.
  template <class Source>
  void Fill(Source& source, std::int64_t first, int count)
  {
    // Copies, because the output may be the array of the seeds.
    source.Fill(first, count, this->Index, this->Seeds);
    this->Number = count;
  }

  // Advects the particles and keeps the unresolved ones, for the next pass.
  void Pass(int pass)
  {
    const int count = std::exchange(this->Number, 0);
    for (int first = 0; first < count && !this->Work.ShouldStop(); first += BlockSize)
    {
      const int lanes = std::min(BlockSize, count - first);
      bool unresolved[BlockSize] = {};
      this->Count.Evaluations += this->Advect(
        this->Job, this->Seeds + first * Dimension, this->Index + first, lanes, pass, unresolved);
      const int before = this->Number;
      this->Number += compact(
        lanes, [&](int i) { return unresolved[i]; },
        [&](int i, int place) {
          this->Index[before + place] = this->Index[first + i];
          std::copy_n(this->Seeds + (first + i) * Dimension, Dimension,
            this->Seeds + (before + place) * Dimension);
        });
    }
    if (pass == 0)
    {
      this->Number = this->Job.Backward || this->Job.Nearest ? 0 : this->Number;
      this->Count.Redone += this->Number;
    }
  }

  // All passes; what is left moves to the nearest mass.
  void Run(int firstPass, int lastPass)
  {
    for (int pass = firstPass; this->Number > 0 && pass <= lastPass; ++pass)
    {
      this->Pass(pass);
    }
    for (int i = 0; i < this->Number && !this->Work.ShouldStop(); ++i)
    {
      moveToMass<Dimension>(this->Job, this->Index[i], this->Count);
    }
  }

  UnresolvedParticles<Dimension> Unresolved() const
  {
    return { { this->Index, this->Index + this->Number },
      { this->Seeds, this->Seeds + this->Number * Dimension } };
  }

private:
  const FlowJob<Dimension>& Job;
  Counters& Count;
  Progress& Work;
  const AdvectBlock<Dimension> Advect;
  int Number = 0;
  std::int64_t Index[rangeBlocks * BlockSize];
  double Seeds[rangeBlocks * BlockSize * Dimension];
};

// Advects the unresolved particles of many ranges together: a block with few particles costs nearly
// as much as a full one, and most ranges leave few.
template <int Dimension>
class UnresolvedAdvection
{
public:
  UnresolvedAdvection(const FlowJob<Dimension>& job, Counters& counters, Progress& progress)
    : Job(job)
    , Count(counters)
    , Work(progress)
    , Advect(flowKernels().Advect<Dimension>())
  {
  }

  void Run(const std::vector<UnresolvedParticles<Dimension>>& ranges, int firstPass, int lastPass)
  {
    for (const UnresolvedParticles<Dimension>& range : ranges)
    {
      this->Index.insert(this->Index.end(), range.Index.begin(), range.Index.end());
      this->Seeds.insert(this->Seeds.end(), range.Seeds.begin(), range.Seeds.end());
    }
    this->IsUnresolved.resize(this->Index.size());
    for (int pass = firstPass; !this->Index.empty() && pass <= lastPass; ++pass)
    {
      this->Pass(pass);
      this->Count.Redone += pass == 0 ? static_cast<std::int64_t>(this->Index.size()) : 0;
    }
    const auto left = static_cast<std::int64_t>(this->Index.size());
    this->Work.Threads().For(left, BlockSize, [this](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last && !this->Work.ShouldStop(); ++i)
      {
        moveToMass<Dimension>(this->Job, this->Index[static_cast<std::size_t>(i)], this->Count);
      }
    });
  }

private:
  void Pass(int pass)
  {
    const auto count = static_cast<std::int64_t>(this->Index.size());
    const auto advect = [this, pass](std::int64_t first, std::int64_t last) {
      if (this->Work.ShouldStop())
      {
        return;
      }
      bool unresolved[BlockSize] = {};
      this->Count.Evaluations += this->Advect(this->Job, this->Seeds.data() + first * Dimension,
        this->Index.data() + first, static_cast<int>(last - first), pass, unresolved);
      std::copy(unresolved, unresolved + (last - first), this->IsUnresolved.data() + first);
    };
    this->Work.Threads().For(count, BlockSize, [&advect](std::int64_t first, std::int64_t last) {
      forGrains(first, last, BlockSize, advect);
    });
    const std::size_t left = compact(
      this->Index.size(), [&](std::size_t i) { return this->IsUnresolved[i] != 0; },
      [&](std::size_t i, std::size_t place) {
        this->Index[place] = this->Index[i];
        std::copy_n(
          this->Seeds.data() + i * Dimension, Dimension, this->Seeds.data() + place * Dimension);
      });
    this->Index.resize(left);
  }

  const FlowJob<Dimension>& Job;
  Counters& Count;
  Progress& Work;
  const AdvectBlock<Dimension> Advect;
  std::vector<std::int64_t> Index;
  std::vector<double> Seeds;
  std::vector<unsigned char> IsUnresolved;
};

// The particles of a source for one range, with local memory for their end points.
template <int Dimension>
class RangeCells
{
public:
  RangeCells(const ParticleSource<Dimension>& source, const FlowJob<Dimension>& job)
    : Order(source)
    , Job(job)
  {
    this->Job.Output = this->Ends;
  }

  const FlowJob<Dimension>& LocalJob() const { return this->Job; }

  void Fill(std::int64_t first, int count, std::int64_t* index, double* points)
  {
    this->Order.Fill(first, count, this->Number, points);
    std::iota(index, index + count, std::int64_t{ 0 });
  }

  // Writes the number of the grid cell with mass in which each particle ends, or the nearest one.
  // Returns how many end in empty cells.
  std::int64_t Write(int count, std::int64_t* cells) const
  {
    std::int64_t missed = 0;
    for (int i = 0; i < count; ++i)
    {
      Point<Dimension> point;
      std::copy_n(this->Ends + i * Dimension, Dimension, point.begin());
      Point<Dimension> inside = this->Middle(point);
      if (!hasMass<Dimension>(this->Job.Tables, inside))
      {
        missed += hasMass<Dimension>(this->Job.Tables, point) ? 0 : 1;
        inside = this->Middle(nearestMass<Dimension>(this->Job.Tables, point));
      }
      std::int64_t cell = 0;
      for (int axis = Dimension; axis-- > 0;)
      {
        cell = cell * this->Job.Tables.Cells[axis] + static_cast<std::int64_t>(inside[axis]);
      }
      cells[this->Number[i]] = cell;
    }
    return missed;
  }

private:
  // The centre of the grid cell that contains a point; on a face, of the upper cell.
  Point<Dimension> Middle(const Point<Dimension>& point) const
  {
    Point<Dimension> middle;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double last = this->Job.Tables.Size[axis] - 1.0;
      middle[axis] = std::min(std::floor(point[axis]), last) + 0.5;
    }
    return middle;
  }

  const ParticleSource<Dimension>& Order;
  FlowJob<Dimension> Job;
  std::int64_t Number[rangeBlocks * BlockSize];
  double Ends[rangeBlocks * BlockSize * Dimension];
};

// One advection of any number of particles.
template <int Dimension>
class AdvectionRun
{
public:
  AdvectionRun(const TableView<Dimension>& tables, AdvectionKind kind, const FlowOptions& options,
    const Context& context)
    : Shared(tables, kind, options)
    , Job(Shared.Job)
    , Work(context)
  {
    this->Job.ShouldStop = [](void* clientData) {
      return static_cast<Progress*>(clientData)->ShouldStop();
    };
    this->Job.ClientData = &this->Work;
    // With many steps, ranges have fewer particles. This bounds the time between progress reports.
    constexpr std::int64_t usualSteps = 64;
    const std::int64_t steps = std::max(this->Job.Steps, usualSteps);
    this->Grain = std::max<std::int64_t>(1, rangeBlocks * usualSteps / steps) * BlockSize;
  }
  AdvectionRun(const AdvectionRun&) = delete;
  AdvectionRun& operator=(const AdvectionRun&) = delete;

  const AdvectionJob<Dimension>& SharedJob() const { return this->Shared; }
  const Ranks& Group() const { return this->Work.Group(); }

  // The context of work that comes before the advection and takes a share of its time.
  Context BeginPreparation(double share)
  {
    this->Work.BeginStage(share);
    return this->Work.Stage();
  }

  // Particles start from a flow map, or end on it. The map is of the same tables, steps and
  // direction. If it was made for this run, its evaluations count for the run.
  void UseMap(std::shared_ptr<const FlowMap<Dimension>> map, bool isNew)
  {
    this->Count.Evaluations += isNew ? map->Evaluations() : 0;
    this->Map = std::move(map);
    const bool hasLevels = this->Map->View().LevelCount > 0;
    this->Job.Map = hasLevels ? &this->Map->View() : nullptr;
    this->First = hasLevels ? -this->Job.Map->LevelCount : 0;
  }

  // Advects the particles of a source chunk by chunk. Writes the positions at the ascending times,
  // all times of a particle together; without times, at the end. Throws Cancelled.
  FlowReport Advect(ParticleSource<Dimension>& source, PointSpan<Dimension> positions,
    const std::vector<double>& times = {})
  {
    this->Job.Output = positions.data();
    this->Job.Times = times.empty() ? nullptr : times.data();
    this->Job.TimeCount = std::max<std::int64_t>(1, static_cast<std::int64_t>(times.size()));
    constexpr std::size_t enough = 2048; // particles: fills blocks, and takes little time
    const Executor& threads = this->Work.Threads();
    this->Work.BeginStage(1.0, source.Count());
    std::vector<UnresolvedParticles<Dimension>> unresolved;
    std::size_t left = 0;
    std::int64_t chunkEnd = 0;
    for (std::int64_t chunk = 0, begin = 0; begin < source.Count();)
    {
      if (begin == chunkEnd)
      {
        chunk = begin;
        chunkEnd += source.Prepare(begin);
      }
      const std::int64_t slice =
        std::min(chunkEnd - begin, this->Work.NextSlice(this->Grain * threads.Concurrency()));
      const std::size_t before = unresolved.size();
      unresolved.resize(before + static_cast<std::size_t>((slice + this->Grain - 1) / this->Grain));
      const auto advect = [&](std::int64_t first, std::int64_t last) {
        RangeAdvection<Dimension> range(this->Job, this->Count, this->Work);
        range.Fill(source, begin - chunk + first, static_cast<int>(last - first));
        range.Pass(this->First);
        unresolved[before + static_cast<std::size_t>(first / this->Grain)] = range.Unresolved();
      };
      threads.For(slice, this->Grain, [&](std::int64_t first, std::int64_t last) {
        forGrains(first, last, this->Grain, advect);
      });
      for (std::size_t range = before; range < unresolved.size(); ++range)
      {
        left += unresolved[range].Index.size();
      }
      begin += slice;
      if (left >= enough || begin == chunkEnd)
      {
        UnresolvedAdvection<Dimension>(this->Job, this->Count, this->Work)
          .Run(unresolved, this->First + 1, this->Shared.LastPass());
        unresolved.clear();
        left = 0;
      }
      this->Work.EndSlice(slice);
    }
    return this->Report();
  }

  // Advects the particles of a source and writes the grid cell in which each ends. Throws
  // Cancelled.
  FlowReport AdvectToCells(ParticleSource<Dimension>& source, std::int64_t* cells)
  {
    const auto all = static_cast<double>(source.Count());
    for (std::int64_t chunk = 0; chunk < source.Count();)
    {
      const std::int64_t count = source.Prepare(chunk);
      const auto advect = [&](std::int64_t first, std::int64_t last) {
        const int length = static_cast<int>(last - first);
        RangeCells<Dimension> ends(source, this->Job);
        RangeAdvection<Dimension> range(ends.LocalJob(), this->Count, this->Work);
        range.Fill(ends, first, length);
        range.Run(this->First, this->Shared.LastPass());
        if (!this->Work.ShouldStop())
        {
          this->Count.MovedToMass += ends.Write(length, cells);
        }
      };
      chunk += count;
      this->Work.BeginStage(static_cast<double>(chunk) / all);
      this->Work.For(
        count, this->Grain,
        [&](std::int64_t first, std::int64_t last) { forGrains(first, last, this->Grain, advect); },
        this->Grain);
    }
    return this->Report();
  }

private:
  FlowReport Report() const
  {
    FlowReport report;
    report.Redone = this->Count.Redone;
    report.MovedToMass = this->Count.MovedToMass;
    report.Evaluations = this->Count.Evaluations;
    return report;
  }

  const AdvectionJob<Dimension> Shared;
  FlowJob<Dimension> Job;
  std::shared_ptr<const FlowMap<Dimension>> Map;
  int First = 0; // pass
  Counters Count;
  Progress Work;
  std::int64_t Grain = BlockSize;
};

} // namespace RectifiedTransport

#endif
