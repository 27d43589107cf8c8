// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/OptimalBlend.h"

#include "Bridge/Blend/ParticlePositions.h"
#include "Bridge/Density/CostBound.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PairMap.h"
#include "Bridge/Ranks/TupleBoxes.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Splat/DistributedSplat.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/OptimalMap/OptimalMap.h"
#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
constexpr int mostRounds = 20; // of a barycenter

// Of a barycenter's inputs.
std::vector<std::size_t> usedOf(const std::vector<OptimalBlendInput>& inputs)
{
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    if (inputs[i].Weight > 0.0)
    {
      used.push_back(i);
    }
  }
  return used;
}

// Particles and maps in index spaces, in which inputs differ, and in the lengths of the common
// directions.
template <int D>
class OptimalBlender
{
public:
  OptimalBlender(const std::vector<OptimalBlendInput>& inputs, const OptimalBlendSettings& settings,
    Progress& progress)
    : Inputs(inputs)
    , Settings(settings)
    , Scale(settings.Geometry)
    , Work(progress)
    , Count(inputs.front().Positions->GetNumberOfTuples())
    , All(static_cast<double>(sumOverRanks(progress.Group(), this->Count)))
  {
    for (const OptimalBlendInput& input : inputs)
    {
      this->Result.Positions.emplace_back(input.Positions);
    }
    this->Result.Slack = newArray<vtkDoubleArray>("Slack", 1, this->Count);
    std::fill_n(this->Result.Slack->GetPointer(0), this->Count, 0.0);
  }

  OptimalBlendResult Run()
  {
    if (this->Settings.IsPair)
    {
      this->BlendPair();
    }
    else
    {
      this->BlendAll();
    }
    return std::move(this->Result);
  }

private:
  PlacedDensity<D> Place(const ImageGrid& grid, const DensitySource<D>& source) const
  {
    return placeDensity<D>(this->Settings.Geometry, grid, source);
  }

  std::unique_ptr<OptimalMap<D>> Solve(const PlacedDensity<D>& source,
    const OptimalBlendInput& target, int leastIterations, bool refines, Progress& progress)
  {
    return solvePair<D>(this->Settings.Geometry, source, *target.Density,
      { this->Settings.Optimal, leastIterations, refines, refines ? this->All : 0.0 }, progress);
  }

  LargeBuffer<double> IndexOf(const ImageGrid& grid, vtkDoubleArray* positions)
  {
    LargeBuffer<double> index(this->Count * D);
    const double* x = positions->GetPointer(0);
    double* out = index.data();
    this->Work.Threads().For(this->Count, grain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        grid.ToIndex<D>(x + 3 * i, out + D * i);
        grid.ClampToDomain<D>(out + D * i);
      }
    });
    this->Work.Check();
    return index;
  }

  vtkSmartPointer<vtkDoubleArray> PhysicalOf(
    const ImageGrid& grid, ConstPointSpan<D> points, Progress& progress)
  {
    auto physical = newArray<vtkDoubleArray>("Positions", 3, this->Count);
    writePhysical<D>(grid, points, progress, { physical->GetPointer(0), this->Count });
    return physical;
  }

  // The mean over all ranks of the squared distances.
  double MeanSquare(vtkDoubleArray* from, vtkDoubleArray* to, Progress& progress)
  {
    const double* a = from->GetPointer(0);
    const double* b = to->GetPointer(0);
    const auto own = sumExactly<ExactSum>(
      progress, this->Count, grain, [&](std::int64_t first, std::int64_t last, ExactSum& sum) {
        for (std::int64_t i = first; i < last; ++i)
        {
          sum.Add(this->Scale.SquaredDistanceInUnits(a + 3 * i, b + 3 * i));
        }
      });
    const Ranks& ranks = this->Work.Group();
    const double squares = sumOverRanks(ranks, own).Value();
    return this->Scale.CostFromUnits(squares / this->All);
  }

  void AddSlack(const OptimalMap<D>& map, double weight, const LargeBuffer<double>& points,
    ConstPointSpan<D> images, Progress& progress)
  {
    LargeBuffer<double> slack(this->Count);
    map.Slack({ points.data(), this->Count }, images, slack.data(), progress);
    double* sum = this->Result.Slack->GetPointer(0);
    this->Work.Threads().For(this->Count, grain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        sum[i] += weight * this->Scale.SquareFromUnits(slack.data()[i]);
      }
    });
  }

  // Whether the map reaches its target; else warns, and the flow's positions remain.
  bool Resolves(const OptimalMap<D>& map, const OptimalBlendInput& target, Progress& progress)
  {
    const std::string text = unresolvedText(map.MassError(progress));
    if (!text.empty())
    {
      this->Result.Warnings.push_back(target.Name + ": " + text);
    }
    return text.empty();
  }

  // From particles in the index space `from` of a source, under the map or by the given positions
  // of the flow.
  void Follow(const OptimalMap<D>& map, std::size_t input, vtkDoubleArray* starts,
    const ImageGrid& startGrid, bool areSamples, double weight, Progress& progress)
  {
    const OptimalBlendInput& target = this->Inputs[input];
    const ImageGrid& grid = target.Density->Grid();
    const LargeBuffer<double> points = this->IndexOf(startGrid, starts);
    LargeBuffer<double> images;
    if (this->Settings.Optimal.IsOptimal && this->Resolves(map, target, progress))
    {
      images = LargeBuffer<double>(this->Count * D);
      FlowSeeds<D> seeds(points.data(), this->Count);
      map.Forward(
        areSamples ? seeds.AsSamples() : seeds, { images.data(), this->Count }, {}, progress);
      this->Result.Positions[input] =
        this->PhysicalOf(grid, { images.data(), this->Count }, progress);
    }
    else
    {
      images = this->IndexOf(grid, target.Positions);
    }
    if (areSamples)
    {
      this->AddSlack(map, weight, points, { images.data(), this->Count }, progress);
      this->Result.Bound += weight * this->Scale.CostFromUnits(map.LowerBound());
      if (!this->Settings.IsPair)
      {
        this->Result.Cost +=
          weight * this->MeanSquare(starts, this->Result.Positions[input], progress);
      }
    }
  }

  void BlendPair()
  {
    const OptimalBlendInput& source = this->Inputs[0];
    const ImageGrid& grid = source.Density->Grid();
    Stages stages(this->Work, { { "reading", 1 }, { "map", 69 }, { "images", 30 } });
    source.Density->Prepare(FlowTables::Whole, stages["reading"]);
    const auto map = this->Solve(this->Place(grid, source.Density->template Source<D>()),
      this->Inputs[1], this->LeastIterations(), true, stages["map"]);
    source.Density->ReleaseGathered();
    this->Follow(*map, 1, source.Positions, grid, true, 1.0, stages["images"]);
  }

  int LeastIterations() const { return leastIterations(this->Settings.Optimal); }

  vtkSmartPointer<vtkDoubleArray> MeanOf(Progress& progress)
  {
    auto mean = newArray<vtkDoubleArray>("Positions", 3, this->Count);
    writeMeans(
      this->Result.Positions, this->Inputs, progress, { mean->GetPointer(0), this->Count });
    return mean;
  }

  // Whether the particles are at the same places in all these inputs, up to rounding: then the
  // densities are the same, and their mean is where they are.
  bool AreOne(const std::vector<std::size_t>& used)
  {
    constexpr double rounding = 1e-5; // of a cell; the flow amplifies that of the densities
    const double most = rounding * std::pow(this->Settings.Geometry.CellMeasure(), 1.0 / D);
    const double* first = this->Inputs[used.front()].Positions->GetPointer(0);
    const bool areOne = std::all_of(used.begin() + 1, used.end(), [&](std::size_t i) {
      const double* other = this->Inputs[i].Positions->GetPointer(0);
      return other == first ||
        std::equal(first, first + 3 * this->Count, other,
          [=](double a, double b) { return std::abs(a - b) <= most; });
    });
    return onAllRanks(this->Work.Group(), areOne);
  }

  // Alvarez-Esteban, del Barrio, Cuesta-Albertos and Matran, "A fixed-point approach to barycenters
  // in Wasserstein space", Journal of Mathematical Analysis and Applications 441, 2016: the
  // particles of a mean go to the mean of their images in the inputs, which lowers the functional.
  void BlendAll()
  {
    const std::vector<std::size_t> used = usedOf(this->Inputs);
    if (this->AreOne(used))
    {
      if (this->Settings.Optimal.IsOptimal)
      {
        this->Result.Functional.push_back(0.0);
      }
      return;
    }
    const bool isOptimal = this->Settings.Optimal.IsOptimal;
    Stages stages(this->Work, { { "rounds", isOptimal ? 5.0 : 0.0 }, { "last round", 1 } });
    if (isOptimal)
    {
      constexpr int usual = 3; // about half of the rounds
      Rounds rounds(stages["rounds"], usual);
      for (int round = 0; round < mostRounds; ++round)
      {
        const auto before = this->Result.Positions;
        const double functional = this->TakeRound(used, false, rounds.Next());
        const std::vector<double>& all = this->Result.Functional;
        const double fall = all.empty() ? functional : all.back() - functional;
        if (fall <= 0.0)
        {
          this->Result.Positions = before;
          break;
        }
        this->Result.Functional.push_back(functional);
        if (fall < this->Settings.Optimal.Tolerance * functional)
        {
          break;
        }
      }
    }
    const double last = this->TakeRound(used, true, stages["last round"]);
    std::vector<double>& all = this->Result.Functional;
    if (!all.empty() && last < all.back())
    {
      all.push_back(last);
    }
  }

  // One map to each input from the density of the mean. Returns the weighted mean of their bounds.
  double TakeRound(const std::vector<std::size_t>& used, bool isLast, Progress& progress)
  {
    const ImageGrid& geometry = this->Settings.Geometry;
    Stages stages(progress, { { "mean", 1 }, { "density", 1 }, { "maps", 98 } });
    const vtkSmartPointer<vtkDoubleArray> mean = this->MeanOf(stages["mean"]);
    const vtkSmartPointer<vtkDoubleArray> density = this->Splat(mean, stages["density"]);
    const GridSize<D> size = geometry.Size<D>();
    const DensityArray<D, double> values(density->GetPointer(0), size);
    const PlacedDensity<D> source = this->Place(geometry, DensitySource<D>(size, values));
    double functional = 0.0;
    Parts maps(stages["maps"], static_cast<std::int64_t>(used.size()));
    std::int64_t done = 0;
    for (const std::size_t i : used)
    {
      Stages parts(maps[done++], { { "map", 7 }, { "images", 3 } });
      const double weight = this->Inputs[i].Weight;
      const auto map = this->Solve(
        source, this->Inputs[i], isLast ? this->LeastIterations() : 2, isLast, parts["map"]);
      this->Follow(*map, i, mean, geometry, isLast, weight, parts["images"]);
      functional += weight * this->Scale.CostFromUnits(map->LowerBound());
    }
    return functional;
  }

  // The density of all ranks' particles, on each of them.
  vtkSmartPointer<vtkDoubleArray> Splat(vtkDoubleArray* points, Progress& progress)
  {
    const ImageGrid& geometry = this->Settings.Geometry;
    const int owner = geometry.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
    const TupleBox box = tuplesOf(geometry.Extent(), owner, geometry.Extent());
    SplatOptions options;
    options.Kernel = SplatKernel::CloudInCell;
    const SplatTarget target{ geometry, options, false };
    auto density = newArray<vtkDoubleArray>("Density", 1, box.Count());
    splatDistributed(points, nullptr, 1.0, nullptr, target, box, progress, density);
    return density;
  }

  const std::vector<OptimalBlendInput>& Inputs;
  const OptimalBlendSettings& Settings;
  const LengthScale Scale;
  Progress& Work;
  const std::int64_t Count;
  const double All; // of the particles, on all ranks
  OptimalBlendResult Result;
};

template <int D>
OptimalBlendResult blend(const std::vector<OptimalBlendInput>& inputs,
  const OptimalBlendSettings& settings, Progress& progress)
{
  return OptimalBlender<D>(inputs, settings, progress).Run();
}

template <int D>
void requireFor(const std::vector<OptimalBlendInput>& inputs, const OptimalBlendSettings& settings,
  double particles, const Ranks& ranks)
{
  const OptimalNeeds needs{ settings.Optimal, particles };
  // Positions in the inputs and slack, and points and images in index spaces.
  const double each = sizeof(double) * (3.0 * static_cast<double>(inputs.size()) + 1.0 + 2.0 * D);
  const double more = each * particles / ranks.Count();
  if (settings.IsPair)
  {
    memoryOfPair<D>(
      inputs[0].Density->Grid().Size<D>(), inputs[1].Density->Grid().Size<D>(), needs, ranks)
      .Require(more);
    return;
  }
  const std::vector<std::size_t> used = usedOf(inputs);
  for (std::size_t i = 0; i < used.size() && used.size() > 1; ++i)
  {
    memoryOfPair<D>(
      settings.Geometry.Size<D>(), inputs[used[i]].Density->Grid().Size<D>(), needs, ranks)
      .Require(more);
  }
}

} // namespace

void requireMemoryForMaps(const std::vector<OptimalBlendInput>& inputs,
  const OptimalBlendSettings& settings, double particles, const Ranks& ranks)
{
  dispatchDimension(settings.Geometry.Dimension(), requireFor<1>, requireFor<2>, requireFor<3>)(
    inputs, settings, particles, ranks);
}

OptimalBlendResult blendOptimally(const std::vector<OptimalBlendInput>& inputs,
  const OptimalBlendSettings& settings, Progress& progress)
{
  return dispatchDimension(settings.Geometry.Dimension(), blend<1>, blend<2>, blend<3>)(
    inputs, settings, progress);
}

} // namespace RectifiedTransport::Bridge
