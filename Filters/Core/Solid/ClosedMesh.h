// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces of triangles: whether a mesh is one, and its triangles with one orientation.
//
//   ClosedMesh mesh(surface);
//   if (mesh.IsClosed() && mesh.Orient())
//     coverSolid(mesh.Surface(), cells, 2, coverage);
#ifndef RectifiedTransport_ClosedMesh_h
#define RectifiedTransport_ClosedMesh_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Mesh/TriangleSurface.h"

#include <array>
#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

class SurfaceEdges;

// Points of equal coordinates are one point, as where each face has points of its own. A mesh is
// closed where each of its edges is one of exactly two triangles. Throws std::bad_alloc and
// Cancelled.
class ClosedMesh
{
public:
  // Copies a surface, merges its points and counts its edges. Throws std::invalid_argument for
  // coordinates that are not finite, and triangles of points that there are not.
  explicit ClosedMesh(const TriangleSurface& surface, const Context& context = Context());

  // The same in steps, for faces that have yet to be cut into triangles. First the points, three
  // finite coordinates each: finds those that are equal, by a hash table of the coordinates' bits,
  // in linear time for any distribution. Memory: 8 bytes a point, up to 32 meanwhile. Then
  // Reserve(), Add() and CountEdges().
  explicit ClosedMesh(LargeBuffer<double> coordinates, const Context& context = Context());
  ~ClosedMesh();
  ClosedMesh(ClosedMesh&&) noexcept;
  ClosedMesh& operator=(ClosedMesh&&) noexcept;

  // The first of the points that are equal to a point; not after CountEdges().
  std::int64_t FirstOf(std::int64_t point) const { return this->Firsts.data()[point]; }
  // Provides memory for as many triangles.
  void Reserve(std::int64_t triangles);
  // Adds a triangle, unless two of its corners are one point: its other two sides are then one
  // edge.
  void Add(const std::array<std::int64_t, 3>& corners);
  // Counts edges, in O(triangles log triangles) for any number of triangles about a point. Memory:
  // 24 bytes a triangle, and as much again and 8 bytes a point meanwhile.
  void CountEdges(const Context& context = Context());

  // Edges of one triangle, and of more than two.
  std::int64_t OpenEdges() const { return this->NumberOpen; }
  std::int64_t NonManifoldEdges() const { return this->NumberNonManifold; }
  // No such edges; false before CountEdges().
  bool IsClosed() const { return this->Closed; }

  // Reorders the corners of triangles of a closed mesh so that those of each component, that is
  // triangles joined by edges, have one orientation: that of most of its area, even if that is
  // inside out. By the winding number that is the same solid, and within another one a cavity.
  // Returns false if there is none, as for a Klein bottle, or the mesh is not closed. Memory: 9
  // bytes a triangle. On one thread.
  bool Orient(const Context& context = Context());

  // The points may be moved, as to other coordinates; they stay merged as they were.
  PointSpan<3> Points() { return { this->Coordinates.data(), this->Coordinates.size() / 3 }; }
  TriangleSurface Surface() const;

private:
  void Merge(const Context& context);

  LargeBuffer<double> Coordinates;
  LargeBuffer<std::int64_t> Firsts;
  LargeBuffer<std::int64_t> Triangles;
  std::int64_t NumberOfTriangles = 0;
  std::unique_ptr<SurfaceEdges> Edges;
  std::int64_t NumberOpen = 0;
  std::int64_t NumberNonManifold = 0;
  bool Closed = false;
  bool Oriented = false;
};

} // namespace RectifiedTransport

#endif
