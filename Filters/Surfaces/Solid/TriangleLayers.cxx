// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/TriangleLayers.h"

#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

// A counting sort: triangles of a layer are contiguous and keep their order.
TriangleLayers::TriangleLayers(const TriangleSurface& surface, std::int64_t layers,
  std::int64_t firstLayer, std::int64_t endLayer, Progress& progress)
  : Surface(surface)
  , FirstLayer(firstLayer)
  , EndLayer(endLayer)
  , First(layers + 2, 0)
{
  // Counted as differences along the layers: O(1) for a triangle of any height.
  Stages stages(progress, { { "counts", 1 }, { "lists", 1 } });
  this->ForTriangles(
    stages["counts"].Expect(surface.NumberOfTriangles), [this](std::int64_t, const Range& range) {
      ++this->First.data()[range.First + 1];
      --this->First.data()[range.End + 1];
    });
  std::int64_t* first = this->First.data();
  std::int64_t open = 0;
  std::int64_t sum = 0;
  for (std::int64_t k = 0; k <= layers; ++k)
  {
    open += first[k];
    sum += open;
    first[k] = sum; // where layer k begins
  }
  this->Triangles = LargeBuffer<std::int64_t>(sum);
  LargeBuffer<std::int64_t> next(layers);
  std::copy_n(first, layers, next.data());
  Progress& lists = stages["lists"].Expect(surface.NumberOfTriangles + sum);
  this->ForTriangles(lists, [&, this](std::int64_t triangle, const Range& range) {
    for (std::int64_t k = range.First; k < range.End; ++k)
    {
      this->Triangles.data()[next.data()[k]++] = triangle;
    }
    lists.Add(range.End - range.First);
  });
}

// Layers whose open interval the triangle's range of z meets: floor(low) to ceil(high). A flat
// triangle in a plane z = k has none.
TriangleLayers::Range TriangleLayers::LayersOf(std::int64_t triangle) const
{
  const std::int64_t* corners = this->Surface.Triangles + 3 * triangle;
  const double z[3] = { this->Surface.Points[corners[0]][2], this->Surface.Points[corners[1]][2],
    this->Surface.Points[corners[2]][2] };
  const auto end = static_cast<double>(this->EndLayer);
  const double low = std::max(0.0, std::min({ z[0], z[1], z[2], end }));
  const double high = std::max(0.0, std::min(std::max({ z[0], z[1], z[2] }), end));
  return { std::max(static_cast<std::int64_t>(low), this->FirstLayer),
    static_cast<std::int64_t>(std::ceil(high)) };
}

// Calls visit(triangle, range) for all triangles with a layer, in their order.
template <class Visit>
void TriangleLayers::ForTriangles(Progress& progress, const Visit& visit)
{
  for (std::int64_t i = 0; i < this->Surface.NumberOfTriangles; ++i)
  {
    const Range range = this->LayersOf(i);
    if (range.First < range.End)
    {
      visit(i, range);
    }
    progress.Add(1);
  }
}

} // namespace RectifiedTransport
