// SPDX-License-Identifier: BSD-3-Clause
// The masses of the triangles of a surface that was read: area, times a density.
#ifndef RectifiedTransport_SurfaceMasses_h
#define RectifiedTransport_SurfaceMasses_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/TriangleDomain.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include <cstdint>
#include <functional>
#include <string>

namespace RectifiedTransport
{
// The masses of triangles: their areas times a density.
struct TriangleMasses
{
  LargeBuffer<double> Masses; // shares of the surface's area, times the density
  double Sum = 0.0;
};

// The density at points is that at given points; its mean over a triangle is exact for linear
// interpolation. Triangles that are `isEmpty`, which may be null, have no mass. Throws
// std::bad_alloc and Cancelled.
TriangleMasses massesOf(const TriangleDomain& surface, const SurfaceDensityValues& density,
  const std::function<bool(std::int64_t)>& isEmpty, Progress& progress);

// A density per area at the points of a surface, or of its cells, which its triangles were cut
// from.
struct ReadDensity
{
  const double* Values = nullptr; // nullptr: 1 everywhere
  bool OnPoints = true;
  // First index of the points, or of the cells that are no lines or vertices.
  std::int64_t First = 0;
  std::int64_t Last = 0;                            // one beyond
  std::string Name;                                 // begins a sentence
  std::function<std::int64_t(std::int64_t)> CellOf; // a triangle's
  std::function<bool(std::int64_t)> IsGhost;        // a cell's; may be empty
};

class SurfaceMasses
{
public:
  // The mass of a triangle is its area times the mean of the density at its points, exact for
  // linear interpolation, or times the density of its cell. Ghost cells have no mass. Throws
  // Failure for densities that are negative or not finite and for a total mass that is
  // zero or not finite, std::bad_alloc and Cancelled.
  SurfaceMasses(const TriangleDomain& surface, const ReadDensity& density, Progress& progress);

  // The masses of the triangles, up to a factor.
  const double* Values() const { return this->Masses.Masses.data(); }
  // The total mass, in units of the density and of the surface as it was read.
  double Total() const { return this->Sum; }
  // The density relative to its largest value, so that no mass is past the largest double.
  SurfaceDensityValues Density() const;

private:
  void ReadRelative(std::int64_t triangles, const ReadDensity& density, Progress& progress);
  void FindTotal(const SurfaceAreas& areas, const ReadDensity& density);

  bool OnPoints;
  LargeBuffer<double> Relative; // by points or triangles; empty for 1 everywhere
  double Largest = 1.0;         // also if all values are 0
  TriangleMasses Masses;
  double Sum = 0.0;
};

} // namespace RectifiedTransport

#endif
