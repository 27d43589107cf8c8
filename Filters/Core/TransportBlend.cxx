// SPDX-License-Identifier: BSD-3-Clause
// Blends of densities: particles of the uniform measure are moved to each of them.
#include "Core/Blend/AdvectedCells.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Flow/WeightedMean.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/CellMeans.h"
#include "Core/TransportBox.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// A density and the pivot's particles in it.
template <int D>
struct BlendedInput
{
  BoxDensity<D> Density;
  double Mass;
  std::vector<Point<3>> Positions; // in lengths
};

template <int D>
class Blend
{
public:
  Blend(
    const std::vector<BoxDensity<D>>& densities, const BlendOptions& options, Progress& progress)
    : Options(options)
  {
    this->FindGrid(densities);
    if (options.ParticlesPerCell < 1)
    {
      throw std::invalid_argument("ParticlesPerCell is " +
        std::to_string(options.ParticlesPerCell) + "; it must be at least 1");
    }
    // The pivot is a lattice of particles with equal masses, the same for all densities: particle
    // i of each is an image of the same point x_i of the uniform measure.
    const PivotLattice<D> pivot = pivotLattice<D>(this->Cells, options.ParticlesPerCell);
    this->Count = pivot.NumberOfParticles();
    Parts parts(progress, static_cast<std::int64_t>(densities.size()));
    for (const BoxDensity<D>& density : densities)
    {
      this->Inputs.push_back(
        this->MoveTo(density, pivot, parts[static_cast<std::int64_t>(this->Inputs.size())]));
    }
  }

  // Particles keep their places in the first density. In the second one they get the places to
  // which the optimal map takes them, if the grids resolve it.
  void MoveOptimally(double tolerance, Progress& progress)
  {
    Stages stages(progress, { { "map", 70 }, { "images", 30 } });
    BlendedInput<D>& a = this->Inputs[0];
    BlendedInput<D>& b = this->Inputs[1];
    PlanOptions options;
    options.IsOptimal = true;
    options.Optimal.Tolerance = tolerance;
    // One map from the first density to the second takes the place of the composition of two flows.
    const TransportPlan<D> plan(planEnd(a.Density), planEnd(b.Density), options, stages["map"]);
    if (!plan.IsOptimal())
    {
      return;
    }
    // From lengths to the index space of the first density.
    std::vector<Point<D>> points(a.Positions.size());
    const Point<D> cells = cellSides(a.Density);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        points[i][axis] = a.Positions[i][axis] / cells[axis];
      }
    }
    plan.Forward(FlowSeeds<D>(points).AsSamples(), points, stages["images"]);
    b.Positions = this->InSpace(points, b.Density);
  }

  // Makes the density for weights w_i with the sum 1. Particles at sum of w_i T_i(x) carry the
  // mass, except near a density: there its own cells, moved with the particles, take over an
  // increasing share.
  MadeDensity<D> Make(const std::vector<double>& weights, Progress& progress) const
  {
    Stages stages(progress, { { "mean", 2 }, { "splat", 3 }, { "input", 5 } });
    const auto heaviest = std::max_element(weights.begin(), weights.end());
    const BlendedInput<D>& input =
      this->Inputs[static_cast<std::size_t>(heaviest - weights.begin())];
    // Near a density, particles would blur its cells: there the cells themselves carry this share.
    const double share = shareOfHeaviest(*heaviest);
    const double mass = this->MassOf(weights);
    // At a density itself, the result is exactly that density, resampled.
    if (*heaviest == 1.0)
    {
      return { this->Cells, this->Resample(input, mass, stages["input"]) };
    }
    const std::vector<Point<3>> mean = this->MeanOf(weights, stages["mean"]);
    MadeDensity<D> made{ this->Cells,
      std::vector<double>(static_cast<std::size_t>(this->Grid.NumberOfCells())) };
    // The mass of each particle; the splat divides masses by the measure of a cell to get a
    // density.
    const double each = (1.0 - share) * mass / static_cast<double>(this->Count);
    splatMass<D, double>({ mean, nullptr, each, this->Grid.template ToIndexMap<D>() }, this->Cells,
      this->Options.Splat, 1.0 / this->Grid.CellMeasure(), made.Values.data(), stages["splat"]);
    if (share > 0.0)
    {
      // Cells move by the mean displacement of the particles in them, from the density to the mean.
      const std::vector<double> values = this->Resample(input, share * mass, stages["input"]);
      const auto whole = LatticePart<D>::WholeOf(this->Cells);
      addAdvected<D>({ this->Grid, whole, values.data(), ConstPointSpan<3>(input.Positions),
                       ConstPointSpan<3>(mean) },
        whole, stages["input"], made.Values.data());
    }
    return made;
  }

private:
  // Finds the common box and the largest number of cells along each axis.
  void FindGrid(const std::vector<BoxDensity<D>>& densities)
  {
    if (densities.empty())
    {
      throw std::invalid_argument("there are no densities; there must be at least one");
    }
    this->Cells.fill(1);
    for (const BoxDensity<D>& density : densities)
    {
      requireSameBox(densities.front(), density);
      for (int axis = 0; axis < D; ++axis)
      {
        this->Cells[axis] = std::max(this->Cells[axis], density.Cells()[axis]);
      }
    }
    this->Grid = gridOf<D>(this->Cells, densities.front().Sides());
  }

  // Moves the pivot's particles, which represent the uniform measure, to a density.
  BlendedInput<D> MoveTo(
    const BoxDensity<D>& density, const PivotLattice<D>& pivot, Progress& progress) const
  {
    Stages stages(progress, { { "tables", 5 }, { "flow", 95 } });
    // Positions are T_i(x) for the density's flow T_i.
    const RectifiedFlow<D> flow(density.Source(), stages["tables"]);
    std::vector<Point<D>> positions(static_cast<std::size_t>(this->Count));
    transportPivot<D>(flow, pivot, positions, this->Options.Flow, stages["flow"]);
    return { density, flow.Total() * cellMeasure(density), this->InSpace(positions, density) };
  }

  // Converts points from the index space of a density to lengths.
  std::vector<Point<3>> InSpace(
    const std::vector<Point<D>>& points, const BoxDensity<D>& density) const
  {
    const Point<D> sides = cellSides(density);
    std::vector<Point<3>> placed(points.size(), Point<3>{});
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        placed[i][static_cast<std::size_t>(axis)] = points[i][axis] * sides[axis];
      }
    }
    return placed;
  }

  // Returns the mass of the blend, by the options' rule.
  double MassOf(const std::vector<double>& weights) const
  {
    std::vector<double> masses;
    for (const BlendedInput<D>& input : this->Inputs)
    {
      masses.push_back(input.Mass);
    }
    return blendedMass(this->Options.Mass, masses, weights);
  }

  // Returns the points sum of w_i T_i(x), which are the displacement interpolation of the coupling
  // that all flows induce.
  std::vector<Point<3>> MeanOf(const std::vector<double>& weights, Progress& progress) const
  {
    std::vector<WeightedPositions> parts;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      parts.push_back({ ConstPointSpan<3>(this->Inputs[i].Positions), weights[i] });
    }
    std::vector<Point<3>> mean(static_cast<std::size_t>(this->Count));
    writeWeightedMean(parts, mean, progress);
    return mean;
  }

  // Resamples a density to the common grid by exact overlaps, and scales it to another mass.
  std::vector<double> Resample(const BlendedInput<D>& input, double mass, Progress& progress) const
  {
    // Both grids fill the same box, so a cell of the density has cells / size cells of the common
    // grid.
    PlacedCells<D> placed{ input.Density.Cells(), {}, {} };
    for (int axis = 0; axis < D; ++axis)
    {
      placed.Sides[axis] =
        static_cast<double>(this->Cells[axis]) / static_cast<double>(placed.Size[axis]);
    }
    std::vector<double> values(static_cast<std::size_t>(this->Grid.NumberOfCells()));
    CellMeans<D>(placed, this->Cells, LatticePart<D>::WholeOf(this->Cells))
      .Write(*input.Density.Source().Whole(), progress, values.data());
    rescaleMass(input.Mass, mass, values.data(), this->Grid.NumberOfCells());
    return values;
  }

  // Cells and Grid are the common grid; Count particles represent each density.
  const BlendOptions Options;
  GridSize<D> Cells{};
  ImageGrid Grid;
  std::int64_t Count = 0; // particles
  std::vector<BlendedInput<D>> Inputs;
};

} // namespace

// A morph is the blend of two densities with the weights 1 - t and t.
template <int Dimension>
std::vector<MadeDensity<Dimension>> morph(const BoxDensity<Dimension>& a,
  const BoxDensity<Dimension>& b, const std::vector<double>& times, const MorphOptions& options,
  const Context& context)
{
  for (const double time : times)
  {
    if (!(time >= 0.0 && time <= 1.0))
    {
      throw std::invalid_argument("a time is " + std::to_string(time) + "; it must be from 0 to 1");
    }
  }
  // The maps are made once; each time then needs a mean of positions and a splat.
  const bool isOptimal = options.Method == MapMethod::Optimal;
  Progress progress(context);
  Stages stages(progress,
    { { "maps", 40 }, { "optimal map", isOptimal ? 100.0 : 0.0 },
      { "densities", 5.0 * static_cast<double>(times.size()) } });
  Blend<Dimension> blend({ a, b }, options, stages["maps"]);
  if (isOptimal)
  {
    blend.MoveOptimally(options.Tolerance, stages["optimal map"]);
  }
  std::vector<MadeDensity<Dimension>> made;
  Parts parts(stages["densities"], static_cast<std::int64_t>(times.size()));
  for (const double time : times)
  {
    made.push_back(blend.Make({ 1.0 - time, time }, parts[static_cast<std::int64_t>(made.size())]));
  }
  return made;
}

template <int Dimension>
MadeDensity<Dimension> barycenter(const std::vector<BoxDensity<Dimension>>& densities,
  const std::vector<double>& weights, const BlendOptions& options, const Context& context)
{
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const bool areValid = weights.size() == densities.size() && sum > 0.0 && std::isfinite(sum) &&
    std::all_of(weights.begin(), weights.end(), [](double weight) { return weight >= 0.0; });
  if (!areValid)
  {
    throw std::invalid_argument("there are " + std::to_string(weights.size()) +
      " weights with the sum " + std::to_string(sum) + " for " + std::to_string(densities.size()) +
      " densities; there must be one for each, 0 and more, with a positive and finite sum");
  }
  // The weights are normalized to the sum 1.
  std::vector<double> shares(weights.size());
  std::transform(
    weights.begin(), weights.end(), shares.begin(), [=](double weight) { return weight / sum; });
  Progress progress(context);
  Stages stages(progress, { { "maps", 90 }, { "density", 10 } });
  const Blend<Dimension> blend(densities, options, stages["maps"]);
  return blend.Make(shares, stages["density"]);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(morph);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(barycenter);

} // namespace RectifiedTransport
