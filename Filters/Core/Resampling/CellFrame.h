// SPDX-License-Identifier: BSD-3-Clause
// The box around the cells of data sets, along the axes of space or of their plane or line.
#ifndef RectifiedTransport_CellFrame_h
#define RectifiedTransport_CellFrame_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Resampling/MassCells.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Columns: right-handed axes, each nearest to the axis of space with its number. Axis `main` is the
// direction: across a plane or along a line.
ImageGrid::Matrix axesAround(const Eigen::Vector3d& direction, Eigen::Index main);

struct CellFrame
{
  // Why there is none.
  enum class Flaw
  {
    None,
    NotFinite, // a point of a cell
    OnePlace,  // all points
    TooLong,   // a side is past the largest double
    NotFlat    // a surface in no plane, or lines on no straight one
  };

  // The frame of the cells with mass. Throws Cancelled.
  static CellFrame Of(const CellSets& sets, const MassCells& cells, Progress& progress);

  ImageGrid::Matrix Axes = ImageGrid::Matrix::Identity(); // columns
  // The range of the coordinates along the axes. Flat axes, those of the shortest sides, have no
  // length.
  Eigen::AlignedBox3d Box;

  Flaw Wrong = Flaw::None;
  std::size_t Set = 0; // the set of the first point that is not finite, and the point
  std::int64_t Point = -1;
  Eigen::Vector3d Sides = Eigen::Vector3d::Zero(); // if cells are not flat, in growing order
};

} // namespace RectifiedTransport

#endif
