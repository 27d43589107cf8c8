// SPDX-License-Identifier: BSD-3-Clause
// Particles that move on straight lines, with constant speed.
#ifndef RectifiedTransport_StraightPaths_h
#define RectifiedTransport_StraightPaths_h

#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/Particles/ParticleSource.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
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

// The positions of seeds on a box of `size` at several times, all times of a particle together.
// Images are where particles are at time 1; toImages(seed) is a seed in the space of the images.
template <int Dimension, class ToImages>
void writeStraightPaths(const FlowSeeds<Dimension>& seeds, const GridSize<Dimension>& size,
  const ToImages& toImages, ConstPointSpan<Dimension> images, const std::vector<double>& times,
  PointSpan<Dimension> positions, Progress& progress)
{
  ParticleSource<Dimension> source(seeds, size, images.size());
  const auto several = static_cast<std::int64_t>(times.size());
  forParticles(
    source, progress.Expect(images.size()), [&](std::int64_t index, const Point<Dimension>& point) {
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
}

} // namespace RectifiedTransport

#endif
