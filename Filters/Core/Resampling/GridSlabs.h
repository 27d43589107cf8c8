// SPDX-License-Identifier: BSD-3-Clause
// Parts of a grid for threads, and the cells that reach each.
#ifndef RectifiedTransport_GridSlabs_h
#define RectifiedTransport_GridSlabs_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/Trees/Bins.h"
#include "Core/Overlap/Overlap.h"
#include "Core/Parallel/Progress.h"
#include "Core/Resampling/CellValues.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Equal parts of the grid along its last axis, for any number of threads: enough parts for many
// threads, and so thick that a cell is in few of them.
template <int D>
struct GridSlabs
{
  explicit GridSlabs(const GridSize<D>& size)
    : Size(size)
    , Planes(std::max<std::int64_t>((size[D - 1] + most - 1) / most, std::min(size[D - 1], least)))
    , Count((size[D - 1] + this->Planes - 1) / this->Planes)
  {
  }
  // The slab of a plane of cells; the first or the last one for planes beyond the grid.
  std::int64_t At(double plane) const
  {
    const double end = static_cast<double>(this->Planes * this->Count); // far ones may exceed every
                                                                        // integer
    return std::min(
      static_cast<std::int64_t>(std::clamp(plane, 0.0, end)) / this->Planes, this->Count - 1);
  }

  // A slab of the values of all cells.
  GridSlab<D> Slab(std::int64_t slab, double* values) const
  {
    return { this->Size, slab * this->Planes,
      std::min((slab + 1) * this->Planes, this->Size[D - 1]), values };
  }

  // Calls visit(slab) for each slab, on any thread. Throws Cancelled.
  template <class Visit>
  void ForEach(Progress& progress, const Visit& visit) const
  {
    progress.For(
      this->Count, 1,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t s = first; s < last && !progress.ShouldStop(); ++s)
        {
          visit(s);
        }
      },
      1);
  }

  // For each set, the cells that are divided and nearer than `margin` grid cells to each slab, in
  // their order. Throws Cancelled.
  std::vector<Bins<std::int64_t>> CellsOf(const std::vector<CellValues>& sets,
    const ImageGrid& grid, double margin, Progress& progress) const;

  static constexpr std::int64_t most = 64; // number of slabs
  static constexpr std::int64_t least = 4; // planes of a slab, unless the grid has fewer
  GridSize<D> Size;
  std::int64_t Planes; // planes of a slab
  std::int64_t Count;
};

} // namespace RectifiedTransport

#endif
