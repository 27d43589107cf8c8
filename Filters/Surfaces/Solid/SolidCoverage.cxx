// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/SolidCoverage.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Solid/BodyWeights.h"
#include "Surfaces/Solid/SignedVolumes.h"
#include "Surfaces/Solid/SolidLines.h"
#include "Surfaces/Solid/TriangleLayers.h"
#include "Surfaces/Solid/WindingTree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Index = std::int64_t;

// Layers of cells across axis 2 are independent tasks. In each, exact signed volumes come first;
// lines then correct the rows in which windings other than 0 and 1 occur.
class CoverageRun
{
public:
  CoverageRun(const TriangleSurface& surface, const TriangleLayers& layers,
    const signed char* weights, const GridSize<3>& cells, const LatticePart<3>& part,
    int supersampling, double* coverage, Progress& progress)
    : Surface(surface)
    , Layers(layers)
    , Weights(weights)
    , Cells(cells)
    , Part(part)
    , Squares(supersampling)
    , Coverage(coverage)
    , Work(progress)
  {
    // A bound for the rounding of index coordinates and of sums where faces lie on the borders of
    // cells: 8 units in the last place of the grid's size. Grids below 16 cells count as 16.
    const Index longest = std::max({ cells[0], cells[1], cells[2], Index{ 16 } });
    this->Rounding = 8.0 * std::numeric_limits<double>::epsilon() * static_cast<double>(longest);
  }

  // A range kernel over the layers of the part.
  // Each layer writes to its own part of Coverage, so that threads share only the list of idle
  // memory and the number of open lines, an integer sum.
  void CoverLayers(Index first, Index last)
  {
    std::unique_ptr<LayerWork> layerWork = this->TakeWork();
    for (Index layer = first; layer < last && !this->Work.ShouldStop(); ++layer)
    {
      this->AddVolumes(this->Part.Low[2] + layer, layerWork->Volumes);
      layerWork->Lines.FindCrossings(this->Part.Low[2] + layer, this->Work);
      if (this->Work.IsCancelled()) // then crossings may be missing
      {
        return;
      }
      this->WriteLayer(layer, *layerWork);
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Idle.push_back(std::move(layerWork));
  }

  Index OpenLines() const { return this->NumberOfOpenLines; }

private:
  // What a thread needs for a layer.
  struct LayerWork
  {
    SignedVolumes Volumes;
    SolidLines Lines;
    std::vector<double> Row; // values of all cells along axis 0
  };

  // Memory is kept from range to range, one LayerWork for each thread that runs at a time.
  std::unique_ptr<LayerWork> TakeWork()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      if (!this->Idle.empty())
      {
        std::unique_ptr<LayerWork> idle = std::move(this->Idle.back());
        this->Idle.pop_back();
        return idle;
      }
    }
    return std::unique_ptr<LayerWork>(new LayerWork{ { this->Cells, this->Part },
      { this->Surface, this->Layers, this->Weights, this->Cells, this->Part, this->Squares },
      std::vector<double>(static_cast<std::size_t>(this->Cells[0])) });
  }

  // Bodies of the weight 0 bound nothing.
  void AddVolumes(Index layer, SignedVolumes& volumes)
  {
    volumes.Begin(layer);
    for (Index at = this->Layers.Begin(layer); at < this->Layers.End(layer); ++at)
    {
      // Polled every 4096 triangles.
      if ((at & 0xfff) == 0xfff && this->Work.ShouldStop())
      {
        return;
      }
      const Index triangle = this->Layers.Triangle(at);
      if (this->Weights[triangle] != 0)
      {
        volumes.Add(cornersOf(this->Surface, triangle), this->Weights[triangle]);
      }
    }
  }

  // Rows of the layer: volumes where triangles have a part, lines where they cross. Volumes have
  // all cells along axis 0, as sums run along it; the part takes its own.
  void WriteLayer(Index layer, LayerWork& layerWork)
  {
    const Index columns = this->Part.Cells[0];
    for (Index j = 0; j < this->Part.Cells[1]; ++j)
    {
      if ((j & 0x1f) == 0x1f && this->Work.ShouldStop())
      {
        return;
      }
      double* row = this->Coverage + (layer * this->Part.Cells[1] + j) * columns;
      const bool hasVolumes = layerWork.Volumes.HasRow(j);
      const bool hasLines = layerWork.Lines.HasRow(j);
      // A line along axis 0 that enters a closed surface passes a triangle; those beyond the grid
      // count as on its border. A row without triangles is therefore outside.
      if (!hasVolumes && !hasLines)
      {
        std::fill_n(row, columns, 0.0);
        continue;
      }
      double* values = layerWork.Row.data();
      if (hasVolumes)
      {
        layerWork.Volumes.WriteRow(j, this->Rounding, values);
      }
      else
      {
        std::fill_n(values, this->Cells[0], 0.0);
      }
      this->NumberOfOpenLines += hasLines ? layerWork.Lines.CorrectRow(j, values) : 0;
      // Where lines correct a cell, they may do so by too much: their share of a cell is a sample.
      std::transform(values + this->Part.Low[0], values + this->Part.Low[0] + columns, row,
        [](double value) { return std::max(0.0, std::min(value, 1.0)); });
    }
  }

  TriangleSurface Surface;
  const TriangleLayers& Layers;
  const signed char* Weights; // by triangles: 1, 0 or -1
  GridSize<3> Cells;
  LatticePart<3> Part;
  int Squares;      // squares along an axis of a cell
  double Rounding;  // in cells, by face of a cell
  double* Coverage; // by cells of the part, axis 0 fastest
  Progress& Work;
  std::atomic<Index> NumberOfOpenLines{ 0 };
  std::mutex Mutex;
  std::vector<std::unique_ptr<LayerWork>> Idle;
};

} // namespace

CoverageReport coverSolid(const SolidSurface& surface, const GridSize<3>& cells, int supersampling,
  double* coverage, const Context& context)
{
  return coverPartOfSolid(
    surface, cells, LatticePart<3>::WholeOf(cells), supersampling, coverage, context);
}

// Weights are found from all triangles, also for a part of the grid: all parts, and the ranks that
// have them, then agree. Layers are listed, and volumes summed, for the part alone.
CoverageReport coverPartOfSolid(const SolidSurface& surface, const GridSize<3>& cells,
  const LatticePart<3>& part, int supersampling, double* coverage, const Context& context)
{
  if (part.Count() == 0)
  {
    return {};
  }
  Progress progress(context);
  Stages stages(progress, { { "weights", 1 }, { "layers", 1 }, { "cells", 8 } });
  const LargeBuffer<signed char> weights = weighBodies(surface, stages["weights"]);
  const TriangleLayers layers(
    surface.Triangles, cells[2], part.Low[2], part.Low[2] + part.Cells[2], stages["layers"]);
  Progress& work = stages["cells"];
  CoverageRun run(
    surface.Triangles, layers, weights.data(), cells, part, supersampling, coverage, work);
  // A layer is a range, as layers differ in cost.
  work.For(
    part.Cells[2], 1, [&run](Index first, Index last) { run.CoverLayers(first, last); }, 1);
  return { run.OpenLines() };
}

void coverPartOfOpenSolid(const TriangleSurface& surface, const GridSize<3>& cells,
  const LatticePart<3>& part, int supersampling, double* coverage, const Context& context)
{
  if (part.Count() == 0)
  {
    return;
  }
  Progress progress(context);
  Stages stages(progress, { { "tree", 1 }, { "layers", 1 }, { "cells", 8 } });
  const WindingTree tree(surface, stages["tree"]);
  const TriangleLayers layers(
    surface, cells[2], part.Low[2], part.Low[2] + part.Cells[2], stages["layers"]);
  const std::vector<signed char> weights(static_cast<std::size_t>(surface.NumberOfTriangles), 1);
  const auto winding = [&tree](const Point<3>& place) { return tree.At(place); };
  Progress& work = stages["cells"];
  work.For(
    part.Cells[2], 1,
    [&](Index first, Index last) {
      SolidLines lines(surface, layers, weights.data(), cells, part, supersampling);
      std::vector<double> values(static_cast<std::size_t>(cells[0]));
      for (Index layer = first; layer < last && !work.ShouldStop(); ++layer)
      {
        lines.FindCrossings(part.Low[2] + layer, work);
        for (Index j = 0; j < part.Cells[1] && !work.ShouldStop(); ++j)
        {
          lines.CoverRow(part.Low[2] + layer, j, winding, values.data());
          std::copy_n(values.data() + part.Low[0], part.Cells[0],
            coverage + (layer * part.Cells[1] + j) * part.Cells[0]);
        }
      }
    },
    1);
}

// Rejection sampling: a low-discrepancy sequence that begins at the point fills the cell evenly,
// and its first place inside is taken. Inside is where the winding number is not zero, which the
// tree has within .07.
void moveInside(const TriangleSurface& surface, PointSpan<3> points, const Context& context)
{
  constexpr Index grain = 256;
  constexpr int tries = 1024;
  constexpr Point<3> step{ 0.8191725133961645, 0.6710436067037893, 0.5497004779019703 };
  Progress progress(context);
  Stages stages(progress, { { "tree", 1 }, { "points", 1 } });
  const WindingTree tree(surface, stages["tree"]);
  stages["points"].ForEach(points.size(), grain, [&](Index i) {
    double* point = points[i];
    Point<3> place{ point[0], point[1], point[2] };
    for (int t = 0; t < tries; ++t)
    {
      if (std::abs(tree.At(place)) > 0.5)
      {
        std::copy_n(place.begin(), 3, point);
        return;
      }
      for (std::size_t a = 0; a < 3; ++a)
      {
        const double low = std::floor(point[a]);
        place[a] = low + std::fmod(place[a] - low + step[a], 1.0);
      }
    }
  });
}

} // namespace RectifiedTransport
