// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteLabels.h"

#include "Bridge/Run/Fingerprint.h"

#include "vtkPointSet.h"

#include <utility>

namespace RectifiedTransport
{

namespace
{

std::pair<vtkSmartPointer<vtkPoints>, vtkMTimeType> keyOf(vtkPointSet* sites)
{
  return { sites->GetPoints(), sites->GetPoints()->GetMTime() };
}

// The modification time of the data set itself: its GetMTime() includes its points.
std::uint64_t timeOf(vtkPointSet* sites)
{
  return static_cast<std::uint64_t>(sites->vtkObject::GetMTime());
}

} // namespace

bool SiteLabels::IsFor(vtkPointSet* sites, const Settings& settings) const
{
  return this->Kept.Labels && this->Of == settings && this->Stamp.IsOf(keyOf(sites), timeOf(sites));
}

bool SiteLabels::UpdateStamp(vtkPointSet* sites, Progress& progress)
{
  return this->Stamp.Update(keyOf(sites), timeOf(sites),
    [&]() { return fingerprint({ sites->GetPoints()->GetData() }, progress); });
}

} // namespace RectifiedTransport
