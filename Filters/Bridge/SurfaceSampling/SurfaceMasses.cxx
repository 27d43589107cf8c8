// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SurfaceSampling/SurfaceMasses.h"

#include "Bridge/Points/DoubleTuples.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/NumbersOfText.h"
#include "Bridge/Surface/PlacedTriangles.h"
#include "Core/Parallel/Reduction.h"

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
#include <sstream>

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

// What is wrong with values, in the order of their indices.
struct DensityRange
{
  double Largest = 0.0;
  std::int64_t NotFinite = 0;
  std::int64_t Negative = 0;
  std::int64_t First = -1; // that is not finite, else that is negative
};

DensityRange joinRanges(DensityRange all, const DensityRange& next)
{
  const bool isFirst = all.NotFinite > 0 ? false : next.NotFinite > 0 ? true : all.Negative == 0;
  all.First = isFirst ? next.First : all.First;
  all.Largest = std::max(all.Largest, next.Largest);
  all.NotFinite += next.NotFinite;
  all.Negative += next.Negative;
  return all;
}

// Of the values of points or cells from `begin` on that are no ghosts.
DensityRange rangeOf(const double* values, const unsigned char* ghosts, std::int64_t begin,
  std::int64_t end, Progress& progress)
{
  return reduceChunks(
    progress, end - begin, Grain, DensityRange{},
    [=](std::int64_t first, std::int64_t last) {
      DensityRange range;
      for (std::int64_t i = begin + first; i < begin + last; ++i)
      {
        const double value = values[i];
        DensityRange one;
        one.NotFinite = std::isfinite(value) ? 0 : 1;
        one.Negative = value < 0.0 ? 1 : 0;
        one.First = one.NotFinite + one.Negative > 0 ? i : -1;
        one.Largest = value > 0.0 ? value : 0.0;
        range = ghosts && (ghosts[i] & ghostCell) ? range : joinRanges(range, one);
      }
      return range;
    },
    joinRanges);
}

void requireDensity(const DensityRange& range, vtkDataArray* array)
{
  if (range.NotFinite + range.Negative == 0)
  {
    return;
  }
  std::ostringstream message;
  message << titleOf(array) << " has ";
  if (range.NotFinite > 0)
  {
    message << range.NotFinite << (range.NotFinite == 1 ? " value that is" : " values that are")
            << " NaN or infinite";
  }
  else
  {
    message << range.Negative << (range.Negative == 1 ? " negative value" : " negative values");
  }
  message << ", the first at index " << range.First << " ("
          << array->GetComponent(static_cast<vtkIdType>(range.First), 0) << "); "
          << (range.NotFinite > 0 ? "every value must be finite"
                                  : "a density must not be negative");
  throw Failure(message.str());
}

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

SurfaceMasses::SurfaceMasses(vtkPolyData* input, const PlacedTriangles& surface,
  const SurfaceDensityArray& density, Progress& progress)
{
  const SurfaceAreas areas = surface.Areas();
  const std::int64_t triangles = surface.NumberOfTriangles();
  const unsigned char* ghosts = ghostFlags(input, vtkDataObject::CELL, "input surface");
  withMemory("the masses of " + std::to_string(triangles) + " triangles",
    static_cast<double>(triangles) * sizeof(double),
    [&]() { this->Masses = LargeBuffer<double>(triangles); });
  vtkDataArray* array = density.Array();
  std::optional<DoubleTuples> tuples;
  double largest = 1.0;
  if (array)
  {
    tuples.emplace(array, progress);
    const DensityRange range = density.IsOnPoints()
      ? rangeOf(tuples->data(), nullptr, 0, input->GetNumberOfPoints(), progress)
      : rangeOf(tuples->data(), ghosts, input->GetNumberOfVerts() + input->GetNumberOfLines(),
          input->GetNumberOfCells(), progress);
    requireDensity(range, array);
    largest = range.Largest > 0.0 ? range.Largest : 1.0;
  }
  const double* values = tuples ? tuples->data() : nullptr;
  // Relative to the largest density, so that no mass is past the largest double.
  const auto densityOf = [&](std::int64_t triangle) {
    const vtkIdType cell = surface.InputCellOf(triangle);
    if (ghosts && (ghosts[cell] & ghostCell))
    {
      return 0.0;
    }
    if (!values || !density.IsOnPoints())
    {
      return values ? values[cell] / largest : 1.0;
    }
    if (surface.IsPart(triangle))
    {
      constexpr double third = 1.0 / 3.0;
      const PointWeights centre = surface.InCell({ triangle, { third, third, third } });
      double mean = 0.0;
      for (std::size_t i = 0; i < 3; ++i)
      {
        mean += centre.Weights[i] * (values[centre.Points[i]] / largest);
      }
      return mean;
    }
    const std::array<std::int64_t, 3> corners = surface.CornersOf(triangle);
    return (values[corners[0]] / largest + values[corners[1]] / largest +
             values[corners[2]] / largest) /
      3.0;
  };
  double* masses = this->Masses.data();
  const double shares = reduceChunks(
    progress, triangles, Grain, 0.0,
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
  this->LargestValue = largest;
  this->Sum = shares * areas.Total * areas.Unit * largest * areas.Unit;
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

RelativeDensity::RelativeDensity(const PlacedTriangles& surface, const SurfaceDensityArray& density,
  double largest, Progress& progress)
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
      relative[i] = values[this->OnPoints ? i : surface.InputCellOf(i)] / largest;
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
