// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityPlan.h"

#include "Bridge/Run/FieldValue.h"

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

} // namespace RectifiedTransport::Bridge
