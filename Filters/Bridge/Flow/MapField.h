// SPDX-License-Identifier: BSD-3-Clause
// A map sampled at the centres of a lattice, or on each rank at those of its part: from the core's
// index space to the arrays of an image.
#ifndef RectifiedTransport_MapField_h
#define RectifiedTransport_MapField_h

#include "Bridge/Run/Memory.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Quality/MapFigures.h"

#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSetAttributes;
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

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

  // The part that this rank computes.
  const LatticePart<D>& Part() const { return this->OwnPart; }
  // The own part, with the numbers of its positions.
  LatticeParts<D> Parts() const { return { this->OwnPart, this->Stored }; }
  // The mapped samples, in index space.
  PointSpan<D> Positions();

  // Adds Displacement, Divergence and JacobianDeterminant of the wanted samples, with a target
  // CostDensity, too; see writeMap. Positions are undefined afterwards. Collective. Throws Failure
  // and Cancelled.
  MapFigures Write(const RectifiedFlow<D>& flow, FlowDirection direction,
    const DensitySource<D>& density, Progress& progress, vtkDataSetAttributes* output,
    const MapTarget<D>* target = nullptr);

private:
  void FindParts(const ImageGrid& samples, const TupleBox& wanted, const Ranks& ranks);
  TupleBox BoxOf(const LatticePart<D>& part) const;
  void Complete();

  const ImageGrid& Geometry;
  const Ranks& Processes;
  GridSize<D> Lattice;
  LatticePart<D> OwnPart;
  LatticePart<D> Wanted;
  LatticePart<D> Measured; // what the figures of the own part depend on
  LatticePart<D> Stored;
  std::int64_t Ahead = 0;     // tuples in the memory before the positions
  std::vector<TupleBox> Held; // the box that each rank holds
  std::array<int, 3> Start{}; // where the lattice begins in the image
  std::array<int, D> Axes{};  // the image's axis for each axis of the lattice
  vtkSmartPointer<vtkDoubleArray> Displacement;
  LargeBuffer<double> PositionBuffer; // not in 3D
};

} // namespace RectifiedTransport::Bridge

#endif
