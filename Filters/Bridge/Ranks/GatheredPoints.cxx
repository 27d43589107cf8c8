// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/GatheredPoints.h"

#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Ranks/JoinedSurface.h"
#include "Bridge/Ranks/SharedPoints.h"
#include "Bridge/Run/Failure.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
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

vtkSmartPointer<vtkPointSet> withoutGhostCells(vtkPointSet* set)
{
  const unsigned char* flags = ghostFlags(set, vtkDataObject::CELL, "input point set");
  const bool hasDuplicates = flags &&
    std::any_of(flags, flags + set->GetNumberOfCells(),
      [](unsigned char flag) { return (flag & vtkDataSetAttributes::DUPLICATECELL) != 0; });
  if (!hasDuplicates)
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

// What counts of this rank's set; nullptr for nothing.
vtkSmartPointer<vtkPointSet> countedPart(vtkPointSet* own, PointSetKind kind, const Ranks& ranks)
{
  vtkSmartPointer<vtkPointSet> part;
  if (kind == PointSetKind::Points)
  {
    part = countedPoints(own, ranks);
  }
  else if (own && own->GetNumberOfPoints() > 0)
  {
    part = withoutGhostCells(own);
  }
  return part && part->GetNumberOfPoints() > 0 ? part : nullptr;
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
  if (!ranks.AreSeveral())
  {
    this->Gathered = own;
    return;
  }
  std::vector<DataPart> parts;
  if (const vtkSmartPointer<vtkPointSet> points = countedPart(own, kind, ranks))
  {
    parts.push_back({ 0, "input", points });
  }
  this->Gathered = joinParts(gatherDataParts(parts, ranks, receivers).Parts, kind);
}

} // namespace RectifiedTransport
