// SPDX-License-Identifier: BSD-3-Clause
// The cost of the optimal transport from a density to equal masses at points, as a function of
// their positions.
#ifndef RectifiedTransport_TransportEnergy_h
#define RectifiedTransport_TransportEnergy_h

#include "Core/PowerCells/EqualMassPartition.h"
#include "Core/Relaxation/RelaxationEnergy.h"

namespace RectifiedTransport
{

// Half the cost. Its gradient is the displacement from the centroids of the cells to the points; a
// whole step is that of de Goes et al. 2012 (Section 4.2).
class TransportEnergy final : public RelaxationEnergy<2>
{
public:
  explicit TransportEnergy(EqualMassPartition& partition)
    : Partition(partition)
  {
  }

  // All spacings are 1, the unit. Returns infinity if the masses cannot be made equal.
  double Evaluate(
    ConstPointSpan<2> points, PointSpan<2> gradient, double* spacings, Progress& progress) override;
  // Points go to the nearest place where the density has mass, which lowers the cost most, and stay
  // distinct. Points that begin where it has none go the whole way only with a whole step, because
  // the cost may rise over long ways.
  void Aim(ConstPointSpan<2> points, PointSpan<2> steps, std::vector<char>& aimed,
    Progress& progress) const override;
  void Constrain(ConstPointSpan<2> from, PointSpan<2> points, Progress& progress) const override;
  // Moves points that the diagram cannot tell apart, within the domain.
  void Separate(PointSpan<2> points, Progress& progress) const;

private:
  // Visits the points at which the density has mass, or those at which it has none.
  template <class Visit>
  void VisitPoints(
    ConstPointSpan<2> points, bool haveMass, Progress& progress, const Visit& visit) const;

  EqualMassPartition& Partition;
};

} // namespace RectifiedTransport

#endif
