// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/Cartogram.h"

#include "Bridge/Data/PointInput.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Cartogram/MapOverlays.h"
#include "Core/Cartogram/MapProjection.h"
#include "Core/Cartogram/MapWarnings.h"
#include "Core/Cartogram/RegionChecks.h"
#include "Core/Cartogram/RegionRaster.h"
#include "Core/Parallel/Stages.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <numeric>
#include <optional>

namespace RectifiedTransport::Bridge
{

namespace
{

// VTK ends the program where cells that grow find no memory.
void reserveCells(vtkCellArray* cells, vtkIdType count, vtkIdType ids)
{
  if (count > 0 && !cells->AllocateExact(count, ids))
  {
    throw std::bad_alloc();
  }
}

// Gives a point on an edge the values of its ends, which may be such points themselves.
// InterpolateEdge of VTK would need ends in the input, whose arrays may be others.
void divideEdge(vtkPointData* data, vtkIdType point, const DividingPoint& added)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    array->InterpolateTuple(point, static_cast<vtkIdType>(added.First), array,
      static_cast<vtkIdType>(added.Second), array, added.At);
  }
}

// Writes each line of the graticule as a polyline. No two lines share a point, so that the ids are
// 0 to count - 1, and line i has the points from offset i up to offset i + 1. The arrays go to the
// output.
void writeGraticule(const MapOverlays& overlays, vtkPolyData* output)
{
  const std::vector<std::size_t>& ends = overlays.LineEnds();
  const auto number = [](std::size_t i) { return static_cast<vtkIdType>(i); };
  const vtkIdType count = number(ends.back());
  const auto coordinates = newArray<vtkDoubleArray>("Points", 3, count);
  const auto ids = newArray<vtkIdTypeArray>("Ids", 1, count);
  const auto offsets = newArray<vtkIdTypeArray>("Offsets", 1, number(ends.size() + 1));
  for (vtkIdType i = 0; i < count; ++i)
  {
    ids->SetValue(i, i);
    coordinates->SetTypedTuple(i, overlays.GraticulePoint(static_cast<std::size_t>(i)).data());
  }
  offsets->SetValue(0, 0);
  std::transform(ends.begin(), ends.end(), offsets->GetPointer(1), number);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkCellArray> lines;
  lines->SetData(offsets, ids);
  output->SetPoints(points);
  output->SetLines(lines);
}

// One run: the regions become rings in the plane of the map and then in the index space of a square
// box; runCartogram moves their points until areas are proportional to masses; graticule and
// overlay move along; all go back to the plane in space.
class CartogramJob
{
public:
  CartogramJob(const CartogramWorker& worker, RegionCells cells, MapCache& cache,
    const CartogramOutputs& outputs)
    : Worker(worker)
    , Cells(std::move(cells))
    , Cache(cache)
    , Outputs(outputs)
  {
  }

  std::vector<std::string> Run(Progress& progress)
  {
    Stages stages(progress,
      { { "points", 3 }, { "holes", 1 }, { "overlay", 1 }, { "comparison", 1 }, { "cartogram", 90 },
        { "regions", 1 }, { "moved overlay", 1 } });
    this->ReadPoints(stages["points"]);
    if (!this->Cells.OpenLines.empty())
    {
      this->Warnings.push_back(this->Cells.OpenLines);
    }
    // The plane of the map is that of its closed rings alone: open lines bound no area.
    this->Frame = planeOfRegions(this->Places, [this](const auto& visit) {
      this->VisitRings([&](std::int32_t region, const std::vector<std::int64_t>& ring) {
        region < 0 ? void() : visit(ring);
      });
    });
    progress.Check();
    this->MakeMap(stages["holes"]);
    // A region without mass would shrink to nothing. Masses are raised to a least share for the
    // flow, while MassPerArea shows those of the input.
    this->MassesBefore = this->Cells.Masses;
    this->Enlarged = completeMasses(this->Cells.Masses, this->Worker.MinimumShare, this->Before,
      this->Cells.Names, this->Warnings);
    // The flow is defined in a box. The sea in its margin gives way where regions move outwards.
    this->Box = boxAround(this->Map, this->Worker.Options);
    if (!this->Worker.IsInDegrees && looksLikeDegrees(this->Places))
    {
      this->Warnings.push_back(
        "The coordinates look like degrees of longitude and latitude, in which areas are wrong; "
        "set Projection to EqualArea, or project the map with the Calculator or QGIS");
    }
    // From here on the map is in index space, in cells of the raster.
    for (Point<2>& place : this->Map.Points())
    {
      place = this->Box.ToIndex(place);
    }
    progress.Check();
    // Graticule and overlay are points in the same index space, which all passes move with those of
    // the map.
    const MapPlace place{ this->Projection, *this->Frame, this->Box, this->Worker.Blend };
    MapOverlays overlays(place, this->Map);
    addOverlay(this->Outputs.Overlay, overlays, stages["overlay"]);
    CartogramStart start = this->FindStart(stages["comparison"]);
    this->RequireMemory();
    this->Result = runCartogram(this->Map, this->Cells.Masses, this->Box, this->Worker.Options,
      overlays.Points(), start, stages["cartogram"]);
    // If there was no raster of the unmoved map yet, `start` has the new one. It is kept even if
    // outlines turn out to cross, as it depends on the shapes alone.
    this->Cache.Start = start;
    if (!this->Result.Crossing.empty())
    {
      fail("The outline of the region ", this->Cells.Names[Index(this->Result.Crossing.front())],
        " crosses itself, so that its area is not clear; repair it, with QGIS's Fix geometries");
    }
    this->Missed = addWarnings(this->Result, this->Cells.Masses, this->Cells.Names,
      this->Map.Rings(), this->Worker.Options.Tolerance, this->Warnings);
    this->WriteRegions(place, stages["regions"]);
    writeGraticule(overlays, this->Outputs.Graticule);
    writeOverlay(overlays, this->Outputs.Overlay, stages["moved overlay"]);
    progress.Check();
    return std::move(this->Warnings);
  }

private:
  static std::size_t Index(std::int64_t i) { return static_cast<std::size_t>(i); }

  // Reads the places of all points, 3 coordinates each. Degrees of longitude and latitude are
  // projected first, by Lambert's cylindrical equal-area projection: areas in degrees are not those
  // on the earth.
  void ReadPoints(Progress& progress)
  {
    vtkPoints* points = this->Cells.Data->GetPoints();
    this->Places.resize(Index(points->GetNumberOfPoints()));
    visitPoints(this->Cells.Data, "input", progress, [this](std::int64_t i, const double* x) {
      this->Places[Index(i)] = { x[0], x[1], x[2] };
    });
    if (this->Worker.IsInDegrees)
    {
      this->Projection = MapProjection(this->Places);
      for (Point<3>& place : this->Places)
      {
        place = this->Projection.Project(place);
      }
    }
  }

  // For lines and polygons; polygons always are regions.
  bool IsOpen(vtkIdType cell) const { return this->Cells.Regions[Index(cell)] < 0; }

  // visit(cell, ids, count) of lines and polygons; the ids have the first point of a closed line at
  // the end again, which is not counted.
  template <class Visit>
  void VisitCells(const Visit& visit) const
  {
    vtkPolyData* data = this->Cells.Data;
    vtkNew<vtkIdList> ids;
    // A vtkPolyData numbers its cells by kinds, vertices first, then lines and polygons.
    vtkIdType cell = data->GetNumberOfVerts();
    for (vtkCellArray* cells : { data->GetLines(), data->GetPolys() })
    {
      for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i, ++cell)
      {
        cells->GetCellAtId(i, ids);
        const bool isClosedLine = cells == data->GetLines() && !this->IsOpen(cell);
        visit(cell, ids, ids->GetNumberOfIds() - (isClosedLine ? 1 : 0));
      }
    }
  }

  // visit(region, points) of rings and of open lines, whose region is below 0.
  template <class Visit>
  void VisitRings(const Visit& visit) const
  {
    std::vector<std::int64_t> ring;
    this->VisitCells([&](vtkIdType cell, vtkIdList* ids, vtkIdType count) {
      ring.assign(ids->begin(), ids->begin() + count);
      visit(this->Cells.Regions[Index(cell)], ring);
    });
  }

  // Makes the map in its plane. Points are added in the order of the input, so that its ids are the
  // map's numbers; what FindHoles adds where rings cross follows. Areas are measured before
  // anything moves.
  void MakeMap(Progress& progress)
  {
    for (const Point<3>& place : this->Places)
    {
      this->Map.AddPoint(this->Frame->ToPlane(place));
    }
    this->VisitRings([&](std::int32_t region, const std::vector<std::int64_t>& ring) {
      region < 0 ? this->Map.AddLine(ring) : this->Map.AddRing(region, ring);
    });
    this->Added = this->Map.FindHoles(progress);
    this->Before = this->Map.Areas(static_cast<std::int32_t>(this->Cells.Masses.size()));
    this->Land = requireAreas(this->Before, this->Cells.Names);
  }

  void RequireMemory() const
  {
    // Checked before the passes begin, which take most of the time.
    constexpr double bytesOfCell = 40.0; // a density and its flow
    const auto side = static_cast<double>(this->Box.Side);
    const std::string text = std::to_string(this->Box.Side);
    requireMemory({ "a raster of " + text + " x " + text + " cells (see Resolution)",
      bytesOfCell * side * side + RegionRaster::BytesOf(this->Map, this->Box.Side) });
  }

  // The raster of the unmoved map depends on its points, cells and regions, on the projection,
  // Resolution and Margin, but not on masses. A run with other masses reuses it.
  CartogramStart FindStart(Progress& progress)
  {
    DataIdentity content;
    vtkPolyData* data = this->Cells.Data;
    content.AddArray(data->GetPoints()->GetData());
    for (vtkCellArray* cells : { data->GetLines(), data->GetPolys() })
    {
      content.AddArray(cells->GetConnectivityArray());
      content.AddArray(cells->GetOffsetsArray());
    }
    for (const std::int32_t region : this->Cells.Regions)
    {
      // Open lines, which have the region -1, count as 0.
      content.AddNumber(static_cast<std::uint64_t>(region + 1));
    }
    content.AddNumber(static_cast<std::uint64_t>(this->Worker.Options.Resolution));
    content.AddNumber(this->Worker.IsInDegrees ? 1 : 0);
    content.AddNumbers(&this->Worker.Options.Margin, 1);
    if (content.IsSameAs(this->Cache.Content, progress))
    {
      return this->Cache.Start;
    }
    content.Hash(progress);
    this->Cache = { std::move(content), {} }; // an abort may follow
    return {};
  }

  // Points that divide edges follow those of the input. Their values are interpolated along the
  // edge; an end may be such a point itself, so they are made in the order in which they were
  // added. With Blend = 0 places stay as given, without rounding by index space.
  void WriteRegions(const MapPlace& where, Progress& progress)
  {
    vtkPolyData* input = this->Cells.Data;
    vtkPolyData* output = this->Outputs.Regions;
    const auto points = static_cast<vtkIdType>(this->Map.Points().size());
    const auto moved = newArray<vtkDoubleArray>("Points", 3, points);
    // Arrays of points have room for the dividing points, whose values are interpolated in place.
    output->GetPointData()->InterpolateAllocate(input->GetPointData(), points);
    // The places of all points before the move, 3 coordinates each, those that divide edges at the
    // end.
    std::vector<Point<3>> before = this->Places;
    const auto old = static_cast<vtkIdType>(before.size());
    output->GetPointData()->CopyData(input->GetPointData(), 0, old, 0);
    constexpr std::int64_t work = 8; // units, of the arrays of a point
    progress.Expect(work * (points - old) + points);
    // The points at crossings come first and those of the passes after them, as the map numbers
    // them.
    this->Added.insert(this->Added.end(), this->Result.Added.begin(), this->Result.Added.end());
    for (std::size_t i = 0; i < this->Added.size(); ++i)
    {
      progress.Add(work);
      const DividingPoint& added = this->Added[i];
      const Point<3>& a = before[Index(added.First)];
      const Point<3>& b = before[Index(added.Second)];
      Point<3> place;
      for (std::size_t k = 0; k < 3; ++k)
      {
        place[k] = a[k] + added.At * (b[k] - a[k]);
      }
      before.push_back(place);
      divideEdge(output->GetPointData(), old + static_cast<vtkIdType>(i), added);
    }
    for (vtkIdType i = 0; i < points; ++i)
    {
      progress.Add(1);
      // A point moves along the plane by the part Blend of its way and keeps its distance from the
      // plane.
      const Point<3> place = this->Worker.Blend > 0.0
        ? where.Blended(this->Result.Before[Index(i)], this->Map.Points()[Index(i)],
            this->Frame->Distance(before[Index(i)]))
        : before[Index(i)];
      moved->SetTypedTuple(i, place.data());
    }
    vtkNew<vtkPoints> outputPoints;
    outputPoints->SetData(moved);
    output->SetPoints(outputPoints);
    progress.Check();
    this->WriteCells(output);
    addFieldValues(output, "AreaErrors", this->LargestErrors());
    addFieldValue(output, "EnlargedRegions", this->Enlarged);
    addFieldValue(output, "RegionsMissed", static_cast<double>(this->Missed));
  }

  // The largest relative error of a region's area in each pass: the field data show the
  // convergence.
  std::vector<double> LargestErrors() const
  {
    std::vector<double> errors;
    for (const CartogramPass& pass : this->Result.Passes)
    {
      errors.push_back(pass.LargestError);
    }
    return errors;
  }

  // Cells keep their order, and each gets AreaError, TargetArea = mass / total mass times the land
  // area, and MassPerArea, the density before. Cells that are no region have 0.
  void WriteCells(vtkPolyData* output)
  {
    vtkPolyData* input = this->Cells.Data;
    output->SetVerts(input->GetVerts());
    vtkNew<vtkCellArray> lines;
    vtkNew<vtkCellArray> polygons;
    // A ring has a corner for each edge, and a closed line its first point once more.
    reserveCells(lines, input->GetNumberOfLines(), this->Map.Edges() + input->GetNumberOfLines());
    reserveCells(polygons, input->GetNumberOfPolys(), this->Map.Edges());
    std::int64_t ring = 0;
    vtkNew<vtkIdList> ids;
    this->VisitCells([&](vtkIdType cell, vtkIdList* given, vtkIdType count) {
      const bool isLine = cell < input->GetNumberOfVerts() + input->GetNumberOfLines();
      const bool isClosedLine = isLine && !this->IsOpen(cell);
      const std::int64_t corners = this->Map.CountOf(ring);
      ids->SetNumberOfIds(corners + (isClosedLine ? 1 : 0));
      for (std::int64_t i = 0; i < corners; ++i)
      {
        ids->SetId(i, this->Map.CornerOf(ring, i));
      }
      if (isClosedLine)
      {
        // The last point may be another one in the same place.
        const vtkIdType last = given->GetId(count);
        output->GetPoints()->SetPoint(last, output->GetPoints()->GetPoint(given->GetId(0)));
        ids->SetId(corners, last);
      }
      (isLine ? lines : polygons)->InsertNextCell(ids);
      ++ring;
    });
    output->SetLines(lines);
    output->SetPolys(polygons);
    output->GetCellData()->PassData(input->GetCellData());
    const double total = std::accumulate(this->Cells.Masses.begin(), this->Cells.Masses.end(), 0.0);
    // The area of all regions after the move: Growth differs from 1 if the sea has another density
    // than their mean, because they then grow into it or give way.
    const double land = this->Land * this->Result.Growth;
    vtkNew<vtkDoubleArray> errors;
    vtkNew<vtkDoubleArray> targets;
    vtkNew<vtkDoubleArray> densities;
    errors->SetName("AreaError");
    targets->SetName("TargetArea");
    densities->SetName("MassPerArea");
    const auto cells = static_cast<vtkIdType>(this->Cells.Regions.size());
    for (vtkDoubleArray* array : { errors.Get(), targets.Get(), densities.Get() })
    {
      array->SetNumberOfTuples(cells);
      output->GetCellData()->AddArray(array);
    }
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      const std::int32_t region = this->Cells.Regions[Index(cell)];
      const bool isRegion = region >= 0;
      errors->SetValue(cell, isRegion ? this->Result.Errors[Index(region)] : 0.0);
      targets->SetValue(cell, isRegion ? this->Cells.Masses[Index(region)] / total * land : 0.0);
      densities->SetValue(
        cell, isRegion ? this->MassesBefore[Index(region)] / this->Before[Index(region)] : 0.0);
    }
  }

  const CartogramWorker& Worker;
  RegionCells Cells;
  MapCache& Cache;
  const CartogramOutputs& Outputs;
  std::vector<std::string> Warnings;
  std::vector<Point<3>> Places; // the input's points, projected if they are in degrees
  MapProjection Projection;
  std::optional<PlaneFrame> Frame;
  RegionMap Map;
  std::vector<DividingPoint> Added; // what follows the input's points, on their edges
  CartogramBox Box{};
  std::vector<double> MassesBefore; // the masses of the regions, without the least share
  std::vector<double> Before;       // the areas of the regions, in the plane of the map
  double Land = 0.0;                // their sum
  std::int32_t Enlarged = 0;
  std::int64_t Missed = 0; // regions
  CartogramResult Result;
};

} // namespace

std::vector<std::string> CartogramWorker::Run(const std::vector<DensityBlock>& blocks,
  MapCache& cache, Progress& progress, const CartogramOutputs& outputs) const
{
  Stages stages(progress, { { "regions", 2 }, { "cartogram", 98 } });
  // The job has the state of this run alone; only the cache outlives it.
  RegionCells cells = readRegions(blocks, this->Arrays, stages["regions"]);
  return CartogramJob(*this, std::move(cells), cache, outputs).Run(stages["cartogram"]);
}

} // namespace RectifiedTransport::Bridge
