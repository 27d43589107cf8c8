// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/TriangleInput.h"

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Triangles/PolygonInput.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/Repair/TJunctions.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr double bytesOfMappedPoint = 1350.0; // in the conformal map

// Calls a function with the errors of a run: what Core says is wrong with a surface is the
// predicate of a sentence.
template <class Function>
auto withSurface(const MemoryPlan& plan, const Function& function)
{
  try
  {
    return withMemory(plan, function);
  }
  catch (const NotADisk& error)
  {
    fail("The input surface ", error.what());
  }
  catch (const std::invalid_argument& error)
  {
    fail("The input surface ", error.what());
  }
}

// For messages of memory: "12 triangles".
std::string countOf(const TriangleSurface& surface)
{
  return std::to_string(surface.NumberOfTriangles) + " triangles";
}

// Triangles from three point ids each, for the output. AllocateExact takes the memory once.
vtkSmartPointer<vtkCellArray> cellsOf(
  const std::int64_t* corners, std::int64_t count, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->AllocateExact(static_cast<vtkIdType>(count), static_cast<vtkIdType>(3 * count));
  progress.ForInOrder(count, grain, [&](std::int64_t first, std::int64_t last) {
    for (const std::int64_t* ids = corners + 3 * first; ids < corners + 3 * last; ids += 3)
    {
      cells->InsertNextCell({ static_cast<vtkIdType>(ids[0]), static_cast<vtkIdType>(ids[1]),
        static_cast<vtkIdType>(ids[2]) });
    }
  });
  return cells;
}

// Triangles in place of polygons and strips. The other data are the caller's to copy.
void setTriangles(vtkPolyData* from, vtkPoints* points, vtkCellArray* triangles, vtkPolyData* to)
{
  to->SetPoints(points);
  to->SetVerts(from->GetVerts());
  to->SetLines(from->GetLines());
  to->SetPolys(triangles);
  to->GetFieldData()->PassData(from->GetFieldData());
}

} // namespace

TriangleInput::TriangleInput(vtkPolyData* input, const std::string& need, Progress& progress)
  : Surface(input)
  , FirstPolygon(input->GetNumberOfVerts() + input->GetNumberOfLines())
{
  // Coordinates are copied to doubles, three a point, in the order of the input's points: cutting
  // and predicates need one type.
  Stages stages(progress, { { "points", 2 }, { "triangles", 8 } });
  LargeBuffer<double> coordinates = readSurfacePoints(input, need, stages["points"]);
  const ConstPointSpan<3> points{ coordinates.data(), coordinates.size() / 3 };
  // What rounding leaves of differences at one place: that of float if all coordinates are floats.
  const double rounding = roundingOfPoints(points);
  LargeBuffer<std::int64_t> corners = this->ReadCorners(points, rounding, stages["triangles"]);
  this->Triangles = { std::move(coordinates), std::move(corners), rounding };
}

// Point ids of the triangles, 3 each. Triangles are copied as they are; other polygons are cut, and
// Polygons then has the polygon that each triangle comes from.
LargeBuffer<std::int64_t> TriangleInput::ReadCorners(
  ConstPointSpan<3> points, double rounding, Progress& work)
{
  // The usual case: Polygons stays empty, which says that triangle i is polygon i.
  if (isAllTriangles(this->Surface))
  {
    const vtkIdType count = this->Surface->GetNumberOfPolys();
    return withMemory({ "the surface's " + std::to_string(count) + " triangles",
                        static_cast<double>(count) * 3.0 * sizeof(std::int64_t) },
      [&]() { return this->Corners(work); });
  }
  // A polygon of n corners gives n - 2 triangles, and so does a strip of n points. Memory: three
  // corners and the polygon for each.
  const PolygonSource polygons = polygonsOf(this->Surface);
  const std::int64_t count = polygons.NumberOfTriangles;
  PolygonTriangles cut = withMemory({ std::to_string(count) + " triangles of the input surface",
                                      static_cast<double>(count) * 4.0 * sizeof(std::int64_t) },
    [&]() { return cutPolygons(polygons, points, rounding, work); });
  // Triangles will copy the cell data of their polygons, so that short arrays are an error before
  // the work.
  vtkCellData* data = this->Surface->GetCellData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    requireTuples(
      data->GetAbstractArray(i), this->Surface->GetNumberOfCells(), "cell", "input surface");
  }
  this->Polygons = std::move(cut.Cells);
  return std::move(cut.Corners);
}

// Errors name the cell of the input, as triangles of cut polygons have numbers of their own.
// Coordinates and, where the input can be read again, corners are freed: the disk has its own.
DiskTriangles TriangleInput::Disk(Progress& progress)
{
  const TriangleSurface surface = this->Triangles.Surface();
  try
  {
    DiskTriangles disk = withMemory({ "the surface's " + std::to_string(surface.Points.size()) +
                                        " points and " + countOf(surface),
                                      static_cast<double>(surface.Points.size()) * 40.0 +
                                        static_cast<double>(surface.NumberOfTriangles) * 80.0 },
      [&]() { return DiskTriangles(this->Triangles, progress); });
    // The peak of the maps comes later: 24 bytes a point and 24 a triangle are given back before
    // it.
    this->Triangles.FreePoints();
    if (this->IsInput())
    {
      this->Triangles.FreeCorners();
    }
    return disk;
  }
  catch (const DiskTriangles::NoDisk& defect)
  {
    const std::int64_t first = defect.First();
    const std::int64_t cell = defect.GivenTriangle < 0 ? first : this->CellOf(defect.GivenTriangle);
    throw NoDiskSurface(std::string("The input surface ") + defect.what() +
      (cell == first
          ? ""
          : "; triangle " + std::to_string(first) + " is of cell " + std::to_string(cell)));
  }
}

// T-junctions are closed first, as the sides of an open one are boundaries, which part the surface
// there.
CutOpenSurface TriangleInput::Opened(Progress& progress)
{
  Stages stages(progress, { { "T-junctions", 5 }, { "seams", 95 } });
  withMemory({ "the edges of the surface's " + countOf(this->Triangles.Surface()),
               static_cast<double>(this->Triangles.Surface().NumberOfTriangles) * 150.0 },
    [&]() { this->Triangles.CloseTJunctions(TJunctionScope::All, stages["T-junctions"]); });
  const TriangleSurface surface = this->Triangles.Surface();
  // Edges, components, shortest paths and the cut triangles (see CutSurface). Each component is
  // mapped conformally in turn, the largest of which may have all points.
  constexpr double bytesOfTriangle = 250.0;
  SeamOptions options;
  // Points within rounding are merged before edges are found: without that, seams of texture
  // coordinates would be boundaries.
  options.Rounding = this->Triangles.Rounding();
  return withSurface({ "the seams of " + countOf(surface),
                       static_cast<double>(surface.NumberOfTriangles) * bytesOfTriangle +
                         static_cast<double>(surface.Points.size()) * bytesOfMappedPoint },
    [&]() { return CutOpenSurface(surface, options, stages["seams"]); });
}

AllTriangles TriangleInput::Whole(Progress& progress)
{
  const unsigned char* ghosts = ghostFlags(this->Surface, vtkDataObject::CELL, "input surface");
  // Polygons of the input carry the flags; all triangles of a polygon share its flag.
  const AllTriangles::IsLeftOut isGhost = [this, ghosts](std::int64_t triangle) {
    return (ghosts[this->CellOf(triangle)] & ghostCell) != 0;
  };
  const TriangleSurface surface = this->Triangles.Surface();
  return withSurface({ "the surface's " + countOf(surface),
                       static_cast<double>(surface.NumberOfTriangles) * 80.0 +
                         static_cast<double>(surface.Points.size()) * 48.0 },
    [&]() {
      // The buffers move into the result, so that nothing is in memory twice. Triangulated() is not
      // possible after that.
      return AllTriangles(this->Triangles.TakePoints(), this->Triangles.TakeCorners(),
        ghosts ? isGhost : nullptr, progress);
    });
}

// Disk may have freed the corners; those of an input of triangles are read again.
LargeBuffer<std::int64_t> TriangleInput::Corners(Progress& progress) const
{
  // Cut triangles exist only here, so that Disk has not freed them.
  if (!this->IsInput())
  {
    const TriangleSurface surface = this->Triangles.Surface();
    LargeBuffer<std::int64_t> kept(3 * surface.NumberOfTriangles);
    std::copy_n(surface.Triangles, kept.size(), kept.data());
    return kept;
  }
  LargeBuffer<std::int64_t> read(3 * this->Surface->GetNumberOfPolys());
  visitTriangles(this->Surface->GetPolys(), progress,
    [copy = read.data()](std::int64_t triangle, const std::array<std::int64_t, 3>& ids) {
      std::copy_n(ids.data(), 3, copy + 3 * triangle);
    });
  return read;
}

vtkSmartPointer<vtkPolyData> TriangleInput::Triangulated(Progress& progress) const
{
  // Without a cut, the input's own cell arrays and data are the output's.
  if (this->IsInput())
  {
    return this->Surface;
  }
  const TriangleSurface triangles = this->Triangles.Surface();
  Stages stages(progress, { { "triangles", 1 }, { "arrays", 2 } });
  auto made = vtkSmartPointer<vtkPolyData>::New();
  // Three point ids and an offset a triangle, with a reserve.
  requireMemory({ "the cells of the surface's " + countOf(triangles),
    static_cast<double>(triangles.NumberOfTriangles) * 5.0 * sizeof(vtkIdType) });
  setTriangles(this->Surface, this->Surface->GetPoints(),
    cellsOf(triangles.Triangles, triangles.NumberOfTriangles, stages["triangles"]), made);
  // Points stay in number and order, so that their arrays are shared.
  made->GetPointData()->PassData(this->Surface->GetPointData());
  copyTuples(
    { this->Surface->GetCellData(), this->Surface->GetNumberOfCells(), "cell", "input surface" },
    made->GetNumberOfCells(),
    [this](vtkIdType cell) {
      // Vertices and lines come first, as in the input; then each triangle has the data of its
      // polygon.
      return cell < this->FirstPolygon
        ? cell
        : this->CellOf(this->Triangles.GivenTriangle(cell - this->FirstPolygon));
    },
    made->GetCellData(), stages["arrays"]);
  return made;
}

void TriangleInput::CopyOpened(
  const CutOpenSurface& opened, Progress& progress, vtkPolyData* output) const
{
  Stages stages(progress, { { "triangles", 2 }, { "opened triangles", 1 }, { "points", 2 } });
  const vtkSmartPointer<vtkPolyData> from = this->Triangulated(stages["triangles"]);
  vtkNew<vtkPoints> points;
  // Copies have the coordinates of their originals to the bit, so that seams do not open in space.
  points->SetDataType(from->GetPoints()->GetDataType());
  const std::int64_t count = opened.NumberOfPoints();
  requireMemory({ "the points of the surface with its seams",
    static_cast<double>(count) * 3.0 * points->GetData()->GetDataTypeSize() });
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  for (std::int64_t point = 0; point < count; ++point)
  {
    points->SetPoint(static_cast<vtkIdType>(point),
      from->GetPoints()->GetPoint(static_cast<vtkIdType>(opened.OriginOf(point))));
  }
  setTriangles(from, points,
    cellsOf(opened.Triangles(), opened.Given().NumberOfTriangles, stages["opened triangles"]),
    output);
  output->GetCellData()->PassData(from->GetCellData());
  copyTuples(
    { from->GetPointData(), from->GetNumberOfPoints(), "point", "input surface" }, count,
    [&](vtkIdType point) { return static_cast<vtkIdType>(opened.OriginOf(point)); },
    output->GetPointData(), stages["points"]);
}

std::string TriangleInput::RepairWarning(
  const SurfaceRepairs& repairs, std::int64_t partedEdges) const
{
  RepairCounts counts;
  static_cast<SurfaceRepairs&>(counts) = repairs;
  // Closing T-junctions leaves out flat triangles, too, before the repairs count their own.
  counts.FlatTriangles += this->Triangles.FlatTriangles();
  counts.TJunctions = this->Triangles.TJunctions();
  counts.PartedEdges = partedEdges;
  return repairWarning(counts);
}

ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress)
{
  const std::int64_t points = disk.NumberOfPoints();
  return withSurface({ "the conformal map of " + std::to_string(points) + " points",
                       bytesOfMappedPoint * static_cast<double>(points) },
    [&]() { return mapConformally(disk, corners, progress); });
}

} // namespace RectifiedTransport::Bridge
