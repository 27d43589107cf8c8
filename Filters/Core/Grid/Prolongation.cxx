// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Grid/Prolongation.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

// Multilinear interpolation, along one axis after the other: values lie as [after][nodes][before].
template <int Dimension>
NodeValues prolong(const NodeValues& values, const GridSize<Dimension>& from,
  const GridSize<Dimension>& to, Progress& progress)
{
  NodeValues last;
  const double* read = values.data();
  GridSize<Dimension> cells = from;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    std::int64_t before = 1;
    std::int64_t after = 1;
    for (int a = 0; a < Dimension; ++a)
    {
      (a < axis ? before : after) *= a == axis ? 1 : cells[a] + 1;
    }
    const std::int64_t old = cells[axis] + 1;
    const std::int64_t nodes = to[axis] + 1;
    // Node j lies at j M_old / M_new, in cells of the old nodes, which need not be an integer
    // factor.
    const double ratio = static_cast<double>(cells[axis]) / static_cast<double>(to[axis]);
    NodeValues made(before * nodes * after);
    double* written = made.data();
    const std::int64_t lines = std::max<std::int64_t>(1, 4096 / before);
    progress.For(nodes * after * before, lines * before, [=](std::int64_t first, std::int64_t end) {
      for (std::int64_t line = first / before; line < end / before; ++line)
      {
        // The last node lies at the end of the last interval.
        const double place = static_cast<double>(line % nodes) * ratio;
        const auto low = std::min(static_cast<std::int64_t>(place), old - 2);
        const double weight = place - static_cast<double>(low);
        const double* x = read + (line / nodes * old + low) * before;
        double* out = written + line * before;
        for (std::int64_t i = 0; i < before; ++i)
        {
          out[i] = (1.0 - weight) * x[i] + weight * x[i + before];
        }
      }
    });
    last = std::move(made);
    read = last.data();
    cells[axis] = to[axis];
  }
  return last;
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(prolong);

} // namespace RectifiedTransport
