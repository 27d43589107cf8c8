// SPDX-License-Identifier: BSD-3-Clause
// A map sampled at the centres of a lattice: from the core's index space to the arrays of an image.
#ifndef RectifiedTransport_MapField_h
#define RectifiedTransport_MapField_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSetAttributes;
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

template <int Dimension>
class RectifiedFlow;

// In 3D positions and displacements share memory.
template <int D>
class MapField
{
public:
  // Allocates memory for a lattice on the domain of `geometry`. Throws Failure before if there is
  // not enough; `purpose` completes "not enough memory for".
  MapField(const ImageGrid& geometry, const GridSize<D>& lattice, const std::string& purpose);

  std::int64_t Count() const { return this->NumberOfSamples; }

  // The mapped samples, in index space.
  PointSpan<D> Positions();

  // Computes Displacement, Divergence and JacobianDeterminant; positions are undefined afterwards.
  // Returns the mean squared displacement of the samples, weighted, if `flow` is given, with the
  // mass of its density in their lattice cells. Progress reaches `end`. Throws Failure and
  // Cancelled.
  double Write(
    const RectifiedFlow<D>* flow, Progress& progress, double end, vtkDataSetAttributes* output);

private:
  void WriteDerivatives(Progress& progress, vtkDataSetAttributes* output);

  const ImageGrid& Geometry;
  GridSize<D> Lattice;
  std::int64_t NumberOfSamples;
  vtkSmartPointer<vtkDoubleArray> Displacement;
  LargeBuffer<double> PositionBuffer;
};

} // namespace RectifiedTransport

#endif
