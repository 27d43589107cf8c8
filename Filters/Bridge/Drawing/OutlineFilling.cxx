// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/OutlineFilling.h"

#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Drawing/OutlineRegions.h"
#include "Core/Overlap/RingShape.h"
#include "Core/Overlap/RingTriangles.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Cells of vtkPolyData are ordered as vertices, lines, polygons and strips. The output has the
// vertices and lines, a line around each polygon, the filled areas and the strips; Cells has the
// input cell of each in that order.
class OutlineFilling
{
public:
  explicit OutlineFilling(vtkPolyData* data)
    : Data(data)
    , Ends(Context())
  {
    this->Lines->DeepCopy(data->GetLines());
  }

  // The order of the calls is that of the kinds of cells in a vtkPolyData, for vertices and lines,
  // then lines around polygons, areas and strips: Cells and CellsOfAreas grow in step with the
  // output's cells.
  void Fill()
  {
    const OutlineRegions outlines = findOutlineRegions(this->Data);
    const vtkIdType firstPolygon = this->Data->GetNumberOfVerts() + this->Data->GetNumberOfLines();
    const vtkIdType firstStrip = firstPolygon + this->Data->GetNumberOfPolys();
    this->AddCells(0, firstPolygon);
    this->FillPolygons(firstPolygon);
    for (const std::vector<Outline>& region : outlines.Regions)
    {
      this->FillRegion(region, outlines.Plane);
    }
    for (const vtkIdType cell : this->CellsOfAreas)
    {
      this->Cells->InsertNextId(cell);
    }
    this->AddCells(firstStrip, this->Data->GetNumberOfCells());
    this->Attach();
  }

private:
  // A point where edges cross.
  struct AddedPoint
  {
    Point<3> Place;
    vtkIdType First; // the ends of one of the edges
    vtkIdType Second;
    double Part; // the share of that edge before the point, from 0 to 1
  };

  // The cells [first, last) of the input are cells of the output as they are.
  void AddCells(vtkIdType first, vtkIdType last)
  {
    for (vtkIdType cell = first; cell < last; ++cell)
    {
      this->Cells->InsertNextId(cell);
    }
  }

  // `first` is the number of the first polygon among all cells. Polygons without points, which
  // files may have, are left out.
  void FillPolygons(vtkIdType first)
  {
    vtkNew<vtkIdList> polygon;
    for (vtkIdType i = 0; i < this->Data->GetNumberOfPolys(); ++i)
    {
      this->Data->GetPolys()->GetCellAtId(i, polygon);
      if (polygon->GetNumberOfIds() > 0)
      {
        this->AddLoop(polygon);
        this->Cells->InsertNextId(first + i);
        this->FillPolygon(first + i, polygon);
      }
    }
  }

  // Adds a line around a polygon, so that its edge is drawn as those of outlines.
  void AddLoop(vtkIdList* polygon)
  {
    this->Lines->InsertNextCell(static_cast<int>(polygon->GetNumberOfIds() + 1));
    for (const vtkIdType point : *polygon)
    {
      this->Lines->InsertCellPoint(point);
    }
    this->Lines->InsertCellPoint(polygon->GetId(0));
  }

  // A convex polygon stays one cell. VTK draws others as a fan of triangles, which covers more than
  // the polygon, so they are triangulated as a region of one outline.
  void FillPolygon(vtkIdType cell, vtkIdList* polygon)
  {
    std::vector<Point<3>> places(static_cast<std::size_t>(polygon->GetNumberOfIds()));
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      this->Data->GetPoint(polygon->GetId(static_cast<vtkIdType>(i)), places[i].data());
    }
    RingPlane plane;
    // A polygon has a plane of its own, as surfaces bend; outlines of a map share one.
    plane.Add(places);
    if (isConvex(places) || !plane.HasArea() || !areFinite(places))
    {
      this->Areas->InsertNextCell(polygon);
      this->CellsOfAreas.push_back(cell);
      return;
    }
    this->FillRegion({ { cell, { polygon->begin(), polygon->end() } } }, plane.Frame());
  }

  // The outlines of a region become rings in its plane, which the even-odd rule triangulates.
  // Points where edges cross are added with the values that are interpolated along one of the
  // edges.
  void FillRegion(const std::vector<Outline>& region, const PlaneFrame& plane)
  {
    // Points of the rings are numbered from 0, ring by ring; `points` gives their ids in the data
    // set, and those of crossings follow.
    Rings rings;
    std::vector<vtkIdType> points;
    for (const Outline& outline : region)
    {
      for (const vtkIdType point : outline.Points)
      {
        Point<3> place;
        this->Data->GetPoint(point, place.data());
        rings.Add(plane.ToPlane(place));
        points.push_back(point);
      }
      rings.EndRing();
    }
    const RingTriangles triangles = triangulateRings(rings, this->Ends);
    for (const RingTriangles::AddedPoint& added : triangles.Added)
    {
      points.push_back(this->AddPoint(points[static_cast<std::size_t>(added.Edge)],
        points[static_cast<std::size_t>(rings.Next(added.Edge))], added.Part));
    }
    for (const std::array<std::int32_t, 3>& corners : triangles.Corners)
    {
      const auto corner = [&](
                            std::size_t i) { return points[static_cast<std::size_t>(corners[i])]; };
      this->Areas->InsertNextCell({ corner(0), corner(1), corner(2) });
      this->CellsOfAreas.push_back(region.front().Cell);
    }
  }

  // Returns the id that the point will have: added points follow those of the input.
  vtkIdType AddPoint(vtkIdType first, vtkIdType second, double part)
  {
    Point<3> from;
    Point<3> to;
    this->Data->GetPoint(first, from.data());
    this->Data->GetPoint(second, to.data());
    this->Added.push_back({ from + part * (to - from), first, second, part });
    return this->Data->GetNumberOfPoints() + static_cast<vtkIdType>(this->Added.size()) - 1;
  }

  // The output replaces the data at the end, in one step, so that a Failure leaves them unchanged.
  void Attach()
  {
    vtkNew<vtkPolyData> filled;
    filled->ShallowCopy(this->Data);
    filled->SetLines(this->Lines);
    filled->SetPolys(this->Areas);
    // VTK would read past the end of an array that is too short.
    requireTuples(this->Data, "input");
    vtkCellData* cells = filled->GetCellData();
    cells->Initialize();
    cells->CopyAllOn();
    cells->CopyAllocate(this->Data->GetCellData(), this->Cells->GetNumberOfIds());
    // Each cell of the output gets the tuples of one cell of the input.
    cells->CopyData(this->Data->GetCellData(), this->Cells);
    if (!this->Added.empty())
    {
      this->AttachPoints(filled);
    }
    this->Data->ShallowCopy(filled);
  }

  void AttachPoints(vtkPolyData* filled)
  {
    const vtkIdType before = this->Data->GetNumberOfPoints();
    const vtkIdType count = before + static_cast<vtkIdType>(this->Added.size());
    vtkNew<vtkPoints> points;
    // Copies, as the input may share its points with other data sets. Coordinates keep their type.
    points->SetDataType(this->Data->GetPoints()->GetDataType());
    points->DeepCopy(this->Data->GetPoints());
    points->Resize(count);
    vtkPointData* from = this->Data->GetPointData();
    vtkPointData* to = filled->GetPointData();
    to->Initialize();
    to->CopyAllOn();
    to->InterpolateAllocate(from, count);
    to->CopyData(from, 0, before, 0);
    for (const AddedPoint& added : this->Added)
    {
      to->InterpolateEdge(
        from, points->InsertNextPoint(added.Place.data()), added.First, added.Second, added.Part);
    }
    filled->SetPoints(points);
  }

  vtkPolyData* const Data;
  Progress Ends; // nothing is aborted
  vtkNew<vtkCellArray> Lines;
  vtkNew<vtkCellArray> Areas;
  vtkNew<vtkIdList> Cells; // the cell of the input whose data each cell of the output has
  std::vector<vtkIdType> CellsOfAreas;
  std::vector<AddedPoint> Added;
};

} // namespace

void fillOutlines(vtkPolyData* data)
{
  OutlineFilling(data).Fill();
}

} // namespace RectifiedTransport::Bridge
