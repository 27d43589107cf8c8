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

#include <cmath>
#include <cstdint>
#include <functional>

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

// Sums up the values of points or cells from `begin` on, but not those of ghosts.
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
  : OnPoints(density.IsOnPoints())
{
  const unsigned char* ghosts = ghostFlags(triangles.Input(), vtkDataObject::CELL, "input surface");
  const auto cellOf = [&](std::int64_t triangle) {
    return triangles.CellOf(surface.GivenTriangle(triangle));
  };
  const auto isGhost = [&](std::int64_t triangle) {
    return (ghosts[cellOf(triangle)] & ghostCell) != 0;
  };
  const std::int64_t count = surface.NumberOfTriangles();
  vtkDataArray* array = density.Array();
  withMemory({ "the masses of " + std::to_string(count) + " triangles",
               static_cast<double>(count) * sizeof(double) },
    [&]() {
      if (array)
      {
        const DoubleTuples values(array, progress);
        this->ReadLargest(triangles, values.data(), ghosts, array, progress);
        this->Relative = LargeBuffer<double>(this->OnPoints ? array->GetNumberOfTuples() : count);
        progress.For(this->Relative.size(), Grain, [&](std::int64_t first, std::int64_t last) {
          for (std::int64_t i = first; i < last; ++i)
          {
            this->Relative.data()[i] =
              values.data()[this->OnPoints ? i : cellOf(i)] / this->Largest;
          }
        });
      }
      this->Masses = massesOf(
        surface, this->Density(), ghosts ? isGhost : WholeTriangles::IsLeftOut(), progress);
    });
  const std::string title =
    array ? titleOf(array) + " has a total mass" : std::string("The input surface has an area");
  if (!(this->Masses.Sum > 0.0))
  {
    throw Failure(title + " of zero" +
      (ghosts ? " (duplicate and blanked ghosts carry none)" : "") +
      (array ? "; at least one value must be positive" : ""));
  }
  const SurfaceAreas areas = surface.Areas();
  this->Sum = this->Masses.Sum * areas.Total * areas.Unit * this->Largest * areas.Unit;
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

void SurfaceMasses::ReadLargest(const TriangleInput& triangles, const double* values,
  const unsigned char* ghosts, vtkDataArray* array, Progress& progress)
{
  vtkPolyData* input = triangles.Input();
  const DensitySummary found = this->OnPoints
    ? summaryOf(values, nullptr, 0, input->GetNumberOfPoints(), progress)
    : summaryOf(values, ghosts, triangles.FirstCell(), input->GetNumberOfCells(), progress);
  requireValid(found, array);
  this->Largest = found.Maximum > 0.0 ? found.Maximum : 1.0;
}

SurfaceDensityValues SurfaceMasses::Density() const
{
  const double* values = this->Relative.size() > 0 ? this->Relative.data() : nullptr;
  SurfaceDensityValues found;
  (this->OnPoints ? found.AtPoints : found.OfTriangles) = values;
  return found;
}

} // namespace RectifiedTransport::Bridge
