// SPDX-License-Identifier: BSD-3-Clause
// The plan between the densities of two steps.
#ifndef RectifiedTransport_IntervalPlan_h
#define RectifiedTransport_IntervalPlan_h

#include "Core/Plan/TransportPlan.h"
#include "Core/Tables/Density.h"

#include <optional>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct StepDensity;

template <int D>
class IntervalPlan
{
public:
  // Both densities have mass, and outlive the plan. Forward moves at most `samples` together,
  // counted on all ranks. Collective. Throws Failure and Cancelled.
  IntervalPlan(const StepDensity& from, const StepDensity& to, bool isOptimal, double samples,
    Progress& progress);

  const TransportPlan<D>& Points() const { return *this->Plan; }
  // Bounds the mean squared distance, physical; 0 with flows alone.
  double LowerBound() const { return this->Bound; }

private:
  const DensityArray<D, double> From;
  const DensityArray<D, double> To;
  std::optional<TransportPlan<D>> Plan;
  double Bound = 0.0;
};

} // namespace RectifiedTransport::Bridge

#endif
