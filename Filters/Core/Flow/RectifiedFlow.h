// SPDX-License-Identifier: BSD-3-Clause
// Linear-time transport between the uniform measure on a box and a density, after Do, Coeurjolly,
// Memari and Bonneel, "Linear-Time Transport with Rectified Flows", ACM TOG 44(4), 2025,
// doi:10.1145/3731147. All coordinates are in index space: cell i covers [i, i+1].
//
//   const std::vector<float> density = ...;                         // 640 x 480 values, x fastest
//   DensityArray<2, float> source(density.data(), { 640, 480 });
//   std::vector<Point<2>> seeds = ...;                              // uniform in the box
//   auto particles = transportPoints<2>(source, seeds);             // one-off
//
//   RectifiedFlow<2> flow(source);                                  // stores the tables
//   FlowOptions options;
//   options.NumberOfSteps = 64;
//   flow.Forward(seeds, particles, options);
//   flow.Backward(particles, seeds, options);
#ifndef RectifiedTransport_RectifiedFlow_h
#define RectifiedTransport_RectifiedFlow_h

#include "../Geometry/GridSize.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "../Tables/Density.h"
#include "FlowOptions.h"
#include "FlowSeeds.h"
#include "FlowTables.h"
#include "NoMemoryForFlowMap.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class FlowEngine;
class StepChoiceCache;

// The summed-area tables of one density and the flow that they define. Construction costs
// O(cells), an advection O(particles * steps * 2^Dimension). Const members may run concurrently.
// Every particle's result depends on its seed, the density and the options alone, to the last bit;
// with FlowMaps::Auto also on how many particles there are, and with times on the first of them.
// Advections are collective: the particles are those of all ranks of the context, each of which has
// the density and gives its own part of the particles. Throws InvalidDensity,
// std::invalid_argument (options, sizes), std::bad_alloc (NoMemoryForFlowMap where FlowMaps::Off
// may do) and Cancelled.
template <int Dimension>
class RectifiedFlow final
{
public:
  explicit RectifiedFlow(
    const DensitySource<Dimension>& density, const Context& context = Context());
  // Tiled is for densities, in 2D and 3D, whose tables are too large for the memory: the values
  // must outlive the flow, as every advection reads them again. It takes Multistep with
  // Interpolated alone, in enough steps, without times before the end, and not to cells: else, and
  // for MeasureOfShare, it throws std::invalid_argument. Results differ from those of whole tables
  // by less than the error of either. With tiles of a distributed density, whatever takes a context
  // is collective, and no rank has more of the density at a time than about its share, or a tile.
  RectifiedFlow(const DensitySource<Dimension>& density, FlowTables tables,
    const Context& context = Context(), const TileLimits& limits = {});
  // The same in the memory of `previous`, if its tables are as large: for a density that changes
  // with time. Takes about half the time that new memory takes, and never allocates both tables.
  RectifiedFlow(const DensitySource<Dimension>& density, RectifiedFlow&& previous,
    const Context& context = Context());
  ~RectifiedFlow();
  RectifiedFlow(RectifiedFlow&&) noexcept;
  RectifiedFlow& operator=(RectifiedFlow&&) noexcept;

  const GridSize<Dimension>& Size() const { return this->Cells; }
  double Total() const;                  // sum of the density over the cells
  const DensitySummary& Summary() const; // sums and extremes of the density's values
  Point<Dimension> Centroid() const;     // the density's, in index space
  std::int64_t MemorySize() const;       // bytes that the tables and the kept flow maps hold
  // About the bytes of the tables of a density, before they are made. Flow maps are at most half as
  // large in each direction.
  static double MemoryFor(const GridSize<Dimension>& size);
  // The most bytes that a flow with tiles takes, while it advects so many particles, samples of a
  // lattice or an array of points, besides the positions; options for which tiles serve.
  static double TiledMemoryFor(const GridSize<Dimension>& size, const FlowOptions& options,
    FlowDirection direction, double particles, bool isLattice, const TileLimits& limits = {});
  // The same while it computes MeasuresOfShares of so many boxes.
  static double TiledSharesMemoryFor(const GridSize<Dimension>& size,
    const Point<Dimension>& aspect, double boxes, const TileLimits& limits = {});
  // For flows with tiles: the values are now at another place in memory.
  void SetDensity(const DensitySource<Dimension>& density);
  // Whether the grid cell that holds a point has mass (a point on a face: any of its cells).
  bool HasMass(const Point<Dimension>& point) const;
  // To be called before Share of boxes in these grid cells. Collective, for a density on ranks.
  void PrepareShares(const GridSize<Dimension>& low, const GridSize<Dimension>& high) const;
  // The share of the mass in a box.
  double Share(const Point<Dimension>& low, const Point<Dimension>& high) const;
  // The measure, in grid cells, of the part in the domain of the smallest box about a point that
  // holds a share of the mass; the sides of the box are in proportion to `aspect`.
  double MeasureOfShare(
    const Point<Dimension>& centre, const Point<Dimension>& aspect, double share) const;
  // The same for many points and their shares, which may be in the memory of the measures. With
  // tiles, too: then the measures of boxes that reach far beyond a tile are interpolated.
  // Collective, for a density on ranks, each rank for its own points. Throws std::bad_alloc and
  // Cancelled.
  void MeasuresOfShares(ConstPointSpan<Dimension> centres, const Point<Dimension>& aspect,
    const double* shares, double* measures, const Context& context = Context()) const;

  // What NumberOfSteps 0 of the options means in a direction. Kept: other runs find it again at no
  // cost. Collective.
  StepChoice ChooseSteps(
    const FlowOptions& options, FlowDirection direction, const Context& context = Context()) const;

  // Points are in the index space of the density. There are as many positions as seeds, and both
  // may be in the same memory. Points outside the box are clamped to its border.
  //
  // Moves points of time 0 (uniform) to time 1 (distributed like the density).
  FlowReport Forward(const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions,
    const FlowOptions& options = {}, const Context& context = Context()) const;
  // Moves points of time 1 back to time 0: the inverse map, density to uniform.
  FlowReport Backward(const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions,
    const FlowOptions& options = {}, const Context& context = Context()) const;
  // The positions at several times of [0,1], ascending, from one run: all times of a particle
  // together.
  FlowReport ForwardAt(const FlowSeeds<Dimension>& seeds, const std::vector<double>& times,
    PointSpan<Dimension> positions, const FlowOptions& options = {},
    const Context& context = Context()) const;
  // Forward, but writes for each point only the number, axis 0 fastest, of the density's cell with
  // mass in which it ends. For densities of isolated cells, which most particles miss at first:
  // fewer than 128 steps become up to 32 times as many in the first pass, and 0 means the fewest.
  FlowReport ForwardToCells(const FlowSeeds<Dimension>& seeds, std::int64_t* cells,
    const FlowOptions& options = {}, const Context& context = Context()) const;

private:
  template <class Run>
  FlowReport RunWithSteps(const FlowOptions& options, FlowDirection direction, double particles,
    const Context& context, const Run& run) const;

  GridSize<Dimension> Cells;
  std::unique_ptr<FlowEngine<Dimension>> Engine;
  std::unique_ptr<StepChoiceCache> Steps;
};

// One-off: builds the tables, transports the points, releases the tables.
template <int Dimension>
std::vector<Point<Dimension>> transportPoints(const DensitySource<Dimension>& density,
  const FlowSeeds<Dimension>& seeds, const FlowOptions& options = {},
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
