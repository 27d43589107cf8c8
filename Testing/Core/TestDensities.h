// SPDX-License-Identifier: BSD-3-Clause
// The densities that the tests transport.
#ifndef RectifiedTransport_TestDensities_h
#define RectifiedTransport_TestDensities_h

#include "Core/Tables/Density.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
struct TestDensity
{
  GridSize<Dimension> Size;
  std::vector<double> Values;

  DensityArray<Dimension, double> Source() const { return { this->Values.data(), this->Size }; }
};

// The same along every axis.
template <int Dimension>
GridSize<Dimension> evenSize(std::int64_t side)
{
  GridSize<Dimension> size;
  size.fill(side);
  return size;
}

template <int Dimension>
Point<Dimension> evenPoint(double coordinate)
{
  Point<Dimension> point;
  point.fill(coordinate);
  return point;
}

template <int Dimension>
std::int64_t cellCount(const GridSize<Dimension>& size)
{
  std::int64_t count = 1;
  for (const std::int64_t side : size)
  {
    count *= side;
  }
  return count;
}

template <int Dimension>
GridSize<Dimension> cellAt(std::int64_t index, const GridSize<Dimension>& size)
{
  GridSize<Dimension> cell;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    cell[axis] = index % size[axis];
    index /= size[axis];
  }
  return cell;
}

template <int Dimension>
std::int64_t cellIndex(const GridSize<Dimension>& cell, const GridSize<Dimension>& size)
{
  std::int64_t index = 0;
  for (int axis = Dimension; axis-- > 0;)
  {
    index = index * size[axis] + cell[axis];
  }
  return index;
}

// The cell that holds a point; a point on the upper border belongs to the last cell.
template <int Dimension>
GridSize<Dimension> cellOf(const Point<Dimension>& point, const GridSize<Dimension>& size)
{
  GridSize<Dimension> cell;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const auto index = static_cast<std::int64_t>(std::floor(point[axis]));
    cell[axis] = index == size[axis] ? index - 1 : index;
  }
  return cell;
}

// Uniform in [0,1), the same on every platform.
inline double uniformNumber(std::mt19937_64& engine)
{
  return static_cast<double>(engine() >> 11) * 0x1p-53;
}

// Samples value(p) at the cells' centres p in the unit box.
template <int Dimension, class F>
TestDensity<Dimension> sampleDensity(const GridSize<Dimension>& size, F&& value)
{
  TestDensity<Dimension> density{ size, std::vector<double>(cellCount<Dimension>(size)) };
  for (std::size_t index = 0; index < density.Values.size(); ++index)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(index), size);
    Point<Dimension> p;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      p[axis] = (static_cast<double>(cell[axis]) + 0.5) / static_cast<double>(size[axis]);
    }
    density.Values[index] = value(p);
  }
  return density;
}

template <int Dimension>
double squaredDistance(const Point<Dimension>& p, double centre)
{
  double sum = 0.0;
  for (const double coordinate : p)
  {
    sum += (coordinate - centre) * (coordinate - centre);
  }
  return sum;
}

template <int Dimension>
TestDensity<Dimension> uniformDensity(const GridSize<Dimension>& size, double value = 1.0)
{
  return { size, std::vector<double>(cellCount<Dimension>(size), value) };
}

// Smooth and positive.
template <int Dimension>
TestDensity<Dimension> twoGaussians(const GridSize<Dimension>& size)
{
  return sampleDensity<Dimension>(size, [](const Point<Dimension>& p) {
    return 0.05 + std::exp(-20.0 * squaredDistance<Dimension>(p, 0.3)) +
      0.6 * std::exp(-60.0 * squaredDistance<Dimension>(p, 0.72));
  });
}

// Independent values in [least, 1).
template <int Dimension>
TestDensity<Dimension> randomCells(
  const GridSize<Dimension>& size, double least = 0.0, std::uint64_t seed = 1)
{
  std::mt19937_64 engine(seed);
  return sampleDensity<Dimension>(
    size, [&](const Point<Dimension>&) { return least + (1.0 - least) * uniformNumber(engine); });
}

// A disc (ball) of ones with a round hole, zeros elsewhere.
template <int Dimension>
TestDensity<Dimension> discWithHole(const GridSize<Dimension>& size)
{
  return sampleDensity<Dimension>(size, [](const Point<Dimension>& p) {
    return squaredDistance<Dimension>(p, 0.5) < 0.16 && squaredDistance<Dimension>(p, 0.58) > 0.01
      ? 1.0
      : 0.0;
  });
}

// Blocks of ones and zeros, `block` cells wide.
template <int Dimension>
TestDensity<Dimension> checker(const GridSize<Dimension>& size, std::int64_t block)
{
  TestDensity<Dimension> density = uniformDensity<Dimension>(size);
  for (std::size_t index = 0; index < density.Values.size(); ++index)
  {
    std::int64_t parity = 0;
    for (const std::int64_t coordinate : cellAt<Dimension>(static_cast<std::int64_t>(index), size))
    {
      parity += coordinate / block;
    }
    density.Values[index] = static_cast<double>(parity % 2);
  }
  return density;
}

// One cell holds everything.
template <int Dimension>
TestDensity<Dimension> dirac(
  const GridSize<Dimension>& size, const GridSize<Dimension>& cell, double value = 1.0)
{
  TestDensity<Dimension> density = uniformDensity<Dimension>(size, 0.0);
  density.Values[cellIndex<Dimension>(cell, size)] = value;
  return density;
}

// The product of a density an axis. Its transport is known: axis by axis the inverse of the
// cumulative sum.
template <int Dimension>
struct SeparableDensity
{
  std::array<std::vector<double>, Dimension> Factors;

  TestDensity<Dimension> Density() const
  {
    GridSize<Dimension> size;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      size[axis] = static_cast<std::int64_t>(this->Factors[axis].size());
    }
    TestDensity<Dimension> density = uniformDensity<Dimension>(size);
    for (std::size_t index = 0; index < density.Values.size(); ++index)
    {
      const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(index), size);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        density.Values[index] *= this->Factors[axis][cell[axis]];
      }
    }
    return density;
  }

  // Where the flow takes a seed.
  Point<Dimension> Forward(const Point<Dimension>& seed) const
  {
    Point<Dimension> position;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::vector<double>& factor = this->Factors[axis];
      double total = 0.0;
      for (const double value : factor)
      {
        total += value;
      }
      double rest = seed[axis] / static_cast<double>(factor.size()) * total;
      std::size_t cell = 0;
      while (cell + 1 < factor.size() && rest >= factor[cell])
      {
        rest -= factor[cell++];
      }
      position[axis] = static_cast<double>(cell) + rest / factor[cell];
    }
    return position;
  }
};

// Independent factors in [least, 1).
template <int Dimension>
SeparableDensity<Dimension> randomSeparable(
  const GridSize<Dimension>& size, double least, std::uint64_t seed = 1)
{
  std::mt19937_64 engine(seed);
  SeparableDensity<Dimension> density;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    density.Factors[axis].resize(size[axis]);
    for (double& value : density.Factors[axis])
    {
      value = least + (1.0 - least) * uniformNumber(engine);
    }
  }
  return density;
}

// A disc in the plane, a ball in space, whose density is `ratio` times that of the rest.
template <int Dimension>
TestDensity<Dimension> denseBall(std::int64_t side, double ratio)
{
  return sampleDensity<Dimension>(evenSize<Dimension>(side), [&](const Point<Dimension>& p) {
    return squaredDistance<Dimension>(p, 0.47) < 0.15 * 0.15 ? ratio : 1.0;
  });
}

} // namespace RectifiedTransport

#endif
