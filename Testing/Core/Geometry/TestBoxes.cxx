// SPDX-License-Identifier: BSD-3-Clause
// The boxes of images: common ones, those of given sizes, around solids, joined from parts.
#include "Core/Geometry/Boxes/BoxUnion.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/Boxes/SolidGrid.h"
#include "Core/Geometry/InverseMatrix.h"
#include "Core/Messages/Failure.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Values = std::array<int, 3>;

// Cells of a plane at z, from the origin on.
ImageGrid plane(int x, int y, double spacing, double z = 0.0)
{
  return { { 0, x, 0, y, 0, 0 }, Eigen::Vector3d(0.0, 0.0, z),
    Eigen::Vector3d(spacing, spacing, 1.0), ImageGrid::Matrix::Identity(), false };
}

template <class Function>
std::string messageOf(const Function& function)
{
  try
  {
    function();
  }
  catch (const Failure& failure)
  {
    return failure.what();
  }
  return "";
}

TEST(Boxes, AnInverseMakesTheIdentity)
{
  ImageGrid::Matrix matrix;
  matrix << 1.0, 0.25, 0.0, -0.5, 2.0, 0.125, 0.75, 0.0, -1.0;
  EXPECT_TRUE((matrix * inverseOf(matrix)).isApprox(ImageGrid::Matrix::Identity(), 1e-12));
  EXPECT_EQ(inverseOf(ImageGrid::Matrix::Identity()), ImageGrid::Matrix::Identity());
  EXPECT_EQ(inverseOf(ImageGrid::Matrix::Ones()), ImageGrid::Matrix::Zero());
}

TEST(Boxes, ACommonGridHasTheFinestSpacing)
{
  const int any[3] = { 0, 0, 0 };
  const NamedGrid coarse{ plane(4, 2, 1.0), "first" };
  const NamedGrid fine{ plane(8, 4, 0.5), "second" };
  EXPECT_TRUE(commonGrid({ coarse, fine }, any, MostCells::Any) == fine.Grid);
  // No more cells than the larger one has, although the box is that of both.
  const NamedGrid wide{ plane(16, 4, 0.5), "third" };
  const ImageGrid both = commonGrid({ fine, wide }, any, MostCells::OfTheLargest);
  EXPECT_TRUE(both == wide.Grid);
}

TEST(Boxes, RoundedGridsAreTheFirst)
{
  const int any[3] = { 0, 0, 0 };
  const NamedGrid first{ plane(4, 2, 1.0), "first" };
  const NamedGrid rounded{ plane(4, 2, 1.0 + 1e-9), "second" };
  EXPECT_TRUE(commonGrid({ first, rounded }, any, MostCells::Any) == first.Grid);
  EXPECT_TRUE(haveSameCells(first.Grid, rounded.Grid));
  EXPECT_FALSE(haveSameCells(first.Grid, plane(8, 4, 0.5)));
  requireSameBox(first, { plane(8, 4, 0.5), "second" });
}

TEST(Boxes, MessagesNameWhatDiffers)
{
  const NamedGrid first{ plane(4, 2, 1.0), "first" };
  const auto compare = [&](const ImageGrid& other) {
    return messageOf([&]() { requireSameBox(first, { other, "second" }); });
  };
  EXPECT_NE(compare(plane(4, 2, 1.0, 3.0)).find("must lie in one plane"), std::string::npos);
  EXPECT_NE(
    compare(plane(5, 2, 1.0)).find("second reaches from 0 to 5 along x"), std::string::npos);
  EXPECT_NE(compare(plane(4, 0, 1.0)).find("the same number of dimensions"), std::string::npos);
}

TEST(Boxes, SizesAreChecked)
{
  const ImageGrid box = gridOfBox({ 0.0, 2.0, -1.0, 0.0, 3.0, 3.0 });
  EXPECT_EQ(box.Dimension(), 2);
  EXPECT_EQ(gridWithResolution(box, 10, "Resolution").NumberOfValues(), (Values{ 10, 5, 1 }));
  EXPECT_EQ(describeValues(gridWithResolution(box, 10, "Resolution")), "10 x 5");
  EXPECT_EQ(messageOf([&]() { gridWithResolution(box, 0, "Resolution"); }),
    "Resolution is 0; it must be from 1 to 1073741824");
  const int wanted[3] = { 3, 0, 2 };
  EXPECT_EQ(messageOf([&]() { gridWithValues(box, wanted, "Dimensions"); }),
    "Dimensions is 3 0 2; it must be 0 or 1 along z, where the input has one point");
  EXPECT_EQ(cellsOfMargin(plane(10, 5, 1.0), 0.1), (GridSize<3>{ 1, 1, 0 }));
  EXPECT_EQ(describeSize<2>({ 8, 4 }), "8 x 4");
}

TEST(Boxes, CubesCoverASolid)
{
  const ImageGrid grid = solidGrid({ 0.0, 1.0, 0.0, 0.5, 0.0, 0.26 }, 4, 0.0);
  EXPECT_EQ(grid.NumberOfValues(), (Values{ 4, 2, 2 }));
  EXPECT_NE(
    messageOf([&]() { requireSolidGrid(4, -1.0); }).find("Padding is -1"), std::string::npos);
}

TEST(Boxes, TheFirstBoxGivesSharedValues)
{
  const LatticePart<3> all{ {}, { 3, 1, 1 } };
  const unsigned char flags[] = { 0, 1 };
  const UnionBox first{ 0, { {}, { 2, 1, 1 } }, nullptr, 1 };
  const UnionBox second{ 1, { { 1, 0, 0 }, { 2, 1, 1 } }, nullptr, 1 };
  const UnionBox ghosts{ 1, { { 1, 0, 0 }, { 2, 1, 1 } }, flags, 1 };
  const auto owners = [&](const UnionBox& other, bool areSame) {
    ValueOwners found{ std::vector<std::int64_t>(3), std::vector<std::int32_t>(3, -1) };
    const auto same = [&](
                        std::size_t owner, std::int64_t value, std::size_t box, std::int64_t own) {
      EXPECT_TRUE(owner == 0 && value == 1 && box == 1 && own == 0);
      return areSame;
    };
    return findValueOwners({ first, other }, all, same, found) ? found.Boxes
                                                               : std::vector<std::int32_t>();
  };
  EXPECT_EQ(owners(second, true), (std::vector<std::int32_t>{ 0, 0, 1 }));
  EXPECT_TRUE(owners(second, false).empty());
  EXPECT_EQ(owners(ghosts, true), (std::vector<std::int32_t>{ 0, 0, -1 }));
}

} // namespace
} // namespace RectifiedTransport
