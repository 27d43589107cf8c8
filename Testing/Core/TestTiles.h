// SPDX-License-Identifier: BSD-3-Clause
// Flows with tiles, on one rank and on ranks that are threads.
#ifndef RectifiedTransport_TestTiles_h
#define RectifiedTransport_TestTiles_h

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Tables/DistributedDensity.h"

#include "TestDensities.h"
#include "TestDimensions.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <stdexcept>

namespace RectifiedTransport
{

// Limits that make the tables of small densities as coarse, and their tiles as many, as those of
// large ones.
template <int Dimension>
TileLimits tileLimits(std::int64_t nodesOfPlane, std::int64_t nodesOfVolume, std::int64_t width)
{
  TileLimits limits;
  limits.GradedNodes = Dimension == 3 ? nodesOfVolume : nodesOfPlane;
  limits.Width = width;
  return limits;
}

// Of a density of `manyTilesSize`.
template <int Dimension>
TileLimits manyTiles()
{
  return tileLimits<Dimension>(20000, 250000, 24);
}

template <int Dimension>
GridSize<Dimension> manyTilesSize()
{
  return sizeFor<Dimension>({ 100 }, { 171, 127 }, { 77, 71, 67 });
}

// The values outlive the flow, which reads them in every run.
template <int Dimension>
class TiledRun
{
public:
  TiledRun(const TestDensity<Dimension>& density, const TileLimits& limits,
    const Context& context = Context())
    : Source(density.Source())
    , Flow(Source, FlowTables::Tiled, context, limits)
  {
  }

private:
  const DensityArray<Dimension, double> Source;

public:
  const RectifiedFlow<Dimension> Flow;
};

// Boxes of a density that is in memory once. What lies outside of a box is not read.
template <int Dimension>
class BoxesOfDensity final : public DistributedDensity<Dimension>
{
public:
  BoxesOfDensity(const TestDensity<Dimension>& density, const Ranks& ranks)
    : Size(density.Size)
    , Whole(density.Source())
    , Group(ranks)
  {
  }

  std::shared_ptr<const DensityValues> Gather(
    const GridSize<Dimension>& low, const GridSize<Dimension>& high) const override
  {
    EXPECT_TRUE(onAllRanks(this->Group, true)); // all of them come
    return std::make_shared<Box>(this->Size, this->Whole, low, high);
  }

private:
  class Box final : public DensityValues
  {
  public:
    Box(const GridSize<Dimension>& size, const DensityArray<Dimension, double>& whole,
      const GridSize<Dimension>& low, const GridSize<Dimension>& high)
      : Size(size)
      , Whole(whole)
      , Low(low)
      , High(high)
    {
    }
    void Read(std::int64_t first, std::int64_t count, double* values) const override
    {
      std::int64_t rest = first;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const std::int64_t along = rest % this->Size[axis];
        rest /= this->Size[axis];
        const std::int64_t length = axis == 0 ? count : 1;
        if (along < this->Low[axis] || along + length > this->High[axis])
        {
          throw std::logic_error("cells outside of the box are read");
        }
      }
      this->Whole.Read(first, count, values);
    }

  private:
    const GridSize<Dimension> Size;
    const DensityArray<Dimension, double>& Whole;
    const GridSize<Dimension> Low;
    const GridSize<Dimension> High;
  };

  const GridSize<Dimension> Size;
  const DensityArray<Dimension, double> Whole;
  const Ranks& Group;
};

// A flow on one rank, and what it gives there.
template <int Dimension>
class RankFlow
{
public:
  RankFlow(const TestDensity<Dimension>& density, const Ranks& ranks, const TileLimits& limits)
    : Group(ranks)
    , Density(density, ranks)
    , Flow(DensitySource<Dimension>(density.Size, Density), FlowTables::Tiled, this->RankContext(),
        limits)
  {
  }

  Context RankContext() const
  {
    Context context(this->Serial);
    context.Group = &this->Group;
    return context;
  }

private:
  const SerialExecutor Serial;
  const Ranks& Group;
  const BoxesOfDensity<Dimension> Density;

public:
  const RectifiedFlow<Dimension> Flow;
};

} // namespace RectifiedTransport

#endif
