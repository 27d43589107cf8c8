// SPDX-License-Identifier: BSD-3-Clause
// A map at the centres of a lattice of cells, between the core's index space and the arrays of an
// image.
#ifndef RectifiedTransport_MapField_h
#define RectifiedTransport_MapField_h

#include "Bridge/Image/ImageGeometry.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Executor.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSetAttributes;
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class AlgorithmProgress;

template <int Dimension>
class RectifiedFlow;

// In 3D, positions and displacements share their memory.
template <int D>
class MapField
{
public:
  // Memory for a lattice on the domain of `geometry`. Throws Failure before anything is allocated
  // if it is too much for the system; `purpose` completes "not enough memory for".
  MapField(const ImageGeometry& geometry, const GridSize<D>& lattice, const std::string& purpose);

  std::int64_t Count() const { return this->NumberOfSamples; }

  // Where the map takes the samples, in index space, D doubles each.
  double* Positions();

  // Turns positions into Displacement, Divergence and JacobianDeterminant. Positions are gone
  // afterwards. Returns the mean squared displacement: of the samples, or if `flow` is given
  // weighted with the mass of its density in their cells. Progress reaches `progress`. Throws
  // Failure and Aborted.
  double Write(const RectifiedFlow<D>* flow, const Executor& executor, AlgorithmProgress& host,
    double progress, vtkDataSetAttributes* output);

private:
  void WriteDerivatives(
    const Executor& executor, AlgorithmProgress& host, vtkDataSetAttributes* output);
  double WriteDisplacement(
    const RectifiedFlow<D>* flow, const Executor& executor, AlgorithmProgress& host);

  const ImageGeometry& Geometry;
  GridSize<D> Lattice;
  GridSize<D> Size;
  std::int64_t NumberOfSamples;
  vtkSmartPointer<vtkDoubleArray> Displacement;
  LargeBuffer<double> PositionBuffer;
};

} // namespace RectifiedTransport

#endif
