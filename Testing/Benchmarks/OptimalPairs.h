// SPDX-License-Identifier: BSD-3-Clause
// Pairs of densities between which optimal maps are measured: smooth ones, shapes in voids, thin
// lines, filaments, and what stands still.
#ifndef RectifiedTransport_OptimalPairs_h
#define RectifiedTransport_OptimalPairs_h

#include "../Core/TestDensities.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
using DensityMaker = std::function<TestDensity<Dimension>()>;

template <int Dimension>
struct OptimalPair
{
  using Choice = std::function<bool(const Point<Dimension>&)>;

  OptimalPair(std::string name, DensityMaker<Dimension> source, DensityMaker<Dimension> target,
    Choice isFixed = nullptr)
    : Name(std::move(name))
    , Source(std::move(source))
    , Target(std::move(target))
    , IsFixed(std::move(isFixed))
  {
  }

  std::string Name;
  DensityMaker<Dimension> Source;
  DensityMaker<Dimension> Target;
  // Whether a point of the unit box belongs to a part that is the same in both; or empty.
  Choice IsFixed;
};

// A plane cuts solids in the middle.
struct PairPoint
{
  explicit PairPoint(const Point<2>& p)
    : X(p[0])
    , Y(p[1])
  {
  }
  explicit PairPoint(const Point<3>& p)
    : X(p[0])
    , Y(p[1])
    , Z(p[2])
  {
  }

  double Bell(double x, double y, double z, double deviation) const
  {
    return std::exp(-this->Square(x, y, z) / (2.0 * deviation * deviation));
  }
  bool IsInBall(double x, double y, double z, double radius) const
  {
    return this->Square(x, y, z) < radius * radius;
  }
  double Square(double x, double y, double z) const
  {
    const double dx = this->X - x;
    const double dy = this->Y - y;
    const double dz = this->Z - z;
    return dx * dx + dy * dy + dz * dz;
  }

  double X;
  double Y;
  double Z = 0.5;
};

inline double blobs(const PairPoint& p)
{
  return 0.02 + p.Bell(0.3, 0.35, 0.4, 0.1) + 0.7 * p.Bell(0.7, 0.75, 0.6, 0.07);
}

inline double otherBlobs(const PairPoint& p)
{
  return 0.02 + p.Bell(0.7, 0.3, 0.55, 0.12) + 0.5 * p.Bell(0.25, 0.7, 0.3, 0.06);
}

inline double star(const PairPoint& p)
{
  const double radius = std::hypot(p.X - 0.5, p.Y - 0.5);
  const double angle = std::atan2(p.Y - 0.5, p.X - 0.5);
  return radius < 0.42 * (1.0 - 0.55 * (0.5 + 0.5 * std::cos(5.0 * angle))) ? 1.0 : 0.0;
}

inline double ring(const PairPoint& p)
{
  const double radius = std::hypot(p.X - 0.5, p.Y - 0.5);
  return radius > 0.22 && radius < 0.36 && std::abs(p.Z - 0.5) < 0.25 ? 1.0 : 0.0;
}

inline double cross(const PairPoint& p)
{
  const double x = std::abs(p.X - 0.5);
  const double y = std::abs(p.Y - 0.5);
  const bool isIn = std::min(x, y) < 0.08 && std::max(x, y) < 0.4 && std::abs(p.Z - 0.5) < 0.4;
  return isIn ? 1.0 : 0.0;
}

inline double turnedGaussian(const PairPoint& p, double turn)
{
  const double u = std::cos(turn) * (p.X - 0.5) + std::sin(turn) * (p.Y - 0.5);
  const double v = std::cos(turn) * (p.Y - 0.5) - std::sin(turn) * (p.X - 0.5);
  return std::exp(-u * u / 0.0072 - v * v / 0.0018);
}

inline double twoDisks(const PairPoint& p)
{
  return p.IsInBall(0.25, 0.3, 0.5, 0.15) || p.IsInBall(0.7, 0.72, 0.5, 0.2) ? 1.0 : 0.0;
}

// Sharp, over a faint background.
inline double filaments(const PairPoint& p)
{
  return 0.01 +
    std::pow(std::abs(std::sin(9.0 * p.X + 3.0 * std::sin(7.0 * p.Y) + 0.5) *
               std::cos(8.0 * p.Y - 2.0 * std::sin(5.0 * p.X) - 0.5)),
      12.0);
}

// Two disks, the first of them at a fixed place.
inline double diskAnd(const PairPoint& p, double x, double weight, double background)
{
  return background + (p.IsInBall(0.3, 0.3, 0.5, 0.12) ? 1.0 : 0.0) +
    (p.IsInBall(x, 0.7, 0.5, 0.12) ? weight : 0.0);
}

inline double gaussianAnd(const PairPoint& p, double x)
{
  return p.Bell(0.3, 0.3, 0.5, 0.05) + p.Bell(x, 0.7, 0.5, 0.05);
}

// A line of `width` cells of a grid of `side`.
inline double line(const PairPoint& p, double side, double width)
{
  const double column = std::floor(p.X * side) - std::floor(0.6 * side);
  return column >= 0.0 && column < width && std::abs(p.Y - 0.5) < 0.3 ? 1.0 : 0.0;
}

// A body with a head and thin legs.
inline double animal(const PairPoint& p)
{
  bool isIn = p.IsInBall(0.35, 0.5, 0.55, 0.14) || p.IsInBall(0.55, 0.5, 0.55, 0.14) ||
    p.IsInBall(0.76, 0.5, 0.68, 0.1);
  for (const double x : { 0.3, 0.6 })
  {
    for (const double y : { 0.42, 0.58 })
    {
      isIn = isIn || (std::hypot(p.X - x, p.Y - y) < 0.04 && p.Z > 0.2 && p.Z < 0.5);
    }
  }
  return isIn ? 1.0 : 0.0;
}

template <int Dimension, class Value>
DensityMaker<Dimension> onSquares(std::int64_t side, Value value)
{
  return [=] {
    return sampleDensity<Dimension>(
      evenSize<Dimension>(side), [&](const Point<Dimension>& p) { return value(PairPoint(p)); });
  };
}

inline std::vector<OptimalPair<2>> optimalPairs2D(std::int64_t side)
{
  const auto on = [=](const auto& value) { return onSquares<2>(side, value); };
  const auto with = [=](double x, double weight, double background) {
    return on([=](const PairPoint& p) { return diskAnd(p, x, weight, background); });
  };
  const auto gaussians = [=](double x) {
    return on([=](const auto& p) { return gaussianAnd(p, x); });
  };
  const auto turned = [=](double turn) {
    return on([=](const auto& p) { return turnedGaussian(p, turn); });
  };
  const auto isFixed = [](const Point<2>& p) { return PairPoint(p).IsInBall(0.3, 0.3, 0.5, 0.12); };
  const auto lines = [=](double width) {
    return on([=](const PairPoint& p) { return line(p, static_cast<double>(side), width); });
  };
  const auto disk =
    on([](const PairPoint& p) { return p.IsInBall(0.5, 0.5, 0.5, 0.2) ? 1.0 : 0.0; });
  const auto uniform = on([](const PairPoint&) { return 1.0; });
  return { { "blobs", on(blobs), on(otherBlobs) }, { "star_ring", on(star), on(ring) },
    { "disks_filaments", on(twoDisks), on(filaments) }, { "star_cross", on(star), on(cross) },
    { "turned_Gaussians", turned(0.3), turned(1.3) },
    { "unequal_disks_moved", with(0.55, 1.0, 0.0), with(0.8, 0.9, 0.0), isFixed },
    { "unequal_disks", with(0.8, 1.0, 0.0), with(0.8, 0.9, 0.0), isFixed },
    { "disk_line_2", disk, lines(2.0) }, { "disk_line_4", disk, lines(4.0) },
    { "still_void", with(0.55, 1.0, 0.0), with(0.8, 1.0, 0.0), isFixed },
    { "still_background", with(0.55, 1.0, 0.01), with(0.8, 1.0, 0.01), isFixed },
    { "still_Gaussians", gaussians(0.5), gaussians(0.75), isFixed },
    { "uniform_star", uniform, on(star) }, { "uniform_filaments", uniform, on(filaments) },
    { "ring_star", on(ring), on(star) }, { "filaments_disks", on(filaments), on(twoDisks) },
    { "cross_blobs", on(cross), on(blobs) } };
}

inline std::vector<OptimalPair<3>> optimalPairs3D(std::int64_t side)
{
  const auto on = [=](const auto& value) { return onSquares<3>(side, value); };
  return { { "blobs", on(blobs), on(otherBlobs) }, { "animal_ring", on(animal), on(ring) },
    { "ring_animal", on(ring), on(animal) }, { "cross_blobs", on(cross), on(otherBlobs) } };
}

template <int Dimension>
OptimalPair<Dimension> optimalPair(const std::string& name, std::int64_t side)
{
  const auto pairs = [=]() {
    if constexpr (Dimension == 2)
    {
      return optimalPairs2D(side);
    }
    else
    {
      return optimalPairs3D(side);
    }
  }();
  return *std::find_if(
    pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.Name == name; });
}

} // namespace RectifiedTransport

#endif
