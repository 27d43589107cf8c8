// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces of triangles: whether a mesh is one, and its triangles with consistent
// orientation.
//
//   ClosedMesh mesh(std::move(coordinates));
//   if (mesh.Close(surface, ClosingDistances(bounds, false)).empty() && mesh.Orient())
//     coverSolid(mesh.Solid(), cells, 2, coverage);
#ifndef RectifiedTransport_ClosedMesh_h
#define RectifiedTransport_ClosedMesh_h

#include "../../Core/Parallel/Context.h"
#include "../../Core/Parallel/LargeBuffer.h"
#include "../Mesh/SurfaceEdges.h"
#include "../Mesh/TriangleSurface.h"
#include "SolidCoverage.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace RectifiedTransport
{

class ClosedMesh;
class ImageGrid;
class Progress;

// How far points may be apart where a surface is closed.
struct ClosingDistances
{
  // The triangles lie within these bounds, low and high along each axis. `areFloats`: coordinates
  // are rounded to single precision.
  ClosingDistances(const std::array<double, 6>& bounds, bool areFloats);

  // What rounding leaves of any coordinates, and of float ones: points nearer than that are merged,
  // and T-junctions within it are closed.
  std::array<double, 2> Near;
  // Then T-junctions that gape by the least of these that closes the surface.
  std::array<double, 4> Gaps;
};

// Points with equal coordinates are one point, for example if each face has its own points. A mesh
// is closed if each of its edges has two triangles or another even number. Duplicate triangles of
// the same direction count once; two of opposite directions cancel. Throws std::bad_alloc and
// Cancelled.
class ClosedMesh
{
public:
  // Three finite coordinates a point. Finds equal points by a hash table of the coordinates' bits,
  // in linear time for any distribution. Memory: 8 bytes a point, temporarily up to 32. Then call
  // Close(), or Reserve(), Add() and CountEdges().
  explicit ClosedMesh(LargeBuffer<double> coordinates, const Context& context = Context());

  // Calls Reserve() and Add() for all faces, as triangles on the points that FirstOf() gives.
  using AddFaces = std::function<void(ClosedMesh& mesh, Progress& progress)>;
  // Adds faces and counts edges. If the mesh is then open, closes it within the distances, as
  // little as that takes. Returns what is wrong with the surface if that is not possible, as the
  // predicate of a sentence, else an empty text.
  std::string Close(
    const AddFaces& add, const ClosingDistances& distances, const Context& context = Context());
  // The same with the triangles of a surface whose points the mesh has. Throws
  // std::invalid_argument for triangles with points that do not exist.
  std::string Close(const TriangleSurface& surface, const ClosingDistances& distances,
    const Context& context = Context());
  // Whether it was closed at T-junctions that gape by more than rounding.
  bool HadGaps() const { return this->ClosedGaps; }

  // For a mesh that is open after CountEdges(): begins again without triangles, and merges points
  // that differ by less than a distance along every axis (mergeNearPoints()), to close seams that
  // are open only by rounding. Returns whether there are such points; if not, the mesh is
  // unchanged.
  bool MergeNear(double distance, const Context& context = Context());
  // A part of the longest side of the bounds, far above the rounding of double.
  static constexpr double NearDistance = 1e-9;

  // The point that a point is merged into; not after CountEdges().
  std::int64_t FirstOf(std::int64_t point) const { return this->Firsts.data()[point]; }
  // Reserves memory for this number of triangles.
  void Reserve(std::int64_t triangles);
  // Adds a triangle, unless two of its corners are the same point: its other two sides are then one
  // edge.
  void Add(const std::array<std::int64_t, 3>& corners);
  // Counts edges, in O(triangles log triangles) for any number of triangles about a point. Memory:
  // 24 bytes a triangle, and temporarily as much again and 8 bytes a point.
  void CountEdges(const Context& context = Context());

  // After CountEdges(): if edges are open, cuts triangles at T-junctions (see TJunctions.h).
  // Returns whether the mesh is closed; if not, it is unchanged. Points may be off their edges by a
  // distance, to which the cut triangles then bend. Memory: up to 110 bytes a triangle.
  bool CloseTJunctions(double distance, const Context& context = Context());
  std::int64_t TJunctions() const { return this->NumberOfTJunctions; }
  // How far the farthest of their points was off its edge.
  double WidestGap() const { return this->Gap; }

  // The numbers of edges of one triangle, and of three or another odd number.
  std::int64_t OpenEdges() const { return this->NumberOpen; }
  std::int64_t NonManifoldEdges() const { return this->NumberNonManifold; }
  // Whether there are no such edges; false before CountEdges().
  bool IsClosed() const { return this->Closed; }

  // Reorders the corners of triangles of a closed mesh so that each component (triangles joined by
  // edges) has one orientation: that of most of its area, even if that is inside out. By the
  // winding number that is the same solid, and inside another one a cavity. At edges of four
  // triangles or more, unless the triangles agree already, inside is where the number of crossings
  // is odd. Returns false if there is no orientation, as for a Klein bottle, or the mesh is not
  // closed. Memory: 17 bytes a triangle. On one thread.
  bool Orient(const Context& context = Context());
  // The same for a mesh that stays open: each component gets the orientation of most of its area,
  // and all are turned if the volume towards their middle is negative.
  void OrientOpen(const Context& context = Context());

  // The points may be moved, for example to other coordinates; they stay merged as before.
  PointSpan<3> Points() { return { this->Coordinates.data(), this->Coordinates.size() / 3 }; }
  // Moves them to the index coordinates of a grid of equal cells. Coordinates are first rounded to
  // four units in the last place of the largest one within the bounds: smaller differences, as
  // between ranks, give the same bits.
  void MoveToCells(
    const ImageGrid& grid, const std::array<double, 6>& bounds, const Context& context = Context());
  TriangleSurface Surface() const;
  // The surface with the bodies that Orient() finds, for coverSolid(). Must not outlive this
  // object.
  SolidSurface Solid() const;

private:
  std::string Fill(const AddFaces& add, Progress& progress);
  bool CloseNear(const AddFaces& add, double distance, Progress& progress);
  bool CloseWithin(double distance, Progress& progress);
  std::string Openness() const;
  void DropRepeated(const Context& context);
  void CountEdgesAlone(const Context& context);

  LargeBuffer<double> Coordinates;     // three a point
  LargeBuffer<std::int64_t> Firsts;    // by points; released by CountEdges()
  LargeBuffer<std::int64_t> Triangles; // three points each
  LargeBuffer<std::int64_t> Bodies;    // by triangles; after Orient()
  std::int64_t NumberOfTriangles = 0;
  std::unique_ptr<SurfaceEdges> Edges;
  std::int64_t NumberOpen = 0;        // edges of one triangle
  std::int64_t NumberNonManifold = 0; // edges of three or another odd number
  std::int64_t NumberOfTJunctions = 0;
  double Gap = 0.0; // largest distance of a T-junction from its edge, in the points' units
  bool Closed = false;
  bool ClosedGaps = false;
  bool Oriented = false;
};

} // namespace RectifiedTransport

#endif
