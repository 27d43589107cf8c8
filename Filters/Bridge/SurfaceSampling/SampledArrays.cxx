// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SurfaceSampling/SampledArrays.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/DiskSurface.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <string>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 10;
// Units of a slice of work: each fills a tuple of every array.
constexpr std::int64_t Units = std::int64_t{ 1 } << 14;

// The arrays whose names `known` has not; `owner` is "point" or "cell".
void passNewArrays(vtkDataSetAttributes* from, vtkIdType tuples, const std::string& owner,
  vtkPointData* known, vtkDataSetAttributes* to)
{
  to->PassData(from);
  for (int i = to->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const char* name = to->GetAbstractArray(i)->GetName();
    if (name &&
      (known->HasArray(name) || std::string(name) == vtkDataSetAttributes::GhostArrayName()))
    {
      to->RemoveArray(i);
    }
    else if (to->GetAbstractArray(i)->GetNumberOfTuples() < tuples)
    {
      throw Failure("The " + owner + " array '" + (name ? name : "") +
        "' of the input surface has " +
        std::to_string(to->GetAbstractArray(i)->GetNumberOfTuples()) +
        " tuples; it must have one for each of the " + std::to_string(tuples) + " " + owner + "s");
    }
  }
}

void requireMemoryFor(vtkDataSetAttributes* arrays, std::int64_t tuples)
{
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = arrays->GetAbstractArray(i);
    requireMemory(
      std::string("the array ") + (array->GetName() ? array->GetName() : "without name"),
      static_cast<double>(tuples) * array->GetNumberOfComponents() *
        std::max(1, array->GetDataTypeSize()));
  }
}

void addAll(vtkPointData* from, vtkPointData* to)
{
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = from->GetAbstractArray(i);
    const int index = to->AddArray(array);
    const int attribute = from->IsArrayAnAttribute(i);
    if (attribute >= 0 && !to->GetAbstractAttribute(attribute))
    {
      to->SetActiveAttribute(index, attribute);
    }
  }
}

} // namespace

void sampleArrays(const DiskSurface& surface, const LargeBuffer<PlaceOnTriangle>& places,
  Progress& progress, double end, vtkPointData* output)
{
  const std::int64_t count = places.size();
  vtkPolyData* mesh = surface.Triangulated();
  progress.BeginStage(0.5 * (progress.StageEnd() + end));
  vtkNew<vtkPointData> ofPoints;
  passNewArrays(mesh->GetPointData(), mesh->GetNumberOfPoints(), "point", output, ofPoints);
  requireMemoryFor(ofPoints, count);
  vtkNew<vtkPointData> sampled;
  sampled->InterpolateAllocate(ofPoints, count);
  vtkNew<vtkIdList> corners;
  corners->SetNumberOfIds(3);
  progress.ForInOrder(
    count, Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        PlaceOnTriangle place = places.data()[i];
        const std::int64_t* points = surface.Disk().Triangle(place.Triangle);
        std::copy_n(points, 3, corners->GetPointer(0));
        sampled->InterpolatePoint(
          ofPoints, static_cast<vtkIdType>(i), corners, place.Weights.data());
      }
    },
    Units);
  addAll(sampled, output);

  progress.BeginStage(end);
  vtkNew<vtkPointData> ofCells;
  passNewArrays(mesh->GetCellData(), mesh->GetNumberOfCells(), "cell", output, ofCells);
  if (vtkDataArray* ids = ofCells->GetGlobalIds())
  {
    ofCells->RemoveArray(ids->GetName()); // would be of several particles
  }
  requireMemoryFor(ofCells, count);
  for (int attribute = 0; attribute < vtkDataSetAttributes::NUM_ATTRIBUTES; ++attribute)
  {
    ofCells->SetActiveAttribute(-1, attribute);
  }
  vtkNew<vtkPointData> copied;
  copied->CopyAllocate(ofCells, count);
  progress.ForInOrder(
    count, Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        copied->CopyData(
          ofCells, surface.CellOf(places.data()[i].Triangle), static_cast<vtkIdType>(i));
      }
    },
    Units);
  addAll(copied, output);
}

} // namespace RectifiedTransport
