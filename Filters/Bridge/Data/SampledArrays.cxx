// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/SampledArrays.h"

#include "Bridge/Data/CopiedTuples.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Stages.h"
#include "Core/Resampling/PlacesInImage.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkArrayDispatch.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 10;
// Units of a slice of work.
constexpr std::int64_t Units = std::int64_t{ 1 } << 14;

struct NewArray
{
  std::vector<vtkAbstractArray*> From; // of each data set
  int Attribute;                       // that it is, else negative
};

std::string nameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

// The arrays of the cells, or else of the points, whose names `known` has not.
std::vector<NewArray> newArrays(const ArraySource& source, bool ofCells, vtkPointData* known)
{
  const std::string owner = ofCells ? "cell" : "point";
  const int type = ofCells ? vtkDataObject::CELL : vtkDataObject::POINT;
  vtkDataSetAttributes* from = source.Sets.front()->GetAttributes(type);
  std::vector<NewArray> arrays;
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = from->GetAbstractArray(i);
    const std::string name = nameOf(array);
    const int attribute = from->IsArrayAnAttribute(i);
    const bool isTaken = array->GetName() && known->HasArray(array->GetName());
    const bool isGhost = name == vtkDataSetAttributes::GhostArrayName();
    // Between the names of points there is nothing, and a cell's would be of several particles.
    const bool isIds = attribute == vtkDataSetAttributes::GLOBALIDS ||
      (!ofCells &&
        (attribute == vtkDataSetAttributes::PEDIGREEIDS || vtkIdTypeArray::SafeDownCast(array)));
    if (isTaken || isGhost || isIds)
    {
      continue;
    }
    NewArray made{ {}, attribute };
    for (vtkDataSet* set : source.Sets)
    {
      vtkAbstractArray* own = set == source.Sets.front()
        ? array
        : set->GetAttributes(type)->GetAbstractArray(name.c_str());
      // Those of other ranks may be of another class for the same type.
      if (!own || own->GetDataType() != array->GetDataType() ||
        own->GetNumberOfComponents() != array->GetNumberOfComponents())
      {
        break;
      }
      requireTuples(own, set->GetNumberOfElements(type), owner, source.Name);
      made.From.push_back(own);
    }
    if (made.From.size() == source.Sets.size())
    {
      arrays.push_back(made);
    }
  }
  return arrays;
}

vtkSmartPointer<vtkAbstractArray> makeLike(vtkAbstractArray* array, std::int64_t tuples)
{
  const std::string purpose =
    "the array " + (array->GetName() ? nameOf(array) : std::string("without name"));
  const double bytes = static_cast<double>(tuples) * array->GetNumberOfComponents() *
    std::max(1, array->GetDataTypeSize());
  requireMemory({ purpose, bytes });
  const auto made = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  made->SetName(array->GetName());
  made->SetNumberOfComponents(array->GetNumberOfComponents());
  made->CopyComponentNames(array);
  if (array->HasInformation())
  {
    made->CopyInformation(array->GetInformation(), 0);
  }
  if (auto* data = vtkDataArray::SafeDownCast(made))
  {
    data->SetLookupTable(vtkDataArray::SafeDownCast(array)->GetLookupTable());
  }
  withMemory(
    { purpose, bytes }, [&]() { made->SetNumberOfTuples(static_cast<vtkIdType>(tuples)); });
  return made;
}

// Writes the tuples of one array for a block of places: on any thread, as no two of them share a
// value's memory.
class ArraySampler
{
public:
  virtual ~ArraySampler() = default;
  virtual void Sample(const SampledPlace* places, std::int64_t first, std::int64_t count) const = 0;
};

template <class Value>
Value noValue()
{
  constexpr bool hasNaN = std::numeric_limits<Value>::has_quiet_NaN;
  return hasNaN ? std::numeric_limits<Value>::quiet_NaN() : Value(0);
}

template <class Value>
Value rounded(double number)
{
  if constexpr (std::is_integral<Value>::value)
  {
    // As a double the largest value of 64 bits is one more, which vtkMath does not clamp.
    if (number >= static_cast<double>(std::numeric_limits<Value>::max()))
    {
      return std::numeric_limits<Value>::max();
    }
  }
  Value value;
  vtkMath::RoundDoubleToIntegralIfNecessary(number, &value);
  return value;
}

// The mean of value(point) with a place's weights.
template <class Value, class ValueAt>
Value interpolate(const SampledPlace& place, const ValueAt& valueAt)
{
  double sum = 0.0;
  for (int k = 0; k < place.Count; ++k)
  {
    sum += place.Weights[k] * static_cast<double>(valueAt(place.Points[k]));
  }
  return rounded<Value>(sum);
}

// Of arrays whose tuples are contiguous, with `N` components; 0 for any number.
template <class Value, int N>
class ContiguousSampler final : public ArraySampler
{
public:
  ContiguousSampler(const NewArray& array, vtkDataArray* to, bool ofCells)
    : To(vtkArrayDownCast<vtkAOSDataArrayTemplate<Value>>(to)->GetPointer(0))
    , Components(to->GetNumberOfComponents())
    , OfCells(ofCells)
  {
    for (vtkAbstractArray* from : array.From)
    {
      this->From.push_back(vtkArrayDownCast<vtkAOSDataArrayTemplate<Value>>(from)->GetPointer(0));
    }
  }

  void Sample(const SampledPlace* places, std::int64_t first, std::int64_t count) const override
  {
    const int components = N > 0 ? N : this->Components;
    Value* tuple = this->To + first * components;
    this->Touch(places, count, components);
    for (std::int64_t i = 0; i < count; ++i, tuple += components)
    {
      const SampledPlace& place = places[i];
      if (place.Cell < 0)
      {
        std::fill_n(tuple, components, noValue<Value>());
        continue;
      }
      const Value* given = this->From[static_cast<std::size_t>(place.Set)];
      if (this->OfCells)
      {
        std::copy_n(given + place.Cell * components, components, tuple);
        continue;
      }
      for (int c = 0; c < components; ++c)
      {
        tuple[c] = interpolate<Value>(
          place, [=](std::int64_t point) { return given[point * components + c]; });
      }
    }
  }

private:
  // Reads a value of each cache line beforehand, by loads that do not wait for each other:
  // particles are not in the order of memory, and processors drop prefetches of pages that they do
  // not know.
  void Touch(const SampledPlace* places, std::int64_t count, int components) const
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      const SampledPlace& place = places[i];
      if (place.Cell < 0)
      {
        continue;
      }
      const volatile Value* given = this->From[static_cast<std::size_t>(place.Set)];
      if (this->OfCells)
      {
        static_cast<void>(given[place.Cell * components]);
        continue;
      }
      for (int k = 0; k < place.Count; k += 2) // the next one lies beside it
      {
        static_cast<void>(given[place.Points[k] * components]);
      }
    }
  }

  std::vector<const Value*> From; // of each data set
  Value* To;
  const int Components;
  const bool OfCells;
};

// Of arrays of any layout.
template <class Array>
class RangeSampler final : public ArraySampler
{
public:
  RangeSampler(const NewArray& array, vtkDataArray* to, bool ofCells)
    : To(vtkArrayDownCast<Array>(to))
    , OfCells(ofCells)
  {
    for (vtkAbstractArray* from : array.From)
    {
      this->From.push_back(vtk::DataArrayTupleRange(vtkArrayDownCast<Array>(from)));
    }
  }

  void Sample(const SampledPlace* places, std::int64_t first, std::int64_t count) const override
  {
    using Value = vtk::GetAPIType<Array>;
    auto tuples = vtk::DataArrayTupleRange(this->To);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const SampledPlace& place = places[i];
      auto tuple = tuples[static_cast<vtk::TupleIdType>(first + i)];
      if (place.Cell < 0)
      {
        tuple.fill(noValue<Value>());
        continue;
      }
      const auto& given = this->From[static_cast<std::size_t>(place.Set)];
      if (this->OfCells)
      {
        tuple = given[static_cast<vtk::TupleIdType>(place.Cell)];
        continue;
      }
      for (vtk::ComponentIdType c = 0; c < tuples.GetTupleSize(); ++c)
      {
        tuple[c] = interpolate<Value>(place,
          [&](std::int64_t point) { return given[static_cast<vtk::TupleIdType>(point)][c]; });
      }
    }
  }

private:
  std::vector<decltype(vtk::DataArrayTupleRange(std::declval<Array*>()))> From;
  Array* To;
  const bool OfCells;
};

struct MakeSampler
{
  std::unique_ptr<ArraySampler> Made;

  template <class Value>
  void operator()(
    vtkAOSDataArrayTemplate<Value>*, const NewArray& array, vtkDataArray* to, bool ofCells)
  {
    if (!areAll<vtkAOSDataArrayTemplate<Value>>(array, to))
    {
      return;
    }
    switch (to->GetNumberOfComponents())
    {
      case 1:
        this->Made = std::make_unique<ContiguousSampler<Value, 1>>(array, to, ofCells);
        break;
      case 3:
        this->Made = std::make_unique<ContiguousSampler<Value, 3>>(array, to, ofCells);
        break;
      default:
        this->Made = std::make_unique<ContiguousSampler<Value, 0>>(array, to, ofCells);
    }
  }
  template <class Array>
  void operator()(Array*, const NewArray& array, vtkDataArray* to, bool ofCells)
  {
    if (areAll<Array>(array, to))
    {
      this->Made = std::make_unique<RangeSampler<Array>>(array, to, ofCells);
    }
  }

  // Arrays of one type may be of several classes.
  template <class Array>
  static bool areAll(const NewArray& array, vtkDataArray* to)
  {
    return vtkArrayDownCast<Array>(to) &&
      std::all_of(array.From.begin(), array.From.end(),
        [](vtkAbstractArray* from) { return vtkArrayDownCast<Array>(from) != nullptr; });
  }
};

// Of strings, bits and the like.
void sampleTuples(const NewArray& array, vtkAbstractArray* to, const SampledPlaces& places,
  bool ofCells, Progress& progress)
{
  vtkNew<vtkIdList> points;
  progress.ForEachInOrder(
    places.Count(), Grain,
    [&](std::int64_t i) {
      SampledPlace place = places.Find(i);
      vtkAbstractArray* from = array.From[static_cast<std::size_t>(place.Set)];
      if (place.Cell < 0)
      {
        points->Reset();
        to->InterpolateTuple(static_cast<vtkIdType>(i), points, from, nullptr);
        return;
      }
      if (ofCells)
      {
        to->SetTuple(static_cast<vtkIdType>(i), static_cast<vtkIdType>(place.Cell), from);
        return;
      }
      points->SetNumberOfIds(place.Count);
      std::copy_n(place.Points, place.Count, points->GetPointer(0));
      to->InterpolateTuple(static_cast<vtkIdType>(i), points, from, place.Weights);
    },
    Units);
}

// The arrays of an output that are to be sampled.
struct Sampling
{
  std::vector<std::unique_ptr<ArraySampler>> Blocks;
  struct InOrder
  {
    NewArray From;
    vtkSmartPointer<vtkAbstractArray> To;
    bool OfCells;
  };
  std::vector<InOrder> Others; // a tuple at a time, on one thread
};

// Adds arrays without values to the output.
void prepare(const std::vector<NewArray>& arrays, std::int64_t places, bool ofCells,
  bool keepActive, Sampling& sampling, vtkPointData* output)
{
  for (const NewArray& array : arrays)
  {
    const auto made = makeLike(array.From.front(), places);
    auto* from = vtkDataArray::SafeDownCast(array.From.front());
    auto* to = vtkDataArray::SafeDownCast(made);
    MakeSampler make;
    if (from && from->GetDataType() != VTK_BIT)
    {
      vtkArrayDispatch::Dispatch::Execute(from, make, array, to, ofCells);
    }
    if (make.Made)
    {
      sampling.Blocks.push_back(std::move(make.Made));
    }
    else
    {
      sampling.Others.push_back({ array, made, ofCells });
    }
    const int index = output->AddArray(made);
    if (keepActive && array.Attribute >= 0 && !output->GetAbstractAttribute(array.Attribute))
    {
      output->SetActiveAttribute(index, array.Attribute);
    }
  }
}

// Each place is found once for all arrays.
void sampleBlocks(const Sampling& sampling, const SampledPlaces& places, Progress& progress)
{
  constexpr std::int64_t block = 128;
  progress.For(
    places.Count(), Grain,
    [&](std::int64_t begin, std::int64_t end) {
      SampledPlace found[block];
      for (std::int64_t first = begin; first < end; first += block)
      {
        const std::int64_t count = std::min(block, end - first);
        places.FindBlock(first, count, found);
        for (const auto& array : sampling.Blocks)
        {
          array->Sample(found, first, count);
        }
      }
    },
    Units);
}

template <int D>
void samplePart(vtkImageData* part, const ImageGrid& grid, const Extent& extent,
  ConstPointSpan<3> particles, Progress& progress, vtkPointData* output)
{
  sampleArrays({ { part }, "input image", false }, PlacesInImage<D>(grid, extent, particles),
    progress, output);
}

} // namespace

void sampleArrays(
  const ArraySource& source, const SampledPlaces& places, Progress& progress, vtkPointData* output)
{
  Sampling sampling;
  const std::int64_t count = places.Count();
  prepare(newArrays(source, false, output), count, false, source.KeepActive, sampling, output);
  prepare(newArrays(source, true, output), count, true, false, sampling, output);
  Parts parts(progress, static_cast<std::int64_t>(sampling.Others.size() + 1));
  if (!sampling.Blocks.empty())
  {
    sampleBlocks(sampling, places, parts[0]);
  }
  std::int64_t part = 0;
  for (const Sampling::InOrder& array : sampling.Others)
  {
    sampleTuples(array.From, array.To, places, array.OfCells, parts[++part]);
  }
}

void sampleImage(vtkImageData* part, const ImageGrid& grid, const Extent& extent,
  ConstPointSpan<3> particles, Progress& progress, vtkPointData* output)
{
  dispatchDimension(grid.Dimension(), samplePart<1>, samplePart<2>, samplePart<3>)(
    part, grid, extent, particles, progress, output);
}

} // namespace RectifiedTransport::Bridge
