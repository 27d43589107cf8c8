// SPDX-License-Identifier: BSD-3-Clause
// Moves particles to the ranks that own their positions.
#ifndef RectifiedTransport_ParticleExchange_h
#define RectifiedTransport_ParticleExchange_h

#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class ImageGrid;
class PlaceOwners;
class Progress;
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Each particle is a cell of `points` consecutive points; the last one is its position. Afterwards
// the data set has the particles at the positions that this rank owns, those of rank 0 first, in
// their order. Runs as the current stage. Collective. Throws Failure, Cancelled and std::bad_alloc.
void moveToOwners(vtkPolyData* particles, std::int64_t points, const PlaceOwners& owners,
  const Ranks& ranks, Progress& progress);

// The same for particles of one point each in a grid's domain, without pieces. On a single rank
// they get vertices: the given ones if there are as many.
void moveToOwners(vtkPolyData* particles, const ImageGrid& grid,
  vtkSmartPointer<vtkCellArray>& vertices, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
