// SPDX-License-Identifier: BSD-3-Clause
// What data sets on several ranks have in common: arrays, points, images, properties.
#include "Core/Geometry/Distributed/ArrayKinds.h"
#include "Core/Geometry/Distributed/DuplicatePoints.h"
#include "Core/Geometry/Distributed/ImagePiece.h"
#include "Core/Geometry/Distributed/PropertyDifference.h"

#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(ArrayKinds, SurviveAsText)
{
  const ArrayKinds kinds = { { 0, 11, 3, -1, "a \"name\"\nin two lines", { "x", "", "z" } },
    { 1, 3, 1, 0, "", {} } };
  const ArrayKinds back = kindsOfText(textOfKinds(kinds));
  ASSERT_EQ(back.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_TRUE(back[i].IsLike(kinds[i]));
    EXPECT_EQ(back[i].Attribute, kinds[i].Attribute);
    EXPECT_EQ(back[i].ComponentNames, kinds[i].ComponentNames);
  }
}

TEST(ArrayKinds, AreCommonToAllLists)
{
  const ArrayKind mass{ 0, 11, 1, -1, "mass", {} };
  const ArrayKind single{ 0, 10, 1, -1, "mass", {} };
  const ArrayKind ghosts{ 0, 3, 1, -1, "ghosts", {} };
  const ArrayKind other{ 1, 11, 1, -1, "other", {} };
  const ArrayKinds common = commonKinds({ { other, mass }, { mass, ghosts, single } }, "ghosts");
  ASSERT_EQ(common.size(), 2U);
  EXPECT_TRUE(common[0].IsLike(mass));
  EXPECT_TRUE(common[1].IsLike(ghosts));
}

// Rank r has the points r to r + 3, once each.
TEST(DuplicatePoints, BelongToTheLowestRank)
{
  runOnRanks(3, [](const Ranks& ranks) {
    const auto first = static_cast<std::uint64_t>(ranks.Own());
    const std::vector<unsigned char> repeated = duplicatePoints(
      4,
      [first](std::int64_t i) {
        return PointIdentity{ first + static_cast<std::uint64_t>(i), 7, 0 };
      },
      ranks);
    EXPECT_EQ(repeated,
      ranks.IsFirst() ? std::vector<unsigned char>(4) : std::vector<unsigned char>({ 1, 1, 1, 0 }));
  });
}

ImagePiece pieceOf(const Extent& extent)
{
  ImagePiece piece;
  piece.Points = extent;
  piece.Cells = extent;
  piece.Geometry[3] = 1.0;
  return piece;
}

TEST(ImagePieces, JoinToOneImage)
{
  std::vector<ImagePiece> pieces = { pieceOf(emptyExtent), pieceOf({ 0, 2, 0, 1, 0, 0 }),
    pieceOf({ 2, 5, 0, 1, 0, 0 }) };
  const JoinedPieces joined = joinPieces(pieces);
  EXPECT_EQ(joined.Fault, "");
  EXPECT_EQ(joined.Whole, (Extent{ 0, 5, 0, 1, 0, 0 }));
  EXPECT_EQ(joined.Geometry, pieces[1].Geometry);
  EXPECT_TRUE(isEmpty(joinPieces({ pieceOf(emptyExtent) }).Whole));

  pieces[2].Geometry[3] = 0.5;
  EXPECT_EQ(joinPieces(pieces).Fault,
    "The images of the ranks are not parts of one: the spacing is 1 0 0 on rank 1, but 0.5 0 0 on "
    "rank 2");
  pieces[2] = pieceOf({ 4, 5, 0, 1, 0, 0 });
  EXPECT_EQ(joinPieces(pieces).Fault,
    "The images of the ranks do not fill their common extent: none has the points [3, 3] x [0, 1] "
    "x [0, 0]");
  pieces[2] = pieceOf({ 3, 5, 0, 1, 0, 0 });
  EXPECT_EQ(joinPieces(pieces).Fault,
    "The images of the ranks do not fill their common extent: none has the cells [2, 2] x [0, 0] x "
    "[0, 0]");
}

TEST(ImagePieces, AreWithoutMarkedTuples)
{
  const TupleBox all{ { 5, 0, 0 }, { 3, 2, 1 } };
  const unsigned char flags[6] = { 1, 2, 0, 1, 3, 4 };
  const TupleBox own = boxWithout(all, flags, 1);
  EXPECT_EQ(own.Low, (GridSize<3>{ 6, 0, 0 }));
  EXPECT_EQ(own.Cells, (GridSize<3>{ 2, 2, 1 }));
  EXPECT_TRUE(boxWithout(all, std::vector<unsigned char>(6, 1).data(), 1).IsEmpty());
}

TEST(PropertyDifference, MustBeTheSame)
{
  std::string common;
  EXPECT_EQ(differenceOfTexts({ "", "a", "", "a" }, common), "");
  EXPECT_EQ(common, "a");
  common.clear();
  EXPECT_EQ(differenceOfTexts({ "", "a", "b" }, common), "a on rank 1, but b on rank 2");
  const std::string printed = "Debug: Off\nThreading: Auto\n  Radius: 1\nTableBuildTime: 3\n";
  EXPECT_EQ(differenceOfProperties(
              { printed, "Debug: On\nThreading: Auto\n  Radius: 1\nTableBuildTime: 4\n" }),
    "");
  EXPECT_EQ(differenceOfProperties({ printed, printed, "Threading: Auto\n  Radius: 2\n" }),
    "The property Radius is 1 on rank 0, but 2 on rank 2; it must be the same on all");
}

} // namespace
} // namespace RectifiedTransport
