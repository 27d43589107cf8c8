// SPDX-License-Identifier: BSD-3-Clause
#include "Outcome.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace Campaign
{

namespace
{

class Mixer
{
public:
  explicit Mixer(std::uint64_t seed)
    : Value(seed)
  {
  }
  void Word(std::uint64_t word)
  {
    this->Value = (this->Value ^ word) * 0x9e3779b97f4a7c15;
    this->Value ^= this->Value >> 29;
  }
  void Real(double value)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(value));
    this->Word(std::isnan(value) ? 1 : bits); // which NaN does not matter
  }
  void Text(const char* text)
  {
    for (; text && *text; ++text)
    {
      this->Word(static_cast<unsigned char>(*text));
    }
    this->Word(0);
  }

  void Array(vtkAbstractArray* array)
  {
    this->Text(array->GetName());
    this->Word(static_cast<std::uint64_t>(array->GetDataType()));
    this->Word(static_cast<std::uint64_t>(array->GetNumberOfComponents()));
    this->Word(static_cast<std::uint64_t>(array->GetNumberOfTuples()));
    auto* numbers = vtkDataArray::SafeDownCast(array);
    for (vtkIdType i = 0; numbers && i < numbers->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < numbers->GetNumberOfComponents(); ++c)
      {
        this->Real(numbers->GetComponent(i, c));
      }
    }
  }

  void Arrays(vtkFieldData* data)
  {
    this->Word(static_cast<std::uint64_t>(data->GetNumberOfArrays()));
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      this->Array(data->GetAbstractArray(i));
    }
    if (auto* attributes = vtkDataSetAttributes::SafeDownCast(data))
    {
      for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
      {
        vtkAbstractArray* active = attributes->GetAbstractAttribute(type);
        this->Text(active ? active->GetName() : "");
      }
    }
  }

  template <class Grid>
  void Axes(Grid* grid)
  {
    for (vtkDataArray* places :
      { grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates() })
    {
      if (places)
      {
        this->Array(places);
      }
    }
  }

  void Image(vtkImageData* image)
  {
    for (int a = 0; a < 6; ++a)
    {
      this->Word(static_cast<std::uint64_t>(image->GetExtent()[a]));
    }
    for (int a = 0; a < 3; ++a)
    {
      this->Real(image->GetOrigin()[a]);
      this->Real(image->GetSpacing()[a]);
      for (int b = 0; b < 3; ++b)
      {
        this->Real(image->GetDirectionMatrix()->GetElement(a, b));
      }
    }
  }

  void Set(vtkPointSet* set)
  {
    if (set->GetPoints())
    {
      this->Array(set->GetPoints()->GetData());
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < set->GetNumberOfCells(); ++i)
    {
      set->GetCellPoints(i, ids);
      this->Word(static_cast<std::uint64_t>(set->GetCellType(i)));
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        this->Word(static_cast<std::uint64_t>(ids->GetId(k)));
      }
    }
  }

  std::uint64_t Value;
};

} // namespace

std::uint64_t digest(vtkDataObject* data, std::uint64_t seed)
{
  Mixer mixer(seed);
  if (!data)
  {
    return mixer.Value;
  }
  mixer.Text(data->GetClassName());
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      mixer.Value = digest(leaves->GetCurrentDataObject(), mixer.Value);
    }
    return mixer.Value;
  }
  if (isEmpty(data))
  {
    return mixer.Value; // where an empty image lies is what was there before
  }
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    mixer.Image(image);
  }
  if (auto* set = vtkPointSet::SafeDownCast(data))
  {
    mixer.Set(set);
  }
  for (const int owner :
    { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD, vtkDataObject::ROW })
  {
    if (vtkFieldData* arrays = data->GetAttributesAsFieldData(owner))
    {
      mixer.Arrays(arrays);
    }
  }
  return mixer.Value;
}

std::uint64_t digestOfArrays(vtkDataObject* data, std::uint64_t seed)
{
  Mixer mixer(seed);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      mixer.Value = digestOfArrays(leaves->GetCurrentDataObject(), mixer.Value);
    }
    return mixer.Value;
  }
  auto* set = vtkPointSet::SafeDownCast(data);
  if (set && set->GetPoints())
  {
    mixer.Array(set->GetPoints()->GetData());
  }
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    mixer.Image(image);
  }
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    mixer.Axes(grid);
  }
  if (auto* trees = vtkHyperTreeGrid::SafeDownCast(data))
  {
    mixer.Axes(trees);
  }
  std::vector<vtkCellArray*> cells;
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    cells = { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() };
  }
  else if (auto* mesh = vtkUnstructuredGrid::SafeDownCast(data))
  {
    cells = { mesh->GetCells() };
  }
  for (vtkCellArray* some : cells)
  {
    if (some)
    {
      mixer.Array(some->GetOffsetsArray());
      mixer.Array(some->GetConnectivityArray());
    }
  }
  for (const int owner :
    { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD, vtkDataObject::ROW })
  {
    if (vtkFieldData* arrays = data ? data->GetAttributesAsFieldData(owner) : nullptr)
    {
      mixer.Arrays(arrays);
    }
  }
  return mixer.Value;
}

bool isEmpty(vtkDataObject* data)
{
  if (auto* set = vtkDataSet::SafeDownCast(data))
  {
    return set->GetNumberOfPoints() == 0 && set->GetNumberOfCells() == 0 &&
      set->GetPointData()->GetNumberOfArrays() == 0 && set->GetCellData()->GetNumberOfArrays() == 0;
  }
  if (auto* table = vtkTable::SafeDownCast(data))
  {
    return table->GetNumberOfRows() == 0;
  }
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      if (!isEmpty(leaves->GetCurrentDataObject()))
      {
        return false;
      }
    }
  }
  return true;
}

} // namespace Campaign
