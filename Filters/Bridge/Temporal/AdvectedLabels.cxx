// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/AdvectedLabels.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/AdvectedArrays.h"
#include "Bridge/Temporal/MovingParticles.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"

#include "vtkBitArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <functional>
#include <unordered_map>

namespace RectifiedTransport::Bridge
{

namespace
{

// The cell of a grid at an index, or the nearest one.
template <int D>
vtkIdType cellAt(const GridSize<D>& size, double* index)
{
  GridSize<D> cell;
  for (int axis = 0; axis < D; ++axis)
  {
    const double last = static_cast<double>(size[axis]) - 0.5;
    cell[axis] = static_cast<std::int64_t>(std::clamp(index[axis], 0.0, last));
  }
  return static_cast<vtkIdType>(LatticePart<D>::WholeOf(size).NumberOf(cell));
}

template <int D>
vtkIdType tupleIn(const ImageGrid& grid, const double* x)
{
  double index[D];
  grid.ToIndex<D>(x, index);
  return cellAt<D>(grid.Size<D>(), index);
}

vtkIdType tupleAt(const ImageGrid& grid, const double* x)
{
  return dispatchDimension(grid.Dimension(), tupleIn<1>, tupleIn<2>, tupleIn<3>)(grid, x);
}

// Appends those of all parts of the clouds, whose lengths are in cells; none for lengths of 1.
template <int D>
void addTuples(const ImageGrid& grid, vtkDoubleArray* points, const std::vector<float>& lengths,
  vtkIdType before, std::size_t end, BroughtTuples& tuples)
{
  const GridSize<D> size = grid.Size<D>();
  for (vtkIdType i = 0; i < points->GetNumberOfTuples(); ++i)
  {
    double centre[D];
    grid.ToIndex<D>(points->GetPointer(3 * i), centre);
    for (int part = 0; part < tuples.Parts; ++part)
    {
      double index[D];
      for (int axis = 0; axis < D; ++axis)
      {
        const double length =
          lengths.empty() ? 1.0 : lengths[static_cast<std::size_t>(D * i + axis)];
        index[axis] = centre[axis] + tuples.OffsetOf(part, axis) * length;
      }
      tuples.At[end].push_back(before + cellAt<D>(size, index));
    }
  }
}

template <int D>
bool isWithin(const ImageGrid& grid, const double* x)
{
  double index[D];
  return grid.NearestIndex<D>(x, index);
}

bool contains(const ImageGrid& grid, const double* x)
{
  return dispatchDimension(grid.Dimension(), isWithin<1>, isWithin<2>, isWithin<3>)(grid, x);
}

template <int D>
Eigen::Vector3d centreIn(const ImageGrid& grid, const TupleBox& box, std::int64_t number)
{
  const GridSize<D> cell = latticePartOf<D>(box, grid).CellOf(number);
  double index[D];
  for (int axis = 0; axis < D; ++axis)
  {
    index[axis] = static_cast<double>(cell[axis]) + 0.5;
  }
  Eigen::Vector3d x;
  grid.ToPhysical<D>(index, x.data());
  return x;
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

std::vector<vtkIdType> findEqual(const std::array<vtkSmartPointer<vtkAbstractArray>, 2>& arrays)
{
  std::vector<vtkIdType> equal;
  std::unordered_map<std::string, vtkIdType> known;
  for (vtkAbstractArray* array : arrays)
  {
    std::string before;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      const auto number = static_cast<vtkIdType>(equal.size());
      std::string key = keyOf(array, i);
      // Neighbours are often equal.
      equal.push_back(
        i > 0 && key == before ? equal.back() : known.try_emplace(key, number).first->second);
      before = std::move(key);
    }
  }
  return equal;
}

} // namespace

bool isOfLabels(vtkAbstractArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_DOUBLE && type != VTK_FLOAT;
}

void AdvectedLabels::Make(int owner, const std::vector<std::string>& names,
  const AdvectedImage& first, const AdvectedImage& second, const MovingParticles& particles)
{
  this->Owner = owner;
  this->Arrays.clear();
  const bool onPoints = owner == vtkDataObject::POINT;
  this->Grids = { first.Grid.WithValuesOn(onPoints), second.Grid.WithValuesOn(onPoints) };
  for (const std::string& name : names)
  {
    const auto arrayOf = [&](const AdvectedImage& image) {
      return copyOf(image.Image->GetAttributes(owner)->GetAbstractArray(name.c_str()));
    };
    Labels labels{ name, { arrayOf(first), arrayOf(second) }, {} };
    const double tuples = static_cast<double>(
      labels.Arrays[0]->GetNumberOfTuples() + labels.Arrays[1]->GetNumberOfTuples());
    withMemory(
      "the labels of " + name, 48.0 * tuples, [&]() { labels.Equal = findEqual(labels.Arrays); });
    this->Arrays.push_back(std::move(labels));
  }
  this->OfParticles = {};
  if (names.empty())
  {
    return;
  }
  const int dimension = first.Grid.Dimension();
  const bool isAcross = first.Grid.IsOnPoints() != onPoints;
  this->OfParticles.Parts = isAcross ? 1 << dimension : 1;
  const auto add = dispatchDimension(dimension, addTuples<1>, addTuples<2>, addTuples<3>);
  const double bytes =
    2.0 * sizeof(vtkIdType) * this->OfParticles.Parts * static_cast<double>(particles.Count());
  withMemory("the labels that move along", bytes, [&]() {
    add(this->Grids[0], particles.From, particles.Sizes.From, 0, 0, this->OfParticles);
    add(this->Grids[1], particles.To, particles.Sizes.To,
      static_cast<vtkIdType>(this->Grids[0].NumberOfCells()), 1, this->OfParticles);
  });
}

// Takes the step that is nearer in time, if both have the place or neither has.
vtkIdType AdvectedLabels::InPlace(
  const ImageGrid& grid, const TupleBox& box, std::int64_t number, double part) const
{
  const Eigen::Vector3d x =
    dispatchDimension(grid.Dimension(), centreIn<1>, centreIn<2>, centreIn<3>)(grid, box, number);
  const bool isInFirst = contains(this->Grids[0], x.data());
  const bool isInSecond = contains(this->Grids[1], x.data());
  const bool isFirst = isInFirst == isInSecond ? part <= 0.5 : isInFirst;
  return isFirst
    ? tupleAt(this->Grids[0], x.data())
    : tupleAt(this->Grids[1], x.data()) + static_cast<vtkIdType>(this->Grids[0].NumberOfCells());
}

void AdvectedLabels::Write(const AdvectedMoment& moment, const ImageGrid& geometry,
  const Extent& wanted, Progress& progress, vtkImageData* output) const
{
  if (this->Arrays.empty())
  {
    return;
  }
  const ImageGrid own = geometry.WithValuesOn(this->Owner == vtkDataObject::POINT);
  const TupleBox box = tuplesOf(wanted, this->Owner, geometry.Extent());
  const auto vote =
    dispatchDimension(own.Dimension(), makeLabelVotes<1>, makeLabelVotes<2>, makeLabelVotes<3>);
  const std::unique_ptr<LabelVotes> votes = vote(moment, this->OfParticles, own, box, progress);
  const auto ofFirst = static_cast<vtkIdType>(this->Grids[0].NumberOfCells());
  for (const Labels& labels : this->Arrays)
  {
    std::vector<vtkIdType> tuples = votes->Count(labels.Equal, progress);
    const auto made = vtkSmartPointer<vtkAbstractArray>::Take(labels.Arrays[0]->NewInstance());
    made->SetName(labels.Name.c_str());
    made->SetNumberOfComponents(labels.Arrays[0]->GetNumberOfComponents());
    made->CopyComponentNames(labels.Arrays[0]);
    withMemory("the array " + labels.Name,
      8.0 * static_cast<double>(box.Count()) * made->GetNumberOfComponents(),
      [&]() { made->SetNumberOfTuples(box.Count()); });
    for (vtkIdType i = 0; i < box.Count(); ++i)
    {
      vtkIdType tuple = tuples[static_cast<std::size_t>(i)];
      if (tuple < 0)
      {
        tuple = this->InPlace(own, box, i, moment.Clouds.Part);
      }
      const bool isFirst = tuple < ofFirst;
      made->SetTuple(i, isFirst ? tuple : tuple - ofFirst, labels.Arrays[isFirst ? 0 : 1]);
    }
    output->GetAttributes(this->Owner)->AddArray(made);
  }
}

} // namespace RectifiedTransport::Bridge
