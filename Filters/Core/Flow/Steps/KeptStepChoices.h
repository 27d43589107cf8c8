// SPDX-License-Identifier: BSD-3-Clause
// The numbers of steps that were chosen for a flow, kept for later runs.
#ifndef RectifiedTransport_KeptStepChoices_h
#define RectifiedTransport_KeptStepChoices_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/RankExchange.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

namespace RectifiedTransport
{

class KeptStepChoices
{
public:
  // The choice if all ranks have kept it; else what make() returns, which is kept. Several runs may
  // call it concurrently. Collective.
  template <class Make>
  StepChoice FindOrMake(
    const FlowOptions& options, FlowDirection direction, const Ranks& ranks, const Make& make)
  {
    const double particles = direction == FlowDirection::Forward ? options.Particles : 0.0;
    const Question question(direction, options.Integrator, options.Lookup, options.Maps,
      options.LeastSteps, options.NeedsEstimate, options.AreaTolerance, particles);
    const std::optional<StepChoice> kept = this->Find(question);
    if (onAllRanks(ranks, kept.has_value()))
    {
      return *kept;
    }
    // Not locked: other runs make the same choice meanwhile.
    const StepChoice made = make();
    this->Keep(question, made);
    return made;
  }

private:
  using Question =
    std::tuple<FlowDirection, Integrator, TableLookup, FlowMaps, int, bool, double, double>;

  std::optional<StepChoice> Find(const Question& question)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Choices.find(question);
    return found == this->Choices.end() ? std::optional<StepChoice>() : found->second;
  }

  void Keep(const Question& question, const StepChoice& choice)
  {
    constexpr std::size_t most = 64; // tolerances or particles that an animation goes through
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Choices.size() == most)
    {
      this->Choices.clear();
    }
    this->Choices[question] = choice;
  }

  std::mutex Mutex;
  std::map<Question, StepChoice> Choices;
};

} // namespace RectifiedTransport

#endif
