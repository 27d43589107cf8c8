// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Splat/SplatTiles.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <atomic>

namespace RectifiedTransport
{

namespace
{

// Tiles of 32768 cells, 256 kB.
template <int Dimension>
constexpr int tileShift = Dimension == 1 ? 15
  : Dimension == 2                       ? 7
                                         : 5;
constexpr std::int64_t mostTiles = std::int64_t{ 1 } << 16;
constexpr std::int64_t parts = 64; // of the particles, counted and sorted separately

} // namespace

template <int Dimension, class Real>
void SplatTiles<Dimension, Real>::Divide()
{
  for (int shift = tileShift<Dimension>;; ++shift)
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

template <int Dimension, class Real>
template <class Visit>
void SplatTiles<Dimension, Real>::VisitTiles(const std::int32_t* cells, const Visit& visit) const
{
  std::int64_t low[3] = { 0, 0, 0 };
  std::int64_t high[3] = { 0, 0, 0 };
  for (int a = 0; a < Dimension; ++a)
  {
    const CellBox<Dimension>& box = this->Job.Box;
    const std::int32_t first = std::max(cells[a], box.Low[a]);
    const std::int32_t last = std::min(cells[a] + this->Job.Kept[a], box.High[a]) - 1;
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

template <int Dimension, class Real>
std::int64_t SplatTiles<Dimension, Real>::Sort(
  FindCells<Dimension, Real> find, std::int64_t first, std::int64_t count, Progress& progress)
{
  const std::int64_t part = std::max<std::int64_t>((count + parts - 1) / parts, splatBlock);
  const std::int64_t used = (count + part - 1) / part;
  this->Position.assign(static_cast<std::size_t>(used * this->NumberOfTiles), 0);
  this->Start.resize(static_cast<std::size_t>(this->NumberOfTiles + 1));
  const auto visitPart = [&](std::int64_t number, const auto& visit) {
    constexpr std::int64_t found = 16 * splatBlock; // at a time
    std::int32_t cells[3 * found];
    std::int64_t outside = 0;
    const std::int64_t end = std::min((number + 1) * part, count);
    for (std::int64_t begin = number * part; begin < end && !progress.ShouldStop(); begin += found)
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

template <int Dimension, class Real>
CellBox<Dimension> SplatTiles<Dimension, Real>::Box(std::int64_t tile) const
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

template <int Dimension, class Real>
const std::uint32_t* SplatTiles<Dimension, Real>::Begin(std::int64_t tile) const
{
  return this->Index.data() + this->Start[static_cast<std::size_t>(tile)];
}

template <int Dimension, class Real>
std::int64_t SplatTiles<Dimension, Real>::CountOf(std::int64_t tile) const
{
  const auto t = static_cast<std::size_t>(tile);
  return this->Start[t + 1] - this->Start[t];
}

template class SplatTiles<1, float>;
template class SplatTiles<2, float>;
template class SplatTiles<3, float>;
template class SplatTiles<1, double>;
template class SplatTiles<2, double>;
template class SplatTiles<3, double>;

} // namespace RectifiedTransport
