// SPDX-License-Identifier: BSD-3-Clause
// The distances between all pairs of densities of inputs.
#ifndef RectifiedTransport_DensityDistances_h
#define RectifiedTransport_DensityDistances_h

#include "Bridge/Ensembles/DistanceInput.h"
#include "Core/Distance/DistanceSet.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// In physical lengths.
struct DistancePair
{
  double Distance = 0.0;
  double Lower = 0.0;
  double Upper = 0.0;
};

// See DistanceSet.
class DensityDistances
{
public:
  // Forgets the densities, but not what was computed.
  void Begin(DistanceMethod method);
  // With Linearized, may compute maps. Collective. Throws Failure, where densities have not the
  // same box, and Cancelled.
  void Add(DistanceInput input, Progress& progress);
  const std::vector<DistanceInput>& Inputs() const { return this->Given; }
  // The number of maps and pairs of Certified that have been found, on all ranks.
  std::int64_t NumberOfSolutions() const { return this->Distances.NumberOfSolutions(); }

  // The pairs (0, 1), (0, 2) ... (1, 2) ... of the densities. Collective. Throws Failure and
  // Cancelled.
  std::vector<DistancePair> Find(Progress& progress);

private:
  void MakeMaps(Progress& progress);

  DistanceMethod Method = DistanceMethod::Linearized;
  std::vector<DistanceInput> Given; // without their values
  std::vector<double> Sides;        // of the box, in the LengthScale of the first density
  DistanceSet Distances;
};

} // namespace RectifiedTransport::Bridge

#endif
