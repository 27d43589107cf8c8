// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/SurfaceDensityArray.h"

#include "Bridge/Data/DoubleTuples.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/TextToNumbers.h"
#include "Bridge/Triangles/TriangleInput.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cstdint>
#include <optional>

namespace RectifiedTransport::Bridge
{

namespace
{

std::string titleOf(vtkDataArray* array)
{
  const char* name = array->GetName();
  return std::string("The density array '") + (name ? name : "") + "'";
}

} // namespace

SurfaceDensityArray::SurfaceDensityArray(
  vtkPolyData* surface, vtkAbstractArray* found, bool onPoints, const std::string& name)
  : OnPoints(onPoints)
{
  const TextToNumbers numbers = parseNumbers(found);
  this->Values = numbers.Array;
  if (!this->Values)
  {
    fail(found ? "The density array '" + name + "' is not numeric (" + numbers.Wrong + ")"
               : "The input surface has no density array '" + name + "'",
      "; it has ", listArrays(surface->GetPointData(), "point"), " and ",
      listArrays(surface->GetCellData(), "cell"));
  }
  requireScalars(this->Values, titleOf(this->Values),
    onPoints ? surface->GetNumberOfPoints() : surface->GetNumberOfCells(),
    onPoints ? "points" : "cells");
}

SurfaceMasses SurfaceDensityArray::MassesOf(
  const TriangleInput& input, const TriangleDomain& surface, Progress& progress) const
{
  vtkPolyData* data = input.Input();
  const unsigned char* ghosts = ghostFlags(data, vtkDataObject::CELL, "input surface");
  ReadDensity density;
  density.OnPoints = this->OnPoints;
  density.First = this->OnPoints ? 0 : input.FirstCell();
  density.Last = this->OnPoints ? data->GetNumberOfPoints() : data->GetNumberOfCells();
  density.CellOf = [&](std::int64_t triangle) {
    return input.CellOf(surface.GivenTriangle(triangle));
  };
  if (ghosts)
  {
    density.IsGhost = [ghosts](std::int64_t cell) { return (ghosts[cell] & ghostCell) != 0; };
  }
  const std::int64_t count = surface.NumberOfTriangles();
  return withMemory({ "the masses of " + std::to_string(count) + " triangles",
                      static_cast<double>(count) * sizeof(double) },
    [&]() {
      std::optional<DoubleTuples> values;
      if (this->Values)
      {
        density.Name = titleOf(this->Values);
        density.Values = values.emplace(this->Values, progress).data();
      }
      return SurfaceMasses(surface, density, progress);
    });
}

} // namespace RectifiedTransport::Bridge
