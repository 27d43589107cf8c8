// SPDX-License-Identifier: BSD-3-Clause
// Boxes of an image's tuples, and their exchange between ranks.
#include "Core/Geometry/Distributed/BoxExchange.h"
#include "Core/Geometry/Distributed/PlaceOwners.h"

#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

const Extent whole = { 0, 4, 0, 3, 7, 7 };

TEST(TupleBoxes, AreThoseOfExtents)
{
  const Extent part = { 1, 3, 2, 3, 7, 7 };
  for (const int owner : { OfPoints, OfCells })
  {
    EXPECT_EQ(extentOf(tuplesOf(part, owner, whole), owner, whole), part);
  }
  EXPECT_EQ(tuplesOf(part, OfPoints, whole).Count(), 6);
  EXPECT_EQ(tuplesOf(part, OfCells, whole).Count(), 2);
  EXPECT_EQ(tuplesOf(emptyExtent, OfPoints, whole).Count(), 0);
  EXPECT_EQ(intersectionOf(part, { 3, 9, 0, 2, 7, 7 }), (Extent{ 3, 3, 2, 2, 7, 7 }));
  EXPECT_EQ(intersectionOf(part, { 4, 9, 0, 2, 7, 7 }), emptyExtent);
  EXPECT_EQ(describe(tuplesOf(part, OfPoints, whole)), "[1, 3] x [2, 3] x [7, 7]");
}

// What is left without boxes covers each tuple once, and none of those of the boxes.
TEST(TupleBoxes, AreSubtracted)
{
  const TupleBox all{ {}, { 5, 4, 3 } };
  const std::vector<TupleBox> taken = { { { 1, 1, 1 }, { 2, 2, 1 } }, { { 0, 0, 0 }, { 5, 1, 3 } },
    { { 9, 9, 9 }, { 1, 1, 1 } } };
  std::vector<TupleBox> left = { all };
  for (const TupleBox& box : taken)
  {
    subtract(box, left);
  }
  for (std::int64_t i = 0; i < all.Count(); ++i)
  {
    const GridSize<3> tuple = all.CellOf(i);
    int covered = 0;
    for (const TupleBox& box : left)
    {
      covered += box.Contains(tuple) ? 1 : 0;
    }
    EXPECT_EQ(covered, taken[0].Contains(tuple) || taken[1].Contains(tuple) ? 0 : 1);
  }
}

// Three ranks hold layers, two of them a common one, and each wants another part.
TEST(BoxExchange, BringsWantedTuples)
{
  const TupleBox all{ {}, { 4, 6, 1 } };
  const std::vector<TupleBox> held = { { { 0, 0, 0 }, { 4, 3, 1 } }, { { 0, 2, 0 }, { 4, 2, 1 } },
    { { 0, 4, 0 }, { 4, 2, 1 } } };
  runOnRanks(3, [&](const Ranks& ranks) {
    const auto own = static_cast<std::size_t>(ranks.Own());
    const TupleBox wanted{ { ranks.Own(), 1, 0 }, { 2, 4, 1 } };
    std::vector<std::int64_t> from(static_cast<std::size_t>(held[own].Count()));
    for (std::int64_t i = 0; i < held[own].Count(); ++i)
    {
      const GridSize<3> tuple = held[own].CellOf(i);
      // The layer that two ranks hold comes from the lower one.
      from[static_cast<std::size_t>(i)] = 100 * (tuple[1] == 2 ? own : 0) + all.NumberOf(tuple);
    }
    std::vector<std::int64_t> to(static_cast<std::size_t>(wanted.Count()), -1);
    exchangeBoxes(
      held, wanted, ranks, TupleMemory::Of(from.data(), 1), TupleMemory::Of(to.data(), 1));
    for (std::int64_t i = 0; i < wanted.Count(); ++i)
    {
      EXPECT_EQ(to[static_cast<std::size_t>(i)], all.NumberOf(wanted.CellOf(i)));
    }
  });
}

TEST(BoxExchange, CompletesTuplesInPlace)
{
  const TupleBox all{ {}, { 3, 4, 2 } };
  const std::vector<TupleBox> held = { { {}, { 3, 2, 2 } }, { { 0, 2, 0 }, { 3, 2, 2 } } };
  runOnRanks(2, [&](const Ranks& ranks) {
    std::vector<double> values(static_cast<std::size_t>(2 * all.Count()), -1.0);
    const auto tell = [&](std::int64_t i) {
      return held[static_cast<std::size_t>(ranks.Own())].Contains(all.CellOf(i));
    };
    for (std::int64_t i = 0; i < all.Count(); ++i)
    {
      for (std::int64_t c = 2 * i; c < 2 * i + 2; ++c)
      {
        values[static_cast<std::size_t>(c)] = tell(i) ? static_cast<double>(c) : -1.0;
      }
    }
    completeBoxes(held, all, all, ranks, TupleMemory::Of(values.data(), 2));
    for (std::size_t c = 0; c < values.size(); ++c)
    {
      EXPECT_EQ(values[c], static_cast<double>(c));
    }
  });
}

// Where a rank has no array the others get zeros.
TEST(BoxExchange, SendsZerosForNone)
{
  const std::vector<TupleBox> held = { { {}, { 2, 1, 1 } }, { { 2, 0, 0 }, { 2, 1, 1 } } };
  runOnRanks(2, [&](const Ranks& ranks) {
    std::vector<char> from = { 5, 6 };
    std::vector<char> to(4, 9);
    exchangeBoxes(held, { {}, { 4, 1, 1 } }, ranks,
      ranks.IsFirst() ? TupleMemory{} : TupleMemory::Of(from.data(), 1),
      TupleMemory::Of(to.data(), 1));
    EXPECT_EQ(to, (std::vector<char>{ 0, 0, 5, 6 }));
  });
}

TEST(TupleMemory, PacksTuplesForTheirOwners)
{
  const std::vector<int> owner = { 1, 0, 1 };
  std::vector<int> values = { 10, 11, 20, 21, 30, 31 };
  const std::vector<Bytes> parts =
    packTuples(TupleMemory::Of(values.data(), 1), 2, owner, { 1, 2 });
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].size(), 2 * sizeof(int));
  std::vector<int> back(6);
  unpackTuples({ parts[1], parts[0] }, TupleMemory::Of(back.data(), 1));
  EXPECT_EQ(back, (std::vector<int>{ 10, 11, 30, 31, 20, 21 }));
}

// The lowest rank that holds a cell owns it; where one holds all, the pieces count.
TEST(PlaceOwners, AreTheLowestThatHoldACell)
{
  const ImageGrid grid({ 0, 4, 0, 2, 0, 0 }, Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(),
    ImageGrid::Matrix::Identity(), false);
  const std::vector<Extent> halves = { { 0, 2, 0, 2, 0, 0 }, { 2, 4, 0, 2, 0, 0 } };
  const std::vector<Extent> held = { { 0, 1, 0, 2, 0, 0 }, { 0, 4, 0, 1, 0, 0 },
    { 1, 4, 1, 2, 0, 0 } };
  const double places[4][3] = { { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 }, { 1.5, 1.5, 0 }, { -9, 9, 0 } };
  runOnRanks(3, [&](const Ranks& ranks) {
    const PlaceOwners owners(grid, held, {}, ranks);
    EXPECT_EQ(owners.OwnExtent(), held[static_cast<std::size_t>(ranks.Own())]);
    const int expected[4] = { 0, 1, 2, 0 };
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_EQ(owners.OwnerOf(places[i]), expected[i]);
    }
  });
  runOnRanks(2, [&](const Ranks& ranks) {
    for (const bool isWhole : { false, true })
    {
      const PlaceOwners owners(grid,
        isWhole ? std::vector<Extent>{ grid.Extent(), halves[1] } : std::vector<Extent>(), halves,
        ranks);
      EXPECT_EQ(owners.OwnerOf(places[1]), 0);
      EXPECT_EQ(owners.OwnerOf(std::vector<double>{ 2.5, 0.5, 0.0 }.data()), 1);
    }
  });
}

} // namespace
} // namespace RectifiedTransport
