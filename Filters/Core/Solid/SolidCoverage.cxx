// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Solid/SolidCoverage.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>

namespace RectifiedTransport
{

namespace
{

using Index = std::int64_t;

// Rows and lines are at the half-integers of coordinates in squares of the sampling.
Index firstLineFrom(double coordinate, Index lines)
{
  const double line = std::ceil(coordinate - 0.5); // the subtraction is exact where it matters
  return static_cast<Index>(std::max(0.0, std::min(line, static_cast<double>(lines))));
}

// Lists, for each layer of grid cells, the triangles that its rows of lines cross, in their order.
class TriangleLayers
{
public:
  // Of `layers`, lists for those of [firstLayer, endLayer).
  TriangleLayers(const TriangleSurface& surface, Index layers, Index firstLayer, Index endLayer,
    int supersampling, Progress& progress)
    : Surface(surface)
    , Layers(layers)
    , FirstLayer(firstLayer)
    , EndLayer(endLayer)
    , Squares(supersampling)
    , First(layers + 2)
    , Work(progress)
  {
  }

  // Throws Cancelled.
  void Build()
  {
    // Counted as differences along the layers: O(1) for a triangle of any height.
    std::fill_n(this->First.data(), this->Layers + 2, Index{ 0 });
    this->Work.BeginStage(0.05, this->Surface.NumberOfTriangles);
    this->ForTriangles([this](Index, const Range& range) {
      ++this->First.data()[range.First + 1];
      --this->First.data()[range.End + 1];
    });
    Index* first = this->First.data();
    Index open = 0;
    Index sum = 0;
    for (Index k = 0; k <= this->Layers; ++k)
    {
      open += first[k];
      sum += open;
      first[k] = sum; // where layer k begins
    }
    this->Triangles = LargeBuffer<Index>(sum);
    LargeBuffer<Index> next(this->Layers);
    std::copy_n(first, this->Layers, next.data());
    this->Work.BeginStage(0.1, sum);
    this->ForTriangles([this, &next](Index triangle, const Range& range) {
      for (Index k = range.First; k < range.End; ++k)
      {
        this->Triangles.data()[next.data()[k]++] = triangle;
      }
    });
  }

  Index Begin(Index layer) const { return this->First.data()[layer]; }
  Index End(Index layer) const { return this->First.data()[layer + 1]; }
  Index Triangle(Index at) const { return this->Triangles.data()[at]; }

private:
  struct Range
  {
    Index First;
    Index End;
  };

  Range LayersOf(Index triangle) const
  {
    const Index* corners = this->Surface.Triangles + 3 * triangle;
    double z[3];
    for (int i = 0; i < 3; ++i)
    {
      z[i] = this->Surface.Points[corners[i]][2] * this->Squares;
    }
    const Index rows = this->Layers * this->Squares;
    const Index first = firstLineFrom(std::min({ z[0], z[1], z[2] }), rows);
    const Index end = firstLineFrom(std::max({ z[0], z[1], z[2] }), rows);
    return { std::max(first / this->Squares, this->FirstLayer),
      first < end ? std::min((end - 1) / this->Squares + 1, this->EndLayer) : 0 };
  }

  // Calls visit(triangle, range) for all, in order.
  template <class Visit>
  void ForTriangles(const Visit& visit)
  {
    for (Index i = 0; i < this->Surface.NumberOfTriangles; ++i)
    {
      const Range range = this->LayersOf(i);
      if (range.First < range.End)
      {
        visit(i, range);
      }
      this->Work.Add(1 + std::max<Index>(0, range.End - range.First));
    }
  }

  TriangleSurface Surface;
  Index Layers;
  Index FirstLayer;
  Index EndLayer;
  int Squares;
  LargeBuffer<Index> First;
  LargeBuffer<Index> Triangles;
  Progress& Work;
};

// The intersection of a line with the surface.
struct Crossing
{
  double X;
  int Side; // the change of the winding number, 1 or -1
};

// Uninitialised memory that is kept from layer to layer.
template <class T>
class Scratch
{
public:
  void Reserve(Index count)
  {
    if (count > this->Count)
    {
      this->Memory.reset(new T[static_cast<std::size_t>(count)]);
      this->Count = count;
    }
  }
  T* data() { return this->Memory.get(); }

private:
  std::unique_ptr<T[]> Memory;
  Index Count = 0;
};

// A corner of the polygon in which the plane of a row intersects the surface.
struct PlanePoint
{
  double X;
  double Y;
};

using Corner = std::array<double, 3>;

// The intersection of the plane of a row with an edge that crosses it upwards. Both triangles of
// the edge call it with the same numbers.
PlanePoint cutEdge(const Corner& below, const Corner& above, double z)
{
  const double t = (z - below[2]) / (above[2] - below[2]);
  return { below[0] + t * (above[0] - below[0]), below[1] + t * (above[1] - below[1]) };
}

class CoverageRun
{
public:
  CoverageRun(const TriangleSurface& surface, const TriangleLayers& layers,
    const GridSize<3>& cells, const LatticePart<3>& part, int supersampling, double* coverage,
    Progress& progress)
    : Surface(surface)
    , Layers(layers)
    , Cells(cells)
    , Part(part)
    , Squares(supersampling)
    , LinesPerCell(supersampling * supersampling)
    , FirstLine(part.Low[1] * supersampling)
    , EndLine((part.Low[1] + part.Cells[1]) * supersampling)
    , Lines(cells[1] * supersampling)
    , Coverage(coverage)
    , Work(progress)
  {
  }

  // A range kernel, of the layers of the part.
  void CoverLayers(Index first, Index last)
  {
    LayerScratch scratch;
    scratch.First.Reserve(this->Part.Cells[1] * this->LinesPerCell + 1);
    scratch.Parts.Reserve(this->Cells[0] + 1);
    scratch.Whole.Reserve(this->Cells[0] + 1);
    scratch.Row.Reserve(this->Cells[0]);
    for (Index layer = first; layer < last && !this->Work.ShouldStop(); ++layer)
    {
      this->FindCrossings(this->Part.Low[2] + layer, scratch);
      if (this->Work.IsCancelled()) // then crossings may be missing
      {
        return;
      }
      this->CoverLayer(layer, scratch);
    }
  }

  Index OpenLines() const { return this->NumberOfOpenLines; }

private:
  // Lines of a layer are numbered so that those of a row of grid cells are contiguous.
  struct LayerScratch
  {
    Scratch<Index> First; // of each line's crossings
    Scratch<Crossing> Crossings;
    Scratch<double> Parts; // sums of the lengths that lines cover of grid cells partly
    Scratch<int> Whole;    // numbers of lines that cover a whole cell, as differences along the row
    Scratch<double> Row;   // of all cells along axis 0
  };

  // The crossings of all lines of a layer, by lines.
  void FindCrossings(Index layer, LayerScratch& scratch)
  {
    const Index lines = this->Part.Cells[1] * this->LinesPerCell;
    Index* first = scratch.First.data();
    std::fill_n(first, lines + 1, Index{ 0 });
    this->ForSegments(
      layer, [this, first](const PlanePoint&, const PlanePoint&, Index from, Index end, Index row) {
        for (Index j = from; j < end; ++j)
        {
          ++first[this->LineOf(j, row)];
        }
      });
    // From counts to the ends of the lines' crossings; filling them backward makes these
    // beginnings.
    for (Index line = 1; line <= lines; ++line)
    {
      first[line] += first[line - 1];
    }
    scratch.Crossings.Reserve(first[lines]);
    Crossing* crossings = scratch.Crossings.data();
    this->ForSegments(layer,
      [this, first, crossings](
        const PlanePoint& in, const PlanePoint& out, Index from, Index end, Index row) {
        // From the lower end, so that coincident triangles have the same crossings.
        const bool up = in.Y < out.Y;
        const PlanePoint& low = up ? in : out;
        const PlanePoint& high = up ? out : in;
        const double slope = (high.X - low.X) / (high.Y - low.Y);
        const double least = std::min(low.X, high.X);
        const double most = std::max(low.X, high.X);
        for (Index j = from; j < end; ++j)
        {
          const double x = low.X + slope * (static_cast<double>(j) + 0.5 - low.Y);
          crossings[--first[this->LineOf(j, row)]] = { std::max(least, std::min(x, most)),
            up ? 1 : -1 };
        }
      });
  }

  Index LineOf(Index j, Index row) const
  {
    j -= this->FirstLine;
    return j / this->Squares * this->LinesPerCell + row * this->Squares + j % this->Squares;
  }

  // Calls visit(in, out, from, end, row) for the intersections of the planes of a layer's rows with
  // the triangles: segments that cross lines [from, end).
  template <class Visit>
  void ForSegments(Index layer, const Visit& visit)
  {
    const double squares = static_cast<double>(this->Squares);
    for (Index at = this->Layers.Begin(layer); at < this->Layers.End(layer); ++at)
    {
      if ((at & 0xfff) == 0xfff && this->Work.ShouldStop())
      {
        return;
      }
      const Index* ids = this->Surface.Triangles + 3 * this->Layers.Triangle(at);
      Corner corners[3];
      for (int i = 0; i < 3; ++i)
      {
        const double* point = this->Surface.Points[ids[i]];
        corners[i] = { point[0], point[1] * squares, point[2] * squares };
      }
      for (Index row = 0; row < this->Squares; ++row)
      {
        const double z = static_cast<double>(layer * this->Squares + row) + 0.5;
        this->CutTriangle(corners, z, [&](const PlanePoint& in, const PlanePoint& out) {
          const Index from =
            std::max(firstLineFrom(std::min(in.Y, out.Y), this->Lines), this->FirstLine);
          const Index end =
            std::min(firstLineFrom(std::max(in.Y, out.Y), this->Lines), this->EndLine);
          visit(in, out, from, end, row);
        });
      }
    }
  }

  // Calls visit(in, out) if the plane intersects the triangle: from the edge that crosses the plane
  // upwards to the one that crosses it downwards. A corner on the plane counts as below it.
  template <class Visit>
  void CutTriangle(const Corner (&corners)[3], double z, const Visit& visit)
  {
    const bool below[3] = { corners[0][2] <= z, corners[1][2] <= z, corners[2][2] <= z };
    if (below[0] == below[1] && below[1] == below[2])
    {
      return;
    }
    PlanePoint in{};
    PlanePoint out{};
    for (int i = 0; i < 3; ++i)
    {
      const int next = i == 2 ? 0 : i + 1;
      if (below[i] && !below[next])
      {
        in = cutEdge(corners[i], corners[next], z);
      }
      else if (!below[i] && below[next])
      {
        out = cutEdge(corners[next], corners[i], z);
      }
    }
    visit(in, out);
  }

  void CoverLayer(Index layer, LayerScratch& scratch)
  {
    const Index* first = scratch.First.data();
    for (Index j = 0; j < this->Part.Cells[1]; ++j)
    {
      if ((j & 0x1f) == 0x1f && this->Work.ShouldStop())
      {
        return;
      }
      const Index begin = j * this->LinesPerCell;
      const Index end = begin + this->LinesPerCell;
      const Index columns = this->Part.Cells[0];
      double* row = this->Coverage + (layer * this->Part.Cells[1] + j) * columns;
      if (first[begin] == first[end])
      {
        std::fill_n(row, columns, 0.0);
        continue;
      }
      std::fill_n(scratch.Parts.data(), this->Cells[0] + 1, 0.0);
      std::fill_n(scratch.Whole.data(), this->Cells[0] + 1, 0);
      for (Index line = begin; line < end; ++line)
      {
        this->CoverLine(scratch.Crossings.data() + first[line], first[line + 1] - first[line],
          scratch.Parts.data(), scratch.Whole.data());
      }
      if (columns == this->Cells[0])
      {
        this->WriteRow(scratch.Parts.data(), scratch.Whole.data(), row);
        continue;
      }
      this->WriteRow(scratch.Parts.data(), scratch.Whole.data(), scratch.Row.data());
      std::copy_n(scratch.Row.data() + this->Part.Low[0], columns, row);
    }
  }

  // Adds the parts of a line that are inside the solid.
  void CoverLine(Crossing* crossings, Index count, double* parts, int* whole)
  {
    std::sort(
      crossings, crossings + count, [](const Crossing& a, const Crossing& b) { return a.X < b.X; });
    Index winding = 0;
    double entry = 0.0;
    for (Index i = 0; i < count; ++i)
    {
      if (winding == 0)
      {
        entry = crossings[i].X;
      }
      winding += crossings[i].Side;
      if (winding == 0)
      {
        this->CoverInterval(entry, crossings[i].X, parts, whole);
      }
    }
    if (winding != 0)
    {
      ++this->NumberOfOpenLines;
    }
  }

  void CoverInterval(double entry, double exit, double* parts, int* whole) const
  {
    const double length = static_cast<double>(this->Cells[0]);
    entry = std::max(0.0, std::min(entry, length));
    exit = std::max(0.0, std::min(exit, length));
    const Index from = std::min(static_cast<Index>(entry), this->Cells[0] - 1);
    const Index to = std::min(static_cast<Index>(exit), this->Cells[0] - 1);
    if (from == to)
    {
      parts[from] += exit - entry;
      return;
    }
    parts[from] += static_cast<double>(from + 1) - entry;
    parts[to] += exit - static_cast<double>(to);
    ++whole[from + 1];
    --whole[to];
  }

  void WriteRow(const double* parts, int* whole, double* row) const
  {
    const Index count = this->Cells[0];
    for (Index i = 1; i < count; ++i)
    {
      whole[i] += whole[i - 1];
    }
    const double lines = this->LinesPerCell;
#pragma omp simd
    for (Index i = 0; i < count; ++i)
    {
      // By rounding the parts of a grid cell may sum to more than the cell.
      row[i] = std::min((static_cast<double>(whole[i]) + parts[i]) / lines, 1.0);
    }
  }

  TriangleSurface Surface;
  const TriangleLayers& Layers;
  GridSize<3> Cells;
  LatticePart<3> Part;
  Index Squares;
  int LinesPerCell;
  Index FirstLine; // of the part, and past its last
  Index EndLine;
  Index Lines; // of a row
  double* Coverage;
  Progress& Work;
  std::atomic<Index> NumberOfOpenLines{ 0 };
};

} // namespace

CoverageReport coverSolid(const TriangleSurface& surface, const GridSize<3>& cells,
  int supersampling, double* coverage, const Context& context)
{
  return coverPartOfSolid(
    surface, cells, LatticePart<3>::WholeOf(cells), supersampling, coverage, context);
}

CoverageReport coverPartOfSolid(const TriangleSurface& surface, const GridSize<3>& cells,
  const LatticePart<3>& part, int supersampling, double* coverage, const Context& context)
{
  if (part.Count() == 0)
  {
    return {};
  }
  Progress progress(context);
  TriangleLayers layers(
    surface, cells[2], part.Low[2], part.Low[2] + part.Cells[2], supersampling, progress);
  layers.Build();
  CoverageRun run(surface, layers, cells, part, supersampling, coverage, progress);
  progress.BeginStage(1.0);
  progress.For(
    part.Cells[2], 1, [&run](Index first, Index last) { run.CoverLayers(first, last); }, 1);
  return { run.OpenLines() };
}

} // namespace RectifiedTransport
