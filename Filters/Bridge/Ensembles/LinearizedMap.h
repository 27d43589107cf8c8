// SPDX-License-Identifier: BSD-3-Clause
// The positions in one density of the particles of the pivot, a unit box with equally many
// particles in each cell of a grid (Section 3.4). Each rank has its share of the particles.
#ifndef RectifiedTransport_LinearizedMap_h
#define RectifiedTransport_LinearizedMap_h

#include "Bridge/Settings/TableSettings.h"
#include "Bridge/Store/DataIdentity.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/RankShare.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <memory>

namespace RectifiedTransport::Bridge
{

class FlowCache;
class InputDensity;

// What maps to several densities must have in common for their particles to correspond.
struct LinearizedMapSettings
{
  std::array<std::int64_t, 3> Grid; // cells along the axes of index space, 1 beyond its dimension
  std::int64_t PerCell;
  FlowOptions Options;
  TableSetting Tables;
  RankShare Share; // of the numbers of the particles
};

struct LinearizedMap
{
  // The share's positions, physical, 3 components, in the order of PivotLattice. Read-only.
  vtkSmartPointer<vtkDoubleArray> Positions;
  double TotalMass = 0.0; // density times cell measure, summed
  // Counts this rank's particles. Those that ended in an empty cell of the density were moved to
  // the nearest mass.
  FlowReport Flow;
};

// What a map depends on.
DataIdentity identityOfMap(const InputDensity& density, const LinearizedMapSettings& settings);

// Advects the particles to a density. Builds the tables in `tables`. Collective on the ranks of the
// progress. Throws Failure and Cancelled.
std::shared_ptr<const LinearizedMap> makeLinearizedMap(InputDensity& density,
  const LinearizedMapSettings& settings, FlowCache& tables, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
