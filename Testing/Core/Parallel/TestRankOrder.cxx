// SPDX-License-Identifier: BSD-3-Clause
// Elements of several ranks in the order of their keys, and sums in that order.
#include "ThreadRanks.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/RankOrder.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Reduction.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

struct Element
{
  std::int64_t Key;
  double Value;
};

double valueOf(std::int64_t i)
{
  return unitReal(randomWord(7, static_cast<std::uint64_t>(i))) - 0.3;
}

// The elements of all ranks: rank r has those whose number modulo 7 it is given.
std::vector<std::vector<Element>> elementsOf(
  int ranks, std::int64_t count, const std::function<std::int64_t(std::int64_t)>& key)
{
  std::vector<std::vector<Element>> elements(static_cast<std::size_t>(ranks));
  for (std::int64_t i = 0; i < count; ++i)
  {
    // Rank 1 has none.
    const std::int64_t owner = i * 5 % 7 % ranks;
    elements[static_cast<std::size_t>(owner == 1 ? 0 : owner)].push_back({ key(i), valueOf(i) });
  }
  return elements;
}

void check(int ranks, std::int64_t count, std::int64_t grain, bool hasKeys,
  const std::function<std::int64_t(std::int64_t)>& key)
{
  const auto elements = elementsOf(ranks, count, key);
  std::vector<Element> sorted;
  for (const std::vector<Element>& own : elements)
  {
    sorted.insert(sorted.end(), own.begin(), own.end());
  }
  const SerialExecutor serialAlone;
  Progress alone{ Context(serialAlone) };
  if (hasKeys)
  {
    sortByKey(sorted, alone);
  }
  const double chunks = reduceChunks(
    alone, count, grain, 0.0,
    [&](std::int64_t first, std::int64_t last) {
      double sum = 0.0;
      for (std::int64_t i = first; i < last; ++i)
      {
        sum += sorted[static_cast<std::size_t>(i)].Value;
      }
      return sum;
    },
    std::plus<>());
  double inOrder = 0.0;
  for (const Element& element : sorted)
  {
    inOrder += element.Value;
  }

  std::vector<std::vector<double>> brought(static_cast<std::size_t>(ranks));
  runOnRanks(ranks, [&](const Ranks& group) {
    const auto own = static_cast<std::size_t>(group.Own());
    std::vector<std::int64_t> keys;
    std::vector<double> values;
    for (const Element& element : elements[own])
    {
      keys.push_back(element.Key);
      values.push_back(element.Value);
    }
    const SerialExecutor serial;
    Progress progress{ Context(serial) };
    const RankOrder order(static_cast<std::int64_t>(keys.size()), hasKeys ? keys.data() : nullptr,
      grain, group, progress);
    brought[own] =
      order.Redistribute([&](std::int64_t i) { return values[static_cast<std::size_t>(i)]; });
    const std::vector<double>& share = brought[own];
    EXPECT_EQ(order.Count(), static_cast<std::int64_t>(share.size()));
    EXPECT_EQ(sumChunks(share.data(), order.Count(), grain, group), chunks);
    const auto add = [&](double& sum) { sum = std::accumulate(share.begin(), share.end(), sum); };
    EXPECT_EQ(sumInTurn(group, 0.0, add), inOrder);
  });
  std::vector<double> all;
  for (const std::vector<double>& share : brought)
  {
    all.insert(all.end(), share.begin(), share.end());
  }
  ASSERT_EQ(all.size(), sorted.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    ASSERT_EQ(all[i], sorted[i].Value) << i;
  }
}

TEST(RankOrder, Keys)
{
  for (const int ranks : { 1, 2, 3, 5 })
  {
    for (const std::int64_t grain : { 1, 10, 4096 })
    {
      check(ranks, 1000, grain, false, [](std::int64_t i) { return i; });
      check(ranks, 1000, grain, true, [](std::int64_t i) { return 999 - i; });
      check(ranks, 1000, grain, true, [](std::int64_t i) { return i * i % 37 - 5; });
      check(ranks, 1000, grain, true, [](std::int64_t) { return 4; });
    }
  }
}

TEST(RankOrder, FewAndNone)
{
  for (const int ranks : { 1, 2, 5 })
  {
    for (const std::int64_t count : { 0, 1, 3 })
    {
      check(ranks, count, 2, false, [](std::int64_t i) { return i; });
      check(ranks, count, 2, true, [](std::int64_t i) { return -i; });
    }
  }
}

TEST(RankOrder, AllIntegersAreKeys)
{
  using Limits = std::numeric_limits<std::int64_t>;
  check(4, 1000, 3, true, [](std::int64_t i) {
    return i == 500 ? Limits::max()
      : i == 501    ? Limits::min()
                    : static_cast<std::int64_t>(randomWord(3, static_cast<std::uint64_t>(i)));
  });
}

TEST(RankShare, KnowsWhoHasAnItem)
{
  for (const std::int64_t count : { 0, 1, 4, 5, 23 })
  {
    for (int rank = 0; rank < 5; ++rank)
    {
      const RankShare share(count, 5, rank);
      for (std::int64_t i = share.First; i < share.First + share.Count; ++i)
      {
        EXPECT_EQ(RankShare::Of(i, count, 5), rank);
      }
    }
  }
}

TEST(KeySort, LongAndStable)
{
  struct Keyed
  {
    std::uint64_t Key;
    std::size_t Number;
  };
  std::vector<Keyed> elements;
  for (std::size_t i = 0; i < 300000; ++i)
  {
    elements.push_back({ randomWord(5, i) % 1000, i });
  }
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  sortByKey(elements, progress);
  for (std::size_t i = 1; i < elements.size(); ++i)
  {
    const Keyed& before = elements[i - 1];
    ASSERT_TRUE(before.Key < elements[i].Key ||
      (before.Key == elements[i].Key && before.Number < elements[i].Number));
  }
}

} // namespace
} // namespace RectifiedTransport
