// SPDX-License-Identifier: BSD-3-Clause
// How a kernel shares a particle's mass among the cells along one axis.
#ifndef RectifiedTransport_SplatWeights_h
#define RectifiedTransport_SplatWeights_h

#include "Splat.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Particles are placed in blocks of this many structure-of-arrays lanes.
constexpr int splatBlock = 64;

using SplatLanes = double[splatBlock];
using SplatCells = std::int32_t[splatBlock];

// The kernels of a fixed number of cells an axis. Weigh finds the first cell and the weights of
// each lane, whose coordinates are in [0, size]; cells may lie beyond the border.
struct CloudInCellKernel
{
  static constexpr int Width = 2;
  static void Weigh(
    const double* __restrict x, std::int32_t, std::int32_t* __restrict cell, SplatLanes* weight)
  {
    double* __restrict w0 = weight[0];
    double* __restrict w1 = weight[1];
#pragma omp simd
    for (int i = 0; i < splatBlock; ++i)
    {
      const std::int32_t own = static_cast<std::int32_t>(x[i]);
      const double part = x[i] - own;
      const bool upper = part >= 0.5;
      cell[i] = own - (upper ? 0 : 1);
      w1[i] = part + (upper ? -0.5 : 0.5);
      w0[i] = 1.0 - w1[i];
    }
  }
};

struct NearestCellKernel
{
  static constexpr int Width = 1;
  static void Weigh(const double* __restrict x, std::int32_t size, std::int32_t* __restrict cell,
    SplatLanes* weight)
  {
    double* __restrict w0 = weight[0];
#pragma omp simd
    for (int i = 0; i < splatBlock; ++i)
    {
      const std::int32_t own = static_cast<std::int32_t>(x[i]);
      cell[i] = own < size ? own : size - 1;
      w0[i] = 1.0;
    }
  }
};

struct TriangularShapedCloudKernel
{
  static constexpr int Width = 3;
  static void Weigh(
    const double* __restrict x, std::int32_t, std::int32_t* __restrict cell, SplatLanes* weight)
  {
    double* __restrict w0 = weight[0];
    double* __restrict w1 = weight[1];
    double* __restrict w2 = weight[2];
#pragma omp simd
    for (int i = 0; i < splatBlock; ++i)
    {
      const std::int32_t own = static_cast<std::int32_t>(x[i]);
      const double offset = x[i] - own - 0.5;
      cell[i] = own - 1;
      w0[i] = 0.5 * (0.5 - offset) * (0.5 - offset);
      w2[i] = 0.5 * (0.5 + offset) * (0.5 + offset);
      w1[i] = 1.0 - w0[i] - w2[i];
    }
  }
};

// The Gaussian, whose number of cells an axis follows from its width.
class GaussianKernel
{
public:
  // Up to this radius the kernel reaches no more than two cells an axis, and weights of two cells
  // that keep the centroid are those of the CloudInCell.
  static constexpr double SmallestRadius = 1.0 / 3.0;

  explicit GaussianKernel(double radius)
    : Reach(std::max(3.0 * radius, 1.0))
    , PerVariance(1.0 / (radius * radius))
  {
    const int farthest = static_cast<int>(this->Reach + 0.5) + 1;
    for (int k = 0; k <= farthest; ++k)
    {
      this->AtOffset.push_back(Exponential(-0.5 * k * k * this->PerVariance));
    }
  }

  // Of all weights that Weigh writes; those past the cut are 0.
  int Width() const { return static_cast<int>(2.0 * this->Reach) + 1; }

  std::int32_t FirstCell(double x, std::int32_t size) const
  {
    const std::int32_t own = OwnCell(x, size);
    return own + this->FirstOffset(x - own - 0.5);
  }

  // Writes the weights of the cells from FirstCell on, which is returned.
  std::int32_t Weigh(double x, std::int32_t size, double* weight) const
  {
    const std::int32_t own = OwnCell(x, size);
    const double offset = x - own - 0.5; // from the centre of its own cell
    const int width = this->Width();
    const int first = this->FirstOffset(offset);
    // exp(-(k - offset)^2 / 2 sigma^2), up to a factor, by powers of one exponential.
    const double up = Exponential(offset * this->PerVariance);
    const double down = 1.0 / up;
    for (int sign = -1; sign <= 1; sign += 2)
    {
      const double ratio = sign < 0 ? down : up;
      double power = 1.0;
      for (int k = 0; k < width; ++k)
      {
        const int cell = sign * k - first;
        if (cell < 0 || cell >= width)
        {
          break;
        }
        weight[cell] = power * this->AtOffset[static_cast<std::size_t>(k)];
        power *= ratio;
      }
    }
    double sum = 0.0;
    double moment = 0.0;
    double second = 0.0;
    for (int k = 0; k < width; ++k)
    {
      const double distance = first + k - offset;
      weight[k] = distance <= this->Reach ? weight[k] : 0.0;
      sum += weight[k];
      moment += weight[k] * distance;
      second += weight[k] * distance * distance;
    }
    const double determinant = sum * second - moment * moment;
    const double constant = second / determinant;
    const double slope = -moment / determinant;
    for (int k = 0; k < width; ++k)
    {
      weight[k] *= constant + slope * (first + k - offset);
    }
    return own + first;
  }

private:
  static std::int32_t OwnCell(double x, std::int32_t size)
  {
    return std::min(static_cast<std::int32_t>(x), size - 1);
  }
  int FirstOffset(double offset) const { return static_cast<int>(std::ceil(offset - this->Reach)); }

  // exp(x) from basic operations alone: the library's may differ in the last bit from one processor
  // to the next.
  static double Exponential(double x)
  {
    int halvings = 0;
    for (; std::abs(x) > 0.5; ++halvings)
    {
      x *= 0.5;
    }
    double sum = 1.0;
    for (int term = 13; term > 0; --term)
    {
      sum = 1.0 + sum * x / term;
    }
    for (; halvings > 0; --halvings)
    {
      sum *= sum;
    }
    return sum;
  }

  double Reach;
  double PerVariance;
  std::vector<double> AtOffset;
};

// Moves weights [0, width) of the cells from `cell` on to the `kept` = min(width, size) cells from
// the returned one on, which are inside; what was outside is shared among them or lost.
inline std::int32_t keepInside(std::int32_t cell, int width, std::int32_t size, bool renormalize,
  double* weight, std::ptrdiff_t stride)
{
  const int kept = std::min<std::int32_t>(width, size);
  const std::int32_t first = std::min(std::max(cell, 0), size - kept);
  const std::int32_t shift = first - cell;
  const auto moved = [&](int k) {
    const std::int32_t from = k + shift;
    return from >= 0 && from < width ? weight[from * stride] : 0.0;
  };
  double sum = 0.0;
  // Weights move down if the first cells are outside, else up: none is overwritten before it is
  // read.
  for (int step = 0; step < kept; ++step)
  {
    const int k = shift >= 0 ? step : kept - 1 - step;
    weight[k * stride] = moved(k);
  }
  for (int k = 0; k < kept; ++k)
  {
    sum += weight[k * stride];
  }
  for (int k = 0; k < kept && renormalize; ++k)
  {
    weight[k * stride] /= sum;
  }
  return first;
}

} // namespace RectifiedTransport

#endif
