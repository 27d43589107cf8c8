// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ensembles/DensityBlend.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Plan/DensityQueries.h"
#include "Bridge/Ranks/ParticleExchange.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Bridge/Run/CostModel.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Blend/AdvectedCells.h"
#include "Core/Flow/WeightedMean.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Geometry/Dispatch.h"

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
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

// The grid of the blend: the smallest box around all inputs, with the given dimensions or the
// finest spacing, but then with no more cells than the largest input, which bounds the number of
// particles.
ImageGrid gridBetween(const std::vector<BlendInput>& inputs, const int dimensions[3])
{
  std::vector<NamedGrid> grids;
  for (const BlendInput& input : inputs)
  {
    grids.push_back({ input.Density->Grid(), input.Name });
  }
  return commonGrid(grids, dimensions, MostCells::OfTheLargest);
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

// The name that all inputs' arrays have.
std::string commonName(const std::vector<BlendInput>& inputs)
{
  const std::string name = inputs.front().Density->NameOfArray();
  const bool isCommon = std::all_of(inputs.begin(), inputs.end(),
    [&](const BlendInput& input) { return input.Density->NameOfArray() == name; });
  return isCommon && !name.empty() ? name : "Density";
}

// Makes an array of values that are not initialised, in the memory of the last one where it has no
// other owner.
void reuseOrMake(
  vtkSmartPointer<vtkDoubleArray>& array, const char* name, int components, std::int64_t tuples)
{
  // An output that somebody still holds, such as a cache of time steps, must keep its values.
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

// The density of an input, as it was read, on its way with this rank's particles.
struct AdvectedInput
{
  InputDensity& Density;
  double OwnMass;       // the mass that the density has
  double Mass;          // the mass that it gets
  vtkDoubleArray* From; // where the particles are in the density
  vtkDoubleArray* To;   // and where they are now
};

// Writes the density, with its mass, on the wanted tuples of a grid that covers its domain. Nothing
// has moved. To the bit, if the masses and the cells are the same. Collective.
void writeInput(const AdvectedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* values)
{
  writeDensityOn(grid, input.Density, wanted, progress, values);
  rescaleMass(input.OwnMass, input.Mass, values, wanted.Count());
}

// Each rank reads a part of the input's cells, without overlap, and the ranks then exchange cells
// with those that want the places to which they move. All bits are the same for any number of
// ranks.
template <int D>
void addMoved(const AdvectedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* density)
{
  Stages stages(progress, { { "input", 1 }, { "cells", 9 } });
  const int owner = grid.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox own = partOfRank(tuplesOf(grid.Extent(), owner, grid.Extent()), progress.Group());
  LargeBuffer<double> given(own.Count());
  writeInput(input, grid, own, stages["input"], given.data());
  const auto spanOf = [](vtkDoubleArray* points) -> ConstPointSpan<3> {
    return { points->GetPointer(0), points->GetNumberOfTuples() };
  };
  addAdvected<D>(
    { grid, latticePartOf<D>(own, grid), given.data(), spanOf(input.From), spanOf(input.To) },
    latticePartOf<D>(wanted, grid), stages["cells"], density);
}

// Adds the density of its cells, each moved by the mean move of the particles in it; cells without
// particles stay. The same bits for every number of threads and ranks. Collective.
void addAdvectedInput(const AdvectedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* density)
{
  const double cells = static_cast<double>(wanted.Count());
  // See addAdvected: doubles for each cell, among them its mean displacement, and a key for each
  // particle.
  const double bytes = 8.0 * (6.0 + grid.Dimension()) * cells +
    8.0 * static_cast<double>(input.From->GetNumberOfTuples());
  withMemory({ "the cells near an input", bytes }, [&]() {
    dispatchDimension(grid.Dimension(), addMoved<1>, addMoved<2>, addMoved<3>)(
      input, grid, wanted, progress, density);
  });
}

} // namespace

BlendReport DensityBlend::Run(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
  FlowCache& tables, Progress& progress, vtkInformationVector* outputs)
{
  vtkInformation* announced = outputs->GetInformationObject(0);
  vtkImageData* image = vtkImageData::GetData(outputs, 0);
  vtkPolyData* particles = vtkPolyData::GetData(outputs, 1);
  const Ranks& ranks = progress.Group();
  // The number of particles is a double here: it is checked before it becomes an integer.
  const ImageGrid geometry = gridBetween(inputs, settings.Dimensions);
  const BlendRun run{ inputs, settings, geometry,
    numberOfValues(geometry) * settings.ParticlesPerCell };
  requireMemoryFor(run.Particles / ranks.Count(), inputs.size(), settings.ComparesEnds);
  requireCells(geometry);
  const auto count = static_cast<std::int64_t>(run.Particles);
  const LinearizedMapSettings pivot{ geometry, settings.ParticlesPerCell, settings.Flow,
    settings.Tables, RankShare(count, ranks) };
  // The image gets the whole grid first, and below this rank's part of it, before its values.
  Extent wanted = extentToGive(geometry.Extent(), announced, ranks);
  applyGrid(geometry, image);
  announceGrid(geometry, announced); // the association may not be known before the data

  Stages whole(progress, { { "kept maps", 1 }, { "blend", 99 } });
  // Maps are nearly all of the work: if only weights change, kept maps give the blend at once.
  const std::size_t newMaps = this->Maps.Match(inputs, pivot, whole["kept maps"]);
  if (newMaps > 0)
  {
    // Releases memory for the tables.
    this->Means = this->Masses = this->Density = nullptr;
    this->Found.Release();
    if (settings.Optimal.NeedsMap()) // before the work of the tables
    {
      requireMemoryForMaps(run, ranks);
    }
  }
  // Estimated times for each particle of the blend, by which the stages divide the progress.
  const double mapCost =
    static_cast<double>(newMaps) * Cost::flow(settings.Flow, geometry.Dimension());
  const double solutions = settings.Optimal.NeedsMap()
    ? static_cast<double>(inputs.size()) * Cost::OptimalCell / settings.ParticlesPerCell
    : 0.0;
  Stages stages(whole["blend"],
    { { "maps", mapCost }, { "optimal maps", solutions }, { "mean", 0.2 * Cost::MeanAndSplat },
      { "particles", 0.15 * Cost::MeanAndSplat }, { "density", 0.6 * Cost::MeanAndSplat } });
  BlendReport report = this->Maps.Make(inputs, pivot, tables, stages["maps"]);
  if (settings.Optimal.IsOptimal)
  {
    // The flow only leads to where the optimal maps begin, and its properties are not shown.
    report = {};
  }
  const auto found =
    findPositions(run, this->Maps, this->Found, stages["optimal maps"], report.Steps);
  this->TakeMeans(run, *found, stages["mean"]);
  std::int64_t movedInAll = 0;
  std::vector<double> masses;
  std::vector<double> weights;
  std::vector<FlowReport> flows;
  std::vector<DensityReading> readings;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    masses.push_back(this->Maps[i].TotalMass);
    weights.push_back(inputs[i].Weight);
    flows.push_back(this->Maps[i].Flow);
    movedInAll += flows.back().MovedToMass;
    readings.push_back(inputs[i].Density->HowRead());
  }
  // The masses of the inputs, as their tables sum them, determine that of the blend.
  const double mass = blendedMass(settings.Mode, masses, weights);
  requireFiniteDensity(
    mass, { geometry, settings.Splat, true }, "The particles' masses", "or the cells larger");
  this->WriteParticles(run, *found, mass, stages["particles"], particles);
  image->SetExtent(wanted.data());
  this->WriteDensity(run, *found, mass, stages["density"], image);
  const auto movedOnRanks = static_cast<double>(sumOverRanks(ranks, movedInAll));
  for (vtkDataObject* part :
    { static_cast<vtkDataObject*>(image), static_cast<vtkDataObject*>(particles) })
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

void DensityBlend::TakeMeans(const BlendRun& run, const BlendPositions& found, Progress& progress)
{
  const std::int64_t count = found.Positions.front()->GetNumberOfTuples();
  reuseOrMake(this->Means, "Points", 3, count);
  // The blend of particle i is the weighted mean sum_k w_k x_k(i) of its positions in the inputs,
  // physical and with weights that sum to 1 (Section 3.4).
  std::vector<WeightedPositions> parts;
  for (std::size_t i = 0; i < run.Inputs.size(); ++i)
  {
    parts.push_back({ { found.Positions[i]->GetPointer(0), count }, run.Inputs[i].Weight });
  }
  writeWeightedMean(parts, { this->Means->GetPointer(0), count }, progress);
}

void DensityBlend::WriteParticles(const BlendRun& run, const BlendPositions& found, double mass,
  Progress& progress, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetData(this->Means);
  output->SetPoints(points);
  vtkPointData* data = output->GetPointData();
  if (found.Displacements)
  {
    data->SetVectors(found.Displacements);
  }
  // Inputs of one density share the values, under different names.
  const auto add = [&](vtkDoubleArray* array, const std::string& name) {
    vtkNew<vtkDoubleArray> named;
    named->ShallowCopy(array);
    named->SetName(name.c_str());
    data->AddArray(named);
  };
  for (std::size_t i = 0; i < run.Inputs.size(); ++i)
  {
    if (!run.Inputs[i].PositionName.empty())
    {
      add(found.Positions[i], run.Inputs[i].PositionName);
    }
  }
  if (found.Slack)
  {
    add(found.Slack, "Slack");
  }
  Stages stages(progress, { { "places", 1 }, { "masses", 1 } });
  moveToOwners(output, run.Geometry, this->Vertices, stages["places"]);
  const std::int64_t count = output->GetNumberOfPoints();
  reuseOrMake(this->Masses, "Mass", 1, count);
  double* masses = this->Masses->GetPointer(0);
  const double each = mass / run.Particles;
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  // All particles have the same mass, the mass of the blend divided by their number on all ranks.
  stages["masses"].For(count, grain,
    [=](std::int64_t first, std::int64_t last) { std::fill(masses + first, masses + last, each); });
  data->AddArray(this->Masses);
}

// At a weight of 1 the density of that input; near it, more and more of that density as its cells
// move, so that there is no jump; else that of the particles.
void DensityBlend::WriteDensity(const BlendRun& run, const BlendPositions& found, double mass,
  Progress& progress, vtkImageData* output)
{
  const ImageGrid& geometry = run.Geometry;
  const int owner = geometry.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  Extent wanted;
  output->GetExtent(wanted.data());
  const TupleBox box = tuplesOf(wanted, owner, geometry.Extent());
  const std::string& name = run.Settings.ArrayName;
  reuseOrMake(
    this->Density, (name.empty() ? commonName(run.Inputs) : name).c_str(), 1, box.Count());
  output->GetAttributes(owner)->SetScalars(this->Density);
  // Particles resolve a density only to their spacing, but the input itself has all details: its
  // own cells take part from a weight of .9 on (see shareOfHeaviest).
  const auto heaviest = std::max_element(run.Inputs.begin(), run.Inputs.end(),
    [](const BlendInput& a, const BlendInput& b) { return a.Weight < b.Weight; });
  const auto number = static_cast<std::size_t>(heaviest - run.Inputs.begin());
  const double share = shareOfHeaviest(heaviest->Weight);
  const AdvectedInput input{ *heaviest->Density, this->Maps[number].TotalMass, share * mass,
    found.Positions[number], this->Means };
  // Nothing moves: the values are those of the input, to the bit where grids agree.
  if (heaviest->Weight == 1.0)
  {
    writeInput(input, geometry, box, progress, this->Density->GetPointer(0));
    return;
  }
  Stages stages(progress, { { "splat", 3 }, { "input", share > 0.0 ? 7.0 : 0.0 } });
  splatDistributed(this->Means, nullptr, (1.0 - share) * (mass / run.Particles), nullptr,
    { geometry, run.Settings.Splat, true }, box, stages["splat"], this->Density);
  if (share > 0.0)
  {
    addAdvectedInput(input, geometry, box, stages["input"], this->Density->GetPointer(0));
  }
}

} // namespace RectifiedTransport::Bridge
