// SPDX-License-Identifier: BSD-3-Clause
// Displacements of known maps, and their mean squares against closed forms: of the samples, and of
// the mass.
#include "Core/Flow/MapDisplacement.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "TestGrid.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
struct Displaced
{
  Points<3> Vectors;
  double Cost;
};

// Of the map that takes each sample to map(sample), both in index space.
template <int Dimension, class Map>
Displaced<Dimension> displace(const ImageGrid& grid, const GridSize<Dimension>& lattice,
  const Map& map, const RectifiedFlow<Dimension>* density = nullptr,
  const Context& context = Context())
{
  Points<Dimension> positions = latticePoints<Dimension>(grid.Size<Dimension>(), lattice);
  for (Point<Dimension>& point : positions)
  {
    point = map(point);
  }
  Displaced<Dimension> found{ Points<3>(positions.size()), 0.0 };
  found.Cost =
    writeDisplacements<Dimension>(grid, lattice, positions, density, found.Vectors, context);
  return found;
}

// Values 1, 3, 5, ... along axis 0: the first k cells of 0 to S have the share (k/S)^2.
template <int Dimension>
TestDensity<Dimension> ramp(const GridSize<Dimension>& size)
{
  TestDensity<Dimension> density{ size, {} };
  density.Values.resize(cellCount<Dimension>(size));
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    density.Values[i] = 2.0 * static_cast<double>(static_cast<std::int64_t>(i) % size[0]) + 1.0;
  }
  return density;
}

template <int D>
void expectShift()
{
  const auto size = sizeFor<D>({ 12 }, { 12, 7 }, { 12, 7, 5 });
  const auto lattice = sizeFor<D>({ 40 }, { 9, 14 }, { 12, 3, 8 });
  const Eigen::Vector3d spacing(0.5, 2.0, -3.0);
  const auto found = displace<D>(makeGrid<D>(size, spacing), lattice, [](Point<D> x) {
    for (int axis = 0; axis < D; ++axis)
    {
      x[axis] += 0.25 * (axis + 1);
    }
    return x;
  });
  double squared = 0.0;
  for (int axis = 0; axis < D; ++axis)
  {
    squared += std::pow(0.25 * (axis + 1) * spacing[axis], 2);
  }
  EXPECT_NEAR(found.Cost, squared, 1e-13 * squared);
  for (const Point<3>& vector : found.Vectors)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_NEAR(vector[axis], axis < D ? 0.25 * (axis + 1) * spacing[axis] : 0.0, 1e-13);
    }
  }
}

TEST(MapDisplacement, Shift)
{
  expectShift<1>();
  expectShift<2>();
  expectShift<3>();
}

// x to 3x along axis 0, of n samples of a length L: the mean of (2x)^2 is L^2 (4/3 - 1/(3 n^2)).
template <int D>
void expectStretchOfTheSamples()
{
  const auto size = sizeFor<D>({ 10 }, { 10, 4 }, { 10, 4, 3 });
  for (const std::int64_t n : { 1, 2, 7, 1000 })
  {
    const auto lattice = sizeFor<D>({ n }, { n, 5 }, { n, 5, 2 });
    const ImageGrid grid = makeGrid<D>(size, { 0.7, 1.0, 1.0 }, { 5.0, 6.0, 7.0 });
    const double cost = displace<D>(grid, lattice, [](Point<D> x) {
      x[0] *= 3.0;
      return x;
    }).Cost;
    const auto samples = static_cast<double>(n);
    const double expected = 49.0 * (4.0 / 3.0 - 1.0 / (3.0 * samples * samples));
    EXPECT_NEAR(cost, expected, 1e-12 * expected) << n;
  }
}

TEST(MapDisplacement, StretchOfTheSamples)
{
  expectStretchOfTheSamples<1>();
  expectStretchOfTheSamples<2>();
  expectStretchOfTheSamples<3>();
}

// The same of n samples whose cells have the shares (2i+1) / n^2 of a ramp's mass: the mean of
// (2x)^2 is L^2 (2 - 1/n^2), whether samples are coarser or finer than the ramp's cells or not.
template <int D>
void expectStretchOfTheMass()
{
  const auto size = sizeFor<D>({ 12 }, { 12, 4 }, { 12, 4, 3 });
  const RectifiedFlow<D> flow = makeFlow(ramp<D>(size));
  for (const std::int64_t n : { 1, 2, 4, 12 })
  {
    const auto lattice = sizeFor<D>({ n }, { n, 5 }, { n, 5, 2 });
    const ImageGrid grid = makeGrid<D>(size, { 0.5, 1.0, 1.0 });
    const double cost = displace<D>(
      grid, lattice,
      [](Point<D> x) {
        x[0] *= 3.0;
        return x;
      },
      &flow)
                          .Cost;
    const auto samples = static_cast<double>(n);
    const double expected = 36.0 * (2.0 - 1.0 / (samples * samples));
    EXPECT_NEAR(cost, expected, 1e-12 * expected) << n;
  }
}

TEST(MapDisplacement, StretchOfTheMass)
{
  expectStretchOfTheMass<1>();
  expectStretchOfTheMass<2>();
  expectStretchOfTheMass<3>();
}

// Finer samples share a cell's mass: the cells' own shares, halved.
TEST(MapDisplacement, SamplesWithinACell)
{
  const RectifiedFlow<1> flow = makeFlow(ramp<1>({ 3 }));
  const ImageGrid grid = makeGrid<1>({ 3 }, { 1.0, 1.0, 1.0 });
  int sample = 0;
  const double cost = displace<1>(
    grid, { 6 }, [&sample](const Point<1>& x) { return Point<1>{ x[0] + ++sample }; }, &flow)
                        .Cost;
  EXPECT_NEAR(cost, (1 + 4 + 3 * (9 + 16) + 5 * (25 + 36)) / 18.0, 1e-14 * 30.0);
}

TEST(MapDisplacement, SharedInSpace)
{
  const GridSize<3> size{ 8, 9, 10 };
  const ImageGrid grid = makeGrid<3>(size, { 0.5, 2.0, 3.0 });
  const auto turn = [](const Point<3>& x) { return Point<3>{ x[1], x[2], x[0] }; };
  const auto apart = displace<3>(grid, size, turn);
  Points<3> shared = latticePoints<3>(size, size);
  for (Point<3>& point : shared)
  {
    point = turn(point);
  }
  EXPECT_EQ(writeDisplacements<3>(grid, size, shared, nullptr, shared), apart.Cost);
  EXPECT_EQ(shared, apart.Vectors);
}

TEST(MapDisplacement, SameBitsOnAnyThreads)
{
  const GridSize<2> size{ 150, 90 };
  const RectifiedFlow<2> flow = makeFlow(twoGaussians<2>(size));
  const ImageGrid grid = makeGrid<2>(size, { 0.3, 0.7, 1.0 });
  const auto wave = [](const Point<2>& x) {
    return Point<2>{ x[0] + std::sin(x[1]), x[1] + std::cos(0.1 * x[0]) };
  };
  for (const RectifiedFlow<2>* density : { &flow, static_cast<const RectifiedFlow<2>*>(nullptr) })
  {
    const auto serial = displace<2>(grid, size, wave, density, SerialExecutor());
    const auto threaded = displace<2>(grid, size, wave, density, OpenMPExecutor());
    EXPECT_EQ(serial.Cost, threaded.Cost);
    EXPECT_EQ(serial.Vectors, threaded.Vectors);
  }
}

// Squares of lengths that are not doubles have a mean, if that is one.
TEST(MapDisplacement, LargeAndSmall)
{
  const auto shift = [](const Point<1>& x) { return Point<1>{ x[0] + 0.5 }; };
  const double large = 0x1p500;
  EXPECT_EQ(displace<1>(makeGrid<1>({ 8 }, { large, 1.0, 1.0 }), { 8 }, shift).Cost, 0x1p998);
  const double small = 0x1p-500;
  EXPECT_EQ(displace<1>(makeGrid<1>({ 8 }, { small, 1.0, 1.0 }), { 8 }, shift).Cost, 0x1p-1002);
  EXPECT_THROW(
    displace<1>(makeGrid<1>({ 8 }, { 0x1p600, 1.0, 1.0 }), { 8 }, shift), std::overflow_error);
}

TEST(MapDisplacement, WrongCountsAndCancel)
{
  const GridSize<2> size{ 300, 200 };
  const ImageGrid grid = makeGrid<2>(size, { 1.0, 1.0, 1.0 });
  Points<2> positions = latticePoints<2>(size, size);
  Points<3> displacements(positions.size());
  const SerialExecutor executor;
  double last = -1.0;
  const Context stopped(
    executor, [&last](double done) { last = done; }, []() { return true; });
  EXPECT_THROW(
    writeDisplacements<2>(grid, size, positions, nullptr, displacements, stopped), Cancelled);
  EXPECT_LE(last, 1.0);
  displacements.pop_back();
  EXPECT_EQ(
    refusal([&]() { writeDisplacements<2>(grid, size, positions, nullptr, displacements); }),
    "there are 59999 positions or displacements, there must be 60000");
}

} // namespace
} // namespace RectifiedTransport
