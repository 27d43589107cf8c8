// SPDX-License-Identifier: BSD-3-Clause
// A density on a surface, in parts of its largest value.
#ifndef RectifiedTransport_SurfaceDensity_h
#define RectifiedTransport_SurfaceDensity_h

#include "Surfaces/SurfaceRelaxation/GeodesicTracer.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

// The largest quotient of densities at neighbouring places; what is more is a jump.
constexpr double largestStep = 2.0;

class SurfaceDensity
{
public:
  // Keeps views of the surface and the values. Throws InvalidDensity for values that are
  // negative or not finite, or 0 everywhere.
  SurfaceDensity(
    const GeodesicTracer& tracer, const SurfaceDensityValues& values, Progress& progress);

  bool IsUniform() const { return !this->Values.AtPoints && !this->Values.OfTriangles; }
  bool IsLinear() const { return this->Values.AtPoints != nullptr; }

  // Relative to the largest value.
  // The density at the corners of a triangle.
  std::array<double, 3> AtCorners(std::int64_t triangle) const
  {
    std::array<double, 3> values{ 1.0, 1.0, 1.0 };
    if (this->Values.AtPoints && this->Tracer.IsPart(triangle))
    {
      return this->AtCornersOfPart(triangle);
    }
    const std::int64_t* points = this->Tracer.Triangle(triangle);
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (this->Values.AtPoints)
      {
        values[i] = this->Values.AtPoints[points[i]] / this->Maximum;
      }
      else if (this->Values.OfTriangles)
      {
        values[i] = this->Values.OfTriangles[this->Tracer.GivenTriangle(triangle)] / this->Maximum;
      }
    }
    return values;
  }
  double MeanOf(std::int64_t triangle) const
  {
    const std::array<double, 3> values = this->AtCorners(triangle);
    return this->IsLinear() ? (values[0] + values[1] + values[2]) * (1.0 / 3.0) : values[0];
  }
  double MassOf(std::int64_t triangle) const
  {
    return this->Tracer.Area(triangle) * this->MeanOf(triangle);
  }

private:
  std::array<double, 3> AtCornersOfPart(std::int64_t triangle) const;

  const GeodesicTracer& Tracer;
  SurfaceDensityValues Values;
  double Maximum = 1.0; // largest value; all others are relative to it
};

} // namespace RectifiedTransport

#endif
