// SPDX-License-Identifier: BSD-3-Clause
// Makes the triangles of a closed surface turn the same way.
#ifndef RectifiedTransport_SurfaceOrientation_h
#define RectifiedTransport_SurfaceOrientation_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Solid/SurfaceEdges.h"

#include <cstdint>

namespace RectifiedTransport
{

// A component, that is triangles joined by edges, keeps the orientation that most of its area has.
// A component that most of its area turns inside out stays so: to the winding number it is the same
// solid, and within another one a cavity.
class SurfaceOrientation
{
public:
  // Of a surface whose edges have two sides each. `points` holds three coordinates each. Throws
  // std::bad_alloc.
  SurfaceOrientation(
    const double* points, std::int64_t* triangles, std::int64_t count, const SurfaceEdges& edges);

  // Visits about as many triangles as asked for, and turns those of the components that are done.
  // Returns how many were visited, 0 once all are.
  std::int64_t Visit(std::int64_t most);

  // Triangles that would have to turn both ways, as on a Klein bottle.
  bool IsOrientable() const { return this->Orientable; }

private:
  double AreaOf(std::int64_t triangle) const;
  void VisitNeighbours(std::int64_t triangle);
  void FinishComponent();

  const double* Points;
  std::int64_t* Triangles;
  std::int64_t Count;
  const SurfaceEdges& Edges;
  LargeBuffer<signed char> Turns;  // 0 not visited, 1 as the component's first triangle, -1 not
  LargeBuffer<std::int64_t> Queue; // the triangles of a component after those of the others
  std::int64_t QueueBegin = 0;
  std::int64_t QueueNext = 0;
  std::int64_t QueueEnd = 0;
  std::int64_t Start = 0;
  double Area = 0.0; // of a component, turned as its first triangle less the rest
  bool Orientable = true;
};

} // namespace RectifiedTransport

#endif
