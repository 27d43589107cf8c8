// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/SurfaceMasses.h"

#include "Core/Messages/Failure.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Tables/DensityInspection.h"

#include <array>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

// The summary of the values of points or cells, without ghost cells.
DensitySummary summaryOf(const ReadDensity& density, Progress& progress)
{
  const double* values = density.Values;
  // Points of ghost cells may belong to other cells, too; their values are checked.
  const bool haveGhosts = density.IsGhost && !density.OnPoints;
  const auto add = [](DensitySummary all, const DensitySummary& more) {
    merge(more, all);
    return all;
  };
  return reduceChunks(
    progress, density.Last - density.First, Grain, DensitySummary(),
    [&](std::int64_t first, std::int64_t last) {
      const std::int64_t from = density.First + first;
      if (!haveGhosts)
      {
        return summarize(values + from, last - first, from);
      }
      DensitySummary found;
      for (std::int64_t i = from; i < density.First + last; ++i)
      {
        found = density.IsGhost(i) ? found : add(found, summarize(values + i, 1, i));
      }
      return found;
    },
    add);
}

// Throws Failure for values that are no density, with their number and the first of them.
void requireValid(const DensitySummary& found, const ReadDensity& density)
{
  if (found.NotFinite + found.Negative == 0)
  {
    return;
  }
  // Values that are no numbers are reported before negative ones.
  const bool isFinite = found.NotFinite == 0;
  const std::int64_t count = isFinite ? found.Negative : found.NotFinite;
  const std::int64_t first = isFinite ? found.FirstNegative : found.FirstNotFinite;
  const char* const what = isFinite
    ? (count == 1 ? " negative value" : " negative values")
    : (count == 1 ? " value that is NaN or infinite" : " values that are NaN or infinite");
  fail(density.Name, " has ", count, what, ", the first at index ", first, " (",
    density.Values[first], "); ",
    isFinite ? "a density must not be negative" : "every value must be finite");
}

// The mean of a linear density is its value at the centre; for a part of a triangle, that of the
// centre in the given triangle.
double meanOf(const TriangleDomain& surface, const double* values, std::int64_t triangle)
{
  if (surface.IsPart(triangle))
  {
    constexpr double third = 1.0 / 3.0;
    const PointWeights centre = surface.InGiven({ triangle, { third, third, third } });
    double mean = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      mean += centre.Weights[i] * values[centre.Points[i]];
    }
    return mean;
  }
  const std::array<std::int64_t, 3> corners = surface.CornersOf(triangle);
  return (values[corners[0]] + values[corners[1]] + values[corners[2]]) / 3.0;
}

} // namespace

// Validates and scales the density, then multiplies areas by it, then sums.
SurfaceMasses::SurfaceMasses(
  const TriangleDomain& surface, const ReadDensity& density, Progress& progress)
  : OnPoints(density.OnPoints)
{
  if (density.Values)
  {
    this->ReadRelative(surface.NumberOfTriangles(), density, progress);
  }
  const auto isGhost = [&](std::int64_t triangle) {
    return density.IsGhost(density.CellOf(triangle));
  };
  this->Masses = massesOf(surface, this->Density(),
    density.IsGhost ? isGhost : std::function<bool(std::int64_t)>(), progress);
  this->FindTotal(surface.Areas(), density);
}

// Divides by the largest value, so that masses neither overflow nor vanish.
void SurfaceMasses::ReadRelative(
  std::int64_t triangles, const ReadDensity& density, Progress& progress)
{
  const DensitySummary found = summaryOf(density, progress);
  requireValid(found, density);
  this->Largest = found.Maximum > 0.0 ? found.Maximum : 1.0;
  // Values of cells go to the triangles that the cells were cut into.
  this->Relative = LargeBuffer<double>(this->OnPoints ? density.Last : triangles);
  progress.ForEach(this->Relative.size(), Grain, [&](std::int64_t i) {
    this->Relative.data()[i] =
      density.Values[this->OnPoints ? i : density.CellOf(i)] / this->Largest;
  });
}

// The total in the units of the input: relative mass times Largest times Unit^2. The order of
// factors avoids an intermediate overflow or underflow.
void SurfaceMasses::FindTotal(const SurfaceAreas& areas, const ReadDensity& density)
{
  const bool isGiven = density.Values != nullptr;
  const std::string title =
    isGiven ? density.Name + " has a total mass" : std::string("The input surface has an area");
  if (!(this->Masses.Sum > 0.0))
  {
    fail(title, " of zero", density.IsGhost ? " (duplicate and blanked ghosts carry none)" : "",
      isGiven ? "; at least one value must be positive" : "");
  }
  this->Sum = this->Masses.Sum * areas.Total * areas.Unit * this->Largest * areas.Unit;
  if (!(this->Sum > 0.0))
  {
    fail(title, " below the least double; ",
      isGiven ? "its values, or the coordinates, must be larger"
              : "the coordinates must be larger");
  }
  if (!std::isfinite(this->Sum))
  {
    fail(title, " past the largest double; ",
      isGiven ? "its values must be smaller" : "the coordinates must be smaller");
  }
}

SurfaceDensityValues SurfaceMasses::Density() const
{
  const double* values = this->Relative.size() > 0 ? this->Relative.data() : nullptr;
  SurfaceDensityValues found;
  (this->OnPoints ? found.AtPoints : found.OfTriangles) = values;
  return found;
}

// mass = share of the area times mean density
TriangleMasses massesOf(const TriangleDomain& surface, const SurfaceDensityValues& density,
  const std::function<bool(std::int64_t)>& isEmpty, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  const std::int64_t count = surface.NumberOfTriangles();
  const double* shares = surface.Areas().Shares;
  const auto densityOf = [&](std::int64_t triangle) {
    if (isEmpty && isEmpty(triangle))
    {
      return 0.0;
    }
    // Without values, the density is 1.
    const double ofTriangle = density.OfTriangles ? density.OfTriangles[triangle] : 1.0;
    return density.AtPoints ? meanOf(surface, density.AtPoints, triangle) : ofTriangle;
  };
  TriangleMasses made{ LargeBuffer<double>(count), 0.0 };
  double* masses = made.Masses.data();
  made.Sum = reduceEach(
    progress, count, grain, 0.0,
    [&](std::int64_t triangle, double& sum) {
      masses[triangle] = shares[triangle] * densityOf(triangle);
      sum += masses[triangle];
    },
    std::plus<>());
  return made;
}

} // namespace RectifiedTransport
