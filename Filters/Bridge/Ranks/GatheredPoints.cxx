// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/GatheredPoints.h"

#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Ranks/JoinedSurface.h"
#include "Bridge/Run/Failure.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkStructuredGridAppend.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <string>

namespace RectifiedTransport
{

namespace
{

bool hasDuplicates(vtkPointSet* set, int owner, unsigned char mask)
{
  const unsigned char* flags = ghostFlags(set, owner, "input point set");
  const vtkIdType count = set->GetNumberOfElements(owner);
  return flags &&
    std::any_of(flags, flags + count, [mask](unsigned char flag) { return (flag & mask) != 0; });
}

vtkSmartPointer<vtkPointSet> withoutGhostCells(vtkPointSet* set)
{
  if (!hasDuplicates(set, vtkDataObject::CELL, vtkDataSetAttributes::DUPLICATECELL))
  {
    return set;
  }
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(set->NewInstance());
  copy->ShallowCopy(set);
  if (auto* surface = vtkPolyData::SafeDownCast(copy))
  {
    surface->RemoveGhostCells();
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(copy))
  {
    grid->RemoveGhostCells();
  }
  return copy;
}

// The points that are no duplicates.
vtkSmartPointer<vtkPointSet> ownPoints(vtkPointSet* set)
{
  const unsigned char* flags = ghostFlags(set, vtkDataObject::POINT, "input point set");
  vtkNew<vtkIdList> kept;
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
  {
    if ((flags[i] & vtkDataSetAttributes::DUPLICATEPOINT) == 0)
    {
      kept->InsertNextId(i);
    }
  }
  const vtkIdType count = kept->GetNumberOfIds();
  vtkNew<vtkPoints> points;
  points->SetDataType(set->GetPoints()->GetDataType());
  set->GetPoints()->GetPoints(kept, points);
  vtkSmartPointer<vtkPointSet> own;
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < count; ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  if (vtkPolyData::SafeDownCast(set))
  {
    const auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetVerts(vertices);
    own = surface;
  }
  else
  {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetCells(VTK_VERTEX, vertices);
    own = grid;
  }
  own->SetPoints(points);
  own->GetPointData()->CopyAllOn();
  own->GetPointData()->CopyAllocate(set->GetPointData(), count);
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    places->SetId(i, i);
  }
  own->GetPointData()->CopyData(set->GetPointData(), kept, places);
  own->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  own->GetFieldData()->ShallowCopy(set->GetFieldData());
  return own;
}

vtkSmartPointer<vtkPointSet> withoutDuplicates(vtkPointSet* set, PointSetKind kind)
{
  if (!set || set->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  const bool hasPoints = kind == PointSetKind::Points &&
    hasDuplicates(set, vtkDataObject::POINT, vtkDataSetAttributes::DUPLICATEPOINT);
  vtkSmartPointer<vtkPointSet> own = hasPoints ? ownPoints(set) : withoutGhostCells(set);
  return own->GetNumberOfPoints() > 0 ? own : nullptr;
}

template <class AppendT>
vtkSmartPointer<vtkPointSet> appendWith(const std::vector<DataPart>& parts)
{
  vtkNew<AppendT> append;
  for (const DataPart& part : parts)
  {
    append->AddInputDataObject(part.Data);
  }
  append->Update();
  vtkSmartPointer<vtkPointSet> made = append->GetOutput();
  made->GetFieldData()->ShallowCopy(parts.front().Data->GetFieldData());
  return made;
}

void requireOneType(const std::vector<DataPart>& parts)
{
  for (const DataPart& part : parts)
  {
    if (part.Data->GetDataObjectType() != parts.front().Data->GetDataObjectType())
    {
      throw Failure("The input is a " + std::string(parts.front().Data->GetClassName()) +
        " on one rank and a " + part.Data->GetClassName() + " on another; it must be of one type");
    }
  }
}

vtkSmartPointer<vtkPointSet> joinParts(const std::vector<DataPart>& parts, PointSetKind kind)
{
  if (parts.empty())
  {
    return nullptr;
  }
  requireOneType(parts);
  vtkDataSet* first = parts.front().Data;
  if (parts.size() == 1)
  {
    return vtkPointSet::SafeDownCast(first);
  }
  if (vtkPolyData::SafeDownCast(first))
  {
    vtkSmartPointer<vtkPointSet> all = appendWith<vtkAppendPolyData>(parts);
    if (kind == PointSetKind::Surface)
    {
      all = joinSurface(vtkPolyData::SafeDownCast(all), parts);
    }
    return all;
  }
  return vtkStructuredGrid::SafeDownCast(first) ? appendWith<vtkStructuredGridAppend>(parts)
                                                : appendWith<vtkAppendFilter>(parts);
}

} // namespace

GatheredPoints::GatheredPoints(
  vtkPointSet* own, const Ranks& ranks, Receivers receivers, PointSetKind kind)
{
  std::vector<DataPart> parts;
  if (const vtkSmartPointer<vtkPointSet> points = withoutDuplicates(own, kind))
  {
    parts.push_back({ 0, "input", points });
  }
  const GatheredParts gathered = gatherDataParts(parts, ranks, receivers);
  if (!parts.empty() && gathered.OwnCount.front())
  {
    this->Given = vtkPointSet::SafeDownCast(parts.front().Data);
  }
  const std::vector<std::int64_t> counts =
    gatherValues<std::int64_t>(ranks, this->Given ? this->Given->GetNumberOfPoints() : 0);
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    this->FirstPoint += rank < static_cast<std::size_t>(ranks.Own()) ? counts[rank] : 0;
    this->Number += counts[rank];
  }
  this->Gathered = joinParts(gathered.Parts, kind);
}

} // namespace RectifiedTransport
