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
        using Value = typename std::decay_t<decltype(range)>::ValueType;
        return static_cast<Value>(range[i * n + c]);
      },
      this->Components);
  }

private:
  ArrayT* Array;
  int Components;
};

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
  const vtkIdType expected = onPoints ? data->GetNumberOfPoints() : data->GetNumberOfCells();
  if (array->GetNumberOfTuples() != expected)
  {
    fail("The ", describeArray(array), " has ", array->GetNumberOfTuples(), " tuples, but the ",
      what, " has ", expected, onPoints ? " points" : " cells", "; there must be one for each");
  }
}

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
  if (!vtkArrayDispatch::Dispatch::Execute(array, make))
  {
    make(array);
  }
  return std::move(make.Reader);
}

} // namespace RectifiedTransport::Bridge
