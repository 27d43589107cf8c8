// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the flow share: seeds, calls on vectors of points, comparisons.
#ifndef RectifiedTransport_TestFlow_h
#define RectifiedTransport_TestFlow_h

#include "Core/Flow/RectifiedFlow.h"

#include "Oracle.h"
#include "TestDensities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
using Points = std::vector<Point<Dimension>>;

// For parameters: std::array's size is no int, so a Dimension cannot be deduced from it.
template <class T>
using NotDeduced = std::common_type_t<T>;

// Independent uniform points in the box.
template <int Dimension>
Points<Dimension> randomPoints(
  const GridSize<Dimension>& size, std::size_t count, std::uint64_t seed = 7)
{
  std::mt19937_64 engine(seed);
  Points<Dimension> points(count);
  for (Point<Dimension>& point : points)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      point[axis] = uniformNumber(engine) * static_cast<double>(size[axis]);
    }
  }
  return points;
}

// The centres of `perAxis` boxes an axis.
template <int Dimension>
Points<Dimension> latticePoints(const GridSize<Dimension>& size, const GridSize<Dimension>& perAxis)
{
  Points<Dimension> points(cellCount<Dimension>(perAxis));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(i), perAxis);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      points[i][axis] = (static_cast<double>(cell[axis]) + 0.5) * static_cast<double>(size[axis]) /
        static_cast<double>(perAxis[axis]);
    }
  }
  return points;
}

template <int Dimension>
Points<Dimension> runForward(const RectifiedFlow<Dimension>& flow,
  const NotDeduced<Points<Dimension>>& seeds, const FlowOptions& options = {},
  const Context& context = Context())
{
  Points<Dimension> positions(seeds.size());
  flow.Forward(seeds, positions, options, context);
  return positions;
}

template <int Dimension>
Points<Dimension> runBackward(const RectifiedFlow<Dimension>& flow,
  const NotDeduced<Points<Dimension>>& points, const FlowOptions& options = {},
  const Context& context = Context())
{
  Points<Dimension> positions(points.size());
  flow.Backward(points, positions, options, context);
  return positions;
}

// Builds the tables with the default executor.
template <int Dimension>
RectifiedFlow<Dimension> makeFlow(const TestDensity<Dimension>& density)
{
  return RectifiedFlow<Dimension>(density.Source());
}

inline FlowOptions steps(int count, Integrator method = Integrator::Multistep)
{
  FlowOptions options;
  options.Integrator = method;
  options.NumberOfSteps = count;
  return options;
}

inline FlowOptions with(FlowMaps maps, FlowOptions options = {})
{
  options.Maps = maps;
  return options;
}

inline FlowOptions adaptive(double tolerance)
{
  FlowOptions options;
  options.Integrator = Integrator::Adaptive;
  options.Tolerance = tolerance;
  return options;
}

inline std::string nameOf(Integrator method)
{
  switch (method)
  {
    case Integrator::Multistep:
      return "Multistep";
    case Integrator::RungeKutta4:
      return "RungeKutta4";
    case Integrator::Euler:
      return "Euler";
    case Integrator::Adaptive:
      return "Adaptive";
  }
  return "unknown";
}

// Auto means one of these.
constexpr FlowMaps OffAndOn[] = { FlowMaps::Off, FlowMaps::On };

inline std::string nameOf(FlowMaps maps)
{
  return maps == FlowMaps::On ? "maps" : maps == FlowMaps::Off ? "no maps" : "maps or none";
}

constexpr Integrator AllIntegrators[] = { Integrator::Multistep, Integrator::RungeKutta4,
  Integrator::Euler, Integrator::Adaptive };

template <int Dimension>
bool sameBits(const Points<Dimension>& first, const Points<Dimension>& second)
{
  return first.size() == second.size() &&
    std::memcmp(first.data(), second.data(), first.size() * sizeof(Point<Dimension>)) == 0;
}

template <int Dimension>
double largestDistance(const Points<Dimension>& first, const Points<Dimension>& second)
{
  return comparePositions<Dimension>(first, second).Largest;
}

template <int Dimension>
bool isInside(const Point<Dimension>& point, const GridSize<Dimension>& size)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (!(point[axis] >= 0.0 && point[axis] <= static_cast<double>(size[axis])))
    {
      return false; // NaN too
    }
  }
  return true;
}

// How many points are NaN or outside, and how many are in a cell without mass. A point on a face
// is in any of the face's cells.
template <int Dimension>
struct Strays
{
  std::int64_t Outside = 0;
  std::int64_t InEmptyCells = 0;

  Strays(const Points<Dimension>& points, const TestDensity<Dimension>& density)
  {
    for (const Point<Dimension>& point : points)
    {
      if (!isInside<Dimension>(point, density.Size))
      {
        ++this->Outside;
      }
      else if (!HasMass(point, density))
      {
        ++this->InEmptyCells;
      }
    }
  }

private:
  static bool HasMass(const Point<Dimension>& point, const TestDensity<Dimension>& density)
  {
    for (int choice = 0; choice < (1 << Dimension); ++choice)
    {
      GridSize<Dimension> cell = cellOf<Dimension>(point, density.Size);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        if ((choice >> axis & 1) && point[axis] == static_cast<double>(cell[axis]) &&
          cell[axis] > 0)
        {
          --cell[axis];
        }
      }
      if (density.Values[cellIndex<Dimension>(cell, density.Size)] > 0.0)
      {
        return true;
      }
    }
    return false;
  }
};

} // namespace RectifiedTransport

#endif
