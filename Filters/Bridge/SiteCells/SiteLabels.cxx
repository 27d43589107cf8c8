// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteLabels.h"

#include "Bridge/Density/InputDensity.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

namespace RectifiedTransport::Bridge
{

DataIdentity identityOfDivision(
  vtkPointSet* sites, const ImageGrid& grid, const FlowOptions* flow, const InputDensity* density)
{
  DataIdentity identity;
  // Programs that write into an array often call Modified() only on the data set, whose GetMTime()
  // includes its points.
  identity.AddTimeOf(sites->GetPoints());
  identity.AddTime(static_cast<std::uint64_t>(sites->vtkObject::GetMTime()));
  identity.AddArray(sites->GetPoints()->GetData());
  identity.AddGrid(grid);
  identity.AddNumber(flow ? 1 : 0);
  if (flow)
  {
    identity.AddOptions(*flow);
  }
  if (density)
  {
    identity.Add(density->Identity());
  }
  return identity;
}

} // namespace RectifiedTransport::Bridge
