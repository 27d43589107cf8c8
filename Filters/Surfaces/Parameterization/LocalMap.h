// SPDX-License-Identifier: BSD-3-Clause
// A part of a map of a disk to the unit square. Its points may move while all others stay.
#ifndef RectifiedTransport_LocalMap_h
#define RectifiedTransport_LocalMap_h

#include "Core/Algebra/SparseCholesky.h"
#include "Core/Geometry/Trees/Bins.h"
#include "Surfaces/Parameterization/ConformalMap.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// The unknowns of a triangle's corners, x and y of each; -1 if a coordinate is fixed.
using TriangleUnknowns = std::array<int, 6>;
using TriangleVector = std::array<double, 6>;
using TriangleMatrix = std::array<TriangleVector, 6>; // symmetric

// A symmetric system, summed over triangles. The pattern is analysed once.
class LocalSystem
{
public:
  // `triangles` have the unknowns of each triangle's corners, 0 to unknowns - 1.
  LocalSystem(std::vector<TriangleUnknowns> triangles, int unknowns);

  // Makes the matrix and the right side 0.
  void Clear();
  // Adds the term of a triangle to the matrix and the right side, except in fixed coordinates.
  void Add(std::size_t triangle, const TriangleMatrix& matrix, const TriangleVector& right);
  // Adds `part` of each diagonal value to it: Levenberg-Marquardt damping with Marquardt's scaling.
  void Damp(double part);
  // Writes the solution by unknowns. Returns false if there is none. Throws Cancelled.
  bool Solve(std::vector<double>& solution, Progress& progress);

private:
  std::vector<TriangleUnknowns> Triangles;
  std::vector<std::array<int, 21>> Places; // in the matrix's values, by triangles and pairs
  SparseCholesky::Matrix Matrix;           // lower triangle, compressed columns
  SparseCholesky::Vector Right;
  SparseCholesky Factor;
};

// The triangles about each point of a disk.
class PointTriangles
{
public:
  explicit PointTriangles(const DiskMesh& disk);

  Bins<std::int64_t>::Range operator[](std::int64_t point) const
  {
    return this->Triangles[static_cast<std::size_t>(point)];
  }
  // Calls visit(other) for the corners of these triangles.
  template <class Visit>
  void VisitCorners(std::int64_t point, const Visit& visit) const
  {
    for (const std::int64_t triangle : (*this)[point])
    {
      std::for_each_n(this->Disk.Triangle(triangle), 3, visit);
    }
  }

private:
  const DiskMesh& Disk;
  Bins<std::int64_t> Triangles;
};

// What all parts of a map share.
struct MapParts
{
  explicit MapParts(const DiskMesh& disk, const SquareMap& square)
    : Disk(disk)
    , Square(square)
    , Triangles(disk)
  {
  }

  const DiskMesh& Disk;
  const SquareMap& Square; // for the sides that points stay on
  PointTriangles Triangles;
};

// Whether the three points of a triangle are on one side of the square: it has no area there.
bool isCollapsed(const DiskMesh& disk, const SquareMap& square, std::int64_t triangle);

struct CollapsedTriangles
{
  std::int64_t Count = 0;
  double AreaShare = 0.0; // their share of the surface's area
};

CollapsedTriangles findCollapsed(const DiskMesh& disk, const SquareMap& square);

// Twice the area of a triangle, positive if it turns left.
inline double crossProduct(const Point<2>& a, const Point<2>& b, const Point<2>& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// The area of a triangle in a map.
inline double imageArea(
  const DiskMesh& disk, const std::vector<Point<2>>& positions, std::int64_t triangle)
{
  const std::int64_t* ids = disk.Triangle(triangle);
  const auto at = [&](int i) { return positions[static_cast<std::size_t>(ids[i])]; };
  return 0.5 * crossProduct(at(0), at(1), at(2));
}

// The triangles about some points, with local numbers for their corners.
class LocalMap
{
public:
  // `points` are ascending and may move; the other corners of their triangles are fixed.
  LocalMap(const MapParts& parts, const std::vector<std::int64_t>& points,
    const std::vector<Point<2>>& positions);

  std::size_t NumberOfTriangles() const { return this->Corners.size(); }
  // The triangle's number in the disk.
  std::int64_t IdOf(std::size_t triangle) const { return this->Ids[triangle]; }
  // Its share of the surface's area.
  double ShareOf(std::size_t triangle) const { return this->Shares[triangle]; }
  const std::array<int, 3>& CornersOf(std::size_t triangle) const
  {
    return this->Corners[triangle];
  }
  // Its three corners are on one side of the square.
  bool IsCollapsed(std::size_t triangle) const { return this->Collapsed[triangle] != 0; }
  LocalSystem MakeSystem() const;
  int NumberOfUnknowns() const { return this->Unknowns; }

  const std::vector<Point<2>>& Positions() const { return this->Current; }
  double AreaOf(std::size_t triangle, const std::vector<Point<2>>& positions) const
  {
    const std::array<int, 3>& c = this->Corners[triangle];
    return 0.5 *
      crossProduct(positions[static_cast<std::size_t>(c[0])],
        positions[static_cast<std::size_t>(c[1])], positions[static_cast<std::size_t>(c[2])]);
  }
  // The derivatives of a triangle's area by the coordinates of its corners.
  TriangleVector AreaGradient(std::size_t triangle) const;
  // The displacement of a corner by a solution.
  Point<2> MoveOf(int corner, const std::vector<double>& solution) const;
  // Moves by the first of a step and its halves at which energy(positions) is less. Returns the
  // step; 0 if none of `halvings` steps is such.
  template <class Energy>
  double Descend(
    const std::vector<double>& solution, double step, int halvings, const Energy& energy)
  {
    const double before = energy(this->Current);
    std::vector<Point<2>> moved;
    for (int i = 0; i < halvings; ++i, step *= 0.5)
    {
      this->Move(solution, step, moved);
      if (energy(moved) < before)
      {
        this->Current = std::move(moved);
        return step;
      }
    }
    return 0.0;
  }
  // Writes the positions of the points that may move.
  void Store(std::vector<Point<2>>& positions) const;

private:
  // Positions moved by `step` times a solution, kept in the square.
  void Move(const std::vector<double>& solution, double step, std::vector<Point<2>>& moved) const;

  std::vector<std::int64_t> Points;           // global ids by corners, ascending
  std::vector<std::array<int, 2>> UnknownsOf; // unknowns of x and y, by corners; -1 if fixed
  std::vector<std::int64_t> Ids;              // global ids by triangles, ascending
  std::vector<double> Shares;                 // parts of the surface's area, by triangles
  std::vector<std::array<int, 3>> Corners;    // local numbers, by triangles
  std::vector<unsigned char> Collapsed;
  std::vector<unsigned char> IsFree;
  std::vector<Point<2>> Current; // positions by corners, in [0,1]^2
  int Unknowns = 0;              // number of unknowns
};

} // namespace RectifiedTransport

#endif
