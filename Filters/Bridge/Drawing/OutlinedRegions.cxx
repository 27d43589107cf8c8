// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/OutlinedRegions.h"

#include "Bridge/Points/CellCheck.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Points/PlaneFrame.h"
#include "Core/Cartogram/RegionMap.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace RectifiedTransport
{

namespace
{

// Whether VTK gives each cell a value of its own, such as vtkOriginalCellIds of ParaView's
// geometry.
bool isOfCells(vtkCellData* data, vtkAbstractArray* array)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  return array == data->GetGlobalIds() || name.rfind("vtk", 0) == 0;
}

std::string valuesOf(vtkCellData* data, vtkIdType cell)
{
  std::string values;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (isOfCells(data, array))
    {
      continue;
    }
    const int components = array->GetNumberOfComponents();
    for (int c = 0; c < components; ++c)
    {
      values += array->GetVariantValue(cell * components + c).ToString() + '\n';
    }
  }
  return values;
}

class OutlineSearch
{
public:
  explicit OutlineSearch(vtkPolyData* data)
    : Data(data)
  {
  }

  OutlinedRegions Find()
  {
    requireReadableCells(this->Data, "input");
    this->FindRings();
    OutlinedRegions found;
    found.Normal = { 0.0, 0.0, 1.0 };
    if (!this->Plane.HasArea())
    {
      return found;
    }
    const PlaneFrame frame = this->Plane.Frame();
    found.Normal = frame.Normal();
    this->MakeMap(frame);
    for (const std::vector<std::int64_t>& rings : this->Map.RingsOfRegions())
    {
      std::vector<Outline> region;
      for (const std::int64_t ring : rings)
      {
        if (this->Map.AreaOf(ring) > 0.0)
        {
          region.push_back(this->OutlineOf(ring));
        }
      }
      if (!region.empty())
      {
        found.Regions.push_back(std::move(region));
      }
    }
    return found;
  }

private:
  Point<3> PlaceOf(vtkIdType point) const
  {
    Point<3> place;
    this->Data->GetPoint(point, place.data());
    return place;
  }

  void FindRings()
  {
    const unsigned char* ghosts = ghostFlags(this->Data, vtkDataObject::CELL, "input");
    vtkIdType cell = this->Data->GetNumberOfVerts();
    std::vector<Point<3>> places;
    const auto line =
      vtkSmartPointer<vtkCellArrayIterator>::Take(this->Data->GetLines()->NewIterator());
    for (line->GoToFirstCell(); !line->IsDoneWithTraversal(); line->GoToNextCell(), ++cell)
    {
      const vtkIdType* points = nullptr;
      vtkIdType count = 0;
      line->GetCurrentCell(count, points);
      const bool isGhost = ghosts && (ghosts[cell] & ghostCell);
      if (isGhost || count < 4 || this->PlaceOf(points[0]) != this->PlaceOf(points[count - 1]))
      {
        continue;
      }
      places.clear();
      for (vtkIdType i = 0; i + 1 < count; ++i)
      {
        places.push_back(this->PlaceOf(points[i]));
      }
      this->Plane.Add(places);
      this->Rings.push_back({ cell, { points, points + count - 1 } });
    }
  }

  void MakeMap(const PlaneFrame& frame)
  {
    std::map<std::string, std::int32_t> regions;
    std::vector<std::int64_t> numbers;
    for (const Outline& ring : this->Rings)
    {
      numbers.clear();
      for (const vtkIdType point : ring.Points)
      {
        numbers.push_back(this->Map.AddPoint(frame.ToPlane(this->PlaceOf(point))));
      }
      const auto region = regions.insert({ valuesOf(this->Data->GetCellData(), ring.Cell),
        static_cast<std::int32_t>(regions.size()) });
      this->Map.AddRing(region.first->second, numbers);
    }
    this->Map.FindHoles();
  }

  Outline OutlineOf(std::int64_t ring)
  {
    Outline& outline = this->Rings[static_cast<std::size_t>(ring)];
    if (this->Map.IsTurned(ring))
    {
      std::reverse(outline.Points.begin(), outline.Points.end());
    }
    return std::move(outline);
  }

  vtkPolyData* const Data;
  std::vector<Outline> Rings;
  RingPlane Plane;
  RegionMap Map;
};

} // namespace

OutlinedRegions findOutlinedRegions(vtkPolyData* data)
{
  return OutlineSearch(data).Find();
}

} // namespace RectifiedTransport
