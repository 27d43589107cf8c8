// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/FlowCache.h"

#include "Bridge/Image/GridText.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"
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

void FlowCache::Update(DensityImage& density, Progress& progress, double end)
{
  if (!this->IsOutdated(density))
  {
    return;
  }
  constexpr double partOfFingerprint = 0.05;
  constexpr double partOfPreparation = 0.1;
  progress.BeginStage(progress.StageEnd() + partOfFingerprint * (end - progress.StageEnd()));
  ContentHash stamp = this->Stamp;
  const bool isSame = stamp.Renew(density, progress);
  if (isSame && this->HasFlow())
  {
    this->Stamp = stamp;
    return;
  }
  this->Stamp = ContentHash(); // until the tables are whole
  progress.BeginStage(progress.StageEnd() + partOfPreparation * (end - progress.StageEnd()));
  density.Prepare(progress);
  progress.BeginStage(end);
  switch (density.Geometry().Dimension())
  {
    case 1:
      this->Build<1>(density, progress);
      break;
    case 2:
      this->Build<2>(density, progress);
      break;
    default:
      this->Build<3>(density, progress);
  }
  this->Stamp = stamp;
  this->Built.Modified();
}

// Old and new tables side by side would double the peak.
template <int D>
RectifiedFlow<D> FlowCache::BuildFlow(DensityImage& density, const Context& context)
{
  const DensitySource<D> source{ density.Geometry().Size<D>(), density };
  auto kept = std::exchange(this->Kept, std::monostate());
  if (auto* previous = std::get_if<RectifiedFlow<D>>(&kept))
  {
    return RectifiedFlow<D>(source, std::move(*previous), context);
  }
  kept = std::monostate();
  return RectifiedFlow<D>(source, context);
}

template <int D>
void FlowCache::Build(DensityImage& density, Progress& progress)
{
  const GridSize<D> size = density.Geometry().Size<D>();
  withMemory(describeTables<D>(size), tableBytes<D>(size), [&]() {
    const Context context = progress.Stage();
    try
    {
      RectifiedFlow<D> flow = this->BuildFlow<D>(density, context);
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
