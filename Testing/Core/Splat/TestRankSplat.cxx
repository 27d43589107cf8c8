// SPDX-License-Identifier: BSD-3-Clause
// The splat of the particles of several ranks has the bits of one rank.
#include "TestSplat.h"
#include "ThreadRanks.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankOrder.h"
#include "Core/Splat/RankSplat.h"
#include "Core/Splat/SplatMass.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

// Every third particle is of rank 2, the others of rank 0; rank 1 has none.
struct Shares
{
  std::vector<Cloud<2>> Clouds{ 3 };
  std::vector<std::vector<std::int64_t>> Keys{ 3 };
};

Shares sharesOf(const Cloud<2>& cloud)
{
  Shares shares;
  for (std::int64_t i = 0; i < cloud.Count(); ++i)
  {
    const std::size_t rank = i % 3 == 0 ? 2 : 0;
    const auto at = static_cast<std::size_t>(i);
    shares.Clouds[rank].Add({ cloud.Points[3 * at], cloud.Points[3 * at + 1] }, cloud.Masses[at]);
    shares.Keys[rank].push_back(i);
  }
  return shares;
}

Cloud<2> joined(const Shares& shares)
{
  Cloud<2> all;
  for (const Cloud<2>& cloud : shares.Clouds)
  {
    all.Points.insert(all.Points.end(), cloud.Points.begin(), cloud.Points.end());
    all.Masses.insert(all.Masses.end(), cloud.Masses.begin(), cloud.Masses.end());
  }
  return all;
}

// Rank 0 wants two rows, rank 1 nothing, rank 2 an inner part of the rest and one of the rows.
std::vector<LatticePart<2>> wantedOf(const GridSize<2>& size)
{
  return { { { 0, 0 }, { size[0], 2 } }, { { 0, 0 }, { 0, 0 } },
    { { 3, 1 }, { size[0] - 5, size[1] - 2 } } };
}

void check(SplatKernel kernel, bool hasKeys)
{
  const GridSize<2> size{ 20, 11 };
  const Cloud<2> cloud = randomCloud<2>(size, 3000, -0.3, false);
  const Shares shares = sharesOf(cloud);
  const SplatOptions options = splatOptions(kernel, SplatBoundary::Drop);
  // Without keys those of rank 0 come first.
  const Splatted whole = splat((hasKeys ? cloud : joined(shares)).Particles(), size, options);
  const std::vector<LatticePart<2>> wanted = wantedOf(size);
  runOnRanks(3, [&](const Ranks& ranks) {
    const auto own = static_cast<std::size_t>(ranks.Own());
    const SerialExecutor serial;
    Context context(serial);
    context.Group = &ranks;
    Progress progress(context);
    std::vector<double> cells(static_cast<std::size_t>(wanted[own].Count()), -7.0);
    const std::int64_t outside = splatOnRanks<2, double>(shares.Clouds[own].Particles(),
      hasKeys ? shares.Keys[own].data() : nullptr, size, wanted[own], options, 1.0, cells.data(),
      progress);
    EXPECT_EQ(outside, whole.Outside);
    const auto grid = LatticePart<2>::WholeOf(size);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      const std::int64_t cell = grid.NumberOf(wanted[own].CellOf(static_cast<std::int64_t>(i)));
      wrong += cells[i] != whole.Cells[static_cast<std::size_t>(cell)] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0u) << "kernel " << static_cast<int>(kernel);
  });
}

TEST(RankSplat, HasTheBitsOfOneRank)
{
  for (const SplatKernel kernel : allKernels)
  {
    check(kernel, true);
    check(kernel, false);
  }
}

// The sums of the shares of ranks have the bits of one rank's sum.
TEST(SplatMass, IsThatOfOneRank)
{
  for (const GridSize<3>& size : { GridSize<3>{ 50, 40, 31 }, GridSize<3>{ 20000, 3, 1 },
         GridSize<3>{ 90001, 1, 1 }, GridSize<3>{ 7, 1, 2 } })
  {
    const auto whole = LatticePart<3>::WholeOf(size);
    std::vector<double> cells(static_cast<std::size_t>(whole.Count()));
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      cells[i] = unitReal(randomWord(3, i));
    }
    const SerialExecutor serial;
    Progress alone{ Context(serial) };
    const double sum = sumOfCells(cells.data(), whole.Count(), alone);
    runOnRanks(3, [&](const Ranks& ranks) {
      const CellShare share(whole, ranks.Count(), ranks.Own());
      const std::int64_t layers = share.Layers.IsEmpty() ? 0 : share.Layers.Count();
      EXPECT_LE(share.First + share.Count, std::max(layers, share.First));
      const double* first =
        cells.data() + (layers > 0 ? whole.NumberOf(share.Layers.Low) : 0) + share.First;
      EXPECT_EQ(sumChunks(first, share.Count, splatSumChunk, ranks), sum);
    });
  }
}

} // namespace
} // namespace RectifiedTransport
