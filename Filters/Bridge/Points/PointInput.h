// SPDX-License-Identifier: BSD-3-Clause
// Loops over the points of an input, in double precision.
#ifndef RectifiedTransport_PointInput_h
#define RectifiedTransport_PointInput_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The point set of a port, nullptr if there is none. Throws Failure for a block of another type,
// which executives do not check.
vtkPointSet* pointSetOf(vtkInformationVector* port);

// The bounds of all finite points of a set, also of points that no vtkCell uses.
// vtkPointSet::GetBounds caches its result, which is outdated if coordinates were changed without
// Modified(); vtkBoundingBox::ComputeBounds takes 100 ns a point. `points` may be nullptr. Without
// points, lower bounds are above the upper ones. Collective, for the points of all ranks.
void findBounds(vtkPointSet* points, const Ranks& ranks, double bounds[6]);
// The same on the ranks of the progress. Throws Cancelled.
void findBounds(vtkPointSet* points, Progress& progress, double bounds[6]);
// The union of the bounds of all ranks, without those whose lower bounds are above the upper ones.
// Collective.
std::array<double, 6> boundsOfAll(const Ranks& ranks, const std::array<double, 6>& own);

// Counts points whose coordinates are not finite; thread-safe.
class NotFinitePoints
{
public:
  void Add(std::int64_t count, std::int64_t first);
  // Throws Failure with their number if there are any; `what` names the input.
  void RequireNone(const std::string& what) const;

private:
  std::atomic<std::int64_t> Count{ 0 };
  std::atomic<std::int64_t> First{ -1 };
};

// Calls visit(i, x) for the points of a range of tuples.
template <class Visit>
class PointPass
{
public:
  explicit PointPass(const Visit& visit)
    : VisitPoint(visit)
  {
  }

  template <class ArrayT>
  void operator()(ArrayT* array, Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    progress.For(
      array->GetNumberOfTuples(), grain, [this, array](std::int64_t first, std::int64_t last) {
        this->Range(vtk::DataArrayTupleRange<3>(array, first, last), first);
      });
  }

  NotFinitePoints NotFinite;

private:
  template <class Tuples>
  void Range(const Tuples& tuples, std::int64_t first)
  {
    std::int64_t notFinite = 0;
    std::int64_t firstNotFinite = -1;
    std::int64_t i = first;
    for (const auto tuple : tuples)
    {
      const double x[3] = { static_cast<double>(tuple[0]), static_cast<double>(tuple[1]),
        static_cast<double>(tuple[2]) };
      if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
      {
        this->VisitPoint(i, x);
      }
      else
      {
        firstNotFinite = notFinite++ == 0 ? i : firstNotFinite;
      }
      ++i;
    }
    if (notFinite > 0)
    {
      this->NotFinite.Add(notFinite, firstNotFinite);
    }
  }

  const Visit& VisitPoint;
};

// Calls visit(i, x) for every point of a set, on several threads. Throws Failure for
// coordinates that are not finite, naming the input as `what`, and Cancelled.
template <class Visit>
void visitPoints(
  vtkPointSet* points, const std::string& what, Progress& progress, const Visit& visit)
{
  if (points->GetNumberOfPoints() == 0)
  {
    return;
  }
  PointPass<Visit> pass(visit);
  vtkDataArray* coordinates = points->GetPoints()->GetData();
  using Dispatch = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>;
  if (!Dispatch::Execute(coordinates, pass, progress))
  {
    pass(coordinates, progress);
  }
  pass.NotFinite.RequireNone(what);
}

} // namespace RectifiedTransport::Bridge

#endif
