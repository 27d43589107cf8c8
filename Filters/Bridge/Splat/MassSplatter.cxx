// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Splat/MassSplatter.h"

#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Points/PointMasses.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Splat/MassSplat.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"

namespace RectifiedTransport
{

ImageGrid MassSplatter::CellsAround(vtkPointSet* points) const
{
  double bounds[6];
  findBounds(points, bounds);
  const ImageGrid box = gridOfBox(bounds);
  int dimensions[3];
  for (std::size_t a = 0; a < 3; ++a)
  {
    dimensions[a] = box.IsAxis(a) ? this->Dimensions[a] : 1;
  }
  return gridWithValues(box, dimensions, "Dimensions");
}

ImageGrid MassSplatter::GridAround(vtkPointSet* points) const
{
  const ImageGrid cells = this->CellsAround(points);
  return this->OnPoints ? cells.AtCellCentres() : cells;
}

std::int64_t MassSplatter::Run(vtkPointSet* points, vtkDataArray* masses, vtkImageData* reference,
  Progress& progress, vtkImageData* output) const
{
  const vtkIdType count = points->GetNumberOfPoints();
  PointMasses given;
  if (count > 0)
  {
    progress.BeginStage(0.1);
    visitPoints(points, "input point set", progress, [](std::int64_t, const double*) {});
    progress.BeginStage(0.2);
    given = PointMasses(points, masses, progress);
  }
  const ImageGrid cells = reference ? gridOf(reference, this->OnPoints) : this->CellsAround(points);
  if (cells.Dimension() == 0)
  {
    throw Failure(reference
        ? "The Reference has one point along every axis; it needs at least one axis of two points "
          "or more"
        : "The input's points are all at one place, about which there is no box; connect an image "
          "as the Reference, or points that differ");
  }
  if (!reference)
  {
    const std::array<int, 3> along = cells.NumberOfValues();
    const GridSize<3> size{ along[0], along[1], along[2] };
    requireMemory("the array Density of " + describeSize<3>(size) + " values (see Dimensions)",
      numberOfCells<3>(size) * sizeof(double));
  }
  applyGrid(this->OnPoints && !reference ? cells.AtCellCentres() : cells, output);
  requireCells(cells);
  const SplatTarget target{ cells, this->Splat, this->DivideByVolume };
  requireFiniteDensity(given.TotalSize(), target, "The points' masses",
    this->DivideByVolume ? "the cells larger, or switch DivideByVolume off"
                         : "so that the sum of their sizes is a double");

  const auto density = newArray<vtkDoubleArray>("Density", 1, cells.NumberOfCells());
  progress.BeginStage(0.95);
  const std::int64_t outside = count > 0
    ? splatPoints(points->GetPoints()->GetData(), given.Values(), 1.0, target, progress, density)
    : splatPoints(ConstPointSpan<3>(), 1.0, target, progress, density);
  progress.BeginStage(1.0);
  const double total = this->Splat.Boundary == SplatBoundary::Renormalize
    ? given.Total()
    : splatMassIn(density, target, progress);
  output->GetAttributes(this->OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL)
    ->SetScalars(density);
  addFieldValue(output, "TotalMass", total);
  return outside;
}

} // namespace RectifiedTransport
