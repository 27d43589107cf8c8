// SPDX-License-Identifier: BSD-3-Clause
// A map sampled at the centres of a lattice, or on each rank at those of its part: from the core's
// index space to the arrays of an image.
#ifndef RectifiedTransport_MapField_h
#define RectifiedTransport_MapField_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/MapDerivatives.h"
#include "Core/Flow/MapDisplacement.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Quality/BlockErrors.h"
#include "Core/Quality/MapBlocks.h"
#include "Core/Tables/Density.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSetAttributes;
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// What a map says about all of its samples.
struct MapFigures
{
  double Cost = 0.0;       // the mean squared displacement
  std::int64_t Folded = 0; // samples
  bool ShowsFolds = false; // enough for a warning

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

// In 3D positions and displacements share memory.
template <int D>
class MapField
{
public:
  // Allocates memory for the lattice of the samples, on the domain of `geometry`. Each rank
  // computes one part of the lattice, gets the samples of the wanted box and has memory for these.
  // A single rank computes all. Collective. Throws Failure if there is not enough memory; `purpose`
  // completes "not enough memory for". `hasTarget`: Write is called with a target.
  MapField(const ImageGrid& geometry, const ImageGrid& samples, const TupleBox& wanted,
    const std::string& purpose, const Ranks& ranks, bool hasTarget = false);

  const GridSize<D>& Whole() const { return this->Lattice; }
  // The part that this rank computes.
  const LatticePart<D>& Part() const { return this->OwnPart; }
  // The part that Write needs the masses of, too.
  LatticePart<D> WeighedPart() const { return this->OwnPart.With(this->Wanted); }
  // The own part, with the numbers of its positions.
  LatticeParts<D> Parts() const { return { this->OwnPart, this->Kept }; }
  // The mapped samples, in index space.
  PointSpan<D> Positions();

  // Computes Displacement, Divergence and JacobianDeterminant of the wanted samples; positions are
  // undefined afterwards. The map begins at the uniform measure (forward) or at the density
  // (backward), and so do the weights of samples in the cost. `density` has the values that `flow`
  // moves points by. A map from the density to a target, which is backward to the uniform measure,
  // also gives CostDensity. Collective. Throws Failure and Cancelled.
  MapFigures Write(const RectifiedFlow<D>& flow, FlowDirection direction,
    const DensitySource<D>& density, Progress& progress, vtkDataSetAttributes* output,
    const MapTarget<D>* target = nullptr);

private:
  void FindParts(const ImageGrid& samples, const TupleBox& wanted, const Ranks& ranks);
  TupleBox BoxOf(const LatticePart<D>& part) const;
  void Complete();
  void TakeFrom(const MapTarget<D>& target, Progress& progress);
  void WriteSamples(const MapDerivatives<D>& derivatives, const MapDisplacement<D>& moves,
    DisplacementSums& sums, Progress& progress, double* divergence, double* determinant);

  const ImageGrid& Geometry;
  const Ranks& Processes;
  GridSize<D> Lattice;
  LatticePart<D> OwnPart;
  LatticePart<D> Wanted;
  LatticePart<D> Measured; // what the figures of the own part depend on
  LatticePart<D> Kept;
  std::int64_t Ahead = 0;     // tuples in the memory before the positions
  std::vector<TupleBox> Held; // by the ranks
  std::array<int, 3> Start{}; // of the lattice, in the image
  std::array<int, D> Axes{};  // of the image
  vtkSmartPointer<vtkDoubleArray> Displacement;
  LargeBuffer<double> PositionBuffer; // not in 3D
};

} // namespace RectifiedTransport::Bridge

#endif
