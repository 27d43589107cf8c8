// SPDX-License-Identifier: BSD-3-Clause
// Numbers that neighbouring site cells do not share.
#include "Core/SiteCells/SiteColors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Labels = std::vector<std::int64_t>;
using Colours = std::vector<std::uint8_t>;

TEST(SiteColors, LeastThatNoNeighbourHas)
{
  // 0 0 1 1     a board of two colours, and a site that has no pixel
  // 0 0 1 1
  // 3 3 2 2
  const Labels labels = { 0, 0, 1, 1, 0, 0, 1, 1, 3, 3, 2, 2 };
  EXPECT_EQ(colourSiteCells<2>({ 4, 3 }, labels.data(), 5), (Colours{ 0, 1, 0, 1, 0 }));
  EXPECT_EQ(colourSiteCells<1>({ 12 }, labels.data(), 5), (Colours{ 0, 1, 0, 2, 0 }));
}

// Corners alone do not touch.
TEST(SiteColors, AcrossCorners)
{
  const Labels labels = { 0, 1, 1, 2 };
  EXPECT_EQ(colourSiteCells<2>({ 2, 2 }, labels.data(), 3), (Colours{ 0, 1, 0 }));
}

// What is of no site is nobody's neighbour.
TEST(SiteColors, AcrossPixelsOfNone)
{
  const Labels labels = { 0, -1, 1, 2 };
  EXPECT_EQ(colourSiteCells<1>({ 4 }, labels.data(), 3), (Colours{ 0, 0, 1 }));
}

TEST(SiteColors, DifferAcrossEveryFace)
{
  const GridSize<3> size = { 9, 8, 7 };
  Labels labels(9 * 8 * 7);
  std::uint32_t state = 1;
  std::generate(labels.begin(), labels.end(), [&state]() {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::int64_t>(state >> 25);
  });
  const Colours colours = colourSiteCells<3>(size, labels.data(), 128);
  const auto colourAt = [&](std::int64_t pixel) {
    return colours[static_cast<std::size_t>(labels[static_cast<std::size_t>(pixel)])];
  };
  std::int64_t stride = 1;
  int faces = 0;
  for (std::int64_t count : size)
  {
    for (std::int64_t pixel = 0; pixel < 9 * 8 * 7; ++pixel)
    {
      const std::int64_t next = pixel + stride;
      if (pixel / stride % count + 1 < count &&
        labels[static_cast<std::size_t>(pixel)] != labels[static_cast<std::size_t>(next)])
      {
        EXPECT_NE(colourAt(pixel), colourAt(next));
        ++faces;
      }
    }
    stride *= count;
  }
  EXPECT_GT(faces, 1000);
}

// A site with more neighbours than there are bytes has the last one.
TEST(SiteColors, MoreNeighboursThanNumbers)
{
  constexpr std::int64_t sites = 300;
  Labels labels;
  for (std::int64_t high = 1; high < sites; ++high)
  {
    for (std::int64_t low = 0; low < high; ++low)
    {
      labels.insert(labels.end(), { high, low });
    }
  }
  const Colours colours =
    colourSiteCells<1>({ static_cast<std::int64_t>(labels.size()) }, labels.data(), sites);
  EXPECT_EQ(colours[254], 254);
  EXPECT_EQ(colours[255], 255);
  EXPECT_EQ(colours[299], 255);
}

} // namespace
} // namespace RectifiedTransport
