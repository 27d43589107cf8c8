// SPDX-License-Identifier: BSD-3-Clause
// Cells of a density that move with particles, by whole cells or not at all.
#include "Core/Blend/AdvectedCells.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankShare.h"
#include "TestDensities.h"
#include "TestDimensions.h"
#include "TestGrid.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class T>
using AdvectedCellsIn = DimensionTest<T>;
TYPED_TEST_SUITE(AdvectedCellsIn, Dimensions);

// Masses in the middle of a grid, and a particle in the middle of each of its cells.
template <int D>
struct Scene
{
  Scene()
    : Size(evenSize<D>(6))
    , Grid(makeGrid<D>(this->Size, { 0.5, 0.25, 2.0 }, { 1.0, 2.0, 3.0 }))
    , Density(sampleDensity<D>(this->Size, [](const Point<D>& p) {
      return p[0] > 0.3 && p[0] < 0.7 ? 1.0 + p[0] + 10.0 * p[D - 1] : 0.0;
    }))
  {
    for (std::int64_t i = 0; i < cellCount<D>(this->Size); ++i)
    {
      const GridSize<D> cell = cellAt<D>(i, this->Size);
      Point<D> index;
      for (int axis = 0; axis < D; ++axis)
      {
        index[axis] = static_cast<double>(cell[axis]) + 0.5;
      }
      Point<3> place;
      this->Grid.template ToPhysical<D>(index.data(), place.data());
      this->From.push_back(place);
    }
  }

  // With the particles of a rank moved by so many cells along the first axis.
  std::vector<double> Add(double cells, const Context& context = Context()) const
  {
    Progress progress(context);
    auto own = LatticePart<D>::WholeOf(this->Size);
    const RankShare share(this->Size[D - 1], progress.Group());
    own.Low[D - 1] = share.First;
    own.Cells[D - 1] = share.Count;
    const std::int64_t layer = own.Count() / std::max<std::int64_t>(1, share.Count);
    const auto first = static_cast<std::size_t>(share.First * layer);
    const std::vector<double> density(
      this->Density.Values.begin() + static_cast<std::ptrdiff_t>(first),
      this->Density.Values.begin() + static_cast<std::ptrdiff_t>(first) + own.Count());
    const std::vector<Point<3>> from(this->From.begin() + static_cast<std::ptrdiff_t>(first),
      this->From.begin() + static_cast<std::ptrdiff_t>(first) + own.Count());
    std::vector<Point<3>> to = from;
    for (Point<3>& point : to)
    {
      point[0] += 0.5 * cells;
    }
    std::vector<double> sum(this->Density.Values.size(), 1.0);
    const AdvectedCells<D> moved{ this->Grid, own, density.data(), from, to };
    addAdvected<D>(moved, LatticePart<D>::WholeOf(this->Size), progress, sum.data());
    return sum;
  }

  GridSize<D> Size;
  ImageGrid Grid;
  TestDensity<D> Density;
  std::vector<Point<3>> From;
};

TYPED_TEST(AdvectedCellsIn, StayWithTheirParticles)
{
  constexpr int D = TypeParam::value;
  const Scene<D> scene;
  const std::vector<double> still = scene.Add(0.0);
  const std::vector<double> moved = scene.Add(1.0);
  for (std::int64_t i = 0; i < cellCount<D>(scene.Size); ++i)
  {
    const auto n = static_cast<std::size_t>(i);
    EXPECT_NEAR(still[n], 1.0 + scene.Density.Values[n], 1e-12);
    const double before = i % 6 == 0 ? 0.0 : scene.Density.Values[n - 1];
    EXPECT_NEAR(moved[n], 1.0 + before, 1e-12);
  }
}

TYPED_TEST(AdvectedCellsIn, AreTheSameOnRanks)
{
  constexpr int D = TypeParam::value;
  const Scene<D> scene;
  const std::vector<double> expected = scene.Add(0.3);
  runOnRanks(3, [&](const Ranks& ranks) {
    Context context;
    context.Group = &ranks;
    EXPECT_EQ(scene.Add(0.3, context), expected);
  });
}

} // namespace
} // namespace RectifiedTransport
