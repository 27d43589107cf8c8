// SPDX-License-Identifier: BSD-3-Clause
// The core from outside, without VTK: particles of a density that is a formula, and back to where
// they came from.
#include <RectifiedTransport/Core/Flow/RectifiedFlow.h>
#include <RectifiedTransport/Core/Seeds/Seeds.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace RectifiedTransport;

const GridSize<2> size{ 64, 48 };

// Rises from left to right: the left half has a quarter of the mass.
class Ramp final : public DensityValues
{
public:
  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = static_cast<double>((first + i) % size[0]) + 0.5;
    }
  }
};

int main()
{
  const int count = 10000;
  std::vector<Point<2>> seeds(count);
  generateSeeds<2>(SeedPattern::BlueNoise, { 64, 48 }, 1, seeds);
  for (Point<2>& seed : seeds)
  {
    seed = { seed[0] * 64, seed[1] * 48 }; // the unit box to cells
  }

  const Ramp density;
  const RectifiedFlow<2> flow({ size, density }); // makes the tables, once for both ways
  std::vector<Point<2>> particles(count);
  std::vector<Point<2>> origins(count);
  flow.Forward(seeds, particles);
  flow.Backward(particles, origins);

  int left = 0;
  double distance = 0;
  for (int i = 0; i < count; ++i)
  {
    left += particles[i][0] < 32;
    const Point<2>& seed = seeds[i];
    distance = std::max(distance, std::hypot(origins[i][0] - seed[0], origins[i][1] - seed[1]));
  }
  const double share = flow.Share({ 0, 0 }, { 32, 48 });
  const double part = static_cast<double>(left) / count;
  std::cout << "the left half has " << share << " of the mass and " << part << " of the particles, "
            << "which go back to within " << distance << " cells of their seeds\n";
  return std::abs(part - share) < 0.001 && distance < 0.1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
