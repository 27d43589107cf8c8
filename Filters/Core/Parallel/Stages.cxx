// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

ProgressPart::ProgressPart(Progress& whole)
  : Whole(whole)
{
}

// A part's fractions map linearly to [begin, end] of the whole. It takes threads, ranks and
// cancellation from the whole.
Progress& ProgressPart::Begin(double begin, double end)
{
  Context part = this->Whole;
  part.Report = [report = std::move(part.Report), begin, end](
                  double fraction) { report(begin + (end - begin) * fraction); };
  return this->Part.emplace(std::move(part));
}

Stages::Stages(Progress& whole, std::initializer_list<Stage> stages)
  : ProgressPart(whole)
  , All(stages)
{
}

// A stage begins where the weights of those before it end. Asked for again, it goes on.
Progress& Stages::operator[](const char* name)
{
  const auto found = std::find_if(this->All.begin(), this->All.end(),
    [name](const Stage& stage) { return std::strcmp(stage.Name, name) == 0; });
  if (found == this->All.end())
  {
    throw std::logic_error(std::string("there is no stage ") + name);
  }
  if (this->Begun == &*found)
  {
    return this->Current();
  }
  this->Begun = &*found;
  const auto add = [](double sum, const Stage& stage) { return sum + stage.Weight; };
  const double before = std::accumulate(this->All.begin(), found, 0.0, add);
  // If all weights from here on are 0, nothing of the work is left to divide.
  const double all = std::accumulate(found, this->All.end(), before, add);
  return all > 0.0 ? this->Begin(before / all, (before + found->Weight) / all)
                   : this->Begin(0.0, 1.0);
}

Parts::Parts(Progress& whole, std::int64_t count)
  : ProgressPart(whole)
  , Count(count)
{
}

// Weights become cumulative sums, the ends of the parts.
Parts::Parts(Progress& whole, const std::vector<double>& weights)
  : ProgressPart(whole)
  , Count(static_cast<std::int64_t>(weights.size()))
  , Ends(weights.size())
{
  std::partial_sum(weights.begin(), weights.end(), this->Ends.begin());
}

// Part i covers [end(i - 1), end(i)] of the sum of weights.
Progress& Parts::operator[](std::int64_t i)
{
  const auto endOf = [this](std::int64_t part) {
    return this->Ends.empty() ? static_cast<double>(part + 1)
      : part < 0              ? 0.0
                              : this->Ends[static_cast<std::size_t>(part)];
  };
  const double all = endOf(this->Count - 1);
  return all > 0.0 ? this->Begin(endOf(i - 1) / all, endOf(i) / all) : this->Begin(0.0, 1.0);
}

Rounds::Rounds(Progress& whole, int usual)
  : ProgressPart(whole)
  , Usual(usual)
{
}

// The number of rounds is not known: after n rounds n / (n + Usual) of the work counts as done,
// which rises towards 1 and is 1/2 after the usual number.
Progress& Rounds::Next()
{
  const auto left = [this](int rounds) { return this->Usual / (rounds + this->Usual); };
  ++this->Round;
  return this->Begin(1.0 - left(this->Round - 1), 1.0 - left(this->Round));
}

} // namespace RectifiedTransport
