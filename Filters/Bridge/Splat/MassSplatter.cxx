// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Splat/MassSplatter.h"

#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Points/PointMasses.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/SameOnRanks.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Splat/MassSplat.h"
#include "Bridge/Splat/SplatOnRanks.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"

namespace RectifiedTransport
{

namespace
{

// The work before the splat, of all.
constexpr double endOfPoints = 0.1;
constexpr double endOfMasses = 0.2;
constexpr double endOfBounds = 0.25;

PointMasses readPoints(vtkPointSet* points, vtkDataArray* masses, Progress& progress)
{
  if (points->GetNumberOfPoints() == 0)
  {
    return {};
  }
  progress.BeginStage(endOfPoints);
  visitPoints(points, "input point set", progress, [](std::int64_t, const double*) {});
  progress.BeginStage(endOfMasses);
  return { points, masses, progress };
}

void requireAxis(const ImageGrid& cells, bool hasReference)
{
  if (cells.Dimension() == 0)
  {
    throw Failure(hasReference
        ? "The Reference has one point along every axis; it needs at least one axis of two points "
          "or more"
        : "The input's points are all at one place, about which there is no box; connect an image "
          "as the Reference, or points that differ");
  }
}

void requireMemoryFor(double values, const ImageGrid& cells)
{
  const std::array<int, 3> along = cells.NumberOfValues();
  const GridSize<3> size{ along[0], along[1], along[2] };
  requireMemory("the array Density of " + describeSize<3>(size) + " values (see Dimensions)",
    values * sizeof(double));
}

void requireFinite(double sizes, const SplatTarget& target)
{
  requireFiniteDensity(sizes, target, "The points' masses",
    target.DivideByVolume ? "the cells larger, or switch DivideByVolume off"
                          : "so that the sum of their sizes is a double");
}

} // namespace

ImageGrid MassSplatter::CellsIn(const double (&bounds)[6]) const
{
  const ImageGrid box = gridOfBox(bounds);
  int dimensions[3];
  for (std::size_t a = 0; a < 3; ++a)
  {
    dimensions[a] = box.IsAxis(a) ? this->Dimensions[a] : 1;
  }
  return gridWithValues(box, dimensions, "Dimensions");
}

// Of the image.
ImageGrid MassSplatter::GridOf(const ImageGrid& cells, bool hasReference) const
{
  return this->OnPoints && !hasReference ? cells.AtCellCentres() : cells;
}

ImageGrid MassSplatter::GridAround(const double (&bounds)[6]) const
{
  return this->GridOf(this->CellsIn(bounds), false);
}

// Of the image that all ranks have together.
ImageGrid MassSplatter::GridOfReference(vtkImageData* reference, const Ranks& ranks) const
{
  vtkSmartPointer<vtkImageData> whole = reference;
  if (ranks.AreSeveral())
  {
    whole = ImagePieces(reference, ranks).MakeFrame();
  }
  return whole && whole->GetNumberOfPoints() > 0 ? gridOf(whole, this->OnPoints) : ImageGrid();
}

MassSplatter::Report MassSplatter::Run(vtkPointSet* points, vtkDataArray* masses,
  const Target& target, Progress& progress, vtkImageData* output) const
{
  const Ranks& ranks = progress.Group();
  // Hidden points have no mass, but their places among the others.
  const DistributedPoints counted(points, vtkDataSetAttributes::DUPLICATEPOINT, ranks);
  const PointMasses given = readPoints(counted.Set(), masses, progress);
  ImageGrid cells;
  if (target.HasReference)
  {
    cells = this->GridOfReference(target.Reference, ranks);
  }
  else if (counted.All() > 0)
  {
    double bounds[6];
    progress.BeginStage(endOfBounds);
    findBounds(counted.Set(), progress, bounds);
    cells = this->CellsIn(bounds);
  }
  if (cells.IsEmpty())
  {
    return {};
  }
  requireAxis(cells, target.HasReference);
  if (!target.HasReference)
  {
    requireMemoryFor(numberOfValues(cells) / ranks.Count(), cells);
  }
  const ImageGrid grid = this->GridOf(cells, target.HasReference);
  applyGrid(grid, output);
  Extent wanted = extentToGive(grid.Extent(), target.Output, ranks);
  output->SetExtent(wanted.data());
  requireCells(cells);
  double sizes = 0.0;
  for (const double there : gatherValues(ranks, given.TotalSize()))
  {
    sizes += there;
  }
  const SplatTarget splatTarget{ cells, this->Splat, this->DivideByVolume };
  requireFinite(sizes, splatTarget);

  const int owner = this->OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox box = tuplesOf(wanted, owner, grid.Extent());
  const auto density = newArray<vtkDoubleArray>("Density", 1, static_cast<vtkIdType>(box.Count()));
  progress.BeginStage(1.0);
  const RankSplat splat = splatOnRanks({ counted, given, splatTarget },
    { tuplesOf(grid.Extent(), owner, grid.Extent()), box }, progress, density);
  output->GetAttributes(owner)->SetScalars(density);
  addFieldValue(output, "TotalMass", splat.TotalMass);
  return { grid, counted.All(), splat.Outside };
}

} // namespace RectifiedTransport
