// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/ArraySampling.h"

#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Stages.h"
#include "Core/Resampling/ImageProbe.h"

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
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// Places in a range of work, which one thread takes at a time.
constexpr std::int64_t Grain = std::int64_t{ 1 } << 10;
// Units of a slice of work.
constexpr std::int64_t Units = std::int64_t{ 1 } << 14;

struct NewArray
{
  std::vector<vtkAbstractArray*> From; // the array of this name in each data set
  int Attribute;                       // the attribute type of the array, else negative
};

// VTK gives nullptr for an array without a name.
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
    // The particles' own arrays, such as SeedId, win over those of the input with the same name,
    // and arrays of points, which come first, over those of cells.
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
    // An array that one of the data sets lacks would have no values at the places in it.
    if (made.From.size() == source.Sets.size())
    {
      arrays.push_back(made);
    }
  }
  return arrays;
}

// An array of the same class, with all that views show of it: names of components, information such
// as units, and the lookup table. Values are not initialised. Throws Failure if memory is short.
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

// Writes the tuples of one array for `count` places, the first of which has the number `first`: on
// any thread, as no two of them share a value's memory.
using ArraySampler =
  std::function<void(const ProbeLocation* places, std::int64_t first, std::int64_t count)>;

template <class Value>
Value noValue()
{
  constexpr bool hasNaN = std::numeric_limits<Value>::has_quiet_NaN;
  return hasNaN ? std::numeric_limits<Value>::quiet_NaN() : Value(0);
}

// Interpolated values go back to the type of the array: integers are rounded to the nearest one,
// and clamped to their range.
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

// Makes the sampler of arrays that are all of one class.
struct MakeSampler
{
  ArraySampler Made;

  template <class Array>
  void operator()(Array*, const NewArray& array, vtkDataArray* to, bool ofCells)
  {
    // The dispatch gives the class of the first data set's array. Tuples of one class are read
    // without virtual calls.
    auto* made = vtkArrayDownCast<Array>(to);
    std::vector<decltype(vtk::DataArrayTupleRange(made))> given;
    for (vtkAbstractArray* from : array.From)
    {
      auto* own = vtkArrayDownCast<Array>(from);
      if (!made || !own)
      {
        return; // arrays of one type may be of several classes
      }
      given.push_back(vtk::DataArrayTupleRange(own));
    }
    // The ranges hold pointers to the arrays, which sources and output keep alive until all is
    // sampled.
    this->Made = [=](const ProbeLocation* places, std::int64_t first, std::int64_t count) {
      auto tuples = vtk::DataArrayTupleRange(made, first, first + count);
      for (const auto tuple : tuples)
      {
        sample(given, ofCells, *places++, tuple);
      }
    };
  }

private:
  template <class Range, class Tuple>
  // The tuple at one place: that of its cell, or the mean of those of its points with the
  // weights of the place, sum_k w_k v_k, in double precision. NaN or 0 outside of all cells.
  static void sample(
    const std::vector<Range>& given, bool ofCells, const ProbeLocation& place, Tuple tuple)
  {
    using Value = typename Tuple::value_type;
    if (place.Cell < 0)
    {
      tuple.fill(noValue<Value>());
      return;
    }
    const Range& from = given[static_cast<std::size_t>(place.Set)];
    if (ofCells)
    {
      tuple = from[static_cast<vtk::TupleIdType>(place.Cell)];
      return;
    }
    for (vtk::ComponentIdType c = 0; c < tuple.size(); ++c)
    {
      double sum = 0.0;
      for (int k = 0; k < place.Count; ++k)
      {
        const auto value = from[static_cast<vtk::TupleIdType>(place.Points[k])][c];
        sum += place.Weights[k] * static_cast<double>(value);
      }
      tuple[c] = rounded<Value>(sum);
    }
  }
};

// Strings, bits and the like have no mean: VTK interpolates their tuples, one by one.
void sampleTuples(const NewArray& array, vtkAbstractArray* to, const ProbeLocations& places,
  bool ofCells, Progress& progress)
{
  // The tuples of such arrays may share bytes or allocate, so that one thread writes them in order.
  vtkNew<vtkIdList> points;
  progress.ForEachInOrder(
    places.Count(), Grain,
    [&](std::int64_t i) {
      ProbeLocation place = places.Find(i);
      vtkAbstractArray* from = array.From[static_cast<std::size_t>(place.Set)];
      if (place.Cell < 0)
      {
        // The interpolation of no points gives an empty text, or 0.
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
// Numeric arrays have samplers, which any thread calls for a block of places.
struct Sampling
{
  std::vector<ArraySampler> Blocks;
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
    // Eight bits share a byte, which two threads must not write at once.
    if (from && from->GetDataType() != VTK_BIT)
    {
      vtkArrayDispatch::Dispatch::Execute(from, make, array, to, ofCells);
    }
    // Arrays of classes that the dispatch does not know, or of several classes, are sampled by
    // VTK's virtual methods.
    if (make.Made)
    {
      sampling.Blocks.push_back(std::move(make.Made));
    }
    else
    {
      sampling.Others.push_back({ array, made, ofCells });
    }
    const int index = output->AddArray(made);
    // Attributes that the output has already, such as the vectors Displacement, stay active.
    if (keepActive && array.Attribute >= 0 && !output->GetAbstractAttribute(array.Attribute))
    {
      output->SetActiveAttribute(index, array.Attribute);
    }
  }
}

// Each place is found once for all arrays.
void sampleBlocks(const Sampling& sampling, const ProbeLocations& places, Progress& progress)
{
  // The locations of a block stay in the first-level cache while all arrays read them: 128 of about
  // 150 bytes.
  constexpr std::int64_t block = 128;
  progress.For(
    places.Count(), Grain,
    [&](std::int64_t begin, std::int64_t end) {
      ProbeLocation found[block];
      for (std::int64_t first = begin; first < end; first += block)
      {
        const std::int64_t count = std::min(block, end - first);
        places.FindBlock(first, count, found);
        for (const ArraySampler& sample : sampling.Blocks)
        {
          sample(found, first, count);
        }
      }
    },
    Units);
}

template <int D>
void samplePart(vtkImageData* part, const ImageGrid& grid, const Extent& extent,
  ConstPointSpan<3> particles, Progress& progress, vtkPointData* output)
{
  sampleArrays(
    { { part }, "input image", false }, ImageProbe<D>(grid, extent, particles), progress, output);
}

} // namespace

void sampleArrays(
  const ArraySource& source, const ProbeLocations& places, Progress& progress, vtkPointData* output)
{
  Sampling sampling;
  const std::int64_t count = places.Count();
  // Arrays of points first: the second call leaves out names that the first one has added. All
  // arrays are allocated before any is sampled, so that a lack of memory is reported at once.
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
