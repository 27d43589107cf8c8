// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ensembles/BlendPositions.h"

#include "Bridge/Run/StepReport.h"
#include "Core/Blend/OptimalBlend.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/MeanSquare.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// What a map depends on.
// A change of any of these gives other particles or other positions. The pivot counts by its
// numbers of cells alone, as particles start in a unit box (Section 3.4), wherever the grid of the
// blend lies.
DataIdentity identityOf(const InputDensity& density, const LinearizedMapSettings& settings)
{
  DataIdentity identity = density.Identity();
  identity.AddGrid(density.Grid()); // not part of the content, but of the physical positions
  for (const int values : settings.Pivot.NumberOfValues())
  {
    identity.AddNumber(static_cast<std::uint64_t>(values));
  }
  for (const std::int64_t number : { settings.PerCell, settings.Share.First, settings.Share.Count,
         static_cast<std::int64_t>(settings.Tables) })
  {
    identity.AddNumber(static_cast<std::uint64_t>(number));
  }
  identity.AddOptions(settings.Options);
  return identity;
}

// The linearized map of one density: the particles of the pivot, equally many in each of its cells,
// are advected forward to the density by the rectified flow. They are this rank's share of all
// particles, in the order of their numbers, so that particles of one number correspond in all
// inputs.
template <int D>
std::shared_ptr<const LinearizedMap> make(InputDensity& density,
  const LinearizedMapSettings& settings, FlowCache& tables, Progress& progress)
{
  Stages stages(progress, { { "tables", 4 }, { "positions", 96 } });
  const PivotLattice<D> pivot = pivotLattice<D>(settings.Pivot.Size<D>(), settings.PerCell);
  const std::int64_t particles = settings.Share.Count;
  // Tiles or whole tables, by the memory that is there and the number of particles.
  const FlowTables kind = requireTables(chooseTables<D>(settings.Tables, density.Grid().Size<D>(),
    { settings.Options, FlowDirection::Forward, static_cast<double>(particles), true, "" }));
  const SharedFlow& flow = tables.Update(density, stages["tables"], kind);
  auto map = std::make_shared<LinearizedMap>();
  map->TotalMass = flow.TotalMass();
  map->Positions = newArray<vtkDoubleArray>("Positions", 3, particles);
  // In 3D index coordinates are in the output array and converted in place; else there is a buffer.
  const double bytes = D == 3 ? 0.0 : static_cast<double>(particles * D) * sizeof(double);
  requireMemory({ "the particles", bytes });
  map->Flow = writePivot<D>(flow.Flow<D>(), density.Grid(), pivot, settings.Share,
    { map->Positions->GetPointer(0), particles }, settings.Options, stages["positions"]);
  return map;
}

// The slot among others that keeps a map; the end if there is none. By times alone, or else by
// contents. On ranks, whose times and kept maps differ, all of them have it or none.
const StoreSlot* findMap(const StoreSlot* begin, const StoreSlot* end, DataIdentity& identity,
  bool byContents, Progress& progress)
{
  // A rank that lacks a map makes all ranks make it, as advection and hashing are collective.
  const auto agreed = [&](const StoreSlot* found) {
    return onAllRanks(progress.Group(), found != end) ? found : end;
  };
  const StoreSlot* found =
    agreed(std::find_if(begin, end, [&](const StoreSlot& slot) { return slot.Holds(identity); }));
  if (found != end || !byContents)
  {
    return found;
  }
  identity.Hash(progress);
  return agreed(
    std::find_if(begin, end, [&](const StoreSlot& slot) { return slot.HoldsContent(identity); }));
}

// What the optimal maps of a blend need.
template <int D>
std::vector<MemoryPlan> memoriesOfMaps(const BlendRun& run, const Ranks& ranks)
{
  // Between two inputs there is one map, from the first to the second; else one from the
  // barycenter's grid to each input that has a weight. Maps are found one after the other.
  const OptimalNeeds needs{ run.Settings.Optimal, run.Particles };
  const auto sizeOf = [&](std::size_t i) { return run.Inputs[i].Density->Grid().Size<D>(); };
  if (run.Settings.ComparesEnds)
  {
    return { memoryOfOptimalMap<D>(sizeOf(0), sizeOf(1), needs, ranks) };
  }
  std::vector<MemoryPlan> memories;
  for (std::size_t i = 0; i < run.Inputs.size(); ++i)
  {
    if (run.Inputs[i].Weight > 0.0)
    {
      memories.push_back(memoryOfOptimalMap<D>(run.Geometry.Size<D>(), sizeOf(i), needs, ranks));
    }
  }
  // The mean of one density is that density.
  return memories.size() > 1 ? memories : std::vector<MemoryPlan>();
}

template <int D>
void requireFor(const BlendRun& run, const Ranks& ranks)
{
  // Positions in the inputs and slack, and points and images in index spaces.
  // 3 coordinates in each input, one slack, and D coordinates of a point and of its image.
  const double each =
    sizeof(double) * (3.0 * static_cast<double>(run.Inputs.size()) + 1.0 + 2.0 * D);
  for (const MemoryPlan& memory : memoriesOfMaps<D>(run, ranks))
  {
    requireMemory(memory.With(each * run.Particles / ranks.Count()));
  }
}

ConstPointSpan<3> spanOf(vtkDoubleArray* points)
{
  return { points->GetPointer(0), points->GetNumberOfTuples() };
}

// The displacements y - x of particles between their positions x and y.
vtkSmartPointer<vtkDoubleArray> displacementsOf(
  ConstPointSpan<3> from, ConstPointSpan<3> to, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  auto displacements = newArray<vtkDoubleArray>("Displacement", 3, from.size());
  double* values = displacements->GetPointer(0);
  progress.For(from.size(), grain, [&](std::int64_t first, std::int64_t last) {
    std::transform(to.data() + 3 * first, to.data() + 3 * last, from.data() + 3 * first,
      values + 3 * first, std::minus<>());
  });
  return displacements;
}

template <int D>
void findOptimal(const BlendRun& run, Progress& progress, BlendPositions& found,
  std::vector<std::string>& warnings)
{
  // The maps begin at the flow's positions, of which each particle has one in each input.
  std::vector<BlendedDensity<D>> densities;
  for (std::size_t i = 0; i < run.Inputs.size(); ++i)
  {
    const BlendInput& input = run.Inputs[i];
    const ImageGrid& grid = input.Density->Grid();
    densities.push_back({ planEnd<D>(PlanEnd<D>::In(run.Geometry, grid), *input.Density), grid,
      input.Weight, spanOf(found.Positions[i]) });
  }
  std::vector<MemoryPlan> memories = memoriesOfMaps<D>(run, progress.Group());
  memories.push_back({ "the optimal maps", 0.0 });
  // The plan with the most bytes gives the message if memory ends anywhere in the solutions; the
  // last one takes no memory, so that there is always one.
  const auto largest = std::max_element(memories.begin(), memories.end(),
    [](const MemoryPlan& a, const MemoryPlan& b) { return a.Bytes < b.Bytes; });
  const OptimalSetting& setting = run.Settings.Optimal;
  OptimalPositions moved = withRequiredMemory(*largest, [&]() {
    return blendOptimally<D>(densities,
      { setting.IsOptimal, setting.Tolerance, run.Settings.ComparesEnds, run.Geometry }, progress);
  });
  for (std::size_t i = 0; i < run.Inputs.size(); ++i)
  {
    // Inputs without a new array keep the positions of the flow, which the maps own.
    if (moved.Moved[i])
    {
      found.Positions[i] = arrayOf<vtkDoubleArray>("Positions", 3, *moved.Moved[i]);
    }
  }
  found.Slack = arrayOf<vtkDoubleArray>("Slack", 1, moved.Slack);
  found.Bound = moved.Bound;
  found.Cost = moved.Cost;
  found.Functional = moved.Functional;
  for (const auto& [input, text] : moved.Warnings)
  {
    warnings.push_back(run.Inputs[input].Name + ": " + text);
  }
}

// The transport cost of the particles between two inputs, the mean of |y - x|^2 over those of all
// ranks, and their displacements y - x. The particles of one number make the coupling of both
// densities.
void compareEnds(const BlendRun& run, Progress& progress, BlendPositions& found)
{
  const ConstPointSpan<3> from = spanOf(found.Positions[0]);
  const ConstPointSpan<3> to = spanOf(found.Positions[1]);
  found.Cost = meanSquare(LengthScale(run.Geometry), from, to, nullptr, run.Particles, progress);
  found.Displacements = displacementsOf(from, to, progress);
}

} // namespace

std::size_t LinearizedMaps::Match(
  const std::vector<BlendInput>& inputs, const LinearizedMapSettings& settings, Progress& progress)
{
  // Slots share what they keep, so that a map whose input moved to another connection, or that
  // several inputs have, stays. What no input has is released at the end.
  const std::vector<StoreSlot> before = std::exchange(this->Slots, {});
  const StoreSlot* const end = before.data() + before.size();
  // Hashing takes a pass over all values: without maps to compare with it is not needed. On several
  // ranks another one may have maps, and hashing is collective.
  const bool byContents = !before.empty() || progress.Group().AreSeveral();
  std::size_t missing = 0;
  for (const BlendInput& input : inputs)
  {
    DataIdentity identity = identityOf(*input.Density, settings);
    const StoreSlot* match = findMap(before.data(), end, identity, byContents, progress);
    this->Slots.push_back(match == end ? StoreSlot() : *match);
    match == end ? void(++missing) : this->Slots.back().TakeTimes(identity);
  }
  return missing;
}

BlendReport LinearizedMaps::Make(const std::vector<BlendInput>& inputs,
  const LinearizedMapSettings& settings, FlowCache& tables, Progress& progress)
{
  // The tables take as much memory as the particles, and little time to build.
  struct Releaser
  {
    FlowCache& Tables;
    ~Releaser() { this->Tables.Release(); }
  } const releaser{ tables };
  BlendReport report;
  Parts parts(progress, static_cast<std::int64_t>(inputs.size()));
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    StoreSlot& slot = this->Slots[i];
    // Match has found a map for this input on all ranks.
    if (!slot.IsEmpty())
    {
      continue;
    }
    InputDensity& density = *inputs[i].Density;
    Stages making(parts[static_cast<std::int64_t>(i)], { { "comparison", 1 }, { "map", 99 } });
    DataIdentity identity = identityOf(density, settings);
    // Several inputs may have the same density.
    const StoreSlot* made = findMap(
      this->Slots.data(), &slot, identity, progress.Group().AreSeveral(), making["comparison"]);
    if (made != &slot)
    {
      slot = *made;
      continue;
    }
    try
    {
      // No other filter has use for maps from this pivot, so that they are not shared.
      const auto map = slot.Get<const LinearizedMap>(
        identity, progress.Group(), making["comparison"], Sharing::None, [&]() {
          return dispatchDimension(density.Grid().Dimension(), make<1>, make<2>, make<3>)(
            density, settings, tables, making["map"]);
        });
      report.Moved += map->Flow.MovedToMass;
      const std::string warning =
        stepWarning(map->Flow, settings.Options, FlowDirection::Forward, true);
      if (!warning.empty())
      {
        report.Steps.push_back(inputs[i].Name + ": " + warning);
      }
    }
    catch (const Failure& failure)
    {
      // Which of the inputs is wrong would not be clear from the density alone.
      throw Failure(inputs[i].Name, failure);
    }
  }
  return report;
}

void requireMemoryForMaps(const BlendRun& run, const Ranks& ranks)
{
  dispatchDimension(run.Geometry.Dimension(), requireFor<1>, requireFor<2>, requireFor<3>)(
    run, ranks);
}

std::shared_ptr<const BlendPositions> findPositions(const BlendRun& run, const LinearizedMaps& maps,
  StoreSlot& kept, Progress& progress, std::vector<std::string>& warnings)
{
  const OptimalSetting& optimal = run.Settings.Optimal;
  // What the positions depend on: the geometry of the blend, the settings of optimal maps, and each
  // input's map. Linearized positions depend on nothing else.
  DataIdentity identity;
  identity.AddGrid(run.Geometry);
  identity.AddNumbers(&optimal.Tolerance, 1);
  identity.AddNumber((optimal.IsOptimal ? 1 : 0) + (optimal.Certifies ? 2 : 0));
  for (std::size_t i = 0; i < run.Inputs.size(); ++i)
  {
    identity.Add(maps.Identity(i));
    // Between two inputs particles only move along their ways.
    const bool counts = optimal.NeedsMap() && !run.Settings.ComparesEnds;
    const double weight = counts ? run.Inputs[i].Weight : 0.0;
    identity.AddNumbers(&weight, 1);
  }
  Stages stages(
    progress, { { "hash", 0 }, { "maps", optimal.NeedsMap() ? 99.0 : 0.0 }, { "ends", 1 } });
  const auto find = [&]() {
    auto found = std::make_shared<BlendPositions>();
    for (std::size_t i = 0; i < run.Inputs.size(); ++i)
    {
      found->Positions.push_back(maps[i].Positions);
    }
    if (optimal.NeedsMap())
    {
      dispatchDimension(run.Geometry.Dimension(), findOptimal<1>, findOptimal<2>, findOptimal<3>)(
        run, stages["maps"], *found, warnings);
    }
    if (run.Settings.ComparesEnds)
    {
      compareEnds(run, stages["ends"], *found);
    }
    return found;
  };
  return kept.Get<const BlendPositions>(
    identity, progress.Group(), stages["hash"], Sharing::None, find);
}

} // namespace RectifiedTransport::Bridge
