// SPDX-License-Identifier: BSD-3-Clause
// The map between the densities of two steps, in both directions.
#ifndef RectifiedTransport_IntervalMap_h
#define RectifiedTransport_IntervalMap_h

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Points.h"
#include "Core/OptimalMap/OptimalMap.h"

#include <memory>
#include <string>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct StepDensity;

// By the optimal map or, where that does not reach the densities or is not wanted, by the flow of
// the first density back to the uniform measure and that of the second one from there.
template <int D>
class IntervalMap
{
public:
  // Both densities have mass, and outlive the map. `samples`: those that Forward moves together, of
  // all ranks. Collective. Throws Failure and Cancelled.
  IntervalMap(const StepDensity& from, const StepDensity& to, bool isOptimal, double samples,
    Progress& progress);

  // Moves points from the index space of one density to that of the other one. Collective.
  // `areSamples`: they are of equal mass and together those of the density, and boxes of cells keep
  // their masses.
  void Forward(PointSpan<D> points, bool areSamples, Progress& progress) const;
  void Backward(PointSpan<D> points, Progress& progress) const;

  bool IsOptimal() const { return this->Map != nullptr; }
  // Of the mean squared distance; 0 with the flow alone.
  double LowerBound() const { return this->Bound; }
  // Why the flow took the place of the optimal map; empty if it did not.
  const std::string& Warning() const { return this->Text; }

private:
  void Solve(double samples, Progress& progress);
  void MakeFlows(Progress& progress);
  void Follow(const RectifiedFlow<D>& back, const RectifiedFlow<D>& on, PointSpan<D> points,
    Progress& progress) const;

  const StepDensity& From;
  const StepDensity& To;
  std::unique_ptr<OptimalMap<D>> Map;
  std::unique_ptr<RectifiedFlow<D>> FromFlow;
  std::unique_ptr<RectifiedFlow<D>> ToFlow;
  double Bound = 0.0;
  std::string Text;
};

} // namespace RectifiedTransport::Bridge

#endif
