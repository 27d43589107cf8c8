// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/PlacesInMeshes.h"

#include "Bridge/Meshes/CellPieces.h"
#include "Bridge/Meshes/MeshSlabs.h"
#include "Bridge/Meshes/PlacesInRegions.h"
#include "Bridge/Meshes/RegionShapes.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataSet.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr double reach = 1.0; // grid cells around a mesh's cell

// Numbers of places, by the bin of a lattice that each is in.
template <int D>
class PlaceBins
{
public:
  PlaceBins(const std::vector<Point<D>>& places, const Bins<std::int64_t>::Range& numbers)
    : Places(places)
  {
    this->Low.fill(std::numeric_limits<double>::infinity());
    Point<D> high;
    high.fill(-std::numeric_limits<double>::infinity());
    for (const std::int64_t number : numbers)
    {
      const Point<D>& x = places[static_cast<std::size_t>(number)];
      for (int a = 0; a < D; ++a)
      {
        this->Low[a] = std::min(this->Low[a], x[a]);
        high[a] = std::max(high[a], x[a]);
      }
    }
    double volume = 1.0;
    for (int a = 0; a < D; ++a)
    {
      volume *= std::max(high[a] - this->Low[a], 1.0);
    }
    this->Width = std::max(1.0, std::pow(volume / static_cast<double>(numbers.Size()), 1.0 / D));
    std::size_t bins = 1;
    for (int a = 0; a < D; ++a)
    {
      this->Size[a] = static_cast<std::int64_t>((high[a] - this->Low[a]) / this->Width) + 1;
      bins *= static_cast<std::size_t>(this->Size[a]);
    }
    this->Sorted.Fill(bins, [&](const auto& add) {
      for (const std::int64_t number : numbers)
      {
        std::int64_t bin = 0;
        for (int a = D - 1; a >= 0; --a)
        {
          bin = bin * this->Size[a] + this->At(a, places[static_cast<std::size_t>(number)][a]);
        }
        add(static_cast<std::size_t>(bin), number);
      }
    });
  }

  // Calls visit(number, place) for all places of the box, and for others near it.
  template <class Visit>
  void VisitBox(const Point<D>& low, const Point<D>& high, const Visit& visit) const
  {
    std::int64_t first[3] = { 0, 0, 0 };
    std::int64_t last[3] = { 0, 0, 0 };
    for (int a = 0; a < D; ++a)
    {
      if (high[a] < this->Low[a])
      {
        return;
      }
      first[a] = this->At(a, low[a]);
      last[a] = this->At(a, high[a]);
    }
    for (std::int64_t k = first[2]; k <= last[2]; ++k)
    {
      for (std::int64_t j = first[1]; j <= last[1]; ++j)
      {
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
  std::int64_t At(int axis, double x) const
  {
    const double bin = (x - this->Low[axis]) / this->Width;
    return static_cast<std::int64_t>(
      std::clamp(bin, 0.0, static_cast<double>(this->Size[axis] - 1)));
  }

  const std::vector<Point<D>>& Places;
  Point<D> Low;
  double Width;
  GridSize<D> Size;
  Bins<std::int64_t> Sorted;
};

// Where places are in the simplices of the last cell that was divided.
template <int D>
void search(
  const CellPieces<D>& pieces, vtkIdType cell, int set, const PlaceBins<D>& bins, MeshPlace* found)
{
  using Vector = Eigen::Matrix<double, D, 1>;
  for (vtkIdType s = 0; s < pieces.NumberOfSimplices(); ++s)
  {
    Point<D> vertices[D + 1];
    Eigen::Matrix<double, D, D> edges;
    Point<D> low;
    Point<D> high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (int i = 0; i <= D; ++i)
    {
      vertices[i] = pieces.Vertex(s, i);
      for (int a = 0; a < D; ++a)
      {
        low[a] = std::min(low[a], vertices[i][a] - reach);
        high[a] = std::max(high[a], vertices[i][a] + reach);
        if (i > 0)
        {
          edges(a, i - 1) = vertices[i][a] - vertices[0][a];
        }
      }
    }
    const Eigen::Matrix<double, D, D> inverse = edges.inverse();
    if (!inverse.allFinite())
    {
      continue; // without a measure
    }
    bins.VisitBox(low, high, [&](std::int64_t number, const Point<D>& place) {
      MeshPlace& best = found[number];
      if (best.Distance == 0.0)
      {
        return;
      }
      const Vector x(place.data());
      const Vector part = inverse * (x - Vector(vertices[0].data()));
      double weights[D + 1];
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
        std::fill(best.Points + D + 1, best.Points + 4, best.Points[0]);
        std::fill(best.Weights + D + 1, best.Weights + 4, 0.0);
      }
    });
  }
}

void searchRegion(const RegionRows& region, int set, const PlaceBins<2>& bins, MeshPlace* found)
{
  const Point<2> low{ region.Low()[0] - reach, region.Low()[1] - reach };
  const Point<2> high{ region.High()[0] + reach, region.High()[1] + reach };
  bins.VisitBox(low, high, [&](std::int64_t number, const Point<2>& x) {
    MeshPlace& best = found[number];
    const bool isFound = best.Distance == 0.0;
    if (isFound && best.Set <= set)
    {
      return;
    }
    const MeshPlace place = region.Find(x);
    if (place.Distance < best.Distance || (isFound && place.Distance == 0.0))
    {
      best = place;
    }
  });
}

void searchRegions(const RegionBatch& batch, const MeshSlabs<2>& slabs,
  const Bins<std::int64_t>& numbers, const std::vector<Point<2>>& index, Progress& progress,
  MeshPlace* found)
{
  progress.For(
    slabs.Count, 1,
    [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t s = begin; s < end; ++s)
      {
        const auto slab = static_cast<std::size_t>(s);
        const RegionRows::Edges edges = batch.Slabs[slab];
        if (numbers[slab].Size() == 0 || edges.Size() == 0)
        {
          continue;
        }
        const PlaceBins<2> bins(index, numbers[slab]);
        for (const RegionBatch::Edge* first = edges.First; first != edges.Last;)
        {
          const RegionBatch::Edge* last = std::find_if(first, edges.Last,
            [&](const RegionBatch::Edge& edge) { return !batch.IsSame(*first, edge); });
          if (progress.ShouldStop())
          {
            return;
          }
          const RegionRows region(batch, { first, last }, s * slabs.Planes, (s + 1) * slabs.Planes);
          searchRegion(region, batch.ShapeOf(*first).Block, bins, found);
          first = last;
        }
      }
    },
    1);
}

template <int D>
void findPlaces(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
  ConstPointSpan<3> places, Progress& progress, MeshPlace* found)
{
  constexpr std::int64_t cellsBetweenPolls = 64;
  const MeshSlabs<D> slabs(grid.Size<D>());
  std::vector<Point<D>> index(static_cast<std::size_t>(places.size()));
  for (std::int64_t i = 0; i < places.size(); ++i)
  {
    grid.ToIndex<D>(places[i], index[static_cast<std::size_t>(i)].data());
    found[i] = {};
    found[i].Distance = std::numeric_limits<double>::infinity();
    found[i].Cell = -1; // until there is one within reach
  }
  Bins<std::int64_t> numbers; // of the places of each slab
  numbers.Fill(static_cast<std::size_t>(slabs.Count), [&](const auto& add) {
    for (std::int64_t i = 0; i < places.size(); ++i)
    {
      add(static_cast<std::size_t>(slabs.At(index[static_cast<std::size_t>(i)][D - 1])), i);
    }
  });
  const std::vector<Bins<vtkIdType>> cells = cellsOfSlabs<D>(blocks, grid, slabs, reach, progress);
  progress.For(
    slabs.Count, 1,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t s = first; s < last; ++s)
      {
        const auto slab = static_cast<std::size_t>(s);
        if (numbers[slab].Size() == 0)
        {
          continue;
        }
        const PlaceBins<D> bins(index, numbers[slab]);
        std::int64_t searched = 0;
        for (std::size_t b = 0; b < blocks.size(); ++b)
        {
          CellPieces<D> pieces(blocks[b], grid);
          for (const vtkIdType cell : cells[b][slab])
          {
            if (searched++ % cellsBetweenPolls == 0 && progress.ShouldStop())
            {
              return;
            }
            if (pieces.Divide(cell))
            {
              search(pieces, cell, static_cast<int>(b), bins, found);
            }
          }
        }
      }
    },
    1);
  if constexpr (D == 2)
  {
    visitRegions(blocks, grid, slabs, reach, progress, [&](const RegionBatch& batch) {
      searchRegions(batch, slabs, numbers, index, progress, found);
    });
  }
}

} // namespace

PlacesInMeshes::PlacesInMeshes(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
  ConstPointSpan<3> places, Progress& progress)
{
  withMemory("the places of the particles in the input's cells",
    static_cast<double>(places.size()) * sizeof(MeshPlace), [&]() {
      this->Found = LargeBuffer<MeshPlace>(places.size());
      dispatchDimension(grid.Dimension(), findPlaces<1>, findPlaces<2>, findPlaces<3>)(
        blocks, grid, places, progress, this->Found.data());
    });
}

SampledPlace PlacesInMeshes::Find(std::int64_t place) const
{
  const MeshPlace& found = this->Found.data()[place];
  SampledPlace sampled{ {}, {}, 0, found.Cell, found.Set };
  for (int i = 0; i < 4; ++i)
  {
    // A weight of 0 would not keep out values that are not finite.
    if (found.Weights[i] > 0.0)
    {
      sampled.Points[sampled.Count] = found.Points[i];
      sampled.Weights[sampled.Count++] = found.Weights[i];
    }
  }
  return sampled;
}

} // namespace RectifiedTransport::Bridge
