// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/AdvectedArrays.h"

#include "Bridge/Data/ArraySampling.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Series/AdvectedMeans.h"

#include "vtkBitArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// The values of some arrays of an image at points.
vtkSmartPointer<vtkPointData> sample(const AdvectedImage& image, int owner,
  const std::vector<std::string>& names, ConstPointSpan<3> points, Progress& progress)
{
  // An image with the geometry of the step and only the wanted arrays, whose values are shared.
  vtkNew<vtkImageData> some;
  some->CopyStructure(image.Image);
  for (const std::string& name : names)
  {
    some->GetAttributes(owner)->AddArray(
      image.Image->GetAttributes(owner)->GetAbstractArray(name.c_str()));
  }
  auto values = vtkSmartPointer<vtkPointData>::New();
  // Arrays of points are interpolated, those of cells have one value a cell.
  sampleImage(some, image.Grid, image.Grid.Extent(), points, progress, values);
  return values;
}

// The centres of all cells, or the points, of a grid.
// Shape: values of the grid x 3 doubles, in physical space.
SeriesPositions placesOf(const ImageGrid& grid)
{
  vtkNew<vtkImageData> image;
  applyGrid(grid.IsOnPoints() ? grid : grid.AtCellCentres(), image);
  const vtkIdType count = image->GetNumberOfPoints();
  return withMemory({ "the array Places", 24.0 * static_cast<double>(count) }, [&]() {
    SeriesPositions places(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      image->GetPoint(i, places.Span()[i]);
    }
    return places;
  });
}

// Sums and means are taken in double precision; Write converts to the type of the array.
vtkSmartPointer<vtkDoubleArray> doublesOf(vtkPointData* values, const std::string& name)
{
  vtkDataArray* array = values->GetArray(name.c_str());
  auto doubles =
    newArray<vtkDoubleArray>(name, array->GetNumberOfComponents(), array->GetNumberOfTuples());
  doubles->DeepCopy(array);
  return doubles;
}

// The density itself moves by the transport, ghost flags say what of an image counts, and an array
// with another number of tuples lacks values.
bool isAdvected(const AdvectedImage& image, int owner, vtkAbstractArray* array)
{
  const bool isDensity = array && array->GetName() && image.Density == array->GetName() &&
    owner == (image.Grid.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL);
  return array && array->GetName() && !isDensity &&
    array->GetName() != std::string(vtkDataSetAttributes::GhostArrayName()) &&
    array->GetNumberOfTuples() == image.Image->GetNumberOfElements(owner);
}

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

// An array of the type and the components of another one. Throws Failure.
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

// Whether the values of an array are labels.
bool isOfLabels(vtkAbstractArray* array)
{
  // A mean of two labels, such as materials 1 and 3, would be a label that has nothing to do with
  // them.
  const int type = array->GetDataType();
  return type != VTK_DOUBLE && type != VTK_FLOAT;
}

} // namespace

void passAdvected(const AdvectedImage& image, vtkImageData* output)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = image.Image->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      if (isAdvected(image, owner, attributes->GetAbstractArray(i)))
      {
        output->GetAttributes(owner)->AddArray(attributes->GetAbstractArray(i));
      }
    }
  }
}

void AdvectedArrays::Make(const AdvectedImage& first, const AdvectedImage& second,
  const SeriesParticles& particles, const ImageGrid& geometry, Progress& progress)
{
  this->Arrays.clear();
  this->MissingNames.clear();
  for (const int owner : { vtkDataObject::CELL, vtkDataObject::POINT })
  {
    this->MakeOf(owner, first, second, particles, geometry, progress);
  }
}

// Floating-point arrays are sampled where the particles begin (in the first image) and end (in the
// second one), and at all tuples in place. Arrays of integers, text and the like are labels, which
// have no mean.
void AdvectedArrays::MakeOf(int owner, const AdvectedImage& first, const AdvectedImage& second,
  const SeriesParticles& particles, const ImageGrid& geometry, Progress& progress)
{
  const auto find = [owner](const AdvectedImage& image, const char* name) {
    vtkAbstractArray* array = image.Image->GetAttributes(owner)->GetAbstractArray(name);
    return isAdvected(image, owner, array) ? array : nullptr;
  };
  std::vector<std::string> names;
  // Both images are searched, so that an array that only one of them has is reported.
  for (const auto& [one, other] : { std::pair(&first, &second), std::pair(&second, &first) })
  {
    vtkDataSetAttributes* attributes = one->Image->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = attributes->GetAbstractArray(i);
      if (!isAdvected(*one, owner, array))
      {
        continue;
      }
      vtkAbstractArray* there = find(*other, array->GetName());
      const bool isSame = there && there->GetDataType() == array->GetDataType() &&
        there->GetNumberOfComponents() == array->GetNumberOfComponents();
      std::vector<std::string>& list = isSame ? names : this->MissingNames;
      // Both images name it, but it is wanted once.
      if (std::find(list.begin(), list.end(), array->GetName()) == list.end())
      {
        list.emplace_back(array->GetName());
      }
    }
  }
  // Floating-point arrays first, in their order in the first image.
  const auto labels = std::stable_partition(names.begin(), names.end(),
    [&](const std::string& name) { return !isOfLabels(find(first, name.c_str())); });
  this->Labels[owner == vtkDataObject::POINT ? 1 : 0].Make(
    owner, { labels, names.end() }, first, second, particles);
  names.erase(labels, names.end());
  if (names.empty())
  {
    return;
  }
  // Where no mass arrives, a mean by mass is 0 / 0: the values of both steps at the place itself
  // are interpolated in time there. These places are the same for all times of the interval.
  const SeriesPositions places = placesOf(geometry.WithValuesOn(owner == vtkDataObject::POINT));
  const auto atFrom = sample(first, owner, names, particles.From->Span(), progress);
  const auto atTo = sample(second, owner, names, particles.To->Span(), progress);
  const auto firstInPlace = sample(first, owner, names, places.Span(), progress);
  const auto secondInPlace = sample(second, owner, names, places.Span(), progress);
  for (const std::string& name : names)
  {
    this->Arrays.push_back({ name, owner, newLike(atFrom->GetArray(name.c_str()), name, 0),
      { doublesOf(atFrom, name), doublesOf(atTo, name) },
      { doublesOf(firstInPlace, name), doublesOf(secondInPlace, name) } });
  }
}

// Value at a place: the sum of m v over the particles that are splat there, divided by the sum of
// m. The denominator is the same for all arrays of an association and is splat once.
void AdvectedArrays::Write(const SeriesSnapshot& moment, const ImageGrid& geometry,
  const SplatOptions& splat, const Extent& wanted, Progress& progress, vtkImageData* output) const
{
  for (const int owner : { vtkDataObject::CELL, vtkDataObject::POINT })
  {
    // Arrays of points are splat onto the dual cells around points, whatever the density is on.
    const ImageGrid own = geometry.WithValuesOn(owner == vtkDataObject::POINT);
    const SplatTarget target{ own, splat, false };
    const TupleBox box = tuplesOf(wanted, owner, geometry.Extent());
    vtkSmartPointer<vtkDoubleArray> mass;
    for (const Advected& advected : this->Arrays)
    {
      if (advected.Owner != owner)
      {
        continue;
      }
      // The masses without division by the volume: only the ratio of two sums matters.
      if (!mass)
      {
        mass = newArray<vtkDoubleArray>("Mass", 1, box.Count());
        splatDistributed(
          moment.Points(), moment.Masses(), moment.Numbers(), target, box, progress, mass);
      }
      this->WriteOne(advected, moment, target, box, mass, progress, output);
    }
    const AdvectedLabels& labels = this->Labels[owner == vtkDataObject::POINT ? 1 : 0];
    labels.Write(moment, geometry, wanted, progress, output);
  }
}

// One component at a time, so that the scratch memory is a double a particle and one a tuple,
// whatever the number of components. `moments` has m v of each particle, with v = (1 - s) v0 + s v1
// at the share s of the interval.
void AdvectedArrays::WriteOne(const Advected& advected, const SeriesSnapshot& moment,
  const SplatTarget& target, const TupleBox& wanted, vtkDoubleArray* mass, Progress& progress,
  vtkImageData* output) const
{
  const int components = advected.Like->GetNumberOfComponents();
  const Extent& whole = target.Geometry.Extent();
  const auto like = newLike(advected.Like, advected.Name, wanted.Count());
  auto* made = vtkDataArray::SafeDownCast(like);
  const auto moments = newArray<vtkDoubleArray>("Moments", 1, moment.Count());
  const auto sums = newArray<vtkDoubleArray>("Sums", 1, wanted.Count());
  for (int c = 0; c < components; ++c)
  {
    const auto componentOf = [c](const Ends& ends) {
      return std::array<const double*, 2>{ ends[0]->GetPointer(c), ends[1]->GetPointer(c) };
    };
    const AdvectedValues values{ componentOf(advected.OfParticles), componentOf(advected.InPlace),
      components };
    // sums = sum of m v of the particles by the same kernel as mass = sum of m; then sums / mass.
    writeMoments(values, moment, progress, moments->GetPointer(0));
    splatDistributed(
      moment.Points(), moments->GetPointer(0), moment.Numbers(), target, wanted, progress, sums);
    writeMeans(values, moment.Part(), tuplesOf(whole, advected.Owner, whole), wanted,
      mass->GetPointer(0), progress, sums->GetPointer(0));
    for (std::int64_t i = 0; i < wanted.Count(); ++i)
    {
      made->SetComponent(i, c, sums->GetValue(i));
    }
  }
  output->GetAttributes(advected.Owner)->AddArray(made);
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
