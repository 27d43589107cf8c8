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
TEST(CornerDisplacements, OfParallelFaces)
{
  constexpr std::int64_t cells = 5000;
  constexpr double move = 0.1;
  // Two directions in the plane, and its normal.
  constexpr double third = 1.0 / 3.0;
  const double turned[3][3] = { { 2 * third, 2 * third, -third }, { -third, 2 * third, 2 * third },
    { 2 * third, -third, 2 * third } };
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
        std::vector<double> x[3];
        for (std::int64_t i = 0; i <= cells; ++i)
        {
          const double at[3] = { static_cast<double>(i) + 0.5 * b, a + 0.3 * b,
            height * bend(random) };
          for (int axis = 0; axis < 3; ++axis)
          {
            x[axis].push_back(
              turned[0][axis] * at[0] + turned[1][axis] * at[1] + turned[2][axis] * at[2]);
          }
        }
        for (std::vector<double>& of : x)
        {
          values.push_back(std::move(of));
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
      double along[3] = {};
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int direction = 0; direction < 3; ++direction)
        {
          along[direction] += turned[direction][axis] * static_cast<double>(moves[axis][i]);
        }
      }
      EXPECT_NEAR(along[2], move, 0.01 * move) << i << ", " << height;
      EXPECT_LT(std::hypot(along[0], along[1]), move) << i << ", " << height;
    }
  }
}

} // namespace
} // namespace RectifiedTransport
