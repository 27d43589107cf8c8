// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distance/DensityMoments.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Covariance3 = Eigen::Matrix3d;

// Sums of f, f x and f x x^T over the cells' centres.
struct RawMoments
{
  double Mass = 0.0;
  Eigen::Vector3d First = Eigen::Vector3d::Zero();
  Covariance3 Second = Covariance3::Zero();

  void Add(const RawMoments& other)
  {
    this->Mass += other.Mass;
    this->First += other.First;
    this->Second += other.Second;
  }
};

// The symmetric root of a positive semidefinite matrix; eigenvalues that rounding makes negative
// count as 0.
Covariance3 rootOf(const Covariance3& matrix)
{
  const Eigen::SelfAdjointEigenSolver<Covariance3> solver(matrix);
  const Eigen::Vector3d roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
}

Covariance3 matrixOf(const DensityMoments& moments)
{
  return Eigen::Map<const Covariance3>(moments.Covariance[0].data()); // symmetric
}

} // namespace

template <int Dimension>
DensityMoments momentsOf(const DensityValues& density, const GridSize<Dimension>& cells,
  const Point<Dimension>& sides, const Context& context)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  Progress progress(context);
  // Places are relative to the centre of the box, so that the covariance E(x x^T) - m m^T cancels
  // little.
  const auto readChunk = [&](std::int64_t first, std::int64_t last) {
    std::vector<double> values(static_cast<std::size_t>(last - first));
    density.Read(first, last - first, values.data());
    RawMoments sum;
    for (std::int64_t i = first; i < last; ++i)
    {
      const double mass = values[static_cast<std::size_t>(i - first)];
      // The centre of the cell; coordinates beyond the dimension are 0.
      double x[3]{};
      std::int64_t rest = i;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const double place = static_cast<double>(rest % cells[axis]) + 0.5;
        x[axis] = (place / static_cast<double>(cells[axis]) - 0.5) * sides[axis];
        rest /= cells[axis];
      }
      sum.Mass += mass;
      for (int a = 0; a < 3; ++a)
      {
        sum.First[a] += mass * x[a];
        for (int b = 0; b <= a; ++b)
        {
          sum.Second(a, b) += mass * x[a] * x[b];
        }
      }
    }
    return sum;
  };
  const auto join = [](RawMoments all, const RawMoments& chunk) {
    all.Add(chunk);
    return all;
  };
  // Chunks are added in their order, for the same bits with any number of threads.
  const RawMoments raw =
    reduceChunks(progress, static_cast<std::int64_t>(numberOfCells<Dimension>(cells)), grain,
      RawMoments(), readChunk, join);
  DensityMoments moments;
  const Eigen::Vector3d mean = raw.First / raw.Mass;
  for (std::size_t a = 0; a < Dimension; ++a)
  {
    const auto row = static_cast<Eigen::Index>(a);
    moments.Mean[a] = mean[row] + 0.5 * sides[a];
    for (std::size_t b = 0; b <= a; ++b)
    {
      const auto column = static_cast<Eigen::Index>(b);
      // E(x_a x_b) - E(x_a) E(x_b).
      const double covariance = raw.Second(row, column) / raw.Mass - mean[row] * mean[column];
      moments.Covariance[a][b] = moments.Covariance[b][a] = covariance;
    }
    // The variance of the uniform measure on a cell, side^2 / 12, is added to that of the centres.
    const double side = sides[a] / static_cast<double>(cells[a]);
    moments.Covariance[a][a] = std::max(0.0, moments.Covariance[a][a]) + side * side / 12.0;
  }
  return moments;
}

double leastSquaredDistance(const DensityMoments& a, const DensityMoments& b)
{
  // Gelbrich: |m_a - m_b|^2 + tr(A + B - 2 (A^1/2 B A^1/2)^1/2).
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double offset = a.Mean[axis] - b.Mean[axis];
    square += offset * offset;
  }
  const Covariance3 first = matrixOf(a);
  const Covariance3 second = matrixOf(b);
  const Covariance3 root = rootOf(first);
  const double cross = rootOf(root * second * root).trace();
  const double traces = first.trace() + second.trace();
  // Subtract what rounding of the moments and roots may add, so that the bound stays valid.
  constexpr double rounding = 1e-7;
  return std::max(0.0, square + std::max(0.0, traces - 2.0 * cross - rounding * traces));
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(momentsOf);

} // namespace RectifiedTransport
