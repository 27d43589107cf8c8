// SPDX-License-Identifier: BSD-3-Clause
// Which tuples have most of the mass of clouds in each cell.
#ifndef RectifiedTransport_LabelVotes_h
#define RectifiedTransport_LabelVotes_h

#include "Bridge/Ranks/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkType.h"

#include <array>
#include <memory>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct AdvectedMoment;

class LabelVotes
{
public:
  virtual ~LabelVotes() = default;
  // For each wanted cell what has most of the mass there, of equal masses the least number; -1 if
  // there is no mass. `equal`: for each tuple, what its mass counts for. Throws Cancelled.
  virtual std::vector<vtkIdType> Count(
    const std::vector<vtkIdType>& equal, Progress& progress) const = 0;
};

// The tuples that clouds bring from both ends of their ways, those of the second end after all of
// the first one. A cloud that several tuples share, of points around the centre of a cell or cells
// around a point, has a part for each of its 2^d quarters.
struct BroughtTuples
{
  int Parts = 1;
  std::array<std::vector<vtkIdType>, 2> At; // those of a cloud's parts one after the other

  // From the centre of the cloud to that of a part, of the cloud's length.
  double OffsetOf(int part, int axis) const
  {
    return this->Parts == 1 ? 0.0 : (part >> axis & 1) == 0 ? -0.25 : 0.25;
  }
};

// On ranks each gets the clouds that reach its wanted cells, in the order of their numbers.
// Collective. Throws Failure.
template <int D>
std::unique_ptr<LabelVotes> makeLabelVotes(const AdvectedMoment& moment,
  const BroughtTuples& tuples, const ImageGrid& geometry, const TupleBox& wanted,
  Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
