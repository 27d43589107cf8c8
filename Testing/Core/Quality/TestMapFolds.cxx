// SPDX-License-Identifier: BSD-3-Clause
// Folds of maps that are known, where there is mass, by determinants and by images, and none of
// smooth maps.
#include "Core/Quality/MapFolds.h"

#include "Core/Flow/MapDerivatives.h"

#include "TestDensities.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// By both ways, in parts, and on threads.
template <int Dimension>
std::int64_t foldsOf(const GridSize<Dimension>& lattice, const GridSize<Dimension>& size,
  const NotDeduced<Points<Dimension>>& positions, const RectifiedFlow<Dimension>* density)
{
  const auto whole = LatticePart<Dimension>::WholeOf(lattice);
  const Point<Dimension> step = latticeStep<Dimension>(lattice, size);
  std::vector<double> determinants(positions.size());
  std::vector<double> divergences(positions.size());
  MapDerivatives<Dimension>(lattice, step, positions)
    .Write(0, whole.Count(), divergences.data(), determinants.data());
  const MapFolds<Dimension> folds(lattice, density);
  std::int64_t found = -1;
  for (const int threads : { 1, 2, 3 })
  {
    const ThreadsExecutor executor(threads);
    Progress progress{ Context(executor) };
    const std::int64_t byDeterminants =
      folds.Count(whole, whole, determinants.data(), progress).Samples;
    EXPECT_EQ(folds.Count(whole, whole, step, positions, progress).Samples, byDeterminants);
    EXPECT_TRUE(found == -1 || found == byDeterminants);
    found = byDeterminants;
    LatticePart<Dimension> low = whole;
    LatticePart<Dimension> high = whole;
    low.Cells[0] = lattice[0] / 3;
    high.Low[0] = low.Cells[0];
    high.Cells[0] -= low.Cells[0];
    EXPECT_EQ(folds.Count(low, whole, determinants.data(), progress).Samples +
        folds.Count(high, whole, step, positions, progress).Samples,
      found);
    EXPECT_EQ(folds.Count({ {}, {} }, whole, determinants.data(), progress).Samples, 0);
  }
  return found;
}

template <class T>
class MapFoldsTest : public testing::Test
{
};
TYPED_TEST_SUITE(MapFoldsTest, Dimensions);

// Samples 20 to 24 along axis 0 run backwards, where differences are negative, or 0 at both ends.
// All along the other axes count, but at edges, where two faces are near.
TYPED_TEST(MapFoldsTest, KnownFold)
{
  constexpr int D = TypeParam::value;
  const auto lattice = sizeFor<D>({ 60 }, { 60, 9 }, { 60, 9, 7 });
  Points<D> positions = latticePoints<D>(lattice, lattice);
  for (Point<D>& x : positions)
  {
    const double fold = std::min(std::max(x[0] - 20.5, 0.0), 4.0);
    x[0] -= 2.0 * fold;
  }
  const std::int64_t across = D == 1 ? 1 : D == 2 ? 9 : 9 * 7 - 4 * 4;
  EXPECT_EQ(foldsOf<D>(lattice, lattice, positions, nullptr), 5 * across);

  // Backward only where there is mass: in cells 22 and above.
  const auto density =
    sampleDensity<D>(lattice, [](const Point<D>& p) { return p[0] * 60.0 > 22.0 ? 1.0 : 0.0; });
  const RectifiedFlow<D> flow(density.Source());
  EXPECT_EQ(foldsOf<D>(lattice, lattice, positions, &flow), 3 * across);
}

// A cell of the lattice covers several of the density, the outer ones in part.
TYPED_TEST(MapFoldsTest, MassInPartOfASample)
{
  constexpr int D = TypeParam::value;
  const auto size = evenSize<D>(30);
  const auto lattice = evenSize<D>(12); // of 2.5 cells
  Points<D> positions = latticePoints<D>(size, lattice);
  for (Point<D>& x : positions)
  {
    x[0] = -x[0];
  }
  // All but those at corners and edges.
  const std::int64_t inner = D == 1 ? 12 : D == 2 ? 12 * 12 - 4 * 4 : 8 * 8 * 8 + 6 * 4 * 8 * 8 / 2;
  EXPECT_EQ(foldsOf<D>(lattice, size, positions, nullptr), inner);
  // Cell 12 is half in sample 4, half in sample 5; cell 14 in sample 5 alone.
  for (const auto& [cell, wanted] : { std::pair<std::int64_t, int>{ 12, 1 << D }, { 14, 1 } })
  {
    TestDensity<D> density{ size,
      std::vector<double>(static_cast<std::size_t>(cellCount<D>(size)), 0.0) };
    density.Values[static_cast<std::size_t>(cellIndex<D>(evenSize<D>(cell), size))] = 1e-30;
    const RectifiedFlow<D> flow(density.Source());
    EXPECT_EQ(foldsOf<D>(lattice, size, positions, &flow), wanted);
  }
}

// No false alarm, also where the determinant itself is negative beside the corners and edges.
TYPED_TEST(MapFoldsTest, NoneOfTheFlow)
{
  constexpr int D = TypeParam::value;
  const auto size = sizeFor<D>({ 256 }, { 64, 72 }, { 48, 48, 48 });
  const std::vector<TestDensity<D>> densities = { uniformDensity<D>(size),
    sampleDensity<D>(
      size, [](const Point<D>& p) { return 0.1 + std::exp(-12.0 * squaredDistance<D>(p, 0.45)); }),
    sampleDensity<D>(size, [](const Point<D>& p) {
      return squaredDistance<D>(p, 0.5) < (D == 3 ? 0.04 : 0.0225) ? 100.0 : 1.0;
    }) };
  int corners = 0;
  for (const auto& density : densities)
  {
    const RectifiedFlow<D> flow(density.Source());
    Points<D> positions(static_cast<std::size_t>(cellCount<D>(size)));
    FlowOptions options;
    options.NumberOfSteps = D == 3 ? 96 : 512;
    flow.Backward(FlowSeeds<D>::Lattice(size), positions, options);
    EXPECT_EQ(foldsOf<D>(size, size, positions, &flow), 0);
    std::vector<double> determinants(positions.size());
    std::vector<double> divergences(positions.size());
    MapDerivatives<D>(size, evenPoint<D>(1.0), positions)
      .Write(0, cellCount<D>(size), divergences.data(), determinants.data());
    corners += static_cast<int>(std::count_if(
      determinants.begin(), determinants.end(), [](double value) { return value <= 0.0; }));
  }
  EXPECT_EQ(corners > 0, D > 1);
}

} // namespace
} // namespace RectifiedTransport
