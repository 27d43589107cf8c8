// SPDX-License-Identifier: BSD-3-Clause
#include "RectifiedFlow.h"

#include "BoxShare.h"
#include "FlowKernels.h"
#include "LatticeOrder.h"
#include "NearestMass.h"
#include "Pacer.h"
#include "ParticleOrder.h"
#include "SummedAreaTables.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr int maximumSteps = 10000;
constexpr int refinements = 5; // 2N, 4N ... 32N
constexpr int rangeBlocks = 16;
constexpr int particlesPerTile = 8;
constexpr std::int64_t chunkParticles = std::int64_t{ 1 } << 20;

void check(const FlowOptions& options)
{
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

void check(const std::vector<double>& times)
{
  if (times.empty())
  {
    throw std::invalid_argument("no times are given, there must be at least one");
  }
  double before = 0.0;
  for (const double time : times)
  {
    if (!(time >= before && time <= 1.0))
    {
      throw std::invalid_argument("time " + std::to_string(time) + " is given after " +
        std::to_string(before) + ", times must ascend and be from 0 to 1");
    }
    before = time;
  }
}

template <int Dimension>
void check(const GridSize<Dimension>& size, const char* what)
{
  for (const std::int64_t cells : size)
  {
    if (cells < 1 || cells > std::int64_t{ 1 } << 30)
    {
      throw std::invalid_argument(std::string(what) + " has " + std::to_string(cells) +
        " cells along an axis, it must have from 1 to 2^30");
    }
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

// Points of an array in the order of a sort, as LatticeOrder gives those of a lattice.
template <int Dimension>
struct SortedPoints
{
  const double* Points;
  const std::int64_t* Order;

  void Fill(std::int64_t first, int count, std::int64_t* index, double* points) const
  {
    for (int i = 0; i < count; ++i)
    {
      index[i] = this->Order[first + i];
      std::copy_n(this->Points + index[i] * Dimension, Dimension, points + i * Dimension);
    }
  }
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

} // namespace

template <int Dimension>
struct RectifiedFlow<Dimension>::Internals
{
  Internals(const DensitySource<Dimension>& density, const Executor& executor, Pacer& pacer,
    TableMemory memory = {})
    : Size(density.Size())
    , Tables(density, executor, pacer, std::move(memory))
  {
  }

  FlowReport Advect(const double* points, std::int64_t count, const std::vector<double>& times,
    double* positions, bool backward, const FlowOptions& options, const Executor& executor,
    const Monitor& monitor) const;
  FlowReport AdvectLattice(const GridSize<Dimension>& lattice, double* positions, bool backward,
    const FlowOptions& options, const Executor& executor, const Monitor& monitor) const;

  GridSize<Dimension> Size;
  SummedAreaTables<Dimension> Tables;
};

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Internals::Advect(const double* points, std::int64_t count,
  const std::vector<double>& times, double* positions, bool backward, const FlowOptions& options,
  const Executor& executor, const Monitor& monitor) const
{
  AdvectionRun<Dimension> run(
    this->Tables.View(), times, positions, backward, options, count, monitor);
  ParticleOrder<Dimension> order;
  for (std::int64_t chunk = 0; chunk < count; chunk += chunkParticles)
  {
    const std::int64_t length = std::min(chunkParticles, count - chunk);
    const std::int64_t wrong = order.Sort(points, chunk, length, particlesPerTile);
    if (wrong >= 0)
    {
      throw std::invalid_argument("point " + std::to_string(wrong) + " is not finite");
    }
    if (!run.Advect(SortedPoints<Dimension>{ points, order.Order() }, length, executor))
    {
      break;
    }
  }
  return run.Report();
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Internals::AdvectLattice(const GridSize<Dimension>& lattice,
  double* positions, bool backward, const FlowOptions& options, const Executor& executor,
  const Monitor& monitor) const
{
  check<Dimension>(lattice, "a lattice");
  const LatticeOrder<Dimension> order(lattice, this->Size);
  AdvectionRun<Dimension> run(
    this->Tables.View(), {}, positions, backward, options, order.Count(), monitor);
  run.Advect(order, order.Count(), executor);
  return run.Report();
}

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(
  const DensitySource<Dimension>& density, const Executor& executor, const Monitor& monitor)
{
  check<Dimension>(density.Size(), "a density");
  Pacer pacer(monitor);
  this->Data = std::make_unique<Internals>(density, executor, pacer);
}

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(const DensitySource<Dimension>& density,
  RectifiedFlow&& previous, const Executor& executor, const Monitor& monitor)
{
  check<Dimension>(density.Size(), "a density");
  Pacer pacer(monitor);
  TableMemory memory;
  if (previous.Data)
  {
    memory = previous.Data->Tables.ReleaseMemory();
    previous.Data.reset();
  }
  this->Data = std::make_unique<Internals>(density, executor, pacer, std::move(memory));
}

template <int Dimension>
RectifiedFlow<Dimension>::~RectifiedFlow() = default;

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(RectifiedFlow&&) noexcept = default;

template <int Dimension>
RectifiedFlow<Dimension>& RectifiedFlow<Dimension>::operator=(RectifiedFlow&&) noexcept = default;

template <int Dimension>
RectifiedFlow<Dimension>::operator bool() const
{
  return this->Data && this->Data->Tables.IsComplete();
}

template <int Dimension>
const GridSize<Dimension>& RectifiedFlow<Dimension>::Size() const
{
  return this->Data->Size;
}

template <int Dimension>
double RectifiedFlow<Dimension>::Total() const
{
  return this->Data->Tables.Summary().Total;
}

template <int Dimension>
Point<Dimension> RectifiedFlow<Dimension>::Centroid() const
{
  Point<Dimension> centroid;
  std::copy_n(this->Data->Tables.View().Centroid, Dimension, centroid.begin());
  return centroid;
}

template <int Dimension>
std::int64_t RectifiedFlow<Dimension>::MemorySize() const
{
  return this->Data->Tables.MemorySize();
}

template <int Dimension>
bool RectifiedFlow<Dimension>::HasMass(const Point<Dimension>& point) const
{
  return hasMass<Dimension>(this->Data->Tables.View(), point);
}

template <int Dimension>
double RectifiedFlow<Dimension>::Share(
  const Point<Dimension>& low, const Point<Dimension>& high) const
{
  return boxShare<Dimension>(this->Data->Tables.View(), low, high);
}

template <int Dimension>
double RectifiedFlow<Dimension>::MeasureOfShare(
  const Point<Dimension>& centre, const Point<Dimension>& aspect, double share) const
{
  return measureOfShare<Dimension>(this->Data->Tables.View(), centre, aspect, share);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Forward(const double* seeds, std::int64_t count,
  double* positions, const FlowOptions& options, const Executor& executor,
  const Monitor& monitor) const
{
  return this->Data->Advect(seeds, count, {}, positions, false, options, executor, monitor);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardAt(const double* seeds, std::int64_t count,
  const std::vector<double>& times, double* positions, const FlowOptions& options,
  const Executor& executor, const Monitor& monitor) const
{
  check(times);
  return this->Data->Advect(seeds, count, times, positions, false, options, executor, monitor);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Backward(const double* points, std::int64_t count,
  double* positions, const FlowOptions& options, const Executor& executor,
  const Monitor& monitor) const
{
  return this->Data->Advect(points, count, {}, positions, true, options, executor, monitor);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardLattice(const GridSize<Dimension>& lattice,
  double* positions, const FlowOptions& options, const Executor& executor,
  const Monitor& monitor) const
{
  return this->Data->AdvectLattice(lattice, positions, false, options, executor, monitor);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::BackwardLattice(const GridSize<Dimension>& lattice,
  double* positions, const FlowOptions& options, const Executor& executor,
  const Monitor& monitor) const
{
  return this->Data->AdvectLattice(lattice, positions, true, options, executor, monitor);
}

template <int Dimension>
std::vector<Point<Dimension>> transportPoints(const DensitySource<Dimension>& density,
  const std::vector<Point<Dimension>>& seeds, const FlowOptions& options)
{
  const RectifiedFlow<Dimension> flow(density);
  std::vector<Point<Dimension>> positions(seeds.size());
  if (!seeds.empty())
  {
    flow.Forward(
      seeds[0].data(), static_cast<std::int64_t>(seeds.size()), positions[0].data(), options);
  }
  return positions;
}

template class RectifiedFlow<1>;
template class RectifiedFlow<2>;
template class RectifiedFlow<3>;
template std::vector<Point<1>> transportPoints<1>(
  const DensitySource<1>&, const std::vector<Point<1>>&, const FlowOptions&);
template std::vector<Point<2>> transportPoints<2>(
  const DensitySource<2>&, const std::vector<Point<2>>&, const FlowOptions&);
template std::vector<Point<3>> transportPoints<3>(
  const DensitySource<3>&, const std::vector<Point<3>>&, const FlowOptions&);

} // namespace RectifiedTransport
