// SPDX-License-Identifier: BSD-3-Clause
// Clouds that scale: their masses and centroids, those of one cell as CloudInCell, and the same
// bits for every number of threads and ranks.
#include "TestSplat.h"
#include "ThreadRanks.h"
#include "ThreadsExecutor.h"

#include "Core/Parallel/Progress.h"
#include "Core/Splat/ScaledClouds.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

template <int D>
ImageGrid unitGrid(const GridSize<D>& size)
{
  std::array<int, 6> extent{};
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    extent[2 * axis + 1] = static_cast<int>(size[axis]);
  }
  return { extent, Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), ImageGrid::Matrix::Identity(),
    false };
}

template <int D>
struct TestClouds
{
  Cloud<D> Particles;
  std::array<std::vector<float>, 2> Lengths;

  TestClouds(const Cloud<D>& particles, float from, float to)
    : Particles(particles)
  {
    const auto count = static_cast<std::size_t>(D * particles.Count());
    this->Lengths = { std::vector<float>(count, from), std::vector<float>(count, to) };
    for (double& mass : this->Particles.Masses)
    {
      mass = std::abs(mass);
    }
  }
  ScaledClouds<D> At(double part) const
  {
    Point<D> unit;
    unit.fill(1.0);
    return { { this->Particles.Points.data(), this->Particles.Count() },
      this->Particles.Masses.data(), { this->Lengths[0].data(), this->Lengths[1].data() }, part,
      { unit, unit }, this->Particles.Count() };
  }
  double Mass() const { return sumOf(this->Particles.Masses); }
};

template <int D>
std::vector<double> densityOf(const ScaledClouds<D>& clouds, const ImageGrid& grid, double mass,
  const LatticePart<D>& part, const Context& context)
{
  Progress progress(context);
  std::vector<double> density(static_cast<std::size_t>(part.Count()));
  splatClouds<D>(clouds, grid, mass, part, density.data(), progress);
  return density;
}

template <int D>
std::vector<double> densityOf(
  const TestClouds<D>& clouds, const typename SizeOf<D>::Type& size, double part)
{
  const SerialExecutor serial;
  return densityOf<D>(
    clouds.At(part), unitGrid<D>(size), clouds.Mass(), LatticePart<D>::WholeOf(size), serial);
}

template <int D>
void checkOneCell(const GridSize<D>& size)
{
  const TestClouds<D> clouds(randomCloud<D>(size, 500, 0.5, false), 1.0F, 1.0F);
  const std::vector<double> found = densityOf<D>(clouds, size, 0.3);
  const std::vector<double> expected =
    splat(clouds.Particles.Particles(), size, splatOptions(SplatKernel::CloudInCell)).Cells;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-12);
  }
}

TEST(ScaledClouds, OfOneCellAreCloudInCell)
{
  checkOneCell<1>({ 30 });
  checkOneCell<2>({ 12, 7 });
  checkOneCell<3>({ 6, 7, 5 });
}

template <int D>
void checkMoments(const GridSize<D>& size)
{
  const TestClouds<D> inner(randomCloud<D>(size, 300, 2.0, false), 0.25F, 3.5F);
  const TestClouds<D> beyond(randomCloud<D>(size, 300, -1.0, false), 6.0F, 9.0F);
  for (const double part : { 0.0, 0.4, 1.0 })
  {
    const std::vector<double> cells = densityOf<D>(inner, size, part);
    EXPECT_NEAR(sumOf(cells), inner.Mass(), 1e-12 * inner.Mass());
    for (int axis = 0; axis < D; ++axis)
    {
      double moment = 0.0;
      for (std::size_t i = 0; i < inner.Particles.Masses.size(); ++i)
      {
        moment += inner.Particles.Masses[i] *
          inner.Particles.Points[3 * i + static_cast<std::size_t>(axis)];
      }
      // A box that ends within a cell is spread over it.
      EXPECT_NEAR(firstMoment<D>(cells, size, axis), moment, 0.02 * moment);
    }
    EXPECT_NEAR(sumOf(densityOf<D>(beyond, size, part)), beyond.Mass(), 1e-12 * beyond.Mass());
  }
}

TEST(ScaledClouds, KeepMassAndPlace)
{
  checkMoments<1>({ 40 });
  checkMoments<2>({ 14, 9 });
  checkMoments<3>({ 8, 9, 7 });
}

// In units of the cells of their own steps.
TEST(ScaledClouds, HaveTheUnitsOfTheirSteps)
{
  Cloud<1> two;
  two.Add({ 2.0 }, 1.0);
  two.Add({ 6.0 }, 1.0);
  const TestClouds<1> clouds(two, 1.0F, 1.0F);
  ScaledClouds<1> scaled = clouds.At(0.5);
  scaled.Units = { Point<1>{ 2.0 }, Point<1>{ 4.0 } };
  scaled.Second = 1;
  const SerialExecutor serial;
  const std::vector<double> expected = { 0.0, 0.5, 0.5, 0.0, 0.25, 0.25, 0.25, 0.25 };
  EXPECT_EQ(densityOf<1>(scaled, unitGrid<1>({ 8 }), 2.0, LatticePart<1>::WholeOf({ 8 }), serial),
    expected);
}

TEST(ScaledClouds, HaveTheSameBitsOnThreadsAndRanks)
{
  const GridSize<3> size{ 9, 8, 10 };
  const ImageGrid grid = unitGrid<3>(size);
  const auto whole = LatticePart<3>::WholeOf(size);
  const TestClouds<3> clouds(randomCloud<3>(size, 20000, -0.5, false), 0.5F, 2.5F);
  const ScaledClouds<3> all = clouds.At(0.6);
  const std::vector<double> alone = densityOf<3>(clouds, size, 0.6);
  const ThreadsExecutor threads(3);
  EXPECT_EQ(densityOf<3>(all, grid, clouds.Mass(), whole, threads), alone);
  runOnRanks(3, [&](const Ranks& ranks) {
    const SerialExecutor serial;
    Context context(serial);
    context.Group = &ranks;
    const std::int64_t begin = ranks.Own() * 5000;
    const std::int64_t count = ranks.Own() == 2 ? 10000 : 5000;
    ScaledClouds<3> own = all;
    own.Centres = all.Centres.Part(begin, count);
    own.Masses += begin;
    for (const float*& lengths : own.Lengths)
    {
      lengths += 3 * begin;
    }
    // Two layers, the rest, nothing.
    LatticePart<3> part = whole;
    part.Low[2] = ranks.Own() == 0 ? 0 : 2;
    part.Cells[2] = ranks.Own() == 0 ? 2 : ranks.Own() == 1 ? size[2] - 2 : 0;
    const std::vector<double> found = densityOf<3>(own, grid, clouds.Mass(), part, context);
    const auto first = alone.begin() + part.Low[2] * size[0] * size[1];
    EXPECT_EQ(found, std::vector<double>(first, first + part.Count()));
  });
}

} // namespace
} // namespace RectifiedTransport
