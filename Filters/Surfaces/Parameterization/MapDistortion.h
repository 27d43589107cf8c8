// SPDX-License-Identifier: BSD-3-Clause
// How a map of a disk to the unit square changes areas and angles.
#ifndef RectifiedTransport_MapDistortion_h
#define RectifiedTransport_MapDistortion_h

#include "../../Core/Geometry/Points.h"
#include "../../Core/Parallel/Context.h"
#include "../Mesh/DiskMesh.h"
#include "../Mesh/TriangleSurface.h"

#include <cstdint>

namespace RectifiedTransport
{

// Triangles without area in the square would have an infinite distortion and make the mean useless.
constexpr double MaximumAngleDistortion = 1e3;

struct TriangleDistortion
{
  // The triangle's share of the square divided by its share of the surface; negative if the
  // triangle is turned over.
  double Area;
  // The quotient of the singular values of the map, 1 to MaximumAngleDistortion.
  double Angle;
  bool IsFlipped; // its area in the square is not positive
};

// Triangles with their shares of the surface's area, each > 0.
struct MeasuredTriangles
{
  TriangleSurface Surface;
  const double* AreaShares;
};

MeasuredTriangles measuredTriangles(const DiskMesh& disk);

TriangleDistortion distortionOf(
  const MeasuredTriangles& triangles, ConstPointSpan<2> positions, std::int64_t triangle);
TriangleDistortion distortionOf(
  const DiskMesh& disk, ConstPointSpan<2> positions, std::int64_t triangle);

// Over the surface: means, quantiles and parts weight triangles by the surface's area. The
// deviation of an area distortion q is |q - 1|.
struct MapDistortion
{
  double AreaRootMeanSquare; // root mean square of the deviation
  double AreaMedian;         // median deviation
  double Area95;             // 95 % of the surface deviates by no more
  double AngleMean;          // mean of the quotients of the singular values
  std::int64_t Flipped;      // number of triangles
  // Flipped triangles whose height is below NeedleHeight times their longest side; included in
  // Flipped.
  std::int64_t FlippedNeedles;
  static constexpr double NeedleHeight = 1e-4;
};

MapDistortion measureDistortion(const MeasuredTriangles& triangles, ConstPointSpan<2> positions,
  const Context& context = Context());
MapDistortion measureDistortion(
  const DiskMesh& disk, ConstPointSpan<2> positions, const Context& context = Context());

} // namespace RectifiedTransport

#endif
