// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/RegionShapes.h"

#include "Core/Parallel/Progress.h"
#include "Core/Resampling/CellPieces.h"
#include "Core/Resampling/RingValues.h"

#include <cmath>
#include <memory>

namespace RectifiedTransport
{

namespace
{

// A thread tests so many cells at a time: most tests look at the number of corners alone.
constexpr std::int64_t cellGrain = std::int64_t{ 1 } << 10;
// Stands for all closed lines of a set in the place of a cell.
constexpr std::int64_t allLines = -1;

// Adds rings of cells to shapes. For one thread.
class ShapeReader
{
public:
  ShapeReader(const std::vector<CellValues>& sets, const ImageGrid& grid)
    : Sets(sets)
    , Grid(grid)
  {
  }

  // Reads a set's cell, or all its lines, as rings in index space.
  void Read(int set, std::int64_t cell, RegionShape& shape)
  {
    const CellValues& values = this->Sets[static_cast<std::size_t>(set)];
    shape.Set = set;
    // A reader serves all cells of its set.
    if (set != this->ReaderSet)
    {
      this->Reader = values.Cells().Read();
      this->ReaderSet = set;
    }
    if (cell != allLines)
    {
      this->AddRing(values, cell, shape);
      return;
    }
    for (std::int64_t line = 0; line < values.Cells().NumberOfCells; ++line)
    {
      if (values.IsRegion(line))
      {
        this->AddRing(values, line, shape);
      }
    }
  }

  // Finds the edges of regions by the even-odd rule, and with point values the value of each
  // region: that of the least-squares plane at the region's centroid.
  void FindRegions(std::int64_t cell, RegionShape& shape, Progress& progress) const
  {
    const CellValues& values = this->Sets[static_cast<std::size_t>(shape.Set)];
    const bool mayBeSimple = cell != allLines && values.IsRegion(cell);
    // What one visit found about crossings serves the next ones.
    bool isSimple = mayBeSimple && values.IsSimple(cell);
    shape.Edges = regionOutlines(shape.Outline, shape.Values, progress, &isSimple);
    if (mayBeSimple && isSimple)
    {
      values.MarkAsSimple(cell);
    }
    if (!values.IsOnPoints())
    {
      return;
    }
    shape.VisitRegions([&](std::int32_t ring, const OutlineEdge* first, const OutlineEdge* last) {
      shape.Values[static_cast<std::size_t>(ring)] =
        RingValues(shape.Outline, ring, shape.PointValues.data())
          .At(sizeOfRegion(first, last).Centroid);
    });
  }

private:
  // Appends the ring of a cell. A point at the place of the one before is left out, and so is the
  // last point of a closed line.
  void AddRing(const CellValues& values, std::int64_t cell, RegionShape& shape)
  {
    const CellReader::Ids& points = this->Reader->PointsOf(cell);
    const std::size_t count = points.size();
    shape.Outline.Reserve(shape.Outline.Edges() + static_cast<std::int64_t>(count));
    shape.Points.reserve(shape.Points.size() + count);
    const auto first = shape.Points.size();
    Point<2> before{};
    Point<2> begin{};
    for (std::size_t i = 0; i < count; ++i)
    {
      double x[3];
      this->Reader->GetPosition(points[i], x);
      // In index space of the grid, as all outlines.
      Point<2> index;
      this->Grid.ToIndex<2>(x, index.data());
      // The ring's own first point, as a shape may have several rings.
      const bool isFirst = shape.Points.size() == first;
      begin = isFirst ? index : begin;
      // Twice at one place, and the end of a closed line.
      if (!isFirst && (index == before || (i + 1 == count && index == begin)))
      {
        continue;
      }
      before = index;
      shape.Outline.Add(index);
      shape.Points.push_back(points[i]);
      if (values.IsOnPoints())
      {
        shape.PointValues.push_back(values.At(points[i]));
      }
    }
    shape.Outline.EndRing();
    shape.Cells.push_back(cell);
    const std::int64_t ring = shape.Outline.Count() - 1;
    // At first the mean along the ring; regions of several rings get their own values later.
    shape.Values.push_back(values.IsOnPoints()
        ? RingValues(shape.Outline, ring, shape.PointValues.data()).Mean()
        : values.At(cell));
  }

  const std::vector<CellValues>& Sets;
  const ImageGrid& Grid;
  std::unique_ptr<CellReader> Reader;
  int ReaderSet = -1;
};

// Whether a polygon of four corners turns the same way at each of them, clearly: by an area above
// 1e-6 of the longest side's square.
bool isConvex(const Rings& ring)
{
  constexpr double clearly = 1e-6;
  int lefts = 0;
  int rights = 0;
  // Turns are compared with the square of the longest side.
  const double longest = [&]() {
    double length = 0.0;
    for (std::int64_t i = 0; i < ring.Edges(); ++i)
    {
      const Point<2>& a = ring.At(i);
      const Point<2>& b = ring.At(ring.Next(i));
      length = std::max(length, std::hypot(b[0] - a[0], b[1] - a[1]));
    }
    return length;
  }();
  for (std::int64_t i = 0; i < ring.Edges(); ++i)
  {
    const std::int64_t next = ring.Next(i);
    // Twice the area of each corner's triangle; its sign is the turn.
    double error = 0.0;
    const double area = doubleArea(ring.At(i), ring.At(next), ring.At(ring.Next(next)), error);
    lefts += area > clearly * longest * longest ? 1 : 0;
    rights += area < -clearly * longest * longest ? 1 : 0;
  }
  return ring.Edges() == 4 && (lefts == 4 || rights == 4);
}

// Whether a polygon is a region instead of being divided; for one thread.
class RegionTest
{
public:
  RegionTest(const std::vector<CellValues>& sets, int set, const ImageGrid& grid)
    : Values(sets[static_cast<std::size_t>(set)])
    , Set(set)
    , Cells(Values.Cells().Read())
    , Reader(sets, grid)
    , Pieces(Values, grid)
  {
  }

  // Triangles and convex quadrilaterals divide well. Larger polygons with one value need no
  // division. With point values, it is used if the triangles have the area of the region.
  bool Is(std::int64_t cell, Progress& progress)
  {
    constexpr std::size_t mostDivided = 256; // VTK's ear clipping takes quadratic time
    const CellShape shapeOfCell = this->Cells->ShapeOf(cell);
    // Other cells are divided exactly as they are.
    if (shapeOfCell != CellShape::Polygon && shapeOfCell != CellShape::Quad)
    {
      return false;
    }
    // More than four corners and one value: the shape of the polygon need not be known.
    const std::size_t corners = this->Cells->PointsOf(cell).size();
    if (corners > 4 && (!this->Values.IsOnPoints() || corners > mostDivided))
    {
      return true;
    }
    RegionShape shape;
    this->Reader.Read(this->Set, cell, shape);
    // A triangle; with points at one place it may be less.
    if (corners == 3 && shape.Outline.Edges() == 3)
    {
      return false;
    }
    if (corners == 4 && isConvex(shape.Outline))
    {
      return false;
    }
    return !this->Values.IsOnPoints() || !this->IsDividedWell(cell, shape, progress);
  }

private:
  // VTK's triangles of a concave or crossing polygon need not cover the region once.
  bool IsDividedWell(std::int64_t cell, RegionShape& shape, Progress& progress)
  {
    // Both areas differ by rounding alone if the triangles cover the region once.
    constexpr double tolerance = 1e-9;
    this->Reader.FindRegions(cell, shape, progress);
    const double area =
      sizeOfRegion(shape.Edges.data(), shape.Edges.data() + shape.Edges.size()).Area;
    const auto size = this->Pieces.SizeOf(cell);
    return size.LeftOut == 0 && std::abs(size.Measure - area) <= tolerance * area;
  }

  const CellValues& Values;
  const int Set;
  const std::unique_ptr<CellReader> Cells;
  ShapeReader Reader;
  CellPieces<2> Pieces;
};

// What a shape is made of: a polygon, or the lines of a set.
struct Unit
{
  int Set;
  std::int64_t Cell;
};

// The units in the order of sets and cells, which is the order of regions in every result.
std::vector<Unit> unitsOf(const std::vector<CellValues>& sets)
{
  std::vector<Unit> units;
  for (std::size_t s = 0; s < sets.size(); ++s)
  {
    const std::int64_t count = sets[s].Cells().NumberOfCells;
    for (std::int64_t cell = 0; cell < count; ++cell)
    {
      if (sets[s].IsRegion(cell))
      {
        const bool areLines = sets[s].AreClosedLines();
        // All lines of a set are one unit: they may lie in each other.
        units.push_back({ static_cast<int>(s), areLines ? allLines : cell });
        cell = areLines ? count : cell;
      }
    }
  }
  return units;
}

// Returns the end of the batch that begins with a unit: about 2^18 edges, which bounds the memory.
std::size_t endOfBatch(
  const std::vector<CellValues>& sets, const std::vector<Unit>& units, std::size_t first)
{
  constexpr std::size_t edgesOfBatch = std::size_t{ 1 } << 18;
  std::unique_ptr<CellReader> reader;
  std::size_t last = first;
  for (std::size_t edges = 0; last < units.size() && edges < edgesOfBatch; ++last)
  {
    const CellSet& cells = sets[static_cast<std::size_t>(units[last].Set)].Cells();
    if (units[last].Cell == allLines)
    {
      // An upper bound for the edges of all lines.
      edges += static_cast<std::size_t>(cells.NumberOfPoints);
      continue;
    }
    if (!reader || units[last].Set != units[last - 1].Set)
    {
      reader = cells.Read();
    }
    edges += reader->PointsOf(units[last].Cell).size();
  }
  return last;
}

// Sorts the edges of a batch by the slabs that they reach, within a margin in grid cells.
void findSlabs(const GridSlabs<2>& slabs, double margin, RegionBatch& batch)
{
  batch.Slabs.Fill(static_cast<std::size_t>(slabs.Count), [&](const auto& add) {
    for (std::size_t s = 0; s < batch.Shapes.size(); ++s)
    {
      const std::vector<OutlineEdge>& edges = batch.Shapes[s].Edges;
      for (std::size_t e = 0; e < edges.size(); ++e)
      {
        const double low = std::min(edges[e].From[1], edges[e].To[1]);
        const double high = std::max(edges[e].From[1], edges[e].To[1]);
        // An edge is in all slabs between its ends.
        const std::int64_t last = slabs.At(high + margin);
        for (std::int64_t slab = slabs.At(low - margin); slab <= last; ++slab)
        {
          add(static_cast<std::size_t>(slab),
            RegionBatch::Edge{ static_cast<std::int32_t>(s), static_cast<std::int32_t>(e) });
        }
      }
    }
  });
}

} // namespace

void markRegions(std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress)
{
  for (std::size_t s = 0; s < sets.size(); ++s)
  {
    CellValues& values = sets[s];
    // Closed lines are regions in any case: there is nothing to test.
    if (values.AreClosedLines())
    {
      continue;
    }
    progress.For(
      values.Cells().NumberOfCells, cellGrain, [&](std::int64_t first, std::int64_t last) {
        // A test has a reader and memory of its own.
        RegionTest test(sets, static_cast<int>(s), grid);
        for (std::int64_t cell = first; cell < last; ++cell)
        {
          if (values.IsCounted(cell) && test.Is(cell, progress))
          {
            values.MarkAsRegion(cell);
          }
        }
      });
  }
}

// Batches follow each other; in a batch, shapes and then slabs are the tasks of threads.
void visitRegions(const std::vector<CellValues>& sets, const ImageGrid& grid,
  const GridSlabs<2>& slabs, double margin, Progress& progress,
  const std::function<void(const RegionBatch&)>& use)
{
  const std::vector<Unit> units = unitsOf(sets);
  RegionBatch batch;
  for (std::size_t first = 0; first < units.size();)
  {
    const std::size_t last = endOfBatch(sets, units, first);
    // Memory is that of one batch.
    batch.Shapes.clear();
    batch.Shapes.resize(last - first);
    // Each shape is one task, because one polygon may have most of the edges. Slices begin with one
    // shape for the same reason: the time of the first is not known.
    progress.For(
      static_cast<std::int64_t>(last - first), 1,
      [&](std::int64_t begin, std::int64_t end) {
        ShapeReader reader(sets, grid);
        for (std::int64_t i = begin; i < end && !progress.IsCancelled(); ++i)
        {
          RegionShape& shape = batch.Shapes[static_cast<std::size_t>(i)];
          const Unit& unit = units[first + static_cast<std::size_t>(i)];
          reader.Read(unit.Set, unit.Cell, shape);
          reader.FindRegions(unit.Cell, shape, progress);
        }
      },
      1);
    findSlabs(slabs, margin, batch);
    use(batch);
    first = last;
  }
}

} // namespace RectifiedTransport
