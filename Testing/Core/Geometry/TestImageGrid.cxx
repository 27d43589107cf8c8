// SPDX-License-Identifier: BSD-3-Clause
// The grid of an image: index space and physical space, where values are, what is no grid.
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticeExtent.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{
namespace
{

using Matrix = ImageGrid::Matrix;

const Eigen::Vector3d origin(10.0, -20.0, 30.0);
const Eigen::Vector3d spacing(0.5, 2.0, 3.0);

// A rotation about no axis of the image, and a shear.
Matrix oblique()
{
  Matrix shear = Matrix::Identity();
  shear(0, 1) = 0.25;
  shear(1, 2) = -0.5;
  const Eigen::Vector3d about = Eigen::Vector3d(1.0, 2.0, -1.0).normalized();
  return Matrix(Eigen::AngleAxisd(0.7, about).toRotationMatrix() * shear);
}

// Where vtkImageData has a point of the image's index space, by the definition.
Eigen::Vector3d placeOf(const Matrix& direction, double i, double j, double k)
{
  return origin + direction * spacing.asDiagonal() * Eigen::Vector3d(i, j, k);
}

template <int D>
Eigen::Vector3d physical(const ImageGrid& grid, const std::array<double, 3>& index)
{
  Eigen::Vector3d x;
  grid.ToPhysical<D>(index.data(), x.data());
  return x;
}

template <int D>
void expectRoundTrip(const ImageGrid& grid)
{
  const std::array<double, 3> index{ 0.3, 1.7, 2.9 };
  const Eigen::Vector3d x = physical<D>(grid, index);
  std::array<double, 3> found{};
  grid.ToIndex<D>(x.data(), found.data());
  const IndexMap<D> map = grid.ToIndexMap<D>();
  for (int a = 0; a < 3; ++a)
  {
    double mapped = 0.0;
    for (int r = 0; r < 3; ++r)
    {
      mapped += map.Matrix[a][r] * (x[r] - map.Origin[r]);
    }
    const double expected = a < D ? index[static_cast<std::size_t>(a)] : 0.0;
    EXPECT_NEAR(mapped, expected, 1e-13);
    if (a < D)
    {
      EXPECT_NEAR(found[static_cast<std::size_t>(a)], expected, 1e-13);
    }
  }
  // Off the line or plane of the axes the nearest point of it has the same index.
  if (D < 3)
  {
    const Eigen::Vector3d off = Eigen::Vector3d::Map(map.Matrix[2]);
    const Eigen::Vector3d beside = x + 5.0 * off / off.norm();
    std::array<double, 3> nearest{};
    grid.ToIndex<D>(beside.data(), nearest.data());
    for (std::size_t a = 0; a < D; ++a)
    {
      EXPECT_NEAR(nearest[a], index[a], 1e-13);
    }
    EXPECT_FALSE(grid.NearestIndex<D>(beside.data(), nearest.data()));
  }
  EXPECT_TRUE(grid.NearestIndex<D>(x.data(), found.data()));
}

TEST(ImageGrid, PointsAndCellsOfAnImage)
{
  const std::array<int, 6> extent{ -2, 4, 3, 8, 5, 9 };
  const ImageGrid cells(extent, origin, spacing, oblique(), false);
  EXPECT_EQ(cells.Dimension(), 3);
  EXPECT_EQ(cells.NumberOfCells(), 6 * 5 * 4);
  EXPECT_EQ(cells.Size<3>(), (GridSize<3>{ 6, 5, 4 }));
  EXPECT_TRUE(physical<3>(cells, { 1.5, 2.5, 3.5 }).isApprox(placeOf(oblique(), -0.5, 5.5, 8.5)));

  const ImageGrid points = cells.WithValuesOn(true);
  EXPECT_EQ(points.NumberOfCells(), 7 * 6 * 5);
  EXPECT_TRUE(physical<3>(points, { 0.5, 0.5, 0.5 }).isApprox(placeOf(oblique(), -2.0, 3.0, 5.0)));
  EXPECT_EQ(points.CellMeasure(), cells.CellMeasure());

  const Matrix steps = oblique() * spacing.asDiagonal();
  EXPECT_NEAR(cells.CellMeasure(), std::abs(steps.determinant()), 1e-14);
  const Eigen::Vector3d sides =
    steps.colwise().norm().transpose().cwiseProduct(Eigen::Vector3d(6.0, 5.0, 4.0));
  EXPECT_NEAR(cells.Diagonal(), sides.norm(), 1e-13);
  for (std::size_t a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(cells.Lengths<3>()[a], sides[static_cast<Eigen::Index>(a)], 1e-14);
  }
}

TEST(ImageGrid, RoundTrip)
{
  expectRoundTrip<3>(ImageGrid({ 1, 4, 2, 5, 0, 3 }, origin, spacing, oblique(), false));
  expectRoundTrip<2>(ImageGrid({ 1, 4, 7, 7, 0, 3 }, origin, spacing, oblique(), true));
  expectRoundTrip<1>(ImageGrid({ 1, 1, 2, 5, 3, 3 }, origin, spacing, oblique(), false));
}

TEST(ImageGrid, AxesOfOnePointAreNone)
{
  const ImageGrid plane({ 1, 4, 7, 7, 0, 3 }, origin, spacing, oblique(), false);
  EXPECT_EQ(plane.Dimension(), 2);
  EXPECT_EQ(plane.Size<2>(), (GridSize<2>{ 3, 3 }));
  EXPECT_FALSE(plane.IsAxis(1));
  const Eigen::Vector3d first = oblique().col(0) * spacing[0];
  const Eigen::Vector3d second = oblique().col(2) * spacing[2];
  EXPECT_NEAR(plane.CellMeasure(), first.cross(second).norm(), 1e-14);
  EXPECT_TRUE(physical<2>(plane, { 1.0, 2.0 }).isApprox(placeOf(oblique(), 2.0, 7.0, 2.0)));

  const ImageGrid line({ 0, 0, 2, 6, 3, 3 }, origin, spacing, oblique(), false);
  EXPECT_EQ(line.Dimension(), 1);
  EXPECT_NEAR(line.CellMeasure(), (oblique().col(1) * spacing[1]).norm(), 1e-14);
  EXPECT_NEAR(line.Diagonal(), 4.0 * line.CellMeasure(), 1e-13);
}

TEST(ImageGrid, ClampsToItsDomain)
{
  const ImageGrid grid({ 0, 4, 0, 3, 0, 0 }, origin, spacing, oblique(), false);
  std::array<double, 2> index{ -1.5, 2.0 };
  EXPECT_FALSE(grid.ClampToDomain<2>(index.data()));
  EXPECT_EQ(index, (std::array<double, 2>{ 0.0, 2.0 }));
  EXPECT_TRUE(grid.ClampToDomain<2>(index.data()));
  index = { 4.0, 3.5 };
  EXPECT_FALSE(grid.ClampToDomain<2>(index.data()));
  EXPECT_EQ(index, (std::array<double, 2>{ 4.0, 3.0 }));

  // By less than the tolerance a point beyond the border is not outside.
  const Eigen::Vector3d along = oblique().col(0).normalized();
  const Eigen::Vector3d corner = placeOf(oblique(), 0.0, 0.0, 0.0);
  const Eigen::Vector3d near = corner - 0.9 * grid.BorderTolerance() * along;
  const Eigen::Vector3d far = corner - 1.1 * grid.BorderTolerance() * along;
  EXPECT_TRUE(grid.NearestIndex<2>(near.data(), index.data()));
  EXPECT_EQ(index[0], 0.0);
  EXPECT_FALSE(grid.NearestIndex<2>(far.data(), index.data()));
}

TEST(ImageGrid, VectorsAreDifferencesOfPlaces)
{
  const ImageGrid grid({ 0, 4, 2, 2, -3, 3 }, origin, spacing, oblique(), true);
  const std::array<double, 2> way{ 0.75, -1.25 };
  Eigen::Vector3d vector;
  grid.VectorToPhysical<2>(way.data(), vector.data());
  const Eigen::Vector3d from = physical<2>(grid, { 1.0, 2.0 });
  EXPECT_TRUE((physical<2>(grid, { 1.75, 0.75 }) - from).isApprox(vector, 1e-13));
}

TEST(ImageGrid, OtherValuesOnTheSameDomain)
{
  const ImageGrid points({ 2, 5, 1, 1, 0, 7 }, origin, spacing, oblique(), true);
  for (const ImageGrid& other : { points.WithValues({ 9, 1, 3 }), points.WithDualCells(),
         points.WithDualCells().AtCellCentres() })
  {
    EXPECT_NEAR(other.Diagonal(), points.Diagonal(), 1e-13);
    const GridSize<2> size = other.Size<2>();
    const std::array<double, 3> end{ static_cast<double>(size[0]), static_cast<double>(size[1]) };
    EXPECT_TRUE(physical<2>(other, {}).isApprox(physical<2>(points, {}), 1e-13));
    EXPECT_TRUE(physical<2>(other, end).isApprox(physical<2>(points, { 4.0, 8.0 }), 1e-13));
  }
  EXPECT_EQ(points.WithValues({ 9, 1, 3 }).NumberOfValues(), (std::array<int, 3>{ 9, 1, 3 }));
  EXPECT_EQ(points.WithValues({ 0, 0, 0 }).NumberOfValues(), points.NumberOfValues());
  EXPECT_FALSE(points.WithDualCells().IsOnPoints());
  EXPECT_EQ(points.WithDualCells().NumberOfValues(), points.NumberOfValues());
}

TEST(ImageGrid, MoreCellsAround)
{
  for (const bool onPoints : { true, false })
  {
    const ImageGrid grid({ 2, 5, 1, 1, 0, 7 }, origin, spacing, oblique(), onPoints);
    const ImageGrid grown = grid.Grown({ 3, 2, 0 });
    EXPECT_EQ(grown.Extent(), (std::array<int, 6>{ -1, 8, 1, 1, -2, 9 }));
    EXPECT_EQ(grown.CellMeasure(), grid.CellMeasure());
    EXPECT_EQ(grown.Size<2>()[0], grid.Size<2>()[0] + 6);
    EXPECT_EQ(grown.Size<2>()[1], grid.Size<2>()[1] + 4);
    // The same places, to the last bit.
    EXPECT_EQ(physical<2>(grown, { 3.5, 4.0 }), physical<2>(grid, { 0.5, 2.0 }));
    EXPECT_EQ(grid.Grown({ 0, 0, 0 }), grid);
  }
}

TEST(ImageGrid, MirroredVolumes)
{
  Matrix mirror = oblique();
  const std::array<int, 6> extent{ 0, 1, 0, 1, 0, 1 };
  EXPECT_FALSE(ImageGrid(extent, origin, spacing, mirror, false).IsMirrored());
  mirror.col(1) = -mirror.col(1);
  EXPECT_TRUE(ImageGrid(extent, origin, spacing, mirror, false).IsMirrored());
  EXPECT_FALSE(ImageGrid({ 0, 1, 0, 1, 0, 0 }, origin, spacing, mirror, false).IsMirrored());
}

TEST(ImageGrid, PlaceInAnotherLattice)
{
  const Matrix turned(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY()).toRotationMatrix());
  const ImageGrid lattice({ 0, 4, 0, 3, 0, 0 }, origin, spacing, turned, false);
  const Eigen::Vector3d steps(3.0, -2.0, 0.0);
  const auto moved = [&](const Eigen::Vector3d& by, const Eigen::Vector3d& sides) {
    const Eigen::Vector3d offset = Eigen::Vector3d(spacing).cwiseProduct(by);
    return ImageGrid({ 1, 2, 5, 6, 0, 0 }, origin + turned * offset, sides, turned, false);
  };
  EXPECT_EQ(extentIn(lattice, moved(steps, spacing)), (std::array<int, 6>{ 4, 5, 3, 4, 0, 0 }));
  EXPECT_FALSE(extentIn(lattice, moved({ 0.5, 0.0, 0.0 }, spacing)));
  EXPECT_FALSE(extentIn(lattice, moved(steps, 1.01 * spacing)));
  EXPECT_FALSE(extentIn(lattice, moved({ 3e9, 0.0, 0.0 }, spacing)));
  EXPECT_FALSE(extentIn(ImageGrid({ 0, 4, 0, 3, 0, 2 }, origin, spacing, turned, false), lattice));
}

TEST(ImageGrid, WhatHasNoCells)
{
  const std::array<int, 6> extent{ 0, 4, 0, 3, 0, 2 };
  EXPECT_TRUE(ImageGrid().IsEmpty());
  EXPECT_FALSE(ImageGrid().HasCells());
  EXPECT_FALSE(ImageGrid({ 3, 3, 2, 2, 1, 1 }, origin, spacing, oblique(), false).HasCells());
  EXPECT_TRUE(ImageGrid(extent, origin, spacing, oblique(), false).HasCells());

  Matrix flat = Matrix::Identity();
  flat.col(2) = flat.col(0) + flat.col(1);
  EXPECT_FALSE(ImageGrid(extent, origin, spacing, flat, false).HasCells());
  Matrix sheared = Matrix::Identity();
  sheared(0, 1) = 1e3;
  EXPECT_TRUE(ImageGrid(extent, origin, spacing, sheared, false).HasCells());
  sheared(0, 1) = 2147483647.0;
  EXPECT_FALSE(ImageGrid(extent, origin, spacing, sheared, false).HasCells());
  const Eigen::Vector3d none(1.0, 0.0, 1.0);
  EXPECT_FALSE(ImageGrid(extent, origin, none, Matrix::Identity(), false).HasCells());
  const Eigen::Vector3d lost(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  EXPECT_FALSE(ImageGrid(extent, lost, spacing, Matrix::Identity(), false).HasCells());
  const Eigen::Vector3d huge(1e308, 1e308, 1e308);
  EXPECT_FALSE(ImageGrid(extent, origin, huge, Matrix::Identity(), false).HasCells());
  // Lengths whose squares are beyond the doubles are fine.
  const Eigen::Vector3d long1(1e200, 1.0, 1.0);
  EXPECT_TRUE(ImageGrid({ 0, 4, 0, 0, 0, 0 }, origin, long1, Matrix::Identity(), false).HasCells());
}

} // namespace
} // namespace RectifiedTransport
