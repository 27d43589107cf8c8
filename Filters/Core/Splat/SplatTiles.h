// SPDX-License-Identifier: BSD-3-Clause
// Sorts particles by the tiles of the grid that they reach, keeping their order within a tile.
// Tasks for tiles then add particles that are scattered in space, and compute only the weights of
// their own.
#ifndef RectifiedTransport_SplatTiles_h
#define RectifiedTransport_SplatTiles_h

#include "Core/Parallel/Progress.h"
#include "Core/Splat/Kernels/SplatKernels.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension, class Real>
class SplatTiles
{
public:
  explicit SplatTiles(const SplatJob<Dimension, Real>& job)
    : Job(job)
  {
  }

  // Divides the cells in memory into tiles. The job must have the cells.
  void Divide()
  {
    // Tiles of 32768 cells take 256 kB, which fits a second-level cache. Large grids have larger
    // tiles, so that the counters stay few.
    constexpr int least = Dimension == 1 ? 15 : Dimension == 2 ? 7 : 5;
    constexpr std::int64_t mostTiles = std::int64_t{ 1 } << 16;
    for (int shift = least;; ++shift)
    {
      this->NumberOfTiles = 1;
      for (int a = 0; a < Dimension; ++a)
      {
        this->Shift[a] = shift;
        this->Tiles[a] = ((this->Job.Box.High[a] - this->Job.Box.Low[a] - 1) >> shift) + 1;
        this->NumberOfTiles *= this->Tiles[a];
      }
      if (this->NumberOfTiles <= mostTiles)
      {
        break;
      }
    }
  }

  // Sorts `count` < 2^32 particles from `first` on. Returns how many are outside; results are
  // undefined after cancellation. Throws std::bad_alloc.
  std::int64_t Sort(
    FindCells<Dimension, Real> find, std::int64_t first, std::int64_t count, Progress& progress)
  {
    // The parts of the particles are counted and sorted separately.
    constexpr std::int64_t parts = 64;
    // Particles in a part; the last part may have fewer.
    const std::int64_t part = std::max<std::int64_t>((count + parts - 1) / parts, splatBlock);
    const std::int64_t used = (count + part - 1) / part;
    this->Position.assign(static_cast<std::size_t>(used * this->NumberOfTiles), 0);
    this->Start.resize(static_cast<std::size_t>(this->NumberOfTiles + 1));
    // Calls visit(tile, particle) for the particles of a part and the tiles that each of them
    // reaches. Returns how many are outside.
    const auto visitPart = [&](std::int64_t number, const auto& visit) {
      constexpr std::int64_t found = 16 * splatBlock; // at a time
      std::int32_t cells[3 * found];
      std::int64_t outside = 0;
      const std::int64_t end = std::min((number + 1) * part, count);
      for (std::int64_t begin = number * part; begin < end && !progress.ShouldStop();
           begin += found)
      {
        const int lanes = static_cast<int>(std::min(found, end - begin));
        outside += find(this->Job, first + begin, lanes, cells);
        for (int i = 0; i < lanes; ++i)
        {
          this->VisitTiles(cells + 3 * i, [&](std::int64_t tile) { visit(tile, begin + i); });
        }
      }
      return outside;
    };

    std::atomic<std::int64_t> outside{ 0 };
    progress.Threads().For(used, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t number = begin; number < end; ++number)
      {
        std::int64_t* counts = this->Position.data() + number * this->NumberOfTiles;
        outside += visitPart(number, [counts](std::int64_t tile, std::int64_t) { ++counts[tile]; });
      }
    });
    // Counting sort: first all counts, then their prefix sums (tile by tile, part by part within a
    // tile, for a stable order), then the indices.
    std::int64_t sum = 0;
    for (std::int64_t tile = 0; tile < this->NumberOfTiles; ++tile)
    {
      this->Start[static_cast<std::size_t>(tile)] = sum;
      for (std::int64_t number = 0; number < used; ++number)
      {
        auto& position =
          this->Position[static_cast<std::size_t>(number * this->NumberOfTiles + tile)];
        sum += position;
        position = sum - position;
      }
    }
    this->Start.back() = sum;
    if (progress.IsCancelled())
    {
      return outside;
    }
    this->Index.resize(static_cast<std::size_t>(sum));
    progress.Threads().For(used, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t number = begin; number < end; ++number)
      {
        std::int64_t* positions = this->Position.data() + number * this->NumberOfTiles;
        visitPart(number, [this, positions](std::int64_t tile, std::int64_t particle) {
          this->Index[static_cast<std::size_t>(positions[tile]++)] =
            static_cast<std::uint32_t>(particle);
        });
      }
    });
    return outside;
  }

  std::int64_t Count() const { return this->NumberOfTiles; }
  CellBox<Dimension> Box(std::int64_t tile) const
  {
    CellBox<Dimension> box;
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int64_t low = this->Job.Box.Low[a] + ((tile % this->Tiles[a]) << this->Shift[a]);
      tile /= this->Tiles[a];
      box.Low[a] = static_cast<std::int32_t>(low);
      box.High[a] = static_cast<std::int32_t>(
        std::min<std::int64_t>(low + (std::int64_t{ 1 } << this->Shift[a]), this->Job.Box.High[a]));
    }
    return box;
  }

  // Particles of a tile, counted from `first`.
  const std::uint32_t* Begin(std::int64_t tile) const
  {
    return this->Index.data() + this->Start[static_cast<std::size_t>(tile)];
  }

  std::int64_t CountOf(std::int64_t tile) const
  {
    const auto t = static_cast<std::size_t>(tile);
    return this->Start[t + 1] - this->Start[t];
  }

private:
  // Calls visit(tile) for the tiles of the cells that a particle reaches; `cells` are the first
  // cells along each axis.
  template <class Visit>
  void VisitTiles(const std::int32_t* cells, const Visit& visit) const
  {
    // The first and the last tile along each axis.
    std::int64_t low[3] = { 0, 0, 0 };
    std::int64_t high[3] = { 0, 0, 0 };
    for (int a = 0; a < Dimension; ++a)
    {
      const CellBox<Dimension>& box = this->Job.Box;
      const std::int32_t first = std::max(cells[a], box.Low[a]);
      const std::int32_t last = std::min(cells[a] + this->Job.Span[a], box.High[a]) - 1;
      if (last < first)
      {
        return;
      }
      low[a] = (first - box.Low[a]) >> this->Shift[a];
      high[a] = (last - box.Low[a]) >> this->Shift[a];
    }
    for (std::int64_t k = low[2]; k <= high[2]; ++k)
    {
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
      {
        const std::int64_t row = Dimension == 1 ? 0
          : Dimension == 2                      ? j
                                                : k * this->Tiles[Dimension > 1 ? 1 : 0] + j;
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
        {
          visit(row * this->Tiles[0] + i);
        }
      }
    }
  }

  const SplatJob<Dimension, Real>& Job;
  int Shift[Dimension];
  std::int64_t Tiles[Dimension];
  std::int64_t NumberOfTiles = 1;
  std::vector<std::int64_t> Start;    // first index of every tile, and the end
  std::vector<std::int64_t> Position; // next index for every tile in every part of the particles
  std::vector<std::uint32_t> Index;
};

} // namespace RectifiedTransport

#endif
