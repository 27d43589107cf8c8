// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/PointMasses.h"

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/TextToNumbers.h"
#include "Core/Messages/NotFiniteValues.h"
#include "Core/Parallel/Reduction.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// The sums over a range of points, in the order of their indices.
struct RangeOfMasses
{
  double Sum = 0.0;
  double Sizes = 0.0;
  NotFiniteValues NotFinite;
};

// Ranges are joined from the first to the last one, so that sums round in one order.
RangeOfMasses joinRanges(RangeOfMasses all, const RangeOfMasses& range)
{
  all.Sum += range.Sum;
  all.Sizes += range.Sizes;
  all.NotFinite.Add(range.NotFinite);
  return all;
}

// Copies values; 0 for ghosts.
struct ReadMasses
{
  const unsigned char* Ghosts;
  double* Masses;
  RangeOfMasses Found;

  // For each type and layout of arrays that VTK dispatches, and for vtkDataArray, whose values come
  // by virtual calls. Threads write disjoint ranges of Masses.
  template <class ArrayT>
  void operator()(ArrayT* array, Progress& progress)
  {
    const auto read = [this, array](std::int64_t first, std::int64_t last) {
      RangeOfMasses range;
      std::int64_t i = first;
      for (const auto given : vtk::DataArrayValueRange<1>(array, first, last))
      {
        const auto value = static_cast<double>(given);
        // A ghost point counts on the rank that owns it. Its value may be anything, also not a
        // number.
        const bool isGhost = this->Ghosts && (this->Ghosts[i] & ghostPoint) != 0;
        if (!isGhost && !std::isfinite(value))
        {
          range.NotFinite.Add(i);
        }
        this->Masses[i] = isGhost ? 0.0 : value;
        range.Sum += this->Masses[i];
        range.Sizes += std::abs(this->Masses[i]);
        ++i;
      }
      return range;
    };
    this->Found = reduceChunks(
      progress, array->GetNumberOfTuples(), PointMasses::Chunk, RangeOfMasses(), read, joinRanges);
  }
};

// The array as numbers, with one value a point. Throws Failure, which `text` begins, if it is not.
vtkSmartPointer<vtkDataArray> requireMasses(
  vtkPointSet* points, vtkAbstractArray* found, const std::string& text)
{
  const TextToNumbers numbers = parseNumbers(found);
  if (!numbers.Array)
  {
    throw Failure(text + " is not numeric (" + numbers.Wrong + "); the input has " +
      listArrays(points->GetPointData(), "point"));
  }
  requireScalars(numbers.Array, text, points->GetNumberOfPoints(), "points");
  return numbers.Array;
}

} // namespace

vtkSmartPointer<vtkDataArray> findMasses(vtkPointSet* points, int attribute)
{
  // ParaView and programs may choose "the active scalars" without a name. Attributes may be texts,
  // such as pedigree ids.
  vtkAbstractArray* found = points->GetPointData()->GetAbstractAttribute(attribute);
  if (!found)
  {
    const char* kind = vtkDataSetAttributes::GetAttributeTypeAsString(attribute);
    throw Failure("The input's points have no active " + std::string(kind ? kind : "attribute") +
      " to take the masses from; they have " + listArrays(points->GetPointData(), "point"));
  }
  const char* name = found->GetName();
  return requireMasses(points, found, "The mass array '" + std::string(name ? name : "") + "'");
}

vtkSmartPointer<vtkDataArray> findMasses(vtkPointSet* points, const std::string& name)
{
  vtkAbstractArray* found =
    name.empty() ? nullptr : points->GetPointData()->GetAbstractArray(name.c_str());
  // "None" is what ParaView's list writes for no choice, unless an array has this name.
  if (!found && (name.empty() || name == "None"))
  {
    return nullptr;
  }
  if (!found)
  {
    throw Failure("The input has no mass array '" + name + "'; it has " +
      listArrays(points->GetPointData(), "point"));
  }
  return requireMasses(points, found, "The mass array '" + name + "'");
}

// Masses are doubles, one a point, 0 for ghosts. They are summed in fixed chunks, so that the sum
// is the same for every number of threads. Sizes is the sum of |m|, which bounds the rounding of
// sums.
PointMasses::PointMasses(vtkPointSet* points, vtkDataArray* array, Progress& progress)
{
  const vtkIdType count = points->GetNumberOfPoints();
  const unsigned char* ghosts = ghostFlags(points, vtkDataObject::POINT, "input point set");
  // Each point has the mass 1, which needs no array. The sums are exact.
  if (!array && !ghosts)
  {
    this->Sum = static_cast<double>(count);
    this->Sizes = this->Sum;
    return;
  }
  this->Masses = newArray<vtkDoubleArray>("Mass", 1, count);
  ReadMasses read{ ghosts, this->Masses->GetPointer(0), {} };
  if (!array)
  {
    this->Masses->Fill(1.0);
  }
  // Without an array the ones themselves are read, and those of ghosts become 0 in place.
  vtkDataArray* from = array ? array : this->Masses.Get();
  if (!vtkArrayDispatch::Dispatch::Execute(from, read, progress))
  {
    read(from, progress);
  }
  this->Sum = read.Found.Sum;
  this->Sizes = read.Found.Sizes;
  const std::string title =
    "The mass array '" + std::string(array && array->GetName() ? array->GetName() : "") + "' ";
  if (read.Found.NotFinite.Count > 0)
  {
    throw Failure(title + read.Found.NotFinite.Text("value") + "; all masses must be finite");
  }
  // Masses that are finite may still sum beyond the largest double.
  if (!std::isfinite(this->Sum))
  {
    fail(title, "sums to ", this->Sum, "; the sum must be a double");
  }
}

} // namespace RectifiedTransport::Bridge
