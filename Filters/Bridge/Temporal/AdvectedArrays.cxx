// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/AdvectedArrays.h"

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Splat/DistributedSplat.h"
#include "Bridge/Temporal/MovingParticles.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// The image with some of its arrays alone.
vtkSmartPointer<vtkImageData> imageWith(
  vtkImageData* image, int owner, const std::vector<std::string>& names)
{
  auto some = vtkSmartPointer<vtkImageData>::New();
  some->CopyStructure(image);
  for (const std::string& name : names)
  {
    some->GetAttributes(owner)->AddArray(
      image->GetAttributes(owner)->GetAbstractArray(name.c_str()));
  }
  return some;
}

vtkSmartPointer<vtkPointData> sample(
  vtkImageData* image, const ImageGrid& grid, vtkDoubleArray* points, Progress& progress)
{
  auto values = vtkSmartPointer<vtkPointData>::New();
  sampleImage(image, grid, grid.Extent(),
    ConstPointSpan<3>(points->GetPointer(0), points->GetNumberOfTuples()), progress, values);
  return values;
}

// The centres of all cells, or the points, of a grid.
vtkSmartPointer<vtkDoubleArray> placesOf(const ImageGrid& grid)
{
  const ImageGrid at = grid.IsOnPoints() ? grid : grid.AtCellCentres();
  vtkNew<vtkImageData> image;
  std::array<int, 6> extent = at.Extent();
  image->SetExtent(extent.data());
  image->SetOrigin(at.Origin()[0], at.Origin()[1], at.Origin()[2]);
  image->SetSpacing(at.Spacing()[0], at.Spacing()[1], at.Spacing()[2]);
  double direction[9];
  std::copy_n(at.Direction().data(), 9, direction);
  image->SetDirectionMatrix(direction);
  auto places = newArray<vtkDoubleArray>("Places", 3, image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    image->GetPoint(i, places->GetPointer(3 * i));
  }
  return places;
}

vtkSmartPointer<vtkDoubleArray> doublesOf(vtkPointData* values, const std::string& name)
{
  vtkDataArray* array = values->GetArray(name.c_str());
  auto doubles =
    newArray<vtkDoubleArray>(name, array->GetNumberOfComponents(), array->GetNumberOfTuples());
  doubles->DeepCopy(array);
  return doubles;
}

// Between two values, of which one alone counts at its end.
double between(double first, double second, double part)
{
  return part <= 0.0 ? first : part >= 1.0 ? second : (1.0 - part) * first + part * second;
}

} // namespace

bool isAdvected(const AdvectedImage& image, int owner, vtkAbstractArray* array)
{
  const bool isDensity = array && array->GetName() && image.Density == array->GetName() &&
    owner == (image.Grid.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL);
  return array && array->GetName() && !isDensity &&
    array->GetName() != std::string(vtkDataSetAttributes::GhostArrayName()) &&
    array->GetNumberOfTuples() == image.Image->GetNumberOfElements(owner);
}

void AdvectedArrays::Make(const AdvectedImage& first, const AdvectedImage& second,
  const MovingParticles& particles, const ImageGrid& geometry, Progress& progress)
{
  this->Arrays.clear();
  this->Lacking.clear();
  for (const int owner : { vtkDataObject::CELL, vtkDataObject::POINT })
  {
    this->MakeOf(owner, first, second, particles, geometry, progress);
  }
}

void AdvectedArrays::MakeOf(int owner, const AdvectedImage& first, const AdvectedImage& second,
  const MovingParticles& particles, const ImageGrid& geometry, Progress& progress)
{
  const auto find = [owner](const AdvectedImage& image, const char* name) {
    vtkAbstractArray* array = image.Image->GetAttributes(owner)->GetAbstractArray(name);
    return isAdvected(image, owner, array) ? array : nullptr;
  };
  std::vector<std::string> names;
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
      const vtkAbstractArray* there = find(*other, array->GetName());
      const bool isSame = there &&
        there->GetDataType() == const_cast<vtkAbstractArray*>(array)->GetDataType() &&
        there->GetNumberOfComponents() == array->GetNumberOfComponents();
      std::vector<std::string>& list = isSame ? names : this->Lacking;
      if (std::find(list.begin(), list.end(), array->GetName()) == list.end())
      {
        list.emplace_back(array->GetName());
      }
    }
  }
  const auto labels = std::stable_partition(names.begin(), names.end(),
    [&](const std::string& name) { return !isOfLabels(find(first, name.c_str())); });
  this->Labels[owner == vtkDataObject::POINT ? 1 : 0].Make(
    owner, { labels, names.end() }, first, second, particles);
  names.erase(labels, names.end());
  if (names.empty())
  {
    return;
  }
  const auto firstImage = imageWith(first.Image, owner, names);
  const auto secondImage = imageWith(second.Image, owner, names);
  const ImageGrid own = geometry.WithValuesOn(owner == vtkDataObject::POINT);
  const auto places = placesOf(own);
  const auto atFrom = sample(firstImage, first.Grid, particles.From, progress);
  const auto atTo = sample(secondImage, second.Grid, particles.To, progress);
  const auto firstInPlace = sample(firstImage, first.Grid, places, progress);
  const auto secondInPlace = sample(secondImage, second.Grid, places, progress);
  for (const std::string& name : names)
  {
    vtkDataArray* from = atFrom->GetArray(name.c_str());
    const auto like = vtkSmartPointer<vtkDataArray>::Take(from->NewInstance());
    like->SetNumberOfComponents(from->GetNumberOfComponents());
    like->CopyComponentNames(from);
    this->Arrays.push_back({ name, owner, like, { doublesOf(atFrom, name), doublesOf(atTo, name) },
      { doublesOf(firstInPlace, name), doublesOf(secondInPlace, name) } });
  }
}

void AdvectedArrays::Write(const AdvectedMoment& moment, const ImageGrid& geometry,
  const SplatOptions& splat, const Extent& wanted, Progress& progress, vtkImageData* output) const
{
  for (const int owner : { vtkDataObject::CELL, vtkDataObject::POINT })
  {
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
      if (!mass)
      {
        mass = newArray<vtkDoubleArray>("Mass", 1, box.Count());
        splatDistributed(moment.Clouds.Points, moment.Clouds.Masses, 0.0, moment.Numbers, target,
          box, progress, mass);
      }
      this->WriteOne(advected, moment, target, box, mass, progress, output);
    }
    const AdvectedLabels& labels = this->Labels[owner == vtkDataObject::POINT ? 1 : 0];
    labels.Write(moment, geometry, wanted, progress, output);
  }
}

void AdvectedArrays::WriteOne(const Advected& advected, const AdvectedMoment& moment,
  const SplatTarget& target, const TupleBox& wanted, vtkDoubleArray* mass, Progress& progress,
  vtkImageData* output) const
{
  const MovedClouds& clouds = moment.Clouds;
  const auto& [first, second] = advected.OfParticles;
  const auto& [firstHere, secondHere] = advected.InPlace;
  const int components = first->GetNumberOfComponents();
  const std::int64_t particles = clouds.Points->GetNumberOfTuples();
  const TupleBox all = tuplesOf(target.Geometry.Extent(), advected.Owner, target.Geometry.Extent());
  const auto made = vtkSmartPointer<vtkDataArray>::Take(advected.Like->NewInstance());
  made->SetName(advected.Name.c_str());
  made->SetNumberOfComponents(components);
  made->CopyComponentNames(advected.Like);
  withMemory("the array " + advected.Name, 8.0 * static_cast<double>(wanted.Count()) * components,
    [&]() { made->SetNumberOfTuples(wanted.Count()); });
  const auto moments = newArray<vtkDoubleArray>("Moments", 1, particles);
  const auto sums = newArray<vtkDoubleArray>("Sums", 1, wanted.Count());
  for (int c = 0; c < components; ++c)
  {
    double* moved = moments->GetPointer(0);
    const double* a = first->GetPointer(c) + components * clouds.First;
    const double* b = second->GetPointer(c) + components * clouds.First;
    progress.For(particles, grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        moved[i] = clouds.Masses[i] * between(a[components * i], b[components * i], clouds.Part);
      }
    });
    splatDistributed(clouds.Points, moved, 0.0, moment.Numbers, target, wanted, progress, sums);
    const double* here = firstHere->GetPointer(c);
    const double* later = secondHere->GetPointer(c);
    double* sum = sums->GetPointer(0);
    progress.For(wanted.Count(), grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t place = components * all.NumberOf(wanted.CellOf(i));
        const double weight = mass->GetValue(i);
        sum[i] = weight > 0.0 ? sum[i] / weight : between(here[place], later[place], clouds.Part);
      }
    });
    for (std::int64_t i = 0; i < wanted.Count(); ++i)
    {
      made->SetComponent(i, c, sum[i]);
    }
  }
  output->GetAttributes(advected.Owner)->AddArray(made);
}

} // namespace RectifiedTransport::Bridge
