// SPDX-License-Identifier: BSD-3-Clause
// The parts of a long computation. Each part is a Progress of its own, from 0 to 1, which a callee
// gets; what it reports is a share of the whole.
#ifndef RectifiedTransport_Stages_h
#define RectifiedTransport_Stages_h

#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

// What Stages, Parts and Rounds share: one part at a time. The whole must outlive it.
class ProgressPart
{
protected:
  explicit ProgressPart(Progress& whole);
  ~ProgressPart() = default;

  // Begins a part, and ends the one before; valid until the next one begins.
  Progress& Begin(double begin, double end);
  Progress& Current() { return *this->Part; }

private:
  Progress& Whole;
  std::optional<Progress> Part;
};

// Parts with names and weights, such as estimates of their time. For example:
//
//   Stages stages(progress, { { "tables", 2.0 }, { "map", 80.0 } });
//   makeTables(density, stages["tables"]);
//   solve(density, stages["map"]);
//
// Stages may be left out and repeated; the whole never goes back.
class Stages : private ProgressPart
{
public:
  struct Stage
  {
    const char* Name;
    double Weight; // at least 0
  };
  Stages(Progress& whole, std::initializer_list<Stage> stages);

  // Begins a stage, unless it has just begun. Valid until another one begins. Throws
  // std::logic_error for a name that is not there.
  Progress& operator[](const char* name);

private:
  const std::vector<Stage> All;
  const Stage* Begun = nullptr;
};

// Numbered parts, of equal weights or of given ones.
class Parts : private ProgressPart
{
public:
  Parts(Progress& whole, std::int64_t count);
  Parts(Progress& whole, const std::vector<double>& weights);

  // Begins part i. Valid until another one begins.
  Progress& operator[](std::int64_t i);

private:
  std::int64_t Count;
  std::vector<double> Ends; // empty: all are equal
};

// Parts whose number is not known in advance. The first `usual` ones are half of the whole;
// the others lead towards its end.
class Rounds : private ProgressPart
{
public:
  Rounds(Progress& whole, int usual);

  // Begins the next round. Valid until another one begins.
  Progress& Next();

private:
  const double Usual;
  int Round = 0;
};

} // namespace RectifiedTransport

#endif
