// SPDX-License-Identifier: BSD-3-Clause
// Particles to a grid: mass and centroid, weights against their definitions, the border, the
// transform to index space.
#include "TestSplat.h"
#include "TestDensities.h"
#include "TestDimensions.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

template <int D>
GridSize<D> someSize()
{
  return sizeFor<D>({ 23 }, { 23, 19 }, { 23, 19, 21 });
}

template <class T>
using Splat = DimensionTest<T>;
TYPED_TEST_SUITE(Splat, Dimensions, );

TYPED_TEST(Splat, KeepsMassAndCentroid)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  for (const SplatKernel kernel : allKernels)
  {
    for (const double radius : { 0.2, 1.0 / 3.0, 0.34, 0.5, 1.0, 2.3 })
    {
      const double margin = 3.0 * radius + 1.6;
      const Cloud<D> cloud = randomCloud<D>(size, 500, margin, false);
      for (const SplatBoundary boundary : { SplatBoundary::Renormalize, SplatBoundary::Drop })
      {
        const Splatted result =
          splat(cloud.Particles(), size, splatOptions(kernel, boundary, radius));
        EXPECT_EQ(result.Outside, 0);
        const double mass = sumOf(cloud.Masses);
        EXPECT_NEAR(sumOf(result.Cells), mass, 1e-12 * mass);
        for (int a = 0; a < D && kernel != SplatKernel::NearestCell; ++a)
        {
          double moment = 0.0;
          for (std::size_t i = 0; i < cloud.Masses.size(); ++i)
          {
            moment += cloud.Masses[i] * cloud.Points[3 * i + static_cast<std::size_t>(a)];
          }
          EXPECT_NEAR(firstMoment<D>(result.Cells, size, a), moment, 1e-12 * std::abs(moment))
            << static_cast<int>(kernel) << " " << radius << " axis " << a;
        }
      }
    }
  }
}

TYPED_TEST(Splat, KeepsMassAtBorders)
{
  constexpr int D = TypeParam::value;
  // Also grids with fewer cells than the kernels.
  for (const std::int64_t cells : { 1, 2, 3, 5, 12 })
  {
    const auto size = evenSize<D>(cells);
    const Cloud<D> cloud = borderCloud<D>(size);
    for (const SplatKernel kernel : allKernels)
    {
      const Splatted kept = splat(cloud.Particles(), size, splatOptions(kernel));
      const double mass = static_cast<double>(cloud.Count());
      EXPECT_EQ(kept.Outside, 0);
      EXPECT_NEAR(sumOf(kept.Cells), mass, 1e-12 * mass) << static_cast<int>(kernel) << cells;
      EXPECT_GE(*std::min_element(kept.Cells.begin(), kept.Cells.end()), 0.0);
      const Splatted dropped =
        splat(cloud.Particles(), size, splatOptions(kernel, SplatBoundary::Drop));
      EXPECT_EQ(dropped.Outside, 0);
      for (std::size_t i = 0; i < kept.Cells.size(); ++i)
      {
        EXPECT_LE(dropped.Cells[i], kept.Cells[i] + 1e-12);
      }
      if (kernel != SplatKernel::NearestCell)
      {
        EXPECT_LT(sumOf(dropped.Cells), 0.9 * mass);
      }
    }
  }
}

// Blocks whose particles are all on one face between cells, or in the middle of one.
TYPED_TEST(Splat, KeepsMassOnFaces)
{
  constexpr int D = TypeParam::value;
  for (const std::int64_t cells : { 1, 2, 3, 6 })
  {
    const auto size = evenSize<D>(cells);
    for (std::int64_t half = 0; half <= 2 * cells; ++half)
    {
      Point<D> point;
      for (int a = 0; a < D; ++a)
      {
        point[a] = 0.5 * static_cast<double>(half);
      }
      Cloud<D> cloud;
      for (int i = 0; i < 130; ++i)
      {
        cloud.Add(point, 1.0);
      }
      for (const SplatKernel kernel : allKernels)
      {
        const Splatted result = splat(cloud.Particles(), size, splatOptions(kernel));
        EXPECT_EQ(result.Outside, 0);
        EXPECT_NEAR(sumOf(result.Cells), 130.0, 1e-10)
          << static_cast<int>(kernel) << " at " << half << " halves of " << cells;
      }
    }
  }
}

// The kernels as they are defined, by a distance from the particle.
double definition(SplatKernel kernel, double distance, double radius)
{
  const double d = std::abs(distance);
  switch (kernel)
  {
    case SplatKernel::CloudInCell:
      return std::max(0.0, 1.0 - d);
    case SplatKernel::NearestCell:
      return d < 0.5 ? 1.0 : 0.0;
    case SplatKernel::TriangularShapedCloud:
      return d < 0.5 ? 0.75 - d * d : d < 1.5 ? 0.5 * (1.5 - d) * (1.5 - d) : 0.0;
    default:
      return d <= 3.0 * radius ? std::exp(-0.5 * d * d / (radius * radius)) : 0.0;
  }
}

std::vector<double> definedWeights(
  SplatKernel kernel, double x, std::int64_t size, SplatBoundary boundary, double radius)
{
  const auto beyond = static_cast<std::int64_t>(3.0 * radius) + 3;
  double moments[3] = { 0.0, 0.0, 0.0 };
  for (std::int64_t cell = -beyond; cell < size + beyond; ++cell)
  {
    const double d = static_cast<double>(cell) + 0.5 - x;
    for (int power = 0; power < 3; ++power)
    {
      moments[power] += definition(kernel, d, radius) * std::pow(d, power);
    }
  }
  const double determinant = moments[0] * moments[2] - moments[1] * moments[1];
  std::vector<double> weights;
  double sum = 0.0;
  for (std::int64_t cell = 0; cell < size; ++cell)
  {
    const double d = static_cast<double>(cell) + 0.5 - x;
    const double corrected =
      kernel == SplatKernel::Gaussian ? (moments[2] - moments[1] * d) / determinant : 1.0;
    weights.push_back(definition(kernel, d, radius) * corrected);
    sum += weights.back();
  }
  for (double& weight : weights)
  {
    weight /= boundary == SplatBoundary::Renormalize ? sum : 1.0;
  }
  return weights;
}

TEST(SplatWeights, AreThoseOfTheDefinition)
{
  const GridSize<2> size{ 9, 7 };
  const double xs[] = { 0.1, 0.9, 1.3, 4.4, 4.6, 7.99, 8.7 };
  const double ys[] = { 0.2, 2.75, 3.4, 6.95 };
  for (const SplatKernel kernel : allKernels)
  {
    for (const double radius : { 0.4, 1.0, 1.9 })
    {
      for (const SplatBoundary boundary : { SplatBoundary::Renormalize, SplatBoundary::Drop })
      {
        for (const double x : xs)
        {
          for (const double y : ys)
          {
            Cloud<2> cloud;
            cloud.Add({ x, y }, 2.0);
            const Splatted result =
              splat(cloud.Particles(), size, splatOptions(kernel, boundary, radius));
            const std::vector<double> wx = definedWeights(kernel, x, size[0], boundary, radius);
            const std::vector<double> wy = definedWeights(kernel, y, size[1], boundary, radius);
            for (std::size_t i = 0; i < result.Cells.size(); ++i)
            {
              EXPECT_NEAR(result.Cells[i], 2.0 * wx[i % 9] * wy[i / 9], 1e-13)
                << static_cast<int>(kernel) << " " << x << " " << y << " cell " << i;
            }
          }
        }
      }
    }
  }
}

TEST(SplatWeights, NarrowGaussianIsCloudInCell)
{
  const GridSize<3> size{ 12, 11, 10 };
  const Cloud<3> cloud = randomCloud<3>(size, 300, 0.0, false);
  const Splatted cloudInCell =
    splat(cloud.Particles(), size, splatOptions(SplatKernel::CloudInCell));
  for (const double radius : { 1e-300, 0.01, 1.0 / 3.0 })
  {
    const SplatOptions options =
      splatOptions(SplatKernel::Gaussian, SplatBoundary::Renormalize, radius);
    EXPECT_EQ(splat(cloud.Particles(), size, options).Cells, cloudInCell.Cells);
  }
  // It comes to it continuously.
  const SplatOptions wider =
    splatOptions(SplatKernel::Gaussian, SplatBoundary::Renormalize, 1.0 / 3.0 + 1e-7);
  const Splatted near = splat(cloud.Particles(), size, wider);
  double difference = 0.0;
  for (std::size_t i = 0; i < near.Cells.size(); ++i)
  {
    difference = std::max(difference, std::abs(near.Cells[i] - cloudInCell.Cells[i]));
  }
  EXPECT_LT(difference, 0.05);
}

TEST(SplatWeights, GaussianWiderThanTheGrid)
{
  const GridSize<2> size{ 6, 4 };
  Cloud<2> cloud;
  cloud.Add({ 2.3, 1.1 }, 1.0);
  for (const double radius : { 20.0, SplatOptions::LargestRadius })
  {
    const Splatted result = splat(cloud.Particles(), size,
      splatOptions(SplatKernel::Gaussian, SplatBoundary::Renormalize, radius));
    EXPECT_NEAR(sumOf(result.Cells), 1.0, 1e-12);
    for (const double cell : result.Cells)
    {
      EXPECT_NEAR(cell, 1.0 / 24.0, radius > 100.0 ? 1e-6 : 2e-3);
    }
  }
}

TEST(SplatOutside, MovedOrLeftOut)
{
  const GridSize<2> size{ 5, 4 };
  Cloud<2> cloud;
  cloud.Add({ -3.0, 1.5 }, 1.0);
  cloud.Add({ 2.5, 9.0 }, 10.0);
  cloud.Add({ 2.5, 1.5 }, 100.0);
  cloud.Add({ 2.5, 1.5 }, 1000.0);
  cloud.Points[3 * 3 + 2] = 0.5; // off the plane
  for (const SplatKernel kernel : allKernels)
  {
    const Splatted moved = splat(cloud.Particles(), size, splatOptions(kernel));
    EXPECT_EQ(moved.Outside, 3);
    EXPECT_NEAR(sumOf(moved.Cells), 1111.0, 1e-9);
    const Splatted dropped =
      splat(cloud.Particles(), size, splatOptions(kernel, SplatBoundary::Drop));
    EXPECT_EQ(dropped.Outside, 3);
    Cloud<2> inside;
    inside.Add({ 2.5, 1.5 }, 100.0);
    EXPECT_EQ(dropped.Cells,
      splat(inside.Particles(), size, splatOptions(kernel, SplatBoundary::Drop)).Cells);
  }
  EXPECT_EQ(splat(cloud.Particles(), size, splatOptions(SplatKernel::NearestCell)).Cells[5], 1.0);
}

// Coordinates whose index overflows are outside.
TEST(SplatOutside, Overflow)
{
  const GridSize<3> size{ 5, 4, 3 };
  Cloud<3> cloud;
  cloud.Add({ 1e308, -1e308, 1e308 }, 1.0);
  SplatParticles<3, double> particles = cloud.Particles();
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c)
    {
      particles.ToIndex.Matrix[r][c] = r == c ? 1e10 : 1e9;
    }
  }
  for (const SplatKernel kernel : allKernels)
  {
    for (const int concurrency : { 1, 2 })
    {
      const Splatted result =
        splat(particles, size, splatOptions(kernel), BackwardExecutor(concurrency));
      EXPECT_EQ(result.Outside, 1);
      EXPECT_NEAR(sumOf(result.Cells), 1.0, 1e-12);
    }
  }
}

// A rotated and scaled grid with particles rotated and scaled alike gives the same result.
TEST(SplatToIndex, RotatedGrid)
{
  const GridSize<3> size{ 16, 14, 12 };
  const Cloud<3> cloud = randomCloud<3>(size, 2000, 0.0, false);
  Cloud<3> turned = cloud;
  // Columns of a rotation, scaled; its transpose over the squared scale is its inverse.
  const double axes[3][3] = { { 0.6, 0.8, 0.0 }, { -0.8, 0.6, 0.0 }, { 0.0, 0.0, 1.0 } };
  const double scale = 0.25;
  SplatParticles<3, double> particles = turned.Particles();
  for (std::size_t i = 0; i < turned.Masses.size(); ++i)
  {
    for (std::size_t r = 0; r < 3; ++r)
    {
      double x = 100.0;
      for (std::size_t a = 0; a < 3; ++a)
      {
        x += scale * axes[a][r] * cloud.Points[3 * i + a];
      }
      turned.Points[3 * i + r] = x;
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    particles.ToIndex.Origin[a] = 100.0;
    for (int r = 0; r < 3; ++r)
    {
      particles.ToIndex.Matrix[a][r] = axes[a][r] / scale;
    }
  }
  for (const SplatKernel kernel : { SplatKernel::CloudInCell, SplatKernel::Gaussian })
  {
    const Splatted expected = splat(cloud.Particles(), size, splatOptions(kernel));
    const Splatted result = splat(particles, size, splatOptions(kernel));
    EXPECT_EQ(result.Outside, 0);
    for (std::size_t i = 0; i < expected.Cells.size(); ++i)
    {
      ASSERT_NEAR(result.Cells[i], expected.Cells[i], 1e-10);
    }
  }
}

TEST(SplatInput, FloatsAndOneMass)
{
  const GridSize<2> size{ 40, 30 };
  const Cloud<2, float> single = randomCloud<2, float>(size, 777, 0.0, false);
  Cloud<2> cloud;
  cloud.Points.assign(single.Points.begin(), single.Points.end());
  cloud.Masses.assign(single.Masses.size(), 0.3);
  const Splatted expected = splat(cloud.Particles(), size, SplatOptions());
  SplatParticles<2, float> particles = single.Particles();
  particles.Masses = nullptr;
  particles.Mass = 0.3;
  EXPECT_EQ(splat(particles, size, SplatOptions()).Cells, expected.Cells);
}

// A scale applies to masses of their own as to the one of all.
TEST(SplatInput, Scale)
{
  const GridSize<2> size{ 40, 30 };
  const Cloud<2> cloud = randomCloud<2>(size, 777, 0.0, false);
  SplatParticles<2, double> ofOneMass = cloud.Particles();
  ofOneMass.Masses = nullptr;
  ofOneMass.Mass = 0.3;
  for (const SplatParticles<2, double>& particles : { cloud.Particles(), ofOneMass })
  {
    for (const SplatKernel kernel : allKernels)
    {
      const SplatOptions options = splatOptions(kernel);
      Splatted whole = splat(particles, size, options);
      std::vector<double> half(whole.Cells.size());
      splatMass<2, double>(particles, size, options, 0.5, half.data(), SerialExecutor());
      for (double& cell : whole.Cells)
      {
        cell *= 0.5;
      }
      EXPECT_EQ(half, whole.Cells) << static_cast<int>(kernel);
    }
  }
}

TEST(SplatInput, NoParticles)
{
  const GridSize<1> size{ 100 };
  const SplatParticles<1, double> none{ {}, nullptr, 1.0, identityMap<1>() };
  EXPECT_EQ(splat(none, size, SplatOptions()).Cells, std::vector<double>(100, 0.0));
}

} // namespace
} // namespace RectifiedTransport
