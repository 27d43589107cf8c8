// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/UnifiedTypes.h"

#include "Bridge/Data/TupleValues.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <set>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

// The forms that an array of one component has in the blocks that have cells.
struct ArrayForms
{
  std::set<int> Types;
  std::size_t Blocks = 0;
};

// A type that holds all values of arrays of some types.
int commonType(const std::set<int>& types)
{
  const auto has = [&](std::initializer_list<int> some) {
    return std::any_of(some.begin(), some.end(), [&](int type) { return types.count(type) > 0; });
  };
  const bool hasReal = has({ VTK_FLOAT, VTK_DOUBLE });
  const bool hasUnsigned = has({ VTK_UNSIGNED_LONG, VTK_UNSIGNED_LONG_LONG });
  const bool hasLong = hasUnsigned || has({ VTK_LONG, VTK_LONG_LONG, VTK_ID_TYPE });
  const bool isText = has({ VTK_STRING, VTK_VARIANT }) || hasUnsigned || (hasReal && hasLong);
  return isText ? VTK_STRING : hasReal ? VTK_DOUBLE : VTK_LONG_LONG;
}

vtkSmartPointer<vtkAbstractArray> converted(vtkAbstractArray* array, int type)
{
  auto made = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
  made->SetName(array->GetName());
  if (auto* texts = vtkStringArray::SafeDownCast(made))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      texts->InsertNextValue(tupleText(array, i));
    }
  }
  else
  {
    made->DeepCopy(array);
  }
  return made;
}

} // namespace

void unifyTypes(const std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  std::map<std::string, ArrayForms> arrays;
  std::size_t withCells = 0;
  const auto visit = [&](const auto& use) {
    for (const auto& part : parts)
    {
      vtkCellData* cells = part->GetCellData();
      for (int i = 0; part->GetNumberOfCells() > 0 && i < cells->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* array = cells->GetAbstractArray(i);
        if (array->GetName() && array->GetNumberOfComponents() == 1)
        {
          use(cells, array, arrays[array->GetName()]);
        }
      }
    }
  };
  for (const auto& part : parts)
  {
    withCells += part->GetNumberOfCells() > 0 ? 1 : 0;
  }
  visit([](vtkCellData*, vtkAbstractArray* array, ArrayForms& forms) {
    forms.Types.insert(array->GetDataType());
    ++forms.Blocks;
  });
  visit([&](vtkCellData* cells, vtkAbstractArray* array, const ArrayForms& forms) {
    const int type = commonType(forms.Types);
    if (forms.Types.size() > 1 && forms.Blocks == withCells && array->GetDataType() != type)
    {
      cells->AddArray(converted(array, type));
    }
  });
}

} // namespace RectifiedTransport::Bridge
