// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/SurfaceDensity.h"

#include "Core/Parallel/Reduction.h"
#include "Core/Tables/DensityInspection.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Adds the value of a triangle, or those at its three points, to a summary.
void addTriangle(const TriangleSurface& surface, const SurfaceDensityValues& values,
  std::int64_t triangle, DensitySummary& summary)
{
  const auto add = [&summary](double value, std::int64_t index) {
    if (!std::isfinite(value))
    {
      summary.FirstNotFinite = summary.NotFinite++ == 0 ? index : summary.FirstNotFinite;
    }
    else if (value < 0.0)
    {
      summary.FirstNegative = summary.Negative++ == 0 ? index : summary.FirstNegative;
    }
    else
    {
      summary.Maximum = std::max(summary.Maximum, value);
    }
  };
  if (values.OfTriangles)
  {
    add(values.OfTriangles[triangle], triangle);
  }
  for (std::int64_t i = 0; i < 3 && values.AtPoints; ++i)
  {
    const std::int64_t point = surface.Triangles[3 * triangle + i];
    add(values.AtPoints[point], point);
  }
}

} // namespace

SurfaceDensity::SurfaceDensity(
  const GeodesicTracer& tracer, const SurfaceDensityValues& values, Progress& progress)
  : Tracer(tracer)
  , Values(values)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  if (this->IsUniform())
  {
    return;
  }
  // Only values that triangles have are checked; points of no triangle may have any.
  const DensitySummary summary = reduceEach(
    progress, tracer.Given().NumberOfTriangles, grain, DensitySummary(),
    [&](std::int64_t triangle, DensitySummary& part) {
      addTriangle(tracer.Given(), this->Values, triangle, part);
    },
    [](DensitySummary all, const DensitySummary& more) {
      merge(more, all);
      return all;
    });
  // A density of 0 everywhere has no place for dots.
  if (summary.NotFinite > 0 || summary.Negative > 0 || summary.Maximum == 0.0)
  {
    throw InvalidDensity(summary);
  }
  // Relative densities keep masses between 0 and the area.
  this->Maximum = summary.Maximum;
}

// The density at the corners of a part of a triangle: linear in the given triangle, so that corners
// on its sides get interpolated values.
std::array<double, 3> SurfaceDensity::AtCornersOfPart(std::int64_t triangle) const
{
  std::array<double, 3> values{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    // The corner in the given triangle's barycentric coordinates.
    PlaceOnTriangle corner{ triangle, { 0.0, 0.0, 0.0 } };
    corner.Weights[i] = 1.0;
    const PlaceOnTriangle given = this->Tracer.GivenPlace(corner);
    for (std::size_t j = 0; j < 3; ++j)
    {
      const std::int64_t point =
        this->Tracer.Given().Triangles[3 * given.Triangle + static_cast<std::int64_t>(j)];
      values[i] += given.Weights[j] * (this->Values.AtPoints[point] / this->Maximum);
    }
  }
  return values;
}

} // namespace RectifiedTransport
