// SPDX-License-Identifier: BSD-3-Clause
// Loops over the points of an input, in double precision.
#ifndef RectifiedTransport_PointInput_h
#define RectifiedTransport_PointInput_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/NotFiniteValues.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Parallel/Reduction.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <array>
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

// What a pass over points finds. A Part sums up the finite points; Add joins two parts.
template <class Part>
struct PointFindings
{
  Part Found{};
  NotFiniteValues NotFinite;
};

template <class Part, class Visit>
struct PointPass
{
  const Visit& VisitPoint;
  PointFindings<Part> All;

  template <class ArrayT>
  void operator()(ArrayT* array, Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    const auto visitRange = [this, array](std::int64_t first, std::int64_t last) {
      PointFindings<Part> range;
      std::int64_t i = first;
      for (const auto tuple : vtk::DataArrayTupleRange<3>(array, first, last))
      {
        const double x[3] = { static_cast<double>(tuple[0]), static_cast<double>(tuple[1]),
          static_cast<double>(tuple[2]) };
        if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
        {
          this->VisitPoint(i, x, range.Found);
        }
        else
        {
          range.NotFinite.Add(i);
        }
        ++i;
      }
      return range;
    };
    const auto join = [](PointFindings<Part> all, const PointFindings<Part>& range) {
      all.Found.Add(range.Found);
      all.NotFinite.Add(range.NotFinite);
      return all;
    };
    this->All = reduceChunks(
      progress, array->GetNumberOfTuples(), grain, PointFindings<Part>(), visitRange, join);
  }
};

// Calls visit(i, x, part) for every finite point of a set, on several threads. Throws Cancelled.
template <class Part, class Visit>
PointFindings<Part> reducePoints(vtkPointSet* points, Progress& progress, const Visit& visit)
{
  PointPass<Part, Visit> pass{ visit, {} };
  if (points && points->GetNumberOfPoints() > 0)
  {
    vtkDataArray* coordinates = points->GetPoints()->GetData();
    using Dispatch = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>;
    if (!Dispatch::Execute(coordinates, pass, progress))
    {
      pass(coordinates, progress);
    }
  }
  return pass.All;
}

// Calls visit(i, x) for every point of a set, on several threads. Throws Failure for
// coordinates that are not finite, naming the input as `what`, and Cancelled.
template <class Visit>
void visitPoints(
  vtkPointSet* points, const std::string& what, Progress& progress, const Visit& visit)
{
  const auto visitOnly = [&](std::int64_t i, const double* x, NotFiniteValues&) { visit(i, x); };
  const NotFiniteValues notFinite =
    reducePoints<NotFiniteValues>(points, progress, visitOnly).NotFinite;
  if (notFinite.Count > 0)
  {
    throw Failure(
      "The " + what + " " + notFinite.Text("point") + "; all coordinates must be finite");
  }
}

} // namespace RectifiedTransport::Bridge

#endif
