// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/MassSplatter.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Data/PointMasses.h"
#include "Bridge/Ranks/CommonArrays.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Ranks/DistributedSplat.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/Distributed/BoxExchange.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankOrder.h"
#include "Core/Parallel/Stages.h"
#include "Core/Splat/SplatMass.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Checks coordinates and masses of all points of this rank, hidden ones among them, which have no
// mass. A rank without points has no masses, and takes part in what follows.
PointMasses readPoints(vtkPointSet* points, vtkDataArray* masses, Progress& progress)
{
  if (points->GetNumberOfPoints() == 0)
  {
    return {};
  }
  Stages stages(progress, { { "points", 1 }, { "masses", 1 } });
  visitPoints(points, "input point set", stages["points"], [](std::int64_t, const double*) {});
  return { points, masses, stages["masses"] };
}

// A grid without axes has no cells to splat onto.
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

// The cells along the longest side of a box that make about as many cells as points: in a finer
// image most cells would be empty.
int resolutionFor(std::int64_t points, const ImageGrid& box)
{
  constexpr double most = 128.0;
  double longest = 0.0;
  double measure = 1.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double length = box.IsAxis(i) ? box.Spacing()[static_cast<Eigen::Index>(i)] : 1.0;
    longest = box.IsAxis(i) ? std::max(longest, length) : longest;
    measure *= length;
  }
  const double side = std::pow(measure / static_cast<double>(points), 1.0 / box.Dimension());
  return static_cast<int>(std::clamp(std::round(longest / side), 1.0, most));
}

// Asked for before VTK allocates the image: Dimensions may be far too large. `values` is the number
// that one rank holds.
void requireMemoryFor(double values, const ImageGrid& cells)
{
  const std::array<int, 3> along = cells.NumberOfValues();
  const GridSize<3> size{ along[0], along[1], along[2] };
  requireMemory({ "the array Density of " + describeSize<3>(size) + " values (see Dimensions)",
    values * sizeof(double) });
}

// The points that count, and the masses of all points of the set.
struct SplatInput
{
  const DistributedPoints& Points;
  const PointMasses& Masses;
  const SplatTarget& Target;
};

struct SplatResult
{
  std::int64_t Outside; // points of all ranks outside the grid
  double TotalMass;     // the mass that the whole image holds
};

// The sum of the counted masses, in the order of their keys and in chunks, with the bits of one
// rank. Without masses on any rank it is the number of points, which a double holds exactly up to
// 2^53. A rank without points has no array, but its 0 points have the mass 1 each.
double inOrder(
  const DistributedPoints& points, const double* masses, const Ranks& ranks, Progress& progress)
{
  if (onAllRanks(ranks, masses == nullptr))
  {
    return static_cast<double>(points.All());
  }
  const std::int64_t count = points.Counted().Count();
  // Each rank gets whole chunks of the order, so that sums of chunks do not depend on the ranks.
  const RankOrder order(count, points.Keys(), PointMasses::Chunk, ranks, progress);
  const std::vector<double> share =
    order.Redistribute([=](std::int64_t i) { return masses ? masses[i] : 1.0; });
  const double total = sumChunks(share.data(), order.Count(), PointMasses::Chunk, ranks);
  // Each mass is finite, but their sum may overflow.
  if (!std::isfinite(total))
  {
    std::ostringstream message;
    message << "The points' masses sum to " << total << "; the sum must be a double";
    throw Failure(message.str());
  }
  return total;
}

// On one rank: density in each cell, and the mass that the image holds.
SplatResult splatHere(const SplatInput& input, Progress& progress, vtkDoubleArray* cells)
{
  Stages stages(progress, { { "splat", 95 }, { "sum", 5 } });
  const std::int64_t outside = splatDistributed(input.Points.Set()->GetPoints()->GetData(),
    input.Masses.Values(), 1.0, nullptr, input.Target, {}, stages["splat"], cells);
  // The weights of each point sum to 1 inside: the image holds the masses' sum, which is known
  // exactly.
  if (input.Target.Options.Boundary == SplatBoundary::Renormalize)
  {
    return { outside, input.Masses.Total() };
  }
  // With Drop, mass that falls outside is lost, so that the cells are summed; times a cell's
  // measure where they have densities.
  const double sum = sumOfCells(cells->GetPointer(0), cells->GetNumberOfTuples(), stages["sum"]);
  return { outside, sum * input.Target.CellMeasure() };
}

// Writes the wanted cells: the splat of distributed points and its mass, bitwise as on one rank.
SplatResult splatOnRanks(const SplatInput& input, const TupleBox& whole, const TupleBox& wanted,
  Progress& progress, vtkDoubleArray* cells)
{
  const Ranks& ranks = progress.Group();
  if (!ranks.AreSeveral())
  {
    return splatHere(input, progress, cells);
  }
  // Only counted points are sent, so that arrays are reduced to these. Points that a lower rank
  // has, too, would otherwise have their mass twice.
  vtkDoubleArray* given = input.Masses.Array();
  const vtkSmartPointer<vtkDataArray> counted = given ? input.Points.TuplesOf(given) : nullptr;
  const double* masses = given ? vtkDoubleArray::SafeDownCast(counted)->GetPointer(0) : nullptr;
  const auto places = input.Points.TuplesOf(input.Points.Set()->GetPoints()->GetData());
  // Each rank gets the points that reach its box, sorted by keys; terms are added in that order.
  const auto splat = [&](const TupleBox& box, vtkDoubleArray* to) {
    return splatDistributed(
      places, masses, 1.0, input.Points.Keys(), input.Target, box, progress, to);
  };
  if (input.Target.Options.Boundary == SplatBoundary::Renormalize)
  {
    const double total = inOrder(input.Points, masses, ranks, progress);
    return { splat(wanted, cells), total };
  }
  // What is dropped is known from the cells only: all of them, wanted or not.
  // Every rank splats a share of whole layers, sums it, and then sends the cells that others want.
  std::vector<TupleBox> held;
  for (int rank = 0; rank < ranks.Count(); ++rank)
  {
    held.push_back(CellShare(whole, ranks.Count(), rank).Layers);
  }
  const CellShare own(whole, ranks.Count(), ranks.Own());
  const auto values =
    newArray<vtkDoubleArray>("Density", 1, static_cast<vtkIdType>(own.Layers.Count()));
  const std::int64_t outside = splat(own.Layers, values);
  const double sum = sumChunks(values->GetPointer(0) + own.First, own.Count, splatSumChunk, ranks);
  exchangeBoxes(held, wanted, ranks, tuplesIn(values), tuplesIn(cells));
  return { outside, sum * input.Target.CellMeasure() };
}

} // namespace

ImageGrid MassSplatter::CellsIn(const double (&bounds)[6], std::int64_t points) const
{
  // An axis along which all points have one coordinate has no length, and one cell.
  const ImageGrid box = gridOfBox(bounds);
  if (box.Dimension() > 0 && this->Dimensions == std::array<int, 3>{})
  {
    return gridWithResolution(box, resolutionFor(points, box), "Dimensions");
  }
  int dimensions[3];
  for (std::size_t a = 0; a < 3; ++a)
  {
    dimensions[a] = box.IsAxis(a) ? this->Dimensions[a] : 1;
  }
  return gridWithValues(box, dimensions, "Dimensions");
}

// The grid of the image: its points are the centres of the cells if the density is on points.
ImageGrid MassSplatter::GridOf(const ImageGrid& cells, bool hasReference) const
{
  // A reference already has the association: OnPoints tells which of its values are written.
  return this->OnPoints && !hasReference ? cells.AtCellCentres() : cells;
}

ImageGrid MassSplatter::GridAround(const double (&bounds)[6], std::int64_t points) const
{
  return this->GridOf(this->CellsIn(bounds, points), false);
}

// The grid of the image that all ranks have together.
ImageGrid MassSplatter::GridOfReference(vtkImageData* reference, const Ranks& ranks) const
{
  // On several ranks the frame of the whole: its arrays do not matter here.
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
  Stages stages(progress,
    { { "reading", 20 }, { "bounds", target.HasReference ? 0.0 : 5.0 }, { "splat", 75 } });
  // Reading precedes everything that depends on the points: a value that is not finite has no
  // place.
  const PointMasses given = readPoints(counted.Set(), masses, stages["reading"]);
  ImageGrid cells;
  if (target.HasReference)
  {
    cells = this->GridOfReference(target.Reference, ranks);
  }
  else if (counted.All() > 0)
  {
    double bounds[6];
    findBounds(counted.Set(), stages["bounds"], bounds);
    cells = this->CellsIn(bounds, counted.All());
  }
  // No points anywhere, or an empty reference: all ranks return an empty output.
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
  // The image has the geometry of the whole; each rank then has its own extent of it.
  applyGrid(grid, output);
  Extent wanted = extentToGive(grid.Extent(), target.Output, ranks);
  output->SetExtent(wanted.data());
  requireCells(cells);
  // If one cell got the absolute masses of all ranks, its density would still be finite: the check
  // comes before any sum can overflow.
  const std::vector<double> sizes = gatherValues(ranks, given.TotalSize());
  const SplatTarget splatTarget{ cells, this->Splat, this->DivideByVolume };
  requireFiniteDensity(std::accumulate(sizes.begin(), sizes.end(), 0.0), splatTarget,
    "The points' masses",
    this->DivideByVolume ? "the cells larger, or switch DivideByVolume off"
                         : "so that the sum of their sizes is a double");

  // Values on points are those of the dual cells around them.
  const int owner = this->OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox box = tuplesOf(wanted, owner, grid.Extent());
  const auto density = newArray<vtkDoubleArray>("Density", 1, static_cast<vtkIdType>(box.Count()));
  const SplatResult splat = splatOnRanks({ counted, given, splatTarget },
    tuplesOf(grid.Extent(), owner, grid.Extent()), box, stages["splat"], density);
  output->GetAttributes(owner)->SetScalars(density);
  addFieldValue(output, "TotalMass", splat.TotalMass);
  addFieldValue(output, "OutsidePoints", static_cast<double>(splat.Outside));
  return { grid, counted.All(), splat.Outside };
}

} // namespace RectifiedTransport::Bridge
