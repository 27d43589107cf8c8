// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distance/ClassicalScaling.h"

#include "Core/Parallel/Progress.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

using Matrix = Eigen::MatrixXd;

// Double centring, B = -1/2 J D^2 J with J = 1 - 1/n: if points with these distances exist, B_ij
// are the inner products of their offsets from the centroid.
Matrix productsOf(const std::vector<double>& distances, Eigen::Index count)
{
  Matrix products(count, count);
  // Means of the squared distances over each row, and over all.
  std::vector<double> means(static_cast<std::size_t>(count), 0.0);
  double mean = 0.0;
  for (Eigen::Index i = 0; i < count; ++i)
  {
    for (Eigen::Index j = 0; j < count; ++j)
    {
      const double d = distances[static_cast<std::size_t>(i * count + j)];
      products(i, j) = d * d;
      means[static_cast<std::size_t>(i)] += products(i, j) / static_cast<double>(count);
    }
    mean += means[static_cast<std::size_t>(i)] / static_cast<double>(count);
  }
  for (Eigen::Index i = 0; i < count; ++i)
  {
    for (Eigen::Index j = 0; j < count; ++j)
    {
      products(i, j) = -0.5 *
        (products(i, j) - means[static_cast<std::size_t>(i)] - means[static_cast<std::size_t>(j)] +
          mean);
    }
  }
  return products;
}

// The sign of an eigenvector is arbitrary: its entry of largest magnitude, the first one up to
// rounding, is made positive.
double signOf(const Eigen::VectorXd& vector)
{
  constexpr double rounding = 1e-9;
  const double largest = vector.cwiseAbs().maxCoeff();
  for (const double entry : vector)
  {
    if (std::abs(entry) >= (1.0 - rounding) * largest)
    {
      return entry < 0.0 ? -1.0 : 1.0;
    }
  }
  return 1.0;
}

// Computes Kruskal's stress over all pairs.
double stressOf(const std::vector<double>& distances, const ScaledPoints& points, std::size_t count,
  int dimensions)
{
  const auto axes = static_cast<std::size_t>(dimensions);
  double lost = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      double square = 0.0;
      for (std::size_t k = 0; k < axes; ++k)
      {
        const double offset = points.Coordinates[i * axes + k] - points.Coordinates[j * axes + k];
        square += offset * offset;
      }
      const double d = distances[i * count + j];
      // Squared deviations of the distances, relative to the squared distances.
      lost += (d - std::sqrt(square)) * (d - std::sqrt(square));
      all += d * d;
    }
  }
  return all > 0.0 ? std::sqrt(lost / all) : 0.0;
}

} // namespace

ScaledPoints scaleClassically(
  const std::vector<double>& distances, std::int64_t count, int dimensions, const Context& context)
{
  Progress progress(context);
  progress.Check();
  const auto axes = static_cast<std::size_t>(dimensions);
  ScaledPoints points;
  points.Coordinates.assign(static_cast<std::size_t>(count) * axes, 0.0);
  // Relative to the largest distance, no square overflows.
  const double unit = count > 0 ? *std::max_element(distances.begin(), distances.end()) : 0.0;
  if (!(unit > 0.0))
  {
    return points;
  }
  std::vector<double> scaled = distances;
  std::for_each(scaled.begin(), scaled.end(), [=](double& d) { d /= unit; });
  // The eigenvectors of B with the largest eigenvalues span the best Euclidean approximation
  // (Torgerson).
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(productsOf(scaled, count));
  // Eigenvalues are in rising order. Coordinate k is sqrt(lambda_k) v_k; negative eigenvalues,
  // which non-Euclidean distances have, are left out.
  for (std::int64_t k = 0; k < std::min<std::int64_t>(dimensions, count); ++k)
  {
    const double value = solver.eigenvalues()[count - 1 - k];
    if (!(value > 0.0))
    {
      break;
    }
    const Eigen::VectorXd vector = solver.eigenvectors().col(count - 1 - k);
    const double factor = signOf(vector) * std::sqrt(value);
    for (std::int64_t i = 0; i < count; ++i)
    {
      points.Coordinates[static_cast<std::size_t>(i) * axes + static_cast<std::size_t>(k)] =
        factor * vector[i];
    }
  }
  points.Stress = stressOf(scaled, points, static_cast<std::size_t>(count), dimensions);
  std::for_each(
    points.Coordinates.begin(), points.Coordinates.end(), [=](double& x) { x *= unit; });
  return points;
}

} // namespace RectifiedTransport
