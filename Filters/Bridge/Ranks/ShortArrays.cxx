// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/ShortArrays.h"

#include "Core/Parallel/Ranks.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

std::string nameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

bool isShort(vtkAbstractArray* array, vtkDataSet* data, int owner)
{
  return array->GetNumberOfTuples() < data->GetNumberOfElements(owner);
}

} // namespace

ShortArrays::ShortArrays(vtkDataSet* data)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data ? data->GetAttributes(owner) : nullptr;
    for (int i = 0; attributes && i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = attributes->GetAbstractArray(i);
      if (isShort(array, data, owner))
      {
        this->Arrays.push_back({ owner, array->GetDataType(), array->GetNumberOfComponents(),
          attributes->IsArrayAnAttribute(i), nameOf(array) });
      }
    }
  }
}

ShortArrays ShortArrays::FromText(const std::string& text)
{
  ShortArrays made;
  std::istringstream is(text);
  for (Array array; is >> array.Owner >> array.Type >> array.Components >> array.Attribute >>
       std::quoted(array.Name);)
  {
    made.Arrays.push_back(array);
  }
  return made;
}

void ShortArrays::Add(const ShortArrays& others)
{
  for (const Array& other : others.Arrays)
  {
    if (std::none_of(this->Arrays.begin(), this->Arrays.end(), [&other](const Array& array) {
          return array.Owner == other.Owner && array.Name == other.Name;
        }))
    {
      this->Arrays.push_back(other);
    }
  }
}

void ShortArrays::AddFromRanks(const Ranks& ranks)
{
  const std::string own = this->Text();
  for (const Bytes& text : ranks.Gather(Bytes(own.begin(), own.end())))
  {
    this->Add(FromText(std::string(text.begin(), text.end())));
  }
}

std::string ShortArrays::Text() const
{
  std::ostringstream os;
  for (const Array& array : this->Arrays)
  {
    os << array.Owner << ' ' << array.Type << ' ' << array.Components << ' ' << array.Attribute
       << ' ' << std::quoted(array.Name) << '\n';
  }
  return os.str();
}

void ShortArrays::RemoveFrom(vtkDataSet* data) const
{
  for (const Array& array : this->Arrays)
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(array.Owner);
    for (int i = attributes->GetNumberOfArrays(); i-- > 0;)
    {
      vtkAbstractArray* other = attributes->GetAbstractArray(i);
      if (nameOf(other) == array.Name && (!array.Name.empty() || isShort(other, data, array.Owner)))
      {
        attributes->RemoveArray(i);
      }
    }
  }
}

void ShortArrays::AddEmptyTo(vtkDataSet* data) const
{
  for (const Array& array : this->Arrays)
  {
    if (array.Name.empty())
    {
      continue;
    }
    const auto empty =
      vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(array.Type));
    empty->SetName(array.Name.c_str());
    empty->SetNumberOfComponents(array.Components);
    vtkDataSetAttributes* attributes = data->GetAttributes(array.Owner);
    const int index = attributes->AddArray(empty);
    if (array.Attribute >= 0)
    {
      attributes->SetActiveAttribute(index, array.Attribute);
    }
  }
}

} // namespace RectifiedTransport::Bridge
