// SPDX-License-Identifier: BSD-3-Clause
// The cells of a grid that clouds cover.
#ifndef RectifiedTransport_CloudRows_h
#define RectifiedTransport_CloudRows_h

#include "Bridge/Temporal/MovedClouds.h"
#include "Core/Geometry/ImageGrid.h"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace RectifiedTransport::Bridge
{

constexpr double largestCloud = 8.0; // in cells of the output

// The cells that a cloud covers along an axis, and the parts of it in each.
struct CloudRow
{
  static constexpr int Most = static_cast<int>(largestCloud) + 2;
  std::int64_t First;
  int Count;
  double Parts[Most];

  std::int64_t End() const { return this->First + this->Count; }
};

// What is beyond the border is cut.
inline CloudRow cloudRow(double centre, double length, std::int64_t cells)
{
  const double end = static_cast<double>(cells);
  const double half = 0.5 * std::clamp(length, 1e-6, largestCloud);
  const double low = std::clamp(centre - half, 0.0, end - 1e-6);
  const double high = std::max(std::clamp(centre + half, 0.0, end), low + 1e-6);
  CloudRow row;
  row.First = static_cast<std::int64_t>(low);
  row.Count = 0;
  for (std::int64_t cell = row.First; static_cast<double>(cell) < high && cell < cells; ++cell)
  {
    const double from = std::max(low, static_cast<double>(cell));
    const double to = std::min(high, static_cast<double>(cell + 1));
    row.Parts[row.Count++] = (to - from) / (high - low);
  }
  return row;
}

template <int D>
Point<D> cellLengths(const ImageGrid& grid)
{
  Point<D> lengths = grid.Lengths<D>();
  const GridSize<D> size = grid.Size<D>();
  for (int axis = 0; axis < D; ++axis)
  {
    lengths[axis] /= static_cast<double>(size[axis]);
  }
  return lengths;
}

// The lengths of the cells of a step, in those of another grid.
template <int D>
Point<D> lengthsInCells(const ImageGrid& step, const ImageGrid& grid)
{
  Point<D> lengths = cellLengths<D>(step);
  const Point<D> units = cellLengths<D>(grid);
  std::transform(lengths.begin(), lengths.end(), units.begin(), lengths.begin(), std::divides<>());
  return lengths;
}

// Clouds in the index space of a grid.
template <int D>
class CloudPlaces
{
public:
  CloudPlaces(const MovedClouds& clouds, const ImageGrid& geometry)
    : Clouds(clouds)
    , Geometry(geometry)
    , Units{ lengthsInCells<D>(clouds.FirstGrid, geometry),
      lengthsInCells<D>(clouds.SecondGrid, geometry) }
    , X(clouds.Points->GetPointer(0))
    , From(clouds.Sizes.From.data() + D * clouds.First)
    , To(clouds.Sizes.To.data() + D * clouds.First)
  {
  }

  // The centre, in the domain.
  void Centre(std::int64_t cloud, double* index) const
  {
    this->Geometry.template ToIndex<D>(this->X + 3 * cloud, index);
    this->Geometry.template ClampToDomain<D>(index);
  }
  // In cells; not for points.
  double Length(std::int64_t cloud, int axis) const
  {
    const Point<D>& unit = this->Units[this->Clouds.First + cloud < this->Clouds.OfFirst ? 0 : 1];
    const double length = (1.0 - this->Clouds.Part) * this->From[D * cloud + axis] +
      this->Clouds.Part * this->To[D * cloud + axis];
    return length * unit[axis];
  }

private:
  const MovedClouds& Clouds;
  const ImageGrid& Geometry;
  const Point<D> Units[2]; // of both steps
  const double* X;
  const float* From;
  const float* To;
};

} // namespace RectifiedTransport::Bridge

#endif
