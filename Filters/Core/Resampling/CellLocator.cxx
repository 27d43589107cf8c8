// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellLocator.h"

#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/Progress.h"
#include "Core/Resampling/CellPieces.h"
#include "Core/Resampling/GridSlabs.h"
#include "Core/Resampling/RegionShapes.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr double reach = 1.0; // grid cells around a mesh's cell in which places are still found

// Numbers of places, by the bin of a lattice that each is in. Bins are cubes of at least a grid
// cell, about as many as places.
template <int D>
class PlaceBins
{
public:
  // Sorts the places of these numbers into bins. They are in index space, and there is at least
  // one.
  PlaceBins(const std::vector<Point<D>>& places, const Bins<std::int64_t>::Range& numbers)
    : Places(places)
  {
    Bounds<D> bounds;
    for (const std::int64_t number : numbers)
    {
      bounds.Add(places[static_cast<std::size_t>(number)].data());
    }
    this->Low = bounds.Low;
    double volume = 1.0;
    for (int a = 0; a < D; ++a)
    {
      volume *= std::max(bounds.Length(a), 1.0);
    }
    // width^D = volume / places: about one place a bin.
    this->Width = std::max(1.0, std::pow(volume / static_cast<double>(numbers.Size()), 1.0 / D));
    std::size_t bins = 1;
    for (int a = 0; a < D; ++a)
    {
      this->Size[a] = static_cast<std::int64_t>(bounds.Length(a) / this->Width) + 1;
      bins *= static_cast<std::size_t>(this->Size[a]);
    }
    this->Sorted.Fill(bins, [&](const auto& add) {
      for (const std::int64_t number : numbers)
      {
        // bin = b_0 + size_0 (b_1 + size_1 b_2).
        std::int64_t bin = 0;
        for (int a = D - 1; a >= 0; --a)
        {
          bin = bin * this->Size[a] + this->At(a, places[static_cast<std::size_t>(number)][a]);
        }
        add(static_cast<std::size_t>(bin), number);
      }
    });
  }

  // Calls visit(number, place) for all places within reach of a box, and for others near it.
  template <class Visit>
  void VisitAround(const Bounds<D>& box, const Visit& visit) const
  {
    std::int64_t first[3] = { 0, 0, 0 };
    std::int64_t last[3] = { 0, 0, 0 };
    for (int a = 0; a < D; ++a)
    {
      if (box.High[a] + reach < this->Low[a])
      {
        return;
      }
      first[a] = this->At(a, box.Low[a] - reach);
      last[a] = this->At(a, box.High[a] + reach);
    }
    for (std::int64_t k = first[2]; k <= last[2]; ++k)
    {
      for (std::int64_t j = first[1]; j <= last[1]; ++j)
      {
        // Bins of a row are contiguous, so that a range of them is one loop.
        const std::int64_t row = this->Size[0] * (D > 1 ? j + this->Size[D > 1] * k : 0);
        for (const std::int64_t number : this->Sorted.Of(
               static_cast<std::size_t>(row + first[0]), static_cast<std::size_t>(row + last[0])))
        {
          visit(number, this->Places[static_cast<std::size_t>(number)]);
        }
      }
    }
  }

private:
  // The bin along an axis; places beyond the box are in the bin at its border.
  std::int64_t At(int axis, double x) const
  {
    const double bin = (x - this->Low[axis]) / this->Width;
    return static_cast<std::int64_t>(
      std::clamp(bin, 0.0, static_cast<double>(this->Size[axis] - 1)));
  }

  // Places are those of all slabs, looked up by their numbers; Low and Width are in grid cells.
  const std::vector<Point<D>>& Places;
  Point<D> Low;
  double Width;
  GridSize<D> Size;
  Bins<std::int64_t> Sorted;
};

// Finds where places are in the simplices of the last cell that was divided. Barycentric weights w
// = E^-1 (x - v0) are not negative inside. Outside, negative weights are set to 0 and the rest
// scaled to the sum 1: a point of the simplex near x, whose squared distance competes with others.
template <int D>
void search(const CellPieces<D>& pieces, std::int64_t cell, int set, const PlaceBins<D>& bins,
  MeshLocation* found)
{
  // Simplices look for the places near them, not places for simplices: each cell is divided once
  // for a slab, and needs no memory afterwards.
  using Vector = Eigen::Matrix<double, D, 1>;
  for (std::int64_t s = 0; s < pieces.NumberOfSimplices(); ++s)
  {
    Point<D> vertices[D + 1];
    Eigen::Matrix<double, D, D> edges;
    Bounds<D> bounds;
    for (int i = 0; i <= D; ++i)
    {
      vertices[i] = pieces.Vertex(s, i);
      bounds.Add(vertices[i].data());
      for (int a = 0; a < D && i > 0; ++a)
      {
        edges(a, i - 1) = vertices[i][a] - vertices[0][a];
      }
    }
    // E has the edges v_i - v_0 as columns.
    const Eigen::Matrix<double, D, D> inverse = edges.inverse();
    if (!inverse.allFinite())
    {
      continue; // without a measure
    }
    bins.VisitAround(bounds, [&](std::int64_t number, const Point<D>& place) {
      // Distance 0: a cell before contains the place, and the first one counts.
      MeshLocation& best = found[number];
      // Cells come in their order, hence the first one that contains the place stays.
      if (best.Distance == 0.0)
      {
        return;
      }
      // Solves E w = x - v_0 for the weights of vertices 1 to D.
      const Vector x(place.data());
      const Vector part = inverse * (x - Vector(vertices[0].data()));
      double weights[D + 1];
      // w_0 = 1 - sum of the others.
      weights[0] = 1.0 - part.sum();
      double smallest = weights[0];
      for (int i = 0; i < D; ++i)
      {
        weights[i + 1] = part[i];
        smallest = std::min(smallest, part[i]);
      }
      double distance = 0.0;
      if (smallest < 0.0)
      {
        double sum = 0.0;
        for (double& weight : weights)
        {
          // Not the nearest point of the simplex in general, but one near x, and exact on a face.
          weight = std::max(weight, 0.0);
          sum += weight;
        }
        Vector nearest = Vector::Zero();
        for (int i = 0; i <= D; ++i)
        {
          weights[i] /= sum;
          nearest += weights[i] * Vector(vertices[i].data());
        }
        // Rounding must not make it 0, which ends the search.
        distance = std::max((x - nearest).squaredNorm(), std::numeric_limits<double>::min());
      }
      if (distance < best.Distance)
      {
        best.Distance = distance;
        best.Cell = cell;
        best.Set = set;
        for (int i = 0; i <= D; ++i)
        {
          best.Points[i] = pieces.VertexId(s, i);
          best.Weights[i] = weights[i];
        }
        // The records have four points for any dimension.
        std::fill(best.Points + D + 1, best.Points + 4, best.Points[0]);
        std::fill(best.Weights + D + 1, best.Weights + 4, 0.0);
      }
    });
  }
}

// A region replaces what sets after it have found, as places belong to the first set.
void searchRegion(const RegionRows& region, int set, const PlaceBins<2>& bins, MeshLocation* found)
{
  bins.VisitAround(region.Extent(), [&](std::int64_t number, const Point<2>& x) {
    MeshLocation& best = found[number];
    // A place that an earlier set contains stays there.
    const bool isFound = best.Distance == 0.0;
    if (isFound && best.Set <= set)
    {
      return;
    }
    const MeshLocation place = region.Find(x);
    if (place.Distance < best.Distance || (isFound && place.Distance == 0.0))
    {
      best = place;
    }
  });
}

// Edges of one region follow each other in a slab.
void searchRegions(const RegionBatch& batch, std::int64_t slab, const GridSlabs<2>& slabs,
  const PlaceBins<2>& bins, Progress& progress, MeshLocation* found)
{
  const RegionRows::Edges edges = batch.Slabs[static_cast<std::size_t>(slab)];
  for (const RegionBatch::Edge* first = edges.First; first != edges.Last;)
  {
    // The edges [first, last) are those of one region in the slab.
    const RegionBatch::Edge* last = std::find_if(first, edges.Last,
      [&](const RegionBatch::Edge& edge) { return !batch.IsSame(*first, edge); });
    if (progress.ShouldStop())
    {
      return;
    }
    const RegionRows region(batch, { first, last }, slab * slabs.Planes, (slab + 1) * slabs.Planes);
    searchRegion(region, batch.ShapeOf(*first).Set, bins, found);
    first = last;
  }
}

// Searches the cells of all sets that reach a slab, in the order of sets and cells, for its places.
// Sets have cells of different kinds: each has a reader of its own.
template <int D>
void searchCells(const std::vector<CellValues>& sets, const ImageGrid& grid,
  const std::vector<Bins<std::int64_t>>& cells, std::int64_t slab, const PlaceBins<D>& bins,
  Progress& progress, MeshLocation* found)
{
  // An abort waits for so many cells at most; a poll for each cell would take time of its own.
  constexpr std::int64_t cellsBetweenPolls = 64;
  std::int64_t searched = 0;
  for (std::size_t s = 0; s < sets.size(); ++s)
  {
    CellPieces<D> pieces(sets[s], grid);
    for (const std::int64_t cell : cells[s][static_cast<std::size_t>(slab)])
    {
      if (searched++ % cellsBetweenPolls == 0 && progress.ShouldStop())
      {
        return;
      }
      if (pieces.Divide(cell))
      {
        search(pieces, cell, static_cast<int>(s), bins, found);
      }
    }
  }
}

// Each slab has its own places: threads write to different records.
template <int D>
void find(const std::vector<CellValues>& sets, const ImageGrid& grid, ConstPointSpan<3> places,
  Progress& progress, MeshLocation* found)
{
  // Slabs are the tasks of threads. A place belongs to one slab, and cells are listed in every slab
  // from which they are within reach: a place near the face of a slab sees the cells on both sides.
  const GridSlabs<D> slabs(grid.Size<D>());
  // In index space, where a grid cell has the width 1.
  std::vector<Point<D>> index(static_cast<std::size_t>(places.size()));
  for (std::int64_t i = 0; i < places.size(); ++i)
  {
    grid.ToIndex<D>(places[i], index[static_cast<std::size_t>(i)].data());
    found[i] = {};
    found[i].Distance = std::numeric_limits<double>::infinity();
    found[i].Cell = -1; // until there is one within reach
  }
  Bins<std::int64_t> numbers; // the places of each slab
  numbers.Fill(static_cast<std::size_t>(slabs.Count), [&](const auto& add) {
    for (std::int64_t i = 0; i < places.size(); ++i)
    {
      add(static_cast<std::size_t>(slabs.At(index[static_cast<std::size_t>(i)][D - 1])), i);
    }
  });
  // Bins are made where they are used: memory is that of the slabs at work.
  const auto withBins = [&](std::int64_t slab, const auto& use) {
    const auto own = numbers[static_cast<std::size_t>(slab)];
    if (own.Size() > 0)
    {
      use(PlaceBins<D>(index, own));
    }
  };
  // Regions come after the cells: they are read in batches, each for all slabs, so that one polygon
  // with many edges is read once.
  const auto cells = slabs.CellsOf(sets, grid, reach, progress);
  slabs.ForEach(progress, [&](std::int64_t slab) {
    withBins(slab, [&](const PlaceBins<D>& bins) {
      searchCells<D>(sets, grid, cells, slab, bins, progress, found);
    });
  });
  if constexpr (D == 2)
  {
    visitRegions(sets, grid, slabs, reach, progress, [&](const RegionBatch& batch) {
      slabs.ForEach(progress, [&](std::int64_t slab) {
        if (batch.Slabs[static_cast<std::size_t>(slab)].Size() > 0)
        {
          withBins(slab, [&](const PlaceBins<2>& bins) {
            searchRegions(batch, slab, slabs, bins, progress, found);
          });
        }
      });
    });
  }
}

} // namespace

LargeBuffer<MeshLocation> locateInCells(const std::vector<CellValues>& sets, const ImageGrid& grid,
  ConstPointSpan<3> places, Progress& progress)
{
  // One record a place; Cell is -1 for places that no cell reaches.
  LargeBuffer<MeshLocation> found(places.size());
  dispatchDimension(grid.Dimension(), find<1>, find<2>, find<3>)(
    sets, grid, places, progress, found.data());
  return found;
}

} // namespace RectifiedTransport
