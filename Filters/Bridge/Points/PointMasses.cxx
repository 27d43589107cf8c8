// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/PointMasses.h"

#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/NumbersOfText.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <cmath>
#include <cstdint>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

// The sums over a range of points, in the order of their indices.
struct RangeOfMasses
{
  double Sum = 0.0;
  double Sizes = 0.0;
  std::int64_t NotFinite = 0;
  std::int64_t First = -1;
};

RangeOfMasses joinRanges(RangeOfMasses all, const RangeOfMasses& range)
{
  all.Sum += range.Sum;
  all.Sizes += range.Sizes;
  all.First = all.NotFinite == 0 ? range.First : all.First;
  all.NotFinite += range.NotFinite;
  return all;
}

// Copies values, or 1 each; 0 for ghosts.
class ReadMasses
{
public:
  ReadMasses(const unsigned char* ghosts, double* masses, std::int64_t count)
    : Ghosts(ghosts)
    , Masses(masses)
    , Count(count)
  {
  }

  template <class ArrayT>
  void operator()(ArrayT* array, Progress& progress)
  {
    this->ReadAll(progress, [this, array](std::int64_t first, std::int64_t last) {
      const auto values = vtk::DataArrayValueRange<1>(array, first, last);
      auto value = values.begin();
      return this->Read(first, last, [&value]() { return static_cast<double>(*value++); });
    });
  }

  void ReadOnes(Progress& progress)
  {
    this->ReadAll(progress, [this](std::int64_t first, std::int64_t last) {
      return this->Read(first, last, []() { return 1.0; });
    });
  }

  const RangeOfMasses& All() const { return this->Found; }

private:
  template <class ReadRange>
  void ReadAll(Progress& progress, const ReadRange& read)
  {
    this->Found =
      reduceChunks(progress, this->Count, PointMasses::Chunk, RangeOfMasses{}, read, joinRanges);
  }

  template <class Next>
  RangeOfMasses Read(std::int64_t first, std::int64_t last, const Next& next) const
  {
    RangeOfMasses range;
    for (std::int64_t i = first; i < last; ++i)
    {
      const double value = next();
      const bool isGhost = this->Ghosts && (this->Ghosts[i] & ghostPoint) != 0;
      if (!isGhost && !std::isfinite(value))
      {
        range.First = range.NotFinite++ == 0 ? i : range.First;
      }
      this->Masses[i] = isGhost ? 0.0 : value;
      range.Sum += this->Masses[i];
      range.Sizes += std::abs(this->Masses[i]);
    }
    return range;
  }

  const unsigned char* Ghosts;
  double* Masses;
  std::int64_t Count;
  RangeOfMasses Found;
};

vtkSmartPointer<vtkDataArray> requireMasses(
  vtkPointSet* points, vtkAbstractArray* found, const std::string& text)
{
  const NumbersOfText numbers = numbersOf(found);
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

PointMasses::PointMasses(vtkPointSet* points, vtkDataArray* array, Progress& progress)
{
  const vtkIdType count = points->GetNumberOfPoints();
  const unsigned char* ghosts = ghostFlags(points, vtkDataObject::POINT, "input point set");
  if (!array && !ghosts)
  {
    this->Sum = static_cast<double>(count);
    this->Sizes = this->Sum;
    return;
  }
  this->Masses = newArray<vtkDoubleArray>("Mass", 1, count);
  ReadMasses read(ghosts, this->Masses->GetPointer(0), count);
  using Dispatch = vtkArrayDispatch::Dispatch;
  if (!array)
  {
    read.ReadOnes(progress);
  }
  else if (!Dispatch::Execute(array, read, progress))
  {
    read(array, progress);
  }
  const RangeOfMasses all = read.All();
  this->Sum = all.Sum;
  this->Sizes = all.Sizes;
  const char* name = array ? array->GetName() : nullptr;
  std::ostringstream message;
  message << "The mass array '" << (name ? name : "") << "' ";
  if (all.NotFinite > 0)
  {
    message << "has " << all.NotFinite
            << (all.NotFinite == 1 ? " value that is" : " values that are")
            << " NaN or infinite, the first at index " << all.First
            << "; all masses must be finite";
    throw Failure(message.str());
  }
  if (!std::isfinite(all.Sum))
  {
    message << "sums to " << all.Sum << "; the sum must be a double";
    throw Failure(message.str());
  }
}

} // namespace RectifiedTransport::Bridge
