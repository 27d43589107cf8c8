// SPDX-License-Identifier: BSD-3-Clause
// The pixels that a resolution means in a box, and what users are told of them.
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"
#include "Core/SiteCells/LabelPixels.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{

namespace
{

constexpr double Square[6] = { 0.0, 2.0, 0.0, 1.0, 3.0, 3.0 };
constexpr double Cube[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };

} // namespace

TEST(LabelPixels, TheDimensionChoosesTheirNumber)
{
  EXPECT_EQ(describeValues(labelPixels(gridOfBox(Square), 0)), "512 x 256");
  EXPECT_EQ(describeValues(labelPixels(gridOfBox(Cube), 0)), "64 x 64 x 64");
  EXPECT_EQ(describeValues(labelPixels(gridOfBox(Cube), 20)), "20 x 20 x 20");
}

TEST(LabelPixels, TheirMemoryAndWhatHelpsIsSaid)
{
  EXPECT_EQ(
    describeLabelPixels(labelPixels(gridOfBox(Cube), 0)), "64 x 64 x 64 pixels take about 10.7 MB");
  const ImageGrid many = labelPixels(gridOfBox(Cube), 512);
  EXPECT_TRUE(areManyPixels(many));
  EXPECT_EQ(describeLabelPixels(many),
    "512 x 512 x 512 pixels take about 5.5 GB; a lower Resolution is quicker");
  EXPECT_FALSE(areManyPixels(labelPixels(gridOfBox(Cube), 200)));
}

TEST(LabelPixels, AResolutionOutOfRangeIsRefused)
{
  EXPECT_THROW(labelPixels(gridOfBox(Square), -1), Failure);
}

} // namespace RectifiedTransport
