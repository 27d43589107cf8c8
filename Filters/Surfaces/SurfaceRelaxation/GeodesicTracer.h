// SPDX-License-Identifier: BSD-3-Clause
// Geodesics on a triangle surface: they go straight ahead over edges, and along boundaries.
#ifndef RectifiedTransport_GeodesicTracer_h
#define RectifiedTransport_GeodesicTracer_h

#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/PlaceOnTriangle.h"
#include "Surfaces/Mesh/Repair/SplitSurface.h"
#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <optional>

namespace RectifiedTransport
{

class Progress;

// Where one is: in space, on a triangle.
struct SurfacePlace
{
  Point<3> X;
  std::int64_t Triangle;
};

// Any triangles: points with equal coordinates are one point, and triangles on one edge are
// neighbours, whichever way they turn. Of more than two, those that continue each other most
// straightly are neighbours; one that is left over ends there. Triangles are cut at T-junctions
// (see TJunctions.h); "given" are those before.
class GeodesicTracer
{
public:
  // What is across a side: another side, or one of these.
  static constexpr std::int64_t Boundary = -1;
  static constexpr std::int64_t Wall = -2; // there is surface, but no way

  // Keeps a view of the triangles. Coordinates may be off by `rounding`. Throws
  // std::invalid_argument, std::bad_alloc and Cancelled.
  GeodesicTracer(const TriangleSurface& surface, double rounding, Progress& progress);
  // Bytes that the constructor takes at most, about; without T-junctions, 32 a triangle less.
  static double MemoryFor(std::int64_t points, std::int64_t triangles);

  const TriangleSurface& Given() const { return this->GivenSurface; }
  std::int64_t GivenTriangle(std::int64_t triangle) const
  {
    return this->Split ? this->Split->GivenTriangle(triangle) : triangle;
  }
  bool IsPart(std::int64_t triangle) const { return this->Split && this->Split->IsPart(triangle); }
  PlaceOnTriangle GivenPlace(const PlaceOnTriangle& place) const
  {
    return this->Split ? this->Split->GivenPlace(place) : place;
  }

  std::int64_t NumberOfTriangles() const { return this->Count; }
  const std::int64_t* Triangle(std::int64_t triangle) const
  {
    return this->Triangles + 3 * triangle;
  }
  // In a frame in which the surface is in the box [-1/2, 1/2]^3.
  Point<3> Corner(std::int64_t triangle, std::int64_t corner) const
  {
    return this->Start(3 * triangle + corner);
  }
  // The area in that frame. It is 0 for flat triangles, which have no height beyond rounding.
  double Area(std::int64_t triangle) const;

  // Side 3t+i of triangle t goes from its corner i to the next: where it begins, and its vector.
  Point<3> Start(std::int64_t side) const
  {
    const double* x = this->Positions.data() + 3 * this->Triangles[side];
    return { x[0], x[1], x[2] };
  }
  Point<3> Edge(std::int64_t side) const { return this->Start(nextSide(side)) - this->Start(side); }
  std::int64_t Across(std::int64_t side) const { return this->Sides.data()[side]; }
  // Puts Boundary or Wall across a side.
  void Close(std::int64_t side, std::int64_t with) { this->Sides.data()[side] = with; }

  // Traces a geodesic by a vector, of which only the part in the triangle's plane counts. It may
  // pass triangles where `levels`, if not null, is 0, but does not end in one.
  void Trace(SurfacePlace& place, const Point<3>& by, const double* levels) const;
  PlaceOnTriangle WeightsOf(const SurfacePlace& place) const;

  std::int64_t WeldedPoints() const { return this->NumberWelded; }
  std::int64_t TJunctions() const { return this->Split ? this->Split->NumberOfTJunctions() : 0; }
  std::int64_t OpenEdges() const { return this->NumberOpen; }
  std::int64_t NonManifoldEdges() const { return this->NumberNonManifold; }

private:
  struct Frame; // what a geodesic needs of a triangle

  void PairSides(const std::int64_t* welded, std::int64_t points, Progress& progress);
  bool IsLine(std::int64_t triangle, const std::int64_t* welded) const;
  bool Cut(const std::int64_t* welded, double rounding, Progress& progress);
  void PairEdge(const std::int64_t* sides, std::int64_t count);
  Point<3> Inwards(std::int64_t side) const;
  Point<3> Along(std::int64_t side) const;
  std::int64_t Beyond(std::int64_t side, const Point<3>& x) const;

  TriangleSurface GivenSurface;
  std::optional<SplitSurface> Split; // if there are T-junctions
  const std::int64_t* Triangles;
  std::int64_t Count;              // number of triangles, cut or given
  LargeBuffer<double> Positions;   // three a point, in the box [-1/2, 1/2]^3
  LargeBuffer<std::int64_t> Sides; // what is across, by sides
  std::int64_t NumberWelded = 0;
  std::int64_t NumberOpen = 0;
  std::int64_t NumberNonManifold = 0;
};

} // namespace RectifiedTransport

#endif
