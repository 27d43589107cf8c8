// SPDX-License-Identifier: BSD-3-Clause
#include "Kinds.h"

namespace Campaign
{

const std::vector<FilterKind>& filterKinds()
{
  static const std::vector<FilterKind> kinds = []() {
    std::vector<FilterKind> all;
    addTransportKinds(all);
    addBlendKinds(all);
    addOtherKinds(all);
    addSurfaceKinds(all);
    addMapKinds(all);
    all.push_back(distanceKind());
    all.push_back(temporalKind());
    return all;
  }();
  return kinds;
}

} // namespace Campaign
