// SPDX-License-Identifier: BSD-3-Clause
// Which blocks of cells show the error of a flow, and how many of them are looked at.
#ifndef RectifiedTransport_ProbePlan_h
#define RectifiedTransport_ProbePlan_h

#include "Core/Flow/Steps/BlockSurface.h"
#include "Core/Flow/Steps/SymmetricPlace.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/ReproducibleMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace RectifiedTransport
{

// So many particles of blue noise in a block differ from the density by about a part of this many:
// the count varies by k^(1/4), so the part is k^(-3/4).
inline double particlesThatShow(double part)
{
  const double root = cubeRoot(part);
  return 1.0 / (root * root * root * root);
}

template <int Dimension>
struct ProbePlan
{
  // For a map, forward or backward: blocks of 4 cells along each axis, all that lie side by side,
  // or some where those are too many.
  explicit ProbePlan(const GridSize<Dimension>& size)
    : Side(smallestBlock(size))
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
    // Images of a place under a density's symmetry show the same, and in 3D there are many.
    constexpr double each = Dimension == 3 ? 4.0 : 1.0;
    this->SideBySide = {};
    this->Take(each * this->BlocksOf(size));
  }

  // For so many particles that go forward: blocks in which they show an error of the tolerance.
  // None if there are fewer than two, or so few particles that looking would take longer than they
  // do.
  ProbePlan(const GridSize<Dimension>& size, double particles, double tolerance)
    : Side(blockOf(particlesThatShow(tolerance) * numberOfCells<Dimension>(size) / particles, size))
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

  GridSize<Dimension> Side; // side of a block, in cells
  int Parts = 1;            // parts of a block's edge between the points that are moved
  std::int64_t Blocks = 0;  // a multiple of SymmetricPlace's Images, but of those side by side
  GridSize<Dimension> SideBySide{}; // how many lie so along each axis; 0: blocks are spread

  // At most so many, spread.
  void Spread(std::int64_t most)
  {
    this->SideBySide = {};
    this->Take(static_cast<double>(std::min(this->Blocks, most)));
  }

  // The lowest corner of one of those side by side. They lie as those of mirror images do: where
  // they do not fit, those of the upper half overlap with those of the lower.
  Point<Dimension> LowestOf(std::int64_t number, const GridSize<Dimension>& size) const
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

private:
  static constexpr std::int64_t fewestCells = 4;       // along an axis of a block
  static constexpr std::int64_t mostSideBySide = 8192; // more take too long

  // No more than a quarter of an axis.
  static GridSize<Dimension> smallestBlock(const GridSize<Dimension>& size)
  {
    GridSize<Dimension> side;
    std::transform(size.begin(), size.end(), side.begin(),
      [](std::int64_t cells) { return std::clamp<std::int64_t>(cells / 4, 1, fewestCells); });
    return side;
  }

  // As nearly a cube as the axes allow.
  static GridSize<Dimension> blockOf(double volume, const GridSize<Dimension>& size)
  {
    std::array<int, Dimension> axes;
    std::iota(axes.begin(), axes.end(), 0);
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] < size[b]; });
    GridSize<Dimension> side = smallestBlock(size);
    for (int done = 0; done < Dimension; ++done)
    {
      const int axis = axes[static_cast<std::size_t>(done)];
      // The side of a cube, square or interval, with the same bits everywhere.
      const int left = Dimension - done;
      const double wanted = std::ceil(left == 3 ? cubeRoot(volume)
          : left == 2                           ? std::sqrt(volume)
                                                : volume);
      const auto cells = static_cast<double>(size[axis]);
      side[axis] = std::max(side[axis], static_cast<std::int64_t>(std::min(wanted, cells)));
      volume = std::max(1.0, volume / static_cast<double>(side[axis]));
    }
    return side;
  }

  double BlocksOf(const GridSize<Dimension>& size) const
  {
    return numberOfCells<Dimension>(size) / numberOfCells<Dimension>(this->Side);
  }

  void Take(double blocks)
  {
    // 99.9 % of 2,048 blocks have at most the third largest error.
    constexpr double mostBlocks = 2048.0;
    constexpr std::int64_t images = SymmetricPlace<Dimension>::Images;
    const auto taken = static_cast<std::int64_t>(std::min(blocks, mostBlocks));
    this->Blocks = std::max(images, taken / images * images);
  }
};

} // namespace RectifiedTransport

#endif
