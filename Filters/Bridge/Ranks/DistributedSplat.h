// SPDX-License-Identifier: BSD-3-Clause
// Splats the masses of points in physical space onto the cells, or dual cells, of an image.
#ifndef RectifiedTransport_DistributedSplat_h
#define RectifiedTransport_DistributedSplat_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
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

  // What values are to be multiplied by to be masses.
  double CellMeasure() const { return this->DivideByVolume ? this->Geometry.CellMeasure() : 1.0; }
};

// Throws Failure if the density of a cell that holds all of `mass` would not be finite; `what` is
// the subject of the message, `rule` completes "make the masses smaller, ...".
void requireFiniteDensity(
  double mass, const SplatTarget& target, const char* what, const char* rule);

// Splats an array of points and one mass for each, `massEach` if `masses` is nullptr. Coordinates
// are finite; those of a type other than double and float are copied. Each rank gets the cells (or
// dual cells) of its box `wanted`, tuples of the target's whole geometry as tuplesOf(extent, owner,
// whole) gives them; one rank alone gets all. `cells` has a component and wanted.Count() tuples.
// `order` may be nullptr; else it has a key for each point. Boxes, keys and memory: see
// splatOnRanks. Collective. Returns how many points of all ranks are outside the domain. Throws
// Failure if memory is short, and Cancelled.
std::int64_t splatDistributed(vtkDataArray* points, const double* masses, double massEach,
  const std::int64_t* order, const SplatTarget& target, const TupleBox& wanted, Progress& progress,
  vtkDoubleArray* cells);
// The same for a mass for each of points in double precision on all ranks.
std::int64_t splatDistributed(ConstPointSpan<3> points, const double* masses,
  const std::int64_t* order, const SplatTarget& target, const TupleBox& wanted, Progress& progress,
  vtkDoubleArray* cells);

} // namespace RectifiedTransport::Bridge

#endif
