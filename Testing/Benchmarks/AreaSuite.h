// SPDX-License-Identifier: BSD-3-Clause
// Densities on which areas and masses are measured: smooth ones, sharp shapes of several contrasts,
// and noise. AreaPhotographs.h adds those that are read from files.
#ifndef RectifiedTransport_AreaSuite_h
#define RectifiedTransport_AreaSuite_h

#include "../Core/TestDensities.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace AreaSuite
{

// Standard normal, the same on every platform up to the rounding of its functions.
inline double normalNumber(std::mt19937_64& engine)
{
  const double radius = std::sqrt(-2.0 * std::log(uniformNumber(engine) + 1e-300));
  return radius * std::cos(6.283185307179586 * uniformNumber(engine));
}

// The mean of value(p) over points^Dimension places of each cell.
template <int Dimension, class F>
TestDensity<Dimension> meanOfCells(const GridSize<Dimension>& size, int points, const F& value)
{
  GridSize<Dimension> inner;
  inner.fill(points);
  const std::int64_t count = cellCount<Dimension>(inner);
  return sampleDensity<Dimension>(size, [&](const Point<Dimension>& centre) {
    double sum = 0.0;
    for (std::int64_t index = 0; index < count; ++index)
    {
      const GridSize<Dimension> place = cellAt<Dimension>(index, inner);
      Point<Dimension> p = centre;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        p[axis] += ((static_cast<double>(place[axis]) + 0.5) / points - 0.5) /
          static_cast<double>(size[axis]);
      }
      sum += value(p);
    }
    return sum / static_cast<double>(count);
  });
}

template <int Dimension>
double squaredDistance(const Point<Dimension>& p, const Point<Dimension>& q)
{
  double sum = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    sum += (p[axis] - q[axis]) * (p[axis] - q[axis]);
  }
  return sum;
}

template <int Dimension>
double gaussian(const Point<Dimension>& p, const Point<Dimension>& centre, double deviation)
{
  return std::exp(-squaredDistance<Dimension>(p, centre) / (2.0 * deviation * deviation));
}

// A disc or ball of a density over 1 (or over 0).
template <int Dimension>
TestDensity<Dimension> ball(
  const GridSize<Dimension>& size, double radius, double inside, double outside, int points)
{
  Point<Dimension> centre = evenPoint<Dimension>(0.5);
  centre[0] = 0.45;
  centre[1] = 0.52;
  return meanOfCells<Dimension>(size, points, [&](const Point<Dimension>& p) {
    return squaredDistance<Dimension>(p, centre) < radius * radius ? inside : outside;
  });
}

// Lognormal clumps over a thin ground, as in a cosmological simulation.
template <int Dimension>
TestDensity<Dimension> clumps(const GridSize<Dimension>& size, double scale, double spread)
{
  struct Clump
  {
    Point<Dimension> Centre;
    double Deviation;
    double Height;
  };
  std::mt19937_64 engine(11);
  std::vector<Clump> all(150);
  for (Clump& clump : all)
  {
    for (double& coordinate : clump.Centre)
    {
      coordinate = uniformNumber(engine);
    }
    clump.Deviation = scale * std::exp(spread * normalNumber(engine));
    clump.Height = std::exp(1.2 * normalNumber(engine));
  }
  return sampleDensity<Dimension>(size, [&](const Point<Dimension>& p) {
    double sum = 0.03;
    for (const Clump& clump : all)
    {
      sum += clump.Height * gaussian<Dimension>(p, clump.Centre, clump.Deviation);
    }
    return sum;
  });
}

} // namespace AreaSuite

// A density of the plane by its name:
//   gauss, gausses   one wide Gaussian; five, with empty parts
//   peak             a narrow Gaussian over 1e-3
//   disc01, star01   1 inside, 0 outside
//   circle           a line of 1, a cell wide, over 1e-6
//   disc<R>, square<R>, checker<R>   R times as dense as the rest
//   noise, noise3, noiselog   independent cells: uniform, its cube, lognormal
//   clumps           150 Gaussians over 0.03
inline TestDensity<2> areaDensity2D(const std::string& name, const GridSize<2>& size)
{
  using namespace AreaSuite;
  const auto contrast = [&name](const std::string& kind) {
    return name.rfind(kind, 0) == 0 ? std::atof(name.c_str() + kind.size()) : 0.0;
  };
  if (name == "gauss")
  {
    return sampleDensity<2>(size, [](const Point<2>& p) {
      return gaussian<2>(p, { 0.45, 0.55 }, 0.15);
    });
  }
  if (name == "gausses")
  {
    return sampleDensity<2>(size, [](const Point<2>& p) {
      return gaussian<2>(p, { 0.3, 0.3 }, 0.08) + 0.7 * gaussian<2>(p, { 0.7, 0.25 }, 0.12) +
        2.0 * gaussian<2>(p, { 0.6, 0.7 }, 0.05) + 0.8 * gaussian<2>(p, { 0.2, 0.75 }, 0.1) +
        1.5 * gaussian<2>(p, { 0.85, 0.85 }, 0.04);
    });
  }
  if (name == "peak")
  {
    return sampleDensity<2>(size, [](const Point<2>& p) {
      return 1e-3 + gaussian<2>(p, { 0.4, 0.57 }, 0.03);
    });
  }
  if (name == "disc01")
  {
    return ball<2>(size, 0.3, 1.0, 0.0, 8);
  }
  if (name == "star01")
  {
    return meanOfCells<2>(size, 8, [](const Point<2>& p) {
      const double angle = std::atan2(p[1] - 0.5, p[0] - 0.5);
      const double radius = std::hypot(p[0] - 0.5, p[1] - 0.5);
      return radius < 0.3 * (1.0 + 0.4 * std::cos(5.0 * angle)) ? 1.0 : 0.0;
    });
  }
  if (name == "circle")
  {
    return sampleDensity<2>(size, [&size](const Point<2>& p) {
      const double radius = std::hypot(p[0] - 0.5, p[1] - 0.5);
      return std::abs(radius - 1.0 / 3.0) * static_cast<double>(size[0]) < 0.7 ? 1.0 : 1e-6;
    });
  }
  if (const double ratio = contrast("disc"); ratio > 0.0)
  {
    return ball<2>(size, 0.15, ratio, 1.0, 8);
  }
  if (const double ratio = contrast("square"); ratio > 0.0)
  {
    return sampleDensity<2>(size, [ratio](const Point<2>& p) {
      return p[0] > 0.25 && p[0] < 0.5 && p[1] > 0.5 && p[1] < 0.75 ? ratio : 1.0;
    });
  }
  if (const double ratio = contrast("checker"); ratio > 0.0)
  {
    return sampleDensity<2>(size, [ratio](const Point<2>& p) {
      const int square = static_cast<int>(8.0 * p[0]) + static_cast<int>(8.0 * p[1]);
      return square % 2 == 1 ? ratio : 1.0;
    });
  }
  if (name == "noise" || name == "noise3" || name == "noiselog")
  {
    std::mt19937_64 engine(7);
    return sampleDensity<2>(size, [&](const Point<2>&) {
      if (name == "noiselog")
      {
        return std::exp(1.5 * normalNumber(engine));
      }
      const double value = uniformNumber(engine);
      return name == "noise" ? value : value * value * value;
    });
  }
  if (name == "clumps")
  {
    return clumps<2>(size, 0.006, 0.6);
  }
  throw std::invalid_argument("no density of the plane is called " + name);
}

// A density of space: ball<R>, R times as dense as the rest, and clumps.
inline TestDensity<3> areaDensity3D(const std::string& name, const GridSize<3>& size)
{
  using namespace AreaSuite;
  if (name.rfind("ball", 0) == 0)
  {
    return ball<3>(size, 0.2, std::atof(name.c_str() + 4), 1.0, 4);
  }
  if (name == "clumps")
  {
    return clumps<3>(size, 0.02, 0.4);
  }
  throw std::invalid_argument("no density of space is called " + name);
}

} // namespace RectifiedTransport

#endif
