// SPDX-License-Identifier: BSD-3-Clause
// The regions of a map: polygons and closed lines.
#ifndef RectifiedTransport_RegionCells_h
#define RectifiedTransport_RegionCells_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Names of cell arrays; empty: none is chosen.
struct RegionArrays
{
  std::string Mass;
  std::string Region;
};

struct RegionCells
{
  // All blocks as one, with double points and the arrays that all blocks have. Cells are numbered
  // as those of a vtkPolyData: vertices, lines, polygons.
  vtkSmartPointer<vtkPolyData> Data;
  std::vector<std::int32_t> Regions; // one a cell; -1 for vertices and open lines
  std::vector<std::string> Names;    // one a region, for messages
  std::vector<double> Masses;        // one a region, at least 0
  std::string OpenLines;             // a warning, if there are some
};

// Blocks are those of the input. Without a chosen mass array it is the cells' active scalars, else
// their only numeric array. Cells with one value of the region array are one region; without one
// those of a block, with all its pieces, if there are several, else each cell. Throws Failure as
// joinRegionBlocks, and for no regions, no or bad masses, and masses that differ in a region; and
// Cancelled.
RegionCells readRegions(
  const std::vector<DensityBlock>& blocks, const RegionArrays& arrays, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
