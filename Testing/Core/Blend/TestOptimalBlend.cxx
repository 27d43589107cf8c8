// SPDX-License-Identifier: BSD-3-Clause
// Blends whose particles are known: translations, means of translations, and equal densities.
#include "Core/Blend/OptimalBlend.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Geometry/MeanSquare.h"
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Parallel/Progress.h"
#include "OptimalMap/MapPoints.h"
#include "TestGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t side = 48;

// Densities on a unit square and the particles of a pivot that the flow takes there.
class Blend
{
public:
  Blend()
    : Grid(makeGrid<2>(evenSize<2>(side), { 1.0 / side, 1.0 / side, 1.0 }))
  {
    this->Options.Geometry = this->Grid;
  }

  void Add(const TestDensity<2>& given, double weight)
  {
    const TestDensity<2>& density = this->Kept.emplace_back(given);
    const DensityArray<2, double>& values = this->Arrays.emplace_back(density.Source());
    const auto pivot = pivotLattice<2>(density.Size, 1);
    Points<2> points(static_cast<std::size_t>(pivot.NumberOfParticles()));
    transportPivot<2>(RectifiedFlow<2>(values), pivot, points);
    std::vector<Point<3>>& physical = this->Positions.emplace_back(points.size());
    Progress progress{ Context() };
    writePhysical<2>(this->Grid, ConstPointSpan<2>(points), progress, physical);
    const auto place = PlanEnd<2>::In(this->Grid, this->Grid);
    this->Densities.push_back({ PlanEnd<2>(PlacedDensity<2>{ values, place.Low, place.High }),
      this->Grid, weight, physical });
  }

  OptimalPositions Run() const { return blendOptimally<2>(this->Densities, this->Options); }

  OptimalBlendOptions Options;
  std::deque<std::vector<Point<3>>> Positions;

private:
  const ImageGrid Grid;
  std::deque<TestDensity<2>> Kept;
  std::deque<DensityArray<2, double>> Arrays;
  std::vector<BlendedDensity<2>> Densities;
};

double meanOf(const LargeBuffer<double>& values)
{
  double sum = 0.0;
  for (std::int64_t i = 0; i < values.size(); ++i)
  {
    sum += values.data()[i];
  }
  return sum / static_cast<double>(values.size());
}

TEST(OptimalBlend, TranslatesBetweenTwo)
{
  Blend blend;
  blend.Add(ballAt<2>(evenSize<2>(side), { 0.375, 0.5 }), 0.5);
  blend.Add(ballAt<2>(evenSize<2>(side), { 0.625, 0.5 }), 0.5);
  blend.Options.IsOptimal = true;
  blend.Options.IsPair = true;
  const OptimalPositions found = blend.Run();
  EXPECT_TRUE(found.Warnings.empty());
  EXPECT_TRUE(found.Functional.empty());
  EXPECT_EQ(found.Moved[0], nullptr);
  ASSERT_NE(found.Moved[1], nullptr);
  EXPECT_NEAR(found.Bound, 0.0625, 0.001);
  EXPECT_LE(found.Bound, 0.0625 + 1e-9);
  const std::vector<Point<3>>& from = blend.Positions[0];
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    const double* to = found.Moved[1]->data() + 3 * i;
    sum += std::hypot(to[0] - from[i][0] - 0.25, to[1] - from[i][1]);
  }
  EXPECT_LT(sum / static_cast<double>(from.size()), 0.5 / side);
  // The cost is the bound and twice the mean slack, but for the errors of the nodes.
  const ConstPointSpan<3> images(found.Moved[1]->data(), static_cast<std::int64_t>(from.size()));
  Progress progress{ Context() };
  const double cost = meanSquare(LengthScale(blend.Options.Geometry), from, images, nullptr,
    static_cast<double>(from.size()), progress);
  EXPECT_NEAR(cost, found.Bound + 2.0 * meanOf(found.Slack), 0.002);
}

TEST(OptimalBlend, CertifiesTheFlow)
{
  Blend blend;
  blend.Add(ballAt<2>(evenSize<2>(side), { 0.375, 0.5 }), 0.5);
  blend.Add(ballAt<2>(evenSize<2>(side), { 0.625, 0.5 }), 0.5);
  for (const bool isPair : { true, false })
  {
    blend.Options.IsPair = isPair;
    const OptimalPositions found = blend.Run();
    EXPECT_EQ(std::count(found.Moved.begin(), found.Moved.end(), nullptr), 2);
    EXPECT_NEAR(found.Bound, isPair ? 0.0625 : 0.0625 / 4.0, 0.002);
    EXPECT_GT(meanOf(found.Slack), 0.0);
    EXPECT_TRUE(found.Functional.empty());
    EXPECT_EQ(found.Cost > found.Bound, !isPair);
  }
}

// The mean of translations of one density is in the middle; its functional is known.
TEST(OptimalBlend, FindsBarycenters)
{
  Blend blend;
  blend.Add(ballAt<2>(evenSize<2>(side), { 0.375, 0.5 }), 0.75);
  blend.Add(ballAt<2>(evenSize<2>(side), { 0.625, 0.5 }), 0.25);
  blend.Add(ballAt<2>(evenSize<2>(side), { 0.5, 0.8 }), 0.0);
  blend.Options.IsOptimal = true;
  const OptimalPositions found = blend.Run();
  EXPECT_TRUE(found.Warnings.empty());
  EXPECT_EQ(found.Moved[2], nullptr);
  ASSERT_FALSE(found.Functional.empty());
  EXPECT_NEAR(found.Functional.back(), 0.75 * 0.25 * 0.0625, 5e-4);
  EXPECT_TRUE(std::is_sorted(found.Functional.rbegin(), found.Functional.rend()));
  EXPECT_NEAR(found.Bound, found.Functional.back(), 5e-4);
  EXPECT_GE(found.Cost, found.Bound - 1e-4);
  double mean = 0.0;
  const auto count = static_cast<std::size_t>(found.Moved[0]->size() / 3);
  for (std::size_t i = 0; i < count; ++i)
  {
    mean += 0.75 * found.Moved[0]->data()[3 * i] + 0.25 * found.Moved[1]->data()[3 * i];
  }
  EXPECT_NEAR(mean / static_cast<double>(count), 0.4375, 0.25 / side);
}

TEST(OptimalBlend, LeavesOneDensityAsItIs)
{
  Blend blend;
  const TestDensity<2> ball = ballAt<2>(evenSize<2>(side), { 0.4, 0.5 });
  blend.Add(ball, 0.5);
  blend.Add(ball, 0.5);
  blend.Options.IsOptimal = true;
  const OptimalPositions found = blend.Run();
  EXPECT_EQ(std::count(found.Moved.begin(), found.Moved.end(), nullptr), 2);
  EXPECT_EQ(found.Functional, std::vector<double>{ 0.0 });
  EXPECT_EQ(found.Bound, 0.0);
  EXPECT_EQ(meanOf(found.Slack), 0.0);
}

} // namespace
} // namespace RectifiedTransport
