// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SiteDensity.h"

#include <algorithm>
#include <numeric>

namespace RectifiedTransport
{

template <int Dimension>
SiteDensity<Dimension>::SiteDensity(
  const GridSize<Dimension>& size, ConstPointSpan<Dimension> sites)
  : Grid(size)
{
  const std::int64_t count = sites.size();
  std::vector<std::int64_t>& order = this->Grouped.Sites;
  order.resize(static_cast<std::size_t>(count));
  std::vector<std::int64_t> pixels(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    pixels[i] = numberOfCellAt<Dimension>(sites[i], size);
  }
  std::iota(order.begin(), order.end(), std::int64_t{ 0 });
  // A stable sort by pixels leaves the sites of a pixel ascending.
  std::stable_sort(order.begin(), order.end(),
    [&](std::int64_t a, std::int64_t b) { return pixels[a] < pixels[b]; });
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int64_t pixel = pixels[order[i]];
    if (this->Pixels.empty() || this->Pixels.back() != pixel)
    {
      this->Pixels.push_back(pixel);
      this->Grouped.First.push_back(i);
    }
  }
  this->Grouped.First.push_back(count);
}

template <int Dimension>
void SiteDensity<Dimension>::Read(std::int64_t first, std::int64_t count, double* values) const
{
  std::fill_n(values, count, 0.0);
  auto next = std::lower_bound(this->Pixels.begin(), this->Pixels.end(), first);
  for (; next != this->Pixels.end() && *next < first + count; ++next)
  {
    values[*next - first] = static_cast<double>(this->SitesIn(next - this->Pixels.begin()));
  }
}

template <int Dimension>
std::int64_t SiteDensity<Dimension>::Find(std::int64_t pixel) const
{
  return std::lower_bound(this->Pixels.begin(), this->Pixels.end(), pixel) - this->Pixels.begin();
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(SiteDensity);

} // namespace RectifiedTransport
