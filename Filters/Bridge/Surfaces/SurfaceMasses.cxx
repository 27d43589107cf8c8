// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surfaces/SurfaceMasses.h"

#include "Bridge/Points/DoubleTuples.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/NumbersOfText.h"
#include "Bridge/Triangles/TriangleInput.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Tables/DensityInspection.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

std::string titleOf(vtkDataArray* array)
{
  const char* name = array->GetName();
  return std::string("The density array '") + (name ? name : "") + "'";
}

// Of the values of points or cells from `begin` on that are no ghosts.
DensitySummary summaryOf(const double* values, const unsigned char* ghosts, std::int64_t begin,
  std::int64_t end, Progress& progress)
{
  const auto add = [](DensitySummary all, const DensitySummary& more) {
    merge(more, all);
    return all;
  };
  return reduceChunks(
    progress, end - begin, Grain, DensitySummary(),
    [=](std::int64_t first, std::int64_t last) {
      const std::int64_t from = begin + first;
      if (!ghosts)
      {
        return summarize(values + from, last - first, from);
      }
      DensitySummary found;
      for (std::int64_t i = from; i < begin + last; ++i)
      {
        found = (ghosts[i] & ghostCell) != 0 ? found : add(found, summarize(values + i, 1, i));
      }
      return found;
    },
    add);
}

void requireValid(const DensitySummary& found, vtkDataArray* array)
{
  if (found.NotFinite + found.Negative == 0)
  {
    return;
  }
  const bool isFinite = found.NotFinite == 0;
  const std::int64_t count = isFinite ? found.Negative : found.NotFinite;
  const std::int64_t first = isFinite ? found.FirstNegative : found.FirstNotFinite;
  const char* const what = isFinite
    ? (count == 1 ? " negative value" : " negative values")
    : (count == 1 ? " value that is NaN or infinite" : " values that are NaN or infinite");
  fail(titleOf(array), " has ", count, what, ", the first at index ", first, " (",
    array->GetComponent(static_cast<vtkIdType>(first), 0), "); ",
    isFinite ? "a density must not be negative" : "every value must be finite");
}

// The density of triangles relative to its largest value, so that no mass is past the largest
// double.
class TriangleDensity
{
public:
  TriangleDensity(const TriangleInput& input, const PlacedTriangles& surface,
    const unsigned char* ghosts, const double* values, bool onPoints, double largest)
    : Input(input)
    , Surface(surface)
    , Ghosts(ghosts)
    , Values(values)
    , OnPoints(onPoints)
    , Largest(largest)
  {
  }

  double operator()(std::int64_t triangle) const
  {
    const vtkIdType cell = this->Input.CellOf(this->Surface.GivenTriangle(triangle));
    if (this->Ghosts && (this->Ghosts[cell] & ghostCell))
    {
      return 0.0;
    }
    if (!this->Values || !this->OnPoints)
    {
      return this->Values ? this->At(cell) : 1.0;
    }
    if (this->Surface.IsPart(triangle))
    {
      constexpr double third = 1.0 / 3.0;
      const PointWeights centre = this->Surface.InGiven({ triangle, { third, third, third } });
      double mean = 0.0;
      for (std::size_t i = 0; i < 3; ++i)
      {
        mean += centre.Weights[i] * this->At(centre.Points[i]);
      }
      return mean;
    }
    const std::array<std::int64_t, 3> corners = this->Surface.CornersOf(triangle);
    return (this->At(corners[0]) + this->At(corners[1]) + this->At(corners[2])) / 3.0;
  }

private:
  double At(std::int64_t i) const { return this->Values[i] / this->Largest; }

  const TriangleInput& Input;
  const PlacedTriangles& Surface;
  const unsigned char* const Ghosts;
  const double* const Values; // null: 1 everywhere
  const bool OnPoints;
  const double Largest;
};

} // namespace

SurfaceDensityArray::SurfaceDensityArray(
  vtkPolyData* surface, vtkAbstractArray* found, bool onPoints, const std::string& name)
  : OnPoints(onPoints)
{
  const NumbersOfText numbers = numbersOf(found);
  this->Values = numbers.Array;
  if (!this->Values)
  {
    throw Failure((found ? "The density array '" + name + "' is not numeric (" + numbers.Wrong + ")"
                         : "The input surface has no density array '" + name + "'") +
      "; it has " + listArrays(surface->GetPointData(), "point") + " and " +
      listArrays(surface->GetCellData(), "cell"));
  }
  requireScalars(this->Values, titleOf(this->Values),
    onPoints ? surface->GetNumberOfPoints() : surface->GetNumberOfCells(),
    onPoints ? "points" : "cells");
}

SurfaceMasses::SurfaceMasses(const TriangleInput& triangles, const PlacedTriangles& surface,
  const SurfaceDensityArray& density, Progress& progress)
{
  vtkPolyData* input = triangles.Input();
  const SurfaceAreas areas = surface.Areas();
  const std::int64_t count = surface.NumberOfTriangles();
  const unsigned char* ghosts = ghostFlags(input, vtkDataObject::CELL, "input surface");
  withMemory("the masses of " + std::to_string(count) + " triangles",
    static_cast<double>(count) * sizeof(double),
    [&]() { this->Masses = LargeBuffer<double>(count); });
  vtkDataArray* array = density.Array();
  std::optional<DoubleTuples> tuples;
  if (array)
  {
    tuples.emplace(array, progress);
    const DensitySummary found = density.IsOnPoints()
      ? summaryOf(tuples->data(), nullptr, 0, input->GetNumberOfPoints(), progress)
      : summaryOf(
          tuples->data(), ghosts, triangles.FirstCell(), input->GetNumberOfCells(), progress);
    requireValid(found, array);
    this->LargestValue = found.Maximum > 0.0 ? found.Maximum : 1.0;
  }
  const TriangleDensity densityOf(triangles, surface, ghosts, tuples ? tuples->data() : nullptr,
    density.IsOnPoints(), this->LargestValue);
  double* masses = this->Masses.data();
  const double shares = reduceChunks(
    progress, count, Grain, 0.0,
    [&](std::int64_t first, std::int64_t last) {
      double sum = 0.0;
      for (std::int64_t triangle = first; triangle < last; ++triangle)
      {
        masses[triangle] = areas.Shares[triangle] * densityOf(triangle);
        sum += masses[triangle];
      }
      return sum;
    },
    std::plus<>());
  const std::string title =
    array ? titleOf(array) + " has a total mass" : std::string("The input surface has an area");
  if (!(shares > 0.0))
  {
    throw Failure(title + " of zero" +
      (ghosts ? " (duplicate and blanked ghosts carry none)" : "") +
      (array ? "; at least one value must be positive" : ""));
  }
  this->Sum = shares * areas.Total * areas.Unit * this->LargestValue * areas.Unit;
  if (!(this->Sum > 0.0))
  {
    throw Failure(title + " below the least double; " +
      (array ? "its values, or the coordinates, must be larger"
             : "the coordinates must be larger"));
  }
  if (!std::isfinite(this->Sum))
  {
    throw Failure(title + " past the largest double; " +
      (array ? "its values must be smaller" : "the coordinates must be smaller"));
  }
}

RelativeDensity::RelativeDensity(const TriangleInput& input, const PlacedTriangles& surface,
  const SurfaceDensityArray& density, double largest, Progress& progress)
  : OnPoints(density.IsOnPoints())
{
  vtkDataArray* array = density.Array();
  if (!array)
  {
    return;
  }
  const DoubleTuples tuples(array, progress);
  const double* values = tuples.data();
  this->Relative =
    LargeBuffer<double>(this->OnPoints ? array->GetNumberOfTuples() : surface.NumberOfTriangles());
  double* relative = this->Relative.data();
  progress.For(this->Relative.size(), Grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      relative[i] = values[this->OnPoints ? i : input.CellOf(surface.GivenTriangle(i))] / largest;
    }
  });
}

SurfaceDensityValues RelativeDensity::Values() const
{
  const double* values = this->Relative.size() > 0 ? this->Relative.data() : nullptr;
  SurfaceDensityValues found;
  (this->OnPoints ? found.AtPoints : found.OfTriangles) = values;
  return found;
}

} // namespace RectifiedTransport::Bridge
