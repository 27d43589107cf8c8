// SPDX-License-Identifier: BSD-3-Clause
#include "Display/FilledOutlines.h"

#include "Bridge/Drawing/OutlinedRegions.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkContourTriangulator.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Around a polygon.
void addLoop(vtkIdList* polygon, vtkCellArray* lines)
{
  lines->InsertNextCell(static_cast<int>(polygon->GetNumberOfIds() + 1));
  for (const vtkIdType point : *polygon)
  {
    lines->InsertCellPoint(point);
  }
  lines->InsertCellPoint(polygon->GetId(0));
}

// Twice, as a vector; relative to a point, so that places far from the origin lose no digits.
Point<3> areaVectorOf(vtkPoints* points, vtkIdList* ring)
{
  double origin[3];
  double before[3];
  Point<3> sum{ 0.0, 0.0, 0.0 };
  points->GetPoint(ring->GetId(0), origin);
  for (vtkIdType i = 1; i <= ring->GetNumberOfIds(); ++i)
  {
    double place[3];
    points->GetPoint(ring->GetId(i % ring->GetNumberOfIds()), place);
    vtkMath::Subtract(place, origin, place);
    if (i > 1)
    {
      double cross[3];
      vtkMath::Cross(before, place, cross);
      vtkMath::Add(sum.data(), cross, sum.data());
    }
    std::copy_n(place, 3, before);
  }
  return sum;
}

// Twice, about the normal.
double areaOf(vtkPoints* points, vtkIdList* ring, const Point<3>& normal)
{
  return vtkMath::Dot(areaVectorOf(points, ring).data(), normal.data());
}

using Rings = std::vector<vtkSmartPointer<vtkIdList>>;

// Rings that turn counter-clockwise, and holes that turn the other way, as triangles.
class RingTriangles
{
public:
  RingTriangles(vtkPoints* points, const Rings& rings, const Point<3>& normal)
    : Points(points)
    , Normal(normal)
  {
    double area = 0.0;
    for (vtkIdList* ring : rings)
    {
      area += areaOf(points, ring, normal);
    }
    this->Keep(this->OfContours(rings), area);
    // Robust for holes and touching rings, but it leaves gaps at some polygons of pixels.
    constexpr double exact = 1e-6;
    if (rings.size() == 1 && this->Error > exact * area)
    {
      this->Keep(this->OfPolygon(rings.front()), area);
    }
  }

  vtkCellArray* Best() const { return this->Triangles; }

private:
  void Keep(vtkCellArray* triangles, double area)
  {
    double sum = 0.0;
    vtkNew<vtkIdList> corners;
    for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i)
    {
      triangles->GetCellAtId(i, corners);
      sum += std::abs(areaOf(this->Points, corners, this->Normal));
    }
    if (!this->Triangles || std::abs(sum - area) < this->Error)
    {
      this->Triangles = triangles;
      this->Error = std::abs(sum - area);
    }
  }

  vtkSmartPointer<vtkCellArray> OfContours(const Rings& rings) const
  {
    vtkNew<vtkCellArray> loops;
    for (vtkIdList* ring : rings)
    {
      addLoop(ring, loops);
    }
    vtkNew<vtkPolyData> contours;
    contours->SetPoints(this->Points);
    contours->SetLines(loops);
    auto triangles = vtkSmartPointer<vtkCellArray>::New();
    vtkContourTriangulator::TriangulateContours(
      contours, 0, loops->GetNumberOfCells(), triangles, this->Normal.data());
    return triangles;
  }

  vtkSmartPointer<vtkCellArray> OfPolygon(vtkIdList* ring) const
  {
    vtkNew<vtkPolygon> polygon;
    polygon->Initialize(
      static_cast<int>(ring->GetNumberOfIds()), ring->GetPointer(0), this->Points);
    vtkNew<vtkIdList> corners;
    vtkNew<vtkPoints> places;
    polygon->Triangulate(0, corners, places);
    auto triangles = vtkSmartPointer<vtkCellArray>::New();
    for (vtkIdType i = 0; i + 2 < corners->GetNumberOfIds(); i += 3)
    {
      triangles->InsertNextCell(3, corners->GetPointer(i));
    }
    return triangles;
  }

  vtkPoints* const Points;
  const Point<3>& Normal;
  vtkSmartPointer<vtkCellArray> Triangles;
  double Error = 0.0; // of the area
};

// Returns how many cells are added.
vtkIdType fillRegion(vtkPolyData* data, const std::vector<Outline>& region, const Point<3>& normal,
  vtkCellArray* areas)
{
  Rings rings;
  for (const Outline& outline : region)
  {
    auto ring = vtkSmartPointer<vtkIdList>::New();
    ring->SetNumberOfIds(static_cast<vtkIdType>(outline.Points.size()));
    std::copy(outline.Points.begin(), outline.Points.end(), ring->begin());
    rings.push_back(ring);
  }
  const RingTriangles triangles(data->GetPoints(), rings, normal);
  areas->Append(triangles.Best());
  return triangles.Best()->GetNumberOfCells();
}

// What views draw of a polygon that is not convex may be wrong.
vtkIdType fillPolygon(vtkPolyData* data, vtkIdList* polygon, vtkCellArray* areas)
{
  constexpr vtkIdType few = 4;
  Point<3> normal = areaVectorOf(data->GetPoints(), polygon);
  if (polygon->GetNumberOfIds() <= few || !(vtkMath::Normalize(normal.data()) > 0.0))
  {
    areas->InsertNextCell(polygon);
    return 1;
  }
  auto ring = vtkSmartPointer<vtkIdList>::New();
  ring->DeepCopy(polygon);
  const RingTriangles triangles(data->GetPoints(), { ring }, normal);
  areas->Append(triangles.Best());
  return triangles.Best()->GetNumberOfCells();
}

} // namespace

void fillOutlines(vtkPolyData* data)
{
  const OutlinedRegions outlines = findOutlinedRegions(data);
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> polygons;
  lines->DeepCopy(data->GetLines());
  vtkNew<vtkIdList> cells; // of the input, whose data the cells of the output have
  const vtkIdType firstPolygon = data->GetNumberOfVerts() + data->GetNumberOfLines();
  const vtkIdType firstStrip = firstPolygon + data->GetNumberOfPolys();
  const vtkIdType last = data->GetNumberOfCells();
  for (vtkIdType cell = 0; cell < firstPolygon; ++cell)
  {
    cells->InsertNextId(cell);
  }
  vtkNew<vtkIdList> ofAreas;
  const auto add = [&ofAreas](vtkIdType cell, vtkIdType count) {
    for (vtkIdType i = 0; i < count; ++i)
    {
      ofAreas->InsertNextId(cell);
    }
  };
  vtkNew<vtkIdList> polygon;
  for (vtkIdType cell = firstPolygon; cell < firstStrip; ++cell)
  {
    data->GetPolys()->GetCellAtId(cell - firstPolygon, polygon);
    if (polygon->GetNumberOfIds() > 0)
    {
      addLoop(polygon, lines);
      cells->InsertNextId(cell);
      add(cell, fillPolygon(data, polygon, polygons));
    }
  }
  for (const std::vector<Outline>& region : outlines.Regions)
  {
    add(region.front().Cell, fillRegion(data, region, outlines.Normal, polygons));
  }
  for (const vtkIdType cell : *ofAreas)
  {
    cells->InsertNextId(cell);
  }
  for (vtkIdType cell = firstStrip; cell < last; ++cell)
  {
    cells->InsertNextId(cell);
  }

  vtkNew<vtkPolyData> filled;
  filled->ShallowCopy(data);
  filled->SetLines(lines);
  filled->SetPolys(polygons);
  filled->GetCellData()->Initialize();
  filled->GetCellData()->CopyAllOn();
  filled->GetCellData()->CopyAllocate(data->GetCellData(), cells->GetNumberOfIds());
  for (vtkIdType i = 0; i < cells->GetNumberOfIds(); ++i)
  {
    filled->GetCellData()->CopyData(data->GetCellData(), cells->GetId(i), i);
  }
  data->ShallowCopy(filled);
}

} // namespace RectifiedTransport
