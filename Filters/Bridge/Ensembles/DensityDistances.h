// SPDX-License-Identifier: BSD-3-Clause
// The distances between all pairs of densities of inputs, and the tables of vtkTransportDistance.
#ifndef RectifiedTransport_DensityDistances_h
#define RectifiedTransport_DensityDistances_h

#include "Bridge/Plan/DensityQueries.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Distance/DistanceSet.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkTable;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// A density as the distances to others need it: its values, read once, and what identifies them.
struct DistanceInput
{
  std::string Title; // in messages
  std::string Name;  // the name of its column
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
  const std::vector<DistanceInput>& Inputs() const { return this->Entries; }
  // The number of maps and pairs of Certified that have been found, on all ranks.
  std::int64_t NumberOfSolutions() const { return this->Distances.NumberOfSolutions(); }

  // The pairs (0, 1), (0, 2) ... (1, 2) ... of the densities. Collective. Throws Failure and
  // Cancelled.
  std::vector<DistancePair> Find(Progress& progress);

private:
  void MakeMaps(Progress& progress);

  DistanceMethod Method = DistanceMethod::Linearized;
  std::vector<DistanceInput> Entries; // without their values
  DistanceSet Distances;
};

// A column and a row for each input.
void writeDistances(const std::vector<DistanceInput>& inputs,
  const std::vector<DistancePair>& pairs, vtkTable* table);

// A row for each pair: First, Second (numbers of rows of the distances), LowerBound, UpperBound.
void writeBounds(std::size_t inputs, const std::vector<DistancePair>& pairs, vtkTable* table);

// A row for each input: Name, Time (if inputs have times), TotalMass, Coordinate0 ..., and the
// field data Stress. Throws Cancelled.
void writeCoordinates(const std::vector<DistanceInput>& inputs,
  const std::vector<DistancePair>& pairs, int dimensions, Progress& progress, vtkTable* table);

} // namespace RectifiedTransport::Bridge

#endif
