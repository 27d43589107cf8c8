// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/NodeLayout.h"

namespace RectifiedTransport
{

namespace
{

// Returns the smallest stride, in cache lines, that is at least `lines` and maps the rows in a
// particle's neighbourhood to different sets of the caches. With 2^k cells a row, all of them would
// share one set. `rowStride` is the stride of the previous axis, 0 for the first.
std::int64_t spreadStride(std::int64_t lines, std::int64_t rowStride)
{
  // First-level caches have 64 sets of 64-byte lines. Up to 10 neighbouring rows stay 3 sets apart;
  // in 3D, rows and planes within 3 of each other stay 2 sets apart.
  constexpr std::int64_t sets = 64;
  constexpr int reach = 10;
  constexpr std::int64_t apart = 3;
  const auto distance = [](std::int64_t offset) {
    const std::int64_t set = ((offset % sets) + sets) % sets;
    return std::min(set, sets - set);
  };
  for (std::int64_t stride = lines; stride < lines + sets; ++stride)
  {
    bool spread = true;
    for (int step = 1; step <= reach && spread; ++step)
    {
      spread = distance(step * stride) >= apart;
    }
    const int across = rowStride > 0 ? 3 : 0;
    for (int step = 1; step <= across && spread; ++step)
    {
      for (int row = -across; row <= across && spread; ++row)
      {
        spread = distance(step * stride + row * rowStride) >= 2;
      }
    }
    if (spread)
    {
      return stride;
    }
  }
  // No stride spreads them all; any other is as good.
  return lines;
}

} // namespace

template <int Dimension>
std::int64_t layOutNodes(const GridSize<Dimension>& nodes, std::int64_t (&stride)[Dimension])
{
  // The doubles of a cache line.
  constexpr std::int64_t line = 8;
  stride[0] = TableView<Dimension>::Record;
  for (int axis = 1; axis < Dimension; ++axis)
  {
    const std::int64_t lines = (stride[axis - 1] * nodes[axis - 1] + line - 1) / line;
    stride[axis] = spreadStride(lines, axis > 1 ? stride[axis - 1] / line : 0) * line;
  }
  return (stride[Dimension - 1] * nodes[Dimension - 1] + line - 1) / line * line;
}

template std::int64_t layOutNodes<1>(const GridSize<1>&, std::int64_t (&)[1]);
template std::int64_t layOutNodes<2>(const GridSize<2>&, std::int64_t (&)[2]);
template std::int64_t layOutNodes<3>(const GridSize<3>&, std::int64_t (&)[3]);

} // namespace RectifiedTransport
