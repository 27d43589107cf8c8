// SPDX-License-Identifier: BSD-3-Clause
// The numbers of steps that were chosen for a flow, kept for later runs.
#ifndef RectifiedTransport_StepChoiceCache_h
#define RectifiedTransport_StepChoiceCache_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/RankExchange.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

namespace RectifiedTransport
{

class StepChoiceCache
{
public:
  // The choice if all ranks have it; else what make() returns, which is kept. Several runs
  // may call it concurrently. Collective.
  template <class Make>
  StepChoice FindOrMake(
    const FlowOptions& options, FlowDirection direction, const Ranks& ranks, const Make& make)
  {
    const double particles = direction == FlowDirection::Forward ? options.Particles : 0.0;
    const Key key(direction, options.Integrator, options.Lookup, options.Maps, options.LeastSteps,
      options.NeedsEstimate, options.AreaTolerance, particles);
    const std::optional<StepChoice> cached = this->Find(key);
    if (onAllRanks(ranks, cached.has_value()))
    {
      return *cached;
    }
    // Not locked: other runs make the same choice meanwhile.
    const StepChoice made = make();
    this->Insert(key, made);
    return made;
  }

private:
  using Key =
    std::tuple<FlowDirection, Integrator, TableLookup, FlowMaps, int, bool, double, double>;

  std::optional<StepChoice> Find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Choices.find(key);
    return found == this->Choices.end() ? std::optional<StepChoice>() : found->second;
  }

  void Insert(const Key& key, const StepChoice& choice)
  {
    constexpr std::size_t most = 64; // tolerances or particles that an animation goes through
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Choices.size() == most)
    {
      this->Choices.clear();
    }
    this->Choices[key] = choice;
  }

  std::mutex Mutex;
  std::map<Key, StepChoice> Choices;
};

} // namespace RectifiedTransport

#endif
