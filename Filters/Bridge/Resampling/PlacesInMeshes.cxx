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

namespace RectifiedTransport
{

namespace
{

constexpr double reach = 1.0; // grid cells around a mesh's cell

// Numbers of places, by the bin of a lattice that each is in.
template <int D>
class PlaceBins
{
public:
  PlaceBins(const std::vector<Point<D>>& places, const std::vector<std::int64_t>& numbers)
    : Places(places)
    , Numbers(numbers)
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
    this->Width = std::max(1.0, std::pow(volume / static_cast<double>(numbers.size()), 1.0 / D));
    std::size_t bins = 1;
    for (int a = 0; a < D; ++a)
    {
      this->Size[a] = static_cast<std::int64_t>((high[a] - this->Low[a]) / this->Width) + 1;
      bins *= static_cast<std::size_t>(this->Size[a]);
    }
    std::vector<std::size_t> binOf;
    binOf.reserve(numbers.size());
    this->Begin.assign(bins + 2, 0);
    for (const std::int64_t number : numbers)
    {
      std::int64_t bin = 0;
      for (int a = D - 1; a >= 0; --a)
      {
        bin = bin * this->Size[a] + this->At(a, places[static_cast<std::size_t>(number)][a]);
      }
      binOf.push_back(static_cast<std::size_t>(bin));
      ++this->Begin[binOf.back() + 2];
    }
    for (std::size_t bin = 2; bin < this->Begin.size(); ++bin)
    {
      this->Begin[bin] += this->Begin[bin - 1];
    }
    this->Sorted.resize(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      this->Sorted[static_cast<std::size_t>(this->Begin[binOf[i] + 1]++)] = numbers[i];
    }
  }

  // Calls visit(number) for all places of the box, and for others near it.
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
        const std::int64_t begin = this->Begin[static_cast<std::size_t>(row + first[0])];
        const std::int64_t end = this->Begin[static_cast<std::size_t>(row + last[0] + 1)];
        for (std::int64_t i = begin; i < end; ++i)
        {
          visit(this->Sorted[static_cast<std::size_t>(i)]);
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
  const std::vector<std::int64_t>& Numbers;
  Point<D> Low;
  double Width;
  GridSize<D> Size;
  std::vector<std::int64_t> Begin; // of each bin, and the end
  std::vector<std::int64_t> Sorted;
};

} // namespace

template <int D>
class PlaceSearch
{
public:
  using Place = PlacesInMeshes::Place;

  static void Run(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
    ConstPointSpan<3> places, Progress& progress, Place* found)
  {
    const MeshSlabs<D> slabs(grid.Size<D>());
    std::vector<Point<D>> index(static_cast<std::size_t>(places.size()));
    std::vector<std::vector<std::int64_t>> numbers(static_cast<std::size_t>(slabs.Count));
    for (std::int64_t i = 0; i < places.size(); ++i)
    {
      Point<D>& x = index[static_cast<std::size_t>(i)];
      grid.ToIndex<D>(places[i], x.data());
      found[i] = {};
      found[i].Distance = std::numeric_limits<double>::infinity();
      found[i].Cell = -1; // until there is one within reach
      numbers[static_cast<std::size_t>(slabs.At(x[D - 1]))].push_back(i);
    }
    std::vector<CellsOfSlabs> cells;
    cells.reserve(blocks.size());
    for (const BlockValues& block : blocks)
    {
      cells.push_back(cellsOfSlabs<D>(block, grid, slabs, reach, progress));
    }
    progress.For(
      slabs.Count, 1,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t s = first; s < last; ++s)
        {
          const auto slab = static_cast<std::size_t>(s);
          if (numbers[slab].empty())
          {
            continue;
          }
          const PlaceBins<D> bins(index, numbers[slab]);
          for (std::size_t b = 0; b < blocks.size(); ++b)
          {
            CellPieces<D> pieces(blocks[b], grid);
            for (std::int64_t i = cells[b].Begin[slab]; i < cells[b].Begin[slab + 1]; ++i)
            {
              if (i % cellsBetweenPolls == 0 && progress.ShouldStop())
              {
                return;
              }
              const vtkIdType cell = cells[b].Cells[static_cast<std::size_t>(i)];
              if (pieces.Divide(cell))
              {
                search(pieces, cell, static_cast<int>(b), bins, index, found);
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

private:
  static constexpr std::int64_t cellsBetweenPolls = 64;

  static void searchRegions(const RegionBatch& batch, const MeshSlabs<D>& slabs,
    const std::vector<std::vector<std::int64_t>>& numbers, const std::vector<Point<D>>& index,
    Progress& progress, Place* found)
  {
    progress.For(
      static_cast<std::int64_t>(numbers.size()), 1,
      [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t s = begin; s < end; ++s)
        {
          const auto slab = static_cast<std::size_t>(s);
          if (numbers[slab].empty() || batch.Begin[slab] == batch.Begin[slab + 1])
          {
            continue;
          }
          const PlaceBins<D> bins(index, numbers[slab]);
          for (std::size_t first = batch.Begin[slab]; first < batch.Begin[slab + 1];)
          {
            std::size_t last = first + 1;
            while (
              last < batch.Begin[slab + 1] && batch.IsSame(batch.Edges[first], batch.Edges[last]))
            {
              ++last;
            }
            if (progress.ShouldStop())
            {
              return;
            }
            searchRegion(RegionRows(batch, first, last, s * slabs.Planes, (s + 1) * slabs.Planes),
              batch.Shapes[static_cast<std::size_t>(batch.Edges[first].Shape)].Block, bins, index,
              found);
            first = last;
          }
        }
      },
      1);
  }

  static void searchRegion(const RegionRows& region, int set, const PlaceBins<D>& bins,
    const std::vector<Point<D>>& index, Place* found)
  {
    const Point<2> low{ region.Low()[0] - reach, region.Low()[1] - reach };
    const Point<2> high{ region.High()[0] + reach, region.High()[1] + reach };
    bins.VisitBox(low, high, [&](std::int64_t number) {
      Place& best = found[number];
      const bool isFound = best.Distance == 0.0;
      if (isFound && best.Set <= set)
      {
        return;
      }
      const RegionRows::Found place = region.Find(index[static_cast<std::size_t>(number)]);
      if (place.Distance < best.Distance || (isFound && place.Distance == 0.0))
      {
        best.Distance = place.Distance;
        best.Cell = place.Cell;
        best.Set = set;
        std::copy_n(place.Points, 4, best.Points);
        std::copy_n(place.Weights, 4, best.Weights);
      }
    });
  }

  static void search(const CellPieces<D>& pieces, vtkIdType cell, int set, const PlaceBins<D>& bins,
    const std::vector<Point<D>>& index, Place* found)
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
      bins.VisitBox(low, high, [&](std::int64_t number) {
        Place& best = found[number];
        if (best.Distance == 0.0)
        {
          return;
        }
        const Vector x(index[static_cast<std::size_t>(number)].data());
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
};

PlacesInMeshes::PlacesInMeshes(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
  ConstPointSpan<3> places, Progress& progress)
{
  withMemory("the places of the particles in the input's cells",
    static_cast<double>(places.size()) * sizeof(Place), [&]() {
      this->Found = LargeBuffer<Place>(places.size());
      dispatchDimension(grid.Dimension(), &PlaceSearch<1>::Run, &PlaceSearch<2>::Run,
        &PlaceSearch<3>::Run)(blocks, grid, places, progress, this->Found.data());
    });
}

SampledPlace PlacesInMeshes::Find(std::int64_t place) const
{
  const Place& found = this->Found.data()[place];
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

} // namespace RectifiedTransport
