// SPDX-License-Identifier: BSD-3-Clause
// The gap between the cost of a map and its certified bound, also where the bound is rounding.
#include "Checks.h"

#include "Bridge/Plan/DensityPlan.h"

#include "vtkDataArray.h"
#include "vtkPolyData.h"

namespace
{

double gapOf(double bound, double cost)
{
  const RectifiedTransport::ImageGrid grid({ 0, 256, 0, 256, 0, 0 }, { 0, 0, 0 }, { 0.5, 0.5, 1 },
    RectifiedTransport::ImageGrid::Matrix::Identity(), false);
  vtkNew<vtkPolyData> output;
  RectifiedTransport::Bridge::addCostBound(output, bound, cost, grid);
  return output->GetFieldData()->GetArray("OptimalityGap")->GetComponent(0, 0);
}

void checkGaps(Checks& checks)
{
  CHECK_NEAR(checks, gapOf(4.0, 5.0), 0.25, 1e-15);
  CHECK(checks, gapOf(4.0, 3.9) == 0.0);
  // Short ways with a bound.
  CHECK_NEAR(checks, gapOf(1e-4, 1.5e-4), 0.5, 1e-12);
  for (const double bound : { 0.0, 1e-300, 1e-20, 1e-9 })
  {
    CHECK(checks, gapOf(bound, 0.0) == 0.0);
    CHECK(checks, gapOf(bound, 1e-8) == 0.0);
    CHECK(checks, gapOf(bound, 0.0024) == 0.0); // a cell is 0.5 wide
    CHECK(checks, gapOf(bound, 0.0026) == std::numeric_limits<double>::infinity());
  }
}

} // namespace

int TestCostBound(int, char*[])
{
  return runChecks({ checkGaps });
}
