// SPDX-License-Identifier: BSD-3-Clause
// Sections 3.4, 5.2 and 5.3 of the paper on top of its Algorithms 1 and 2, as they stand: uniform
// particles are advected to each density, interpolated, and splatted onto the grid. Scalar, and as
// a program would be that has one purpose. The baseline of the benchmarks of morphs.
#ifndef RectifiedTransport_PaperMorph_h
#define RectifiedTransport_PaperMorph_h

#include "PaperTransport.h"

#include <cmath>

namespace RectifiedTransport::Paper
{

// One particle at each cell's centre.
inline std::vector<Vector<2>> uniformParticles(const Size<2>& cells)
{
  std::vector<Vector<2>> particles;
  for (std::int64_t y = 0; y < cells[1]; ++y)
  {
    for (std::int64_t x = 0; x < cells[0]; ++x)
    {
      particles.push_back({ static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5 });
    }
  }
  return particles;
}

// Linear over two cells along each axis; what would fall beyond the border stays in the last cell.
// Particles that got lost on their way are left out.
inline std::vector<double> splat(
  const std::vector<Vector<2>>& particles, double mass, const Size<2>& cells)
{
  std::vector<double> image(static_cast<std::size_t>(cells[0] * cells[1]));
  const auto inside = [](std::int64_t cell, std::int64_t count) {
    return std::min(std::max<std::int64_t>(cell, 0), count - 1);
  };
  for (const Vector<2>& p : particles)
  {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
    {
      continue;
    }
    const double floorX = std::floor(p[0] - 0.5);
    const double floorY = std::floor(p[1] - 0.5);
    const double u = p[0] - 0.5 - floorX;
    const double v = p[1] - 0.5 - floorY;
    for (std::int64_t j = 0; j < 2; ++j)
    {
      const std::int64_t y = inside(static_cast<std::int64_t>(floorY) + j, cells[1]);
      for (std::int64_t i = 0; i < 2; ++i)
      {
        const std::int64_t x = inside(static_cast<std::int64_t>(floorX) + i, cells[0]);
        image[y * cells[0] + x] += mass * (i == 0 ? 1.0 - u : u) * (j == 0 ? 1.0 - v : v);
      }
    }
  }
  return image;
}

// The particles of each density, as its map leaves them.
inline std::vector<std::vector<Vector<2>>> transportToAll(
  const std::vector<const std::vector<double>*>& images, const Size<2>& cells, int steps)
{
  std::vector<std::vector<Vector<2>>> all;
  for (const std::vector<double>* image : images)
  {
    all.push_back(uniformParticles(cells));
    advect(buildTables(*image, cells), all.back(), steps, FinalVelocity::Zero);
  }
  return all;
}

// The image between densities, by weights.
inline std::vector<double> between(const std::vector<std::vector<Vector<2>>>& all,
  const std::vector<double>& weights, const Size<2>& cells)
{
  std::vector<Vector<2>> mean(all.front().size());
  for (std::size_t p = 0; p < mean.size(); ++p)
  {
    mean[p] = { 0.0, 0.0 };
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      mean[p][0] += weights[k] * all[k][p][0];
      mean[p][1] += weights[k] * all[k][p][1];
    }
  }
  return splat(mean, 1.0 / static_cast<double>(mean.size()), cells);
}

} // namespace RectifiedTransport::Paper

#endif
