// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Nodes/NodeMap.h"

#include "Core/Parallel/Progress.h"

#include <numeric>

namespace RectifiedTransport
{

namespace
{

// So many neighbouring lines are smoothed together: their values of one node are 1 KiB of
// contiguous memory, and the old values of the node before fit on the stack.
constexpr std::int64_t mostLines = 128;

// Computes one coordinate of T = x - grad phi, in cells: T_i = i - (phi_{i+1} - phi_{i-1}) / (2
// h^2), with one-sided differences at the ends, for lines along axis 0.
struct Differences
{
  const double* Potential;
  double* Images;
  std::int64_t Nodes;  // along axis 0
  std::int64_t Stride; // between neighbours along the coordinate's axis
  std::int64_t Cells;  // along this axis
  double Scale;        // 1 / h^2: one h of the derivative, one for lengths in cells

  // Along axis 0, where neighbours are adjacent in memory.
  void WriteAlong(std::int64_t first, std::int64_t last) const
  {
    const double half = 0.5 * this->Scale;
    const std::int64_t n = this->Nodes;
    for (std::int64_t line = first; line < last; ++line)
    {
      const double* p = this->Potential + line * n;
      double* out = this->Images + line * n;
      // One-sided at the ends, where the potential has a neighbour on one side alone.
      out[0] = -(p[1] - p[0]) * this->Scale;
      for (std::int64_t i = 1; i + 1 < n; ++i)
      {
        out[i] = static_cast<double>(i) - half * (p[i + 1] - p[i - 1]);
      }
      out[n - 1] = static_cast<double>(n - 1) - (p[n - 1] - p[n - 2]) * this->Scale;
      this->Clamp(out);
    }
  }

  // Along another axis, where the neighbours of a line are lines, so that each line is one loop.
  void WriteAcross(std::int64_t first, std::int64_t last) const
  {
    for (std::int64_t line = first; line < last; ++line)
    {
      const std::int64_t node = line * this->Nodes / this->Stride % (this->Cells + 1);
      const std::int64_t low = node > 0 ? this->Stride : 0;
      const std::int64_t high = node < this->Cells ? this->Stride : 0;
      // A one-sided difference spans h, a central one 2 h.
      const double scale = low > 0 && high > 0 ? 0.5 * this->Scale : this->Scale;
      const double at = static_cast<double>(node);
      const double* p = this->Potential + line * this->Nodes;
      double* out = this->Images + line * this->Nodes;
      for (std::int64_t i = 0; i < this->Nodes; ++i)
      {
        out[i] = at - scale * (p[i + high] - p[i - low]);
      }
      this->Clamp(out);
    }
  }

  // An image beyond the box would have left the convex domain.
  void Clamp(double* images) const
  {
    const double most = static_cast<double>(this->Cells);
    for (std::int64_t i = 0; i < this->Nodes; ++i)
    {
      images[i] = std::clamp(images[i], 0.0, most);
    }
  }
};

// Applies the stencil 1/4, 1/2, 1/4 in place to `lines` (at most mostLines) neighbouring lines,
// whose nodes are a stride apart. `before` holds the old value of the node before.
void smoothLines(double* values, std::int64_t nodes, std::int64_t stride, std::int64_t lines)
{
  std::array<double, mostLines> before;
  std::copy_n(values, lines, before.data());
  // The first and the last node keep their values: an average there would pull the image inwards.
  for (std::int64_t node = 1; node + 1 < nodes; ++node)
  {
    double* own = values + node * stride;
    for (std::int64_t i = 0; i < lines; ++i)
    {
      const double value = own[i];
      own[i] = 0.5 * value + 0.25 * (before[static_cast<std::size_t>(i)] + own[i + stride]);
      before[static_cast<std::size_t>(i)] = value;
    }
  }
}

} // namespace

// A coordinate at a time, each over all lines along axis 0.
template <int Dimension>
void writeGradientMap(const double* potential, NodeMap<Dimension>& map, Progress& progress)
{
  const NodeGrid<Dimension>& grid = map.Grid;
  const std::int64_t nodes = grid.Cells[0] + 1;
  // Chunks of about 4096 nodes, in whole lines.
  const std::int64_t grain = std::max<std::int64_t>(1, 4096 / nodes);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double spacing = grid.Spacing[axis];
    const Differences differences{ potential, map.Images[static_cast<std::size_t>(axis)].data(),
      nodes, grid.Stride(axis), grid.Cells[axis], 1.0 / (spacing * spacing) };
    progress.For(grid.NumberOfNodes(), grain * nodes, [&](std::int64_t first, std::int64_t last) {
      if (axis == 0)
      {
        differences.WriteAlong(first / nodes, last / nodes);
      }
      else
      {
        differences.WriteAcross(first / nodes, last / nodes);
      }
    });
  }
}

// The stencils of the axes commute, so the axes are smoothed one after the other.
template <int Dimension>
void smoothMap(NodeMap<Dimension>& map, Progress& progress)
{
  for (NodeValues& images : map.Images)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t stride = map.Grid.Stride(axis);
      const std::int64_t nodes = map.Grid.Cells[axis] + 1;
      // The lines along an axis form groups of `stride` neighbours, which are smoothed in blocks.
      const std::int64_t blocks = (stride + mostLines - 1) / mostLines;
      const std::int64_t all = images.size() / (nodes * stride) * blocks;
      const std::int64_t grain =
        std::max<std::int64_t>(1, 4096 / (nodes * std::min(stride, mostLines)));
      progress.ForEach(all, grain, [&](std::int64_t i) {
        const std::int64_t begin = i % blocks * mostLines;
        smoothLines(images.data() + i / blocks * nodes * stride + begin, nodes, stride,
          std::min(mostLines, stride - begin));
      });
    }
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(smoothMap);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(limitFineness);
// A map that stretches needs many samples a cell. Their mean is estimated from every eighth row; if
// it is too large, the samples along each axis become fewer by the factor's Dimension-th root.
template <int Dimension>
SampleFineness limitFineness(
  const NodeMap<Dimension>& map, const double* masses, SampleFineness fineness, Progress& progress)
{
  constexpr std::int64_t apart = 8; // take every eighth row for the estimate
  constexpr double most = 4.0;      // samples a cell
  constexpr int attempts = 4;       // as each cell has a sample, the first may be too many
  const std::int64_t cells = map.Grid.Cells[0];
  const std::int64_t rows = (ImageSamples<Dimension>::NumberOfRows(map.Grid) + apart - 1) / apart;
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    std::vector<double> counts(static_cast<std::size_t>(rows));
    progress.Threads().For(
      rows, std::max<std::int64_t>(1, 1024 / cells), [&](std::int64_t first, std::int64_t last) {
        ImageSamples<Dimension> samples(map, fineness);
        for (std::int64_t row = first; row < last; ++row)
        {
          counts[static_cast<std::size_t>(row)] = samples.CountRow(apart * row, masses);
        }
      });
    progress.Check();
    const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
    // The mean number of samples a cell, also over cells without mass.
    const double each = all / static_cast<double>(rows * cells);
    if (each <= most)
    {
      break;
    }
    const double part = std::pow(most / each, 1.0 / Dimension);
    // Both fall by the same factor, so that light cells keep fewer samples than others.
    fineness.Each *= part;
    fineness.OfLightCells *= part;
  }
  return fineness;
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(writeGradientMap);

} // namespace RectifiedTransport
