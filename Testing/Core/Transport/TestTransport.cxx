// SPDX-License-Identifier: BSD-3-Clause
// The core's functions in one header, on plain data: where mass is known to go.
#include "Core/Transport.h"
#include "TestDimensions.h"
#include "TestRefusal.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class T>
using TransportOf = DimensionTest<T>;
TYPED_TEST_SUITE(TransportOf, Dimensions, );
template <class T>
using TransportInPlaneAndSpace = DimensionTest<T>;
TYPED_TEST_SUITE(TransportInPlaneAndSpace, PlaneAndSpace, );

// Values of value(x), x in cells, on a box of cells of side 1/2.
template <int D>
struct Values
{
  template <class Value>
  Values(const GridSize<D>& size, const Value& value)
    : Cells(size)
  {
    const auto count = static_cast<std::int64_t>(numberOfCells<D>(size));
    for (std::int64_t i = 0; i < count; ++i)
    {
      Point<D> x;
      std::int64_t rest = i;
      for (int axis = 0; axis < D; ++axis)
      {
        x[axis] = static_cast<double>(rest % size[axis]) + 0.5;
        rest /= size[axis];
      }
      this->All.push_back(value(x));
    }
  }
  BoxDensity<D> Box() const
  {
    Point<D> sides;
    for (int axis = 0; axis < D; ++axis)
    {
      sides[axis] = 0.5 * static_cast<double>(this->Cells[axis]);
    }
    return { this->All.data(), this->Cells, sides };
  }

  GridSize<D> Cells;
  std::vector<double> All;
};

template <int D>
GridSize<D> plainSize()
{
  return sizeFor<D>({ 96 }, { 32, 24 }, { 16, 12, 10 });
}

// The upper half of axis 0 has three quarters of the mass.
template <int D>
Values<D> step()
{
  const GridSize<D> size = plainSize<D>();
  const double middle = 0.5 * static_cast<double>(size[0]);
  return { size, [=](const Point<D>& x) { return x[0] < middle ? 1.0 : 3.0; } };
}

// A bump about a place along axis 0, in cells.
template <int D>
Values<D> bump(double place, const GridSize<D>& size = plainSize<D>())
{
  return { size, [=](const Point<D>& x) {
            double square = 0.0;
            for (int axis = 0; axis < D; ++axis)
            {
              const double centre = axis == 0 ? place : 0.5 * static_cast<double>(size[axis]);
              square += (x[axis] - centre) * (x[axis] - centre);
            }
            return std::max(0.0, 9.0 - square);
          } };
}

double sumOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <int D>
double centroidOf(const std::vector<double>& values, std::int64_t cells)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sum += values[i] * (static_cast<double>(static_cast<std::int64_t>(i) % cells) + 0.5);
  }
  return sum / sumOf(values);
}

TYPED_TEST(TransportOf, SamplesHaveTheirShareOfTheMass)
{
  constexpr int D = TypeParam::value;
  const Values<D> values = step<D>();
  const double middle = 0.25 * static_cast<double>(values.Cells[0]); // of sides of 1/2
  for (const MapMethod method : { MapMethod::RectifiedFlow, MapMethod::Optimal })
  {
    SampleOptions options;
    options.Map.Method = method;
    const std::vector<Point<D>> points = sample(values.Box(), 4000, options);
    ASSERT_EQ(points.size(), 4000U);
    const auto upper = std::count_if(
      points.begin(), points.end(), [=](const Point<D>& point) { return point[0] > middle; });
    EXPECT_NEAR(static_cast<double>(upper) / 4000.0, 0.75, 0.01);
    for (const Point<D>& point : points)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        ASSERT_GE(point[axis], 0.0);
        ASSERT_LE(point[axis], values.Box().Sides()[axis]);
      }
    }
  }
}

TYPED_TEST(TransportOf, MapsStretchBoxesByTheDensity)
{
  constexpr int D = TypeParam::value;
  const Values<D> values = step<D>();
  const double side = 0.5 * static_cast<double>(values.Cells[0]);
  MapOptions<D> options;
  options.Samples = sizeFor<D>({ 64 }, { 32, 8 }, { 32, 4, 4 });
  for (const MapMethod method : { MapMethod::RectifiedFlow, MapMethod::Optimal })
  {
    options.Map.Method = method;
    const SampledMap<D> found = map(values.Box(), options);
    ASSERT_EQ(found.Samples, options.Samples);
    ASSERT_EQ(found.Displacement.size(), found.Determinant.size());
    const double most = method == MapMethod::Optimal ? 0.05 : 0.02;
    for (std::size_t i = 0; i < found.Displacement.size(); ++i)
    {
      const auto row = static_cast<double>(static_cast<std::int64_t>(i) % options.Samples[0]);
      const double x = (row + 0.5) / static_cast<double>(options.Samples[0]); // of the side
      const double image = x < 0.25 ? 2.0 * x : 0.5 + (x - 0.25) / 1.5;
      ASSERT_NEAR(found.Displacement[i][0], (image - x) * side, most * side);
      if (std::abs(x - 0.25) > 0.1)
      {
        const double measure = x < 0.25 ? 2.0 : 2.0 / 3.0;
        ASSERT_NEAR(found.Determinant[i], measure, 0.2);
        ASSERT_NEAR(found.Divergence[i], measure - 1.0, 0.2);
      }
    }
  }
}

TYPED_TEST(TransportOf, BackwardUndoesForward)
{
  constexpr int D = TypeParam::value;
  const Values<D> values = step<D>();
  MapOptions<D> options;
  const SampledMap<D> forward = map(values.Box(), options);
  options.Direction = FlowDirection::Backward;
  const SampledMap<D> backward = map(values.Box(), options);
  // Where the first goes from a cell, the second comes from, near enough.
  const auto cells = values.Cells[0];
  for (std::int64_t i = 0; i < cells; ++i)
  {
    const double x = 0.5 * (static_cast<double>(i) + 0.5);
    const double image = x + forward.Displacement[static_cast<std::size_t>(i)][0];
    const auto cell = std::min(static_cast<std::int64_t>(2.0 * image), cells - 1);
    EXPECT_NEAR(
      image + backward.Displacement[static_cast<std::size_t>(cell)][0], x, 1.1); // two cells
  }
}

TYPED_TEST(TransportOf, MassIsHalfwayAtHalfTime)
{
  constexpr int D = TypeParam::value;
  const auto from = 0.3 * static_cast<double>(plainSize<D>()[0]);
  const auto to = 0.7 * static_cast<double>(plainSize<D>()[0]);
  const Values<D> a = bump<D>(from);
  Values<D> b = bump<D>(to);
  for (double& value : b.All)
  {
    value *= 3.0;
  }
  for (const MapMethod method : { MapMethod::RectifiedFlow, MapMethod::Optimal })
  {
    MorphOptions options;
    options.Method = method;
    const std::vector<double> times{ 0.0, 0.05, 0.5, 0.95, 1.0 };
    const std::vector<MadeDensity<D>> made = morph(a.Box(), b.Box(), times, options);
    ASSERT_EQ(made.size(), times.size());
    EXPECT_EQ(made.front().Values, a.All);
    EXPECT_EQ(made.back().Values, b.All);
    for (std::size_t i = 0; i < times.size(); ++i)
    {
      ASSERT_EQ(made[i].Cells, a.Cells);
      EXPECT_NEAR(
        sumOf(made[i].Values), (1.0 + 2.0 * times[i]) * sumOf(a.All), 1e-9 * sumOf(b.All));
      EXPECT_NEAR(centroidOf<D>(made[i].Values, a.Cells[0]), from + times[i] * (to - from), 0.3);
    }
  }
}

TYPED_TEST(TransportOf, MassModes)
{
  constexpr int D = TypeParam::value;
  const Values<D> a = step<D>();
  Values<D> b = a;
  for (double& value : b.All)
  {
    value *= 4.0;
  }
  const double measure = std::pow(0.5, D);
  const double mass = sumOf(a.All) * measure;
  const std::pair<BlendedMass, double> modes[] = { { BlendedMass::Linear, 2.5 * mass },
    { BlendedMass::Geometric, 2.0 * mass }, { BlendedMass::Source, mass },
    { BlendedMass::Normalize, 1.0 } };
  for (const auto& [mode, expected] : modes)
  {
    BlendOptions options;
    options.Mass = mode;
    const MadeDensity<D> made = barycenter<D>({ a.Box(), b.Box() }, { 1.0, 1.0 }, options);
    EXPECT_NEAR(sumOf(made.Values) * measure, expected, 1e-9 * expected);
  }
}

TYPED_TEST(TransportOf, BarycenterOfTwoIsAMorph)
{
  constexpr int D = TypeParam::value;
  const Values<D> a = bump<D>(6.0);
  const Values<D> b = step<D>();
  const MadeDensity<D> mean = barycenter<D>({ a.Box(), b.Box() }, { 3.0, 1.0 });
  EXPECT_EQ(mean.Values, morph(a.Box(), b.Box(), { 0.25 }).front().Values);
  EXPECT_EQ(barycenter<D>({ a.Box(), b.Box() }, { 2.0, 0.0 }).Values, a.All);
}

// Of a density with fewer cells the values are resampled, with its mass.
TYPED_TEST(TransportOf, OtherNumbersOfCells)
{
  constexpr int D = TypeParam::value;
  const Values<D> fine = step<D>();
  GridSize<D> half = fine.Cells;
  half[0] /= 2;
  const Values<D> coarse(half, [](const Point<D>&) { return 2.0; });
  const BoxDensity<D> given(coarse.All.data(), half, fine.Box().Sides());
  const MadeDensity<D> made = barycenter<D>({ given, fine.Box() }, { 1.0, 0.0 });
  EXPECT_EQ(made.Cells, fine.Cells);
  for (const double value : made.Values)
  {
    ASSERT_NEAR(value, 2.0, 1e-12);
  }
}

TYPED_TEST(TransportOf, DistanceOfATranslation)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 128 }, { 64, 32 }, { 32, 16, 16 });
  const auto way = 0.4 * static_cast<double>(size[0]);
  const Values<D> a = bump<D>(0.2 * static_cast<double>(size[0]) + 0.2, size);
  const Values<D> b = bump<D>(0.2 * static_cast<double>(size[0]) + 0.2 + std::round(way), size);
  const double length = 0.5 * std::round(way);
  const DistanceBounds found = distance(a.Box(), b.Box());
  EXPECT_LE(found.Lower, length + 1e-9);
  EXPECT_GE(found.Upper, length - 1e-9);
  EXPECT_GT(found.Lower, 0.98 * length);
  EXPECT_LT(found.Upper, 1.02 * length);
}

TYPED_TEST(TransportOf, CellsHaveEqualMasses)
{
  constexpr int D = TypeParam::value;
  const Values<D> values = step<D>();
  const std::vector<Point<D>> sites = sample(values.Box(), 12);
  const double mass = sumOf(values.All) * std::pow(0.5, D);
  const EqualMassDivision<D> found = cells<D>(sites, values.Box());
  EXPECT_EQ(found.Pixels, values.Cells);
  ASSERT_EQ(found.Labels.size(), values.All.size());
  ASSERT_EQ(found.Masses.size(), sites.size());
  EXPECT_NEAR(sumOf(found.Masses), mass, 1e-9 * mass);
  EXPECT_NEAR(sumOf(found.Costs), found.Cost, 1e-9 * found.Cost);
  std::vector<double> masses(sites.size());
  for (std::size_t i = 0; i < found.Labels.size(); ++i)
  {
    masses[static_cast<std::size_t>(found.Labels[i])] += values.All[i] * std::pow(0.5, D);
  }
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    EXPECT_NEAR(masses[i], found.Masses[i], 1e-9 * mass);
    EXPECT_NEAR(masses[i], mass / 12.0, 3.0 * std::pow(0.5, D)); // a pixel
  }
}

TEST(Transport, PowerCellsHaveEqualMasses)
{
  const Values<2> values = step<2>();
  const std::vector<Point<2>> sites = sample(values.Box(), 12);
  CellOptions<2> options;
  options.Shape = SiteCellShape::Power;
  options.Pixels = { 64, 48 };
  const EqualMassDivision<2> found = cells<2>(sites, values.Box(), options);
  EXPECT_EQ(found.Labels.size(), 64U * 48U);
  const double mean = sumOf(values.All) / 4.0 / 12.0;
  for (const double mass : found.Masses)
  {
    EXPECT_NEAR(mass, mean, 1e-6 * mean);
  }
  // No cells of equal masses cost less.
  EXPECT_LT(found.Cost, cells<2>(sites, values.Box()).Cost);
}

TYPED_TEST(TransportInPlaneAndSpace, RelaxedPointsAreFartherApart)
{
  constexpr int D = TypeParam::value;
  const Values<D> values(plainSize<D>(), [](const Point<D>&) { return 1.0; });
  SampleOptions random;
  random.Pattern = SeedPattern::Random;
  const std::vector<Point<D>> before = sample(values.Box(), 200, random);
  const auto closest = [](const std::vector<Point<D>>& points) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        double square = 0.0;
        for (int axis = 0; axis < D; ++axis)
        {
          square += (points[i][axis] - points[j][axis]) * (points[i][axis] - points[j][axis]);
        }
        least = std::min(least, square);
      }
    }
    return std::sqrt(least);
  };
  RelaxOptions options;
  for (const RelaxMethod method : { RelaxMethod::GaussianBlueNoise, RelaxMethod::OptimalTransport })
  {
    options.Method = method;
    if (D == 3 && method == RelaxMethod::OptimalTransport)
    {
      EXPECT_EQ(refusal([&]() { relax<D>(before, values.Box(), options); }),
        "RelaxMethod::OptimalTransport needs 2 dimensions; the density has 3");
      continue;
    }
    const std::vector<Point<D>> after = relax<D>(before, values.Box(), options);
    ASSERT_EQ(after.size(), before.size());
    EXPECT_GT(closest(after), 4.0 * closest(before));
  }
}

TEST(Transport, DotsAreWhereInkIs)
{
  // A dark disc on white paper.
  const Values<2> values({ 60, 40 },
    [](const Point<2>& x) { return std::hypot(x[0] - 20.0, x[1] - 15.0) < 10.0 ? 20.0 : 255.0; });
  for (const Point<2>& dot : stipple(values.Box(), 100))
  {
    EXPECT_LT(std::hypot(dot[0] - 10.0, dot[1] - 7.5), 5.5);
  }
  StippleOptions light;
  light.Invert = false;
  const std::vector<Point<2>> dots = stipple(values.Box(), 100, light);
  const auto inDisc = std::count_if(dots.begin(), dots.end(),
    [](const Point<2>& dot) { return std::hypot(dot[0] - 10.0, dot[1] - 7.5) < 4.5; });
  EXPECT_LE(inDisc, 5);
}

TYPED_TEST(TransportOf, SameBitsOnEveryNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  const Values<D> a = bump<D>(6.0);
  const Values<D> b = step<D>();
  const ThreadsExecutor three(3);
  const SerialExecutor one;
  MorphOptions options;
  options.Method = MapMethod::Optimal;
  EXPECT_EQ(morph(a.Box(), b.Box(), { 0.4 }, options, one).front().Values,
    morph(a.Box(), b.Box(), { 0.4 }, options, three).front().Values);
  EXPECT_EQ(sample(b.Box(), 1000, {}, one), sample(b.Box(), 1000, {}, three));
  EXPECT_EQ(map(b.Box(), {}, one).Displacement, map(b.Box(), {}, three).Displacement);
}

TEST(Transport, SaysWhatIsWrong)
{
  const Values<2> values = step<2>();
  const BoxDensity<2> density = values.Box();
  EXPECT_EQ(refusal([&]() {
    BoxDensity<2>(values.All.data(), { 0, 4 }, { 1.0, 1.0 });
  }),
    "the density has 0 cells along axis 0; there must be 1 to 2^30");
  EXPECT_EQ(refusal([&]() {
    BoxDensity<2>(values.All.data(), { 32, 24 }, { 1.0, -1.0 });
  }),
    "the box has the side -1.000000 along axis 1; it must be positive and finite");
  EXPECT_EQ(refusal([&]() { morph(density, density, { 1.5 }); }),
    "a time is 1.500000; it must be from 0 to 1");
  EXPECT_EQ(refusal([&]() {
    barycenter<2>({ density }, { 1.0, 2.0 });
  }),
    "there are 2 weights with the sum 3.000000 for 1 densities; there must be one for each, 0 and "
    "more, with a positive and finite sum");
  const BoxDensity<2> other(values.All.data(), values.Cells, { 1.0, 1.0 });
  EXPECT_EQ(refusal([&]() { distance(density, other); }),
    "the boxes of the densities differ; they must have the same sides");
  EXPECT_EQ(
    refusal([&]() { cells<2>({}, density); }), "there are no sites; there must be at least one");
  const std::vector<float> nothing(16);
  EXPECT_THROW(sample(BoxDensity<2>(nothing.data(), { 4, 4 }, { 1.0, 1.0 }), 10), InvalidDensity);
  const SerialExecutor serial;
  const Context stopped(serial, {}, []() { return true; });
  EXPECT_THROW(sample(density, 10, {}, stopped), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
