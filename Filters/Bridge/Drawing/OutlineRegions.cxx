// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/OutlineRegions.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Data/TupleValues.h"
#include "Core/Overlap/RingShape.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>

namespace RectifiedTransport::Bridge
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

// The arrays whose values tell regions apart.
// Readers of maps repeat the attributes of a country for each of its outlines, so that equal
// values of all arrays mean one region. Arrays that are too short throw Failure: their tuples are
// read below.
std::vector<vtkAbstractArray*> arraysOfRegions(vtkPolyData* data)
{
  std::vector<vtkAbstractArray*> arrays;
  vtkCellData* cells = data->GetCellData();
  for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = cells->GetAbstractArray(i);
    if (!isOfCells(cells, array))
    {
      requireTuples(array, data->GetNumberOfCells(), "cell", "input");
      arrays.push_back(array);
    }
  }
  return arrays;
}

// One pass over the lines of the data: each line that is an outline joins the region of its values.
class OutlineSearch
{
public:
  explicit OutlineSearch(vtkPolyData* data)
    : Data(data)
    , Ghosts(ghostFlags(data, vtkDataObject::CELL, "input"))
  {
    // Before any cell is read: VTK does not check the ids of points, which a damaged file may have
    // wrong.
    requireReadableCells(data, "input");
    this->Arrays = arraysOfRegions(data);
  }

  OutlineRegions Find()
  {
    // Lines follow the vertices in the numbering of cells. The iterator gives ids without a copy
    // where the array has vtkIdType.
    vtkIdType cell = this->Data->GetNumberOfVerts();
    const auto line =
      vtkSmartPointer<vtkCellArrayIterator>::Take(this->Data->GetLines()->NewIterator());
    for (line->GoToFirstCell(); !line->IsDoneWithTraversal(); line->GoToNextCell(), ++cell)
    {
      const vtkIdType* points = nullptr;
      vtkIdType count = 0;
      line->GetCurrentCell(count, points);
      if (this->IsOutline(cell, count, points))
      {
        this->Add({ cell, { points, points + count - 1 } });
      }
    }
    // The plane of the sum of all rings; without an outline the default one stays.
    if (this->Plane.HasArea())
    {
      this->Found.Plane = this->Plane.Frame();
    }
    return std::move(this->Found);
  }

private:
  Point<3> PlaceOf(vtkIdType point) const
  {
    Point<3> place;
    this->Data->GetPoint(point, place.data());
    return place;
  }

  // Whether a line is closed, by coordinates, as readers may repeat the first point under another
  // id. Sets Places to its points without the last one. A triangle is the shortest, with 4 ids.
  bool IsOutline(vtkIdType cell, vtkIdType count, const vtkIdType* points)
  {
    const bool isGhost = this->Ghosts && (this->Ghosts[cell] & ghostCell);
    if (isGhost || count < 4 || this->PlaceOf(points[0]) != this->PlaceOf(points[count - 1]))
    {
      return false;
    }
    this->Places.clear();
    for (vtkIdType i = 0; i + 1 < count; ++i)
    {
      this->Places.push_back(this->PlaceOf(points[i]));
    }
    return areFinite(this->Places) && hasArea(this->Places);
  }

  // Adds an outline whose points are in Places. Regions are numbered in the order of their first
  // outlines, so that drawings do not depend on hashes.
  void Add(Outline&& outline)
  {
    this->Plane.Add(this->Places);
    this->Values.clear();
    for (vtkAbstractArray* array : this->Arrays)
    {
      appendTupleKey(array, outline.Cell, this->Values);
    }
    const auto region = this->Numbers.insert({ this->Values, this->Found.Regions.size() });
    if (region.second)
    {
      this->Found.Regions.emplace_back();
    }
    this->Found.Regions[region.first->second].push_back(std::move(outline));
  }

  vtkPolyData* const Data;
  const unsigned char* const Ghosts;
  std::vector<vtkAbstractArray*> Arrays;
  RingPlane Plane;
  OutlineRegions Found;
  std::unordered_map<std::string, std::size_t> Numbers; // the index of each region, by its values
  std::vector<Point<3>> Places;                         // the points of one line
  std::string Values;
};

} // namespace

OutlineRegions findOutlineRegions(vtkPolyData* data)
{
  return OutlineSearch(data).Find();
}

} // namespace RectifiedTransport::Bridge
