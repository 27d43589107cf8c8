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
#include <unordered_map>
#include <utility>

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
  if (vtkDataArray::SafeDownCast(array))
  {
    const auto size = static_cast<std::size_t>(array->GetDataTypeSize());
    const auto* bytes = static_cast<const char*>(array->GetVoidPointer(0));
    return { bytes + size * static_cast<std::size_t>(first),
      size * static_cast<std::size_t>(components) };
  }
  for (int c = 0; c < components; ++c)
  {
    const vtkVariant value = array->GetVariantValue(first + c);
    const std::string text = value.ToString();
    key += std::to_string(value.GetType()) + ":" + std::to_string(text.size()) + ":" + text;
  }
  return key;
}

// Its values are contiguous in memory and stay, whatever a source writes next.
vtkSmartPointer<vtkAbstractArray> copyOf(vtkAbstractArray* array)
{
  auto copy = vtkSmartPointer<vtkAbstractArray>::Take(vtkDataArray::SafeDownCast(array)
      ? vtkDataArray::CreateDataArray(array->GetDataType())
      : array->NewInstance());
  copy->DeepCopy(array);
  return copy;
}

std::vector<std::int64_t> findEqual(const std::array<vtkSmartPointer<vtkAbstractArray>, 2>& arrays)
{
  std::vector<std::int64_t> equal;
  std::unordered_map<std::string, std::int64_t> known;
  for (vtkAbstractArray* array : arrays)
  {
    std::string before;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      const auto number = static_cast<std::int64_t>(equal.size());
      std::string key = keyOf(array, i);
      // Neighbours are often equal.
      equal.push_back(
        i > 0 && key == before ? equal.back() : known.try_emplace(key, number).first->second);
      before = std::move(key);
    }
  }
  return equal;
}

template <int D>
void find(const SeriesLabels& labels, const SeriesMoment& moment, const ImageGrid& grid,
  const TupleBox& wanted, const std::vector<const std::vector<std::int64_t>*>& equal,
  Progress& progress, const SeriesLabels::Take& take)
{
  labels.Find<D>(moment, grid, latticePartOf<D>(wanted, grid), equal, progress, take);
}

} // namespace

bool isOfLabels(vtkAbstractArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_DOUBLE && type != VTK_FLOAT;
}

void AdvectedLabels::Make(int owner, const std::vector<std::string>& names,
  const AdvectedImage& first, const AdvectedImage& second, const SeriesParticles& particles)
{
  this->Owner = owner;
  this->Arrays.clear();
  this->OfParticles = SeriesLabels();
  for (const std::string& name : names)
  {
    const auto arrayOf = [&](const AdvectedImage& image) {
      return copyOf(image.Image->GetAttributes(owner)->GetAbstractArray(name.c_str()));
    };
    Labels labels{ name, { arrayOf(first), arrayOf(second) }, {} };
    const double tuples = static_cast<double>(
      labels.Arrays[0]->GetNumberOfTuples() + labels.Arrays[1]->GetNumberOfTuples());
    withMemory({ "the labels of " + name, 48.0 * tuples },
      [&]() { labels.Equal = findEqual(labels.Arrays); });
    this->Arrays.push_back(std::move(labels));
  }
  if (names.empty())
  {
    return;
  }
  const bool onPoints = owner == vtkDataObject::POINT;
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

void AdvectedLabels::Write(const SeriesMoment& moment, const ImageGrid& geometry,
  const Extent& wanted, Progress& progress, vtkImageData* output) const
{
  if (this->Arrays.empty())
  {
    return;
  }
  const TupleBox box = tuplesOf(wanted, this->Owner, geometry.Extent());
  const auto ofFirst = static_cast<vtkIdType>(this->OfParticles.TuplesOfFirst());
  const auto write = [&](std::size_t array, const std::vector<std::int64_t>& tuples) {
    const Labels& labels = this->Arrays[array];
    const auto made = vtkSmartPointer<vtkAbstractArray>::Take(labels.Arrays[0]->NewInstance());
    made->SetName(labels.Name.c_str());
    made->SetNumberOfComponents(labels.Arrays[0]->GetNumberOfComponents());
    made->CopyComponentNames(labels.Arrays[0]);
    withMemory({ "the array " + labels.Name,
                 8.0 * static_cast<double>(box.Count()) * made->GetNumberOfComponents() },
      [&]() { made->SetNumberOfTuples(box.Count()); });
    for (vtkIdType i = 0; i < box.Count(); ++i)
    {
      const vtkIdType tuple = tuples[static_cast<std::size_t>(i)];
      const bool isFirst = tuple < ofFirst;
      made->SetTuple(i, isFirst ? tuple : tuple - ofFirst, labels.Arrays[isFirst ? 0 : 1]);
    }
    output->GetAttributes(this->Owner)->AddArray(made);
  };
  std::vector<const std::vector<std::int64_t>*> equal;
  for (const Labels& labels : this->Arrays)
  {
    equal.push_back(&labels.Equal);
  }
  withMemory(
    { "the labels that move along", this->OfParticles.BytesOfVotes(moment.Count()) }, [&]() {
      const ImageGrid own = geometry.WithValuesOn(this->Owner == vtkDataObject::POINT);
      dispatchDimension(own.Dimension(), find<1>, find<2>, find<3>)(
        this->OfParticles, moment, own, box, equal, progress, write);
    });
}

} // namespace RectifiedTransport::Bridge
