// SPDX-License-Identifier: BSD-3-Clause
// Particles as clouds: boxes of constant density, aligned with the axes of a grid, whose lengths
// change along the way.
#ifndef RectifiedTransport_ScaledClouds_h
#define RectifiedTransport_ScaledClouds_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace RectifiedTransport
{

class Progress;

constexpr double largestCloud = 8.0; // in cells

// The cells that a cloud covers along an axis, and the parts of it in each.
struct CloudRow
{
  static constexpr int Most = static_cast<int>(largestCloud) + 2;
  std::int64_t First;
  int Count;
  double Parts[Most];

  std::int64_t End() const { return this->First + this->Count; }
};

// The cloud is cut at the border and keeps its mass. A length of at least 1e-6 cells avoids a
// division by zero.
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

// A cloud is a row along each axis.
template <int D>
using CloudRows = std::array<CloudRow, D>;

// Calls visit(j, k, mass) for the rows of cells that a cloud covers along axis 0, with their
// indices along axes 1 and 2, 0 where there is none, and their masses.
template <int D, class Visit>
void visitRows(const CloudRows<D>& rows, double mass, const Visit& visit)
{
  const CloudRow& planes = rows[D - 1];
  const CloudRow& lines = rows[D > 1 ? 1 : 0];
  for (int k = 0; k < (D > 2 ? planes.Count : 1); ++k)
  {
    const double ofPlane = D > 2 ? mass * planes.Parts[k] : mass;
    for (int j = 0; j < (D > 1 ? lines.Count : 1); ++j)
    {
      visit(D > 1 ? lines.First + j : 0, D > 2 ? planes.First + k : 0,
        D > 1 ? ofPlane * lines.Parts[j] : ofPlane);
    }
  }
}

template <int D>
struct ScaledClouds
{
  ConstPointSpan<3> Centres; // physical
  const double* Masses;
  // Lengths where the way begins and where it ends, along D axes, interleaved; nullptr for points.
  std::array<const float*, 2> Lengths;
  double Part; // done of the way
  // The units of the lengths, in cells of the grid: those of the clouds before `Second`, and of the
  // others.
  std::array<Point<D>, 2> Units;
  std::int64_t Second;

  // Returns the centre of a cloud in the index space of a grid, moved into the domain.
  Point<D> CentreIn(const ImageGrid& grid, std::int64_t cloud) const
  {
    Point<D> index;
    grid.ToIndex<D>(this->Centres[cloud], index.data());
    grid.ClampToDomain<D>(index.data());
    return index;
  }
  // Returns the length of a cloud along an axis, in cells of the grid: linear in the part of the
  // way.
  double Length(std::int64_t cloud, int axis) const
  {
    const double length = (1.0 - this->Part) * this->Lengths[0][D * cloud + axis] +
      this->Part * this->Lengths[1][D * cloud + axis];
    return length * this->Units[cloud < this->Second ? 0 : 1][axis];
  }
};

// Writes the density of the clouds of all ranks in the wanted cells of a grid. Clouds beyond the
// border are cut there and keep their masses. `most`: no cell gets more mass. Sums are of integers,
// so that neither threads nor ranks change a bit. Memory: 16 bytes a cell of the grid. Collective.
// Throws std::bad_alloc and Cancelled.
template <int D>
void splatClouds(const ScaledClouds<D>& clouds, const ImageGrid& grid, double most,
  const LatticePart<D>& wanted, double* density, Progress& progress);

} // namespace RectifiedTransport

#endif
