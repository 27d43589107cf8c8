// SPDX-License-Identifier: BSD-3-Clause
// Splats the masses of points in physical space onto the cells, or dual cells, of an image.
#ifndef RectifiedTransport_MassSplat_h
#define RectifiedTransport_MassSplat_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"
#include "Core/Splat/Splat.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The grid and the options of a splat.
struct SplatTarget
{
  const ImageGrid& Geometry;
  SplatOptions Options;
  bool DivideByVolume; // densities, else masses

  // The factor of the masses.
  double Scale() const { return this->DivideByVolume ? 1.0 / this->Geometry.CellMeasure() : 1.0; }
};

// Throws Failure if the density of a cell that holds all of `mass` would not be finite; `what` is
// the subject of the message, `rule` completes "make the masses smaller, ...".
void requireFiniteDensity(
  double mass, const SplatTarget& target, const char* what, const char* rule);

// Writes the values of the cells (or dual cells) of the target's geometry into `cells`, one
// component and a tuple for each, of an array of points and one mass for each; `massEach` if
// `masses` is nullptr. Coordinates are finite; those of a type other than double and float are
// copied. Returns how many points are outside the domain (see SplatReport). Throws Failure if
// memory is short, and Cancelled.
std::int64_t splatPoints(vtkDataArray* points, const double* masses, double massEach,
  const SplatTarget& target, Progress& progress, vtkDoubleArray* cells);

// The total mass of the cells that splatPoints wrote: the sum of the sums of `splatSumChunk`
// consecutive cells. Throws Cancelled.
constexpr std::int64_t splatSumChunk = std::int64_t{ 1 } << 13;
double splatMassIn(vtkDoubleArray* cells, const SplatTarget& target, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
