// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TransportSampler.h"

#include "Bridge/Data/Cells/ParticleCells.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/ParticleSet.h"
#include "Bridge/Data/SeedInput.h"
#include "Bridge/Plan/FlowCosts.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/ParticleExchange.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Seeds/SeedShare.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <new>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Particles in a range of a thread: enough to hide the cost of scheduling, few enough to divide
// evenly.
constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

// The times of the output positions: FlowTime, or those of a path's points.
std::vector<double> timesOf(const TransportSampler& sampler)
{
  // A path has as many line segments as the integration has steps, evenly spaced in [0, FlowTime].
  const int asked = sampler.Flow.NumberOfSteps;
  const int steps = !sampler.OutputPaths ? 0 : asked > 0 ? asked : FlowOptions::FewestSteps;
  std::vector<double> times;
  for (int i = 0; i < steps; ++i)
  {
    times.push_back(sampler.FlowTime * i / steps);
  }
  times.push_back(sampler.FlowTime);
  return times;
}

// Seeds are uniform in the box of the density, in index space. A pattern with SamplesPerCell is a
// grid that divides every cell; otherwise the pattern fills the box's physical lengths, so that the
// spacing is the same along all axes.
template <int D>
UnitSeeds<D> patternOf(const TransportSampler& sampler, const ImageGrid& grid)
{
  const auto randomSeed = static_cast<std::uint64_t>(sampler.RandomSeed);
  if (sampler.UsesGrid())
  {
    GridSize<D> cells = grid.Size<D>();
    for (std::int64_t& count : cells)
    {
      count *= sampler.SamplesPerCell;
    }
    return UnitSeeds<D>(sampler.Pattern, cells, randomSeed);
  }
  return UnitSeeds<D>(sampler.Pattern, grid.Lengths<D>(), sampler.NumberOfParticles, randomSeed);
}

std::string describeParticles(double count, bool paths)
{
  // Below 2^53 a double is an exact integer, and the count of a large grid may exceed every
  // integer.
  constexpr double maximumExact = 1e15;
  const std::string number =
    count < maximumExact ? std::to_string(static_cast<std::int64_t>(count)) : "more than 1e15";
  return (paths ? "the paths of " : "") + number +
    " particles (see NumberOfParticles, SamplesPerCell and Seeds)";
}

// What values at this rank's places depend on: between its points and the next ones.
Extent extentAround(const PlaceOwners& owners, const ImageGrid& grid)
{
  Extent extent = owners.OwnExtent();
  if (!isEmpty(extent) && grid.IsOnPoints())
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      extent[2 * axis] -= 1;
      extent[2 * axis + 1] += 1;
    }
  }
  return intersectionOf(extent, grid.Extent());
}

template <int D>
TransportSampler::Report sample(const TransportSampler& sampler, InputDensity& density,
  vtkPointSet* given, FlowCache& cache, Progress& progress, vtkPolyData* output)
{
  const ImageGrid& grid = density.Grid();
  const UnitSeeds<D> pattern = patternOf<D>(sampler, grid);
  const Ranks& ranks = progress.Group();
  // Given seeds stay on their ranks and are numbered through all of them. A pattern is divided:
  // each rank makes and moves the seeds [First, First + Count), which are the same as on one rank.
  const SeedShare share = given ? SeedShare(given->GetNumberOfPoints(), ranks)
                                : SeedShare(pattern.Count(), ranks.Count(), ranks.Own());
  // No rank has a seed: the output is empty, and all ranks agree on it.
  if (given && share.All == 0)
  {
    return {};
  }
  const double count = share.Count;
  const std::vector<double> times = timesOf(sampler);
  const bool addsArrays = sampler.SampleArrays && !sampler.OutputPaths;
  const OptimalSetting& optimal = sampler.Optimal;
  Stages stages(progress,
    { { "tables", Cost::tables(cache, density) }, { "seeds", Cost::Seed * count },
      { "optimal map", Cost::optimal(cache, density, optimal) },
      { "flow", Cost::flow(sampler.Flow, D) * count },
      { "slack", optimal.NeedsMap() ? Cost::Write * count : 0.0 },
      { "particles", Cost::Write * count * static_cast<double>(times.size()) },
      { "arrays", addsArrays ? Cost::Write * count : 0.0 } });
  const std::string purpose = describeParticles(count, sampler.OutputPaths);
  // Shape of the seeds: Count x D doubles in index space; of the positions: Count x times x D.
  ParticleSet<D> particles(
    grid, purpose, count, static_cast<std::int64_t>(times.size()), given != nullptr);
  particles.SetShare(share.First, share.All);

  FlowOptions options = sampler.Flow;
  options.Particles = static_cast<double>(share.All);
  const std::string wholeFor = times.size() > 1 ? "OutputPaths"
    : times.back() < 1.0                        ? "a FlowTime other than 1"
                                                : optimal.WholeFor();
  // Only the seeds of a pattern have equal masses that together are the density's mass, so that the
  // optimal map may count them exactly in boxes of cells. Given seeds are single points.
  const OptimalNeeds needs{ optimal, given ? 0.0 : static_cast<double>(share.All) };
  // Tiles serve a run of all particles from t = 0 to 1 in one pass. Positions at times between need
  // the tables as a whole.
  const FlowTables tables = requireTables(chooseTables<D>(
    sampler.Tables, grid.Size<D>(), { options, FlowDirection::Forward, count, false, wholeFor }));
  const SharedFlow& flow = cache.Update(density, stages["tables"], tables, needs);
  TransportSampler::Report report;
  if (given)
  {
    report.SeedsMoved = readSeeds<D>(given, NonGhostPoints(given->GetNumberOfPoints(), nullptr, 0),
      "input Seeds", grid, stages["seeds"], particles.Seeds(), particles.PhysicalSeeds());
  }
  else
  {
    withMemory({ purpose, pattern.Count() * D * sizeof(double) }, [&]() {
      writeSeeds<D>(pattern, grid.Size<D>(), share.First, stages["seeds"], particles.Seeds());
    });
  }
  const TransportPlan<D> plan = cache.Plan<D>(needs, options, density, stages["optimal map"]);
  report.Transport = TransportReport(plan);
  // Both are in the index space of the density; ParticleSet::Write converts to physical space.
  const ConstPointSpan<D> seeds = particles.Seeds();
  const PointSpan<D> positions = particles.Positions();
  const FlowSeeds<D> starts = given ? FlowSeeds<D>(seeds) : FlowSeeds<D>(seeds).AsSamples();
  vtkSmartPointer<vtkDoubleArray> slack;
  try
  {
    // x(0) is the seed itself. x(1) can come from any solver of the plan, with a certificate. Times
    // between need the paths: x(t) along the flow, or the straight line (1 - t) x(0) + t x(1) of
    // the optimal map.
    if (times.back() == 0.0 && times.size() == 1)
    {
      stages["flow"].For(seeds.size(), grain, [=](std::int64_t first, std::int64_t last) {
        std::copy(seeds[first], seeds[last], positions[first]);
      });
    }
    else if (times.back() == 1.0 && times.size() == 1)
    {
      report.Flow = plan.Forward(starts, positions, stages["flow"]);
      if constexpr (D == 3)
      {
        density.MoveInside(positions, stages["flow"]);
      }
      if (plan.Certificate())
      {
        slack = slackOf<D>(plan, grid, seeds, positions, stages["slack"]);
      }
    }
    else
    {
      report.Flow = plan.ForwardAt(starts, times, positions, stages["flow"]);
    }
  }
  catch (const std::bad_alloc& caught)
  {
    // The flow sorts particles by cells: an index a particle.
    const double sort = count * sizeof(std::int64_t);
    failOutOfMemory(caught, { purpose, sort });
  }

  // A particle is a point of the output, a path is a cell: the seeds' arrays go where one tuple a
  // seed is.
  if (given)
  {
    output->GetAttributes(sampler.OutputPaths ? vtkDataObject::CELL : vtkDataObject::POINT)
      ->PassData(given->GetPointData());
  }
  const double mass = flow.TotalMass();
  const double cost = particles.Write(mass, times, stages["particles"], output);
  if (slack)
  {
    output->GetPointData()->AddArray(slack);
  }
  // Each particle goes to the rank that owns the cell where it ends.
  const PlaceOwners owners = ownersOf(grid, density.Pieces(), ranks);
  moveToOwners(output, static_cast<std::int64_t>(times.size()), owners, ranks, stages["particles"]);
  report.SeedsMoved = sumOverRanks(ranks, report.SeedsMoved);
  report.ParticlesMoved = sumOverRanks(ranks, report.Flow.MovedToMass);
  report.Particles = share.All;
  // Values are sampled on the rank that owns the position, after the exchange: it has the cells
  // there.
  if (addsArrays)
  {
    auto* places = vtkDoubleArray::SafeDownCast(output->GetPoints()->GetData());
    density.SampleArrays(extentAround(owners, grid),
      { places->GetPointer(0), places->GetNumberOfTuples() }, stages["arrays"],
      output->GetPointData());
  }
  activateMass(output);
  addFieldValue(output, "TotalMass", mass);
  addFieldValue(output, "TransportCost", cost);
  if (sampler.FlowTime == 1.0) // as the bound is
  {
    addBound<D>(plan, grid, cost, grid, output);
  }
  addFieldValue(output, "MovedParticles", static_cast<double>(report.ParticlesMoved));
  addFieldValue(output, "OutsideSeeds", static_cast<double>(report.SeedsMoved));
  addSteps(output, { report.Flow });
  return report;
}

} // namespace

TransportSampler::Report TransportSampler::Run(InputDensity& density, vtkPointSet* seeds,
  FlowCache& cache, Progress& progress, vtkPolyData* output) const
{
  return dispatchDimension(density.Grid().Dimension(), sample<1>, sample<2>, sample<3>)(
    *this, density, seeds, cache, progress, output);
}

} // namespace RectifiedTransport::Bridge
