// SPDX-License-Identifier: BSD-3-Clause
// Distributed inputs, gathered: the blocks of a density on every rank, and all inputs of a filter
// that runs only on the first rank.
#ifndef RectifiedTransport_GatheredInputs_h
#define RectifiedTransport_GatheredInputs_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Store/DataIdentity.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <map>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Keeps the blocks of the last run. They are gathered again only if the blocks of a rank change.
class GatheredBlocks
{
public:
  // All blocks in the order of their numbers, the parts of one block in the order of the ranks.
  // Blocks that are the same on several ranks count once. Collective. Throws Failure, Cancelled and
  // std::bad_alloc.
  const std::vector<DensityBlock>& Gather(
    const std::vector<DensityBlock>& own, const Ranks& ranks, Progress& progress);

private:
  DataIdentity Content; // what this rank's blocks have
  std::vector<DensityBlock> Blocks;
};

enum class GatheredKind
{
  Points,  // a point set, all of whose points count
  Surface, // a vtkPolyData, whose polygons count
  Density  // an image, any other data set, or a composite one
};

// The data of all ranks on the first rank; nullptr on the others and if no rank has data. Data that
// are whole on every rank stay as they are.
class GatheredInputs
{
public:
  // The kind of the data of each port. Collective. Throws Failure and std::bad_alloc.
  GatheredInputs(
    vtkInformationVector** inputs, const std::map<int, GatheredKind>& kinds, const Ranks& ranks);

  // The executive's input vectors with the gathered data.
  vtkInformationVector** Vectors() { return this->Pointers.data(); }

private:
  std::vector<vtkSmartPointer<vtkInformationVector>> Made;
  std::vector<vtkInformationVector*> Pointers;
};

} // namespace RectifiedTransport::Bridge

#endif
