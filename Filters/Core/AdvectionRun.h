// SPDX-License-Identifier: BSD-3-Clause
// One advection of many particles: ranges of blocks for the kernels, those in trouble again with
// smaller steps, the rest onto the nearest mass.
#ifndef RectifiedTransport_AdvectionRun_h
#define RectifiedTransport_AdvectionRun_h

#include "Executor.h"
#include "FlowKernels.h"
#include "FlowOptions.h"
#include "NearestMass.h"
#include "Pacer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

constexpr int refinements = 5; // 2N, 4N ... 32N
constexpr int rangeBlocks = 16;

inline void check(const FlowOptions& options)
{
  constexpr int maximumSteps = 10000;
  if (options.NumberOfSteps < 1 || options.NumberOfSteps > maximumSteps)
  {
    throw std::invalid_argument("NumberOfSteps is " + std::to_string(options.NumberOfSteps) +
      ", it must be from 1 to " + std::to_string(maximumSteps));
  }
  if (!(options.Tolerance > 0.0) || !std::isfinite(options.Tolerance))
  {
    throw std::invalid_argument("Tolerance is " + std::to_string(options.Tolerance) +
      ", it must be a positive number of cells");
  }
}

// The width of the box in cells of a level from which that level is used: coarse levels are faster
// and add an error that a larger number of steps does not remove. In 3D they gain less, as the sums
// on the finest level are simpler.
template <int Dimension>
double coarseRatio(const FlowOptions& options)
{
  constexpr double never = 1e12;
  constexpr double usual = Dimension == 3 ? 32.0 : 16.0;
  const bool adaptive = options.Method == Integrator::Adaptive;
  const bool exact = adaptive ? options.Tolerance < 0.003 : options.NumberOfSteps >= 128;
  const bool accurate = adaptive ? options.Tolerance < 0.03 : options.NumberOfSteps >= 48;
  return exact ? never : accurate ? 64.0 : usual;
}

// What the ranges of one advection count; sums of integers do not depend on their order.
struct Counters
{
  std::atomic<std::int64_t> Redone{ 0 };
  std::atomic<std::int64_t> MovedToMass{ 0 };
  std::atomic<std::int64_t> Evaluations{ 0 };
};

// Advects particles, at most rangeBlocks * BlockSize: all of them once, then those in trouble again
// with ever more steps.
template <int Dimension>
class RangeAdvection
{
public:
  RangeAdvection(const FlowJob<Dimension>& job, Counters& counters, Pacer& pacer)
    : Job(job)
    , Count(counters)
    , Pace(pacer)
    , Advect(flowKernels().Advect<Dimension>())
  {
  }

  template <class Source>
  void Run(const Source& source, std::int64_t first, int count)
  {
    // The output may be the array of the seeds, so these are kept until all is done.
    source.Fill(first, count, this->Index, this->Seeds);
    int left = this->Pass(count, 0);
    if (this->Job.Backward || this->Job.Nearest)
    {
      return;
    }
    this->Count.Redone += left;
    for (int refinement = 1; left > 0 && refinement <= refinements; ++refinement)
    {
      left = this->Pass(left, refinement);
    }
    for (int i = 0; i < left && !this->Pace.ShouldStop(); ++i)
    {
      this->MoveToMass(this->Index[i]);
    }
  }

private:
  // Advects the first `count` particles and moves those in trouble to the front.
  int Pass(int count, int refinement)
  {
    int left = 0;
    for (int first = 0; first < count && !this->Pace.ShouldStop(); first += BlockSize)
    {
      const int lanes = std::min(BlockSize, count - first);
      bool troubled[BlockSize] = {};
      this->Count.Evaluations += this->Advect(this->Job, this->Seeds + first * Dimension,
        this->Index + first, lanes, refinement, troubled);
      for (int i = 0; i < lanes; ++i)
      {
        if (troubled[i])
        {
          this->Index[left] = this->Index[first + i];
          std::copy_n(
            this->Seeds + (first + i) * Dimension, Dimension, this->Seeds + left * Dimension);
          ++left;
        }
      }
    }
    return left;
  }

  void MoveToMass(std::int64_t particle)
  {
    const std::int64_t last = (particle + 1) * this->Job.TimeCount - 1;
    const bool atEnd = !this->Job.Times || this->Job.Times[this->Job.TimeCount - 1] >= 1.0;
    double* position = this->Job.Output + last * Dimension;
    Point<Dimension> point;
    std::copy_n(position, Dimension, point.begin());
    if (atEnd && !hasMass<Dimension>(this->Job.Tables, point))
    {
      point = nearestMass<Dimension>(this->Job.Tables, point);
      std::copy_n(point.begin(), Dimension, position);
      ++this->Count.MovedToMass;
    }
  }

  const FlowJob<Dimension>& Job;
  Counters& Count;
  Pacer& Pace;
  const AdvectBlock<Dimension> Advect;
  std::int64_t Index[rangeBlocks * BlockSize];
  double Seeds[rangeBlocks * BlockSize * Dimension];
};

// One advection of any number of particles, from one source of them after the other.
template <int Dimension>
class AdvectionRun
{
public:
  AdvectionRun(const TableView<Dimension>& tables, const std::vector<double>& times,
    double* positions, bool backward, const FlowOptions& options, std::int64_t count,
    const Monitor& monitor)
    : Pace(monitor)
  {
    check(options);
    this->Job.Tables = tables;
    this->Job.Method = options.Method;
    this->Job.Backward = backward;
    this->Job.Nearest = options.Lookup == TableLookup::Nearest;
    this->Job.Tolerance = options.Tolerance;
    this->Job.Steps = options.NumberOfSteps;
    this->Job.CoarseRatio = coarseRatio<Dimension>(options);
    this->Job.Output = positions;
    this->Job.Times = times.empty() ? nullptr : times.data();
    this->Job.TimeCount = std::max<std::int64_t>(1, static_cast<std::int64_t>(times.size()));
    if (options.Method == Integrator::Multistep)
    {
      this->Weights.reserve(static_cast<std::size_t>(options.NumberOfSteps));
      for (int step = 0; step < options.NumberOfSteps; ++step)
      {
        this->Weights.push_back(multistepWeights(step, options.NumberOfSteps));
      }
    }
    this->Job.Weights = this->Weights.empty() ? nullptr : this->Weights.data();
    this->Job.ShouldStop = [](void* host) { return static_cast<Pacer*>(host)->ShouldStop(); };
    this->Job.Host = &this->Pace;
    this->Pace.BeginStage(1.0, count);
    // A range is short enough to be waited for, however many steps there are.
    constexpr int usualSteps = 64;
    this->Grain = std::max(1,
                    std::min(rangeBlocks,
                      rangeBlocks * usualSteps / std::max(options.NumberOfSteps, usualSteps))) *
      BlockSize;
  }
  AdvectionRun(const AdvectionRun&) = delete;
  AdvectionRun& operator=(const AdvectionRun&) = delete;

  // Advects the first `count` particles of a source. False if the host wants to stop.
  template <class Source>
  bool Advect(const Source& source, std::int64_t count, const Executor& executor)
  {
    for (std::int64_t begin = 0; begin < count;)
    {
      const std::int64_t slice =
        std::min(count - begin, this->Pace.NextSlice(this->Grain * executor.Concurrency()));
      executor.For(slice, this->Grain, [&](std::int64_t first, std::int64_t last) {
        RangeAdvection<Dimension> range(this->Job, this->Count, this->Pace);
        range.Run(source, begin + first, static_cast<int>(last - first));
      });
      begin += slice;
      if (!this->Pace.EndSlice(slice))
      {
        return false;
      }
    }
    return true;
  }

  FlowReport Report() const
  {
    FlowReport report;
    report.Redone = this->Count.Redone;
    report.MovedToMass = this->Count.MovedToMass;
    report.Evaluations = this->Count.Evaluations;
    report.Cancelled = this->Pace.IsCancelled();
    return report;
  }

private:
  FlowJob<Dimension> Job;
  std::vector<StepWeights> Weights;
  Counters Count;
  Pacer Pace;
  std::int64_t Grain = BlockSize;
};

} // namespace RectifiedTransport

#endif
