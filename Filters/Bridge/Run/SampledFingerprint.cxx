// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/SampledFingerprint.h"

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

#include <algorithm>
#include <cstring>

namespace RectifiedTransport::Bridge
{

namespace
{

// FNV-1a.
class Mixer
{
public:
  template <class Value>
  void Add(Value value)
  {
    unsigned char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    for (const unsigned char byte : bytes)
    {
      this->State = (this->State ^ byte) * 0x100000001b3;
    }
  }
  std::uint64_t Mixed() const { return this->State; }

private:
  std::uint64_t State = 0xcbf29ce484222325;
};

// Of an array of any length: samples suffice, as pieces of a data set differ nearly everywhere.
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

void addArray(vtkDataArray* array, Mixer& mixer)
{
  visitSamples(array ? array->GetNumberOfTuples() : 0,
    [&](vtkIdType tuple) { mixer.Add(array->GetComponent(tuple, 0)); });
}

void addArrays(vtkFieldData* attributes, Mixer& mixer)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    addArray(attributes->GetArray(i), mixer);
  }
}

void addTrees(vtkHyperTreeGrid* grid, Mixer& mixer)
{
  double bounds[6];
  grid->GetBounds(bounds);
  std::for_each(bounds, bounds + 6, [&](double bound) { mixer.Add(bound); });
  mixer.Add(grid->GetNumberOfCells());
  if (vtkFieldData* values = grid->GetAttributesAsFieldData(vtkDataObject::CELL))
  {
    addArrays(values, mixer);
  }
}

// Grids of damaged files may have fewer coordinates than their extent says.
void addPlaces(vtkDataSet* data, Mixer& mixer)
{
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    for (vtkDataArray* axis :
      { grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates() })
    {
      addArray(axis, mixer);
    }
  }
  else if (!vtkImageData::SafeDownCast(data))
  {
    visitSamples(data->GetNumberOfPoints(), [&](vtkIdType i) {
      double x[3];
      data->GetPoint(i, x);
      std::for_each(x, x + 3, [&](double place) { mixer.Add(place); });
    });
  }
}

void addDataSet(vtkDataSet* data, Mixer& mixer)
{
  double bounds[6];
  data->GetBounds(bounds);
  std::for_each(bounds, bounds + 6, [&](double bound) { mixer.Add(bound); });
  mixer.Add(data->GetNumberOfPoints());
  mixer.Add(data->GetNumberOfCells());
  addPlaces(data, mixer);
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    addArrays(data->GetAttributes(owner), mixer);
  }
}

// Returns whether it has points.
bool addData(vtkDataObject* data, Mixer& mixer)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    bool hasAny = false;
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      hasAny = addData(leaves->GetCurrentDataObject(), mixer) || hasAny;
    }
    return hasAny;
  }
  if (auto* trees = vtkHyperTreeGrid::SafeDownCast(data))
  {
    addTrees(trees, mixer);
    return trees->GetNumberOfCells() > 0;
  }
  auto* set = vtkDataSet::SafeDownCast(data);
  if (!set || set->GetNumberOfPoints() == 0)
  {
    return false;
  }
  addDataSet(set, mixer);
  return true;
}

} // namespace

std::uint64_t sampledFingerprint(const std::vector<vtkDataObject*>& data)
{
  Mixer mixer;
  bool hasAny = false;
  for (vtkDataObject* object : data)
  {
    mixer.Add(hasAny);
    hasAny = addData(object, mixer) || hasAny;
  }
  return hasAny ? std::max<std::uint64_t>(1, mixer.Mixed()) : 0;
}

} // namespace RectifiedTransport::Bridge
