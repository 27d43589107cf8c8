// SPDX-License-Identifier: BSD-3-Clause
// The moves of corners that fit the fluxes through the faces about them.
#include "Core/Equalize/Kernels/EqualizeKernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// Cells that are squeezed into a plane: the faces about a corner are nearly parallel, and the
// fluxes are those of a move across the plane. No corner moves much further.
TEST(CornerMoves, OfParallelFaces)
{
  constexpr std::int64_t cells = 5000;
  constexpr double move = 0.1;
  std::mt19937 random(1);
  std::normal_distribution<double> bend;
  for (const double height : { 1e-7, 1e-5, 1e-3 })
  {
    std::vector<std::vector<double>> values;
    CornerRow<3> row;
    for (int b = -1; b < 2; ++b)
    {
      for (int a = -1; a < 2; ++a)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          std::vector<double> x;
          for (std::int64_t i = 0; i <= cells; ++i)
          {
            x.push_back(axis == 0 ? static_cast<double>(i) + 0.5 * b
                : axis == 1       ? a + 0.3 * b
                                  : height * bend(random));
          }
          values.push_back(std::move(x));
        }
      }
    }
    for (int r = 0; r < 9; ++r)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        row.Corners[r].X[axis] = values[static_cast<std::size_t>(3 * r + axis)].data();
      }
    }
    row.Cells = cells;
    // Two rows of cells along axes 1 and 2; the areas of the faces are -0.5, -0.3 and 1.
    const std::int64_t strides[3] = { 1, cells + 2, 2 * (cells + 2) };
    const auto all = static_cast<std::size_t>(2 * strides[2]);
    const double areas[3] = { -0.5, -0.3, 1.0 };
    std::vector<float> weights[3];
    std::vector<double> potential;
    for (std::size_t q = 0; q < all; ++q)
    {
      const auto at = static_cast<std::int64_t>(q);
      potential.push_back(
        static_cast<double>(at % strides[1] + at / strides[1] % 2 + at / strides[2]));
    }
    const std::int64_t first = strides[1] + strides[2] + 1;
    std::vector<float> moves[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      weights[axis].assign(all, static_cast<float>(move * areas[axis]));
      moves[axis].assign(static_cast<std::size_t>(cells + 1), 0.0F);
      row.Weights[axis] = weights[axis].data() + first;
      row.Stride[axis] = strides[axis];
      row.Moves[axis] = moves[axis].data();
    }
    row.Potential = potential.data() + first;
    equalizeKernels<3>().Moves(row);
    for (std::size_t i = 1; i < static_cast<std::size_t>(cells); ++i)
    {
      const auto x = static_cast<double>(moves[0][i]);
      const auto y = static_cast<double>(moves[1][i]);
      const auto z = static_cast<double>(moves[2][i]);
      EXPECT_NEAR(z, move, 0.01 * move) << i << ", " << height;
      EXPECT_LT(std::hypot(x, y), move) << i << ", " << height;
    }
  }
}

} // namespace
} // namespace RectifiedTransport
