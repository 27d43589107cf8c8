// SPDX-License-Identifier: BSD-3-Clause
// The arrays of data sets whose density was resampled, at particles.
#ifndef RectifiedTransport_CellSampling_h
#define RectifiedTransport_CellSampling_h

#include "Bridge/Cells/BlockValues.h"
#include "Core/Resampling/CellLattice.h"

#include <optional>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Gives particles the values of the arrays of blocks, whose cells form the lattice if there is one.
// `particles` are physical, in cells of the grid that cells of the blocks reach. Throws Failure and
// Cancelled.
void sampleCells(const BlockValues& blocks, const std::optional<CellLattice>& lattice,
  const ImageGrid& grid, ConstPointSpan<3> particles, Progress& progress, vtkPointData* output);

} // namespace RectifiedTransport::Bridge

#endif
