// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/TruncatedArrays.h"

#include "Bridge/Ranks/CommonArrays.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

bool isShort(vtkAbstractArray* array, vtkDataSet* data, int owner)
{
  return array->GetNumberOfTuples() < data->GetNumberOfElements(owner);
}

} // namespace

TruncatedArrays::TruncatedArrays(vtkDataSet* data)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data ? data->GetAttributes(owner) : nullptr;
    for (int i = 0; attributes && i < attributes->GetNumberOfArrays(); ++i)
    {
      if (isShort(attributes->GetAbstractArray(i), data, owner))
      {
        this->Arrays.push_back(kindOf(attributes, i, owner));
      }
    }
  }
}

void TruncatedArrays::Add(const TruncatedArrays& others)
{
  for (const ArrayKind& other : others.Arrays)
  {
    if (std::none_of(this->Arrays.begin(), this->Arrays.end(), [&other](const ArrayKind& array) {
          return array.Owner == other.Owner && array.Name == other.Name;
        }))
    {
      this->Arrays.push_back(other);
    }
  }
}

void TruncatedArrays::AddFromRanks(const Ranks& ranks)
{
  for (const std::string& text : gatherTexts(ranks, this->Text()))
  {
    this->Add(TruncatedArrays(text));
  }
}

void TruncatedArrays::RemoveFrom(vtkDataSet* data) const
{
  for (const ArrayKind& array : this->Arrays)
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(array.Owner);
    for (int i = attributes->GetNumberOfArrays(); i-- > 0;)
    {
      if (kindOf(attributes, i, array.Owner).Name == array.Name &&
        (!array.Name.empty() || isShort(attributes->GetAbstractArray(i), data, array.Owner)))
      {
        attributes->RemoveArray(i);
      }
    }
  }
}

void TruncatedArrays::AddEmptyTo(vtkDataSet* data) const
{
  for (const ArrayKind& array : this->Arrays)
  {
    if (!array.Name.empty())
    {
      addArray(array, data, 0);
    }
  }
}

} // namespace RectifiedTransport::Bridge
