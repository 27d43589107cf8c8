// SPDX-License-Identifier: BSD-3-Clause
// Particles that move on straight lines, with constant speed.
#ifndef RectifiedTransport_DisplacementInterpolation_h
#define RectifiedTransport_DisplacementInterpolation_h

#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/Particles/ParticleSource.h"
#include "Core/Flow/PointTransport.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// kernel(index of the result, point) of all particles, as `source.Count()` units of work.
template <int Dimension, class Kernel>
void forParticles(ParticleSource<Dimension>& source, Progress& progress, const Kernel& kernel)
{
  constexpr std::int64_t group = 64; // particles that are read together
  const std::int64_t count = source.Count();
  for (std::int64_t begin = 0; begin < count;)
  {
    const std::int64_t chunk = source.Prepare(begin);
    progress.For(
      chunk, 8 * group,
      [&](std::int64_t first, std::int64_t last) {
        std::int64_t index[group];
        Point<Dimension> points[group];
        for (std::int64_t i = first; i < last; i += group)
        {
          const auto size = static_cast<int>(std::min(group, last - i));
          source.Fill(i, size, index, points[0].data());
          for (int j = 0; j < size; ++j)
          {
            kernel(index[j], points[j]);
          }
        }
      },
      64 * group);
    begin += chunk;
  }
}

// ForwardAt of a map whose particles move on straight lines from their seeds to where Forward takes
// them. toImages(seed) is a seed in the space of the images.
template <int Dimension, class ToImages>
FlowReport interpolateDisplacement(const PointTransport<Dimension>& map,
  const FlowSeeds<Dimension>& seeds, const std::vector<double>& times,
  PointSpan<Dimension> positions, const Context& context, const ToImages& toImages)
{
  check(times);
  checkCount(positions.size(), seeds.Count() * static_cast<double>(times.size()));
  const auto several = static_cast<std::int64_t>(times.size());
  const std::int64_t count = positions.size() / several;
  LargeBuffer<double> coordinates(count * Dimension);
  const PointSpan<Dimension> images(coordinates.data(), count);
  Progress progress(context);
  Stages stages(progress, { { "images", 9 }, { "times", 1 } });
  const FlowReport report = map.Forward(seeds, images, stages["images"]);
  ParticleSource<Dimension> source(seeds, map.Size(), count);
  forParticles(
    source, stages["times"].Expect(count), [&](std::int64_t index, const Point<Dimension>& point) {
      const Point<Dimension> begins = toImages(point);
      const double* image = images[index];
      for (std::int64_t t = 0; t < several; ++t)
      {
        const double time = times[static_cast<std::size_t>(t)];
        double* position = positions[index * several + t];
        for (int axis = 0; axis < Dimension; ++axis)
        {
          position[axis] = begins[axis] + time * (image[axis] - begins[axis]);
        }
      }
    });
  return report;
}

} // namespace RectifiedTransport

#endif
