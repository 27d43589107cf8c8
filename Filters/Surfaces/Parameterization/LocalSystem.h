// SPDX-License-Identifier: BSD-3-Clause
// Linear systems for the positions of a few points of a map, with a term for each triangle.
#ifndef RectifiedTransport_LocalSystem_h
#define RectifiedTransport_LocalSystem_h

#include "Core/Algebra/SparseCholesky.h"

#include <array>
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

} // namespace RectifiedTransport

#endif
