// SPDX-License-Identifier: BSD-3-Clause
// The axes, spacings and position of the lattice that cells of data sets form.
#ifndef RectifiedTransport_LatticeFrame_h
#define RectifiedTransport_LatticeFrame_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkNew.h"
#include "vtkType.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkIdList;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct LatticeFrame
{
  // The frame of the cells of the dimension, if they are boxes with about the same edges. Throws
  // Cancelled.
  static std::optional<LatticeFrame> Of(
    const std::vector<DensityBlock>& blocks, int dimension, Progress& progress);

  // Columns: those of the image.
  ImageGrid::Matrix Axes = ImageGrid::Matrix::Identity();
  std::array<bool, 3> IsAxis{ false, false, false };
  // Along the axes: where the cells begin, the spacing, and the tolerance of corners, in lengths.
  Eigen::Vector3d Low = Eigen::Vector3d::Zero();
  Eigen::Vector3d Spacing = Eigen::Vector3d::Ones();
  Eigen::Vector3d Tolerance = Eigen::Vector3d::Zero();
  std::array<double, 3> CellsAlong{ 0.0, 0.0, 0.0 }; // whole numbers, of the box of the cells
  double Cells = 0.0;                                // the number of those that there are
};

// The corners of cells that may be boxes. Bit a of a corner's number says on which side it is along
// the cell's edge a. For one thread.
class BoxCorners
{
public:
  BoxCorners(vtkDataSet* data, int dimension);
  ~BoxCorners();

  // The rounding of coordinates, relative to them.
  double Rounding() const { return this->RoundingOfPoints; }
  bool IsOfDimension(vtkIdType cell) const;
  // Returns false for cells of another type, and if a corner is no point of the data set.
  bool Read(vtkIdType cell);
  int Count() const { return 1 << this->Dimension; }
  const Eigen::Vector3d& operator[](int corner) const
  {
    return this->Corners[static_cast<std::size_t>(corner)];
  }

  // The point of the data set that is a corner.
  vtkIdType PointOf(int corner) const;

  // The place in the lattice of the cell that was read, and on which side of it each corner is
  // along the lattice's axes, as bits. Returns false if it is not a cell of the lattice.
  bool FindPlace(const LatticeFrame& frame, std::array<std::int64_t, 3>& place,
    std::array<unsigned, 8>& sides) const;

private:
  vtkDataSet* Data;
  const int Dimension;
  const double RoundingOfPoints;
  vtkNew<vtkIdList> Ids;
  std::array<vtkIdType, 8> Points;
  std::array<Eigen::Vector3d, 8> Corners;
};

} // namespace RectifiedTransport::Bridge

#endif
