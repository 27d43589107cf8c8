// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/DensityBlend.h"

#include "Bridge/Blend/MovedInput.h"
#include "Bridge/Blend/ParticlePositions.h"
#include "Bridge/Density/CostBound.h"
#include "Bridge/Density/CostModel.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Image/CommonGrid.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Ranks/ParticleExchange.h"
#include "Bridge/Ranks/PlaceOwners.h"
#include "Bridge/Ranks/SameOnRanks.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/StepReport.h"
#include "Bridge/Splat/DistributedSplat.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/ExactSum.h"
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
#include <cmath>
#include <iterator>
#include <numeric>
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
  requireMemory(purpose.str(), each * particles);
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

} // namespace

// The map of a density among others; the end if there is none. By times alone, or else by contents.
// On ranks, whose times and kept maps differ, all of them have it or none.
template <class Maps>
auto findMap(const Maps& begin, const Maps& end, InputDensity& density,
  const LinearizedMapSettings& settings, bool byContents, Progress& progress)
{
  Maps found =
    std::find_if(begin, end, [&](const LinearizedMap& map) { return map.IsOf(density, settings); });
  if (found == end && byContents)
  {
    const ContentHash content(density, progress);
    found = std::find_if(begin, end,
      [&](const LinearizedMap& map) { return map.IsOf(content, density.Grid(), settings); });
  }
  return onAllRanks(progress.Group(), found != end) ? found : end;
}

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
    this->Means = this->Masses = this->Density = this->Displacements = nullptr;
    this->Ends = {};
    if (settings.Optimal.NeedsMap()) // before the work of the tables
    {
      requireMemoryForMaps(this->Given(inputs),
        { settings.Optimal, geometry, settings.ComparesEnds }, static_cast<double>(count), ranks);
    }
  }
  const double mapCost =
    static_cast<double>(newMaps) * Cost::flow(settings.Flow, geometry.Dimension());
  const double solutions = settings.Optimal.NeedsMap()
    ? static_cast<double>(inputs.size()) * Cost::OptimalCell / settings.ParticlesPerCell
    : 0.0;
  Stages stages(whole["blend"],
    { { "maps", mapCost }, { "optimal maps", solutions }, { "mean", 0.2 * Cost::MeanAndSplat },
      { "cost", settings.ComparesEnds ? 0.05 * Cost::MeanAndSplat : 0.0 },
      { "particles", 0.15 * Cost::MeanAndSplat }, { "density", 0.6 * Cost::MeanAndSplat } });
  BlendReport report = this->MakeMaps(inputs, pivot, tables, stages["maps"]);
  if (settings.Optimal.IsOptimal)
  {
    // The flow only leads to where the optimal maps begin, and its properties are not shown.
    report = {};
  }
  this->FindPositions(inputs, settings, geometry, stages["optimal maps"]);
  report.Steps.insert(report.Steps.end(), this->Found.Warnings.begin(), this->Found.Warnings.end());

  this->TakeMeans(inputs, stages["mean"]);
  const double mass = this->TotalMass(inputs, settings.Mode);
  const SplatTarget target{ geometry, settings.Splat, true };
  requireFiniteDensity(mass, target, "The particles' masses", "or the cells larger");
  const double massEach = mass / static_cast<double>(count);
  double cost = 0.0;
  if (settings.ComparesEnds)
  {
    cost = this->CompareEnds(geometry, count, stages["cost"]);
    output.Particles->GetPointData()->SetVectors(this->Displacements);
  }
  this->WriteParticles(inputs, geometry, massEach, stages["particles"], output.Particles);
  this->WriteDensity(inputs, target, { mass, massEach }, wanted, stages["density"], output.Density);
  const std::int64_t movedInAll =
    std::accumulate(this->Maps.begin(), this->Maps.end(), std::int64_t{ 0 },
      [](std::int64_t sum, const LinearizedMap& map) { return sum + map.Moved(); });
  std::vector<FlowReport> flows;
  std::transform(this->Maps.begin(), this->Maps.end(), std::back_inserter(flows),
    [](const LinearizedMap& map) { return map.Flow(); });
  std::vector<DensityReading> readings;
  std::transform(inputs.begin(), inputs.end(), std::back_inserter(readings),
    [](const BlendInput& input) { return input.Density->HowRead(); });
  const auto movedOnRanks = static_cast<double>(sumOverRanks(ranks, movedInAll));
  for (vtkDataObject* part :
    { static_cast<vtkDataObject*>(output.Density), static_cast<vtkDataObject*>(output.Particles) })
  {
    if (settings.ComparesEnds)
    {
      addFieldValue(part, "TransportCost", cost);
    }
    this->AddBound(geometry, settings.ComparesEnds ? cost : this->Found.Cost, part);
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
void DensityBlend::WriteDensity(const std::vector<BlendInput>& inputs, const SplatTarget& target,
  const BlendMass& mass, Extent wanted, Progress& progress, vtkImageData* output)
{
  constexpr double nearby = 0.1; // how far below 1 a weight is near it
  constexpr double rounding = 1e-9;
  const ImageGrid& geometry = target.Geometry;
  const int owner = geometry.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox box = tuplesOf(wanted, owner, geometry.Extent());
  output->SetExtent(wanted.data());
  reuseOrMake(this->Density, "Density", 1, box.Count());
  output->GetAttributes(owner)->SetScalars(this->Density);
  const auto heaviest = std::max_element(inputs.begin(), inputs.end(),
    [](const BlendInput& a, const BlendInput& b) { return a.Weight < b.Weight; });
  const auto number = static_cast<std::size_t>(heaviest - inputs.begin());
  const double linear = 1.0 - (1.0 - heaviest->Weight) / nearby;
  const double share = linear > rounding ? linear : 0.0;
  const MovedInput input{ *heaviest->Density, this->Maps[number].TotalMass(), share * mass.All,
    this->Found.Positions[number], this->Means };
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
  const std::vector<LinearizedMap> before = std::exchange(this->Maps, {});
  std::size_t missing = 0;
  for (const BlendInput& input : inputs)
  {
    InputDensity& density = *input.Density;
    this->Maps.emplace_back();
    const bool byContents = !before.empty() || progress.Group().AreSeveral();
    const auto match =
      findMap(before.begin(), before.end(), density, settings, byContents, progress);
    if (match == before.end())
    {
      ++missing;
      continue;
    }
    this->Maps.back() = *match;
    this->Maps.back().SetTimes(density);
  }
  return missing;
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
    LinearizedMap& map = this->Maps[i];
    InputDensity& density = *inputs[i].Density;
    if (map.Positions())
    {
      continue;
    }
    Progress& making = parts[static_cast<std::int64_t>(i)];
    // Several inputs may have the same density.
    const auto before = this->Maps.cbegin() + static_cast<std::ptrdiff_t>(i);
    const auto made = findMap(
      this->Maps.cbegin(), before, density, settings, progress.Group().AreSeveral(), making);
    if (made != before)
    {
      map = *made;
      continue;
    }
    try
    {
      map.Make(density, settings, tables, making);
      report.Moved += map.Moved();
      const std::string warning =
        stepWarning(map.Flow(), settings.Options, FlowDirection::Forward, true);
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

// With the positions of the maps that there are.
std::vector<OptimalBlendInput> DensityBlend::Given(const std::vector<BlendInput>& inputs) const
{
  std::vector<OptimalBlendInput> given;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    given.push_back(
      { inputs[i].Density.get(), inputs[i].Name, inputs[i].Weight, this->Maps[i].Positions() });
  }
  return given;
}

void DensityBlend::FindPositions(const std::vector<BlendInput>& inputs,
  const BlendSettings& settings, const ImageGrid& geometry, Progress& progress)
{
  decltype(this->FoundFor) now;
  now.Optimal = settings.Optimal;
  now.Geometry = geometry;
  const std::vector<OptimalBlendInput> given = this->Given(inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    now.Maps.emplace_back(given[i].Positions);
    // Between two inputs particles only move along their ways.
    now.Weights.push_back(settings.ComparesEnds ? 0.0 : inputs[i].Weight);
  }
  if (!settings.Optimal.NeedsMap())
  {
    this->Found = {};
    for (const OptimalBlendInput& input : given)
    {
      this->Found.Positions.emplace_back(input.Positions);
    }
  }
  else
  {
    const bool isFound = now.Maps == this->FoundFor.Maps && now.Weights == this->FoundFor.Weights &&
      now.Optimal == this->FoundFor.Optimal && now.Geometry == this->FoundFor.Geometry;
    if (!onAllRanks(progress.Group(), isFound))
    {
      this->Found = {};
      this->FoundFor = {};
      this->Found =
        blendOptimally(given, { settings.Optimal, geometry, settings.ComparesEnds }, progress);
    }
    else
    {
      this->Found.Warnings.clear();
    }
  }
  this->FoundFor = now;
}

void DensityBlend::AddBound(const ImageGrid& geometry, double cost, vtkDataObject* output) const
{
  if (this->Found.Slack)
  {
    addCostBound(output, this->Found.Bound, cost, geometry);
  }
  if (!this->Found.Functional.empty())
  {
    addFieldValues(output, "Functional", this->Found.Functional);
  }
}

void DensityBlend::TakeMeans(const std::vector<BlendInput>& inputs, Progress& progress)
{
  const std::int64_t count = this->Maps.front().Positions()->GetNumberOfTuples();
  reuseOrMake(this->Means, "Points", 3, count);
  writeMeans(this->Found.Positions, inputs, progress, { this->Means->GetPointer(0), count });
}

// Takes the displacements y - x of the particles between their positions x and y in the two inputs.
// Returns the mean of |y - x|^2 over all of them. No work where the maps are those of the last
// call.
double DensityBlend::CompareEnds(
  const ImageGrid& geometry, std::int64_t particles, Progress& progress)
{
  const std::array<vtkDoubleArray*, 2> ends = { this->Found.Positions[0],
    this->Found.Positions[1] };
  if (onAllRanks(progress.Group(), this->Ends[0] == ends[0] && this->Ends[1] == ends[1]))
  {
    return this->EndsCost;
  }
  const std::int64_t count = ends[0]->GetNumberOfTuples();
  const ConstPointSpan<3> from(ends[0]->GetPointer(0), count);
  const ConstPointSpan<3> to(ends[1]->GetPointer(0), count);
  this->Displacements = newArray<vtkDoubleArray>("Displacement", 3, count);
  const PointSpan<3> displacements(this->Displacements->GetPointer(0), count);
  const LengthScale scale(geometry);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  const auto own = sumExactly<ExactSum>(
    progress, count, grain, [&](std::int64_t first, std::int64_t last, ExactSum& sum) {
      for (std::int64_t i = first; i < last; ++i)
      {
        sum.Add(scale.SquaredDistanceInUnits(to[i], from[i]));
        for (int axis = 0; axis < 3; ++axis)
        {
          displacements[i][axis] = to[i][axis] - from[i][axis];
        }
      }
    });
  const ExactSum squares = sumOverRanks(progress.Group(), own);
  this->EndsCost = scale.CostFromUnits(squares.Value() / static_cast<double>(particles));
  this->Ends = { ends[0], ends[1] };
  return this->EndsCost;
}

double DensityBlend::TotalMass(const std::vector<BlendInput>& inputs, MassMode mode) const
{
  if (mode == MassMode::Source || mode == MassMode::Normalize)
  {
    return mode == MassMode::Source ? this->Maps.front().TotalMass() : 1.0;
  }
  double sum = 0.0;
  double product = 1.0;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    sum += inputs[i].Weight * this->Maps[i].TotalMass();
    product *= std::pow(this->Maps[i].TotalMass(), inputs[i].Weight);
  }
  return mode == MassMode::Linear ? sum : product;
}

void DensityBlend::WriteParticles(const std::vector<BlendInput>& inputs, const ImageGrid& geometry,
  double massEach, Progress& progress, vtkPolyData* output)
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
      named->ShallowCopy(this->Found.Positions[i]);
      named->SetName(inputs[i].PositionName.c_str());
      output->GetPointData()->AddArray(named);
    }
  }
  if (this->Found.Slack)
  {
    vtkNew<vtkDoubleArray> slack;
    slack->ShallowCopy(this->Found.Slack);
    slack->SetName("Slack");
    output->GetPointData()->AddArray(slack);
  }
  Stages stages(progress, { { "places", 1 }, { "masses", 1 } });
  const Ranks& ranks = progress.Group();
  if (ranks.AreSeveral())
  {
    moveToOwners(output, 1, PlaceOwners(geometry, nullptr, ranks), ranks, stages["places"]);
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
