// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/ImageGrid.h"

#include "Core/Geometry/InverseMatrix.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace RectifiedTransport
{

namespace
{

using Matrix = ImageGrid::Matrix;

// The length of a vector; std::hypot neither overflows nor underflows. Eigen's stableNorm rounds in
// another way.
double length(const Eigen::Vector3d& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

// The product, added from left to right. The order of Eigen's sum, and so its rounding, depends on
// its version and on the instruction set.
double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The measure that the first `count` rows span: length, area of the cross product, or volume.
double measure(const Matrix& rows, int count)
{
  const Eigen::Vector3d a = rows.row(0);
  if (count == 1)
  {
    return length(a);
  }
  const Eigen::Vector3d cross = a.cross(Eigen::Vector3d(rows.row(1)));
  return count == 2 ? length(cross) : std::abs(dot(cross, rows.row(2)));
}

} // namespace

ImageGrid::ImageGrid(const std::array<int, 6>& extent, const Eigen::Vector3d& origin,
  const Eigen::Vector3d& spacing, const Matrix& direction, bool onPoints)
  : PointExtent(extent)
  , PointOrigin(origin)
  , PointSpacing(spacing)
  , AxisDirection(direction)
  , OnPoints(onPoints)
{
  this->FindCells();
}

// Bitwise equality: grids that differ by rounding are compared in CommonGrid.
bool ImageGrid::operator==(const ImageGrid& other) const
{
  return this->PointExtent == other.PointExtent && this->PointOrigin == other.PointOrigin &&
    this->PointSpacing == other.PointSpacing && this->AxisDirection == other.AxisDirection &&
    this->OnPoints == other.OnPoints;
}

// VTK writes an empty extent as one whose upper end is below its lower one.
bool ImageGrid::IsEmpty() const
{
  const auto& e = this->PointExtent;
  return e[0] > e[1] || e[2] > e[3] || e[4] > e[5];
}

std::array<int, 3> ImageGrid::NumberOfPoints() const
{
  std::array<int, 3> points;
  for (std::size_t i = 0; i < 3; ++i)
  {
    points[i] = this->PointExtent[2 * i + 1] - this->PointExtent[2 * i] + 1;
  }
  return points;
}

// There is one cell less than points along an axis; an axis of one point still has one layer of
// values.
std::array<int, 3> ImageGrid::NumberOfValues() const
{
  std::array<int, 3> values = this->NumberOfPoints();
  for (int& count : values)
  {
    count -= this->OnPoints || count == 1 ? 0 : 1;
  }
  return values;
}

ImageGrid ImageGrid::WithValuesOn(bool points) const
{
  return { this->PointExtent, this->PointOrigin, this->PointSpacing, this->AxisDirection, points };
}

// A domain stays the same if the number of values times the spacing does: the spacing grows by the
// ratio of the numbers.
ImageGrid ImageGrid::WithValues(const std::array<int, 3>& wanted) const
{
  ImageGrid grid = *this;
  const std::array<int, 3> values = this->NumberOfValues();
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (wanted[i] != 0 && wanted[i] != values[i])
    {
      // The old index at which the new one is 0.
      const double ratio = static_cast<double>(values[i]) / wanted[i];
      const double start = this->PointExtent[2 * i] + (this->OnPoints ? 0.5 * (ratio - 1.0) : 0.0);
      grid.SetAxis(i, start, this->OnPoints ? wanted[i] : wanted[i] + 1);
      grid.PointSpacing[static_cast<Eigen::Index>(i)] *= ratio;
    }
  }
  grid.FindCells();
  return grid;
}

// Extents grow, as VTK's do: origin and indices of the cells that were there stay.
ImageGrid ImageGrid::Grown(const std::array<std::int64_t, 3>& cells) const
{
  ImageGrid grid = *this;
  for (int a = 0; a < this->AxisCount; ++a)
  {
    const auto image = static_cast<std::size_t>(this->Axis[static_cast<std::size_t>(a)]);
    const int more = static_cast<int>(cells[static_cast<std::size_t>(a)]);
    grid.PointExtent[2 * image] -= more;
    grid.PointExtent[2 * image + 1] += more;
  }
  grid.FindCells();
  return grid;
}

// Along each axis there is one centre less than points, and the first one is half a spacing after
// the first point.
ImageGrid ImageGrid::AtCellCentres() const
{
  return this->WithMorePoints(-1, true);
}

// Along each axis the dual cells have one corner more than points, and the first one is half a
// spacing before the first point.
ImageGrid ImageGrid::WithDualCells() const
{
  return this->WithMorePoints(1, false);
}

// Axes of one point stay as they are: they have neither cells nor dual cells.
ImageGrid ImageGrid::WithMorePoints(int more, bool onPoints) const
{
  ImageGrid grid = *this;
  grid.OnPoints = onPoints;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (this->IsAxis(i))
    {
      grid.SetAxis(i, this->PointExtent[2 * i] - 0.5 * more, this->NumberOfPoints()[i] + more);
    }
  }
  grid.FindCells();
  return grid;
}

// The origin moves to the first point, which gets the index 0.
void ImageGrid::SetAxis(std::size_t axis, double first, int points)
{
  const auto a = static_cast<Eigen::Index>(axis);
  for (Eigen::Index r = 0; r < 3; ++r)
  {
    this->PointOrigin[r] += this->AxisDirection(r, a) * this->PointSpacing[a] * first;
  }
  this->PointExtent[2 * axis] = 0;
  this->PointExtent[2 * axis + 1] = points - 1;
}

// Finds the cells and the maps from the image's geometry. Step = Direction diag(Spacing) takes
// indices to offsets. U has the axes of index space as rows, divided by their lengths.
void ImageGrid::FindCells()
{
  this->AxisCount = 0;
  // Offset of index (i, j, k) = Step (i, j, k)^T.
  this->Step = this->AxisDirection * this->PointSpacing.asDiagonal();
  this->Inverse.setZero();
  this->Normal.setZero();
  Matrix axes = Matrix::Zero(); // as rows
  const std::array<int, 3> points = this->NumberOfPoints();
  for (int i = 0; i < 3; ++i)
  {
    const auto image = static_cast<std::size_t>(i);
    this->First[image] = this->PointExtent[2 * image];
    // An axis of one point has no cells. Its direction does not count.
    if (points[image] <= 1)
    {
      continue;
    }
    if (this->OnPoints)
    {
      this->First[image] -= 0.5;
    }
    const int a = this->AxisCount++;
    this->Axis[static_cast<std::size_t>(a)] = i;
    this->Cells[static_cast<std::size_t>(a)] = points[image] - (this->OnPoints ? 0 : 1);
    axes.row(a) = this->Step.col(i).transpose();
    this->CellLength[a] = length(axes.row(a));
  }
  // Length |a|, area |a x b| or volume |(a x b) . c| of a cell with the sides a, b, c.
  this->Measure = this->AxisCount > 0 ? measure(axes, this->AxisCount) : 0.0;
  // The corner of index space is a point like others: it is mapped in the same order of sums.
  const double zero[3] = { 0.0, 0.0, 0.0 };
  this->ToPhysical<3>(zero, this->Corner.data());
  // A corner is never farther than this; if it is not finite, positions are not.
  Eigen::Vector3d farthest = this->Corner.cwiseAbs() + this->PointOrigin.cwiseAbs();
  Eigen::Vector3d sides = Eigen::Vector3d::Zero();
  for (int a = 0; a < this->AxisCount; ++a)
  {
    const auto cells = static_cast<double>(this->Cells[static_cast<std::size_t>(a)]);
    sides[a] = this->CellLength[a] * cells;
    farthest += axes.row(a).transpose().cwiseAbs() * cells;
    axes.row(a) *= 1.0 / this->CellLength[a];
  }
  this->DomainDiagonal = length(sides);
  constexpr double parallel = 1e-5; // the places between points lose its square
  this->Valid = this->AxisCount > 0 && std::isfinite(this->Measure) &&
    std::isfinite(length(farthest)) && this->Measure > 0.0 &&
    measure(axes, this->AxisCount) > parallel;
  if (!this->Valid)
  {
    return;
  }

  // Least squares on axes of unit length: (U U^T)^-1 U.
  Matrix gram = Matrix::Identity();
  for (int a = 0; a < this->AxisCount; ++a)
  {
    for (int b = 0; b < this->AxisCount; ++b)
    {
      // U U^T has ones on its diagonal, as the rows of U have the length 1.
      gram(a, b) = a == b ? 1.0 : dot(axes.row(a), axes.row(b));
    }
  }
  const Matrix inverse = inverseOf(gram);
  for (int a = 0; a < this->AxisCount; ++a)
  {
    for (int b = 0; b < this->AxisCount; ++b)
    {
      this->Inverse.row(a) += inverse(a, b) * axes.row(b);
    }
  }
  const Eigen::Vector3d first = axes.row(0);
  // Unit vectors across the line or plane: distances from it decide what is inside.
  if (this->AxisCount == 1)
  {
    const Eigen::Vector3d across = first.unitOrthogonal();
    this->Normal.row(1) = across;
    this->Normal.row(2) = first.cross(across);
  }
  else if (this->AxisCount == 2)
  {
    this->Normal.row(2) = first.cross(Eigen::Vector3d(axes.row(1))).normalized();
  }
}

// The product over the axes of index space; 1 without axes.
std::int64_t ImageGrid::NumberOfCells() const
{
  std::int64_t cells = 1;
  for (int a = 0; a < this->AxisCount; ++a)
  {
    cells *= this->Cells[static_cast<std::size_t>(a)];
  }
  return cells;
}

// Left-handed axes turn triangles and polygons over.
bool ImageGrid::IsMirrored() const
{
  return this->AxisCount == 3 && this->Step.determinant() < 0.0;
}

} // namespace RectifiedTransport
