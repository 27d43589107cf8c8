// SPDX-License-Identifier: BSD-3-Clause
// The field data of a certified bound, and what is said of an optimal map that misses its density.
#ifndef RectifiedTransport_CostBound_h
#define RectifiedTransport_CostBound_h

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/PartText.h"
#include "Core/Geometry/ImageGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace RectifiedTransport::Bridge
{

// TransportCostLowerBound, and OptimalityGap of a map of this cost on a grid. Where the bound is no
// more than the rounding that it allows for (see PotentialSolver), their ratio says nothing: the
// gap is 0 for ways of less than a tenth of a cell, which are errors of integration, else infinite.
inline void addCostBound(vtkDataObject* output, double bound, double cost, const ImageGrid& grid)
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

// Why an optimal map does not serve whose masses of blocks have this error; empty if it does.
inline std::string unresolvedText(double massError)
{
  constexpr double most = 0.1;
  if (!(massError > most))
  {
    return {};
  }
  return "Method Optimal did not reach the density, which is too thin for its grid: the masses of "
         "blocks of 8 cells a side are off by " +
    percentText(massError) + ", more than " + percentText(most) +
    "; the map is that of Method RectifiedFlow, and TransportCostLowerBound holds (a finer density "
    "helps, for example by Resample To Image)";
}

} // namespace RectifiedTransport::Bridge

#endif
