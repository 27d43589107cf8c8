// SPDX-License-Identifier: BSD-3-Clause
// How a flow of a large density is cut in tiles. Particles are taken to one time, the hand-over, on
// graded tables (GradedTables.h), and from there on, forwards, by the tables of the tile that holds
// the centre of their box: boxes shrink, and each lies in the one before. Backwards the tiles come
// first. All follows from the grid, the number of steps, the direction and the maps.
//
// That boxes are nested: with tau = log(t / (1 - t)), the corners of B' (Eq. (10)) move with
//   da/dtau = m - a >= 0,   db/dtau = m - b <= 0,
// as the mean m (Eq. (11)) lies in B'. So tables of what the box at the hand-over covers are enough
// from there on.
#ifndef RectifiedTransport_TilePlan_h
#define RectifiedTransport_TilePlan_h

#include "Core/Flow/FlowMapShape.h"
#include "Core/Flow/FlowTables.h"
#include "Core/Flow/Tiles/GridTiles.h"
#include "Core/Geometry/GridSize.h"

#include <cstdint>

namespace RectifiedTransport
{

// The least width of a box on the graded tables over their strides. Measured at 256^3: the mean
// error of the finest lattice is 8 % larger than on exact tables, with 8 it is 35 % larger. More
// steps need no wider boxes.
constexpr double gradedRatio = 11.5;

// The strides of the graded tables of a grid, in proportion to its sizes; powers of two.
template <int Dimension>
GridSize<Dimension> gradedStrides(const GridSize<Dimension>& size, const TileLimits& limits = {});
// The bytes of graded tables.
template <int Dimension>
double gradedMemory(const GridSize<Dimension>& size, const GridSize<Dimension>& strides);

template <int Dimension>
struct TilePlan
{
  // Without a hand-over if steps are too few. With maps the finest lattice ends at the hand-over,
  // if there is any.
  TilePlan(const GridSize<Dimension>& size, int numberOfSteps, FlowDirection direction,
    bool hasMaps, const TileLimits& limits = {});

  bool IsPossible() const { return this->HandOver > 0; }
  // The tile of a particle: by its place at the hand-over forwards, at time 1 backwards.
  std::int64_t TileOf(const double* position) const;
  // The most bytes that an advection of so many particles, samples of a lattice or points in any
  // order, takes besides positions: tables, maps and what is noted of particles.
  double MemorySize(double particles, bool isLattice) const;
  // How many particles of an array go through the tiles together, and how many of those that no map
  // serves.
  static constexpr std::int64_t SortedParticles = std::int64_t{ 1 } << 25;
  std::int64_t ExtraParticles() const;

  GridSize<Dimension> Size;
  FlowMapShape<Dimension> Shape;
  int HandOver = 0; // steps between it and time 1
  double TimeLeft = 0.0;
  GridTiles<Dimension> Tiles; // their halo is what boxes reach

private:
  GridTiles<Dimension> ChooseTiles(const TileLimits& limits) const;

  GridSize<Dimension> Strides; // strides of the graded tables
  double InverseTime = 1.0;    // for box centres
};

} // namespace RectifiedTransport

#endif
