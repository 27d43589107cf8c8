// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteLabels.h"

#include "Bridge/Run/Fingerprint.h"

#include "vtkPointSet.h"

#include <utility>

namespace RectifiedTransport::Bridge
{

// The modification time of the data set itself: its GetMTime() includes its points.
SiteLabels::Stamp SiteLabels::StampOf(vtkPointSet* sites)
{
  return { sites->GetPoints(), sites->GetPoints()->GetMTime(), sites->vtkObject::GetMTime() };
}

bool SiteLabels::IsFor(vtkPointSet* sites, const Settings& settings) const
{
  const Stamp now = StampOf(sites);
  return this->Kept.Labels && this->Of == settings && now.HasPointsOf(this->Sites) &&
    now.SetTime == this->Sites.SetTime;
}

bool SiteLabels::UpdateStamp(vtkPointSet* sites, Progress& progress)
{
  const Stamp before = std::exchange(this->Sites, {}); // none is kept if fingerprint() throws
  Stamp now = StampOf(sites);
  now.Bits = fingerprint({ sites->GetPoints()->GetData() }, progress);
  this->Sites = now;
  return now.HasPointsOf(before) &&
    (now.SetTime == before.SetTime || (now.Bits != 0 && now.Bits == before.Bits));
}

} // namespace RectifiedTransport::Bridge
