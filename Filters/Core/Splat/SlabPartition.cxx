// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Splat/SlabPartition.h"

#include <algorithm>

namespace RectifiedTransport
{

template <int Dimension, class Real>
void SlabPartition<Dimension, Real>::FindChunks(
  std::int64_t first, std::int64_t count, const Executor& executor)
{
  const std::int64_t chunks = (count + splatChunk - 1) / splatChunk;
  this->Chunks.resize(static_cast<std::size_t>(chunks));
  executor.For(chunks, 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t chunk = begin; chunk < end; ++chunk)
    {
      const std::int64_t start = chunk * splatChunk;
      const CellBox<Dimension> box =
        this->Reach(*this->Job, first + start, std::min(splatChunk, count - start));
      this->Chunks[static_cast<std::size_t>(chunk)] = { box.Low[Dimension - 1],
        box.High[Dimension - 1] };
    }
  });
}

template <int Dimension, class Real>
double SlabPartition<Dimension, Real>::CutSlabs(std::int64_t wanted)
{
  // As differences from plane to plane.
  const std::int32_t planes = this->Job->Size[Dimension - 1];
  this->Work.assign(static_cast<std::size_t>(planes) + 1, 0.0);
  for (const Planes& chunk : this->Chunks)
  {
    const double each = 1.0 / (chunk.High - chunk.Low);
    this->Work[static_cast<std::size_t>(chunk.Low)] += each;
    this->Work[static_cast<std::size_t>(chunk.High)] -= each;
  }
  const double share = static_cast<double>(this->Chunks.size()) /
    static_cast<double>(std::max<std::int64_t>(wanted, 1));
  this->Cuts.assign(1, 0);
  double work = 0.0;
  double sum = 0.0;
  for (std::int32_t plane = 0; plane + 1 < planes; ++plane)
  {
    work += this->Work[static_cast<std::size_t>(plane)];
    sum += work;
    if (sum >= share * static_cast<double>(this->Cuts.size()))
    {
      this->Cuts.push_back(plane + 1);
    }
  }
  this->Cuts.push_back(planes);
  double visits = 0.0;
  for (const Planes& chunk : this->Chunks)
  {
    const auto after = std::lower_bound(this->Cuts.begin(), this->Cuts.end(), chunk.High);
    const auto before = std::upper_bound(this->Cuts.begin(), this->Cuts.end(), chunk.Low);
    visits += static_cast<double>(after - before + 1);
  }
  return visits / static_cast<double>(this->Chunks.size());
}

template <int Dimension, class Real>
CellBox<Dimension> SlabPartition<Dimension, Real>::Slab(std::int64_t slab) const
{
  CellBox<Dimension> box;
  for (int a = 0; a < Dimension; ++a)
  {
    box.Low[a] = 0;
    box.High[a] = this->Job->Size[a];
  }
  box.Low[Dimension - 1] = this->Cuts[static_cast<std::size_t>(slab)];
  box.High[Dimension - 1] = this->Cuts[static_cast<std::size_t>(slab) + 1];
  return box;
}

template class SlabPartition<1, float>;
template class SlabPartition<2, float>;
template class SlabPartition<3, float>;
template class SlabPartition<1, double>;
template class SlabPartition<2, double>;
template class SlabPartition<3, double>;

} // namespace RectifiedTransport
