// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/DensityBlend.h"

#include "Bridge/Blend/MovedInput.h"
#include "Bridge/Density/CostModel.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Image/CommonGrid.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/ParticleExchange.h"
#include "Bridge/Ranks/SameOnRanks.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/StepReport.h"
#include "Bridge/Splat/DistributedSplat.h"
#include "Core/Flow/WeightedMean.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

ImageGrid gridBetween(const std::vector<BlendInput>& inputs, const int dimensions[3])
{
  std::vector<NamedGrid> grids;
  for (const BlendInput& input : inputs)
  {
    grids.push_back({ input.Density->Grid(), input.Name });
  }
  return commonGrid(grids, dimensions, MostCells::OfTheLargest);
}

std::array<std::int64_t, 3> cellsOf(const ImageGrid& geometry)
{
  std::array<std::int64_t, 3> grid{ 1, 1, 1 };
  const GridSize<3> size = geometry.Size<3>();
  std::copy_n(size.begin(), geometry.Dimension(), grid.begin());
  return grid;
}

void requireMemoryFor(double particles, std::size_t inputs, bool withDisplacements)
{
  // Positions for each input and their mean, displacements, masses and vertices.
  const double each = 24.0 * static_cast<double>(inputs + (withDisplacements ? 2 : 1)) + 24.0;
  std::ostringstream purpose;
  purpose.precision(20);
  purpose << particles << " particles (see ParticlesPerCell and Dimensions)";
  requireMemory({ purpose.str(), each * particles });
}

// Makes an array of values that are not initialised, in the memory of the last one where it has no
// other owner.
void reuseOrMake(
  vtkSmartPointer<vtkDoubleArray>& array, const char* name, int components, std::int64_t tuples)
{
  const bool isUnique = array && array->GetReferenceCount() == 1;
  if (!isUnique || array->GetNumberOfTuples() != tuples)
  {
    array = nullptr;
    array = newArray<vtkDoubleArray>(name, components, tuples);
    return;
  }
  array->GetInformation()->Clear();
  array->SetName(name);
  array->Modified();
}

// The slot among others that keeps a map; the end if there is none. By times alone, or else by
// contents. On ranks, whose times and kept maps differ, all of them have it or none.
template <class Slots>
Slots findMap(
  const Slots& begin, const Slots& end, DataIdentity& identity, bool byContents, Progress& progress)
{
  const auto agreed = [&](const Slots& found) {
    return onAllRanks(progress.Group(), found != end) ? found : end;
  };
  const Slots found =
    agreed(std::find_if(begin, end, [&](const StoreSlot& slot) { return slot.Holds(identity); }));
  if (found != end || !byContents)
  {
    return found;
  }
  identity.Hash(progress);
  return agreed(
    std::find_if(begin, end, [&](const StoreSlot& slot) { return slot.HoldsContent(identity); }));
}

} // namespace

BlendOutput::BlendOutput(vtkInformationVector* outputs)
  : Announced(outputs->GetInformationObject(0))
  , Density(vtkImageData::GetData(outputs, 0))
  , Particles(vtkPolyData::GetData(outputs, 1))
{
}

BlendReport DensityBlend::Run(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
  FlowCache& tables, Progress& progress, const BlendOutput& output)
{
  const Ranks& ranks = progress.Group();
  const ImageGrid geometry = gridBetween(inputs, settings.Dimensions);
  const double all = numberOfValues(geometry) * settings.ParticlesPerCell;
  requireMemoryFor(all / ranks.Count(), inputs.size(), settings.ComparesEnds);
  requireCells(geometry);
  const auto count = static_cast<std::int64_t>(all);
  const LinearizedMapSettings pivot{ cellsOf(geometry), settings.ParticlesPerCell, settings.Flow,
    settings.Tables, RankShare(count, ranks) };
  const Extent wanted = extentToGive(geometry.Extent(), output.Announced, ranks);
  applyGrid(geometry, output.Density);
  announceGrid(geometry, output.Announced); // the association may not be known before the data

  Stages whole(progress, { { "kept maps", 1 }, { "blend", 99 } });
  const std::size_t newMaps = this->MatchMaps(inputs, pivot, whole["kept maps"]);
  if (newMaps > 0)
  {
    // Releases memory for the tables.
    this->Means = this->Masses = this->Density = nullptr;
    this->Found.Release();
    if (settings.Optimal.NeedsMap()) // before the work of the tables
    {
      requireMemoryForMaps(inputs, settings, geometry, all, ranks);
    }
  }
  const double mapCost =
    static_cast<double>(newMaps) * Cost::flow(settings.Flow, geometry.Dimension());
  const double solutions = settings.Optimal.NeedsMap()
    ? static_cast<double>(inputs.size()) * Cost::OptimalCell / settings.ParticlesPerCell
    : 0.0;
  Stages stages(whole["blend"],
    { { "maps", mapCost }, { "optimal maps", solutions }, { "mean", 0.2 * Cost::MeanAndSplat },
      { "particles", 0.15 * Cost::MeanAndSplat }, { "density", 0.6 * Cost::MeanAndSplat } });
  BlendReport report = this->MakeMaps(inputs, pivot, tables, stages["maps"]);
  if (settings.Optimal.IsOptimal)
  {
    // The flow only leads to where the optimal maps begin, and its properties are not shown.
    report = {};
  }
  const auto found =
    this->FindPositions(inputs, settings, geometry, count, stages["optimal maps"], report.Steps);
  this->TakeMeans(inputs, *found, stages["mean"]);
  const double mass = this->TotalMass(inputs, settings.Mode);
  const SplatTarget target{ geometry, settings.Splat, true };
  requireFiniteDensity(mass, target, "The particles' masses", "or the cells larger");
  const double massEach = mass / static_cast<double>(count);
  if (settings.ComparesEnds)
  {
    output.Particles->GetPointData()->SetVectors(found->Displacements);
  }
  this->WriteParticles(inputs, *found, geometry, massEach, stages["particles"], output.Particles);
  this->WriteDensity(
    inputs, *found, target, { mass, massEach }, wanted, stages["density"], output.Density);
  std::int64_t movedInAll = 0;
  std::vector<FlowReport> flows;
  std::vector<DensityReading> readings;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    flows.push_back(this->MapOf(i).Flow);
    movedInAll += flows.back().MovedToMass;
    readings.push_back(inputs[i].Density->HowRead());
  }
  const auto movedOnRanks = static_cast<double>(sumOverRanks(ranks, movedInAll));
  for (vtkDataObject* part :
    { static_cast<vtkDataObject*>(output.Density), static_cast<vtkDataObject*>(output.Particles) })
  {
    if (settings.ComparesEnds)
    {
      addFieldValue(part, "TransportCost", found->Cost);
    }
    if (found->Slack)
    {
      addCostBound(part, found->Bound, found->Cost, geometry);
    }
    if (!found->Functional.empty())
    {
      addFieldValues(part, "Functional", found->Functional);
    }
    addFieldValue(part, "TotalMass", mass);
    addFieldValue(part, "MovedParticles", movedOnRanks);
    addSteps(part, flows);
    addReadings(part, readings);
  }
  report.Particles = count;
  report.Moved = sumOverRanks(ranks, report.Moved);
  return report;
}

// At a weight of 1 the density of that input; near it, more and more of that density as its cells
// move, so that there is no jump; else that of the particles.
void DensityBlend::WriteDensity(const std::vector<BlendInput>& inputs, const BlendPositions& found,
  const SplatTarget& target, const BlendMass& mass, Extent wanted, Progress& progress,
  vtkImageData* output)
{
  const ImageGrid& geometry = target.Geometry;
  const int owner = geometry.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox box = tuplesOf(wanted, owner, geometry.Extent());
  output->SetExtent(wanted.data());
  reuseOrMake(this->Density, "Density", 1, box.Count());
  output->GetAttributes(owner)->SetScalars(this->Density);
  const auto heaviest = std::max_element(inputs.begin(), inputs.end(),
    [](const BlendInput& a, const BlendInput& b) { return a.Weight < b.Weight; });
  const auto number = static_cast<std::size_t>(heaviest - inputs.begin());
  const double share = shareOfHeaviest(heaviest->Weight);
  const MovedInput input{ *heaviest->Density, this->MapOf(number).TotalMass, share * mass.All,
    found.Positions[number], this->Means };
  if (heaviest->Weight == 1.0)
  {
    writeInput(input, geometry, box, progress, this->Density->GetPointer(0));
    return;
  }
  Stages stages(progress, { { "splat", 3 }, { "input", share > 0.0 ? 7.0 : 0.0 } });
  splatDistributed(this->Means, nullptr, (1.0 - share) * mass.Each, nullptr, target, box,
    stages["splat"], this->Density);
  if (share > 0.0)
  {
    addMovedInput(input, geometry, box, stages["input"], this->Density->GetPointer(0));
  }
}

// Assigns to each input the kept map of its density, whatever input had it before, or an empty one.
// Returns how many are empty.
std::size_t DensityBlend::MatchMaps(
  const std::vector<BlendInput>& inputs, const LinearizedMapSettings& settings, Progress& progress)
{
  const std::vector<StoreSlot> before = std::exchange(this->Maps, {});
  const bool byContents = !before.empty() || progress.Group().AreSeveral();
  std::size_t missing = 0;
  for (const BlendInput& input : inputs)
  {
    DataIdentity identity = identityOfMap(*input.Density, settings);
    const auto match = findMap(before.begin(), before.end(), identity, byContents, progress);
    this->Maps.push_back(match == before.end() ? StoreSlot() : *match);
    match == before.end() ? void(++missing) : this->Maps.back().TakeTimes(identity);
  }
  return missing;
}

const LinearizedMap& DensityBlend::MapOf(std::size_t input) const
{
  return *this->Maps[input].Kept<const LinearizedMap>();
}

BlendReport DensityBlend::MakeMaps(const std::vector<BlendInput>& inputs,
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
    if (!this->Maps[i].IsEmpty())
    {
      continue;
    }
    InputDensity& density = *inputs[i].Density;
    Stages making(parts[static_cast<std::int64_t>(i)], { { "comparison", 1 }, { "map", 99 } });
    DataIdentity identity = identityOfMap(density, settings);
    // Several inputs may have the same density.
    const auto before = this->Maps.cbegin() + static_cast<std::ptrdiff_t>(i);
    const auto made = findMap(
      this->Maps.cbegin(), before, identity, progress.Group().AreSeveral(), making["comparison"]);
    if (made != before)
    {
      this->Maps[i] = *made;
      continue;
    }
    try
    {
      const auto map = this->Maps[i].Get<const LinearizedMap>(identity, progress.Group(),
        making["comparison"], Sharing::None,
        [&]() { return makeLinearizedMap(density, settings, tables, making["map"]); });
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
      throw Failure(inputs[i].Name, failure);
    }
  }
  return report;
}

std::shared_ptr<const BlendPositions> DensityBlend::FindPositions(
  const std::vector<BlendInput>& inputs, const BlendSettings& settings, const ImageGrid& geometry,
  std::int64_t particles, Progress& progress, std::vector<std::string>& warnings)
{
  const OptimalSetting& optimal = settings.Optimal;
  DataIdentity identity;
  identity.AddGrid(geometry);
  identity.AddNumbers(&optimal.Tolerance, 1);
  identity.AddNumber((optimal.IsOptimal ? 1 : 0) + (optimal.Certifies ? 2 : 0));
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    identity.Add(this->Maps[i].Identity());
    // Between two inputs particles only move along their ways.
    const bool counts = optimal.NeedsMap() && !settings.ComparesEnds;
    const double weight = counts ? inputs[i].Weight : 0.0;
    identity.AddNumbers(&weight, 1);
  }
  std::vector<vtkSmartPointer<vtkDoubleArray>> given;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    given.push_back(this->MapOf(i).Positions);
  }
  Stages stages(progress, { { "hash", 0 }, { "positions", 1 } });
  return this->Found.Get<const BlendPositions>(
    identity, progress.Group(), stages["hash"], Sharing::None, [&]() {
      return makePositions(
        inputs, given, settings, geometry, particles, stages["positions"], warnings);
    });
}

void DensityBlend::TakeMeans(
  const std::vector<BlendInput>& inputs, const BlendPositions& found, Progress& progress)
{
  const std::int64_t count = found.Positions.front()->GetNumberOfTuples();
  reuseOrMake(this->Means, "Points", 3, count);
  std::vector<WeightedPositions> parts;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    parts.push_back({ { found.Positions[i]->GetPointer(0), count }, inputs[i].Weight });
  }
  writeWeightedMean(parts, { this->Means->GetPointer(0), count }, progress);
}

double DensityBlend::TotalMass(const std::vector<BlendInput>& inputs, BlendedMass mode) const
{
  std::vector<double> masses;
  std::vector<double> weights;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    masses.push_back(this->MapOf(i).TotalMass);
    weights.push_back(inputs[i].Weight);
  }
  return blendedMass(mode, masses, weights);
}

void DensityBlend::WriteParticles(const std::vector<BlendInput>& inputs,
  const BlendPositions& found, const ImageGrid& geometry, double massEach, Progress& progress,
  vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetData(this->Means);
  output->SetPoints(points);
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    if (!inputs[i].PositionName.empty())
    {
      // Inputs of one density share the values, under different names.
      vtkNew<vtkDoubleArray> named;
      named->ShallowCopy(found.Positions[i]);
      named->SetName(inputs[i].PositionName.c_str());
      output->GetPointData()->AddArray(named);
    }
  }
  if (found.Slack)
  {
    vtkNew<vtkDoubleArray> slack;
    slack->ShallowCopy(found.Slack);
    slack->SetName("Slack");
    output->GetPointData()->AddArray(slack);
  }
  Stages stages(progress, { { "places", 1 }, { "masses", 1 } });
  const Ranks& ranks = progress.Group();
  if (ranks.AreSeveral())
  {
    moveToOwners(output, 1, ownersOf(geometry, nullptr, ranks), ranks, stages["places"]);
  }
  else
  {
    this->WriteVertices(stages["places"], output);
  }
  const std::int64_t count = output->GetNumberOfPoints();
  reuseOrMake(this->Masses, "Mass", 1, count);
  double* mass = this->Masses->GetPointer(0);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  stages["masses"].For(count, grain,
    [=](std::int64_t first, std::int64_t last) { std::fill(mass + first, mass + last, massEach); });
  output->GetPointData()->AddArray(this->Masses);
}

void DensityBlend::WriteVertices(Progress& progress, vtkPolyData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  if (!this->Vertices || this->Vertices->GetNumberOfCells() != count)
  {
    this->Vertices = newParticleCells(count, 1, progress);
  }
  output->SetVerts(this->Vertices);
}

} // namespace RectifiedTransport::Bridge
