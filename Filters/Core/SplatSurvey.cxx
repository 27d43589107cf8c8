// SPDX-License-Identifier: BSD-3-Clause
#include "SplatSurvey.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// The box of physical space around particles.
template <class Real>
void boundsOf(const Real* points, std::int64_t count, double low[3], double high[3])
{
  Real least[3] = { points[0], points[1], points[2] };
  Real most[3] = { points[0], points[1], points[2] };
  for (std::int64_t i = 1; i < count; ++i)
  {
    for (int r = 0; r < 3; ++r)
    {
      const Real x = points[3 * i + r];
      least[r] = x < least[r] ? x : least[r];
      most[r] = x > most[r] ? x : most[r];
    }
  }
  for (int r = 0; r < 3; ++r)
  {
    low[r] = least[r];
    high[r] = most[r];
  }
}

} // namespace

template <int Dimension, class Real>
CellBox<Dimension> SplatSurvey<Dimension, Real>::BoxOf(std::int64_t first, std::int64_t count) const
{
  double low[3];
  double high[3];
  boundsOf(this->Job->Particles.Points + 3 * first, count, low, high);
  const SplatMap<Dimension>& map = this->Job->Particles.ToIndex;
  CellBox<Dimension> box;
  for (int a = 0; a < Dimension; ++a)
  {
    double least = 0.0;
    double most = 0.0;
    for (int r = 0; r < 3; ++r)
    {
      const double one = map.Matrix[a][r] * (low[r] - map.Origin[r]);
      const double other = map.Matrix[a][r] * (high[r] - map.Origin[r]);
      least += std::min(one, other);
      most += std::max(one, other);
    }
    // A cell more than the kernel reaches is more than rounding.
    const double size = this->Job->Size[a];
    const double kept = this->Job->Kept[a];
    const double reach = 0.5 * this->Job->Width + 2.0;
    const bool known = std::isfinite(least) && std::isfinite(most);
    const double begin = known ? std::clamp(std::floor(least - reach), 0.0, size - kept) : 0.0;
    const double end = known ? std::clamp(std::ceil(most + reach), kept, size) : size;
    box.Low[a] = static_cast<std::int32_t>(begin);
    box.High[a] = static_cast<std::int32_t>(end);
  }
  return box;
}

template <int Dimension, class Real>
double SplatSurvey<Dimension, Real>::Look(
  std::int64_t first, std::int64_t count, std::int64_t samples, const Executor& executor)
{
  const std::int64_t chunks = (count + splatChunk - 1) / splatChunk;
  const std::int64_t looks = samples > 0 ? std::min(samples, chunks) : chunks;
  this->Chunks.resize(static_cast<std::size_t>(looks));
  this->Cells.resize(static_cast<std::size_t>(looks));
  executor.For(looks, 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t look = begin; look < end; ++look)
    {
      const std::int64_t start = look * chunks / looks * splatChunk;
      const CellBox<Dimension> box =
        this->BoxOf(first + start, std::min(splatChunk, count - start));
      double cells = 1.0;
      for (int a = 0; a < Dimension; ++a)
      {
        cells *= box.High[a] - box.Low[a];
      }
      this->Chunks[static_cast<std::size_t>(look)] = { box.Low[Dimension - 1],
        box.High[Dimension - 1] };
      this->Cells[static_cast<std::size_t>(look)] = cells;
    }
  });
  double sum = 0.0;
  for (const double cells : this->Cells)
  {
    sum += cells;
  }
  return sum / static_cast<double>(looks);
}

template <int Dimension, class Real>
double SplatSurvey<Dimension, Real>::CutSlabs(std::int64_t wanted)
{
  // Differences of the work from plane to plane, at first.
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
CellBox<Dimension> SplatSurvey<Dimension, Real>::Slab(std::int64_t slab) const
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

template class SplatSurvey<1, float>;
template class SplatSurvey<2, float>;
template class SplatSurvey<3, float>;
template class SplatSurvey<1, double>;
template class SplatSurvey<2, double>;
template class SplatSurvey<3, double>;

} // namespace RectifiedTransport
