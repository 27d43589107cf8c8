// SPDX-License-Identifier: BSD-3-Clause
// The tables of vtkTransportDistance.
#ifndef RectifiedTransport_DistanceTables_h
#define RectifiedTransport_DistanceTables_h

#include "Bridge/Ensembles/DensityDistances.h"
#include "Bridge/VTKCompatibility.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkTable;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

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
