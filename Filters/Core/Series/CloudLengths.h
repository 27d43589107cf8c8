// SPDX-License-Identifier: BSD-3-Clause
// The lengths of particles as clouds: where neighbours move apart, clouds grow with the distance,
// so that they still fill the space between them evenly.
#ifndef RectifiedTransport_CloudLengths_h
#define RectifiedTransport_CloudLengths_h

#include "Core/Flow/PivotLattice.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Returns the lengths of the cells of a grid, in units of the cells of another one.
template <int D>
Point<D> cellsInCells(const ImageGrid& cells, const ImageGrid& unit)
{
  const auto lengthsOf = [](const ImageGrid& grid) {
    Point<D> lengths = grid.Lengths<D>();
    const GridSize<D> size = grid.Size<D>();
    std::transform(lengths.begin(), lengths.end(), size.begin(), lengths.begin(),
      [](double length, std::int64_t number) { return length / static_cast<double>(number); });
    return lengths;
  };
  Point<D> lengths = lengthsOf(cells);
  const Point<D> units = lengthsOf(unit);
  std::transform(lengths.begin(), lengths.end(), units.begin(), lengths.begin(), std::divides<>());
  return lengths;
}

// Appends the lengths of clouds in the cells of a lattice on a grid. With several particles in a
// cell, each has its share of the cell.
template <int D>
void addCloudsInCells(const PivotLattice<D>& lattice, const ImageGrid& grid, std::int64_t count,
  std::vector<float>& lengths);

// Appends the lengths of particles in the cells of a lattice of `here` at their images, which are
// in the index space of `there`; each particle is at its number in the lattice. Along an axis, a
// length is the mean of the distances to the images of both neighbours. It is the smaller distance
// if they differ by a factor of two or more, for example where mass comes apart. The images of all
// ranks count. Collective. Throws std::bad_alloc and Cancelled.
template <int D>
void addCloudsAtImages(const PivotLattice<D>& lattice, const ImageGrid& here,
  const ImageGrid& there, const std::vector<std::int64_t>& numbers, ConstPointSpan<D> images,
  Progress& progress, std::vector<float>& lengths);

} // namespace RectifiedTransport

#endif
