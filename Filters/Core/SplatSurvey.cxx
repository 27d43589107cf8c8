// SPDX-License-Identifier: BSD-3-Clause
#include "SplatSurvey.h"

#include <algorithm>
#include <cmath>

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
typename SplatSurvey<Dimension, Real>::Planes SplatSurvey<Dimension, Real>::PlanesOf(
  std::int64_t first, std::int64_t count) const
{
  double low[3];
  double high[3];
  boundsOf(this->Job->Particles.Points + 3 * first, count, low, high);
  constexpr int axis = Dimension - 1;
  const SplatMap<Dimension>& map = this->Job->Particles.ToIndex;
  double least = 0.0;
  double most = 0.0;
  for (int r = 0; r < 3; ++r)
  {
    const double one = map.Matrix[axis][r] * (low[r] - map.Origin[r]);
    const double other = map.Matrix[axis][r] * (high[r] - map.Origin[r]);
    least += std::min(one, other);
    most += std::max(one, other);
  }
  // A cell more than the kernel reaches is more than rounding.
  const double size = this->Job->Size[axis];
  const double kept = this->Job->Kept[axis];
  const double reach = 0.5 * this->Job->Width + 2.0;
  const bool known = std::isfinite(least) && std::isfinite(most);
  const double begin = known ? std::clamp(std::floor(least - reach), 0.0, size - kept) : 0.0;
  const double end = known ? std::clamp(std::ceil(most + reach), kept, size) : size;
  return { static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end) };
}

template <int Dimension, class Real>
void SplatSurvey<Dimension, Real>::Look(
  std::int64_t first, std::int64_t count, const Executor& executor)
{
  const std::int64_t chunks = (count + splatChunk - 1) / splatChunk;
  this->Chunks.resize(static_cast<std::size_t>(chunks));
  executor.For(chunks, 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t chunk = begin; chunk < end; ++chunk)
    {
      const std::int64_t start = chunk * splatChunk;
      this->Chunks[static_cast<std::size_t>(chunk)] =
        this->PlanesOf(first + start, std::min(splatChunk, count - start));
    }
  });
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
