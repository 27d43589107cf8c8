// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/PlaceOnMachine.h"

#include <algorithm>
#include <vector>

namespace RectifiedTransport::Bridge
{

int placeOnMachine(const Ranks& ranks, const std::string& machine)
{
  const Bytes own(machine.begin(), machine.end());
  const std::vector<Bytes> all = ranks.Gather(own);
  return static_cast<int>(std::count(all.begin(), all.begin() + ranks.Own(), own));
}

} // namespace RectifiedTransport::Bridge
