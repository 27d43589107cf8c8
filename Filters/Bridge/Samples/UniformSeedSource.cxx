// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Samples/UniformSeedSource.h"

#include "Bridge/Data/Cells/ParticleCells.h"
#include "Bridge/Run/Memory.h"
#include "Core/Seeds/SeedShare.h"

#include "vtkDoubleArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

void requireBounds(const double* bounds, int dimension)
{
  const char axes[] = { 'x', 'y', 'z' };
  for (int a = 0; a < 3; ++a)
  {
    const double low = bounds[2 * a];
    const double high = bounds[2 * a + 1];
    const bool flat = a >= dimension && low == high;
    if (!std::isfinite(high - low) || (!(low < high) && !flat))
    {
      std::ostringstream message;
      message << "Bounds are " << low << " to " << high << " in " << axes[a]
              << "; they must be finite, the second greater than the first";
      throw Failure(message.str());
    }
  }
}

template <int D>
void fillBox(
  const UniformSeedSource& source, int piece, int pieces, Progress& progress, vtkPolyData* output)
{
  const double* bounds = source.Bounds.data();
  Point<D> lengths;
  for (int a = 0; a < D; ++a)
  {
    lengths[a] = bounds[2 * a + 1] - bounds[2 * a];
  }
  const UnitSeeds<D> seeds(
    source.Pattern, lengths, source.NumberOfPoints, static_cast<std::uint64_t>(source.RandomSeed));
  constexpr double bytesPerPoint = 3 * sizeof(double) + 2 * sizeof(vtkIdType);
  const std::string purpose = "the points (see NumberOfPoints)";
  const SeedShare share(seeds.Count(), pieces, piece);
  requireMemory({ purpose, share.Count * bytesPerPoint });
  const auto count = static_cast<vtkIdType>(share.Count);

  auto coordinates = newArray<vtkDoubleArray>("Points", 3, count);
  double* points = coordinates->GetPointer(0);
  LargeBuffer<double> separate;
  Stages stages(progress, { { "pattern", 6 }, { "points", 2 }, { "cells", 2 } });
  withMemory({ purpose, static_cast<double>(count) * D * sizeof(double) }, [&]() {
    separate = LargeBuffer<double>(D == 3 ? 0 : count * D);
    const PointSpan<D> made(D == 3 ? points : separate.data(), count);
    seeds.GenerateFrom(share.First, made, stages["pattern"]);
  });
  const double* unit = D == 3 ? points : separate.data();

  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  stages["points"].ForEach(count, grain, [=](std::int64_t i) {
    for (int a = 0; a < D; ++a)
    {
      const double low = bounds[2 * a];
      const double high = bounds[2 * a + 1];
      // Rounding of low + (high - low) u may pass the upper bound.
      points[3 * i + a] = std::min(low + (high - low) * unit[i * D + a], high);
    }
    if (D == 2)
    {
      points[3 * i + 2] = bounds[4];
    }
  });
  setParticles(output, coordinates, 1, stages["cells"]);
}

} // namespace

void UniformSeedSource::Run(int piece, int pieces, Progress& progress, vtkPolyData* output) const
{
  requireBounds(this->Bounds.data(), this->Dimension);
  const auto fill = this->Dimension == 2 ? fillBox<2> : fillBox<3>; // not 1, as the filter checks
  fill(*this, piece, pieces, progress, output);
}

} // namespace RectifiedTransport::Bridge
