// SPDX-License-Identifier: BSD-3-Clause
// Sample Density, Density-Equalizing Warp, Transport Quality and Relax Blue Noise.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkCellData.h"
#include "vtkDensityEqualizingWarp.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkTransportQuality.h"
#include "vtkTransportSampler.h"

#include <algorithm>
#include <cmath>

namespace Campaign
{

namespace
{

// The slack of each particle.
void checkSlack(vtkTransportSampler* sampler, Findings& findings)
{
  vtkPolyData* output = sampler->GetOutput();
  const bool isBounded = output->GetFieldData()->GetArray("OptimalityGap") != nullptr;
  vtkDataArray* found = output->GetPointData()->GetArray("Slack");
  findings.That(isBounded == (found != nullptr), "Slack is there with a bound");
  if (isBounded && found)
  {
    requireArray(output->GetPointData(), "Slack", 1, output->GetNumberOfPoints(), findings);
    findings.That(found->GetRange(0)[0] >= 0.0, "Slack is not negative");
  }
}

//------------------------------------------------------------------------------
using Sampler = vtkTransportSampler;

void drawSampler(Settings& settings)
{
  settings.Draw<Sampler, vtkIdType>("NumberOfParticles", &Sampler::SetNumberOfParticles,
    { 1, 2, 10, 100, 500, 500, 1000, 1500 }, {}, 1.0);
  if (settings.GetRandom().Chance(0.03))
  {
    settings.Draw<Sampler, vtkIdType>("NumberOfParticles", &Sampler::SetNumberOfParticles,
      { 0, -1, 1000000000000, std::numeric_limits<vtkIdType>::max() }, {}, 1.0);
  }
  if (settings.IsLarge())
  {
    settings.Add("NumberOfParticles", "20000",
      [](vtkAlgorithm* filter) { Sampler::SafeDownCast(filter)->SetNumberOfParticles(20000); });
  }
  settings.Draw<Sampler, int>(
    "SeedPattern", &Sampler::SetSeedPattern, { 0, 1, 2, 3, 4 }, { -1, 5 });
  settings.Draw<Sampler, int>("RandomSeed", &Sampler::SetRandomSeed,
    { 0, 1, -1, 77, std::numeric_limits<int>::max(), std::numeric_limits<int>::min() }, {}, 0.3);
  settings.Draw<Sampler, int>(
    "SamplesPerCell", &Sampler::SetSamplesPerCell, { 0, 1, 2 }, { -1 }, 0.2);
  settings.Draw<Sampler, double>(
    "FlowTime", &Sampler::SetFlowTime, { 0.0, 0.25, 0.999, 1.0, 5e-324 }, { -0.1, 1.1, NaN }, 0.4);
  settings.Draw<Sampler, vtkTypeBool>(
    "OutputPaths", &Sampler::SetOutputPaths, { 0, 1 }, {}, settings.IsLarge() ? 0.0 : 0.15);
  settings.Draw<Sampler, vtkTypeBool>("SampleArrays", &Sampler::SetSampleArrays, { 0, 1 }, {});
  drawFlowSettings<vtkTransportAlgorithm>(settings);
  drawTables<Sampler>(settings);
  drawDevice<Sampler>(settings);
  drawMethod<Sampler>(settings);
  drawDensitySettings(settings);
}

Inputs drawSamplerInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[0] = { drawDensityOn(random, settings, 0) };
  if (random.Chance(0.3))
  {
    inputs[1] = { drawPoints(
      random, vtkImageData::SafeDownCast(inputs[0][0].Data), settings.IsLarge() ? 20000 : 500) };
  }
  return inputs;
}

bool usesGrid(Sampler* sampler)
{
  return sampler->GetSamplesPerCell() > 0 &&
    (sampler->GetSeedPattern() == Sampler::LATTICE ||
      sampler->GetSeedPattern() == Sampler::JITTERED);
}

State expectSampler(vtkAlgorithm* filter, const Inputs& inputs)
{
  auto* sampler = Sampler::SafeDownCast(filter);
  State state = densityState(filter, inputs[0][0]);
  if (!inputs[1].empty())
  {
    return worse(state, inputs[1][0].Condition);
  }
  const vtkIdType count = sampler->GetNumberOfParticles();
  if (!usesGrid(sampler) && (count < 1 || count > 1000000))
  {
    state = worse(state, State::Faulty);
  }
  return state;
}

void checkPaths(Sampler* sampler, Findings& findings)
{
  vtkPolyData* output = sampler->GetOutput();
  const vtkIdType points = output->GetNumberOfPoints();
  const vtkIdType paths = output->GetNumberOfCells();
  const int asked = sampler->GetNumberOfSteps();
  const int times = (asked > 0 ? asked : 32) + 1;
  findings.That(points == paths * times, "a point for each time of each path");
  requireArray(output->GetPointData(), "SeedId", 1, points, findings);
  requireArray(output->GetPointData(), "Time", 1, points, findings);
  vtkDataArray* mass = requireArray(output->GetPointData(), "Mass", 1, points, findings);
  findings.Near(
    sumOf(mass), requireField(output, "TotalMass", findings) * times, 1e-9, "mass of paths");
}

void checkSampler(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* sampler = Sampler::SafeDownCast(filter);
  vtkPolyData* output = sampler->GetOutput();
  requireFinitePoints(output, findings);
  const double total = requireField(output, "TotalMass", findings);
  const double cost = requireField(output, "TransportCost", findings);
  findings.That(cost >= 0.0, "TransportCost >= 0");
  checkBound(sampler, output, sampler->GetFlowTime() == 1.0, cost, findings);
  const bool sound = densityState(filter, inputs[0][0]) == State::Sound;
  if (sound)
  {
    findings.Near(total, massOf(filter, inputs[0][0]), 1e-9, "TotalMass");
    requireInside(output, inputs[0][0], findings);
  }
  if (sampler->GetOutputPaths())
  {
    checkPaths(sampler, findings);
    return;
  }
  const vtkIdType count = output->GetNumberOfPoints();
  requireVertices(output, findings);
  checkSlack(sampler, findings);
  vtkPointData* data = output->GetPointData();
  vtkDataArray* ids = requireArray(data, "SeedId", 1, count, findings);
  for (vtkIdType i = 0; ids && i < count; ++i)
  {
    if (ids->GetComponent(i, 0) != static_cast<double>(i))
    {
      findings.That(false, "SeedId of " + std::to_string(i));
      break;
    }
  }
  vtkDataArray* seeds = requireArray(data, "SeedPosition", 3, count, findings);
  vtkDataArray* displacements = requireArray(data, "Displacement", 3, count, findings);
  vtkDataArray* mass = requireArray(data, "Mass", 1, count, findings);
  findings.Near(sumOf(mass), total, 1e-9, "sum of Mass");
  if (!inputs[1].empty())
  {
    auto* given = vtkPointSet::SafeDownCast(inputs[1][0].Data);
    findings.That(count == given->GetNumberOfPoints(), "a particle for each seed");
    requirePassed(given->GetPointData(), data,
      { "SeedId", "SeedPosition", "Displacement", "Mass", "Slack" }, findings);
  }
  else if (!usesGrid(sampler) && sampler->GetSeedPattern() != Sampler::LATTICE)
  {
    findings.That(count == sampler->GetNumberOfParticles(), "NumberOfParticles");
  }
  double way = 0.0;
  for (vtkIdType i = 0; seeds && displacements && sound && i < count; ++i)
  {
    double x[3];
    output->GetPoint(i, x);
    for (int a = 0; a < 3; ++a)
    {
      way = std::max(
        way, std::abs(x[a] - seeds->GetComponent(i, a) - displacements->GetComponent(i, a)));
    }
  }
  findings.That(way <= 1e-9, "Displacement is off by " + textOf(way));
}

//------------------------------------------------------------------------------
using Warp = vtkDensityEqualizingWarp;

void drawWarp(Settings& settings)
{
  settings.Draw<Warp, double>("Blend", &Warp::SetBlend, { 0.0, 0.3, 1.0 }, { -0.1, 1.5, NaN });
  settings.Draw<Warp, vtkTypeBool>("EqualizeAreas", &Warp::SetEqualizeAreas, { 0, 1 }, {}, 0.3);
  drawEmptySettings<Warp>(settings);
  settings.Draw<Warp, double>(
    "Margin", &Warp::SetMargin, { 0.0, 0.05, 0.3 }, { -0.1, 10.5, NaN }, 0.3);
  drawFlowSettings<vtkTransportAlgorithm>(settings);
  drawTables<Warp>(settings);
  drawDevice<Warp>(settings);
  drawMethod<Warp>(settings);
  drawDensitySettings(settings);
}

Inputs drawPointsAndDensityInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[1] = { drawDensityOn(random, settings, 1) };
  inputs[0] = { drawPoints(
    random, vtkImageData::SafeDownCast(inputs[1][0].Data), settings.IsLarge() ? 20000 : 600) };
  return inputs;
}

State expectWarp(vtkAlgorithm* filter, const Inputs& inputs)
{
  return worse(densityState(filter, inputs[1][0]), inputs[0][0].Condition);
}

void checkWarp(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  vtkPointSet* output = Warp::SafeDownCast(filter)->GetOutput();
  auto* input = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  requireFinitePoints(output, findings);
  auto* warp = Warp::SafeDownCast(filter);
  vtkDataArray* cost = output->GetFieldData()->GetArray("TransportCost");
  checkBound(warp, output, warp->GetBlend() > 0.0, cost ? cost->GetComponent(0, 0) : 0.0, findings);
  const vtkIdType count = input->GetNumberOfPoints();
  findings.That(output->GetNumberOfPoints() == count &&
      output->GetNumberOfCells() == input->GetNumberOfCells() &&
      output->GetDataObjectType() == input->GetDataObjectType(),
    "as many points and cells as before");
  vtkDataArray* displacements =
    requireArray(output->GetPointData(), "Displacement", 3, count, findings);
  requirePassed(input->GetPointData(), output->GetPointData(), { "Displacement" }, findings);
  double way = 0.0;
  for (vtkIdType i = 0; displacements && i < count; ++i)
  {
    double x[3];
    double before[3];
    output->GetPoint(i, x);
    input->GetPoint(i, before);
    for (int a = 0; a < 3; ++a)
    {
      way = std::max(way, std::abs(x[a] - before[a] - displacements->GetComponent(i, a)));
    }
  }
  findings.That(expectWarp(filter, inputs) != State::Sound || way <= 1e-9,
    "Displacement is off by " + textOf(way));
}

//------------------------------------------------------------------------------
using Quality = vtkTransportQuality;

void drawQuality(Settings& settings)
{
  settings.Draw<Quality, int>("BlockSize", &Quality::SetBlockSize,
    { 0, 1, 2, 8, 100, std::numeric_limits<int>::max() }, { -1, -3 });
  drawTables<Quality>(settings);
  drawThreading<Quality>(settings);
  drawDensitySettings(settings);
}

State expectQuality(vtkAlgorithm* filter, const Inputs& inputs)
{
  auto* set = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  const bool weighed =
    set->GetPointData()->GetArray("Mass") || set->GetPointData()->GetArray("Displacement");
  return worse(expectWarp(filter, inputs), weighed ? State::Odd : State::Sound);
}

void checkQuality(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  vtkTable* table = Quality::SafeDownCast(filter)->GetOutput();
  vtkDataSetAttributes* row = table->GetRowData();
  const auto value = [&](const char* name) {
    vtkDataArray* column = requireArray(row, name, 1, 1, findings);
    return column ? column->GetComponent(0, 0) : 0.0;
  };
  const auto count =
    static_cast<double>(vtkPointSet::SafeDownCast(inputs[0][0].Data)->GetNumberOfPoints());
  const double particles = value("Particles");
  findings.That(particles >= 0.0 && particles <= count, "Particles");
  findings.That(value("Outside") >= 0.0 && value("InEmptyCells") >= 0.0 &&
      value("Outside") + value("InEmptyCells") <= particles,
    "Outside and InEmptyCells");
  findings.That(value("DensityError") >= 0.0 && value("TransportCost") >= 0.0, "no negative value");
  findings.That(value("SmallestSpacing") >= 0.0 &&
      value("SmallestSpacing") <= value("MeanSpacing") * (1.0 + 1e-12),
    "SmallestSpacing <= MeanSpacing");
  if (densityState(filter, inputs[1][0]) == State::Sound)
  {
    findings.Near(value("TotalMass"), massOf(filter, inputs[1][0]), 1e-9, "TotalMass");
  }
}

//------------------------------------------------------------------------------
using Relaxation = vtkBlueNoiseRelaxation;

void drawRelaxation(Settings& settings)
{
  settings.Draw<Relaxation, int>("Method", &Relaxation::SetMethod, { 0, 1 }, { -1, 2 }, 0.6);
  settings.Draw<Relaxation, int>("MaximumIterations", &Relaxation::SetMaximumIterations,
    { 0, 1, 2, 3 }, { -1, std::numeric_limits<int>::min() }, 1.0);
  settings.Draw<Relaxation, double>("Tolerance", &Relaxation::SetTolerance,
    { 0.0, 0.1, 0.999, 5e-324 }, { -0.1, 1.0, NaN, Infinity }, 0.4);
  drawDensitySettings(settings);
  drawThreading<Relaxation>(settings);
}

Inputs drawRelaxationInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[1] = { drawDensityOn(random, settings, 1) };
  inputs[0] = { drawPoints(
    random, vtkImageData::SafeDownCast(inputs[1][0].Data), settings.IsLarge() ? 3000 : 300) };
  return inputs;
}

// Whether one value has most of the mass.
bool isConcentrated(vtkAlgorithm* filter, const Input& density)
{
  double sum = 0.0;
  double largest = 0.0;
  for (vtkIdType i = 0; density.Values && i < density.Values->GetNumberOfTuples(); ++i)
  {
    const double value = std::max(valueAt(filter, density, i), 0.0);
    sum += value;
    largest = std::max(largest, value);
  }
  return 2.0 * largest > sum;
}

State expectRelaxation(vtkAlgorithm* filter, const Inputs& inputs)
{
  const bool byTransport =
    Relaxation::SafeDownCast(filter)->GetMethod() == Relaxation::OPTIMAL_TRANSPORT;
  const int dimension = vtkImageData::SafeDownCast(inputs[1][0].Data)->GetDataDimension();
  const bool isPossible = dimension >= 2 && dimension <= (byTransport ? 2 : 3);
  // Of points that are not where the mass is cells of equal mass may not be found.
  const bool isSound = isPossible && !(byTransport && isConcentrated(filter, inputs[1][0]));
  return worse(expectWarp(filter, inputs),
    isSound        ? State::Sound
      : isPossible ? State::Odd
                   : State::Faulty);
}

void checkRelaxation(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* relaxation = Relaxation::SafeDownCast(filter);
  vtkPointSet* output = relaxation->GetOutput();
  auto* input = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  requireFinitePoints(output, findings);
  findings.That(output->GetNumberOfPoints() == input->GetNumberOfPoints() &&
      output->GetNumberOfCells() == input->GetNumberOfCells() &&
      output->GetDataObjectType() == input->GetDataObjectType(),
    "as many points and cells as before");
  requirePassed(input->GetPointData(), output->GetPointData(), {}, findings);
  if (!input->GetPointGhostArray() && densityState(filter, inputs[1][0]) == State::Sound)
  {
    requireInside(output, inputs[1][0], findings);
  }
  vtkDataArray* energy = output->GetFieldData()->GetArray("Energy");
  findings.That(energy && energy->GetNumberOfComponents() == 1 &&
      energy->GetNumberOfTuples() <= relaxation->GetMaximumIterations() + 1 &&
      (energy->GetNumberOfTuples() > 0 || input->GetPointGhostArray()),
    "the number of energies");
  for (vtkIdType i = 0; energy && i < energy->GetNumberOfTuples(); ++i)
  {
    const double value = energy->GetComponent(i, 0);
    findings.That(std::isfinite(value), "a finite energy");
    findings.That(i == 0 || value <= energy->GetComponent(i - 1, 0), "no greater energy");
  }
}

//------------------------------------------------------------------------------
void quickSampler(RandomSource&, vtkAlgorithm* filter)
{
  Sampler::SafeDownCast(filter)->SetNumberOfParticles(30);
}

void quickRelaxation(RandomSource& random, vtkAlgorithm* filter)
{
  auto* relaxation = Relaxation::SafeDownCast(filter);
  relaxation->SetMaximumIterations(2);
  relaxation->SetMethod(static_cast<int>(random.Whole(0, 1)));
}

} // namespace

void addTransportKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Sampler", make<Sampler>, drawSampler, drawSamplerInputs, expectSampler,
    checkSampler, quickSampler });
  kinds.push_back(transportMapKind());
  kinds.push_back({ "Warp", make<Warp>, drawWarp, drawPointsAndDensityInputs, expectWarp, checkWarp,
    leaveAsItIs });
  kinds.push_back({ "Quality", make<Quality>, drawQuality, drawPointsAndDensityInputs,
    expectQuality, checkQuality, leaveAsItIs });
  kinds.push_back({ "Relaxation", make<Relaxation>, drawRelaxation, drawRelaxationInputs,
    expectRelaxation, checkRelaxation, quickRelaxation });
}

} // namespace Campaign
