// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/SeedInput.h"

#include "Bridge/Points/PointInput.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

template <int D>
class PlaceSeed
{
public:
  PlaceSeed(const ImageGrid& geometry, PointSpan<D> indexSeeds, PointSpan<3> physicalSeeds)
    : Geometry(geometry)
    , IndexSeeds(indexSeeds)
    , PhysicalSeeds(physicalSeeds)
  {
  }

  // Returns whether the seed was moved.
  bool operator()(std::int64_t i, const double* x) const
  {
    double* index = this->IndexSeeds[i];
    double* seed = this->PhysicalSeeds[i];
    this->Geometry.template ToIndex<D>(x, index);
    const bool inside = this->Geometry.template ClampToDomain<D>(index);
    this->Geometry.template ToPhysical<D>(index, seed);
    const double distance = std::hypot(x[0] - seed[0], x[1] - seed[1], x[2] - seed[2]);
    const double rounding =
      1e-12 * (this->Geometry.Diagonal() + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
    if (inside && distance <= rounding)
    {
      std::copy_n(x, 3, seed);
    }
    return distance > this->Geometry.BorderTolerance();
  }

private:
  const ImageGrid& Geometry;
  PointSpan<D> IndexSeeds;
  PointSpan<3> PhysicalSeeds;
};

} // namespace

template <int D>
std::int64_t readSeeds(vtkPointSet* points, const std::string& what, const ImageGrid& grid,
  Progress& progress, PointSpan<D> indexSeeds, PointSpan<3> physicalSeeds)
{
  const PlaceSeed<D> place(grid, indexSeeds, physicalSeeds);
  std::atomic<std::int64_t> moved{ 0 };
  visitPoints(points, what, progress, [&](std::int64_t i, const double* x) {
    if (place(i, x))
    {
      ++moved;
    }
  });
  return moved;
}

template std::int64_t readSeeds<1>(
  vtkPointSet*, const std::string&, const ImageGrid&, Progress&, PointSpan<1>, PointSpan<3>);
template std::int64_t readSeeds<2>(
  vtkPointSet*, const std::string&, const ImageGrid&, Progress&, PointSpan<2>, PointSpan<3>);
template std::int64_t readSeeds<3>(
  vtkPointSet*, const std::string&, const ImageGrid&, Progress&, PointSpan<3>, PointSpan<3>);

} // namespace RectifiedTransport
