// SPDX-License-Identifier: BSD-3-Clause
// What a RectifiedFlow runs on: the tables of its density, and the advection of particles in them.
#ifndef RectifiedTransport_FlowEngine_h
#define RectifiedTransport_FlowEngine_h

#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/FlowSeeds.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/SummedAreaTables.h"
#include "Core/Tables/TableView.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Arguments are those of RectifiedFlow. An engine supports what it overrides; otherwise it throws
// std::invalid_argument. Advections may run concurrently.
template <int Dimension>
class FlowEngine
{
public:
  FlowEngine() = default;
  virtual ~FlowEngine() = default;
  FlowEngine(const FlowEngine&) = delete;
  FlowEngine& operator=(const FlowEngine&) = delete;

  // The view of the whole grid; without levels if there are none.
  virtual const TableView<Dimension>& View() const = 0;
  virtual const DensitySummary& Summary() const = 0;
  virtual std::int64_t MemorySize() = 0;
  // Whether there are levels of the whole grid. Paths, runs to cells and MeasureOfShare need them.
  virtual bool HasWholeTables() const = 0;
  // For reuse by tables of the same size; the engine must not be used afterwards.
  virtual TableMemory ReleaseMemory() { return {}; }

  // Forward or Backward.
  virtual FlowReport Advect(AdvectionKind kind, const FlowSeeds<Dimension>& seeds,
    PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) = 0;
  virtual FlowReport AdvectAt(const FlowSeeds<Dimension>& /*seeds*/,
    const std::vector<double>& /*times*/, PointSpan<Dimension> /*positions*/,
    const FlowOptions& /*options*/, const Context& /*context*/)
  {
    throwNeedsWhole("a path");
  }
  virtual FlowReport AdvectToCells(const FlowSeeds<Dimension>& /*seeds*/, std::int64_t* /*cells*/,
    const FlowOptions& /*options*/, const Context& /*context*/)
  {
    throwNeedsWhole("a run to cells");
  }

  virtual double Share(const Point<Dimension>& low, const Point<Dimension>& high) const = 0;
  virtual double MeasureOfShare(
    const Point<Dimension>& /*centre*/, const Point<Dimension>& /*aspect*/, double /*share*/) const
  {
    throwNeedsWhole("MeasureOfShare");
  }
  virtual void MeasuresOfShares(ConstPointSpan<Dimension> centres, const Point<Dimension>& aspect,
    const double* shares, double* measures, const Context& context) = 0;

  // For engines that read the density again.
  virtual void SetDensity(const DensitySource<Dimension>& /*density*/) {}
  virtual void PrepareShares(
    const GridSize<Dimension>& /*low*/, const GridSize<Dimension>& /*high*/)
  {
  }

private:
  [[noreturn]] static void throwNeedsWhole(const char* what)
  {
    throw std::invalid_argument(std::string(what) + " needs whole tables, the flow has tiles");
  }
};

} // namespace RectifiedTransport

#endif
