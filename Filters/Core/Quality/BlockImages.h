// SPDX-License-Identifier: BSD-3-Clause
// The images of a map's blocks: where they lie, and integrals over their faces.
#ifndef RectifiedTransport_BlockImages_h
#define RectifiedTransport_BlockImages_h

#include "Core/Quality/LayerBins.h"
#include "Core/Quality/MapBlocks.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace RectifiedTransport
{

template <int Dimension>
class BlockImages
{
public:
  explicit BlockImages(const MapSamples<Dimension>& map)
    : Map(map)
  {
  }

  const double* At(const GridSize<Dimension>& sample) const
  {
    return this->Map.Positions[this->Map.Within.NumberOf(sample)];
  }

  // The integral over a face of blocks across an axis, in the direction of the axis.
  template <class Integral>
  double Across(int axis, const GridSize<Dimension>& face, const Integral& integral) const
  {
    constexpr std::int64_t size = MapBlocks<Dimension>::Size;
    GridSize<Dimension> sample;
    for (int a = 0; a < Dimension; ++a)
    {
      sample[a] = size * face[a];
    }
    // The image of the face's first sample; others follow by strides in memory.
    const double* first = this->At(sample);
    // Doubles from a sample's image to that of the next one along an axis.
    const auto strideOf = [this](int a) {
      std::int64_t stride = Dimension;
      for (int b = 0; b < a; ++b)
      {
        stride *= this->Map.Within.Cells[b];
      }
      return stride;
    };
    if constexpr (Dimension == 1)
    {
      return integral.Point(first);
    }
    else if constexpr (Dimension == 2)
    {
      // Anticlockwise, the boundary of a block goes up on the right and to the left at the top.
      const std::int64_t stride = strideOf(1 - axis);
      double sum = 0.0;
      for (std::int64_t i = 0; i < size; ++i)
      {
        sum += integral.Edge(first + i * stride, first + (i + 1) * stride);
      }
      return axis == 0 ? sum : -sum;
    }
    else
    {
      // A face is divided into triangles in the same way for both blocks that share it, so that the
      // integrals over it cancel.
      const std::int64_t alongU = strideOf((axis + 1) % Dimension);
      const std::int64_t alongV = strideOf((axis + 2) % Dimension);
      double sum = 0.0;
      for (std::int64_t j = 0; j < size; ++j)
      {
        for (std::int64_t i = 0; i < size; ++i)
        {
          const double* low = first + i * alongU + j * alongV;
          const double* across = low + alongU + alongV;
          sum += integral.Triangle({ low, low + alongU, across }) +
            integral.Triangle({ low, across, low + alongV });
        }
      }
      return sum;
    }
  }

  // Returns the layers of a grid of `size` layers that contain the images of samples.
  LayerSpan LayersOf(const LatticePart<Dimension>& samples, std::int64_t size) const
  {
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;
    const std::int64_t count = samples.Count();
    for (std::int64_t i = 0; i < count; ++i)
    {
      const double place = this->At(samples.CellOf(i))[Dimension - 1];
      low = std::min(low, place);
      high = std::max(high, place);
    }
    const std::int64_t end = size - 1;
    return { std::min(static_cast<std::int64_t>(low), end),
      std::min(static_cast<std::int64_t>(high), end) + 1 };
  }

private:
  const MapSamples<Dimension>& Map;
};

} // namespace RectifiedTransport

#endif
