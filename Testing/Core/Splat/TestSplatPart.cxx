// SPDX-License-Identifier: BSD-3-Clause
// Parts of a grid: their cells have the bits of the whole splat, in memory of their own.
#include "TestSplat.h"

#include "Core/Splat/SplatSetup.h"

#include <gtest/gtest.h>

#include <memory>

namespace RectifiedTransport
{
namespace
{

// Parts that do not fill the grid: corners, layers, single cells, one with no cells.
template <int D>
std::vector<LatticePart<D>> partsOf(const GridSize<D>& size)
{
  std::vector<LatticePart<D>> parts{ LatticePart<D>::WholeOf(size) };
  for (int axis = 0; axis < D; ++axis)
  {
    LatticePart<D> layers = parts[0];
    layers.Low[axis] = size[axis] / 3;
    layers.Cells[axis] = size[axis] - size[axis] / 2;
    parts.push_back(layers);
    layers.Low[axis] = size[axis] - 1;
    layers.Cells[axis] = 1;
    parts.push_back(layers);
  }
  LatticePart<D> inner = parts[0];
  LatticePart<D> none = parts[0];
  for (int axis = 0; axis < D; ++axis)
  {
    inner.Low[axis] = size[axis] / 4;
    inner.Cells[axis] = size[axis] / 2;
    none.Cells[axis] = axis == 0 ? 0 : 1;
  }
  parts.push_back(inner);
  parts.push_back(none);
  return parts;
}

template <int D, class Real>
void checkParts(const GridSize<D>& size, const SplatParticles<D, Real>& particles,
  const SplatOptions& options, const std::vector<int>& concurrencies)
{
  const std::vector<double> whole = splat(particles, size, options).Cells;
  const auto grid = LatticePart<D>::WholeOf(size);
  for (const LatticePart<D>& part : partsOf<D>(size))
  {
    const auto count = static_cast<std::size_t>(part.Count());
    for (const int concurrency : concurrencies)
    {
      // Exactly as much memory, so that sanitizers see what is written beyond it.
      const auto cells = std::make_unique<double[]>(count);
      std::fill_n(cells.get(), count, -7.0);
      splatMass<D, Real>(
        particles, size, part, options, 1.0, cells.get(), BackwardExecutor(concurrency));
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < count; ++i)
      {
        const std::int64_t cell = grid.NumberOf(part.CellOf(static_cast<std::int64_t>(i)));
        wrong += cells[i] != whole[static_cast<std::size_t>(cell)] ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0u) << D << "D, kernel " << static_cast<int>(options.Kernel) << ", "
                           << concurrency << " tasks";
    }
  }
}

template <int D>
void checkKernels(const GridSize<D>& size, std::int64_t count)
{
  for (const SplatKernel kernel : allKernels)
  {
    for (const SplatBoundary boundary : { SplatBoundary::Renormalize, SplatBoundary::Drop })
    {
      const SplatOptions options = splatOptions(kernel, boundary);
      for (const bool sorted : { false, true })
      {
        const Cloud<D> cloud = randomCloud<D>(size, count, -0.3, sorted);
        checkParts<D, double>(size, cloud.Particles(), options, { 1, 3, 64 });
      }
      const Cloud<D, float> single = randomCloud<D, float>(size, count / 2, -0.3, false);
      checkParts<D, float>(size, single.Particles(), options, { 1, 3 });
      checkParts<D, double>(size, borderCloud<D>(size).Particles(), options, { 1, 3 });
    }
  }
}

TEST(SplatPart, HasTheBitsOfTheWhole)
{
  checkKernels<1>({ 300 }, 9001);
  checkKernels<2>({ 150, 20 }, 9001);
  checkKernels<3>({ 36, 5, 70 }, 9001);
  checkKernels<3>({ 2, 30, 1 }, 4500);
}

// Many tiles and planes.
TEST(SplatPart, OfALargeGrid)
{
  const GridSize<3> size{ 130, 120, 110 };
  for (const bool sorted : { false, true })
  {
    const Cloud<3> cloud = randomCloud<3>(size, 300000, -0.01, sorted);
    for (const SplatKernel kernel : { SplatKernel::CloudInCell, SplatKernel::Gaussian })
    {
      checkParts<3, double>(size, cloud.Particles(), splatOptions(kernel), { 20 });
    }
  }
}

// Axes that the grid does not share with space.
TEST(SplatPart, Oblique)
{
  const GridSize<2> size{ 40, 30 };
  Cloud<2> cloud = randomCloud<2>(size, 3000, -0.3, false);
  SplatParticles<2, double> particles = cloud.Particles();
  const double rows[2][3] = { { 0.8, 0.6, 0.0 }, { -0.6, 0.8, 0.0 } };
  std::copy_n(&rows[0][0], 6, &particles.ToIndex.Matrix[0][0]);
  for (const SplatKernel kernel : allKernels)
  {
    checkParts<2, double>(size, particles, splatOptions(kernel), { 1, 5 });
  }
}

// No particle adds to cells but those that are found for it.
template <int D>
void checkFound(const GridSize<D>& size, SplatKernel kernel)
{
  const Cloud<D> cloud = randomCloud<D>(size, 200, -0.3, false);
  const SplatOptions options = splatOptions(kernel);
  const SplatSetup<D, double> setup(cloud.Particles(), size, options);
  std::vector<std::int32_t> first(static_cast<std::size_t>(3 * cloud.Count()));
  const std::int64_t outside =
    setup.Kernels.Find(setup.Job, 0, static_cast<int>(cloud.Count()), first.data());
  EXPECT_EQ(outside, splat(cloud.Particles(), size, options).Outside);
  const auto grid = LatticePart<D>::WholeOf(size);
  for (std::int64_t i = 0; i < cloud.Count(); ++i)
  {
    SplatParticles<D, double> one = cloud.Particles();
    one.Points = one.Points.Part(i, 1);
    one.Masses += i;
    const std::vector<double> cells = splat(one, size, options).Cells;
    for (std::size_t c = 0; c < cells.size(); ++c)
    {
      const GridSize<D> cell = grid.CellOf(static_cast<std::int64_t>(c));
      bool isFound = true;
      for (int a = 0; a < D; ++a)
      {
        const std::int64_t from = cell[a] - first[static_cast<std::size_t>(3 * i + a)];
        isFound = isFound && from >= 0 && from < setup.Job.Span[a];
      }
      EXPECT_TRUE(isFound || cells[c] == 0.0);
    }
  }
}

TEST(SplatPart, FoundCellsAreAllThatAreReached)
{
  for (const SplatKernel kernel : allKernels)
  {
    checkFound<1>({ 50 }, kernel);
    checkFound<2>({ 12, 9 }, kernel);
    checkFound<3>({ 6, 2, 9 }, kernel);
  }
}

} // namespace
} // namespace RectifiedTransport
