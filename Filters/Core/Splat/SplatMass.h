// SPDX-License-Identifier: BSD-3-Clause
// The mass that the cells of a splat hold: the sum of the sums of fixed chunks of cells, with the
// same bits on any number of threads and ranks.
#ifndef RectifiedTransport_SplatMass_h
#define RectifiedTransport_SplatMass_h

#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>

namespace RectifiedTransport
{

constexpr std::int64_t splatSumChunk = std::int64_t{ 1 } << 13; // consecutive cells

// Adds up all cells in a fixed order. Throws Cancelled.
inline double sumOfCells(const double* cells, std::int64_t count, Progress& progress)
{
  return reduceChunks(
    progress, count, splatSumChunk, 0.0,
    [cells](std::int64_t first, std::int64_t last) {
      return std::accumulate(cells + first, cells + last, 0.0);
    },
    std::plus<>());
}

// The cells of a grid, axis 0 fastest, that a rank adds up: whole chunks, in shares as equal as
// possible.
struct CellShare
{
  LatticePart<3> Layers; // those that hold them
  std::int64_t First;    // from the layers' first cell on
  std::int64_t Count;

  CellShare(const LatticePart<3>& whole, int ranks, int rank)
    : Layers(whole)
  {
    std::size_t slowest = 2;
    while (slowest > 0 && whole.Cells[slowest] == 1)
    {
      --slowest;
    }
    const std::int64_t all = whole.Count();
    const std::int64_t layer = all / whole.Cells[slowest];
    const RankShare chunks((all + splatSumChunk - 1) / splatSumChunk, ranks, rank);
    const std::int64_t first = std::min(all, chunks.First * splatSumChunk);
    const std::int64_t last = std::min(all, (chunks.First + chunks.Count) * splatSumChunk);
    this->First = first % layer;
    this->Count = last - first;
    this->Layers.Low[slowest] += first / layer;
    this->Layers.Cells[slowest] = last > first ? (last - 1) / layer + 1 - first / layer : 0;
  }
};

} // namespace RectifiedTransport

#endif
