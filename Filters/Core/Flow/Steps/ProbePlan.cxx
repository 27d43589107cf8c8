// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Steps/ProbePlan.h"

#include "Core/Flow/Steps/BlockSurface.h"
#include "Core/Flow/Steps/SymmetricPlace.h"
#include "Core/Geometry/ReproducibleMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t fewestCells = 4; // along an axis of a block; no more than a quarter of it
// Of 2,048 blocks the third largest error is that of 99.9 %.
constexpr double mostBlocks = 2048.0;
constexpr std::int64_t mostSideBySide = 8192; // more take too long

template <int Dimension>
GridSize<Dimension> smallestBlock(const GridSize<Dimension>& size)
{
  GridSize<Dimension> side;
  std::transform(size.begin(), size.end(), side.begin(),
    [](std::int64_t cells) { return std::clamp<std::int64_t>(cells / 4, 1, fewestCells); });
  return side;
}

// The side of a cube, square or interval, with the same bits everywhere.
double sideOf(double volume, int dimension)
{
  return dimension == 3 ? cubeRoot(volume) : dimension == 2 ? std::sqrt(volume) : volume;
}

// As nearly a cube as the axes allow.
template <int Dimension>
GridSize<Dimension> blockOf(double volume, const GridSize<Dimension>& size)
{
  std::array<int, Dimension> axes;
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] < size[b]; });
  GridSize<Dimension> side = smallestBlock<Dimension>(size);
  for (int done = 0; done < Dimension; ++done)
  {
    const int axis = axes[static_cast<std::size_t>(done)];
    const double wanted = std::ceil(sideOf(volume, Dimension - done));
    const auto cells = static_cast<double>(size[axis]);
    side[axis] = std::max(side[axis], static_cast<std::int64_t>(std::min(wanted, cells)));
    volume = std::max(1.0, volume / static_cast<double>(side[axis]));
  }
  return side;
}

} // namespace

double particlesThatShow(double part)
{
  const double root = cubeRoot(part);
  return 1.0 / (root * root * root * root);
}

template <int Dimension>
ProbePlan<Dimension>::ProbePlan(const GridSize<Dimension>& size)
  : Side(smallestBlock<Dimension>(size))
{
  std::int64_t all = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t side = this->Side[axis];
    const bool fit = size[axis] % side == 0;
    this->SideBySide[axis] = fit ? size[axis] / side : 2 * (size[axis] / (2 * side) + 1);
    all *= this->SideBySide[axis];
  }
  if (all <= mostSideBySide)
  {
    this->Blocks = all;
    return;
  }
  // Of a symmetric density the images of a place show the same, and in 3D there are many.
  constexpr double each = Dimension == 3 ? 4.0 : 1.0;
  this->SideBySide = {};
  this->Take(each * this->BlocksOf(size));
}

template <int Dimension>
void ProbePlan<Dimension>::Spread(std::int64_t most)
{
  this->SideBySide = {};
  this->Take(static_cast<double>(std::min(this->Blocks, most)));
}

template <int Dimension>
Point<Dimension> ProbePlan<Dimension>::LowestOf(
  std::int64_t number, const GridSize<Dimension>& size) const
{
  Point<Dimension> low;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t count = this->SideBySide[axis];
    const std::int64_t at = number % count;
    low[axis] = static_cast<double>(
      2 * at < count ? at * this->Side[axis] : size[axis] - (count - at) * this->Side[axis]);
    number /= count;
  }
  return low;
}

template <int Dimension>
ProbePlan<Dimension>::ProbePlan(const GridSize<Dimension>& size, double particles, double tolerance)
  : Side(blockOf<Dimension>(
      particlesThatShow(tolerance) * numberOfCells<Dimension>(size) / particles, size))
{
  // Points are 4 cells or more apart. Those of all blocks together take a tenth of the particles'
  // time; of few blocks a half.
  constexpr std::int64_t mostParts = Dimension == 3 ? 3 : 8;
  constexpr double part = 1.0 / 30.0;
  constexpr double mostPart = 1.0 / 4.0;
  const double blocks = this->BlocksOf(size);
  const std::int64_t shortest = *std::min_element(this->Side.begin(), this->Side.end());
  this->Parts = static_cast<int>(std::clamp<std::int64_t>(shortest / fewestCells, 1, mostParts));
  const auto pointsOf = [](int parts) {
    return static_cast<double>(BlockSurface<Dimension>(parts).Count());
  };
  constexpr auto fewest = static_cast<double>(SymmetricPlace<Dimension>::Images);
  while (this->Parts > 1 && fewest * pointsOf(this->Parts) > mostPart * particles)
  {
    --this->Parts;
  }
  const double each = pointsOf(this->Parts);
  if (blocks >= 2.0 && fewest * each <= mostPart * particles)
  {
    this->Take(std::min(0.5 * blocks, part * particles / each));
  }
}

template <int Dimension>
double ProbePlan<Dimension>::BlocksOf(const GridSize<Dimension>& size) const
{
  return numberOfCells<Dimension>(size) / numberOfCells<Dimension>(this->Side);
}

template <int Dimension>
void ProbePlan<Dimension>::Take(double blocks)
{
  constexpr std::int64_t images = SymmetricPlace<Dimension>::Images;
  const auto taken = static_cast<std::int64_t>(std::min(blocks, mostBlocks));
  this->Blocks = std::max(images, taken / images * images);
}

template struct ProbePlan<1>;
template struct ProbePlan<2>;
template struct ProbePlan<3>;

} // namespace RectifiedTransport
