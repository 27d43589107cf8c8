// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityReader.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"

#include <cstdint>
#include <limits>
#include <type_traits>

namespace RectifiedTransport
{

namespace
{

// Rec. 709. Whole ten-thousandths, so that a grey of an integer type has exactly its own value: the
// double 1e-4 is near enough to it (5e-17, relatively) for the product to round to the integer.
template <class T>
double luminance(T red, T green, T blue)
{
  constexpr double unit = 1e-4;
  if constexpr (std::is_floating_point_v<T>)
  {
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  }
  else if constexpr (sizeof(T) <= 2)
  {
    const std::int32_t sum =
      2126 * std::int32_t{ red } + 7152 * std::int32_t{ green } + 722 * std::int32_t{ blue };
    return unit * sum;
  }
  else
  {
    return unit *
      (2126.0 * static_cast<double>(red) + 7152.0 * static_cast<double>(green) +
        722.0 * static_cast<double>(blue));
  }
}

// Rounding of a luminance may exceed white; a comparison keeps NaN.
double positivePart(double value)
{
  return value < 0.0 ? 0.0 : value;
}

// The loops, over tuples that begin(i)[c] indexes.
template <class Tuples>
void readTuples(const Tuples& begin, int components, vtkIdType count, const TupleReading& reading,
  double* __restrict values)
{
  const double white = reading.White;
  if (reading.Component >= 0 || components == 1)
  {
    const int c = reading.Component < 0 ? 0 : reading.Component;
    for (vtkIdType i = 0; i < count; ++i)
    {
      values[i] = static_cast<double>(begin(i, c));
    }
    if (reading.Invert)
    {
      for (vtkIdType i = 0; i < count; ++i)
      {
        values[i] = white - values[i];
      }
    }
    return;
  }
  if (components >= 3)
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      values[i] = luminance(begin(i, 0), begin(i, 1), begin(i, 2));
    }
  }
  else
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      values[i] = static_cast<double>(begin(i, 0));
    }
  }
  if (components == 3)
  {
    if (reading.Invert)
    {
      for (vtkIdType i = 0; i < count; ++i)
      {
        values[i] = positivePart(white - values[i]);
      }
    }
    return;
  }
  const int alpha = components - 1;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double opacity = white > 0.0 ? static_cast<double>(begin(i, alpha)) / white : 1.0;
    const double ink = (white - values[i]) * opacity;
    values[i] = reading.Invert ? positivePart(ink) : white - ink;
  }
}

template <class Tuples>
double maximumOfTuples(const Tuples& begin, int firstComponent, int endComponent, vtkIdType count,
  const unsigned char* blank, unsigned char mask)
{
  double maximum = -std::numeric_limits<double>::infinity();
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (blank && (blank[i] & mask))
    {
      continue;
    }
    for (int c = firstComponent; c < endComponent; ++c)
    {
      const double value = static_cast<double>(begin(i, c));
      if (value > maximum && value <= std::numeric_limits<double>::max())
      {
        maximum = value;
      }
    }
  }
  return maximum;
}

// Arrays whose tuples lie in one block of memory. The number of components is a constant where that
// lets the loops be vectorised.
template <class T>
class BlockReader final : public DensityReader
{
public:
  explicit BlockReader(vtkAOSDataArrayTemplate<T>* array)
    : Values(array->GetPointer(0))
    , Components(array->GetNumberOfComponents())
  {
  }

  void Read(
    vtkIdType first, vtkIdType count, const TupleReading& reading, double* values) const override
  {
    const T* block = this->Values + first * this->Components;
    switch (this->Components)
    {
      case 1:
        return ReadBlock<1>(block, count, reading, values);
      case 2:
        return ReadBlock<2>(block, count, reading, values);
      case 3:
        return ReadBlock<3>(block, count, reading, values);
      case 4:
        return ReadBlock<4>(block, count, reading, values);
      default:
        return readTuples(
          [block, n = this->Components](vtkIdType i, int c) { return block[i * n + c]; },
          this->Components, count, reading, values);
    }
  }

  double Maximum(vtkIdType first, vtkIdType count, int component, const unsigned char* blank,
    unsigned char mask) const override
  {
    const T* block = this->Values + first * this->Components;
    return maximumOfTuples(
      [block, n = this->Components](vtkIdType i, int c) { return block[i * n + c]; },
      component < 0 ? 0 : component, component < 0 ? this->Components : component + 1, count, blank,
      mask);
  }

private:
  template <int N>
  static void ReadBlock(
    const T* block, vtkIdType count, const TupleReading& reading, double* values)
  {
    readTuples([block](vtkIdType i, int c) { return block[i * N + c]; }, N, count, reading, values);
  }

  const T* Values;
  int Components;
};

// Every other layout.
template <class ArrayT>
class RangeReader final : public DensityReader
{
public:
  explicit RangeReader(ArrayT* array)
    : Array(array)
    , Components(array->GetNumberOfComponents())
  {
  }

  void Read(
    vtkIdType first, vtkIdType count, const TupleReading& reading, double* values) const override
  {
    readTuples(this->Tuples(first, count), this->Components, count, reading, values);
  }

  double Maximum(vtkIdType first, vtkIdType count, int component, const unsigned char* blank,
    unsigned char mask) const override
  {
    return maximumOfTuples(this->Tuples(first, count), component < 0 ? 0 : component,
      component < 0 ? this->Components : component + 1, count, blank, mask);
  }

private:
  auto Tuples(vtkIdType first, vtkIdType count) const
  {
    const auto range = vtk::DataArrayValueRange(
      this->Array, first * this->Components, (first + count) * this->Components);
    return [range, n = this->Components](vtkIdType i, int c) {
      using Value = typename decltype(range)::ValueType;
      return static_cast<Value>(range[i * n + c]);
    };
  }

  ArrayT* Array;
  int Components;
};

struct MakeReader
{
  std::unique_ptr<DensityReader> Reader;

  template <class T>
  void operator()(vtkAOSDataArrayTemplate<T>* array)
  {
    this->Reader = std::make_unique<BlockReader<T>>(array);
  }

  template <class ArrayT>
  void operator()(ArrayT* array)
  {
    this->Reader = std::make_unique<RangeReader<ArrayT>>(array);
  }
};

} // namespace

std::unique_ptr<DensityReader> makeDensityReader(vtkDataArray* array)
{
  MakeReader make;
  if (!vtkArrayDispatch::Dispatch::Execute(array, make))
  {
    make(array);
  }
  return std::move(make.Reader);
}

} // namespace RectifiedTransport
