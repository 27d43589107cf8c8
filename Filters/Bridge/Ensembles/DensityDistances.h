// SPDX-License-Identifier: BSD-3-Clause
// The distances between all pairs of densities of inputs.
#ifndef RectifiedTransport_DensityDistances_h
#define RectifiedTransport_DensityDistances_h

#include "Bridge/Density/InputDensity.h"
#include "Core/Distance/DistanceSet.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

// A density as the distances to others need it: its values, read once, and what identifies them.
struct DistanceInput
{
  std::string Title; // in messages
  std::string Name;  // of its column
  double Time = std::numeric_limits<double>::quiet_NaN();
  DensityReading Reading;
  ImageGrid Grid;
  double Mass = 0.0;     // density times cell measure
  DataIdentity Identity; // identifies the values; hashed
  // One value per cell, axis 0 of index space fastest; released when added to the distances.
  vtkSmartPointer<vtkDoubleArray> Values;
};

// Reads a density, on ranks the whole one on each. Collective. Throws Failure, without the title,
// and Cancelled.
DistanceInput readDistanceInput(InputDensity& density, Progress& progress);

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
  DistanceSet Distances;
};

} // namespace RectifiedTransport::Bridge

#endif
