// SPDX-License-Identifier: BSD-3-Clause
// Finds the triangle of a plane mesh that contains a point.
#ifndef RectifiedTransport_FlatLocator_h
#define RectifiedTransport_FlatLocator_h

#include "../../Core/Geometry/Points.h"
#include "../../Core/Parallel/Context.h"
#include "../../Core/Parallel/LargeBuffer.h"
#include "../../Core/Parallel/Progress.h"
#include "../Mesh/PlaceOnTriangle.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// A mesh in the unit square. `Masses`, if not null, has a value for each triangle: triangles of
// mass 0 are not found.
struct FlatMesh
{
  ConstPointSpan<2> Positions;
  const std::int64_t* Triangles; // three points each
  std::int64_t NumberOfTriangles;
  const double* Masses = nullptr;
  Point<2> Lengths{ 1.0, 1.0 }; // lengths of the square's sides, for distances; each > 0
};

// A tree of bounding boxes, divided at the median along their longer axis: triangles of very uneven
// sizes cost no more than equal ones. The mesh must outlive it.
class FlatLocator
{
public:
  // O(triangles log triangles). Memory: about 80 bytes a triangle. Throws std::invalid_argument if
  // no triangle has mass, std::bad_alloc and Cancelled.
  explicit FlatLocator(const FlatMesh& mesh, const Context& context = Context());

  // The place of a point: in the triangle that contains it and turns left, the first if there are
  // several (on an edge, or where the map folds), decided without rounding. If a map covers the
  // square, there is always one; triangles that turn right lie below others. A point in no triangle
  // gets the nearest place on an edge.
  PlaceOnTriangle Locate(const Point<2>& point) const;

private:
  struct Item
  {
    double Centre[2]; // centre of the triangle's bounds
    std::int64_t Triangle;
  };
  // The bounds of the triangles [First, Last) of Items. The first child is the next box, Second the
  // other, -1 in a leaf.
  struct Box
  {
    double Low[2];
    double High[2];
    std::int64_t First;
    std::int64_t Last;
    std::int64_t Second;
  };
  struct Nearest;

  const double* Corner(std::int64_t triangle, int corner) const
  {
    return this->Mesh.Positions[this->Mesh.Triangles[3 * triangle + corner]];
  }
  void ReadTriangles(Progress& progress);
  void Build(Progress& progress);
  void Bound(Box& box, Progress& progress) const;
  std::int64_t Divide(const Box& box, Progress& progress);
  std::int64_t FirstContaining(const double* point, std::int64_t box, std::int64_t best) const;
  bool Contains(std::int64_t triangle, const double* point) const;
  double Gap(const double* point, std::int64_t box) const;
  void FindNearest(const double* point, std::int64_t box, Nearest& best) const;
  PlaceOnTriangle NearestPlace(std::int64_t triangle, const double* point) const;
  double SquaredDistance(const PlaceOnTriangle& place, const double* point) const;

  FlatMesh Mesh;
  LargeBuffer<Item> Items; // triangles with mass, in the order of the tree
  std::int64_t NumberOfItems = 0;
  std::vector<Box> Boxes;
};

} // namespace RectifiedTransport

#endif
