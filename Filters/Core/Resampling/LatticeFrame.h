// SPDX-License-Identifier: BSD-3-Clause
// The axes, spacings and position of the lattice that cells of data sets form.
#ifndef RectifiedTransport_LatticeFrame_h
#define RectifiedTransport_LatticeFrame_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Resampling/CellSet.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace RectifiedTransport
{

class Progress;

struct LatticeFrame
{
  // The frame of the cells of the dimension, if they are boxes with about the same edges. Throws
  // Cancelled.
  static std::optional<LatticeFrame> Of(const CellSets& sets, int dimension, Progress& progress);

  // Columns: those of the image.
  ImageGrid::Matrix Axes = ImageGrid::Matrix::Identity();
  std::array<bool, 3> IsAxis{ false, false, false };
  // Along the axes: where the cells begin, the spacing, and the tolerance of corners, in lengths.
  Eigen::Vector3d Low = Eigen::Vector3d::Zero();
  Eigen::Vector3d Spacing = Eigen::Vector3d::Ones();
  Eigen::Vector3d Tolerance = Eigen::Vector3d::Zero();
  std::array<double, 3> CellsAlong{ 0.0, 0.0, 0.0 }; // whole numbers of cells along the box
  double Cells = 0.0;                                // number of cells that there are
};

// The corners of cells that may be boxes. Bit a of a corner's number says on which side it is along
// the cell's edge a. For one thread.
class BoxCorners
{
public:
  BoxCorners(const CellSet& cells, int dimension);

  // The rounding of coordinates, relative to them.
  double Rounding() const { return this->Set.Rounding; }
  bool IsOfDimension(std::int64_t cell) const
  {
    return this->Reader->DimensionOf(cell) == this->Dimension;
  }
  // Returns false for cells of another type, and if a corner is no point of the set.
  bool Read(std::int64_t cell);
  int Count() const { return 1 << this->Dimension; }
  const Eigen::Vector3d& operator[](int corner) const
  {
    return this->Corners[static_cast<std::size_t>(corner)];
  }

  // The point that is a corner.
  std::int64_t PointOf(int corner) const { return this->Points[static_cast<std::size_t>(corner)]; }

  // The place in the lattice of the cell that was read, and on which side of it each corner is
  // along the lattice's axes, as bits. Returns false if it is not a cell of the lattice.
  bool FindPlace(const LatticeFrame& frame, std::array<std::int64_t, 3>& place,
    std::array<unsigned, 8>& sides) const;

private:
  const CellSet& Set;
  const int Dimension;
  const std::unique_ptr<CellReader> Reader;
  std::array<std::int64_t, 8> Points;
  std::array<Eigen::Vector3d, 8> Corners;
};

} // namespace RectifiedTransport

#endif
