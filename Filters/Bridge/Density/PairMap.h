// SPDX-License-Identifier: BSD-3-Clause
// Optimal maps between two densities that lie in one space, at any places and spacings.
#ifndef RectifiedTransport_PairMap_h
#define RectifiedTransport_PairMap_h

#include "Bridge/Density/OptimalMemory.h"
#include "Bridge/Settings/OptimalSettings.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/OptimalMap/OptimalMap.h"

#include <memory>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;

// A density on a grid at its place in the box of another grid, whose axes have the same directions.
// Lengths are in the LengthScale of the box.
template <int D>
PlacedDensity<D> placeDensity(
  const ImageGrid& box, const ImageGrid& grid, const DensitySource<D>& density);

struct PairMapOptions
{
  OptimalSetting Optimal;
  int LeastIterations;
  bool RefinesBound;
  double Samples = 0.0; // that the map moves together, of all ranks
};

// The fewest iterations for what a setting asks for.
inline int leastIterations(const OptimalSetting& setting)
{
  return setting.IsOptimal ? 4 : 1;
}

template <int D>
OptimalMemory memoryOfPair(const GridSize<D>& source, const GridSize<D>& target,
  const OptimalNeeds& needs, const Ranks& ranks);

// The map from a density in the box to a density of an input, solved. Collective. Throws Failure
// and Cancelled.
template <int D>
std::unique_ptr<OptimalMap<D>> solvePair(const ImageGrid& box, const PlacedDensity<D>& source,
  InputDensity& target, const PairMapOptions& options, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
