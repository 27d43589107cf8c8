// SPDX-License-Identifier: BSD-3-Clause
// The push-forward T_# mu of a density by a map, as masses of the nodes' hats.
#include "Core/OptimalMap/Nodes/NodeSums.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// Each cell is divided into samples as the map stretches it. A sample's mass goes to its image and
// is deposited on the nodes about it by multilinear weights, the transpose of interpolation.
template <int Dimension>
void pushForward(const NodeMap<Dimension>& map, const double* cells, const SampleFineness& fineness,
  NodeSums<Dimension>& sums, Progress& progress)
{
  const std::int64_t row = map.Grid.Cells[0];
  // Rows a chunk: about 1024 cells.
  const std::int64_t rows = std::max<std::int64_t>(1, 1024 / row);
  constexpr std::int64_t firstCells = std::int64_t{ 1 } << 15;
  progress.For(
    map.Grid.NumberOfCells(), rows * row,
    [&](std::int64_t first, std::int64_t last) {
      typename NodeSums<Dimension>::Part part(sums);
      ImageSamples<Dimension> samples(map, fineness);
      for (std::int64_t r = first / row; r < last / row; ++r)
      {
        samples.ForRow(
          r, cells, [&](const CellSample<Dimension>& sample, const Point<Dimension>& image) {
            part.Add(sample.Mass, image.data());
          });
      }
    },
    firstCells);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(pushForward);

} // namespace RectifiedTransport
