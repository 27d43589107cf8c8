// SPDX-License-Identifier: BSD-3-Clause
// The exact finish of particles whose whole box is at the density's largest value.
#include "TestDimensions.h"
#include "TestFlow.h"

namespace RectifiedTransport
{
namespace
{

template <class T>
using Plateau = DimensionTest<T>;
TYPED_TEST_SUITE(Plateau, Dimensions);

// Ones in half of each axis, about the middle.
template <int Dimension>
TestDensity<Dimension> block(std::int64_t side)
{
  return sampleDensity<Dimension>(evenSize<Dimension>(side), [](const Point<Dimension>& p) {
    for (const double coordinate : p)
    {
      if (coordinate < 0.25 || coordinate > 0.75)
      {
        return 0.0;
      }
    }
    return 1.0;
  });
}

// Nearly all particles are inside of it before the last of the 31 evaluations.
TYPED_TEST(Plateau, EndsEarly)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> shape = block<D>(32);
  const auto lattice = evenSize<D>(D == 1 ? 4096 : 32); // of many blocks of neighbours
  Points<D> positions(static_cast<std::size_t>(cellCount<D>(lattice)));
  const RectifiedFlow<D> flow(shape.Source());
  const FlowReport report = flow.Forward(FlowSeeds<D>::Lattice(lattice), positions);
  EXPECT_LT(report.Evaluations, 30 * cellCount<D>(lattice));
}

// Sums of what is no power of two are rounded, and the values of a plateau are the same all the
// same; values that differ by little are none.
TEST(PlateauTolerance, IsThatOfRounding)
{
  TestDensity<2> shape = block<2>(200);
  for (double& value : shape.Values)
  {
    value *= 0.1;
  }
  Points<2> positions(100 * 100);
  const auto evaluations = [&positions](const TestDensity<2>& density) {
    const RectifiedFlow<2> flow(density.Source());
    FlowOptions options;
    options.Maps = FlowMaps::Off;
    options.NumberOfSteps = 32;
    return flow.Forward(FlowSeeds<2>::Lattice({ 100, 100 }), positions, options).Evaluations;
  };
  EXPECT_LT(evaluations(shape), 28 * 10000);
  for (std::size_t i = 0; i < shape.Values.size(); ++i)
  {
    shape.Values[i] *= 1.0 + 1e-7 * static_cast<double>(i % 200 + i / 200);
  }
  EXPECT_GE(evaluations(shape), 31 * 10000);
}

// The map onto a box of ones is the scaling of the domain onto it, along each axis; what is left is
// the integrator's error before the plateau, a part of a cell.
TYPED_TEST(Plateau, IsTheScaling)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> shape = block<D>(32);
  const RectifiedFlow<D> flow(shape.Source());
  FlowOptions options;
  options.NumberOfSteps = 64;
  const auto lattice = evenSize<D>(16);
  Points<D> positions(static_cast<std::size_t>(cellCount<D>(lattice)));
  flow.Forward(FlowSeeds<D>::Lattice(lattice), positions, options);
  for (std::int64_t i = 0; i < cellCount<D>(lattice); ++i)
  {
    const GridSize<D> cell = cellAt<D>(i, lattice);
    for (int axis = 0; axis < D; ++axis)
    {
      const double expected = 8.0 + static_cast<double>(cell[axis]) + 0.5;
      EXPECT_NEAR(positions[static_cast<std::size_t>(i)][axis], expected, 0.02);
    }
  }
}

// On the way from where it is known the path is straight, and its end is the same without a path.
TYPED_TEST(Plateau, PathsAgree)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> shape = block<D>(32);
  const RectifiedFlow<D> flow(shape.Source());
  const Points<D> seeds = randomPoints<D>(shape.Size, 300);
  const std::vector<double> times{ 0.98, 0.99, 1.0 };
  Points<D> paths(seeds.size() * times.size());
  Points<D> ends(seeds.size());
  flow.ForwardAt(seeds, times, paths);
  flow.Forward(seeds, ends);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      const Point<D>* path = paths.data() + i * times.size();
      EXPECT_EQ(path[2][axis], ends[i][axis]);
      if (std::abs(ends[i][axis] - 16.0) < 6.0)
      {
        EXPECT_NEAR(path[1][axis], 0.5 * (path[0][axis] + path[2][axis]), 0.001);
      }
    }
  }
}

} // namespace
} // namespace RectifiedTransport
