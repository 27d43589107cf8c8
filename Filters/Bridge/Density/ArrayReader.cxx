// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/ArrayReader.h"

#include "Bridge/Run/Settings/ComponentChoice.h"
#include "Core/Tables/Reading/DensityFailure.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"

#include <cstdint>
#include <type_traits>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// Contiguous tuples. Their number of components is a compile-time constant up to 4, so that the
// loops are vectorised.
// Both classes below are the Tuples of the core's TupleReader: VisitTuples calls visit(begin,
// components) once for a run of tuples, where begin(i, c) is component c of the i-th tuple of the
// run.
template <class T>
class BlockOfTuples
{
public:
  explicit BlockOfTuples(vtkAOSDataArrayTemplate<T>* array)
    : Values(array->GetPointer(0))
    , Components(array->GetNumberOfComponents())
  {
  }

  template <class Visit>
  void VisitTuples(std::int64_t first, std::int64_t, const Visit& visit) const
  {
    // The length of the run is not needed: visit reads the tuples that it wants.
    const T* block = this->Values + first * this->Components;
    const auto visitAs = [&](auto components) {
      constexpr int N = decltype(components)::value;
      visit([block](std::int64_t i, int c) { return block[i * N + c]; }, N);
    };
    switch (this->Components)
    {
      case 1:
        return visitAs(std::integral_constant<int, 1>());
      case 2:
        return visitAs(std::integral_constant<int, 2>());
      case 3:
        return visitAs(std::integral_constant<int, 3>());
      case 4:
        return visitAs(std::integral_constant<int, 4>());
      // More components, as of tensors or time series, take a loop of variable length.
      default:
        return visit(
          [block, n = this->Components](std::int64_t i, int c) { return block[i * n + c]; },
          this->Components);
    }
  }

private:
  const T* Values;
  int Components;
};

// Tuples of any other memory layout.
template <class ArrayT>
class RangeOfTuples
{
public:
  explicit RangeOfTuples(ArrayT* array)
    : Array(array)
    , Components(array->GetNumberOfComponents())
  {
  }

  template <class Visit>
  void VisitTuples(std::int64_t first, std::int64_t count, const Visit& visit) const
  {
    const auto range = vtk::DataArrayValueRange(
      this->Array, first * this->Components, (first + count) * this->Components);
    visit(
      [&range, n = this->Components](std::int64_t i, int c) {
        // The cast turns references into values: some layouts give proxies. A vtkDataArray gives
        // doubles.
        using Value = typename std::decay_t<decltype(range)>::ValueType;
        return static_cast<Value>(range[i * n + c]);
      },
      this->Components);
  }

private:
  ArrayT* Array;
  int Components;
};

// Chooses the reader for the class of an array. Arrays of structs, one tuple after the other, are
// what readers of files and numpy give; all other layouts are read through ranges.
struct MakeReader
{
  const DensityRules& Rules;
  std::unique_ptr<DensityReader> Reader;

  template <class T>
  void operator()(vtkAOSDataArrayTemplate<T>* array)
  {
    this->Reader = std::make_unique<TupleReader<BlockOfTuples<T>>>(array, this->Rules);
  }

  template <class ArrayT>
  void operator()(ArrayT* array)
  {
    this->Reader = std::make_unique<TupleReader<RangeOfTuples<ArrayT>>>(array, this->Rules);
  }
};

} // namespace

std::string describeArray(vtkDataArray* array)
{
  return array->GetName() ? std::string("density array '") + array->GetName() + "'"
                          : std::string("density array (which has no name)");
}

void requireTuples(vtkDataArray* array, vtkDataSet* data, bool onPoints, const std::string& what)
{
  // An array that is too long is an error, too: it probably belongs to another data set.
  const vtkIdType expected = onPoints ? data->GetNumberOfPoints() : data->GetNumberOfCells();
  if (array->GetNumberOfTuples() != expected)
  {
    fail("The ", describeArray(array), " has ", array->GetNumberOfTuples(), " tuples, but the ",
      what, " has ", expected, onPoints ? " points" : " cells", "; there must be one for each");
  }
}

// Auto becomes a component by the type and number of components, so that the core needs no choice.
DensityRules resolveRules(vtkDataArray* array, const std::string& name, const DensityRules& rules)
{
  DensityRules taken = rules;
  const int components = array->GetNumberOfComponents();
  taken.Component = resolveComponent(
    name, rules.Component, automaticComponent(array->GetDataType(), components), components);
  return taken;
}

std::vector<FillValue> fillValuesOf(vtkFieldData* fields)
{
  std::vector<FillValue> found;
  // Readers pass such attributes on as field data, though the values stay in the arrays. They serve
  // only for messages: what is missing follows from the rules.
  for (const char* name : { "_FillValue", "missing_value", "NO_DATA_VALUE" })
  {
    vtkDataArray* array = fields ? fields->GetArray(name) : nullptr;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      found.push_back({ name, array->GetComponent(i, 0) });
    }
  }
  return found;
}

std::unique_ptr<DensityReader> makeDensityReader(vtkDataArray* array, const DensityRules& rules)
{
  MakeReader make{ rules, nullptr };
  // Classes that the dispatch does not know are read as vtkDataArray, by virtual calls.
  if (!vtkArrayDispatch::Dispatch::Execute(array, make))
  {
    make(array);
  }
  return std::move(make.Reader);
}

} // namespace RectifiedTransport::Bridge
