// SPDX-License-Identifier: BSD-3-Clause
// Which cells finer boxes cover, against a search of all cells.
#include "Core/Geometry/CoveredParts.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace RectifiedTransport
{
namespace
{

using Part = LatticePart<2>;

std::vector<Part> randomParts(std::mt19937& engine, int count, int reach, int widest)
{
  std::uniform_int_distribution<std::int64_t> low(-reach, reach);
  std::uniform_int_distribution<std::int64_t> side(1, widest);
  std::vector<Part> parts;
  for (int i = 0; i < count; ++i)
  {
    parts.push_back({ { low(engine), low(engine) }, { side(engine), side(engine) } });
  }
  return parts;
}

TEST(CoveredParts, Coarsened)
{
  const Part coarse = coarsened(Part{ { -5, 3 }, { 4, 6 } }, 4);
  EXPECT_EQ(coarse.Low, (GridSize<2>{ -2, 0 }));
  EXPECT_EQ(coarse.Cells, (GridSize<2>{ 2, 3 }));
}

TEST(CoveredParts, AllCells)
{
  std::mt19937 engine(3);
  for (int run = 0; run < 20; ++run)
  {
    const std::vector<Part> coarse = randomParts(engine, 12, 10, 6);
    const std::vector<Part> fine = randomParts(engine, 8, 25, 9);
    std::set<std::pair<std::size_t, GridSize<2>>> found;
    visitCovered(coarse, fine, 3, [&](std::size_t i, const Part& covered) {
      for (std::int64_t n = 0; n < covered.Count(); ++n)
      {
        found.insert({ i, covered.CellOf(n) });
      }
    });
    std::set<std::pair<std::size_t, GridSize<2>>> expected;
    for (std::size_t i = 0; i < coarse.size(); ++i)
    {
      for (const Part& part : fine)
      {
        for (std::int64_t n = 0; n < part.Count(); ++n)
        {
          const GridSize<2> cell = part.CellOf(n);
          const GridSize<2> around = coarsened(Part{ cell, { 1, 1 } }, 3).Low;
          if (coarse[i].Contains(around))
          {
            expected.insert({ i, around });
          }
        }
      }
    }
    EXPECT_EQ(found, expected);
  }
}

} // namespace
} // namespace RectifiedTransport
