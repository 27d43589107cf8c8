// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Ranks.h"

namespace RectifiedTransport
{

const SoloRanks& SoloRanks::Get()
{
  static const SoloRanks solo;
  return solo;
}

} // namespace RectifiedTransport
