// SPDX-License-Identifier: BSD-3-Clause
// Densities and particles of the report, beside those of the core's tests.
#ifndef RectifiedTransport_ReportInputs_h
#define RectifiedTransport_ReportInputs_h

#include "../Core/TestDensities.h"

#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/Executor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
using Particles = std::vector<Point<Dimension>>;

// "385 x 450"
template <int Dimension>
std::string nameOf(const GridSize<Dimension>& size)
{
  std::string name;
  for (const std::int64_t cells : size)
  {
    name += (name.empty() ? "" : " x ") + std::to_string(cells);
  }
  return name;
}

inline FlowOptions withSteps(int steps, FlowMaps maps)
{
  FlowOptions options;
  options.NumberOfSteps = steps;
  options.Maps = maps;
  return options;
}

// A number in [0, 1) of a point of a lattice of integers.
template <int Dimension>
double hashedNumber(const GridSize<Dimension>& place, std::uint64_t seed)
{
  std::uint64_t bits = seed;
  for (const std::int64_t coordinate : place)
  {
    bits = (bits ^ static_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15ULL;
    bits ^= bits >> 29;
  }
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

// Such numbers with smooth transitions between them.
template <int Dimension>
double smoothNoise(const Point<Dimension>& p, std::uint64_t seed)
{
  GridSize<Dimension> low;
  Point<Dimension> weight;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    low[axis] = static_cast<std::int64_t>(std::floor(p[axis]));
    const double t = p[axis] - static_cast<double>(low[axis]);
    weight[axis] = t * t * (3.0 - 2.0 * t);
  }
  double sum = 0.0;
  for (int corner = 0; corner < (1 << Dimension); ++corner)
  {
    GridSize<Dimension> place = low;
    double share = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const int upper = corner >> axis & 1;
      place[axis] += upper;
      share *= upper ? weight[axis] : 1.0 - weight[axis];
    }
    sum += share * hashedNumber<Dimension>(place, seed);
  }
  return sum;
}

// Like a photograph: whole numbers from 0 to 255, contrast on all scales, sharp edges and some
// empty parts.
template <int Dimension>
TestDensity<Dimension> photographLike(const GridSize<Dimension>& size)
{
  TestDensity<Dimension> density{ size, std::vector<double>(cellCount<Dimension>(size)) };
  const auto longest = static_cast<double>(*std::max_element(size.begin(), size.end()));
  OpenMPExecutor().For(static_cast<std::int64_t>(density.Values.size()), 4096,
    [&](std::int64_t first, std::int64_t last) {
      for (; first < last; ++first)
      {
        const GridSize<Dimension> cell = cellAt<Dimension>(first, size);
        Point<Dimension> p;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          p[axis] = (static_cast<double>(cell[axis]) + 0.5) / longest;
        }
        double value = 0.0;
        double amplitude = 1.0;
        double frequency = 4.0;
        constexpr int octaves = Dimension == 3 ? 4 : 7;
        for (int octave = 0; octave < octaves; ++octave, amplitude *= 0.6, frequency *= 2.0)
        {
          Point<Dimension> q = p;
          for (double& coordinate : q)
          {
            coordinate *= frequency;
          }
          value +=
            amplitude * (smoothNoise<Dimension>(q, static_cast<std::uint64_t>(octave) + 1) - 0.5);
        }
        const bool isShape = squaredDistance<Dimension>(p, 0.4) < 0.05 || p[0] + p[1] > 1.4;
        const double shade = (isShape ? 40.0 : 130.0) + 230.0 * value;
        density.Values[static_cast<std::size_t>(first)] =
          std::min(std::max(std::floor(shade), 0.0), 255.0);
      }
    });
  return density;
}

// Independent uniform points in the box.
template <int Dimension>
Particles<Dimension> randomParticles(const GridSize<Dimension>& size, std::size_t count)
{
  std::mt19937_64 engine(7);
  Particles<Dimension> particles(count);
  for (Point<Dimension>& point : particles)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      point[axis] = uniformNumber(engine) * static_cast<double>(size[axis]);
    }
  }
  return particles;
}

// Points whose coordinates are whole numbers, on the border and far outside, and numbers next to
// those.
template <int Dimension>
Particles<Dimension> awkwardParticles(const GridSize<Dimension>& size, std::size_t count)
{
  std::mt19937_64 engine(11);
  Particles<Dimension> particles(count);
  for (Point<Dimension>& point : particles)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto length = static_cast<double>(size[axis]);
      const double within = uniformNumber(engine) * length;
      const double face = std::floor(within);
      const double choices[] = { within, face, std::nextafter(face, -1.0),
        std::nextafter(face, length), 0.0, length, -0.0, std::nextafter(length, 0.0), -within,
        length + within, -1e300, 1e300, 5e-324 };
      point[axis] = choices[engine() % (sizeof(choices) / sizeof(choices[0]))];
    }
  }
  return particles;
}

} // namespace RectifiedTransport

#endif
