// SPDX-License-Identifier: BSD-3-Clause
// The weighted means of the positions of the particles that densities share.
#ifndef RectifiedTransport_ParticlePositions_h
#define RectifiedTransport_ParticlePositions_h

#include "Core/Flow/WeightedMean.h"
#include "Core/Geometry/PhysicalPoints.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport::Bridge
{

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
