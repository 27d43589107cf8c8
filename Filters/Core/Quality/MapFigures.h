// SPDX-License-Identifier: BSD-3-Clause
// A map sampled on a lattice: its displacements and derivatives, and figures of all samples.
#ifndef RectifiedTransport_MapFigures_h
#define RectifiedTransport_MapFigures_h

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Quality/BlockErrors.h"
#include "Core/Quality/MapBlocks.h"
#include "Core/Quality/MapFolds.h"

namespace RectifiedTransport
{

struct MapFigures
{
  double Cost = 0.0; // the mean squared displacement
  FoldCount Folds;
  std::int64_t WithMass = 0; // samples, if some are folded
  BlockErrors Blocks;
};

// The density that a map leads to from another one, and its grid, in whose index space the images
// are.
template <int D>
struct MapTarget
{
  const ImageGrid& Grid;
  SummedDensity<D> Density;
};

// A lattice on the domain of a grid, and the images of its samples.
template <int D>
struct MapOnLattice
{
  const ImageGrid& Geometry;
  GridSize<D> Lattice;
  LatticePart<D> Own;    // the samples that this rank counts
  LatticePart<D> Wanted; // those that it writes
  LatticePart<D> Stored; // those whose positions are there, axis 0 fastest
  PointSpan<D> Positions;
};

// Each has a value or vector for each wanted sample, axis 0 fastest.
struct MapValues
{
  double* Displacements; // in 3D they may begin one layer or more before the positions
  double* Divergences;
  double* Determinants;
  double* Costs; // only for a map with a target
};

// Writes the values; positions are undefined afterwards. The map begins at the uniform measure
// (forward) or at the density (backward), and so do the weights of samples in the cost. `density`
// has the values that `flow` moves points by. A map from the density to a target, which may be
// nullptr, is backward to the uniform measure. Collective. Throws std::overflow_error,
// std::bad_alloc and Cancelled.
template <int D>
MapFigures writeMap(const MapOnLattice<D>& map, const RectifiedFlow<D>& flow,
  FlowDirection direction, const DensitySource<D>& density, const MapTarget<D>* target,
  const MapValues& values, Progress& progress);

} // namespace RectifiedTransport

#endif
