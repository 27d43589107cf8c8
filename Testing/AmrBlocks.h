// SPDX-License-Identifier: BSD-3-Clause
// What sets up adaptive mesh refinement in all versions of VTK.
#ifndef RectifiedTransport_AmrBlocks_h
#define RectifiedTransport_AmrBlocks_h

#include "Bridge/VTKCompatibility.h"

#include "vtkImageData.h"
#include "vtkUniformGrid.h"

#include <vector>

template <class AMR>
void setBlocksPerLevel(AMR* grids, const std::vector<unsigned int>& counts)
{
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_AMR_OF_CARTESIAN_GRIDS
  grids->Initialize(counts);
#else
  const std::vector<int> signedCounts(counts.begin(), counts.end());
  grids->Initialize(static_cast<int>(counts.size()), signedCounts.data());
#endif
}

template <class AMR>
vtkImageData* imageAt(AMR* grids, unsigned int level, unsigned int block)
{
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_AMR_OF_CARTESIAN_GRIDS
  return grids->GetDataSetAsImageData(level, block);
#else
  return grids->GetDataSet(level, block);
#endif
}

#endif
