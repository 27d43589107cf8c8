// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Transport.h"

#include "Core/Distance/CertifiedDistance.h"
#include "Core/Flow/MapDerivatives.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Stages.h"
#include "Core/Seeds/UnitSeeds.h"
#include "Core/SiteCells/DensitySiteCells.h"
#include "Core/SiteCells/PixelMasses.h"
#include "Core/SiteCells/PowerSiteCells.h"
#include "Core/Tables/DensityInspection.h"
#include "Core/TransportBox.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// Points or samples in a chunk. Chunks are fixed, so that sums are the same for any number of
// threads.
constexpr std::int64_t grain = std::int64_t{ 1 } << 13;

// Makes the plan between the uniform measure and a density.
template <int D>
TransportPlan<D> makePlan(
  const BoxDensity<D>& density, const MethodOptions& options, Progress& progress)
{
  PlanOptions plan;
  plan.IsOptimal = options.Method == MapMethod::Optimal;
  plan.Flow = options.Flow;
  plan.Optimal.Tolerance = options.Tolerance;
  return TransportPlan<D>(planEnd(density), plan, progress);
}

// The density of ink in a picture: white minus grey, at least 0.
class Ink final : public DensityValues
{
public:
  Ink(const DensityValues& greys, double white)
    : Greys(greys)
    , White(white)
  {
  }
  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    this->Greys.Read(first, count, values);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const double ink = this->White - values[i];
      values[i] = ink < 0.0 ? 0.0 : ink; // NaN stays
    }
  }

private:
  const DensityValues& Greys;
  const double White;
};

// Points of 1 or 2 dimensions become points in space with zeros.
template <int D>
std::vector<Point<3>> inSpace(ConstPointSpan<D> points)
{
  std::vector<Point<3>> placed(static_cast<std::size_t>(points.size()), Point<3>{});
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    std::copy_n(points[i], D, placed[static_cast<std::size_t>(i)].begin());
  }
  return placed;
}

// Calls write() with arrays for the sites' figures, and keeps them in `division`.
template <int D, class Measure>
void measure(std::size_t sites, EqualMassDivision<D>& division, const Measure& write)
{
  // One mass, centroid and cost for each site; centroids come as points in space and lose their
  // zeros.
  division.Masses.resize(sites);
  division.Costs.resize(sites);
  std::vector<Point<3>> centroids(sites);
  division.Cost = write(
    SiteCellStatistics{ division.Masses.data(), PointSpan<3>(centroids), division.Costs.data() });
  division.Centroids.resize(sites);
  for (std::size_t i = 0; i < sites; ++i)
  {
    std::copy_n(centroids[i].begin(), D, division.Centroids[i].begin());
  }
}

// Pixels by the flow: labels, then masses, centroids and costs of the labelled pixels.
template <int D>
void divideByFlow(const std::vector<Point<3>>& sites, const BoxDensity<D>& density,
  const CellOptions<D>& options, Progress& progress, EqualMassDivision<D>& division)
{
  Stages stages(progress, { { "tables", 4 }, { "labels", 90 }, { "statistics", 6 } });
  // Pixels may be finer or coarser than the density's cells: their masses are integrals of it.
  const ImageGrid pixels = gridOf<D>(division.Pixels, density.Sides());
  const RectifiedFlow<D> flow(density.Source(), stages["tables"]);
  const DensitySiteCells<D> divided(
    sites, pixels, density.Source(), flow.Total(), stages["labels"]);
  divided.Label(flow, division.Labels.data(), options.Flow, stages["labels"]);
  // The flow's total is the sum of values; times the measure of a cell it is a mass.
  const double mass = flow.Total() * cellMeasure(density);
  measure<D>(sites.size(), division, [&](const SiteCellStatistics& statistics) {
    return measureSiteCells<D>(
      divided, division.Labels.data(), mass, options.Norm, statistics, stages["statistics"]);
  });
}

// Polygons of a power diagram: their masses and costs are exact, while labels are those of pixel
// centres.
void divideByPower(const std::vector<Point<3>>& sites, const BoxDensity<2>& density,
  Progress& progress, EqualMassDivision<2>& division)
{
  Stages stages(progress, { { "density", 2 }, { "cells", 90 }, { "labels", 8 } });
  const std::int64_t cells = density.Cells()[0] * density.Cells()[1];
  // Power diagrams need no flow: the sum of values is taken here.
  const double total = summarize(*density.Source().Whole(), cells, stages["density"]).Total;
  const PowerSiteCells power(sites, gridOf<2>(division.Pixels, density.Sides()), density.Source(),
    total * cellMeasure(density), stages["cells"]);
  power.Label(division.Labels.data(), stages["labels"]);
  PixelMasses<2>(density.Source(), total, division.Pixels, stages["labels"])
    .RemoveEmptyPixels(division.Labels.data(), stages["labels"]);
  measure<2>(sites.size(), division,
    [&](const SiteCellStatistics& statistics) { return power.Measure(statistics); });
}

} // namespace

// The values are read when they are needed, and shared among copies of the density.
template <int Dimension>
BoxDensity<Dimension>::BoxDensity(std::shared_ptr<const DensityValues> values,
  const GridSize<Dimension>& cells, const Point<Dimension>& sides)
  : Values(std::move(values))
  , Size(cells)
  , Lengths(sides)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (cells[axis] < 1 || cells[axis] > MaximumResolution)
    {
      throw std::invalid_argument("the density has " + std::to_string(cells[axis]) +
        " cells along axis " + std::to_string(axis) + "; there must be 1 to 2^30");
    }
    if (!(sides[axis] > 0.0) || !std::isfinite(sides[axis]))
    {
      throw std::invalid_argument("the box has the side " + std::to_string(sides[axis]) +
        " along axis " + std::to_string(axis) + "; it must be positive and finite");
    }
  }
}

template <int Dimension>
std::vector<Point<Dimension>> sample(const BoxDensity<Dimension>& density, std::int64_t count,
  const SampleOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "seeds", 15 }, { "map", 25 }, { "points", 60 } });
  const UnitSeeds<Dimension> pattern(options.Pattern, density.Sides(), count, options.RandomSeed);
  // Seeds first, then their images in place: the pattern may have more or fewer points than `count`
  // if it is a lattice.
  std::vector<Point<Dimension>> points(static_cast<std::size_t>(pattern.Count()));
  pattern.Generate(points, stages["seeds"]);
  // Points of the unit box become points of index space, in which the plan works, and then of the
  // box.
  Point<Dimension> cells;
  std::copy(density.Cells().begin(), density.Cells().end(), cells.begin());
  scalePoints<Dimension>(cells, points, stages["seeds"]);
  MethodOptions method = options.Map;
  // The flow may choose its tables by the number of particles.
  method.Flow.Particles = pattern.Count();
  // Samples are the images T(x_i) of seeds x_i that sample the uniform measure.
  const auto plan = makePlan(density, method, stages["map"]);
  plan.Forward(FlowSeeds<Dimension>(points).AsSamples(), points, stages["points"]);
  scalePoints<Dimension>(cellSides(density), points, stages["points"]);
  return points;
}

template <int Dimension>
SampledMap<Dimension> map(const BoxDensity<Dimension>& density,
  const MapOptions<Dimension>& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "map", 25 }, { "samples", 65 }, { "derivatives", 10 } });
  SampledMap<Dimension> sampled;
  // By default, one sample at the centre of each cell of the density.
  sampled.Samples = options.Samples == GridSize<Dimension>{} ? density.Cells() : options.Samples;
  const auto count = static_cast<std::int64_t>(numberOfCells<Dimension>(sampled.Samples));
  const auto size = static_cast<std::size_t>(count);
  // A vector, a divergence and a determinant for each sample, axis 0 fastest.
  sampled.Displacement.resize(size);
  sampled.Divergence.resize(size);
  sampled.Determinant.resize(size);
  const auto plan = makePlan(density, options.Map, stages["map"]);
  const auto seeds = FlowSeeds<Dimension>::Lattice(sampled.Samples);
  // The images take the memory of the displacements, which replace them at the end.
  std::vector<Point<Dimension>>& images = sampled.Displacement;
  if (options.Direction == FlowDirection::Forward)
  {
    plan.Forward(seeds, images, stages["samples"]);
  }
  else
  {
    plan.Backward(seeds, images, stages["samples"]);
  }
  // Derivatives are central differences of the images on the lattice, in index space.
  // The distance of neighbouring samples, in cells of the density: the step of the differences.
  const Point<Dimension> step = latticeStep<Dimension>(sampled.Samples, density.Cells());
  const MapDerivatives<Dimension> derivatives(sampled.Samples, step, images);
  stages["derivatives"].For(count, grain, [&](std::int64_t first, std::int64_t last) {
    derivatives.Write(first, last, sampled.Divergence.data(), sampled.Determinant.data());
  });
  const auto lattice = LatticePart<Dimension>::WholeOf(sampled.Samples);
  const Point<Dimension> sides = cellSides(density);
  stages["derivatives"].ForEach(count, grain, [&](std::int64_t i) {
    const GridSize<Dimension> cell = lattice.CellOf(i);
    Point<Dimension>& moved = images[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // The displacement T(x) - x in lengths, from the centre of the sample.
      const double centre = (static_cast<double>(cell[axis]) + 0.5) * step[axis];
      moved[axis] = (moved[axis] - centre) * sides[axis];
    }
  });
  return sampled;
}

template <int Dimension>
DistanceBounds distance(
  const BoxDensity<Dimension>& a, const BoxDensity<Dimension>& b, const Context& context)
{
  requireSameBox(a, b);
  // The bracket is of W2^2, and roots keep its order.
  const SquaredBracket squared =
    bracketDistance<Dimension>(a.Source(), b.Source(), a.Sides(), context);
  return { std::sqrt(squared.Lower), std::sqrt(squared.Upper) };
}

template <int Dimension>
EqualMassDivision<Dimension> cells(ConstPointSpan<Dimension> sites,
  const BoxDensity<Dimension>& density, const CellOptions<Dimension>& options,
  const Context& context)
{
  Progress progress(context);
  if (sites.size() == 0)
  {
    throw std::invalid_argument("there are no sites; there must be at least one");
  }
  EqualMassDivision<Dimension> division;
  // By default a pixel is a cell of the density.
  division.Pixels = options.Pixels == GridSize<Dimension>{} ? density.Cells() : options.Pixels;
  division.Labels.resize(static_cast<std::size_t>(numberOfCells<Dimension>(division.Pixels)));
  // Site cells work in physical space, of which a box takes the first axes.
  const std::vector<Point<3>> placed = inSpace<Dimension>(sites);
  if (options.Shape == SiteCellShape::Flow)
  {
    divideByFlow<Dimension>(placed, density, options, progress, division);
  }
  else if constexpr (Dimension == 2)
  {
    divideByPower(placed, density, progress, division);
  }
  else
  {
    throw std::invalid_argument(
      "SiteCellShape::Power needs 2 dimensions; the density has " + std::to_string(Dimension));
  }
  return division;
}

template <int Dimension>
std::vector<Point<Dimension>> relax(ConstPointSpan<Dimension> points,
  const BoxDensity<Dimension>& density, const RelaxOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "tables", 3 }, { "relaxation", 97 } });
  const Point<Dimension> sides = cellSides(density);
  // From lengths to index space, and back at the end.
  // Cells for each unit of length.
  Point<Dimension> perCell;
  std::transform(
    sides.begin(), sides.end(), perCell.begin(), [](double side) { return 1.0 / side; });
  // A copy of the points, which is relaxed in place in index space.
  std::vector<Point<Dimension>> relaxed(static_cast<std::size_t>(points.size()));
  std::copy_n(points.data(), points.size() * Dimension, PointSpan<Dimension>(relaxed).data());
  scalePoints<Dimension>(perCell, relaxed, stages["tables"]);
  // Only the ratio of the sides matters; squares of the lengths may overflow.
  Point<Dimension> spacing = sides;
  const double longest = *std::max_element(sides.begin(), sides.end());
  for (double& side : spacing)
  {
    side /= longest;
  }
  if (options.Method == RelaxMethod::GaussianBlueNoise)
  {
    const RectifiedFlow<Dimension> flow(density.Source(), stages["tables"]);
    relaxByRepulsion<Dimension>(
      density.Source(), flow, spacing, relaxed, options, stages["relaxation"]);
  }
  else if constexpr (Dimension == 2)
  {
    relaxByTransport(density.Source(), spacing, relaxed, options, stages["relaxation"]);
  }
  else
  {
    throw std::invalid_argument(
      "RelaxMethod::OptimalTransport needs 2 dimensions; the density has " +
      std::to_string(Dimension));
  }
  scalePoints<Dimension>(sides, relaxed, stages["relaxation"]);
  return relaxed;
}

// Section 5.1 of the paper: samples of the ink, which the relaxation then spaces evenly.
std::vector<Point<2>> stipple(const BoxDensity<2>& picture, std::int64_t count,
  const StippleOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "white", 1 }, { "sample", 19 }, { "relax", 80 } });
  // The reader of greys must outlive the density of ink, which reads through it.
  const auto greys = picture.Source().Whole();
  BoxDensity<2> ink = picture;
  // Dark pixels have much ink: the density is white - grey.
  if (options.Invert)
  {
    const std::int64_t pixels = picture.Cells()[0] * picture.Cells()[1];
    const double white =
      options.White > 0.0 ? options.White : summarize(*greys, pixels, stages["white"]).Maximum;
    ink = { std::make_shared<Ink>(*greys, white), picture.Cells(), picture.Sides() };
  }
  const std::vector<Point<2>> points = sample(ink, count, options.Sample, stages["sample"]);
  return relax<2>(points, ink, options.Relax, stages["relax"]);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(BoxDensity);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(sample);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(map);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(distance);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(cells);
template decltype(relax<2>) relax<2>;
template decltype(relax<3>) relax<3>;

} // namespace RectifiedTransport
