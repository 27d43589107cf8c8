// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityPlan.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport::Bridge
{

void addCostBound(vtkDataObject* output, double bound, double cost, const ImageGrid& grid)
{
  constexpr double rounding = 1e-12; // of the squared diagonal
  double gap = std::max(0.0, cost / bound - 1.0);
  if (!(bound > rounding * grid.Diagonal() * grid.Diagonal()))
  {
    constexpr double nothing = 0.1; // cells
    const double cell = std::pow(grid.CellMeasure(), 1.0 / grid.Dimension());
    const bool isNothing = std::sqrt(cost) <= nothing * cell;
    gap = isNothing ? 0.0 : std::numeric_limits<double>::infinity();
  }
  addFieldValue(output, "TransportCostLowerBound", bound);
  addFieldValue(output, "OptimalityGap", gap);
}

template <int D>
void addBound(const TransportPlan<D>& plan, const ImageGrid& box, double cost,
  const ImageGrid& grid, vtkDataObject* output)
{
  if (plan.HasMap())
  {
    addCostBound(output, LengthScale(box).CostFromUnits(plan.LowerBound()), cost, grid);
  }
}

template <int D>
vtkSmartPointer<vtkDoubleArray> slackOf(const TransportPlan<D>& plan, const ImageGrid& box,
  ConstPointSpan<D> points, ConstPointSpan<D> images, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const std::int64_t count = points.size();
  const LengthScale scale(box);
  auto array = newArray<vtkDoubleArray>("Slack", 1, count);
  double* slack = array->GetPointer(0);
  Stages stages(progress, { { "slack", 9 }, { "units", 1 } });
  plan.Slack(points, images, slack, stages["slack"]);
  stages["units"].For(count, grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      slack[i] = scale.SquareFromUnits(slack[i]);
    }
  });
  return array;
}

template void addBound<1>(
  const TransportPlan<1>&, const ImageGrid&, double, const ImageGrid&, vtkDataObject*);
template vtkSmartPointer<vtkDoubleArray> slackOf<1>(
  const TransportPlan<1>&, const ImageGrid&, ConstPointSpan<1>, ConstPointSpan<1>, Progress&);
template void addBound<2>(
  const TransportPlan<2>&, const ImageGrid&, double, const ImageGrid&, vtkDataObject*);
template vtkSmartPointer<vtkDoubleArray> slackOf<2>(
  const TransportPlan<2>&, const ImageGrid&, ConstPointSpan<2>, ConstPointSpan<2>, Progress&);
template void addBound<3>(
  const TransportPlan<3>&, const ImageGrid&, double, const ImageGrid&, vtkDataObject*);
template vtkSmartPointer<vtkDoubleArray> slackOf<3>(
  const TransportPlan<3>&, const ImageGrid&, ConstPointSpan<3>, ConstPointSpan<3>, Progress&);

} // namespace RectifiedTransport::Bridge
