// SPDX-License-Identifier: BSD-3-Clause
// What the tests of particles of an optimal map share: particles that are samples of a density, and
// how far their masses in boxes are from it.
#ifndef RectifiedTransport_ParticleMasses_h
#define RectifiedTransport_ParticleMasses_h

#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/Parallel/Progress.h"
#include "Core/Quality/GridBlocks.h"

#include "TestDensities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
using Particles = std::vector<Point<Dimension>>;

template <int Dimension>
CellDensity<Dimension> cellDensity(const TestDensity<Dimension>& density)
{
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  return CellDensity<Dimension>(density.Source(), progress);
}

// Independent samples.
template <int Dimension>
Particles<Dimension> samplesOf(
  const TestDensity<Dimension>& density, std::size_t number, std::uint64_t seed = 7)
{
  std::mt19937_64 engine(seed);
  std::vector<double> sums(density.Values.size());
  std::partial_sum(density.Values.begin(), density.Values.end(), sums.begin());
  Particles<Dimension> particles(number);
  for (Point<Dimension>& particle : particles)
  {
    const double sum = uniformNumber(engine) * sums.back();
    const auto cell = std::upper_bound(sums.begin(), sums.end(), sum) - sums.begin();
    const GridSize<Dimension> place = cellAt<Dimension>(cell, density.Size);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      particle[axis] = static_cast<double>(place[axis]) + uniformNumber(engine);
    }
  }
  return particles;
}

// A density times a smooth function from .6 to 1.4.
template <int Dimension>
TestDensity<Dimension> distorted(const TestDensity<Dimension>& density)
{
  TestDensity<Dimension> other =
    sampleDensity<Dimension>(density.Size, [](const Point<Dimension>& p) {
      double product = 1.0;
      for (const double x : p)
      {
        product *= std::sin(7.0 * x + 1.0);
      }
      return 1.0 + 0.4 * product;
    });
  std::transform(other.Values.begin(), other.Values.end(), density.Values.begin(),
    other.Values.begin(), [](double a, double b) { return a * b; });
  return other;
}

// Blocks of `side` cells a side that begin at `begin`, as far as they fit.
template <int Dimension>
std::vector<GridBox<Dimension>> blocksOf(
  const GridSize<Dimension>& size, std::int64_t side, std::int64_t begin)
{
  GridSize<Dimension> number;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    number[axis] = (size[axis] - begin) / side;
  }
  std::vector<GridBox<Dimension>> boxes;
  for (std::int64_t i = 0; i < cellCount<Dimension>(number); ++i)
  {
    GridBox<Dimension> box{ cellAt<Dimension>(i, number), {} };
    for (int axis = 0; axis < Dimension; ++axis)
    {
      box.Low[axis] = begin + side * box.Low[axis];
      box.High[axis] = box.Low[axis] + side;
    }
    boxes.push_back(box);
  }
  return boxes;
}

template <int Dimension>
std::vector<GridBox<Dimension>> randomBoxes(const GridSize<Dimension>& size, int number)
{
  std::mt19937_64 engine(23);
  std::vector<GridBox<Dimension>> boxes(static_cast<std::size_t>(number));
  for (GridBox<Dimension>& box : boxes)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t side =
        4 + static_cast<std::int64_t>(engine() % static_cast<std::uint64_t>(size[axis] / 2));
      box.Low[axis] =
        static_cast<std::int64_t>(engine() % static_cast<std::uint64_t>(size[axis] - side + 1));
      box.High[axis] = box.Low[axis] + side;
    }
  }
  return boxes;
}

template <int Dimension>
bool isIn(const GridSize<Dimension>& cell, const GridBox<Dimension>& box)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (cell[axis] < box.Low[axis] || cell[axis] >= box.High[axis])
    {
      return false;
    }
  }
  return true;
}

// The root mean square of the errors of the masses in boxes. Particles without masses are equal.
template <int Dimension>
double massError(const CellDensity<Dimension>& density, const Particles<Dimension>& particles,
  const std::vector<double>& masses, const std::vector<GridBox<Dimension>>& boxes)
{
  std::vector<double> rest(static_cast<std::size_t>(density.NumberOfCells()));
  for (std::size_t cell = 0; cell < rest.size(); ++cell)
  {
    rest[cell] = -density.Share(static_cast<std::int64_t>(cell));
  }
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    rest[static_cast<std::size_t>(density.CellOf(particles[i].data()))] +=
      masses.empty() ? 1.0 / static_cast<double>(particles.size()) : masses[i];
  }
  double sum = 0.0;
  for (const GridBox<Dimension>& box : boxes)
  {
    double error = 0.0;
    GridSize<Dimension> sides;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      sides[axis] = box.High[axis] - box.Low[axis];
    }
    for (std::int64_t i = 0; i < cellCount<Dimension>(sides); ++i)
    {
      GridSize<Dimension> cell = cellAt<Dimension>(i, sides);
      std::transform(cell.begin(), cell.end(), box.Low.begin(), cell.begin(), std::plus<>());
      error += rest[static_cast<std::size_t>(cellIndex<Dimension>(cell, density.Size()))];
    }
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(boxes.size()));
}

template <int Dimension>
std::int64_t inVoids(const CellDensity<Dimension>& density, const Particles<Dimension>& particles)
{
  return std::count_if(particles.begin(), particles.end(),
    [&](const Point<Dimension>& particle) { return !density.HasMass(particle.data()); });
}

template <int Dimension>
bool areInBox(const GridSize<Dimension>& size, const Particles<Dimension>& particles)
{
  return std::all_of(particles.begin(), particles.end(), [&](const Point<Dimension>& particle) {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      if (!(particle[axis] >= 0.0 && particle[axis] <= static_cast<double>(size[axis])))
      {
        return false;
      }
    }
    return true;
  });
}

} // namespace RectifiedTransport

#endif
