// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces of triangles: whether a mesh is one, and its triangles with one orientation.
//
//   ClosedMesh mesh(surface);
//   if (mesh.IsClosed() && mesh.Orient())
//     coverSolid(mesh.Solid(), cells, 2, coverage);
#ifndef RectifiedTransport_ClosedMesh_h
#define RectifiedTransport_ClosedMesh_h

#include "../Mesh/TriangleSurface.h"
#include "../Parallel/Context.h"
#include "../Parallel/LargeBuffer.h"
#include "SolidCoverage.h"

#include <array>
#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

class SurfaceEdges;

// Points of equal coordinates are one point, as where each face has points of its own. A mesh is
// closed where each of its edges has two triangles or another even number. Triangles of the same
// three points and direction count once, and two of opposite directions not at all. Throws
// std::bad_alloc and Cancelled.
class ClosedMesh
{
public:
  // Copies a surface, merges its points and counts its edges. If it is open so, points nearer than
  // NearDistance times the longest side of the triangles' bounds are merged, too. Throws
  // std::invalid_argument for coordinates that are not finite, and triangles of points that there
  // are not.
  explicit ClosedMesh(const TriangleSurface& surface, const Context& context = Context());

  // The same in steps, for faces that have yet to be cut into triangles. First the points, three
  // finite coordinates each: finds those that are equal, by a hash table of the coordinates' bits,
  // in linear time for any distribution. Memory: 8 bytes a point, up to 32 meanwhile. Then
  // Reserve(), Add() and CountEdges().
  explicit ClosedMesh(LargeBuffer<double> coordinates, const Context& context = Context());
  ~ClosedMesh();
  ClosedMesh(ClosedMesh&&) noexcept;
  ClosedMesh& operator=(ClosedMesh&&) noexcept;

  // For a mesh that CountEdges() finds to be open: begins again without triangles, and merges
  // points that differ by less than a distance along every axis (mergeNearPoints()): seams that
  // close but for rounding. Returns whether there are any; else the mesh is what it was.
  bool MergeNear(double distance, const Context& context = Context());
  static constexpr double NearDistance = 1e-9;

  // The one that a point is merged into; not after CountEdges().
  std::int64_t FirstOf(std::int64_t point) const { return this->Firsts.data()[point]; }
  // Provides memory for as many triangles.
  void Reserve(std::int64_t triangles);
  // Adds a triangle, unless two of its corners are one point: its other two sides are then one
  // edge.
  void Add(const std::array<std::int64_t, 3>& corners);
  // Counts edges, in O(triangles log triangles) for any number of triangles about a point. Memory:
  // 24 bytes a triangle, and as much again and 8 bytes a point meanwhile.
  void CountEdges(const Context& context = Context());

  // Edges of one triangle, and of three or another odd number.
  std::int64_t OpenEdges() const { return this->NumberOpen; }
  std::int64_t NonManifoldEdges() const { return this->NumberNonManifold; }
  // No such edges; false before CountEdges().
  bool IsClosed() const { return this->Closed; }

  // Reorders the corners of triangles of a closed mesh so that those of each component, that is
  // triangles joined by edges, have one orientation: that of most of its area, even if that is
  // inside out. By the winding number that is the same solid, and within another one a cavity.
  // Of edges of four triangles or more inside is what an odd number of crossings says, unless
  // the triangles agree as they are. Returns false if there is none, as for a
  // Klein bottle, or the mesh is not closed. Memory: 17 bytes a triangle. On one thread.
  bool Orient(const Context& context = Context());

  // The points may be moved, as to other coordinates; they stay merged as they were.
  PointSpan<3> Points() { return { this->Coordinates.data(), this->Coordinates.size() / 3 }; }
  TriangleSurface Surface() const;
  // The same with the bodies that Orient() finds, for coverSolid(). Must not outlive this object.
  SolidSurface Solid() const;

private:
  void Merge(const Context& context);
  double LongestSide() const;
  void DropRepeated(const Context& context);
  void CountEdgesAlone(const Context& context);

  LargeBuffer<double> Coordinates;
  LargeBuffer<std::int64_t> Firsts;
  LargeBuffer<std::int64_t> Triangles;
  LargeBuffer<std::int64_t> Bodies;
  std::int64_t NumberOfTriangles = 0;
  std::unique_ptr<SurfaceEdges> Edges;
  std::int64_t NumberOpen = 0;
  std::int64_t NumberNonManifold = 0;
  bool Closed = false;
  bool Oriented = false;
};

} // namespace RectifiedTransport

#endif
