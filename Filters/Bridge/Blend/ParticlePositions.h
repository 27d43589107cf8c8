// SPDX-License-Identifier: BSD-3-Clause
// Positions of the particles that densities share: physical ones, and their weighted means.
#ifndef RectifiedTransport_ParticlePositions_h
#define RectifiedTransport_ParticlePositions_h

#include "Core/Flow/WeightedMean.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport::Bridge
{

constexpr std::int64_t grainOfPositions = std::int64_t{ 1 } << 13;

// From index to physical coordinates, which in 3D may share memory.
template <int D>
void writePhysical(
  const ImageGrid& grid, ConstPointSpan<D> positions, Progress& progress, PointSpan<3> physical)
{
  progress.For(positions.size(), grainOfPositions, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      double index[D];
      std::copy_n(positions[i], D, index);
      grid.ToPhysical<D>(index, physical[i]);
    }
  });
}

// The means of the positions in inputs, by their Weight.
template <class Inputs>
void writeMeans(const std::vector<vtkSmartPointer<vtkDoubleArray>>& positions, const Inputs& inputs,
  Progress& progress, PointSpan<3> means)
{
  std::vector<WeightedPositions> parts;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    parts.push_back({ { positions[i]->GetPointer(0), means.size() }, inputs[i].Weight });
  }
  progress.For(means.size(), grainOfPositions,
    [&](std::int64_t first, std::int64_t last) { writeWeightedMean(parts, first, last, means); });
}

} // namespace RectifiedTransport::Bridge

#endif
