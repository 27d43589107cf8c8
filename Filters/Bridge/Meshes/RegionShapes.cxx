// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Meshes/RegionShapes.h"

#include "Bridge/Meshes/CellPieces.h"
#include "Bridge/Meshes/RegionValue.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t cellGrain = std::int64_t{ 1 } << 10;
constexpr vtkIdType allLines = -1;

// Adds rings of cells to shapes. For one thread.
class ShapeReader
{
public:
  ShapeReader(const std::vector<BlockValues>& blocks, const ImageGrid& grid)
    : Blocks(blocks)
    , Grid(grid)
  {
  }

  // Of a block's cell, or of all its lines.
  void Read(int block, vtkIdType cell, RegionShape& shape)
  {
    const BlockValues& values = this->Blocks[static_cast<std::size_t>(block)];
    shape.Block = block;
    if (cell != allLines)
    {
      this->AddRing(values, cell, shape);
      return;
    }
    for (vtkIdType line = 0; line < values.Data()->GetNumberOfCells(); ++line)
    {
      if (values.IsRegion(line))
      {
        this->AddRing(values, line, shape);
      }
    }
  }

  // Edges and the values of regions.
  void FindRegions(vtkIdType cell, RegionShape& shape, Progress& progress) const
  {
    const BlockValues& values = this->Blocks[static_cast<std::size_t>(shape.Block)];
    const bool mayBeSimple = cell != allLines && values.IsRegion(cell);
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
        RingValues(shape.Outline, ring, shape.Points.data(), values.Values())
          .At(sizeOfRegion(first, last).Centroid);
    });
  }

private:
  void AddRing(const BlockValues& values, vtkIdType cell, RegionShape& shape)
  {
    vtkDataSet* data = values.Data();
    data->GetCellPoints(cell, this->Ids);
    const vtkIdType count = this->Ids->GetNumberOfIds();
    auto* set = vtkPointSet::SafeDownCast(data);
    auto* doubles = set ? vtkArrayDownCast<vtkDoubleArray>(set->GetPoints()->GetData()) : nullptr;
    const double* coordinates = doubles ? doubles->GetPointer(0) : nullptr;
    shape.Outline.Reserve(shape.Outline.Edges() + count);
    shape.Points.reserve(shape.Points.size() + static_cast<std::size_t>(count));
    const auto first = shape.Points.size();
    Point<2> before{};
    Point<2> begin{};
    for (vtkIdType i = 0; i < count; ++i)
    {
      double x[3];
      const vtkIdType id = this->Ids->GetId(i);
      if (coordinates)
      {
        std::copy_n(coordinates + 3 * id, 3, x);
      }
      else
      {
        data->GetPoint(id, x);
      }
      Point<2> index;
      this->Grid.ToIndex<2>(x, index.data());
      const bool isFirst = shape.Points.size() == first;
      begin = isFirst ? index : begin;
      // Twice at one place, and the end of a closed line.
      if (!isFirst && (index == before || (i + 1 == count && index == begin)))
      {
        continue;
      }
      before = index;
      shape.Outline.Add(index);
      shape.Points.push_back(id);
    }
    shape.Outline.EndRing();
    shape.Cells.push_back(cell);
    const std::int64_t ring = shape.Outline.Count() - 1;
    shape.Values.push_back(values.IsOnPoints()
        ? RingValues(shape.Outline, ring, shape.Points.data(), values.Values()).Mean()
        : values.Values()[cell]);
  }

  const std::vector<BlockValues>& Blocks;
  const ImageGrid& Grid;
  vtkNew<vtkIdList> Ids;
};

// Whether a polygon of four corners turns the same way at each of them, clearly.
bool isConvex(const Rings& ring)
{
  constexpr double clearly = 1e-6;
  int lefts = 0;
  int rights = 0;
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
    double error = 0.0;
    const double area = doubleArea(ring.At(i), ring.At(next), ring.At(ring.Next(next)), error);
    lefts += area > clearly * longest * longest ? 1 : 0;
    rights += area < -clearly * longest * longest ? 1 : 0;
  }
  return ring.Edges() == 4 && (lefts == 4 || rights == 4);
}

// Whether a cell is a region; for one thread.
class RegionTest
{
public:
  RegionTest(const std::vector<BlockValues>& blocks, int block, const ImageGrid& grid)
    : Values(blocks[static_cast<std::size_t>(block)])
    , Block(block)
    , Reader(blocks, grid)
    , Pieces(Values, grid)
  {
  }

  bool Is(vtkIdType cell, Progress& progress)
  {
    constexpr vtkIdType mostDivided = 256; // VTK takes quadratic time
    const int type = this->Values.Data()->GetCellType(cell);
    if (type != VTK_POLYGON && type != VTK_QUAD)
    {
      return false;
    }
    const vtkIdType corners = this->Values.Data()->GetCellSize(cell);
    if (corners > 4 && (!this->Values.IsOnPoints() || corners > mostDivided))
    {
      return true;
    }
    RegionShape shape;
    this->Reader.Read(this->Block, cell, shape);
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
  bool IsDividedWell(vtkIdType cell, RegionShape& shape, Progress& progress)
  {
    constexpr double tolerance = 1e-9;
    this->Reader.FindRegions(cell, shape, progress);
    const double area =
      sizeOfRegion(shape.Edges.data(), shape.Edges.data() + shape.Edges.size()).Area;
    const auto size = this->Pieces.SizeOf(cell);
    return size.LeftOut == 0 && std::abs(size.Measure - area) <= tolerance * area;
  }

  const BlockValues& Values;
  const int Block;
  ShapeReader Reader;
  CellPieces<2> Pieces;
};

// Of a batch: a polygon, or the lines of a block.
struct Unit
{
  int Block;
  vtkIdType Cell;
};

std::vector<Unit> unitsOf(const std::vector<BlockValues>& blocks)
{
  std::vector<Unit> units;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const vtkIdType count = blocks[b].Data()->GetNumberOfCells();
    for (vtkIdType cell = 0; cell < count; ++cell)
    {
      if (blocks[b].IsRegion(cell))
      {
        const bool areLines = blocks[b].AreClosedLines();
        units.push_back({ static_cast<int>(b), areLines ? allLines : cell });
        cell = areLines ? count : cell;
      }
    }
  }
  return units;
}

// Sorts the edges of a batch by the slabs that they reach.
void findSlabs(const MeshSlabs<2>& slabs, double margin, RegionBatch& batch)
{
  batch.Slabs.Fill(static_cast<std::size_t>(slabs.Count), [&](const auto& add) {
    for (std::size_t s = 0; s < batch.Shapes.size(); ++s)
    {
      const std::vector<OutlineEdge>& edges = batch.Shapes[s].Edges;
      for (std::size_t e = 0; e < edges.size(); ++e)
      {
        const double low = std::min(edges[e].From[1], edges[e].To[1]);
        const double high = std::max(edges[e].From[1], edges[e].To[1]);
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

void markRegions(std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress)
{
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    if (blocks[b].AreClosedLines())
    {
      continue;
    }
    progress.For(
      blocks[b].Data()->GetNumberOfCells(), cellGrain, [&](std::int64_t first, std::int64_t last) {
        RegionTest test(blocks, static_cast<int>(b), grid);
        for (std::int64_t cell = first; cell < last; ++cell)
        {
          if (blocks[b].IsCounted(cell) && test.Is(cell, progress))
          {
            blocks[b].MarkAsRegion(cell);
          }
        }
      });
  }
}

void visitRegions(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
  const MeshSlabs<2>& slabs, double margin, Progress& progress,
  const std::function<void(const RegionBatch&)>& use)
{
  constexpr std::int64_t edgesOfBatch = std::int64_t{ 1 } << 18;
  const std::vector<Unit> units = unitsOf(blocks);
  RegionBatch batch;
  for (std::size_t first = 0; first < units.size();)
  {
    std::size_t last = first;
    for (std::int64_t edges = 0; last < units.size() && edges < edgesOfBatch; ++last)
    {
      vtkDataSet* data = blocks[static_cast<std::size_t>(units[last].Block)].Data();
      if (units[last].Cell == allLines)
      {
        edges += data->GetNumberOfPoints();
        continue;
      }
      edges += data->GetCellSize(units[last].Cell);
    }
    batch.Shapes.clear();
    batch.Shapes.resize(last - first);
    progress.For(
      static_cast<std::int64_t>(last - first), 1,
      [&](std::int64_t begin, std::int64_t end) {
        ShapeReader reader(blocks, grid);
        for (std::int64_t i = begin; i < end && !progress.IsCancelled(); ++i)
        {
          RegionShape& shape = batch.Shapes[static_cast<std::size_t>(i)];
          const Unit& unit = units[first + static_cast<std::size_t>(i)];
          reader.Read(unit.Block, unit.Cell, shape);
          reader.FindRegions(unit.Cell, shape, progress);
        }
      },
      1);
    findSlabs(slabs, margin, batch);
    use(batch);
    first = last;
  }
}

} // namespace RectifiedTransport::Bridge
