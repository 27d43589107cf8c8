// SPDX-License-Identifier: BSD-3-Clause
// Cells of equal mass from sites and a grid alone.
#include "Core/SiteCells/SiteCells.h"
#include "TestFlow.h"
#include "TestGrid.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace RectifiedTransport
{
namespace
{

using Labels = std::vector<std::int64_t>;

// Sites in the middles of equal parts of the domain: by symmetry the cells are these parts.
TEST(SiteCellFigures, Quarters)
{
  const auto grid = makeGrid<2>({ 8, 4 }, { 0.5, 2.0, 1.0 }, { 10.0, -4.0, 3.0 });
  const Points<3> sites = { { 11.0, -2.0, 3.0 }, { 13.0, -2.0, 3.0 }, { 11.0, 2.0, 3.0 },
    { 13.0, 2.0, 3.0 } };
  const Labels labels = labelSiteCells<2>(sites, grid);
  const Labels low = { 0, 0, 0, 0, 1, 1, 1, 1 };
  const Labels high = { 2, 2, 2, 2, 3, 3, 3, 3 };
  for (std::size_t row = 0; row < 4; ++row)
  {
    const auto begin = labels.begin() + 8 * static_cast<std::ptrdiff_t>(row);
    EXPECT_EQ(Labels(begin, begin + 8), row < 2 ? low : high) << row;
  }
}

TEST(SiteCellFigures, AnyNumberOfSites)
{
  const GridSize<3> size = { 20, 16, 12 };
  const auto grid = makeGrid<3>(size, { 0.5, 0.75, 1.0 });
  Points<3> sites = randomPoints<3>({ 10, 12, 12 }, 37);
  sites[5] = sites[30]; // they share a cell
  sites[7] = { -3.0, 5.0, 6.0 };
  const SiteCells<3> cells(sites, grid);
  EXPECT_EQ(cells.NumberOutside(), 1);
  Labels labels(3840);
  cells.Label(labels.data());
  EXPECT_EQ(labels, labelSiteCells<3>(sites, grid));
  Labels counts(37, 0);
  for (const std::int64_t label : labels)
  {
    ++counts.at(static_cast<std::size_t>(label));
  }
  for (const std::int64_t count : counts)
  {
    EXPECT_TRUE(count == 103 || count == 104) << count;
  }
}

TEST(SiteCellFigures, WhatIsWrong)
{
  const auto grid = makeGrid<1>({ 2 }, { 1e200, 1.0, 1.0 });
  EXPECT_THROW(SiteCells<1>(Points<3>{ { 0.0 }, { 1.0 }, { 2.0 } }, grid), std::invalid_argument);
}

} // namespace
} // namespace RectifiedTransport
