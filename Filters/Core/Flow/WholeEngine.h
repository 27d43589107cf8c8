// SPDX-License-Identifier: BSD-3-Clause
// A flow on the summed-area tables of the whole grid, with flow maps that are kept.
#ifndef RectifiedTransport_WholeEngine_h
#define RectifiedTransport_WholeEngine_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Devices/FlowOnDevices.h"
#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/FlowMapCache.h"
#include "Core/Flow/Particles/ParticleSource.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/BoxShare.h"
#include "Core/Tables/SummedAreaTables.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class WholeEngine final : public FlowEngine<Dimension>
{
public:
  WholeEngine(const DensitySource<Dimension>& density, Progress& progress, TableMemory memory = {})
    : Size(density.Size)
    , Tables(density, progress, std::move(memory))
  {
    if (const auto flow = this->Devices.On(progress.Device()))
    {
      // A device sums its own tables from the values, which are less to transfer.
      flow->MakeTables(*progress.Device(), density, this->Tables, progress);
    }
  }

  const TableView<Dimension>& View() const override { return this->Tables.View(); }
  const DensitySummary& Summary() const override { return this->Tables.Summary(); }
  std::int64_t MemorySize() override { return this->Tables.MemorySize() + this->Maps.MemorySize(); }
  bool HasWholeTables() const override { return true; }
  TableMemory ReleaseMemory() override { return this->Tables.ReleaseMemory(); }

  FlowReport Advect(AdvectionKind kind, const FlowSeeds<Dimension>& seeds,
    PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) override
  {
    ParticleSource<Dimension> source(seeds, this->Size, positions.size());
    return this->Run(kind, source, 1.0, options, context, [&](AdvectionRun<Dimension>& run) {
      const auto flow = this->Devices.On(context.Device);
      if (flow && flow->Serves(kind, options))
      {
        run.UseDevice(*flow);
      }
      return run.Advect(source, positions);
    });
  }

  FlowReport AdvectAt(const FlowSeeds<Dimension>& seeds, const std::vector<double>& times,
    PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) override
  {
    const auto each = static_cast<std::int64_t>(times.size());
    // There are `each` positions for a seed.
    ParticleSource<Dimension> source(seeds, this->Size, positions.size() / each);
    return this->Run(AdvectionKind::Forward, source, times.front(), options, context,
      [&](AdvectionRun<Dimension>& run) { return run.Advect(source, positions, times); });
  }

  FlowReport AdvectToCells(const FlowSeeds<Dimension>& seeds, std::int64_t* cells,
    const FlowOptions& options, const Context& context) override
  {
    const auto count = static_cast<std::int64_t>(seeds.Count());
    ParticleSource<Dimension> source(seeds, this->Size, count);
    return this->Run(AdvectionKind::ForwardToCells, source, 1.0, options, context,
      [&](AdvectionRun<Dimension>& run) { return run.AdvectToCells(source, cells); });
  }

  double Share(const Point<Dimension>& low, const Point<Dimension>& high) const override
  {
    // By inclusion and exclusion over the corners of the box.
    return boxShare<Dimension>(this->View(), low, high);
  }
  double MeasureOfShare(
    const Point<Dimension>& centre, const Point<Dimension>& aspect, double share) const override
  {
    return measureOfShare<Dimension>(this->View(), centre, aspect, share);
  }
  void MeasuresOfShares(ConstPointSpan<Dimension> centres, const Point<Dimension>& aspect,
    const double* shares, double* measures, const Context& context) override
  {
    // Boxes a chunk.
    constexpr std::int64_t grain = 256;
    Progress progress(context);
    progress.ForEach(
      centres.size(), grain,
      [&](std::int64_t i) {
        Point<Dimension> centre;
        std::copy_n(centres[i], Dimension, centre.begin());
        measures[i] = measureOfShare<Dimension>(this->View(), centre, aspect, shares[i]);
      },
      16 * grain);
  }

private:
  // advect(run) for particles whose positions are wanted from `firstTime` on, with the flow map
  // that the options ask for, if any.
  template <class Function>
  FlowReport Run(AdvectionKind kind, const ParticleSource<Dimension>& source, double firstTime,
    const FlowOptions& options, const Context& context, const Function& advect)
  {
    const AdvectionJob<Dimension> shared(this->View(), kind, options);
    const double particles = source.CountOfAll(*context.Group);
    const std::optional<FlowMapShape<Dimension>> shape =
      this->MapFor(shared, options, particles, firstTime);
    Progress progress(context);
    Stages stages(progress,
      { { "map", shape ? shape->Cost : 0.0 },
        { "particles", shape ? particles * shape->Levels.back().HandOver : 1.0 } });
    // A map is kept for runs with the same shape; `isNew` says whether its evaluations are part of
    // this run.
    std::shared_ptr<const FlowMap<Dimension>> map;
    bool isNew = false;
    if (shape)
    {
      map = this->Maps.FindOrMake(*shape, shared.Refinement, *context.Group, [&]() {
        isNew = true;
        const auto flow = this->Devices.On(context.Device);
        const auto nodes =
          flow ? flow->BeginNodes(*context.Device, shared) : DeviceNodes<Dimension>();
        return std::make_shared<const FlowMap<Dimension>>(*shape, shared.Job, stages["map"], nodes);
      });
    }
    AdvectionRun<Dimension> run(shared, stages["particles"]);
    if (map)
    {
      run.UseMap(std::move(map), isNew);
    }
    return advect(run);
  }

  // The flow map that a run of so many particles is to have, if any.
  std::optional<FlowMapShape<Dimension>> MapFor(const AdvectionJob<Dimension>& shared,
    const FlowOptions& options, double particles, double firstTime) const
  {
    if (!takesFlowMaps(options) || options.Maps == FlowMaps::Off || particles == 0.0)
    {
      return std::nullopt;
    }
    const FlowMapShape<Dimension> shape(this->Size, options.NumberOfSteps, directionOf(shared.Kind),
      shared.Refinement, 1, options.MapSteps);
    // Isolated cells leave most boxes empty before particles could take over.
    const bool pays = shared.Kind != AdvectionKind::ForwardToCells && shape.PaysFor(particles);
    if (shape.Levels.empty() || firstTime < 1.0 - shape.Levels.back().TimeLeft ||
      (options.Maps == FlowMaps::Auto && !pays))
    {
      return std::nullopt;
    }
    return shape;
  }

  const GridSize<Dimension> Size;
  SummedAreaTables<Dimension> Tables;
  FlowMapCache<Dimension> Maps;
  FlowOnDevices<Dimension> Devices;
};

} // namespace RectifiedTransport

#endif
