// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the splat share: particles, executors that run ranges in other orders, sums and
// first moments.
#ifndef TestSplat_h
#define TestSplat_h

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Splat/Splat.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace RectifiedTransport
{

constexpr SplatKernel allKernels[] = { SplatKernel::CloudInCell, SplatKernel::NearestCell,
  SplatKernel::TriangularShapedCloud, SplatKernel::Gaussian };

// Runs ranges from the last to the first, and says that as many could run at one time.
class BackwardExecutor final : public Executor
{
public:
  explicit BackwardExecutor(int concurrency)
    : Ranges(concurrency)
  {
  }
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    for (std::int64_t range = (count + grain - 1) / grain - 1; range >= 0; --range)
    {
      kernel(range * grain, std::min((range + 1) * grain, count));
    }
  }
  int Concurrency() const override { return this->Ranges; }

private:
  int Ranges;
};

// Index space is physical space, with the further axes at 0.
inline IndexMap<3> identityRows()
{
  return { { 0.0, 0.0, 0.0 }, { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } },
    { 1e-6, 1e-6, 1e-6 } };
}

template <int D>
IndexMap<D> identityMap()
{
  const IndexMap<3> rows = identityRows();
  IndexMap<D> map;
  std::copy_n(rows.Origin, 3, map.Origin);
  std::copy_n(&rows.Matrix[0][0], 9, &map.Matrix[0][0]);
  std::copy_n(rows.Tolerance, 3, map.Tolerance);
  return map;
}

// Points and their masses, some of them negative.
template <int D, class Real = double>
struct Cloud
{
  std::vector<Real> Points;
  std::vector<double> Masses;

  std::int64_t Count() const { return static_cast<std::int64_t>(this->Masses.size()); }
  SplatParticles<D, Real> Particles() const
  {
    return { { this->Points.data(), this->Count() }, this->Masses.data(), 0.0, identityMap<D>() };
  }
  void Add(const Point<D>& point, double mass)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Points.push_back(static_cast<Real>(a < D ? point[a < D ? a : 0] : 0.0));
    }
    this->Masses.push_back(mass);
  }
};

// At random in the box [margin, size - margin]; `sorted` along the last axis.
template <int D, class Real = double>
Cloud<D, Real> randomCloud(
  const GridSize<D>& size, std::int64_t count, double margin, bool sorted, std::uint64_t seed = 1)
{
  Cloud<D, Real> cloud;
  for (std::int64_t i = 0; i < count; ++i)
  {
    Point<D> point;
    for (int a = 0; a < D; ++a)
    {
      const double u = sorted && a == D - 1
        ? (static_cast<double>(i) + 0.5) / static_cast<double>(count)
        : unitReal(randomWord(seed, static_cast<std::uint64_t>(3 * i + a)));
      point[a] = margin + u * (static_cast<double>(size[a]) - 2.0 * margin);
    }
    cloud.Add(point, unitReal(randomWord(seed + 1, static_cast<std::uint64_t>(i))) - 0.1);
  }
  return cloud;
}

// Particles at all corners, on faces and edges, at and beyond the border by rounding.
template <int D>
Cloud<D> borderCloud(const GridSize<D>& size)
{
  Cloud<D> cloud;
  const auto places = [&size](int a) {
    const double n = static_cast<double>(size[static_cast<std::size_t>(a)]);
    return std::vector<double>{ 0.0, std::nextafter(0.5, 0.0), 0.5, 0.7, 0.5 * n, n - 0.25, n,
      -1e-9, n + 1e-9 };
  };
  const std::size_t each = places(0).size();
  for (std::size_t code = 0; code < (D == 1      ? each
                                        : D == 2 ? each * each
                                                 : each * each * each);
       ++code)
  {
    Point<D> point;
    std::size_t rest = code;
    for (int a = 0; a < D; ++a)
    {
      point[a] = places(a)[rest % each];
      rest /= each;
    }
    cloud.Add(point, 1.0);
  }
  return cloud;
}

inline SplatOptions splatOptions(
  SplatKernel kernel, SplatBoundary boundary = SplatBoundary::Renormalize, double radius = 1.0)
{
  SplatOptions options;
  options.Kernel = kernel;
  options.Boundary = boundary;
  options.Radius = radius;
  return options;
}

struct Splatted
{
  std::vector<double> Cells;
  std::int64_t Outside = 0;
};

// A grid's size, of which no template argument is deduced: std::array counts in another type.
template <int D>
struct SizeOf
{
  using Type = GridSize<D>;
};

template <int D, class Real>
Splatted splat(const SplatParticles<D, Real>& particles, const typename SizeOf<D>::Type& size,
  const SplatOptions& options, const Executor& executor = SerialExecutor())
{
  // What was in memory does not count.
  Splatted result{ std::vector<double>(static_cast<std::size_t>(numberOfCells<D>(size)), -7.0) };
  result.Outside =
    splatMass<D, Real>(particles, size, options, 1.0, result.Cells.data(), executor).Outside;
  return result;
}

inline double sumOf(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum;
}

// The sum of mass times cell centre along an axis.
template <int D>
double firstMoment(const std::vector<double>& cells, const GridSize<D>& size, int axis)
{
  double moment = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    auto rest = static_cast<std::int64_t>(i);
    for (int a = 0; a < axis; ++a)
    {
      rest /= size[a];
    }
    moment += cells[i] * (static_cast<double>(rest % size[axis]) + 0.5);
  }
  return moment;
}

} // namespace RectifiedTransport

#endif
