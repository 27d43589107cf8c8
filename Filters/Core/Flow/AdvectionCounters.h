// SPDX-License-Identifier: BSD-3-Clause
// What an advection counts, and what it does with particles that no step resolves.
#ifndef RectifiedTransport_AdvectionCounters_h
#define RectifiedTransport_AdvectionCounters_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Tables/NearestMass.h"
#include "Core/Tables/TableView.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace RectifiedTransport
{

// Counted over the ranges of one advection. Sums of integers do not depend on their order.
struct Counters
{
  std::atomic<std::int64_t> Redone{ 0 };
  std::atomic<std::int64_t> MovedToMass{ 0 };
  std::atomic<std::int64_t> Evaluations{ 0 };

  void Add(const FlowReport& report)
  {
    this->Redone += report.Redone;
    this->MovedToMass += report.MovedToMass;
    this->Evaluations += report.Evaluations;
  }

  FlowReport Report() const
  {
    FlowReport report;
    report.Redone = this->Redone;
    report.MovedToMass = this->MovedToMass;
    report.Evaluations = this->Evaluations;
    return report;
  }
};

// Moves a particle that ends in an empty cell even with the smallest steps to the nearest mass.
template <int Dimension>
void moveToMass(const TableView<Dimension>& tables, double* position, Counters& counters)
{
  Point<Dimension> point;
  std::copy_n(position, Dimension, point.begin());
  if (!hasMass<Dimension>(tables, point))
  {
    point = nearestMass<Dimension>(tables, point);
    std::copy_n(point.begin(), Dimension, position);
    ++counters.MovedToMass;
  }
}

} // namespace RectifiedTransport

#endif
