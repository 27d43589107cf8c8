// SPDX-License-Identifier: BSD-3-Clause
// Warnings about data sets whose densities were resampled.
#ifndef RectifiedTransport_SetMessages_h
#define RectifiedTransport_SetMessages_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Resampling/CellPieces.h"
#include "Core/Resampling/Reading/SetReading.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{

// Warnings about cells that carry no mass. `size` is what all cells contain.
std::vector<std::string> describeLost(
  const std::vector<CellValues>& sets, const CellSize& size, int dimension);

// A line for each finding about the values of all sets. `places` have no names of arrays and no
// number of values yet. Throws Cancelled.
std::vector<std::string> describeSuspect(const std::vector<CellValues>& sets,
  const std::vector<SetFindings>& findings, ValuePlaces places, const ImageGrid& grid,
  Progress& progress);

} // namespace RectifiedTransport

#endif
