// SPDX-License-Identifier: BSD-3-Clause
// One advection of many particles (paper, Section 3.3): blocks for the kernels. Unresolved
// particles are advected again with smaller steps; the rest are moved to the nearest mass.
#ifndef RectifiedTransport_AdvectionRun_h
#define RectifiedTransport_AdvectionRun_h

#include "Core/Flow/AdvectionCounters.h"
#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/Devices/DeviceFlow.h"
#include "Core/Flow/FlowMap.h"
#include "Core/Flow/Particles/Compaction.h"
#include "Core/Flow/Particles/ParticleSource.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/NearestMass.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

constexpr int rangeBlocks = 16;

// Particles that wait for a pass: after the first one, those that met an empty box or ended in an
// empty cell. Their seeds are copies, because the output may be the array of the seeds.
template <int Dimension>
struct WaitingParticles
{
  std::vector<std::int64_t> Index; // in the output
  std::vector<double> Seeds;       // [particle][Dimension]

  std::int64_t Count() const { return static_cast<std::int64_t>(this->Index.size()); }
  void Add(std::int64_t index, const double* seed)
  {
    this->Index.push_back(index);
    this->Seeds.insert(this->Seeds.end(), seed, seed + Dimension);
  }
  void Add(const WaitingParticles& others)
  {
    this->Index.insert(this->Index.end(), others.Index.begin(), others.Index.end());
    this->Seeds.insert(this->Seeds.end(), others.Seeds.begin(), others.Seeds.end());
  }
  // Keeps the marked ones, in their order.
  void Keep(const std::vector<unsigned char>& marks)
  {
    this->Index.resize(compact(
      this->Index.size(), [&](std::size_t i) { return marks[i] != 0; },
      [&](std::size_t i, std::size_t place) {
        this->Index[place] = this->Index[i];
        std::copy_n(
          this->Seeds.data() + i * Dimension, Dimension, this->Seeds.data() + place * Dimension);
      }));
    this->Seeds.resize(this->Index.size() * Dimension);
  }
};

// The end points of the particles of one range, in local memory, and the grid cells that they are
// in.
template <int Dimension>
class RangeCells
{
public:
  // Reads `count` particles of a source, at most rangeBlocks * BlockSize.
  RangeCells(const FlowJob<Dimension>& job, const ParticleSource<Dimension>& source,
    std::int64_t first, int count)
    : Job(job)
    , Number(static_cast<std::size_t>(count))
  {
    // Ends stay in this object, so that the seeds may be the output.
    this->Job.Output = this->Ends;
    this->Particles.Index.resize(this->Number.size());
    this->Particles.Seeds.resize(this->Number.size() * Dimension);
    source.Fill(first, count, this->Number.data(), this->Particles.Seeds.data());
    std::iota(this->Particles.Index.begin(), this->Particles.Index.end(), std::int64_t{ 0 });
  }

  const FlowJob<Dimension>& LocalJob() const { return this->Job; }
  WaitingParticles<Dimension>& All() { return this->Particles; }

  // Writes the number of the grid cell with mass in which each particle ends, or the nearest one.
  // Returns how many end in empty cells.
  std::int64_t Write(std::int64_t* cells) const
  {
    std::int64_t missed = 0;
    for (std::size_t i = 0; i < this->Number.size(); ++i)
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
      // Points on the high face belong to the last cell.
      const double last = this->Job.Tables.Size[axis] - 1.0;
      middle[axis] = std::min(std::floor(point[axis]), last) + 0.5;
    }
    return middle;
  }

  FlowJob<Dimension> Job;
  std::vector<std::int64_t> Number; // each particle's cell in the output
  WaitingParticles<Dimension> Particles;
  double Ends[rangeBlocks * BlockSize * Dimension];
};

// One advection of any number of particles.
template <int Dimension>
class AdvectionRun
{
public:
  // Both must outlive it.
  AdvectionRun(const AdvectionJob<Dimension>& shared, Progress& progress)
    : Shared(shared)
    , Job(shared.Job)
    , Work(progress)
  {
    stopWith(this->Job, progress);
    // With many steps, ranges have fewer particles. This bounds the time between progress reports.
    constexpr std::int64_t usualSteps = 64;
    const std::int64_t steps = std::max(this->Job.Steps, usualSteps);
    this->Grain = std::max<std::int64_t>(1, rangeBlocks * usualSteps / steps) * BlockSize;
  }
  AdvectionRun(const AdvectionRun&) = delete;
  AdvectionRun& operator=(const AdvectionRun&) = delete;

  // Particles start from a flow map, or end on it. The map is of the same tables, steps and
  // direction. If it was made for this run, its evaluations count for the run.
  void UseMap(std::shared_ptr<const FlowMap<Dimension>> map, bool isNew)
  {
    this->Count.Evaluations += isNew ? map->Evaluations() : 0;
    this->Map = std::move(map);
    const bool hasLevels = this->Map->View().LevelCount > 0;
    this->Job.Map = hasLevels ? &this->Map->View() : nullptr;
    // Passes below 0 start from levels of the map, the finest one first.
    this->First = hasLevels ? -this->Job.Map->LevelCount : 0;
  }

  // The device that does what Advect without times asks for, as long as it serves.
  void UseDevice(DeviceFlow<Dimension>& flow)
  {
    this->OnDevice = flow.Begin(*this->Work.Device(), this->Shared, this->Map, this->Work);
  }

  // Advects the particles of a source chunk by chunk. Writes the positions at the ascending times,
  // all times of a particle together; without times, at the end. Throws Cancelled.
  FlowReport Advect(ParticleSource<Dimension>& source, PointSpan<Dimension> positions,
    const std::vector<double>& times = {})
  {
    this->Job.Output = positions.data();
    this->Job.Times = times.empty() ? nullptr : times.data();
    this->Job.TimeCount = std::max<std::int64_t>(1, static_cast<std::int64_t>(times.size()));
    constexpr std::int64_t enough = 2048; // particles: fills blocks, and takes little time
    const Executor& threads = this->Work.Threads();
    this->Work.Expect(source.Count());
    WaitingParticles<Dimension> unresolved;
    FlowReport ofDevice;
    std::int64_t chunkEnd = 0;
    for (std::int64_t chunk = 0, begin = 0; begin < source.Count();)
    {
      if (begin == chunkEnd)
      {
        chunk = begin;
        chunkEnd += source.Prepare(begin);
      }
      const std::int64_t slice = std::min(chunkEnd - begin,
        this->Work.NextSlice(this->OnDevice ? this->OnDevice->FewestParticles()
                                            : this->Grain * threads.Concurrency()));
      if (this->OnDevice)
      {
        if (this->OnDevice->Run(
              source, begin - chunk, slice, this->Job.Output, ofDevice, this->Work))
        {
          begin += slice;
          this->Work.EndSlice(slice);
          continue;
        }
        this->OnDevice.reset();
        if (source.WholeLattice())
        {
          // The device took it in another order.
          begin = chunkEnd = 0;
          ofDevice = {};
        }
        continue;
      }
      // A list of each range, so that their order does not depend on threads.
      std::vector<WaitingParticles<Dimension>> left(
        static_cast<std::size_t>((slice + this->Grain - 1) / this->Grain));
      threads.For(slice, this->Grain, [&](std::int64_t first, std::int64_t last) {
        WaitingParticles<Dimension>& those = left[static_cast<std::size_t>(first / this->Grain)];
        for (; first < last && !this->Work.ShouldStop(); first += BlockSize)
        {
          // A block of lanes, with copies of its seeds.
          std::int64_t index[BlockSize];
          double seeds[BlockSize * Dimension];
          bool isUnresolved[BlockSize] = {};
          const auto count = static_cast<int>(std::min<std::int64_t>(BlockSize, last - first));
          source.Fill(begin - chunk + first, count, index, seeds);
          this->Count.Evaluations +=
            this->Kernel(this->Job, seeds, index, count, this->First, isUnresolved);
          for (int i = 0; i < count; ++i)
          {
            if (isUnresolved[i])
            {
              those.Add(index[i], seeds + i * Dimension);
            }
          }
        }
      });
      for (const WaitingParticles<Dimension>& those : left)
      {
        unresolved.Add(those);
      }
      begin += slice;
      // Those of many ranges together: a block with few particles costs nearly as much as a full
      // one, and most ranges leave few.
      if (unresolved.Count() >= enough || begin == chunkEnd)
      {
        this->RunPassesAfter(this->First, this->Job, unresolved, threads);
        unresolved = {};
      }
      this->Work.EndSlice(slice);
    }
    this->Count.Add(ofDevice);
    return this->Count.Report();
  }

  // Advects the particles of a source and writes the grid cell in which each ends. Throws
  // Cancelled.
  FlowReport AdvectToCells(ParticleSource<Dimension>& source, std::int64_t* cells)
  {
    this->Work.Expect(source.Count());
    for (std::int64_t chunk = 0; chunk < source.Count();)
    {
      const std::int64_t count = source.Prepare(chunk);
      chunk += count;
      this->Work.For(
        count, this->Grain,
        [&](std::int64_t first, std::int64_t last) {
          // An executor may join ranges.
          for (; first < last; first += this->Grain)
          {
            RangeCells<Dimension> range(
              this->Job, source, first, static_cast<int>(std::min(this->Grain, last - first)));
            this->RunPassesAfter(this->First - 1, range.LocalJob(), range.All(), SerialExecutor());
            if (!this->Work.ShouldStop())
            {
              this->Count.MovedToMass += range.Write(cells);
            }
          }
        },
        this->Grain);
    }
    return this->Count.Report();
  }

private:
  // Advects particles pass after pass, until the last one or none is left. What is left moves to
  // the nearest mass.
  void RunPassesAfter(int pass, const FlowJob<Dimension>& job,
    WaitingParticles<Dimension>& particles, const Executor& threads)
  {
    std::vector<unsigned char> isUnresolved;
    while (particles.Count() > 0)
    {
      if (pass == 0)
      {
        if (job.Backward || job.Nearest)
        {
          return; // these are not redone: they stay where they are
        }
        this->Count.Redone += particles.Count();
      }
      if (pass == this->Shared.LastPass())
      {
        break;
      }
      ++pass;
      isUnresolved.assign(particles.Index.size(), 0);
      threads.For(particles.Count(), BlockSize, [&](std::int64_t first, std::int64_t last) {
        for (; first < last && !this->Work.ShouldStop(); first += BlockSize)
        {
          bool marks[BlockSize] = {};
          const auto count = static_cast<int>(std::min<std::int64_t>(BlockSize, last - first));
          this->Count.Evaluations += this->Kernel(job, particles.Seeds.data() + first * Dimension,
            particles.Index.data() + first, count, pass, marks);
          std::copy_n(marks, count, isUnresolved.data() + first);
        }
      });
      particles.Keep(isUnresolved);
    }
    threads.For(particles.Count(), BlockSize, [&](std::int64_t first, std::int64_t last) {
      // Only ends may have to have mass.
      const bool atEnd = !job.Times || job.Times[job.TimeCount - 1] >= 1.0;
      for (std::int64_t i = first; i < last && atEnd && !this->Work.ShouldStop(); ++i)
      {
        const std::int64_t end =
          (particles.Index[static_cast<std::size_t>(i)] + 1) * job.TimeCount - 1;
        moveToMass<Dimension>(job.Tables, job.Output + end * Dimension, this->Count);
      }
    });
  }

  const AdvectionJob<Dimension>& Shared;
  FlowJob<Dimension> Job;
  const AdvectBlock<Dimension> Kernel = flowKernels<Dimension>().Advect;
  std::shared_ptr<const FlowMap<Dimension>> Map;
  std::unique_ptr<DeviceAdvection<Dimension>> OnDevice; // null: the processor does it
  int First = 0;                                        // pass
  Counters Count;
  Progress& Work;
  std::int64_t Grain = BlockSize;
};

} // namespace RectifiedTransport

#endif
