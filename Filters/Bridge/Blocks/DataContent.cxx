// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/DataContent.h"

#include "Bridge/Run/Fingerprint.h"

#include "vtkDataArray.h"

#include <cstring>

namespace RectifiedTransport::Bridge
{

void DataContent::AddNumber(std::uint64_t number)
{
  this->Numbers.push_back(number);
}

void DataContent::AddNumbers(const double* numbers, int count)
{
  for (int i = 0; i < count; ++i)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, numbers + i, sizeof(double));
    this->Numbers.push_back(bits);
  }
}

void DataContent::AddTime(std::uint64_t time)
{
  this->Times.push_back(time);
}

void DataContent::AddTimeOf(vtkObject* object)
{
  this->Times.push_back(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(object)));
  this->Times.push_back(object ? static_cast<std::uint64_t>(object->GetMTime()) : 0);
}

void DataContent::AddArray(vtkAbstractArray* array)
{
  this->AddNumber(array ? 1 : 0);
  this->AddTimeOf(array);
  if (!array)
  {
    return;
  }
  for (const char* letter = array->GetName(); letter && *letter; ++letter)
  {
    this->AddNumber(static_cast<unsigned char>(*letter));
  }
  this->AddNumber(static_cast<std::uint64_t>(array->GetDataType()));
  this->AddNumber(static_cast<std::uint64_t>(array->GetNumberOfComponents()));
  this->AddNumber(static_cast<std::uint64_t>(array->GetNumberOfTuples()));
  if (auto* numeric = vtkDataArray::SafeDownCast(array))
  {
    this->Arrays.push_back(numeric);
    return;
  }
  // There is no hash of texts: another array is another content.
  this->AddNumber(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(array)));
  this->AddNumber(static_cast<std::uint64_t>(array->GetMTime()));
}

bool DataContent::IsSameAs(DataContent& before, Progress& progress)
{
  if (!before.IsHashed || this->Numbers != before.Numbers)
  {
    return false;
  }
  if (this->Times == before.Times)
  {
    return true;
  }
  if (before.Hash == 0 || this->HashOf(progress) != before.Hash)
  {
    return false;
  }
  before.Times = this->Times;
  return true;
}

void DataContent::Keep(Progress& progress)
{
  this->HashOf(progress);
  this->Arrays.clear();
}

std::uint64_t DataContent::HashOf(Progress& progress)
{
  if (!this->IsHashed)
  {
    this->Hash = fingerprint(this->Arrays, progress);
    this->IsHashed = true;
  }
  return this->Hash;
}

} // namespace RectifiedTransport::Bridge
