// SPDX-License-Identifier: BSD-3-Clause
// Barycentric embeddings of disks in the unit square with areas near those of the surface.
#ifndef RectifiedTransport_TutteEmbedding_h
#define RectifiedTransport_TutteEmbedding_h

#include "Core/Parallel/Context.h"
#include "Surfaces/Mesh/DiskMesh.h"
#include "Surfaces/Parameterization/ConformalMap.h"

namespace RectifiedTransport
{

// Each inner point is a weighted mean of its neighbours (Tutte 1963, doi:10.1112/plms/s3-13.1.743),
// so no triangle is flipped. At first the weights are the cotangents of the Laplacian where these
// are positive. Then they fall where the map squeezes areas and grow where it stretches them, as
// Yoshizawa, Belyaev and Seidel (Shape Modeling International 2004) do with the stretch; several
// times, until areas no longer become more even. Boundary points are on the sides by their lengths
// on the surface. A conformal map squeezes bays of a long boundary by many orders of magnitude;
// this one does not.
//
// Corners and sides are those of `conformal`. Cost: up to 12 sparse Cholesky factorizations, 3
// above 2^17 points, about O(points^1.5) each. Memory: that of mapConformally. On one thread. The
// result has flipped triangles only by rounding, and collapsed ones as every map to the square.
// Throws std::bad_alloc and Cancelled.
SquareMap tutteEmbedding(
  const DiskMesh& disk, const SquareMap& conformal, const Context& context = Context());

// How far a map is from one that keeps areas: sqrt(sum over triangles of s log(A / s)^2), where s
// is the share of the surface's area and A the area in the square, taken as at least 1e-10 s. The
// angles of the area-preserving map are worse where this is large.
double areaDistortion(const DiskMesh& disk, const std::vector<Point<2>>& positions);

} // namespace RectifiedTransport

#endif
