// SPDX-License-Identifier: BSD-3-Clause
// Which rank advects what: all items once, about equally many each, and few tables.
#include "Core/Flow/Tiles/TileSchedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Counts = std::vector<std::vector<TileCount>>;
using Units = std::vector<std::vector<TileUnit>>;

std::int64_t itemsOf(const std::vector<TileUnit>& units)
{
  std::int64_t items = 0;
  for (const TileUnit& unit : units)
  {
    items += unit.Count();
  }
  return items;
}

// Of each rank in each tile, all of them once.
void expectAllOnce(const Counts& counts, const Units& units)
{
  std::map<std::pair<std::int64_t, int>, std::vector<TileVisit>> visits;
  ASSERT_EQ(units.size(), counts.size());
  for (const std::vector<TileUnit>& those : units)
  {
    std::vector<std::int64_t> tiles;
    for (const TileUnit& unit : those)
    {
      tiles.push_back(unit.Tile);
      EXPECT_GT(unit.Count(), 0);
      for (const TileVisit& visit : unit.Visits)
      {
        visits[{ unit.Tile, visit.From }].push_back(visit);
      }
    }
    std::sort(tiles.begin(), tiles.end());
    EXPECT_EQ(std::adjacent_find(tiles.begin(), tiles.end()), tiles.end()) << "tables twice";
  }
  std::size_t found = 0;
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    for (const TileCount& count : counts[rank])
    {
      auto those = visits[{ count.Tile, static_cast<int>(rank) }];
      std::sort(those.begin(), those.end(),
        [](const TileVisit& a, const TileVisit& b) { return a.First < b.First; });
      std::int64_t next = 0;
      for (const TileVisit& visit : those)
      {
        EXPECT_EQ(visit.First, next);
        EXPECT_GT(visit.End, visit.First);
        next = visit.End;
      }
      EXPECT_EQ(next, count.Items);
      ++found;
    }
  }
  EXPECT_EQ(visits.size(), found);
}

TEST(TileSchedule, RanksKeepWhatPaysForItsTables)
{
  const Counts counts = { { { 0, 900 }, { 3, 1000 } }, { { 0, 1100 }, { 3, 800 } } };
  const Units units = scheduleTiles(counts, 100.0);
  expectAllOnce(counts, units);
  for (std::size_t rank = 0; rank < units.size(); ++rank)
  {
    for (const TileUnit& unit : units[rank])
    {
      ASSERT_EQ(unit.Visits.size(), 1u);
      EXPECT_EQ(unit.Visits[0].From, static_cast<int>(rank));
    }
  }
  EXPECT_EQ(units[0].front().Tile, 3); // the largest first
  EXPECT_EQ(units[1].front().Tile, 0);
}

TEST(TileSchedule, FewItemsShareTables)
{
  const Counts counts = { { { 0, 10 }, { 1, 5 } }, { { 0, 7 }, { 1, 9 } }, { { 0, 2 } } };
  const Units units = scheduleTiles(counts, 100.0);
  expectAllOnce(counts, units);
  std::size_t tables = 0;
  for (const std::vector<TileUnit>& those : units)
  {
    tables += those.size();
    EXPECT_LE(those.size(), 1u);
  }
  EXPECT_EQ(tables, 2u);
}

TEST(TileSchedule, WhatOneRankHasIsDivided)
{
  const Counts counts = { { { 5, 40000 } }, {}, {}, {} };
  const Units units = scheduleTiles(counts, 100.0);
  expectAllOnce(counts, units);
  for (const std::vector<TileUnit>& those : units)
  {
    EXPECT_LE(itemsOf(those), 11250);
    EXPECT_GE(itemsOf(those), 6000);
  }
}

TEST(TileSchedule, NothingToDo)
{
  const Units units = scheduleTiles({ {}, {} }, 100.0);
  ASSERT_EQ(units.size(), 2u);
  EXPECT_TRUE(units[0].empty() && units[1].empty());
}

// Whatever ranks have, none gets much more than its part, or what tables pay for.
TEST(TileSchedule, RandomCounts)
{
  std::mt19937_64 engine(3);
  const auto number = [&engine](std::int64_t below) {
    return static_cast<std::int64_t>(engine() % static_cast<std::uint64_t>(below));
  };
  for (int round = 0; round < 300; ++round)
  {
    Counts counts(static_cast<std::size_t>(1 + number(9)));
    std::int64_t all = 0;
    for (std::vector<TileCount>& those : counts)
    {
      for (std::int64_t tile = 0; tile < 12; ++tile)
      {
        const std::int64_t items = number(2) * number(std::int64_t{ 1 } << number(18));
        if (items > 0)
        {
          those.push_back({ tile, items });
          all += items;
        }
      }
    }
    constexpr double tables = 50.0;
    const Units units = scheduleTiles(counts, tables);
    expectAllOnce(counts, units);
    const double part = static_cast<double>(all) / static_cast<double>(counts.size());
    for (const std::vector<TileUnit>& those : units)
    {
      EXPECT_LE(static_cast<double>(itemsOf(those)), std::max(1.125 * part, 200.0) + 200.0);
    }
  }
}

} // namespace
} // namespace RectifiedTransport
