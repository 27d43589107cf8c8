// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityTransport.h"

#include "Bridge/Density/CostBound.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkDoubleArray.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

template <int D>
DensityTransport<D>::DensityTransport(const RectifiedFlow<D>& flow, const ImageGrid& grid,
  const OptimalSetting& setting, std::shared_ptr<const OptimalMap<D>> map, Progress& progress)
  : Flow(flow)
  , Scale(grid)
  , Grid(grid)
  , Map(std::move(map))
{
  if (setting.IsOptimal)
  {
    const std::string purpose = std::string("the optimal map (") + setting.Advice() + ")";
    const double bytes = OptimalMap<D>::MemoryFor(flow.Size(), flow.Size());
    this->Found.Warning =
      unresolvedText(withMemory(purpose, bytes, [&]() { return this->Map->MassError(progress); }));
    this->Found.IsOptimal = this->Found.Warning.empty();
    this->Key = this->Found.IsOptimal ? OptimalMapKey(setting, grid) : OptimalMapKey();
  }
}

template <int D>
const PointTransport<D>& DensityTransport<D>::Points() const
{
  if (this->Found.IsOptimal)
  {
    return *this->Map;
  }
  return this->Flow;
}

template <int D>
void DensityTransport<D>::AddBound(double cost, vtkDataObject* output) const
{
  if (!this->Map)
  {
    return;
  }
  addCostBound(output, this->Scale.CostFromUnits(this->Map->LowerBound()), cost, this->Grid);
}

template <int D>
vtkSmartPointer<vtkDoubleArray> DensityTransport<D>::Slack(
  ConstPointSpan<D> seeds, ConstPointSpan<D> images, Progress& progress) const
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const std::int64_t count = seeds.size();
  auto array = newArray<vtkDoubleArray>("Slack", 1, count);
  double* slack = array->GetPointer(0);
  this->Map->Slack(seeds, images, slack, progress);
  progress.For(count, grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      slack[i] = this->Scale.SquareFromUnits(slack[i]);
    }
  });
  return array;
}

template class DensityTransport<1>;
template class DensityTransport<2>;
template class DensityTransport<3>;

} // namespace RectifiedTransport::Bridge
