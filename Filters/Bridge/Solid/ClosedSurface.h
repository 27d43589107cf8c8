// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a closed surface of triangles.
#ifndef RectifiedTransport_ClosedSurface_h
#define RectifiedTransport_ClosedSurface_h

#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Solid/MergePoints.h"
#include "Core/Solid/SolidCoverage.h"
#include "Core/Solid/SurfaceEdges.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class SolidGrid;

// The bounds of the points that polygons and strips use; the first is above the second if there are
// none.
std::array<double, 6> polygonBounds(vtkPolyData* surface);

class ClosedSurface
{
public:
  // Merges points of equal coordinates and cuts polygons and strips into triangles, as stages of
  // the run up to the progress `end`; lines and vertices do not count. Throws Failure where the
  // input has no polygons, coordinates that are not finite, or edges that have not two triangles,
  // and Aborted.
  ClosedSurface(vtkPolyData* input, const Executor& executor, AlgorithmProgress& host, double end);

  // Gives the points in cells of a grid, and the triangles of each component one orientation, as
  // stages up to the progress `end`. Throws Failure where there is no orientation, and Aborted.
  TriangleSurface InCells(
    const SolidGrid& grid, const Executor& executor, AlgorithmProgress& host, double end);

private:
  void EnterPoints(AlgorithmProgress& host);
  vtkSmartPointer<vtkCellArray> MergeCorners(vtkCellArray* polygons, AlgorithmProgress& host) const;
  void ReadTriangles(vtkCellArray* triangles, const Executor& executor, AlgorithmProgress& host);
  void DropDegenerateTriangles(AlgorithmProgress& host);
  void RequireClosed(const Executor& executor, AlgorithmProgress& host, double end);
  void Orient(AlgorithmProgress& host);

  LargeBuffer<double> Points;
  LargeBuffer<std::int64_t> Triangles;
  std::int64_t NumberOfPoints;
  std::int64_t Count = 0; // of triangles
  std::unique_ptr<MergePoints> Equal;
  std::unique_ptr<SurfaceEdges> Edges;
};

} // namespace RectifiedTransport

#endif
