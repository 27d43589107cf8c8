// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/FlowCache.h"

#include "Bridge/Image/GridText.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Tables/TableView.h"

#include <cmath>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// What the tables take: a record a node of each level, which has a fixed share of the nodes of the
// level before.
template <int D>
double tableBytes(const GridSize<D>& size)
{
  double nodes = 1.0;
  for (const std::int64_t cells : size)
  {
    nodes *= static_cast<double>(cells + 1);
  }
  constexpr double levels = 1.0 / (1.0 - 1.0 / (1 << (D * levelShift)));
  return nodes * levels * TableView<D>::Record * sizeof(double);
}

template <int D>
std::string describeTables(const GridSize<D>& size)
{
  return "the tables of a density of " + describeSize<D>(size) + " cells";
}

} // namespace

bool FlowCache::IsOutdated(const DensityImage& density) const
{
  return !this->HasFlow() || !this->Stamp.IsOf(density);
}

void FlowCache::Update(
  DensityImage& density, const Executor& executor, AlgorithmProgress& host, double progress)
{
  if (!this->IsOutdated(density))
  {
    return;
  }
  constexpr double partOfFingerprint = 0.05;
  constexpr double partOfPreparation = 0.1;
  host.BeginStage(host.Reached() + partOfFingerprint * (progress - host.Reached()));
  ContentHash stamp = this->Stamp;
  const bool isSame = stamp.Renew(density, executor, host);
  if (isSame && this->HasFlow())
  {
    this->Stamp = stamp;
    return;
  }
  this->Stamp = ContentHash(); // until the tables are whole
  host.BeginStage(host.Reached() + partOfPreparation * (progress - host.Reached()));
  density.Prepare(executor, host);
  host.BeginStage(progress);
  switch (density.Geometry().Dimension())
  {
    case 1:
      this->Build<1>(density, executor, host);
      break;
    case 2:
      this->Build<2>(density, executor, host);
      break;
    default:
      this->Build<3>(density, executor, host);
  }
  this->Stamp = stamp;
  this->Built.Modified();
}

// Old and new tables side by side would double the peak.
template <int D>
RectifiedFlow<D> FlowCache::BuildFlow(
  DensityImage& density, const Executor& executor, const Monitor& monitor)
{
  const DensityImageSource<D> source(density);
  auto kept = std::exchange(this->Kept, std::monostate());
  if (auto* previous = std::get_if<RectifiedFlow<D>>(&kept))
  {
    return RectifiedFlow<D>(source, std::move(*previous), executor, monitor);
  }
  kept = std::monostate();
  return RectifiedFlow<D>(source, executor, monitor);
}

template <int D>
void FlowCache::Build(DensityImage& density, const Executor& executor, AlgorithmProgress& host)
{
  const GridSize<D> size = density.Geometry().Size<D>();
  withMemory(describeTables<D>(size), tableBytes<D>(size), [&]() {
    const Monitor monitor = host.GetMonitor();
    try
    {
      RectifiedFlow<D> flow = this->BuildFlow<D>(density, executor, monitor);
      if (!flow)
      {
        throw Aborted();
      }
      DensitySummary found;
      found.Total = flow.Total() * density.Geometry().CellMeasure();
      if (!(found.Total > 0.0) || std::isinf(found.Total))
      {
        density.Explain(found);
      }
      this->Mass = found.Total;
      this->Kept = std::move(flow);
    }
    catch (const InvalidDensity& invalid)
    {
      density.Explain(invalid.Summary());
    }
  });
}

} // namespace RectifiedTransport
