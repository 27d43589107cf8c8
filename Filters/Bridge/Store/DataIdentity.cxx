// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Store/DataIdentity.h"

#include "Bridge/Run/Fingerprint.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Tables/Reading/DensityRules.h"

#include "vtkDataArray.h"

#include <cstring>

namespace RectifiedTransport::Bridge
{

// Doubles are compared by their bits: -0 differs from 0, and NaN equals itself.
void DataIdentity::AddNumbers(const double* numbers, int count)
{
  for (int i = 0; i < count; ++i)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, numbers + i, sizeof(double));
    this->Numbers.push_back(bits);
  }
}

void DataIdentity::AddGrid(const ImageGrid& grid)
{
  // Six ends of the extent, 15 numbers of the geometry, and the association.
  for (const int end : grid.Extent())
  {
    this->AddNumber(static_cast<std::uint64_t>(end));
  }
  this->AddNumbers(grid.Origin().data(), 3);
  this->AddNumbers(grid.Spacing().data(), 3);
  this->AddNumbers(grid.Direction().data(), 9);
  this->AddNumber(grid.IsOnPoints() ? 1 : 0);
}

void DataIdentity::AddOptions(const FlowOptions& options)
{
  // All members of FlowOptions, in groups of one type: a result may depend on any of them.
  for (const int number : { static_cast<int>(options.Integrator), options.NumberOfSteps,
         options.LeastSteps, options.NeedsEstimate ? 1 : 0, static_cast<int>(options.Lookup),
         static_cast<int>(options.Maps), options.MapSteps })
  {
    this->AddNumber(static_cast<std::uint64_t>(number));
  }
  const double numbers[] = { options.AreaTolerance, options.Particles, options.Tolerance };
  this->AddNumbers(numbers, 3);
}

void DataIdentity::AddRules(const DensityRules& rules)
{
  // All members of DensityRules, as two readings of one array are different densities.
  for (const int number : { rules.Component, rules.Invert ? 1 : 0, rules.ClampNegative ? 1 : 0,
         rules.Missing.AreNaN ? 1 : 0, static_cast<int>(rules.Empty.Cells) })
  {
    this->AddNumber(static_cast<std::uint64_t>(number));
  }
  const double numbers[] = { rules.Missing.Low, rules.Missing.High, rules.Empty.Value };
  this->AddNumbers(numbers, 3);
}

// The address belongs to the time: another object at the same time is other data. A new object at
// an old address has a newer time, as VTK's clock never repeats one.
void DataIdentity::AddTimeOf(vtkObject* object)
{
  this->Times.push_back(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(object)));
  this->Times.push_back(object ? static_cast<std::uint64_t>(object->GetMTime()) : 0);
}

void DataIdentity::AddArray(vtkAbstractArray* array)
{
  // An array that is missing differs from every array, so that the numbers after it are not mixed
  // up.
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
  // Values are hashed later, and only if the times differ.
  if (auto* numeric = vtkDataArray::SafeDownCast(array))
  {
    this->Arrays.push_back(numeric);
    return;
  }
  // There is no hash of texts: another array is another content.
  this->AddNumber(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(array)));
  this->AddNumber(static_cast<std::uint64_t>(array->GetMTime()));
}

// Hashes are lazy, so the other identity is kept until Hash combines both. A hash that exists
// already is wrapped as a hasher, because Hash would otherwise look for arrays that are gone.
void DataIdentity::Add(const DataIdentity& other)
{
  this->Numbers.insert(this->Numbers.end(), other.Numbers.begin(), other.Numbers.end());
  this->Times.insert(this->Times.end(), other.Times.begin(), other.Times.end());
  if (this->IsHashed)
  {
    this->Find = [own = this->Bits](Progress&) { return own; };
  }
  this->Others.push_back(other);
  this->IsHashed = false;
}

void DataIdentity::Hash(Progress& progress)
{
  // The hashes h and g of two identities are combined as (h odd xor h / 2^32) + g, which depends on
  // their order. An odd factor is invertible modulo 2^64, so no bit of h is lost in it.
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
  if (this->IsHashed)
  {
    return;
  }
  // 0 where an array is not contiguous in memory: there is no hash, and times alone decide.
  this->Bits = this->Find ? this->Find(progress) : fingerprint(this->Arrays, progress);
  for (DataIdentity& other : this->Others)
  {
    other.Hash(progress);
    const bool haveBoth = this->HasHash() && other.HasHash();
    this->Bits = haveBoth ? ((this->Bits * odd) ^ (this->Bits >> 32)) + other.Bits : 0;
  }
  // Arrays may be deleted from here on, and an identity that is kept must not refer to them.
  this->IsHashed = true;
  this->Arrays.clear();
  this->Find = nullptr;
  this->Others.clear();
}

bool DataIdentity::IsByTimes(const DataIdentity& other) const
{
  return other.IsHashed && this->Numbers == other.Numbers && this->Times == other.Times;
}

bool DataIdentity::IsByContent(const DataIdentity& other) const
{
  return this->IsHashed && other.IsHashed && this->Content() == other.Content();
}

// From cheap to expensive: numbers must be equal, equal times suffice, and only other times make
// the values be hashed. The times are then taken over, so that the next comparison is cheap again.
// Data without a hash (0) are the same only by their times.
bool DataIdentity::IsSameAs(DataIdentity& before, Progress& progress)
{
  if (!before.IsHashed || this->Numbers != before.Numbers)
  {
    return false;
  }
  if (this->Times != before.Times)
  {
    if (before.Bits == 0)
    {
      return false;
    }
    this->Hash(progress);
    if (this->Bits != before.Bits)
    {
      return false;
    }
  }
  before.Times = this->Times;
  return true;
}

std::vector<std::uint64_t> DataIdentity::Content() const
{
  // Equal contents mean equal data: the numbers, and the hash of all values.
  std::vector<std::uint64_t> content = this->Numbers;
  content.push_back(this->Bits);
  if (this->Bits == 0)
  {
    content.insert(content.end(), this->Times.begin(), this->Times.end());
  }
  return content;
}

} // namespace RectifiedTransport::Bridge
