// SPDX-License-Identifier: BSD-3-Clause
// The cost of the optimal transport from a density to equal masses at points, as a function of
// their places.
#ifndef RectifiedTransport_TransportEnergy_h
#define RectifiedTransport_TransportEnergy_h

#include "Core/PowerCells/EqualMassPartition.h"
#include "Core/Relaxation/RelaxationEnergy.h"

namespace RectifiedTransport
{

// Half the cost: its gradient is the way from the centroids of the cells to the points, of which a
// whole step is that of de Goes et al. 2012 (Section 4.2).
class TransportEnergy final : public RelaxationEnergy<2>
{
public:
  explicit TransportEnergy(EqualMassPartition& partition)
    : Partition(partition)
  {
  }

  // All spacings are 1, the unit. Infinite where the masses cannot be made equal.
  double Evaluate(
    ConstPointSpan<2> points, PointSpan<2> gradient, double* spacings, Progress& progress) override;
  // Points stay where the density has mass: others go to the nearest place, which lowers the cost
  // most.
  void Constrain(PointSpan<2> points, Progress& progress) const override;

private:
  EqualMassPartition& Partition;
};

} // namespace RectifiedTransport

#endif
