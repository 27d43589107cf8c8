// SPDX-License-Identifier: BSD-3-Clause
// The core's functions in one header: what most programs need, one call each.
//
//   #include <RectifiedTransport/Core/Transport.h>
//   using namespace RectifiedTransport;
//
//   std::vector<float> values(640 * 480, 1.0f);                        // x fastest
//   const BoxDensity<2> density(values.data(), { 640, 480 }, { 4.0, 3.0 });
//   std::vector<Point<2>> points = sample(density, 10000);             // x in [0, 4], y in [0, 3]
//   points = relax<2>(points, density);
//
// What they have in common:
// * Dimension is 1, 2 or 3 where nothing else is said. All lengths are in the unit of the boxes'
//   sides; points outside a box count as the nearest points of its border.
// * A result has the same bits for every number of threads.
// * Each call makes the tables or maps of its densities anew; RectifiedFlow and OptimalMap keep
//   them.
// * They throw InvalidDensity (values that are negative or not finite, a sum of zero or beyond the
//   largest double), std::invalid_argument (boxes, sizes, options), std::bad_alloc, and Cancelled
//   if the context's IsCancelled returns true.
#ifndef RectifiedTransport_Transport_h
#define RectifiedTransport_Transport_h

#include "Blend/BlendWeights.h"
#include "Flow/FlowOptions.h"
#include "Geometry/GridSize.h"
#include "Geometry/Points.h"
#include "Parallel/Context.h"
#include "Relaxation/BlueNoiseRelaxation.h"
#include "Seeds/Seeds.h"
#include "SiteCells/SiteCellStatistics.h"
#include "Splat/Splat.h"
#include "Tables/Density.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

// A density on the box [0, sides]: constant on each cell of a grid that fills the box. A cell's
// mass is its value times its measure.
template <int Dimension>
class BoxDensity
{
public:
  // One value of any arithmetic type for each cell, axis 0 fastest, 0 and more. They are not copied
  // and must outlive this. `cells`: 1 to 2^30 along each axis. `sides`: above 0.
  template <class T>
  BoxDensity(const T* values, const GridSize<Dimension>& cells, const Point<Dimension>& sides)
    : BoxDensity(std::make_shared<DensityArray<Dimension, T>>(values, cells), cells, sides)
  {
  }
  // Takes values that are read in another way.
  BoxDensity(std::shared_ptr<const DensityValues> values, const GridSize<Dimension>& cells,
    const Point<Dimension>& sides);

  const GridSize<Dimension>& Cells() const { return this->Size; }
  const Point<Dimension>& Sides() const { return this->Lengths; }
  DensitySource<Dimension> Source() const { return { this->Size, *this->Values }; }

private:
  std::shared_ptr<const DensityValues> Values;
  GridSize<Dimension> Size;
  Point<Dimension> Lengths;
};

// How mass is moved.
enum class MapMethod
{
  RectifiedFlow, // in linear time; not of least cost
  Optimal        // of nearly the least mean squared distance; Documentation/Optimal.md
};

struct MethodOptions
{
  MapMethod Method = MapMethod::RectifiedFlow;
  FlowOptions Flow; // for RectifiedFlow
  // For Optimal, above 0: the iteration ends when one step raises the lower bound of the cost by
  // less than a quarter of this part of it.
  double Tolerance = 1e-3;
};

struct SampleOptions
{
  MethodOptions Map;
  SeedPattern Pattern = SeedPattern::BlueNoise;
  std::uint64_t RandomSeed = 1;
};

// Points that are distributed like a density: T(x_i) for points x_i that are spread evenly over the
// box and the map T that takes the uniform measure to the density. Each has the same share of the
// mass. `count` is at least 0; with SeedPattern::Lattice there are about as many.
template <int Dimension>
std::vector<Point<Dimension>> sample(const BoxDensity<Dimension>& density, std::int64_t count,
  const SampleOptions& options = {}, const Context& context = Context());

template <int Dimension>
struct MapOptions
{
  MethodOptions Map;
  // Forward: from the uniform measure to the density. Backward: the inverse.
  FlowDirection Direction = FlowDirection::Forward;
  GridSize<Dimension> Samples{}; // a lattice of samples that fills the box; 0: the density's cells
};

// A map at the centres x of a lattice's cells, axis 0 fastest.
template <int Dimension>
struct SampledMap
{
  GridSize<Dimension> Samples{};
  std::vector<Point<Dimension>> Displacement; // T(x) - x
  std::vector<double> Divergence;             // the displacement's
  // How many times as large T makes a small cell, from T's derivative; below 0 where T is folded.
  std::vector<double> Determinant;
};

// The map between the uniform measure and a density; derivatives are central differences.
template <int Dimension>
SampledMap<Dimension> map(const BoxDensity<Dimension>& density,
  const MapOptions<Dimension>& options = {}, const Context& context = Context());

struct BlendOptions
{
  FlowOptions Flow;
  // The number of particles that are moved for each cell of the result: above 0. If it is a
  // Dimension-th power, they form a lattice.
  std::int64_t ParticlesPerCell = 4;
  BlendedMass Mass = BlendedMass::Linear;
  // The kernel that spreads the particles' mass over cells. The grid is that of the result.
  SplatOptions Splat = { SplatKernel::TriangularShapedCloud };
};

struct MorphOptions : BlendOptions
{
  // Optimal: straight displacements of nearly least cost between the two densities. If their grid
  // is too coarse for it (OptimalMap::MassError above a tenth), the displacements are those of
  // RectifiedFlow.
  MapMethod Method = MapMethod::RectifiedFlow;
  double Tolerance = 1e-3; // as MethodOptions::Tolerance
};

// Densities that were made: a value for each cell of a grid that fills the box, axis 0 fastest.
template <int Dimension>
struct MadeDensity
{
  GridSize<Dimension> Cells{};
  std::vector<double> Values;
};

// The mass of `a` on its way to `b` at some times in [0, 1], one density for each. Both boxes are
// the same; the result has the larger number of cells along each axis. With the maps A and B of the
// uniform measure to the two, a particle is at (1 - t) A(x) + t B(x). At 0 and 1 it is a and b,
// resampled where their numbers of cells differ; near these times more and more of their cells move
// instead of particles. The maps are made once for all times.
template <int Dimension>
std::vector<MadeDensity<Dimension>> morph(const BoxDensity<Dimension>& a,
  const BoxDensity<Dimension>& b, const std::vector<double>& times,
  const MorphOptions& options = {}, const Context& context = Context());

// The weighted mean of densities in the same box, as `morph`: particles are at the sum of w_i
// T_i(x) for the maps T_i of the uniform measure to density i (Section 3.4 of the paper). `weights`
// has one number >= 0 for each. They are divided by their sum, which is above 0.
template <int Dimension>
MadeDensity<Dimension> barycenter(const std::vector<BoxDensity<Dimension>>& densities,
  const std::vector<double>& weights, const BlendOptions& options = {},
  const Context& context = Context());

// W2 is within these bounds, up to rounding.
struct DistanceBounds
{
  double Lower = 0.0;
  double Upper = 0.0;
};

// The 2-Wasserstein distance of two densities, each divided by its mass. Its square is the least
// mean squared length of the ways that move the mass of one to the other. Boxes and numbers of
// cells are the same. The lower bound loses about the square of a cell's side, of W2^2.
template <int Dimension>
DistanceBounds distance(const BoxDensity<Dimension>& a, const BoxDensity<Dimension>& b,
  const Context& context = Context());

enum class SiteCellShape
{
  Flow, // pixels, by the rectified flow
  Power // polygons of least cost: a power diagram; 2D
};

template <int Dimension>
struct CellOptions
{
  SiteCellShape Shape = SiteCellShape::Flow;
  GridSize<Dimension> Pixels{}; // along each axis of the box; 0: as the density has cells
  FlowOptions Flow;             // for SiteCellShape::Flow
  CostNorm Norm;                // for SiteCellShape::Flow; Power has squared distances
};

template <int Dimension>
struct EqualMassDivision
{
  GridSize<Dimension> Pixels{};
  std::vector<std::int64_t> Labels; // the site of each pixel, axis 0 fastest; -1: no mass
  // One entry for each site: the mass of its cell, the cell's centroid, and its share of the cost.
  std::vector<double> Masses;
  std::vector<Point<Dimension>> Centroids;
  std::vector<double> Costs;
  double Cost = 0.0; // the mean over the mass of |x - site|^2, or of another norm
};

// The box divided among sites, one or more, into cells that have equal masses of the density: up to
// a pixel's mass, with Power up to 5e-7 of their mean. Also throws TooFewPixels, and, with Power,
// std::runtime_error if sites are distributed too differently from the density.
template <int Dimension>
EqualMassDivision<Dimension> cells(ConstPointSpan<Dimension> sites,
  const BoxDensity<Dimension>& density, const CellOptions<Dimension>& options = {},
  const Context& context = Context());

enum class RelaxMethod
{
  GaussianBlueNoise,
  OptimalTransport // 2D
};

struct RelaxOptions : RelaxationOptions
{
  RelaxMethod Method = RelaxMethod::GaussianBlueNoise;
};

// Points spaced evenly while they follow a density, in their order; best those of `sample`. 2D and
// 3D. Also throws NoEqualMasses.
template <int Dimension>
std::vector<Point<Dimension>> relax(ConstPointSpan<Dimension> points,
  const BoxDensity<Dimension>& density, const RelaxOptions& options = {},
  const Context& context = Context());

struct StippleOptions
{
  bool Invert = true; // dark is ink
  double White = 0.0; // the value of a pixel without ink, if inverted; 0: the largest value
  SampleOptions Sample;
  RelaxOptions Relax;
};

// A picture of greys as dots of ink: sample, then relax. Values above White have no ink.
std::vector<Point<2>> stipple(const BoxDensity<2>& picture, std::int64_t count,
  const StippleOptions& options = {}, const Context& context = Context());

} // namespace RectifiedTransport

#endif
