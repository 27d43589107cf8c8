// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/AdvectedLabels.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/AdvectedArrays.h"
#include "Core/Geometry/Dispatch.h"

#include "vtkBitArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkVariant.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// What equal tuples have in common and no others.
std::string keyOf(vtkAbstractArray* array, vtkIdType tuple)
{
  const int components = array->GetNumberOfComponents();
  const vtkIdType first = tuple * components;
  std::string key;
  if (auto* bits = vtkBitArray::SafeDownCast(array)) // whose variants have no value
  {
    for (int c = 0; c < components; ++c)
    {
      key += bits->GetValue(first + c) != 0 ? '1' : '0';
    }
    return key;
  }
  // The bytes of all components of the tuple: equal numbers of one type have equal bytes.
  if (vtkDataArray::SafeDownCast(array))
  {
    const auto size = static_cast<std::size_t>(array->GetDataTypeSize());
    const auto* bytes = static_cast<const char*>(array->GetVoidPointer(0));
    return { bytes + size * static_cast<std::size_t>(first),
      size * static_cast<std::size_t>(components) };
  }
  // Texts and variants: type and length go first, so that "a", "bc" differs from "ab", "c".
  for (int c = 0; c < components; ++c)
  {
    const vtkVariant value = array->GetVariantValue(first + c);
    const std::string text = value.ToString();
    key += std::to_string(value.GetType()) + ":" + std::to_string(text.size()) + ":" + text;
  }
  return key;
}

// Its values are contiguous in memory and stay, whatever a source writes next.
// CreateDataArray makes contiguous arrays also for arrays of other layouts; arrays of text keep
// their own class.
vtkSmartPointer<vtkAbstractArray> copyOf(vtkAbstractArray* array)
{
  auto copy = vtkSmartPointer<vtkAbstractArray>::Take(vtkDataArray::SafeDownCast(array)
      ? vtkDataArray::CreateDataArray(array->GetDataType())
      : array->NewInstance());
  copy->DeepCopy(array);
  return copy;
}

// Calls take(array, tuples) with a tuple for each wanted cell of the grid.
template <int D>
void find(const SeriesLabels& labels, const SeriesSnapshot& moment, const ImageGrid& grid,
  const TupleBox& wanted, const std::vector<std::vector<std::int64_t>>& equal, Progress& progress,
  const SeriesLabels::Take& take)
{
  labels.Find<D>(moment, grid, latticePartOf<D>(wanted, grid), equal, progress, take);
}

} // namespace

vtkSmartPointer<vtkAbstractArray> newLike(
  vtkAbstractArray* array, const std::string& name, vtkIdType tuples)
{
  const auto made = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  made->SetName(name.c_str());
  made->SetNumberOfComponents(array->GetNumberOfComponents());
  made->CopyComponentNames(array);
  // 8 bytes a value is the size of the largest number.
  const double values = static_cast<double>(tuples) * array->GetNumberOfComponents();
  withMemory({ "the array " + name, 8.0 * values }, [&]() { made->SetNumberOfTuples(tuples); });
  return made;
}

bool isOfLabels(vtkAbstractArray* array)
{
  // A mean of two labels, such as materials 1 and 3, would be a label that has nothing to do with
  // them.
  const int type = array->GetDataType();
  return type != VTK_DOUBLE && type != VTK_FLOAT;
}

// Labels of the two images are compared by their values: tuples of both that are equal get one
// number (see findEqual), and particles carry the number of their tuple.
void AdvectedLabels::Make(int owner, const std::vector<std::string>& names,
  const AdvectedImage& first, const AdvectedImage& second, const SeriesParticles& particles)
{
  this->Owner = owner;
  this->Arrays.clear();
  this->Equal.clear();
  this->OfParticles = SeriesLabels();
  for (const std::string& name : names)
  {
    const auto arrayOf = [&](const AdvectedImage& image) {
      return copyOf(image.Image->GetAttributes(owner)->GetAbstractArray(name.c_str()));
    };
    // Copies of both: the next execution of the source may overwrite its arrays.
    const Labels& labels =
      this->Arrays.emplace_back(Labels{ name, { arrayOf(first), arrayOf(second) } });
    const std::array<std::int64_t, 2> tuples{ labels.Arrays[0]->GetNumberOfTuples(),
      labels.Arrays[1]->GetNumberOfTuples() };
    // About the bytes that the table of keys takes a tuple.
    const double bytes = 48.0 * static_cast<double>(tuples[0] + tuples[1]);
    this->Equal.push_back(withMemory({ "the labels of " + name, bytes }, [&]() {
      return findEqual(tuples,
        [&](std::size_t step, std::int64_t tuple) { return keyOf(labels.Arrays[step], tuple); });
    }));
  }
  if (names.empty())
  {
    return;
  }
  const bool onPoints = owner == vtkDataObject::POINT;
  // Arrays of cells with a density on points, or the reverse: a particle's cloud then covers
  // parts of up to 2^d tuples, and each part counts separately.
  const bool isAcross = first.Grid.IsOnPoints() != onPoints;
  const double parts = isAcross ? std::exp2(first.Grid.Dimension()) : 1.0;
  withMemory({ "the labels that move along",
               2.0 * sizeof(std::int64_t) * parts * static_cast<double>(particles.Count()) },
    [&]() {
      this->OfParticles =
        SeriesLabels({ first.Grid.WithValuesOn(onPoints), second.Grid.WithValuesOn(onPoints) },
          isAcross, particles);
    });
}

void AdvectedLabels::Write(const SeriesSnapshot& moment, const ImageGrid& geometry,
  const Extent& wanted, Progress& progress, vtkImageData* output) const
{
  // All ranks have the same arrays, so that all return here or none does.
  if (this->Arrays.empty())
  {
    return;
  }
  const TupleBox box = tuplesOf(wanted, this->Owner, geometry.Extent());
  const auto ofFirst = static_cast<vtkIdType>(this->OfParticles.TuplesOfFirst());
  // Tuples of the second image are numbered on from those of the first one.
  const auto write = [&](std::size_t array, const std::vector<std::int64_t>& tuples) {
    const Labels& labels = this->Arrays[array];
    const auto made = newLike(labels.Arrays[0], labels.Name, box.Count());
    for (vtkIdType i = 0; i < box.Count(); ++i)
    {
      const vtkIdType tuple = tuples[static_cast<std::size_t>(i)];
      const bool isFirst = tuple < ofFirst;
      // The whole tuple comes from one particle: components are never mixed.
      made->SetTuple(i, isFirst ? tuple : tuple - ofFirst, labels.Arrays[isFirst ? 0 : 1]);
    }
    output->GetAttributes(this->Owner)->AddArray(made);
  };
  withMemory(
    { "the labels that move along", this->OfParticles.BytesOfVotes(moment.Count()) }, [&]() {
      const ImageGrid own = geometry.WithValuesOn(this->Owner == vtkDataObject::POINT);
      dispatchDimension(own.Dimension(), find<1>, find<2>, find<3>)(
        this->OfParticles, moment, own, box, this->Equal, progress, write);
    });
}

} // namespace RectifiedTransport::Bridge
