// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/SampledArrays.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkArrayDispatch.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace RectifiedTransport
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
      const vtkIdType tuples = set->GetNumberOfElements(type);
      if (own->GetNumberOfTuples() < tuples)
      {
        throw Failure("The " + owner + " array '" + name + "' of the " + source.Name + " has " +
          std::to_string(own->GetNumberOfTuples()) + " tuples; it must have one for each of the " +
          std::to_string(tuples) + " " + owner + "s");
      }
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
  requireMemory(purpose, bytes);
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
  withMemory(purpose, bytes, [&]() { made->SetNumberOfTuples(static_cast<vtkIdType>(tuples)); });
  return made;
}

// Writes tuples of an array whose values lie apart in memory: on any threads.
struct SampleValues
{
  template <class Array>
  void operator()(Array* first, const NewArray& array, vtkDataArray* to,
    const SampledPlaces& places, bool ofCells, Progress& progress) const
  {
    using Value = vtk::GetAPIType<Array>;
    std::vector<decltype(vtk::DataArrayTupleRange(first))> sets;
    for (vtkAbstractArray* from : array.From)
    {
      sets.push_back(vtk::DataArrayTupleRange(vtkArrayDownCast<Array>(from)));
    }
    auto found = vtk::DataArrayTupleRange(vtkArrayDownCast<Array>(to));
    const auto components = static_cast<vtk::ComponentIdType>(first->GetNumberOfComponents());
    progress.For(
      places.Count(), Grain,
      [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i)
        {
          const SampledPlace place = places.Find(i);
          auto tuple = found[static_cast<vtk::TupleIdType>(i)];
          if (place.Cell < 0)
          {
            constexpr bool hasNaN = std::numeric_limits<Value>::has_quiet_NaN;
            tuple.fill(hasNaN ? std::numeric_limits<Value>::quiet_NaN() : Value(0));
            continue;
          }
          const auto& given = sets[static_cast<std::size_t>(place.Set)];
          if (ofCells)
          {
            tuple = given[static_cast<vtk::TupleIdType>(place.Cell)];
            continue;
          }
          for (vtk::ComponentIdType c = 0; c < components; ++c)
          {
            double sum = 0.0;
            for (int k = 0; k < place.Count; ++k)
            {
              sum += place.Weights[k] * static_cast<double>(given[place.Points[k]][c]);
            }
            Value value;
            vtkMath::RoundDoubleToIntegralIfNecessary(sum, &value);
            tuple[c] = value;
          }
        }
      },
      Units);
  }
};

// Of strings, bits and the like.
void sampleTuples(const NewArray& array, vtkAbstractArray* to, const SampledPlaces& places,
  bool ofCells, Progress& progress)
{
  vtkNew<vtkIdList> points;
  progress.ForInOrder(
    places.Count(), Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        SampledPlace place = places.Find(i);
        vtkAbstractArray* from = array.From[static_cast<std::size_t>(place.Set)];
        if (place.Cell < 0)
        {
          points->Reset();
          to->InterpolateTuple(static_cast<vtkIdType>(i), points, from, nullptr);
          continue;
        }
        if (ofCells)
        {
          to->SetTuple(static_cast<vtkIdType>(i), place.Cell, from);
          continue;
        }
        points->SetNumberOfIds(place.Count);
        std::copy_n(place.Points, place.Count, points->GetPointer(0));
        to->InterpolateTuple(static_cast<vtkIdType>(i), points, from, place.Weights);
      }
    },
    Units);
}

void sample(const std::vector<NewArray>& arrays, const SampledPlaces& places, bool ofCells,
  bool keepActive, Progress& progress, double end, vtkPointData* output)
{
  const double begin = progress.StageEnd();
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    const NewArray& array = arrays[i];
    progress.BeginStage(
      begin + (end - begin) * static_cast<double>(i + 1) / static_cast<double>(arrays.size()));
    const auto made = makeLike(array.From.front(), places.Count());
    auto* from = vtkDataArray::SafeDownCast(array.From.front());
    auto* to = vtkDataArray::SafeDownCast(made);
    if (!from || from->GetDataType() == VTK_BIT ||
      !vtkArrayDispatch::Dispatch::Execute(
        from, SampleValues(), array, to, places, ofCells, progress))
    {
      sampleTuples(array, made, places, ofCells, progress);
    }
    const int index = output->AddArray(made);
    if (keepActive && array.Attribute >= 0 && !output->GetAbstractAttribute(array.Attribute))
    {
      output->SetActiveAttribute(index, array.Attribute);
    }
  }
}

} // namespace

void sampleArrays(const ArraySource& source, const SampledPlaces& places, Progress& progress,
  double end, vtkPointData* output)
{
  vtkDataSet* data = source.Sets.front();
  const auto ofPointsAlone = static_cast<double>(data->GetPointData()->GetNumberOfArrays());
  const double all = ofPointsAlone + data->GetCellData()->GetNumberOfArrays();
  const double begin = progress.StageEnd();
  const double middle = begin + (end - begin) * ofPointsAlone / std::max(all, 1.0);
  sample(
    newArrays(source, false, output), places, false, source.KeepActive, progress, middle, output);
  sample(newArrays(source, true, output), places, true, false, progress, end, output);
}

} // namespace RectifiedTransport
