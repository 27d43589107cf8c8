// SPDX-License-Identifier: BSD-3-Clause
// Uniform particles become particles that are distributed like the density: block by block, and
// in the mean.
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace RectifiedTransport
{
namespace
{

// The share of mass in each block of the grid, and the centroid.
template <int Dimension>
struct Distribution
{
  std::vector<double> Shares;
  Point<Dimension> Centroid{};

  Distribution(const GridSize<Dimension>& size, std::int64_t block)
    : Block(block)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Blocks[axis] = (size[axis] + block - 1) / block;
    }
    this->Shares.resize(cellCount<Dimension>(this->Blocks));
  }

  void Add(const GridSize<Dimension>& cell, const Point<Dimension>& point, double share)
  {
    GridSize<Dimension> block;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      block[axis] = cell[axis] / this->Block;
      this->Centroid[axis] += share * point[axis];
    }
    this->Shares[cellIndex<Dimension>(block, this->Blocks)] += share;
  }

private:
  std::int64_t Block;
  GridSize<Dimension> Blocks;
};

template <int Dimension>
void expectConserved(const TestDensity<Dimension>& density, std::int64_t perCell,
  std::int64_t block, double blockError, double centroidError)
{
  double total = 0.0;
  for (const double value : density.Values)
  {
    total += value;
  }
  Distribution<Dimension> wanted(density.Size, block);
  GridSize<Dimension> lattice;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    lattice[axis] = perCell * density.Size[axis];
  }
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(i), density.Size);
    Point<Dimension> centre;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      centre[axis] = static_cast<double>(cell[axis]) + 0.5;
    }
    wanted.Add(cell, centre, density.Values[i] / total);
  }

  const RectifiedFlow<Dimension> flow = makeFlow(density);
  EXPECT_NEAR(flow.Total() / total, 1.0, 1e-13);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    EXPECT_NEAR(flow.Centroid()[axis], wanted.Centroid[axis], 1e-9);
  }

  const Points<Dimension> positions =
    runForward(flow, latticePoints<Dimension>(density.Size, lattice), steps(64));
  Distribution<Dimension> found(density.Size, block);
  for (const Point<Dimension>& position : positions)
  {
    found.Add(cellOf<Dimension>(position, density.Size), position,
      1.0 / static_cast<double>(positions.size()));
  }
  double difference = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < wanted.Shares.size(); ++i)
  {
    difference += std::pow(found.Shares[i] - wanted.Shares[i], 2);
    norm += std::pow(wanted.Shares[i], 2);
  }
  EXPECT_LT(std::sqrt(difference / norm), blockError);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    EXPECT_NEAR(found.Centroid[axis], wanted.Centroid[axis], centroidError);
  }
}

TEST(Conservation, Gaussians)
{
  expectConserved(twoGaussians<1>({ 400 }), 8, 8, 0.02, 0.02);
  expectConserved(twoGaussians<2>({ 120, 96 }), 3, 8, 0.02, 0.02);
  expectConserved(twoGaussians<3>({ 30, 24, 36 }), 2, 6, 0.03, 0.02);
}

TEST(Conservation, RandomCells)
{
  expectConserved(randomCells<2>({ 120, 96 }), 3, 8, 0.02, 0.02);
  expectConserved(randomCells<3>({ 30, 24, 36 }), 2, 6, 0.02, 0.02);
}

TEST(Conservation, DiscWithHole)
{
  expectConserved(discWithHole<2>({ 128, 128 }), 3, 8, 0.03, 0.02);
  expectConserved(discWithHole<3>({ 32, 32, 32 }), 2, 4, 0.05, 0.02);
}

TEST(Conservation, Checker)
{
  expectConserved(checker<2>({ 128, 96 }, 8), 3, 8, 0.03, 0.03);
}

} // namespace
} // namespace RectifiedTransport
