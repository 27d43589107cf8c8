// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/FlowCache.h"

#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

const SharedFlow& FlowCache::Update(
  InputDensity& density, Progress& progress, FlowTables tables, const OptimalNeeds& needs)
{
  if (this->Kept && this->Kept->Tables() != tables)
  {
    this->Release();
  }
  // Times are local: a rank on which the last run failed may be alone in having to build.
  if (onAllRanks(progress.Group(), !this->IsOutdated(density)))
  {
    this->Kept->Attach(density, progress);
    return *this->Kept;
  }
  Stages stages(progress, { { "hash", 5 }, { "tables", 95 } });
  const ContentHash hash(density, stages["hash"]);
  if (!onAllRanks(progress.Group(), this->Kept && this->Hash == hash))
  {
    this->Hash = ContentHash(); // invalid until the tables are built
    this->ForgetCorrection();
    this->KeptMap.reset();
    const auto findOrBuild = dispatchDimension(density.Grid().Dimension(),
      &SharedFlow::FindOrBuild<1>, &SharedFlow::FindOrBuild<2>, &SharedFlow::FindOrBuild<3>);
    this->Kept = findOrBuild(density, hash, tables, needs, std::move(this->Kept), stages["tables"]);
    this->Time = std::max(this->Time, this->Kept->BuildTime());
  }
  else
  {
    this->Kept->Attach(density, stages["tables"]);
  }
  this->Hash = hash;
  density.TellUnusual(this->Kept->Unusual(), stages["tables"]);
  return *this->Kept;
}

} // namespace RectifiedTransport::Bridge
