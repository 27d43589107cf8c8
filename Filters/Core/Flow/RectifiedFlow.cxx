// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/RectifiedFlow.h"

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/LatticeOrder.h"
#include "Core/Flow/ParticleOrder.h"
#include "Core/Parallel/Pacer.h"
#include "Core/Tables/BoxShare.h"
#include "Core/Tables/NearestMass.h"
#include "Core/Tables/SummedAreaTables.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr int particlesPerTile = 8;
constexpr std::int64_t chunkParticles = std::int64_t{ 1 } << 20;

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
  FlowReport AdvectLattice(const GridSize<Dimension>& lattice, const Point<Dimension>& place,
    double* positions, bool backward, const FlowOptions& options, const Executor& executor,
    const Monitor& monitor) const;

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
  const Point<Dimension>& place, double* positions, bool backward, const FlowOptions& options,
  const Executor& executor, const Monitor& monitor) const
{
  check<Dimension>(lattice, "a lattice");
  for (const double coordinate : place)
  {
    if (!(coordinate >= 0.0 && coordinate <= 1.0))
    {
      throw std::invalid_argument("a place in a lattice's cells has the coordinate " +
        std::to_string(coordinate) + ", it must be from 0 to 1");
    }
  }
  const LatticeOrder<Dimension> order(lattice, this->Size, place);
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
  double* positions, const FlowOptions& options, const Executor& executor, const Monitor& monitor,
  const Point<Dimension>& place) const
{
  return this->Data->AdvectLattice(lattice, place, positions, false, options, executor, monitor);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::BackwardLattice(const GridSize<Dimension>& lattice,
  double* positions, const FlowOptions& options, const Executor& executor,
  const Monitor& monitor) const
{
  return this->Data->AdvectLattice(
    lattice, cellCentre<Dimension>(), positions, true, options, executor, monitor);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardLatticeToCells(const GridSize<Dimension>& lattice,
  std::int64_t* cells, const FlowOptions& options, const Executor& executor,
  const Monitor& monitor) const
{
  check<Dimension>(lattice, "a lattice");
  const LatticeOrder<Dimension> order(lattice, this->Data->Size);
  AdvectionRun<Dimension> run(
    this->Data->Tables.View(), {}, nullptr, false, options, order.Count(), monitor, true);
  run.AdvectToCells(order, cells, executor);
  return run.Report();
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
