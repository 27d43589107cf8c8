// SPDX-License-Identifier: BSD-3-Clause
// The box around the cells of data sets, along the axes of space or of their plane or line.
#ifndef RectifiedTransport_CellFrame_h
#define RectifiedTransport_CellFrame_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Messages/Failure.h"
#include "Core/Resampling/MassCells.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

class Progress;

// Columns: right-handed axes, each nearest to the axis of space with its number. Axis `main` is the
// direction: across a plane or along a line.
ImageGrid::Matrix axesAround(const Eigen::Vector3d& direction, Eigen::Index main);

// Whether points lie in one plane as nearly as the cells of a CellFrame. `positionOf` writes the
// coordinates of a point. Those that are not finite do not count. A quick test: it reads each point
// three times.
bool areInPlane(std::int64_t count, const std::function<void(std::int64_t, double*)>& positionOf);

// The cells lie in no plane, or on no line.
class NotFlat : public Failure
{
public:
  using Failure::Failure;
};

struct CellFrame
{
  // The frame of the cells with mass. Throws Cancelled, and Failure for sets without cells of
  // positive measure, and for points of cells that are not finite; NotFlat for surfaces that are
  // not plane and for lines that are not straight.
  static CellFrame Of(const CellSets& sets, const MassCells& cells, Progress& progress);

  // Values on cells, `resolution` cells along the longest axis, as near to cubes as whole numbers
  // allow. Throws Failure for a resolution out of range.
  ImageGrid Grid(int resolution) const;

  ImageGrid::Matrix Axes = ImageGrid::Matrix::Identity(); // columns
  // The range of the coordinates along the axes. Flat axes, those of the shortest sides, have no
  // length.
  Eigen::AlignedBox3d Box;
};

} // namespace RectifiedTransport

#endif
