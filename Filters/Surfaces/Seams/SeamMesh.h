// SPDX-License-Identifier: BSD-3-Clause
// One component of a surface, and the seams along which it is cut.
#ifndef RectifiedTransport_SeamMesh_h
#define RectifiedTransport_SeamMesh_h

#include "Core/Geometry/Points.h"
#include "Core/Geometry/Trees/Bins.h"
#include "Core/Parallel/Context.h"
#include "Surfaces/Mesh/SurfaceEdges.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Triangles joined by edges of at most two triangles; those about a point form one fan. Their
// orientations need not agree. An edge is named by either of its sides (see SurfaceEdges).
class SeamMesh
{
public:
  // `origins`, by triangles: an edge between two triangles of one origin is never a seam. Memory:
  // 90 bytes a triangle, 40 a point. Throws std::bad_alloc and Cancelled.
  SeamMesh(std::vector<Point<3>> points, std::vector<std::int64_t> triangles,
    std::vector<std::int64_t> origins, const Context& context = Context());

  // The same component with further points and triangles, after those that there are.
  SeamMesh With(const std::vector<Point<3>>& points, const std::vector<std::int64_t>& triangles,
    const std::vector<std::int64_t>& origins, const Context& context = Context()) const;

  std::int64_t NumberOfPoints() const { return static_cast<std::int64_t>(this->Points.size()); }
  std::int64_t NumberOfTriangles() const { return this->NumberOfSides() / 3; }
  std::int64_t NumberOfSides() const { return static_cast<std::int64_t>(this->Triangles.size()); }
  std::int64_t NumberOfEdges() const { return (this->NumberOfSides() + this->Edges->Open()) / 2; }
  // Points - edges + triangles: 2 for a sphere, 1 for a disk and, closed, for the projective plane,
  // less for others.
  std::int64_t EulerCharacteristic() const
  {
    return this->NumberOfPoints() - this->NumberOfEdges() + this->NumberOfTriangles();
  }

  const Point<3>& Position(std::int64_t point) const
  {
    return this->Points[static_cast<std::size_t>(point)];
  }
  std::int64_t From(std::int64_t side) const
  {
    return this->Triangles[static_cast<std::size_t>(side)];
  }
  std::int64_t To(std::int64_t side) const { return this->From(nextSide(side)); }
  // -1 on the boundary.
  std::int64_t Other(std::int64_t side) const { return this->Edges->Other(side); }
  // The end of an edge that is not the given one.
  std::int64_t OtherEnd(std::int64_t side, std::int64_t end) const
  {
    return this->From(side) == end ? this->To(side) : this->From(side);
  }
  // The Euclidean length of an edge.
  double Length(std::int64_t side) const;
  double LengthOf(const std::vector<std::int64_t>& sides) const;
  // Whether a side stands for its edge: the lower one of the two does, and that of a boundary.
  bool IsFirst(std::int64_t side) const
  {
    return this->Other(side) < 0 || side < this->Other(side);
  }
  // Not the boundary, and not an edge within a given triangle that was split.
  bool MayBeSeam(std::int64_t side) const
  {
    return this->Other(side) >= 0 && this->OriginOf(side) != this->OriginOf(this->Other(side));
  }

  // Calls visit(side, neighbour) once for each edge at a point. `side` is the edge's first.
  template <class Visit>
  void VisitEdges(std::int64_t point, const Visit& visit) const
  {
    // A triangle at the point has two of its edges: the one that begins there, and the last one
    // before.
    this->VisitCorners(point, [&](std::int64_t side) {
      const std::int64_t last = lastSide(side);
      if (this->IsFirst(side))
      {
        visit(side, this->To(side));
      }
      if (this->IsFirst(last))
      {
        visit(last, this->From(last));
      }
    });
  }
  // Calls visit(side) for the side that begins at each corner at a point.
  template <class Visit>
  void VisitCorners(std::int64_t point, const Visit& visit) const
  {
    for (const std::int64_t side : this->Corners[static_cast<std::size_t>(point)])
    {
      visit(side);
    }
  }

  // The boundary, too, is a seam; it does not change.
  bool IsSeam(std::int64_t side) const { return this->Seams[static_cast<std::size_t>(side)] != 0; }
  void SetSeam(std::int64_t side, bool isSeam);
  void SetSeams(const std::vector<std::int64_t>& sides, bool isSeam);
  // The number of seams at a point.
  int SeamsAt(std::int64_t point) const { return this->Degrees[static_cast<std::size_t>(point)]; }
  bool IsOnSeam(std::int64_t point) const { return this->SeamsAt(point) > 0; }
  bool IsClosed() const { return this->Edges->Open() == 0; }

  // The triangles cut along the seams.
  struct Cut
  {
    std::vector<std::int64_t> Triangles; // three points each, in the order of the triangles
    std::vector<std::int64_t> Origins;   // by points of the cut: the points that they are copies of
  };
  // Throws std::bad_alloc and Cancelled.
  Cut MakeCut(Progress& progress) const;

private:
  std::int64_t OriginOf(std::int64_t side) const
  {
    return this->Origins[static_cast<std::size_t>(side / 3)];
  }

  std::vector<Point<3>> Points;        // in units of the largest coordinate
  std::vector<std::int64_t> Triangles; // three points each
  std::vector<std::int64_t> Origins;   // by triangles
  std::unique_ptr<SurfaceEdges> Edges;
  Bins<std::int64_t> Corners;       // by points
  std::vector<unsigned char> Seams; // by sides
  std::vector<int> Degrees;         // numbers of seams, by points
};

// Joins the corners of two triangles, each named by the side that begins there, across an edge that
// they share. Orientations may differ: the sides of the edge run in opposite directions if they
// agree, else in the same one. `join(a, b)` is called for both ends of the edge.
template <class Join>
void joinCorners(
  const std::int64_t* triangles, std::int64_t side, std::int64_t other, const Join& join)
{
  const bool isOpposite = triangles[side] != triangles[other];
  join(side, isOpposite ? nextSide(other) : other);
  join(nextSide(side), isOpposite ? other : nextSide(other));
}

} // namespace RectifiedTransport

#endif
