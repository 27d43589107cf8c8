// SPDX-License-Identifier: BSD-3-Clause
// What the tests of site cells of a density share: pixels on its domain, and the masses of cells.
#ifndef RectifiedTransport_TestMasses_h
#define RectifiedTransport_TestMasses_h

#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/PixelMasses.h"

#include "TestFlow.h"
#include "TestGrid.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

// Pixels on the domain of a density, whose cells are of unit sides.
template <int Dimension>
ImageGrid pixelsOn(const GridSize<Dimension>& density, const GridSize<Dimension>& pixels)
{
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  for (int axis = 0; axis < Dimension; ++axis)
  {
    spacing[axis] = static_cast<double>(density[axis]) / static_cast<double>(pixels[axis]);
  }
  return makeGrid<Dimension>(pixels, spacing);
}

template <int Dimension>
Points<3> inSpace(const Points<Dimension>& places)
{
  Points<3> sites;
  for (const Point<Dimension>& place : places)
  {
    sites.push_back({});
    std::copy(place.begin(), place.end(), sites.back().begin());
  }
  return sites;
}

template <int Dimension>
PixelMasses<Dimension> massesOf(const TestDensity<Dimension>& density,
  const NotDeduced<GridSize<Dimension>>& pixels, const Context& context = Context())
{
  Progress progress(context);
  const double total = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  return PixelMasses<Dimension>(density.Source(), total, pixels, progress);
}

// The masses of the cells, and what they should be.
struct Shares
{
  double Deviation() const { return std::max(this->Most - this->Each, this->Each - this->Least); }

  double Least;
  double Most;
  double Each;
};

template <int Dimension>
Shares sharesOf(
  const PixelMasses<Dimension>& masses, const std::vector<std::int64_t>& labels, std::int64_t count)
{
  std::vector<std::int64_t> sums(static_cast<std::size_t>(count), 0);
  for (std::size_t pixel = 0; pixel < labels.size(); ++pixel)
  {
    const std::int64_t mass = masses[static_cast<std::int64_t>(pixel)];
    if (mass > 0)
    {
      sums.at(static_cast<std::size_t>(labels[pixel])) += mass;
    }
  }
  const auto [least, most] = std::minmax_element(sums.begin(), sums.end());
  return { static_cast<double>(*least), static_cast<double>(*most),
    static_cast<double>(masses.Total()) / static_cast<double>(count) };
}

} // namespace RectifiedTransport

#endif
