// SPDX-License-Identifier: BSD-3-Clause
// The grid of an image in physical space: its points, the cells of its values, and the affine map
// between these and space.
#ifndef RectifiedTransport_ImageGrid_h
#define RectifiedTransport_ImageGrid_h

#include "GridSize.h"
#include "IndexMap.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

// Values are constant on grid cells. The grid cells of a cell array are the image's vtkCells.
// Those of a point array are dual cells: they are centred on the points and extend half a spacing
// beyond the bounds. An axis of one point is no axis. Index space has the other axes, in their
// order: grid cell i is [i, i + 1].
class ImageGrid
{
public:
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

  ImageGrid() = default; // without points
  ImageGrid(const std::array<int, 6>& extent, const Eigen::Vector3d& origin,
    const Eigen::Vector3d& spacing, const Matrix& direction, bool onPoints);

  bool operator==(const ImageGrid& other) const;

  // As in vtkImageData.
  const std::array<int, 6>& Extent() const { return this->PointExtent; }
  const Eigen::Vector3d& Origin() const { return this->PointOrigin; }
  const Eigen::Vector3d& Spacing() const { return this->PointSpacing; }
  const Matrix& Direction() const { return this->AxisDirection; }
  bool IsOnPoints() const { return this->OnPoints; }

  // Whether there is no point.
  bool IsEmpty() const;
  bool IsAxis(std::size_t axis) const
  {
    return this->PointExtent[2 * axis] != this->PointExtent[2 * axis + 1];
  }
  std::array<int, 3> NumberOfPoints() const;
  // Along the image's axes, 1 where there is no axis.
  std::array<int, 3> NumberOfValues() const;

  // The same image with values on points, or else on cells.
  ImageGrid WithValuesOn(bool points) const;
  // Another image on the domain that the grid cells cover, with other numbers of values along its
  // axes; 0 keeps the number. Only cells may have one value along an axis.
  ImageGrid WithValues(const std::array<int, 3>& values) const;
  // The image with more cells on each side of its axes; `cells` are along the axes of index space.
  ImageGrid Grown(const std::array<std::int64_t, 3>& cells) const;
  // The image with its points at the centres of this one's cells, and values on points.
  ImageGrid AtCellCentres() const;
  // The image whose cells are the dual cells of this one's points.
  ImageGrid WithDualCells() const;

  // The number of axes.
  int Dimension() const { return this->AxisCount; }
  // False if there is no axis, or if the grid cells have no measure or positions that are not
  // finite. The members below require true.
  bool HasCells() const { return this->Valid; }
  std::int64_t NumberOfCells() const;
  // The length, area or volume of a grid cell.
  double CellMeasure() const { return this->Measure; }
  // The physical length of the diagonal of a box with the domain's sides.
  double Diagonal() const { return this->DomainDiagonal; }
  // Whether the axes of a volume are left-handed.
  bool IsMirrored() const;
  // The distance beyond the border up to which a point counts as inside: more than the rounding of
  // single precision.
  double BorderTolerance() const { return 1e-6 * this->Diagonal(); }

  template <int D>
  GridSize<D> Size() const
  {
    GridSize<D> size{};
    std::copy_n(this->Cells.begin(), D, size.begin());
    return size;
  }

  // The physical lengths of the domain's sides.
  template <int D>
  Point<D> Lengths() const
  {
    Point<D> lengths;
    for (int a = 0; a < D; ++a)
    {
      lengths[a] =
        this->CellLength[a] * static_cast<double>(this->Cells[static_cast<std::size_t>(a)]);
    }
    return lengths;
  }

  // Summed in the order of vtkImageData, so that rounding puts no point of the domain outside its
  // bounds. Like the other maps of points and vectors, written out: Eigen's expressions of the same
  // order take up to five times as long.
  template <int D>
  void ToPhysical(const double* index, double* x) const
  {
    double ijk[3] = { this->First[0], this->First[1], this->First[2] };
    for (int a = 0; a < D; ++a)
    {
      ijk[this->Axis[static_cast<std::size_t>(a)]] += index[a];
    }
    for (int r = 0; r < 3; ++r)
    {
      const double* m = this->Step.data() + 3 * r;
      x[r] = m[0] * ijk[0] + m[1] * ijk[1] + m[2] * ijk[2] + this->PointOrigin[r];
    }
  }

  // The nearest point of the (unbounded) line, plane or space that the axes span.
  template <int D>
  void ToIndex(const double* x, double* index) const
  {
    const double d[3] = { x[0] - this->Corner[0], x[1] - this->Corner[1], x[2] - this->Corner[2] };
    for (int a = 0; a < D; ++a)
    {
      const double* row = this->Inverse.data() + 3 * a;
      index[a] = (row[0] * d[0] + row[1] * d[1] + row[2] * d[2]) / this->CellLength[a];
    }
  }

  // ToIndex, with BorderTolerance() beyond the border and off the line or plane of the image.
  template <int D>
  IndexMap<D> ToIndexMap() const
  {
    IndexMap<D> map;
    for (int a = 0; a < 3; ++a)
    {
      const double unit = a < D ? this->CellLength[a] : 1.0;
      map.Origin[a] = this->Corner[a];
      map.Tolerance[a] = this->BorderTolerance() / unit;
      for (int r = 0; r < 3; ++r)
      {
        map.Matrix[a][r] = (a < D ? this->Inverse(a, r) : this->Normal(a, r)) / unit;
      }
    }
    return map;
  }

  // The physical vector of a difference of indices.
  template <int D>
  void VectorToPhysical(const double* index, double* v) const
  {
    for (int r = 0; r < 3; ++r)
    {
      v[r] = 0.0;
      for (int a = 0; a < D; ++a)
      {
        v[r] += this->Step(r, this->Axis[static_cast<std::size_t>(a)]) * index[a];
      }
    }
  }

  // Moves a point to the nearest one of the domain, axis by axis. Returns whether it was inside.
  template <int D>
  bool ClampToDomain(double* index) const
  {
    bool inside = true;
    for (int a = 0; a < D; ++a)
    {
      const double nearest =
        std::clamp(index[a], 0.0, static_cast<double>(this->Cells[static_cast<std::size_t>(a)]));
      inside = inside && nearest == index[a];
      index[a] = nearest;
    }
    return inside;
  }

  // The index of the nearest point of the domain, axis by axis. Returns whether x is within
  // BorderTolerance() of it.
  template <int D>
  bool NearestIndex(const double* x, double* index) const
  {
    this->ToIndex<D>(x, index);
    this->ClampToDomain<D>(index);
    double nearest[3];
    this->ToPhysical<D>(index, nearest);
    return !(std::hypot(x[0] - nearest[0], x[1] - nearest[1], x[2] - nearest[2]) >
      this->BorderTolerance());
  }

private:
  // The image with half as many more points, or fewer, at each end of its axes.
  ImageGrid WithMorePoints(int more, bool onPoints) const;
  // Gives an axis `points` points. The first is at an index that need not be an integer.
  void SetAxis(std::size_t axis, double first, int points);
  void FindCells();

  std::array<int, 6> PointExtent{ 0, -1, 0, -1, 0, -1 };
  Eigen::Vector3d PointOrigin = Eigen::Vector3d::Zero();
  Eigen::Vector3d PointSpacing = Eigen::Vector3d::Ones();
  Matrix AxisDirection = Matrix::Identity();
  bool OnPoints = true;

  // The dimension of index space.
  int AxisCount = 0;
  bool Valid = false;
  std::array<int, 3> Axis{ 0, 1, 2 };                   // the image's axis, by axes of index space
  std::array<std::int64_t, 3> Cells{ 0, 0, 0 };         // along the axes of index space
  std::array<double, 3> First{ 0.0, 0.0, 0.0 };         // the image's index where index space is 0
  Matrix Step = Matrix::Zero();                         // image index to physical offset
  Eigen::Vector3d Corner = Eigen::Vector3d::Zero();     // physical place where index space is 0
  Eigen::Vector3d CellLength = Eigen::Vector3d::Zero(); // physical lengths of a cell's sides
  Matrix Inverse = Matrix::Zero(); // physical offset to physical length along each axis
  Matrix Normal = Matrix::Zero();  // rows from AxisCount on: unit vectors across the axes
  double Measure = 0.0;            // length, area or volume of a cell
  double DomainDiagonal = 0.0;
};

} // namespace RectifiedTransport

#endif
