// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Fingerprint.h"

#include "Core/Parallel/BytesHash.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

// The number of bytes of the values; -1 if they are not contiguous in memory. The unused bits of a
// bit array count: at worst equal arrays differ.
std::int64_t bytesOf(vtkDataArray* array)
{
  constexpr std::int64_t bitsAByte = 8;
  const std::int64_t values = array->GetNumberOfValues();
  if (array->GetDataType() == VTK_BIT) // whose GetDataTypeSize() is 0
  {
    return (values + bitsAByte - 1) / bitsAByte;
  }
  const int size = array->GetDataTypeSize();
  return array->HasStandardMemoryLayout() && size > 0 ? values * size : -1;
}

// The number of samples of an array of any length: samples suffice, as pieces of a data set differ
// nearly everywhere.
constexpr vtkIdType maximumSamples = 4096;

template <class Visit>
void visitSamples(vtkIdType count, const Visit& visit)
{
  const vtkIdType step = std::max<vtkIdType>(1, count / maximumSamples);
  for (vtkIdType i = 0; i < count; i += step)
  {
    visit(i);
  }
}

void addArray(vtkDataArray* array, ValueHash& hash)
{
  visitSamples(array ? array->GetNumberOfTuples() : 0,
    [&](vtkIdType tuple) { hash.Add(array->GetComponent(tuple, 0)); });
}

void addArrays(vtkFieldData* attributes, ValueHash& hash)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    addArray(attributes->GetArray(i), hash);
  }
}

void addTrees(vtkHyperTreeGrid* grid, ValueHash& hash)
{
  double bounds[6];
  grid->GetBounds(bounds);
  std::for_each(bounds, bounds + 6, [&](double bound) { hash.Add(bound); });
  hash.Add(grid->GetNumberOfCells());
  if (vtkFieldData* values = grid->GetAttributesAsFieldData(vtkDataObject::CELL))
  {
    addArrays(values, hash);
  }
}

// Grids of damaged files may have fewer coordinates than their extent says.
void addPlaces(vtkDataSet* data, ValueHash& hash)
{
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    for (vtkDataArray* axis :
      { grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates() })
    {
      addArray(axis, hash);
    }
  }
  else if (!vtkImageData::SafeDownCast(data))
  {
    visitSamples(data->GetNumberOfPoints(), [&](vtkIdType i) {
      double x[3];
      data->GetPoint(i, x);
      std::for_each(x, x + 3, [&](double place) { hash.Add(place); });
    });
  }
}

void addDataSet(vtkDataSet* data, ValueHash& hash)
{
  double bounds[6];
  data->GetBounds(bounds);
  std::for_each(bounds, bounds + 6, [&](double bound) { hash.Add(bound); });
  hash.Add(data->GetNumberOfPoints());
  hash.Add(data->GetNumberOfCells());
  addPlaces(data, hash);
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    addArrays(data->GetAttributes(owner), hash);
  }
}

// Returns whether it has points.
bool addData(vtkDataObject* data, ValueHash& hash)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    bool hasAny = false;
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      hasAny = addData(leaves->GetCurrentDataObject(), hash) || hasAny;
    }
    return hasAny;
  }
  if (auto* trees = vtkHyperTreeGrid::SafeDownCast(data))
  {
    addTrees(trees, hash);
    return trees->GetNumberOfCells() > 0;
  }
  auto* set = vtkDataSet::SafeDownCast(data);
  if (!set || set->GetNumberOfPoints() == 0)
  {
    return false;
  }
  addDataSet(set, hash);
  return true;
}

} // namespace

std::uint64_t fingerprint(const std::vector<vtkDataArray*>& arrays, Progress& progress)
{
  std::vector<ByteRange> ranges;
  for (vtkDataArray* array : arrays)
  {
    if (!array)
    {
      continue;
    }
    const std::int64_t count = bytesOf(array);
    if (count < 0)
    {
      return 0;
    }
    ranges.push_back({ static_cast<const unsigned char*>(array->GetVoidPointer(0)), count });
  }
  return hashBytes(ranges, progress);
}

std::uint64_t sampledFingerprint(const std::vector<vtkDataObject*>& data)
{
  ValueHash hash;
  bool hasAny = false;
  for (vtkDataObject* object : data)
  {
    hash.Add(hasAny);
    hasAny = addData(object, hash) || hasAny;
  }
  return hasAny ? std::max<std::uint64_t>(1, hash.Mixed()) : 0;
}

} // namespace RectifiedTransport::Bridge
