// SPDX-License-Identifier: BSD-3-Clause
#include "Display/FilledOutlines.h"

#include "Bridge/Drawing/OutlinedRegions.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkContourTriangulator.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
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

vtkIdType addTriangles(vtkPolyData* data, const std::vector<Outline>& region,
  const Point<3>& normal, vtkCellArray* polygons)
{
  vtkNew<vtkPolyData> rings;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIdList> ring;
  for (const Outline& outline : region)
  {
    ring->SetNumberOfIds(static_cast<vtkIdType>(outline.Points.size()));
    std::copy(outline.Points.begin(), outline.Points.end(), ring->begin());
    addLoop(ring, lines);
  }
  rings->SetPoints(data->GetPoints());
  rings->SetLines(lines);
  const vtkIdType before = polygons->GetNumberOfCells();
  vtkContourTriangulator::TriangulateContours(
    rings, 0, lines->GetNumberOfCells(), polygons, normal.data());
  return polygons->GetNumberOfCells() - before;
}

} // namespace

void fillOutlines(vtkPolyData* data)
{
  const OutlinedRegions outlines = findOutlinedRegions(data);
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> polygons;
  lines->DeepCopy(data->GetLines());
  polygons->DeepCopy(data->GetPolys());
  vtkNew<vtkIdList> cells; // of the input, whose data the cells of the output have
  const auto add = [&cells](vtkIdType first, vtkIdType count) {
    for (vtkIdType i = 0; i < count; ++i)
    {
      cells->InsertNextId(first + i);
    }
  };
  const vtkIdType firstPolygon = data->GetNumberOfVerts() + data->GetNumberOfLines();
  add(0, firstPolygon);
  vtkNew<vtkIdList> polygon;
  for (vtkIdType i = 0; i < data->GetNumberOfPolys(); ++i)
  {
    data->GetPolys()->GetCellAtId(i, polygon);
    if (polygon->GetNumberOfIds() > 0)
    {
      addLoop(polygon, lines);
      cells->InsertNextId(firstPolygon + i);
    }
  }
  add(firstPolygon, data->GetNumberOfPolys());
  for (const std::vector<Outline>& region : outlines.Regions)
  {
    const vtkIdType count = addTriangles(data, region, outlines.Normal, polygons);
    for (vtkIdType i = 0; i < count; ++i)
    {
      cells->InsertNextId(region.front().Cell);
    }
  }
  add(firstPolygon + data->GetNumberOfPolys(), data->GetNumberOfStrips());

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
