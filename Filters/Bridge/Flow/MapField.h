// SPDX-License-Identifier: BSD-3-Clause
// A map sampled at the centres of a lattice, or of each rank's part of it: from the core's index
// space to the arrays of an image.
#ifndef RectifiedTransport_MapField_h
#define RectifiedTransport_MapField_h

#include "Bridge/Ranks/TupleBoxes.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSetAttributes;
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

template <int Dimension>
class RectifiedFlow;

// In 3D positions and displacements share memory, where a rank has the whole lattice.
template <int D>
class MapField
{
public:
  // Allocates memory for the lattice of the samples, on the domain of `geometry`, or for this
  // rank's part of it. Throws Failure before if there is not enough; `purpose` completes "not
  // enough memory for".
  MapField(const ImageGrid& geometry, const ImageGrid& samples, const std::string& purpose,
    const Ranks* ranks);

  const GridSize<D>& Whole() const { return this->Lattice; }
  const LatticePart<D>& Part() const { return this->OwnPart; }

  // The mapped samples of the part, in index space.
  PointSpan<D> Positions();

  // Computes Displacement, Divergence and JacobianDeterminant; positions are undefined afterwards.
  // Returns the mean squared displacement of all samples, weighted, if `flow` is given, with the
  // mass of its density in their lattice cells. On ranks, which call this together, the output gets
  // the samples of the wanted box. Progress reaches `end`. Throws Failure and Cancelled.
  double Write(const RectifiedFlow<D>* flow, const TupleBox& wanted, Progress& progress, double end,
    vtkDataSetAttributes* output);

private:
  std::vector<vtkSmartPointer<vtkDoubleArray>> WriteDerivatives(Progress& progress);
  void FindParts(const ImageGrid& samples, const Ranks& ranks);
  void FetchAround();
  TupleBox BoxOf(const LatticePart<D>& part) const;

  const ImageGrid& Geometry;
  const Ranks* const Processes;
  GridSize<D> Lattice;
  LatticePart<D> OwnPart;
  LatticePart<D> Around;      // of the positions
  std::vector<TupleBox> Held; // by the ranks
  std::array<int, 3> Start{}; // of the lattice, in the image
  std::array<int, D> Axes{};  // of the image
  std::int64_t NumberOfSamples;
  vtkSmartPointer<vtkDoubleArray> Displacement;
  LargeBuffer<double> PositionBuffer;
};

} // namespace RectifiedTransport

#endif
