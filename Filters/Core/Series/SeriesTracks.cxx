// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/SeriesTracks.h"

#include "Core/Parallel/RankExchange.h"

namespace RectifiedTransport
{

void SeriesTracks::SetSettings(const TrackSettings& settings, int ranks)
{
  if (!(this->Chosen == settings) || this->NumberOfRanks != ranks)
  {
    this->Names.clear();
    this->Checked = 0;
  }
  this->Chosen = settings;
  this->NumberOfRanks = ranks;
}

bool SeriesTracks::Knows(const Name& next, const Ranks& ranks)
{
  const auto number = static_cast<std::size_t>(this->Checked);
  // All ranks must agree, as the moves are collective.
  const bool isKnown = number < this->Names.size() && this->Names[number] == next;
  if (onAllRanks(ranks, isKnown))
  {
    ++this->Checked;
    return true;
  }
  this->Names.resize(number);
  this->Tracked.Keep(this->Checked);
  return false;
}

} // namespace RectifiedTransport
