// SPDX-License-Identifier: BSD-3-Clause
// The ghost points and ghost cells (vtkGhostType) of an input: duplicates of another piece, or
// blanked.
#ifndef RectifiedTransport_GhostFlags_h
#define RectifiedTransport_GhostFlags_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Resampling/HiddenPoints.h"

#include "vtkDataSetAttributes.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDataSet;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The flags of points and cells without mass.
constexpr unsigned char ghostPoint =
  vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
constexpr unsigned char ghostCell = vtkDataSetAttributes::DUPLICATECELL |
  vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

// The values of the ghost array of the points or cells (vtkDataObject::POINT or CELL); nullptr if
// there is none. Throws Failure for a ghost array of another length; `what` names the input.
const unsigned char* ghostFlags(vtkDataSet* data, int owner, const char* what);

constexpr BlankingFlags blankingFlags = { vtkDataSetAttributes::HIDDENPOINT, ghostCell };

// The points of a data set without these ghost flags, numbered from 0 in their order.
class NonGhostPoints
{
public:
  // Throws Failure as above, and if memory is short.
  NonGhostPoints(vtkDataSet* points, const char* what, unsigned char ghosts = ghostPoint);
  // `all` points except those with such a flag; `flags` may be nullptr.
  NonGhostPoints(std::int64_t all, const unsigned char* flags, unsigned char ghosts);

  std::int64_t Count() const { return this->Number; }
  // The index of the point with this number.
  std::int64_t Point(std::int64_t number) const
  {
    return this->Indices.data() ? this->Indices.data()[number] : number;
  }

private:
  std::int64_t Number;
  LargeBuffer<std::int64_t> Indices; // none if there are no ghosts
};

// A warning of the filter for the first such array of its inputs. VTK does not take them for flags,
// so that they hide no points and cells.
void warnOfGhostArrayType(vtkAlgorithm* filter, vtkInformationVector** inputVector);

} // namespace RectifiedTransport::Bridge

#endif
