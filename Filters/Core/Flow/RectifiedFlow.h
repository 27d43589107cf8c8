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
//   RectifiedFlow<2> flow(source);                                  // keeps the tables
//   FlowOptions options;
//   options.NumberOfSteps = 64;
//   flow.Forward(seeds[0].data(), seeds.size(), particles[0].data(), options);
//   flow.Backward(particles[0].data(), seeds.size(), seeds[0].data(), options);
#ifndef RectifiedTransport_RectifiedFlow_h
#define RectifiedTransport_RectifiedFlow_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/Executor.h"
#include "Core/Tables/Density.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

// The summed-area tables of one density and the flow that they define. Construction costs
// O(cells), an advection O(particles * steps * 2^Dimension). Const members may run concurrently.
// Every particle's result depends on its seed and the density alone, to the last bit.
// Throws InvalidDensity, std::invalid_argument (options) and std::bad_alloc.
template <int Dimension>
class RectifiedFlow
{
public:
  explicit RectifiedFlow(const DensitySource<Dimension>& density,
    const Executor& executor = OpenMPExecutor(), const Monitor& monitor = {});
  // The same in the memory of `previous`, where its tables are as large: for a density that changes
  // with time. It takes about half the time that new memory takes, and never holds both tables.
  RectifiedFlow(const DensitySource<Dimension>& density, RectifiedFlow&& previous,
    const Executor& executor = OpenMPExecutor(), const Monitor& monitor = {});
  ~RectifiedFlow();
  RectifiedFlow(RectifiedFlow&&) noexcept;
  RectifiedFlow& operator=(RectifiedFlow&&) noexcept;

  // False if the monitor cancelled the construction; nothing else may be called then.
  explicit operator bool() const;

  const GridSize<Dimension>& Size() const;
  double Total() const;              // sum of the density over the cells
  Point<Dimension> Centroid() const; // of the density
  std::int64_t MemorySize() const;   // bytes that the tables hold
  // Whether the cell that holds a point has mass (a point on a face: any of its cells).
  bool HasMass(const Point<Dimension>& point) const;
  // The share of the mass in a box.
  double Share(const Point<Dimension>& low, const Point<Dimension>& high) const;
  // The measure, in cells, of the smallest box about a point that holds a share of the mass, the
  // part in the domain; the sides of the box are in proportion to `aspect`.
  double MeasureOfShare(
    const Point<Dimension>& centre, const Point<Dimension>& aspect, double share) const;

  // Advects points of time 0 (uniform) to time 1 (distributed like the density). Arrays hold
  // count * Dimension doubles, a point's coordinates together, and may be the same array. Points
  // outside the box are taken from its border.
  FlowReport Forward(const double* seeds, std::int64_t count, double* positions,
    const FlowOptions& options = {}, const Executor& executor = OpenMPExecutor(),
    const Monitor& monitor = {}) const;

  // The positions at several times of [0,1], ascending, from one run: positions holds count *
  // times.size() * Dimension doubles, all times of a particle together.
  FlowReport ForwardAt(const double* seeds, std::int64_t count, const std::vector<double>& times,
    double* positions, const FlowOptions& options = {}, const Executor& executor = OpenMPExecutor(),
    const Monitor& monitor = {}) const;

  // Advects points of time 1 back to time 0: the inverse map, density to uniform.
  FlowReport Backward(const double* points, std::int64_t count, double* positions,
    const FlowOptions& options = {}, const Executor& executor = OpenMPExecutor(),
    const Monitor& monitor = {}) const;

  // The same for the centres of a grid of cells that fill the box, axis 0 fastest; cells along an
  // axis: 1 to 2^30. It needs neither an array of points nor a sort. Positions hold as many points.
  // Forwards also for the points at another `place` in the cells, in [0,1].
  FlowReport ForwardLattice(const GridSize<Dimension>& lattice, double* positions,
    const FlowOptions& options = {}, const Executor& executor = OpenMPExecutor(),
    const Monitor& monitor = {}, const Point<Dimension>& place = cellCentre<Dimension>()) const;
  FlowReport BackwardLattice(const GridSize<Dimension>& lattice, double* positions,
    const FlowOptions& options = {}, const Executor& executor = OpenMPExecutor(),
    const Monitor& monitor = {}) const;

  // Forwards too, but of every sample only the cell of the density that it comes to, which has
  // mass: cells are numbered with axis 0 fastest. For densities of few cells scattered like points,
  // which most particles miss at first: fewer than 128 steps become up to 32 times as many at once.
  FlowReport ForwardLatticeToCells(const GridSize<Dimension>& lattice, std::int64_t* cells,
    const FlowOptions& options = {}, const Executor& executor = OpenMPExecutor(),
    const Monitor& monitor = {}) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Data;
};

// One-off: builds the tables, transports the points, forgets the tables.
template <int Dimension>
std::vector<Point<Dimension>> transportPoints(const DensitySource<Dimension>& density,
  const std::vector<Point<Dimension>>& seeds, const FlowOptions& options = {});

} // namespace RectifiedTransport

#endif
