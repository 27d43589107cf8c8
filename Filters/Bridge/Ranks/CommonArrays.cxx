// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/CommonArrays.h"

#include "Bridge/Points/CopiedTuples.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

std::vector<ArrayKind> kindsOf(vtkDataSet* data)
{
  std::vector<ArrayKind> kinds;
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (!array || !array->GetName())
      {
        continue;
      }
      requireTuples(array, data->GetNumberOfElements(owner),
        owner == vtkDataObject::CELL ? "cell" : "point", "input");
      // Bits have no bytes of their own.
      const int type = array->GetDataType() == VTK_BIT ? VTK_UNSIGNED_CHAR : array->GetDataType();
      ArrayKind kind{ owner, type, array->GetNumberOfComponents(),
        attributes->IsArrayAnAttribute(i), array->GetName(), {} };
      for (int c = 0; array->HasAComponentName() && c < kind.Components; ++c)
      {
        const char* name = array->GetComponentName(c);
        kind.ComponentNames.emplace_back(name ? name : "");
      }
      kinds.push_back(kind);
    }
  }
  return kinds;
}

Bytes describe(const std::vector<ArrayKind>& kinds)
{
  std::ostringstream os;
  for (const ArrayKind& kind : kinds)
  {
    os << kind.Owner << ' ' << kind.Type << ' ' << kind.Components << ' ' << kind.Attribute << ' '
       << kind.ComponentNames.size() << ' ' << std::quoted(kind.Name);
    for (const std::string& name : kind.ComponentNames)
    {
      os << ' ' << std::quoted(name);
    }
    os << '\n';
  }
  const std::string text = os.str();
  return Bytes(text.begin(), text.end());
}

std::vector<ArrayKind> kindsFrom(const Bytes& bytes)
{
  std::istringstream is(std::string(bytes.begin(), bytes.end()));
  std::vector<ArrayKind> kinds;
  std::size_t names = 0;
  for (ArrayKind kind; is >> kind.Owner >> kind.Type >> kind.Components >> kind.Attribute >>
       names >> std::quoted(kind.Name);)
  {
    kind.ComponentNames.resize(names);
    for (std::string& name : kind.ComponentNames)
    {
      is >> std::quoted(name);
    }
    kinds.push_back(kind);
  }
  return kinds;
}

bool has(const std::vector<ArrayKind>& kinds, const ArrayKind& wanted)
{
  return std::any_of(
    kinds.begin(), kinds.end(), [&](const ArrayKind& kind) { return kind.IsLike(wanted); });
}

} // namespace

bool ArrayKind::IsGhosts() const
{
  return this->Name == vtkDataSetAttributes::GhostArrayName();
}

vtkSmartPointer<vtkDataArray> ArrayKind::Find(vtkDataSet* data) const
{
  vtkDataArray* array =
    data ? data->GetAttributes(this->Owner)->GetArray(this->Name.c_str()) : nullptr;
  if (!array)
  {
    return nullptr;
  }
  if (array->HasStandardMemoryLayout() && array->GetDataType() == this->Type)
  {
    return array;
  }
  const auto copy = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Type));
  copy->DeepCopy(array);
  return copy;
}

vtkSmartPointer<vtkDataArray> ArrayKind::Make(vtkDataSet* data, vtkIdType tuples) const
{
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Type));
  array->SetName(this->Name.c_str());
  array->SetNumberOfComponents(this->Components);
  for (std::size_t c = 0; c < this->ComponentNames.size(); ++c)
  {
    array->SetComponentName(static_cast<vtkIdType>(c), this->ComponentNames[c].c_str());
  }
  array->SetNumberOfTuples(tuples);
  vtkDataSetAttributes* attributes = data->GetAttributes(this->Owner);
  const int index = attributes->AddArray(array);
  if (this->Attribute >= 0)
  {
    attributes->SetActiveAttribute(index, this->Attribute);
  }
  return array;
}

std::vector<ArrayKind> commonArrays(vtkDataSet* data, const Ranks& ranks)
{
  const bool hasData = data && data->GetNumberOfPoints() > 0;
  // A first byte for whether there are data.
  Bytes own(1, hasData ? 1 : 0);
  const Bytes kinds = hasData ? describe(kindsOf(data)) : Bytes();
  own.insert(own.end(), kinds.begin(), kinds.end());
  std::vector<std::vector<ArrayKind>> all;
  for (const Bytes& bytes : ranks.Gather(own))
  {
    if (bytes.front() != 0)
    {
      all.push_back(kindsFrom(Bytes(bytes.begin() + 1, bytes.end())));
    }
  }
  std::vector<ArrayKind> common;
  for (const std::vector<ArrayKind>& others : all)
  {
    for (const ArrayKind& kind : others)
    {
      const bool isInAll = std::all_of(all.begin(), all.end(),
        [&](const std::vector<ArrayKind>& kindsThere) { return has(kindsThere, kind); });
      if ((isInAll || kind.IsGhosts()) && !has(common, kind))
      {
        common.push_back(kind);
      }
    }
  }
  return common;
}

void appendTuples(vtkDataArray* from, const std::vector<TupleRun>& runs, Bytes& to)
{
  std::size_t tuples = 0;
  for (const TupleRun& run : runs)
  {
    tuples += static_cast<std::size_t>(run.Count);
  }
  if (!from)
  {
    to.resize(to.size() + tuples);
    return;
  }
  const auto size = static_cast<std::size_t>(from->GetDataTypeSize()) *
    static_cast<std::size_t>(from->GetNumberOfComponents());
  to.reserve(to.size() + tuples * size);
  const auto* bytes = static_cast<const char*>(from->GetVoidPointer(0));
  for (const TupleRun& run : runs)
  {
    const char* first = bytes + static_cast<std::size_t>(run.First) * size;
    to.insert(to.end(), first, first + static_cast<std::size_t>(run.Count) * size);
  }
}

void copyTuples(vtkDataArray* from, const std::vector<TupleRun>& runs,
  const std::vector<TupleRun>& runsThere, vtkDataArray* to)
{
  const auto size = static_cast<std::size_t>(to->GetDataTypeSize()) *
    static_cast<std::size_t>(to->GetNumberOfComponents());
  const auto* here = from ? static_cast<const char*>(from->GetVoidPointer(0)) : nullptr;
  auto* there = static_cast<char*>(to->GetVoidPointer(0));
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const std::size_t length = static_cast<std::size_t>(runs[i].Count) * size;
    char* target = there + static_cast<std::size_t>(runsThere[i].First) * size;
    if (here)
    {
      std::copy_n(here + static_cast<std::size_t>(runs[i].First) * size, length, target);
    }
    else
    {
      std::fill_n(target, length, '\0');
    }
  }
}

const char* takeTuples(const char* from, const std::vector<TupleRun>& runs, vtkDataArray* to)
{
  const auto size = static_cast<std::size_t>(to->GetDataTypeSize()) *
    static_cast<std::size_t>(to->GetNumberOfComponents());
  auto* bytes = static_cast<char*>(to->GetVoidPointer(0));
  for (const TupleRun& run : runs)
  {
    const std::size_t length = static_cast<std::size_t>(run.Count) * size;
    std::copy_n(from, length, bytes + static_cast<std::size_t>(run.First) * size);
    from += length;
  }
  return from;
}

} // namespace RectifiedTransport::Bridge
